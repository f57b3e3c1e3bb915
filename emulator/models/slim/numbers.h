// Formats the numbers in SLIM's replies.
#pragma once

#include <cstdint>
#include <string>

namespace understudy::emulator::models::slim {

enum class RealForm : std::uint8_t {
  plain,     // digits and a point, for any size
  exponent,  // with an exponent from 1e9 on and below 1e-4
};

std::string text_of_integer(double value);
/// Writes as few digits as distinguish a 32-bit real from its neighbours.
std::string text_of_real(double value, RealForm form = RealForm::plain);
/// Distinguishes every pulse: whole numbers exactly, others with up to nine decimals and about 15 digits.
std::string text_of_coordinate(double units);

}  // namespace understudy::emulator::models::slim
