// The program that a user gives a device to run by itself, in the language of its model (program_language.h).
// A facet: Device::user_program() is null where a device takes none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/program_error.h"  // IWYU pragma: keep, load_program() throws it

namespace understudy::emulator {

/// Where a program is at this moment: of a device that runs several at once, one for each of them.
struct ProgramPlace {
  enum class State : std::uint8_t { stopped, running, waiting, failed };
  std::string program;  // "MAIN", "P1"; empty where there is one
  State state = State::stopped;
  int line = 0;           // of program_text(), from 1; 0: it is not told
  std::string text;       // what stands there
  std::string waits_for;  // of one that waits: "input 3 is ON", "a delay"
  std::string why;        // it has stopped or failed, or what went wrong on its way, where that is known
  std::optional<SimTime> until{};  // of one that waits for a time: when it is over
};

class UserProgram {
 public:
  /// If it throws (ProgramError), the program is as it was; what the device shows of the attempt may not be.
  /// The program is written as if over the wire.
  virtual void load_program(std::string_view text) = 0;
  /// As text that load_program() takes.
  virtual std::string program_text() const = 0;
  /// For onlookers.
  virtual std::vector<ProgramPlace> places() const { return {}; }

 protected:
  ~UserProgram() = default;
};

}  // namespace understudy::emulator
