// The controller on which a running macro acts, as an abstract interface.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/program_watch.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

/// The result of a line. A line that waits has not changed anything, and is repeated in the next tick.
enum class Took : std::uint8_t { done, waits };

/// A fault during execution, for inputs 115 to 119. The line is skipped.
struct ExecutionFault {
  MacroName macro = {};
  std::uint16_t code = 0;  // of its line
  std::uint16_t line = 0;
  Fault fault = Fault::none;

  bool operator==(const ExecutionFault&) const = default;
};

/// The interface to the controller. References in commands are already replaced by numbers within the ranges
/// of their rows.
class Machine : public Watched {
 public:
  virtual ~Machine() = default;

  /// Returns null for a macro that was never downloaded.
  virtual const Macro* macro(const MacroName& name) const = 0;

  /// These access VAR0 to VAR511 and bVAR0 to bVAR127.
  virtual std::int32_t variable(std::size_t number) const = 0;
  virtual void set_variable(std::size_t number, std::int32_t value) = 0;
  virtual std::uint8_t byte_variable(std::size_t number) const = 0;

  /// Executes one of kReadVerbs and returns the value.
  virtual std::int32_t read(const Command& command) const = 0;
  /// For STOP_WAIT: returns true if all axes in the mask have stopped.
  virtual bool stand(std::uint32_t axes) const = 0;
  /// For FRNET_WAIT: returns the input of group 8 to 15, channel 0 to 15.
  virtual bool frnet_input(std::uint32_t group, std::uint32_t channel) const = 0;
  /// Executes all other lines. Also returns `done` for a drive that has no effect.
  virtual Took carry_out(const Command& command) = 0;

  /// Starts the next pending ISR and returns its number, or 0 if none is pending.
  virtual int take_isr() = 0;
  /// Called when the outermost MP has ended, except by MP_TERMINATE.
  virtual void mp_ended() = 0;
  /// Called for MP_TERMINATE as a line of a macro, after all macros have ended.
  virtual void terminated() = 0;
  virtual void report(const ExecutionFault& fault) = 0;
};

}  // namespace understudy::interpreter::rs_m8194h
