#include "emulator/world/probe/probe_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

namespace {

/// Splits "feeder.A.pulses" at its first dot. The second part is empty if there is no dot.
std::pair<std::string_view, std::string_view> at_dot(std::string_view name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {name, {}};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

// The names that every device has.
constexpr std::array<std::string_view, 4> kOfDevice{"power", "requests", "replies", "exceptions"};

/// Returns true for registers, terminals, axes (as in "A.pulses"), and the names that every device has.
bool has_name(const KnownDevice& device, std::string_view name) {
  return std::find(kOfDevice.begin(), kOfDevice.end(), name) != kOfDevice.end() ||
         find_register(*device.model, name, device.firmware) || find_terminal(*device.model, name) >= 0 ||
         find_group(*device.model, name) != nullptr ||
         (name.find('.') != std::string_view::npos && find_axis(*device.model, at_dot(name).first) >= 0);
}

bool find_of_line(const Inventory& inventory, std::string_view line, std::string_view rest,
                  ProbeNames::Probe& probe) {
  using What = ProbeNames::What;
  static constexpr std::array<std::pair<std::string_view, What>, 3> kOfLine{{
      {"bytes_in", What::bytes_in},
      {"bytes_out", What::bytes_out},
      {"collisions", What::collisions},
  }};
  for (std::size_t i = 0; i < inventory.line_count(); ++i) {
    if (inventory.line_name(i) != line) continue;
    for (const auto& [word, what] : kOfLine) {
      if (word != rest) continue;
      probe.what = what;
      probe.device = i;
      return true;
    }
  }
  return false;
}

/// Finds the names that devices of all models have.
bool find_of_any_device(const Device& device, std::string_view rest, ProbeNames::Probe& probe) {
  using What = ProbeNames::What;
  static constexpr std::array<What, kOfDevice.size()> kWhatOfDevice{What::power, What::requests,
                                                                    What::replies, What::exceptions};
  for (std::size_t i = 0; i < kOfDevice.size(); ++i) {
    if (kOfDevice[i] != rest) continue;
    probe.what = kWhatOfDevice[i];
    return true;
  }
  const Axes* const axes = device.axes();
  if (rest != "pulse_format" || axes == nullptr || axes->pulse_formats().empty()) return false;
  probe.what = What::pulse_format;
  return true;
}

}  // namespace

NamedNumber ProbeNames::resolve(std::string_view name) const {
  std::string whole(name);
  if (const auto known = handles_.find(whole); known != handles_.end()) {
    return {known->second, probe(known->second).unit};
  }
  Probe found = find(name);
  found.name = name;
  const auto handle = static_cast<std::int32_t>(probes_.size());
  probes_.push_back(found);
  handles_.emplace(std::move(whole), handle);
  return {handle, found.unit};
}

bool ProbeNames::find_of_axis(std::string_view rest, Probe& probe) const {
  static constexpr std::array<std::pair<std::string_view, What>, 18> kOfAxis{{
      {"pulses", What::pulses},
      {"target", What::target},
      {"speed", What::speed},
      {"servo", What::servo},
      {"pwm", What::pwm},
      {"greatest_speed", What::greatest_speed},
      {"greatest_acceleration", What::greatest_acceleration},
      {"position", What::position},
      {"lost", What::lost},
      {"encoder", What::encoder},
      {"home", What::home},
      {"upper_limit", What::upper_limit},
      {"lower_limit", What::lower_limit},
      {"near_home", What::near_home},
      {"mark", What::mark},
      {"index", What::index},
      {"ready", What::ready},
      {"alarm", What::alarm},
  }};
  const auto [axis_name, what_name] = at_dot(rest);
  const Model& model = *inventory_.known()[probe.device].model;
  const int axis = find_axis(model, axis_name);
  if (axis < 0 || rest.find('.') == std::string_view::npos) return false;
  std::vector<std::string> known;
  const PlantSetup& machine = inventory_.machine(probe.device, axis);
  for (const auto& [word, what] : kOfAxis) {
    const bool is_lacking = (what == What::near_home && !machine.near_home) ||
                            (what == What::mark && !machine.mark) || (what == What::index && !machine.index);
    if (is_lacking) continue;
    if (what == What::pwm && !inventory_.device(probe.device).axes()->duty_percent(axis)) continue;
    if (what == What::servo && !inventory_.device(probe.device).axes()->servo_on(axis)) continue;
    known.emplace_back(word);
    if (word != what_name) continue;
    probe.what = what;
    probe.place = axis;
    return true;
  }
  if (what_name.empty()) {
    const std::string whole = inventory_.known()[probe.device].name + "." + std::string(axis_name);
    std::string values;
    for (const std::string& word : known) values += (values.empty() ? "" : ", ") + whole + "." + word;
    throw NameError(quoted(whole) + " is an axis; expected one of its values: " + values);
  }
  throw NameError("axis " + std::string(axis_name) + " has no " + quoted(what_name) +
                  suggestion(what_name, known));
}

bool ProbeNames::find_of_terminal(const Model& model, std::string_view rest, Probe& probe) const {
  if (const int terminal = find_terminal(model, rest); terminal >= 0) {
    const TerminalRow::Kind kind = model.terminals[static_cast<std::size_t>(terminal)].kind;
    probe.what = is_input(kind) ? What::input : What::output;
    probe.place = terminal;
    if (is_in_millivolts(kind)) probe.unit = Unit::millivolts;
    return true;
  }
  if (const TerminalGroup* const group = find_group(model, rest)) {
    probe.what = What::terminal_group;
    probe.group = group;
    return true;
  }
  const auto [name, word] = at_dot(rest);
  const int terminal = word == "pulses" ? find_terminal(model, name) : -1;
  if (terminal < 0 ||
      model.terminals[static_cast<std::size_t>(terminal)].kind != TerminalRow::Kind::pulse_out)
    return false;
  probe.what = What::output_pulses;
  probe.place = terminal;
  return true;
}

ProbeNames::Probe ProbeNames::find(std::string_view name) const {
  Probe probe;
  if (name == "time") {
    probe.unit = Unit::nanoseconds;
    return probe;
  }
  const auto [first, behind] = at_dot(name);
  if (find_of_line(inventory_, first, behind, probe)) return probe;
  // If there is only one device, its name may be omitted.
  const KnownDevices& known = inventory_.known();
  std::string_view rest = name;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].name != first || behind.empty()) continue;
    probe.device = i;
    rest = behind;
  }
  if (rest == name && known.size() != 1) throw name_without_device(known, name, has_name, "NAME");
  if (find_of_any_device(inventory_.device(probe.device), rest, probe)) return probe;
  if (find_of_axis(rest, probe)) return probe;
  const KnownDevice& device = known[probe.device];
  if (const auto place = find_register(*device.model, rest, device.firmware)) {
    probe.what = What::reg;
    probe.reg = *place;
    return probe;
  }
  if (find_of_terminal(*device.model, rest, probe)) return probe;
  const Device& there = inventory_.device(probe.device);
  const NamedValues* const values = there.named_values();
  const bool has_value = values != nullptr && values->value_named(rest).has_value();
  if (!has_value) find_of_axis(std::string(rest) + ".", probe);  // throws if the name is an axis alone
  if (rest == device.name) throw NameError(quoted(rest) + " is a device; expected " + device.name + ".NAME");
  if (there.register_bank() != nullptr) {
    throw NameError(device.name + ": " + why_no_register(*device.model, rest, device.firmware));
  }
  if (!has_value) throw NameError(why_no_value(there, rest));
  probe.what = What::named;
  probe.value_name = rest;
  return probe;
}

bool ProbeNames::is_of_scenarios(std::int32_t handle) const {
  const What what = probe(handle).what;
  return what == What::greatest_speed || what == What::greatest_acceleration;
}

}  // namespace understudy::emulator::world
