// SLIM's replies to typed lines: queries, parameters, memory, errors, editing, options.
#include "emulator/device/named_values.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace dialogue_test {

TEST(SlimDialogue, AnswersQueriesWithTheBareValue) {
  DialogueScript script;
  script.play(R"(
> ?PE
< 0
> ?pe
< 0
> ?t0err
< 0
> ?N0
< 0
> ?R64
< 0
> ?IN
< 0
IN1 = 1
IN8 = 1
@ 1
> ?IN
< 129
> ?IN 8
< 1
> ?IN 2
< 0
AIN = 640
> ?AIN
< 640
SW3 = 1
> ?SW 3
< 1
> ?SW 4
< 0
> ?VER
< 1.00
> ?ST
< 1
> ?MD
< 0
> ?VM
< 1000
> ?PR3
< 100
> ?TVM
< 100
> ?CMA
< 0
> ?ERC
< 0
@ 3725000
> ?time
< 1:02:05
> ?TM
< 3725
> TM=0
> ?TM
< 0
@ 2000
> ?TM
< 2
)");
}

TEST(SlimDialogue, SaysOnlyWhatItIsAskedFor) {
  DialogueScript script;
  script.play(R"(
> MR 100
> N0=5

> SET P1
@ 2000
> ?N0
< 5
)");
}

TEST(SlimDialogue, RefusesWithANumberAndRemembersIt) {
  DialogueScript script(2);
  // By the table of codes: syntax, range, mode, axis, not linked.
  script.play(R"(
> NONSENSE
< ERR 1
> ?ERR
< 1
> N0=40000
< ERR 2
> OUTP 16
< ERR 2
> N65=1
< ERR 2
> JP 3
< ERR 3
> 2MA 10,20
< ERR 4
> T2MA 100
< ERR 5
> ?T2PE
< ERR 5
> TX=9
< ERR 2
> T12MA 3,4
< ERR 2
> $LABEL
< ERR 1
> G $NOWHERE
< ERR 13
> ?ERC
< 13,1,2,2,5,5,4,3,2,2,2,1
> ?N0
< 0
> RESET
> ?ERR
< 0
)");
}

TEST(SlimDialogue, KeepsTheLastSixteenErrors) {
  DialogueScript script;
  for (int i = 0; i < 20; ++i) script.ask("NONSENSE");
  EXPECT_EQ(script.ask("?ERC"), "1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1");
}

TEST(SlimDialogue, RemembersEachFailureOfAProgramOfItsModule) {
  DialogueScript script(2);
  // T2 is not linked: of what is its, the host has the error. Nothing of it is said.
  script.play(R"(
> PG
> JP $NOWHERE
> T1MA 5
> T2MA 5
>
> G
@ 5
> G
@ 5
> ?ERC
< 13,13
> G 2
@ 5
> ?ERC
< 5,13,13
> T1HOFF
@ 2
> G 1
@ 5
> ?T1ERC
< 9
# T0 ran the program that has ended so.
> ?ERC
< 9,5,13,13
)");
}

TEST(SlimDialogue, TakesParametersByNameAndAlias) {
  DialogueScript script(3);
  script.play(R"(
> PR3=12.5
> ?TVM
< 12.5
> ?T2PR3
< 100
> TVM=30
> ?T2PR3
< 30
> ?T1TVM
< 30
> T2PR3=200
> ?PR3
< 30
> ?T2PR3
< 200
> PR2=0
< ERR 2
> FU=2
< ERR 2
> FU=1
> ?FU
< 1
> VJ=0.01
> ?VJ
< 0.01
> T0SYN=2
> ?T0SYN
< 2
> PN50=255
> ?T7PE
< 0
> PN50=0
> ?PN50
< 1
> PN37=34952
> PN37=63
< ERR 2
> FOO=1
< ERR 1
> T1PN50=3
< ERR 5
> PN50=3
> T1PN50=3
< ERR 1
)");
}

TEST(SlimDialogue, MovesNumbersBetweenVariables) {
  DialogueScript script;
  script.play(R"(
> N0=12
> N1=N0
> ?N1
< 12
> R0=N0
> ?R0
< 12
> R1=2.75
> N2=R1
< ERR 1
> N4=100
> NS(N4)=5
> ?NS(100)
< 5
> ?NS(N4)
< 5
> NS(2001)=1
< ERR 2
> DATA N7,9
> ?N7
< 9
> DATA R7,0.5
> ?R7
< 0.5
AIN = 321
@ 1
> AIN=N9
> ?N9
< 321
> N10=AIN
> ?N10
< 321
> TM=N0
> ?TM
< 12
> N11=TM
> ?N11
< 12
)");
}

TEST(SlimDialogue, EditsAProgram) {
  DialogueScript script;
  script.play(R"(
> PG
> MA 10
> ma 20
> nonsense
< ERR 1
> $END
>
> PL
< 0: MA 10
< 1: ma 20
< 2: $END
> PI 1
> WT 100
> PE 0
> MR -5
> PD 3
> PA
> RET
> EXIT
> ULP
< MR -5
< WT 100
< ma 20
< RET
< END
> PD 9
< ERR 2
> DLP
> MA 1
> END
> PL
< 0: MA 1
)");
}

TEST(SlimDialogue, ListsItsParametersAsAssignments) {
  DialogueScript script(2);
  script.type("ULC");
  std::map<std::string, std::string> listed;
  for (std::string line = script.next(); line != "(nothing)"; line = script.next()) {
    const std::size_t equals = line.find('=');
    ASSERT_NE(equals, std::string::npos) << line;
    listed[line.substr(0, equals)] = line.substr(equals + 1);
  }
  EXPECT_EQ(listed.size(), 15u + 13u);  // of T1 without PN37 and PN50
  EXPECT_EQ(listed["PN10"], "1000");
  EXPECT_EQ(listed["PN50"], "3");
  EXPECT_EQ(listed["PN37"], "34952");  // 8 in each nibble
  EXPECT_EQ(listed["T1PR2"], "1000");
  // What it lists it takes.
  for (const auto& [name, value] : listed) EXPECT_EQ(script.ask(name + "=" + value), "(nothing)") << name;
}

TEST(SlimDialogue, IsReadAndWrittenByNamePastTheLine) {
  DialogueScript script(2);
  Slim& device = script.device();
  EXPECT_EQ(device.named_values()->value_named("T1PE"), 0);
  EXPECT_EQ(device.named_values()->value_named("NOTHING"), std::nullopt);
  EXPECT_EQ(device.named_values()->value_named("T5PE"), std::nullopt);
  EXPECT_EQ(device.named_values()->assign("R0", 2.5), std::nullopt);
  EXPECT_EQ(device.named_values()->value_named("R0"), 2.5);
  EXPECT_TRUE(device.named_values()->assign("N0", 1e6).has_value());
  EXPECT_TRUE(device.named_values()->assign("MA", 1).has_value());
  EXPECT_EQ(script.ask("?R0"), "2.5");
}

}  // namespace dialogue_test

}  // namespace understudy::emulator::models::slim
