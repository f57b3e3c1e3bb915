// An indexing table, and a two-axis pick and place.
//
// Rules behind the numbers, for these and the other programs:
//   - one line in each slot of 2 ms (appendix B: 500 Hz); a line that waits is tested again in each slot, the
//     next line comes one slot after the test that succeeds;
//   - the line after Delay_* N in slot t comes in the first slot from max(t + 2, t + N) on;
//   - a move that begins in slot t is at s(j) at ms t + j and over in the first ms with j >= TT. *_Wait finds
//     that out in the first slot after this ms, because lines run before the axes do;
//   - appendix A: with the speed V in pulses/ms and TA, TD in ms, V * (TA + TD) / 2 pulses are ramps, so
//     TT = P / V + (TA + TD) / 2, and s = V * t * t / (2 * TA) on the way up; u ms before the end,
//     V * u * u / (2 * TD) pulses are still to come. Whole pulses count.
#include "tests/emulator/models/simple2_r3/programs/course.h"

namespace understudy::emulator::models::simple2_r3 {
namespace positioning_programs_test {

// 600 RPM * 3200 / 60 s = 32 pulses/ms; TA 100 ms, TD 200 ms: 32 * 150 = 4800 pulses of ramps; of 8000 the
// other 3200 take 100 ms: TT = 400.
//   s(100) = 32 * 100 / 2 = 1600;  s(200) = 4800;  s(300) = 8000 - 32 * 100 * 100 / 400 = 7200
TEST(Program, IndexingTableTurnsAQuarterForEachPress) {
  expect_course(
      {.listing = "indexing_table.lst",
       .host = {{"PROG_MEM0", 8000}, {"PROG_MEM1", 600}, {"PROG_MEM2", 10}, {"PROG_MEM3", 20}},
       .deeds = {input_is_on(1001, 1300, 10), input_is_on(2000, 3000, 10), input_is_on(3006, 3100, 10),
                 input_is_on(3801, 3802, 10), input_is_on(3999, 4001, 10)},
       .until = 5500},
      R"(
0       run L0 +servoA
2       L1
4       L2
6       L3 +D0
8       L4 +D1
10      L5              ; waits. Pressed at 1001: slot 1002 sees it
1004    L6 -D1
+2      L7 -D0
+4      L8              ; 80 ms
+84     L9 +moveA@0     ; 1088
+184    A=1600
+284    A=4800
+384    A=7200
+484    -moveA@8000     ; 1488; found in slot 1490
+488    L10             ; 1492, 25 ms: not before 1517
+514    L11 +D0         ; 1518
+516    L12 C1=1
+518    L13             ; released at 1300: OFF already
+520    L14             ; pass 1 of 4 is over
+522    L4 +D1
+524    L5              ; 1528. Pressed at 2000: slot 2000 sees it
2002    L6 -D1
+2      L7 -D0
+4      L8
+84     L9 +moveA@8000
+184    A=9600
+484    -moveA@16000
+488    L10
+514    L11 +D0
+516    L12 C1=2
+518    L13             ; 2520. Held until 3000
3002    L14             ; pass 2
+2      L4 +D1
+4      L5              ; pressed at 3006: seen at once
3008    L6 -D1
+2      L7 -D0
+4      L8
+84     L9 +moveA@16000
+384    A=23200
+484    -moveA@24000
+488    L10
+514    L11 +D0
+516    L12 C1=3
+518    L13
+520    L14             ; pass 3
+522    L4 +D1
+524    L5              ; 3532. A bounce in ms 3801 alone is not seen, a press from 3999 to 4000 is
4002    L6 -D1
+2      L7 -D0
+4      L8
+84     L9 +moveA@24000
+484    -moveA@32000
+488    L10
+514    L11 +D0
+516    L12 C1=4
+518    L13
+520    L14             ; pass 4: the loop is over
+522    L15 cordA=0
+524    L16 -D0
+526    L17 -servoA
+528    L18 stop
)");
}

// A: 300 RPM = 16 pulses/ms, B: 150 RPM = 8; TA 50 ms, TD 100 ms, so TT = P / V + 75:
//   B  4000 pulses   500 + 75 = 575          B  3000 pulses   375 + 75 = 450
//   B  2001 pulses   250.125 + 75 = 325.125: over in ms 326; in ms 325 it has 0.125 ms to go, which are
//                    8 * 0.125 * 0.125 / 200 = 0.0006 pulses: 2000 are out
//   A 24000 pulses   1500 + 75 = 1575
// On the way: B s(50) = 200, and 100 ms before the end 8 * 100 * 100 / 200 = 400 to go;
//             A s(50) = 400, and 100 ms before the end 800 to go.
TEST(Program, PickAndPlaceCarriesTwoPartsAndLosesOne) {
  expect_course({.listing = "pick_and_place.lst",
                 .host = {{"Parms_Pulse1", 4000},
                          {"Parms_Pulse2", 1000},
                          {"Parms_Pulse3", 24000},
                          {"Parms_Pulse4", 0},
                          {"Parms_Pulse5", 3001},
                          {"Parms_Speed1", 300},
                          {"Parms_Speed2", 150},
                          {"Parms_AccTime1", 5},
                          {"Parms_DecTime1", 10},
                          {"PROG_MEM0", 2}},
                 .deeds = {input_is_on(100, 99999, 10), input_is_on(750, 4000, 9),
                           input_is_on(7000, 99999, 9), input_is_on(6501, 6600, 8)},
                 .until = 11500},
                R"(
0       run L0 +servoA +servoB
2       L1
4       L2
6       L3              ; part at 100
102     L4 +moveB@0     ; 575 ms
152     B=200
577     B=3600
677     -moveB@4000     ; found in slot 678
680     L5 +D4
682     L6              ; 150 ms
832     L7 +moveB@4000  ; 450 ms
1282    -moveB@1000     ; slot 1282 ran before: found in 1284
1286    L8              ; vacuum
1288    L9 +moveA@0     ; 1575 ms, not waited for
1290    L10 +D5
1290..2864  L10 L11     ; L11 in 1292, 1296, ..., 2864 = 1292 + 4 * 393, the first after the end
1338    A=400
2763    A=23200
2863    -moveA@24000
2866    L12 -D5
2868    L13 +moveB@1000
3193    B=3000
3194    -moveB@3001     ; found in slot 3196
3198    L14 -D4
3200    L15             ; 100 ms
3300    L16 +moveA@24000 +moveB@3001
3625    B=1001
3626    -moveB@1000     ; A has longer: 1575 ms
4775    A=800
4875    -moveA@0        ; found in slot 4876
4878    L17 C1=1
4880    L18
4882    L19
4884    L3              ; the next part is there: one slot
4886    L4 +moveB@1000  ; 450 ms
5336    -moveB@4000
5340    L5 +D4
5342    L6
5492    L7 +moveB@4000
5942    -moveB@1000
5946    L8              ; no vacuum since 4000
5948    L20 +D6
5950    L21 -D4
5952    L22             ; acknowledged at 6501: slot 6502
6504    L23 -D6
6506    L24
6508    L3
6510    L4 +moveB@1000
6960    -moveB@4000
6964    L5 +D4
6966    L6
7116    L7 +moveB@4000
7566    -moveB@1000
7570    L8              ; vacuum since 7000
7572    L9 +moveA@0
7574    L10 +D5
7574..9148  L10 L11     ; over at 7572 + 1575 = 9147; 9148 = 7576 + 4 * 393
9147    -moveA@24000
9150    L12 -D5
9152    L13 +moveB@1000
9478    -moveB@3001     ; 9152 + 326; found in slot 9480
9482    L14 -D4
9484    L15
9584    L16 +moveA@24000 +moveB@3001
9910    -moveB@1000
11159   -moveA@0
11162   L17 C1=2
11164   L18
11166   L25 -servoA -servoB
11168   L26 stop
)");
}

}  // namespace positioning_programs_test
}  // namespace understudy::emulator::models::simple2_r3
