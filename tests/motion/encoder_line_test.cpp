// The counts of an encoder along the travel, compared with counting pulse by pulse.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "motion/encoder_line.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace encoder_line_test {

EncoderLine any_line(RandomMoves& random) {
  EncoderLine line{.counts = random.between(1, 40),
                   .pulses = random.between(1, 40),
                   .origin = random.between(-50, 50),
                   .mirrored = random.between(0, 1) == 0,
                   .reversed = random.between(0, 1) == 0,
                   .surplus = random.between(-5, 5),
                   .factor = random.between(1, 4),
                   .zero = random.between(-50, 50),
                   .divider = random.between(1, 4),
                   .turned = random.between(0, 1) == 0};
  if (random.between(0, 3) == 0) {
    line.first = random.between(-60, 0);
    line.last = line.first + random.between(0, 80);
  }
  return line;
}

TEST(EncoderLine, StepsUntilACountAreThoseOfAWalk) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(20'000); ++i) {
    const EncoderLine line = any_line(random);
    const std::int64_t travel = random.between(-100, 100);
    const int direction = random.between(0, 1) == 0 ? +1 : -1;
    const std::int64_t count_steps = random.between(1, 30);
    std::optional<std::int64_t> walked;
    constexpr std::int64_t kFar = 6000;  // 30 counts, 40 pulses each, a quarter of them counted
    for (std::int64_t n = 1; n <= kFar && !walked; ++n) {
      const std::int64_t gone = line.at(travel + direction * n) - line.at(travel);
      ASSERT_GE(gone * direction * line.sense(), 0) << i;
      if (std::abs(gone) >= count_steps) walked = n;
    }
    ASSERT_EQ(line.steps_until(travel, direction, count_steps), walked) << i << " " << seed();
  }
}

TEST(EncoderLine, FarAwayItIsTheSameLine) {
  const EncoderLine line{.counts = 3, .pulses = 7, .origin = 11};
  const std::int64_t far = std::int64_t{7} << 50;
  EXPECT_EQ(line.at(11 + far), std::int64_t{3} << 50);
  EXPECT_EQ(line.at(11 - far - 1), -(std::int64_t{3} << 50) - 1);
  EXPECT_EQ(line.steps_until(11, +1, std::int64_t{3} << 50), far);
  EXPECT_EQ(line.steps_until(11, +1, INT64_MAX / 4), std::nullopt);
}

}  // namespace encoder_line_test
}  // namespace understudy::motion
