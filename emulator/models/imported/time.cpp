// Advances a described controller in time: its inputs, its axes and its following values.
#include "emulator/models/imported/device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/machine_edges.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/models/imported/axis_drive.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/follower.h"
#include "emulator/models/imported/model.h"
#include "motion/environment.h"
#include "motion/tick.h"

namespace understudy::emulator::models::imported {

void ImportedDevice::update_environment(std::size_t axis_number) {
  using motion::Signal;
  const AxisBinding& binding = description().axes[axis_number];
  const std::array<std::pair<int, Signal>, 4> wired{{{binding.upper_limit_input, Signal::limit_plus},
                                                     {binding.lower_limit_input, Signal::limit_minus},
                                                     {binding.home_input, Signal::home},
                                                     {binding.alarm_input, Signal::alarm}}};
  motion::Environment now;
  for (const auto& [terminal, signal] : wired) {
    if (terminal < 0) continue;
    if (const MachineEdges::Span* const span = edges_[axis_number].span_of(terminal)) {
      (span->level_inside ? now.add(signal, span->first, span->last, span->slack)
                          : now.add_outside(signal, span->first, span->last, span->slack));
    } else {
      now.set_steady(signal, input(terminal) != 0);
    }
  }
  motion::Environment& environment = state_.axes[axis_number].environment;
  now.version = environment.version;
  if (now == environment) return;
  ++now.version;
  environment = now;
}

void ImportedDevice::set_edges(int axis, const MachineEdges& edges) {
  const auto number = static_cast<std::size_t>(axis);
  edges_[number] = edges;
  // A restored state already includes these inputs, but not the changes since the last tick.
  if (is_restored_[number] == 0) update_environment(number);
  is_restored_[number] = 0;
}

void ImportedDevice::sample_inputs(Tick) {
  if (!take_inputs_changed()) return;
  for (std::size_t i = 0; i < state_.axes.size(); ++i) update_environment(i);
  state_.touched = true;
}

void ImportedDevice::finish_step(std::size_t axis_number, std::int64_t pulses) {
  AxisState& axis = state_.axes[axis_number];
  axis.sent_pulses = pulses;
  if (note_events(axis, description().axes[axis_number])) state_.touched = true;
}

void ImportedDevice::step_motion(Tick tick) {
  if (state_.touched) {
    state_.touched = false;
    steer_axes(tick - 1);
  }
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    AxisState& axis = state_.axes[i];
    finish_step(i, axis.motor.step(tick, axis.environment));
  }
}

double ImportedDevice::goal_of(const Following& following) const {
  const bool goes = !following.as_long_as || holds_now(*following.as_long_as);
  return counts_of(goes ? following.of : following.rest);
}

void ImportedDevice::renew_followed(Tick tick) {
  for (std::size_t i = 0; i < state_.followed.size(); ++i) {
    const Following& following = description().followings[i];
    if (tick % following.every != 0) continue;
    const double limit = following.max_per_s * static_cast<double>(following.every) / motion::kTicksPerSecond;
    const double before = state_.followed[i];
    state_.followed[i] = approach(before, goal_of(following), shares_[i], limit);
    // An axis may use this value as a speed.
    if (state_.followed[i] != before && !state_.axes.empty()) state_.touched = true;
  }
}

bool ImportedDevice::any_moves() const {
  return std::any_of(state_.axes.begin(), state_.axes.end(),
                     [](const AxisState& axis) { return axis.motor.moving(); });
}

void ImportedDevice::set_encoder(int axis, std::int64_t counts) {
  if (at(axis).encoder_counts == counts) return;
  at(axis).encoder_counts = counts;
  if (model_.numbers_move()) state_.touched = true;
}

void ImportedDevice::update_outputs(Tick tick) {
  renew_followed(tick);
  if (model_.numbers_move() && any_moves()) state_.touched = true;
  state_.eeprom.step(tick, state_.image);
}

bool ImportedDevice::is_quiet(const AxisState& axis) const {
  const motion::Axis& motor = axis.motor;
  return !motor.moving() && !motor.must_recheck && motor.events == 0 && motor.events_between == 0 &&
         axis.sent_pulses == 0 && axis.environment.version == motor.seen_version;
}

/// Returns the next tick in which a value is stored in the memory, or in which a following value that is not
/// at its goal, or may leave it, is updated. Moving axes need further ticks.
Tick ImportedDevice::next_tick_of_values(Tick done) const {
  const bool are_moving = any_moves();
  Tick next = state_.eeprom.next_active_tick();
  for (std::size_t i = 0; i < state_.followed.size(); ++i) {
    const Following& following = description().followings[i];
    if (!are_moving && state_.followed[i] == goal_of(following)) continue;
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

Tick ImportedDevice::next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const {
  if (state_.touched || inputs_changed()) return done + 1;
  Tick last = std::min(limit, next_tick_of_values(done) - 1);
  for (std::size_t i = 0; i < state_.axes.size() && last > done; ++i) {
    const motion::Axis& motor = state_.axes[i].motor;
    const PulseRoom room = ahead.room(static_cast<int>(i));
    last = motor.quiet_until(done + 1, last, state_.axes[i].environment,
                             {.low = motor.travel_pulses + room.min, .high = motor.travel_pulses + room.max});
  }
  return last + 1;
}

void ImportedDevice::fast_forward_to(Tick, Tick tick, const ClearTravel& ahead,
                                     std::span<std::int64_t> pulses) {
  for (std::size_t i = 0; i < state_.axes.size(); ++i) {
    AxisState& axis = state_.axes[i];
    pulses[i] += axis.motor.fast_forward_to(tick - 1);
    finish_step(i, axis.motor.step(tick, axis.environment));
    pulses[i] += axis.sent_pulses;
    const int number = static_cast<int>(i);
    if (ahead.has_encoder(number)) axis.encoder_counts = ahead.encoder_counts(number, pulses[i]);
  }
}

}  // namespace understudy::emulator::models::imported
