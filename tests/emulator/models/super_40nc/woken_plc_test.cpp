// Everything that a settled PLC reads wakes it, no matter what changes it: each lamp follows its contact
// within two scans, even if everything is at rest and time advances in one step.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace woken_plc_test {

/// An action, a delay, and what the lamp Y15 shows then.
struct Step {
  std::string does;  // "ALM_X", "X0": an input; "M400", "D0": a write; "frame": one that cannot be read
  std::int32_t level;
  Tick ticks;
  bool lamp;
};

struct Case {
  const char* name;
  std::string condition;
  std::vector<Step> steps;
  std::vector<std::pair<std::string, Value>> set{};
  std::string more{};  // of the program
  std::map<std::string, std::string> choices{};
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

const Case kCases[] = {
    {"alarm", "LD M8139", {{"ALM_X", 1, 5000, true}, {"ALM_X", 0, 5000, false}}},
    {"alarm inverted", "LDI M8439", {{"ALM_U", 1, 5000, false}, {"ALM_U", 0, 5000, true}}},
    {"limit", "LD M8140", {{"X1", 1, 5000, true}, {"X1", 0, 5000, false}}},
    {"other limit", "LD M8241", {{"X5", 1, 5000, true}, {"X5", 0, 5000, false}}},
    {"DOG", "LD M8142", {{"X0", 1, 5000, true}, {"X0", 0, 5000, false}}},
    {"index", "LD M8150", {{"EZ_X", 1, 5000, true}, {"EZ_X", 0, 5000, false}}},
    {"in position", "LD M8155", {{"INP_X", 1, 5000, true}, {"INP_X", 0, 5000, false}}},
    {"emergency", "LD M8147", {{"CEMG", 1, 5000, true}, {"CEMG", 0, 5000, false}}},
    {"analog input", "LD> D8091 K100", {{"VR1", 900, 5000, true}, {"VR1", 5, 5000, false}}},
    {"receive errors", "LD> D8097 K0", {{"frame", 0, 5000, true}}},
    {"position", "LD> D8117 K100", {{"M8103", 1, 5000, true}, {"M8103", 0, 5000, true}}},
    {"running", "LD M8121", {{"M8103", 1, 5000, true}, {"M8103", 0, 5000, false}}},
    {"signal of END",
     "LD Y4",
     {{"M8100", 1, 100, true}, {"M8100", 0, 5000, false}},
     {{"D9192", 300}},
     "AREA X\nEND\n"},
    {"what a program writes last", "LD M7", {{"M8100", 1, 5000, true}}, {}, "AREA X\nSET M7\nEND\n"},
    {"what a program leaves", "LD= D7 K3", {{"M8100", 1, 5000, true}}, {}, "AREA X\nMOV K3 D7\nEND\n"},
    {"a scan of 5 ms",
     "LD M8139",
     {{"ALM_X", 1, 5000, true}, {"ALM_X", 0, 5000, false}},
     {},
     "",
     {{"scan_time", "5_ms"}}},
    {"an input and a scan of 5 ms",
     "LD X20",
     {{"X20", 1, 5003, true}, {"X20", 0, 5001, false}},
     {},
     "",
     {{"scan_time", "5_ms"}}},
};

class WokenPlc : public testing::TestWithParam<Case> {};

TEST_P(WokenPlc, LetsItsLampFollow) {
  const Case& c = GetParam();
  for (const bool by_single_ticks : {false, true}) {
    OneSuper40nc one({.set = c.set,
                      .program = "AREA PLC\n" + c.condition + "\nOUT Y15\nEND\n" + c.more,
                      .choices = c.choices});
    one.world().set_bulk_ticks(!by_single_ticks);
    one.run(500);
    for (const Step& step : c.steps) {
      if (step.does == "frame") {
        one.world().receive(0, world::hex("00 03 1E 00 00 02 00 00"));
      } else if (step.does[0] == 'M' || step.does[0] == 'D') {
        one.set(step.does, step.level);
      } else {
        one.input(step.does, step.level);
      }
      one.run(step.ticks);
      EXPECT_EQ(one.output("Y15"), step.lamp)
          << step.does << " = " << step.level << (by_single_ticks ? ", by single ticks" : ", in one piece");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(By, WokenPlc, testing::ValuesIn(kCases));

/// The time of the panel's picture at power-up ends while nothing else happens.
TEST(WokenPlc, SeesThePanelsTime) {
  OneSuper40nc one({.set = {{"D9007", 3000}}, .program = "AREA PLC\nLD M8502\nOUT Y15\nEND\n"});
  one.run(20'000);
  EXPECT_TRUE(one.on("M8502"));
  EXPECT_TRUE(one.output("Y15"));
}

/// If it reads nothing that changes with the pulses, ticks are skipped while an axis moves.
TEST(WokenPlc, SleepsWhileAnAxisMovesThatItDoesNotLookAt) {
  for (const auto& [condition, crosses] :
       {std::pair{"LD M8139", true}, std::pair{"LD X20", true}, std::pair{"LD M8155", true},
        std::pair{"LD> D8117 K100", false}, std::pair{"LD M8136", false}}) {
    OneSuper40nc one({.program = std::string("AREA PLC\n") + condition + "\nOUT Y15\nEND\n"});
    one.set("M8103", 1);
    one.run(2000);
    const std::uint64_t before = one.world().ticks_skipped();
    one.run(2000);
    EXPECT_EQ(one.world().ticks_skipped() - before > 1500, crosses) << condition;
  }
}

}  // namespace woken_plc_test
}  // namespace understudy::emulator::models::super_40nc
