// Models, and the settings from which devices are made.
#include "emulator/device/model.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include <set>

#include "emulator/device/device.h"
#include "emulator/device/register_map/access.h"

namespace understudy::emulator {
namespace model_test {

const Model& simple2() { return *find_model(models::all_models(), "simple2-r3"); }

std::string error_of(const DeviceSettings& settings) {
  try {
    make_device(simple2(), settings);
  } catch (const SettingError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(error.setting + ": ")) << error.what();
    return error.what();
  }
  return "";
}

Value value_of(const Device& device, std::string_view name) {
  return read_value(*device.register_bank(), device.register_bank()->find(name).value());
}

TEST(Models, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Model* model : models::all_models()) {
    EXPECT_TRUE(names.insert(model->name).second);
    EXPECT_EQ(find_model(models::all_models(), model->name), model);
    EXPECT_FALSE(model->title.empty());
    EXPECT_TRUE(std::is_sorted(model->firmwares.begin(), model->firmwares.end()));
  }
  EXPECT_EQ(find_model(models::all_models(), "simple2"), nullptr);
  EXPECT_EQ(find_model(models::all_models(), ""), nullptr);
  EXPECT_EQ(find_model(models::all_models(), "SIMPLE2-R3"), nullptr);
}

TEST(Models, AreMadeOnlyWhenAskedFor) {
  static int made = 0;
  const ListedModel listed[] = {{"first",
                                 []() -> const Model& {
                                   ++made;
                                   return simple2();
                                 }},
                                {"second", []() -> const Model& { return simple2(); }}};
  const ModelList models(listed);
  EXPECT_EQ(find_model(models, "third"), nullptr);
  EXPECT_EQ(find_model(models, "second"), &simple2());
  EXPECT_EQ(made, 0);
  EXPECT_EQ(find_model(models, "first"), &simple2());
  EXPECT_EQ(made, 1);
}

TEST(Models, AreListedByTheirOwnNames) {
  for (const ListedModel& listed : models::all_models()) {
    const Model* const model = listed;
    EXPECT_EQ(listed.name(), model->name);
  }
}

TEST(Models, GiveEachRegisterANameOfItsOwn) {
  for (const Model* model : models::all_models()) {
    if (model->registers == nullptr) continue;
    EXPECT_NO_THROW(model->registers->require_distinct_names()) << model->name;
  }
}

TEST(Models, FindEachRegisterByItsName) {
  for (const Model* model : models::all_models()) {
    int count = 0;
    for (const RegisterRow& row : register_rows(*model)) {
      for (int index = 0; index < row.count; ++index, ++count) {
        const auto found =
            model->registers->find(model->registers->unique_name(row, index), model->firmwares.back());
        ASSERT_TRUE(found) << RegisterMap::name_of(row, index);
        EXPECT_EQ(found->place.row, &row);
        EXPECT_EQ(found->place.index, index);
        EXPECT_EQ(found->place.part, Place::Part::whole);
      }
    }
    EXPECT_EQ(count > 0, model->registers != nullptr) << model->name;
  }
}

TEST(Firmware, IsWrittenWithTwoDecimals) {
  const std::vector<std::pair<std::string_view, Firmware>> versions = {
      {"1.52", 152}, {"1.40", 140}, {"0.01", 1}, {"9.99", 999}};
  for (const auto& [text, firmware] : versions) {
    EXPECT_EQ(parse_firmware(text), firmware);
    EXPECT_EQ(version_text(firmware), text);
  }
  for (const char* text : {"", "1", "1.5", "1.520", "152", "v1.52", "1,52", " 1.52", "1.52 ", "-1.5", "a.bc",
                           "1.5x", "12.5", "0.00", "٣.52"}) {
    EXPECT_EQ(parse_firmware(text), 0) << text;
  }
}

TEST(MakeDevice, DefaultsToTheNewestFirmwareAndTheFactorySpeed) {
  const auto device = make_device(simple2(), {});
  EXPECT_EQ(device->firmware(), 152);
  EXPECT_EQ(device->line_settings(0),
            (pty::LineSettings{.baud = 19200, .data_bits = 8, .parity = pty::Parity::even, .stop_bits = 1}));
  EXPECT_EQ(value_of(*device, "Version"), 152);
  EXPECT_EQ(value_of(*device, "HW_Code"), 0xC001);
}

TEST(MakeDevice, RefusesSettingsThatTheModelDoesNotHave) {
  DeviceSettings firmware;
  firmware.firmware = 143;
  EXPECT_EQ(
      error_of(firmware),
      "firmware: '1.43' is unknown for simple2-r3; expected one of 1.39, 1.40, 1.41, 1.42, 1.50, 1.51, 1.52");
  for (const int address : {-1, 16, 247, 255, 1 << 20}) {
    DeviceSettings station;
    station.address = address;
    EXPECT_EQ(error_of(station), "address: " + std::to_string(address) +
                                     " is not a station number of simple2-r3; expected 0 to 15");
  }
  for (const int baud : {1, 9600, 38400, -19200}) {
    DeviceSettings line;
    line.bauds = {baud};
    EXPECT_EQ(error_of(line), "baud: " + std::to_string(baud) +
                                  " is not a speed of simple2-r3; expected one of 19200, 115200");
  }
  DeviceSettings choice;
  choice.choices["stop"] = "softly";
  EXPECT_EQ(error_of(choice),
            "choices: choice 'stop' has no option 'softly'; expected one of at_once|slows_down");
}

TEST(MakeDevice, GivesRegistersTheirValues) {
  DeviceSettings settings;
  settings.set = {{"Aaxis_Speed", 200},
                  {"Aaxis_Pulse", -32000},
                  {"Cord_A", 77},
                  {"Baxis_Pulse_L", 0xFFFF},
                  {"DOUT_ALL.3", 1}};
  const auto device = make_device(simple2(), settings);
  EXPECT_EQ(value_of(*device, "Aaxis_Speed"), 200);
  EXPECT_EQ(value_of(*device, "Aaxis_Pulse"), -32000);
  EXPECT_EQ(value_of(*device, "Cord_A"), 77);
  EXPECT_EQ(value_of(*device, "Baxis_Pulse"), 65535);
  EXPECT_EQ(value_of(*device, "DOUT_3"), 1);
}

TEST(MakeDevice, RefusesRegistersThatCannotBeGivenAValue) {
  const std::vector<std::tuple<std::string, Value, std::string>> cases = {
      {"Aaxis_Sped", 1, "set: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'"},
      {"", 1, "set: no register is called ''"},
      {"HW_Code", 1, "set: HW_Code cannot be written; it is read-only"},
      {"STATUS.4", 1, "set: STATUS.4 cannot be written; it is read-only"},
      {"Aaxis_AccTime", 3001, "set: 3001 is out of range for Aaxis_AccTime; expected 0 to 3000"},
      {"Aaxis_AccTime", -1, "set: -1 is out of range for Aaxis_AccTime; expected 0 to 3000"},
      {"Aaxis_Resoultion", 0, "set: 0 is out of range for Aaxis_Resoultion; expected 1 to 2147483648"},
      {"Aaxis_Pulse", 2147483648,
       "set: 2147483648 is out of range for Aaxis_Pulse; expected -2147483648 to 2147483647"},
      {"MAIN_LINE0_CMD", 65536, "set: 65536 is out of range for MAIN_LINE0_CMD; expected 0 to 255"},
      {"ADC_1V_A", -1, "set: -1 is out of range for ADC_1V_A; expected 0 to 65535"},
      {"CalcREG", 4294967295,
       "set: 4294967295 is out of range for CalcREG; expected -2147483648 to 2147483647"},
  };
  for (const auto& [name, value, message] : cases) {
    DeviceSettings settings;
    settings.set = {{std::string(name), value}};
    EXPECT_TRUE(error_of(settings).starts_with(message)) << error_of(settings);
  }
}

TEST(MakeDevice, RegistersOfNewerFirmwareCannotBeSetInOlderOnes) {
  DeviceSettings settings;
  settings.firmware = 150;
  settings.set = {{"NEW_PWD", 1}};
  EXPECT_TRUE(error_of(settings).starts_with("set: register 'NEW_PWD' exists from firmware 1.51 on"));
  settings.firmware = 151;
  EXPECT_EQ(error_of(settings), "");
}

}  // namespace model_test
}  // namespace understudy::emulator
