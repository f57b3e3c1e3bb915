// A commanded stop that is cancelled while the axis still moves.
#include <gtest/gtest.h>

#include "motion/axis.h"

namespace understudy::motion {
namespace axis_resume_test {

SpeedLaw by_slope(double speed, double slope) {
  return {.top_speed_u_s = speed, .up = RampLaw::by_slope(slope), .down = RampLaw::by_slope(slope)};
}

struct Running {
  Axis axis;
  Environment environment;
  Tick tick = 0;

  Running() { axis.switch_servo(true); }
  void steps(int count) {
    for (; count > 0; --count) axis.step(++tick, environment);
  }
};

TEST(AxisResume, AMoveContinuesToItsTarget) {
  Running run;
  const SpeedLaw law = by_slope(1000, 1000);
  run.axis.move(4000, law, 0);
  run.steps(2001);  // at its beginning in tick 1: 500 + 1000 pulses, at 1000 pps
  run.axis.slow_down(run.tick);
  run.steps(500);  // 375 further, at 500 pps
  EXPECT_TRUE(run.axis.resume(law, run.tick));
  EXPECT_FALSE(run.axis.slowing);
  run.steps(500);
  EXPECT_DOUBLE_EQ(run.axis.sample(run.tick).speed_u_s, 1000);
  EXPECT_EQ(run.axis.travel_pulses, 1500 + 2 * 375);
  run.steps(1250 + 999);  // 1250 at speed, 500 down in 1 s
  EXPECT_TRUE(run.axis.moving());
  run.steps(1);
  EXPECT_FALSE(run.axis.moving());
  EXPECT_EQ(run.axis.cause, Cause::arrived);
  EXPECT_EQ(run.axis.travel_pulses, 4000);
}

TEST(AxisResume, AnEndlessRunContinuesAtAnotherSpeed) {
  Running run;
  run.axis.run(-1, by_slope(1000, 1000), 0);
  run.steps(1501);
  run.axis.slow_down(run.tick);
  run.steps(500);
  EXPECT_TRUE(run.axis.resume(by_slope(200, 1000), run.tick));
  run.steps(300);
  EXPECT_DOUBLE_EQ(run.axis.sample(run.tick).speed_u_s, 200);
  run.steps(1000);
  EXPECT_EQ(run.axis.travel_pulses, -(1000 + 375 + 105 + 200));
}

TEST(AxisResume, OnlyAStopByCommandThatIsUnderWayCanBeTakenBack) {
  const SpeedLaw law = by_slope(1000, 1000);
  Running idle;
  EXPECT_FALSE(idle.axis.resume(law, 0));
  Running moves;
  moves.axis.move(4000, law, 0);
  moves.steps(1000);
  const Axis before = moves.axis;
  EXPECT_FALSE(moves.axis.resume(law, moves.tick));
  EXPECT_EQ(moves.axis, before);
  moves.axis.slow_down(moves.tick, Cause::limit_plus);
  EXPECT_FALSE(moves.axis.resume(law, moves.tick));
  Running stands;
  stands.axis.move(4000, law, 0);
  stands.steps(500);
  stands.axis.slow_down(stands.tick);
  stands.steps(600);
  EXPECT_FALSE(stands.axis.resume(law, stands.tick));
  Running back;  // it stops to come back
  back.axis.move(4000, law, 0);
  back.steps(1500);
  back.axis.change_distance(100, false, back.tick);
  EXPECT_FALSE(back.axis.resume(law, back.tick));
  Running homes;
  HomingProgram program{.speeds = {law}};
  program.add({.direction = -1});
  homes.axis.home(program, 0);
  homes.steps(500);
  homes.axis.slow_down(homes.tick);
  EXPECT_FALSE(homes.axis.resume(law, homes.tick));
}

}  // namespace axis_resume_test
}  // namespace understudy::motion
