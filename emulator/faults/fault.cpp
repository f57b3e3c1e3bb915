#include "emulator/faults/fault.h"

#include <array>

#include "emulator/bench/names.h"
#include "emulator/one_line.h"
#include "emulator/world/world.h"

namespace understudy::emulator {

namespace {

struct KindRow {
  std::string_view name;
  Fault::Kind kind;
  std::string_view amount;  // its name; empty: there is none
  std::int64_t lowest = 0;
  std::int64_t highest = 0;
};

constexpr std::int64_t kFar = 1'000'000'000'000;       // pulses; farther than any counter
constexpr std::int64_t kFarthestSlip = 1'000'000'000;  // pulses; many of them in one tick still add up
constexpr std::array<KindRow, 5> kKinds{{
    {"stall", Fault::Kind::stall, ""},
    {"lost_steps", Fault::Kind::lost_steps, "one_in", 1, kFar},
    {"slip", Fault::Kind::slip, "pulses", -kFarthestSlip, kFarthestSlip},
    {"alarm", Fault::Kind::alarm, ""},
    {"stuck", Fault::Kind::stuck, "level", 0, 1},
}};

std::string range_text(const KindRow& row) {
  return std::to_string(row.lowest) + " to " + std::to_string(row.highest);
}

const KindRow& row_of(std::string_view name) {
  std::string names;
  for (const KindRow& row : kKinds) {
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw NameError(quoted(name) + " is no fault; expected one of " + names);
}

}  // namespace

Fault find_fault(const KnownDevices& devices, const FaultText& text) {
  const KindRow& row = row_of(text.kind);
  Fault fault{.kind = row.kind};
  if (row.kind == Fault::Kind::stuck) {
    const InputName input = find_input(devices, text.place);
    if (input.row(devices).kind != TerminalRow::Kind::digital_in) {
      throw NameError(quoted(text.place) + " cannot be stuck; expected a digital input");
    }
    fault.device = input.device;
    fault.place = input.terminal;
  } else {
    const AxisName axis = find_axis(devices, text.place);
    fault.device = axis.device;
    fault.place = axis.axis;
  }
  for (const auto& [name, amount] : text.amounts) {
    if (row.amount.empty() || name != row.amount) {
      throw NameError(text.kind + ": " + quoted(name) + " is nothing it has; expected " +
                      (row.amount.empty() ? "no more than the axis" : std::string(row.amount)));
    }
    if (amount < row.lowest || amount > row.highest) {
      throw NameError(text.kind + ": " + name + ": " + std::to_string(amount) +
                      " is out of range; expected " + range_text(row));
    }
    fault.amount = amount;
  }
  if (text.amounts.size() > 1)
    throw NameError(text.kind + ": " + std::string(row.amount) + " is given twice; expected it once");
  if (text.amounts.empty() && !row.amount.empty()) {
    throw NameError(text.kind + ": " + std::string(row.amount) + " is missing; expected " + range_text(row));
  }
  return fault;
}

FaultText fault_text(const KnownDevices& devices, const Fault& fault) {
  const KnownDevice& device = devices[fault.device];
  const auto place = static_cast<std::size_t>(fault.place);
  FaultText text;
  for (const KindRow& row : kKinds) {
    if (row.kind != fault.kind) continue;
    const std::string_view name = fault.kind == Fault::Kind::stuck ? device.model->terminals[place].name
                                                                   : device.model->axes[place].name;
    text.kind = row.name;
    text.place = device.name + "." + std::string(name);
    if (!row.amount.empty()) text.amounts.emplace_back(row.amount, fault.amount);
  }
  return text;
}

std::string to_text(const KnownDevices& devices, const Fault& fault) {
  const FaultText parts = fault_text(devices, fault);
  std::string text = parts.kind + " " + parts.place;
  for (const auto& [name, amount] : parts.amounts) text += " " + name + "=" + std::to_string(amount);
  return text;
}

}  // namespace understudy::emulator
