// Options about motion: each one in a dialogue, compared with the default.
//
// A typed command starts in the next millisecond, so 500 ms of a motion are over after 501.
#include "tests/emulator/models/slim/motion_option_script.h"

namespace understudy::emulator::models::slim {

namespace options_of_motion_test {

TEST(SlimMotionOptions, CommandsWhileSomethingMoves) {
  const std::string begin = "> TX=0\n> TY=1\n> MA 1000\n@ 501\n";
  play_all("busy", {{"wait_in_the_buffer", begin + "> MR 10\n> 2MR 5,5\n@ 5000\n> ?PE\n< 1015\n"},
                    {"error_3", begin + R"(> MR 10
< ERR 3
> H
< ERR 3
> XMR 1
< ERR 3
> 2MR 5,5
< ERR 3
> AR 5,5,90
< ERR 3
> SAR 5,5,90,7
< ERR 4
> YMR 5
> T2MR 7
> SET P1
@ 700
> ?PE
< 1000
> ?T1PE
< 5
> ?T2PE
< 7
> MR 10
> PG
> MR 20
> DN
> OUT "END"
>
> G
@ 500
< END
> ?PE
< 1030
> MR 10
> TAPZ
> MR 5
< ERR 6
)"}});
}

TEST(SlimMotionOptions, CoordinateWhileSomethingMoves) {
  play_all("coordinate_in_motion",
           {{"in_its_turn", "> MA 1000\n> CS 5\n@ 501\n> ?PE\n< 450\n@ 700\n> ?PE\n< 5\n"},
            {"error_3",
             "> MA 1000\n> CS 5\n< ERR 3\n> T1CS 7\n> ?T1PE\n< 7\n@ 1200\n> ?PE\n< 1000\n"
             "> CS 5\n> ?PE\n< 5\n> T1JGF\n> T1CS 0\n< ERR 3\n> T1JG0\n> T1CS 0\n"}});
}

TEST(SlimMotionOptions, WhatResetClears) {
  // Homed, with the motor on: 17. During the motion after 500 ms: 450 pulses.
  const std::string begin = "HORG = 1\n> H\n@ 10\n> ?ST\n< 17\n> MA 1000\n@ 501\n> RESET\n";
  play_all("reset", {{"error_motion_and_buffer", begin + "> ?PE\n< 450\n> ?ST\n< 17\n"},
                     {"coordinate_too", begin + "> ?PE\n< 0\n> ?ST\n< 1\n> MA 20\n@ 200\n> ?PE\n< 20\n"}});
  // T0's command ends a pause, and nothing that it has held continues.
  const std::string paused =
      "> MR 1000\n> T1MR 1000\n> T2JGF\n@ 501\n> TAPZ\n> PZ\n@ 300\n> T1RESET\n> RESET\n";
  play_all(
      "reset",
      {{"error_motion_and_buffer", paused + "> T1MR 5\n< ERR 6\n> ?T2MD\n< 2\n> TAREDO\n> REDO\n@ 300\n"
                                            "> ?T2ST\n< 131\n"},
       {"pause_too", paused + "> ?ST\n< 1\n> ?T2MD\n< 0\n> T1MR 5\n@ 300\n> ?T1PE\n< 505\n> ?T2ST\n< 1\n"}});
}

TEST(SlimMotionOptions, WhetherThePausesAreOne) {
  const std::string moves = "> MR 1000\n@ 501\n> PZ\n@ 300\n";
  play_all(
      "pauses",
      {{"each_ends_by_its_own", moves + "> MR 5\n> TAREDO\n> TAUPZ\n@ 900\n> ?PE\n< 500\n> ?MD\n< 1\n> ?ST\n"
                                        "< 265\n> REDO\n@ 900\n> ?PE\n< 1005\n> ?ST\n< 1\n"},
       {"one_pause", moves + "> MR 5\n< ERR 6\n> TAREDO\n@ 700\n> ?PE\n< 1000\n"},
       {"one_pause", moves + "> TAPZ\n> REDO\n@ 700\n> ?PE\n< 1000\n"},
       {"one_pause", moves + "> TAUPZ\n> REDO\n@ 700\n> ?PE\n< 500\n> ?ST\n< 1\n"},
       {"one_pause", "> MR 1000\n@ 501\n> TAPZ\n@ 300\n> CLR BUF\n> MR 5\n@ 300\n> ?PE\n< 505\n"}});
  // A program's line waits in either pause, even one that cannot be in the buffer.
  const std::string program = "> PG\n> PZ\n> JGF\n> OUT \"GOES\"\n>\n> G\n@ 50\n> ?ST\n< 13\n";
  play_all("pauses", {{"each_ends_by_its_own", program + "> REDO\n@ 5\n< GOES\n> ?MD\n< 2\n"},
                      {"one_pause", program + "> TAREDO\n@ 5\n< GOES\n> ?MD\n< 2\n"}});
}

TEST(SlimMotionOptions, WhatAStopDoesToOutputs) {
  const std::string outputs = "> SET P1\n> PLS P2,1000\n> PWM P3,10,50\n> P1SET P4,100\n@ 40\n";
  const std::string seen = "@ 35\n> MR 200\n@ 400\n";
  for (const std::string stop : {"TASTOP", "RESET"}) {
    for (const bool ends : {false, true}) {
      SCOPED_TRACE(stop);
      MotionScript script("outputs_at_stop", ends ? "end" : "go_on");
      script.play(outputs + "> " + stop + "\n" + seen);
      EXPECT_TRUE(script.output(1));
      EXPECT_EQ(script.output(2), !ends);
      int changes = 0;
      for (int i = 0; i < 100; ++i) {
        const bool before = script.output(3);
        script.pass(1);
        changes += script.output(3) != before ? 1 : 0;
      }
      EXPECT_EQ(changes, ends ? 0 : 2);
      EXPECT_EQ(script.output(4), !ends);
    }
  }
  play_all("outputs_at_stop", {{"go_on", outputs + "> TASTOP\n" + seen + "> RESET\n@ 50\n"},
                               {"end", outputs + "> TASTOP\n" + seen + "> RESET\n@ 50\n"}});
}

TEST(SlimMotionOptions, Bit0OfOutp) {
  for (const bool reversed : {false, true}) {
    MotionScript script("output_order", reversed ? "p4" : "p1");
    for (int mask = 0; mask < 16; ++mask) {
      script.type("OUTP " + std::to_string(mask));
      for (int number = 1; number <= kOutputs; ++number) {
        EXPECT_EQ(script.output(number), (mask >> (reversed ? 4 - number : number - 1) & 1) != 0)
            << "P" << number << " of OUTP " << mask;
      }
    }
  }
}

TEST(SlimMotionOptions, PositionOutputsThatStayArmed) {
  for (const bool stays : {false, true}) {
    MotionScript script("position_outputs", stays ? "each_time_from_either_side_on_the_commanded_position"
                                                  : "once_from_either_side_on_the_commanded_position");
    script.play("> P1SET P2,500\n> P2CLR P2,600\n> MA 550\n@ 800\n");
    EXPECT_TRUE(script.output(2));
    script.play("> MA 1000\n@ 800\n");
    EXPECT_FALSE(script.output(2));
    // Back over 600, which clears, and 500, which sets, if they are still armed.
    script.play("> MA 0\n@ 1300\n");
    EXPECT_EQ(script.output(2), stays);
    // With another coordinate they are at other positions.
    script.play("> ICLR P2\n> CS 550\n> MA 490\n@ 300\n");
    EXPECT_EQ(script.output(2), stays);
    // Sent again, it is another one.
    script.play("> ICLR P2\n> P1SET P3,480\n> MA 550\n@ 300\n");
    EXPECT_FALSE(script.output(2));
    EXPECT_FALSE(script.output(3));
    script.play("> MA 470\n@ 300\n");
    EXPECT_TRUE(script.output(3));
    script.play("> ICLR P3\n> MA 490\n@ 300\n");
    EXPECT_EQ(script.output(3), stays);
    // RESET and a power cut disarm.
    script.play("> ICLR P3\n> P1SET P3,480\n> RESET\n> MA 470\n@ 300\n");
    EXPECT_EQ(script.output(3), !stays);
    script.play("> ICLR P3\n> P1SET P3,480\noff\non\n> MA 500\n@ 900\n");
    EXPECT_FALSE(script.output(3));
  }
}

TEST(SlimMotionOptions, WhatPzHolds) {
  // After 500 ms 45 of 100 units are done; they stop at 50, or 30 and 40. T2 has done 450.
  const std::string path =
      "> TX=0\n> TY=1\n> 2MR 60,80\n> YMR 10\n> T2MR 1000\n@ 501\n> PZ\n@ 700\n"
      "> ?PE\n< 30\n> ?T1PE\n< 40\n> ?T2PE\n< ";
  const std::string continues = "> REDO\n@ 1000\n> ?PE\n< 60\n> ?T1PE\n< 90\n";
  const std::string two = "> MR 1000\n> MR 500\n> T2MR 1000\n> T2MR 500\n@ 501\n";
  // T1 waits behind a command that waits for T0.
  const std::string behind = "> TX=0\n> TY=1\n> MR 1000\n> 2MR 10,10\n> YMR 100\n@ 501\n";
  const std::string both = "> MR 1000\n> T2MR 1000\n@ 501\n> TAPZ\n> PZ\n@ 200\n> TAREDO\n@ 700\n";
  play_all("pause_scope", {{"all_modules", path + "500\n> T2JGF\n< ERR 6\n" + continues},
                           {"all_modules", two + "> CLR BUF\n@ 2000\n> ?PE\n< 1000\n> ?T2PE\n< 1000\n"},
                           {"all_modules", behind + "> CLR BUF\n@ 2000\n> ?PE\n< 1000\n> ?T1PE\n< 0\n"},
                           {"all_modules", both + "> ?PE\n< 500\n> ?T2PE\n< 500\n"}});
  // A jog of 301 ms and its ramp: 50 + 200 + 50.
  play_all(
      "pause_scope",
      {{"t0", path + "1000\n> T2JGF\n@ 301\n> T2JG0\n@ 200\n> ?T2PE\n< 1300\n> JGF\n< ERR 6\n" + continues},
       {"t0", path + "1000\n> CLR BUF\n@ 200\n> ?PE\n< 30\n> ?T1PE\n< 50\n> MR 5\n@ 200\n> ?PE\n< 35\n"},
       {"t0", two + "> CLR BUF\n@ 2000\n> ?PE\n< 1000\n> ?T2PE\n< 1500\n"},
       {"t0", two + "> PZ\n> CLR BUF\n@ 2000\n> ?PE\n< 500\n> ?T2PE\n< 1500\n"},
       {"t0", behind + "> CLR BUF\n@ 2000\n> ?PE\n< 1000\n> ?T1PE\n< 100\n"},
       {"t0", behind + "> PZ\n@ 200\n> ?T1PE\n< 0\n> CLR BUF\n@ 400\n> ?PE\n< 500\n> ?T1PE\n< 100\n"},
       {"t0", both + "> ?PE\n< 500\n> ?T2PE\n< 1000\n> REDO\n@ 700\n> ?PE\n< 1000\n"},
       // A path of other modules does not affect T0's.
       {"t0", "> TX=1\n> TY=2\n> 2MR 60,80\n@ 501\n> PZ\n@ 700\n> ?T2PE\n< 80\n"}});
}

TEST(SlimMotionOptions, AJogWhileAMoveRuns) {
  const std::string moves = "> MR 1000\n> MR 5\n@ 501\n";
  play_all("jog_while_moving",
           {{"error_3", moves + "> JGF\n< ERR 3\n> FT 5\n< ERR 3\n@ 900\n> ?PE\n< 1005\n"},
            {"error_3", moves + "> HOFF\n> JGF\n< ERR 3\n"}});  // HOFF waits, and the servo is still on
  // It stops at 500 within 100 ms. After 200 ms of the jog another 150 are done, plus 50 to stop.
  play_all(
      "jog_while_moving",
      {{"ends_the_move", moves + "> JGF\n> ?PE\n< 450\n@ 300\n> ?PE\n< 650\n> ?MD\n< 2\n> JG0\n"
                                 "@ 1000\n> ?PE\n< 700\n> ?ST\n< 1\n"},
       {"ends_the_move", moves + "> JGF\n@ 50\n> JGR\n> MR 7\n@ 250\n> ?PE\n< 350\n> JG0\n"
                                 "@ 300\n> ?PE\n< 307\n"},
       {"ends_the_move", moves + "> JGF\n@ 50\n> JG0\n@ 300\n> ?PE\n< 500\n> ?ST\n< 1\n"},
       {"ends_the_move", moves + "> JGF\n@ 50\n> PZ\n@ 300\n> ?PE\n< 500\n> REDO\n@ 300\n> ?PE\n< 749\n"},
       {"ends_the_move", moves + "> JGF\n@ 50\n> TASTOP\n@ 300\n> ?MD\n< 0\n"},
       {"ends_the_move", moves + "> HOFF\n> JGF\n@ 300\n> ?PE\n< 650\n"},
       {"ends_the_move", moves + "> FT 5\n@ 200\n> ?PE\n< 500\n> ?MD\n< 3\n"},
       {"ends_the_move", moves + "> TAPZ\n> JGF\n< ERR 6\n> TAREDO\n@ 900\n> ?PE\n< 1005\n"},
       // Homing at -1000: from -50 to -100, and 150 back.
       {"ends_the_move", "> H\n@ 101\n> JGF\n@ 300\n> ?PE\n< 50\n"},
       // In its first millisecond nothing has moved.
       {"ends_the_move", "> MR 1000\n> JGR\n@ 201\n> ?PE\n< -150\n"},
       // A path ends at 30 and 40; T1 continues with its own commands.
       {"ends_the_move",
        "> TX=0\n> TY=1\n> 2MR 60,80\n> YMR 10\n> 2MR 5,5\n> YMR 1\n@ 501\n> JGF\n@ 200\n"
        "> ?PE\n< 80\n> ?T1PE\n< 51\n> JG0\n@ 200\n> ?PE\n< 130\n> ?T1PE\n< 51\n"},
       {"ends_the_move",
        "> TX=0\n> TY=1\n> 2MR 60,80\n> YMR 10\n> JGF\n@ 201\n> ?PE\n< 150\n"
        "> ?T1PE\n< 10\n"},
       {"ends_the_move", "> TX=0\n> TY=1\n> 2MR 60,80\n@ 501\n> JGF\n> T1RESET\n@ 201\n> ?PE\n< 177\n"}});
}

TEST(SlimMotionOptions, TheGrowthOfASpiral) {
  // From the origin about (100, 0) the radius is 100, at 180 degrees. Two turns end at 180 degrees again.
  const std::string two_turns = "> TX=0\n> TY=1\n> SPI 100,0,720,50\n@ 25000\n> ?T1PE\n< 0\n> ?PE\n< ";
  play_all("spiral", {{"sweep_in_degrees_and_growth_a_turn", two_turns + "-100\n"},
                      // Then half a turn back to radius 100, at 0 degrees, and a quarter into the centre.
                      {"sweep_in_degrees_and_growth_in_all",
                       two_turns + "-50\n> SPI 100,0,-180,-50\n@ 9000\n> ?PE\n< 200\n> ?T1PE\n< 0\n"
                                   "> SPI 100,0,90,-100\n@ 9000\n> ?PE\n< 100\n> ?T1PE\n< 0\n"
                                   "> SPI 0,0,0,5\n< ERR 2\n> SPI 0,0,1e-30,1e30\n< ERR 2\n"
                                   "> SPI 0,0,0,0\n@ 10\n> ?PE\n< 100\n"}});
}

TEST(SlimMotionOptions, WhatIsLeftAfterTastop) {
  const std::string stopped =
      "> AVM\nAIN = 1000\n@ 1\n> MR 1000\n> MR 5\n@ 501\n> TASTOP\n@ 100\n> ?PE\n< 450\n";
  play_all("emergency_stop",
           {{"nothing_queued_not_paused_servo_on", stopped + "> ?ST\n< 1\n> ?MD\n< 5\n> MR 5\n> T1MR 5\n"},
            {"nothing_queued_not_paused_servo_off",
             stopped + "> ?ST\n< 0\n> ?MD\n< 0\n> MR 5\n< ERR 9\n> JGF\n< ERR 9\n> T1MR 5\n< ERR 9\n> HON\n"
                       "> MR 5\n@ 200\n> ?PE\n< 455\n> T1MR 5\n< ERR 9\n> T1HON\n> T1MR 5\n"}});
}

TEST(SlimMotionOptions, AccelerationWhileSomethingIsCoordinated) {
  // 50 units at 1000: 0.6 s each. At 250: 0.5 + 0.4 s, the first 20 units within 400 ms.
  const std::string two = "> TX=0\n> TY=1\n> 2MR 30,40\n> 2MR 30,40\n@ 101\n> TVA=250\n";
  play_all("acceleration_in_motion",
           {{"error_3", two + "< ERR 3\n> ?TVA\n< 1000\n"},
            {"next_command", two + "> ?TVA\n< 250\n> 2MR 1,1\n< ERR 7\n> T1PR2=250\n> 2MR 30,40\n> TVA=1000\n"
                                   "@ 1099\n> ?ST\n< 291\n@ 1\n> ?PE\n< 60\n> ?T1PE\n< 80\n"
                                   "@ 400\n> ?PE\n< 72\n> ?T1PE\n< 96\n@ 500\n> ?PE\n< 90\n> ?ST\n< 33\n"}});
  // A command with another acceleration starts from rest, whatever CM says: 0.6 + 0.9 s instead of 1.1.
  for (const bool changes : {false, true}) {
    MotionScript script("acceleration_in_motion", "next_command");
    script.play("> TX=0\n> TY=1\n> CM 1\n> 2MR 30,40\n");
    if (changes) script.play("> TVA=250\n> T1PR2=250\n");
    script.play("> 2MR 30,40\n");
    EXPECT_EQ(script.finish_ms(), changes ? 1500 : 1100);
  }
}

TEST(SlimMotionOptions, WhoseCmCounts) {
  struct Pair {
    std::string first, second, direction;
    Tick ours_ms, new_ms;
  };
  // Two lines of 50: joined 1.1 s, otherwise 0.6 s each. CM 2 with PR7 = 0 joins paths without a corner.
  for (const Pair& pair : {Pair{"0", "1", "50,0", 1200, 1100}, Pair{"1", "0", "50,0", 1200, 1200},
                           Pair{"0", "2", "50,0", 1200, 1100}, Pair{"0", "2", "0,50", 1200, 1200},
                           Pair{"2", "1", "0,50", 1200, 1100}, Pair{"1", "2", "0,50", 1200, 1200},
                           Pair{"1", "1", "0,50", 1100, 1100}}) {
    for (const bool ours : {true, false}) {
      MotionScript script("joint", ours ? "both_commands_allow_it" : "second_command_decides");
      script.play("> TX=0\n> TY=1\n> CM " + pair.first + "\n> 2MR 50,0\n> CM " + pair.second + "\n> 2MR " +
                  pair.direction + "\n");
      EXPECT_EQ(script.finish_ms(), ours ? pair.ours_ms : pair.new_ms) << pair.first << " " << pair.second;
    }
  }
}

TEST(SlimMotionOptions, ASuccessorThatComesLate) {
  // 100 units decelerate from 1000 ms on. After 1050 the position is 98.75 with speed 50: 50 ms and 3.75 to
  // accelerate, 92.5 at 100, 5 to stop within 100 ms, in all 1050 + 50 + 925 + 100. After 1000 nothing is
  // lost yet.
  for (const auto& [after, ms] : {std::pair<Tick, Tick>{999, 2100}, {1050, 2125}}) {
    MotionScript script("late_successor", "speeds_up_again");
    script.play("> TX=0\n> TY=1\n> CM 1\n> 2MR 100,0\n");
    script.pass(after + 1);
    script.play("> 2MR 100,0\n");
    EXPECT_EQ(script.finish_ms() + after + 1, ms);
    EXPECT_EQ(script.ask("?PE"), "200");
  }
  const std::string late = "> TX=0\n> TY=1\n> CM 1\n> 2MR 100,0\n@ 1051\n> 2MR 100,0\n";
  // From rest at 1100: 300 ms later 25. Continuing: 98.75 + 3.75 + 10 after 150 ms.
  play_all("late_successor", {{"begins_from_rest", late + "@ 350\n> ?PE\n< 125\n@ 800\n> ?PE\n< 200\n"},
                              {"speeds_up_again", late + "@ 175\n> ?PE\n< 115\n@ 900\n> ?PE\n< 200\n"}});
}

TEST(SlimMotionOptions, APathWithoutLength) {
  const std::string map = "> TX=0\n> TY=1\n> TZ=2\n";
  play_all("path_without_length",
           {{"is_over_at_once", map + "> 2MR 0,0\n> 2MA 0,0\n> AR 5,0,0\n> SAR 5,0,0,0\n> SPI 5,0,0,1\n"
                                      "> 3MR 0,0,0\n> CM 1\n> 2MR 5,0\n> 2MA 5,0\n@ 300\n> ?ERC\n< 0\n"},
            {"error_2",
             map + "> 2MR 0,0\n< ERR 2\n> 2MA 0,0\n< ERR 2\n> AR 5,0,0\n< ERR 2\n> SAR 5,0,0,0\n< ERR 2\n"
                   "> SPI 5,0,0,1\n< ERR 2\n> 3MR 0,0,0\n< ERR 2\n> MR 0\n> XMR 0\n> SAR 5,0,0,1\n"
                   "> CM 1\n> 2MR 5,0\n> 2MA 5,0\n< ERR 2\n@ 300\n> ?PE\n< 5\n> RESET\n"
                   // The end of a jog is not known yet; the command is dropped then.
                   "> JGF\n> 2MR 0,0\n@ 200\n> ?ERR\n< 0\n> JG0\n@ 200\n> ?ERR\n< 2\n> ?ST\n< 33\n"}});
}

TEST(SlimMotionOptions, HowManyCommandsWait) {
  for (const int length : {32, 16, 8}) {
    MotionScript script("buffer_length", std::to_string(length));
    for (int i = 0; i < length; ++i) EXPECT_EQ(script.ask("MR 10"), "(nothing)");
    EXPECT_EQ(script.ask("MR 10"), "ERR 8");
    EXPECT_EQ(script.ask("T1MR 10"), "(nothing)");
    script.pass(5000);
    EXPECT_EQ(script.ask("?PE"), std::to_string(10 * length));
  }
}

TEST(SlimMotionOptions, HowMovesOfOneAxisSpeedUp) {
  // 1000 pulses at 1000: with 1000, 4000 and (10 pulses per unit) 10000 pulses/s2 within 2, 1.25 and 1.1 s.
  const std::string begin = "> T1PR2=4000\n> T2PN45=10\n> MR 1000\n> T1MR 1000\n> T2MR 100\n";
  play_all(
      "single_axis_profile",
      {{"trapezoid_with_va", begin + "@ 1101\n> ?PE\n< 1000\n> ?T1PE\n< 1000\n> ?T2PE\n< 100\n"},
       {"trapezoid_with_tva", begin + "@ 1001\n> ?PE\n< 500\n@ 99\n> ?T2ST\n< 259\n@ 1\n> ?T2ST\n< 1\n"
                                      "@ 149\n> ?T1ST\n< 259\n@ 1\n> ?T1ST\n< 1\n@ 749\n> ?ST\n< 259\n@ 1\n"
                                      "> ?ST\n< 1\n> ?PE\n< 1000\n"
                                      // A jog at 400: 20 + 20 after 0.1 s and a stop.
                                      "> T1VJ=0.4\n> T1JGF\n@ 101\n> T1JG0\n@ 200\n> ?T1PE\n< 1040\n"},
       // As fast and as slow as numbers allow.
       {"trapezoid_with_tva", "> PR2=1e9\n> PN45=2000000\n> MR 0.001\n@ 2002\n> ?PE\n< 0.001\n> ?ST\n< 1\n"},
       {"trapezoid_with_tva",
        "> PR2=2e-6\n> PN46=2000000000\n> MR 2e9\n@ 1000\n> ?ST\n< 259\n> JGF\n< ERR 3\n"
        "> TASTOP\n> JGF\n@ 1000\n> JG0\n"}});
}

TEST(SlimMotionOptions, TheWayHome) {
  // 150 pulses before the input comes on, and 50 to stop.
  const std::string home = "> H\n@ 201\nHORG = 1\n> ?PE\n< ";
  const std::string there = "\n@ 300\n> ?PE\n< 0\n> ?ST\n< 17\n> MA ";
  play_all("homing", {{"at_vj_backwards_to_horg_then_0", home + "-150" + there + "1\n"},
                      {"at_vj_forwards_to_horg_then_0", home + "150" + there + "-1\n"}});
}

TEST(SlimMotionOptions, AvmAndMotion) {
  const std::string avm = "AIN = 400\n@ 1\n> AVM\n@ 141\n> ?PE\n< ";
  // At 400 within 40 ms and 8 pulses; 100 ms more, and 8 to stop.
  play_all("analog_speed",
           {{"sets_the_speed_only", avm + "0\n> ?MD\n< 5\n> ?ST\n< 1\n> MR 1000\n> AVM\n"},
            {"starts_a_jog",
             avm + "48\n> ?MD\n< 5\n> JG0\n@ 100\n> ?PE\n< 56\n> JGR\n@ 100\n> AVM\n@ 500\n> JG0\n"},
            // Without a voltage it waits for one.
            {"starts_a_jog", "> AVM\n@ 100\n> ?PE\n< 0\nAIN = 400\n@ 142\n> ?PE\n< 48\nAIN = 0\n@ 100\n"},
            {"starts_a_jog", "> JGF\n@ 201\n> AVM\n@ 200\n> ?PE\n< 200\nAIN = 400\n@ 142\n> ?PE\n< 248\n"},
            // A refused command changes no speed.
            {"starts_a_jog",
             "AIN = 400\n> MR 1000\n@ 501\n> AVM\n< ERR 3\n@ 600\n> ?PE\n< 1000\n> TAPZ\n> AVM\n< ERR 6\n"
             "> TAUPZ\n> HOFF\n> AVM\n< ERR 9\n> ?MD\n< 0\n"}});
}

TEST(SlimMotionOptions, PwmInKilohertz) {
  for (const bool in_khz : {false, true}) {
    MotionScript script("pwm_units", in_khz ? "khz_and_percent" : "hz_and_percent");
    EXPECT_EQ(script.ask(in_khz ? "PWM P1,0.01,25" : "PWM P1,10,25"), "(nothing)");
    int on = 0;
    for (int i = 0; i < 1000; ++i, script.pass(1)) on += script.output(1) ? 1 : 0;
    EXPECT_EQ(on, 250);
    EXPECT_EQ(script.ask("PWM P1,1000,5"), "(nothing)");
    EXPECT_EQ(script.device().state().chain.module_at(0).outputs[0].frequency_hz, in_khz ? 1e6 : 1e3);
    EXPECT_EQ(script.ask("PWM P1,1001,5"), in_khz ? "ERR 2" : "(nothing)");
  }
}

TEST(SlimMotionOptions, WhatIsRefusedForAModuleWithALetter) {
  const std::string map = "> TX=0\n> TY=1\n> T1MR 5\n< ERR 4\n> T1MA 5\n< ERR 4\n";
  play_all(
      "reserved_module",
      {{"moves_jogs_homing_and_thrust_by_number",
        map + "> T1JGF\n< ERR 4\n> T1JGR\n< ERR 4\n> T1FT 5\n< ERR 4\n> T1H\n< ERR 4\n"},
       // A path waits for the jog's end.
       {"moves_by_number", map + "> T1JGF\n> 2MR 30,40\n@ 201\n> ?T1PE\n< 150\n> ?PE\n< 0\n> T1JG0\n@ 800\n"
                                 "> ?T1PE\n< 240\n> ?PE\n< 30\n> T1FT 5\n@ 10\n> ?T1MD\n< 3\n> T1JG0\n"
                                 "> T1H\n@ 201\nT1HORG = 1\n@ 200\n> ?T1PE\n< 0\n> ?T1ST\n< 49\n"}});
}

// The cases were found while the motion code was written.
TEST(SlimMotionOptions, AnalogSpeedNeitherBreaksNorRevivesAJog) {
  // Reversing, without a voltage, and reversing again: it waits for a voltage.
  play_all("analog_speed",
           {{"sets_the_speed_only",
             "> JGF\n@ 201\n> JGR\n> AVM\n> JGF\n@ 200\n> ?PE\n< 200\n> ?MD\n< 5\n"
             "AIN = 400\n@ 142\n> ?PE\n< 248\n"},
            // 400 mV less for JG0: what happens to the voltage afterwards does not matter.
            {"sets_the_speed_only",
             "AIN = 400\n@ 1\n> AVM\n> JGF\n@ 141\n> JG0\n@ 5\nAIN = 0\n@ 5\nAIN = 900\n@ 200\n"
             "> ?PE\n< 56\n> ?ST\n< 1\n"}});
}

}  // namespace options_of_motion_test

}  // namespace understudy::emulator::models::slim
