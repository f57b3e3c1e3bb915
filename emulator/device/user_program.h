// The program that a user loads into a device, in the language of its model (program_language.h). This is a
// facet: Device::user_program() is null if a device runs no program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/program_watch.h"
#include "base/simulated_time.h"
#include "emulator/device/program_error.h"  // IWYU pragma: keep, load_program() throws it

namespace understudy::emulator {

/// The present position of a program. A device that runs several programs concurrently has several positions.
struct ProgramLocation {
  enum class State : std::uint8_t { stopped, running, waiting, failed };
  std::string program;  // "MAIN", "P1"; empty if there is only one
  State state = State::stopped;
  int line = 0;                    // the line in program_text(), from 1; 0: unknown
  std::string text;                // the program's text at that line
  std::string waits_for;           // what a waiting program waits for: "input 3 is ON", "a delay"
  std::string why;                 // why it has stopped or failed, or what went wrong, if that is known
  std::optional<SimTime> until{};  // the end of the wait, if the program waits for a time
  std::vector<int> callers{};      // the lines at which its callers continue; the innermost caller is first
};

class UserProgram {
 public:
  /// Loads the program as if it were written over the line. If it throws ProgramError, the program does not
  /// change, although the device's registers may show the attempt.
  virtual void load_program(std::string_view text) = 0;
  /// Returns the program as text that load_program() accepts.
  virtual std::string program_text() const = 0;
  /// Returns the positions for observers.
  virtual std::vector<ProgramLocation> program_locations() const { return {}; }
  /// Adds an observer, which is not part of the state. First, it receives the mark of the program
  /// (ProgramWatch::program_loaded()); from then on, it is notified of every line that runs.
  void add_watch(ProgramWatch& watch) {
    watches_.add(watch);
    watch_program(watches_.watch());
  }
  void remove_watch(const ProgramWatch& watch) {
    watches_.remove(watch);
    watch_program(watches_.watch());
  }

 protected:
  ~UserProgram() = default;

 private:
  /// Sets the observer of the lines, or none (null).
  virtual void watch_program(ProgramWatch* /*watch*/) {}

  ProgramWatches watches_;
};

}  // namespace understudy::emulator
