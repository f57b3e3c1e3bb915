// Registers by name: in several tables, of axes, fields, reals; their persistence, and the output of a table
// of them.
#include <gtest/gtest.h>

#include "emulator/device/describe/describe.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/register_map/access.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::emulator::workbench {
namespace names_test {

std::unique_ptr<Device> make_workbench() {
  DeviceSettings settings;
  settings.name = "it";
  return make_device(model(), settings);
}

std::optional<NamedPlace> find(std::string_view name) { return model().registers->find(name, 100); }

TEST(Names, StandForOneRegisterOfOneTable) {
  struct Case {
    const char* name;
    Table table;
    std::uint16_t address;
    int bit;
    int width;
  };
  const Case cases[] = {
      {"Speed_Y", Table::holding, 1, -1, 1},        {"holding.Position_Z", Table::holding, 0x14, -1, 1},
      {"input.Position_Z", Table::input, 6, -1, 1}, {"STATE.DRIVING", Table::input, 0, 0, 1},
      {"STATE.WAITING", Table::input, 0, 4, 2},     {"Mode.PROGRAM", Table::holding, 0x30, 4, 4},
      {"Mode.4", Table::holding, 0x30, 4, 1},       {"holding.Mode.HOLD", Table::holding, 0x30, 1, 1},
      {"coil.Output_79", Table::coil, 79, -1, 1},   {"DRIVING_Y", Table::discrete, 32, -1, 1},
      {"Step8301", Table::holding, 0x220, -1, 1},   {"input.0x0014", Table::input, 20, -1, 1},
      {"0x0030.4", Table::holding, 0x30, 4, 1},     {"input.Position_X.31", Table::input, 2, 31, 1},
      {"0x17CF", Table::coil, 0x17CF, -1, 1},       {"input.20", Table::input, 20, -1, 1},
      {"coil.4096", Table::coil, 0x1000, -1, 1},    {"holding.48.4", Table::holding, 0x30, 4, 1},
  };
  for (const Case& c : cases) {
    const auto found = find(c.name);
    ASSERT_TRUE(found) << c.name;
    EXPECT_EQ(found->place.row->table, c.table) << c.name;
    EXPECT_EQ(found->place.address(), c.address) << c.name;
    EXPECT_EQ(found->bit, c.bit) << c.name;
    EXPECT_EQ(found->width, c.width) << c.name;
  }
}

TEST(Names, ThatStandForNoneSayWhy) {
  const std::pair<const char*, const char*> cases[] = {
      {"Position_X",
       "'Position_X' is in several tables; expected one of holding.Position_X, input.Position_X"},
      {"Position_X.3",
       "'Position_X' is in several tables; expected one of holding.Position_X.3, input.Position_X.3"},
      {"coil.Speed_X", "'Speed_X' is not in the table 'coil'; expected holding.Speed_X"},
      {"Mode.RUN", "register 'Mode' has no bit 'RUN'; expected 0 to 15, AUTO, HOLD, PROGRAM"},
      {"Output_3.0", "register 'Output_3' has no bit '0'; expected none: it is a bit itself"},
      {"Speed_W", "no register is called 'Speed_W'; the nearest is 'Speed_X'"},
      {"input.0x0001", "no register is at 0x0001 of the table 'input'"},
      {"coil.200", "no register is at 200 of the table 'coil'"},
      {"coil.20x", "no register is called 'coil.20x'; expected one such as 'Speed_X'"},
      {"coil.65536", "no register is called 'coil.65536'; expected one such as 'Speed_X'"},
      {"20", "no register is called '20'; the nearest is 'D0'"},
      {"0x1001.0", "0x1001 has no bit '0'; expected none: it is a bit itself"},
  };
  for (const auto& [name, wanted] : cases) {
    EXPECT_FALSE(find(name)) << name;
    EXPECT_EQ(model().registers->why_not(name, 100), wanted);
  }
}

TEST(Names, ReadAndWriteBitsFieldsAndReals) {
  const auto device = make_workbench();
  RegisterBank& bank = *device->register_bank();
  const auto write = [&](const char* name, double number) {
    const NamedPlace place = *find(name);
    const auto value = value_of_number(place, number);
    return value ? write_value(bank, place, *value) : Refusal::bad_value;
  };
  const auto read = [&](const char* name) { return number_of(*find(name), read_value(bank, *find(name))); };
  EXPECT_EQ(write("Mode.PROGRAM", 11), Refusal::none);
  EXPECT_EQ(write("Mode.HOLD", 1), Refusal::none);
  EXPECT_EQ(read("Mode"), 0xB2);
  EXPECT_EQ(read("Mode.PROGRAM"), 11);
  EXPECT_EQ(write("Mode.PROGRAM", 16), Refusal::bad_value);
  EXPECT_EQ(write("Gain_Z", 2.25), Refusal::none);
  EXPECT_EQ(read("Gain_Z"), 2.25);
  EXPECT_EQ(read("Gain_Z_H"), 0x4010);
  EXPECT_EQ(write("Gain_Z", 10.5), Refusal::bad_value);
  EXPECT_EQ(write("Gain_Z", 1e300), Refusal::bad_value);
  EXPECT_EQ(write("Speed_X", 2.5), Refusal::bad_value);
  EXPECT_EQ(write("Output_7", 1), Refusal::none);
  EXPECT_EQ(read("Output_7"), 1);
  EXPECT_EQ(write("Output_7", 2), Refusal::bad_value);
  EXPECT_EQ(write("holding.Position_Y", -7), Refusal::none);
  EXPECT_EQ(read("input.Position_Y"), -7);
  EXPECT_EQ(write("input.Position_Y", 1), Refusal::no_register);
  EXPECT_EQ(write("Servo_X", 1), Refusal::no_register);
}

TEST(Views, HaveNoSlotAndAreNotKept) {
  const RegisterMap& map = *model().registers;
  int slots = 0;
  for (const RegisterRow& row : map.rows()) slots += row.is_view ? 0 : row.count;
  EXPECT_EQ(map.slot_count(), slots);
  for (const char* name : {"holding.Position_X", "STATE", "Module_ID", "DRIVING_X", "Command3"}) {
    EXPECT_EQ(find(name)->place.slot, Place::kNoSlot) << name;
  }
  static constexpr RegisterRow kKeptView[] = {input(0, "A", Type::u16).always(1).persists()};
  EXPECT_THROW(RegisterMap(kKeptView, {}), std::logic_error);
}

TEST(Memory, NamesRealsAndRegistersOfSeveralTables) {
  const auto device = make_workbench();
  RegisterBank& bank = *device->register_bank();
  ASSERT_EQ(write_value(bank, *find("Speed_Z"), 77), Refusal::none);
  ASSERT_EQ(write_value(bank, *find("Gain_X"), value_of_real(3.25F)), Refusal::none);
  bank.image()[static_cast<std::size_t>(find("Gain_Y")->place.slot)] = 0x7FC00000;  // not a number
  NvImage image{.model = "workbench", .firmware = "1.00"};
  registers_writer(bank, bank.image())(image);
  EXPECT_EQ(image.reals, (std::vector<std::pair<std::string, double>>{{"Gain_X", 3.25}}));
  EXPECT_EQ(image.registers,
            (std::vector<std::pair<std::string, std::int64_t>>{{"Speed_Z", 77}, {"Gain_Y", 0x7FC00000}}));
  const NvImage again = parse_nv_image(to_json(image));
  EXPECT_EQ(read_registers(bank, again, 100),
            std::vector<std::uint32_t>(bank.image().begin(), bank.image().end()));
  const std::pair<NvImage, const char*> bad[] = {
      {{.model = "workbench", .firmware = {}, .reals = {{"Speed_X", 1.5}}}, "reals: 'Speed_X' cannot hold"},
      {{.model = "workbench", .firmware = {}, .registers = {{"Position_X", 1}}}, "is in several tables"},
      {{.model = "workbench", .firmware = {}, .registers = {{"holding.Position_X", 1}}}, "is not persistent"},
      {{.model = "workbench", .firmware = {}, .reals = {{"Gain_X", 10.5}}},
       "reals: 'Gain_X': 10.5 does not fit; expected 0 to 10"},
      {{.model = "workbench", .firmware = {}, .registers = {{"Speed_X", 4001}}},
       "registers: 'Speed_X': 4001 does not fit; expected 1 to 4000"},
  };
  for (const auto& [wrong, diagnostic] : bad) {
    try {
      read_registers(bank, wrong, 100);
      ADD_FAILURE() << diagnostic;
    } catch (const NvError& error) {
      EXPECT_NE(std::string(error.what()).find(diagnostic), std::string::npos) << error.what();
    }
  }
}

TEST(Describe, ShowsTablesRealsAndFields) {
  const auto sheet = describe(model(), "registers", SheetFormat::csv);
  ASSERT_TRUE(sheet);
  const auto row_of = [&](const std::string& table, const std::string& name) {
    for (const auto& row : sheet->rows) {
      if (row[0] == table && row[2] == name) return row;
    }
    return std::vector<std::string>{};
  };
  using Row = std::vector<std::string>;
  EXPECT_EQ(row_of("holding", "Gain_Y"),
            (Row{"holding", "0x0022", "Gain_Y", "R/W", "32", "1", "0", "10", "", "1", "1.5", "1", ""}));
  EXPECT_EQ(row_of("input", "STATE"), (Row{"input", "0x0000", "STATE", "R", "16", "0", "", "", "", "0", "0",
                                           "0", "0 DRIVING, 4-5 WAITING"}));
  EXPECT_EQ(row_of("discrete", "DRIVING_Z"),
            (Row{"discrete", "0x0030", "DRIVING_Z", "R", "1", "0", "", "", "", "0", "0", "0", ""}));
}

TEST(Map, RefusesRowsThatMakeNoSense) {
  static constexpr BitField kTwice[] = {bits(0, "A", 3), bits(2, "B")};
  static constexpr BitField kBeyond[] = {bits(15, "A", 2)};
  static constexpr std::string_view kTwo[] = {"X", "Y"};
  static constexpr RegisterRow kWrong[] = {
      reg(0, "WordOfCoils", Type::u16, Access::read).always(0),
      coil(0, "WrittenTwice").with_bits(kTwice),
      reg(0, "SharedBit", Type::u16, Access::read_write).with_bits(kTwice),
      reg(0, "BeyondTheWord", Type::u16, Access::read_write).with_bits(kBeyond),
      reg(Table::discrete, 0, "WrittenInput", Type::bit, Access::read_write),
      reg(Table::coil, 0, "WordInCoils", Type::u16, Access::read_write),
      reg(0, "BitInWords", Type::bit, Access::read_write),
      reg(0, "Label_{}", Type::u16, Access::read_write).each(kTwo, 1).times(3, 1, 0),
  };
  for (std::size_t i = 1; i < std::size(kWrong); ++i) {
    EXPECT_THROW(RegisterMap(std::span(kWrong).subspan(i, 1), {}), std::logic_error) << kWrong[i].name;
  }
  EXPECT_NO_THROW(RegisterMap(std::span(kWrong).first(1), {}));
}

}  // namespace names_test
}  // namespace understudy::emulator::workbench
