// What remains of a failed course is needed for the failure.
#include "emulator/hunt/shrinker.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

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

}  // namespace shrinker_test
}  // namespace understudy::emulator::hunt
