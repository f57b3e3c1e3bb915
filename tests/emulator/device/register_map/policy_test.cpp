// Requests of several words, effects, and the policies in which models differ.
#include <gtest/gtest.h>

#include "emulator/world/stations/server.h"
#include "tests/emulator/device/register_map/toy_device.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator {
namespace policy_test {

using Events = std::vector<std::string>;

Refusal write(Toy& toy, std::uint16_t first, const world::Words& words) {
  return write_words(toy.device, Table::holding, first, words);
}

std::vector<std::uint32_t> image_of(const Toy& toy) {
  const auto image = toy.device.image();
  return {image.begin(), image.end()};
}

TEST(WriteWords, StoresAllThenAppliesEffectsInAscendingOrder) {
  const RegisterRow rows[] = {
      reg(0x0012, "Late", Type::u16, Access::read_write).does<note>(3),
      reg(0x0010, "Early", Type::u16, Access::read_write).does<note>(1),
      reg(0x0011, "Middle", Type::u16, Access::read_write).does<note>(2),
  };
  Toy toy(rows);
  EXPECT_EQ(write(toy, 0x0010, {10, 20, 30}), Refusal::none);
  EXPECT_EQ(toy.device.events,
            (Events{"1[0]=10 first=30", "2[0]=20 first=30", "3[0]=30 first=30", "written"}));
}

TEST(WriteWords, ATriggerIgnoresAZeroAndAnEffectDoesNot) {
  Toy toy(kToyRows);
  EXPECT_EQ(write(toy, 0x0016, {0}), Refusal::none);
  EXPECT_EQ(toy.device.events, Events{"written"});
  EXPECT_EQ(write(toy, 0x0016, {1}), Refusal::none);
  EXPECT_EQ(write(toy, 0x0024, {0}), Refusal::none);
  EXPECT_EQ(toy.device.events, (Events{"written", "7[0]=1 first=5", "written", "1[1]=0 first=5", "written"}));
}

TEST(WriteWords, AnEffectReceivesTheWholeValueAndWhichHalfCame) {
  Toy toy(kToyRows);
  toy.device.image()[static_cast<std::size_t>(toy.named("Far2").place.slot)] = 0x00020001;
  EXPECT_EQ(write(toy, 0x0025, {7}), Refusal::none);
  EXPECT_EQ(write(toy, 0x0026, {0xFFFF}), Refusal::none);
  EXPECT_EQ(write(toy, 0x0025, {0, 1}), Refusal::none);
  EXPECT_EQ(toy.device.events, (Events{"2[1]=131079 first=5 low", "written", "2[1]=-65529 first=5", "written",
                                       "2[1]=65536 first=5", "written"}));
}

TEST(WriteWords, ARefusedRequestChangesNothingHoweverMuchOfItIsGood) {
  struct Case {
    std::uint16_t first;
    world::Words words;
    Refusal refusal;
  };
  const std::vector<Case> cases = {
      {0x0010, {7, 5, 1, 0, 1, 1, 1, 1}, Refusal::no_register},  // ends on a read-only register
      {0x0010, {0, 5}, Refusal::bad_value},
      {0x0010, {7, 1001}, Refusal::bad_value},
      {0x0010, {7, 1, 0xFFFF, 0xFFF0}, Refusal::bad_value},      // a whole 32-bit value
      {0x0010, {0, 0, 0, 0, 0, 0, 0, 0}, Refusal::no_register},  // addresses are checked before values
      {0x0016, {5, 1}, Refusal::no_register},
      {0x0019, {1, 1, 1}, Refusal::no_register},
      {0x0020, {1, 2, 3, 4}, Refusal::no_register},  // a hole at its end
      {0xFFFF, {1, 2}, Refusal::no_register},
      {0x0018, {1}, Refusal::no_register},
  };
  for (const Case& c : cases) {
    Toy toy(kToyRows);
    const auto before = image_of(toy);
    EXPECT_EQ(write(toy, c.first, c.words), c.refusal) << std::hex << c.first << ", " << c.words.size();
    EXPECT_EQ(image_of(toy), before);
    EXPECT_TRUE(toy.device.events.empty());
  }
}

// More than any frame can carry, with a margin.
TEST(WriteWords, AreAtMost2000) {
  const RegisterRow rows[] = {coil(0, "C{}", Access::read_write).times(2001, 1, 0)};
  Toy toy(rows);
  EXPECT_EQ(write_words(toy.device, Table::coil, 0, world::Words(2001, 1)), Refusal::no_register);
  EXPECT_EQ(toy.device.image().front(), 0U);
  EXPECT_EQ(write_words(toy.device, Table::coil, 0, world::Words(2000, 1)), Refusal::none);
  EXPECT_EQ(toy.device.image()[1999], 1U);
  EXPECT_EQ(toy.device.image()[2000], 0U);
}

TEST(Policy, WhereNothingIsMayReadAsZeroAndSwallowWrites) {
  Toy toy(kToyRows, {.unmapped = MapPolicy::Unmapped::reads_zero});
  EXPECT_EQ(world::read(toy.device, 0x0017, 3), (world::Words{0x8421, 0, 0}));
  EXPECT_EQ(world::read(toy.device, 0x8000, 2), (world::Words{0, 0}));
  EXPECT_EQ(write(toy, 0x0018, {1, 2}), Refusal::none);
  EXPECT_EQ(toy.value("Trim"), 2);
  EXPECT_EQ(write(toy, 0x8000, {1, 2}), Refusal::none);
  EXPECT_EQ(write(toy, 0x0022, {1, 2, 3}), Refusal::none);  // a half, a hole, a cell
  EXPECT_EQ(toy.value("Far1"), 65536);
  EXPECT_EQ(toy.value("Cell2"), 3);
  EXPECT_EQ(world::answer(toy.device, world::read_pdu(3, 0xFFFF, 2)), "83 02")
      << "an address past the last one is not a hole";
  EXPECT_EQ(world::answer(toy.device, world::write_request(0xFFFF, world::Words{1, 2})), "90 02");
}

TEST(Policy, TheLastAddressIsOneLikeOthers) {
  const RegisterRow rows[] = {reg(0xFFFE, "W{}", Type::u16, Access::read_write).times(2, 1, 0),
                              coil(0xFFF6, "C{}").times(10, 1, 0)};
  for (const auto unmapped : {MapPolicy::Unmapped::refused, MapPolicy::Unmapped::reads_zero}) {
    Toy toy(rows, {.unmapped = unmapped});
    EXPECT_EQ(write(toy, 0xFFFE, {5, 6}), Refusal::none);
    EXPECT_EQ(write(toy, 0xFFFF, {7}), Refusal::none);
    EXPECT_EQ(world::read(toy.device, 0xFFFE, 2), (world::Words{5, 7}));
    EXPECT_EQ(write(toy, 0xFFFF, {8, 9}), Refusal::no_register);
    EXPECT_EQ(world::answer(toy.device, world::read_pdu(3, 0xFFFE, 3)), "83 02");
    const world::Words bits{1, 0, 0, 0, 0, 0, 0, 0, 1, 1};
    EXPECT_EQ(write_words(toy.device, Table::coil, 0xFFF6, bits), Refusal::none);
    std::array<std::uint8_t, 2> packed{};
    EXPECT_EQ(read_bits_request(toy.device, Table::coil, 0xFFF6, 10, packed), Objection{});
    EXPECT_EQ(packed, (std::array<std::uint8_t, 2>{0x01, 0x03}));
    EXPECT_EQ(read_bits_request(toy.device, Table::coil, 0xFFF6, 11, packed).cause, Cause::no_register);
  }
}

TEST(Policy, ATableOfBitsMayBeFullFromItsFirstAddressOn) {
  const RegisterRow stored[] = {coil(0, "A{}").times(32768, 1, 0), coil(32768, "B{}").times(32768, 1, 0)};
  const RegisterRow constant[] = {discrete(0, "A{}").always(1).times(32768, 1, 0),
                                  discrete(32768, "B{}").always(1).times(32768, 1, 0)};
  Toy changing(stored);
  EXPECT_EQ(write_words(changing.device, Table::coil, 1, world::Words{1, 0, 1}), Refusal::none);
  Toy standing(constant);
  std::array<std::uint8_t, 1> packed{};
  EXPECT_EQ(read_bits_request(changing.device, Table::coil, 0, 8, packed), Objection{});
  EXPECT_EQ(packed[0], 0x0A);
  for (const std::uint16_t first : {0, 1, 32764, 65528}) {
    EXPECT_EQ(read_bits_request(standing.device, Table::discrete, first, 7, packed), Objection{});
    EXPECT_EQ(packed[0], 0x7F) << first;
  }
}

TEST(Policy, NeighboursThatNeverChangeAreReadAloneAndTogether) {
  const RegisterRow rows[] = {discrete(0, "A{}").always(1).times(3, 1, 0),
                              discrete(3, "B{}").always(0).times(4, 1, 0),
                              discrete(7, "C{}").always(1).times(5, 1, 0), coil(0, "D")};
  Toy toy(rows);
  constexpr int kBits = 0b111110000111;
  for (int first = 0; first < 12; ++first) {
    for (int count = 1; first + count <= 12; ++count) {
      std::array<std::uint8_t, 2> packed{};
      EXPECT_EQ(read_bits_request(toy.device, Table::discrete, static_cast<std::uint16_t>(first),
                                  static_cast<std::size_t>(count), packed),
                Objection{});
      EXPECT_EQ(packed[0] | packed[1] << 8, kBits >> first & ((1 << count) - 1)) << first << ' ' << count;
    }
  }
}

/// Neighbours on the wire are not neighbours in the image then.
TEST(Policy, BitsMayStandInAnotherOrderThanTheirRows) {
  const RegisterRow in_turns[] = {coil(0, "A{}").times(2, 2, 0), coil(1, "B{}").times(2, 2, 0)};
  const RegisterRow backwards[] = {coil(3, "D"), coil(2, "C"), coil(1, "B"), coil(0, "A")};
  for (const std::span<const RegisterRow> rows :
       {std::span<const RegisterRow>(in_turns), std::span<const RegisterRow>(backwards)}) {
    for (int bits = 0; bits < 16; ++bits) {
      Toy toy(rows);
      world::Words each;
      for (int i = 0; i < 4; ++i) each.push_back(static_cast<std::uint16_t>(bits >> i & 1));
      EXPECT_EQ(write_words(toy.device, Table::coil, 0, each), Refusal::none);
      std::array<std::uint8_t, 1> packed{};
      EXPECT_EQ(read_bits_request(toy.device, Table::coil, 0, 4, packed), Objection{});
      EXPECT_EQ(packed[0], bits);
    }
  }
}

TEST(Policy, WhatChangesIsNotTakenForTheConstantBeforeIt) {
  const RegisterRow rows[] = {coil(0, "A", Access::read).always(0), coil(1, "B")};
  Toy toy(rows);
  EXPECT_EQ(write_words(toy.device, Table::coil, 1, world::Words{1}), Refusal::none);
  std::array<std::uint8_t, 1> packed{};
  EXPECT_EQ(read_bits_request(toy.device, Table::coil, 0, 2, packed), Objection{});
  EXPECT_EQ(packed[0], 2);
}

TEST(Policy, WhatCanOnlyBeWrittenMayRefuseToBeRead) {
  Toy open(kToyRows);
  EXPECT_EQ(world::read(open.device, 0x0015, 3), (world::Words{0, 0, 0x8421}));
  Toy strict(kToyRows, {.write_only = MapPolicy::WriteOnly::refused});
  EXPECT_EQ(world::answer(strict.device, world::read_pdu(3, 0x0016, 1)), "83 02");
  EXPECT_EQ(world::answer(strict.device, world::read_pdu(3, 0x0015, 3)), "83 02");
  EXPECT_EQ(world::read(strict.device, 0x0017, 1), world::Words{0x8421});
  EXPECT_EQ(write(strict, 0x0016, {1}), Refusal::none);
}

TEST(Policy, WhatCanOnlyBeReadMayIgnoreWrites) {
  Toy toy(kToyRows, {.read_only = MapPolicy::ReadOnly::ignores_writes});
  EXPECT_EQ(world::answer(toy.device, world::write_request(0x0017, 9)), "06 00 17 00 09");
  EXPECT_EQ(toy.value("State"), 0x8421);
  EXPECT_EQ(write(toy, 0x0016, {1, 9}), Refusal::none);
  EXPECT_EQ(toy.value("State"), 0x8421);
  EXPECT_EQ(toy.device.events, (Events{"written", "7[0]=1 first=5", "written"}));
}

TEST(Policy, A32BitRegisterMayHaveToComeWhole) {
  Toy toy(kToyRows, {.halves = MapPolicy::Halves::come_whole});
  EXPECT_EQ(write(toy, 0x0014, {1}), Refusal::no_register);
  EXPECT_EQ(write(toy, 0x0015, {1}), Refusal::no_register);
  EXPECT_EQ(write(toy, 0x0013, {1, 2, 3}), Refusal::no_register);
  EXPECT_EQ(write(toy, 0x0012, {1, 0, 3}), Refusal::no_register);
  EXPECT_EQ(toy.value("Target"), 0);
  EXPECT_EQ(toy.value("Count"), 0);
  EXPECT_EQ(write(toy, 0x0012, {1, 0, 3, 4}), Refusal::none);
  EXPECT_EQ(toy.value("Target"), 1);
  EXPECT_EQ(toy.value("Count"), 0x40003);
  EXPECT_EQ(toy.write("Count", 77), Refusal::none);
  EXPECT_EQ(toy.write("Count_L", 1), Refusal::no_register);
  EXPECT_EQ(toy.write("Count.0", 0), Refusal::none) << "a bit travels with its whole register";
  EXPECT_EQ(toy.value("Count"), 76);
}

TEST(Policy, ACutRegisterIsRefusedAsThePolicySays) {
  Toy toy(kToyRows, {.halves = MapPolicy::Halves::come_whole,
                     .read_halves = MapPolicy::ReadHalves::come_whole,
                     .cut_pair = Refusal::bad_value});
  EXPECT_EQ(world::answer(toy.device, world::write_request(0x0014, 1)), "86 03");
  EXPECT_EQ(world::answer(toy.device, world::read_pdu(3, 0x0015, 1)), "83 03");
  EXPECT_EQ(world::answer(toy.device, world::read_pdu(3, 0x0018, 1)), "83 02") << "a hole is a hole";
}

/// The reader of a window: refuses as the first word says.
DeviceAnswer received(ToyDevice& toy, Cell, std::span<const std::uint16_t> words) {
  toy.events.push_back("heard");
  return {static_cast<Refusal>(words[0]), 40 + words[0]};
}

TEST(WriteWords, AWindowSaysWhyItRefuses) {
  struct Case {
    Refusal refusal;
    Cause cause;
  };
  constexpr Case kCases[] = {{Refusal::no_register, Cause::bad_message},
                             {Refusal::bad_value, Cause::bad_message},
                             {Refusal::busy, Cause::busy},
                             {Refusal::failure, Cause::failure}};
  const RegisterRow rows[] = {window<received>(0x0030, "W{}", 3)};
  for (const auto& [refusal, cause] : kCases) {
    Toy toy(rows);
    const world::Words words{static_cast<std::uint16_t>(refusal), 1};
    const auto reason = static_cast<std::uint16_t>(40 + words[0]);
    EXPECT_EQ(write_request(toy.device, Table::holding, 0x0030, words),
              (Objection{.refusal = refusal, .cause = cause, .address = 0x0030, .reason = reason}));
    EXPECT_EQ(toy.device.events, Events{"heard"}) << "nothing was written";
  }
  Toy toy(rows);
  EXPECT_EQ(write(toy, 0x0030, {0}), Refusal::none);
  EXPECT_EQ(toy.device.events, (Events{"heard", "written"}));
}

TEST(WriteWords, AWriteMayBeOneMessageWithoutAWindow) {
  Toy toy(kToyRows);
  toy.device.whole_at = 0x0017;  // read-only state, and a hole
  const auto before = image_of(toy);
  EXPECT_EQ(write(toy, 0x0017, {8, 9}), Refusal::none);
  EXPECT_EQ(toy.device.events, (Events{"whole 8 9", "written"}));
  EXPECT_EQ(image_of(toy), before);
  const world::Words refused{0, 9};
  EXPECT_EQ(write_request(toy.device, Table::holding, 0x0017, refused),
            (Objection{.refusal = Refusal::busy, .cause = Cause::busy, .address = 0x0017, .reason = 9}));
  // A different count or place does not match.
  EXPECT_EQ(write(toy, 0x0017, {8}), Refusal::no_register);
  EXPECT_EQ(write(toy, 0x0010, {8, 9}), Refusal::none);
  EXPECT_EQ(toy.device.events, (Events{"whole 8 9", "written", "written"}));
}

TEST(WriteWords, AWholeMessageIsAdmittedFirst) {
  for (const Checked checked : {Checked::addresses, Checked::everything}) {
    Toy toy(kToyRows);
    toy.device.whole_at = 0x0010;
    toy.device.not_admitted = checked;
    const world::Words words{8, 9};
    EXPECT_EQ(write_request(toy.device, Table::holding, 0x0010, words).reason, 7);
    EXPECT_TRUE(toy.device.events.empty());
  }
}

TEST(Policy, TheHighWordMayComeFirst) {
  Toy toy(kToyRows, {.low_word_first = false});
  EXPECT_EQ(write(toy, 0x0012, {0xFFFF, 0xFFFE}), Refusal::none);
  EXPECT_EQ(toy.value("Target"), -2);
  EXPECT_EQ(world::read(toy.device, 0x0012, 1), world::Words{0xFFFF});
  EXPECT_EQ(toy.write("Target_L", 0x1234), Refusal::none);
  EXPECT_EQ(world::read(toy.device, 0x0012, 2), (world::Words{0xFFFF, 0x1234}));
  EXPECT_EQ(toy.write("Target_H", 0), Refusal::none);
  EXPECT_EQ(world::read(toy.device, 0x0012, 2), (world::Words{0, 0x1234}));
  EXPECT_EQ(write(toy, 0x0012, {2, 0}), Refusal::bad_value) << "131072 is beyond 100000";
  // The half in the second word is the low one.
  EXPECT_EQ(write(toy, 0x0022, {9}), Refusal::none);
  EXPECT_EQ(toy.device.events.at(toy.device.events.size() - 2), "2[0]=9 first=5 low");
}

TEST(NotImplemented, IsMentionedOnceForEachRow) {
  const RegisterRow rows[] = {
      reg(0x10, "Gone{}", Type::u16, Access::read_write).times(2, 1, 0).not_modelled("it only stores"),
      reg(0x12, "Fine", Type::u16, Access::read_write),
  };
  Toy toy(rows);
  Events log;
  toy.device.set_log([&](const std::string& line) { log.push_back(line); });
  world::read(toy.device, 0x12, 1);
  EXPECT_TRUE(log.empty());
  write(toy, 0x10, {1, 2});
  world::read(toy.device, 0x10, 2);
  ASSERT_EQ(log.size(), 1u);
  EXPECT_NE(log[0].find("toy"), std::string::npos);
  EXPECT_NE(log[0].find("it only stores"), std::string::npos);
  EXPECT_EQ(world::read(toy.device, 0x10, 2), (world::Words{1, 2}));
}

/// What the controller should report, by word and by bit, and what it does report.
TEST(NotImplemented, IsMentionedToWhoReadsIt) {
  const RegisterRow rows[] = {reg(0x10, "Fine", Type::u16, Access::read),
                              reg(0x11, "Word", Type::u16, Access::read).not_modelled("no word"),
                              reg(0x12, "Pair", Type::u32, Access::read).not_modelled("no pair"),
                              coil(0, "Good", Access::read),
                              coil(1, "Bit", Access::read).always(1).not_modelled("no bit")};
  Toy toy(rows);
  std::string log;
  toy.device.set_log([&](const std::string& line) { log += line + "\n"; });
  EXPECT_EQ(world::read(toy.device, 0x10, 4).size(), 4U);
  std::array<std::uint8_t, 1> packed{};
  EXPECT_EQ(read_bits_request(toy.device, Table::coil, 0, 2, packed), Objection{});
  for (const char* missing : {"no word", "no pair", "no bit"})
    EXPECT_NE(log.find(missing), std::string::npos) << log;
}

TEST(NotImplemented, IsMentionedToWhoReadsItByName) {
  const RegisterRow rows[] = {reg(0x10, "Set", Type::u16, Access::read_write).not_modelled("no use"),
                              reg(0x11, "Told", Type::u16, Access::read).not_modelled("no word")};
  Toy toy(rows);
  std::string log;
  toy.device.set_log([&](const std::string& line) { log += line + "\n"; });
  EXPECT_EQ(toy.value("Set"), 0);
  EXPECT_EQ(log, "") << "the written value is read back";
  EXPECT_EQ(toy.value("Told.3"), 0);
  EXPECT_NE(log.find("no word"), std::string::npos) << log;
}

}  // namespace policy_test
}  // namespace understudy::emulator
