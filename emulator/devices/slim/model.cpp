#include "emulator/devices/slim/model.h"

#include <array>
#include <string>
#include <vector>

#include "emulator/devices/slim/device.h"
#include "emulator/text/text_device.h"

namespace understudy::emulator::slim {

namespace {

constexpr std::array<Firmware, 1> kFirmwares{100};  // the manual names none
constexpr std::array<int, 5> kBauds{9600, 19200, 38400, 57600, 115200};

/// Names live as long as the program.
struct Names {
  std::vector<std::string> texts;
  std::vector<TerminalRow> terminals;
  std::vector<std::string> axis_texts;
  std::vector<AxisRow> axes;
};

Names make_names() {
  Names names;
  names.texts.reserve(static_cast<std::size_t>(kModules * kTerminalsOfModule));
  const auto add = [&](int module, TerminalRow::Kind kind, const std::string& name, int highest = 1) {
    // T0 needs no prefix, as in commands.
    names.texts.push_back((module == 0 ? "" : "T" + std::to_string(module)) + name);
    names.terminals.push_back({.kind = kind, .name = names.texts.back(), .lowest = 0, .highest = highest});
  };
  using Kind = TerminalRow::Kind;
  for (int m = 0; m < kModules; ++m) {
    for (int i = 1; i <= kInputs; ++i) add(m, Kind::digital_in, "IN" + std::to_string(i));
    add(m, Kind::digital_in, "HORG");
    add(m, Kind::analog_in, "AIN", kFullAnalog);
    for (int i = 1; i <= lang::kSwitchCount; ++i) add(m, Kind::dip_switch, "SW" + std::to_string(i));
    for (int i = 1; i <= kOutputs; ++i) add(m, Kind::digital_out, "P" + std::to_string(i));
  }
  names.axis_texts.reserve(kModules);
  for (int m = 0; m < kModules; ++m) {
    names.axis_texts.push_back("T" + std::to_string(m));
    names.axes.push_back({.name = names.axis_texts.back(),
                          .home_input = terminal(m, kHorg),
                          .pulses_per_revolution = ModuleSettings{}.pulses_per_revolution});
  }
  return names;
}

std::vector<CommandRow> command_rows() {
  std::vector<CommandRow> rows;
  for (const auto& row : lang::kCommands) rows.push_back({row.command, row.syntax, row.meaning});
  return rows;
}

constexpr std::array<std::string_view, 5> kStateNames{"ST", "MD", "PE", "ERR", "TM"};

constexpr std::array<std::string_view, 4> kGaps{
    "?AC and ?TEMP always show 24 and 25, ?IMX and ?IC 0: nothing electrical is modelled.",
    "The servo's own loop has no error: ?FLE shows 0, and EL and LL are stored without effect.",
    "FT pushes against something that does not give way, and PN44 and TpSYN are stored without effect.",
    "Moves that a real chain would make wrongly, with PR2 or PR3 unequal, are refused instead.",
};

}  // namespace

const Model& model() {
  static const Names names = make_names();
  static const std::vector<CommandRow> commands = command_rows();
  static const Model model{
      .name = "slim",
      .title = "chain of up to 8 integrated servos, ASCII commands on RS232",
      .firmwares = kFirmwares,
      .registers = no_registers(),
      .parameters = {},
      .instructions = {},
      .commands = commands,
      .choices = kChoices,
      .terminals = names.terminals,
      .axes = names.axes,
      .state_registers = kStateNames,
      .gaps = kGaps,
      .text = TextPort{.bauds = kBauds},
      .most_modules = kModules,
      .make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
        return std::make_unique<Slim>(settings);
      },
  };
  return model;
}

}  // namespace understudy::emulator::slim
