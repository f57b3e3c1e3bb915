// The simulated EEPROM: when values are stored, and what a power cut leaves. Ticks are calculated by hand: a
// write after tick n starts in tick n + 1, and is stored at the end of tick n + 1 + its time.
#include "emulator/device/memory/eeprom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <random>

namespace understudy::emulator {
namespace eeprom_test {

using Image = std::vector<std::uint32_t>;

constexpr Tick kWord = 5;
constexpr Tick kPair = 10;
constexpr Tick kErasure = 500;

/// An image and its EEPROM. Slots 0 to 5 are persistent, 6 and 7 are not. The factory value of each is 100 +
/// slot.
struct Memory {
  Memory() : eeprom(image, kIsPersistent) {}

  void write(std::size_t slot, std::uint32_t bits, Tick takes = kWord) {
    image[slot] = bits;
    eeprom.write(slot, bits, takes, now);
  }
  void run_to(Tick tick) {
    while (now < tick) eeprom.step(++now, image);
  }
  Image content() const { return {eeprom.content().begin(), eeprom.content().end()}; }

  static constexpr std::array<bool, 8> kIsPersistent{true, true, true, true, true, true, false, false};
  Image image{100, 101, 102, 103, 104, 105, 106, 107};
  Eeprom eeprom;
  Tick now = 0;
};

TEST(Eeprom, BeginsWithTheFactorysValuesAndAtRest) {
  const Memory memory;
  EXPECT_EQ(memory.content(), (Image{100, 101, 102, 103, 104, 105, 106, 107}));
  EXPECT_FALSE(memory.eeprom.writing());
  EXPECT_EQ(memory.eeprom.next_active_tick(), kNever);
  EXPECT_EQ(memory.eeprom.revision(), 0u);
}

TEST(Eeprom, KeepsAWordFiveTicksAfterTheNextOne) {
  Memory memory;
  memory.run_to(40);
  memory.write(2, 7);
  EXPECT_TRUE(memory.eeprom.writing()) << "from the moment it is written";
  EXPECT_EQ(memory.eeprom.next_active_tick(), 46) << "40 + 1 + 5";
  memory.run_to(45);
  EXPECT_TRUE(memory.eeprom.writing());
  EXPECT_EQ(memory.content()[2], 102u);
  EXPECT_EQ(memory.eeprom.revision(), 0u);
  memory.run_to(46);
  EXPECT_FALSE(memory.eeprom.writing());
  EXPECT_EQ(memory.content()[2], 7u);
  EXPECT_EQ(memory.eeprom.revision(), 1u);
}

TEST(Eeprom, KeepsOneAfterTheOtherInTheOrderTheyWereWritten) {
  Memory memory;
  memory.write(4, 1);
  memory.write(0, 2, kPair);
  memory.write(5, 3);
  // 4 at 0 + 1 + 5 = 6, the pair 0 at 6 + 10 = 16, 5 at 16 + 5 = 21.
  memory.run_to(5);
  EXPECT_EQ(memory.content(), (Image{100, 101, 102, 103, 104, 105, 106, 107}));
  memory.run_to(15);
  EXPECT_EQ(memory.content(), (Image{100, 101, 102, 103, 1, 105, 106, 107}));
  memory.run_to(20);
  EXPECT_EQ(memory.content(), (Image{2, 101, 102, 103, 1, 105, 106, 107}));
  EXPECT_TRUE(memory.eeprom.writing());
  memory.run_to(21);
  EXPECT_EQ(memory.content(), (Image{2, 101, 102, 103, 1, 3, 106, 107}));
  EXPECT_FALSE(memory.eeprom.writing());
}

TEST(Eeprom, WhatIsWrittenLaterWaitsForWhatIsBeingDone) {
  Memory memory;
  memory.write(1, 7);  // done at 6
  memory.run_to(4);
  memory.write(2, 8);  // starts at 6, done at 11
  memory.run_to(10);
  EXPECT_TRUE(memory.eeprom.writing());
  EXPECT_EQ(memory.content()[2], 102u);
  memory.run_to(11);
  EXPECT_EQ(memory.content()[2], 8u);
  EXPECT_FALSE(memory.eeprom.writing());
}

TEST(Eeprom, AValueThatWaitsIsChangedInItsPlace) {
  Memory memory;
  memory.write(1, 7);   // 6
  memory.write(2, 8);   // 11
  memory.write(1, 70);  // its write has not begun either
  memory.run_to(3);
  memory.write(2, 80);
  memory.write(2, 81);
  memory.run_to(6);
  EXPECT_EQ(memory.content()[1], 70u);
  memory.run_to(11);
  EXPECT_EQ(memory.content()[2], 81u);
  EXPECT_FALSE(memory.eeprom.writing()) << "five writes became two";
  EXPECT_EQ(memory.eeprom.revision(), 2u);
}

TEST(Eeprom, AValueThatIsBeingWrittenIsNotTheNextOne) {
  for (const Tick when : {2, 5}) {
    Memory memory;
    memory.write(1, 7);  // begins at 1, done at 6
    memory.run_to(when);
    memory.write(1, 7);  // is being written already
    memory.write(1, 70);
    memory.write(1, 71);
    memory.run_to(6);
    EXPECT_EQ(memory.content()[1], 7u);
    EXPECT_TRUE(memory.eeprom.writing()) << "the next value waits for its turn";
    Memory cut = memory;
    cut.eeprom.lose_power();
    EXPECT_EQ(cut.content()[1], 7u);
    memory.run_to(10);
    EXPECT_EQ(memory.content()[1], 7u);
    memory.run_to(11);
    EXPECT_EQ(memory.content()[1], 71u);
    EXPECT_FALSE(memory.eeprom.writing());
  }
}

TEST(Eeprom, AValueThatIsThereIsNotWrittenAgain) {
  Memory memory;
  memory.write(3, 103);
  EXPECT_FALSE(memory.eeprom.writing());
  memory.write(3, 9);
  memory.run_to(6);
  memory.write(3, 9);
  EXPECT_FALSE(memory.eeprom.writing());
  EXPECT_EQ(memory.eeprom.revision(), 1u);
}

TEST(Eeprom, AWaitingValueThatIsRevertedTakesTimeButNoEffect) {
  Memory memory;
  memory.write(3, 9);
  memory.write(3, 103);
  EXPECT_TRUE(memory.eeprom.writing());
  memory.run_to(6);
  EXPECT_FALSE(memory.eeprom.writing());
  EXPECT_EQ(memory.content()[3], 103u);
  EXPECT_EQ(memory.eeprom.revision(), 0u);
}

TEST(Eeprom, WhatIsNotKeptIsNotWritten) {
  Memory memory;
  memory.write(6, 9);
  memory.write(7, 9);
  EXPECT_FALSE(memory.eeprom.writing());
  memory.eeprom.settle(memory.image);
  EXPECT_EQ(memory.content(), (Image{100, 101, 102, 103, 104, 105, 106, 107}));
}

TEST(Eeprom, APowerCutLosesWhatWaitsAndWhatIsBeingWritten) {
  Memory memory;
  memory.write(0, 1);         // 6
  memory.write(1, 2, kPair);  // 16
  memory.write(2, 3);         // 21
  memory.run_to(15);          // the pair lacks its last tick
  memory.eeprom.lose_power();
  EXPECT_FALSE(memory.eeprom.writing());
  EXPECT_EQ(memory.eeprom.next_active_tick(), kNever);
  memory.run_to(1000);
  EXPECT_EQ(memory.content(), (Image{1, 101, 102, 103, 104, 105, 106, 107}));
  // It can be written again, including what was lost.
  memory.write(1, 2, kPair);
  memory.run_to(1011);
  EXPECT_EQ(memory.content()[1], 2u);
}

TEST(Eeprom, RewritingEverythingIsOneJobInPlaceOfWhatWaits) {
  Memory memory;
  memory.write(0, 1);
  memory.write(1, 2);
  memory.run_to(2);
  memory.image = {0, 0, 0, 0, 0, 105, 0, 0};
  memory.eeprom.rewrite(memory.image, kErasure, memory.now);
  EXPECT_EQ(memory.eeprom.next_active_tick(), 503) << "2 + 1 + 500";
  memory.run_to(502);
  EXPECT_EQ(memory.content(), (Image{100, 101, 102, 103, 104, 105, 106, 107}));
  memory.run_to(503);
  EXPECT_EQ(memory.content(), (Image{0, 0, 0, 0, 0, 105, 106, 107}));
  EXPECT_FALSE(memory.eeprom.writing());
  EXPECT_EQ(memory.eeprom.revision(), 5u) << "each value that changed";
}

TEST(Eeprom, WhatIsWrittenDuringARewriteWaitsBehindIt) {
  Memory memory;
  memory.image = {0, 0, 0, 0, 0, 0, 0, 0};
  memory.eeprom.rewrite(memory.image, kErasure, memory.now);  // 501
  memory.run_to(100);
  memory.write(3, 33);  // 506
  memory.write(4, 44);  // 511
  memory.write(5, 0);   // as the rewrite will leave it
  memory.run_to(501);
  EXPECT_EQ(memory.content(), (Image{0, 0, 0, 0, 0, 0, 106, 107})) << "the erasure whole, and nothing else";
  memory.run_to(506);
  EXPECT_EQ(memory.content(), (Image{0, 0, 0, 33, 0, 0, 106, 107}));
  memory.run_to(510);
  EXPECT_TRUE(memory.eeprom.writing());
  memory.run_to(511);
  EXPECT_EQ(memory.content(), (Image{0, 0, 0, 33, 44, 0, 106, 107}));
  EXPECT_FALSE(memory.eeprom.writing());
}

TEST(Eeprom, WritingTheOldValueDuringARewriteBringsItBack) {
  Memory memory;
  memory.image = {0, 0, 0, 0, 0, 0, 0, 0};
  memory.eeprom.rewrite(memory.image, kErasure, memory.now);
  memory.write(1, 101);  // stored at this moment, but no longer at 501
  memory.run_to(501);
  EXPECT_EQ(memory.content()[1], 0u);
  memory.run_to(506);
  EXPECT_EQ(memory.content()[1], 101u);
}

TEST(Eeprom, APowerCutDuringARewriteLeavesEverythingAsItWas) {
  Memory memory;
  memory.write(0, 1);
  memory.run_to(6);
  memory.image = {0, 0, 0, 0, 0, 0, 0, 0};
  memory.eeprom.rewrite(memory.image, kErasure, memory.now);
  memory.write(2, 22);
  memory.run_to(506);
  memory.eeprom.lose_power();
  EXPECT_EQ(memory.content(), (Image{1, 101, 102, 103, 104, 105, 106, 107}));
  EXPECT_FALSE(memory.eeprom.writing());
}

TEST(Eeprom, SettlingKeepsEverythingAtOnce) {
  Memory memory;
  memory.write(0, 1);
  memory.write(1, 2, kPair);
  memory.eeprom.settle(memory.image);
  EXPECT_FALSE(memory.eeprom.writing());
  EXPECT_EQ(memory.content(), (Image{1, 2, 102, 103, 104, 105, 106, 107}));
  EXPECT_EQ(memory.eeprom.revision(), 2u);
  memory.image[2] = 5;
  memory.eeprom.rewrite(memory.image, kErasure, memory.now);
  memory.write(3, 6);
  memory.eeprom.settle(memory.image);
  EXPECT_EQ(memory.content(), (Image{1, 2, 5, 6, 104, 105, 106, 107}));
  EXPECT_EQ(memory.eeprom.next_active_tick(), kNever);
}

TEST(Eeprom, WhatIsPutFromOutsideIsThereAtOnce) {
  Memory memory;
  memory.eeprom.put(4, 9);
  EXPECT_EQ(memory.content()[4], 9u);
  EXPECT_EQ(memory.eeprom.revision(), 1u);
  memory.eeprom.put(4, 9);
  EXPECT_EQ(memory.eeprom.revision(), 1u);
}

// --- compared with a slow and simple one -----------------------------------------------------------

/// Counts every tick down, and knows the whole result of each job.
class SlowEeprom {
 public:
  explicit SlowEeprom(Image factory) : kept(std::move(factory)) {}

  void write(std::size_t slot, std::uint32_t bits, Tick takes) {
    if (slot >= 6) return;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const bool has_begun = i == 0 && !is_first_;
      if (jobs_[i].slot == slot && !has_begun) {
        jobs_[i].bits = bits;
        return;
      }
    }
    // Its contents when all writes before it are done.
    std::uint32_t before = kept[slot];
    if (!jobs_.empty() && jobs_[0].everything) before = (*jobs_[0].everything)[slot];
    if (!jobs_.empty() && jobs_[0].slot == slot) before = jobs_[0].bits;
    if (before != bits) jobs_.push_back({.slot = slot, .bits = bits, .left = takes});
  }
  void rewrite(const Image& image, Tick takes) { jobs_ = {{.slot = 99, .left = takes, .everything = image}}; }
  void lose_power() { jobs_.clear(); }
  void settle(const Image& image) {
    jobs_.clear();
    std::copy_n(image.begin(), 6, kept.begin());
  }
  /// Runs a tick: jobs that were present before it have one tick less. The first tick is the delay before a
  /// job starts.
  void tick() {
    if (jobs_.empty()) return;
    Job& job = jobs_.front();
    if (is_first_) {
      is_first_ = false;
      return;
    }
    if (--job.left > 0) return;
    if (job.everything) {
      std::copy_n(job.everything->begin(), 6, kept.begin());
    } else {
      kept[job.slot] = job.bits;
    }
    jobs_.pop_front();
  }
  void after_operation(bool was_writing) {
    if (!was_writing && writing()) is_first_ = true;
  }
  void begins_anew() { is_first_ = true; }
  bool writing() const { return !jobs_.empty(); }

  Image kept;

 private:
  struct Job {
    std::size_t slot = 0;
    std::uint32_t bits = 0;
    Tick left = 0;
    std::optional<Image> everything{};
  };
  std::deque<Job> jobs_;
  bool is_first_ = true;
};

TEST(Eeprom, MatchesASlowModelAndNeedsSteppingOnlyWhenDue) {
  constexpr std::uint64_t kSeed = 81'001;
  std::mt19937_64 random(kSeed);
  const auto between = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  int rewrites_interrupted = 0;
  for (int sequence = 0; sequence < 60; ++sequence) {
    Memory memory;                   // stepped in every tick
    Eeprom leaping = memory.eeprom;  // only when it is due
    SlowEeprom slow(memory.image);
    for (int operation = 0; operation < 300; ++operation) {
      const bool was_writing = slow.writing();
      switch (between(0, 40)) {
        case 0:
          for (int i = 0; i < 6; ++i)
            memory.image[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(i % 2);
          rewrites_interrupted += was_writing;
          memory.eeprom.rewrite(memory.image, 40, memory.now);
          leaping.rewrite(memory.image, 40, memory.now);
          slow.rewrite(memory.image, 40);
          slow.begins_anew();
          break;
        case 1:
          memory.eeprom.lose_power();
          leaping.lose_power();
          slow.lose_power();
          std::copy_n(slow.kept.begin(), 6, memory.image.begin());  // as power-up does
          break;
        case 2:
          memory.eeprom.settle(memory.image);
          leaping.settle(memory.image);
          slow.settle(memory.image);
          break;
        default: {
          const auto slot = static_cast<std::size_t>(between(0, 7));
          const auto bits = static_cast<std::uint32_t>(between(0, 3));
          const Tick takes = slot % 2 == 0 ? kPair : kWord;
          memory.write(slot, bits, takes);
          leaping.write(slot, bits, takes, memory.now);
          slow.write(slot, bits, takes);
        }
      }
      slow.after_operation(was_writing);
      for (int ticks = between(0, between(0, 25)); ticks > 0; --ticks) {
        memory.run_to(memory.now + 1);
        if (leaping.next_active_tick() <= memory.now) leaping.step(memory.now, memory.image);
        slow.tick();
        ASSERT_EQ(memory.eeprom.writing(), slow.writing()) << kSeed << " " << sequence << " " << operation;
      }
      ASSERT_TRUE(memory.eeprom == leaping) << kSeed << " " << sequence << " " << operation;
      ASSERT_TRUE(std::equal(slow.kept.begin(), slow.kept.begin() + 6, memory.eeprom.content().begin()))
          << kSeed << " " << sequence << " " << operation;
    }
  }
  EXPECT_GT(rewrites_interrupted, 100);
}

}  // namespace eeprom_test
}  // namespace understudy::emulator
