// Options about SLIM's dialogue, its modules and numbers, each compared with the default. For the line itself
// see options_of_the_line_test.cpp.
#include <algorithm>

#include "emulator/device/axes.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/named_values.h"
#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace options_of_the_dialogue_test {

struct Case {
  const char* title;
  Choices choices;
  int modules;
  const char* script;
};

void play_all(const std::vector<Case>& cases) {
  for (const Case& one : cases) {
    SCOPED_TRACE(one.title);
    DialogueScript script(one.modules, one.choices);
    script.play(one.script);
  }
}

const char* const kCoordinatesInEachMode = R"(> ?MD
< IDLE
> MA 100000
> ?MD
< POSITION
> TASTOP
> JGF
> ?MD
< JOG
> JG0
@ 1000
> FT 100
> ?MD
< TORQUE
> JG0
@ 10
> TX=0
> TY=1
> 2MA 100,50
> ?MD
< COORDINATED
@ 2000
> AVM
> ?MD
< ANALOG
)";

TEST(SlimDialogueOptions, Queries) {
  play_all({
      // Inputs 1 and 3: 1 + 4.
      {"a mask", {}, 1, "IN1 = 1\nIN3 = 1\n@ 1\n> ?IN\n< 5\n> ?IN 3\n< 1\n"},
      {"no mask",
       {{"input_mask", "error_1"}},
       1,
       "IN3 = 1\n@ 1\n> ?IN\n< ERR 1\n> ?IN 3\n< 1\n> ?IN 2\n< 0\n"},
      // Servo on 1, moving 2, jog 128, buffer not empty 256.
      {"bits", {}, 1, "> ?ST\n< 1\n> JGF\n@ 2\n> ?ST\n< 131\n"},
      {"bits in hexadecimal",
       {{"status_bits", "the_same_in_hexadecimal"}},
       1,
       "> ?ST\n< 0x0001\n> JGF\n@ 2\n> ?ST\n< 0x0083\n> TASTOP\n> MA 50000\n@ 2\n> ?ST\n< 0x0103\n"},
      {"modes", {}, 1, "> ?MD\n< 0\n> MA 100000\n> ?MD\n< 1\n"},
      {"modes in words", {{"mode_codes", "words"}}, 2, kCoordinatesInEachMode},
      // 3725 s are 1 h, 2 min and 5 s.
      {"hours", {}, 1, "@ 3725999\n> ?time\n< 1:02:05\n"},
      {"seconds",
       {{"time_format", "seconds"}},
       1,
       "@ 3725999\n> ?time\n< 3725\n@ 1\n> TM=0\n> ?time\n< 3726\n"},
      {"24 V, 25 degrees", {}, 1, "> ?AC\n< 24\n> ?TEMP\n< 25\n"},
      {"36 V, 40 degrees", {{"voltage", "36"}, {"temperature", "40"}}, 1, "> ?AC\n< 36\n> ?TEMP\n< 40\n"},
      {"48 V, 60 degrees", {{"voltage", "48"}, {"temperature", "60"}}, 1, "> ?AC\n< 48\n> ?TEMP\n< 60\n"},
  });
}

TEST(SlimDialogueOptions, ANameHasANumberHoweverItIsWritten) {
  DialogueScript script(1, {{"status_bits", "the_same_in_hexadecimal"},
                            {"mode_codes", "words"},
                            {"time_format", "seconds"},
                            {"input_mask", "error_1"}});
  script.type("JGF");
  script.pass(2000);
  EXPECT_EQ(script.device().named_values()->value_named("ST"), 131.0);
  EXPECT_EQ(script.device().named_values()->value_named("MD"), 2.0);
  EXPECT_EQ(script.device().named_values()->value_named("TIME"), 2.0);
  EXPECT_EQ(script.device().named_values()->value_named("IN"), std::nullopt);
  const std::vector<std::string> names = script.device().named_values()->names();
  EXPECT_EQ(std::count(names.begin(), names.end(), "IN"), 0);
}

TEST(SlimDialogueOptions, Errors) {
  play_all({
      {"codes", {}, 1, "> N0=40000\n< ERR 2\n> MA\n< ERR 1\n> ?ERR\n< 1\n> ?ERC\n< 1,2\n"},
      {"one code",
       {{"error_codes", "1_for_all"}},
       1,
       "> N0=40000\n< ERR 1\n> ?ERR\n< 1\n> T1MA 5\n< ERR 1\n> ?ERC\n< 1,1\n> RESET\n> ?ERR\n< 0\n"},
      {"a history of 16",
       {},
       1,
       "> N0=40000\n< ERR 2\n> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n"
       "> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n> ?ERC\n< 1,1,1,1,1,1,1,1,2\n"},
      {"a history of 8",
       {{"history_length", "8"}},
       1,
       "> N0=40000\n< ERR 2\n> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n"
       "> MA\n< ERR 1\n> MA\n< ERR 1\n> ?ERC\n< 1,1,1,1,1,1,1,2\n> MA\n< ERR 1\n> ?ERC\n< 1,1,1,1,1,1,1,1\n"},
      {"a history of 4",
       {{"history_length", "4"}},
       1,
       "> N0=40000\n< ERR 2\n> MA\n< ERR 1\n> MA\n< ERR 1\n> MA\n< ERR 1\n> ?ERC\n< 1,1,1,2\n"
       "> MA\n< ERR 1\n> ?ERC\n< 1,1,1,1\n"},
  });
}

/// No module is T1: its move fails, in line 1.
const char* const kFailingProgram = "> PG\n> WT 5\n> T1MA 5\n> OUT \"ON\"\n> \n> G\n";

TEST(SlimDialogueOptions, FailedLinesOfAProgram) {
  const std::string program = kFailingProgram;
  play_all({
      {"remembered", {}, 1, (program + "@ 20\n> ?ERC\n< 5\n").c_str()},
  });
  DialogueScript message(1, {{"unasked_text", "errors_of_a_program_too"}});
  message.play(program + "@ 20\n< ERR 5\n> ?ERC\n< 5\n");
  DialogueScript passed(1, {{"unasked_text", "errors_of_a_program_too"}, {"failed_line", "is_passed_over"}});
  passed.play(program + "@ 20\n< ERR 5\n< ON\n");
  DialogueScript quiet(1, {{"unasked_text", "errors_of_a_program_too"}, {"error_reply", "nothing"}});
  quiet.play(program + "@ 20\n> ?ERC\n< 5\n");
  DialogueScript one_code(1, {{"unasked_text", "errors_of_a_program_too"}, {"error_codes", "1_for_all"}});
  one_code.play(program + "@ 20\n< ERR 1\n");
}

TEST(SlimDialogueOptions, WhatOfErrorsHasNoRoomIsRememberedOnly) {
  DialogueScript script(1, {{"unasked_text", "errors_of_a_program_too"},
                            {"failed_line", "is_passed_over"},
                            {"flow_control", "xon_xoff"}});
  script.play("> PG\n> T1MA 5\n> JP 0\n> \n> G\n");
  script.send("\x13");
  script.pass(5000);
  // Lines of 7 characters, until there are 1024: 147.
  EXPECT_EQ(script.device().state().output.size(), 7 * 147u);
  script.send("\x11");
  // 1024 of them go at once.
  for (int i = 0; i < 146; ++i) EXPECT_EQ(script.next(), "ERR 5");
  EXPECT_EQ(script.next(), "(nothing)");
}

TEST(SlimDialogueOptions, AModuleThatIsNotLinked) {
  const std::string program = kFailingProgram;
  DialogueScript ours(1);
  ours.play("> T1MA 5\n< ERR 5\n> ?T1PE\n< ERR 5\n> TX=1\n> XMA 5\n< ERR 5\n> ?ERC\n< 5,5,5\n");
  DialogueScript silent(1, {{"unlinked_module", "silence"}, {"acknowledgement", "ok"}});
  silent.play(
      "> T1MA 5\n> ?T1PE\n> T1VM=5\n> TX=1\n< OK\n> XMA 5\n> TY=0\n< OK\n> 2MA 5,5\n> ?PE\n< 0\n> ?ERC\n< 0\n"
      // Lines that T0 itself cannot read are T0's to refuse, and nothing is done to T1.
      "> T9MA 5\n< ERR 2\n> T1NONSENSE\n< ERR 1\n> PN50=3\n< OK\n> ?T1VM\n< 1000\n> ?T1PE\n< 0\n");
  DialogueScript in_a_program(1,
                              {{"unlinked_module", "silence"}, {"unasked_text", "errors_of_a_program_too"}});
  in_a_program.play(program + "@ 20\n< ON\n> ?ERC\n< 0\n");
  in_a_program.play("> PG\n> T1DN\n> OUT \"PAST\"\n> \n> G\n@ 5\n< PAST\n> ?ERC\n< 0\n");
  DialogueScript prompted(1, {{"unlinked_module", "silence"}, {"prompt", "greater_than"}});
  prompted.send("?T1PE\r?PE\r");  // T0 is still ready for the next line
  EXPECT_EQ(prompted.next(), ">0");
  // After the line, there is a module to report to.
  EXPECT_TRUE(silent.device().named_values()->assign("T2VM", 5).value_or("").starts_with(
      "belongs to a module that is not linked"));
}

TEST(SlimDialogueOptions, IntegerRange) {
  play_all({
      {"of 16 bits", {}, 1, "> N0=-32768\n> ?N0\n< -32768\n"},
      {"as far down as up", {{"integer_range", "from_minus_32766"}}, 1, R"(> N0=-32766
> N1=32766
> NS(7)=-32766
> N0=-32767
< ERR 2
> NS(7)=-32767
< ERR 2
> ?N0
< -32766
> ?NS(7)
< -32766
> PG
> N2=-32767
< ERR 2
> JE -32767,N0,0
< ERR 2
> N2=GETI
> OUT N2
> 
> G
@ 5
> -32767
< ERR 2
> -32766
@ 5
< -32766
)"},
  });
}

TEST(SlimDialogueOptions, IntegerRangeOfWhatIsKept) {
  NvImage image = DialogueScript(1).device().memory()->nv_image();
  image.registers.emplace_back("N3", -32767);
  const auto load = [&](const Choices& choices) {
    DialogueScript script(1, choices);
    script.world().switch_power(0, false);
    script.device().memory()->load_nv(image);
    script.world().switch_power(0, true);
    return script.ask("?N3");
  };
  EXPECT_EQ(load({}), "-32767");
  try {
    load({{"integer_range", "from_minus_32766"}});
    FAIL() << "it was accepted";
  } catch (const NvError& error) {
    EXPECT_STREQ(error.what(), "registers: 'N3': -32767 does not fit; expected -32766 to 32766");
  }
}

TEST(SlimDialogueOptions, AxisMap) {
  play_all({
      {"a letter keeps its module",
       {},
       2,
       "> TX=1\n> TY=1\n< ERR 2\n> XMA 5\n@ 100\n> ?T1PE\n< 5\n> TY=6\n< ERR 2\n"},
      // XMA then finds no module, and TX takes the module back.
      {"a module is taken",
       {{"axis_values", "is_taken_from_its_letter"}},
       2,
       "> TX=1\n> TY=1\n> XMA 5\n< ERR 4\n> YMA 5\n@ 100\n> ?T1PE\n< 5\n> TX=1\n> YMA 9\n< ERR 4\n> XMA 9\n@ "
       "100\n"
       "> ?T1PE\n< 9\n> TY=6\n< ERR 2\n> TY=7\n< ERR 2\n> TY=9\n< ERR 2\n> TX=8\n> TY=8\n> XMA 1\n< ERR 4\n"},
      {"PN37 is for power-up", {}, 2, "> TX=1\n> ?PN37\n< 34952\n> SAVE C\noff\non\n> XMA 5\n< ERR 4\n"},
      // 0x8881 is 34945; X is T1 after the next power-up.
      {"TX= changes PN37",
       {{"axis_map_kept", "yes"}},
       2,
       "> TX=1\n> ?PN37\n< 34945\noff\non\n> ?PN37\n< 34952\n> XMA 5\n< ERR 4\n"
       "> TX=1\n> TX=1\n> TY=1\n< ERR 2\n> ?PN37\n< 34945\n> SAVE C\noff\non\n> XMA 5\n@ 100\n> ?T1PE\n< 5\n"
       // 0x8810 is 34832: X is now T0, Y is T1.
       "> TX=0\n> TY=1\n> ?PN37\n< 34832\n"},
      // 0x8818 is 34840: X has lost T1.
      {"both letters change",
       {{"axis_map_kept", "yes"}, {"axis_values", "is_taken_from_its_letter"}},
       2,
       "> TX=1\n> TY=1\n> ?PN37\n< 34840\n"},
  });
}

TEST(SlimDialogueOptions, Parameters) {
  play_all({
      {"DF until SAVE C", {}, 1, "> VM=500\n> SAVE C\n> DF\noff\non\n> ?VM\n< 500\n"},
      {"DF at once",
       {{"defaults_kept", "at_once"}},
       1,
       "> VM=500\n> N0=3\n> SAVE C\n> DF\n> ?VM\n< 1000\noff\non\n> ?VM\n< 1000\n> ?N0\n< 0\n"},
      {"TM is written", {}, 1, "> N0=7\n@ 5000\n> TM=N0\n> ?TM\n< 7\n> ?N0\n< 7\n"},
      {"TM is read",
       {{"clock_assignment", "the_variable"}},
       1,
       "@ 5000\n> TM=N0\n> ?N0\n< 5\n> ?TM\n< 5\n> TM=R1\n> ?R1\n< 5\n> TM=NS(N0)\n> ?NS(5)\n< 5\n> TM=2\n> "
       "?TM\n< 2\n"
       // The line begins 1 ms after G.
       "> TM=0\n> PG\n> WT 2000\n> TM=N1\n> \n> G\n@ 2500\n> ?N1\n< 2\n"
       // 40000 s are more than N0 holds.
       "> TM=40000\n> TM=N0\n< ERR 2\n> ?N0\n< 5\n"},
  });
}

/// An error of ULC, which continues.
std::string first_parameters(DialogueScript& script) {
  script.type("ULC");
  std::string lines;
  std::string line = script.next();
  for (int i = 0; i < 3; ++i, line = script.next()) lines += line + "|";
  while (line != "(nothing)") line = script.next();
  return lines;
}

TEST(SlimDialogueOptions, NamesOfSpeeds) {
  DialogueScript script(2);
  script.play("> PN10=7\n> ?VM\n< 7\n> PN14=8\n> ?VJ\n< 8\n> T1PN14=9\n> ?T1VJ\n< 9\n");
  EXPECT_EQ(first_parameters(script), "PN10=7|PN14=8|FU=0|");
}

TEST(SlimDialogueOptions, NamesOfSpeedsAreSwapped) {
  const Choices choices{{"speed_parameters", "pn14_is_vm"}};
  DialogueScript script(2, choices);
  EXPECT_EQ(first_parameters(script), "PN10=100|PN14=1000|FU=0|");
  script.play(
      "> PN14=500\n> ?VM\n< 500\n> ?VJ\n< 100\n> PN10=7\n> ?VJ\n< 7\n> ?VM\n< 500\n> VM=600\n> ?PN14\n< 600\n"
      "> T1PN14=900\n> ?T1VM\n< 900\n> SAVE C\n");
  EXPECT_EQ(first_parameters(script), "PN10=7|PN14=600|FU=0|");
  // The image has the names of the commands.
  const NvImage image = script.device().memory()->nv_image();
  const std::vector<std::pair<std::string, double>> kept{{"PN10", 7}, {"PN14", 600}, {"T1PN14", 900}};
  EXPECT_EQ(image.reals, kept);
  DialogueScript other(2, choices);
  other.world().switch_power(0, false);
  other.device().memory()->load_nv(image);
  other.play("on\n> ?VM\n< 600\n> ?VJ\n< 7\n> ?T1VM\n< 900\n");
  EXPECT_EQ(other.device().named_values()->assign("PN10", 9), std::nullopt);
  EXPECT_EQ(other.ask("?VJ"), "9");
  EXPECT_EQ(other.device().named_values()->value_named("PN14"), 600.0);
  // VJ applies to a jog: at 600 RPM and 10000 pulses per revolution 100 pulses per millisecond.
  other.play("> PN10=600\n> VA=1000000000\n> JGF\n@ 10\n");
  EXPECT_DOUBLE_EQ(other.device().axes()->speed_pps(0), 100000);
}

TEST(SlimDialogueOptions, ABenchChoosesAndSets) {
  const std::string text = R"(understudy: 1
lines:
  rs232:
    timing: instant
    stations:
      - name: robot
        model: slim
        modules: 2
        choices: { axis_map_kept: yes, voltage: 48, speed_parameters: pn14_is_vm }
        set: { PN14: 500, T1PN10: 7 }
)";
  world::World world(world::parse_bench(all_models(), text, "bench.yaml", "."), world::WorldOptions{},
                     [](const std::string&) {});
  auto& robot = dynamic_cast<Slim&>(world.device(0));
  const auto ask = [&](const char* line) {
    robot.receive_line(line);
    return robot.take_text();
  };
  EXPECT_EQ(ask("?VM"), "500\r\n");
  EXPECT_EQ(ask("?T1VJ"), "7\r\n");
  EXPECT_EQ(ask("?AC"), "48\r\n");
  EXPECT_EQ(ask("TX=1"), "");
  EXPECT_EQ(ask("?PN37"), "34945\r\n");
}

}  // namespace options_of_the_dialogue_test

}  // namespace understudy::emulator::models::slim
