// Wrong programs, and changes of programs at the wrong moment: each ends or continues as the manual or a
// choice says, and the host is always served. The rules are those in positioning_programs_test.cpp.
#include "tests/emulator/models/simple2_r3/programs/course.h"

namespace understudy::emulator::models::simple2_r3 {
namespace wrong_programs_test {

// "No LOOP inside a LOOP; if there is one the program is forcibly terminated": when it is reached.
TEST(WrongProgram, WithNestedLoopsEndsWhereTheInnerLoopIsReachedAgain) {
  expect_course({.listing = "wrong_nested_loops.lst", .until = 100}, R"(
0       run L0 C1=1
2       L1 C2=1
4       L2              ; no other Loop counts yet: pass 1 of 2
6       L1 C2=2
8       L2              ; pass 2: over
10      L3              ; pass 1 of the outer one
12      L0 C1=2
14      L1 C2=3
16      L2 stop
)");
}

TEST(WrongProgram, WithNestedLoopsEndsAtTheOuterLoopIfThatIsChosen) {
  expect_course({.listing = "wrong_nested_loops.lst",
                 .given = {.choices = {{"loop_nesting", "when_outer_starts"}}},
                 .until = 100},
                R"(
0       run L0 C1=1
2       L1 C2=1
4       L2
6       L1 C2=2
8       L2
10      L3 stop
)");
}

TEST(WrongProgram, WithCommandsThatDoNotExistDoesNothingInTheirSlots) {
  expect_course({.listing = "wrong_commands.lst", .until = 100}, R"(
0       run L0 +D0
2..10   L1-L5
12      L6 +D1
14      L7 stop
)");
}

TEST(WrongProgram, WithACommandThatDoesNotExistEndsIfThatIsChosen) {
  expect_course(
      {.listing = "wrong_commands.lst", .given = {.choices = {{"unknown_command", "ends"}}}, .until = 100},
      R"(
0       run L0 +D0
2       L1 stop
)");
}

// The move: 16 pulses/ms, ramps of 40 ms, 640 pulses: TT = 80.
TEST(WrongProgram, WithFlagsThatNoLineHasGoesToLine0OrWaits) {
  expect_course({.listing = "wrong_flags.lst",
                 .host = {{"PROG_MEM0", 2},
                          {"PROG_MEM1", 640},
                          {"Aaxis_Speed", 300},
                          {"Aaxis_AccTime", 4},
                          {"Aaxis_DecTime", 4}},
                 .until = 500},
                R"(
0       run L0 C1=1
2       L1
4       L2              ; line 0
6       L0 C1=2
8       L1
10      L2
12      L0 C1=3
14      L1              ; 3 > 2
16      L3 +servoA
18      L4 +moveA@0
20      L5              ; in its place
98      -moveA@640      ; found in slot 100
102     L6              ; from line 0 on: pass 1 of 2
104     L0 C1=4
106     L1
108     L3
110     L4 +moveA@640
112     L5
190     -moveA@1280
194     L6
196     L7 stop
)");
}

TEST(WrongProgram, WithoutEndStopsAfterLine255) {
  expect_course({.listing = "wrong_no_end.lst", .first_line = 250, .until = 100}, R"(
0       run L250
2       L251
4       L252
6       L253 C1=1
8       L254 C1=2
10      L255 C1=3
12      stop
)");
}

TEST(WrongProgram, WithoutEndContinuesAtLine0IfThatIsChosen) {
  expect_course({.listing = "wrong_no_end.lst",
                 .given = {.choices = {{"after_last_line", "goes_on_at_0"}}},
                 .deeds = {{host_writes(2 * 256 + 13, "PROG_MAIN_RunTime_END", 1)}},
                 .first_line = 253,
                 .until = 600},
                R"(
0       run L253 C1=1
2       L254 C1=2
4       L255 C1=3
6..516  L0-L255
512     C1=4            ; line 253, the 254th from 6 on
514     C1=5
516     C1=6
518..524    L0-L255
525     stop
)");
}

// Without a program every line is NOP.
TEST(WrongProgram, OfNothingTakes512ms) {
  expect_course(
      {.listing = "wrong_no_end.lst", .deeds = {{host_writes(-1, "PROG_MAIN_Erase_ALL", 1)}}, .until = 600},
      R"(
0       run
0..510  L0-L255
512     stop
)");
}

// Appendix A: at speed 0 a move is "always running". STOP ends it, and with it the wait.
TEST(WrongProgram, ThatMovesAtSpeed0WaitsUntilTheHostStopsTheAxis) {
  expect_course({.listing = "wrong_speed_zero.lst",
                 .host = {{"PROG_MEM0", 1000}},
                 .deeds = {{host_writes(30001, "Aaxis_STOP", 1)}},
                 .until = 30100},
                R"(
0       run L0 +servoA
2       L1 +moveA@0
30001   -moveA@0        ; found in slot 30002
30004   L2 stop
)");
}

const std::vector<std::pair<std::string, Value>> kLongWay = {
    {"PROG_MEM0", 300}, {"PROG_MEM1", 4}, {"PROG_MEM2", 4800}};  // TT = 4800 / 16 + 40 = 340

// Erasing stops the program; the axis and the outputs are not the program's any more. Started again, it
// finds 256 NOPs.
TEST(WrongMoment, ErasedWhileItRunsItStopsAndTheMoveContinues) {
  expect_course({.listing = "endless_blinker.lst",
                 .host = kLongWay,
                 .deeds = {{host_writes(241, "PROG_MAIN_Erase_ALL", 1),
                            host_writes(500, "PROG_MAIN_RunTime_START", 0)}},
                 .until = 1200},
                R"(
0       run L0 +servoA
2       L1
4       L2
6       L3 +moveA@0
8       L4 +D0
10      L5              ; 50 ms
60      L6 -D0
62      L7
112     L8
114     L4 +D0
116     L5
166     L6 -D0
168     L7
218     L8
220     L4 +D0
222     L5              ; until 272
241     stop
346     -moveA@4800
500     run
500..1010   L0-L255
1012    stop
)");
}

TEST(WrongMoment, StartedWhileItRunsItRestartsAtThatLine) {
  expect_course({.listing = "endless_blinker.lst",
                 .host = kLongWay,
                 .deeds = {{host_writes(30, "PROG_MAIN_RunTime_START", 6),
                            host_writes(101, "PROG_MAIN_RunTime_END", 1)}},
                 .until = 500},
                R"(
0       run L0 +servoA
2       L1
4       L2
6       L3 +moveA@0
8       L4 +D0
10      L5              ; until 60
30      L6 -D0          ; which is forgotten
32      L7
82      L8
84      L4 +D0
86      L5
101     stop
346     -moveA@4800
)");
}

// A delay that has begun continues as it began; flags jump to their present places.
TEST(WrongMoment, RewrittenWhileItRunsItContinuesWithTheNewLines) {
  expect_course({.listing = "rewritten_as_it_runs.lst",
                 .deeds = {{host_writes(31, "MAIN_LINE1_DATA1", 4), host_writes(61, "MAIN_LINE0_JMP", 0),
                            host_writes(61, "MAIN_LINE3_JMP", 1)}},
                 .until = 200},
                R"(
0       run L0 C1=1
2       L1              ; 20 ms
22      L2
24      L0 C1=2
26      L1              ; 20 ms; rewritten at 31, read anew at 32: 4 ms from there
36      L2
38      L0 C1=3
40      L1
44      L2
46      L0 C1=4
48      L1
52      L2
54      L0 C1=5
56      L1
60      L2              ; the flag moves at 61
62      L0 C1=6
64      L1
68      L2
70      L3 +D3
72      L4 stop
)");
}

// All flags gone at once: the Jump leads to line 0, which happens to be the same; and a Jump that becomes a
// Jump to itself runs until the host ends it.
TEST(WrongMoment, MadeAJumpToItselfItRunsUntilTheHostEndsIt) {
  expect_course({.listing = "rewritten_as_it_runs.lst",
                 .deeds = {{host_writes(21, "MAIN_LINE0_JMP", 0), host_writes(41, "MAIN_LINE2_JMP", 1),
                            host_writes(60001, "PROG_MAIN_RunTime_END", 1)}},
                 .until = 60100},
                R"(
0       run L0 C1=1
2       L1
22      L2              ; no line has the flag: line 0
24      L0 C1=2
26      L1
46      L2              ; the flag is its own
60001   stop
)");
}

}  // namespace wrong_programs_test
}  // namespace understudy::emulator::models::simple2_r3
