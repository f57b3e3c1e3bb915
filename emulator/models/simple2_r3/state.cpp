// Converts Simple2-R3's state to bytes and back.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/state/state_error.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/stateful_device_bytes.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/state_fields.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// Requires a count that a plant's encoder can have (PlantAxis::encoder_counts), so that the difference of
/// two counts does not overflow.
void require_encoder_count(std::int64_t counts) {
  constexpr std::int64_t kEnd = std::int64_t{1} << 61;
  require_within(counts, -kEnd, kEnd - 1);
}

/// Limits the speed, because velocity mode multiplies it by the resolution.
void require_speed(const AxisState& axis, std::uint32_t pulses_per_revolution) {
  const std::int64_t max = INT64_MAX / 4 / std::max<std::int64_t>(pulses_per_revolution, 1);
  require_within(axis.speed_urpm, -max, max);
}

}  // namespace

std::string register_at_slot(std::size_t slot) {
  for (const RegisterRow& row : kRegisters) {
    const auto count = static_cast<std::size_t>(row.count);
    if (slot < count) return std::string(row.name) + (count == 1 ? "" : "+" + std::to_string(slot));
    slot -= count;
  }
  return std::to_string(slot);
}

}  // namespace understudy::emulator::models::simple2_r3

namespace understudy {

using namespace emulator::models::simple2_r3;

void StateOf<KeptCommand>::check(const KeptCommand& kept) {
  // A distance is the difference of two coordinates; the other values come from registers.
  require_within(kept.move.distance_pulses, -(std::int64_t{1} << 33), std::int64_t{1} << 33);
  for (const std::uint32_t word :
       {kept.move.speed_rpm, kept.move.acceleration_10ms, kept.move.deceleration_10ms}) {
    require_within(word, 0, UINT16_MAX);
  }
  require_within(kept.value, INT32_MIN, INT32_MAX);
}

void StateOf<AxisState>::check(const AxisState& axis) {
  require_reach(axis.pulses_this_tick);
  require_reach(axis.alarm_clear_until);
  require_within(axis.target_urpm, INT32_MIN * std::int64_t{1000}, INT32_MAX * std::int64_t{1000});
  require_within(axis.velocity_phase, -kVelocityPhase, kVelocityPhase);
  require_within(axis.velocity_resolution, 1, std::int64_t{1} << 31);
  require_encoder_count(axis.encoder_raw);
  require_encoder_count(axis.encoder_counts);
  require_encoder_count(axis.encoder_followed);
  require_reach(axis.encoder_preset);
  for (const std::int64_t counts : axis.encoder_history) require_encoder_count(counts);
  require_reach(axis.encoder_changed);
}

void StateOf<State>::check(const State& state) {
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    require_speed(state.axes[i], state.image[kAxisSlots[i].resolution]);
    require_speed(state.axes[i], state.axes[i].velocity_resolution);
  }
  require_reach(state.first_tick);
}

}  // namespace understudy

namespace understudy::emulator::models::simple2_r3 {

void Simple2R3::check_restored(State& restored) const {
  restored.eeprom.check_restored(state_.eeprom);
  check_restored_registers(*this, restored.image, restored.eeprom.content());
}

}  // namespace understudy::emulator::models::simple2_r3

template class understudy::emulator::StatefulDevice<understudy::emulator::models::simple2_r3::Simple2R3,
                                                    understudy::emulator::models::simple2_r3::State>;
