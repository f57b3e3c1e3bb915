// Random numbers from a seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace understudy::emulator::world::sleepers {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  bool one_in(std::int64_t many) { return between(1, many) == 1; }
  std::int64_t of_any_size(std::int64_t max) {
    std::uniform_real_distribution<double> exponent(0, std::log2(static_cast<double>(max)));
    return std::llround(std::exp2(exponent(random_)));
  }
  std::int64_t of_any_size_and_sign(std::int64_t max) { return (one_in(2) ? -1 : 1) * of_any_size(max); }
  template <typename Range>
  const auto& one_of(const Range& range) {
    return *(std::begin(range) + between(0, static_cast<std::int64_t>(std::size(range)) - 1));
  }
  std::string number(std::int64_t low, std::int64_t high) { return std::to_string(between(low, high)); }

 private:
  std::mt19937_64 random_;
};

}  // namespace understudy::emulator::world::sleepers
