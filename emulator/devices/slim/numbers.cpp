#include "emulator/devices/slim/numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace understudy::emulator::slim {

std::string text_of_integer(double value) { return std::to_string(static_cast<std::int64_t>(value)); }

std::string text_of_real(double value) {
  const auto real = static_cast<float>(value);
  if (real == 0) return "0";  // never "-0"
  std::array<char, 64> text{};
  const float size = std::abs(real);
  // Plain digits where a person would write them.
  const auto form = size >= 1e-4F && size < 1e9F ? std::chars_format::fixed : std::chars_format::general;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), real, form);
  return {text.data(), end};
}

}  // namespace understudy::emulator::slim
