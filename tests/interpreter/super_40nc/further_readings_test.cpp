// More options about points that the manual leaves open: limits and corner cases.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace further_readings_test {

std::string lines(std::string text) {
  for (char& letter : text) {
    if (letter == ';') letter = '\n';
  }
  return text + "\nEND\n";
}

/// Those at RUN as well.
Running running(const std::string& text, const Options& options) {
  Running made(lines(text), options);
  run(made.plc, made.ladder, made.machine, made.options);
  return made;
}

bool is_loaded(const std::string& text, const Options& options) {
  return check(text, options).program.has_value();
}

TEST(Super40ncFurtherReadings, OfWhatIsLoaded) {
  struct Case {
    std::string text;
    Options::Named option;
    bool with, without;  // whether it is loaded with the option, and with the first one
  };
  const Case cases[] = {
      {"AREA X\nSET Y0\n", option("missing_end", "as_if_it_had_one"), true, false},
      {"AREA PLC\nSET Y0\n", option("missing_end", "as_if_it_had_one"), false,
       false},  // has no condition either
      {"AREA PLC\nLD X0\nOUT T0 D1\nEND\n", option("preset_operand", "k_alone"), false, true},
      {"AREA PLC\nLD X0\nOUT C0 K1\nEND\n", option("preset_operand", "k_alone"), true, true},
      {"AREA C\nF\nEND\n", option("unset_fields", "line_is_skipped"), true, false},
      {"AREA U\nTMR *\nEND\n", option("unset_fields", "line_is_skipped"), true, false},
      {"AREA C\nCWR K1 K2\nEND\n", option("unset_fields", "line_is_skipped"), true, false},
      {"AREA C\nCCWR K1 K2 *\nEND\n", option("unset_fields", "line_is_skipped"), true, false},
      {"AREA C\nJMP\nEND\n", option("unset_fields", "line_is_skipped"), false, false},
      {"AREA C\nMOV K1\nEND\n", option("unset_fields", "line_is_skipped"), false, false},
      {"AREA C\nC3P K1 K2 K3\nEND\n", option("c3p_unset", "refused_at_load"), false, true},
      {"AREA C\nC3P K1 K2 K3 K4\nEND\n", option("c3p_unset", "refused_at_load"), true, true},
  };
  for (const Case& each : cases) {
    Options options;
    EXPECT_EQ(is_loaded(each.text, options), each.without) << each.text;
    options.choose(each.option);
    EXPECT_EQ(is_loaded(each.text, options), each.with) << each.text;
  }
}

TEST(Super40ncFurtherReadings, OfMissingEnds) {
  Options options;
  options.choose(option("missing_end", "as_if_it_had_one"));
  Running step("AREA X\nINC D0\nTMR K2\n", options);
  step.start(Area::x);
  step.tick(9);
  EXPECT_EQ(step.machine.value(d(0)), 1);
  EXPECT_EQ(step.phase(Area::x), Phase::idle);
  EXPECT_TRUE(step.machine.codes.empty());
  Running plc("AREA PLC\nLD X0\nOUT Y0\n", options);
  plc.run_plc();
  plc.machine.set(x(0), true);
  plc.scan();
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(y(0)));
}

TEST(Super40ncFurtherReadings, OfLinesWithoutValues) {
  Options options;
  options.choose(option("unset_fields", "line_is_skipped"));
  Running skipped = running("AREA C;F K700;F *;TMR *;CWR K1 K2 *;SET Y0;TMR K9", options);
  skipped.machine.registers[named::kOwnedAxes] = 4;
  skipped.start(Area::c);
  skipped.tick();
  EXPECT_TRUE(skipped.machine.contact(y(0)));
  EXPECT_EQ(skipped.machine.special_register(named::kFeed), 700);
  EXPECT_TRUE(skipped.machine.codes.empty());
}

TEST(Super40ncFurtherReadings, OfEdgesOfOneBit) {
  for (const bool is_shared : {false, true}) {
    Options options;
    if (is_shared) options.choose(option("edge_memory", "the_bit_so_the_first_takes_the_edge"));
    Running plc = running("AREA PLC;LDP X0;INC D0;LDP X0;INC D1;LDF X0;INC D2;LDP X1;ORP X0;INC D3", options);
    for (const bool on : {true, true, false, false, true}) {
      plc.machine.set(x(0), on);
      plc.scan();
    }
    EXPECT_EQ(plc.machine.value(d(0)), 2);
    EXPECT_EQ(plc.machine.value(d(1)), is_shared ? 0 : 2);
    EXPECT_EQ(plc.machine.value(d(2)), is_shared ? 0 : 1) << "LDP has seen it go OFF";
    EXPECT_EQ(plc.machine.value(d(3)), is_shared ? 0 : 2);
  }
}

TEST(Super40ncFurtherReadings, OfTimersAndCounters) {
  for (const bool is_other : {false, true}) {
    Options options;
    if (is_other) options.choose(option("timer_past_preset", "counts_on"));
    if (is_other) options.choose(option("preset_not_positive", "never_closes"));
    if (is_other) options.choose(option("kept_timers", "all_timers_keep_it"));
    Running plc = running("AREA PLC;LD X0;OUT T0 K5;OUT T1 K0;OUT C0 K-1;LD X1;RST T0", options);
    const Operand value{Letter::t, 0};
    plc.machine.set(x(0), true);
    for (int i = 0; i < 11; ++i) plc.scan();
    EXPECT_EQ(plc.machine.value(value), is_other ? 10 : 5);
    EXPECT_TRUE(plc.machine.contact(t(0)));
    EXPECT_EQ(plc.machine.contact(t(1)), !is_other);
    EXPECT_EQ(plc.machine.contact(c(0)), !is_other);
    plc.machine.set(x(0), false);
    plc.scan();
    EXPECT_EQ(plc.machine.value(value), is_other ? 10 : 0);
    EXPECT_EQ(plc.machine.contact(t(0)), is_other);
    plc.machine.set(x(1), true);
    plc.scan();
    EXPECT_EQ(plc.machine.value(value), 0);
    EXPECT_FALSE(plc.machine.contact(t(0)));
  }
}

TEST(Super40ncFurtherReadings, OfModesInThePlc) {
  for (const bool needs : {false, true}) {
    Options options;
    if (needs) options.choose(option("instruction_edges", "all_on_the_edge"));
    Running plc = running("AREA PLC;LD X0;PSET K1;STP K1", options);
    plc.scan();
    plc.machine.set(x(0), true);
    for (int i = 0; i < 3; ++i) plc.scan();
    const auto count = [&](std::string_view what) {
      return std::count_if(plc.machine.log.begin(), plc.machine.log.end(),
                           [&](const std::string& line) { return line.find(what) != std::string::npos; });
    };
    EXPECT_EQ(count("PSET"), needs ? 1 : 3);
    EXPECT_EQ(count("stop"), needs ? 1 : 3);
  }
  for (const bool stay : {false, true}) {
    Options options;
    if (stay) options.choose(option("plc_modes", "stay"));
    Running plc = running("AREA PLC;LD X0;INCC;RPM K7", options);
    plc.machine.set(x(0), true);
    plc.scan();
    plc.machine.set(x(0), false);
    stop(plc.plc, plc.machine);
    run(plc.plc, plc.ladder, plc.machine, plc.options);
    EXPECT_EQ(plc.plc.targets, stay ? Targets::relative : Targets::absolute);
    EXPECT_EQ(plc.plc.rpm[0], stay ? 7 : plc.machine.rpm_at_power_up(0));
  }
}

TEST(Super40ncFurtherReadings, OfRanges) {
  for (const bool clears_all : {false, true}) {
    Options options;
    options.choose(clears_all ? option("zrst_swapped", "all_between")
                              : option("zrst_swapped", "the_first_alone"));
    Running zrst = running("AREA X;FMV K7 D0 K9;ZRST D6 D3;ZRST D1 D1;TMR K9", options);
    zrst.start(Area::x);
    zrst.tick();
    for (int i = 0; i < 9; ++i) {
      const bool is_cleared = i == 6 || i == 1 || (clears_all && i >= 3 && i <= 6);
      EXPECT_EQ(zrst.machine.value(d(i)), is_cleared ? 0 : 7) << i;
    }
  }
  Options options;
  options.choose(option("div_at_the_end", "nothing_with_a_code"));
  Running div = running("AREA X;DIV K17 K5 D999;DIV K17 K5 D997;TMR K9", options);
  div.start(Area::x);
  div.tick();
  EXPECT_EQ(div.machine.value(d(999)), 0);
  EXPECT_EQ(div.machine.value(d(997)), 3);
  EXPECT_EQ(div.machine.value(d(998)), 2);
  EXPECT_EQ(div.machine.codes.at(0)[0], 9);
}

TEST(Super40ncFurtherReadings, OfStepsAndWaits) {
  Options options;
  options.choose(option("pointer_inside", "goes_on_with_the_next_line"));
  Running inside = running("AREA X;MOV K1 D0;INC D1;TMR K9", options);
  inside.programs().set_step(Area::x, 1);
  inside.start(Area::x);
  inside.tick();
  EXPECT_EQ(inside.machine.value(d(0)), 0);
  EXPECT_EQ(inside.machine.value(d(1)), 1);
  Running beyond = running("AREA X;NOP", options);
  beyond.programs().set_step(Area::x, 9);
  beyond.start(Area::x);
  beyond.tick();
  EXPECT_EQ(beyond.machine.codes.at(0)[0], 1);

  options = {};
  options.choose(option("tmr_of_d", "compared_in_each_scan"));
  Running follows = running("AREA X;TMR D0;SET Y0;TMR K9", options);
  follows.machine.write(d(0), 1000);
  follows.start(Area::x);
  follows.tick(51);  // 50 of them have ended
  EXPECT_EQ(follows.programs().quiet_ms(Area::x), 0);
  follows.machine.write(d(0), 60);
  follows.tick(9);
  EXPECT_FALSE(follows.machine.contact(y(0)));
  follows.tick();
  EXPECT_TRUE(follows.machine.contact(y(0)));

  options = {};
  options.choose(option("tmr_under_m8004", "stands"));
  Running stands = running("AREA X;TMR K20;SET Y0;TMR K9", options);
  stands.start(Area::x);
  stands.tick(11);
  stands.machine.set_special_contact(named::kMotionInhibit, true);
  stands.tick(100);
  EXPECT_EQ(stands.state(Area::x).left_ms, 10);
  stands.programs().fast_forward(Area::x, 5);
  EXPECT_EQ(stands.state(Area::x).left_ms, 10);
  stands.machine.set_special_contact(named::kMotionInhibit, false);
  stands.tick(10);
  EXPECT_TRUE(stands.machine.contact(y(0)));
}

TEST(Super40ncFurtherReadings, OfFieldsAndSingleSteps) {
  for (const bool is_own : {false, true}) {
    Options options;
    if (is_own) options.choose(option("mrk_fields", "of_its_own_axis"));
    if (is_own) options.choose(option("single_step_lines", "yes"));
    Running marks = running("AREA Y;MRK * K5;TMR K9", options);
    marks.machine.registers[named::kOwnedAxes] = 0;
    marks.start(Area::y);
    marks.tick();
    const auto begins = [](const std::string& line) { return line.find("MRK") != std::string::npos; };
    EXPECT_EQ(std::any_of(marks.machine.log.begin(), marks.machine.log.end(), begins), is_own);
    Running steps = running("AREA X;MPG K1;SET Y0;TMR K9", options);
    steps.machine.registers[named::kOwnedAxes] = 0;
    steps.machine.set_special_contact(8101, true);
    steps.start(Area::x);
    steps.tick();
    EXPECT_EQ(steps.machine.contact(y(0)), !is_own);
    EXPECT_EQ(steps.phase(Area::x), is_own ? Phase::paused : Phase::waiting);
  }
}

}  // namespace further_readings_test
}  // namespace understudy::interpreter::super_40nc
