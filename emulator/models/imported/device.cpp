#include "emulator/models/imported/device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/imported/axis_drive.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/follower.h"
#include "emulator/models/imported/model.h"
#include "emulator/models/imported/shown.h"
#include "motion/bad_motion.h"
#include "motion/tick.h"

namespace understudy::emulator::models::imported {

namespace {

Eeprom factory_memory(const RegisterMap& map) {
  std::vector<std::uint32_t> factory;
  std::vector<std::uint8_t> kept;
  for (const RegisterRow& row : map.rows()) {
    if (row.is_view) continue;
    factory.push_back(static_cast<std::uint32_t>(row.factory));
    kept.push_back(row.persistent ? 1 : 0);
  }
  const auto is_persistent = std::make_unique<bool[]>(kept.size());
  std::copy(kept.begin(), kept.end(), is_persistent.get());
  const std::span<const bool> slots(is_persistent.get(), kept.size());
  return Eeprom(factory, slots, slots);
}

}  // namespace

ImportedDevice::ImportedDevice(const ImportedModel& model, const DeviceSettings& settings)
    : StatefulDevice(model.model(), settings),
      RegisterBankOf(*this, *model.model().registers, settings.firmware),
      PersistentMemory(model.model().name, settings.firmware),
      model_(model),
      edges_(model.description().axes.size()),
      is_restored_(edges_.size()) {
  for (std::size_t i = 0; i < description().terminals.size(); ++i) {
    const Terminal& terminal = description().terminals[i];
    if (terminal.is_input && terminal.spot) set_input(static_cast<int>(i), level_at_rest(*terminal.spot));
  }
  state_.eeprom = factory_memory(map());
  state_ = state_at_power_up();
  for (const Following& following : description().followings) {
    const double period_s = static_cast<double>(following.every) / motion::kTicksPerSecond;
    shares_.push_back(lag_fraction(period_s, following.time_constant_s));
  }
}

const Description& ImportedDevice::description() const { return model_.description(); }

/// A spot that shows an input initially contains the register's default, so the input has the same initial
/// level.
std::int32_t ImportedDevice::level_at_rest(const Spot& spot) const {
  const ListedRegister& listed = description().registers[spot.number];
  if (!spot.is_whole()) return static_cast<std::int32_t>((listed.factory >> spot.bit) & 1);
  return static_cast<std::int32_t>(
      std::clamp<Value>(meaning_of(listed, listed.factory), INT32_MIN, INT32_MAX));
}

// --- what registers show ------------------------------------------------------------

namespace {

/// Converts a number to the type, and limits it to the type's range.
Value value_for(double number, Type type) {
  if (type == Type::f32) return value_of_real(static_cast<float>(number));
  const TypeLimits limits = limits_of(type);
  return static_cast<Value>(std::round(
      std::clamp(number, static_cast<double>(limits.lowest), static_cast<double>(limits.highest))));
}

std::uint32_t mask_of(const Spot& spot) {
  return (spot.width >= 32 ? ~0U : (1U << spot.width) - 1U) << std::max(spot.bit, 0);
}

}  // namespace

Value ImportedDevice::value_of_view(std::size_t axis_number, View view, Type type) const {
  const AxisState& axis = state_.axes[axis_number];
  const AxisBinding& binding = description().axes[axis_number];
  const auto input_is_on = [&](int terminal) { return terminal >= 0 && input(terminal) != 0; };
  switch (view) {
    case View::position: {
      const std::int64_t counts = position_counts(axis, binding);
      if (type == Type::f32) return value_of_real(static_cast<float>(counts));
      return value_of(static_cast<std::uint32_t>(counts), type);  // a counter wraps on overflow
    }
    case View::actual_speed: {
      const double counts = imported::speed_pps(axis, now()) / binding.pps_per_count;
      return value_for(is_signed(type) ? counts : std::abs(counts), type);
    }
    case View::encoder:
      if (type == Type::f32) return value_of_real(static_cast<float>(axis.encoder_counts));
      return value_of(static_cast<std::uint32_t>(axis.encoder_counts), type);
    case View::busy: return axis.motor.moving() ? 1 : 0;
    case View::ready:
      return powered() && !axis.motor.moving() && axis.motor.servo_on && !input_is_on(binding.alarm_input)
                 ? 1
                 : 0;
    case View::arrived: return axis.arrived ? 1 : 0;
    case View::homed: return axis.homed ? 1 : 0;
    case View::enabled: return axis.motor.servo_on ? 1 : 0;
    case View::alarm: return input_is_on(binding.alarm_input) ? 1 : 0;
    case View::at_upper_limit: return input_is_on(binding.upper_limit_input) ? 1 : 0;
    case View::at_lower_limit: return input_is_on(binding.lower_limit_input) ? 1 : 0;
  }
  return 0;
}

std::optional<bool> ImportedDevice::servo_on(int axis) const {
  const auto number = static_cast<std::size_t>(axis);
  if (!description().axes[number].command(Command::enable)) return std::nullopt;
  return powered() && state_.axes[number].motor.servo_on;
}

Value ImportedDevice::value_of_part(const ShownPart& part, Type type) const {
  const bool is_bcd = part.spot.is_whole() && description().registers[part.spot.number].is_bcd;
  const auto shown = [&](Value value) { return is_bcd ? coded(value, type) : value; };
  switch (part.what) {
    case ShownPart::What::axis: return shown(value_of_view(part.number, part.view, type));
    case ShownPart::What::input: return shown(value_for(input(static_cast<int>(part.number)), type));
    case ShownPart::What::following: return shown(value_for(state_.followed[part.number], type));
    case ShownPart::What::comparison: return holds(description().comparisons[part.number]) ? 1 : 0;
  }
  return 0;
}

Value ImportedDevice::value_of_register(std::size_t number) const {
  const Type type = model_.type_of(number);
  const int slot = model_.slot_of(number);
  const auto parts = model_.shown(number);
  if (slot == Place::kNoSlot) return value_of_part(parts.front(), type);
  std::uint32_t bits = state_.image[static_cast<std::size_t>(slot)];
  for (const ShownPart& part : parts) {
    const std::uint32_t mask = mask_of(part.spot);
    bits = (bits & ~mask) | (static_cast<std::uint32_t>(value_of_part(part, type) << part.spot.bit) & mask);
  }
  return value_of(bits, type);
}

Value ImportedDevice::value_at(const Spot& spot) const {
  const Value whole = value_of_register(spot.number);
  if (spot.is_whole()) return meaning_of(description().registers[spot.number], whole);
  return (static_cast<std::uint32_t>(whole) & mask_of(spot)) >> spot.bit;
}

double ImportedDevice::counts_of(const Quantity& quantity) const {
  if (!quantity.spot) return quantity.number;
  const Value value = value_at(*quantity.spot);
  if (!quantity.spot->is_whole() || model_.type_of(quantity.spot->number) != Type::f32)
    return static_cast<double>(value);
  const double real{real_of(value)};
  return std::isfinite(real) ? real : 0;
}

bool ImportedDevice::holds(const Comparison& comparison) const {
  const double left = counts_of(comparison.left);
  const double right = counts_of(comparison.right);
  switch (comparison.relation) {
    case Comparison::Relation::less: return left < right;
    case Comparison::Relation::at_most: return left <= right;
    case Comparison::Relation::equal: return left == right;
    case Comparison::Relation::unequal: return left != right;
    case Comparison::Relation::at_least: return left >= right;
    case Comparison::Relation::greater: return left > right;
  }
  return false;
}

Value read_shown(const ImportedDevice& device, Cell cell) {
  return device.value_of_register(static_cast<std::size_t>(cell.argument));
}

void write_shown(ImportedDevice& device, Cell cell, Value value) {
  device.write_view(static_cast<std::size_t>(cell.argument), value);
}

void ImportedDevice::write_view(std::size_t number, Value value) {
  const ShownPart& part = model_.shown(number).front();
  if (part.what != ShownPart::What::axis || part.view != View::position) return;
  const double counts = model_.type_of(number) == Type::f32
                            ? double{real_of(value)}
                            : static_cast<double>(meaning_of(description().registers[number], value));
  if (!std::isfinite(counts)) return;
  set_position(state_.axes[part.number], description().axes[part.number],
               static_cast<Value>(std::round(std::clamp(counts, -4e18, 4e18))));
}

// --- what hosts write ------------------------------------------------------------

void ImportedDevice::register_written(const RegisterRow& row, std::size_t slot) {
  written_.push_back(slot);
  if (keeps(row)) state_.eeprom.write(slot, state_.image[slot], 0, now());
}

void ImportedDevice::registers_written() {
  state_.touched = true;
  check_commands();
  written_.clear();
}

/// A command on a bit is given when the bit changes to 1. A command on a register is given by each write.
bool ImportedDevice::is_given(const Condition& condition, bool was_held) const {
  const auto slot = static_cast<std::size_t>(model_.slot_of(condition.spot.number));
  if (std::find(written_.begin(), written_.end(), slot) == written_.end()) return false;
  return holds_now(condition) && (condition.spot.is_whole() || !was_held);
}

template <typename Act>
void ImportedDevice::attempt(std::size_t axis, Act act) {
  try {
    act();
  } catch (const motion::BadMotion& error) {
    Device::warn_not_implemented(description().axes[axis].name, error.what());
  }
}

void ImportedDevice::check_commands() {
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    const AxisBinding& binding = description().axes[i];
    AxisState& axis = state_.axes[i];
    const AxisNumbers numbers(binding, counts_of_);
    bool is_stopped = false;
    for (std::size_t c = 0; c < kCommands; ++c) {
      const auto command = static_cast<Command>(c);
      const auto& condition = binding.commands[c];
      if (!condition) continue;
      std::uint8_t& was_held = state_.held[i * kCommands + c];
      const bool given = !is_level(command) && is_given(*condition, was_held != 0);
      was_held = holds_now(*condition) ? 1 : 0;
      if (command == Command::enable) enable(axis, binding, was_held != 0);
      if (!given || is_stopped) continue;  // a stop in the same request takes precedence
      attempt(i, [&] { execute(axis, binding, command, numbers, now()); });
      is_stopped = command == Command::stop || command == Command::stop_at_once;
    }
  }
  steer_axes(now());
  for (const std::size_t number : description().momentary) {
    const auto slot = static_cast<std::size_t>(model_.slot_of(number));
    if (std::find(written_.begin(), written_.end(), slot) == written_.end()) continue;
    state_.image[slot] = 0;
    for (std::size_t i = 0; i < state_.held.size(); ++i) {
      const auto& condition = description().axes[i / kCommands].commands[i % kCommands];
      if (condition && condition->spot.number == number) state_.held[i] = holds_now(*condition) ? 1 : 0;
    }
  }
}

void ImportedDevice::steer_axes(Tick done) {
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    const AxisBinding& binding = description().axes[i];
    const auto holds = [&](Command command) {
      const auto& condition = binding.command(command);
      return condition && holds_now(*condition) ? 1 : 0;
    };
    if (const auto& condition = binding.command(Command::enable))
      enable(state_.axes[i], binding, holds_now(*condition));
    const int direction = holds(Command::forward) - holds(Command::backward);
    attempt(i, [&] { steer(state_.axes[i], direction, AxisNumbers(binding, counts_of_), done); });
  }
}

namespace {

/// Returns the value that a request writes to a 16-bit register or a coil, or nothing if it does not write
/// it.
std::optional<std::uint16_t> written_word(const RegisterRequest& request, const ListedRegister& listed) {
  if (request.table != listed.table || listed.address < request.first) return std::nullopt;
  const std::size_t index = static_cast<std::size_t>(listed.address - request.first);
  if (index >= request.words.size()) return std::nullopt;
  const std::uint16_t word = request.words[index];
  return listed.order.low_byte_first ? static_cast<std::uint16_t>(word >> 8 | word << 8) : word;
}

bool has_digits_only(std::uint16_t word) {
  constexpr std::uint16_t kHighest = 9;
  for (; word != 0; word = static_cast<std::uint16_t>(word >> 4)) {
    if ((word & 0xF) > kHighest) return false;
  }
  return true;
}

/// Returns true if a request writes something else than decimal digits to a word of the register.
bool writes_no_digits(const RegisterRequest& request, const ListedRegister& listed) {
  if (!listed.is_bcd || listed.access == Access::read || request.table != listed.table) return false;
  for (int word = 0; word < (is_32_bit(listed.type) ? 2 : 1); ++word) {
    const int index = listed.address + word - request.first;
    const bool is_written = index >= 0 && static_cast<std::size_t>(index) < request.words.size();
    if (is_written && !has_digits_only(request.words[static_cast<std::size_t>(index)])) return true;
  }
  return false;
}

}  // namespace

DeviceAnswer ImportedDevice::admits(const RegisterRequest& request, Checked checked) const {
  if (!request.is_write() || checked != Checked::everything) return Refusal::none;
  if (description().policy.out_of_range != MapPolicy::OutOfRange::stored) {
    for (const std::size_t number : model_.bcd_registers()) {
      if (writes_no_digits(request, description().registers[number])) return Refusal::bad_value;
    }
  }
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    const AxisBinding& binding = description().axes[i];
    const auto held_after = [&](const Condition& condition) {
      const ListedRegister& listed = description().registers[condition.spot.number];
      const auto word = written_word(request, listed);
      if (!word) return holds_now(condition);
      const Value whole = value_of(*word, listed.type);
      if (condition.spot.is_whole()) return condition.matches(meaning_of(listed, whole));
      return condition.matches((static_cast<std::uint32_t>(whole) & mask_of(condition.spot)) >>
                               condition.spot.bit);
    };
    for (const Command command : {Command::home, Command::start, Command::start_relative}) {
      const auto& condition = binding.command(command);
      if (!condition || !written_word(request, description().registers[condition->spot.number])) continue;
      const bool was_held = state_.held[i * kCommands + static_cast<std::size_t>(command)] != 0;
      if (!held_after(*condition) || (was_held && !condition->spot.is_whole())) continue;
      const auto& enabling = binding.command(Command::enable);
      if (binding.while_disabled == WhileDisabled::refuse && enabling && !held_after(*enabling))
        return Refusal::failure;
      if (binding.while_busy == WhileBusy::refuse && state_.axes[i].motor.moving()) return Refusal::busy;
    }
  }
  return Refusal::none;
}

// --- the line ------------------------------------------------------------

Addressing ImportedDevice::addressing(std::uint8_t address) const {
  if (address == station_number()) return Addressing::execute_and_reply;
  return address == 0 && description().line.obeys_broadcasts ? Addressing::execute_silently
                                                             : Addressing::ignore;
}

pty::SimTime ImportedDevice::end_silence(pty::SimTime usual) const {
  return description().line.silence ? usual : standard_silence(line_settings(0));
}

// --- terminals ------------------------------------------------------------

bool ImportedDevice::output(int terminal) const {
  const auto& spot = description().terminals[static_cast<std::size_t>(terminal)].spot;
  return powered() && spot && value_at(*spot) != 0;
}

bool ImportedDevice::output_moves(int terminal) const {
  return model_.output_moves(static_cast<std::size_t>(terminal)) && any_moves();
}

}  // namespace understudy::emulator::models::imported
