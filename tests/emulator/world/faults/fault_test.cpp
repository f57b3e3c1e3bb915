// Faults as text: how they are read, how they are printed, and which are refused with which line.
#include "emulator/world/faults/fault.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/fault_schema.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/faults/trigger_text.h"
#include "tests/emulator/world/faults/faulty_line.h"

namespace understudy::emulator::world {
namespace fault_test {

const KnownDevices& two() {
  static const Model* const model = find_model(models::all_models(), "simple2-r3");
  static const KnownDevices devices{{"feeder", model, 152, {"rs485"}}, {"turner", model, 140, {"rs485"}}};
  return devices;
}

const KnownDevices& one() {
  static const KnownDevices devices{two()[0]};
  return devices;
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
           {"turn feeder.A counts=-4000", {.kind = Kind::turn, .amount = -4000}},
           {"turn feeder.A counts=400 in=2s", {.kind = Kind::turn, .amount = 400, .over_ticks = 2000}},
           {"alarm feeder.B", {Kind::alarm, 0, 1, 0}},
           {"stuck feeder.DIN_2 level=0", {Kind::stuck, 0, terminal("DIN_2"), 0}},
           {"stuck turner.DIN_10 level=1", {Kind::stuck, 1, terminal("DIN_10"), 1}},
       }) {
    EXPECT_EQ(find_fault(two(), fault_words(text)), fault) << text;
    EXPECT_EQ(to_text(two(), fault), text);
  }
}

TEST(FaultText, WithATriggerIsPrintedAsItIsRead) {
  for (const std::string text : {
           "drop feeder",
           "drop rs485 of=request function=6 nth=3",
           "drop rs485 of=both every=2 times=7",
           "delay turner by=20ms from=1s to=2.5s",
           "delay turner by=0s of=request",
           "corrupt_checksum rs485 station=2 chance=5%",
           "corrupt_checksum rs485 seed=77 chance=0.000001%",
           "truncate feeder keep=0 address=0x1002",
           "truncate feeder keep=256 of=request address=0x1002..0x1003 nth=4..6",
           "duplicate feeder",
           "duplicate feeder after=5ms nth=9..",
           "noise feeder before=FF00 after=55",
           "noise feeder after=AA",
           "collision rs485",
           "collision rs485 with=00FF of=request",
           "exception turner code=4 at=250ms",
           "busy turner for=1s when=\"feeder.A.pulses > 12000\"",
           "early_reply rs485 chance=100%",
           "slow feeder by=3ms",
           "power_cut feeder at=1.5s for=200ms",
           "encoder_noise feeder.A counts=-4",
           "encoder_noise feeder.B counts=4 period=10ms",
           "stall feeder.A function=16 for=3ms address=0x2000",
           "slip feeder.A pulses=-3 every=1",
       }) {
    EXPECT_EQ(to_text(two(), find_fault(two(), fault_words(text))), text);
  }
}

TEST(FaultText, HasOtherSpellingsOfTheSame) {
  struct Case {
    std::string written, printed;
  };
  for (const auto& [written, printed] : std::vector<Case>{
           {"drop feeder of=reply", "drop feeder"},
           {"drop feeder nth=1..", "drop feeder"},
           {"drop feeder nth=5..5", "drop feeder nth=5"},
           {"drop feeder function=0x10 address=4098", "drop feeder function=16 address=0x1002"},
           {"drop feeder address=Aaxis_Speed", "drop feeder address=0x1002"},
           {"drop feeder address=feeder.Aaxis_Speed", "drop feeder address=0x1002"},
           {"drop rs485 address=turner.Aaxis_Pulse", "drop rs485 address=0x1000..0x1001"},
           {"drop feeder address=Aaxis_Pulse_H", "drop feeder address=0x1001"},
           {"drop feeder address=Aaxis_Pulse_L", "drop feeder address=0x1000"},
           {"drop feeder address=STATUS.4", "drop feeder address=0x0000"},
           {"noise feeder before=\"ff 0 0\" after=\"a b\"", ""},
           {"noise feeder before=\"ff 00\" after=\"ab cd\"", "noise feeder before=FF00 after=ABCD"},
           {"drop feeder chance=05.50%", "drop feeder chance=5.5%"},
           {"drop feeder at=0.25s", "drop feeder at=250ms"},
           {"stuck feeder.DIN_1 level=off", "stuck feeder.DIN_1 level=0"},
       }) {
    if (printed.empty()) {
      EXPECT_NE(refusal(two(), fault_words(written)), "") << written;
    } else {
      EXPECT_EQ(to_text(two(), find_fault(two(), fault_words(written))), printed);
    }
  }
}

TEST(FaultText, WithAWrongTriggerOrFieldIsRefused) {
  struct Case {
    std::string text, why;
  };
  const std::string hours = " is out of range; expected ";
  for (const auto& [text, why] : std::vector<Case>{
           {"drop rs458", "no device is called 'rs458'; expected one of feeder, turner"},
           {"drop feeder.A", "no device is called 'feeder.A'; the nearest is 'feeder'"},
           {"power_cut rs485", "no device is called 'rs485'; expected one of feeder, turner"},
           {"slow rs485 by=1ms", "no device is called 'rs485'; expected one of feeder, turner"},
           {"drop feeder nht=3", "drop: nht: is not a field here; the nearest is 'nth'"},
           {"drop feeder by=3ms", "drop: by: is not a field here; expected one such as 'nth'"},
           {"drop feeder nth=0", "drop: nth: 0 is out of range; expected 1 to 1000000000000"},
           {"drop feeder nth=5..3",
            "drop: nth: '5..3' is not valid; expected a range that does not end before it begins"},
           {"drop feeder nth=x",
            "drop: nth: 'x' is not valid; expected a whole number, or a range such as 3..7"},
           {"drop feeder nth=..3",
            "drop: nth: '..3' is not valid; expected a whole number, or a range such as 3..7"},
           {"drop feeder every=0", "drop: every: 0 is out of range; expected 1 to 1000000000000"},
           {"drop feeder times=0", "drop: times: 0 is out of range; expected 1 to 1000000000000"},
           {"drop feeder function=256", "drop: function: 256 is out of range; expected 0 to 255"},
           {"turn feeder.A in=2s", "turn: counts is missing; expected -1000000000 to 1000000000"},
           {"turn feeder.A counts=1 in=1500us",
            "turn: in: '1500us' is not valid; expected whole milliseconds"},
           {"turn feeder.A counts=1 for=1s", "turn: for: this fault has no duration; expected no `for`"},
           {"drop feeder station=248", "drop: station: 248 is out of range; expected 0 to 247"},
           {"drop feeder station=-1", "drop: station: -1 is out of range; expected 0 to 247"},
           {"drop feeder address=0x10000", "drop: address: 65536 is out of range; expected 0 to 65535"},
           {"drop feeder address=Aaxis_Sped",
            "drop: address: feeder: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'"},
           {"drop rs485 address=Aaxis_Speed",
            "drop: address: 'Aaxis_Speed' must begin with its device; expected one of feeder.Aaxis_Speed, "
            "turner.Aaxis_Speed"},
           {"drop feeder at=5", "drop: at: '5' is not valid; expected a duration such as 250ms"},
           {"drop feeder for=0s", "drop: for: 0s" + hours + "1ns to 8760h"},
           {"drop feeder at=9000h", "drop: at: 32400000s" + hours + "0s to 8760h"},
           {"drop feeder at=5ms from=1ms",
            "drop: at: cannot be combined with from and to; expected one or the other"},
           {"drop feeder at=5ms times=2", "drop: at: happens only once; expected it without times"},
           {"drop feeder from=5ms to=5ms", "drop: to: is not after from; expected a later time"},
           {"drop feeder seed=5", "drop: seed: has no effect without chance; expected both"},
           {"drop feeder chance=5",
            "drop: chance: '5' is not valid; expected more than 0% up to 100%, as in 0.5%"},
           {"drop feeder chance=0%",
            "drop: chance: '0%' is not valid; expected more than 0% up to 100%, as in 0.5%"},
           {"drop feeder chance=100.1%",
            "drop: chance: '100.1%' is not valid; expected more than 0% up to 100%, as in 0.5%"},
           {"drop feeder of=requests", "drop: of: 'requests' is not valid; expected reply, request or both"},
           {"drop feeder when=", "drop: when: '' is not valid; expected a condition of at most 2000 bytes"},
           {"delay feeder", "delay: by is missing; expected a duration such as 250ms"},
           {"truncate feeder keep=257", "truncate: keep: 257 is out of range; expected 0 to 256"},
           {"exception feeder code=0", "exception: code: 0 is out of range; expected 1 to 255"},
           {"noise feeder", "noise: before and after are missing; expected at least one of them"},
           {"noise feeder before=F", "noise: before: 'F' is not valid; expected bytes such as \"FF 00\""},
           {"noise feeder before=GG", "noise: before: 'GG' is not valid; expected bytes such as \"FF 00\""},
           {"noise feeder before=",
            "noise: before: '' is not valid; expected 1 to 256 bytes such as \"FF 00\""},
           {"encoder_noise feeder.A counts=1 period=3ms",
            "encoder_noise: period: '3ms' is not valid; expected an even number of milliseconds"},
           {"encoder_noise feeder.A counts=1 period=1ms",
            "encoder_noise: period: 1ms is out of range; expected 2ms to 8760h"},
           {"slip feeder.A pulses=1 for=3ms", "slip: for: this fault has no duration; expected no `for`"},
       }) {
    EXPECT_EQ(refusal(two(), fault_words(text)), why) << text;
  }
}

TEST(FaultForm, HasEveryKindAndField) {
  // Editors get the same fields that the reader accepts.
  std::vector<std::string> known;
  for (const FaultKindRow& kind : fault_kinds()) known.emplace_back(kind.name);
  for (const FaultKindRow& kind : fault_kinds()) {
    for (const FaultFieldRow& field : kind.fields) known.emplace_back(field.name);
  }
  for (const std::string& field : trigger_fields()) known.push_back(field);
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::vector<std::string> reported;
  for (const Key& row : kFaultKeys) reported.emplace_back(row.key);
  std::sort(reported.begin(), reported.end());
  EXPECT_EQ(reported, known);
}

TEST(FaultText, MayLeaveOutTheOnlyDevice) {
  EXPECT_EQ(to_text(one(), find_fault(one(), fault_words("stall B"))), "stall feeder.B");
  EXPECT_EQ(to_text(one(), find_fault(one(), fault_words("stuck DIN_4 level=1"))),
            "stuck feeder.DIN_4 level=1");
}

TEST(FaultText, IsRefusedWithOneLineThatSaysWhy) {
  struct Case {
    std::string text;
    std::string why;
  };
  for (const auto& [text, why] : std::vector<Case>{
           {"jam feeder.A", "'jam' is not a fault; expected one such as 'stall'"},
           {" feeder.A", "'' is not a fault; expected one such as 'stall'"},
           {"Stall feeder.A", "'Stall' is not a fault; the nearest is 'stall'"},
           {"stall feeder.C", "no axis of feeder is called 'C'; expected one of A, B"},
           {"stall feeder.DIN_1", "no axis of feeder is called 'DIN_1'; expected one of A, B"},
           {"stall feedr.A", "no device is called 'feedr'; the nearest is 'feeder'"},
           {"stall A", "'A' must begin with its device; expected one of feeder.A, turner.A"},
           {"stall ", "the device is missing; expected one of feeder, turner"},
           {"stall feeder.A one_in=5", "stall: one_in: is not a field here; expected one such as 'nth'"},
           {"alarm feeder.A level=1", "alarm: level: is not a field here; expected one such as 'nth'"},
           {"alarm feeder.A =0", "alarm: : is not a field here; expected one such as 'nth'"},
           {"lost_steps feeder.A", "lost_steps: one_in is missing; expected 1 to 1000000000000"},
           {"lost_steps feeder.A one_in=0",
            "lost_steps: one_in: 0 is out of range; expected 1 to 1000000000000"},
           {"lost_steps feeder.A one_in=-1",
            "lost_steps: one_in: -1 is out of range; expected 1 to 1000000000000"},
           {"lost_steps feeder.A one_in=1000000000001",
            "lost_steps: one_in: 1000000000001 is out of range; expected 1 to 1000000000000"},
           {"lost_steps feeder.A pulses=5",
            "lost_steps: pulses: is not a field here; expected one such as 'nth'"},
           {"lost_steps feeder.A one_in=5 pulses=5",
            "lost_steps: pulses: is not a field here; expected one such as 'nth'"},
           {"lost_steps feeder.A one_in=5 one_in=6",
            "lost_steps: one_in: is given twice; expected it only once"},
           {"slip feeder.A", "slip: pulses is missing; expected -1000000000 to 1000000000"},
           {"slip feeder.A pulses=1000000001",
            "slip: pulses: 1000000001 is out of range; expected -1000000000 to 1000000000"},
           {"slip feeder.A pulses=-9223372036854775807",
            "slip: pulses: -9223372036854775807 is out of range; expected -1000000000 to 1000000000"},
           {"stuck feeder.DIN_2", "stuck: level is missing; expected on or off"},
           {"stuck feeder.DIN_2 level=2", "stuck: level: 2 is out of range; expected 0 to 1"},
           {"stuck feeder.DIN_11 level=1", "no input of feeder is called 'DIN_11'; the nearest is 'DIN_1'"},
           {"stuck feeder.DOUT_1 level=1",
            "no input of feeder is called 'DOUT_1'; expected one such as 'DIN_0'"},
           {"stuck feeder.AIN_A level=1", "'feeder.AIN_A' cannot be stuck; expected a digital input"},
           {"stuck feeder.DIP1 level=1", "'feeder.DIP1' cannot be stuck; expected a digital input"},
           {"stuck feeder.A level=1", "no input of feeder is called 'A'; expected one such as 'DIN_0'"},
       }) {
    EXPECT_EQ(refusal(two(), fault_words(text)), why) << text;
  }
}

TEST(FaultText, WithControlCharactersIsRefusedInOneLine) {
  for (const FaultText& text : {FaultText{.kind = "st\nall", .place = "feeder.A", .fields = {}},
                                FaultText{.kind = "stall", .place = "fee\nder.A", .fields = {}},
                                FaultText{.kind = "stall", .place = "feeder.\nA", .fields = {}},
                                FaultText{.kind = "stall", .place = "feeder.A", .fields = {{"a\nb", "1"}}},
                                FaultText{.kind = "slip", .place = "feeder.A", .fields = {{"a\nb", "1"}}},
                                FaultText{.kind = "stuck", .place = "feeder.\nDIN_1", .fields = {}}}) {
    const std::string why = refusal(two(), text);
    EXPECT_NE(why, "");
    EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  }
}

}  // namespace fault_test
}  // namespace understudy::emulator::world
