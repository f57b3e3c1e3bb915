// What a running macro acts on: the controller, as an abstract machine.
#pragma once

#include <cstddef>
#include <cstdint>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

/// What became of a line. One that waits has changed nothing, and is given again at the next tick.
enum class Took : std::uint8_t { done, waits };

/// Inputs 115 to 119. The line is passed over.
struct ExecutionFault {
  MacroName macro = {};
  std::uint16_t code = 0;  // of its line
  std::uint16_t line = 0;
  Fault fault = Fault::none;

  bool operator==(const ExecutionFault&) const = default;
};

/// Commands come with numbers in place of references, within the ranges of their rows.
class Machine {
 public:
  virtual ~Machine() = default;

  /// Null: never downloaded.
  virtual const Macro* macro(const MacroName& name) const = 0;

  /// VAR0 to VAR511, bVAR0 to bVAR127.
  virtual std::int32_t variable(std::size_t number) const = 0;
  virtual void set_variable(std::size_t number, std::int32_t value) = 0;
  virtual std::uint8_t byte_variable(std::size_t number) const = 0;

  /// One of kReadVerbs.
  virtual std::int32_t read(const Command& command) const = 0;
  /// For STOP_WAIT: whether all axes of a mask have stopped.
  virtual bool stand(std::uint32_t axes) const = 0;
  /// For FRNET_WAIT: group 8 to 15, channel 0 to 15.
  virtual bool frnet_input(std::uint32_t group, std::uint32_t channel) const = 0;
  /// All other lines. A drive that is void is done.
  virtual Took carry_out(const Command& command) = 0;

  /// The ISR whose turn it is, 0 if none. It is then running.
  virtual int take_isr() = 0;
  /// The outermost MP has ended, but not by MP_TERMINATE.
  virtual void mp_ended() = 0;
  /// MP_TERMINATE, as a line of a macro: all macros have ended already.
  virtual void terminated() = 0;
  virtual void report(const ExecutionFault& fault) = 0;
};

}  // namespace understudy::interpreter::rs_m8194h
