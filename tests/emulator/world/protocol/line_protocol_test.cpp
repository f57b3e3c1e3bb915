// One object knows everything that differs from one protocol to another.
#include "emulator/world/protocol/line_protocol.h"

#include <gtest/gtest.h>

#include "emulator/models/models.h"
#include "tests/emulator/world/stations/echo_box.h"

namespace understudy::emulator::world {
namespace line_protocol_test {

TEST(LineProtocol, IsThatOfItsModelsProtocol) {
  for (const Model* model : models_and_echo_box()) {
    const LineProtocol& protocol = protocol_of(*model);
    EXPECT_EQ(&protocol.protocol(), &model->line.protocol) << model->name;
    EXPECT_EQ(&protocol, model->rtu ? &modbus_protocol() : &text_protocol()) << model->name;
  }
}

TEST(LineProtocol, DiffersInAllThatHostsMeet) {
  EXPECT_NE(modbus_protocol().protocol().name, text_protocol().protocol().name);
  EXPECT_EQ(modbus_protocol().messages(), "Modbus frames");
  EXPECT_EQ(text_protocol().messages(), "lines of text");
  EXPECT_TRUE(modbus_protocol().is_framed_by_silence());
  EXPECT_FALSE(text_protocol().is_framed_by_silence());
  EXPECT_FALSE(modbus_protocol().carries_text());
  EXPECT_TRUE(text_protocol().carries_text());
  EXPECT_FALSE(modbus_protocol().may_be_unasked());
  EXPECT_TRUE(text_protocol().may_be_unasked());
}

TEST(LineProtocol, KnowsARefusalWhereThereIsOne) {
  constexpr std::uint8_t kException[] = {0x01, 0x83, 0x02};
  constexpr std::uint8_t kAnswer[] = {0x01, 0x03, 0x02};
  EXPECT_TRUE(modbus_protocol().is_refusal(kException));
  EXPECT_FALSE(modbus_protocol().is_refusal(kAnswer));
  EXPECT_FALSE(modbus_protocol().is_refusal(std::span(kException).first(1)));
  EXPECT_FALSE(text_protocol().is_refusal(kException));
}

TEST(LineProtocol, IsRefusedWhereTheWorldHasNone) {
  static constexpr Protocol kSmokeSigns{"smoke signs"};
  const Model model{.name = "chief",
                    .title = "",
                    .firmwares = kEchoFirmwares,
                    .choices = {},
                    .terminals = {},
                    .axes = {},
                    .state_registers = {},
                    .known_limitations = {},
                    .line = {.protocol = kSmokeSigns, .ports = kTextPort},
                    .make = nullptr};
  std::string diagnostic;
  try {
    protocol_of(model);
  } catch (const std::logic_error& error) {
    diagnostic = error.what();
  }
  EXPECT_EQ(diagnostic, "chief: no line of a world carries smoke signs");
}

/// It does not use the protocol in which it is addressed.
class Mute final : public Device {
 public:
  using Device::Device;

 protected:
  void write_own_state(StateWriter&) const override {}
  std::function<void()> read_own_state(StateReader&) override {
    return [] {};
  }
  std::string own_difference(StateReader&, StateReader&) const override { return ""; }
};

TEST(LineProtocol, MakesAStationOnlyOfADeviceThatSpeaks) {
  Mute mute(echo_box(), {});
  EXPECT_THROW(text_protocol().make_station(mute, 0, {}), std::logic_error);
  EXPECT_THROW(modbus_protocol().make_station(mute, 0, {}), std::logic_error);
  EchoBox box(echo_box(), {});
  EXPECT_NE(text_protocol().make_station(box, 0, {}), nullptr);
  EXPECT_THROW(modbus_protocol().make_station(box, 0, {}), std::logic_error);
}

}  // namespace line_protocol_test
}  // namespace understudy::emulator::world
