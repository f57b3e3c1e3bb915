// Every difference between firmware versions (manual: 韌體版本, program instruction 0x1A, appendix C), as a
// host sees it: programs are written, started and watched by Modbus requests, and their courses are worked
// out by hand in milliseconds, as program_host.h says. Wait_Move_* has a file of its own, and so has
// DIR_Polarity.
#include "tests/emulator/models/simple2_r3/program_host.h"

namespace understudy::emulator::models::simple2_r3 {
namespace firmware_test {

using namespace opcode;

TEST(FirmwareVersions, ReportTheirNumberOverBothReadFunctions) {
  for (const Firmware firmware : kVersions) {
    ProgramHost host(firmware);
    const std::string number = world::text(world::Bytes{0, static_cast<std::uint8_t>(firmware)});
    EXPECT_EQ(host.ask(world::read_pdu(0x03, 0x0002, 1)), "03 02 " + number);
    EXPECT_EQ(host.ask(world::read_pdu(0x04, 0x0002, 1)), "04 02 " + number);
    EXPECT_EQ(host.ask(world::read_pdu(0x03, 0x0001, 2)), "03 04 C0 01 " + number);
    EXPECT_EQ(host.ask(world::write_request(0x0002, firmware)), "86 02");
  }
  EXPECT_EQ(ProgramHost(Given{}.firmware).word(0x0002), 152);
}

// --- Jump_Timer1_GE, Jump_Timer2_GE ---

TEST(FirmwareVersions, JumpTimer1NeverJumpsUntil141AndJumpTimer2DoesInAll) {
  struct Case {
    Value min;  // what the timers are compared with, without a sign
    ProgramCourse by_timer1, by_timer2;
  };
  // Timer1 runs from slot 12, Timer2 from 14. Timer1 is checked in slots 16, 22, 28, ..., Timer2 in 18, 24,
  // 30, ...: at 52 Timer1 is there in slot 64 (64 - 12), Timer2 in slot 66 (66 - 14).
  const std::vector<Case> table{
      {0, {.outputs = {kNone, 18, kNone}, .end = 20}, {.outputs = {kNone, kNone, 20}, .end = 22}},
      {52, {.outputs = {kNone, 66, kNone}, .end = 68}, {.outputs = {kNone, kNone, 68}, .end = 70}},
      {53, {.outputs = {kNone, 72, kNone}, .end = 74}, {.outputs = {kNone, kNone, 74}, .end = 76}},
      {-1, {}, {}},  // 4294967295 ms
  };
  for (const Case& row : table) {
    for (const Firmware firmware : kVersions) {
      SCOPED_TRACE(std::to_string(row.min) + ", firmware " + std::to_string(firmware));
      ProgramHost host(firmware);
      host.write_32(0x8000, row.min);
      host.start(program_lines({{kTimerStart, 1, 0, 0},
                                {kTimerStart, 2, 0, 0},
                                {kJumpTimer1, 1, 0, 3},  // to flag 1, by MEM0
                                {kJumpTimer2, 2, 0, 0},  // to flag 2, by MEM0
                                {kJump, 3, 0, 0},
                                {kOut, 1, 1, 1},
                                {kEnd, 0, 0, 0},
                                {kOut, 2, 1, 2},
                                {kEnd, 0, 0, 0}}));
      ASSERT_NO_FATAL_FAILURE(host.expect(firmware <= 141 ? row.by_timer2 : row.by_timer1, 150));
      EXPECT_EQ(host.value_32(0xF126), 150 - 11) << "Timer1 itself runs in all";
      EXPECT_EQ(host.value_32(0xF128), 150 - 13);
    }
  }
}

// --- the password of appendix C ---

TEST(FirmwareVersions, ThePasswordRegistersAreThereFrom151On) {
  for (const Firmware firmware : kVersions) {
    const bool there = firmware >= 151;
    SCOPED_TRACE(firmware);
    ProgramHost host(firmware);
    for (const std::uint8_t function : {0x03, 0x04}) {
      const std::string refused = world::text(world::Bytes{static_cast<std::uint8_t>(function | 0x80), 2});
      for (const std::size_t address : {0xFF07, 0xFF08, 0xFF09}) {
        const std::string reply = host.ask(world::read_pdu(function, address, 1));
        EXPECT_EQ(reply == refused, !there) << reply;
        if (there) {
          EXPECT_EQ(reply.substr(0, 5), world::text(world::Bytes{function, 2}));
        }
      }
      // One more than there is.
      EXPECT_EQ(host.ask(world::read_pdu(function, 0xFF07, 4)), refused);
      EXPECT_EQ(host.ask(world::read_pdu(function, 0xFF00, 11)), refused);
      // 0xFF00 to 0xFF06 are there in all.
      EXPECT_NE(host.ask(world::read_pdu(function, 0xFF00, 7)), refused);
      EXPECT_EQ(host.ask(world::read_pdu(function, 0xFF00, 8)) == refused, !there);
    }
    EXPECT_EQ(host.ask(world::write_request(0xFF08, 1)), "86 02") << "read only, or not there";
    for (const std::size_t address : {0xFF07, 0xFF09}) {
      const world::Bytes write = world::write_request(address, 0);
      EXPECT_EQ(host.ask(write), there ? world::text(write) : "86 02");
    }
    // A request that reaches into them is refused whole.
    if (!there) {
      EXPECT_EQ(host.ask(world::write_request(0xFF05, world::Words{401, 0, 0})), "90 02");
      EXPECT_EQ(host.word(0xFF05), 400);
    }
    // The program can be read.
    host.write(0x4000, world::Words{kOut, 1, 1, 7});
    EXPECT_EQ(host.ask(world::read_pdu(0x03, 0x4000, 4)), "03 08 00 05 00 01 00 01 00 07");
  }
}

}  // namespace firmware_test
}  // namespace understudy::emulator::models::simple2_r3
