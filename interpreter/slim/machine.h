// The chain of motors on which a running SLIM program acts, as an abstract interface.
#pragma once

#include <cstdint>

#include "base/program_watch.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"

namespace understudy::interpreter::slim {

/// The result of a command.
struct Outcome {
  bool waits = false;  // not executed yet; the program repeats the command in the next tick
  Error error = Error::none;
  /// The effect on the program that sent the command.
  enum class Program : std::uint8_t {
    continues,
    forgets_what_it_interrupted,  // the program ends at the RET of the event routine
    ends,
  } program = Program::continues;

  bool operator==(const Outcome&) const = default;
};
inline constexpr Outcome kDone = {};
inline constexpr Outcome kWaits = {.waits = true};
constexpr Outcome failed(Error error) { return {.error = error}; }

class Machine : public Watched {
 public:
  virtual ~Machine() = default;

  /// Returns input 1 to 8.
  virtual bool input(int number) const = 0;
  /// Returns the value of a variable, an array element (with a constant index that is in range), AIN, TM or a
  /// quantity.
  virtual double value(const Operand& operand) const = 0;
  /// Executes all commands except program flow, program editing, and GETI and GETR alone. This includes DN,
  /// TpDN and XDN, which wait. Indices are constants, and GETI and GETR are already replaced by the numbers
  /// from the host.
  virtual Outcome carry_out(const Command& command) = 0;
};

}  // namespace understudy::interpreter::slim
