// What a benchmark makes of its samples, and how it says so.
#pragma once

#include <algorithm>
#include <cstdio>
#include <span>
#include <vector>

namespace understudy::benchmarks {

/// The smallest sample that is not below `fraction` of them. Of no samples: 0.
inline double percentile(std::span<const double> samples, double fraction) {
  if (samples.empty()) return 0;
  std::vector<double> sorted(samples.begin(), samples.end());
  const auto rank =
      std::min(sorted.size() - 1, static_cast<std::size_t>(fraction * static_cast<double>(sorted.size())));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
  return sorted[rank];
}

inline double median(std::span<const double> samples) { return percentile(samples, 0.5); }

/// "met      what: 1.050 (bar: at most 1.100)"
inline void print_verdict(const char* what, double figure, double bar, const char* unit = "") {
  std::printf("%-8s %s: %.3f%s (bar: at most %.3f%s)\n", figure <= bar ? "met" : "NOT MET", what, figure,
              unit, bar, unit);
}

}  // namespace understudy::benchmarks
