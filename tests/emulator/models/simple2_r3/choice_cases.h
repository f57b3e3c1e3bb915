// Cases for tests of choices: the required effect of each option of a row.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "emulator/models/simple2_r3/choices.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {

template <typename Expected>
using OptionCases = std::vector<std::pair<std::string, Expected>>;

/// Returns the given cases. Fails if they are not the row's options, the default first.
template <typename Expected = Value>
OptionCases<Expected> each_option(std::string_view id, const OptionCases<Expected>& cases) {
  std::vector<std::string_view> named;
  for (const auto& [option, expected] : cases) named.push_back(option);
  std::vector<std::string_view> options;
  for (const ChoiceRow& row : kChoices) {
    if (row.id == id) options = options_of(row);
  }
  EXPECT_EQ(named, options) << id;
  return cases;
}

inline Given with(const std::string& choice, const std::string& option) {
  return {.choices = {{choice, option}}};
}

/// Returns the device's immediate reply to a frame on its line; no bytes if there is none.
inline std::vector<std::uint8_t> ask(OneSimple2& feeder, const std::vector<std::uint8_t>& frame) {
  const pty::Line& line = feeder.world().line(0).line;
  feeder.world().receive(0, frame);
  feeder.run(20);
  const std::vector<std::uint8_t> reply(line.output().begin(), line.output().end());
  feeder.world().take_output(0, reply.size());
  return reply;
}

/// A line of a program: CMD, DATA1, DATA2, JMP.
using ProgramLine = std::array<std::uint16_t, 4>;

inline void write_program(OneSimple2& feeder, const std::vector<ProgramLine>& lines) {
  std::uint16_t address = 0x4000;
  for (const ProgramLine& line : lines) {
    feeder.write(address, {line[0], line[1], line[2], line[3]});
    address = static_cast<std::uint16_t>(address + 4);
  }
}

/// Writes the program and starts it at tick 10, so its lines run at 12, 14 and so on.
inline void start_with_program(OneSimple2& feeder, const std::vector<ProgramLine>& lines) {
  write_program(feeder, lines);
  feeder.run_to(10);
  feeder.set("PROG_MAIN_RunTime_START", 0);
}

inline void switch_off_and_on(OneSimple2& feeder) {
  feeder.world().switch_power(0, false);
  feeder.world().switch_power(0, true);
}

}  // namespace understudy::emulator::models::simple2_r3
