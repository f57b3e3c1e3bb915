// The language in which users write programs for the devices of a model, as text: an object for each, which
// the model's `language` names. A device of such a model loads a text and gives it back (user_program.h);
// here is what can be said without a device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "emulator/device/program_cells.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator {

struct DeviceSettings;

/// An operand of an instruction.
struct OperandRow {
  std::string_view name;    // "target", if it has one
  std::string_view values;  // what it may be: "D0 to D124 or a number"
  bool may_be_unset = false;
};

/// A row of a language's instruction table. Columns that no row of a table fills are not shown.
struct InstructionRow {
  std::optional<int> opcode{};
  std::string_view mnemonic;
  std::span<const OperandRow> operands{};
  std::string_view areas{};  // the parts of a program where it may stand: "C X Y Z U"
  int size = 0;              // of program memory that it takes, in the language's unit; 0: is not told
  std::string_view cost{};   // of time, for people: "3 lines", "until the axes stand"
  std::string_view meaning{};
};

/// What a host does to start a program or to stop it: for onlookers' buttons.
struct ProgramControl {
  enum class By : std::uint8_t {
    registers,  // "M8596=0 M8596=1": one write after the other
    command,    // "RSM_MP_CALL {}": by its name (Model::window)
    text,       // "G": a line of text
  };
  std::string_view word;  // "start"
  By by = By::registers;
  std::string_view what;
  // Where `what` has a {}: a number, within these.
  int lowest = 0;
  int highest = 0;
};

class ProgramLanguage {
 public:
  /// What a text in it is called: "Simple2-R3 listing".
  virtual std::string_view name() const = 0;
  /// ".lst": how names of its files usually end.
  virtual std::string_view file_ending() const = 0;
  /// None where another table of the model has them (Model::commands).
  virtual std::span<const InstructionRow> instructions() const { return {}; }
  /// Where every instruction has the same operands in fixed cells: what those are called. Each row then has
  /// one OperandRow for each of them. None: instructions have operands of their own.
  virtual std::span<const std::string_view> operand_cells() const { return {}; }
  /// Everything that is wrong with a text, in its order: what loading it into a device made of `settings`
  /// would say. They are checked already, and name a firmware.
  virtual std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings& settings) const = 0;
  /// What a text that loads is likely to mean otherwise than it does: a label that stands twice.
  virtual std::vector<ProgramMistake> warnings(std::string_view, const DeviceSettings&) const { return {}; }
  virtual std::span<const ProgramControl> controls() const { return {}; }
  virtual const ProgramCells* cells() const { return nullptr; }

 protected:
  ~ProgramLanguage() = default;
};

}  // namespace understudy::emulator
