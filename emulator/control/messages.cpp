#include "emulator/control/messages.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "emulator/edge/daemon.h"
#include "emulator/register_map/access.h"
#include "emulator/world/names.h"

namespace understudy::emulator {

namespace {

using Json = nlohmann::ordered_json;

struct MessageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void demand_keys(const Json& message, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : message.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw MessageError("'" + key + "' is no key of this message");
    }
  }
}

const Json& demand(const Json& message, const char* key) {
  if (!message.contains(key)) throw MessageError("'" + std::string(key) + "' is missing");
  return message[key];
}

/// The object under "values": names with whole numbers.
std::vector<std::pair<std::string, std::int64_t>> named_values(const Json& message) {
  demand_keys(message, {"do", "values"});
  const Json& values = demand(message, "values");
  if (!values.is_object() || values.empty())
    throw MessageError("values: expected an object of names and whole numbers");
  std::vector<std::pair<std::string, std::int64_t>> all;
  for (const auto& [name, value] : values.items()) {
    const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
    if (!value.is_number_integer() || huge) throw MessageError(name + ": expected a whole number");
    all.emplace_back(name, value.get<std::int64_t>());
  }
  return all;
}

double microseconds(WallTime time) { return static_cast<double>(time.count()) / 1000.0; }

Json line_status(const Daemon& daemon, const Port& port) {
  const World::OneLine& line = daemon.world().line(port.line_number());
  const pty::LineCounters& counters = line.line.counters();
  Json status{{"name", line.line.name()},
              {"pty", port.terminal().path()},
              {"link", port.terminal().link_path()},
              {"settings", pty::to_string(line.line.options().settings)},
              {"timing", line.line.options().timing == pty::Timing::wire ? "wire" : "instant"},
              {"host", port.host_present() ? "open" : "closed"}};
  if (port.host_present() && port.host_settings()) status["host_baud"] = port.host_settings()->baud;
  status["bytes_in"] = counters.bytes_in;
  status["bytes_out"] = counters.bytes_out;
  status["bytes_unheard"] = counters.bytes_unheard;
  status["bytes_discarded"] = counters.bytes_discarded;
  status["collisions"] = counters.collisions;
  status["stations"] = Json::array();
  for (const auto& station : line.stations) {
    status["stations"].push_back(Json{{"device", station->device().name()},
                                      {"address", station->device().settings().address},
                                      {"requests", station->counters().requests},
                                      {"replies", station->counters().replies},
                                      {"exceptions", station->counters().exceptions},
                                      {"bytes_dropped", station->dropped_bytes()}});
  }
  return status;
}

Json device_status(const World& world, std::size_t number) {
  const Device& device = world.device(number);
  Json status{
      {"name", device.name()}, {"model", device.model().name}, {"firmware", version_text(device.firmware())}};
  status["machines"] = Json::object();
  for (std::size_t axis = 0; axis < device.model().axes.size(); ++axis) {
    const PlantAxis& plant = world.plant(number, static_cast<int>(axis));
    status["machines"][std::string(device.model().axes[axis].name)] =
        Json{{"position_pulses", plant.position_pulses()}, {"lost_pulses", plant.lost_pulses()}};
  }
  return status;
}

Json status(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do"});
  daemon.catch_up();
  const World& world = daemon.world();
  const Pacer& pacer = daemon.pacer();
  Json status{{"simulated_time", format_duration(world.now())},
              {"simulated_time_ns", world.now().count()},
              {"speed", format_speed(pacer.speed())},
              {"paused", pacer.paused()},
              {"lateness",
               {{"wakes", pacer.lateness().count()},
                {"p50_us", microseconds(pacer.lateness().percentile(50))},
                {"p99_us", microseconds(pacer.lateness().percentile(99))},
                {"max_us", microseconds(pacer.lateness().greatest())},
                {"slips", pacer.slips()}}},
              {"ticks", {{"stepped", world.ticks_run()}, {"crossed", world.ticks_crossed()}}}};
  status["lines"] = Json::array();
  for (const auto& port : daemon.ports()) status["lines"].push_back(line_status(daemon, *port));
  status["devices"] = Json::array();
  for (std::size_t i = 0; i < world.device_count(); ++i) status["devices"].push_back(device_status(world, i));
  return Json{{"ok", true}, {"status", status}};
}

Json get(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "names"});
  const Json& names = demand(message, "names");
  if (!names.is_array() || names.empty()) throw MessageError("names: expected a list of register names");
  daemon.catch_up();
  Json values = Json::object();
  for (const Json& name : names) {
    if (!name.is_string()) throw MessageError("names: expected a list of register names");
    const RegisterName found = find_register(daemon.world(), name.get<std::string>());
    const Device& device = daemon.world().device(found.device);
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

Json set(Daemon& daemon, const Json& message) {
  daemon.catch_up();
  World& world = daemon.world();
  const auto wanted = named_values(message);
  std::vector<RegisterName> places;
  std::vector<PreparedWrite> writes(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto& [name, value] = wanted[i];
    const RegisterName place = find_register(world, name);
    // Two bits, or halves, of one register would be judged one without the other.
    for (const RegisterName& other : places) {
      if (other.device == place.device && other.place.place.slot == place.place.place.slot) {
        throw MessageError(name + ": its register is named twice; expected it once");
      }
    }
    places.push_back(place);
    demand_accepted(prepare_value(world.device(place.device), place.place, value, writes[i]), name, value,
                    *place.place.place.row);
  }
  for (std::size_t i = 0; i < writes.size(); ++i) write_prepared(world.device(places[i].device), writes[i]);
  return Json{{"ok", true}};
}

Json input(Daemon& daemon, const Json& message) {
  daemon.catch_up();
  const auto wanted = named_values(message);
  std::vector<InputName> inputs;
  for (const auto& [name, level] : wanted) {
    inputs.push_back(find_input(daemon.world(), name));
    for (std::size_t i = 0; i + 1 < inputs.size(); ++i) {
      if (inputs[i].device == inputs.back().device && inputs[i].terminal == inputs.back().terminal) {
        throw MessageError(name + ": is named twice; expected it once");
      }
    }
    if (level != 0 && level != 1)
      throw MessageError(name + ": " + std::to_string(level) + " is no level; expected 0 or 1");
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    daemon.world().set_external_input(inputs[i].device, inputs[i].terminal, wanted[i].second == 1);
  }
  return Json{{"ok", true}};
}

/// The reply comes when simulated time is there.
void advance(Daemon& daemon, const Json& message, const std::function<void(const std::string&)>& reply) {
  demand_keys(message, {"do", "by"});
  const Json& by = demand(message, "by");
  const auto duration = by.is_string() ? parse_duration(by.get<std::string>()) : std::nullopt;
  if (!duration) throw MessageError("by: expected a duration with a unit, such as \"250ms\"");
  if (*duration > std::chrono::hours(24 * 365))
    throw MessageError("by: is more than a year; expected at most that");
  if (*duration > kHorizon - daemon.world().now()) {
    throw MessageError("by: is beyond the end of simulated time; expected at most " +
                       format_duration(kHorizon - daemon.world().now()));
  }
  const bool begun = daemon.advance(*duration, [&daemon, reply] {
    reply(Json{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}}.dump());
  });
  if (!begun) {
    throw MessageError(
        "time runs by itself, or is being advanced already; expected --speed manual, or `pause` first");
  }
}

}  // namespace

void handle_message(Daemon& daemon, const std::string& line,
                    const std::function<void(const std::string&)>& reply) {
  try {
    const Json message = Json::parse(line);
    if (!message.is_object() || !message.contains("do") || !message["do"].is_string()) {
      throw MessageError("expected an object with a word under \"do\"");
    }
    const std::string verb = message["do"].get<std::string>();
    if (verb == "status") return reply(status(daemon, message).dump());
    if (verb == "get") return reply(get(daemon, message).dump());
    if (verb == "set") return reply(set(daemon, message).dump());
    if (verb == "input") return reply(input(daemon, message).dump());
    if (verb == "advance") return advance(daemon, message, reply);
    if (verb == "pause" || verb == "resume") {
      demand_keys(message, {"do"});
      if (verb == "pause") daemon.pause();
      if (verb == "resume" && !daemon.resume())
        throw MessageError("time is being advanced; expected `resume` after that");
      return reply(Json{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}}.dump());
    }
    throw MessageError("'" + verb +
                       "' is nothing to do; expected status, get, set, input, advance, pause or resume");
  } catch (const Json::exception&) {
    reply(R"({"ok":false,"error":"the message is not JSON; expected one object on one line"})");
  } catch (const std::runtime_error& error) {
    // Names come from outside and may be no UTF-8.
    reply(Json{{"ok", false}, {"error", error.what()}}.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
}

}  // namespace understudy::emulator
