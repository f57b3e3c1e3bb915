#include "emulator/models/imported/model.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_ascii.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/device.h"
#include "emulator/models/imported/shown.h"

namespace understudy::emulator::models::imported {

namespace {

constexpr std::array<std::string_view, 1> kKnownLimitations{
    "The model comes from a file. Registers without a binding only store the values that hosts write.",
};

constexpr std::size_t kMaxStateRegisters = 12;

}  // namespace

std::vector<RegisterRow> plain_rows(std::span<const ListedRegister> registers, const MapPolicy& policy,
                                    std::vector<std::vector<BitField>>& fields) {
  std::vector<RegisterRow> rows;
  rows.reserve(registers.size());
  fields.resize(registers.size());
  for (std::size_t i = 0; i < registers.size(); ++i) {
    const ListedRegister& listed = registers[i];
    RegisterRow row = reg(listed.table, listed.address, listed.name, listed.type, listed.access);
    if (listed.ranged) row.range(listed.min, listed.max);
    row.in(listed.unit).from_factory(listed.factory);
    row.section = listed.printed;
    row.alias = listed.alias;
    row.since_firmware(listed.since);
    const bool low_first = listed.order.words == WordOrder::Words::low_first;
    const bool is_own_order = listed.order.words != WordOrder::Words::as_the_model;
    row.ordered(is_own_order && low_first != policy.low_word_first, listed.order.low_byte_first);
    if (listed.persistent) row.persists_at_once();
    for (const BitName& name : listed.bits) fields[i].push_back(bits(name.bit, name.name, name.width));
    row.with_bits(fields[i]);
    rows.push_back(row);
  }
  return rows;
}

std::vector<RegisterRow> ImportedModel::bound_rows() {
  std::vector<RegisterRow> rows = plain_rows(description_.registers, description_.policy, fields_);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RegisterRow& row = rows[i];
    row.argument = static_cast<int>(i);
    if (shown_[i].empty() || row.access == Access::write) continue;
    const bool does_move = moves(description_, shown_, {.number = i});
    row.reads<read_shown, Varies::in_ticks>(static_cast<int>(i));
    if (does_move) row.varies = Varies::while_moving;
    row.is_view = shown_[i].front().spot.is_whole();
    if (row.is_view && row.access != Access::read) row.does<write_shown>(static_cast<int>(i));
  }
  return rows;
}

ImportedModel::ImportedModel(Description description)
    : description_(std::move(description)),
      shown_(shown_parts(description_)),
      map_(bound_rows(), description_.policy),
      model_(made_model()) {
  for (const RegisterRow& row : map_.rows()) {
    slots_.push_back(
        map_.at(row.table, row.address, description_.firmwares.back(), description_.policy.low_word_first)
            .slot);
  }
  for (std::size_t i = 0; i < description_.registers.size(); ++i)
    if (description_.registers[i].is_bcd) bcd_registers_.push_back(i);
  find_what_moves();
}

void ImportedModel::find_what_moves() {
  for (const Terminal& terminal : description_.terminals) {
    moving_outputs_.push_back(!terminal.is_input && terminal.spot &&
                              moves(description_, shown_, *terminal.spot));
  }
  for (const AxisBinding& axis : description_.axes) {
    for (const std::optional<Quantity>& number : axis.numbers)
      numbers_move_ |= number && number->spot && moves(description_, shown_, *number->spot);
  }
}

/// Returns the name with which a host can write a spot: "CONTROL.STOP", "CONTROL.1". Returns nothing if there
/// is no such name.
std::optional<std::string> ImportedModel::name_of(const Spot& spot) const {
  const RegisterRow& row = map_.rows()[spot.number];
  const ListedRegister& listed = description_.registers[spot.number];
  if (row.access == Access::read || row.table == Table::input || row.table == Table::discrete) return {};
  const std::string name = map_.unique_name(row, 0);
  if (spot.is_whole()) return name;
  for (const BitName& one : listed.bits)
    if (one.bit == spot.bit && one.width == spot.width) return name + "." + one.name;
  return spot.width == 1 ? std::optional(name + "." + std::to_string(spot.bit)) : std::nullopt;
}

/// Finds the steps that stop every axis, at once if possible. Afterwards, no jog bit may remain set.
void ImportedModel::find_stops() {
  std::vector<std::pair<std::string, Value>> found;
  const auto add = [&](const Spot& spot, Value value) {
    const auto name = name_of(spot);
    const ListedRegister& listed = description_.registers[spot.number];
    if (spot.is_whole() && listed.is_bcd) value = coded(value, listed.type);
    if (name && std::ranges::find(found, std::pair(*name, value)) == found.end())
      found.emplace_back(*name, value);
  };
  for (const AxisBinding& axis : description_.axes) {
    const auto& at_once = axis.command(Command::stop_at_once);
    const auto& stop = at_once ? at_once : axis.command(Command::stop);
    if (stop) add(stop->spot, stop->value.value_or(1));
  }
  for (const AxisBinding& axis : description_.axes) {
    for (const Command which : {Command::forward, Command::backward}) {
      const auto& jog = axis.command(which);
      const bool is_bit = jog && (!jog->spot.is_whole() || type_of(jog->spot.number) == Type::bit);
      if (is_bit && jog->matches(1)) add(jog->spot, 0);
    }
  }
  for (const auto& [name, value] : found) stop_names_.push_back(name);
  for (std::size_t i = 0; i < found.size(); ++i)
    stops_.push_back({.text = stop_names_[i], .value = found[i].second});
}

Model ImportedModel::made_model() {
  const Line& line = description_.line;
  ports_ = {{.kind = PortRow::Kind::rs485,
             .name = "RS485",
             .bauds = line.bauds,
             .settings = {.data_bits = line.data_bits, .parity = line.parity, .stop_bits = line.stop_bits}}};
  pty::LineSettings factory = ports_.front().settings;
  factory.baud = line.bauds.front();
  for (const Terminal& terminal : description_.terminals) {
    const bool is_number = terminal.is_input && terminal.spot && terminal.spot->is_whole() &&
                           type_of(terminal.spot->number) != Type::bit;
    TerminalRow row{.kind = is_number           ? TerminalRow::Kind::analog_number
                            : terminal.is_input ? TerminalRow::Kind::digital_in
                                                : TerminalRow::Kind::digital_out,
                    .name = terminal.name};
    if (is_number) {
      const TypeLimits limits = limits_of(type_of(terminal.spot->number));
      row.lowest = static_cast<std::int32_t>(std::max<Value>(limits.lowest, INT32_MIN));
      row.highest = static_cast<std::int32_t>(std::min<Value>(limits.highest, INT32_MAX));
    }
    terminals_.push_back(row);
  }
  for (const AxisBinding& axis : description_.axes) {
    axes_.push_back({.name = axis.name,
                     .upper_limit_input = axis.upper_limit_input,
                     .lower_limit_input = axis.lower_limit_input,
                     .home_input = axis.home_input,
                     .alarm_input = axis.alarm_input,
                     .pulses_per_revolution = axis.pulses_per_revolution});
  }
  for (const auto& [id, text] : line.identity) identity_.push_back({.id = id, .text = text});
  // Registers that are bound to an axis or a terminal show best what the controller is doing.
  for (std::size_t i = 0; i < shown_.size() && state_names_.size() < kMaxStateRegisters; ++i) {
    const RegisterRow& row = map_.rows()[i];
    if (!shown_[i].empty() && row.access != Access::write) state_names_.push_back(map_.unique_name(row, 0));
  }
  state_registers_.assign(state_names_.begin(), state_names_.end());
  find_stops();
  return Model{.name = description_.name,
               .title = description_.title,
               .firmwares = description_.firmwares,
               .registers = &map_,
               .choices = {},
               .terminals = terminals_,
               .axes = axes_,
               .state_registers = state_registers_,
               .known_limitations = kKnownLimitations,
               .line = {.protocol = line.is_ascii ? kModbusAscii : kModbusRtu,
                        .ports = ports_,
                        .station_numbers = StationNumbers{.lowest = line.lowest_station,
                                                          .highest = line.highest_station,
                                                          .kept_in = line.station_in}},
               .rtu = RtuRules{.end_silence = line.silence.value_or(standard_silence(factory)),
                               .functions = line.functions,
                               .limits = line.limits,
                               .identity = identity_,
                               .server_id = line.server_id},
               .stop = stops_,
               .description = description_.text,
               .make = [this](const DeviceSettings& settings) -> std::unique_ptr<Device> {
                 return std::make_unique<ImportedDevice>(*this, settings);
               }};
}

}  // namespace understudy::emulator::models::imported
