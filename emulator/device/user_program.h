// The program that a user gives a device to run by itself, in the language of its model (program_language.h).
// A facet: Device::user_program() is null where a device takes none.
#pragma once

#include <string>
#include <string_view>

#include "emulator/device/program_error.h"  // IWYU pragma: keep, load_program() throws it

namespace understudy::emulator {

class UserProgram {
 public:
  /// If it throws (ProgramError), the program is as it was; what the device shows of the attempt may not be.
  /// The program is written as if over the wire.
  virtual void load_program(std::string_view text) = 0;
  /// As text that load_program() takes.
  virtual std::string program_text() const = 0;

 protected:
  ~UserProgram() = default;
};

}  // namespace understudy::emulator
