// A model is a kind of controller, as the maker's manual defines it. All of it is data, except the device
// class that `make` creates.
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

#include "base/choices.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/hazards.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/transition_table.h"
#include "pty/line_settings.h"  // IWYU pragma: export: rows of models contain them

namespace understudy::emulator {

class CommandWindow;
class Device;
class ProgramLanguage;

/// A row of a model's parameter numbers: the `count` numbers from `first` on belong to the registers with the
/// name `register_name`, beginning with the first such register.
struct ParameterRow {
  int first = 0;
  int count = 1;
  std::string_view register_name;  // as in the register table, "{}" for the number
  std::string_view letter{};       // the letter before the number, if any: "X" in X20
  bool of_each_axis = false;       // a number refers to all axes: X20 is one register per axis
};

/// A row of a parameter table, for a model whose parameters are not registers.
struct NamedParameterRow {
  std::string_view number;  // "PN10", if the maker numbers them
  std::string_view name;    // "VM"
  int width = 32;           // the width in bits
  bool persistent = true;
  std::string min{};
  std::string max{};
  std::string_view unit{};
  std::string factory{};
  std::string_view meaning{};
  std::string_view not_implemented{};  // if the parameter is only stored, what is missing
};

/// A section of a manual that is not in English. A model's rows refer to it as the manual does, by title or
/// number.
struct SectionRow {
  std::string_view name;
  std::string_view in_english;
};

/// A part of a manual whose choices are proved by one file, docs/fidelity/proofs/MODEL/NAME.yaml.
struct ProofRow {
  std::string_view name;
  /// The sections, separated by '|'. A number includes its subsections, except those in an earlier row.
  std::string_view sections;
};

/// A row of a model's table of text commands.
struct CommandRow {
  std::string_view command;  // the word that identifies it: "MA"
  std::string_view syntax;   // "MA x"
  std::string_view meaning;
  std::string_view where{};  // where it can be used
};

/// A connection of the device to the outside, named as in its manual.
struct TerminalRow {
  enum class Kind : std::uint8_t {
    digital_in,     // 1: conducting
    digital_out,    // 1: conducting
    analog_in,      // millivolts
    analog_number,  // an analog input whose values have no unit in the manual
    dip_switch,     // on the housing: 1 is ON
    counted_in,     // a hand wheel, pulses or encoder phases: the total count so far, modulo 2^32
    analog_out,     // millivolts
    pulse_out,      // digital; its pulses are counted, because they may be shorter than a tick
  } kind;
  std::string_view name;
  std::int32_t lowest = 0;  // the range of the levels
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
/// Returns true if the level is always 0 or 1.
constexpr bool has_two_levels(TerminalRow::Kind kind) {
  return !is_analog(kind) && kind != TerminalRow::Kind::counted_in;
}
constexpr bool is_in_millivolts(TerminalRow::Kind kind) {
  return kind == TerminalRow::Kind::analog_in || kind == TerminalRow::Kind::analog_out;
}

/// A group of neighbouring digital inputs or outputs, for models that have hundreds of them. Observers show
/// the group as one word, with the first terminal in bit 0. Each terminal can still be used by its own name.
struct TerminalGroup {
  static constexpr int kMax = 32;
  std::string_view name;
  int first = 0;
  int count = 1;
};

/// A motor axis, and the inputs to which the switches of its machine are connected.
struct AxisRow {
  std::string_view name;       // "A": a bench calls its machine DEVICE.A
  int upper_limit_input = -1;  // numbers of terminals
  int lower_limit_input = -1;
  int home_input = -1;
  int alarm_input = -1;  // the alarm input, which comes from the drive, like ready_input
  int ready_input = -1;
  int servo_output = -1;
  int alarm_clear_output = -1;
  int pulses_per_revolution = 0;  // factory setting, for an encoder on the motor
  int near_home_input = -1;
  int mark_input = -1;
  int index_input = -1;  // the index pulse of the encoder
  // The registers, if any, whose value 0 means that the device does not use its limit inputs.
  std::string_view upper_limit_used_by{};
  std::string_view lower_limit_used_by{};
};

/// A protocol on a line. Each protocol has one object, in addition to the facet that implements it (modbus/,
/// text/). The world's object for the protocol (world/protocol/) defines what the protocol means for a line
/// and its hosts.
struct Protocol {
  std::string_view name;  // "Modbus", for messages
};

/// The station numbers that a device can have. A device has one number, which is the same on all its lines.
struct StationNumbers {
  int lowest = 1;
  int highest = 247;
  std::string_view kept_in{};  // the register that stores it; empty: the bench sets it, and it never changes
};

/// A serial port that connects a device to a line.
struct PortRow {
  enum class Kind : std::uint8_t {
    rs232,  // point to point: the device is alone on its line
    rs485,
  } kind = Kind::rs485;
  std::string_view name;       // letters, digits, _ and -, as in a bench file
  std::span<const int> bauds;  // the selectable speeds; the first is the factory setting
  pty::LineSettings settings;  // the other settings; `baud` is replaced by the chosen speed
};

/// The model's rules for its lines, independent of their protocol.
struct LineRules {
  const Protocol& protocol;
  std::span<const PortRow> ports;                   // at least one; the first one is the default
  std::optional<StationNumbers> station_numbers{};  // none: a device has no number, and is alone on its line
};

/// A limit for a request that is lower than the limit in the standard.
struct FunctionLimit {
  std::uint8_t code = 0;
  int max = 0;  // the maximum number of bits or registers
};

/// An object of the device identification (MODBUS Application Protocol, 6.21): 0 is the vendor's name.
struct IdentityObject {
  std::uint8_t id = 0;
  std::string_view text;
};

/// The model's rules for receiving Modbus RTU frames.
struct RtuRules {
  pty::SimTime end_silence{0};              // the silence that ends a frame; also the minimum reply delay
  std::span<const std::uint8_t> functions;  // supported function codes
  std::span<const FunctionLimit> limits{};
  std::span<const IdentityObject> identity{};  // for function 43/14, in ascending order
  std::string_view server_id{};                // for function 17
};

/// The settings from which a device of a model is created.
struct DeviceSettings {
  std::string name;
  Firmware firmware = 0;                       // 0: the model's default
  std::optional<int> address{};                // the station number; none: 1, or the number in the memory
  std::vector<int> bauds{};                    // the speeds of the ports; 0 or missing: the factory setting
  int modules = 0;                             // how many modules a chain has; 0: the model's default
  std::map<std::string, std::string> choices;  // options; all other choices have their defaults
  std::map<std::string, bool> dip;             // switches on the housing, by terminal name
  std::optional<NvImage> nv;                   // the content of the memory; by default the factory settings
  std::string program;                         // the text that is loaded when the device is created
  std::string program_name;                    // the file that contains the program, for messages
  std::vector<std::pair<std::string, Value>> set;             // registers to write at creation, in this order
  std::vector<std::pair<std::string, double>> assignments{};  // like `set`, for a model without registers
};

/// The files that `understudy init` writes for a beginner: a bench, and the steps of a first move.
struct FirstFiles {
  std::string_view bench;
  std::string_view steps;
  std::string_view first_move{};  // steps that move an axis in any bench, if the scenario's are not allowed
};

/// A step of stopping everything that moves: a register or some of its bits, with a value; a command of the
/// window; or a line of text, depending on the model.
struct StopStep {
  std::string_view text;
  Value value = 1;  // the value to write to a register
};

/// The numbers that a command contains.
struct CommandNumbers {
  std::vector<std::string> names{};  // all names of the command: "MA", "T0MA"
  /// All of its numbers, in order. An element is empty if the text does not contain the number, because the
  /// controller reads it from a variable or an input.
  std::vector<std::optional<double>> numbers{};
};

struct Model {
  std::string_view name;  // "simple2-r3"
  std::string_view title;
  std::span<const Firmware> firmwares;     // oldest first; the last is the default
  const RegisterMap* registers = nullptr;  // null: the model has no registers
  std::span<const ParameterRow> parameters{};
  std::span<const NamedParameterRow> named_parameters{};
  const CommandWindow* window = nullptr;      // for commands that have names; null: there is no window
  const ProgramLanguage* language = nullptr;  // of the devices' programs; null: they do not run programs
  std::span<const CommandRow> commands{};
  std::span<const ChoiceRow> choices;
  std::span<const SectionRow> sections{};
  std::span<const ProofRow> proofs{};
  std::span<const TransitionTable> transitions{};
  bool csv_has_bits = true;  // false: the columns of the CSV were fixed before bits had names
  std::span<const TerminalRow> terminals;
  std::span<const TerminalGroup> terminal_groups{};
  std::span<const AxisRow> axes;
  std::span<const std::string_view> state_registers;  // the registers that best show what the device is doing
  std::span<const std::string_view>
      known_limitations;  // what is missing beyond individual registers, one sentence each
  LineRules line;
  std::optional<RtuRules> rtu{};            // for a model with ModbusStation
  const FirstFiles* first_files = nullptr;  // null: the model has none
  std::span<const StopStep> stop{};         // in this order; empty: a device cannot be stopped over its line
  /// Returns the hazards of a message to the window. Null: there is no window.
  Hazards (*hazards_of_command)(std::span<const std::uint16_t> words) = nullptr;
  /// Returns the hazards of a line of text. Null: the device does not accept text lines.
  Hazards (*hazards_of_line)(std::string_view line) = nullptr;
  /// Returns the effect of a line of text on program entry. Null: programs are not entered as lines.
  EditMark (*edit_mark_of_line)(std::string_view line) = nullptr;
  /// Returns the numbers in a line of text, or in the text of a message to the window. Returns nothing if it
  /// is not a command. Null: the device accepts neither.
  std::optional<CommandNumbers> (*numbers_of_command)(std::string_view text) = nullptr;
  int max_modules = 0;  // the maximum number of modules in a device; 0: the device is not a chain
  /// If a file describes the model, the text of that file with everything that belongs to it.
  /// ModelFiles::parse() creates the same model from it.
  std::string_view description{};
  /// Creates a device. make_device() checks the settings before it calls this.
  std::function<std::unique_ptr<Device>(const DeviceSettings& settings)> make;
};

/// Creates models from files that describe them (docs/import.md). The models live as long as this object. If
/// a description was read before, the same model is returned again. Both functions throw FileError and can be
/// called from any thread.
class ModelFiles {
 public:
  virtual ~ModelFiles() = default;
  /// Adds the files that it reads to `files`.
  virtual const Model& load(const std::string& path, std::vector<FileClaim>& files) = 0;
  /// Parses a text that is complete in itself. Messages contain `name` instead of a file name.
  virtual const Model& parse(const std::string& text, const std::string& name) = 0;
  /// Returns remarks on what the model's files leave open, and on how that was interpreted.
  virtual std::vector<FileError::Diagnostic> remarks_on(const Model& model) const = 0;
};

/// A model in a list of names. Its tables are created on first use, because creating them takes longer than
/// most commands.
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

/// The models that a bench can name, and the object that creates models from files. The object is null if no
/// files are read.
struct ModelList : std::span<const ListedModel> {
  using std::span<const ListedModel>::span;
  ModelList(std::span<const ListedModel> listed, ModelFiles* reader)
      : std::span<const ListedModel>(listed), files(reader) {}
  ModelFiles* files = nullptr;
};
/// Returns null if there is no model with this name. Does not create any other model.
const Model* find_model(ModelList models, std::string_view name);
/// Returns true if the name is that of a model file, such as "drive.yaml".
bool names_model_file(std::string_view name);

/// Returns the number of a terminal in its model's table, or -1 if there is no such name. find_axis() does
/// the same for axes.
int find_terminal(const Model& model, std::string_view name);
/// Returns the group with that name. find_group_of() returns the group that begins with that terminal. Both
/// return null if there is none.
const TerminalGroup* find_group(const Model& model, std::string_view name);
const TerminalGroup* find_group_of(const Model& model, int first_terminal);
int find_axis(const Model& model, std::string_view name);
/// Returns the number of a port in its model's table, or nothing if there is no such name.
std::optional<std::size_t> find_port(const Model& model, std::string_view name);
/// Returns " (RS485)" to follow the name of a device, or an empty text if the model has only one port.
std::string port_text(const Model& model, std::size_t port);
/// Returns no rows if the model has no registers.
std::span<const RegisterRow> register_rows(const Model& model);
/// Returns the register with that name, or nothing if there is none.
std::optional<NamedPlace> find_register(const Model& model, std::string_view name, Firmware firmware);
/// Returns a one-line explanation of why there is no such register.
std::string why_no_register(const Model& model, std::string_view name, Firmware firmware);

/// Reports a wrong setting of a device: the name of the setting, and what was expected.
struct SettingError : std::runtime_error {
  SettingError(std::string setting_name, const std::string& what_is_wrong)
      : std::runtime_error(setting_name + ": " + what_is_wrong), setting(std::move(setting_name)) {}
  std::string setting;
};

/// Checks the settings against the model and creates the device with its memory, power and program. Writes
/// the registers of `set`; persistent ones are stored immediately. Throws SettingError, NvError,
/// ProgramError. `log` receives the device's messages, including those about the settings.
std::unique_ptr<Device> make_device(const Model& model, const DeviceSettings& given,
                                    std::function<void(const std::string&)> log = {});

/// Returns the settings with the firmware that they imply. Throws SettingError for errors that can be
/// detected from the model alone. Errors in the switches and the memory are detected when the device is
/// created.
DeviceSettings checked_settings(const Model& model, const DeviceSettings& given);
/// Returns all mistakes that would be reported if the program were loaded into a device with these settings.
/// Throws SettingError.
std::vector<ProgramMistake> check_program(const Model& model, std::string_view text,
                                          const DeviceSettings& given);
/// Returns suspicious places in a program that loads without errors. Throws SettingError.
std::vector<ProgramMistake> program_warnings(const Model& model, std::string_view text,
                                             const DeviceSettings& given);
/// Returns the mistake to report for any program if the model has no language.
ProgramMistake no_program(const Model& model);
/// Returns 152 for "1.52", or 0 if the text is not a version.
Firmware parse_firmware(std::string_view text);

}  // namespace understudy::emulator
