// Simple2-R3's state as bytes, and back.
#include <memory>
#include <utility>

#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/state_fields.h"
#include "motion/bad_motion.h"
#include "motion/state.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

template <class T>
void read_motion(T& value, StateReader& reader) {
  try {
    reader.take(motion::restore(value, reader.rest()));
  } catch (const motion::BadMotion& bad) {
    throw StateError(bad.what());
  }
}

/// What a plant's encoder gives (PlantAxis::encoder_counts): the difference of two fits.
void demand_encoder_count(std::int64_t counts) {
  constexpr std::int64_t kEnd = std::int64_t{1} << 61;
  demand_within(counts, -kEnd, kEnd - 1);
}

/// Velocity mode multiplies the two.
void demand_speed(const AxisState& axis, std::uint32_t pulses_per_revolution) {
  const std::int64_t most = INT64_MAX / 4 / std::max<std::int64_t>(pulses_per_revolution, 1);
  demand_within(axis.speed_urpm, -most, most);
}

}  // namespace

void StateFields::write(const motion::Axis& motor, StateWriter& writer) {
  writer.append(motion::save(motor));
}
void StateFields::read(motion::Axis& motor, StateReader& reader) { read_motion(motor, reader); }

void StateFields::write(const motion::Surroundings& signals, StateWriter& writer) {
  writer.append(motion::save(signals));
}
void StateFields::read(motion::Surroundings& signals, StateReader& reader) { read_motion(signals, reader); }

void StateFields::write(const interpreter::simple2::Program& program, StateWriter& writer) {
  for (const auto& line : program.lines()) {
    const auto& [command, data1, data2, flag] = line;
    writer.write<StateFields>(std::array{command, data1, data2, flag});
  }
  writer.write<StateFields>(program.flag_rules());
  writer.write<StateFields>(program.flag_lines());
}

void StateFields::read(interpreter::simple2::Program& program, StateReader& reader) {
  interpreter::simple2::Lines lines;
  for (auto& line : lines) {
    std::array<std::uint8_t, 4> cells{};
    reader.read<StateFields>(cells);
    line = {.command = cells[0], .data1 = cells[1], .data2 = cells[2], .flag = cells[3]};
  }
  interpreter::simple2::FlagRules rules;
  reader.read<StateFields>(rules);
  interpreter::simple2::FlagLines flag_lines{};
  reader.read<StateFields>(flag_lines);
  for (const std::int16_t line : flag_lines) demand_within(line, -1, interpreter::simple2::kLineCount - 1);
  program = interpreter::simple2::Program(lines, rules, flag_lines);
}

void StateFields::check(const interpreter::simple2::Execution& execution) {
  demand_within(execution.delay_until_ms, 0, tick_at(kHorizon) * 2);
}

void StateFields::check(const KeptCommand& kept) {
  // A distance is the difference of two coordinates; the rest is as registers bring it.
  demand_within(kept.move.distance_pulses, -(std::int64_t{1} << 33), std::int64_t{1} << 33);
  for (const std::uint32_t word :
       {kept.move.speed_rpm, kept.move.acceleration_10ms, kept.move.deceleration_10ms}) {
    demand_within(word, 0, UINT16_MAX);
  }
  demand_within(kept.value, INT32_MIN, INT32_MAX);
}

void StateFields::check(const AxisState& axis) {
  demand_reach(axis.pulses_this_tick);
  demand_reach(axis.alarm_clear_until);
  demand_within(axis.target_urpm, INT32_MIN * std::int64_t{1000}, INT32_MAX * std::int64_t{1000});
  demand_within(axis.velocity_phase, -kVelocityPhase, kVelocityPhase);
  demand_within(axis.velocity_resolution, 1, std::int64_t{1} << 31);
  demand_encoder_count(axis.encoder_raw);
  demand_encoder_count(axis.encoder_counts);
  demand_encoder_count(axis.encoder_followed);
  demand_reach(axis.encoder_preset);
  for (const std::int64_t counts : axis.encoder_history) demand_encoder_count(counts);
  demand_reach(axis.encoder_changed);
}

void StateFields::check(const State& state) {
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    demand_speed(state.axes[i], state.image[kAxisSlots[i].resolution]);
    demand_speed(state.axes[i], state.axes[i].velocity_resolution);
  }
  demand_reach(state.first_tick);
}

void Simple2R3::write_own_state(StateWriter& writer) const { writer.write<StateFields>(state_); }

std::function<void()> Simple2R3::read_own_state(StateReader& reader) {
  const auto restored = std::make_shared<State>();
  reader.read<StateFields>(*restored);
  restored->eeprom.check_restored(state_.eeprom);
  std::size_t slot = 0;
  for (const RegisterRow& row : map().rows()) {
    for (int i = 0; i < row.count; ++i, ++slot) {
      const std::uint32_t bits = restored->image[slot] | restored->eeprom.kept()[slot];
      demand_state((bits & ~row.stored_bits) == 0, "a register holds more than it can");
    }
  }
  return [this, restored] { state_ = *restored; };
}

}  // namespace understudy::emulator::models::simple2_r3
