// A program that writes and reads every class of parameters. The rules are those in
// positioning_programs_test.cpp; one line, one slot, so line n runs at 2n ms until the first jump.
#include "emulator/device/axes.h"
#include "tests/emulator/models/simple2_r3/programs/course.h"

namespace understudy::emulator::models::simple2_r3 {
namespace recipe_program_test {

// What a parameter cannot hold becomes the nearest that it can. The encoder of B has turned back by 300
// counts within the last 100 ms, half a revolution of 600: -300 RPM.
TEST(Program, ChangeoverMakesEveryKindOfParameterFromARecipe) {
  expect_course({.listing = "recipe_changeover.lst",
                 .host = {{"PROG_MEM0", 12},
                          {"PROG_MEM1", 250},
                          {"PROG_MEM2", 300},
                          {"PROG_MEM3", 40000},
                          {"PROG_MEM4", 4000},
                          {"PROG_VAR1", 77},
                          {"PROG_VAR3", 5},
                          {"Aaxis_Home_AccTime", 7},
                          {"Counter1_Value", 5},
                          {"Axis_SyncSlope", 9},
                          {"Axis_SyncRPM", 100},
                          {"Baxis_SyncRPM", 200},
                          {"ENCB_Resoultion", 600}},
                 .deeds = {{{-50, [](OneSimple2& box) { box.device().axes()->set_encoder(1, -300); }}}},
                 .until = 500},
                R"(
0       run L0 PROG_VAR0=100
2       L1 CalcREG=3000             ; 12 mm * 250
4       L2 Parms_Pulse1=3000
6       L3 Parms_Pulse2=-3000
8       L4 Parms_Speed1=300
10      L5 Parms_AccTime1=4
12      L6 Parms_DecTime1=5
14      L7 CalcREG=-30000           ; 300 * -100
16      L8 Parms_mRPM1=-30000
18      L9 Aaxis_Home_Speed=32768   ; 40000 is too much
20      L10 Baxis_Home_Speed=32767
22      L11 Aaxis_Resoultion=4000
24      L12 Aaxis_Home_AccTime=0    ; -1 is too little
26      L13 Axis_VelMode_ACC=1      ; 0 is too little
28      L14 ENCA=-5
30      L15 CalcREG=95
32      L16 cordA=95
34      L17 PROG_VAR1=0             ; nothing on AIN_A
36      L18
38      L19 CalcREG=100
40      L20 ENCA_Resoultion=100
42      L21 PROG_VAR2=-300
44      L22
46      L23 C1=0                    ; -1 is too little
48      L24 C2=40000                ; 16 bits without a sign
50      L25                         ; more than 0: the next line
52      L26 Timer1_Value=4294967295 ; 32 bits without a sign
54      L27                         ; more than 40000: jumps
56      L29 Axis_EncSync_NUM=0
58      L30 Axis_EncSync_DEN=7
60      L31 Axis_SyncSlope=0
62      L32 Axis_SyncRPM=3000       ; 3000 at most
64      L33 Baxis_SyncRPM=3000
66      L34
68      L35 PROG_VAR3=0             ; what is not defined reads 0
70      L36 +servoA
72      L37 Aaxis_Speed=300         ; 300 RPM * 4000 / 60 s = 20 pulses/ms
74      L38 Aaxis_AccTime=4 Aaxis_DecTime=5
76      L39 +moveA@95               ; TT = 3000 / 20 + (40 + 50) / 2 = 195
116     A=-305                      ; 95 - 20 * 40 / 2
246     A=-2780                     ; 25 ms to go: 20 * 25 * 25 / 100 = 125 pulses
271     -moveA@-2905                ; found in slot 272
274     L40 stop
)");
}

}  // namespace recipe_program_test
}  // namespace understudy::emulator::models::simple2_r3
