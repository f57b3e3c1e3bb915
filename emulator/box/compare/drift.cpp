#include "emulator/box/compare/drift.h"

#include <cstddef>
#include <functional>

#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::box {

double fit_drift(const world::Bench& bench, const Capture& capture, const CompareSettings& settings,
                 const std::function<bool()>& is_over) {
  // Quartzes and processors' oscillators are within this; between two steps motions stay within a tolerance.
  constexpr int kFurthest = 300;
  constexpr int kStep = 25;
  const auto agrees_for = [&](int millionths) {
    CompareSettings with = settings;
    with.drift_ppm = millionths;
    const Comparison comparison = compare(bench, capture, with, Extent::to_difference);
    return comparison.first_difference.value_or(capture.exchanges.size());
  };
  int best = 0;
  std::size_t furthest = agrees_for(0);
  const std::size_t without = furthest;
  int last = 0;  // of those that are equally good the middle one is taken
  for (int millionths = kStep; millionths <= kFurthest && without < capture.exchanges.size();
       millionths += kStep) {
    for (const int one : {millionths, -millionths}) {
      if (is_over && is_over()) return 0;
      const std::size_t reach = agrees_for(one);
      if (reach < furthest || reach == without) continue;
      if (reach > furthest) {
        best = last = one;
      } else if ((one > 0) == (best > 0)) {
        last = one;
      }
      furthest = reach;
    }
  }
  return (best + last) / 2.0;
}

}  // namespace understudy::emulator::box
