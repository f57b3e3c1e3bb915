// Every type of motion/state.h is saved, restored and hashed.
#include "motion/state.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "base/state/difference.h"
#include "base/state/state_error.h"
#include "motion/state_fields.h"
#include "tests/motion/state_samples.h"

namespace understudy::motion {
namespace state_test {

template <class T>
class State : public testing::Test {};

using Saved = testing::Types<Axis, Coordinated, ExternalDrive, Follower, PathRun, Profile, PulseDrive,
                             Environment, SyncTable>;
TYPED_TEST_SUITE(State, Saved);

/// Checks that bytes are refused as they should be: by name, and without a change.
template <class T>
bool refuses(T value, std::span<const std::byte> bytes) {
  const T before = value;
  try {
    restore(value, bytes);
  } catch (const BadMotion& refused) {
    return refused.refusal() == Refusal::out_of_range && save(value) == save(before);
  }
  return false;
}

TYPED_TEST(State, WhatIsRestoredIsWhatWasSaved) {
  const auto value = sample_of<TypeParam>();
  std::vector<std::byte> bytes = save(value);
  bytes.push_back(std::byte{7});  // the data that follow in a larger state
  TypeParam restored;
  EXPECT_FALSE(restored == value);
  EXPECT_EQ(restore(restored, bytes), bytes.size() - 1);
  EXPECT_TRUE(restored == value);
  EXPECT_EQ(hash(restored), hash(value));
  bytes.pop_back();
  EXPECT_EQ(save(restored), bytes);
  EXPECT_NE(hash(restored), hash(TypeParam{}));
}

TYPED_TEST(State, InMotionTheRestoredOneContinuesTickByTickAlike) {
  auto value = sample_of<TypeParam>();
  TypeParam restored;
  restore(restored, save(value));
  for (Tick tick = kSampledAt + 1; tick < kSampledAt + 600; ++tick) {
    ASSERT_EQ(go_on(restored, tick), go_on(value, tick)) << tick;
    ASSERT_EQ(hash(restored), hash(value)) << tick;
    if (tick % 97 == 0) {
      TypeParam again;
      restore(again, save(restored));
      restored = again;
    }
  }
  EXPECT_TRUE(restored == value);
}

TYPED_TEST(State, EveryBytesChangeIsRefusedOrChangesTheHash) {
  const auto value = sample_of<TypeParam>();
  const std::vector<std::byte> bytes = save(value);
  std::size_t taken = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned flip : {0x01U, 0x80U}) {
      std::vector<std::byte> changed = bytes;
      changed[i] ^= static_cast<std::byte>(flip);
      changed.insert(changed.end(), 300, std::byte{0});  // an optional may now be present
      TypeParam restored = value;
      try {
        const std::size_t length = restore(restored, changed);
        ++taken;
        ASSERT_NE(hash(restored), hash(value)) << "byte " << i;
        changed.resize(length);
        ASSERT_EQ(save(restored), changed) << "byte " << i;
      } catch (const BadMotion& refused) {
        ASSERT_EQ(refused.refusal(), Refusal::out_of_range) << "byte " << i;
        ASSERT_EQ(hash(restored), hash(value)) << "byte " << i;
      }
    }
  }
  EXPECT_GT(taken, bytes.size() / 2);
}

TYPED_TEST(State, BytesThatEndTooEarlyAreRefused) {
  const auto value = sample_of<TypeParam>();
  const std::vector<std::byte> bytes = save(value);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 400) {
    ASSERT_TRUE(refuses(TypeParam{}, std::span(bytes).first(length))) << length;
  }
  ASSERT_TRUE(refuses(value, std::span(bytes).first(bytes.size() - 1)));
}

TYPED_TEST(State, WhateverIsRestoredCanContinue) {
  // Any bytes at all, and images with a few changed bytes: an accepted state either continues or reports
  // BadMotion.
  RandomMoves random(seed());
  const std::vector<std::byte> image = save(sample_of<TypeParam>());
  int taken = 0;
  for (int i = 0; i < random_cases(2000); ++i) {
    std::vector<std::byte> bytes = image;
    if (i % 4 == 0) {
      for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.between(0, 255));
    } else {
      for (std::int64_t n = random.between(1, 6); n > 0; --n) {
        const auto at =
            static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(bytes.size()) - 1));
        bytes[at] = static_cast<std::byte>(random.between(0, 3) == 0 ? 0xFF : random.between(0, 255));
      }
    }
    bytes.insert(bytes.end(), 300, std::byte{0});
    TypeParam value;
    try {
      restore(value, bytes);
      ++taken;
      for (Tick tick = kSampledAt + 1; tick < kSampledAt + 20; ++tick) go_on(value, tick);
    } catch (const BadMotion&) {
    }
  }
  EXPECT_GT(taken, 10);
}

TEST(PathRunState, ThatStandsByAnOverrideOfNothingIsTakenBack) {
  PathRun run;
  run.set_speed({.top_speed_u_s = 1000, .up = RampLaw::by_slope(1e5), .down = RampLaw::by_slope(1e5)}, 0);
  run.append(line(Point::Zero(), Point(1000, 0, 0, 0)), {}, 0);
  run.start(0);
  run.set_override(0, 5);
  PathRun restored;
  restore(restored, save(run));
  EXPECT_EQ(hash(restored), hash(run));
}

/// Of a run that waits with one path.
std::vector<std::byte> saved_run() {
  PathRun run;
  run.append(line(Point::Zero(), Point(1000, 0, 0, 0)), {}, 0);
  return save(run);
}

/// Returns the first byte of a field in that state.
std::size_t place_of(const std::string& field) {
  static std::map<std::string, std::size_t> known;  // a search reads the whole state once per byte
  if (const auto it = known.find(field); it != known.end()) return it->second;
  const std::vector<std::byte> bytes = saved_run();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::byte> changed = bytes;
    changed[i] ^= std::byte{1};
    StateReader before(bytes);
    StateReader after(changed);
    try {
      if (difference_of_saved<PathRun>(before, after).starts_with(field + ":")) return known[field] = i;
    } catch (const StateError&) {
    }
  }
  throw std::logic_error("no field is called " + field);
}

TEST(PathRunState, WhoseNumbersContradictEachOtherIsRefused) {
  const struct {
    const char* field;
    std::int64_t value;
    bool is_good;
  } cases[] = {{"head", PathRun::kMaxPaths - 1, true},
               {"head", PathRun::kMaxPaths, false},
               {"count", PathRun::kMaxPaths, true},
               {"count", PathRun::kMaxPaths + 1, false},
               {"chain_count", 1, true},
               {"chain_count", 2, false},
               {"begin_tick", Tick{1} << 56, true},
               {"begin_tick", (Tick{1} << 56) + 1, false},
               {"begin_tick", -(Tick{1} << 56), true},
               {"begin_tick", -(Tick{1} << 56) - 1, false}};
  for (const auto& [field, value, is_good] : cases) {
    std::vector<std::byte> bytes = saved_run();
    const std::size_t place = place_of(field);
    for (std::size_t i = 0; i < sizeof value; ++i) bytes[place + i] = static_cast<std::byte>(value >> 8 * i);
    EXPECT_NE(refuses(PathRun{}, bytes), is_good) << field << " " << value;
  }
}

TEST(StateBytes, AreTheSameOnEveryMachine) {
  // Little endian, doubles by their bits, no padding; the hash is FNV-1a of them.
  const ExternalDrive drive{
      .mode = ExternalDrive::Mode::fixed, .pulses = 0x0102030405060708, .minus_high = false, .running = -1};
  const std::vector<std::byte> bytes = save(drive);
  const std::vector<int> expected{2, 8, 7, 6, 5, 4, 3, 2, 1, 1, 0, 0xFF};
  ASSERT_EQ(bytes.size(), expected.size());
  std::uint64_t sum = 14695981039346656037ULL;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << i;
    sum = (sum ^ std::to_integer<std::uint64_t>(bytes[i])) * 1099511628211ULL;
  }
  EXPECT_EQ(hash(drive), sum);
  Profile profile;
  profile.duration_s = 1.0;  // 0x3FF0000000000000
  const std::vector<std::byte> saved = save(profile);
  EXPECT_EQ(std::to_integer<int>(saved[saved.size() - 17]), 0x3F);
  EXPECT_EQ(std::to_integer<int>(saved[saved.size() - 18]), 0xF0);
}

TEST(StateRefusal, WhatATypeCannotHoldIsRefusedByName) {
  // The first byte of an external drive is its mode, then 8 of pulses, then two levels.
  const std::vector<std::byte> image = save(ExternalDrive{});
  const std::pair<std::size_t, int> kBad[]{{0, 4}, {0, 255}, {9, 2}, {10, 255}};
  for (const auto& [at, byte] : kBad) {
    std::vector<std::byte> bytes = image;
    bytes[at] = static_cast<std::byte>(byte);
    EXPECT_TRUE(refuses(ExternalDrive{}, bytes)) << at;
  }
  Profile profile;
  for (const std::int32_t count : {-1, 13, INT32_MAX}) {
    profile.segment_count = count;
    EXPECT_TRUE(refuses(Profile{}, save(profile))) << count;
  }
  Environment environment;
  environment.zone_count = Environment::kMaxZones + 1;
  EXPECT_TRUE(refuses(Environment{}, save(environment)));
  Follower follower;
  follower.denominator = 0;
  EXPECT_TRUE(refuses(Follower{}, save(follower)));
  Axis axis;
  axis.homing.program.phase_count = 1;  // a row whose speed was never set
  EXPECT_TRUE(refuses(Axis{}, save(axis)));
  Coordinated group;
  group.axis_of[0] = -2;
  EXPECT_TRUE(refuses(Coordinated{}, save(group)));
  group.axis_of[0] = group.axis_of[2] = 1;
  EXPECT_TRUE(refuses(Coordinated{}, save(group)));
  group.axis_of[2] = Coordinated::kNone;
  group.axis_of[0] = 0;
  group.scale[0].divider = 0;
  EXPECT_TRUE(refuses(Coordinated{}, save(group)));
}

TEST(State, WhatRegistersAreMadeOfIsSavedByItself) {
  const Counter counter{.range = Counter::Range::ring, .ring_top = 9999, .offset = -5};
  Counter counted;
  EXPECT_EQ(restore(counted, save(counter)), save(counter).size());
  EXPECT_EQ(counted, counter);
  EXPECT_NE(hash(counted), hash(Counter{}));

  const UnitScale scale = UnitScale::of(8, 5);
  UnitScale scaled;
  restore(scaled, save(scale));
  EXPECT_EQ(scaled, scale);

  SpeedLaw law{.top_speed_u_s = 100, .up = RampLaw::by_jerk(5), .down = RampLaw::by_time(2)};
  law.slow_down_at_u = 3;
  SpeedLaw restored;
  restore(restored, save(law));
  EXPECT_EQ(restored, law);

  const Path path = line(Point::Zero(), Point(1, 2, 3, 4));
  Path laid;
  restore(laid, save(path));
  EXPECT_EQ(laid, path);
}

}  // namespace state_test
}  // namespace understudy::motion
