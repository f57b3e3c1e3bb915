#include "emulator/play/report/envelope.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator::play {

void Envelope::add(Tick tick, double value) {
  const Point point{tick, value};
  if (stretches_.empty()) {
    origin_ = tick;
    min_ = max_ = value;
    stretches_.push_back({point, point, point, point});
    return;
  }
  if (tick <= stretches_.back().last.tick) return;
  min_ = std::min(min_, value);
  max_ = std::max(max_, value);
  while (static_cast<std::size_t>((tick - origin_) / length_) >= max_stretches_) halve();
  Stretch& last = stretches_.back();
  if ((tick - origin_) / length_ != (last.first.tick - origin_) / length_) {
    stretches_.push_back({point, point, point, point});
    return;
  }
  if (value < last.min.value) last.min = point;
  if (value > last.max.value) last.max = point;
  last.last = point;
}

void Envelope::stay(Tick last) {
  if (stretches_.empty()) return;
  const double value = stretches_.back().last.value;
  while (stretches_.back().last.tick < last) {
    // Between the first and the last tick of a stretch, only these two points are kept.
    const Tick at = stretches_.back().last.tick;
    const Tick end = origin_ + ((at - origin_) / length_ + 1) * length_ - 1;
    add(std::min(at < end ? end : at + 1, last), value);
  }
}

/// Merges pairs of stretches, which doubles their length.
void Envelope::halve() {
  length_ *= 2;
  std::vector<Stretch> longer;
  for (const Stretch& stretch : stretches_) {
    const bool is_new = longer.empty() || (stretch.first.tick - origin_) / length_ !=
                                              (longer.back().first.tick - origin_) / length_;
    if (is_new) {
      longer.push_back(stretch);
      continue;
    }
    Stretch& whole = longer.back();
    if (stretch.min.value < whole.min.value) whole.min = stretch.min;
    if (stretch.max.value > whole.max.value) whole.max = stretch.max;
    whole.last = stretch.last;
  }
  stretches_ = std::move(longer);
}

std::vector<Envelope::Point> Envelope::points() const {
  std::vector<Point> points;
  const auto add = [&](const Point& point) {
    if (!points.empty() && point.tick <= points.back().tick) return;
    const std::size_t size = points.size();
    const bool stays =
        size >= 2 && points[size - 1].value == point.value && points[size - 2].value == point.value;
    if (stays) {
      points.back() = point;
    } else {
      points.push_back(point);
    }
  };
  for (const Stretch& stretch : stretches_) {
    std::array<Point, 4> four{stretch.first, stretch.min, stretch.max, stretch.last};
    std::sort(four.begin(), four.end(), [](const Point& a, const Point& b) { return a.tick < b.tick; });
    for (const Point& point : four) add(point);
  }
  return points;
}

}  // namespace understudy::emulator::play
