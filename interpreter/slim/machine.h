// What a running SLIM program acts on: the chain of motors, as an abstract machine.
#pragma once

#include <cstdint>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"

namespace understudy::interpreter::slim {

/// What became of a command.
struct Outcome {
  bool waits =
      false;  // not carried out yet: nothing has changed, and the program asks again at the next tick
  Error error = Error::none;
  /// What it means for the program that gave it, besides going on with the next line.
  enum class Program : std::uint8_t {
    goes_on,
    forgets_what_it_interrupted,  // behind the RET of an event's routine there is nothing more
    ends,
  } program = Program::goes_on;

  bool operator==(const Outcome&) const = default;
};
inline constexpr Outcome kDone = {};
inline constexpr Outcome kWaits = {.waits = true};
constexpr Outcome failed(Error error) { return {.error = error}; }

class Machine {
 public:
  virtual ~Machine() = default;

  /// 1 to 8.
  virtual bool input(int number) const = 0;
  /// Of a variable, an element of an array (its index is a constant, within its range), AIN or TM.
  virtual double value(const Operand& operand) const = 0;
  /// All commands but those of program flow, program editing and GETI and GETR alone; DN, TpDN and XDN too,
  /// which wait. Indices are constants, and GETI and GETR are the numbers that the host has given.
  virtual Outcome carry_out(const Command& command) = 0;
};

}  // namespace understudy::interpreter::slim
