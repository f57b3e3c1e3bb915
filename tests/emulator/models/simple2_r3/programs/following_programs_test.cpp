// Speed from outside: an encoder that is followed, and a potentiometer. The rules are those in
// positioning_programs_test.cpp.
#include <algorithm>

#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/models/simple2_r3/programs/course.h"

namespace understudy::emulator::models::simple2_r3 {
namespace following_programs_test {

// The line's encoder: at rest, 2 counts a ms from 104 to 600, at rest, then from 704 on 1 a ms, from 800 on
// back by 1 a ms, at rest from 850 on, and from 1004 on 20 a ms.
std::int64_t line_counts(Tick ms) {
  const auto since = [&](Tick begin, Tick end) { return std::clamp<Tick>(ms, begin, end) - begin; };
  return 500 + 2 * since(104, 600) + since(704, 800) - since(800, 850) + 20 * since(1004, 2000);
}

// Sync mode takes what was counted every 5 ms (appendix B: 200 Hz), here at 10, 15, 20, ..., and sends its
// 3/2 over the next 5 ms, keeping the half pulse. In each period that begins at p and is over when p + 4 is:
//   A = 3/2 * (counts at p - counts when it began), rounded down.
// From 1010 on 100 counts a period would be 150 pulses; SyncRPM 300 are 16 pulses/ms, 80 a period, and what
// is lost is not caught up.
TEST(Program, EncoderFollowerFeedsTwoLengths) {
  expect_course({.listing = "encoder_follower.lst",
                 .host = {{"PROG_MEM0", 900}, {"PROG_MEM1", 2}, {"Axis_SyncRPM", 300}},
                 .encoder_a = line_counts,
                 .until = 1500},
                R"(
0       run L0 +servoA
2       L1 Axis_EncSync_NUM=3
4       L2 Axis_EncSync_DEN=2
6       L3              ; from 500 counts on
8       L4 +D0
10      L5 modeA=3
12..556 L6 L7           ; L6 in 12 + 4n. 2 * (t - 104) counts: 896 at 552, 904 at 556
105     +moveA@0        ; 2 counts so far: 3 pulses, from 105 to 109
109     A=3
110     A=6             ; 12 counts, 18 pulses: 15 in this period, 3 a ms
114     A=18
554     A=1338          ; 3/2 * 2 * (550 - 104)
557     A=1347          ; and 3 ms of the next period
558     L8 modeA=0 -moveA@1347
560     L9 -D0
562     L10 +D1
564     L11             ; 64 ms
628     L12 -D1
630     L13 C1=1
632     L14
634     L15
636     L3              ; from 500 + 992 counts on
638     L4 +D0
640     L5 modeA=3
642..1050   L6 L7       ; L6 in 642 + 4n. 46 + 20 * (t - 1004) counts: 886 at 1046, 966 at 1050
705     +moveA@1347     ; 1 count: 1 pulse of 1.5
709     A=1348
714     A=1356          ; 6 counts: 9
804     A=1491          ; 96 counts: 144
809     A=1483          ; 91 counts: 136.5
854     A=1416          ; 46 counts: 69
855     -moveA@1416     ; nothing was counted since 850
1005    +moveA@1422     ; 20 counts: 30 pulses, 6 a ms
1009    A=1446
1010    A=1462          ; at the top speed: 16 a ms
1014    A=1526
1051    A=2118          ; 1446 + 42 * 16
1052    L8 modeA=0 -moveA@2118
1054    L9 -D0
1056    L10 +D1
1058    L11
1122    L12 -D1
1124    L13 C1=2
1126    L14
1128    L16 -servoA
1130    L17 stop
)");
}

Deed potentiometer_goes(Tick at, int millivolts) {
  return {at, [millivolts](OneSimple2& box) { box.world().set_external_input(0, kFirstAnalog, millivolts); }};
}

// 200 counts of Analog_A a volt, 30 mRPM a count: 5 V are 30 RPM. VelMode_ACC 25000 is 0.025 RPM in each step
// of 0.5 ms, speed first (appendix B: 2 kHz). With 6000 pulses per revolution 1 RPM makes 0.05 pulses a step,
// so after n steps
//   from rest:          0.05 * 0.025 * n * (n + 1) / 2 = 0.000625 * n * (n + 1) pulses,
//   at a speed of v:    0.05 * v * n                                            pulses,
//   slowing down from v: 0.05 * v * n - 0.000625 * n * (n + 1)                  pulses.
// The half of a pulse that is left over stays for the next one.
TEST(Program, AnalogSpeedFollowsThePotentiometer) {
  expect_course({.listing = "analog_speed.lst",
                 .host = {{"Aaxis_Resoultion", 6000}, {"Axis_VelMode_ACC", 25000}},
                 .deeds = {{potentiometer_goes(101, 5000), potentiometer_goes(1003, 2500),
                            potentiometer_goes(1500, 100), potentiometer_goes(2000, 10000)},
                           input_is_on(2501, 2600, 10)},
                 .until = 3500},
                R"(
0       run L0 +servoA
2       L1 +D0
4..102  L2 L3 L4 L5 L6      ; below 40 counts: 10 ms a round
10      modeA=1             ; at 0 RPM
104..1502   L2 L3 L5 L6     ; 8 ms a round. L2 reads 1000 counts in 104
108     Aaxis_DirectmRPM=30000 +moveA@0
207     A=25                ; 100 ms, 200 steps: 25.125
707     A=900               ; 1200 steps: 30 RPM, and 900.75
1000    A=1779              ; 3 a ms: 900.75 + 293 * 3 = 1779.75
1012    Aaxis_DirectmRPM=15000  ; read by L2 in 104 + 8 * 113 = 1008. Until 1011: 1812.75
1111    A=2087              ; 200 steps: 300 - 25.125, that is 2087.625
1311    A=2487              ; 600 steps: 15 RPM, and 900 - 225.375 more: 2487.375
1504..2002  L2 L3 L4 L5 L6  ; L2 reads 20 counts in 104 + 8 * 175 = 1504
1510    Aaxis_DirectmRPM=0  ; until 1509: 2487.375 + 198 * 1.5 = 2784.375
1809    -moveA@3009         ; 600 steps: 450 - 225.375 more
2004..2506  L2 L3 L5 L6     ; L2 reads 2000 counts in 1504 + 10 * 50 = 2004
2008    Aaxis_DirectmRPM=60000 +moveA@3009
2107    A=3034              ; 25.125
2507    A=3634              ; 1000 steps: 25 RPM, and 625.625
2508    L7 Aaxis_DirectmRPM=0   ; L6 saw the button in 2010 + 8 * 62 = 2506
2510    L8                  ; until it stands
2757    A=4103              ; 500 steps: 625 - 156.5625, that is 4103.0625
3007    -moveA@4259         ; 1000 steps: 1250 - 625.625 = 624.375 more
3010    L9 modeA=0
3012    L10 -D0
3014    L11 -servoA
3016    L12 stop
)");
}

}  // namespace following_programs_test
}  // namespace understudy::emulator::models::simple2_r3
