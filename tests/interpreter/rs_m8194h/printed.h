// The manual's tables and frames, as the tests read them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "interpreter/rs_m8194h/commands.h"
#include "tests/interpreter/facts.h"

namespace understudy::interpreter::rs_m8194h::printed {

inline std::vector<Fact> facts(const std::string& name) {
  return read_facts(std::string(TEST_FACTS) + "/rs_m8194h/" + name + ".csv");
}

inline std::uint16_t code_of(const Fact& fact) {
  return static_cast<std::uint16_t>(std::stoul(fact.at("code"), nullptr, 16));
}

/// The values that the manual allows for one parameter.
struct Allowed {
  std::string name;
  int registers = 1;
  std::string type;
  std::string rule;
  std::int64_t min = 0;
  std::int64_t max = 0;
  std::vector<std::int64_t> list = {};

  bool has_range() const { return rule == "number" && list.empty(); }
};

/// Returns the parameters of each command, by the low byte of its code.
inline std::map<int, std::vector<Allowed>> allowed() {
  std::map<int, std::vector<Allowed>> all;
  for (const Fact& fact : facts("parameters")) {
    Allowed one{.name = fact.at("parameter"),
                .registers = std::stoi(fact.at("registers")),
                .type = fact.at("type"),
                .rule = fact.at("rule")};
    if (!fact.at("least").empty()) one.min = std::stoll(fact.at("least"));
    if (!fact.at("most").empty()) one.max = std::stoll(fact.at("most"));
    std::string list = fact.at("list");
    while (!list.empty()) {
      std::size_t used = 0;
      one.list.push_back(std::stoll(list, &used));
      list.erase(0, used);
    }
    all[std::stoi(fact.at("low"), nullptr, 16)].push_back(one);
  }
  return all;
}

/// The bytes of "01 10 1F 40".
inline std::vector<std::uint8_t> bytes_of(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t at = 0; at + 1 < text.size(); at += 3) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(text.substr(at, 2), nullptr, 16)));
  }
  return bytes;
}

/// Returns the registers of a frame that writes to the window; none for other frames.
inline std::vector<std::uint16_t> window_registers(const Fact& frame) {
  const std::vector<std::uint8_t> bytes = bytes_of(frame.at("frame"));
  const bool is_window = frame.at("direction") == "request" && bytes.size() > 9 && bytes[1] == 0x10 &&
                         bytes[2] == 0x1F && bytes[3] == 0x40;
  std::vector<std::uint16_t> registers;
  if (!is_window) return registers;
  for (std::size_t at = 7; at + 3 < bytes.size(); at += 2) {
    registers.push_back(static_cast<std::uint16_t>(bytes[at] << 8U | bytes[at + 1]));
  }
  EXPECT_EQ(registers.size(), bytes[5]) << frame.at("frame");
  return registers;
}

/// Returns the registers of all frames that write to the window.
inline std::vector<std::vector<std::uint16_t>> window_frames() {
  std::vector<std::vector<std::uint16_t>> frames;
  for (const Fact& frame : facts("frames")) {
    if (auto registers = window_registers(frame); !registers.empty()) frames.push_back(registers);
  }
  return frames;
}

/// Returns registers with a valid value for each parameter. The axes of one command differ.
inline std::vector<std::uint16_t> good_registers(std::uint16_t code, const std::vector<Allowed>& parameters) {
  std::vector<std::uint16_t> registers = {code};
  std::int64_t axis = 1;
  for (const Allowed& one : parameters) {
    std::int64_t value = one.list.empty() ? one.min : one.list.front();
    if (one.rule.starts_with("one axis")) {
      value = axis;
      axis *= 2;
    }
    if (one.rule == "operator") value = one.type == "W" ? 0x3C : '+';
    if (one.rule == "any" || one.rule == "if used") value = 1;
    if (one.name == "Lp" || one.name == "Wp") value = one.max;
    const auto bits = static_cast<std::uint32_t>(value);
    if (one.registers == 2) registers.push_back(static_cast<std::uint16_t>(bits >> 16U));
    registers.push_back(static_cast<std::uint16_t>(bits));
  }
  return registers;
}

/// Returns the position of a parameter in these registers.
inline std::size_t place_of(const std::vector<Allowed>& parameters, std::size_t number) {
  std::size_t at = 1;
  for (std::size_t i = 0; i < number; ++i) at += static_cast<std::size_t>(parameters[i].registers);
  return at;
}

inline void put(std::vector<std::uint16_t>& registers, std::size_t at, int count, std::int64_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  if (count == 2) registers[at++] = static_cast<std::uint16_t>(bits >> 16U);
  registers[at] = static_cast<std::uint16_t>(bits);
}

}  // namespace understudy::interpreter::rs_m8194h::printed
