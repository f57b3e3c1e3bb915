// A queue compared with the library's, and as a part of a state.
#include "base/queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "base/state/difference.h"
#include "base/state/queue_fields.h"
#include "base/state/state_bytes.h"

namespace understudy {
namespace queue_test {

std::vector<std::byte> saved(const auto& value) {
  StateWriter writer;
  writer.write(value);
  return writer.take();
}

TEST(Queue, DoesWhatADequeDoes) {
  std::mt19937_64 random(1);
  Queue<std::uint16_t> queue;
  std::deque<std::uint16_t> expected;
  std::size_t longest = 0;
  for (std::uint16_t step = 0; step < 60'000; ++step) {
    const std::size_t place = expected.empty() ? 0 : random() % expected.size();
    switch (random() % 12) {
      case 0: {
        const std::vector<std::uint16_t> more(random() % 20, step);
        queue.append(more);
        expected.insert(expected.end(), more.begin(), more.end());
        break;
      }
      case 1:
        queue.insert(queue.begin() + static_cast<std::ptrdiff_t>(place), step);
        expected.insert(expected.begin() + static_cast<std::ptrdiff_t>(place), step);
        break;
      case 2:
        queue.pop_front(place);
        expected.erase(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(place));
        break;
      case 3: {
        const auto is_it = [step](std::uint16_t value) { return value % 5 == step % 5; };
        queue.remove_if(is_it);
        std::erase_if(expected, is_it);
        break;
      }
      case 4:
        if (step % 50 == 0) {
          queue.clear();
          expected.clear();
        }
        break;
      default: queue.push_back(step); expected.push_back(step);
    }
    ASSERT_TRUE(std::ranges::equal(queue, expected)) << step;
    ASSERT_TRUE(std::ranges::equal(queue.values(), expected)) << step;
    ASSERT_EQ(queue.size(), expected.size());
    ASSERT_EQ(queue.empty(), expected.empty());
    longest = std::max(longest, expected.size());
    if (expected.empty()) continue;
    ASSERT_EQ(queue.front(), expected.front());
    ASSERT_EQ(queue.back(), expected.back());
    ASSERT_EQ(queue[place % queue.size()], expected[place % expected.size()]);
  }
  EXPECT_GT(longest, 50U);
}

TEST(Queue, StaysSmallHoweverMuchGoesThroughIt) {
  Queue<std::uint8_t> queue;
  for (int i = 0; i < 1'000'000; ++i) {
    queue.push_back(static_cast<std::uint8_t>(i));
    if (queue.size() > 100) queue.pop_front();
  }
  EXPECT_LE(queue.capacity(), 512U);
}

TEST(Queue, IsSavedAsAVectorOfWhatIsInIt) {
  Queue<std::uint16_t> queue;
  for (const std::uint16_t value : {9, 7, 5, 3}) queue.push_back(value);
  queue.pop_front();
  const std::vector<std::byte> bytes = saved(queue);
  EXPECT_EQ(bytes, saved(std::vector<std::uint16_t>{7, 5, 3}));
  Queue<std::uint16_t> other;
  other.push_back(1);
  StateReader reader(bytes);
  reader.read(other);
  EXPECT_TRUE(std::ranges::equal(other, queue));
  EXPECT_EQ(first_difference(other, queue), "");
  other[1] = 6;
  EXPECT_EQ(first_difference(other, queue, "input"), "input[1]: 6 against 5");
  StateReader cut{std::span(bytes).first(6)};
  EXPECT_THROW(cut.read(other), StateError);
}

}  // namespace queue_test
}  // namespace understudy
