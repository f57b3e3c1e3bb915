// Faults as text: what they are read as, how they are printed, and what is refused with which line.
#include "emulator/faults/fault.h"

#include <gtest/gtest.h>

#include "emulator/bench/bench.h"
#include "emulator/parse_integer.h"

namespace understudy::emulator {
namespace {

const KnownDevices& two() {
  static const Model* const model = find_model("simple2-r3");
  static const KnownDevices devices{{"feeder", model, 152}, {"turner", model, 140}};
  return devices;
}

const KnownDevices& one() {
  static const KnownDevices devices{two()[0]};
  return devices;
}

/// "lost_steps feeder.A one_in=50" by its words.
FaultText words(const std::string& text) {
  FaultText fault;
  std::size_t at = 0;
  for (int word = 0; at <= text.size(); ++word) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string piece = text.substr(at, end - at);
    at = end + 1;
    if (word == 0) {
      fault.kind = piece;
    } else if (word == 1) {
      fault.place = piece;
    } else {
      const std::size_t equals = piece.find('=');
      fault.amounts.emplace_back(piece.substr(0, equals), parse_integer(piece.substr(equals + 1)).value());
    }
  }
  return fault;
}

std::string refusal(const KnownDevices& devices, const FaultText& text) {
  try {
    find_fault(devices, text);
  } catch (const NameError& error) {
    return error.what();
  }
  return "";
}

int terminal(std::string_view name) { return find_terminal(*two()[0].model, name); }

TEST(FaultText, IsReadAsWhatItSaysAndPrintedAsItIsRead) {
  struct Case {
    std::string text;
    Fault fault;
  };
  using Kind = Fault::Kind;
  for (const auto& [text, fault] : std::vector<Case>{
           {"stall feeder.A", {Kind::stall, 0, 0, 0}},
           {"stall turner.B", {Kind::stall, 1, 1, 0}},
           {"lost_steps feeder.B one_in=50", {Kind::lost_steps, 0, 1, 50}},
           {"lost_steps feeder.B one_in=1", {Kind::lost_steps, 0, 1, 1}},
           {"lost_steps feeder.B one_in=1000000000000", {Kind::lost_steps, 0, 1, 1'000'000'000'000}},
           {"slip turner.A pulses=-200", {Kind::slip, 1, 0, -200}},
           {"slip turner.A pulses=0", {Kind::slip, 1, 0, 0}},
           {"slip turner.A pulses=1000000000", {Kind::slip, 1, 0, 1'000'000'000}},
           {"slip turner.A pulses=-1000000000", {Kind::slip, 1, 0, -1'000'000'000}},
           {"alarm feeder.B", {Kind::alarm, 0, 1, 0}},
           {"stuck feeder.DIN_2 level=0", {Kind::stuck, 0, terminal("DIN_2"), 0}},
           {"stuck turner.DIN_10 level=1", {Kind::stuck, 1, terminal("DIN_10"), 1}},
       }) {
    EXPECT_EQ(find_fault(two(), words(text)), fault) << text;
    EXPECT_EQ(to_text(two(), fault), text);
  }
}

TEST(FaultText, MayLeaveOutTheOnlyDevice) {
  EXPECT_EQ(to_text(one(), find_fault(one(), words("stall B"))), "stall feeder.B");
  EXPECT_EQ(to_text(one(), find_fault(one(), words("stuck DIN_4 level=1"))), "stuck feeder.DIN_4 level=1");
}

TEST(FaultText, IsRefusedWithOneLineThatSaysWhy) {
  struct Case {
    std::string text;
    std::string why;
  };
  const std::string kinds = " is no fault; expected one of stall, lost_steps, slip, alarm, stuck";
  for (const auto& [text, why] : std::vector<Case>{
           {"jam feeder.A", "'jam'" + kinds},
           {" feeder.A", "''" + kinds},
           {"Stall feeder.A", "'Stall'" + kinds},
           {"stall feeder.C", "no axis of feeder is called 'C'; expected one of A, B"},
           {"stall feeder.DIN_1", "no axis of feeder is called 'DIN_1'; expected one of A, B"},
           {"stall feedr.A", "no device is called 'feedr'; the nearest is 'feeder'"},
           {"stall A", "no device is called 'A'; the nearest is 'feeder'"},
           {"stall ", "no device is called ''; the nearest is 'feeder'"},
           {"stall feeder.A one_in=5", "stall: 'one_in' is nothing it has; expected no more than the axis"},
           {"alarm feeder.A level=1", "alarm: 'level' is nothing it has; expected no more than the axis"},
           {"alarm feeder.A =0", "alarm: '' is nothing it has; expected no more than the axis"},
           {"lost_steps feeder.A", "lost_steps: one_in is missing; expected 1 to 1000000000000"},
           {"lost_steps feeder.A one_in=0",
            "lost_steps: one_in: 0 is out of range; expected 1 to 1000000000000"},
           {"lost_steps feeder.A one_in=-1",
            "lost_steps: one_in: -1 is out of range; expected 1 to 1000000000000"},
           {"lost_steps feeder.A one_in=1000000000001",
            "lost_steps: one_in: 1000000000001 is out of range; expected 1 to 1000000000000"},
           {"lost_steps feeder.A pulses=5", "lost_steps: 'pulses' is nothing it has; expected one_in"},
           {"lost_steps feeder.A one_in=5 pulses=5",
            "lost_steps: 'pulses' is nothing it has; expected one_in"},
           {"lost_steps feeder.A one_in=5 one_in=6", "lost_steps: one_in is given twice; expected it once"},
           {"slip feeder.A", "slip: pulses is missing; expected -1000000000 to 1000000000"},
           {"slip feeder.A pulses=1000000001",
            "slip: pulses: 1000000001 is out of range; expected -1000000000 to 1000000000"},
           {"slip feeder.A pulses=-9223372036854775807",
            "slip: pulses: -9223372036854775807 is out of range; expected -1000000000 to 1000000000"},
           {"stuck feeder.DIN_2", "stuck: level is missing; expected 0 to 1"},
           {"stuck feeder.DIN_2 level=2", "stuck: level: 2 is out of range; expected 0 to 1"},
           {"stuck feeder.DIN_11 level=1", "no input of feeder is called 'DIN_11'; the nearest is 'DIN_1'"},
           {"stuck feeder.DOUT_1 level=1", "no input of feeder is called 'DOUT_1'; the nearest is 'DIN_1'"},
           {"stuck feeder.AIN_A level=1", "'feeder.AIN_A' cannot be stuck; expected a digital input"},
           {"stuck feeder.DIP1 level=1", "'feeder.DIP1' cannot be stuck; expected a digital input"},
           {"stuck feeder.A level=1", "no input of feeder is called 'A'; the nearest is 'AIN_A'"},
       }) {
    EXPECT_EQ(refusal(two(), words(text)), why) << text;
  }
}

TEST(FaultText, WithControlCharactersIsRefusedInOneLine) {
  for (const FaultText& text : {FaultText{.kind = "st\nall", .place = "feeder.A", .amounts = {}},
                                FaultText{.kind = "stall", .place = "fee\nder.A", .amounts = {}},
                                FaultText{.kind = "stall", .place = "feeder.\nA", .amounts = {}},
                                FaultText{.kind = "stall", .place = "feeder.A", .amounts = {{"a\nb", 1}}},
                                FaultText{.kind = "slip", .place = "feeder.A", .amounts = {{"a\nb", 1}}},
                                FaultText{.kind = "stuck", .place = "feeder.\nDIN_1", .amounts = {}}}) {
    const std::string why = refusal(two(), text);
    EXPECT_NE(why, "");
    EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  }
}

}  // namespace
}  // namespace understudy::emulator
