// A device with its own register map, to test register maps without a real model.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator {

using Words16 = std::vector<std::uint16_t>;

inline void PrintTo(Refusal refusal, std::ostream* out) {
  constexpr const char* kNames[] = {"none", "no_register", "bad_value", "busy", "failure"};
  *out << kNames[static_cast<std::size_t>(refusal)];
}

inline constexpr std::uint8_t kToyFunctions[] = {0x03, 0x04, 0x06, 0x10};
inline constexpr int kToyBauds[] = {9600};
inline constexpr PortRow kToyPorts[] = {{.name = "PORT", .bauds = kToyBauds, .settings = {}}};
inline constexpr Firmware kToyFirmwares[] = {100, 200};

class ToyDevice final : public DeviceOf<ToyDevice>, public RegisterBankOf<ToyDevice> {
 public:
  ToyDevice(const Model& model, const DeviceSettings& settings)
      : DeviceOf(model, settings), RegisterBankOf(*this, *model.registers, settings.firmware) {
    for (const RegisterRow& row : model.registers->rows()) {
      for (int i = 0; i < row.count; ++i) image_.push_back(static_cast<std::uint32_t>(row.factory));
    }
  }
  std::span<std::uint32_t> image() override { return image_; }
  std::span<const std::uint32_t> image() const override { return image_; }
  bool low_word_first() const override { return is_low_word_first; }
  void register_written(const RegisterRow&, std::size_t) override {}
  void registers_written() override { events.push_back("written"); }
  void warn_not_implemented(const RegisterRow& row) const override {
    Device::warn_not_implemented(row.name, row.not_implemented);
  }
  bool takes_whole(const RegisterRequest& request) const override {
    return request.count == 2 && request.first == whole_at;
  }
  DeviceAnswer take_whole(const RegisterRequest& request) override {
    if (request.words[0] == 0) return {Refusal::busy, 9};
    events.push_back("whole " + std::to_string(request.words[0]) + " " + std::to_string(request.words[1]));
    return Refusal::none;
  }
  DeviceAnswer admits(const RegisterRequest& /*request*/, Checked checked) const override {
    return checked == not_admitted ? DeviceAnswer{Refusal::failure, 7} : DeviceAnswer{Refusal::none};
  }

  int whole_at = -1;  // two words from this address on form one message
  std::optional<Checked> not_admitted;
  bool is_low_word_first = true;
  std::vector<std::string> events;  // effects in the order in which they occurred

 protected:
  void write_own_state(StateWriter&) const override {}
  std::function<void()> read_own_state(StateReader&) override {
    return [] {};
  }
  std::string own_difference(StateReader&, StateReader&) const override { return ""; }

 private:
  std::vector<std::uint32_t> image_;
};

/// An effect: records its argument, the index, the value, the present content of the device's first register,
/// and whether only the low half was written.
inline void note(ToyDevice& toy, Cell cell, Value value) {
  toy.events.push_back(std::to_string(cell.argument) + "[" + std::to_string(cell.index) +
                       "]=" + std::to_string(value) + " first=" + std::to_string(toy.image()[0]) +
                       (cell.high_half ? "" : " low"));
}

/// A map with its model and one device.
struct Toy {
  explicit Toy(std::span<const RegisterRow> rows, MapPolicy policy = {}, Firmware firmware = 200)
      : map(rows, policy),
        model{.name = "toy",
              .title = "",
              .firmwares = kToyFirmwares,
              .registers = &map,
              .parameters = {},
              .choices = {},
              .terminals = {},
              .axes = {},
              .state_registers = {},
              .known_limitations = {},
              .line = {.protocol = kModbusRtu, .ports = kToyPorts},
              .rtu = RtuRules{.functions = kToyFunctions},
              .make = nullptr},
        device(model, settings(firmware)) {
    device.is_low_word_first = policy.low_word_first;
  }

  static DeviceSettings settings(Firmware firmware) {
    DeviceSettings made;
    made.name = "toy";
    made.firmware = firmware;
    return made;
  }

  NamedPlace named(std::string_view name) const {
    const auto found = map.find(name, device.firmware());
    if (!found) throw std::out_of_range(std::string(name));
    return *found;
  }
  Value value(std::string_view name) const { return read_value(*device.register_bank(), named(name)); }
  Refusal write(std::string_view name, Value value) {
    return write_value(*device.register_bank(), named(name), value);
  }

  RegisterMap map;
  Model model;
  ToyDevice device;
};

// Fourteen words from 0x0010, with holes at 0x0018 and 0x001B.
inline constexpr RegisterRow kToyRows[] = {
    reg(0x0010, "Speed", Type::u16, Access::read_write).range(1, 3000).from_factory(5),
    reg(0x0011, "Angle", Type::s16, Access::read_write).range(-1000, 1000),
    reg(0x0012, "Target", Type::s32, Access::read_write).range(-100000, 100000).also("Goal"),
    reg(0x0014, "Count", Type::u32, Access::read_write),
    reg(0x0016, "Start", Type::u16, Access::write).range(0, 1).triggers<note>(7),
    reg(0x0017, "State", Type::u16, Access::read).from_factory(0x8421),
    reg(0x0019, "Trim", Type::s16, Access::read_write),
    reg(0x001A, "Bits", Type::u16, Access::read_write).holding_bits(0x00FF),
    reg(0x0020, "Cell{}", Type::u16, Access::read_write).times(3, 4, 1).does<note>(1),
    reg(0x0021, "Far{}", Type::s32, Access::read_write).times(3, 4, 1).halves("_RegL", "_RegH").does<note>(2),
    reg(0x0040, "New", Type::u16, Access::read_write).since_firmware(200),
};

}  // namespace understudy::emulator
