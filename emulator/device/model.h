// A model: a kind of controller, as its maker's manual defines it. All of it is data; what data cannot say is
// in the device that `make` makes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/device/choices.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_map.h"
#include "pty/line_settings.h"  // IWYU pragma: export: rows of models have them

namespace understudy::emulator {

class CommandWindow;
class Device;
class ProgramLanguage;

/// A row of a model's parameter numbers: `count` numbers from `first` on name the registers called
/// `register_name`, counted from its first one.
struct ParameterRow {
  int first = 0;
  int count = 1;
  std::string_view register_name;  // as in the register table, "{}" for the number
  std::string_view letter{};       // before the number, where there is one: "X", of X20
  bool of_each_axis = false;       // the one number names them all: X20 is a register for each axis
  std::string_view meaning{};
};

/// A row of a table of parameters, of a model whose values have no registers.
struct NamedParameterRow {
  std::string_view number;  // "PN10", if the maker counts them
  std::string_view name;    // "VM"
  int width = 32;           // bits
  bool persistent = true;
  std::string least{};
  std::string most{};
  std::string_view unit{};
  std::string factory{};
  std::string_view meaning{};
  std::string_view not_implemented{};  // what is missing, if it is only stored
};

/// A section of a manual that is not in English: a model's rows name it as the manual does, by its title or
/// its number.
struct SectionRow {
  std::string_view name;
  std::string_view in_english;
};

/// A part of a manual whose choices are proved in one file, docs/fidelity/proofs/MODEL/NAME.yaml.
struct ProofRow {
  std::string_view name;
  /// Separated by '|'. A number stands for what is below it as well, as far as no row before this one has it.
  std::string_view sections;
};

/// A row of a model's table of text commands.
struct CommandRow {
  std::string_view command;  // the word that it is known by: "MA"
  std::string_view syntax;   // "MA x"
  std::string_view meaning;
  std::string_view where{};  // it may be given
};

/// A point where the device meets the outside, as its manual names it.
struct TerminalRow {
  enum class Kind : std::uint8_t {
    digital_in,     // 1: conducting
    digital_out,    // 1: conducting
    analog_in,      // millivolts
    analog_number,  // an analog input that the maker counts in no unit
    dip_switch,     // on the housing: 1 is ON
    counted_in,     // a hand wheel, pulses, phases of an encoder: all counts so far, modulo 2^32
    analog_out,     // millivolts
    pulse_out,      // digital; its pulses may be shorter than a tick, and are counted
  } kind;
  std::string_view name;
  std::int32_t lowest = 0;  // levels that it can be given
  std::int32_t highest = 1;
};

constexpr bool is_input(TerminalRow::Kind kind) {
  return kind != TerminalRow::Kind::digital_out && kind != TerminalRow::Kind::analog_out &&
         kind != TerminalRow::Kind::pulse_out;
}
constexpr bool is_analog(TerminalRow::Kind kind) {
  return kind == TerminalRow::Kind::analog_in || kind == TerminalRow::Kind::analog_number ||
         kind == TerminalRow::Kind::analog_out;
}
/// 0 or 1, and nothing between.
constexpr bool has_two_levels(TerminalRow::Kind kind) {
  return !is_analog(kind) && kind != TerminalRow::Kind::counted_in;
}
constexpr bool is_in_millivolts(TerminalRow::Kind kind) {
  return kind == TerminalRow::Kind::analog_in || kind == TerminalRow::Kind::analog_out;
}

/// Neighbours in the table that come in hundreds: digital inputs, or digital outputs. Onlookers show them as
/// one word, the first in bit 0; by their own names they are there as well.
struct TerminalGroup {
  static constexpr int kMax = 32;
  std::string_view name;
  int first = 0;
  int count = 1;
};

/// A motor axis, and the inputs to which the switches of its machine are wired.
struct AxisRow {
  std::string_view name;       // "A": a bench calls its machine DEVICE.A
  int upper_limit_input = -1;  // numbers of terminals
  int lower_limit_input = -1;
  int home_input = -1;
  int alarm_input = -1;  // and of its drive
  int ready_input = -1;
  int servo_output = -1;
  int alarm_clear_output = -1;
  int pulses_per_revolution = 0;  // the factory's, for an encoder on the motor
  int near_home_input = -1;
  int mark_input = -1;
  int index_input = -1;  // of the encoder
};

/// What is spoken on a line: an object for each protocol, beside the facet that speaks it (modbus/, text/).
/// What it means for a line and its hosts is said once, by the world's object for it (world/speech/).
struct Protocol {
  std::string_view name;  // "Modbus", for messages
};

/// The station numbers that a device may have: one, whatever line it is asked on.
struct StationNumbers {
  int lowest = 1;
  int highest = 247;
  std::string_view kept_in{};  // the register that holds it; empty: a bench says it, and it stays
};

/// A serial port, by which a device stands on a line.
struct PortRow {
  enum class Kind : std::uint8_t {
    rs232,  // from one to one: the device is alone on that line
    rs485,
  } kind = Kind::rs485;
  std::string_view name;       // letters, digits, _ and -, as in a bench
  std::span<const int> bauds;  // the speeds it can be set to, the factory's first
  pty::LineSettings settings;  // the rest; `baud` is replaced by the chosen one
};

/// How the model stands on its lines, whatever is spoken there.
struct LineRules {
  const Protocol& protocol;
  std::span<const PortRow> ports;                   // one at least; a bench that names none means the first
  std::optional<StationNumbers> station_numbers{};  // none: it has no number, and is alone on its line
};

/// What a model allows in one request where that is less than the standard does.
struct FunctionLimit {
  std::uint8_t code = 0;
  int most = 0;  // bits or registers
};

/// How the model takes frames of Modbus RTU.
struct RtuRules {
  pty::SimTime end_silence{0};              // its end-of-frame silence; it replies no earlier
  std::span<const std::uint8_t> functions;  // function codes it knows
  std::span<const FunctionLimit> limits{};
};

/// What makes one device of a model.
struct DeviceSettings {
  std::string name;
  Firmware firmware = 0;                           // 0: the model's default
  std::optional<int> address{};                    // its station number; none: 1, or what its memory says
  std::vector<int> bauds{};                        // of its ports; 0, or none: the factory's
  int modules = 0;                                 // of a chain; 0: the model's default
  std::map<std::string, std::string> choices;      // overrides
  std::map<std::string, bool> dip;                 // switches on the housing, by the terminal's name
  std::optional<NvImage> nv;                       // what its memory holds; by default the factory's
  std::string program;                             // text, loaded when it is made
  std::string program_name;                        // the file it is from, for messages
  std::vector<std::pair<std::string, Value>> set;  // registers written when it is made, in this order
  std::vector<std::pair<std::string, double>> assignments{};  // the same for a model without registers
};

/// What `understudy init` writes for whoever begins: a bench, and the steps of a first move on it.
struct FirstFiles {
  std::string_view bench;
  std::string_view steps;
};

struct Model {
  std::string_view name;  // "simple2-r3"
  std::string_view title;
  std::span<const Firmware> firmwares;     // oldest first; the last is the default
  const RegisterMap* registers = nullptr;  // null: it has none
  std::span<const ParameterRow> parameters{};
  std::span<const NamedParameterRow> named_parameters{};
  const CommandWindow* window = nullptr;  // through which commands go that have names; null: there is none
  const ProgramLanguage* language = nullptr;  // of the programs that its devices take; null: they take none
  std::span<const CommandRow> commands{};
  std::span<const ChoiceRow> choices;
  std::span<const SectionRow> sections{};
  std::span<const ProofRow> proofs{};
  bool csv_has_bits = true;  // false: its CSV of registers is older than the names of its bits
  std::span<const TerminalRow> terminals;
  std::span<const TerminalGroup> terminal_groups{};
  std::span<const AxisRow> axes;
  std::span<const std::string_view> state_registers;  // those that show best what it is doing
  std::span<const std::string_view> gaps;  // what is missing beyond single registers, a sentence each
  LineRules line;
  std::optional<RtuRules> rtu{};            // of a model with ModbusStation
  const FirstFiles* first_files = nullptr;  // null: there are none
  int most_modules = 0;                     // the most that one device can consist of; 0: it is not a chain
  /// Of a model that a file describes: that text, with all that belongs to it. ModelFiles::parse() makes the
  /// same model of it.
  std::string_view description{};
  /// Settings are checked by make_device() before it is called.
  std::function<std::unique_ptr<Device>(const DeviceSettings& settings)> make;
};

/// Makes models of files that describe them (docs/import.md). They live as long as this does; a description
/// that it has read before gives the same model again. Both throw FileError. Any thread may call them.
class ModelFiles {
 public:
  virtual ~ModelFiles() = default;
  /// `files` gets what was read.
  virtual const Model& load(const std::string& path, std::vector<FileClaim>& files) = 0;
  /// Of a text that has all in itself; `name` stands for the file in messages.
  virtual const Model& parse(const std::string& text, const std::string& name) = 0;
};

/// A model that a list knows by its name. Its tables are made when somebody asks for it: that takes longer
/// than most commands do.
class ListedModel {
 public:
  constexpr ListedModel(std::string_view name, const Model& (*make)()) : name_(name), make_(make) {}
  ListedModel(const Model* made) : name_(made->name), made_(made) {}  // NOLINT(google-explicit-constructor)

  std::string_view name() const { return name_; }
  operator const Model*() const {  // NOLINT(google-explicit-constructor): in place of the model itself
    return made_ != nullptr ? made_ : &make_();
  }

 private:
  std::string_view name_;
  const Model* made_ = nullptr;
  const Model& (*make_)() = nullptr;
};

/// The models that benches may name, handed down by whoever knows them; and what makes models of files, null
/// where none are read.
struct ModelList : std::span<const ListedModel> {
  using std::span<const ListedModel>::span;
  ModelList(std::span<const ListedModel> listed, ModelFiles* reader)
      : std::span<const ListedModel>(listed), files(reader) {}
  ModelFiles* files = nullptr;
};
/// Null if there is none of that name. Makes no other.
const Model* find_model(ModelList models, std::string_view name);
/// Whether a model is named by its file: "drive.yaml".
bool names_model_file(std::string_view name);

/// The number of a terminal or an axis in its model's table; -1 if there is none of that name.
int find_terminal(const Model& model, std::string_view name);
/// A group by its name, or the one that a terminal begins; null if there is none.
const TerminalGroup* find_group(const Model& model, std::string_view name);
const TerminalGroup* find_group_of(const Model& model, int first_terminal);
int find_axis(const Model& model, std::string_view name);
/// The number of a port in its model's table; nothing if there is none of that name.
std::optional<std::size_t> find_port(const Model& model, std::string_view name);
/// " (RS485)" where the model has several ports, nothing where it has one: behind the name of a device.
std::string port_text(const Model& model, std::size_t port);
/// The rows of its registers; none where it has no registers.
std::span<const RegisterRow> register_rows(const Model& model);
/// A register by its name; none where the model has no registers.
std::optional<NamedPlace> find_register(const Model& model, std::string_view name, Firmware firmware);
/// Why there is none, as one line.
std::string why_no_register(const Model& model, std::string_view name, Firmware firmware);

/// What is wrong with a device's settings: which of them, and what was expected.
struct SettingError : std::runtime_error {
  SettingError(std::string setting_name, const std::string& what_is_wrong)
      : std::runtime_error(setting_name + ": " + what_is_wrong), setting(std::move(setting_name)) {}
  std::string setting;
};

/// Checks the settings against the model, makes the device, gives it its memory, power and program, and the
/// registers of `set` their values; the persistent ones are kept at once. Throws SettingError, NvError,
/// ProgramError. `log` gets what the device has to say, from its settings on.
std::unique_ptr<Device> make_device(const Model& model, const DeviceSettings& given,
                                    std::function<void(const std::string&)> log = {});

/// The settings with the firmware that they mean. Throws SettingError: of what a model says by itself; what
/// its switches and memory say is found when the device is made.
DeviceSettings checked_settings(const Model& model, const DeviceSettings& given);
/// Everything that is wrong with a program for devices made so: what loading it would say. Throws
/// SettingError.
std::vector<ProgramMistake> check_program(const Model& model, std::string_view text,
                                          const DeviceSettings& given);
/// What is odd about one that loads. Throws SettingError.
std::vector<ProgramMistake> program_warnings(const Model& model, std::string_view text,
                                             const DeviceSettings& given);
/// What is wrong with every program for a model that has no language.
ProgramMistake no_program(const Model& model);
/// "1.52" as 152; 0 if it is not a version.
Firmware parse_firmware(std::string_view text);

}  // namespace understudy::emulator
