// A device on two lines with one register image: state of a line stays with that line, state of the device is
// the same on both.
#include <gtest/gtest.h>

#include "emulator/world/faults/fault.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/probe/probes.h"
#include "tests/emulator/workbench/two_lines.h"

namespace understudy::emulator::workbench {
namespace ports_line_test {

using namespace std::chrono_literals;
using world::Bytes;
constexpr std::size_t kPc = TwoLines::kPc;
constexpr std::size_t kHmi = TwoLines::kHmi;

TEST(PortsOnLines, HaveOneImageBehindThem) {
  TwoLines two;
  EXPECT_EQ(two.ask(kPc, "01 10 00 64 00 02 04 12 34 56 78"), "01 10 00 64 00 02");
  EXPECT_EQ(two.ask(kHmi, "01 03 00 64 00 02"), "01 03 04 12 34 56 78");
  EXPECT_EQ(two.ask(kHmi, "01 05 10 00 FF 00"), "01 05 10 00 FF 00");
  EXPECT_EQ(two.ask(kPc, "01 01 10 00 00 01"), "01 01 01 01");
  const auto& pc = two.world.line(kPc).stations.front()->counters();
  const auto& hmi = two.world.line(kHmi).stations.front()->counters();
  EXPECT_EQ(pc.requests, 2U);
  EXPECT_EQ(hmi.requests, 2U);
  EXPECT_EQ(two.world.line(kPc).line.counters().bytes_in, 13U + 8U);
  EXPECT_EQ(two.world.line(kHmi).line.counters().bytes_in, 8U + 8U);
  const world::Probes probes(two.world);
  EXPECT_EQ(probes.value(probes.resolve("mill.requests").handle).whole(), 4) << "of all its stations";
}

TEST(PortsOnLines, AnswerInTheTimeOfTheirOwnSpeed) {
  TwoLines two(two_lines_text());
  const auto time_of_reply = [&](std::size_t line) {
    const SimTime begin = two.world.now();
    two.send(line, "01 03 00 64 00 01");
    while (two.world.line(line).line.output().size() < 7) two.world.advance_to(*two.world.next_due());
    const SimTime took = two.world.now() - begin;
    EXPECT_EQ(two.came(line), "01 03 02 00 00");
    return took;
  };
  // 8 and 7 characters of 11 bits at 115200 baud, of 10 bits at 19200, and the device's 500 us between.
  EXPECT_NEAR(static_cast<double>(time_of_reply(kPc).count()), 15 * 11e9 / 115200 + 500e3, 3);
  EXPECT_NEAR(static_cast<double>(time_of_reply(kHmi).count()), 15 * 10e9 / 19200 + 500e3, 3);
}

TEST(PortsOnLines, ComeInTheOrderOfTheBench) {
  // Both write, both read, each pair at the same moment: the first line's comes first, whichever was fed
  // first.
  for (const bool pc_is_first : {true, false}) {
    for (const bool is_turned : {false, true}) {
      std::string text = "understudy: 1\nlines:\n";
      const std::string pc = "  pc: { timing: instant, stations: [ { device: mill, port: PC } ] }\n";
      const std::string hmi = "  hmi: { timing: instant, stations: [ { device: mill, port: HMI } ] }\n";
      text += (is_turned ? hmi + pc : pc + hmi) + "devices: { mill: { model: workbench } }\n";
      TwoLines two(text);
      const std::size_t fed_first = pc_is_first ? 0 : 1;
      two.pass(5ms);
      for (const std::size_t line : {fed_first, 1 - fed_first}) {
        two.send(line, line == 0 ? "01 06 00 64 00 0A" : "01 06 00 64 00 0B");
      }
      two.pass(0ms);
      EXPECT_EQ(two.came(0), "01 06 00 64 00 0A");
      EXPECT_EQ(two.came(1), "01 06 00 64 00 0B");
      EXPECT_EQ(two.ask(0, "01 03 00 64 00 01"), "01 03 02 00 0B") << "the second line's write came last";
    }
  }
}

TEST(PortsOnLines, RefuseOnOneWhileTheOtherIsServed) {
  TwoLines two;
  EXPECT_EQ(two.ask(kPc, "01 05 00 6F FF 00"), "01 05 00 6F FF 00");
  two.send(kPc, "01 10 00 10 00 02 04 00 00 00 64");  // its module is away
  two.send(kHmi, "01 06 00 64 00 07");
  two.pass(1ms);
  EXPECT_EQ(two.came(kPc), "01 90 04");
  EXPECT_EQ(two.came(kHmi), "01 06 00 64 00 07");
  EXPECT_EQ(two.world.line(kPc).stations.front()->counters().exceptions, 1U);
  EXPECT_EQ(two.world.line(kHmi).stations.front()->counters().exceptions, 0U);
}

TEST(PortsOnLines, DoNotChangeAReplyOnItsWay) {
  TwoLines two(two_lines_text());
  EXPECT_EQ(two.ask(kPc, "01 10 00 64 00 03 06 11 11 11 11 11 11"), "01 10 00 64 00 03");
  two.send(kHmi, "01 03 00 64 00 03");
  while (two.world.line(kHmi).line.output().size() < 3) two.world.advance_to(*two.world.next_due());
  two.send(kPc, "01 10 00 64 00 03 06 22 22 22 22 22 22");  // executed before the other's data end
  while (two.world.line(kPc).line.output().empty()) two.world.advance_to(*two.world.next_due());
  EXPECT_LT(two.world.line(kHmi).line.output().size(), 11U) << "it is still being sent";
  two.pass(50ms);
  EXPECT_EQ(two.came(kHmi), "01 03 06 11 11 11 11 11 11");
  EXPECT_EQ(two.ask(kHmi, "01 03 00 64 00 03"), "01 03 06 22 22 22 22 22 22");
}

TEST(PortsOnLines, ReportReceiveErrorsByPort) {
  const Bytes wrong = [] {
    Bytes bytes = frame_of("01 03 00 64 00 01");
    bytes.back() ^= 1;
    return bytes;
  }();
  const Bytes cut = world::hex("01 03 00");
  const Bytes overlong(300, 0x55);
  using pty::ReceiveError;
  struct Case {
    std::size_t line;
    const Bytes& bytes;
    ReceiveError error;
  };
  for (const bool is_strict : {false, true}) {
    for (const std::string timing : {"timing: instant, ", ""}) {
      TwoLines two(two_lines_text(timing), {.strict_framing = is_strict});
      std::array<std::uint32_t, 2> counts{};
      for (const auto& [line, bytes, error] :
           {Case{kPc, wrong, ReceiveError::bad_checksum}, Case{kHmi, cut, ReceiveError::cut_off},
            Case{kHmi, wrong, ReceiveError::bad_checksum}, Case{kPc, overlong, ReceiveError::overlong},
            Case{kPc, cut, ReceiveError::cut_off}}) {
        two.world.receive(line, bytes);
        two.pass(1s);
        ++counts[line];
        EXPECT_EQ(two.came(line), "") << "it gets no reply";
        EXPECT_EQ(two.mill().state.receive_errors, counts) << timing << is_strict;
        EXPECT_EQ(two.mill().state.last_receive_error[line], 1 + static_cast<int>(error))
            << timing << is_strict;
      }
      EXPECT_EQ(two.ask(kHmi, "01 04 00 12 00 02"), "01 04 04 00 03 00 02") << "a host reads both";
    }
  }
}

TEST(PortsOnLines, ReportNothingWithoutPowerOrForOthers) {
  TwoLines two;
  two.world.switch_power(0, false);
  two.world.receive(kPc, world::hex("01 03 00"));
  two.pass(1s);
  two.world.switch_power(0, true);
  EXPECT_EQ(two.ask(kPc, "07 03 00 64 00 01"), "") << "another station's";
  EXPECT_EQ(two.mill().state.receive_errors, (std::array<std::uint32_t, 2>{}));
}

TEST(PortsOnLines, AreBothSilentWithoutPower) {
  TwoLines two(two_lines_text());
  two.send(kPc, "01 03 00 64 00 40");
  two.send(kHmi, "01 03 00 64 00 40");
  while (two.world.line(kHmi).line.output().empty()) two.world.advance_to(*two.world.next_due());
  two.came(kPc);
  two.came(kHmi);
  two.world.switch_power(0, false);
  two.pass(1s);
  EXPECT_LE(two.world.line(kPc).line.output().size(), 1U) << "the character in progress";
  EXPECT_LE(two.world.line(kHmi).line.output().size(), 1U);
  two.came(kPc);
  two.came(kHmi);
  EXPECT_EQ(two.ask(kPc, "01 03 00 64 00 01"), "");
  EXPECT_EQ(two.ask(kHmi, "01 03 00 64 00 01"), "");
  two.world.switch_power(0, true);
  EXPECT_EQ(two.ask(kPc, "01 03 00 64 00 01"), "01 03 02 00 00");
  EXPECT_EQ(two.ask(kHmi, "01 03 00 64 00 01"), "01 03 02 00 00");
}

// --- its number ----------------------------------------------------------------------------------

TEST(StationNumberInMemory, ChangesBehindItsOwnReplyOnAllLines) {
  TwoLines two;
  EXPECT_EQ(two.ask(kPc, "01 06 00 33 00 09"), "01 06 00 33 00 09") << "with the old address";
  for (const std::size_t line : {kPc, kHmi}) {
    EXPECT_EQ(two.ask(line, "01 03 00 33 00 01"), "");
    EXPECT_EQ(two.ask(line, "09 03 00 33 00 01"), "09 03 02 00 09");
    EXPECT_EQ(two.ask(line, "00 06 00 64 00 05"), "") << "0 is a broadcast";
  }
  EXPECT_EQ(two.ask(kHmi, "09 06 00 33 00 00"), "09 06 00 33 00 00");
  for (const std::size_t line : {kPc, kHmi}) {
    EXPECT_EQ(two.ask(line, "00 03 00 64 00 01"), "00 03 02 00 05") << "address 0 replies if it is its own";
    EXPECT_EQ(two.ask(line, "09 03 00 64 00 01"), "");
  }
  EXPECT_EQ(two.ask(kPc, "00 06 00 33 00 01"), "00 06 00 33 00 01") << "not a broadcast: its address was 0";
  EXPECT_EQ(two.world.device(0).station_number(), 1);
}

TEST(StationNumberInMemory, ChangesWhileAReplyIsOnItsWay) {
  TwoLines two(two_lines_text());
  two.send(kHmi, "01 03 00 64 00 02");
  while (two.world.line(kHmi).line.output().empty()) two.world.advance_to(*two.world.next_due());
  two.send(kPc, "01 06 00 33 00 04");
  two.pass(50ms);
  EXPECT_EQ(two.came(kHmi), "01 03 04 00 00 00 00") << "it started with the old address";
  EXPECT_EQ(two.came(kPc), "01 06 00 33 00 04");
  EXPECT_EQ(two.ask(kHmi, "04 03 00 33 00 01"), "04 03 02 00 04");
}

TEST(StationNumberInMemory, IsSetByABenchThatSaysOne) {
  TwoLines two(
      "understudy: 1\nlines: { pc: { timing: instant, stations: [ { name: mill, model: workbench, "
      "address: 12 } ] } }\n");
  EXPECT_EQ(two.ask(kPc, "0C 03 00 33 00 01"), "0C 03 02 00 0C");
  EXPECT_EQ(two.world.device(0).station_number(), 12);
}

// --- faults --------------------------------------------------------------------------------------

world::Fault fault_of(const TwoLines& two, const std::string& kind, const std::string& place,
                      std::vector<std::pair<std::string, std::string>> fields = {}) {
  return world::find_fault(two.world.known(), {kind, place, std::move(fields)});
}

TEST(FaultOfALine, DoesNotTouchTheOther) {
  struct Case {
    std::string kind;
    std::vector<std::pair<std::string, std::string>> fields;
    std::string answer;  // on the line that is broken
  };
  for (const auto& [kind, fields, answer] :
       {Case{"drop", {}, ""}, Case{"drop", {{"of", "request"}}, ""}, Case{"busy", {}, "01 83 06"},
        Case{"exception", {{"code", "4"}}, "01 83 04"}, Case{"truncate", {{"keep", "3"}}, "01 03 02"}}) {
    for (const std::size_t broken : {kPc, kHmi}) {
      TwoLines two;
      const std::string name = broken == kPc ? "pc" : "hmi";
      const world::Fault fault = fault_of(two, kind, name, fields);
      EXPECT_EQ(world::fault_text(two.world.known(), fault).place, name);
      two.world.inject(fault);
      for (int i = 0; i < 3; ++i) {
        two.send(kPc, "01 03 00 64 00 01");
        two.send(kHmi, "01 03 00 64 00 01");
        two.pass(100ms);
        EXPECT_EQ(two.came(broken), answer) << kind << " on " << name;
        EXPECT_EQ(two.came(1 - broken), "01 03 02 00 00") << kind << " on " << name;
      }
      two.world.clear_faults();
      EXPECT_EQ(two.ask(broken, "01 03 00 64 00 01"), "01 03 02 00 00");
    }
  }
}

TEST(FaultOfADevice, CountsItsRequestsOnAllLines) {
  TwoLines two;
  two.world.inject(fault_of(two, "drop", "mill", {{"nth", "2"}}));
  EXPECT_EQ(two.ask(kPc, "01 03 00 64 00 01"), "01 03 02 00 00");
  EXPECT_EQ(two.ask(kHmi, "01 03 00 64 00 01"), "") << "the second one that it replies to";
  EXPECT_EQ(two.ask(kHmi, "01 03 00 64 00 01"), "01 03 02 00 00");
}

TEST(FaultOfALine, ThatSpoilsARequestIsAReceiveErrorThere) {
  struct Case {
    std::string kind;
    std::vector<std::pair<std::string, std::string>> fields;
    pty::ReceiveError error;
  };
  for (const auto& [kind, fields, error] :
       {Case{"corrupt_checksum", {{"of", "request"}}, pty::ReceiveError::bad_checksum},
        Case{"truncate", {{"keep", "5"}, {"of", "request"}}, pty::ReceiveError::cut_off}}) {
    TwoLines two;
    two.world.inject(fault_of(two, kind, "hmi", fields));
    EXPECT_EQ(two.ask(kHmi, "01 03 00 64 00 01"), "");
    EXPECT_EQ(two.ask(kPc, "01 03 00 64 00 01"), "01 03 02 00 00");
    EXPECT_EQ(two.mill().state.receive_errors, (std::array<std::uint32_t, 2>{0, 1})) << kind;
    EXPECT_EQ(two.mill().state.last_receive_error[kHmi], 1 + static_cast<int>(error)) << kind;
  }
}

// --- observers -----------------------------------------------------------------------------------

TEST(PortsOnLines, AreDistinguishedAmongTheFrames) {
  TwoLines two;
  world::FrameLog log(two.world);
  two.ask(kPc, "01 06 00 64 00 01");
  two.ask(kHmi, "01 03 00 64 00 01");
  std::string reported;
  for (const auto& frame : log.since(1, 10)) reported += frame.line + ": " + frame.text + "\n";
  EXPECT_EQ(reported, "pc: write 0x0064 mill.D0 = 1\npc: done\nhmi: read 0x0064 mill.D0\nhmi: mill.D0 = 1\n");
}

}  // namespace ports_line_test
}  // namespace understudy::emulator::workbench
