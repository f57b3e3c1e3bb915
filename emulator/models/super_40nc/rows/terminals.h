// SUPER-40NC's terminals: X, Y, and the pins that have no number. The names of these pins are ours, because
// our copy of the manual lacks the wiring diagrams.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "emulator/device/model.h"
#include "emulator/models/super_40nc/rows/contact_rows.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr int kFirstOutput = kInputCount;
inline constexpr int kFirstPin = kFirstOutput + kOutputCount;

/// Pins of each axis.
enum Pin : int { kAlarmPin, kIndexPin, kInPositionPin, kReadyPin, kPinsOfAxis };
constexpr int pin_of(int axis, Pin pin) { return kFirstPin + axis * kPinsOfAxis + pin; }

inline constexpr int kWheelTerminal = kFirstPin + kAxisCount * kPinsOfAxis;  // MPG
inline constexpr int kEmergencyTerminal = kWheelTerminal + 1;                // CEMG
inline constexpr int kFirstAnalogIn = kEmergencyTerminal + 1;                // VR1 to VR3
inline constexpr int kAnalogInCount = 3;
inline constexpr int kFirstAnalogOut = kFirstAnalogIn + kAnalogInCount;  // Vout1, Vout2
inline constexpr int kAnalogOutCount = 2;
inline constexpr int kRunSwitch = kFirstAnalogOut + kAnalogOutCount;  // PLC_RUN
// Terminals that exist only if choices enable them: those from DOG_X on (dog_inputs), from Vin1 on
// (analog_counts), from SVON_X on (servo_on) and from CLR_X on (pins_fitted).
inline constexpr int kFirstDogTerminal = kRunSwitch + 1;
inline constexpr int kFirstVoltageIn = kFirstDogTerminal + kAxisCount;
inline constexpr int kFirstServoTerminal = kFirstVoltageIn + kAnalogInCount;
inline constexpr int kFirstChipPin = kFirstServoTerminal + kAxisCount;
enum ChipPin : int { kClearPin, kLatchPin, kErcPin, kChipPinsOfAxis };
constexpr int chip_pin_of(int axis, ChipPin pin) { return kFirstChipPin + axis * kChipPinsOfAxis + pin; }
inline constexpr int kTerminalCount = kFirstChipPin + kAxisCount * kChipPinsOfAxis;

// Inputs according to 《X33./X34.》. DOG fills the gap in that list.
constexpr int dog_input(int axis) { return 3 * axis; }
constexpr int limit_plus_input(int axis) { return 3 * axis + 1; }
constexpr int limit_minus_input(int axis) { return 3 * axis + 2; }

inline constexpr std::int32_t kMaxAnalogCount = 1023;
inline constexpr std::int32_t kVoltageSteps = 1000;
inline constexpr std::int32_t kMaxMillivolts = 3300;
inline constexpr std::int32_t kMaxMillivoltsIn = 5000;

inline constexpr int kFactoryPulsesPerRevolution = 4000;

// D9x63 and D9x64: how each axis uses its limit inputs.
inline constexpr std::array<std::string_view, kAxisCount> kPlusLimitUses{"D9163", "D9263", "D9363", "D9463"};
inline constexpr std::array<std::string_view, kAxisCount> kMinusLimitUses{"D9164", "D9264", "D9364", "D9464"};

inline constexpr std::array<AxisRow, kAxisCount> kAxes = [] {
  std::array<AxisRow, kAxisCount> rows;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    rows[static_cast<std::size_t>(axis)] = {
        .name = kAxisNames[static_cast<std::size_t>(axis)],
        .upper_limit_input = limit_plus_input(axis),
        .lower_limit_input = limit_minus_input(axis),
        .home_input = dog_input(axis),
        .alarm_input = pin_of(axis, kAlarmPin),
        .ready_input = pin_of(axis, kReadyPin),
        .pulses_per_revolution = kFactoryPulsesPerRevolution,
        .index_input = pin_of(axis, kIndexPin),
        .upper_limit_used_by = kPlusLimitUses[static_cast<std::size_t>(axis)],
        .lower_limit_used_by = kMinusLimitUses[static_cast<std::size_t>(axis)]};
  }
  return rows;
}();

/// Returns the rows of all terminals. Their names are created once.
std::span<const TerminalRow> terminals();

}  // namespace understudy::emulator::models::super_40nc
