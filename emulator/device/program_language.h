// The language in which users write programs for the devices of a model. Each language has one object, to
// which the `language` member of the model points. A device loads a text and returns it (user_program.h);
// this class contains the functions that do not need a device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "emulator/device/program_cells.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_parts.h"

namespace understudy::emulator {

struct DeviceSettings;

/// An operand of an instruction.
struct OperandRow {
  std::string_view name;    // "target", if it has one
  std::string_view values;  // its allowed values: "D0 to D124 or a number"
  bool may_be_unset = false;
};

/// A row of a language's instruction table. A column that is empty in all rows is not shown.
struct InstructionRow {
  std::optional<int> opcode{};
  std::string_view mnemonic;
  std::span<const OperandRow> operands{};
  std::string_view areas{};  // the parts of a program that may contain it: "C X Y Z U"
  int size = 0;              // the size in program memory, in the unit of the language; 0: unknown
  std::string_view cost{};   // the execution time, for people: "3 lines", "until the axes stop"
  std::string_view meaning{};
};

/// A request with which a host starts or stops a program, for the buttons of user interfaces.
struct ProgramControl {
  enum class By : std::uint8_t {
    registers,  // "M8596=0 M8596=1": these writes, one after the other
    command,    // "RSM_MP_CALL {}": a command of the window, by its name (Model::window)
    text,       // "G": a line of text
  };
  std::string_view word;  // "start"
  By by = By::registers;
  std::string_view what;
  // If `what` contains {}, the limits of the number that replaces it.
  int lowest = 0;
  int highest = 0;
};

class ProgramLanguage {
 public:
  /// Returns the name of the format: "Simple2-R3 listing".
  virtual std::string_view name() const = 0;
  /// Returns the usual ending of its file names: ".lst".
  virtual std::string_view file_ending() const = 0;
  /// Returns no rows if the instructions are in another table of the model (Model::commands).
  virtual std::span<const InstructionRow> instructions() const { return {}; }
  /// If all instructions have the same operand cells, returns the names of the cells; each row then has one
  /// OperandRow per cell. Otherwise, returns none.
  virtual std::span<const std::string_view> operand_cells() const { return {}; }
  /// Returns all mistakes in a text, in order, that loading it into a device created from `settings` would
  /// report. The settings have been checked and contain a firmware version.
  virtual std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings& settings) const = 0;
  /// Returns the places in a text that loads but probably does not do what its author intended, such as a
  /// label that is defined twice.
  virtual std::vector<ProgramMistake> warnings(std::string_view, const DeviceSettings&) const { return {}; }
  /// Returns the parts of a text, for observers of the program. Returns none if the text does not load.
  virtual std::vector<ProgramPart> parts(std::string_view, const DeviceSettings&) const { return {}; }
  /// Returns true if each part is a program that runs concurrently with the others, and false if the parts
  /// call each other.
  virtual bool parts_run_at_once() const { return false; }
  virtual std::span<const ProgramControl> controls() const { return {}; }
  virtual const ProgramCells* cells() const { return nullptr; }

 protected:
  ~ProgramLanguage() = default;
};

}  // namespace understudy::emulator
