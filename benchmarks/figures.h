// Evaluates the samples of a benchmark, and prints the results.
#pragma once

#include <algorithm>
#include <cstdio>
#include <span>
#include <vector>

namespace understudy::benchmarks {

/// Returns the smallest sample that is not below `fraction` of the samples, or 0 if there are no samples.
inline double percentile(std::span<const double> samples, double fraction) {
  if (samples.empty()) return 0;
  std::vector<double> sorted(samples.begin(), samples.end());
  const auto rank =
      std::min(sorted.size() - 1, static_cast<std::size_t>(fraction * static_cast<double>(sorted.size())));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
  return sorted[rank];
}

inline double median(std::span<const double> samples) { return percentile(samples, 0.5); }

/// Prints "met      what: 1.050 (bar: at most 1.100)". Only ratios within one run are judged, because times
/// depend on the machine as much as on our code.
inline void print_verdict(const char* what, double ratio, double bar) {
  std::printf("%-8s %s: %.3f (bar: at most %.3f)\n", ratio <= bar ? "met" : "NOT MET", what, ratio, bar);
}

}  // namespace understudy::benchmarks
