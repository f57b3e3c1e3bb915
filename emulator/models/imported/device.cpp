#include "emulator/models/imported/device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/machine_ahead.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/models/imported/follower.h"
#include "emulator/models/imported/model.h"
#include "emulator/models/imported/shown.h"
#include "motion/bad_motion.h"
#include "motion/surroundings.h"

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
  const auto is_kept = std::make_unique<bool[]>(kept.size());
  std::copy(kept.begin(), kept.end(), is_kept.get());
  const std::span<const bool> slots(is_kept.get(), kept.size());
  return Eeprom(factory, slots, slots);
}

}  // namespace

ImportedDevice::ImportedDevice(const ImportedModel& model, const DeviceSettings& settings)
    : DeviceOf(model.model(), settings),
      RegisterBankOf(*this, *model.model().registers, settings.firmware),
      KeptMemory(model.model().name, settings.firmware),
      model_(model),
      edges_(model.description().axes.size()),
      is_restored_(edges_.size()) {
  for (std::size_t i = 0; i < its().terminals.size(); ++i) {
    const Terminal& terminal = its().terminals[i];
    if (terminal.is_input && terminal.spot) set_input(static_cast<int>(i), level_at_rest(*terminal.spot));
  }
  state_.eeprom = factory_memory(map());
  state_ = state_at_power_up();
  for (const Following& following : its().followings) {
    const double period_s = static_cast<double>(following.every) / motion::kTicksPerSecond;
    shares_.push_back(share_of_way(period_s, following.time_constant_s));
  }
}

const Description& ImportedDevice::its() const { return model_.description(); }

/// What shows an input begins with the register's default, and so has the input to.
std::int32_t ImportedDevice::level_at_rest(const Spot& spot) const {
  const Value whole = its().registers[spot.number].factory;
  if (!spot.is_whole()) return static_cast<std::int32_t>((whole >> spot.bit) & 1);
  return static_cast<std::int32_t>(std::clamp<Value>(whole, INT32_MIN, INT32_MAX));
}

// --- what registers show ------------------------------------------------------------

namespace {

/// As its type has it: cut to what it can hold.
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

Value ImportedDevice::value_of_view(std::size_t number, View view, Type type) const {
  const AxisState& axis = state_.axes[number];
  const AxisBinding& binding = its().axes[number];
  const auto input_is_on = [&](int terminal) { return terminal >= 0 && input(terminal) != 0; };
  switch (view) {
    case View::position: {
      const std::int64_t counts = position_counts(axis, binding);
      if (type == Type::f32) return value_of_real(static_cast<float>(counts));
      return value_of(static_cast<std::uint32_t>(counts), type);  // a counter that is full begins anew
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

Value ImportedDevice::value_of_part(const ShownPart& part, Type type) const {
  switch (part.what) {
    case ShownPart::What::axis: return value_of_view(part.number, part.view, type);
    case ShownPart::What::input: return value_for(input(static_cast<int>(part.number)), type);
    case ShownPart::What::following: return value_for(state_.followed[part.number], type);
    case ShownPart::What::comparison: return holds(its().comparisons[part.number]) ? 1 : 0;
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
  if (spot.is_whole()) return whole;
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
  const double counts =
      model_.type_of(number) == Type::f32 ? double{real_of(value)} : static_cast<double>(value);
  if (!std::isfinite(counts)) return;
  set_position(state_.axes[part.number], its().axes[part.number],
               static_cast<Value>(std::round(std::clamp(counts, -4e18, 4e18))));
}

// --- what hosts write ------------------------------------------------------------

void ImportedDevice::register_written(const RegisterRow& row, std::size_t slot) {
  written_.push_back(slot);
  if (keeps(row)) state_.eeprom.write(slot, state_.image[slot], 0, now());
}

void ImportedDevice::registers_written() {
  state_.touched = true;
  look_at_commands();
  written_.clear();
}

/// A bit is given when it comes on, a register each time that it is written.
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
    Device::mention_unmodelled(its().axes[axis].name, error.what());
  }
}

void ImportedDevice::look_at_commands() {
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    const AxisBinding& binding = its().axes[i];
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
      if (!given || is_stopped) continue;  // a stop in the same request wins
      attempt(i, [&] { obey(axis, binding, command, numbers, now()); });
      is_stopped = command == Command::stop || command == Command::stop_at_once;
    }
  }
  steer_axes(now());
  for (const std::size_t number : its().momentary) {
    const auto slot = static_cast<std::size_t>(model_.slot_of(number));
    if (std::find(written_.begin(), written_.end(), slot) == written_.end()) continue;
    state_.image[slot] = 0;
    for (std::size_t i = 0; i < state_.held.size(); ++i) {
      const auto& condition = its().axes[i / kCommands].commands[i % kCommands];
      if (condition && condition->spot.number == number) state_.held[i] = holds_now(*condition) ? 1 : 0;
    }
  }
}

void ImportedDevice::steer_axes(Tick done) {
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    const AxisBinding& binding = its().axes[i];
    const auto holds = [&](Command command) {
      const auto& condition = binding.command(command);
      return condition && holds_now(*condition) ? 1 : 0;
    };
    if (const auto& condition = binding.command(Command::enable))
      enable(state_.axes[i], binding, holds_now(*condition));
    const int way = holds(Command::forward) - holds(Command::backward);
    attempt(i, [&] { steer(state_.axes[i], way, AxisNumbers(binding, counts_of_), done); });
  }
}

namespace {

/// What a request writes to a 16-bit register or a coil; nothing if it does not.
std::optional<std::uint16_t> written_word(const RegisterRequest& request, const ListedRegister& listed) {
  if (request.table != listed.table || listed.address < request.first) return std::nullopt;
  const std::size_t index = static_cast<std::size_t>(listed.address - request.first);
  if (index >= request.words.size()) return std::nullopt;
  return request.words[index];
}

}  // namespace

DeviceAnswer ImportedDevice::admits(const RegisterRequest& request, Checked checked) const {
  if (!request.is_write() || checked != Checked::everything) return Refusal::none;
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    const AxisBinding& binding = its().axes[i];
    const auto held_after = [&](const Condition& condition) {
      const ListedRegister& listed = its().registers[condition.spot.number];
      const auto word = written_word(request, listed);
      if (!word) return holds_now(condition);
      const Value whole = value_of(*word, listed.type);
      if (condition.spot.is_whole()) return condition.matches(whole);
      return condition.matches((static_cast<std::uint32_t>(whole) & mask_of(condition.spot)) >>
                               condition.spot.bit);
    };
    for (const Command command : {Command::home, Command::start, Command::start_relative}) {
      const auto& condition = binding.command(command);
      if (!condition || !written_word(request, its().registers[condition->spot.number])) continue;
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
  if (address == station_number()) return Addressing::obey_and_reply;
  return address == 0 && its().line.obeys_broadcasts ? Addressing::obey_silently : Addressing::ignore;
}

pty::SimTime ImportedDevice::end_silence(pty::SimTime usual) const {
  return its().line.silence ? usual : standard_silence(line_settings(0));
}

// --- time ------------------------------------------------------------

void ImportedDevice::look_round(std::size_t number) {
  using motion::Signal;
  const AxisBinding& binding = its().axes[number];
  const std::array<std::pair<int, Signal>, 4> wired{{{binding.upper_limit_input, Signal::limit_plus},
                                                     {binding.lower_limit_input, Signal::limit_minus},
                                                     {binding.home_input, Signal::home},
                                                     {binding.alarm_input, Signal::alarm}}};
  motion::Surroundings now;
  for (const auto& [terminal, signal] : wired) {
    if (terminal < 0) continue;
    if (const MachineEdges::Span* const span = edges_[number].span_of(terminal)) {
      (span->level_inside ? now.add(signal, span->first, span->last, span->slack)
                          : now.add_outside(signal, span->first, span->last, span->slack));
    } else {
      now.set_steady(signal, input(terminal) != 0);
    }
  }
  motion::Surroundings& here = state_.axes[number].here;
  now.version = here.version;
  if (now == here) return;
  ++now.version;
  here = now;
}

void ImportedDevice::set_edges(int axis, const MachineEdges& edges) {
  const auto number = static_cast<std::size_t>(axis);
  edges_[number] = edges;
  // A restored state has seen these already, and not yet what has come to its inputs since the last tick.
  if (is_restored_[number] == 0) look_round(number);
  is_restored_[number] = 0;
}

void ImportedDevice::sample_inputs(Tick) {
  if (!take_inputs_changed()) return;
  for (std::size_t i = 0; i < state_.axes.size(); ++i) look_round(i);
  state_.touched = true;
}

void ImportedDevice::finish_step(std::size_t number, std::int64_t pulses) {
  AxisState& axis = state_.axes[number];
  axis.sent_pulses = pulses;
  if (note_events(axis, its().axes[number])) state_.touched = true;
}

void ImportedDevice::step_motion(Tick tick) {
  if (state_.touched) {
    state_.touched = false;
    steer_axes(tick - 1);
  }
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    AxisState& axis = state_.axes[i];
    finish_step(i, axis.motor.step(tick, axis.here));
  }
}

double ImportedDevice::goal_of(const Following& following) const {
  const bool goes = !following.as_long_as || holds_now(*following.as_long_as);
  return counts_of(goes ? following.of : following.rest);
}

void ImportedDevice::renew_followed(Tick tick) {
  for (std::size_t i = 0; i < state_.followed.size(); ++i) {
    const Following& following = its().followings[i];
    if (tick % following.every != 0) continue;
    const double most = following.most_per_s * static_cast<double>(following.every) / motion::kTicksPerSecond;
    const double before = state_.followed[i];
    state_.followed[i] = come_nearer(before, goal_of(following), shares_[i], most);
    if (state_.followed[i] != before && !state_.axes.empty()) state_.touched = true;  // it may be a speed
  }
}

void ImportedDevice::update_outputs(Tick tick) {
  renew_followed(tick);
  state_.eeprom.step(tick, state_.image);
}

bool ImportedDevice::is_quiet(const AxisState& axis) const {
  const motion::Axis& motor = axis.motor;
  return !motor.moving() && !motor.attentive && motor.events == 0 && motor.events_between == 0 &&
         axis.sent_pulses == 0 && axis.here.version == motor.seen_version;
}

/// Without what moves: when a value is renewed next that is not where it goes, or may not stay there.
Tick ImportedDevice::next_tick_of_values(Tick done) const {
  const bool any_moves = !std::all_of(state_.axes.begin(), state_.axes.end(),
                                      [](const AxisState& axis) { return !axis.motor.moving(); });
  Tick next = state_.eeprom.next_active_tick();
  for (std::size_t i = 0; i < state_.followed.size(); ++i) {
    const Following& following = its().followings[i];
    if (!any_moves && state_.followed[i] == goal_of(following)) continue;
    next = std::min(next, done + following.every - done % following.every);
  }
  return next;
}

Tick ImportedDevice::next_active_tick(Tick done) const {
  if (state_.touched || inputs_changed()) return done + 1;
  const bool all_rest = std::all_of(state_.axes.begin(), state_.axes.end(),
                                    [&](const AxisState& axis) { return is_quiet(axis); });
  return all_rest ? next_tick_of_values(done) : done + 1;
}

Tick ImportedDevice::next_event_tick(Tick done, Tick most, const MachineAhead& ahead) const {
  if (state_.touched || inputs_changed()) return done + 1;
  Tick last = std::min(most, next_tick_of_values(done) - 1);
  for (std::size_t i = 0; i < state_.axes.size() && last > done; ++i) {
    const motion::Axis& motor = state_.axes[i].motor;
    const PulseRoom room = ahead.room(static_cast<int>(i));
    last =
        motor.quiet_until(done + 1, last, state_.axes[i].here,
                          {.low = motor.travel_pulses + room.least, .high = motor.travel_pulses + room.most});
  }
  return last + 1;
}

void ImportedDevice::cross_to(Tick, Tick tick, const MachineAhead& ahead, std::span<std::int64_t> pulses) {
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    AxisState& axis = state_.axes[i];
    pulses[i] += axis.motor.cross_to(tick - 1);
    finish_step(i, axis.motor.step(tick, axis.here));
    pulses[i] += axis.sent_pulses;
    const int number = static_cast<int>(i);
    if (ahead.has_encoder(number)) axis.encoder_counts = ahead.encoder_counts(number, pulses[i]);
  }
}

bool ImportedDevice::output(int terminal) const {
  const auto& spot = its().terminals[static_cast<std::size_t>(terminal)].spot;
  return powered() && spot && value_at(*spot) != 0;
}

}  // namespace understudy::emulator::models::imported
