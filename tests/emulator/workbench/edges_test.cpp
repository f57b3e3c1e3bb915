// A device that requests it gets the switches of its machine at their exact pulse, at any speed; if an input
// does not belong to the switch alone, or pulses are lost, levels count.
#include <gtest/gtest.h>

#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"
#include "motion/homing_tables.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::workbench {
namespace edges_test {

using namespace std::chrono_literals;
using motion::Signal;
using world::World;

const ListedModel kModels[] = {&model()};

//   lower             home        near home            upper
//   ════╗           ╔══════╗    ╔═══════════╗        ╔══════
//     -3000       -200   -51    0          999     3000        index at 7 + 1000 k, five wide
constexpr std::int64_t kHomeEdge = -51;
constexpr std::int64_t kIndex = 7;
constexpr std::int64_t kLower = -3000;

struct Setup {
  std::int64_t position = 0;
  int hysteresis = 0;
  bool opens = false;
};

std::string machine(const Setup& setup) {
  const std::string more =
      ", hysteresis: " + std::to_string(setup.hysteresis) + (setup.opens ? ", contact: opens }" : " }");
  return "{ position: " + std::to_string(setup.position) +
         ", travel: [ -3500, 3500 ], home: { at: -200, width: 150" + more +
         ", near_home: { at: 0, width: 1000" + more + ", limits: { lower: -3000, upper: 3000" + more +
         ", encoder: { per_revolution: 4000, index: { at: 7, width: 5 } } }";
}

world::Bench bench_of(const Setup& setup) {
  const std::string its = machine(setup);
  return world::parse_bench(kModels,
                            "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: it, model: "
                            "workbench } ] } }\nplant:\n  it.A: " +
                                its + "\n  it.B: " + its + "\n",
                            "bench.yaml", "/tmp");
}

/// One controller and its machines.
struct Rig {
  explicit Rig(const Setup& setup = {}) : world(bench_of(setup), {}, {}) {
    if (setup.opens) {
      device().state.motors.low_active = 1 << kUpper | 1 << workbench::kLower | 1 << kHome | 1 << kNear;
      for (std::size_t i = 0; i < kMotorCount; ++i) device().motors().update_environment(device(), i);
    }
    advance(2);
  }
  Workbench& device() { return static_cast<Workbench&>(world.device(0)); }
  motion::Axis& axis(std::size_t motor) { return device().state.motors.motors[motor].axis; }
  const motion::Environment& environment(std::size_t motor) {
    return device().state.motors.motors[motor].environment;
  }
  std::int64_t place(std::size_t motor) { return world.plant(0, static_cast<int>(motor)).position_pulses(); }
  void advance(Tick ticks) { world.advance_to(world.now() + ticks * kTickLength); }
  void inject(const std::string& kind, const std::string& place,
              const std::vector<std::pair<std::string, std::string>>& fields = {}) {
    world.inject(world::find_fault(world.known(), {.kind = kind, .place = place, .fields = fields}));
  }

  /// Runs until homing is over. Returns why it ended.
  motion::Cause home(std::size_t motor, const motion::HomingProgram& program) {
    const motion::Cause refused = axis(motor).home(program, device().now());
    if (refused != motion::Cause::none) return refused;
    for (int i = 0; i < 100'000 && (i < 2 || axis(motor).homing.active()); ++i) advance(100);
    return axis(motor).homing.ended_by;
  }

  World world;
};

constexpr double kBrakingPulses = 90;

motion::SpeedLaw law(double pps) {
  const double slope = pps * pps / (2 * kBrakingPulses);
  motion::SpeedLaw made;
  made.top_speed_u_s = pps;
  made.up = made.down = motion::RampLaw::by_slope(slope);
  return made;
}

int sense(std::size_t motor) { return motor == Motors::kReversed ? -1 : +1; }

/// Near home, home and index, with the machine moving down, down and up.
motion::HomingProgram four_steps(std::size_t motor, double pps) {
  const int direction = sense(motor);
  return motion::rsm8194h_homing(
      {.directions = {-direction, -direction, direction, 0}, .drive = law(pps), .home = law(pps)});
}

motion::HomingProgram by_mode(std::size_t motor, int mode, double pps) {
  return motion::super40nc_homing(
      {.mode = mode, .direction = -sense(motor), .fast = law(pps), .creep = law(pps / 2), .index_count = 2});
}

constexpr double kSpeeds_pps[] = {10, 100, 4'000'000};
constexpr std::int64_t kPlaces[] = {3200, 3000, 2500, 1000, 999,  998,  500,   0,     -1,    -50,
                                    -51,  -52,  -120, -200, -201, -500, -2999, -3000, -3001, -3300};

TEST(Edges, HomingEndsOnThePulseFromEveryPlace) {
  for (const double pps : kSpeeds_pps) {
    for (const std::int64_t place : kPlaces) {
      for (const int hysteresis : {0, 25}) {
        for (const bool opens : {false, true}) {
          if (opens && pps != kSpeeds_pps[2]) continue;
          Rig rig({.position = place, .hysteresis = hysteresis, .opens = opens});
          for (std::size_t motor = 0; motor < kMotorCount; ++motor) {
            SCOPED_TRACE(std::to_string(pps) + " pps from " + std::to_string(place) + ", motor " +
                         std::to_string(motor) + ", hysteresis " + std::to_string(hysteresis) +
                         (opens ? ", contacts open" : ""));
            ASSERT_EQ(rig.home(motor, four_steps(motor, pps)), motion::Cause::arrived);
            ASSERT_EQ(rig.place(motor), kIndex);
          }
        }
      }
    }
  }
}

TEST(Edges, HomingByModesEndsOnThePulse) {
  struct Mode {
    int number;
    std::int64_t ends_at;
    std::int64_t lowest;  // from there on
  };
  // The limit releases after its hysteresis; two indexes further are at -2993 and -1993.
  const Mode modes[] = {{1, kHomeEdge, -200}, {6, kLower + 26, -3500}, {7, -1993, -3500}};
  for (const double pps : kSpeeds_pps) {
    for (const Mode& mode : modes) {
      for (const std::int64_t place : kPlaces) {
        if (place < mode.lowest) continue;
        Rig rig({.position = place, .hysteresis = 25});
        for (std::size_t motor = 0; motor < kMotorCount; ++motor) {
          SCOPED_TRACE(std::to_string(pps) + " pps from " + std::to_string(place) + ", mode " +
                       std::to_string(mode.number) + ", motor " + std::to_string(motor));
          ASSERT_EQ(rig.home(motor, by_mode(motor, mode.number, pps)), motion::Cause::arrived);
          ASSERT_EQ(rig.place(motor), mode.ends_at);
        }
      }
    }
  }
}

TEST(Edges, AreReportedOnlyWhenTheMachineChanges) {
  Rig rig({.position = 2000});
  const std::uint32_t reported = rig.environment(0).version;
  rig.axis(0).move(-800, law(1000), rig.device().now());
  rig.advance(3000);
  EXPECT_EQ(rig.place(0), 1200);
  EXPECT_EQ(rig.environment(0).version, reported);
  rig.inject("slip", "it.A", {{"pulses", "300"}});
  rig.advance(2);
  EXPECT_NE(rig.environment(0).version, reported);
  ASSERT_EQ(rig.home(0, four_steps(0, 4e6)), motion::Cause::arrived);
  EXPECT_EQ(rig.place(0), kIndex);
}

TEST(Edges, OfInputsThatAreHeldOrStuckAreLevels) {
  Rig rig({.position = 2000});
  const auto has_zone = [&](Signal signal) {
    const auto& environment = rig.environment(0);
    return std::any_of(environment.zones.begin(), environment.zones.begin() + environment.zone_count,
                       [&](const auto& zone) { return zone.signal == signal; });
  };
  EXPECT_TRUE(has_zone(Signal::home));
  rig.world.set_external_input(0, motor_input(0, kHome), 1);
  EXPECT_FALSE(has_zone(Signal::home));
  EXPECT_TRUE(has_zone(Signal::near_home));
  rig.advance(1);
  EXPECT_TRUE(rig.environment(0).steady & motion::bit(Signal::home));
  rig.world.set_external_input(0, motor_input(0, kHome), 0);
  EXPECT_TRUE(has_zone(Signal::home));
  rig.inject("stuck", "it.HOME_A", {{"level", "off"}});
  rig.advance(1);
  EXPECT_FALSE(has_zone(Signal::home));
  // Home never comes on: step 2 runs into the lower limit, comes back and fails on the upper one.
  EXPECT_EQ(rig.home(0, four_steps(0, 4e6)), motion::Cause::limit_plus);
  EXPECT_GE(rig.place(0), 3000);
  rig.world.clear_faults();
  rig.advance(1);
  ASSERT_EQ(rig.home(0, four_steps(0, 4e6)), motion::Cause::arrived);
  EXPECT_EQ(rig.place(0), kIndex);
}

TEST(Edges, AreLevelsWhilePulsesAreLost) {
  for (const bool stalls : {false, true}) {
    Rig rig({.position = 200});
    rig.axis(0).run(-1, law(20'000), rig.device().now());
    rig.advance(5);
    EXPECT_TRUE(rig.environment(0).depends_on_place());
    if (stalls) {
      rig.inject("stall", "it.A");
    } else {
      rig.inject("lost_steps", "it.A", {{"one_in", "2"}});
    }
    rig.advance(1);
    EXPECT_FALSE(rig.environment(0).depends_on_place());
    rig.axis(0).stop();
    rig.advance(10);
    rig.world.clear_faults();
    rig.advance(2);
    EXPECT_TRUE(rig.environment(0).depends_on_place());
    ASSERT_EQ(rig.home(0, four_steps(0, 4e6)), motion::Cause::arrived);
    EXPECT_EQ(rig.place(0), kIndex) << "pulses have been lost since power-up";
  }
}

TEST(Edges, AtAHardStopLoseTheirPlaceAndFindIt) {
  Rig rig({.position = 3400});
  EXPECT_EQ(rig.axis(0).run(+1, law(4e6), rig.device().now()), motion::Cause::limit_plus);
  rig.axis(0).settings.at_limit_plus = motion::Reaction::ignore;
  rig.axis(0).run(+1, law(4e6), rig.device().now());
  rig.advance(20);
  rig.axis(0).stop();
  rig.advance(2);
  EXPECT_EQ(rig.place(0), 3500);
  EXPECT_GT(rig.world.plant(0, 0).lost_pulses(), 1000);
  rig.axis(0).settings.at_limit_plus = motion::Reaction::stop_at_once;
  ASSERT_EQ(rig.home(0, four_steps(0, 4e6)), motion::Cause::arrived);
  EXPECT_EQ(rig.place(0), kIndex);
}

/// From their positions, everything is equally far away for both.
void expect_as_far_away(Rig& rig, Rig& other, std::size_t motor) {
  ASSERT_EQ(rig.environment(motor).zone_count, other.environment(motor).zone_count);
  for (std::size_t i = 0; i < rig.environment(motor).zone_count; ++i) {
    EXPECT_EQ(rig.environment(motor).zones[i].from - rig.axis(motor).travel_pulses,
              other.environment(motor).zones[i].from - other.axis(motor).travel_pulses);
  }
}

TEST(Edges, TwoThatLoseTheirPlacesAtOnceFindThem) {
  Rig rig({.position = 3400});
  for (std::size_t motor = 0; motor < kMotorCount; ++motor) {
    auto& settings = rig.axis(motor).settings;
    settings.at_limit_plus = settings.at_limit_minus = motion::Reaction::ignore;
    EXPECT_EQ(rig.axis(motor).run(sense(motor), law(4e6), rig.device().now()), motion::Cause::none);
  }
  rig.advance(20);
  for (std::size_t motor = 0; motor < kMotorCount; ++motor) rig.axis(motor).stop();
  rig.advance(2);
  Rig never_lost({.position = 3500});
  for (std::size_t motor = 0; motor < kMotorCount; ++motor) {
    SCOPED_TRACE(motor);
    EXPECT_EQ(rig.place(motor), 3500);
    expect_as_far_away(rig, never_lost, motor);
    EXPECT_GT(rig.world.plant(0, static_cast<int>(motor)).lost_pulses(), 1000);
    auto& settings = rig.axis(motor).settings;
    settings.at_limit_plus = settings.at_limit_minus = motion::Reaction::stop_at_once;
    ASSERT_EQ(rig.home(motor, four_steps(motor, 4e6)), motion::Cause::arrived);
    EXPECT_EQ(rig.place(motor), kIndex);
  }
}

/// A controller's count may change at any moment, for example when it learns that a motor is reversed.
TEST(Edges, FollowAxesThatAllCountAgain) {
  Rig rig({.position = 2000});
  Rig as_before({.position = 2000});
  rig.world.set_bulk_ticks(false);
  for (std::size_t motor = 0; motor < kMotorCount; ++motor) {
    rig.axis(motor).travel_pulses += 500;
    rig.axis(motor).base_pulses += 500;
  }
  rig.advance(2);
  for (std::size_t motor = 0; motor < kMotorCount; ++motor) {
    SCOPED_TRACE(motor);
    expect_as_far_away(rig, as_before, motor);
    ASSERT_EQ(rig.home(motor, four_steps(motor, 4e6)), motion::Cause::arrived);
    EXPECT_EQ(rig.place(motor), kIndex);
  }
}

/// At 4 MPPS a tick moves 500 pulses beyond the stop: the machine never passes the index at 4007.
TEST(Edges, AnIndexBeyondAHardStopIsNeverSeen) {
  struct Case {
    std::int64_t position;
    int direction;
    std::int64_t stop;
  };
  for (const auto& [position, direction, stop] : {Case{3400, +1, 3500}, Case{-3400, -1, -3500}}) {
    for (std::size_t motor = 0; motor < kMotorCount; ++motor) {
      Rig rig({.position = position});
      rig.axis(motor).settings.at_limit_plus = motion::Reaction::ignore;
      rig.axis(motor).settings.at_limit_minus = motion::Reaction::ignore;
      const motion::HomingProgram program = motion::rsm8194h_homing(
          {.directions = {0, 0, sense(motor) * direction, 0}, .drive = law(4e6), .home = law(4e6)});
      ASSERT_EQ(rig.axis(motor).home(program, rig.device().now()), motion::Cause::none);
      rig.advance(20);
      EXPECT_EQ(rig.place(motor), stop);
      EXPECT_TRUE(rig.axis(motor).homing.active()) << motor << " " << direction;
    }
  }
}

TEST(Edges, AreKnownAfterPowerAndASnapshot) {
  Rig rig({.position = 2000});
  rig.world.switch_power(0, false);
  rig.inject("slip", "it.A", {{"pulses", "-123"}});
  rig.advance(5);
  rig.world.switch_power(0, true);
  rig.advance(2);
  ASSERT_EQ(rig.axis(0).home(four_steps(0, 20'000), rig.device().now()), motion::Cause::none);
  rig.advance(30);
  ASSERT_TRUE(rig.axis(0).homing.active());
  Rig twin;
  world::restore(twin.world, world::save(rig.world));
  for (Rig* one : {&rig, &twin}) {
    one->advance(3000);
    EXPECT_EQ(one->axis(0).homing.ended_by, motion::Cause::arrived);
    EXPECT_EQ(one->place(0), kIndex);
  }
  EXPECT_TRUE(world::same_state(rig.world, twin.world));
}

TEST(Edges, AMarkIsMetWithinATick) {
  world::Bench bench = bench_of({});
  bench.machines[0].plant.mark = world::SwitchSetup{.on = {1501, 1502}};
  World world(bench, {}, {});
  auto& device = static_cast<Workbench&>(world.device(0));
  world.advance_to(2ms);
  motion::Axis& axis = device.state.motors.motors[0].axis;
  axis.move(2000, law(4e6), device.now());
  motion::Events seen = 0;
  for (int i = 0; i < 20; ++i) {
    world.advance_to(world.now() + 1ms);
    seen |= axis.events;
  }
  EXPECT_TRUE(seen & motion::bit(motion::Event::mark_on)) << "two pulses are half a microsecond";
  EXPECT_TRUE(seen & motion::bit(motion::Event::mark_off));
  EXPECT_EQ(world.plant(0, 0).position_pulses(), 2000);
}

}  // namespace edges_test
}  // namespace understudy::emulator::workbench
