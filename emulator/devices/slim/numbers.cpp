#include "emulator/devices/slim/numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace understudy::emulator::slim {

std::string text_of_integer(double value) { return std::to_string(static_cast<std::int64_t>(value)); }

std::string text_of_real(double value, RealForm form) {
  const auto real = static_cast<float>(value);
  if (real == 0) return "0";  // never "-0"
  std::array<char, 64> text{};
  const float size = std::abs(real);
  const bool is_plain = form == RealForm::plain || (size >= 1e-4F && size < 1e9F);
  const auto format = is_plain ? std::chars_format::fixed : std::chars_format::general;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), real, format);
  return {text.data(), end};
}

std::string text_of_coordinate(double units) {
  const double size = std::abs(units);
  if (size >= 1e15 || units == std::trunc(units)) return text_of_integer(units);
  int decimals = 9;
  for (double most = 1e6; size >= most && decimals > 0; most *= 10) --decimals;
  std::array<char, 64> digits{};
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), units, std::chars_format::fixed, decimals);
  std::string text(digits.data(), end);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace understudy::emulator::slim
