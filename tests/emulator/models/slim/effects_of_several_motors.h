// The manual's second list, in the same form. At TVM 100 and TVA 1000 a path of L takes L / 100 + 0.1 s, or 2
// sqrt(L / 1000) s if L < 10:
//   L  111.8  5       130  20 (10 each)  78.54 (quarter of 50)  63.03 (turn of 10, 5 high)  100
//   s  1.2180 0.1414  1.4  0.3           0.8854                 0.7303                      1.1
// 100 long, it is at 45 after 0.5 s and needs 5 more to stop within 0.1 s.
#pragma once

#include "tests/emulator/models/slim/effects.h"

namespace understudy::emulator::models::slim {

inline constexpr Effect kSeveralMotorsEffects[] = {
    // --- which module is which axis
    {"TX=p",
     "TX=1; TY=0; XMA 50; @50; ?T1PE -> 50; T1MA 5 -> ERR 4; TX=8; T1MA 5; XMA 5 -> ERR 4; TX=6 -> ERR 2; "
     "TX=9 -> ERR 2; TX=0 -> ERR 2; {runs}; TX=2 -> ERR 3"},
    {"TY=p", "TY=2; YMA 50; @50; ?T2PE -> 50; TY=7 -> ERR 2; TX=2 -> ERR 2; {runs}; TY=3 -> ERR 3"},
    {"TZ=p", "TZ=3; ZMA 50; @50; ?T3PE -> 50; TZ=9 -> ERR 2; TY=3 -> ERR 2; {runs}; TZ=2 -> ERR 3"},
    {"TW=p", "TW=1; WMA 50; @50; ?T1PE -> 50; TW=6 -> ERR 2; TZ=1 -> ERR 2; {runs}; TW=2 -> ERR 3"},
    // --- lines
    {"2MA fx,fy",
     "{map}; 2MA 100,50; @1212; ?ST -> 259; @12; ?PE -> 100; ?T1PE -> 50; ?ST -> 1; "
     "{moves_path 2MA 1,2}"},
    {"2MA Rn,Rm",
     "{map}; R1=100; R2=50; 2MA R1,R2; @1212; ?ST -> 259; @12; ?PE -> 100; ?T1PE -> 50; "
     "{moves_path 2MA R1,R2}"},
    {"2MR fx,fy",
     "{map}; CS 10; 2MR 3,4; @137; ?ST -> 259; @10; ?PE -> 13; ?T1PE -> 4; {moves_path 2MR 1,2}"},
    {"2MR Rn,Rm",
     "{map}; R1=3; R2=4; CS 10; PG; 2MR R1,R2; .; G; @137; ?ST -> 259; @10; ?PE -> 13; ?T1PE -> 4; "
     "{stored 2MR R1,R2}"},
    {"3MA fx,fy,fz",
     "{map}; 3MA 30,40,120; @1394; ?ST -> 259; @12; ?PE -> 30; ?T1PE -> 40; ?T2PE -> 120; "
     "{moves_path 3MA 1,2,3}"},
    {"3MA Rx,Ry,Rz",
     "{map}; R1=30; R2=40; R3=120; PG; 3MA R1,R2,R3; .; G; @1394; ?ST -> 259; @12; ?PE -> 30; "
     "?T1PE -> 40; ?T2PE -> 120; {stored 3MA R1,R2,R3}"},
    {"3MR fx,fy,fz",
     "{map}; T2CS 5; 3MR 30,40,-120; @1394; ?ST -> 259; @12; ?PE -> 30; ?T2PE -> -115; "
     "{moves_path 3MR 1,2,3}"},
    {"3MR Rx,Ry,Rz",
     "{map}; R1=30; R2=40; R3=120; T1CS 1; PG; 3MR R1,R2,R3; .; G; @1394; ?ST -> 259; @12; "
     "?T1PE -> 41; {stored 3MR R1,R2,R3}"},
    {"4MA fx,fy,fz,fw",
     "{map}; 4MA 10,-10,10,-10; @294; ?T3ST -> 259; @12; ?PE -> 10; ?T1PE -> -10; ?T2PE -> 10; "
     "?T3PE -> -10; {moves_path 4MA 1,2,3,4}"},
    {"4MA Rx,Ry,Rz,Rw",
     "{map}; R1=10; PG; 4MA R1,R1,R1,R1; .; G; @294; ?T3ST -> 259; @12; ?PE -> 10; "
     "?T3PE -> 10; {stored 4MA R1,R2,R3,R4}"},
    {"4MR fx,fy,fz,fw",
     "{map}; T3CS 7; 4MR 10,10,10,10; @294; ?T3ST -> 259; @12; ?PE -> 10; ?T3PE -> 17; "
     "{moves_path 4MR 1,2,3,4}"},
    {"4MR Rx,Ry,Rz,Rw",
     "{map}; R1=10; T3CS 7; PG; 4MR R1,R1,R1,R1; .; G; @294; ?T3ST -> 259; @12; ?T3PE -> 17; "
     "{stored 4MR R1,R2,R3,R4}"},
    // --- arcs: a quarter of a circle from below its centre, to the right of it; and clockwise, to the left
    {"AA fx,fy,fa",
     "{map}; AA 0,50,90; @879; ?ST -> 259; @12; ?PE -> 50; ?T1PE -> 50; AA 0,50,-90; @900; ?PE -> 0; "
     "?T1PE -> 0; AA 0,0,90; ?ST -> 1; {moves_path AA 0,50,90}"},
    {"AA Rx,Ry,Ra",
     "{map}; R2=50; R3=-90; PG; AA R1,R2,R3; .; G; @879; ?ST -> 259; @12; ?PE -> -50; ?T1PE -> 50; "
     "{stored AA R1,R2,R3}"},
    {"AR fx,fy,fa",
     "{map}; CS 10; AR 0,50,90; @879; ?ST -> 259; @12; ?PE -> 60; ?T1PE -> 50; "
     "{moves_path AR 0,50,90}"},
    {"AR Rx,Ry,Ra",
     "{map}; CS 10; R2=50; R3=-90; PG; AR R1,R2,R3; .; G; @879; ?ST -> 259; @12; ?PE -> -40; "
     "?T1PE -> 50; {stored AR R1,R2,R3}"},
    {"SAA fx,fy,fa,fz",
     "{map}; SAA 10,0,360,5; @724; ?ST -> 259; @12; ?PE -> 0; ?T1PE -> 0; ?T2PE -> 5; "
     "{moves_path SAA 10,0,360,5}"},
    {"SAA Rx,Ry,Ra,Rz",
     "{map}; R1=10; R3=360; R4=5; PG; SAA R1,R2,R3,R4; .; G; @724; ?ST -> 259; @12; ?PE -> 0; "
     "?T2PE -> 5; {stored SAA R1,R2,R3,R4}"},
    {"SAR fx,fy,fa,fz",
     "{map}; CS 3; T2CS 4; SAR 10,0,360,5; @724; ?ST -> 259; @12; ?PE -> 3; ?T1PE -> 0; "
     "?T2PE -> 9; {moves_path SAR 10,0,360,5}"},
    {"SAR Rx,Ry,Ra,Rz",
     "{map}; R1=10; R3=360; R4=-5; CS 3; T2CS 4; PG; SAR R1,R2,R3,R4; .; G; @724; ?ST -> 259; "
     "@12; ?PE -> 3; ?T2PE -> -1; {stored SAR R1,R2,R3,R4}"},
    // --- all axes: 256 + 8 + 1, in a pause with a half-done command
    {"TAPZ",
     "{map}; 2MA 100,0; @501; TAPZ; @110; ?PE -> 50; ?ST -> 265; @500; ?PE -> 50; MA 5 -> ERR 6; "
     "N0=3; TAPZ; {new}; {runs}; TAPZ; ?ST -> 13"},
    {"TAREDO",
     "{map}; TAREDO; 2MA 100,0; @501; TAPZ; @200; TAREDO; @592; ?ST -> 259; @15; ?PE -> 100; "
     "?ST -> 1; {new}; {runs}; TAREDO"},
    {"TAUPZ",
     "{map}; 2MA 100,0; 2MA 0,0; @501; TAUPZ; ?ST -> 259; TAPZ; @110; TAUPZ; ?ST -> 1; @900; ?PE -> 50; "
     "MA 60; @90; ?PE -> 60; {new}; {runs}; TAPZ; TAUPZ; ?ST -> 5"},
    {"TASTOP",
     "{map}; 2MA 100,0; 2MA 0,0; T3JG0; @501; TASTOP; @1; ?PE -> 45; ?ST -> 1; @500; ?PE -> 45; 2MA 0,0; "
     "@600; ?PE -> 0; {new}; TAPZ; TASTOP; ?ST -> 1; {runs}; TASTOP; ?ST -> 1"},
    // --- one axis by its letter, at VM
    {"XMA f32", "TX=1; XMA 10000; @150; ?T1ST -> 259; @10; ?T1PE -> 10000; {moves_axis XMA 5}"},
    {"YMA f32", "TY=2; YMA 10000; @150; ?T2ST -> 259; @10; ?T2PE -> 10000; {moves_axis YMA 5}"},
    {"ZMA f32", "TZ=3; ZMA 10000; @150; ?T3ST -> 259; @10; ?T3PE -> 10000; {moves_axis ZMA 5}"},
    {"WMA f32", "TW=0; WMA 10000; @150; ?ST -> 259; @10; ?PE -> 10000; {moves_axis WMA 5}"},
    {"XMA Rn", "TX=1; R5=10000; PG; XMA R5; .; G; @150; ?T1ST -> 259; @12; ?T1PE -> 10000; {stored XMA R5}"},
    {"YMA Rn", "TY=2; R5=10000; PG; YMA R5; .; G; @150; ?T2ST -> 259; @12; ?T2PE -> 10000; {stored YMA R5}"},
    {"ZMA Rn", "TZ=3; R5=10000; PG; ZMA R5; .; G; @150; ?T3ST -> 259; @12; ?T3PE -> 10000; {stored ZMA R5}"},
    {"WMA Rn", "TW=0; R5=10000; PG; WMA R5; .; G; @150; ?ST -> 259; @12; ?PE -> 10000; {stored WMA R5}"},
    {"XMR f32",
     "TX=1; T1CS 7; XMR 10000; @150; ?T1ST -> 259; @10; ?T1PE -> 10007; XMR 0; @1; ?T1ST -> 1; "
     "{moves_axis XMR 5}"},
    {"YMR f32", "TY=2; T2CS 7; YMR 10000; @150; ?T2ST -> 259; @10; ?T2PE -> 10007; {moves_axis YMR 5}"},
    {"ZMR f32", "TZ=3; T3CS 7; ZMR 10000; @150; ?T3ST -> 259; @10; ?T3PE -> 10007; {moves_axis ZMR 5}"},
    {"WMR f32", "TW=0; CS 7; WMR 10000; @150; ?ST -> 259; @10; ?PE -> 10007; {moves_axis WMR 5}"},
    {"XMR Rn", "TX=1; R5=-10000; T1CS 7; PG; XMR R5; .; G; @160; ?T1PE -> -9993; {stored XMR R5}"},
    {"YMR Rn", "TY=2; R5=-10000; T2CS 7; PG; YMR R5; .; G; @160; ?T2PE -> -9993; {stored YMR R5}"},
    {"ZMR Rn", "TZ=3; R5=-10000; T3CS 7; PG; ZMR R5; .; G; @160; ?T3PE -> -9993; {stored ZMR R5}"},
    {"WMR Rn", "TW=0; R5=-10000; CS 7; PG; WMR R5; .; G; @160; ?PE -> -9993; {stored WMR R5}"},
    // Another module's move does not matter.
    {"XDN",
     "TX=1; PG; MR 100000; XMR 10000; XDN; OUT \"X\"; .; G; @152; @10; < X; {stored XDN}; {new}; PG; XDN; "
     ".; G; @2; ?ERR -> 4; ?ST -> 33"},
    {"YDN",
     "TY=2; PG; MR 100000; YMR 10000; YDN; OUT \"Y\"; .; G; @152; @10; < Y; {stored YDN}; {new}; PG; YDN; "
     ".; G; @2; ?ERR -> 4"},
    {"ZDN",
     "TZ=3; PG; MR 100000; ZMR 10000; ZDN; OUT \"Z\"; .; G; @152; @10; < Z; {stored ZDN}; {new}; PG; ZDN; "
     ".; G; @2; ?ERR -> 4"},
    {"WDN",
     "TW=0; PG; T1MR 100000; WMR 10000; WDN; OUT \"W\"; .; G; @152; @10; < W; {stored WDN}; {new}; PG; "
     "WDN; .; G; @2; ?ERR -> 4"},
    // If 50 applies from the beginning: 2 + 0.05 s. If it applies from position 45 at 0.5 s on, the path
    // decelerates to 50 within 0.05 s and 3.75, to 0 within another 0.05 s and 1.25, and the 50 in between
    // take 1.1 s more.
    {"TVM=f32",
     "{map}; TVM=50; ?TVM -> 50; ?T3PR3 -> 50; 2MA 100,0; @2044; ?ST -> 259; @12; ?PE -> 100; "
     "TVM=0 -> ERR 2; {new}; {map}; 2MA 100,0; @501; TVM=50; @1093; ?ST -> 259; @12; ?PE -> 100; "
     "{new}; {runs}; TVM=20; ?T2TVM -> 20"},
    // --- two times 50: 0.6 s each, or 1.1 s in one; 512 if they blend
    {"CM 0",
     "{map}; CM 1; CM 0; 2MR 50,0; 2MR 50,0; @1194; ?ST -> 259; @12; ?PE -> 100; ?ST -> 1; {new}; {runs}; "
     "CM 0 -> ERR 3"},
    {"CM 1",
     "{map}; CM 1; 2MR 50,0; 2MR 0,50; @300; ?ST -> 771; @793; ?ST -> 771; @12; ?PE -> 50; ?T1PE -> 50; "
     "?ST -> 1; {new}; {runs}; CM 1 -> ERR 3"},
    // A right angle is more than 89 degrees, but not more than 90.
    {"CM 2",
     "{map}; CM 2; PR7=89; 2MR 50,0; 2MR 0,50; @1194; ?ST -> 259; @12; ?ST -> 1; PR7=90; 2MR 50,0; "
     "2MR 0,50; @1107; ?ST -> 1; ?PE -> 100; {new}; {runs}; CM 2 -> ERR 3"},
};

}  // namespace understudy::emulator::models::slim
