// Fast-forward of a device that handles edges between ticks: the same world as with single ticks.
// UNDERSTUDY_SEED and UNDERSTUDY_COURSES override.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/world.h"
#include "motion/homing_tables.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::workbench {
namespace fast_forward_bench_test {

using world::World;

const ListedModel kModels[] = {&model()};

class Course {
 public:
  explicit Course(std::uint64_t seed) : random_(seed) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  bool one_in(std::int64_t many) { return between(1, many) == 1; }
  std::int64_t of_any_size(std::int64_t max) {
    std::uniform_real_distribution<double> exponent(0, std::log2(static_cast<double>(max)));
    return std::llround(std::exp2(exponent(random_)));
  }

  std::string machine() {
    std::string what = "position: " + std::to_string(between(-3000, 3000));
    const std::string hysteresis = one_in(2) ? ", hysteresis: 7" : "";
    const std::string more = hysteresis + (one_in(3) ? ", contact: opens }" : " }");
    if (!one_in(4)) what += ", travel: [ -4000, 9000 ]";
    if (!one_in(3)) what += ", home: { at: -200, width: 150" + more;
    if (!one_in(3)) what += ", near_home: { at: 0, width: 900" + more;
    if (!one_in(3)) what += ", limits: { lower: -3500, upper: 8000" + more;
    if (one_in(3)) what += ", mark: { at: 1200, width: 3" + more;
    if (one_in(2)) what += ", encoder: { per_revolution: 400, index: { at: 7, width: 5 } }";
    return "{ " + what + " }";
  }

  world::Bench bench() {
    const std::string text =
        "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: it, model: workbench } ] } }\n"
        "plant:\n  it.A: " +
        machine() + "\n  it.B: " + machine() + "\n" + (one_in(3) ? "wires: [ it.OUT3 -> it.HOME_A ]\n" : "");
    return world::parse_bench(kModels, text, "bench.yaml", "/tmp");
  }

  motion::SpeedLaw law() {
    const auto pps = static_cast<double>(of_any_size(4'000'000));
    motion::SpeedLaw made;
    made.top_speed_u_s = pps;
    made.up = made.down = motion::RampLaw::by_slope(pps * pps / 180);
    return made;
  }

  /// An event that both get.
  std::function<void(World&)> act() {
    const auto number = static_cast<std::size_t>(between(0, 1));
    const auto axis = [number](World& world) -> motion::Axis& {
      return static_cast<Workbench&>(world.device(0)).state.motors.motors[number].axis;
    };
    const auto now = [](World& world) { return world.device(0).now(); };
    const std::string place = number == 0 ? "it.A" : "it.B";
    const auto inject = [](const world::FaultText& fault) {
      return [fault](World& world) { world.inject(world::find_fault(world.known(), fault)); };
    };
    const motion::SpeedLaw speed = law();
    const int direction = one_in(2) ? +1 : -1;
    const std::int64_t distance = direction * of_any_size(20'000);
    switch (between(0, 13)) {
      case 0:
      case 1:
      case 2: return [=](World& world) { axis(world).move(distance, speed, now(world)); };
      case 3: return [=](World& world) { axis(world).run(direction, speed, now(world)); };
      case 4:
      case 5: {
        const auto program = motion::rsm8194h_homing(
            {.directions = {direction, direction, -direction, 0}, .drive = speed, .home = speed});
        return [=](World& world) { axis(world).home(program, now(world)); };
      }
      case 6: {
        const auto program = motion::super40nc_homing({.mode = static_cast<int>(between(0, 12)),
                                                       .direction = direction,
                                                       .fast = speed,
                                                       .creep = speed,
                                                       .index_count = 2});
        return [=](World& world) { axis(world).home(program, now(world)); };
      }
      case 7: return [=](World& world) { axis(world).stop(); };
      case 8: return inject({"slip", place, {{"pulses", std::to_string(between(-500, 500))}}});
      case 9: return inject({"turn", "it.MPG", {{"counts", std::to_string(distance)}, {"in", "50ms"}}});
      case 10: {
        const int input = motor_input(number, static_cast<MotorInput>(between(0, kInputsOfMotor - 1)));
        const int level = one_in(2) ? 1 : 0;
        return [=](World& world) { world.set_external_input(0, input, level); };
      }
      case 11:
        if (one_in(2)) return inject({"lost_steps", place, {{"one_in", "3"}}});
        return inject({"stall", place, {}});
      case 12: return [](World& world) { world.clear_faults(); };
      default: {
        const bool on = !one_in(2);
        return [=](World& world) { world.switch_power(0, on); };
      }
    }
  }

  SimTime pause() {
    return one_in(3) ? SimTime{between(0, 20'000'000)} : SimTime{of_any_size(4'000'000'000)};
  }

 private:
  std::mt19937_64 random_;
};

std::uint64_t number_from(const char* name, std::uint64_t usual) {
  const char* given = std::getenv(name);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}

TEST(FastForwardWithEdges, EqualsSingleTicks) {
  const std::uint64_t seed = number_from("UNDERSTUDY_SEED", 51'000);
  std::uint64_t skipped = 0;
  for (std::uint64_t i = 0; i < number_from("UNDERSTUDY_COURSES", 60); ++i) {
    SCOPED_TRACE("UNDERSTUDY_SEED=" + std::to_string(seed + i));
    Course course(seed + i);
    const world::Bench bench = course.bench();
    World plain(bench, {}, {});
    World twin(bench, {}, {});
    twin.set_bulk_ticks(false);
    SimTime time{0};
    for (int acts = 0; acts < 25; ++acts) {
      const auto act = course.act();
      for (World* one : {&plain, &twin}) {
        one->advance_to(time);
        act(*one);
      }
      time += course.pause();
      for (World* one : {&plain, &twin}) one->advance_to(time);
      ASSERT_TRUE(world::same_state(plain, twin)) << "after act " << acts << " at " << format_duration(time);
    }
    skipped += plain.ticks_skipped();
    EXPECT_EQ(twin.ticks_skipped(), 0U);
  }
  EXPECT_GT(skipped, 1000U);
}

}  // namespace fast_forward_bench_test
}  // namespace understudy::emulator::workbench
