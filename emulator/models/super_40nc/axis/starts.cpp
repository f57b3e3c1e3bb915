#include "emulator/models/super_40nc/axis/starts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/marks.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/error.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/move.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The chip's command to start with a ramp (PRCMD).
constexpr int kStartWithRamp = 0x53;

std::int32_t in_32_bits(double number) {
  return static_cast<std::int32_t>(std::llround(std::clamp(number, -2147483648.0, 2147483647.0)));
}

}  // namespace

Grant Starts::ask(int axis_number, Request request) {
  const Grant given = granted(axis(axis_number).holder, request);
  if (given == Grant::refused) ground_.report(Code::axis_taken, Mover::plc);
  return given;
}

motion::Cause Starts::blocked_both_ways(int axis) const {
  if (!chose(option("limits_blocking", "both_ways_blocked"))) return motion::Cause::none;
  if (has_signal(axis, motion::Signal::limit_plus)) return motion::Cause::limit_plus;
  return has_signal(axis, motion::Signal::limit_minus) ? motion::Cause::limit_minus : motion::Cause::none;
}

void Starts::prepare(int axis_number, bool homes) {
  const Settings parameters = registers();
  AxisState& state = axis(axis_number);
  motion::AxisSettings settings = parameters_.motor_settings(axis_number, homes);
  constexpr Value kSlip = 2;
  const Value correction = parameters.of(stored_x(d9x::kCorrectMode), axis_number);
  settings.backlash_pulses = correction != 0 ? parameters.of(stored_x(d9x::kBacklash), axis_number) : 0;
  settings.slips = correction == kSlip;
  const bool is_first = chip(axis_number).last_direction == 0;
  if (is_first && chose(option("backlash_first_move", "as_behind_a_positive_one"))) {
    chip(axis_number).last_direction = +1;
  }
  settings.waits_for_in_position = chose(option("inp_wait", "single_axes_wait"));
  const auto creep_rpm = static_cast<double>(parameters.of(stored_x(d9x::kCreepSpeed), axis_number));
  settings.backlash_speed_pps =
      std::min(parameters.pps(axis_number, creep_rpm), parameters.top_pps(axis_number));
  chip(axis_number).set(settings);
  state.masked = parameters.is_on(stored_x(d9x::kPulseMask), axis_number);
  // Signals that have changed in this tick count. The DOG's edge is left for the latch.
  motion::Axis& motor = chip(axis_number);
  const motion::Signals mark = motion::bit(motion::Signal::mark);
  const motion::Signals seen = environment(axis_number).at(motor.travel_pulses, motor.signals);
  motor.signals = static_cast<motion::Signals>((seen & ~mark) | (motor.signals & mark));
  // A host may have written the high half alone, as the wrong example in the manual does, so the low half
  // counts.
  const bool is_whole = chose(option("motor_direction", "whole_value"));
  const std::int32_t direction =
      parameters.raw(stored_x(d9x::kPulseMode), axis_number) & (is_whole ? -1 : 0xFFFF);
  const bool inverted = direction == 3 || direction == 6;
  if (inverted != chip(axis_number).inverted) {
    chip(axis_number).inverted = inverted;
    inputs_.update_environment(axis_number);
  }
}

void Starts::begun(int axis_number, motion::Cause why_not, Activity holder) {
  AxisState& state = axis(axis_number);
  const bool looks_for_switch = holder == Activity::home || state.rest.kind == RestKind::mark;  // MRK
  if (why_not == motion::Cause::none && !looks_for_switch) {
    why_not = blocked_both_ways(axis_number);
    if (why_not != motion::Cause::none) {
      chip(axis_number).stop(why_not);
      forget_end(axis_number);
    }
  }
  if (why_not != motion::Cause::none) {
    fail(axis_number, code_of(why_not));
    return;
  }
  // For a program, only starting the program clears the error.
  if (state.mover >= Mover::plc) ground_.error_is_over();
  take_off(state, MarkEvent::motion_begins);
  state.holder = holder;
  Tick& erc = axes_.erc_until[static_cast<std::size_t>(axis_number)];
  if (erc == kNever) erc = 0;  // a level until the next start
}

void Starts::fail(int axis_number, Code code) {
  axis(axis_number).has_error = true;
  pins_.give_erc_behind(axis_number, code);
  ground_.report(code, axis(axis_number).mover);
}

void Starts::let_go(int axis_number) {
  AxisState& state = axis(axis_number);
  const bool looked_for_mark = state.rest.kind == RestKind::mark || state.rest.limits_count;
  take_off(state, MarkEvent::motion_ends);
  if (looked_for_mark) inputs_.update_environment(axis_number);
}

void Starts::mirror_start(int axis_number, int mode, std::int64_t distance_pulses,
                          const motion::SpeedLaw& law) {
  const Settings settings = registers();
  AxisState& state = axis(axis_number);
  const double top = std::max(law.top_speed_u_s, 1.0);
  const double step = settings.multiplier(axis_number, top);
  state.step_pps = step;
  if (chose(option("chip_mirror", "plain_registers"))) return;
  const auto rate = [&](const motion::RampLaw& ramp) {
    constexpr double kClock = 19'660'800;
    if (!(ramp.acceleration_u_s2 > 0)) return 0;
    return in_32_bits(std::clamp(std::round(step * kClock / (4 * ramp.acceleration_u_s2)) - 1, 1.0, 65535.0));
  };
  const double creep_pps =
      settings.pps(axis_number, static_cast<double>(settings.of(stored_x(d9x::kCreepSpeed), axis_number)));
  struct Shown {
    int offset;  // relative to PRCMD
    std::int32_t value;
  };
  const Shown shown[] = {{0, kStartWithRamp},
                         {1, static_cast<std::int32_t>(distance_pulses)},
                         {2, in_32_bits(law.start_speed_u_s / step)},
                         {3, in_32_bits(law.top_speed_u_s / step)},
                         {4, rate(law.up)},
                         {5, rate(law.down)},
                         {6, in_32_bits(300 / step) - 1},
                         {7, 0},
                         {8, mode},
                         {9, 0},
                         {10, settings.raw(stored_x(d9x::kSAcceleration), axis_number)},
                         {11, settings.raw(stored_x(d9x::kSDeceleration), axis_number)}};
  static constexpr StoredRegister kFirst = stored_d(d8x::kPrcmd);
  static constexpr StoredRegister kFirstWorking = stored_d(d8x::kRmv);  // RMV comes first
  const auto show = [&](StoredRegister first, int offset, std::int32_t value) {
    const auto slot = first.slot + static_cast<std::size_t>(offset * kAxisCount + axis_number);
    ground_.state().image[slot] = static_cast<std::uint32_t>(value);
  };
  for (const Shown& each : shown) {
    show(kFirst, each.offset, each.value);
    if (each.offset > 0) show(kFirstWorking, each.offset - 1, each.value);
  }
  show(stored_d(d8x::kRfa), 0, in_32_bits(creep_pps / step));
  show(stored_d(d8x::kPrci), 0, 0);
  show(stored_d(d8x::kRcmp5), 0, settings.raw(stored_d(d8x::kPrcmp5), axis_number));
  show(stored_d(d8x::kRci), 0, 0);
}

}  // namespace understudy::emulator::models::super_40nc
