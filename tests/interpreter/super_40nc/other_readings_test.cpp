// What the manual leaves open, read otherwise: each option of the languages makes the difference that it
// names. Those about what is loaded are in listing_test.cpp.
#include <gtest/gtest.h>

#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace other_readings_test {

Running running(std::string text, const Options& options) {
  for (char& letter : text) {
    if (letter == ';') letter = '\n';
  }
  Running made(text + "\nEND\n", options);
  made.run_plc();
  return made;
}

TEST(Super40ncOtherReadings, OfNumbers) {
  Options options;
  options.fill_beyond = Options::FillBeyond::does_nothing;
  options.division_by_zero = Options::DivisionByZero::gives_zero;
  options.product = Options::Product::saturates;
  Running plc = running(
      "AREA PLC;LD M8003;FMV K5 D998 K3;DIV K7 K0 D0;MUL K65536 K65536 D3;MUL K-65536 K65536 D4", options);
  plc.machine.write(d(0), 5);
  plc.machine.write(d(1), 5);
  plc.scan();
  EXPECT_EQ(plc.machine.value(d(998)), 0);
  EXPECT_EQ(plc.machine.value(d(0)), 0);
  EXPECT_EQ(plc.machine.value(d(1)), 0);
  EXPECT_EQ(plc.machine.value(d(3)), INT32_MAX);
  EXPECT_EQ(plc.machine.value(d(4)), INT32_MIN);
  EXPECT_EQ(plc.machine.codes.size(), 2u);
}

TEST(Super40ncOtherReadings, OfTimersInLargerUnits) {
  Options options;
  options.timer_unit_ms = 10;
  Running plc = running("AREA PLC;LD X0;OUT T0 K5", options);
  plc.machine.set(x(0), true);
  int ms = 0;
  for (; !plc.machine.contact(t(0)); ++ms) plc.scan();
  EXPECT_EQ(ms, 51);  // the scan that turns it ON, and five units
}

TEST(Super40ncOtherReadings, OfMotionInThePlc) {
  Options options;
  options.motions_need_edge = false;
  Running plc = running("AREA PLC;LD X0;DRV K1;HOM K1", options);
  plc.machine.registers[named::kOwnedAxes] = 0;
  plc.machine.set(x(0), true);
  for (int i = 0; i < 3; ++i) plc.scan();
  EXPECT_EQ(plc.machine.log.size(), 6u);
}

TEST(Super40ncOtherReadings, OfSubroutines) {
  Options options;
  options.loose_return = Options::LooseReturn::is_ignored;
  Running loose = running("AREA C;RET;SET Y0", options);
  loose.start(Area::c);
  loose.tick();
  EXPECT_TRUE(loose.machine.contact(y(0)));

  options = {};
  options.no_passes = Options::NoPasses::mean_endless;
  Running endless = running("AREA C;CAL K1 K0;END;LAB K1;INC D0;RET", options);
  endless.start(Area::c);
  endless.tick(100);
  EXPECT_EQ(endless.machine.value(d(0)), 99);  // RET ends a slice
  Running skipped = running("AREA C;CAL K1 K0;SET Y0;END;LAB K1;INC D0;RET", {});
  skipped.start(Area::c);
  skipped.tick();
  EXPECT_TRUE(skipped.machine.contact(y(0)));

  for (const int depth : {8, 16}) {
    options = {};
    options.call_depth = depth;
    Running deep = running("AREA C;LAB K1;INC D0;CAL K1", options);
    deep.start(Area::c);
    deep.tick(100);
    EXPECT_EQ(deep.machine.value(d(0)), depth + 1);
    EXPECT_EQ(deep.machine.codes.at(0)[0], 5);
  }
}

TEST(Super40ncOtherReadings, OfSlicesAndStarts) {
  Options options;
  options.slice = 1;
  Running slow = running("AREA C;INC D0;INC D0;INC D0", options);
  slow.start(Area::c);
  slow.tick(2);
  EXPECT_EQ(slow.machine.value(d(0)), 2);

  options = {};
  options.fresh_start = Options::FreshStart::every_start;
  Running fresh = running("AREA C;INCC;WAT X0;DRV K1", options);
  fresh.start(Area::c);
  fresh.tick();
  fresh.take(Event::contact_off, Area::c);
  fresh.start(Area::c);
  EXPECT_EQ(fresh.state(Area::c).targets, Targets::absolute);

  options = {};
  options.empty_program = Options::EmptyProgram::is_an_error;
  Running empty("AREA C\n", options);
  empty.start(Area::c);
  EXPECT_EQ(empty.machine.codes.at(0)[0], 6);
  EXPECT_FALSE(empty.machine.special_contact(8000));

  options = {};
  options.rotation_0_waits = false;
  Running turning = running("AREA C;VDRV K0;SET Y0", options);
  turning.start(Area::c);
  turning.tick();
  EXPECT_TRUE(turning.machine.contact(y(0)));

  options = {};
  options.bases = Options::Bases::older;
  Running old = running("AREA X;NOP;RET", options);
  old.start(Area::x);
  old.tick();
  EXPECT_EQ(old.machine.codes.at(0), (std::array<int, 3>{5, 501, 0}));
}

TEST(Super40ncOtherReadings, OfStackDepths) {
  Options options;
  options.stack_depth = 8;
  std::string text = "AREA PLC\n";
  for (int i = 0; i < 9; ++i) text += "LD X0\n";
  EXPECT_FALSE(check(text + "OUT Y0\nEND\n", options).program);
  options.stack_depth = 11;
  EXPECT_TRUE(check(text + "OUT Y0\nEND\n", options).program);
  options = {};
  options.if_depth = 1;
  EXPECT_FALSE(check("AREA C\nLD X0\nIF\nLD X1\nIF\nENDI\nENDI\nEND\n", options).program);
}

/// Nothing clears the blocks of earlier rungs, but the oldest of more than sixteen falls off.
TEST(Super40ncOtherReadings, TheOldestBlockFallsOff) {
  for (const int more : {15, 16}) {
    std::string text = "AREA PLC\nLD X0\nOUT Y0\n";
    for (int i = 0; i < more; ++i) text += "LD X1\nOUT Y1\n";
    for (int i = 0; i < more; ++i) text += "ORB\n";
    Running plc(text + "OUT Y2\nEND\n");
    plc.run_plc();
    plc.machine.set(x(0), true);
    plc.scan();
    EXPECT_EQ(plc.machine.contact(y(2)), more == 15);
  }
}

}  // namespace other_readings_test
}  // namespace understudy::interpreter::super_40nc
