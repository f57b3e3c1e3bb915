// The filter of the EMG input, pulses at OUT_X that last, the switch INIT, and Pause (3.14, 7.3.9, 14.1, 10).
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace filters_and_pulses_test {

TEST(RsM8194hFilters, EmgGoesThroughThatOfEachAxis) {
  // FLn 5 is 4.096 ms, only for X.
  for (const int lasts : {3, 20}) {
    OneRsm rsm;
    rsm.send({"RSM_SET_FILTER X 1 5", "RSM_CONTINUE_MOVE XY 1000"});
    rsm.run(10);
    rsm.input(kEmergencyPin, true);
    rsm.run(2);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1) << "Y stops at once";
    EXPECT_EQ(rsm.get("DI_ALL_X") & 8, 0);
    EXPECT_EQ(rsm.get("DI_ALL_Y") & 8, 8);
    rsm.run(lasts - 2);
    rsm.input(kEmergencyPin, false);
    rsm.run(20);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), lasts == 3 ? 1 : 0);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), lasts == 3 ? 0 : 0x20);
  }
}

/// An input of DI_ALL or DI_SIGNAL, and the bit of FEn that filters it (3.14).
struct Filtered {
  Pin pin;
  const char* word;
  int bit;     // of the word
  int filter;  // of FEn
};
constexpr Filtered kFiltered[] = {
    {Pin::limit_plus, "DI_ALL_Z", 1, 0},
    {Pin::limit_minus, "DI_ALL_Z", 2, 0},
    {Pin::near_home, "DI_ALL_Z", 6, 0},
    {Pin::home, "DI_ALL_Z", 5, 0},
    {Pin::index, "DI_ALL_Z", 9, 1},
    {Pin::in_position, "DI_ALL_Z", 8, 2},
    {Pin::alarm, "DI_ALL_Z", 4, 2},
    {Pin::external_plus, "DI_SIGNAL_Z", 4, 3},
    {Pin::external_minus, "DI_SIGNAL_Z", 5, 3},
    {Pin::in3, "DI_ALL_Z", 7, 4},
};

TEST(RsM8194hFilters, EachInputIsDelayedByItsBitOfFenAndByFln) {
  constexpr Tick kDelays[] = {0, 0, 0, 1, 2, 4, 8, 16};
  for (const Filtered& each : kFiltered) {
    for (int bit = 0; bit < 5; ++bit) {
      for (int number = 0; number < 8; ++number) {
        OneRsm rsm;
        rsm.send("RSM_SET_ALARM Z 1 0");
        rsm.send("RSM_SET_FILTER Z " + std::to_string(1 << bit) + " " + std::to_string(number));
        rsm.run(3);
        const auto level = [&] { return rsm.get(each.word) >> each.bit & 1; };
        const Value before = level();
        rsm.pin(2, each.pin, true);
        Tick passes = 0;
        while (level() == before && passes < 30) {
          rsm.run(1);
          ++passes;
        }
        const Tick delay = bit == each.filter ? kDelays[number] : 0;
        EXPECT_EQ(passes, delay + 1) << each.word << "." << each.bit << ", FEn " << (1 << bit) << ", FLn "
                                     << number;
        // It must last as long as the filter's time.
        rsm.pin(2, each.pin, false);
        rsm.run(delay);
        rsm.pin(2, each.pin, true);
        for (int i = 0; i < 20 && delay > 0; ++i) {
          EXPECT_NE(level(), before);
          rsm.run(1);
        }
      }
    }
  }
}

TEST(RsM8194hFilters, ExternalDrivesLoseWhatIsTooShort) {
  OneRsm rsm;
  rsm.send({"RSM_SET_SV X 8000", "RSM_SET_V X 8000", "RSM_SET_FILTER X 8 6", "RSM_EXD_FP X 10"});
  rsm.run(3);
  const auto edge_after = [&](int edges, Tick ticks) {
    rsm.world().set_external_input(0, terminal(0, Pin::external_plus), edges);
    rsm.run(ticks);
  };
  edge_after(1, 5);  // FLn 6: 8.192 ms
  edge_after(2, 30);
  EXPECT_EQ(rsm.get("LP_X"), 0);
  edge_after(3, 8);
  EXPECT_EQ(rsm.get("LP_X"), 0);
  rsm.run(10);
  EXPECT_EQ(rsm.get("LP_X"), 10);
  edge_after(4, 30);
  edge_after(5, 3);
  // Without the filter, the level that it held back takes effect.
  rsm.send("RSM_SET_FILTER X 0 0");
  edge_after(6, 30);
  EXPECT_EQ(rsm.get("LP_X"), 20);
}

TEST(RsM8194hPulses, LastAsLongAsPulseWidthSays) {
  constexpr std::pair<int, Tick> kWidths[] = {{0, 0}, {3, 0}, {4, 1}, {5, 2}, {6, 10}, {7, 20}};
  for (const auto& [code, ticks] : kWidths) {
    for (const int level : {0, 1}) {
      OneRsm rsm;
      rsm.send("RSM_SET_OUT X " + std::to_string(level) + " " + std::to_string(code));
      rsm.send({"RSM_SYNC_ACTION X X 0x20 0 0 0 1 0 0 0 0 0", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 5"});
      const bool at_rest = level == 0;
      EXPECT_EQ(rsm.ports().output(kFirstOut), at_rest);
      Tick active = 0;
      for (int i = 0; i < 300; ++i) {
        rsm.run(1);
        active += rsm.ports().output(kFirstOut) != at_rest ? 1 : 0;
      }
      EXPECT_EQ(active, ticks) << code;
      EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 1);
    }
  }
}

TEST(RsM8194hPulses, AreCountedAtTheirTwoTerminalsAlone) {
  OneRsm rsm;
  rsm.send({"RSM_SYNC_ACTION X XY 0x20 0 0 0 1 0 0 0 0 0", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 5"});
  rsm.run(500);
  for (int i = 0; i < kFirstDo; ++i) {
    const bool gives_pulses = i == kFirstOut || i == kFirstOut + 1;
    EXPECT_EQ(rsm.ports().output_pulses(i), gives_pulses ? 1 : 0) << i;
  }
}

TEST(RsM8194hUnmodelled, MeaningsOfCommandsAreReportedOnce) {
  struct Case {
    const char* command;
    const char* reported;  // begins like this; nothing there if it is empty
  };
  constexpr Case kCases[] = {
      {"RSM_SET_FILTER XY 1 2", "rsm: a filter below 1.024 ms is not modelled: "},
      {"RSM_SET_FILTER XY 31 0", "rsm: a filter below 1.024 ms is not modelled: "},
      {"RSM_SET_FILTER XY 0 0", ""},
      {"RSM_SET_FILTER XY 1 3", ""},
      {"RSM_SET_OUT X 0 3", "rsm: PulseWidth below 1 ms is not modelled: "},
      {"RSM_SET_OUT X 1 4", ""},
      {"RSM_LINE_SCAN X 0 0 3 -9", "rsm: PulseWidth below 1 ms is not modelled: "},
      {"RSM_LINE_SCAN X 0 1 4 -9", ""},
  };
  for (const Case& each : kCases) {
    OneRsm rsm;
    std::vector<std::string> reported;
    rsm.device().set_log([&](const std::string& text) { reported.push_back(text); });
    rsm.send({each.command, each.command});
    rsm.run(3);
    const bool is_told = each.reported[0] != 0;
    ASSERT_EQ(reported.size(), is_told ? 1U : 0U) << each.command;
    if (is_told) {
      EXPECT_TRUE(reported[0].starts_with(each.reported)) << reported[0];
    }
  }
}

TEST(RsM8194hInit, IsAsPowerUpHasFoundIt) {
  OneRsm rsm({.program = "MP 1\nRSM_MACRO_SET_VAR VAR1 1\nEND\nTRIGGER 8.0 on MP1\n"});
  rsm.set("FRNET_EVENT", 1);
  rsm.input(kInitSwitch, true);
  rsm.run(10);
  EXPECT_EQ(rsm.rsm().addressing(1), Addressing::execute_and_reply);
  rsm.world().switch_power(0, false);
  rsm.run(10);
  rsm.world().switch_power(0, true);
  rsm.input(kFirstDi, true);
  rsm.run(20);
  EXPECT_EQ(rsm.rsm().addressing(1), Addressing::ignore);
  EXPECT_EQ(rsm.get("VAR1"), 0);
  rsm.input(kInitSwitch, false);
  rsm.run(10);
  EXPECT_EQ(rsm.rsm().addressing(1), Addressing::ignore);
  rsm.world().switch_power(0, false);
  rsm.run(10);
  rsm.world().switch_power(0, true);
  rsm.run(20);
  EXPECT_EQ(rsm.rsm().addressing(1), Addressing::execute_and_reply);
  EXPECT_EQ(rsm.get("VAR1"), 1);
}

}  // namespace filters_and_pulses_test
}  // namespace understudy::emulator::models::rs_m8194h
