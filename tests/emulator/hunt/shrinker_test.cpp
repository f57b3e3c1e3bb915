// What remains of a failed course is needed for the failure.
#include "emulator/hunt/shrinker.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "tests/emulator/hunt/hunted.h"

namespace understudy::emulator::hunt {
namespace shrinker_test {

using When = play::Disturbance::When;

/// Somebody else writes something, and a request is lost: the one that reads the counter.
const std::string kReads = R"(hunt:
  may:
    - write: { feeder.Aaxis_AccTime: 5 }
      times: 2
    - inject: { drop: feeder, of: request }
)";

std::shared_ptr<const play::Scenario> reads() {
  return std::make_shared<const play::Scenario>(
      play::parse_scenarios(models::all_models(), kPresses + kReads, "scenario.yaml").at(0));
}

TEST(Shrinker, WithoutARequestTheLaterOnesHaveLowerNumbers) {
  CoursePlayer course_player(reads(), models::all_models(), {});
  Course course{.disturbances = {
                    {.entry = 0, .step = 1, .when = When::here, .values = {}},
                    {.entry = 0, .step = 3, .when = When::here, .values = {}},
                    {.entry = 1, .step = 0, .when = When::nth, .moment = 4, .values = {}},
                }};
  arrange(course.disturbances);
  const Outcome outcome = course_player.play(course);
  ASSERT_NE(outcome.kind, "");
  ASSERT_FALSE(outcome.is_cut_short);
  const Shrunk shrunk = Shrinker(course_player, outcome.kind).shrink(course, outcome);
  ASSERT_EQ(shrunk.course.disturbances.size(), 1U);
  EXPECT_EQ(shrunk.course.disturbances[0].moment, 2);  // the write is the first
  EXPECT_TRUE(shrunk.is_minimal);
  EXPECT_EQ(shrunk.outcome.kind, outcome.kind);
}

constexpr const char* kBench =
    "understudy: 1\nbench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n";

/// Returns the text without its disturbances, which have a line each.
std::string without_disturbances(const std::string& text) {
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("# disturbance ") == std::string::npos) rest += line + "\n";
  }
  return rest;
}

// Later steps need earlier ones, which must not be left out: the scenario would then fail by itself.
TEST(Shrinker, ScenariosThatWereFoundPassWithoutTheirDisturbances) {
  struct Row {
    const char* rest;
    std::size_t findings;
  };
  const std::vector<Row> rows{
      {"steps:\n"
       "  - write: { Aaxis_SVON: 1 }\n"
       "  - write: { Aaxis_Pulse: 3200, Aaxis_Speed: 60, Aaxis_Move_INC: 1 }\n"
       "  - wait: { until: STATUS.4 == 0, within: 5s }\n"
       "  - expect: { Cord_A: 3200 }\n"
       "hunt: { may: [ power: { feeder: off } ] }\n",
       3},
      {"steps:\n"
       "  - write: { Aaxis_Speed: 100 }\n"
       "  - expect: { Aaxis_Speed: 100 }\n"
       "  - write: { Aaxis_Speed: 200 }\n"
       "  - assert: feeder.Aaxis_Speed == 200\n"
       "hunt: { may: [ write: { feeder.Aaxis_Speed: 7 } ] }\n",
       2},
  };
  for (const Row& row : rows) {
    const HuntFolder folder(kBench + std::string(row.rest));
    const auto found = hunted(folder, {.seed = 0, .jobs = 1, .courses = 200});
    EXPECT_EQ(found.size(), row.findings);
    for (const Found& each : found) {
      EXPECT_NE(failure_of(folder, each.text), "") << each.text;
      EXPECT_EQ(failure_of(folder, without_disturbances(each.text)), "") << each.text;
    }
  }
}

}  // namespace shrinker_test
}  // namespace understudy::emulator::hunt
