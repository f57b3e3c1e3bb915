#include "motion/external_drive.h"

#include <gtest/gtest.h>

#include <vector>

namespace understudy::motion {
namespace external_drive_test {

using Mode = ExternalDrive::Mode;
using What = DriveOrder::What;

constexpr DriveOrder kNothing{};
constexpr DriveOrder kSlowDown{.what = What::slow_down};
constexpr DriveOrder moves(std::int64_t pulses) { return {.what = What::move, .pulses = pulses}; }
constexpr DriveOrder runs(std::int8_t direction) { return {.what = What::run, .direction = direction}; }

/// The inputs in one tick, and the result.
struct InputCase {
  bool plus_high;
  bool minus_high;
  bool axis_moving;
  DriveOrder order;
};

void expect_orders(ExternalDrive drive, const std::vector<InputCase>& ticks) {
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const InputCase& now = ticks[i];
    const DriveOrder order = watch_inputs(drive, now.plus_high, now.minus_high, now.axis_moving);
    EXPECT_EQ(order, now.order) << "tick " << i << ": " << static_cast<int>(order.what) << " " << order.pulses
                                << " " << int{order.direction};
  }
}

TEST(ExternalDrive, OffItAsksForNothing) {
  expect_orders({.mode = Mode::off, .pulses = 10}, {
                                                       {false, true, false, kNothing},
                                                       {true, false, false, kNothing},
                                                       {false, false, false, kNothing},
                                                   });
}

TEST(ExternalDrive, MultipliesTheEdgesOfPlusWhileMinusIsLow) {
  expect_orders({.mode = Mode::multiply, .pulses = 10}, {
                                                            {false, true, false, kNothing},  // minus high
                                                            {true, true, false, kNothing},
                                                            {true, false, false, kNothing},
                                                            {false, false, false, moves(-10)},
                                                            {false, false, false, kNothing},
                                                            {true, false, false, moves(10)},
                                                            {true, false, true, kNothing},
                                                            {false, false, true, moves(-10)},
                                                            {false, true, true, kNothing},
                                                        });
}

TEST(ExternalDrive, SendsAFixedNumberForAFallingEdge) {
  expect_orders({.mode = Mode::fixed, .pulses = 100}, {
                                                          {true, true, false, kNothing},
                                                          {false, true, false, moves(100)},
                                                          {false, true, true, kNothing},
                                                          {true, true, true, kNothing},
                                                          {true, false, false, moves(-100)},
                                                          {true, true, false, kNothing},
                                                          {false, false, false, moves(100)},
                                                      });
}

TEST(ExternalDrive, AFixedNumberIsNotRequestedWhileBusyNorAfterwards) {
  expect_orders({.mode = Mode::fixed, .pulses = 100}, {
                                                          {false, true, false, moves(100)},
                                                          {true, true, true, kNothing},
                                                          {false, true, true, kNothing},
                                                          {false, true, false, kNothing},
                                                      });
}

TEST(ExternalDrive, RunsOnAndOnWhileAnInputIsLow) {
  expect_orders({.mode = Mode::continuous}, {
                                                {true, true, false, kNothing},
                                                {false, true, false, runs(+1)},
                                                {false, true, true, kNothing},
                                                {true, true, true, kSlowDown},
                                                {true, true, true, kNothing},
                                                {true, false, false, runs(-1)},
                                                {true, true, true, kSlowDown},
                                            });
}

TEST(ExternalDrive, TheOtherInputDoesNotDisturbARun) {
  expect_orders({.mode = Mode::continuous}, {
                                                {false, true, false, runs(+1)},
                                                {false, false, true, kNothing},
                                                {false, true, true, kNothing},
                                                {true, true, true, kSlowDown},
                                            });
}

TEST(ExternalDrive, NoPulsesAreNoOrder) {
  for (const Mode mode : {Mode::multiply, Mode::fixed}) {
    expect_orders({.mode = mode, .pulses = 0}, {
                                                   {false, false, false, kNothing},
                                                   {true, true, false, kNothing},
                                                   {false, true, false, kNothing},
                                               });
  }
}

TEST(ExternalDrive, RemembersTheLevelsWhateverTheMode) {
  ExternalDrive drive;
  watch_inputs(drive, false, false, false);
  drive.mode = Mode::fixed;
  drive.pulses = 5;
  EXPECT_EQ(watch_inputs(drive, false, false, false), kNothing);  // already low: no edge
  EXPECT_FALSE(drive.plus_high);
  EXPECT_FALSE(drive.minus_high);
}

}  // namespace external_drive_test
}  // namespace understudy::motion
