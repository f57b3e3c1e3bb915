// SLIM's coordinated commands, as the kernel alone must execute them: resultant speed TVM and acceleration
// TVA, golden times, CM modes with PR7, and the pause rules.
#include <gtest/gtest.h>

#include "motion/bad_motion.h"
#include "tests/motion/path_shapes.h"

namespace understudy::motion {
namespace fit_slim_test {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTvm = 100;
constexpr double kTva = 1000;

// The commands; `here` is where they start.
Path ma(const Point& here, double x, double y, double z = 0) { return line(here, place_of(x, y, z)); }
Path aa(const Point& here, double x, double y, double degrees, double rise = 0) {
  return arc_by_sweep(here, place_of(x, y, here[2]), degrees * kDegree, place_of(0, 0, rise));
}
const Point kOrigin = Point::Zero();

/// SLIM: after a joint that comes too late, the path starts from rest.
PathRun linked(const SpeedLaw& law = by_slope(kTvm, kTva)) {
  PathRun run;
  run.set_late_joint(PathRun::LateJoint::from_rest);
  run.set_speed(law, 0);
  return run;
}

struct Golden {
  const char* command;
  Path path;
  double length, seconds;
  Point end;
};

TEST(FitSlim, GoldenTableOfLengthsTimesAndEnds) {
  const Golden kTable[]{
      {"2MA 100,50", ma(kOrigin, 100, 50), 111.8034, 1.2180, place_of(100, 50)},
      {"2MR 3,4", ma(kOrigin, 3, 4), 5, 0.1414, place_of(3, 4)},
      {"3MA 30,40,120", ma(kOrigin, 30, 40, 120), 130, 1.4000, place_of(30, 40, 120)},
      {"AA 0,50,90", aa(kOrigin, 0, 50, 90), 78.5398, 0.8854, place_of(50, 50)},
      {"AA 100,100,360", aa(kOrigin, 100, 100, 360), 888.5766, 8.9858, place_of(0, 0)},
      {"AA 50,150,-720", aa(kOrigin, 50, 150, -720), 1986.9177, 19.9692, place_of(0, 0)},
      {"SAA 10,0,360,5", aa(kOrigin, 10, 0, 360, 5), 63.0305, 0.7303, place_of(0, 0, 5)},
  };
  for (const Golden& row : kTable) {
    EXPECT_NEAR(row.path.length_u, row.length, 5.1e-5) << row.command;
    PathRun run = linked();
    run.append(row.path, kStop, 0);
    run.start(0);
    const Tick end = finish(run, 0) - 1;
    EXPECT_NEAR(static_cast<double>(end), row.seconds * 1000, 1) << row.command;
    EXPECT_LT((run.step(end + 10) - row.end).norm(), 1e-9) << row.command;
  }
}

TEST(FitSlim, TheOctagonsTimeByItsCmModeAndPr7) {
  struct Row {
    const char* mode;
    Joint joint;
    double seconds;
  };
  const Row kRows[]{
      {"CM 0", kStop, 1.600},
      {"CM 1", kJoin, 0.900},
      {"CM 2, PR7 45", join_below(45), 0.900},
      {"CM 2, PR7 60", join_below(60), 0.900},
      {"CM 2, PR7 44", join_below(44), 1.600},
      {"CM 2, PR7 0", join_below(0), 1.600},
  };
  for (const Row& row : kRows) {
    PathRun run = linked();
    Point here = kOrigin;
    for (int side = 0; side < 8; ++side) {
      const Point way = 10 * place_of(std::cos(side * 45 * kDegree), std::sin(side * 45 * kDegree));
      run.append(line(here, here + way), row.joint, 0);
      here += way;
    }
    run.start(0);
    const Tick end = finish(run, 0) - 1;
    // A stop ends within a tick, and the next side starts at the tick.
    EXPECT_NEAR(static_cast<double>(end), row.seconds * 1000, row.seconds > 1 ? 8 : 1) << row.mode;
    EXPECT_LT(run.step(end + 10).norm(), 1e-12) << row.mode;
  }
}

TEST(FitSlim, ASuccessorQueuedTooLateBeginsFromRest) {
  // 2MA 100,0 decelerates from 95 on, 1000 ms after its beginning.
  for (const auto& [queued_at, ms] : {std::pair<Tick, Tick>{900, 2100}, {1050, 2200}, {1099, 2200}}) {
    PathRun run = linked();
    run.append(ma(kOrigin, 100, 0), kJoin, 0);
    run.start(0);
    for (Tick tick = 1; tick <= queued_at + 1; ++tick) run.step(tick);
    run.append(ma(place_of(100, 0), 200, 0), kJoin, queued_at + 1);
    EXPECT_EQ(finish(run, queued_at + 1) - 1, ms) << queued_at;
  }
}

TEST(FitSlim, TvmChangesInMotionAndThePathStays) {
  PathRun run = linked();
  Walk walk;
  walk.shapes = {Shape::arc(kOrigin, place_of(100, 100), 350 * kDegree)};
  run.append(walk.shapes[0].path(), kStop, 0);
  run.start(0);
  Tick tick = 0;
  for (const double tvm : {200.0, 20.0, 150.0, 100.0}) {
    for (int i = 0; i < 700; ++i) walk.step(run, ++tick);
    run.set_speed(by_slope(tvm, kTva), tick);
    const double before = run.sample(tick).speed_u_s;
    const auto ramp_ms = static_cast<int>(std::ceil(std::abs(tvm - before) / kTva * 1000));
    for (int i = 0; i < ramp_ms; ++i) walk.step(run, ++tick);
    EXPECT_NEAR(run.sample(tick).speed_u_s, tvm, 1e-9);
  }
  while (run.queued() > 0 && tick < 100'000) walk.step(run, ++tick);
  EXPECT_LT(walk.off_u, 1e-9);
  EXPECT_EQ(walk.place, walk.shapes[0].end);
}

TEST(FitSlim, TvaMayNotChangeInMotion) {
  PathRun run = linked();
  run.append(ma(kOrigin, 100, 0), kStop, 0);
  run.start(0);
  for (Tick tick = 1; tick <= 100; ++tick) run.step(tick);
  EXPECT_THROW(run.set_speed(by_slope(kTvm, 2 * kTva), 100), BadMotion);
}

struct Pausing {
  PathRun run = linked();
  Walk walk;
  Tick tick = 0;

  Pausing() {
    walk.shapes = {Shape::line_to(kOrigin, place_of(40, 0)),
                   Shape::arc(place_of(40, 0), place_of(40, 30), std::numbers::pi),
                   Shape::line_to(place_of(40, 60), place_of(0, 60))};
    walk.shapes[2].begin = walk.shapes[1].end;
    for (const Shape& shape : walk.shapes) run.append(shape.path(), kJoin, 0);
    run.start(0);
  }
  void steps(int count) {
    for (; count > 0; --count) walk.step(run, ++tick);
  }
};

TEST(FitSlim, TapzSlowsDownOnThePathAndTaredoResumesThere) {
  for (const int at : {20, 380, 420, 900, 1300}) {  // within the first line, across its end, in the arc ...
    Pausing pausing;
    pausing.steps(at);
    pausing.run.pause(pausing.tick);
    pausing.steps(100);
    EXPECT_TRUE(pausing.run.at_rest(pausing.tick)) << at;
    const double stands = pausing.walk.along_u;
    pausing.steps(1000);
    EXPECT_EQ(pausing.walk.along_u, stands) << at;
    pausing.run.resume(pausing.tick);
    const Tick resumed = pausing.tick;
    while (pausing.run.queued() > 0 && pausing.tick < 10'000) pausing.steps(1);
    const double left = 80 + 30 * std::numbers::pi - stands;
    EXPECT_NEAR(static_cast<double>(pausing.tick - resumed - 1), 1000 * trapezoid_s(left, kTvm, kTva), 1)
        << at;
    EXPECT_LT(pausing.walk.off_u, 1e-9) << at;
  }
}

TEST(FitSlim, TaredoBeforeItStandsSpeedsUpAgain) {
  Pausing pausing;
  pausing.steps(301);
  pausing.run.pause(pausing.tick);
  pausing.steps(50);
  pausing.run.resume(pausing.tick);
  EXPECT_NEAR(pausing.run.sample(pausing.tick).speed_u_s, 50, 1e-9);
  pausing.steps(50);
  EXPECT_NEAR(pausing.run.sample(pausing.tick).speed_u_s, 100, 1e-9);
}

TEST(FitSlim, TaredoWhenNotPausedDoesNothing) {
  Pausing pausing;
  pausing.steps(200);
  const PathRun before = pausing.run;
  pausing.run.resume(pausing.tick);
  EXPECT_EQ(pausing.run, before);
}

TEST(FitSlim, TapzWhenIdleHoldsTheNextCommand) {
  PathRun run = linked();
  run.pause(0);
  run.append(ma(kOrigin, 3, 4), kStop, 0);
  run.start(0);
  for (Tick tick = 1; tick < 500; ++tick) EXPECT_EQ(run.step(tick), kOrigin);
  run.resume(499);
  EXPECT_EQ(finish(run, 499) - 500, 142);
}

TEST(FitSlim, TaupzDiscardsTheHalfDoneCommandAndAllThatIsQueued) {
  Pausing pausing;
  pausing.steps(500);
  pausing.run.pause(pausing.tick);
  pausing.steps(200);
  const Point stands = pausing.walk.place;
  pausing.run.abandon();
  EXPECT_FALSE(pausing.run.paused());
  EXPECT_FALSE(pausing.run.running());
  EXPECT_EQ(pausing.run.step(pausing.tick + 1), stands);
  // Motion is accepted again, from there.
  pausing.run.append(line(stands, kOrigin), kStop, pausing.tick + 1);
  pausing.run.start(pausing.tick + 1);
  EXPECT_GT(finish(pausing.run, pausing.tick + 1), 0);
}

TEST(FitSlim, TvmInPauseCountsFromTaredoOn) {
  Pausing pausing;
  pausing.steps(500);
  pausing.run.pause(pausing.tick);
  pausing.steps(200);
  pausing.run.set_speed(by_slope(50, kTva), pausing.tick);
  pausing.steps(10);
  EXPECT_TRUE(pausing.run.at_rest(pausing.tick));
  pausing.run.resume(pausing.tick);
  pausing.steps(200);
  EXPECT_NEAR(pausing.run.sample(pausing.tick).speed_u_s, 50, 1e-9);
}

}  // namespace fit_slim_test
}  // namespace understudy::motion
