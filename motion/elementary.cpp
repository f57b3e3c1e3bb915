#include "motion/elementary.h"

#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace understudy::motion {

namespace {

static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0,
              "doubles must be IEEE 754 doubles, intermediate results too");

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A number as the sum of two doubles. The second is far smaller than the last bit of the first.
struct Parts {
  double high = 0;
  double low = 0;
};

/// a - b without any loss (Knuth).
Parts exact_difference(double a, double b) {
  const double difference = a - b;
  const double taken = a - difference;
  return {difference, (a - (difference + taken)) + (taken - b)};
}

// ---- sine and cosine -------------------------------------------------------------------------------------

// pi/2 in three parts of 33 bits and a remainder (Cody and Waite): a part times a whole number of 20 bits is
// exact.
constexpr double kQuarter1 = 0x1.921fb544p+0;
constexpr double kQuarter2 = 0x1.0b4611a6p-34;
constexpr double kQuarter3 = 0x1.3198a2ep-69;
constexpr double kQuarter4 = 0x1.b839a252049c1p-104;
constexpr double kQuartersPerRadian = 0x1.45f306dc9c883p-1;
static_assert(kFarthestAngle_rad * kQuartersPerRadian < (1 << 20));

// Adding and subtracting this constant rounds to a whole number, which is then in the last bits of the sum.
constexpr double kRounder = 0x1.8p52;

/// The Taylor series for |r| <= pi/4; the first omitted term is below 1e-19. `low` is the part of the angle
/// below the last bit of r. Even and odd terms are summed separately, because two short chains are faster
/// than a long one.
double sine_near_0(double r, double low) {
  const double z = r * r;
  const double w = z * z;
  const double odd = -1.0 / 6 + w * (-1.0 / 5040 + w * (-1.0 / 39916800 - w * (1.0 / 1307674368000)));
  const double even = 1.0 / 120 + w * (1.0 / 362880 + w * (1.0 / 6227020800 + w * (1.0 / 355687428096000)));
  return r + (r * z * (odd + z * even) + low * (1 - 0.5 * z));
}

double cosine_near_0(double r, double low) {
  const double z = r * r;
  const double w = z * z;
  const double even = 1.0 / 24 + w * (1.0 / 40320 + w * (1.0 / 479001600 + w * (1.0 / 20922789888000)));
  const double odd = -1.0 / 720 + w * (-1.0 / 3628800 - w * (1.0 / 87178291200));
  const double half = 0.5 * z;
  const double first = 1 - half;
  // (1 - first) - half is the rounding error of `first`.
  return first + (((1 - first) - half) + (w * (even + z * odd) - r * low));
}

// ---- arctangent ------------------------------------------------------------------------------------------

// The arctangents of 0/8 .. 8/8.
constexpr std::array<Parts, 9> kArctangentOfEighths{{{0, 0},
                                                     {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                                     {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                                     {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                                     {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                                     {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                                     {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                                     {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                                     {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};
constexpr Parts kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Parts kWholePi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

/// For 0 <= y <= x with x > 0: adds the arctangent of an eighth near y/x and the arctangent of the remainder,
/// which is computed by its Taylor series.
Parts angle_in_first_octant(double y, double x) {
  const int eighths = static_cast<int>(8 * (y / x) + 0.5);
  const double slope = eighths * 0.125;
  const double u = (y - slope * x) / (x + slope * y);  // |u| <= 1/16
  const double z = u * u;
  const double series =
      -1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13)))));
  const Parts near = kArctangentOfEighths[static_cast<std::size_t>(eighths)];
  const double rest = u + (u * z * series + near.low);
  const double sum = near.high + rest;
  return {sum, rest - (sum - near.high)};
}

Parts operator-(const Parts& whole, const Parts& part) {
  const Parts high = exact_difference(whole.high, part.high);
  return {high.high, high.low + (whole.low - part.low)};
}

// ---- logarithm -------------------------------------------------------------------------------------------

// ln 2. The first part has 32 bits, so its product with an exponent is exact.
constexpr Parts kLn2{0x1.62e42feep-1, 0x1.a39ef35793c76p-33};
constexpr double kRootHalf = 0x1.6a09e667f3bcdp-1;

}  // namespace

SineCosine sine_cosine(double angle_rad) {
  if (!(std::abs(angle_rad) <= kFarthestAngle_rad)) return {kNan, kNan};
  if (angle_rad == 0) return {angle_rad, 1};
  const double shifted = angle_rad * kQuartersPerRadian + kRounder;
  const double quarters = shifted - kRounder;
  const Parts once = exact_difference(angle_rad - quarters * kQuarter1, quarters * kQuarter2);
  const Parts twice = exact_difference(once.high, quarters * kQuarter3);
  const double low = once.low + twice.low - quarters * kQuarter4;
  const double sine = sine_near_0(twice.high, low);
  const double cosine = cosine_near_0(twice.high, low);
  switch (std::bit_cast<std::uint64_t>(shifted) & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
  }
}

double angle_of(double y, double x) {
  if (!std::isfinite(x) || !std::isfinite(y)) return kNan;
  double across = std::abs(y);
  double along = std::abs(x);
  const bool steep = across > along;
  if (steep) std::swap(across, along);
  if (along == 0) return 0;
  // Far from overflow and from subnormal numbers, the quotients below keep all their bits.
  if (along > 0x1p1000 || along < 0x1p-900) {
    const double scale = along > 1 ? 0x1p-100 : 0x1p170;
    across *= scale;
    along *= scale;
  }
  Parts angle = angle_in_first_octant(across, along);
  if (steep) angle = kHalfPi - angle;
  if (x < 0) angle = kWholePi - angle;
  const double sum = angle.high + angle.low;
  return y < 0 ? -sum : sum;
}

double natural_log(double value) {
  if (!(value > 0) || !std::isfinite(value)) return kNan;
  int exponent = 0;
  double mantissa = std::frexp(value, &exponent);  // 0.5 .. 1
  if (mantissa < kRootHalf) {
    mantissa *= 2;
    --exponent;
  }
  // log(1 + f) = 2 atanh(s) with s = f / (2 + f), |s| < 0.172; written so that the large terms are exact:
  // f - f^2/2 + s * (f^2/2 + (2/3 s^2 + 2/5 s^4 + ...)).
  const double f = mantissa - 1;
  const double s = f / (2 + f);
  const double z = s * s;
  const double w = z * z;
  const double odd =
      2.0 / 3 + w * (2.0 / 7 + w * (2.0 / 11 + w * (2.0 / 15 + w * (2.0 / 19 + w * (2.0 / 23)))));
  const double even = 2.0 / 5 + w * (2.0 / 9 + w * (2.0 / 13 + w * (2.0 / 17 + w * (2.0 / 21))));
  const double series = z * (odd + z * even);
  const double half_square = 0.5 * f * f;
  const double correction = s * (half_square + series);
  if (exponent == 0) return f - (half_square - correction);
  const double whole = exponent;
  return whole * kLn2.high - ((half_square - (correction + whole * kLn2.low)) - f);
}

}  // namespace understudy::motion
