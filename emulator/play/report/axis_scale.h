// Determines the scale of an axis in a picture, and the round numbers along it.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::play {

struct AxisScale {
  double low = 0;
  double high = 1;
  std::vector<double> marks;  // multiples of 1, 2 or 5 times a power of ten, between the two ends
  int decimals = 0;           // the number of decimal places that the marks need
};

/// Returns a scale from the smallest to the largest value, with a margin so that lines do not touch the
/// frame, and with at most `max_marks` marks (at least 2). A constant value is in the middle.
AxisScale scale_for(double min, double max, int max_marks);
/// The same, but exactly from `low` to `high`.
AxisScale exact_scale_for(double low, double high, int max_marks);

/// Returns "32000" or "10666.67": integers with all digits, other numbers with seven digits.
std::string plain_number(double value);
/// Returns the number with this many decimal places.
std::string fixed_number(double value, int decimals);

}  // namespace understudy::emulator::play
