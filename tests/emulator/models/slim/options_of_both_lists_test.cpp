// Points on which the maker's two lists differ, or one is incomplete: each option compared with the default,
// also tick by tick and on a device that is restored at each step.
#include "emulator/device/memory/persistent_memory.h"
#include "tests/emulator/models/slim/motion_option_script.h"

namespace understudy::emulator::models::slim {

namespace options_of_both_lists_test {

const std::string kMap = "> TX=0\n> TY=1\n";

TEST(SlimListOptions, TheNumbersOfAa) {
  play_all("arc",
           {{"centre_and_angle", kMap + "> AA 100,0,180\n@ 4000\n> ?PE\n< 200\n> AA 200,0,50\n"},
            // Half a circle to the left: through 50,-50. Then the longer way, of radius 60.
            {"end_point_and_radius",
             kMap + "> AA 100,0,50\n@ 836\n> ?PE\n< 50\n> ?T1PE\n< -50\n@ 900\n> ?PE\n< 100\n> ?ST\n< 1\n"
                    "> AA 200,0,-60\n@ 2600\n> ?MD\n< 4\n@ 200\n> ?PE\n< 200\n> ?MD\n< 0\n"
                    "> AA 200,0,50\n< ERR 2\n> AA 900,0,50\n< ERR 2\n> AA 210,0,0\n< ERR 2\n"
                    "> AR 50,0,180\n@ 2000\n> ?PE\n< 300\n"}});
}

TEST(SlimListOptions, TheNumbersOfSpi) {
  // Two turns out to 20, and three in to 5. No growth, one the wrong way, and no radius at all are refused.
  play_all("spiral_r",
           {{"sweep", kMap + "> SPI 10,0,180,10\n@ 2000\n> ?PE\n< 25\n"},
            {"radius_at_its_end",
             kMap + "> SPI 10,0,20,5\n@ 10000\n> ?PE\n< -10\n> ?T1PE\n< 0\n> SPI 10,0,5,-5\n@ 9000\n"
                    "> ?PE\n< 5\n> SPI 10,0,9,-5\n< ERR 2\n> SPI 10,0,9,0\n< ERR 2\n"
                    "> SPI 10,0,-9,-5\n< ERR 2\n> SPI 10,0,5,5\n@ 5\n> ?MD\n< 0\n"}});
  const std::string there = kMap + "> CS 100\n> SPI 110,0,180,10\n@ 10000\n> ?PE\n< ";
  play_all("spiral_centre", {{"absolute", there + "125\n"}, {"relative", there + "325\n"}});
}

TEST(SlimListOptions, TheSpeedOf2Ma) {
  // 100 at 50: 2.05 s; at 100: 1.1 s.
  const std::string begin = kMap + "> PR4=50\n> T1PR4=50\n> 2MR 100,0\n";
  play_all("line_speed",
           {{"pr3_which_pr4_names_too",
             begin + "> ?PR3\n< 50\n@ 2040\n> ?MD\n< 4\n@ 12\n> ?MD\n< 0\n> T1PR3=5\n> ?T1PR4\n< 5\n"
                     "> PR4=0\n< ERR 2\n"},
            {"pr4_of_its_own",
             begin + "> ?PR3\n< 100\n@ 2040\n> ?MD\n< 4\n@ 12\n> ?MD\n< 0\n> T1PR4=40\n> 2MR 1,0\n< ERR 7\n"
                     "> AR 5,0,0\n> PR4=40\n> SAVE C\noff\non\n> ?PR4\n< 40\n> ?PR3\n< 100\n"},
            // A running motion receives it at once, each module its own; TVM= sets all.
            {"pr4_of_its_own", begin + "@ 551\n> ?PE\n< 26\n> PR3=5\n@ 500\n> ?PE\n< 51\n> PR4=10\n@ 1000\n"
                                       "> ?PE\n< 62\n> TVM=100\n@ 700\n> ?PE\n< 100\n"},
            // A line and an arc then have two speeds, and a stop between them: 0.6 + 0.6 s.
            {"pr4_of_its_own", kMap + "> CM 1\n> 2MR 50,0\n> 2MR 50,0\n> 3MR 0,0,0\n< ERR 4\n@ 1101\n"
                                      "> ?MD\n< 0\n> 2MR 50,0\n> AR 0,5,0.0001\n@ 602\n> ?PE\n< 150\n"}});
}

TEST(SlimListOptions, WhatClrBufDropsInAPause) {
  const std::string moves = "> MR 1000\n> MR 5\n> T1JGF\n> T2HOFF\n@ 501\n";
  const std::string after = "@ 300\n> CLR BUF\n";
  play_all(
      "clear_buffer_in_pause",
      {{"what_is_half_done_too", moves + "> PZ\n" + after + "> REDO\n@ 1000\n> ?PE\n< 500\n> ?T1MD\n< 0\n"},
       {"what_waits", moves + "> PZ\n" + after +
                          "@ 500\n> ?PE\n< 500\n> REDO\n@ 1000\n> ?PE\n< 1000\n"
                          "> ?T1MD\n< 2\n> ?ST\n< 1\n"},
       {"what_waits", moves + "> TAPZ\n" + after + "> TAREDO\n@ 1000\n> ?PE\n< 1000\n"},
       // A command that has not started is dropped: a move that waits for the jog before it.
       {"what_waits", "> JGF\n> MR 5\n@ 201\n> PZ\n" + after + "> REDO\n@ 201\n> JG0\n@ 200\n> ?ST\n< 1\n"},
       {"what_waits", kMap + "> 2MR 100,0\n> 2MR 5,0\n> MR 7\n@ 501\n> PZ\n" + after +
                          "> REDO\n@ 700\n> ?PE\n< 100\n> ?ST\n< 1\n"}});
}

TEST(SlimListOptions, WhetherPzPausesTheProgram) {
  const std::string program = "> PG\n> WT 200\n> OUT \"A\"\n> PZ\n> OUT \"B\"\n>\n> G\n@ 50\n> PZ\n@ 500\n";
  play_all("pause_and_program",
           {{"program_goes_on", program + "< A\n< B\n> ?ST\n< 9\n> REDO\n"},
            {"program_pauses_too", program + "> ?ST\n< 13\n> REDO\n@ 5\n< A\n@ 100\n> REDO\n@ 5\n< B\n"},
            {"program_pauses_too", program + "> TASTOP\n@ 50\n> ?ST\n< 1\n"},
            {"program_pauses_too", program + "> EXIT\n> REDO\n@ 50\n> ?ST\n< 1\n"},
            // TAPZ only pauses motion.
            {"program_pauses_too", "> PG\n> TAPZ\n> OUT \"A\"\n>\n> G\n@ 5\n< A\n"}});
}

TEST(SlimListOptions, WhatEndsAThrust) {
  const std::string push = kMap + "> FT 500\n@ 50\n> MR 100\n> 2MR 3,4\n@ 600\n> ?PE\n< ";
  play_all("thrust_end", {{"jg0_a_jog_or_a_stop", push + "0\n> ?MD\n< 3\n> JG0\n@ 600\n> ?PE\n< 103\n"},
                          {"a_move_too", push + "103\n> ?MD\n< 0\n> FT 5\n> SET P1\n> ?MD\n< 3\n> H\n@ 5\n"
                                                "> ?MD\n< 1\n"}});
}

TEST(SlimListOptions, WhatDnWaitsFor) {
  const std::string pulse = "> PG\n> PLS P1,25\n> T1DN\n> OUT \"A\"\n> DN\n> OUT \"B\"\n>\n> G\n@ 20\n";
  play_all("done", {{"moves_and_all_in_the_buffer", pulse + "< A\n< B\n"},
                    {"jogs_thrust_and_pulses_too", pulse + "< A\n@ 85\n< B\n"}});
  const std::string jog = "> JGF\n> PG\n> DN\n> OUT \"B\"\n>\n> G\n@ 300\n";
  play_all("done", {{"moves_and_all_in_the_buffer", jog + "< B\n"},
                    {"jogs_thrust_and_pulses_too", jog + "> TAPZ\n@ 300\n> TAUPZ\n@ 5\n< B\n"}});
}

TEST(SlimListOptions, WhatAvmIsOf) {
  // At 400 of 1000: 40 ms and 8 pulses of ramp. Or 100 ms and 50, as without it.
  const std::string jog = "AIN = 400\n@ 1\n> AVM\n> ?VM\n< ";
  play_all("analog_speed_of",
           {{"moves_and_jogs", jog + "1\n> JGF\n@ 241\n> ?PE\n< 88\n"},
            {"moves", jog + "1\n> JGF\n@ 201\n> ?PE\n< 150\n> JG0\n@ 200\n> CS 0\n> MR 1000\n"
                            "@ 241\n> ?PE\n< 88\n"},
            {"moves", "> AVM\n> JGF\n@ 201\n> ?PE\n< 150\n"}});
  play_all("working_speed_shown",
           {{"as_set", jog + "1\n"},
            {"as_the_analog_input_leaves_it",
             jog + "0.4\n> ?PN10\n< 0.4\n> ?T1VM\n< 1\n> ?VJ\n< 1\n> VM=2\n> ?VM\n< 2\n"}});
}

TEST(SlimListOptions, WhichFunctionsThereAre) {
  const std::string program = R"(> PN45=2
> CS 7.5
> PG
> R0=PE
> N0=T1PE
> JG VM,R0,$A
> OUT "NO"
> $A OUT R0
> OUT N0
>
> T1CS 9
> G
@ 20
< 7.5
< 9
> N1=PE
< ERR 2
> R1=T1ST
> ?R1
< 1
> R1=VER
< ERR 1
> R1=FOO
< ERR 1
> MA PE
< ERR 1
)";
  play_all("functions",
           {{"what_queries_show_too", program},
            {"ain_tm_geti_getr", "> R0=PE\n< ERR 1\n> PG\n> R0=PE\n< ERR 1\n> R0=AIN\n>\n"},
            // An event that checks motion, while nothing else happens.
            {"what_queries_show_too",
             "> PG\n> SET EV1 G,PE,R0\n> SET EV2 NG,PE,R0\n> ON EV1,$LESS\n> ON EV2,$MORE\n"
             "> $W JP $W\n> $LESS OUT \"LESS\"\n> RET\n> $MORE OUT \"MORE\"\n> RET\n>\n> R0=500\n"
             "> G\n@ 20\n< LESS\n> TAPZ\n> TAREDO\n"}});
}

TEST(SlimListOptions, WhereABareNumberGoes) {
  const std::string asks =
      "> PG\n> GETI\n> GETR\n> OUT \"A\"\n>\n> G\n@ 5\n> 7\n@ 5\n> 2.5\n@ 5\n< A\n> ?N0\n< ";
  play_all("bare_number",
           {{"nowhere", asks + "0\n> ?R0\n< 0\n"}, {"into_n0_or_r0", asks + "7\n> ?R0\n< 2.5\n"}});
}

TEST(SlimListOptions, EventsWithoutAProgram) {
  const std::string event =
      "> PG\n> $A RET\n> $E OUT \"EVENT\"\n> RET\n>\n> SET EV1 I,8\n> ON EV1,$E\n@ 50\nIN8 = 1\n@ 50\n";
  play_all("events_without_program",
           {{"waits_for_a_program", event + "> G\n@ 50\n< EVENT\n"},
            {"run_their_routine", event + "< EVENT\n> ?ST\n< 1\nIN8 = 0\n@ 50\nIN8 = 1\n@ 50\n< EVENT\n"},
            // Leads nowhere.
            {"run_their_routine", "> SET EV1 I,8\n> ON EV1,$E\nIN8 = 1\n@ 50\n> ?ERR\n< 13\n"}});
}

TEST(SlimListOptions, TheUserUnit) {
  const std::string set = "> PN44=7\n> PN45=10\n> PN46=2\n> MR 10\n@ 300\n> ?PE\n< 10\n> MR 100\n> ";
  for (const auto& [option, refused] : {std::pair{"pn45_pulses_are_pn46_units", "PN46"},
                                        {"pn44_pulses_are_pn45_units", "PN44"},
                                        {"pn46_pulses_are_pn45_units", "PN45"}}) {
    play_all("user_unit", {{option, set + refused + "=5\n< ERR 3\n"}});
  }
}

TEST(SlimListOptions, WhatIsKept) {
  const std::string set = "> N0=7\n> R0=2.5\n> FOO\n< ERR 1\noff\non\n> ?N0\n< ";
  play_all("variables_kept", {{"by_save_d", set + "0\n"}, {"when_written", set + "7\n> ?R0\n< 2.5\n"}});
  play_all("history_kept", {{"until_power_off", set + "0\n> ?ERC\n< 0\n"},
                            {"for_ever", set + "0\n> ?ERC\n< 1\n> ?ERR\n< 0\n> RESET H\n> ?ERC\n< 1\n"}});
  DialogueScript all(3, {{"linked_from_factory", "all_of_the_bench"}});
  all.play("> ?PN50\n< 7\n> T2MR 5\n");
  DialogueScript alone(3, {{"linked_from_factory", "t0_alone"}});
  alone.play(
      "> ?PN50\n< 1\n> T1MR 5\n< ERR 5\n> PN50=3\n> T1MR 5\n> DF\n< ERR 3\n@ 100\n> DF\n> ?PN50\n< 1\n");
}

TEST(SlimListOptions, AHistoryThatIsKeptIsInTheImage) {
  const std::map<std::string, std::string> kept{{"history_kept", "for_ever"}, {"history_length", "4"}};
  DialogueScript first(2, kept);
  first.play("> T1HOFF\n> T1MA 5\n< ERR 9\n> FOO\n< ERR 1\n> OUTP 16\n< ERR 2\n");
  const NvImage image = first.device().memory()->nv_image();
  DialogueScript second(2, kept);
  second.play("off\n");
  second.device().memory()->load_nv(image);
  second.play("on\n> ?ERC\n< 2,1\n> ?T1ERC\n< 9\n> ?ERR\n< 0\n");
}

TEST(SlimListOptions, TheFormOfSaa) {
  const std::string form = "> TX=0\n> TY=1\n> TZ=2\n> R0=50\n> PG\n> SAA R0,R1,90,20\n";
  const std::string both = "> SAA R0,R1,R0,R1\n> SAA R0,1,90,5\n< ERR 1\n> SAA R0,R1,90\n< ERR 1\n";
  play_all("helix_variables",
           {{"constants_for_angle_and_height_too",
             form + both +
                 ">\n> SAA R0,R1,90,20\n< ERR 3\n> PD 1\n> PL\n< 0: SAA R0,R1,90,20\n> G\n@ 1200\n"
                 "> ?PE\n< 50\n> ?T1PE\n< -50\n> ?T2PE\n< 20\n"},
            {"four_variables", form + "< ERR 1\n" + both + ">\n"}});
}

}  // namespace options_of_both_lists_test

}  // namespace understudy::emulator::models::slim
