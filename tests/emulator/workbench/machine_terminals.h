// The terminals of the made-up controller, and its motors: every kind of terminal, and 320 in groups.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator::workbench {

inline constexpr std::string_view kMotors[] = {"A", "B"};
inline constexpr std::size_t kMotorCount = 2;

/// The functions of a motor's inputs, in the order of their terminals.
enum MotorInput : int { kUpper, kLower, kHome, kNear, kMark, kIndex, kInputsOfMotor };

// Terminals by number.
inline constexpr int kPlainInputs = 16;
inline constexpr int kFirstMotorInput = kPlainInputs;
inline constexpr int kHandWheel = kFirstMotorInput + 2 * kInputsOfMotor;
inline constexpr int kExternal = kHandWheel + 1;
inline constexpr int kFirstOutput = kExternal + 1;
inline constexpr int kPlainOutputs = 80;
inline constexpr int kVolts = kFirstOutput + kPlainOutputs;
inline constexpr int kCompare = kVolts + 1;
inline constexpr int kFirstOfGroups = kCompare + 1;
inline constexpr int kBitsOfGroup = 16;
inline constexpr int kInputWords = 12;
inline constexpr int kOutputWords = 8;
inline constexpr int kFirstGroupedOutput = kFirstOfGroups + kInputWords * kBitsOfGroup;

constexpr int motor_input(std::size_t motor, MotorInput input) {
  return kFirstMotorInput + static_cast<int>(motor) * kInputsOfMotor + input;
}

struct TerminalTables {
  std::vector<std::string> names;
  std::vector<TerminalRow> rows;
  std::vector<std::string> group_names;
  std::vector<TerminalGroup> groups;
};

inline TerminalTables make_terminals() {
  using Kind = TerminalRow::Kind;
  TerminalTables made;
  std::vector<TerminalRow> kinds;
  const auto add = [&](Kind kind, const std::string& name, std::int32_t highest = 1) {
    made.names.push_back(name);
    kinds.push_back({.kind = kind, .name = {}, .lowest = 0, .highest = highest});
  };
  for (int i = 0; i < kPlainInputs; ++i) add(Kind::digital_in, "IN" + std::to_string(i));
  for (const std::string_view motor : kMotors) {
    for (const char* what : {"UPPER_", "LOWER_", "HOME_", "NEAR_", "MARK_", "INDEX_"}) {
      add(Kind::digital_in, what + std::string(motor));
    }
  }
  add(Kind::counted_in, "MPG");
  add(Kind::counted_in, "EXPP");
  for (int i = 0; i < kPlainOutputs; ++i) add(Kind::digital_out, "OUT" + std::to_string(i));
  add(Kind::analog_out, "VOUT", 5000);
  add(Kind::pulse_out, "CMP");
  const auto add_group = [&](Kind kind, const std::string& name) {
    made.group_names.push_back(name);
    made.groups.push_back({.name = {}, .first = static_cast<int>(made.names.size()), .count = kBitsOfGroup});
    for (int i = 0; i < kBitsOfGroup; ++i) add(kind, name + "_" + std::to_string(i));
  };
  for (int i = 0; i < kInputWords; ++i) add_group(Kind::digital_in, "DI_" + std::to_string(i));
  for (int i = 0; i < kOutputWords; ++i) add_group(Kind::digital_out, "DO_" + std::to_string(i));
  for (std::size_t i = 0; i < made.names.size(); ++i) {
    kinds[i].name = made.names[i];
    made.rows.push_back(kinds[i]);
  }
  for (std::size_t i = 0; i < made.groups.size(); ++i) made.groups[i].name = made.group_names[i];
  return made;
}

inline const TerminalTables& terminal_tables() {
  static const TerminalTables made = make_terminals();
  return made;
}

inline std::span<const AxisRow> motor_rows() {
  static const std::vector<AxisRow> rows = [] {
    std::vector<AxisRow> made;
    for (std::size_t i = 0; i < kMotorCount; ++i) {
      made.push_back({.name = kMotors[i],
                      .upper_limit_input = motor_input(i, kUpper),
                      .lower_limit_input = motor_input(i, kLower),
                      .home_input = motor_input(i, kHome),
                      .pulses_per_revolution = 1000,
                      .near_home_input = motor_input(i, kNear),
                      .mark_input = motor_input(i, kMark),
                      .index_input = motor_input(i, kIndex)});
    }
    return made;
  }();
  return rows;
}

}  // namespace understudy::emulator::workbench
