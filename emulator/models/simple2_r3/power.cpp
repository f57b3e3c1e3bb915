#include "emulator/models/simple2_r3/power.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/memory.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/reactions.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/slots.h"
#include "emulator/models/simple2_r3/state.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// Returns the duration of Erase_ALL and Factory_Reset.
Tick rewrite_ticks(const Setup& setup) { return setup.chose(option("eeprom_erasure", "100ms")) ? 100 : 500; }

/// Resets the state, except the memory and the encoders' raw counts.
void blank(State& state) {
  State blank;
  blank.eeprom = std::move(state.eeprom);
  for (std::size_t i = 0; i < blank.axes.size(); ++i) {
    blank.axes[i].encoder_raw = state.axes[i].encoder_raw;
  }
  state = std::move(blank);
}

}  // namespace

void Power::down() {
  const bool ends_first = state_.eeprom.writing() && setup_.chose(option("power_cut", "new_value"));
  if (ends_first) state_.eeprom.step(state_.eeprom.next_active_tick(), state_.image);
  state_.eeprom.lose_power();
  const std::uint8_t switches = state_.switches;
  blank(state_);
  state_.switches = switches;  // until then, the line keeps its speed
}

void Power::up() {
  blank(state_);
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    state_.image[slot] = setup_.keeps(row) ? state_.eeprom.content()[slot] : factory_bits(setup_, row);
  });
  for (std::size_t i = 0; i < kAssignmentCount; ++i) {
    if (state_.image[kFirstAssignment + i] != 0) state_.assignments |= static_cast<std::uint16_t>(1U << i);
  }
  state_.first_tick = setup_.now() + 1 + setup_.boot_ticks;
  state_.switches = setup_.switch_levels();
  memory_.take_password();
  programs_.power_up();
  for (int axis = 0; axis < 2; ++axis) AxisReactions(state_, setup_, axis).power_up();
}

void Power::reset_to_factory() {
  if (!is_unlocked(state_, setup_) && setup_.chose(option("locked_reset", "ignored"))) return;
  const bool volatile_stays = setup_.chose(option("factory_reset_of_volatile", "kept"));
  constexpr std::size_t kFirstSurvivor = slot("ADC_10V_A");
  constexpr std::size_t kLastSurvivor = slot("ADC_1V_B");
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    const bool stays = volatile_stays && !setup_.keeps(row);
    if (stays || (slot >= kFirstSurvivor && slot <= kLastSurvivor)) return;
    state_.image[slot] = factory_bits(setup_, row);
  });
  memory_.take_password();
  programs_.stop();
  programs_.reload();
  state_.eeprom.rewrite(state_.image, rewrite_ticks(setup_), setup_.now());
  for (int axis = 0; axis < 2; ++axis) {
    if (!setup_.chose(option("factory_reset_motion", "goes_on")))
      AxisReactions(state_, setup_, axis).servo_off();
    state_.axes[static_cast<std::size_t>(axis)].homed = false;
  }
  if (volatile_stays) return;
  state_.written_outputs = 0;
  programs_.reset_timers();
  for (AxisState& axis : state_.axes) axis.alarm_clear_until = 0;
}

void Power::erase_program() {
  if (!setup_.chose(option("erase_while_running", "goes_on"))) programs_.stop();
  programs_.clear();
  state_.eeprom.rewrite(state_.image, rewrite_ticks(setup_), setup_.now());
}

}  // namespace understudy::emulator::models::simple2_r3
