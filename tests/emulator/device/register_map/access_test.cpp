// Reading and writing values by name: types, halves, bits, ranges, word order.
#include "emulator/device/register_map/access.h"

#include <gtest/gtest.h>

#include "tests/emulator/device/register_map/toy_device.h"

namespace understudy::emulator {
namespace access_test {

constexpr Refusal kOk = Refusal::none;
constexpr Refusal kBad = Refusal::bad_value;
constexpr Refusal kNone = Refusal::no_register;

struct Write {
  std::string_view name;
  Value before;  // of the whole register, passed to its image
  Value value;
  Refusal refusal;
  Value after;  // of the whole register
};

void run(const std::vector<Write>& writes) {
  for (const bool low_word_first : {true, false}) {
    for (const Write& w : writes) {
      Toy toy(kToyRows, {.low_word_first = low_word_first});
      const NamedPlace place = toy.named(w.name);
      const auto slot = static_cast<std::size_t>(place.place.slot);
      toy.device.image()[slot] = static_cast<std::uint32_t>(w.before);
      const std::string which = std::string(w.name) + " = " + std::to_string(w.value) + " after " +
                                std::to_string(w.before) + (low_word_first ? "" : ", high word first");
      PreparedWrite prepared;
      EXPECT_EQ(prepare_value(toy.device, place, w.value, prepared), w.refusal) << which;
      EXPECT_EQ(toy.device.image()[slot], static_cast<std::uint32_t>(w.before))
          << which << ": a check does not write";
      EXPECT_TRUE(toy.device.events.empty()) << which;
      EXPECT_EQ(write_value(toy.device, place, w.value), w.refusal) << which;
      Place whole = place.place;
      whole.part = Place::Part::whole;
      EXPECT_EQ(read_value(toy.device, whole), w.after) << which;
    }
  }
}

TEST(WriteValue, KeepsToTheRangeOfTheRegister) {
  run({
      {"Speed", 5, 1, kOk, 1},
      {"Speed", 5, 3000, kOk, 3000},
      {"Speed", 5, 0, kBad, 5},
      {"Speed", 5, 3001, kBad, 5},
      {"Speed", 5, -1, kBad, 5},
      {"Speed", 5, 65536 + 7, kBad, 5},
      {"Speed", 5, INT64_MAX, kBad, 5},
      {"Speed", 5, INT64_MIN, kBad, 5},
      {"Angle", 0, -1000, kOk, -1000},
      {"Angle", 0, 1000, kOk, 1000},
      {"Angle", 0, -1001, kBad, 0},
      {"Angle", 0, 1001, kBad, 0},
      {"Trim", 0, -32768, kOk, -32768},
      {"Trim", 0, 32767, kOk, 32767},
      {"Trim", 0, -32769, kBad, 0},
      {"Target", 0, -100000, kOk, -100000},
      {"Target", 0, 100000, kOk, 100000},
      {"Target", 0, 100001, kBad, 0},
      {"Target", 0, 4294967295, kBad, 0},
      {"Goal", 0, -7, kOk, -7},
      {"Count", 0, 4294967295, kOk, 4294967295},
      {"Count", 0, 4294967296, kBad, 0},
      {"Count", 0, -1, kBad, 0},
      {"Start", 0, 2, kBad, 0},
      {"State", 0x8421, 0, kNone, 0x8421},
      {"State.0", 0x8421, 0, kNone, 0x8421},
      {"State", 0x8421, 1 << 20, kNone, 0x8421},
  });
}

TEST(WriteValue, ASignedRegisterTakesNoValueAboveItsHighest) {
  run({
      {"Trim", 0, 32768, kBad, 0},
      {"Trim", 0, 65535, kBad, 0},
      {"Angle", 0, 65535, kBad, 0},
      {"Target", 0, 2147483648, kBad, 0},
  });
}

TEST(WriteValue, HalvesAreWrittenAloneAndUnjudged) {
  run({
      {"Target_L", 0x00012345, 0xFFFF, kOk, 0x0001FFFF},
      {"Target_H", 0x00012345, 0x7FFF, kOk, 0x7FFF2345},
      {"Target_H", 0x00002345, 0xFFFF, kOk, -56507},
      {"Goal_L", -1, 0, kOk, -65536},
      {"Count_L", 0x12345678, 0, kOk, 0x12340000},
      {"Count_H", 0x12345678, 0xFFFF, kOk, 0xFFFF5678},
      {"Count_H", 0x12345678, 0x10000, kBad, 0x12345678},
      {"Far1_RegL", 0x12345678, 1, kOk, 0x12340001},
      {"Far3_RegH", 0x12345678, 1, kOk, 0x00015678},
  });
}

TEST(WriteValue, ABitIsOneBit) {
  run({
      {"Speed.4", 5, 1, kOk, 21},
      {"Speed.2", 5, 0, kOk, 1},
      {"Speed.0", 1, 0, kBad, 1},   // 0 would be out of range
      {"Speed.12", 5, 1, kBad, 5},  // and so would 4101
      {"Speed.4", 5, 2, kBad, 5},
      {"Speed.4", 5, -1, kBad, 5},
      {"Angle.1", -3, 1, kOk, -1},
      {"Count.31", 1, 1, kOk, 0x80000001},
      {"Count.31", 0xFFFFFFFF, 0, kOk, 0x7FFFFFFF},
      {"Count_H.15", 1, 1, kOk, 0x80000001},
      {"Target_L.0", 0x10000, 1, kOk, 0x10001},
      {"Far2.0", -2, 1, kOk, -1},
  });
}

TEST(WriteValue, TheSignBitIsABitLikeAnyOther) {
  run({
      {"Far1.31", 0, 1, kOk, INT32_MIN},
      {"Far1.31", -1, 0, kOk, INT32_MAX},
      {"Far1.31", 5, 0, kOk, 5},
      {"Trim.15", 0, 1, kOk, -32768},
      {"Trim.15", -1, 0, kOk, 32767},
      {"Far1_RegH.15", 0, 1, kOk, INT32_MIN},
      {"Far1_RegH.15", -1, 0, kOk, INT32_MAX},
  });
}

TEST(WriteValue, KeepsOnlyTheBitsThatTheRegisterHolds) {
  run({{"Bits", 0, 0xFFFB, kOk, 0x00FB}, {"Bits", 0x12, 0x0100, kOk, 0}, {"Bits.9", 3, 1, kOk, 3}});
}

TEST(WriteValue, WhatIsNotThereForThisFirmwareHasNoPlace) {
  Toy toy(kToyRows, {}, 100);
  EXPECT_FALSE(toy.map.find("New", toy.device.firmware()));
  const Words16 words{1};
  EXPECT_EQ(write_words(toy.device, Table::holding, 0x0040, words), Refusal::no_register);
}

TEST(ReadValue, HasTheTypeOfTheRegister) {
  Toy toy(kToyRows);
  toy.device.image()[static_cast<std::size_t>(toy.named("Angle").place.slot)] = 0xFFFF;
  toy.device.image()[static_cast<std::size_t>(toy.named("Target").place.slot)] = 0xFFFE0001;
  toy.device.image()[static_cast<std::size_t>(toy.named("Count").place.slot)] = 0xFFFE0001;
  EXPECT_EQ(toy.value("Speed"), 5);
  EXPECT_EQ(toy.value("Angle"), -1);
  EXPECT_EQ(toy.value("Angle.15"), 1);
  EXPECT_EQ(toy.value("Target"), -131071);
  EXPECT_EQ(toy.value("Target.31"), 1);
  EXPECT_EQ(toy.value("Target.16"), 0);
  EXPECT_EQ(toy.value("Target_L"), 1);
  EXPECT_EQ(toy.value("Target_H"), 0xFFFE);
  EXPECT_EQ(toy.value("Target_H.0"), 0);
  EXPECT_EQ(toy.value("Count"), 0xFFFE0001);
  EXPECT_EQ(toy.value("State"), 0x8421);
  EXPECT_EQ(toy.value("State.15"), 1);
  EXPECT_EQ(toy.value("State.14"), 0);
}

TEST(ReadWords, FollowsTheOrderOfWordsThatTheDeviceHasNow) {
  Toy toy(kToyRows);
  toy.write("Target", 0x00012345);
  std::vector<std::uint16_t> words(2);
  EXPECT_EQ(read_words(toy.device, Table::holding, 0x0012, words), kOk);
  EXPECT_EQ(words, (Words16{0x2345, 0x0001}));
  toy.device.is_low_word_first = false;
  EXPECT_EQ(read_words(toy.device, Table::holding, 0x0012, words), kOk);
  EXPECT_EQ(words, (Words16{0x0001, 0x2345}));
  EXPECT_EQ(toy.value("Target"), 0x00012345);
  EXPECT_EQ(toy.value("Target_L"), 0x2345);
  EXPECT_EQ(write_words(toy.device, Table::holding, 0x0012, Words16{0xFFFF, 0xFFF0}), kOk);
  EXPECT_EQ(toy.value("Target"), -16);
}

}  // namespace access_test
}  // namespace understudy::emulator
