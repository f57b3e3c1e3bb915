// Chooses the scale of a picture's axis, and the round numbers along it.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::play {

struct AxisScale {
  double low = 0;
  double high = 1;
  std::vector<double> marks;  // multiples of 1, 2 or 5 times a power of ten, between the two ends
  int decimals = 0;           // the number of decimals that the marks need
};

/// Returns a scale from the smallest to the largest value, and a little beyond so that lines do not touch the
/// frame, with at most this many marks (at least 2). A constant value is in the middle.
AxisScale scale_for(double min, double max, int max_marks);
/// Like the above, but from exactly `low` to exactly `high`.
AxisScale exact_scale_for(double low, double high, int max_marks);

/// Returns "32000" or "10666.67": whole numbers in full, others with seven digits.
std::string plain_number(double value);
/// Returns the number with this many decimals.
std::string fixed_number(double value, int decimals);

}  // namespace understudy::emulator::play
