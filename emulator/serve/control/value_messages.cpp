// Handles messages about registers and all other values that conditions can use.
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/parser.h"
#include "emulator/world/expression/term.h"
#include "emulator/world/names/names.h"
#include "emulator/world/probe/probes.h"

namespace understudy::emulator::serve {

namespace {

/// A number for a register. It must be whole unless the register contains a real number.
struct WantedRegister {
  std::string name;
  Json number;
};

/// The values that `set` assigns to registers and to devices without registers.
struct WantedValues {
  std::vector<WantedRegister> registers;
  std::vector<std::pair<world::ValueName, double>> values;
};

/// Returns true if this is the name of a register for real numbers.
bool is_real_register(const world::KnownDevices& known, const std::string& name) {
  try {
    return world::find_register(known, name).place.is_real();
  } catch (const world::NameError&) {
    return false;  // the error is reported when the name is looked up
  }
}

/// Returns an error that describes which values the register accepts. Throws world::NameError if there is no
/// such register.
MessageError no_number(const world::KnownDevices& known, const std::string& name, const Json& value) {
  if (world::find_value(known, name)) return is_not(name, value, "a number");
  const world::RegisterName place = world::find_register(known, name);
  if (place.place.is_real()) return is_not(name, value, "a number");
  const std::string range = range_text(place.place, -1);
  if (value.is_number_integer())
    return MessageError(name + ": " + shown(value) + " is out of range; expected " + range);
  return is_not(name, value, value.is_number() ? "a whole number" : "a number", range);
}

/// Reads the names and numbers in "values". The numbers must be whole, except for registers with real
/// numbers.
WantedValues named_values(const Json& message, const world::KnownDevices& known) {
  require_keys(message, {"do", "values"});
  const Json& values = require_values(message, "names and whole numbers");
  WantedValues all;
  for (const auto& [name, given] : values.items()) {
    const Json value = given.is_boolean() ? Json(given.get<bool>() ? 1 : 0) : given;
    if (value.is_number()) {
      if (auto found = world::find_value(known, name)) {
        all.values.emplace_back(std::move(*found), value.get<double>());
        continue;
      }
    }
    const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
    const bool is_real = value.is_number() && is_real_register(known, name);
    if (!is_real && (!value.is_number_integer() || huge)) {
      throw no_number(known, name, value);
    }
    all.registers.push_back({name, value});
  }
  return all;
}

/// Returns a number as JSON.
Json json_number(world::Number number) {
  if (number.is_whole()) return number.whole();
  return number.real();
}

std::string_view unit_word(world::Unit unit) {
  switch (unit) {
    case world::Unit::nanoseconds: return "ns";
    case world::Unit::millivolts: return "mV";
    case world::Unit::none: break;
  }
  return {};
}

world::NamedNumber resolve(const world::World& world, const world::Probes& probes, const std::string& name) {
  try {
    return probes.resolve(name);
  } catch (const world::NameError&) {
    // A device with a text protocol has values only while it is powered.
    std::optional<world::ValueName> value;
    try {
      value = world::find_value(world.known(), name);
    } catch (const world::NameError&) {
    }
    if (value) require_power(world.device(value->device));
    throw;
  }
}

void require_accepted(Refusal refusal, const std::string& name, const std::string& reported,
                      const NamedPlace& place, Value value) {
  switch (refusal) {
    case Refusal::none: return;
    case Refusal::no_register: throw MessageError(name + " " + why_not_writable(place));
    case Refusal::bad_value:
      throw MessageError(name + ": " + reported + " is out of range; expected " + range_text(place, value));
    case Refusal::busy: throw MessageError(name + " cannot be written now; the device is busy");
    case Refusal::failure:
      throw MessageError(name + " cannot be written now; the device refuses it (exception 4)");
  }
}

/// Converts a number to a register value.
Value value_for(const world::RegisterName& place, const WantedRegister& wanted) {
  if (!place.place.is_real()) return wanted.number.get<std::int64_t>();
  if (const auto value = value_of_number(place.place, wanted.number.get<double>())) return *value;
  throw MessageError(wanted.name + ": " + wanted.number.dump() + " is too large for a 32-bit real");
}

/// Tries all assignments on a copy of the device, so that either all of them are made or none.
void require_possible(const world::World& world,
                      const std::vector<std::pair<world::ValueName, double>>& wanted) {
  std::map<std::size_t, std::unique_ptr<Device>> trials;
  for (const auto& [place, value] : wanted) {
    const Device& device = world.device(place.device);
    require_power(device);
    auto& trial = trials[place.device];
    if (!trial) {
      trial = make_device(device.model(), device.settings());
      trial->restore_state(device.save_state());
    }
    const NamedValues* const values = device.named_values();
    if (values == nullptr || !values->value_named(place.name))
      throw MessageError(why_no_value(device, place.name));
    if (const auto diagnostic = trial->named_values()->assign(place.name, value)) {
      throw MessageError(place.name + ": " + *diagnostic);
    }
  }
}

}  // namespace

namespace {

/// Looks up all names first, so that all values are read at the same moment.
ReplyTask get_names_message(Daemon& daemon, Json message) {
  require_keys(message, {"do", "names"});
  const Json& names = require(message, "names");
  if (!names.is_array() || names.empty()) throw is_not("names", names, "a list of names");
  daemon.catch_up();
  const Pause pause(daemon);
  const world::World& world = daemon.world();
  const world::Probes probes(world);
  std::vector<world::NamedNumber> found;
  std::set<std::string> known;
  std::vector<std::string> texts;
  for (const Json& entry : names) {
    if (!entry.is_string()) throw is_not("names", names, "a list of names");
    std::string name = entry.get<std::string>();
    if (!known.insert(name).second) continue;
    found.push_back(resolve(world, probes, name));
    texts.push_back(std::move(name));
    co_await pause;
  }
  daemon.catch_up();
  std::vector<world::Number> values;
  for (const world::NamedNumber& one : found) {
    if (const auto device = probes.device_read(one.handle)) require_power(world.device(*device));
    values.push_back(probes.value(one.handle));
  }
  ReplyText text;
  text.open_object("values");
  Json units = Json::object();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    text.member(texts[i], json_number(values[i]));
    if (found[i].unit != world::Unit::none) units[texts[i]] = unit_word(found[i].unit);
    co_await pause;
  }
  text.close_object();
  if (!units.empty()) text.member("units", units);
  co_return text.take();
}

}  // namespace

ReplyTask get_message(Daemon& daemon, Json message) {
  for (const char* key : {"device", "section", "find", "from"}) {
    if (message.contains(key)) return get_page_message(daemon, std::move(message));
  }
  return get_names_message(daemon, std::move(message));
}

Json eval_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "expression"});
  const std::string text = require_text(message, "expression");
  daemon.catch_up();
  const world::Probes probes(daemon.world());
  world::ExpressionParser parser(text, probes);
  const world::Term term = parser.expression();
  parser.expect_end();
  const world::Expression expression = parser.take();
  for (const std::int32_t name : world::names_in(expression)) {
    if (const auto device = probes.device_read(name)) require_power(daemon.world().device(*device));
  }
  Json reply{{"ok", true}, {"value", json_number(world::evaluate(expression, probes))}};
  if (term.unit != world::Unit::none) reply["unit"] = unit_word(term.unit);
  return reply;
}

Json set_message(Daemon& daemon, const Json& message) {
  daemon.catch_up();
  world::World& world = daemon.world();
  const auto [wanted, values] = named_values(message, world.known());
  require_possible(world, values);
  std::vector<world::RegisterName> places;
  std::vector<PreparedWrite> writes(wanted.size());
  std::vector<bool> low_first;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::string& name = wanted[i].name;
    const world::RegisterName place = world::find_register(world.known(), name);
    // Two bits or halves of the same register would be checked separately.
    for (const world::RegisterName& other : places) {
      if (other.device == place.device && other.place.place.is_same_register(place.place.place)) {
        throw MessageError(name + ": its register appears twice; expected it only once");
      }
    }
    places.push_back(place);
    require_power(world.device(place.device));
    const RegisterBank& bank = *world.device(place.device).register_bank();
    low_first.push_back(bank.low_word_first());
    const Value value = value_for(place, wanted[i]);
    const Refusal refusal = prepare_value(bank, place.place, value, writes[i]);
    require_accepted(refusal, name, wanted[i].number.dump(), place.place, value);
  }
  for (std::size_t i = 0; i < writes.size(); ++i) {
    // An earlier assignment may have changed the word order.
    const RegisterBank& bank = *world.device(places[i].device).register_bank();
    if (bank.low_word_first() != low_first[i]) {
      const Value value = value_for(places[i], wanted[i]);
      require_accepted(prepare_value(bank, places[i].place, value, writes[i]), wanted[i].name,
                       wanted[i].number.dump(), places[i].place, value);
    }
    if (world.write(places[i].device, writes[i]) == Refusal::none) continue;
    throw MessageError(wanted[i].name + " was not written: " +
                       (i == 0 ? "the device" : "after the earlier writes the device") +
                       " does not accept it now");
  }
  for (const auto& [place, value] : values) world.assign(place.device, place.name, value);
  return Json{{"ok", true}};
}

}  // namespace understudy::emulator::serve
