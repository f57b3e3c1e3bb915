// Invalid rows are refused when a table is built, each with its error; and corner cases of the vocabulary of
// rows.
#include <gtest/gtest.h>

#include <limits>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/row_sense.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::emulator::workbench {
namespace row_sense_test {

constexpr BitField kEmptyName[] = {bits(0, "")};
constexpr BitField kNumberName[] = {bits(3, "4")};
constexpr BitField kOtherNumberName[] = {bits(3, "90")};
constexpr BitField kDottedName[] = {bits(3, "A.B")};
constexpr BitField kSameNames[] = {bits(0, "A"), bits(1, "A")};
constexpr BitField kShared[] = {bits(0, "A", 3), bits(2, "B")};
constexpr BitField kBeyond[] = {bits(15, "A", 2)};
constexpr BitField kReading[] = {bits(0, "A").reads<is_any_driving, Varies::in_ticks>()};
constexpr BitField kPlain[] = {bits(0, "A")};
constexpr std::string_view kTwo[] = {"X", "Y"};

RegisterRow word(std::string_view name = "Word") { return reg(0, name, Type::u16, Access::read_write); }
RegisterRow real() { return reg(0, "Real", Type::f32, Access::read_write); }
RegisterRow command(int words = 5) { return emulator::window<take_command>(0, "Command{}", words); }

struct Case {
  RegisterRow row;
  const char* what;
};

RegisterRow with(RegisterRow row, void (*change)(RegisterRow&)) {
  change(row);
  return row;
}

const Case kCases[] = {
    {reg(Table::coil, 0, "C", Type::u16, Access::read), "is not as wide as its table"},
    {reg(0, "W", Type::bit, Access::read), "is not as wide as its table"},
    {word("W{}").times(0, 1, 0), "has no registers"},
    {word("W{}").times(-1, 1, 0), "has no registers"},
    {coil(0, "C{}").times(40000, 1, 0), "has more than 32,768 registers"},
    {word("W{}").times(2, 0, 0), "has registers that overlap"},
    {reg(0, "P{}", Type::s32, Access::read_write).times(2, 1, 0), "has registers that overlap"},
    {reg(0xFFFF, "P", Type::s32, Access::read_write), "goes beyond address 0xFFFF"},
    {reg(0xFFF0, "W{}", Type::u16, Access::read_write).times(17, 1, 0), "goes beyond address 0xFFFF"},
    {reg(Table::discrete, 0, "D", Type::bit, Access::read_write), "is in a table that hosts cannot write"},
    {reg(Table::input, 0, "I", Type::u16, Access::write), "is in a table that hosts cannot write"},
    {word(""), "is not a valid register name"},
    {word("A.B"), "is not a valid register name"},
    {word("0x10"), "is not a valid register name"},
    {word("input"), "is not a valid register name"},
    {word().also("B.C"), "has an alias that is not a valid register name"},
    {word("W").times(2, 1, 0), "has several registers, but no {} in its name"},
    {word("W{}").each(kTwo, 1).times(3, 1, 0), "has a different number of labels"},
    {word("W{}").each(kTwo, 1, -1), "begins with a different axis, but is not a row for several axes"},
    {word().from_factory(0x10000), "has a factory value that it cannot hold"},
    {word().from_factory(-1), "has a factory value that it cannot hold"},
    {coil(0, "C").from_factory(2), "has a factory value that it cannot hold"},
    {word().range(0, 0x10000), "has a range that it cannot hold"},
    {reg(0, "S", Type::s16, Access::read_write).range(-32769, 0), "has a range that it cannot hold"},
    {word().range(5, 4), "has a range that ends before it begins"},
    {real().real_range(1, -1), "has a range that ends before it begins"},
    {real().real_range(0, std::numeric_limits<float>::quiet_NaN()), "has a range that ends before it begins"},
    {real().holding_bits(0xFF), "is a real, which must be stored whole"},
    {word().holding_bits(0), "stores no bit of what is written"},
    {input(0, "I", Type::u16).always(1).persists(), "is a view, which stores nothing"},
    {input(0, "I", Type::s32).does<set_position>(), "is read-only, but has an effect"},
    {reg(0, "R", Type::u16, Access::read).missing_trigger("x"), "is read-only, but has an effect"},
    {reg(0, "W", Type::u16, Access::write).reads<last_cause, Varies::in_ticks>(),
     "is write-only, but has a reader"},
    {word().shows<last_cause, Varies::in_ticks>(),
     "is a view that can be written, but nothing handles the write"},
    {word().always(1), "is a view that can be written, but nothing handles the write"},
    {with(command(), [](RegisterRow& row) { row.min_words = 6; }), "is not a window of words"},
    {with(command(), [](RegisterRow& row) { row.min_words = 0; }), "is not a window of words"},
    {with(command(), [](RegisterRow& row) { row.stride = 2; }), "is not a window of words"},
    {with(command(), [](RegisterRow& row) { row.access = Access::read_write; }),
     "is a window, which accepts only messages"},
    {command().does<set_position>(), "is a window, which accepts only messages"},
    {command().range(0, 5), "is a window, whose words are checked by its message"},
    {coil(0, "C").with_bits(kPlain), "has fields, but no bits for them"},
    {real().with_bits(kPlain), "has fields, but no bits for them"},
    {word().with_bits(kBeyond), "has a field outside its bits"},
    {word().with_bits(kShared), "has two fields that share a bit"},
    {word().with_bits(kEmptyName), "has a field with an invalid name"},
    {word().with_bits(kNumberName), "has a field with an invalid name"},
    {word().with_bits(kOtherNumberName), "has a field with an invalid name"},
    {word().with_bits(kDottedName), "has a field with an invalid name"},
    {word().with_bits(kSameNames), "has two fields with the same name"},
    {word().reads<last_cause, Varies::in_ticks>().with_bits(kReading),
     "has a reader, and a field with a different reader"},
};

TEST(RowSense, WhatCannotBeIsRefusedInWords) {
  for (const Case& c : kCases) {
    try {
      const RegisterMap map(std::span(&c.row, 1), {});
      ADD_FAILURE() << c.what << " is taken";
    } catch (const std::logic_error& error) {
      EXPECT_EQ(error.what(), "register map: " + std::string(c.row.name) + " " + c.what);
    }
  }
}

TEST(RowSense, TheOrderOfWordsIsInAHoldingRegister) {
  const RegisterRow rows[] = {coil(0, "Order"), reg(0, "Words", Type::u16, Access::read_write)};
  EXPECT_NO_THROW(RegisterMap(rows, {.word_order_in = "Words"}));
  for (const char* name : {"Order", "Word"}) {
    try {
      const RegisterMap map(rows, {.word_order_in = name});
      ADD_FAILURE() << name << " is taken";
    } catch (const std::logic_error& error) {
      EXPECT_EQ(error.what(), "register map: " + std::string(name) +
                                  " holds the word order, but is not a holding register");
    }
  }
}

TEST(RowSense, WhatIsAtTheEdgeIsTaken) {
  const RegisterRow rows[] = {
      coil(0, "C{}").times(32768, 2, 0),
      reg(0xFFFE, "P", Type::s32, Access::read_write).range(INT32_MIN, INT32_MAX).from_factory(INT32_MIN),
      reg(0, "U", Type::u32, Access::read_write).from_factory(UINT32_MAX),
      reg(2, "Axis_{}", Type::u16, Access::read_write).each(kTwo, 1, 2),
      word("Logic Position 3").holding_bits(1),
      command().also("Code"),
      with(command(), [](RegisterRow& row) { row.min_words = 5; }),  // all of it, and no less
      word().range(7, 7).from_factory(7),
  };
  for (const RegisterRow& row : rows) EXPECT_NO_THROW(RegisterMap(std::span(&row, 1), {})) << row.name;
}

Value axis_and_index(const Workbench&, Cell cell) { return 10 * cell.axis + cell.index; }

TEST(Also, ANameForOneIsThatOfTheFirst) {
  const RegisterRow row = command().also("Code");
  const RegisterMap map(std::span(&row, 1), {});
  const auto place = map.find("Code", 100);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->place.index, 0);
  EXPECT_EQ(map.find("Command0", 100)->place.address(), place->place.address());
}

TEST(Each, CountsAxesAsTheDeviceDoes) {
  static constexpr std::string_view kZU[] = {"Z", "U"};
  static const RegisterRow kRowsOfAxes[] = {
      reg(0, "All_{}", Type::u16, Access::read).each(kAxes, 1).shows<axis_and_index, Varies::in_ticks>(),
      reg(8, "Last_{}", Type::u16, Access::read).each(kZU, 1, 2).shows<axis_and_index, Varies::in_ticks>()};
  static const RegisterMap map(kRowsOfAxes, {});
  struct Plain final : RegisterBankOf<Workbench> {
    Plain(Workbench& bench, const RegisterMap& of) : RegisterBankOf(bench, of, 100) {}
    std::span<std::uint32_t> image() override { return {}; }
    std::span<const std::uint32_t> image() const override { return {}; }
    void register_written(const RegisterRow&, std::size_t) override {}
    void warn_not_implemented(const RegisterRow&) const override {}
  };
  DeviceSettings settings;
  settings.name = "it";
  Workbench bench(model(), settings);
  Plain bank(bench, map);
  const auto value = [&](const char* name) { return read_value(bank, *bank.find(name)); };
  EXPECT_EQ(value("All_X"), 0);
  EXPECT_EQ(value("All_Z"), 22);
  EXPECT_EQ(value("Last_Z"), 20);
  EXPECT_EQ(value("Last_U"), 31);
}

TEST(Firmware, ARowThatItLacksIsAHoleToWritesOfAllKinds) {
  static const RegisterRow kNew[] = {
      reg(0, "Old", Type::u16, Access::read_write),
      reg(1, "New", Type::u16, Access::read_write).since_firmware(200),
      reg(2, "Pair", Type::s32, Access::read_write).since_firmware(200),
      reg(8, "Last", Type::u16, Access::read_write),
  };
  using Unmapped = MapPolicy::Unmapped;
  for (const auto& [unmapped, wanted] : {std::pair(Unmapped::refused, Refusal::no_register),
                                         std::pair(Unmapped::holes_read_zero, Refusal::no_register),
                                         std::pair(Unmapped::reads_zero, Refusal::none)}) {
    const RegisterMap map(kNew, {.unmapped = unmapped});
    struct Bank final : RegisterBank {
      explicit Bank(const RegisterMap& of) : RegisterBank(of, 100) {}
      std::span<std::uint32_t> image() override { return stored; }
      std::span<const std::uint32_t> image() const override { return stored; }
      void register_written(const RegisterRow&, std::size_t) override {}
      void warn_not_implemented(const RegisterRow&) const override {}
      std::array<std::uint32_t, 4> stored{};
    };
    Bank bank(map);
    for (const char* name : {"New", "New.3", "Pair", "Pair_H", "Pair_L.2"}) {
      const auto place = map.find(name, 200);  // as a program knows it that was written for that firmware
      ASSERT_TRUE(place) << name;
      EXPECT_EQ(write_value(bank, *place, 1), wanted) << name;
      PreparedWrite write;
      EXPECT_EQ(prepare_value(bank, *place, 1, write), wanted) << name;
    }
    const std::array<std::uint16_t, 1> one{1};
    EXPECT_EQ(write_words(bank, Table::holding, 1, one), wanted);
    EXPECT_EQ(bank.stored, (std::array<std::uint32_t, 4>{}));
    EXPECT_EQ(write_value(bank, *map.find("Last", 100), 7), Refusal::none);
    EXPECT_EQ(bank.stored[3], 7U);
  }
}

TEST(Values, ARealIsTheNumberThatWasWritten) {
  const auto place = model().registers->find("Gain_X", 100);
  ASSERT_TRUE(place);
  for (const double number : {0.1, 1.5, 321.65, -1e-7, 3.4e38, 16777216.0, 0.0}) {
    const auto value = value_of_number(*place, number);
    ASSERT_TRUE(value) << number;
    EXPECT_EQ(number_of(*place, *value), number);
  }
  EXPECT_FALSE(value_of_number(*place, 3.5e38));
}

}  // namespace row_sense_test
}  // namespace understudy::emulator::workbench
