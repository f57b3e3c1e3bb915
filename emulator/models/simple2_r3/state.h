// The whole state of a Simple2-R3, as a value.
#pragma once

#include <array>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/terminals.h"
#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/program.h"

namespace understudy::emulator::models::simple2_r3 {

/// Timer1, Timer2: 32 bits, in the timer's unit (Setup::timer_time). The value is computed from its start, so
/// a running timer takes no time to simulate.
struct Timer {
  std::uint32_t value = 0;  // the value at `since`
  Tick since = 0;
  bool running = false;

  /// Returns the value at `now`. On overflow, it wraps to 0, or saturates if `stays`.
  std::uint32_t at(Tick now, bool stays) const {
    const std::uint64_t sum = value + (running ? static_cast<std::uint64_t>(now - since) : 0);
    return stays && sum > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(sum);
  }
  void set(std::uint32_t new_value, Tick now) {
    value = new_value;
    since = now;
  }
  void run(bool on, Tick now, bool stays) {
    set(at(now, stays), now);
    running = on;
  }

  bool operator==(const Timer&) const = default;
};

/// The speed of a program's moves, if they do not use the axis's registers.
struct ProgramSpeed {
  std::uint32_t speed_rpm = 0;
  std::uint32_t acceleration_10ms = 0;
  std::uint32_t deceleration_10ms = 0;

  bool operator==(const ProgramSpeed&) const = default;
};

/// The parameters of a position move, latched when it starts (appendix A).
struct MoveParameters {
  std::int64_t distance_pulses = 0;
  std::uint32_t speed_rpm = 0;
  std::uint32_t acceleration_10ms = 0;
  std::uint32_t deceleration_10ms = 0;
  bool of_the_axis = false;  // the speed and times come from the axis's registers 0x1002 and 0x1008
  bool by_trigger = false;   // started by the register that shows it

  bool operator==(const MoveParameters&) const = default;
};

/// A command that waits for SVON because of a choice.
struct KeptCommand {
  Mode mode = Mode::position;
  Command command = Command::none;  // a command for position mode; none: no command is waiting
  MoveParameters move{};
  std::int64_t value = 0;  // the value in mRPM or percent

  bool operator==(const KeptCommand&) const = default;
};

/// The members that a tick needs come first and, up to the beginning of `eeprom`, are on one cache line (a
/// test checks this).
struct alignas(64) State {
  bool touched = true;               // registers or inputs may have changed since motion last read them
  bool unlocked = true;              // PROG_UNLOCK
  std::uint8_t switches = 0;         // bit n: DIP n + 1 at power-up
  std::uint8_t written_outputs = 0;  // bit n: the last level written to DOUT n
  std::uint16_t inputs = 0;          // bit n: DIN n, as sampled in this tick
  std::uint16_t assignments = 0;     // bit n: register 0x0A00 + n at power-up
  std::array<std::uint16_t, kAnalogCount> adc{};  // as sampled in this tick
  std::uint16_t password = 0;                     // NEW_PWD, independent of the image while locked
  Tick first_tick = 1;  // the first tick after power-up, in which AutoStart_MainProg is checked
  interpreter::simple2::Execution execution;
  Eeprom eeprom;
  std::array<AxisState, 2> axes;
  alignas(64) std::array<std::uint32_t, kSlotCount> image{};
  interpreter::simple2::Program program;  // the cells of the image, in an executable form
  std::array<Timer, 2> timers;
  std::array<ProgramSpeed, 2> program_speeds{};
  std::array<KeptCommand, 2> kept{};  // the waiting commands, by axis

  bool operator==(const State&) const = default;
};

}  // namespace understudy::emulator::models::simple2_r3
