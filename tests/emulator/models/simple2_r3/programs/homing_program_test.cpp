// Homing with an alarm on the way. The rules are those in positioning_programs_test.cpp.
#include "tests/emulator/models/simple2_r3/programs/course.h"

namespace understudy::emulator::models::simple2_r3 {
namespace homing_program_test {

// 3000 pulses per revolution: homing at 20 RPM is 1 pulse/ms, its ramps of 10 ms take 5 pulses, so s(j) = j -
// 5 from 10 ms on. The way to work is 200 RPM = 10 pulses/ms with ramps of 20 ms: TT = P / 10 + 20.
const std::vector<std::pair<std::string, Value>> kMachine = {
    {"DIN0_Aaxis_Alarm", 1},    {"DIN1_Aaxis_Ready", 1},  {"DIN2_Aaxis_UP_Limit", 1},
    {"DIN3_Aaxis_DN_Limit", 1}, {"DIN4_Aaxis_Home", 1},   {"DOUT0_Aaxis_SVON", 1},
    {"Aaxis_Resoultion", 3000}, {"Aaxis_Home_Speed", 20}, {"Aaxis_Home_AccTime", 1},
    {"PROG_MEM0", 200},         {"PROG_MEM1", 2},         {"PROG_MEM2", 500}};

Given machine_with_home(world::PulseSpan home) {
  world::PlantSetup machine;
  machine.home = home;
  Given given;
  given.plant[0] = machine;
  return given;
}

Given machine_between(std::int64_t lower_limit, std::int64_t upper_limit) {
  world::PlantSetup machine;
  machine.lower_limit = lower_limit;
  machine.upper_limit = upper_limit;
  Given given;
  given.plant[0] = machine;
  return given;
}

// An input is seen in the ms that it comes, a switch of the machine in the ms after the one that moved it
// there. An alarm stops the axis before the pulse of its ms. Homing, in the negative direction first: down
// to a standstill beyond the switch's edge, back to it, and there it is 0.
TEST(Program, HomingBeginsAgainAfterAnAlarmAndFindsHome) {
  expect_course({.listing = "homing_with_alarm.lst",
                 .given = machine_with_home({-200, -100}),
                 .host = kMachine,
                 .deeds = {input_is_on(51, 131, 1), input_is_on(121, 541, 0), input_is_on(301, 350, 10),
                           input_is_on(601, 99999, 1)},
                 .until = 1000},
                R"(
0       run L0 +servoA +D0
2       L1              ; until Ready
51      +readyA         ; slot 52
54      L2 +moveA@0 +homingA
56..122 L3 L4
64      A=-5
120     A=-61           ; s(66)
121     +alarmA -homingA -moveA@-61
124     L5              ; L4 found homing over in slot 122; L5 asks why
126     L12 +D6
128     L13 -servoA -D0
130     L14             ; acknowledged at 301: slot 302
131     -readyA
304     L15 +D1
306     L16             ; 200 ms
506     L17 -D1
508     L18             ; until the drive takes its alarm away
541     -alarmA         ; slot 542
544     L19 -D6
546     L20 C1=1
548     L21
550     L0 +servoA +D0
552     L1
601     +readyA
604     L2 +moveA@-61 +homingA
606..680    L3 L4       ; L4 in 608 + 4n: 680 is the first after 678
648     A=-100          ; 39 pulses: s(44). The switch is on
658     A=-105          ; 10 ms and 5 pulses to stand still
668     A=-103          ; and back: 5 pulses in 10 + 10 ms, a triangle; after 10 ms 2.5, that is 2
678     -moveA@0 -homingA +homeA
682     L5
684     L6
686     L7 +D4
688     L8
690     L9
692     L10 +moveA@0    ; TT = 70
712     A=100           ; 10 * 20 / 2
762     -moveA@500      ; found in slot 764
766     L11 stop
)");
}

// The alarm comes with the slot that looks for it.
TEST(Program, HomingSeesAnAlarmInTheVeryMs) {
  expect_course({.listing = "homing_with_alarm.lst",
                 .host = kMachine,
                 .deeds = {input_is_on(51, 99999, 1), input_is_on(120, 99999, 0)},
                 .until = 1000},
                R"(
0       run L0 +servoA +D0
2       L1
51      +readyA
54      L2 +moveA@0 +homingA
56..120 L3 L4           ; L3 in 56 + 4n: 120
120     +alarmA -homingA -moveA@-60
122     L12 +D6
124     L13 -servoA -D0
126     L14             ; for ever: nobody acknowledges
)");
}

// There is no home switch between the limits. The search reverses at the first limit, at once and from
// standstill, and gives up at the second.
TEST(Program, HomingWithoutASwitchGivesUpAtTheSecondLimit) {
  expect_course({.listing = "homing_with_alarm.lst",
                 .given = machine_between(-150, 150),
                 .host = kMachine,
                 .deeds = {input_is_on(51, 99999, 1)},
                 .until = 1000},
                R"(
0       run L0 +servoA +D0
2       L1
51      +readyA
54      L2 +moveA@0 +homingA
56..518 L3 L4           ; L4 in 58 + 4n: 518 is the first after 515
209     A=-150          ; s(155)
210     +lowerA         ; s(j) the other way from 209 on
214     A=-149          ; s(5) = 25 / 20 = 1.25
215     -lowerA
514     A=150           ; 300 pulses: s(305)
515     +upperA -homingA -moveA@150
520     L5
522     L6
524     L22 +D5
526     L23 -servoA -D0
528     L24 stop
)");
}

}  // namespace homing_program_test
}  // namespace understudy::emulator::models::simple2_r3
