// Many ticks in one step equal single ticks: random sequences of drives, paths, homing, comparators, macros,
// inputs, machines that lose pulses, and power. UNDERSTUDY_SEED and UNDERSTUDY_COURSES override.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::models::rs_m8194h {
namespace rs_m8194h_fast_forward_test {

constexpr const char* kProgram =
    "MP 1\nRSM_MACRO_FOR 3\nRSM_MACRO_FIXED_MOVE X 700\nRSM_MACRO_STOP_WAIT X\nRSM_MACRO_NEXT\nEND\n"
    "MP 2\nRSM_MACRO_LABEL 1\nRSM_MACRO_SET_VAR VAR1 5\nRSM_MACRO_TIMER 40\nRSM_MACRO_GOTO 1\nEND\n"
    "ISR 1\nRSM_MACRO_FIXED_MOVE Y 300\nEND\n";

std::uint64_t number_from(const char* name, std::uint64_t usual) {
  const char* const given = std::getenv(name);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}

class Course {
 public:
  explicit Course(std::uint64_t seed) : random_(seed) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  bool one_in(std::int64_t many) { return between(1, many) == 1; }
  std::string of_any_size(std::int64_t max, bool with_sign = false) {
    std::uniform_real_distribution<double> exponent(0, std::log2(static_cast<double>(max)));
    const auto size = std::llround(std::exp2(exponent(random_)));
    return std::to_string(with_sign && one_in(2) ? -size : size);
  }

  GivenRsm given() {
    GivenRsm made{.program = one_in(2) ? kProgram : ""};
    for (const int axis : {0, 1, 2}) {
      world::PlantSetup plant;
      plant.position_pulses = between(-2000, 2000);
      if (one_in(2)) plant.travel = world::PulseSpan{-9000, 9000};
      if (one_in(2)) plant.home = world::PulseSpan{-200, 200};
      if (one_in(2)) plant.near_home = world::SwitchSetup{.on = {-3000, 1500}};
      if (one_in(3)) plant.lower_limit = -5000;
      if (one_in(3)) plant.upper_limit = 5000;
      if (one_in(2)) plant.index = world::IndexSetup{.at = 700, .width = 20, .period = 2000};
      if (one_in(3)) plant.encoder_counts_per_revolution = 4000;
      plant.pulses_per_revolution = 2000;
      made.plant[axis] = plant;
    }
    return made;
  }

  std::string command() {
    const std::string axis(1, "XYZU"[between(0, 3)]);
    const std::string speed = of_any_size(500'000);
    switch (between(0, 20)) {
      case 0:
      case 1:
      case 2: return "RSM_FIXED_MOVE " + axis + " " + of_any_size(30'000, true);
      case 3: return "RSM_FIXED_MOVE XYZ " + of_any_size(9000, true);
      case 4: return "RSM_CONTINUE_MOVE " + axis + " " + of_any_size(20'000, true);
      case 5: return "RSM_SET_V " + axis + " " + speed;
      case 6: return "RSM_SET_A " + axis + " " + of_any_size(5'000'000);
      case 7: return "RSM_SET_SV " + axis + " " + of_any_size(5000);
      case 8: return (one_in(2) ? "RSM_STOP_SLOWLY " : "RSM_STOP_SUDDENLY ") + axis;
      case 9: return "RSM_CLEAR_STOP " + axis;
      case 10: return "RSM_LINE_2D " + of_any_size(9000, true) + " " + of_any_size(9000, true);
      case 11: return "RSM_ARC_CW " + of_any_size(3000, true) + " " + of_any_size(3000, true) + " 0 0";
      case 12: return "RSM_HOME_START " + axis;
      case 13: return "RSM_SET_COMPARE " + axis + " 0 0 " + of_any_size(9000, true);
      case 14: return "RSM_SET_LP " + axis + " " + of_any_size(9000, true);
      case 15: return "RSM_MP_CALL " + std::to_string(between(1, 2));
      // Only the encoder's count matters.
      case 17: return "RSM_SET_COMPARE " + axis + " 0 1 " + of_any_size(9000, true);
      case 18: return "RSM_SET_EP " + axis + " " + of_any_size(9000, true);
      case 19:
        return one_in(4) ? "RSM_CLEAR_SLMT " + axis
                         : "RSM_SET_SLMT " + axis + " " + of_any_size(9000) + " -" + of_any_size(9000) + " 1";
      case 16: return one_in(2) ? "RSM_ENABLE_INT" : "RSM_INTFACTOR_ENABLE X 4 1";
      default:
        return one_in(4) ? "RSM_EMERGENCY_STOP " + std::to_string(between(0, 1)) : "RSM_CLEAR_STOP XYZU";
    }
  }

  /// An event for both worlds, and its name.
  std::pair<std::function<void(OneRsm&)>, std::string> act() {
    const auto axis = static_cast<std::size_t>(between(0, 2));
    const bool on = one_in(2);
    switch (between(0, 11)) {
      case 0: {
        const auto pin = static_cast<Pin>(between(0, kPinsOfAxis - 1));
        return {[=](OneRsm& rsm) { rsm.pin(axis, pin, on); },
                "pin " + std::to_string(static_cast<int>(pin)) + " of " + std::to_string(axis)};
      }
      case 1: {
        const world::FaultText fault =
            on ? world::FaultText{.kind = "lost_steps", .place = "rsm.X", .fields = {{"one_in", "3"}}}
               : world::FaultText{.kind = "stall", .place = "rsm.Y", .fields = {}};
        return {[=](OneRsm& rsm) { rsm.world().inject(world::find_fault(rsm.world().known(), fault)); },
                fault.kind};
      }
      case 2: return {[](OneRsm& rsm) { rsm.world().clear_faults(); }, "mended"};
      case 3:
        if (!one_in(4)) break;
        return {[=](OneRsm& rsm) { rsm.world().switch_power(0, on); }, "power"};
      default: break;
    }
    const std::string message = command();
    return {[=](OneRsm& rsm) {
              if (rsm.device().powered()) (void)rsm.exception(message);
            },
            message};
  }

  SimTime pause() {
    return one_in(3)
               ? SimTime{between(0, 20'000'000)}
               : SimTime{std::llround(std::exp2(std::uniform_real_distribution<double>(0, 31)(random_)))};
  }

 private:
  std::mt19937_64 random_;
};

TEST(RsM8194hFastForward, RandomCoursesAreTheSameInBulkAndByTicks) {
  const std::uint64_t first = number_from("UNDERSTUDY_SEED", 81'940);
  std::uint64_t skipped = 0;
  std::int64_t moved = 0;
  for (std::uint64_t seed = first; seed < first + number_from("UNDERSTUDY_COURSES", 60); ++seed) {
    Course course(seed);
    const GivenRsm given = course.given();
    OneRsm plain(given);
    OneRsm twin(given);
    twin.world().set_bulk_ticks(false);
    for (OneRsm* const one : {&plain, &twin}) {
      one->send({"RSM_SET_MAX_V XYZU 500000", "RSM_SET_SV XYZU 1000", "RSM_SET_V XYZU 20000",
                 "RSM_SET_A XYZU 1000000", "RSM_AXIS_ASSIGN X Y 0"});
    }
    std::string done;
    for (int acts = 0; acts < 25; ++acts) {
      const auto [act, name] = course.act();
      done += name + "\n";
      const SimTime time = plain.world().now() + course.pause();
      const std::int64_t before = plain.world().sent_pulses(0, 0);
      for (OneRsm* const one : {&plain, &twin}) {
        act(*one);
        one->world().advance_to(time);
      }
      ASSERT_TRUE(world::same_state(plain.world(), twin.world()))
          << "UNDERSTUDY_SEED=" << seed << " UNDERSTUDY_COURSES=1 at " << format_duration(time) << "\n"
          << done;
      moved += std::abs(plain.world().sent_pulses(0, 0) - before);
    }
    skipped += plain.world().ticks_skipped();
    EXPECT_EQ(twin.world().ticks_skipped(), 0U);
  }
  // The test is meaningful only if many ticks are skipped, and axes move.
  EXPECT_GT(skipped, 10'000U);
  EXPECT_GT(moved, 10'000);
}

TEST(RsM8194hFastForward, AMoveWithNothingToMeetIsFastForwarded) {
  OneRsm rsm;
  rsm.send({"RSM_SET_SV XY 1000", "RSM_SET_V XY 1000", "RSM_FIXED_MOVE XY 10000"});
  const std::uint64_t before = rsm.world().ticks_skipped();
  rsm.run(5000);
  EXPECT_GT(rsm.world().ticks_skipped() - before, 4900U);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 3);
}

/// An encoder that is not compared with anything causes no events.
TEST(RsM8194hFastForward, AMoveWithAnEncoderIsFastForwardedAsWell) {
  GivenRsm given;
  given.plant[0].encoder_counts_per_revolution = 4000;
  given.plant[0].pulses_per_revolution = 1000;
  OneRsm rsm(given);
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 10000"});
  const std::uint64_t before = rsm.world().ticks_skipped();
  rsm.run(5000);
  EXPECT_GT(rsm.world().ticks_skipped() - before, 4900U);
  EXPECT_GT(rsm.get("LP_X"), 4900);
  EXPECT_EQ(rsm.get("EP_X"), 4 * rsm.get("LP_X"));
}

}  // namespace rs_m8194h_fast_forward_test
}  // namespace understudy::emulator::models::rs_m8194h
