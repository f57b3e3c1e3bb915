// Power, RESET_CARD and LOAD_INITIAL, and what each of them preserves (3.2.1, 8).
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/programs/status.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "emulator/models/rs_m8194h/state.h"
#include "motion/axis.h"
#include "motion/external_drive.h"

namespace understudy::emulator::models::rs_m8194h {

void Module::blank_module() {
  chip.blank(state_.initial_table);
  streams.reset();
  drives.reset();
  interrupts.reset();
  triggers.reset();
  queue.clear_all();
  programs.reset();
  chip.rearm_all();
}

void Module::blank() {
  State made;
  made.initial_table = initial_table_of(state_.blocks, memory.factory_settings());
  made.image = memory.image_at_power_up();
  made.eeprom = std::move(state_.eeprom);
  made.blocks = std::move(state_.blocks);
  for (std::size_t a = 0; a < kAxes; ++a) {
    made.units[a].has_encoder = state_.units[a].has_encoder;
    made.units[a].encoder_raw = state_.units[a].encoder_raw;
    made.units[a].out.pulses = state_.units[a].out.pulses;
  }
  state_ = std::move(made);
  blank_module();
}

void Module::power_up() {
  blank();
  state_.powered_at = now();
  state_.at_init = input(kInitSwitch) != 0;
  status.pass(kInitialised);
  state_.steps_left = language_options().steps_a_tick;
  for (std::size_t a = 0; a < kAxes; ++a) external.take_levels(a);
  chip.pass_pins(now());
  chip.pass_all_pins();
  frnet.scan_first();
  triggers.check_at_start();
  for (std::size_t a = 0; a < kAxes; ++a) {
    chip.rearm(a);
    motion::Axis& motor = chip.motor(a);
    // The levels at power-up do not count as edges.
    motor.signals = chip.environment(a).at(motor.travel_pulses);
  }
}

void Module::power_down() {
  state_.eeprom.lose_power();
  blank();
}

void Module::reset_card() {
  const ChipState chip_before = chip.state();
  const InterruptState interrupts_before = interrupts.state();
  blank_module();
  if (chose(option("reset_card_counters", "kept"))) chip.keep_counters_of(chip_before);
  if (chose(option("reset_card_settings", "kept"))) {
    chip.keep_settings_of(chip_before);
    state_.interrupts = interrupts_before.interrupts;
    state_.enabled = interrupts_before.enabled;
  }
  chip.rearm_all();
  constexpr Tick kBooting = 100;
  if (chose(option("reset_card_time", "100ms"))) state_.resetting_until = now() + kBooting;
  if (chose(option("reset_card_variables", "cleared"))) {
    memory.clear(kFirstBvarSlot, kBvars);
    memory.clear(kFirstVarSlot, kVars);
  }
  if (chose(option("reset_card_do", "off"))) frnet.clear_outputs();
  if (chose(option("reset_card_own_words", "as_at_power_on"))) {
    memory.clear(kCallMpSlot, 1);
    if (!chose(option("word_order_kept", "kept"))) memory.clear(kWordOrderSlot, 1);
    state_.illegal_reason = 0;
    state_.downloaded = {};
    state_.execution_fault = {};
  }
}

void Module::load_initial() {
  for (std::size_t a = 0; a < kAxes; ++a) {
    apply_basic(chip.unit(a), chip.motor(a), state_.initial_table[a], machine_options().axis);
    external.set(a, motion::ExternalDrive::Mode::off, 0);
    chip.rearm(a);
  }
}

}  // namespace understudy::emulator::models::rs_m8194h
