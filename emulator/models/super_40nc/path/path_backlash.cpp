// Before a path, every axis that reverses or slips (D9x57 = 2) sends its X1 pulses at X22, all axes at the
// same time. The path begins when the last axis has finished. Within an arc, nothing is corrected, as on the
// chip, unless a choice requires it. (Manual, X1., X22.)
#include "emulator/models/super_40nc/path/path_backlash.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis.h"
#include "motion/path.h"
#include "motion/tick.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// Returns the backlash that a separate motion would have.
std::int64_t backlash_before(const motion::Axis& motor, int direction) {
  const std::int64_t all = motor.settings.backlash_pulses;
  if (motor.settings.slips) return all;
  if (motor.last_direction == 0) return 0;
  const std::int64_t taken = std::clamp<std::int64_t>(motor.backlash_taken_pulses, 0, all);
  return direction > 0 ? all - taken : taken;
}

/// Returns how many of `pulses` have been sent after `ticks`.
std::int64_t come_by(std::int64_t pulses, double speed_pps, Tick ticks) {
  constexpr double kRounding = 1e-9;
  const double come = speed_pps * static_cast<double>(ticks) / motion::kTicksPerSecond + kRounding;
  return come < static_cast<double>(pulses) ? static_cast<std::int64_t>(come) : pulses;
}

}  // namespace

bool PathBacklash::awaits_path() const {
  return std::any_of(axes_.axes.begin(), axes_.axes.end(),
                     [](const AxisState& state) { return state.path_backlash != 0; });
}

void PathBacklash::begin_path_backlash(const motion::Path& path) {
  constexpr double kFirstPart = 1e-3;  // an arc may begin perpendicular to the axis
  state_.path_backlash_ticks = 0;
  for (int number = 0; number < kAxisCount; ++number) {
    if (!is_on_path(number)) continue;
    const double ahead = path.at(path.length_u * kFirstPart)[number] - path.begin[number];
    if (ahead == 0) continue;
    const int direction = ahead < 0 ? -1 : +1;
    motion::Axis& motor = chip(number);
    const std::int64_t untaken = backlash_before(motor, direction);
    if (untaken == 0) continue;
    axis(number).path_backlash = untaken * direction;
    // Record how much has been sent, because the backlash may be stopped.
    motor.backlash_taken_pulses = direction > 0 ? motor.settings.backlash_pulses - untaken : untaken;
    motor.last_direction = static_cast<std::int8_t>(direction);
  }
  awaits_path() ? axes_.path.run.pause(before_motion()) : end_path_backlash();
}

/// Ends the backlash before a path. On the path, nothing is corrected.
void PathBacklash::end_path_backlash() {
  for (int number = 0; number < kAxisCount; ++number) {
    if (!is_on_path(number)) continue;
    motion::AxisSettings without = chip(number).settings;
    without.backlash_pulses = 0;
    chip(number).set(without);
  }
}

void PathBacklash::step_path_backlash(Tick tick, std::array<std::int64_t, kAxisCount>& sent) {
  if (axes_.path_is_held || !awaits_path()) return;
  const Tick ticks = ++state_.path_backlash_ticks;
  for (int number = 0; number < kAxisCount; ++number) {
    const std::int64_t all = std::abs(axis(number).path_backlash);
    if (all == 0) continue;
    motion::Axis& motor = chip(number);
    const double speed_pps = motor.settings.backlash_speed_pps;
    const std::int64_t come = come_by(all, speed_pps, ticks);
    const std::int64_t now_come =
        (come - come_by(all, speed_pps, ticks - 1)) * (axis(number).path_backlash < 0 ? -1 : +1);
    motor.backlash_sent += now_come;
    motor.backlash_taken_pulses += now_come;
    sent[static_cast<std::size_t>(number)] += motor.inverted ? -now_come : now_come;
    if (come == all) axis(number).path_backlash = 0;
  }
  if (awaits_path()) return;
  end_path_backlash();
  if (axes_.path.slowing_for == motion::Cause::none) axes_.path.run.resume(tick);
}

/// If a choice requires it, an axis that reverses on its path additionally sends X1 at X22. If it reverses
/// again before the end, it first returns the pulses sent so far.
void PathBacklash::step_arc_backlash(const std::array<std::int8_t, kAxisCount>& ways_before,
                                     std::array<std::int64_t, kAxisCount>& sent) {
  const Settings settings = registers();
  constexpr Value kBacklash = 1;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    AxisState& state = axis(number);
    motion::Axis& motor = chip(number);
    const std::int8_t direction = motor.last_direction;
    const bool turns = is_on_path(number) && ways_before[n] != 0 && direction != ways_before[n];
    if (turns && settings.of(stored_x(d9x::kCorrectMode), number) == kBacklash) {
      state.arc_backlash =
          direction * (settings.of(stored_x(d9x::kBacklash), number) - std::abs(state.arc_backlash));
      state.arc_backlash_part = 0;
    }
    if (state.arc_backlash == 0) continue;
    state.arc_backlash_part += motor.settings.backlash_speed_pps / motion::kTicksPerSecond;
    const auto come =
        std::min(static_cast<std::int64_t>(state.arc_backlash_part), std::abs(state.arc_backlash));
    state.arc_backlash_part -= static_cast<double>(come);
    const std::int64_t now_come = state.arc_backlash < 0 ? -come : come;
    state.arc_backlash -= now_come;
    if (state.arc_backlash == 0) state.arc_backlash_part = 0;
    motor.backlash_sent += now_come;
    sent[n] += motor.inverted ? -now_come : now_come;
  }
}

}  // namespace understudy::emulator::models::super_40nc
