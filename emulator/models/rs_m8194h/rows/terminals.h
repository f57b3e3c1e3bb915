// RS-M8194H: the terminals, by number and as rows. 1 means conducting, which the manual calls on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator::models::rs_m8194h {

/// The inputs of an axis, in the order of its terminals.
enum class Pin : std::uint8_t {
  limit_plus,   // LMT+
  limit_minus,  // LMT-
  near_home,    // NHOME, IN0
  home,         // HOME, IN1
  index,        // Z phase, IN2
  in3,
  external_plus,   // EXP+, MPG+
  external_minus,  // EXP-, MPG-
  in_position,
  alarm,
};
inline constexpr int kPinsOfAxis = 10;
constexpr std::uint16_t bit_of(Pin pin) {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(pin));
}

inline constexpr int kFirstPin = 0;
inline constexpr int kEmergencyPin = kFirstPin + 4 * kPinsOfAxis;
inline constexpr int kInitSwitch = kEmergencyPin + 1;
inline constexpr int kNoModuleSwitch = kInitSwitch + 1;
inline constexpr int kFirstServo = kNoModuleSwitch + 1;
inline constexpr int kFirstOut = kFirstServo + 4;  // nOUT of X and Y
inline constexpr int kOuts = 2;
inline constexpr int kFrnetGroups = 8;
inline constexpr int kFrnetChannels = 16;
inline constexpr int kFirstDi = kFirstOut + kOuts;
inline constexpr int kFirstDo = kFirstDi + kFrnetGroups * kFrnetChannels;
inline constexpr int kTerminalCount = kFirstDo + kFrnetGroups * kFrnetChannels;

constexpr int terminal(std::size_t axis, Pin pin) {
  return kFirstPin + static_cast<int>(axis) * kPinsOfAxis + static_cast<int>(pin);
}

struct TerminalTables {
  std::vector<std::string> names;
  std::vector<TerminalRow> rows;
  std::vector<std::string> group_names;
  std::vector<TerminalGroup> groups;
  std::vector<AxisRow> axes;
};
const TerminalTables& terminal_tables();

}  // namespace understudy::emulator::models::rs_m8194h
