// Programs of several axes as people write them, compared like those of programs_test.cpp: a path of L from
// rest to rest takes L/100 + 0.1 s, at 100 units/s and 1000 units/s2.
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace programs_on_paths_test {

TEST(SlimPrograms, PalletisingWithArcs) {
  // 100 along x: 1.1 s. Half a circle of radius 50: 157.08, 1.6708 s. Back: 1.1 s. 3.8708 s in all.
  DialogueScript(2).play(R"(
> PG
> TX=0
> TY=1
> CS 0
> 2MA 100,0
> AA 100,50,180
> 2MR -100,0
> XDN
> SET P2
> OUT "PALLET"
>
> G
@ 1110
> ?PE
< 100
@ 2755
@ 30
< PALLET
> ?PE
< 0
> ?T1PE
< 100
)");
}

TEST(SlimPrograms, AnOctagonWithoutStopping) {
  // Eight sides of 10: each separately takes 0.2 s, all in one 80 / 100 + 0.1 = 0.9 s.
  DialogueScript(2).play(R"(
> PG
> TX=0
> TY=1
> CM 1
> 2MR 10,0
> 2MR 7.0710678,7.0710678
> 2MR 0,10
> 2MR -7.0710678,7.0710678
> 2MR -10,0
> 2MR -7.0710678,-7.0710678
> 2MR 0,-10
> 2MR 7.0710678,-7.0710678
> XDN
> OUT "ROUND"
>
> G
@ 900
@ 20
< ROUND
> ?PE
< 0
> ?T1PE
< 0
)");
}

TEST(SlimPrograms, TwoGroupsAtATime) {
  // 100 in 1.1 s, 200 in 2.1 s, at the same time.
  DialogueScript(4).play(R"(
> PG
> TX=0
> TY=1
> 2MR 100,0
> TX=2
> TY=3
> 2MR 0,200
> T0DN
> OUT "FIRST"
> T3DN
> OUT "SECOND"
>
> G
@ 1095
@ 20
< FIRST
> ?PE
< 100
@ 980
@ 20
< SECOND
> ?T3PE
< 200
)");
}

TEST(SlimPrograms, AHelix) {
  // A circle of radius 10 while z rises by 5: 63.03 long, 0.7303 s.
  DialogueScript(3).play(R"(
> PG
> TX=0
> TY=1
> TZ=2
> SAA 10,0,360,5
> XDN
> OUT "BORED"
>
> G
@ 730
@ 15
< BORED
> ?T2PE
< 5
> ?PE
< 0
)");
}

TEST(SlimPrograms, APausedProgramContinuesOnItsPath) {
  // 100 along x, 1.1 s. Decelerating from 100 at 1000 takes 0.1 s and 5 units, and so does accelerating
  // again.
  DialogueScript(2).play(R"(
> PG
> TX=0
> TY=1
> 2MA 100,0
> XDN
> 2MA 100,100
> XDN
> OUT "CORNER"
>
> G
@ 503
> TAPZ
@ 150
> MA 5
< ERR 3
> ?ST
# servo on, program, pause, error present, buffer not empty
< 301
@ 1000
> TAREDO
@ 640
@ 1100
@ 25
< CORNER
> ?PE
< 100
> ?T1PE
< 100
)");
}

}  // namespace programs_on_paths_test

}  // namespace understudy::emulator::models::slim
