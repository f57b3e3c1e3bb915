// Runs with all operations in random order. A failure prints the commands as code.
#include <gtest/gtest.h>

#include <functional>

#include "motion/bad_motion.h"
#include "tests/motion/path_shapes.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace path_run_random_test {

constexpr double kPi = std::numbers::pi;

/// A course of shapes, and the operations on its run, at random. `log` contains the commands so far.
class RandomRun {
 public:
  explicit RandomRun(std::uint64_t case_seed) : random_(case_seed) {
    scale_u_ = std::pow(10.0, static_cast<double>(random_.between(-1, 4)));
    top_u_s_ = scale_u_ * within(0.5, 20);
    // From stops within a shape's part to stops over several shapes.
    slope_u_s2_ = top_u_s_ * top_u_s_ / (scale_u_ * within(0.2, 8));
    law_ = by_slope(top_u_s_, slope_u_s2_);
    if (random_.between(0, 2) == 0) {
      const double faster = slope_u_s2_ * within(0.3, 1);
      law_.down = RampLaw::by_slope(faster);
    }
    smooth_ = random_.between(0, 3) == 0;
    if (smooth_) {
      // Jerk such that the ramp to the top has at most the slope: K = a^2 / v.
      law_.up = law_.down = RampLaw::by_jerk(slope_u_s2_ * slope_u_s2_ / top_u_s_);
    }
    if (random_.between(0, 1) == 0) {
      run.set_late_joint(PathRun::LateJoint::from_rest);
      say("run.set_late_joint(PathRun::LateJoint::from_rest);");
    }
    run.set_speed(law_, 0);
    say("run.set_speed(law, 0);  // top " + number_as_code(top_u_s_) + ", slope " +
        number_as_code(slope_u_s2_) + (smooth_ ? ", jerk" : ""));
  }

  void append(Tick now) {
    const Point from = walk.shapes.empty() ? Point(Point::Zero()) : walk.shapes.back().end;
    const auto somewhere = [&] { return scale_u_ * within(-1, 1); };
    Shape shape;
    switch (random_.between(0, 5)) {
      case 0: shape = Shape::line_to(from, from); break;
      case 1:
      case 2: {
        const Point centre = from + place_of(somewhere(), somewhere());
        const double sweep = random_.between(0, 2) == 0
                                 ? static_cast<double>(random_.between(-3, 3)) * kPi / 2
                                 : within(-6, 6);
        shape = Shape::arc(from, centre, sweep, random_.between(0, 1) == 0 ? somewhere() : 0);
        break;
      }
      case 3:  // straight on, mostly short
        shape = Shape::line_to(from, from + place_of(scale_u_ * within(0, 0.1), 0));
        break;
      default:
        shape = Shape::line_to(from, from + place_of(somewhere(), somewhere(), somewhere(), somewhere()));
    }
    const Joint joint = random_.between(0, 2) == 0 ? kStop
                        : random_.between(0, 1) == 0
                            ? kJoin
                            : join_below(static_cast<double>(random_.between(0, 4)) * 45);
    say("run.append(" + shape.code() + ", {.rule = Joint::Rule{" +
        std::to_string(static_cast<int>(joint.rule)) +
        "}, .corner_deg = " + number_as_code(joint.corner_deg) + "}, " + std::to_string(now) + ");");
    run.append(shape.path(), joint, now);
    walk.shapes.push_back(shape);
  }

  /// One command, of any kind.
  void disturb(Tick now) {
    const std::string at = ", " + std::to_string(now) + ");";
    switch (random_.between(0, 5)) {
      case 0:
        say("run.pause(" + std::to_string(now) + ");");
        run.pause(now);
        break;
      case 1:
      case 2:
        say("run.resume(" + std::to_string(now) + ");");
        run.resume(now);
        break;
      case 3: {
        constexpr double kFactors[]{0, 0.25, 0.5, 1, 1, 1.5, 2};
        const double factor = kFactors[random_.between(0, 6)];
        say("run.set_override(" + number_as_code(factor) + at);
        run.set_override(factor, now);
        override_ = factor;
        break;
      }
      case 4: {
        law_.top_speed_u_s = top_u_s_ * within(0.2, 1.5);
        say("law.top_speed_u_s = " + number_as_code(law_.top_speed_u_s) + "; run.set_speed(law" + at);
        run.set_speed(law_, now);
        break;
      }
      default:
        if (!run.full()) append(now);
    }
  }

  /// Nothing holds it any more.
  void release(Tick now) {
    say("run.resume(" + std::to_string(now) + "); run.set_override(1, " + std::to_string(now) + ");");
    run.resume(now);
    run.set_override(1, now);
    override_ = 1;
  }

  void step(Tick tick) { walk.step(run, tick); }

  /// Everything that must hold for a tick; empty for success.
  std::string fault() {
    const double limit = law_.top_speed_u_s * override_;
    const double tick_s = 1 / kTicksPerSecond;
    const double size = scale_u_ * 30;  // of coordinates, after some dozens of shapes
    if (walk.off_u > 1e-9 * size) return "off the path by " + number_as_code(walk.off_u);
    // The length derived from a position is rounded like the position.
    const double blur_u_s = 1e-11 * size / tick_s;
    // Means of a tick: the speed may have grown to the end of the previous one. With a jerk law it grows
    // while the acceleration fades, up to the largest limit so far.
    const double before = smooth_ ? 3 * top_u_s_ : walk.speed_before_u_s + slope_u_s2_ * tick_s / 2;
    if (walk.speed_u_s > std::max(limit, before) + blur_u_s) {
      return "faster than the limit: " + number_as_code(walk.speed_u_s) + " of " + number_as_code(limit);
    }
    if (walk.speed_u_s < -blur_u_s) return "backwards at " + number_as_code(walk.speed_u_s);
    const double steepest = (smooth_ ? 2.5 : 1) * slope_u_s2_ * tick_s * (1 + 1e-9) + blur_u_s;
    const double change = std::abs(walk.speed_u_s - walk.speed_before_u_s);
    if (change > steepest) {
      return "speed jumps by " + number_as_code(change) + ", not " + number_as_code(steepest);
    }
    return {};
  }

  /// More than the rest can take, apart from pauses.
  Tick enough_ticks() const {
    double s = 0;
    for (std::size_t i = walk.done; i < walk.shapes.size(); ++i) {
      s += 4 * trapezoid_s(walk.shapes[i].length_u(), 0.2 * top_u_s_, 0.2 * slope_u_s2_) + 0.002;
    }
    return 100 + static_cast<Tick>(s * kTicksPerSecond);
  }

  void say(const std::string& line) { log += "  " + line + "\n"; }

  PathRun run;
  Walk walk;
  std::string log;

 private:
  double within(double low, double high) {
    return low + (high - low) * static_cast<double>(random_.between(0, 1'000'000)) * 1e-6;
  }

  RandomMoves random_;
  double scale_u_ = 1;
  double top_u_s_ = 1;
  double slope_u_s2_ = 1;
  double override_ = 1;
  bool smooth_ = false;
  SpeedLaw law_;

 public:
  RandomMoves& random() { return random_; }
};

/// The failure; empty for success.
std::string run_at_random(RandomRun& it) {
  for (std::int64_t i = it.random().between(1, 6); i > 0; --i) it.append(0);
  if (it.random().between(0, 5) == 0) it.disturb(0);
  it.say("run.start(0);");
  it.run.start(0);
  Tick tick = 0;
  const auto faulty = [&](const std::string& what) { return what + " in tick " + std::to_string(tick); };
  for (std::int64_t commands = it.random().between(0, 25); commands > 0; --commands) {
    for (std::int64_t ticks = it.random().of_any_size(1, 150); ticks > 0; --ticks) {
      it.step(++tick);
      if (const std::string fault = it.fault(); !fault.empty()) return faulty(fault);
    }
    it.disturb(tick);
  }
  it.release(tick);
  for (const Tick last = tick + it.enough_ticks(); it.run.queued() > 0;) {
    if (tick == last) return faulty("does not end");
    it.step(++tick);
    if (const std::string fault = it.fault(); !fault.empty()) return faulty(fault);
  }
  if (it.walk.done != it.walk.shapes.size()) return faulty("not all completed");
  if (it.walk.place != it.walk.shapes.back().end) return faulty("ends beside the end");
  return {};
}

TEST(PathRunRandom, StaysOnThePathWithinLimitsToTheEndWhateverIsDone) {
  for (int i = 0; i < random_cases(4000); ++i) {
    const std::uint64_t case_seed = seed() + static_cast<std::uint64_t>(i);
    RandomRun it(case_seed);
    const std::string fault = run_at_random(it);
    ASSERT_EQ(fault, "") << "UNDERSTUDY_SEED=" << case_seed << "\n" << it.log;
  }
}

TEST(PathRunRandom, PausedAndResumedAtAnyTickItEndsWhereItWouldHave) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(1000); ++i) {
    const std::uint64_t case_seed = seed() + 1'000'000 + static_cast<std::uint64_t>(i);
    RandomRun it(case_seed);
    for (int n = 0; n < 4; ++n) it.append(0);
    it.run.start(0);
    Tick tick = 0;
    std::string fault;
    const auto steps = [&](Tick count) {
      for (; count > 0 && it.run.queued() > 0 && fault.empty(); --count) {
        it.step(++tick);
        fault = it.fault();
      }
    };
    for (int pauses = 0; pauses < 5; ++pauses) {
      steps(random.of_any_size(1, 400));
      it.run.pause(tick);
      it.say("run.pause(" + std::to_string(tick) + ");");
      steps(random.of_any_size(1, 400));
      it.run.resume(tick);
      it.say("run.resume(" + std::to_string(tick) + ");");
    }
    steps(it.enough_ticks());
    ASSERT_EQ(fault, "") << "tick " << tick << " UNDERSTUDY_SEED=" << case_seed << "\n" << it.log;
    ASSERT_EQ(it.walk.done, it.walk.shapes.size()) << it.log;
    ASSERT_EQ(it.walk.place, it.walk.shapes.back().end) << it.log;
  }
}

}  // namespace path_run_random_test
}  // namespace understudy::motion
