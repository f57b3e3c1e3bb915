// Formats the numbers in SLIM's replies.
#pragma once

#include <cstdint>
#include <string>

namespace understudy::emulator::models::slim {

enum class RealForm : std::uint8_t {
  plain,     // digits and a point, for any size
  exponent,  // with an exponent for 1e9 and above, and below 1e-4
};

std::string text_of_integer(double value);
/// Writes as few digits as necessary to distinguish a 32-bit real from its neighbours.
std::string text_of_real(double value, RealForm form = RealForm::plain);
/// Distinguishes all pulses: whole numbers are exact, other numbers have up to nine decimals and about 15
/// digits.
std::string text_of_coordinate(double units);

}  // namespace understudy::emulator::models::slim
