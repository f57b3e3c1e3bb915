// What the state of a Simple2-R3 consists of, for state.cpp: all fields, in order, and the demands on a
// restored state, so that its ticks can neither leave a table nor run away.
#pragma once

#include "base/state/state_bytes.h"
#include "emulator/models/simple2_r3/device.h"

namespace understudy::emulator::models::simple2_r3 {

struct StateFields {
  // clang-format off
  static void of(Like<Timer> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<interpreter::simple2::LoopState> auto& v, auto visit) {
    auto& [a, b, c, d] = v; visit(a, b, c, d);
  }
  static void of(Like<interpreter::simple2::Execution> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = v; visit(a, b, c, d, e, f, g, h, i, j, k);
  }
  static void of(Like<interpreter::simple2::Line> auto& v, auto visit) {
    auto& [a, b, c, d] = v; visit(a, b, c, d);
  }
  static void of(Like<interpreter::simple2::FlagRules> auto& v, auto visit) {
    auto& [a, b, c] = v; visit(a, b, c);
  }
  static void of(Like<AxisState> auto& v, auto visit) {
    // As they lie in memory, and as the bytes have them.
    auto& [motor, mode, command, homed, own_speed, by_trigger, cut_short, alarm_latched, pwm_percent,
           coordinate, velocity_step, pulses, alarm_clear_until, encoder_raw, encoder_counts, encoder_changed,
           signals, target, speed, velocity_phase, velocity_resolution, encoder_preset, encoder_followed,
           encoder_history] = v;
    visit(motor, signals, mode, command, homed, own_speed, by_trigger, cut_short, alarm_latched, coordinate,
          pulses, alarm_clear_until, target, speed, velocity_resolution, velocity_step, velocity_phase,
          pwm_percent, encoder_raw, encoder_counts, encoder_preset, encoder_followed, encoder_history,
          encoder_changed);
  }
  static void of(Like<ProgramSpeed> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<MoveParameters> auto& v, auto visit) {
    auto& [a, b, c, d, e, f] = v; visit(a, b, c, d, e, f);
  }
  static void of(Like<KeptCommand> auto& v, auto visit) { auto& [a, b, c, d] = v; visit(a, b, c, d); }
  static void of(Like<State> auto& v, auto visit) {
    // As they lie in memory, and as the bytes have them.
    auto& [touched, unlocked, switches, written_outputs, inputs, assignments, adc, password, first_tick,
           execution, eeprom, axes, image, program, timers, program_speeds, kept] = v;
    visit(image, axes, program, execution, timers, eeprom, first_tick, switches, unlocked, password, adc,
          inputs, written_outputs, assignments, program_speeds, kept, touched);
  }
  // clang-format on

  static constexpr Mode last(Mode) { return Mode::sync; }
  static constexpr Command last(Command) { return Command::homing; }
  static constexpr Eeprom::Slot last(Eeprom::Slot) { return Eeprom::Slot::waits; }
  static constexpr interpreter::simple2::Ending last(interpreter::simple2::Ending) {
    return interpreter::simple2::Ending::wait_cut_short;
  }
  static constexpr interpreter::simple2::Phase last(interpreter::simple2::Phase) {
    return interpreter::simple2::Phase::move;
  }
  using FlagRules = interpreter::simple2::FlagRules;
  static constexpr FlagRules::Several last(FlagRules::Several) { return FlagRules::Several::last_written; }
  static constexpr FlagRules::AfterEnd last(FlagRules::AfterEnd) { return FlagRules::AfterEnd::do_not_count; }
  static constexpr FlagRules::Found last(FlagRules::Found) { return FlagRules::Found::when_told; }

  // Of other rooms.
  static void write(const motion::Axis& motor, StateWriter& writer);
  static void read(motion::Axis& motor, StateReader& reader);
  static void write(const motion::Surroundings& signals, StateWriter& writer);
  static void read(motion::Surroundings& signals, StateReader& reader);
  static void write(const interpreter::simple2::Program& program, StateWriter& writer);
  static void read(interpreter::simple2::Program& program, StateReader& reader);

  static void check(const Timer& timer) { demand_reach(timer.since); }
  static void check(const interpreter::simple2::Execution& execution);
  static void check(const AxisState& axis);
  static void check(const KeptCommand& kept);
  static void check(const State& state);
  static void check(const auto&) {}  // of the memory see Eeprom::check_restored()
};

}  // namespace understudy::emulator::models::simple2_r3
