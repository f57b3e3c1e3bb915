#include "emulator/play/report/envelope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace understudy::emulator::play {

void PrintTo(const Envelope::Point& point, std::ostream* out) { *out << point.tick << ":" << point.value; }

namespace envelope_test {

using Points = std::vector<Envelope::Point>;

TEST(Envelope, HasAllPointsOfAShortSignalButForWhereItStays) {
  Envelope envelope;
  for (const auto& [tick, value] :
       Points{{5, 0}, {6, 0}, {7, 0}, {8, 3}, {9, 7}, {10, 7}, {11, 7}, {12, 7}}) {
    envelope.add(tick, value);
  }
  EXPECT_EQ(envelope.points(), (Points{{5, 0}, {7, 0}, {8, 3}, {9, 7}, {12, 7}}));
  EXPECT_TRUE(envelope.varies());
  EXPECT_EQ(envelope.min(), 0);
  EXPECT_EQ(envelope.max(), 7);
}

TEST(Envelope, LeavesOutWhatComesTooLate) {
  Envelope envelope;
  envelope.add(5, 1);
  envelope.add(5, 2);
  envelope.add(4, 3);
  EXPECT_EQ(envelope.points(), (Points{{5, 1}}));
  EXPECT_FALSE(envelope.varies());
}

TEST(Envelope, KeepsASpikeOfOneTickInAHourAtItsTime) {
  Envelope envelope(100);
  for (Tick tick = 0; tick < 3'600'000; ++tick) envelope.add(tick, tick == 1'234'567 ? -5 : 1);
  const Points points = envelope.points();
  EXPECT_LE(points.size(), 400U);
  EXPECT_NE(std::find(points.begin(), points.end(), Envelope::Point{1'234'567, -5}), points.end());
  EXPECT_EQ(points.front(), (Envelope::Point{0, 1}));
  EXPECT_EQ(points.back(), (Envelope::Point{3'599'999, 1}));
}

/// Compared with the plain definition: the points of each stretch of ticks are real ones, and include its
/// extremes.
TEST(Envelope, HasTheExtremesOfEveryStretch) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const std::size_t max = 1 + random() % 20;
    const Tick origin = random() % 100;
    const Tick count = 1 + random() % 400;
    std::vector<double> values;
    Envelope envelope(max);
    for (Tick i = 0; i < count; ++i) {
      values.push_back(random() % 7 == 0 && i > 0 ? values.back() : static_cast<double>(random() % 1000));
      envelope.add(origin + i, values.back());
    }
    Tick length = 1;  // the smallest power of two that gives few enough stretches
    while ((count + length - 1) / length > static_cast<Tick>(max)) length *= 2;
    const Points points = envelope.points();
    EXPECT_LE(points.size(), 4 * max) << "seed " << seed;
    for (const auto& [tick, value] : points) {
      EXPECT_EQ(value, values[static_cast<std::size_t>(tick - origin)]) << "seed " << seed;
    }
    for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT(points[i - 1].tick, points[i].tick);
    for (Tick begin = 0; begin < count; begin += length) {
      const auto first = values.begin() + begin;
      const auto last = values.begin() + std::min(begin + length, count);
      const auto has = [&](double wanted) {
        // A value that is constant over several stretches has only its first and last points.
        return std::any_of(points.begin(), points.end(), [&](const Envelope::Point& point) {
          return point.value == wanted && point.tick - origin < begin + length;
        });
      };
      EXPECT_TRUE(has(*std::min_element(first, last))) << "seed " << seed << " at " << begin;
      EXPECT_TRUE(has(*std::max_element(first, last))) << "seed " << seed << " at " << begin;
    }
    EXPECT_EQ(points.front().tick, origin);
    EXPECT_EQ(points.back().tick, origin + count - 1);
  }
}

/// A constant value is the same as one that is added again at every tick, however long, and whatever follows.
TEST(Envelope, StaysAsIfItWereAddedAtEveryTick) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const std::size_t max = 1 + random() % 20;
    Envelope stays(max);
    Envelope added(max);
    Tick tick = random() % 100;
    for (int i = 0; i < 12; ++i) {
      const double value = random() % 5;
      stays.add(tick, value);
      added.add(tick, value);
      const Tick last = tick + (random() % 2 == 0 ? random() % 4 : random() % 5000);
      stays.stay(last);
      while (++tick <= last) added.add(tick, value);
      ASSERT_EQ(stays.points(), added.points()) << "seed " << seed;
    }
    EXPECT_EQ(stays.min(), added.min());
    EXPECT_EQ(stays.max(), added.max());
  }
}

TEST(Envelope, StaysForALongTimeInAFewSteps) {
  Envelope envelope(100);
  envelope.add(0, 1);
  envelope.stay(Tick{1} << 50);
  EXPECT_EQ(envelope.points(), (Points{{0, 1}, {Tick{1} << 50, 1}}));
}

}  // namespace envelope_test
}  // namespace understudy::emulator::play
