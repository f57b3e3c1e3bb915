// What happens to motions that no step program waits for: each with each event, cell by cell (5.6 of our
// conclusions from 《M8 特殊接點的功用》, 《M8x 特殊接點的功用》 and 《STP 指令》).
#include <gtest/gtest.h>

#include <functional>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace events_test {

enum class Comes { on, ramp, stop };

/// The state of a running motion of X.
struct Motion {
  std::string name;
  std::function<void(OneSuper40nc&)> begin;
  std::function<void(OneSuper40nc&)> let_go;  // its contact OFF; none if it has none
  Comes contact_off = Comes::on;
  Comes plc_stop = Comes::on;
  bool is_wheel = false;
};

constexpr const char* kProgram =
    "AREA PLC\nLD M1\nPJG K1\nLD M2\nHOM K1\nLD M3\nDRV K900000\nLD M4\nSTP * * * *\nLD M5\nSTP K1\nEND\n"
    "AREA X\nVDRV K100\nEND\nAREA C\nMPG K1\nEND\n";

void set(OneSuper40nc& one, const char* name, Value value) { one.set(name, value); }

const std::vector<Motion>& motions() {
  const auto on = [](const char* name) { return [name](OneSuper40nc& one) { set(one, name, 1); }; };
  const auto off = [](const char* name) { return [name](OneSuper40nc& one) { set(one, name, 0); }; };
  static const std::vector<Motion> all{
      {"jog", on("M8103"), off("M8103"), Comes::ramp},
      {"jog key", on("M8560"), off("M8560"), Comes::ramp},
      {"PJG", on("M1"), off("M1"), Comes::ramp, Comes::ramp},
      {"HOME", on("M8105"), off("M8105")},
      {"PLC HOM", on("M2"), off("M2")},
      {"ZERO", on("M8106"), off("M8106")},
      {"wheel", on("M8110"), off("M8110"), Comes::stop, Comes::on, true},
      {"wheel by D8020", on("D8020"), off("D8020"), Comes::stop, Comes::on, true},
      {"PLC DRV", on("M3"), off("M3")},
      {"VDRV behind END", on("M8100"), nullptr},
  };
  return all;
}

bool moves(OneSuper40nc& one) { return one.on("M8120"); }

/// Running at a constant speed, or following.
void bring_about(OneSuper40nc& one, const Motion& motion) {
  set(one, "D8117", -900000);
  motion.begin(one);
  one.run(500);
  ASSERT_TRUE(moves(one)) << motion.name;
}

void expect(OneSuper40nc& one, Comes wanted, const std::string& what) {
  one.run(1);
  const double speed = one.device().axes()->speed_pps(0);
  EXPECT_EQ(moves(one), wanted != Comes::stop) << what;
  one.run(200);
  EXPECT_EQ(moves(one), wanted == Comes::on) << what << " at " << speed;
}

struct Event {
  std::string name;
  std::function<void(OneSuper40nc&)> happen;
  std::function<Comes(const Motion&)> comes;
};

const std::vector<Event>& events() {
  const auto write = [](const char* name) { return [name](OneSuper40nc& one) { set(one, name, 1); }; };
  const auto always = [](Comes what) { return [what](const Motion&) { return what; }; };
  static const std::vector<Event> all{
      {"contact OFF", [](OneSuper40nc&) {},  // by the motion
       [](const Motion& motion) { return motion.contact_off; }},
      {"M8006", write("M8006"), always(Comes::on)},
      {"PAUSE key", write("M8588"), always(Comes::on)},
      {"main PAUSE key", write("M8597"), always(Comes::on)},
      {"STP", write("M5"), always(Comes::stop)},
      {"STOP key", write("M8584"), always(Comes::stop)},
      {"M8x02", write("M8102"), always(Comes::stop)},
      {"STP of C", write("M4"), always(Comes::on)},
      {"main STOP key", write("M8596"), always(Comes::on)},
      {"M8002", write("M8002"), always(Comes::stop)},
      {"CEMG", [](OneSuper40nc& one) { one.input("CEMG", 1); }, always(Comes::stop)},
      {"M8004", write("M8004"), always(Comes::on)},
      {"ALM", [](OneSuper40nc& one) { one.input("ALM_X", 1); }, always(Comes::stop)},
      {"PLC to STOP", [](OneSuper40nc& one) { one.input("PLC_RUN", 0); },
       [](const Motion& motion) { return motion.plc_stop; }},
      {"reset of another axis", write("M8202"), always(Comes::on)},
      {"limit of the other side", [](OneSuper40nc& one) { one.input("X2", 1); }, always(Comes::on)},
      {"limit ahead", [](OneSuper40nc& one) { one.input("X1", 1); },
       [](const Motion& motion) { return motion.is_wheel ? Comes::on : Comes::stop; }},
  };
  return all;
}

TEST(Super40ncEvents, MeetMotionsAsTheTableSays) {
  for (const Motion& motion : motions()) {
    for (const Event& event : events()) {
      OneSuper40nc one({.program = kProgram});
      bring_about(one, motion);
      if (event.name == "contact OFF") {
        if (!motion.let_go) continue;
        motion.let_go(one);
      } else {
        event.happen(one);
      }
      expect(one, event.comes(motion), motion.name + ", " + event.name);
    }
  }
}

/// Nothing continues automatically when they go OFF while a level stays ON.
TEST(Super40ncEvents, LevelsNeedANewEdgeBehindAStop) {
  for (const char* stop : {"M8002", "M8102"}) {
    for (const char* level : {"M8103", "M8110", "M1"}) {
      OneSuper40nc one({.program = kProgram});
      one.set(level, 1);
      one.run(100);
      EXPECT_TRUE(moves(one));
      one.set(stop, 1);
      one.run(5);
      one.set(stop, 0);
      one.run(20);
      EXPECT_FALSE(moves(one)) << level << ", " << stop;
      one.set(level, 0);
      one.run(2);
      one.set(level, 1);
      one.run(2);
      EXPECT_TRUE(moves(one)) << level << ", " << stop;
    }
  }
}

TEST(Super40ncEvents, NothingStartsWhileInhibited) {
  for (const char* inhibit : {"M8004", "M8002", "M8102"}) {
    for (const Motion& motion : motions()) {
      OneSuper40nc one({.program = kProgram});
      one.set("D8117", -900000);
      one.set(inhibit, 1);
      one.run(2);
      motion.begin(one);
      one.run(20);
      EXPECT_FALSE(moves(one)) << motion.name << ", " << inhibit;
    }
  }
}

/// Both ports write at once; each gets its reply on its own line, and no 32-bit value is torn.
TEST(Super40ncEvents, TwoHostsAreServedSideBySide) {
  OneSuper40nc one({.program = kProgram});
  for (int i = 0; i < 50; ++i) {
    const std::string value = i % 2 == 0 ? "11 11 11 11" : "22 22 22 22";
    EXPECT_EQ(one.ask(OneSuper40nc::kRs485, "00 10 00 14 00 02 04 " + value), "00 10 00 14 00 02");
    EXPECT_EQ(one.ask(OneSuper40nc::kRs232, "00 03 00 14 00 02"), "00 03 04 " + value);
    EXPECT_EQ(one.came(OneSuper40nc::kRs485), "");
  }
}

}  // namespace events_test
}  // namespace understudy::emulator::models::super_40nc
