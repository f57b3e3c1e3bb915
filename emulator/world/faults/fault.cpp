#include "emulator/world/faults/fault.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/world/faults/field_values.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/faults/trigger_text.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::world {

namespace {

using ValueType = FaultFieldRow::ValueType;
using At = FaultKindRow::Place;

constexpr std::array<std::string_view, 3> kSides{"reply", "request", "both"};  // in the order of Fault::Side

const FaultKindRow& row_of(const std::string& name) {
  std::vector<std::string> names;
  for (const FaultKindRow& row : fault_kinds()) {
    if (row.name == name) return row;
    names.emplace_back(row.name);
  }
  throw NameError(quoted(name) + " is not a fault" + suggestion(name, names));
}

/// Returns the first device on a line and the port that connects it, or nothing if there is no such line.
std::optional<std::pair<std::size_t, std::size_t>> find_line(const KnownDevices& devices,
                                                             const std::string& name) {
  for (std::size_t d = 0; d < devices.size() && !name.empty(); ++d) {
    const auto& lines = devices[d].lines;
    const auto found = std::find(lines.begin(), lines.end(), name);
    if (found != lines.end()) return std::pair(d, static_cast<std::size_t>(found - lines.begin()));
  }
  return std::nullopt;
}

void set_device_or_line(const KnownDevices& devices, const std::string& place, Fault& fault) {
  const auto has_name = [&](const KnownDevice& device) { return device.name == place; };
  const auto line = find_line(devices, place);
  if (line && std::none_of(devices.begin(), devices.end(), has_name)) {
    fault.device = line->first;
    fault.place = static_cast<int>(line->second);
    fault.on_line = true;
    return;
  }
  fault.device = find_device(devices, place);
}

void set_line(const KnownDevices& devices, const std::string& place, Fault& fault) {
  const auto line = find_line(devices, place);
  if (!line) {
    std::vector<std::string> names;
    for (const KnownDevice& device : devices) {
      for (const std::string& name : device.lines) {
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      }
    }
    throw NameError("no line is called " + quoted(place) + suggestion(place, names));
  }
  fault.device = line->first;
  fault.place = static_cast<int>(line->second);
  fault.on_line = true;
}

/// Returns nothing if there is no counted input with that name.
std::optional<InputName> find_counted(const KnownDevices& devices, const std::string& name) {
  try {
    const InputName input = find_input(devices, name);
    if (input.row(devices).kind == TerminalRow::Kind::counted_in) return input;
  } catch (const NameError&) {
  }
  return std::nullopt;
}

void set_place(const KnownDevices& devices, const FaultKindRow& row, const std::string& place, Fault& fault) {
  switch (row.place) {
    case At::device: fault.device = find_device(devices, place); return;
    case At::device_or_line: set_device_or_line(devices, place, fault); return;
    case At::line: set_line(devices, place, fault); return;
    case At::wheel:
      if (const auto input = find_counted(devices, place)) {
        fault.device = input->device;
        fault.place = input->terminal;
        fault.of_input = true;
        return;
      }
      [[fallthrough]];
    case At::axis: {
      const AxisName axis = find_axis(devices, place, row.place == At::wheel);
      fault.device = axis.device;
      fault.place = axis.axis;
      return;
    }
    case At::input: {
      const InputName input = find_input(devices, place);
      if (input.row(devices).kind != TerminalRow::Kind::digital_in) {
        throw NameError(quoted(place) + " cannot be stuck; expected a digital input");
      }
      fault.device = input.device;
      fault.place = input.terminal;
      return;
    }
  }
}

void set_field(const FaultFieldRow& row, const std::string& text, Fault& fault) {
  switch (row.type) {
    case ValueType::number: fault.*row.number = field_number(row.name, text, row.lowest, row.highest); break;
    case ValueType::level: fault.*row.number = field_level(row.name, text); break;
    case ValueType::duration:
      fault.*row.number = field_duration(row.name, text, SimTime{row.lowest}).count();
      break;
    case ValueType::ticks:
    case ValueType::even_ticks: {
      const SimTime time = field_duration(row.name, text, row.lowest * kTickLength);
      const bool is_even = row.type == ValueType::even_ticks;
      if (time % ((is_even ? 2 : 1) * kTickLength) != SimTime{0}) {
        throw NameError(std::string(row.name) + ": " + quoted(text) + " is not valid; expected " +
                        (is_even ? "an even number of milliseconds" : "whole milliseconds"));
      }
      fault.*row.number = time / kTickLength;
      break;
    }
    case ValueType::bytes: fault.*row.bytes = field_bytes(row.name, text); break;
    case ValueType::side: fault.side = static_cast<Fault::Side>(field_word(row.name, text, kSides)); break;
  }
}

std::string expected_of(const FaultFieldRow& row) {
  switch (row.type) {
    case ValueType::level: return "on or off";
    case ValueType::duration:
    case ValueType::ticks:
    case ValueType::even_ticks: return "a duration such as 250ms";
    default: return std::to_string(row.lowest) + " to " + std::to_string(row.highest);
  }
}

/// Returns the text of a field, or an empty text if it has its default value.
std::string text_of(const FaultFieldRow& row, const Fault& fault) {
  switch (row.type) {
    case ValueType::number:
    case ValueType::level: return std::to_string(fault.*row.number);
    case ValueType::duration:
      return row.required || fault.*row.number != 0 ? format_duration(SimTime{fault.*row.number}) : "";
    case ValueType::ticks:
    case ValueType::even_ticks:
      return fault.*row.number != 0 ? format_duration(time_of(fault.*row.number)) : "";
    case ValueType::bytes: return hex_text(fault.*row.bytes);
    case ValueType::side: {
      const auto side = static_cast<std::size_t>(fault.side);
      return fault.side == Fault::Side::reply ? "" : std::string(kSides[side]);
    }
  }
  return {};
}

/// Sets the addresses of a register's words. `name` is the name of the register.
void set_address(const KnownDevices& devices, const std::string& name, Fault& fault) {
  const RegisterName found =
      fault.on_line ? find_register(devices, name) : find_register({devices[fault.device]}, name);
  const Place& place = found.place.place;
  const bool is_wide = place.row->type == Type::u32 || place.row->type == Type::s32;
  using Part = Place::Part;
  fault.trigger.first_address = place.address();
  fault.trigger.last_address = place.address() + (is_wide ? 1 : 0);
  if (place.part == Part::whole) return;
  const KnownDevice& device = devices[fault.on_line ? found.device : fault.device];
  const bool is_first = !is_second_word(place, device.model->registers->policy().low_word_first);
  (is_first ? fault.trigger.last_address : fault.trigger.first_address) =
      place.address() + (is_first ? 0 : 1);
}

bool is_number(const std::string& text) { return !text.empty() && text[0] >= '0' && text[0] <= '9'; }

void set_fields(const KnownDevices& devices, const FaultKindRow& kind, const FaultText& text, Fault& fault) {
  std::vector<std::string> given;
  for (const auto& [name, value] : text.fields) {
    if (std::find(given.begin(), given.end(), name) != given.end()) {
      throw NameError(name + ": is given twice; expected it only once");
    }
    given.push_back(name);
    const auto is_it = [&field = name](const FaultFieldRow& row) { return row.name == field; };
    const auto row = std::find_if(kind.fields.begin(), kind.fields.end(), is_it);
    if (row != kind.fields.end()) {
      set_field(*row, value, fault);
    } else if (name == "address" && !is_number(value)) {
      try {
        set_address(devices, value, fault);
      } catch (const NameError& error) {
        throw NameError("address: " + std::string(error.what()));
      }
    } else if (!set_trigger_field(fault.trigger, name, value)) {
      std::vector<std::string> known = trigger_fields();
      for (const FaultFieldRow& field : kind.fields) known.emplace_back(field.name);
      throw NameError(one_line(name) + ": is not a field here" + suggestion(name, known));
    }
  }
  for (const FaultFieldRow& row : kind.fields) {
    if (row.required && std::find(given.begin(), given.end(), row.name) == given.end()) {
      throw NameError(std::string(row.name) + " is missing; expected " + expected_of(row));
    }
  }
}

}  // namespace

bool waits(const Fault& fault) { return is_of_frames(fault.kind) || fault.trigger != FaultTrigger{}; }

namespace {

/// Sets all fields except the place.
void set_all_fields(const KnownDevices& devices, const FaultKindRow& row, const FaultText& text,
                    Fault& fault) {
  try {
    set_fields(devices, row, text, fault);
    validate_trigger(fault.trigger);
    if (fault.kind == Fault::Kind::noise && fault.before.empty() && fault.after.empty()) {
      throw NameError("before and after are missing; expected at least one of them");
    }
    if (is_done_at_once(fault.kind) && fault.trigger.lasts != SimTime{0}) {
      throw NameError("for: this fault has no duration; expected no `for`");
    }
  } catch (const NameError& error) {
    // If the message is "field: what is wrong" and the field was specified, it becomes a FaultFieldError.
    const std::string what = error.what();
    const std::size_t colon = what.find(": ");
    const auto is_it = [&](const auto& field) { return one_line(field.first) == what.substr(0, colon); };
    if (colon != std::string::npos && std::any_of(text.fields.begin(), text.fields.end(), is_it)) {
      throw FaultFieldError(text.kind, what.substr(0, colon), what.substr(colon + 2));
    }
    throw NameError(text.kind + ": " + what);
  }
}

}  // namespace

Fault find_fault(const KnownDevices& devices, const FaultText& text) {
  const FaultKindRow& row = row_of(text.kind);
  Fault fault{.kind = row.kind};
  try {
    set_place(devices, row, text.place, fault);
  } catch (const NameError& error) {
    throw FaultPlaceError(error.what());
  }
  set_all_fields(devices, row, text, fault);
  return fault;
}

void require_fault_fields(const KnownDevices& devices, const FaultText& text) {
  const FaultKindRow& row = row_of(text.kind);
  Fault fault{.kind = row.kind};
  set_all_fields(devices, row, text, fault);
}

FaultText fault_text(const KnownDevices& devices, const Fault& fault) {
  const FaultKindRow& row = fault_kind(fault.kind);
  const KnownDevice& device = devices[fault.device];
  const auto place = static_cast<std::size_t>(fault.place);
  FaultText text{.kind = std::string(row.name),
                 .place = fault.on_line ? device.lines[place] : device.name,
                 .fields = {}};
  const bool is_of_input = row.place == At::input || fault.of_input;
  if (!is_of_input && (row.place == At::axis || row.place == At::wheel)) {
    text.place += "." + std::string(device.model->axes[place].name);
  }
  if (is_of_input) text.place += "." + std::string(device.model->terminals[place].name);
  for (const FaultFieldRow& field : row.fields) {
    const std::string value = text_of(field, fault);
    if (!value.empty()) text.fields.emplace_back(field.name, value);
  }
  const auto of_trigger = fields_of(fault.trigger);
  text.fields.insert(text.fields.end(), of_trigger.begin(), of_trigger.end());
  return text;
}

std::string to_text(const KnownDevices& devices, const Fault& fault) {
  const FaultText parts = fault_text(devices, fault);
  std::string text = parts.kind + " " + parts.place;
  for (const auto& [name, value] : parts.fields) {
    text += " " + name + "=" + (name == "when" ? "\"" + one_line(value) + "\"" : value);
  }
  return text;
}

}  // namespace understudy::emulator::world
