// The inputs that motion refuses, by name; and that it ends for any input: with a refusal or with a profile.
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <limits>
#include <vector>

#include "motion/bad_motion.h"
#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace move_refusal_test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SpeedLaw good() {
  return {.start_speed_u_s = 10,
          .top_speed_u_s = 100,
          .up = RampLaw::by_jerk(100, 50),
          .down = RampLaw::by_sections(100, 10)};
}

void expect_refused(const std::function<void()>& act, Refusal refusal, const std::string& require) {
  try {
    act();
    ADD_FAILURE() << "accepted; expected the error: " << require;
  } catch (const BadMotion& error) {
    EXPECT_EQ(error.refusal(), refusal) << error.what();
    EXPECT_EQ(std::string(error.what()).find(require), 0U) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

enum class Domain { positive, not_negative, finite };

struct Quantity {
  const char* name;
  Domain domain;
  std::function<void(SpeedLaw&, double)> set;
};

TEST(MoveRefusal, ABadLawIsRefusedByEveryFunctionWhateverTheDistance) {
  const std::vector<Quantity> quantities = {
      {"move: top speed", Domain::positive, [](SpeedLaw& law, double x) { law.top_speed_u_s = x; }},
      {"move: start speed", Domain::not_negative, [](SpeedLaw& law, double x) { law.start_speed_u_s = x; }},
      {"jerk ramp: jerk", Domain::positive, [](SpeedLaw& law, double x) { law.up.jerk_u_s3 = x; }},
      {"ramp with sections: acceleration", Domain::positive,
       [](SpeedLaw& law, double x) { law.down.acceleration_u_s2 = x; }},
      {"ramp with sections: section", Domain::not_negative,
       [](SpeedLaw& law, double x) { law.down.section_u_s = x; }},
      {"ramp: acceleration", Domain::positive,
       [](SpeedLaw& law, double x) {
         law.slow_down_reckoned_by = RampLaw{.kind = RampLaw::Kind::slope, .acceleration_u_s2 = x};
       }},
      {"ramp: duration", Domain::positive,
       [](SpeedLaw& law, double x) { law.up = {.kind = RampLaw::Kind::time, .duration_s = x}; }},
      {"move: slow-down position", Domain::not_negative,
       [](SpeedLaw& law, double x) { law.slow_down_at_u = x; }},
      {"move: slow-down offset", Domain::finite, [](SpeedLaw& law, double x) { law.slow_down_offset_u = x; }},
  };
  const Sample moving{.position_u = 50, .speed_u_s = 50, .acceleration_u_s2 = 10};
  const std::vector<std::function<void(const SpeedLaw&)>> functions = {
      [](const SpeedLaw& law) { check(law); },
      [](const SpeedLaw& law) { plan(0, law); },
      [](const SpeedLaw& law) { plan(1, law); },
      [](const SpeedLaw& law) { plan(1e6, law); },
      [](const SpeedLaw& law) { plan_endless(law); },
      [&](const SpeedLaw& law) { change_speed(moving, 70, law); },
      [&](const SpeedLaw& law) { change_speed(moving, 0, law); },
      [&](const SpeedLaw& law) { slow_to_stop(moving, law); },
      [&](const SpeedLaw& law) { change_target(moving, 1000, law); },
      [&](const SpeedLaw& law) { change_target({}, 1000, law); },
  };
  for (const Quantity& quantity : quantities) {
    for (const double value : {kNan, kInfinite, -kInfinite, -1.0, -5e-324, 0.0, -0.0}) {
      const bool finite = std::isfinite(value);
      if (finite && quantity.domain == Domain::finite) continue;
      if (value == 0 && quantity.domain == Domain::not_negative) continue;
      const Refusal refusal = !finite                               ? Refusal::not_finite
                              : quantity.domain == Domain::positive ? Refusal::not_positive
                                                                    : Refusal::negative;
      SpeedLaw law = good();
      quantity.set(law, value);
      for (const auto& function : functions) {
        expect_refused([&] { function(law); }, refusal, std::string(quantity.name) + " must be ");
      }
    }
  }
  for (const auto& function : functions) EXPECT_NO_THROW(function(good()));
}

TEST(MoveRefusal, BadDistancesStatesSpeedsAndTargetsAreRefused) {
  const SpeedLaw law = good();
  struct Row {
    double value;
    Refusal refusal;
  };
  for (const Row& row : std::vector<Row>{{kNan, Refusal::not_finite},
                                         {kInfinite, Refusal::not_finite},
                                         {-kInfinite, Refusal::not_finite},
                                         {-1, Refusal::negative},
                                         {-5e-324, Refusal::negative}}) {
    const double value = row.value;
    const Refusal refusal = row.refusal;
    expect_refused([&] { plan(value, law); }, refusal, "move: distance must be ");
    expect_refused([&] { change_speed({}, value, law); }, refusal, "change of speed: speed must be ");
    const Sample bad_speed{.speed_u_s = value};
    for (const auto& act : std::vector<std::function<void()>>{[&] { change_speed(bad_speed, 5, law); },
                                                              [&] { slow_to_stop(bad_speed, law); },
                                                              [&] { change_target(bad_speed, 5, law); }}) {
      expect_refused(act, refusal, "move in progress: speed must be ");
    }
    if (std::isfinite(value)) continue;
    expect_refused([&] { change_target({}, value, law); }, refusal, "change of target: target must be ");
    expect_refused([&] { slow_to_stop({.position_u = value}, law); }, refusal,
                   "move in progress: position must be ");
    expect_refused([&] { slow_to_stop({.acceleration_u_s2 = value}, law); }, refusal,
                   "move in progress: acceleration must be ");
    expect_refused([&] { slow_to_stop({.jerk_u_s3 = value}, law); }, refusal,
                   "move in progress: jerk must be ");
  }
}

TEST(MoveRefusal, WhatNoDoubleCanHoldIsRefused) {
  SpeedLaw law{.top_speed_u_s = 1e300, .up = RampLaw::by_slope(1e-300), .down = RampLaw::by_slope(1e-300)};
  for (const auto& act : std::vector<std::function<void()>>{
           [&] { plan(1e308, law); },
           [&] { plan_endless(law); },
           [&] { change_speed({}, 1e300, law); },
           [&] { slow_to_stop({.speed_u_s = 1e300}, law); },
           [&] { change_target({.speed_u_s = 1e300}, 5, law); },
       }) {
    expect_refused(act, Refusal::out_of_range, "move: quantities must give a profile that fits in doubles");
  }
}

// ---- Garbage

class Garbage {
 public:
  explicit Garbage(std::uint64_t seed) : random_(seed) {}

  double number() {
    constexpr std::array<double, 16> kOdd{0,     -0.0,  kNan,   kInfinite, -kInfinite, -1,     5e-324, 1e-310,
                                          1e308, 1e300, 1e-300, 1,         2,          1e-200, 1e200,  3};
    switch (random_.below(6)) {
      case 0: return kOdd[random_.below(kOdd.size())];
      case 1: return std::bit_cast<double>((random_.below(1ULL << 32) << 32) | random_.below(1ULL << 32));
      case 2: return random_.of_any_size(1e-300, 1e300);
      default: return random_.of_any_size(1e-6, 1e6);
    }
  }
  /// Mostly of a kind that passes the checks.
  double sound() { return random_.below(16) == 0 ? number() : std::abs(number()); }
  RampLaw ramp() {
    RampLaw law{.kind = static_cast<RampLaw::Kind>(random_.below(4)), .acceleration_u_s2 = sound()};
    law.jerk_u_s3 = sound();
    law.section_u_s = sound();
    law.duration_s = sound();
    return law;
  }
  SpeedLaw law() {
    SpeedLaw law{.start_speed_u_s = random_.below(3) == 0 ? 0 : sound(), .top_speed_u_s = sound()};
    law.up = ramp();
    law.down = random_.below(2) == 0 ? law.up : ramp();
    law.when_short = static_cast<Short>(random_.below(3));
    if (random_.below(6) == 0) law.slow_down_reckoned_by = ramp();
    if (random_.below(6) == 0) law.slow_down_at_u = sound();
    if (random_.below(4) == 0) law.slow_down_offset_u = number();
    return law;
  }

 private:
  RandomLaws random_;
};

bool sound(const Profile& profile, bool may_be_endless) {
  if (profile.segment_count < 0 || profile.segment_count > static_cast<int>(Profile::kMaxSegments))
    return false;
  if (!may_be_endless || !profile.endless()) {
    if (!std::isfinite(profile.duration_s) || !std::isfinite(profile.end_position_u)) return false;
  }
  const double last_s = profile.endless() ? 1e6 : profile.duration_s;
  for (const double share : {0.0, 0.3, 0.9, 1.0}) {
    const Sample sample = profile.sample(share * last_s);
    if (std::isnan(sample.position_u) || std::isnan(sample.speed_u_s)) return false;
  }
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& s = profile.segments[static_cast<std::size_t>(i)];
    for (const double value : {s.begin_s, s.position_u, s.speed_u_s, s.acceleration_u_s2, s.jerk_u_s3}) {
      if (!std::isfinite(value)) return false;
    }
  }
  return true;
}

TEST(MoveRefusal, GarbageGetsARefusalOrAProfileOfFiniteNumbers) {
  const std::uint64_t from = seed() + 40;
  std::cout << "seed " << from << "\n";
  Garbage garbage(from);
  int planned = 0;
  int refused = 0;
  const auto tried = [&](bool may_be_endless, const auto& act, const auto& words) {
    try {
      const bool is_sound = sound(act(), may_be_endless);
      if (!is_sound) ADD_FAILURE() << "seed " << from << ": " << words() << " has no finite numbers";
      ++planned;
    } catch (const BadMotion&) {
      ++refused;
    }
  };
  const int tries = random_cases(200'000);
  for (int i = 0; i < tries && !testing::Test::HasFailure(); ++i) {
    const SpeedLaw law = garbage.law();
    const Sample now{garbage.number(), garbage.sound(), garbage.number(), garbage.number()};
    const double value = garbage.sound();
    const double target = garbage.number();
    const auto words = [&] {
      return code(law) + " " + code(now) + " // distance, speed " + code(value) + ", target " + code(target) +
             ", function " + std::to_string(i % 5);
    };
    switch (i % 5) {
      case 0:
        tried(
            false, [&] { return plan(value, law); }, words);
        break;
      case 1:
        tried(
            true, [&] { return plan_endless(law); }, words);
        break;
      case 2:
        tried(
            true, [&] { return change_speed(now, value, law); }, words);
        break;
      case 3:
        tried(
            false, [&] { return slow_to_stop(now, law); }, words);
        break;
      default:
        tried(
            false, [&] { return change_target(now, target, law); }, words);
    }
  }
  EXPECT_GT(planned, tries / 10);
  EXPECT_GT(refused, tries / 10);
}

}  // namespace move_refusal_test
}  // namespace understudy::motion
