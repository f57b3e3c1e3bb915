#include "emulator/play/report/axis_scale.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace understudy::emulator::play {

AxisScale exact_scale_for(double low, double high, int max_marks) {
  AxisScale scale{.low = low, .high = high, .marks = {}, .decimals = 0};
  // This finds the smallest step of 1, 2, 5, 10, ... for which the number of marks is small enough.
  const double wanted = (high - low) / max_marks;
  double power = 1;
  int decimals = 0;
  while (power > wanted) {
    power /= 10;
    ++decimals;
  }
  while (power * 10 <= wanted) {
    power *= 10;
    --decimals;
  }
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= wanted) step = factor * power;
  }
  if (step == 10 * power) --decimals;
  scale.decimals = std::max(decimals, 0);
  for (double i = std::ceil(low / step); i * step <= high; ++i) scale.marks.push_back(i * step);
  return scale;
}

AxisScale scale_for(double min, double max, int max_marks) {
  constexpr double kBeyond = 0.05;
  if (min == max) return exact_scale_for(min - 1, max + 1, std::min(max_marks, 3));
  const double beyond = kBeyond * (max - min);
  return exact_scale_for(min - beyond, max + beyond, max_marks);
}

std::string plain_number(double value) {
  constexpr double kLargestWhole = 1e15;
  constexpr int kDigits = 7;
  std::array<char, 40> digits;
  if (std::floor(value) == value && std::abs(value) < kLargestWhole) {
    return std::to_string(static_cast<long long>(value));
  }
  const auto written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, kDigits);
  return {digits.data(), written.ptr};
}

std::string fixed_number(double value, int decimals) {
  std::array<char, 400> digits;
  const auto written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals);
  const std::string text(digits.data(), written.ptr);
  const bool is_minus_zero = text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos;
  return is_minus_zero ? text.substr(1) : text;
}

}  // namespace understudy::emulator::play
