#include "emulator/models/slim/numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace understudy::emulator::models::slim {

namespace {

/// Writes the fewest digits that identify the number. Before the point, zeros replace the other digits.
/// (to_chars() itself writes all 39 digits of a large number.)
std::string plain_digits(float real) {
  std::array<char, 32> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), std::abs(real), std::chars_format::scientific);
  const std::string_view written(text.data(), end);  // d.ddde+dd
  const std::size_t e = written.find('e');
  std::string digits(written.substr(0, e));
  if (digits.size() > 1) digits.erase(1, 1);
  int exponent = 0;
  std::from_chars(written.data() + e + (written[e + 1] == '+' ? 2 : 1), written.data() + written.size(),
                  exponent);
  if (exponent < 0) {
    digits.insert(0, static_cast<std::size_t>(-exponent), '0');
    exponent = 0;
  }
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (digits.size() < whole) digits.append(whole - digits.size(), '0');
  if (digits.size() > whole) digits.insert(whole, 1, '.');
  return (real < 0 ? "-" : "") + digits;
}

}  // namespace

std::string text_of_integer(double value) { return std::to_string(static_cast<std::int64_t>(value)); }

std::string text_of_real(double value, RealForm form) {
  const auto real = static_cast<float>(value);
  if (real == 0) return "0";  // never "-0"
  std::array<char, 64> text{};
  const float size = std::abs(real);
  if (form == RealForm::plain || (size >= 1e-4F && size < 1e9F)) return plain_digits(real);
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), real, std::chars_format::general);
  return {text.data(), end};
}

std::string text_of_coordinate(double units) {
  const double size = std::abs(units);
  if (size >= 1e15 || units == std::trunc(units)) return text_of_integer(units);
  int decimals = 9;
  for (double max = 1e6; size >= max && decimals > 0; max *= 10) --decimals;
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

}  // namespace understudy::emulator::models::slim
