// The pulses over time, compared with lines and circles that are drawn pulse by pulse.
#include <gtest/gtest.h>

#include <set>

#include "tests/motion/coordinated_bench.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace coordinated_oracle_test {

/// Bresenham's line from zero in up to four axes, one pulse of the longest at a time.
class PulseLine {
 public:
  explicit PulseLine(const Travels& way) : way_(way) {
    for (const std::int64_t one : way) longest_ = std::max(longest_, std::abs(one));
  }
  std::int64_t longest() const { return longest_; }
  const Travels& place() const { return place_; }
  /// Exactly half a pulse, rounded down so far: the next one is equally near.
  bool tie(std::size_t axis) const { return error_[axis] == longest_; }
  void step() {
    for (std::size_t axis = 0; axis < way_.size(); ++axis) {
      const std::int64_t sign = way_[axis] < 0 ? -1 : 1;
      error_[axis] += 2 * std::abs(way_[axis]);
      if (error_[axis] > longest_) error_[axis] -= 2 * longest_, place_[axis] += sign;
    }
  }

 private:
  Travels way_;
  Travels place_{};
  Travels error_{};  // twice the distance behind the line, in parts of a pulse of the longest axis
  std::int64_t longest_ = 0;
};

Point as_point(const Travels& t) {
  return place_of(static_cast<double>(t[0]), static_cast<double>(t[1]), static_cast<double>(t[2]),
                  static_cast<double>(t[3]));
}

Travels random_direction(RandomMoves& random, int axes, std::int64_t size) {
  Travels way{};
  for (int i = 0; i < axes; ++i) {
    const std::int64_t kind = random.between(0, 5);
    way[static_cast<std::size_t>(i)] = kind == 0 ? 0 : kind == 1 ? size : random.between(-size, size);
  }
  way[static_cast<std::size_t>(random.between(0, axes - 1))] = random.between(0, 1) == 0 ? size : -size;
  return way;
}

std::string code(const Travels& way) {
  std::string text = "way {";
  for (const std::int64_t one : way) text += std::to_string(one) + ", ";
  return text + "}";
}

TEST(CoordinatedOracle, AtOnePulseATickALongestAxisLineMatchesBresenham) {
  RandomMoves random(seed());
  SpeedLaw one_a_tick = by_slope(1000, 1000);
  one_a_tick.start_speed_u_s = 1000;
  for (int i = 0; i < random_cases(600); ++i) {
    const Travels way = random_direction(random, 2 + i % 3, random.of_any_size(1, 700));
    Bench bench(one_a_tick);
    bench.add(line(place_of(0, 0), as_point(way), Measure::longest_axis));
    bench.begin();
    bench.step();
    PulseLine drawn(way);
    for (std::int64_t k = 1; k <= drawn.longest(); ++k) {
      drawn.step();
      bench.step();
      for (std::size_t axis = 0; axis < 4; ++axis) {
        const std::int64_t off = bench.axes[axis].travel_pulses - drawn.place()[axis];
        ASSERT_TRUE(off == 0 || (drawn.tie(axis) && off == (way[axis] < 0 ? -1 : 1)))
            << code(way) << " axis " << axis << " step " << k << " off " << off;
      }
    }
    ASSERT_EQ(bench.travels(), way);
  }
}

TEST(CoordinatedOracle, AtAnySpeedEveryPlaceIsWithinHalfAPulseOfTheLine) {
  RandomMoves random(seed() + 1);
  for (int i = 0; i < random_cases(600); ++i) {
    const Travels way = random_direction(random, 2 + i % 3, random.of_any_size(1, 3000));
    const auto measure = random.between(0, 1) == 0 ? Measure::vector : Measure::longest_axis;
    Bench bench(by_slope(static_cast<double>(random.of_any_size(500, 50'000)),
                         static_cast<double>(random.of_any_size(100'000, 10'000'000))));
    bench.add(line(place_of(0, 0), as_point(way), measure));
    bench.begin();
    while (bench.group.engaged && bench.tick < 20'000) {
      bench.step();
      // Some fraction of the path is within half a pulse of every axis at once.
      double min = 0;
      double max = 1;
      for (std::size_t axis = 0; axis < 4; ++axis) {
        const auto place = static_cast<double>(bench.axes[axis].travel_pulses);
        const auto whole = static_cast<double>(way[axis]);
        if (way[axis] == 0) {
          ASSERT_EQ(place, 0) << code(way);
          continue;
        }
        min = std::max(min, std::min((place - 0.5) / whole, (place + 0.5) / whole));
        max = std::min(max, std::max((place - 0.5) / whole, (place + 0.5) / whole));
      }
      ASSERT_LE(min, max + 1e-12) << code(way) << " tick " << bench.tick;
    }
    ASSERT_EQ(bench.travels(), way);
  }
}

using Pixel = std::pair<std::int64_t, std::int64_t>;

/// The circle about zero as the eight-octant algorithm draws it.
std::set<Pixel> drawn_circle(std::int64_t radius) {
  std::set<Pixel> pixels;
  std::int64_t x = radius;
  std::int64_t y = 0;
  std::int64_t error = 1 - radius;
  while (x >= y) {
    for (const Pixel& p : {Pixel{x, y}, Pixel{y, x}}) {
      for (const int sx : {-1, 1}) {
        for (const int sy : {-1, 1}) pixels.insert({sx * p.first, sy * p.second});
      }
    }
    ++y;
    error += error < 0 ? 2 * y + 1 : 2 * (y - --x) + 1;
  }
  return pixels;
}

bool near(const std::set<Pixel>& pixels, const Pixel& pixel) {
  for (std::int64_t dx = -1; dx <= 1; ++dx) {
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      if (pixels.contains({pixel.first + dx, pixel.second + dy})) return true;
    }
  }
  return false;
}

TEST(CoordinatedOracle, ACircleGoesByThePulsesOfTheEightOctants) {
  for (const std::int64_t radius : {1, 2, 3, 5, 10, 29, 100, 257, 1000, 1999}) {
    for (const double turn : {1.0, -1.0}) {
      for (const Measure measure : {Measure::vector, Measure::longest_axis}) {
        // Half a pulse per tick: no pixel is skipped.
        SpeedLaw slow = by_slope(500, 1000);
        slow.start_speed_u_s = 500;
        Bench bench(slow);
        const Point begin = place_of(static_cast<double>(radius), 0);
        bench.add(arc_by_sweep(begin, place_of(0, 0), turn * 2 * std::numbers::pi, place_of(0, 0),
                               {.measure = measure}));
        bench.begin(begin);
        const std::set<Pixel> drawn = drawn_circle(radius);
        std::set<Pixel> visited;
        while (bench.group.engaged && bench.tick < 100'000) {
          bench.step();
          const Pixel pixel{bench.axes[0].travel_pulses + radius, bench.axes[1].travel_pulses};
          visited.insert(pixel);
          // The square of half a pulse around the position touches the circle: exact, in quarters.
          const std::int64_t x = std::abs(2 * pixel.first);
          const std::int64_t y = std::abs(2 * pixel.second);
          const auto square = [](std::int64_t a, std::int64_t b) { return a * a + b * b; };
          ASSERT_LE(square(std::max<std::int64_t>(x - 1, 0), std::max<std::int64_t>(y - 1, 0)),
                    square(2 * radius, 0))
              << radius << " tick " << bench.tick;
          ASSERT_GE(square(x + 1, y + 1), square(2 * radius, 0)) << radius << " tick " << bench.tick;
          ASSERT_TRUE(near(drawn, pixel)) << radius << " tick " << bench.tick;
        }
        for (const Pixel& pixel : drawn) ASSERT_TRUE(near(visited, pixel)) << radius;
        ASSERT_EQ(bench.travels(), (Travels{0, 0, 0, 0}));
      }
    }
  }
}

}  // namespace coordinated_oracle_test
}  // namespace understudy::motion
