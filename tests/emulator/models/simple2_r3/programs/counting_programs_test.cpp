// A batch by counters, and a mixer by timers. The rules are those in positioning_programs_test.cpp.
#include "tests/emulator/models/simple2_r3/programs/course.h"

namespace understudy::emulator::models::simple2_r3 {
namespace counting_programs_test {

// The pusher: 300 RPM = 16 pulses/ms, TA = TD = 40 ms, stroke 1609: TT = 1609 / 16 + 40 = 140.5625, so it is
// over in ms 141. In ms 140 it has 0.5625 ms to go, that is 16 * 0.5625^2 / 80 = 0.06 pulses: 1608 are out.
TEST(Program, BatchCountsPiecesIntoRowsAndRowsIntoABatch) {
  expect_course({.listing = "counted_batch.lst",
                 .host = {{"PROG_MEM0", 3},
                          {"PROG_MEM1", 2},
                          {"PROG_MEM2", 300},
                          {"PROG_MEM3", 4},
                          {"PROG_MEM4", 51},
                          {"PROG_MEM5", 1609}},
                 .deeds = {input_is_on(100, 180, 10), input_is_on(301, 351, 10), input_is_on(401, 402, 10),
                           input_is_on(500, 505, 10), input_is_on(700, 900, 10), input_is_on(1000, 1002, 10),
                           input_is_on(1007, 1011, 10)},
                 .until = 1500},
                R"(
0       run L0 +servoB
2       L1
4       L2
6       L3 C2=2
8       L4              ; is 0 already
10      L5 +D0
12      L6              ; piece 1 comes at 100
102     L7              ; and has passed at 180
182     L8 C1=1
184     L9
186     L10
188     L6              ; piece 2 comes at 301: slot 302
304     L7              ; passed at 351: slot 352
354     L8 C1=2
356     L9
358     L10
360     L6              ; a crumb, in ms 401 only, is not seen; piece 3 comes at 500
502     L7              ; passed at 505: slot 506
508     L8 C1=3
510     L9              ; full
512     L11 -D0
514     L12             ; 51 ms: not before 565
566     L13 +moveB@0
706     B=1608
707     -moveB@1609     ; found in slot 708
710     L14 PROG_VAR0=-1609
712     L15 +moveB@1609
852     B=1
853     -moveB@0
856     L16 C2=1
858     L17             ; one more row
860     L4 C1=0
862     L5 +D0
864     L6              ; a piece stands there since 700
866     L7              ; until 900
902     L8 C1=1
904     L9
906     L10
908     L6              ; the next one is there from 1000 to 1001
1002    L7              ; gone
1004    L8 C1=2
1006    L9
1008    L10
1010    L6              ; there, from 1007 to 1010
1012    L7
1014    L8 C1=3
1016    L9
1018    L11 -D0
1020    L12             ; not before 1071
1072    L13 +moveB@0
1213    -moveB@1609
1216    L14             ; VAR32 is that already
1218    L15 +moveB@1609
1359    -moveB@0
1362    L16 C2=0
1364    L17
1366    L18 +D6
1368    L19 -servoB
1370    L20 stop
)");
}

const std::vector<std::pair<std::string, Value>> kMixture = {
    {"PROG_MEM0", 2000}, {"PROG_MEM1", 500}, {"PROG_MEM2", 40}};

// A timer counts ms from the slot of its Timer_Start. The four lines that poll take 8 ms.
TEST(Program, MixerDosesByOneTimerAndEndsByTheOther) {
  expect_course({.listing = "dosing_mixer.lst",
                 .host = kMixture,
                 .deeds = {input_is_on(1301, 2000, 10)},
                 .until = 3500},
                R"(
0       run L0
2       L1
4       L2 +D0
6       L3              ; Timer1 = t - 6
8       L4              ; Timer2 = t - 8: 500 at 508
10..510 L5 L6 L7 L8     ; L7 in 14 + 8n: 14 + 8 * 62 = 510
512     L9 +D1
+2      L10             ; 40 ms
+42     L11 -D1
+44     L12             ; 556: Timer2 = t - 556: 500 at 1056
+46     L13 C1=1
+48     L14
+50..+550   L5 L6 L7 L8     ; L7 in 566 + 8n: 566 + 8 * 62 = 1062
1064    L9 +D1
+2      L10
+42     L11 -D1
+44     L12             ; 1108
+46     L13 C1=2
+48     L14
+50..+242   L5 L6 L7 L8     ; the door opens at 1301; L5 in 1114 + 8n: 1114 + 8 * 24 = 1306
1308    L15             ; Timer1 stands at 1302
1310    L16             ; Timer2 stands at 1310 - 1108 = 202
1312    L17 -D0
1314    L18 +D6
1316    L19             ; closed at 2000
2002    L20 -D6
2004    L21 +D0
2006    L22             ; Timer1 = 1302 + t - 2006: 2000 at 2704
2008    L23             ; Timer2 = 202 + t - 2008: 500 at 2306
2010    L24
2012..2312  L5 L6 L7 L8     ; L7 in 2016 + 8n: 2016 + 8 * 37 = 2312
2314    L9 +D1
+2      L10
+42     L11 -D1
+44     L12             ; 2358
+46     L13 C1=3
+48     L14
+50..+396   L5 L6 L7 L8     ; L6 in 2366 + 8n: 2366 + 8 * 43 = 2710
2712    L25 -D0
2714    L26             ; Timer1 stands at 1302 + 2714 - 2006 = 2010
2716    L27             ; Timer2 stands at 2716 - 2358 = 358
2718    L28 PROG_MEM10=2010
2720    L29 PROG_MEM11=358
2722    L30 stop
)");
}

// "1.41 以前": Jump_Timer1_GE does not work, so the same mixer never ends; the host stops it at last, and all
// that the program has set stays.
TEST(Program, MixerNeverEndsWithFirmware141) {
  expect_course({.listing = "dosing_mixer.lst",
                 .given = {.firmware = 141},
                 .host = kMixture,
                 .deeds = {{host_writes(2801, "PROG_MAIN_RunTime_END", 1)}},
                 .until = 4000},
                R"(
0       run L0
2       L1
4       L2 +D0
6       L3
8       L4
10..510 L5 L6 L7 L8
512     L9 +D1
+2      L10
+42     L11 -D1
+44     L12             ; from one Timer_Reset to the next 552 ms: 500, 6 until L7, and 46 to dose
+46     L13 C1=1
+48     L14
+50..+550   L5 L6 L7 L8
1064    L9 +D1
+2      L10
+42     L11 -D1
+44     L12
+46     L13 C1=2
+48     L14
+50..+550   L5 L6 L7 L8
1616    L9 +D1
+2      L10
+42     L11 -D1
+44     L12
+46     L13 C1=3
+48     L14
+50..+550   L5 L6 L7 L8     ; Timer1 is 2000 at 2006: nothing happens
2168    L9 +D1
+2      L10
+42     L11 -D1
+44     L12
+46     L13 C1=4
+48     L14
+50..+550   L5 L6 L7 L8
2720    L9 +D1
+2      L10
+42     L11 -D1
+44     L12
+46     L13 C1=5
+48     L14
+50..+80    L5 L6 L7 L8     ; the last slot is 2800
2801    stop            ; the stirrer goes on
)");
}

}  // namespace counting_programs_test
}  // namespace understudy::emulator::models::simple2_r3
