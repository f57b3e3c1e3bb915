#include "emulator/models/slim/model.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/text/text_port.h"
#include "emulator/models/slim/command_hazards.h"
#include "emulator/models/slim/device.h"
#include "emulator/models/slim/first_files.h"
#include "emulator/models/slim/language.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/choices.h"
#include "emulator/models/slim/transition_tables.h"
#include "interpreter/slim/availability.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"

namespace understudy::emulator::models::slim {

namespace {

constexpr std::array<Firmware, 1> kFirmwares{100};  // the manual does not mention a version
constexpr std::array<int, 5> kBauds{9600, 19200, 38400, 57600, 115200};
constexpr std::array<PortRow, 1> kPorts{port_of_text(kBauds)};

constexpr SectionRow kSections[] = {
    {"程式/立即", "program, immediate"},
    {"立即", "immediate"},
    {"立即/外部", "immediate, external"},
    {"緩衝區", "buffer"},
};

constexpr ProofRow kProofs[] = {
    {"dialogue", "RS232|OUT|?IN|?ST|?MD|?time"},
    {"permissions", "立即/外部|立即|TAREDO|GETI|程式/立即|緩衝區"},
    {"programs", "G|SET EV|ON EV|PG|JE|addr|PE|PL|TAPZ|CALL"},
    {"stops", "RESET|TASTOP|PZ|CLR BUF|DN|OUTP|P1SET|CS"},
    {"motion", "FT|VM, VJ|JTI|JGF|AVM|?VM|TVA|VM|H|PWM"},
    {"paths", "SAA|SAR|AA|PR4|SPI|PR3|CM|2MA|PR2, PR3"},
    {"modules", "PN50|PN45|TX|PN37|DF|HON|FU|?MT|?AC|?TEMP|?VER"},
    {"numbers", "?ERR|?ERC|R#|?PE|N#|N#, R#|NS, RS|TM"},
};

/// Owns the names in the tables as long as the process runs.
struct Names {
  std::vector<std::string> texts;
  std::vector<TerminalRow> terminals;
  std::vector<std::string> axis_texts;
  std::vector<AxisRow> axes;
};

Names make_names() {
  Names names;
  names.texts.reserve(std::size_t{kModules} * kTerminalsOfModule);
  const auto add = [&](int module, TerminalRow::Kind kind, const std::string& name, int highest = 1) {
    // T0 needs no prefix, as in commands.
    names.texts.push_back((module == 0 ? "" : "T" + std::to_string(module)) + name);
    names.terminals.push_back({.kind = kind, .name = names.texts.back(), .lowest = 0, .highest = highest});
  };
  using Kind = TerminalRow::Kind;
  for (int m = 0; m < kModules; ++m) {
    for (int i = 1; i <= kInputs; ++i) add(m, Kind::digital_in, "IN" + std::to_string(i));
    add(m, Kind::digital_in, "HORG");
    add(m, Kind::analog_number, "AIN", kFullAnalog);
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

/// Texts for the places where a command can be given, indexed by the bits of Place.
constexpr std::array<std::string_view, 8> kWhere{
    "nowhere", "program",          "typed",          "program, typed",
    "running", "program, running", "typed, running", "program, typed, running"};

std::vector<CommandRow> command_rows() {
  std::vector<CommandRow> rows;
  for (std::size_t i = 0; i < lang::kCommands.size(); ++i) {
    const lang::CommandRow& row = lang::kCommands[i];
    const lang::Command command{.verb = row.verb, .row = static_cast<int>(i)};
    std::size_t where = 0;
    for (const lang::Place place : {lang::Place::program, lang::Place::immediate, lang::Place::external}) {
      if (is_allowed(command, place)) where |= std::size_t{1} << static_cast<unsigned>(place);
    }
    rows.push_back({row.command, row.syntax, row.meaning, kWhere[where]});
  }
  return rows;
}

std::vector<NamedParameterRow> parameter_rows() {
  std::vector<NamedParameterRow> rows;
  for (const ParameterDefinition& row : kParameters) {
    const bool is_real = row.type == ParameterDefinition::Type::real;
    rows.push_back({.number = row.name.starts_with('P') ? row.name : "",
                    .name = row.alias.empty() ? row.name : row.alias,
                    .width = is_real || row.highest > 65535 ? 32 : 16,
                    .min = (row.above_lowest ? "> " : "") + text_of_real(row.lowest),
                    .max = is_real ? text_of_real(row.highest) : text_of_integer(row.highest),
                    .unit = row.unit,
                    .factory = text_of_real(row.factory),
                    .meaning = row.meaning,
                    .not_implemented = row.not_implemented});
  }
  return rows;
}

constexpr std::array<std::string_view, 5> kStateNames{"ST", "MD", "PE", "ERR", "TM"};

constexpr std::array<std::string_view, 5> kKnownLimitations{
    ("?AC and ?TEMP always show the same values (24 and 25, or those that a bench has chosen), and ?IMX "
     "and ?IC show 0, because electrical values are not modelled. ?VER and ?MT do not belong to a "
     "particular version."),
    "The servo loop has no following error: ?FLE shows 0, and EL and LL are stored without effect.",
    ("FT pushes against something that does not move. TpSYN and one of PN44 to PN46 are stored "
     "without effect."),
    ("PWM has a resolution of whole milliseconds. Above 500 Hz, the output stays at the prevailing "
     "level."),
    ("If PR2 or PR3 of its modules differ, a real chain would move wrongly; here the move is "
     "refused. If PR3 of one module changes in motion, the path stays the same."),
};

constexpr StopStep kStop[] = {{"TASTOP"}};

}  // namespace

const Model& model() {
  static const Names names = make_names();
  static const std::vector<CommandRow> commands = command_rows();
  static const std::vector<NamedParameterRow> parameters = parameter_rows();
  static const Model model{
      .name = kName,
      .title = "chain of up to 8 integrated servos, ASCII commands on RS232",
      .firmwares = kFirmwares,
      .named_parameters = parameters,
      .language = &language(),
      .commands = commands,
      .choices = kChoices,
      .sections = kSections,
      .proofs = kProofs,
      .transitions = transition_tables(),
      .terminals = names.terminals,
      .axes = names.axes,
      .state_registers = kStateNames,
      .known_limitations = kKnownLimitations,
      .line = line_of_text(kPorts),
      .first_files = &kFirstFiles,
      .stop = kStop,
      .hazards_of_line = hazards_of_line,
      .edit_mark_of_line = edit_mark_of_line,
      .numbers_of_command = numbers_of_command,
      .max_modules = kModules,
      .make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
        return std::make_unique<Slim>(settings);
      },
  };
  return model;
}

}  // namespace understudy::emulator::models::slim
