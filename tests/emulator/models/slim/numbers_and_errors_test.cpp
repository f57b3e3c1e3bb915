// How numbers are written, which module has an error, and what is refused when a line is entered.
#include <string>

#include "emulator/device/user_program.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace numbers_and_errors_test {

TEST(SlimNumbers, ACoordinateIsExactToThePulse) {
  for (const std::string units : {"16777217", "33333333", "-33333333", "123456789", "2147483647"}) {
    DialogueScript script;
    script.type("CS " + units);
    EXPECT_EQ(script.ask("?PE"), units);
  }
  play({}, "> FU=1\n> VM=1000\n> VA=100000\n> MA 33333333\n@ 4000\n> ?PE\n< 33333333\n");
  // Fractions of 3, 1000 and 2^31 - 1 pulses per unit.
  play({}, R"(
> PN45=3
> MA 1
> MR -0.6667
@ 100
> ?PE
< 0.333333333
> PN45=1000
> CS 1000000.001
> ?PE
< 1000000.001
> CS -0.5
> ?PE
< -0.5
> CS 2147483647.125
> ?PE
< 2147483647.125
)");
  play({{"coordinate_shown", "as_32_bits_hold_it"}}, "> CS 33333333\n> ?PE\n< 33333332\n");
}

TEST(SlimNumbers, RealsAreWrittenWithoutAnExponent) {
  play({}, R"(
> R0=0.00001
> ?R0
< 0.00001
> R0=1e10
> ?R0
< 10000000000
> R0=-720
> ?R0
< -720
> PG
> OUT R0
>
> G
@ 2
< -720
)");
  play({{"real_format", "exponent_of_the_large_and_small"}},
       "> R0=0.00001\n> ?R0\n< 1e-05\n> R0=1e10\n> ?R0\n< 1e+10\n> R0=0.01\n> ?R0\n< 0.01\n");
}

TEST(SlimNumbers, NoDigitsAreMadeUp) {
  for (const auto& [typed, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {"3.4028235e38", "340282350" + std::string(30, '0')},
           {"-3.4028235e38", "-340282350" + std::string(30, '0')},
           {"1e38", "1" + std::string(38, '0')},
           {"1e-45", "0." + std::string(44, '0') + "1"},
           {"-0.00125", "-0.00125"},
           {"9.5", "9.5"},
           {"1234567", "1234567"},
           {"123456.75", "123456.75"},
           {"0.1", "0.1"}}) {
    DialogueScript script;
    script.type("R0=" + typed);
    EXPECT_EQ(script.ask("?R0"), message);
  }
}

TEST(SlimNumbers, TheClockKeepsAFraction) {
  play(
      {},
      "> TM=1.5\n> ?TM\n< 1\n@ 499\n> ?TM\n< 1\n@ 1\n> ?TM\n< 2\n> R0=0.25\n> TM=R0\n@ 749\n> ?TM\n< 0\n@ 1\n"
      "> ?TM\n< 1\n");
}

TEST(SlimNumbers, WhatIsSaidCanBeTypedAgain) {
  for (const std::string form : {"plain_digits", "exponent_of_the_large_and_small"}) {
    DialogueScript script(1, {{"real_format", form}});
    for (const std::string typed : {"3.4028235e38", "-3.4028234e38", "1e-45", "16777217"}) {
      ASSERT_EQ(script.ask("R0=" + typed), "(nothing)") << typed;
      const std::string message = script.ask("?R0");
      ASSERT_EQ(script.ask("R1=" + message), "(nothing)") << message;
      EXPECT_EQ(script.ask("?R1"), message);
    }
    EXPECT_EQ(script.ask("R0=3.4028236e38"), "ERR 2");
  }
}

TEST(SlimNumbers, ParametersKeepTheRangeThatIsDescribed) {
  for (const std::string name : {"PR2", "PR3", "VM", "VJ", "VA"}) {
    for (const auto& row : model().named_parameters) {
      if (row.name != name && row.number != name) continue;
      DialogueScript script;
      EXPECT_EQ(script.ask(name + "=" + std::string(row.max)), "(nothing)") << name << " " << row.max;
      EXPECT_EQ(script.ask(name + "=" + std::string(row.min)), "(nothing)") << name << " " << row.min;
    }
    DialogueScript script;
    EXPECT_EQ(script.ask(name + "=1.1e9"), "ERR 2") << name;
    EXPECT_EQ(script.ask(name + "=9e-7"), "ERR 2") << name;
  }
}

TEST(SlimNumbers, TwoLettersOfPn37AreTwoModules) {
  play({}, "> PN37=0\n< ERR 2\n> PN37=34944\n> PN37=33\n< ERR 2\n> ?PN37\n< 34944\n");
  play({{"axis_values", "is_taken_from_its_letter"}}, "> PN37=0\n> ?PN37\n< 0\n");
}

// --- whose error it is -----------------------------------------------------------------------------

const std::string kOfLines[] = {"T1FT 0",  "T1MA 1e44", "T1MA",     "T1PR3=0",   "T1VM=0",
                                "T1FOO=1", "?T1FOO",    "T1PN50=3", "T1PR3=abc", "T1MA 1e13"};

TEST(SlimErrors, WhatIsWrongWithALineIsT0s) {
  for (const std::string& line : kOfLines) {
    DialogueScript script(2);
    const std::string answer = script.ask(line);
    ASSERT_EQ(answer.substr(0, 4), "ERR ") << line;
    EXPECT_EQ(script.ask("?ERR"), answer.substr(4)) << line;
    EXPECT_EQ(script.ask("?T1ERR"), "0") << line;
    EXPECT_EQ(script.ask("?T1ERC"), "0") << line;
  }
}

TEST(SlimErrors, WhatAMotorRefusesIsItsOwn) {
  const std::string off = "> T1HOFF\n> T1MA 5\n< ERR 9\n";
  DialogueScript own(2);
  own.play(off + "> ?T1ERR\n< 9\n> ?ERR\n< 0\n");
  DialogueScript all(2, {{"error_of", "t0"}});
  all.play(off + "> ?T1ERR\n< 0\n> ?ERR\n< 9\n");
}

TEST(SlimErrors, T0KnowsWhyItsProgramHasEnded) {
  // By a wrong line for T1, and by one that T1 refuses.
  DialogueScript wrong(2);
  wrong.play("> PG\n> T1PR3=R0\n>\n> G\n@ 5\n> ?ERR\n< 2\n> ?ST\n< 33\n> ?T1ERR\n< 0\n");
  DialogueScript refused(2);
  refused.play("> T1HOFF\n> PG\n> T1MA 5\n>\n> G\n@ 5\n> ?ERR\n< 9\n> ?T1ERR\n< 9\n");
  DialogueScript passed(2, {{"failed_line", "is_passed_over"}});
  passed.play("> T1HOFF\n> PG\n> T1MA 5\n>\n> G\n@ 5\n> ?T1ERR\n< 9\n");
}

// --- lines of a program ----------------------------------------------------------------------------

struct EnteredLine {
  std::string line;
  std::string error;  // "": it is stored
};

TEST(SlimEntry, LinesAreCheckedAsTheyAreEntered) {
  for (const EnteredLine& each : {EnteredLine{"FOO=5", "ERR 1"},
                                  {"XYZ=1", "ERR 1"},
                                  {"TQ=1", "ERR 1"},
                                  {"IN=5", "ERR 1"},
                                  {"PE=5", "ERR 1"},
                                  {"PR3=0", "ERR 2"},
                                  {"PR3=-5", "ERR 2"},
                                  {"VJ=0", "ERR 2"},
                                  {"PN50=256", "ERR 2"},
                                  {"PN37=0", "ERR 2"},
                                  {"TVM=0", "ERR 2"},
                                  {"TM=-1", "ERR 2"},
                                  {"T1FOO=1", "ERR 1"},
                                  {"T1PN50=3", "ERR 1"},
                                  {"T1PR3=0", "ERR 2"},
                                  {"FOO=R0", "ERR 1"},
                                  {"PWM P1,0,50", "ERR 2"},
                                  // Lines and links can come later.
                                  {"T7MR 5", ""},
                                  {"CALL 3000", ""},
                                  {"PR3=R0", ""},
                                  {"TVM=GETR", ""},
                                  {"T7PR3=5", ""},
                                  {"PR3=5", ""},
                                  {"PN14=3", ""},
                                  {"TM=0", ""},
                                  {"$A FOO=5", "ERR 1"},
                                  {"$A PR3=5", ""}}) {
    for (const std::string begin : {"PG", "DLP"}) {
      DialogueScript script;
      script.type(begin);
      EXPECT_EQ(script.ask(each.line), each.error.empty() ? "(nothing)" : each.error) << each.line;
      script.type("EXIT");
      EXPECT_EQ(script.ask("PL"), each.error.empty() ? "0: " + each.line : "(nothing)");
    }
    DialogueScript loaded;
    if (each.error.empty()) {
      loaded.device().user_program()->load_program(each.line);
    } else {
      EXPECT_THROW(loaded.device().user_program()->load_program(each.line), ProgramError) << each.line;
    }
    // With this option it is stored, and fails when it runs.
    DialogueScript later(1, {{"program_check", "when_it_runs"}});
    later.type("PG");
    EXPECT_EQ(later.ask(each.line), "(nothing)") << each.line;
  }
}

TEST(SlimEntry, ASecondLabelIsRefusedOrNeverFound) {
  const std::string twice = "> PG\n> $A OUT \"1\"\n> RET\n> $a OUT \"2\"\n";
  play({}, twice +
               "< ERR 13\n> RET\n>\n> PL\n< 0: $A OUT \"1\"\n< 1: RET\n< 2: RET\n"
               "> PE 0\n> $A OUT \"3\"\n> G $A\n@ 2\n< 3\n");
  play({{"same_label", "the_first_counts"}}, twice + "> RET\n>\n> G $A\n@ 2\n< 1\n");
}

TEST(SlimEntry, AModuleBeyondTheEighthIsOutOfRange) {
  play({}, "> T8H\n< ERR 2\n> T15H\n< ERR 2\n> ?T15PE\n< ERR 2\n> T15PR3=5\n< ERR 2\n> T15FOO\n< ERR 1\n");
}

}  // namespace numbers_and_errors_test

}  // namespace understudy::emulator::models::slim
