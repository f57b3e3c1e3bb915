// Random moves: near zero, round, exactly where a triangle becomes a trapezoid, and everything between.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

#include "tests/motion/exact_trapezoid.h"
#include "tests/sanitized.h"

namespace understudy::motion {

/// Returns the seed, which UNDERSTUDY_SEED can set. Tests print it with every failure.
inline std::uint64_t seed() {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 20'240'611;
}

/// Returns how many random cases a test tries: `usual`, a tenth of that under sanitizers, or UNDERSTUDY_MOVES
/// if given.
inline int random_cases(int usual) {
  if (const char* given = std::getenv("UNDERSTUDY_MOVES")) return std::atoi(given);
  return is_address_sanitized() ? usual / 10 : usual;
}

class RandomMoves {
 public:
  explicit RandomMoves(std::uint64_t seed) : random_(seed) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }

  /// Draws small numbers as often as large ones.
  std::int64_t of_any_size(std::int64_t low, std::int64_t high) {
    std::uniform_real_distribution<double> exponent(std::log2(static_cast<double>(low)),
                                                    std::log2(static_cast<double>(high)));
    return std::clamp(static_cast<std::int64_t>(std::exp2(exponent(random_))), low, high);
  }

  /// Draws a move that takes at most `longest_ms`.
  RegisterMove next(std::int64_t longest_ms) {
    constexpr std::array<std::int64_t, 8> kResolutions{1, 200, 3000, 3200, 6000, 10'000, 36'000, 1LL << 31};
    constexpr std::array<std::int64_t, 8> kSpeeds{1, 20, 60, 200, 600, 1875, 3000, 32'768};
    RegisterMove move;
    move.resolution = pick(kResolutions, of_any_size(1, 1LL << 31));
    move.speed_rpm = pick(kSpeeds, of_any_size(1, 32'768));
    move.acceleration_10ms = ramp_time();
    move.deceleration_10ms = between(0, 3) == 0 ? move.acceleration_10ms : ramp_time();
    const Ratio limit = move.limit();
    // The distance at which the ramps just fill the move.
    const std::int64_t equal = Ratio{limit.num * move.ramps_ms(), 2 * limit.den}.floor();
    switch (between(0, 5)) {
      case 0: move.distance_pulses = between(1, 5); break;
      case 1: move.distance_pulses = std::max<std::int64_t>(1, equal + between(-1, 1)); break;
      case 2: move.distance_pulses = 100 * of_any_size(1, 10'000'000); break;
      case 3: move.distance_pulses = std::max<std::int64_t>(1, equal * between(1, 4) / between(1, 4)); break;
      default: move.distance_pulses = of_any_size(1, 1LL << 32);
    }
    const std::int64_t farthest = Ratio{limit.num * longest_ms, limit.den}.floor();
    move.distance_pulses =
        std::clamp<std::int64_t>(move.distance_pulses, 1, std::max<std::int64_t>(1, farthest));
    return move;
  }

 private:
  template <std::size_t N>
  std::int64_t pick(const std::array<std::int64_t, N>& round_ones, std::int64_t any) {
    return between(0, 1) == 0 ? round_ones[static_cast<std::size_t>(between(0, N - 1))] : any;
  }
  std::int64_t ramp_time() {
    constexpr std::array<std::int64_t, 6> kRound{1, 2, 5, 100, 1500, 3000};
    return pick(kRound, of_any_size(1, 3000));
  }

  std::mt19937_64 random_;
};

}  // namespace understudy::motion
