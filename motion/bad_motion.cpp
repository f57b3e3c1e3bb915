#include "motion/bad_motion.h"

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace understudy::motion {

namespace {

std::string require(std::string_view quantity, std::string_view wanted, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return std::string(quantity) + " must be " + std::string(wanted) + "; it is " + std::string(digits, end);
}

}  // namespace

void require_finite(double value, std::string_view law, std::string_view quantity) {
  if (!std::isfinite(value)) {
    throw BadMotion(Refusal::not_finite, law, require(quantity, "a finite number", value));
  }
}

void require_positive(double value, std::string_view law, std::string_view quantity) {
  require_finite(value, law, quantity);
  if (value <= 0) throw BadMotion(Refusal::not_positive, law, require(quantity, "above 0", value));
}

void require_not_negative(double value, std::string_view law, std::string_view quantity) {
  require_finite(value, law, quantity);
  if (value < 0) throw BadMotion(Refusal::negative, law, require(quantity, "0 or above", value));
}

}  // namespace understudy::motion
