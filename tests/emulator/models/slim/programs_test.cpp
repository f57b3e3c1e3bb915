// Programs as people write them, run in simulated time with the whole dialogue compared. Times are calculated
// by hand: a move of L from rest to rest takes L/v + v/a, or 2 sqrt(L/a) if L < v^2/a. For single axes v is
// 1000 RPM x 10000 / 60 = 166667 pulses/s and a is ten times that per second; for coordinated ones v is 100
// and a is 1000 units. A line takes 1 ms; the scripts check a few lines' time before and after each moment.
#include "emulator/device/named_values.h"
#include "emulator/device/terminals.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace programs_test {

TEST(SlimPrograms, PickAndPlace) {
  // 10000 pulses: 2 sqrt(10000 / 1666667) = 0.1549 s. Twice, with 50 ms between: 0.360 s and 8 lines.
  DialogueScript(1).play(R"(
> PG
> MA 10000
> DN
> SET P1
> WT 50
> MA 0
> DN
> CLR P1
> OUT "DONE"
>
> G
@ 150
> ?ST
# servo on, moving, program, buffer not empty
< 263
@ 30
> ?PE
< 10000
@ 170
@ 25
< DONE
> ?PE
< 0
> ?ST
< 1
)");
}

TEST(SlimPrograms, AnEventHoldsAndReleases) {
  // 100000 pulses: 0.7 s. Held from 0.3 s on: it has decelerated at 0.4 s, at 50000. From 1.0 s on the other
  // 50000 take 0.4 s.
  DialogueScript(1).play(R"(
> PG
> SET EV1 I,1
> ON EV1,$STOP
> MR 100000
> DN
> OUT "LAP"
> RET
> $STOP
> PZ
> OUT "HELD"
> WNI 1
> REDO
> OUT "GO"
> RET
>
> G
@ 302
IN1 = 1
@ 10
< HELD
@ 110
> ?PE
< 50000
@ 577
IN1 = 0
@ 10
< GO
@ 380
@ 25
< LAP
> ?PE
< 100000
)");
}

TEST(SlimPrograms, WritesToADisplay) {
  DialogueScript(1).play(R"(
> N0=42
> R1=3.25
> PG
> OUT "COUNT"
> OUT N0
> OUT "LENGTH"
> OUT R1
> R1=-0.5
> OUT R1
>
> G
@ 3
< COUNT
< 42
< LENGTH
@ 3
< 3.25
< -0.5
)");
}

TEST(SlimPrograms, JogsAsFastAsTheAnalogInputSays) {
  // VJ 100 RPM, half of it: 8333.3 pulses/s. The jog is at its beginning one tick after the command, and
  // decelerates from the moment of the other one: 0.999 s between them, 8325 pulses in all, because both
  // ramps are equal.
  DialogueScript(1).play(R"(
AIN = 500
@ 1
> AVM
> JGF
@ 1000
> ?MD
< 5
> JG0
@ 50
> ?PE
< 8325
# VM= takes the speed back
> VM=1000
> ?MD
< 0
)");
}

TEST(SlimPrograms, AJogWithoutAnalogSpeedBeginsWhenTheInputComes) {
  // As above, but everything has been at rest for a second when the input comes on.
  DialogueScript script(1);
  script.play(R"(
> AVM
> JGF
@ 1000
AIN = 500
@ 1000
> JG0
@ 50
)");
  EXPECT_NEAR(*script.device().named_values()->value_named("PE"), 8333, 20) << "within a tick or two";
}

TEST(SlimPrograms, AsksTheHostForNumbers) {
  // 5000 pulses at 500 RPM: 83333 pulses/s, 5000 / 83333 + 83333 / 1666667 = 0.06 + 0.05 = 0.11 s.
  DialogueScript(1).play(R"(
> PG
> OUT "TARGET"
> R0=GETR
> OUT "SPEED"
> N0=GETI
> VM=N0
> MA R0
> DN
> OUT R0
>
> G
@ 100
< TARGET
> abc
< ERR 1
> 5000.0
@ 100
< SPEED
> 2.5
< ERR 1
> 500
@ 112
@ 12
< 5000
> ?VM
< 500
> ?PE
< 5000
)");
}

TEST(SlimPrograms, PrintsNoFasterThanItsLineCarries) {
  world::Bench bench = slim_bench(1);
  bench.lines[0].timing = pty::Timing::wire;
  world::World world(bench, world::WorldOptions{}, [](const std::string&) {});
  const pty::Line& line = world.line(0).line;
  const std::string typed = "PG\r$A\rOUT \"" + std::string(98, 'x') + "\"\rJP $A\r\rG\r";
  world.receive(0, {reinterpret_cast<const std::uint8_t*>(typed.data()), typed.size()});
  std::size_t sent = 0;
  for (int second = 1; second <= 20; ++second) {
    world.advance_to(std::chrono::seconds(second));
    sent += line.output().size();
    world.take_output(0, line.output().size());
    EXPECT_LT(dynamic_cast<const Slim&>(world.device(0)).state().output.size(), 2 * 1024u);
  }
  // 960 characters per second, except for the typed commands and for pauses of a tick between texts.
  EXPECT_GT(sent, 17'000U);
  EXPECT_LE(sent, 20U * 960U);
}

TEST(SlimPrograms, HomesAndSetsItsCoordinate) {
  DialogueScript script(1);
  script.play(R"(
> PG
> H
> DN
> CS 250
> DN
> OUT "READY"
>
> G
@ 500
HORG = 1
@ 100
HORG = 0
< READY
> ?PE
< 250
# servo on, homed
> ?ST
< 17
)");
}

TEST(SlimPrograms, ASubroutineForEitherAxis) {
  // The same two moves by whatever X is: 0.1549 s each.
  DialogueScript(3).play(R"(
> PG
> TX=1
> CALL $STROKE
> TX=2
> CALL $STROKE
> OUT "BOTH"
> RET
> $STROKE
> XMA 10000
> XDN
> XMR -4000
> XDN
> RET
>
> G
# 4000: 2 sqrt(4000 / 1666667) = 0.0980 s
@ 500
@ 30
< BOTH
> ?T1PE
< 6000
> ?T2PE
< 6000
> ?PE
< 0
)");
}

TEST(SlimPrograms, OutputsOnTheWay) {
  // P3 comes on at 5000, half way: at 77 ms. PLS: 5 x 4 ms.
  DialogueScript script(1);
  script.play(R"(
> PG
> P1SET P3,5000
> PLS P1,5
> MA 10000
> DN
> OUTP 2
> OUT "END"
>
> G
)");
  const auto level = [&](int number) {
    return script.device().terminals()->output(kFirstOutput + number - 1);
  };
  script.pass(10);
  EXPECT_TRUE(level(1));
  EXPECT_FALSE(level(3));
  script.pass(20);
  EXPECT_FALSE(level(1));
  script.pass(40);
  EXPECT_FALSE(level(3)) << "70 ms";
  script.pass(20);
  EXPECT_TRUE(level(3)) << "90 ms";
  script.play(R"(
@ 90
< END
)");
  EXPECT_TRUE(level(2));
  EXPECT_FALSE(level(3)) << "OUTP sets all four";
}

TEST(SlimPrograms, SortsByInputs) {
  DialogueScript(1).play(R"(
> PG
> $NEXT
> WI 1
> JI 2,$LARGE
> JE 3,N0,$BYPASS
> OUT "SMALL"
> JP $GONE
> $LARGE
> OUT "LARGE"
> JP $GONE
> $BYPASS
> OUT "BYPASS"
> $GONE
> JNTI 1,50,$NEXT
> OUT "JAM"
> RET
>
> G
@ 20
IN1 = 1
@ 10
< SMALL
IN1 = 0
@ 10
IN2 = 1
IN1 = 1
@ 10
< LARGE
IN1 = 0
@ 10
IN2 = 0
IN1 = 1
> N0=3
< ERR 3
@ 20
< SMALL
@ 60
< JAM
> ?ST
# the error typed above is remembered
< 33
)");
}

TEST(SlimPrograms, AnEmergencyStopLeavesNothing) {
  DialogueScript script(2);
  script.play(R"(
> PG
> MR 100000
> T1MR 50000
> DN
> OUT "END"
>
> G
@ 200
> TASTOP
@ 20
> ?ST
< 1
)");
  const double stopped = *script.device().named_values()->value_named("PE");
  EXPECT_GT(stopped, 0);
  EXPECT_LT(stopped, 100000);
  script.pass(500);
  EXPECT_EQ(script.device().named_values()->value_named("PE"), stopped);
}

}  // namespace programs_test

}  // namespace understudy::emulator::models::slim
