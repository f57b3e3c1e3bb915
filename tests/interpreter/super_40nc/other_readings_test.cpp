// Options about points that the manual leaves open: each option of the languages makes the difference that it
// describes. listing_test.cpp has those about loading.
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
  options.choose(option("fmv_end", "nothing"));
  options.choose(option("division_by_zero", "zero"));
  options.choose(option("product_size", "saturates"));
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

TEST(Super40ncOtherReadings, OfSumsAndQuotients) {
  for (const bool is_other : {false, true}) {
    Options options;
    if (is_other) options.choose(option("sum_size", "saturates"));
    if (is_other) options.choose(option("division_rounding", "downwards"));
    Running plc = running(
        "AREA PLC;LD M8003;ADD K2147483647 D9 D0;SUB K-2147483648 D9 D1;ADD K3 D9 D2;DIV K-17 K5 D3;DIV K17 "
        "K-5 "
        "D5;DIV K17 K5 D7;DIV K-15 K5 D10",
        options);
    plc.machine.write(d(9), 2);
    plc.scan();
    EXPECT_EQ(plc.machine.value(d(0)), is_other ? INT32_MAX : INT32_MIN + 1);
    EXPECT_EQ(plc.machine.value(d(1)), is_other ? INT32_MIN : INT32_MAX - 1);
    EXPECT_EQ(plc.machine.value(d(2)), 5);
    EXPECT_EQ(plc.machine.value(d(3)), is_other ? -4 : -3);
    EXPECT_EQ(plc.machine.value(d(4)), is_other ? 3 : -2);
    EXPECT_EQ(plc.machine.value(d(5)), is_other ? -4 : -3);
    EXPECT_EQ(plc.machine.value(d(6)), is_other ? -3 : 2);
    EXPECT_EQ(plc.machine.value(d(7)), 3);
    EXPECT_EQ(plc.machine.value(d(8)), 2);
    EXPECT_EQ(plc.machine.value(d(10)), -3);
    EXPECT_EQ(plc.machine.value(d(11)), 0);
  }
}

TEST(Super40ncOtherReadings, OfWritesToTimers) {
  for (const bool is_ignored : {false, true}) {
    Options options;
    if (is_ignored) options.choose(option("timer_write", "ignored"));
    Running plc = running("AREA PLC;LD X0;OUT T0 K1000", options);
    const Operand value{Letter::t, 0};
    const auto write = [&](std::int32_t ms) {
      plc.machine.cells()[value_cell(plc.machine.layout(), value)] = static_cast<std::uint32_t>(ms);
    };
    plc.machine.set(x(0), true);
    for (int i = 0; i < 11; ++i) plc.scan();
    write(500);
    plc.scan();
    EXPECT_EQ(plc.machine.value(value), is_ignored ? 11 : 501);
    fast_forward(plc.plc, plc.ladder, plc.machine, 20, plc.options);
    EXPECT_EQ(plc.machine.value(value), is_ignored ? 31 : 521);
    write(5);
    plc.scan();
    EXPECT_EQ(plc.machine.value(value), is_ignored ? 32 : 6);
    // From STOP to RUN it continues, and OFF it is 0.
    super_40nc::stop(plc.plc, plc.machine);
    plc.run_plc();
    plc.scan();
    EXPECT_EQ(plc.machine.value(value), is_ignored ? 33 : 7);
    plc.machine.set(x(0), false);
    plc.scan();
    plc.machine.set(x(0), true);
    plc.scan();
    plc.scan();
    EXPECT_EQ(plc.machine.value(value), 1);
  }
}

TEST(Super40ncOtherReadings, OfContactsThatGoOffAndStr) {
  for (const bool stops : {false, true}) {
    Options options;
    if (stops) options.choose(option("axis_contact_off", "stops_the_program"));
    Running off = running("AREA X;NOP;TMR K100;END;AREA C;NOP;TMR K100", options);
    off.start(Area::x);
    off.start(Area::c);
    off.tick(3);
    off.machine.set_special_contact(8100, false);
    off.machine.set_special_contact(8000, false);
    off.tick();
    EXPECT_EQ(off.phase(Area::x), stops ? Phase::idle : Phase::paused);
    EXPECT_EQ(off.state(Area::x).step, stops ? 0 : 1);
    EXPECT_EQ(off.phase(Area::c), Phase::paused) << "0 is PAUSE in the manual's table";

    options = {};
    if (stops) options.choose(option("str_running", "begins_anew"));
    Running anew = running("AREA X;INC D0;TMR K100;END;AREA Y;TMR K5;STR K1", options);
    anew.start(Area::x);
    anew.start(Area::y);
    anew.tick(20);
    EXPECT_EQ(anew.machine.value(d(0)), stops ? 2 : 1);
    EXPECT_EQ(anew.phase(Area::x), Phase::waiting);
  }
}

TEST(Super40ncOtherReadings, OfRpm0) {
  for (const bool keeps : {false, true}) {
    Options options;
    if (keeps) options.choose(option("rpm_not_positive", "keeps_the_speed"));
    Running rpm =
        running("AREA C;RPM K200 K300;RPM K0 K-5 K7;TMR K9;END;AREA PLC;LD M8003;RPM K200;RPM K0", options);
    rpm.start(Area::c);
    rpm.tick();
    rpm.scan();
    EXPECT_EQ(rpm.state(Area::c).rpm[0], keeps ? 200 : 0);
    EXPECT_EQ(rpm.state(Area::c).rpm[1], keeps ? 300 : -5);
    EXPECT_EQ(rpm.state(Area::c).rpm[2], 7);
    EXPECT_EQ(rpm.plc.rpm[0], keeps ? 200 : 0);
  }
}

TEST(Super40ncOtherReadings, OfBlocksBehindAnOutputAndLabelsOfAll) {
  Options options;
  options.choose(option("block_stack", "each_output_leaves_the_result_alone"));
  const auto codes = [&](const std::string& text) {
    std::string message;
    const Checked checked = check(text, options);
    for (const Diagnostic& error : checked.errors) message += to_string(error) + ";";
    for (const Diagnostic& warning : checked.warnings) message += "(" + to_string(warning) + ")";
    return message;
  };
  EXPECT_EQ(codes("AREA PLC\nLD X0\nLD X1\nOUT Y0\nANB\nOUT Y1\nEND\n"),
            "5:1: ANB joins blocks that were not begun; expected two blocks before it;");
  // The idioms of the manual's samples still work.
  EXPECT_EQ(codes("AREA PLC\nLD X0\nOUT Y0\nAND X1\nOUT Y1\nLD X2\nOR X3\nANB\nOUT Y2\nEND\n"), "");
  EXPECT_EQ(codes("AREA PLC\nLD X0\nMPS\nAND X1\nOUT Y0\nMRD\nLD X2\nOR X3\nANB\nOUT Y1\nMPP\nOUT Y2\nEND\n"),
            "");

  options = {};
  options.choose(option("label_scope", "the_first_area_has_it"));
  const std::string text = "AREA C\nNOP\nLAB K1\nEND\nAREA X\nLAB K2\nLAB K1\nEND\n";
  EXPECT_EQ(codes(text), "(7:1: label K1 also exists in area C; expected one)");
  EXPECT_EQ(check(text, options).warnings.at(0).step, 1501);
  EXPECT_EQ(check(text, options).warnings.at(0).other_step, 1);
  options.choose(option("duplicate_label", "refused_at_load"));
  EXPECT_EQ(codes(text), "7:1: label K1 also exists in area C; expected one;");
}

TEST(Super40ncOtherReadings, OfTimersInLargerUnits) {
  Options options;
  options.choose(option("timer_unit", "10ms"));
  Running plc = running("AREA PLC;LD X0;OUT T0 K5", options);
  plc.machine.set(x(0), true);
  int ms = 0;
  for (; !plc.machine.contact(t(0)); ++ms) plc.scan();
  EXPECT_EQ(ms, 51);  // the scan that turns it ON, and five units
}

TEST(Super40ncOtherReadings, OfMotionInThePlc) {
  Options options;
  options.choose(option("instruction_edges", "every_scan"));
  Running plc = running("AREA PLC;LD X0;DRV K1;HOM K1", options);
  plc.machine.registers[named::kOwnedAxes] = 0;
  plc.machine.set(x(0), true);
  for (int i = 0; i < 3; ++i) plc.scan();
  EXPECT_EQ(plc.machine.log.size(), 6u);
}

TEST(Super40ncOtherReadings, OfSubroutines) {
  Options options;
  options.choose(option("ret_without_cal", "ignored"));
  Running loose = running("AREA C;RET;SET Y0", options);
  loose.start(Area::c);
  loose.tick();
  EXPECT_TRUE(loose.machine.contact(y(0)));

  options = {};
  options.choose(option("cal_of_d", "compared_at_each_ret"));
  for (const int last : {1, 4}) {  // below the passes that have begun, and above
    Running compared = running(
        "AREA C;MOV K2 D1;CAL K1 D1;SET Y0;END;LAB K1;INC D0;MOV K" + std::to_string(last) + " D1;RET",
        options);
    compared.start(Area::c);
    compared.tick(20);
    EXPECT_EQ(compared.machine.value(d(0)), last);
    EXPECT_TRUE(compared.machine.contact(y(0)));
  }

  options = {};
  options.choose(option("cal_count", "endless"));
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
    if (depth == 8) options.choose(option("cal_depth", "8"));
    Running deep = running("AREA C;LAB K1;INC D0;CAL K1", options);
    deep.start(Area::c);
    deep.tick(100);
    EXPECT_EQ(deep.machine.value(d(0)), depth + 1);
    EXPECT_EQ(deep.machine.codes.at(0)[0], 5);
  }
}

TEST(Super40ncOtherReadings, OfSlicesAndStarts) {
  Options options;
  options.choose(option("slice_length", "1_line"));
  Running slow = running("AREA C;INC D0;INC D0;INC D0", options);
  slow.start(Area::c);
  slow.tick(2);
  EXPECT_EQ(slow.machine.value(d(0)), 2);

  options = {};
  options.choose(option("fresh_start", "every_start"));
  Running fresh = running("AREA C;INCC;WAT X0;DRV K1", options);
  fresh.start(Area::c);
  fresh.tick();
  fresh.take(Event::contact_off, Area::c);
  fresh.start(Area::c);
  EXPECT_EQ(fresh.state(Area::c).targets, Targets::absolute);

  options = {};
  options.choose(option("empty_program", "is_an_error"));
  Running empty("AREA C\n", options);
  empty.start(Area::c);
  EXPECT_EQ(empty.machine.codes.at(0)[0], 6);
  EXPECT_FALSE(empty.machine.special_contact(8000));

  options = {};
  options.choose(option("vdrv_zero_wait", "goes_on"));
  Running turning = running("AREA C;VDRV K0;SET Y0", options);
  turning.start(Area::c);
  turning.tick();
  EXPECT_TRUE(turning.machine.contact(y(0)));

  options = {};
  options.choose(option("area_bases", "older"));
  Running old = running("AREA X;NOP;RET", options);
  old.start(Area::x);
  old.tick();
  EXPECT_EQ(old.machine.codes.at(0), (std::array<int, 3>{5, 501, 0}));
}

TEST(Super40ncOtherReadings, OfStackDepths) {
  Options options;
  options.choose(option("stack_depth", "8"));
  std::string text = "AREA PLC\n";
  for (int i = 0; i < 9; ++i) text += "LD X0\n";
  EXPECT_FALSE(check(text + "OUT Y0\nEND\n", options).program);
  options.choose(option("stack_depth", "11"));
  EXPECT_TRUE(check(text + "OUT Y0\nEND\n", options).program);
  options = {};
  options.choose(option("if_depth", "1"));
  EXPECT_FALSE(check("AREA C\nLD X0\nIF\nLD X1\nIF\nENDI\nENDI\nEND\n", options).program);
}

/// Nothing clears the blocks of earlier rungs, but of more than sixteen the oldest is lost.
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
