// Our own functions compared with the maths library's in long double, which has 11 bits more.
#include "motion/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <vector>

namespace understudy::motion {
namespace elementary_test {

// The bounds that the header states.
constexpr long double kSineCosineAbsolute = 1.2e-16L;
constexpr long double kSineCosineRelative = 2.5e-16L;
constexpr long double kAngleRelative = 4e-16L;
constexpr long double kLogRelative = 4e-16L;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

class Elementary : public testing::Test {
 protected:
  void SetUp() override {
    if (std::numeric_limits<long double>::digits < 64)
      GTEST_SKIP() << "long double is not longer than double";
  }
};

/// The largest errors seen, for the record.
struct Worst {
  long double absolute = 0;
  long double relative = 0;

  void add(double is, long double should) {
    const long double error = std::abs(is - should);
    absolute = std::max(absolute, error);
    if (should != 0) relative = std::max(relative, error / std::abs(should));
  }
};

struct SineCosineWorst {
  Worst sine;
  Worst cosine;

  void add(double angle) {
    const SineCosine both = sine_cosine(angle);
    sine.add(both.sine, std::sin(static_cast<long double>(angle)));
    cosine.add(both.cosine, std::cos(static_cast<long double>(angle)));
  }
  void expect_within_the_bounds() const {
    std::cout << "sine " << sine.absolute << ", relative " << sine.relative << "; cosine " << cosine.absolute
              << ", relative " << cosine.relative << "\n";
    EXPECT_LT(sine.absolute, kSineCosineAbsolute);
    EXPECT_LT(cosine.absolute, kSineCosineAbsolute);
    EXPECT_LT(sine.relative, kSineCosineRelative);
    EXPECT_LT(cosine.relative, kSineCosineRelative);
  }
};

/// A double and its neighbours.
std::vector<double> about(double value) {
  return {std::nextafter(value, -kInfinity), value, std::nextafter(value, kInfinity)};
}

TEST_F(Elementary, SineAndCosineAreWithinTheirBoundsOverAFewTurns) {
  SineCosineWorst worst;
  for (int i = -200'000; i <= 200'000; ++i) worst.add(i * 4e-5);
  worst.expect_within_the_bounds();
}

TEST_F(Elementary, SineAndCosineKeepTheirBoundsUpToTheLargestAngle) {
  SineCosineWorst worst;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-kFarthestAngle_rad, kFarthestAngle_rad);
  for (int i = 0; i < 200'000; ++i) worst.add(any(random));
  for (const double angle : {kFarthestAngle_rad, -kFarthestAngle_rad}) worst.add(angle);
  worst.expect_within_the_bounds();
}

TEST_F(Elementary, SineAndCosineKeepTheirBitsAtEveryEighthOfATurn) {
  SineCosineWorst worst;
  constexpr int kEighths = static_cast<int>(kFarthestAngle_rad / (kPi / 4));
  for (int i = -kEighths; i <= kEighths; i += std::abs(i) < 2000 ? 1 : 7) {
    for (const double angle : about(i * (kPi / 4))) worst.add(angle);
  }
  worst.expect_within_the_bounds();
}

TEST_F(Elementary, SineAndCosineOfTinyAnglesAreTheAngleAndOne) {
  SineCosineWorst worst;
  for (double angle = 1; angle > 1e-300; angle *= 0.37) worst.add(angle);
  worst.expect_within_the_bounds();
  for (const double angle : {0.0, kSmallest, -kSmallest, 1e-300, -1e-20}) {
    EXPECT_EQ(sine_cosine(angle).sine, angle);
    EXPECT_EQ(sine_cosine(angle).cosine, 1);
  }
  EXPECT_TRUE(std::signbit(sine_cosine(-0.0).sine));
}

TEST_F(Elementary, SineAndCosineOfWhatIsNoAngleAreNan) {
  for (const double angle : {kNan, kInfinity, -kInfinity, std::nextafter(kFarthestAngle_rad, kInfinity),
                             std::nextafter(-kFarthestAngle_rad, -kInfinity), 1e300}) {
    EXPECT_TRUE(std::isnan(sine_cosine(angle).sine)) << angle;
    EXPECT_TRUE(std::isnan(sine_cosine(angle).cosine)) << angle;
  }
}

void add_angle(Worst& worst, double y, double x) {
  // + 0: unlike atan2, ours has no negative zero.
  worst.add(angle_of(y, x), std::atan2(static_cast<long double>(y) + 0, static_cast<long double>(x)));
}

TEST_F(Elementary, AngleIsWithinItsBoundAllAround) {
  Worst worst;
  for (int i = 0; i < 300'000; ++i) {
    const double angle = i * (2 * kPi / 300'000);
    const double radius = 1 + 1000.0 * (i % 17);
    add_angle(worst, radius * std::sin(angle), radius * std::cos(angle));
  }
  std::cout << "angle, relative " << worst.relative << "\n";
  EXPECT_LT(worst.relative, kAngleRelative);
}

TEST_F(Elementary, AngleIsWithinItsBoundWhereItsTableIsSwitched) {
  Worst worst;
  for (int sixteenths = 0; sixteenths <= 16; ++sixteenths) {
    for (const double slope : about(sixteenths / 16.0)) {
      for (const double x : {1.0, -1.0, 3.0, -7.0}) {
        for (const double sign : {1.0, -1.0}) {
          add_angle(worst, sign * slope * x, x);
          add_angle(worst, x, sign * slope * x);
        }
      }
    }
  }
  EXPECT_LT(worst.relative, kAngleRelative);
}

TEST_F(Elementary, AngleIsWithinItsBoundForAnyMagnitudes) {
  Worst worst;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-290, 300);
  std::uniform_real_distribution<double> digits(-10, 10);
  for (int i = 0; i < 100'000; ++i) {
    const double y = digits(random) * std::pow(10, exponent(random));
    const double x = digits(random) * std::pow(10, exponent(random));
    // The result itself must not be subnormal.
    if (x < 0 || std::abs(y) > std::abs(x) || std::abs(y / x) > 1e-290) add_angle(worst, y, x);
  }
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (const double y : {kLargest, kLargest / 3, 1e-305, kSmallest}) {
    for (const double x : {kLargest, -kLargest, kLargest / 7}) {
      if (y > 1 || x < 0) add_angle(worst, y, x);
    }
    add_angle(worst, y, 3 * y / 4);
    add_angle(worst, -y, -y);
  }
  EXPECT_LT(worst.relative, kAngleRelative);
}

TEST_F(Elementary, AngleOfEighthsIsTheNearestDouble) {
  for (int eighths = 1; eighths <= 8; ++eighths) {
    const auto should = static_cast<double>(std::atan(static_cast<long double>(eighths) / 8));
    EXPECT_EQ(angle_of(eighths, 8), should) << eighths;
  }
}

TEST(ElementaryAngle, IsExactOnTheAxesAndPositiveOnTheNegativeOne) {
  struct Case {
    double y, x, angle;
  };
  for (const auto& [y, x, angle] : std::vector<Case>{{0, 0, 0},
                                                     {-0.0, -0.0, 0},
                                                     {0, 5, 0},
                                                     {-0.0, 5, 0},
                                                     {0, -5, kPi},
                                                     {-0.0, -5, kPi},
                                                     {3, 0, kPi / 2},
                                                     {-3, 0, -kPi / 2},
                                                     {3, -0.0, kPi / 2},
                                                     {2, 2, kPi / 4},
                                                     {2, -2, 3 * kPi / 4},
                                                     {-2, -2, -3 * kPi / 4},
                                                     {-1e-300, -1, -kPi}}) {
    EXPECT_EQ(angle_of(y, x), angle) << y << ", " << x;
    EXPECT_FALSE(angle == 0 && std::signbit(angle_of(y, x))) << y << ", " << x;
  }
}

TEST(ElementaryAngle, OfWhatIsNoPlaceIsNan) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_TRUE(std::isnan(angle_of(bad, 1)));
    EXPECT_TRUE(std::isnan(angle_of(1, bad)));
    EXPECT_TRUE(std::isnan(angle_of(bad, bad)));
  }
}

TEST_F(Elementary, LogarithmIsWithinItsBound) {
  Worst worst;
  const auto add = [&worst](double value) {
    worst.add(natural_log(value), std::log(static_cast<long double>(value)));
  };
  for (int i = 1; i < 300'000; ++i) add(i * 1e-5);  // 0 .. 3, through 1
  for (int power = -1074; power < 1024; ++power) {
    for (const double value : about(std::ldexp(1.0, power))) {
      if (value > 0) add(value);
    }
    for (const double value : about(std::ldexp(0x1.6a09e667f3bcdp0, power))) add(value);
  }
  for (double away = 0.5; away > 1e-16; away *= 0.7) {
    add(1 + away);
    add(1 - away);
  }
  add(std::numeric_limits<double>::max());
  std::cout << "logarithm, relative " << worst.relative << "\n";
  EXPECT_LT(worst.relative, kLogRelative);
}

TEST(ElementaryLogarithm, OfOneIsExactlyZeroAndOfWhatHasNoneNan) {
  EXPECT_EQ(natural_log(1), 0);
  for (const double value : {0.0, -0.0, -1.0, -kSmallest, kNan, kInfinity, -kInfinity}) {
    EXPECT_TRUE(std::isnan(natural_log(value))) << value;
  }
}

}  // namespace elementary_test
}  // namespace understudy::motion
