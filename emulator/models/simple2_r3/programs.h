// The program of a Simple2-R3: its cells and its execution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/program_watch.h"
#include "base/simulated_time.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/user_program.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/state.h"
#include "interpreter/simple2/execution/execution.h"

namespace understudy::emulator::models::simple2_r3 {

class Programs {
 public:
  /// A program reads and writes registers in `bank`.
  Programs(State& state, const Setup& setup, RegisterBank& bank)
      : state_(state), setup_(setup), bank_(bank) {}

  void power_up();
  void load(std::string_view listing);
  /// Reloads the program after all cells of the image may have changed.
  void reload();
  void clear();
  void start(std::uint8_t line);
  void stop();
  void reset_timers();
  /// Runs one tick, if program_is_due(). The watch may be null.
  void run(Tick tick, ProgramWatch* watch);

 private:
  void has_ended();
  void find_flags_if_requested();

  State& state_;
  const Setup& setup_;
  RegisterBank& bank_;
};

inline bool starts_by_itself(const State& state) { return state.image[slot("AutoStart_MainProg")] != 0; }

/// Returns true if the program may have something to do in this tick.
inline bool program_is_due(const State& state, Tick tick) {
  return tick == state.first_tick || (state.execution.running && tick % interpreter::simple2::kSlotMs == 0);
}

/// Returns the next tick in which the running program does anything.
Tick next_slot(const State& state, const Setup& setup, const RegisterBank& bank, Tick done);

/// Returns the current position of the program, for observers.
ProgramLocation program_location(const State& state);

}  // namespace understudy::emulator::models::simple2_r3
