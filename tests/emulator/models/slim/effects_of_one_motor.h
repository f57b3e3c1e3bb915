// The manual's first list: the effect of each form, and the conditions that refuse it. Calculated by hand:
//   A move at VM 1000 RPM = 166667 pulses/s with VA 10000 RPM/s = 1666667 pulses/s2, from the first tick
//   after its command on. 10000 pulses take 2 sqrt(10000 / 1666667) = 0.1549 s, 100000 take 0.6 + 0.1 = 0.7
//   s, and if the latter is stopped after 0.3 s, it slows down within 0.1 s and 8333 pulses: 41667 + 8333 =
//   50000. A jog at VJ 100 RPM = 16667 pulses/s that is ended after 0.1 s has run for 0.099 s and 1650
//   pulses, because its two ramps are equal.
//
//   ?ST: 1 servo on, 2 moving, 4 program, 8 pause, 16 homed, 32 error, 128 jog, 256 buffer not empty.
#pragma once

#include "tests/emulator/models/slim/effects.h"

namespace understudy::emulator::models::slim {

inline constexpr Effect kOneMotorEffects[] = {
    // --- motion, jog, home
    {"MA x",
     "MA 10000; @140; ?ST -> 259; @20; ?PE -> 10000; ?ST -> 1; MA -5; @200; ?PE -> -5; {moves MA 5}; "
     "{queued MA 5}"},
    {"MA Rn", "R3=10000; MA R3; @140; ?ST -> 259; @20; ?PE -> 10000; {moves MA R0}; {queued MA R0}"},
    {"MR x", "CS 100; MR 4000; MR 6000; @300; ?PE -> 10100; {moves MR 5}; {queued MR 5}"},
    {"MR Rn", "R64=-10000; MR R64; MR R64; @350; ?PE -> -20000; {moves MR R0}; {queued MR R0}"},
    {"TpMA x",
     "T1MA 10000; @160; ?T1PE -> 10000; ?PE -> 0; {moves T1MA 5}; {new}; T5MA 5 -> ERR 5; "
     "TX=1; T1MA 5 -> ERR 4; TX=0; T0MA 5; @20; ?PE -> 5"},
    {"TpMR x",
     "T3MR 10000; T3MR -4000; @300; ?T3PE -> 6000; {moves T1MR 5}; {new}; T5MR 5 -> ERR 5; "
     "TW=1; T1MR 5 -> ERR 4; TW=8; T1MR 5; @20; ?T1PE -> 5"},
    // A radius from 10 to 15 in one turn: 78.70 long, 0.887 s; it ends at 10 - 15.
    {"SPI X,Y,R,L",
     "{map}; SPI 10,0,360,5; @880; ?ST -> 259; @15; ?ST -> 1; ?PE -> -5; ?T1PE -> 0; "
     "{moves_path SPI 10,0,360,5}"},
    {"JGF",
     "JGF; @100; ?MD -> 2; ?ST -> 131; JG0; @50; ?PE -> 1650; ?ST -> 1; {moves JGF}; {new}; MR 9; "
     "JGF -> ERR 3"},
    {"JGR", "JGR; @100; ?MD -> 2; JG0; @50; ?PE -> -1650; {moves JGR}; {new}; MR 9; JGR -> ERR 3"},
    {"JG0", "JG0; ?ST -> 1; JGF; @10; MR 0; JG0; @50; ?ST -> 1; {new}; {runs}; JG0 -> ERR 3"},
    {"TpJGF",
     "T1JGF; @100; T1JG0; @50; ?T1PE -> 1650; ?PE -> 0; {moves T1JGF}; {new}; T5JGF -> ERR 5; TX=1; "
     "T1JGF -> ERR 4"},
    {"TpJGR",
     "T2JGR; @100; T2JG0; @50; ?T2PE -> -1650; {moves T2JGR}; {new}; T5JGR -> ERR 5; TX=2; "
     "T2JGR -> ERR 4"},
    // This also works for a module that is assigned to an axis.
    {"TpJG0", "T1JGF; @100; TX=1; T1JG0; @50; ?T1PE -> 1650; ?T1ST -> 1; T5JG0 -> ERR 5"},
    {"FT n",
     "FT 500; @5; ?MD -> 3; JG0; @5; ?MD -> 0; FT 0 -> ERR 2; FT 20001 -> ERR 2; {moves FT 20000}; "
     "{new}; MR 9; FT 1 -> ERR 3"},
    {"TpFT n",
     "T1FT 1; @5; ?T1MD -> 3; T1HOFF; {moves T1FT 5}; {new}; T5FT 5 -> ERR 5; TX=1; T1FT 5 -> ERR 4"},
    {"H", "MR 500; H; @200; ?ST -> 259; HORG = 1; @50; HORG = 0; ?PE -> 0; ?ST -> 17; {moves H}; {queued H}"},
    {"TpH",
     "T1CS 9; T1H; @50; T1HORG = 1; @50; ?T1PE -> 0; ?T1ST -> 17; ?ST -> 1; {moves T1H}; {new}; "
     "T5H -> ERR 5; TX=1; T1H -> ERR 4"},
    {"CS x",
     "PN45=2; CS -2.5; ?PE -> -2.5; {new}; MR 10000; CS 7; @100; MR 3; @100; ?PE -> 10; {queued CS 5}"},
    {"TpCS x", "T1CS 40; ?T1PE -> 40; ?PE -> 0; TX=1; T1CS 50; ?T1PE -> 50; T5CS 1 -> ERR 5"},
    // --- motor control
    {"HON", "HOFF; @2; ?ST -> 0; HON; @2; ?ST -> 1; MA 5; @20; ?PE -> 5; {queued HON}"},
    {"TpHON", "T1HOFF; @2; ?T1ST -> 0; ?ST -> 1; T1HON; @2; ?T1ST -> 1; T5HON -> ERR 5; TX=1; T1HON"},
    // Commands are executed in order: the earlier move is completed, the later one is refused.
    {"HOFF", "MR 10000; HOFF; MR 5 -> ERR 9; @200; ?PE -> 10000; ?ST -> 32; {queued HOFF}"},
    {"TpHOFF",
     "T2JGF; @20; T2IN1 = 1; T2HOFF; T2JG0; @50; ?T2ST -> 0; T2MA 5 -> ERR 9; ?ST -> 1; "
     "T5HOFF -> ERR 5"},
    {"RESET",
     "MR 100000; MR 5; NONSENSE -> ERR 1; @301; RESET; ?ERR -> 0; @2; ?ST -> 1; @500; ?ST -> 1; CS 7; "
     "RESET; ?PE -> 7; HOFF; @2; RESET; ?ST -> 1; {new}; {runs}; RESET -> ERR 3"},
    {"TpRESET",
     "T1MR 100000; T1FOO -> ERR 1; T1JGF -> ERR 3; ?T1ERR -> 3; T1RESET; @2; ?T1ST -> 1; "
     "?T1ERR -> 0; ?ERR -> 1; T5RESET -> ERR 5"},
    {"IHOFF",
     "MR 100000; MR 5; @100; IHOFF; @2; ?ST -> 0; MR 5 -> ERR 9; {new}; {full}; IHOFF; @1; ?ST -> 0"},
    {"IHON",
     "IHOFF; IHON; @1; ?ST -> 1; MA 5; @20; ?PE -> 5; {new}; {runs}; IHOFF; IHON; ?ST -> 5; {new}; MR 10000; "
     "HOFF; IHON; @200; ?ST -> 0; {new}; {full}; IHON"},
    // --- outputs
    {"SET Pn",
     "SET P1; @2; P1 is 1; P2 is 0; {new}; MR 10000; SET P4; @150; P4 is 0; @10; P4 is 1; "
     "SET P5 -> ERR 2; {queued SET P1}"},
    {"CLR Pn", "OUTP 15; @2; CLR P2; @2; P1 is 1; P2 is 0; P3 is 1; {queued CLR P1}"},
    {"CHG Pn", "CHG P3; @2; P3 is 1; CHG P3; @2; P3 is 0; {queued CHG P1}"},
    {"PLS Pn,tm", "PLS P1,5; @10; P1 is 1; @15; P1 is 0; {queued PLS P1,5}"},
    {"OUTP n",
     "OUTP 5; @2; P1 is 1; P2 is 0; P3 is 1; P4 is 0; OUTP 10; @2; P1 is 0; P2 is 1; P3 is 0; "
     "P4 is 1; OUTP 16 -> ERR 2; {queued OUTP 1}"},
    {"ISET Pn", "{full}; ISET P1; @1; P1 is 1; ISET P5 -> ERR 2; {new}; {runs}; ISET P2; @1; P2 is 1"},
    {"ICLR Pn", "SET P1; @1; {full}; ICLR P1; @1; P1 is 0; ICLR P0 -> ERR 2"},
    // A period of 100 ms, with the output on for 30 ms.
    {"PWM Pn,f,duty",
     "PWM P1,10,30; @15; P1 is 1; @30; P1 is 0; @70; P1 is 1; @30; P1 is 0; "
     "PWM P1,10,101 -> ERR 2; {queued PWM P1,10,30}"},
    // Half of the way, after 77 ms.
    {"P1SET Pn,x", "P1SET P3,5000; MA 10000; @70; P3 is 0; @15; P3 is 1; {queued P1SET P3,5}"},
    {"P2SET Pn,x",
     "P1SET P2,9000; P2SET P3,5000; MA 10000; @70; P3 is 0; @15; P3 is 1; P2 is 0; @70; P2 is 1; "
     "{queued P2SET P3,5}"},
    {"P1CLR Pn,x", "SET P3; P1CLR P3,5000; MA 10000; @70; P3 is 1; @15; P3 is 0; {queued P1CLR P3,5}"},
    // It switches only once, not on the way back.
    {"P2CLR Pn,x",
     "OUTP 15; P2CLR P4,5000; MA 10000; @70; P4 is 1; @15; P4 is 0; @90; SET P4; MA 0; @200; "
     "P4 is 1; {queued P2CLR P3,5}"},
    // --- program flow
    {"G [addr]",
     "PG; OUT \"A\"; $B OUT \"B\"; .; G; @5; < A; < B; G 1; @5; < B; G $b; @5; < B; G 2 -> ERR 13; "
     "G $C -> ERR 13; {new}; {runs}; G -> ERR 3; {new}; G -> ERR 13"},
    {"JP addr",
     "PG; JP 2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @5; < THERE; JP 2 -> ERR 3; {new}; PG; JP 9; .; "
     "G; @3; ?ERR -> 13; ?ST -> 33"},
    {"JI i,addr",
     "PG; JI 2,2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @5; < PASSED; < THERE; IN2 = 1; @1; G; @5; "
     "< THERE; JI 2,2 -> ERR 3"},
    {"JNI i,addr",
     "PG; JNI 2,2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @5; < THERE; IN2 = 1; @1; G; @5; < PASSED; "
     "< THERE; JNI 2,2 -> ERR 3"},
    {"JZ #int,addr",
     "PG; JZ N5,2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @5; < THERE; N5=-1; G; @5; < PASSED; "
     "< THERE; JZ N5,2 -> ERR 3"},
    {"JNZ #int,addr",
     "PG; JNZ NS(7),2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @5; < PASSED; < THERE; NS(7)=1; G; "
     "@5; < THERE; JNZ N5,2 -> ERR 3"},
    {"JE c,#var,addr",
     "PG; JE 3,N5,2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @5; < PASSED; < THERE; N5=3; G; @5; "
     "< THERE; JE 3,N5,2 -> ERR 3"},
    {"JNE c,#var,addr",
     "PG; JNE R1,R5,2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @5; < PASSED; < THERE; R5=0.5; "
     "G; @5; < THERE; JNE 3,N5,2 -> ERR 3"},
    // The variable is greater.
    {"JG c,#var,addr",
     "PG; JG 3,N5,2; OUT \"PASSED\"; OUT \"THERE\"; .; N5=3; G; @5; < PASSED; < THERE; N5=4; "
     "G; @5; < THERE; JG 3,N5,2 -> ERR 3"},
    {"JNG c,#var,addr",
     "PG; JNG 3,N5,2; OUT \"PASSED\"; OUT \"THERE\"; .; N5=3; G; @5; < THERE; N5=4; G; @5; "
     "< PASSED; < THERE; JNG 3,N5,2 -> ERR 3"},
    {"JTI i,tm,addr",
     "PG; JTI 1,50,2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @30; IN1 = 1; @5; < THERE; IN1 = 0; "
     "@1; G; @45; @15; < PASSED; < THERE; JTI 1,50,2 -> ERR 3"},
    {"JNTI i,tm,addr",
     "IN1 = 1; PG; JNTI 1,50,2; OUT \"PASSED\"; OUT \"THERE\"; .; G; @30; IN1 = 0; @5; < THERE; "
     "IN1 = 1; @1; G; @45; @15; < PASSED; < THERE; JNTI 1,50,2 -> ERR 3"},
    {"CALL addr",
     "PG; CALL $S; CALL $S; RET; $S OUT \"S\"; .; G 0; @5; < S; @5; ?ST -> 1; CALL $S -> ERR 3; "
     "{new}; PG; CALL 0; .; G; @15; ?ST -> 5; @5; ?ERR -> 13"},
    {"RET",
     "PG; CALL 3; OUT \"BACK\"; RET; OUT \"IN\"; RET; .; G; @10; < IN; < BACK; ?ST -> 1; RET -> ERR 3"},
    {"WI i", "PG; WI 3; OUT \"ON\"; .; G; @100; ?ST -> 5; IN3 = 1; @3; < ON; ?ST -> 1; WI 3 -> ERR 3"},
    {"WNI i", "IN3 = 1; PG; WNI 3; OUT \"OFF\"; .; G; @100; ?ST -> 5; IN3 = 0; @3; < OFF; WNI 3 -> ERR 3"},
    {"WT tm", "PG; WT 100; OUT \"LATER\"; .; G; @98; @7; < LATER; WT 1 -> ERR 3"},
    {"DN", "PG; MR 10000; T1MR 100000; DN; OUT \"BOTH\"; .; G; @695; @15; < BOTH; DN -> ERR 3"},
    {"TpDN",
     "PG; MR 100000; T1MR 10000; T1DN; OUT \"T1\"; .; G; @150; @12; < T1; T1DN -> ERR 3; {new}; PG; "
     "T5DN; .; G; @3; ?ERR -> 5"},
    {"SET EVk cond",
     "PG; SET EV2 NZ,N0; ON EV2,$E; WT 20; N0=1; WT 50; OUT \"END\"; RET; $E; OUT \"EVENT\"; RET; "
     ".; G; @22; @10; < EVENT; @70; < END; SET EV9 NZ,N0 -> ERR 2; {new}; {runs}; "
     "SET EV1 NZ,N0 -> ERR 3"},
    {"ON EVk,addr",
     "SET EV1 I,1; ON EV1,$E; PG; WI 8; RET; $E OUT \"EVENT\"; RET; .; G; @20; IN1 = 1; @5; "
     "< EVENT; @20; ?ST -> 5; IN8 = 1; @5; ?ST -> 1; {new}; {runs}; ON EV1,0 -> ERR 3"},
    {"PZ", "MR 100000; @301; PZ; @110; ?PE -> 50000; @500; ?PE -> 50000; JGF -> ERR 6; {new}; {runs}; PZ"},
    {"REDO", "REDO; MR 100000; @301; PZ; @200; REDO; @390; ?ST -> 259; @20; ?PE -> 100000; ?ST -> 1"},
    {"CLR BUF",
     "MR 10000; MR 10000; CLR BUF; @400; ?PE -> 10000; {new}; MR 100000; MR 5; @301; PZ; @110; CLR BUF; "
     "REDO; @900; ?PE -> 50000; {new}; {runs}; CLR BUF"},
    // --- speed: half of VJ is 8333.3 pulses/s; VJ 0.5 RPS and 30 RPM are 5000.
    {"AVM",
     "AIN = 500; @1; AVM; JGF; @1000; ?MD -> 5; JG0; @50; ?PE -> 8325; {new}; {runs}; "
     "AVM -> ERR 3"},
    {"FU=0|1",
     "FU=1; VJ=0.5; JGF; @1000; JG0; @50; ?PE -> 4995; FU=2 -> ERR 2; {new}; {runs}; FU=1 -> ERR 3"},
    {"VJ=x", "VJ=30; ?VJ -> 30; JGF; @1000; JG0; @50; ?PE -> 4995; {new}; {runs}; VJ=3 -> ERR 3"},
    // --- the program as text
    {"PG", "PG; MA 5; ?PE -> ERR 3; .; PG; MA 6; .; PL -> 0: MA 6; {new}; {runs}; PG -> ERR 3"},
    {"PA", "PG; MA 5; .; PA; MA 6; EXIT; PL -> 0: MA 5|1: MA 6; {new}; {runs}; PA -> ERR 3"},
    {"PL", "PL; PG; $A; WT 3; .; PL -> 0: $A|1: WT 3; {new}; {runs}; PL -> ERR 3"},
    {"PE n",
     "PG; MA 5; MA 6; .; PE 1; MA 7; PL -> 0: MA 5|1: MA 7; PE 2 -> ERR 2; PE 0; FOO -> ERR 1; "
     "FOO -> ERR 1; .; PL -> 0: MA 5|1: MA 7; PE 0; FOO -> ERR 1; MA 8; @99; ?PE -> 0; PL -> 0: MA 8|1: MA "
     "7; "
     "{new}; {runs}; PE 0 -> ERR 3"},
    {"PI n",
     "PG; MA 5; MA 6; .; PI 1; MA 7; PL -> 0: MA 5|1: MA 7|2: MA 6; PI 4 -> ERR 2; PI 0; "
     "MA -> ERR 1; MA 8; @99; ?PE -> 0; PL -> 0: MA 8|1: MA 5|2: MA 7|3: MA 6; {new}; {runs}; PI 0 -> ERR 3"},
    {"PD n", "PG; MA 5; MA 6; .; PD 0; PL -> 0: MA 6; PD 1 -> ERR 2; {new}; {runs}; PD 0 -> ERR 3"},
    {"ULP", "PG; MA 5; MA 6; .; ULP -> MA 5|MA 6|END; {new}; {runs}; ULP -> ERR 3"},
    {"DLP", "PG; MA 5; .; DLP; MA 6; .; WT 1; END; PL -> 0: MA 6|1: WT 1; {new}; {runs}; DLP -> ERR 3"},
    // Queued commands are completed.
    {"EXIT", "PG; MR 10000; WI 8; .; G; @20; EXIT; ?ST -> 259; @200; ?PE -> 10000; ?ST -> 1; EXIT"},
    {"ULC",
     "VM=500; ULC -> PN10=500|PN14=100|FU=0|VA=10000|LL=0|EL=0|PN37=34952|PN44=1|PN45=1|PN46=1|PN50=1|"
     "PR2=1000|PR3=100|PR7=0|SYN=0; {new}; {runs}; ULC -> ERR 3",
     1},
    // --- input and output of numbers
    {"GETI",
     "PG; GETI; N3=GETI; OUT N3; .; G; @5; 2.5 -> ERR 1; 7; @5; 40000 -> ERR 2; -8; @5; < -8; "
     "GETI -> ERR 3; N3=GETI -> ERR 3; ?N3 -> -8"},
    {"GETR",
     "PG; GETR; R3=GETR; OUT R3; .; G; @5; FOO -> ERR 1; 7; @5; -0.25; @5; < -0.25; GETR -> ERR 3; PR3=GETR "
     "-> ERR 3; ?PR3 -> 100"},
    {"OUT #var", "N3=-7; OUT N3 -> -7; RS(2000)=0.5; OUT RS(2000) -> 0.5; {new}; {runs}; OUT N3 -> ERR 3"},
    {"OUT \"text\"", "OUT \"a, B\" -> a, B; PG; OUT \"x\"; .; G; @3; < x; {new}; {runs}; OUT \"x\" -> ERR 3"},
    {"DATA idx,r",
     "DATA N7,9; ?N7 -> 9; DATA R7,0.5; ?R7 -> 0.5; DATA N65,1 -> ERR 2; {new}; {runs}; "
     "DATA N7,9 -> ERR 3"},
    {"SAVE D",
     "N3=7; R3=1.5; SAVE D; N3=8; VM=500; off; on; ?N3 -> 7; ?R3 -> 1.5; ?VM -> 1000; {new}; {runs}; "
     "SAVE D -> ERR 3"},
    {"N#=data",
     "N64=32766; ?N64 -> 32766; N0=N64; ?N0 -> 32766; N0=32767 -> ERR 2; N65=1 -> ERR 2; N0=-32768; "
     "?N0 -> -32768; off; on; ?N0 -> 0; {runs}; N0=1 -> ERR 3"},
    {"R#=data",
     "R64=-0.125; ?R64 -> -0.125; R0=R64; ?R0 -> -0.125; R65=1 -> ERR 2; {new}; {runs}; R0=1 -> ERR 3"},
    {"NS(i)=data",
     "NS(2000)=-12; ?NS(2000) -> -12; NS(2001)=1 -> ERR 2; off; on; ?NS(2000) -> -12; {runs}; "
     "NS(0)=1 -> ERR 3"},
    {"RS(i)=data",
     "N4=2000; RS(N4)=0.5; ?RS(2000) -> 0.5; RS(2001)=1 -> ERR 2; off; on; ?RS(2000) -> 0.5; "
     "{runs}; RS(0)=1 -> ERR 3"},
    {"AIN=N#", "AIN = 321; @1; AIN=N9; ?N9 -> 321; AIN=R9; ?R9 -> 321; {runs}; AIN=N9 -> ERR 3"},
    // --- parameters
    {"<name>=data",
     "PR3=12.5; ?PR3 -> 12.5; ?T1PR3 -> 100; PR3=0 -> ERR 2; PN37=34952; PN37=8 -> ERR 2; FOO=1 -> ERR 1; "
     "{new}; {map}; "
     "2MA 100,0; PR2=500 -> ERR 3; {new}; {runs}; PR3=5 -> ERR 3"},
    {"Tp<name>=data",
     "T2PR3=200; ?T2PR3 -> 200; ?PR3 -> 100; T5PR3=200 -> ERR 5; T2PR3=-1 -> ERR 2; {runs}; "
     "T2PR3=100 -> ERR 3"},
    {"DF",
     "VM=500; T1PR3=5; N0=7; DF; ?VM -> 1000; ?T1PR3 -> 100; ?N0 -> 7; MR 9; DF -> ERR 3; {new}; "
     "FT 5; DF -> ERR 3; {new}; JGF; @9; TAPZ; @99; DF -> ERR 3"},
    {"SAVE C", "VM=500; N3=7; SAVE C; VM=600; off; on; ?VM -> 500; ?N3 -> 0; {runs}; SAVE C -> ERR 3"},
    {"SAVE P", "PG; MA 5; .; SAVE P; PA; MA 6; .; off; on; PL -> 0: MA 5; {runs}; SAVE P -> ERR 3"},
    {"RESET H",
     "N0=7; VM=500; CS 9; SET P1; TX=1; HOFF; @2; RESET H; @1; ?N0 -> 0; ?VM -> 1000; ?PE -> 0; "
     "?ST -> 1; P1 is 0; T1MA 5; {runs}; RESET H -> ERR 3"},
    {"T0SYN=n", "T0SYN=2; ?T0SYN -> 2; T5SYN=2 -> ERR 5; {runs}; T0SYN=1 -> ERR 3"},
    // --- queries
    {"?IN n", "IN1 = 1; IN8 = 1; @1; ?IN -> 129; ?IN 8 -> 1; ?IN 2 -> 0; ?IN 9 -> ERR 2"},
    {"?AIN", "AIN = 1000; @1; ?AIN -> 1000"},
    {"?SW n", "SW6 = 1; @1; ?SW 6 -> 1; ?SW 5 -> 0; ?SW 7 -> ERR 2"},
    {"?ST", "?ST -> 1; {runs}; ?ST -> 5; EXIT; HOFF; @2; FOO -> ERR 1; ?ST -> 32; TAPZ; ?ST -> 40"},
    {"?VER", "?VER -> 1.00"},
    {"?N#", "N64=-5; ?N64 -> -5; NS(7)=6; ?NS(7) -> 6; ?N65 -> ERR 2"},
    {"?R#", "R64=0.1; ?R64 -> 0.1; RS(7)=1e10; ?RS(7) -> 10000000000; ?R65 -> ERR 2"},
    // Two pulses are one unit.
    {"?PE", "PN45=2; MA 5; @20; ?PE -> 5; PN45=1; PN46=1; ?PE 3 -> ERR 1"},
    {"?LL", "LL=75.5; ?LL -> 75.5"},
    {"?EL", "EL=500; ?EL -> 500"},
    {"?VM", "?VM -> 1000; VM=0.5; ?VM -> 0.5; ?T1VM -> 1000"},
    {"?AC", "?AC -> 24"},
    {"?IMX", "?IMX -> 0"},
    {"?IC", "?IC -> 0"},
    {"?FLE", "MR 10000; @200; ?FLE -> 0"},
    {"?MT", "?MT -> 1"},
    {"?MD",
     "?MD -> 0; MR 10000; @5; ?MD -> 1; TASTOP; JGF; @1; ?MD -> 2; TASTOP; FT 1; @1; ?MD -> 3; TASTOP; "
     "{map}; 2MR 9,9; @5; ?MD -> 4"},
    {"?TEMP", "?TEMP -> 25"},
    {"?ERR", "?ERR -> 0; FOO -> ERR 1; N0=40000 -> ERR 2; ?ERR -> 2; RESET; ?ERR -> 0"},
    {"?ERC", "?ERC -> 0; FOO -> ERR 1; N0=40000 -> ERR 2; T5MA 1 -> ERR 5; RESET; ?ERC -> 5,2,1"},
    {"?time", "@3725000; TM=0; ?time -> 1:02:05"},
    {"?TM", "@61000; ?TM -> 61; TM=0; @1999; ?TM -> 1; N0=30; TM=N0; ?TM -> 30; N1=TM; ?N1 -> 30"},
    {"?Tp<name>",
     "?t1err -> 0; T1CS 8; ?T1PE -> 8; ?T5PE -> ERR 5; ?T1FOO -> ERR 1; T1IN3 = 1; @1; ?T1IN 3 -> 1"},
};

}  // namespace understudy::emulator::models::slim
