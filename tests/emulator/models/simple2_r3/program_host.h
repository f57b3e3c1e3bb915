// A host that writes a program into a Simple2-R3, starts it and watches it, all by Modbus requests.
//
// A program that is started at tick 10 has its first slot at 12, and then one line every 2 ms. A move that
// begins in slot k is at its start position in tick k. A move of P pulses at one pulse per millisecond with
// ramps of 10 ms ends in tick k + P + 10, after that tick's slot. The slot that finds it ended still belongs
// to the line that waits.
#pragma once

#include <array>

#include "tests/emulator/models/simple2_r3/one_simple2.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::simple2_r3 {

/// Every firmware that differs according to the manual, and the versions between them.
inline constexpr Firmware kVersions[] = {139, 140, 141, 142, 150, 151, 152};

/// In a course: never.
inline constexpr Tick kNone = -1;

/// The ticks in which a program's outputs come on, and in which it ends.
struct ProgramCourse {
  std::array<Tick, 3> outputs{kNone, kNone, kNone};
  Tick end = kNone;
};

/// A device that is reached only through its Modbus server.
struct ProgramHost {
  explicit ProgramHost(Firmware firmware, std::map<std::string, std::string> choices = {})
      : machine({.firmware = firmware, .choices = std::move(choices)}) {}

  std::string ask(const world::Bytes& pdu) { return world::answer(machine.device(), pdu); }
  void write(std::size_t address, std::uint16_t word) {
    const world::Bytes pdu = world::write_request(address, word);
    EXPECT_EQ(ask(pdu), world::text(pdu));
  }
  void write(std::size_t address, const world::Words& words) {
    const world::Bytes pdu = world::write_request(address, words);
    EXPECT_EQ(ask(pdu), world::text(world::Bytes(pdu.begin(), pdu.begin() + 5)));
  }
  void write_32(std::size_t address, Value value) {
    const auto bits = static_cast<std::uint32_t>(value);
    write(address, world::Words{static_cast<std::uint16_t>(bits), static_cast<std::uint16_t>(bits >> 16)});
  }
  std::uint16_t word(std::size_t address) {
    const world::Words words = world::read(machine.device(), address, 1);
    EXPECT_EQ(words.size(), 1u) << address;
    return words.empty() ? std::uint16_t{0xFFFF} : words[0];
  }
  std::int32_t value_32(std::size_t address) {
    const world::Words words = world::read(machine.device(), address, 2);
    EXPECT_EQ(words.size(), 2u) << address;
    return words.size() < 2 ? 0 : static_cast<std::int32_t>(words[0] | std::uint32_t{words[1]} << 16);
  }

  /// Sets both axes to one pulse per millisecond: 3000 pulses per revolution, 20 RPM, ramps of 10 ms.
  void set_pace() {
    write_32(0xF002, 3000);
    write_32(0xF004, 3000);
    write(0x1002, world::Words{20, 1, 1});
    write(0x1008, world::Words{20, 1, 1});
  }
  /// Switches the servos on at tick 10.
  void start(const world::Words& program) {
    set_pace();
    write(0x1013, 1);
    write(0x4000, program);
    machine.run_to(10);
    write(0x3000, 0);
  }
  /// Compares a program that was just started with its course, tick by tick.
  void expect(const ProgramCourse& course, Tick until) {
    for (Tick tick = 10; tick <= until; ++tick) {
      machine.run_to(tick);
      for (std::size_t i = 0; i < 3; ++i) {
        const bool on = course.outputs[i] != kNone && tick >= course.outputs[i];
        ASSERT_EQ(word(0x0D00 + i), on) << "DOUT_" << i << " in tick " << tick;
      }
      ASSERT_EQ(word(0x3012), course.end == kNone || tick < course.end) << "running in tick " << tick;
    }
  }

  OneSimple2 machine;
};

/// A program's lines, each as CMD, DATA1, DATA2, JMP.
inline world::Words program_lines(const std::vector<std::array<std::uint16_t, 4>>& of) {
  world::Words words;
  for (const auto& line : of) words.insert(words.end(), line.begin(), line.end());
  return words;
}

/// The CMD values of the lines used here.
namespace opcode {
inline constexpr std::uint16_t kDelay = 0x02, kJump = 0x03, kOut = 0x05, kEnd = 0xFF;
inline constexpr std::uint16_t kJumpTimer1 = 0x1A, kJumpTimer2 = 0x1B, kTimerStart = 0x55, kCountUp = 0x51;
inline constexpr std::uint16_t kMoveA = 0x20, kMoveB = 0x30, kMoveAll = 0x40;
inline constexpr std::uint16_t kWaitA = 0x24, kWaitB = 0x34, kWaitAll = 0x44;
}  // namespace opcode

}  // namespace understudy::emulator::models::simple2_r3
