// Options about what TASTOP does to a program, and which lines are accepted while one waits for a number,
// each compared with the default.
#include "emulator/device/named_values.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace options_of_stops_test {

// The first move is in progress, and the program waits for its end.
const std::string kAtDone = R"(
> PG
> SET EV1 I,8
> ON EV1,$E
> MR 500000
> DN
> OUT "ONE"
> MR 500000
> DN
> RET
> $E TASTOP
> OUT "STOPPED"
> RET
>
> G
@ 500
)";

TEST(SlimStopOptions, ATypedStopEndsTheProgram) {
  play({}, kAtDone + "> TASTOP\n@ 500\n> ?ST\n< 1\n");
  play({{"emergency_stop_program", "ends_also_by_its_own_line"}}, kAtDone + "> TASTOP\n@ 500\n> ?ST\n< 1\n");
  // Full speed again, which nobody has commanded.
  play({{"emergency_stop_program", "goes_on"}}, kAtDone + "> TASTOP\n@ 500\n< ONE\n> ?ST\n< 263\n");
}

TEST(SlimStopOptions, AStopByAnEventEndsWhatItInterrupted) {
  play({}, kAtDone + "IN8 = 1\n@ 500\n< STOPPED\n> ?ST\n< 1\n");
  play({{"emergency_stop_program", "ends_also_by_its_own_line"}}, kAtDone + "IN8 = 1\n@ 500\n> ?ST\n< 1\n");
  play({{"emergency_stop_program", "goes_on"}}, kAtDone + "IN8 = 1\n@ 500\n< STOPPED\n< ONE\n> ?ST\n< 263\n");
}

TEST(SlimStopOptions, AProgramsOwnStopLeavesItTheWord) {
  const std::string own = "> PG\n> MR 500000\n> WT 100\n> TASTOP\n> OUT \"OWN\"\n>\n> G\n@ 200\n";
  play({}, own + "< OWN\n> ?ST\n< 1\n");
  play({{"emergency_stop_program", "goes_on"}}, own + "< OWN\n> ?ST\n< 1\n");
  play({{"emergency_stop_program", "ends_also_by_its_own_line"}}, own + "> ?ST\n< 1\n");
}

/// A line that waits for a number, during a long path.
const std::string kAtNumber = R"(
> TX=0
> TY=1
> PG
> 2MR 3000,4000
> N0=GETI
> OUT N0
> DN
>
> G
@ 1001
)";

TEST(SlimStopOptions, TheChainIsSteeredWhileANumberIsAwaited) {
  // At 95 of 100 a second after the first; stopped at 100 units along, and continued at 50.
  DialogueScript script(2);
  script.play(kAtNumber + "> TAPZ\n@ 200\n> ?PE\n< ERR 1\n");
  EXPECT_DOUBLE_EQ(script.device().named_values()->value_named("PE").value(), 60);
  script.play("> TVM=50\n> TAREDO\n@ 1051\n> TASTOP\n@ 10\n> ?ST\n< 33\n> ?PE\n< 91\n");  // 1.25 in 50 ms,
                                                                                          // and 50 per second
  // A command that asks for a number accepts none of that.
  DialogueScript later(2);
  later.play(kAtNumber + "> TAPZ\n> TAREDO\n> NONSENSE\n< ERR 1\n> 7\n@ 2\n< 7\n");
}

TEST(SlimStopOptions, NumbersOnlyMeansNumbersOnly) {
  DialogueScript script(2, {{"lines_for_a_number", "numbers_only"}});
  script.play(kAtNumber + "> TAPZ\n< ERR 1\n> TVM=5\n< ERR 1\n> TASTOP\n< ERR 1\n> EXIT\n> ?MD\n< 4\n");
  // By the column alone, a pause can begin, and the number must arrive before it ends.
  DialogueScript strict(2, {{"while_program_runs", "external_column_only"}});
  strict.play(kAtNumber + "> TAPZ\n> TAREDO\n< ERR 1\n> EXIT\n> TAREDO\n> ?MD\n< 4\n");
}

}  // namespace options_of_stops_test

}  // namespace understudy::emulator::models::slim
