// The steps that all courses have in common are played once. A course that begins after them comes to the
// same.
#include "emulator/hunt/course_player.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "tests/emulator/hunt/hunted.h"

namespace understudy::emulator::hunt {
namespace course_player_test {

/// The axis moves while the operator presses; nothing happens before that.
std::string late_presses() {
  std::string text = kPresses + R"(hunt:
  from: the operator presses
  may:
    - inject: { stuck: feeder.DIN_10, level: { one_of: [ on, off ] }, for: { between: [ 1ms, 10ms ] } }
      times: 4
    - inject: { drop: feeder }
    - advance: { between: [ 1ms, 100ms ] }
    - power: { feeder: cycle }
  never: [ feeder.Counter1_Value > 2, feeder.A.pulses > 300 ]
)";
  const std::string start = "  - write: { PROG_MAIN_RunTime_START: 0 }\n";
  text.insert(text.find(start) + start.size(),
              "  - write: { Aaxis_SVON: 1, Aaxis_Speed: 600, Aaxis_AccTime: 5, Aaxis_Pulse: 250, "
              "Aaxis_Move_INC: 1 }\n"
              "  - wait: { until: feeder.A.pulses > 20, within: 5s }\n");
  return text;
}

TEST(CoursePlayer, ACourseThatBeginsLaterComesToTheSame) {
  const auto scenario = std::make_shared<const play::Scenario>(
      play::parse_scenarios(models::all_models(), late_presses(), "scenario.yaml").at(0));
  CoursePlayer later(scenario, models::all_models(), {});
  CoursePlayer from_power_up(scenario, models::all_models(), {.can_begin_later = false});
  const Ground ground{.plan = later.plan(), .undisturbed = later.undisturbed()};
  EXPECT_EQ(later.undisturbed().requests, from_power_up.undisturbed().requests);
  int failed = 0;
  for (std::uint64_t number = 0; number < 100; ++number) {
    Dice dice(7, number);
    const Course course{.disturbances = draw_disturbances(ground, dice)};
    const Playing a = later.play_here(course, true);
    const Playing b = from_power_up.play_here(course, true);
    ASSERT_EQ(a.results.size(), b.results.size());
    const play::ScenarioResult& one = a.results.front();
    const play::ScenarioResult& other = b.results.front();
    ASSERT_EQ(one.steps.size(), other.steps.size()) << number;
    EXPECT_EQ(one.simulated, other.simulated) << number;
    EXPECT_EQ(one.failure ? one.failure->what : "", other.failure ? other.failure->what : "") << number;
    EXPECT_EQ(one.failure ? one.failure->state : std::vector<std::string>{},
              other.failure ? other.failure->state : std::vector<std::string>{});
    for (std::size_t i = 0; i < one.steps.size(); ++i)
      EXPECT_EQ(one.steps[i].end, other.steps[i].end) << number;
    EXPECT_EQ(a.reached.when, b.reached.when) << number;
    if (one.failure) ++failed;
  }
  EXPECT_GT(failed, 10);
  EXPECT_LT(failed, 100);
}

}  // namespace course_player_test
}  // namespace understudy::emulator::hunt
