// Facets that a device lacks cannot be requested; facets that its model's tables list exist.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/slim/model.h"
#include "tests/emulator/device/register_map/toy_device.h"

namespace understudy::emulator {
namespace facets_test {

std::unique_ptr<Device> made(const Model& model) {
  DeviceSettings settings;
  settings.name = "one";
  return make_device(model, settings);
}

TEST(Facets, AreThoseThatTheDeviceHas) {
  const auto simple2 = made(models::simple2_r3::model());
  EXPECT_NE(simple2->register_bank(), nullptr);
  EXPECT_NE(simple2->modbus(), nullptr);
  EXPECT_NE(simple2->memory(), nullptr);
  EXPECT_NE(simple2->user_program(), nullptr);
  EXPECT_NE(simple2->axes(), nullptr);
  EXPECT_EQ(simple2->text_protocol(), nullptr);
  EXPECT_EQ(simple2->named_values(), nullptr);

  const auto slim = made(models::slim::model());
  EXPECT_EQ(slim->register_bank(), nullptr);
  EXPECT_EQ(slim->modbus(), nullptr);
  EXPECT_NE(slim->memory(), nullptr);
  EXPECT_NE(slim->user_program(), nullptr);
  EXPECT_NE(slim->axes(), nullptr);
  EXPECT_NE(slim->text_protocol(), nullptr);
  EXPECT_NE(slim->named_values(), nullptr);
}

TEST(Facets, ThatTablesNeedAreDemanded) {
  const Toy toy(kToyRows);
  Model model = toy.model;
  model.make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
    static const Toy other(kToyRows);
    return std::make_unique<ToyDevice>(other.model, settings);
  };
  EXPECT_THROW(made(model), std::logic_error) << "it uses Modbus, but has no such station";
}

TEST(Facets, NoProgramIsTakenWhereThereIsNone) {
  Toy toy(kToyRows);
  EXPECT_EQ(toy.device.user_program(), nullptr);
  try {
    load_program(toy.device, "1");
    FAIL() << "taken";
  } catch (const ProgramError& error) {
    EXPECT_STREQ(error.what(), "toy cannot load a program from a file; expected none");
  }
  EXPECT_EQ(why_no_value(toy.device, "R0"), "toy has no value called 'R0'; there is none");
}

}  // namespace facets_test
}  // namespace understudy::emulator
