// Converts SUPER-40NC's state to bytes and back.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/simulated_time.h"
#include "base/state/state_error.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/stateful_device_bytes.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/programs/files.h"
#include "emulator/models/super_40nc/programs/user_table.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "emulator/models/super_40nc/state_fields.h"

namespace understudy::emulator::models::super_40nc {

std::string register_at_slot(std::size_t slot) {
  for (const RegisterRow& row : kRegisters) {
    if (row.is_view) continue;
    const auto count = static_cast<std::size_t>(row.count);
    if (slot < count) return RegisterMap::name_of(row, static_cast<int>(slot));
    slot -= count;
  }
  return std::to_string(slot);
}

namespace {

/// The limit for sums of pulses and lengths.
constexpr std::int64_t kFar = std::int64_t{1} << 60;

}  // namespace

}  // namespace understudy::emulator::models::super_40nc

namespace understudy {

using namespace emulator::models::super_40nc;

void StateOf<Rest>::check(const Rest& rest) {
  for (const std::int64_t pulses : {rest.travel, rest.distance, rest.search}) {
    require_within(pulses, -kFar, kFar);
  }
}

void StateOf<AxisState>::check(const AxisState& axis) {
  for (const std::int64_t number :
       {axis.sent_pulses, axis.followed_pulses, axis.offset_lu, axis.encoder_counts, axis.backlash_seen,
        axis.path_backlash, axis.arc_backlash, axis.target_lu}) {
    require_within(number, -kFar, kFar);
  }
  require_within(axis.order, 0, 4);
  require_state(std::abs(axis.arc_backlash_part) <= 1, "more than a pulse");
  require_state(axis.step_pps >= 300.0 / 4096 && axis.step_pps <= 100, "not a step of the chip's speeds");
}

void StateOf<State>::check(const State& state) {
  for (const Tick tick : state.signal_until) require_reach(tick);
  require_within(state.plc_quiet_scans, 0, kNever);
  require_within(state.path_backlash_ticks, 0, kNever);
  require_within(state.logo_ms, 0, 10'000);
  require_within(state.flash_until, 0, kNever);
  for (const Tick tick : state.erc_until) require_within(tick, 0, kNever);
  const std::size_t parameters = state.parameters_in_force.size();
  require_state(parameters == 0 || parameters == kParameterCount, "the number of parameters is wrong");
  const std::size_t words = state.table.words.size();
  require_state(words % kWordsOfATableLine == 0 && words <= std::size_t{kTableLines} * kWordsOfATableLine,
                "the lines do not belong to the user table");
  require_within(state.file, 0, 30'000);
  require_within(state.recipe, 0, kRecipeCount - 1);
  require_within(state.homing_by_key.order, 0, 4);
  require_within(state.zeroing_by_key.order, 0, 4);
}

}  // namespace understudy

namespace understudy::emulator::models::super_40nc {

void Super40nc::check_restored(State& restored) const {
  restored.eeprom.check_restored(state_.eeprom);
  restored.blocks.check_restored(state_.blocks);
  check_restored_registers(*this, restored.image, restored.eeprom.content());
}

void Super40nc::take_over(const State& restored) {
  state_ = restored;
  parts_.axes.inputs.await_edges();
  parts_.programs.restored();
}

}  // namespace understudy::emulator::models::super_40nc

template class understudy::emulator::StatefulDevice<understudy::emulator::models::super_40nc::Super40nc,
                                                    understudy::emulator::models::super_40nc::State>;
