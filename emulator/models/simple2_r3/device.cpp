#include "emulator/models/simple2_r3/device.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "base/state/state_bytes.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_view.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/reactions.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/terminals.h"
#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/listing.h"

namespace understudy::emulator::models::simple2_r3 {

Simple2R3::Simple2R3(const DeviceSettings& given)
    : StatefulDevice(simple2_r3::model(), given),
      RegisterBankOf(*this, *simple2_r3::model().registers, given.firmware),
      PersistentMemory(simple2_r3::model().name, given.firmware),
      setup_(*this),
      map_policy_(map_policy_of(setup_)) {
  state_.eeprom = factory_memory(setup_);
  set_input(kFirstSwitch, Device::line_settings(0).baud == line_bauds().back() ? 1 : 0);  // DIP1
}

// --- its line --------------------------------------------------------------------------------------

Addressing Simple2R3::addressing(std::uint8_t address) const {
  if (now() + 1 < state_.first_tick) return Addressing::ignore;  // the device has not booted yet
  const int rotary_switch = *station_number();
  if (rotary_switch == 0) {
    return address == 0 && chose(option("switch_0_broadcast", "silent")) ? Addressing::execute_silently
                                                                         : Addressing::execute_and_reply;
  }
  if (address == rotary_switch) return Addressing::execute_and_reply;
  if (address == 0 && !chose(option("station_0_request", "ignored"))) return Addressing::execute_silently;
  return Addressing::ignore;
}

pty::LineSettings Simple2R3::line_settings(std::size_t port) const {
  pty::LineSettings line = Device::line_settings(port);
  line.baud = line_bauds()[signals().dip_switch(0) ? 1 : 0];
  return line;
}

// --- memory and program ----------------------------------------------------------------------------

std::function<void(NvImage&)> Simple2R3::memory_writer() const {
  return registers_writer(*this, state_.eeprom.content());
}

void Simple2R3::read_memory(const NvImage& image) {
  const auto values = read_registers(*this, image, Device::model().firmwares.back());
  for (std::size_t slot = 0; slot < values.size(); ++slot) state_.eeprom.put(slot, values[slot]);
}

std::string Simple2R3::program_text() const { return disassemble(state_.program.lines()); }

// --- time ------------------------------------------------------------------------------------------

void Simple2R3::sample_inputs(Tick) {
  if (take_inputs_changed()) simple2_r3::sample_inputs(state_, setup_);
}

void Simple2R3::run_interpreters(Tick tick) {
  if (!setup_.motion_first && program_is_due(state_, tick)) programs().run(tick, program_watch_);
}

void Simple2R3::step_motion(Tick tick) {
  for (int number = 0; number < 2; ++number) step_axis(state_, setup_, number, tick);
  state_.touched = false;
  if (setup_.motion_first) {
    set_now(tick);  // motion that a line starts begins in the next tick
    if (program_is_due(state_, tick)) programs().run(tick, program_watch_);
  }
}

void Simple2R3::update_outputs(Tick tick) {
  for (AxisState& axis : state_.axes) {
    remember_encoder(axis, tick);
    if (tick >= axis.alarm_clear_until) axis.alarm_clear_until = 0;
  }
  state_.eeprom.step(tick, state_.image);
}

Tick Simple2R3::next_tick_without_axes(Tick done) const {
  if (state_.touched) return done + 1;
  Tick next = state_.eeprom.next_active_tick();  // the EEPROM continues to work while the device boots
  if (done < state_.first_tick && starts_by_itself(state_)) next = std::min(next, state_.first_tick);
  if (state_.execution.running) next = std::min(next, next_slot(state_, setup_, *this, done));
  for (const AxisState& axis : state_.axes) {
    if (axis.alarm_clear_until > done) next = std::min(next, axis.alarm_clear_until);
  }
  return next;
}

Tick Simple2R3::next_active_tick(Tick done) const {
  // The cheapest check comes first: a moving axis is active in every tick, so nothing else needs to be
  // checked.
  for (const AxisState& axis : state_.axes) {
    if (simple2_r3::next_active_tick(axis, done) == done + 1) return done + 1;
  }
  const Tick next = next_tick_without_axes(done);
  return next > done + 1 && inputs_changed() && signals().have_changed() ? done + 1 : next;
}

Tick Simple2R3::next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const {
  Tick last = std::min(limit, next_tick_without_axes(done) - 1);
  for (int number = 0; number < 2 && last > done; ++number) {
    last = quiet_until(axis(number).state(), axis(number).skip_context(done, ahead), last);
  }
  return last > done && inputs_changed() && signals().have_changed() ? done + 1 : last + 1;
}

void Simple2R3::fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                                std::span<std::int64_t> pulses) {
  for (int number = 0; number < 2; ++number) {
    const AxisView view(state_, setup_, number);
    AxisState& axis = state_.axes[static_cast<std::size_t>(number)];
    const std::int64_t commanded = fast_forward(axis, view.skip_context(done, ahead), tick);
    axis.coordinate_pulses = view.coordinate_after(commanded);
    pulses[static_cast<std::size_t>(number)] += view.sent(commanded);
  }
}

void Simple2R3::prefetch(Tick tick) const {
  Device::prefetch(tick);
  prefetch_line(&setup_);
  prefetch_line(&state_);
  for (const AxisState& axis : state_.axes) simple2_r3::prefetch(axis, tick);
  prefetch_line(&state_.image[slot("Aaxis_DIR_Polarity")]);  // with the other polarities
  if (tick % interpreter::simple2::kSlotMs != 0) return;
  understudy::prefetch(&state_.image[slot("PROG_VAR{}")], 32 * sizeof(std::uint32_t));
  prefetch_line(&state_.image[slot("Counter1_Value")]);
  prefetch_line(&state_.program);
}

// --- terminals and axes ----------------------------------------------------------------------------

bool Simple2R3::output(int terminal) const {
  return terminal >= kFirstOutput && terminal < kFirstOutput + kOutputCount &&
         signals().output(terminal - kFirstOutput);
}

std::span<const std::string_view> Simple2R3::pulse_formats() const {
  static constexpr std::array<std::string_view, 2> kFormats{"CW/CCW", "PLS/DIR"};  // by DIP2
  return kFormats;
}

}  // namespace understudy::emulator::models::simple2_r3
