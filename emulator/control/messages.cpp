#include "emulator/control/messages.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "emulator/bench/names.h"
#include "emulator/control/message_fields.h"
#include "emulator/control/verbs.h"
#include "emulator/edge/daemon.h"
#include "emulator/one_line.h"
#include "emulator/register_map/access.h"
#include "emulator/strict_json.h"

namespace understudy::emulator {

namespace {

/// What `set` wants: of registers, and of devices without them.
struct WantedValues {
  std::vector<std::pair<std::string, std::int64_t>> registers;
  std::vector<std::pair<ValueName, double>> values;
};

/// The object under "values": names with numbers, whole ones for registers.
WantedValues named_values(const Json& message, const KnownDevices& known) {
  demand_keys(message, {"do", "values"});
  const Json& values = demand(message, "values");
  if (!values.is_object() || values.empty())
    throw MessageError("values: expected an object of names and whole numbers");
  WantedValues all;
  for (const auto& [name, value] : values.items()) {
    if (value.is_number()) {
      if (auto found = find_value(known, name)) {
        all.values.emplace_back(std::move(*found), value.get<double>());
        continue;
      }
    }
    const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
    if (!value.is_number_integer() || huge) throw MessageError(name + ": expected a whole number");
    all.registers.emplace_back(name, value.get<std::int64_t>());
  }
  return all;
}

void demand_power(const Device& device) {
  if (!device.powered()) throw MessageError(device.name() + " has no power; expected it switched on");
}

Json get(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "names"});
  const Json& names = demand(message, "names");
  if (!names.is_array() || names.empty()) throw MessageError("names: expected a list of register names");
  daemon.catch_up();
  Json values = Json::object();
  for (const Json& name : names) {
    if (!name.is_string()) throw MessageError("names: expected a list of register names");
    if (const auto value = find_value(daemon.world().known(), name.get<std::string>())) {
      const Device& device = daemon.world().device(value->device);
      demand_power(device);
      const auto present = device.value_named(value->name);
      if (!present) throw MessageError(device.why_no_value(value->name));
      values[name.get<std::string>()] = json_of(*present);
      continue;
    }
    const RegisterName found = find_register(daemon.world().known(), name.get<std::string>());
    const Device& device = daemon.world().device(found.device);
    demand_power(device);
    values[name.get<std::string>()] = read_value(device, found.place);
  }
  return Json{{"ok", true}, {"values", values}};
}

void demand_accepted(Refusal refusal, const std::string& name, std::int64_t value, const RegisterRow& row) {
  switch (refusal) {
    case Refusal::none: return;
    case Refusal::no_register: throw MessageError(name + " cannot be written; it is read-only");
    case Refusal::bad_value:
      throw MessageError(name + ": " + std::to_string(value) + " is out of range; expected " +
                         range_text(row));
  }
}

/// Each is tried on a device that is made alike, so that all are given or none.
void demand_possible(const World& world, const std::vector<std::pair<ValueName, double>>& wanted) {
  std::map<std::size_t, std::unique_ptr<Device>> trials;
  for (const auto& [place, value] : wanted) {
    const Device& device = world.device(place.device);
    demand_power(device);
    auto& trial = trials[place.device];
    if (!trial) {
      trial = make_device(device.model(), device.settings());
      trial->restore_state(device.save_state());
    }
    if (!device.value_named(place.name)) throw MessageError(device.why_no_value(place.name));
    if (const auto complaint = trial->assign(place.name, value)) {
      throw MessageError(place.name + ": " + *complaint);
    }
  }
}

Json set(Daemon& daemon, const Json& message) {
  daemon.catch_up();
  World& world = daemon.world();
  const auto [wanted, values] = named_values(message, world.known());
  demand_possible(world, values);
  std::vector<RegisterName> places;
  std::vector<PreparedWrite> writes(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto& [name, value] = wanted[i];
    const RegisterName place = find_register(world.known(), name);
    // Two bits, or halves, of one register would be judged one without the other.
    for (const RegisterName& other : places) {
      if (other.device == place.device && other.place.place.slot == place.place.place.slot) {
        throw MessageError(name + ": its register is named twice; expected it once");
      }
    }
    places.push_back(place);
    demand_power(world.device(place.device));
    demand_accepted(prepare_value(world.device(place.device), place.place, value, writes[i]), name, value,
                    *place.place.place.row);
  }
  for (std::size_t i = 0; i < writes.size(); ++i) world.write(places[i].device, writes[i]);
  for (const auto& [place, value] : values) world.assign(place.device, place.name, value);
  return Json{{"ok", true}};
}

/// Those that are answered at once.
struct Verb {
  std::string_view name;
  Json (*answer)(Daemon& daemon, const Json& message);
};
constexpr std::array<Verb, 13> kVerbs{{{"status", status_message},
                                       {"get", get},
                                       {"set", set},
                                       {"input", input_message},
                                       {"power", power_message},
                                       {"program", program_message},
                                       {"inject", inject_message},
                                       {"clear", clear_message},
                                       {"list", list_message},
                                       {"snapshot", snapshot_message},
                                       {"restore", restore_message},
                                       {"pause", pause_message},
                                       {"resume", resume_message}}};

std::string line_of(const Json& answer) {
  return answer.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void handle_message(Daemon& daemon, const std::string& line,
                    const std::function<void(const std::string&)>& reply) {
  try {
    const Json message = parse_strict_json<Json>(line, [](const std::string& key) {
      return MessageError(emulator::quoted(key) + " is there twice; expected it once");
    });
    if (!message.is_object() || !message.contains("do") || !message["do"].is_string()) {
      throw MessageError("expected an object with a word under \"do\"");
    }
    const std::string verb = message["do"].get<std::string>();
    for (const Verb& known : kVerbs) {
      // Names and programs come from outside and may be no UTF-8.
      if (verb == known.name) return reply(line_of(known.answer(daemon, message)));
    }
    if (verb == "advance") return advance_message(daemon, message, reply);
    if (verb == "run-until") return run_until_message(daemon, message, reply);
    std::string names = "advance, run-until";
    for (const Verb& known : kVerbs) names += ", " + std::string(known.name);
    throw MessageError(emulator::quoted(verb) + " is nothing to do; expected one of " + names);
  } catch (const Json::exception&) {
    reply(R"({"ok":false,"error":"the message is not JSON; expected one object on one line"})");
  } catch (const std::exception& error) {
    reply(line_of(Json{{"ok", false}, {"error", error.what()}}));
  }
}

}  // namespace understudy::emulator
