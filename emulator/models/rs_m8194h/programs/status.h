// RS-M8194H: the module's status: how it was booted, and what it has just finished (4.16.2).
#pragma once

#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/rows/options.h"

namespace understudy::emulator::models::rs_m8194h {

/// States of the module that pass within a tick (4.16.2).
inline constexpr std::uint8_t kInitialised = 2;
inline constexpr std::uint8_t kDownloaded = 4;
inline constexpr std::uint8_t kMpFinished = 6;
inline constexpr std::uint8_t kIsrFinished = 8;

struct StatusState {
  bool at_init = false;       // the position of the switch at power-up
  std::uint8_t finished = 0;  // the last state that passed within a tick
  Tick finished_at = 0;       // the tick in which it passed
  Tick resetting_until = 0;   // the end of RESET_CARD

  bool operator==(const StatusState&) const = default;
};

class Status final : public Part {
 public:
  Status(const Ground& ground, StatusState& state) : Part(ground), state_(state) {}

  StatusState& state() { return state_; }
  const StatusState& state() const { return state_; }
  /// Returns true if the module was booted with the switch at Init.
  bool is_deaf() const { return state_.at_init && !chose(option("init_switch", "runs_all_the_same")); }
  bool is_resetting() const { return state_.resetting_until > now(); }
  /// Records a state of input 101 that passed within the tick.
  void pass(std::uint8_t finished) {
    if (!machine_options().finished_states_show) return;
    state_.finished = finished;
    state_.finished_at = now();
  }
  /// Returns true while the state in input 101 changes without a request.
  bool changes() const {
    return is_resetting() || (machine_options().finished_states_show && state_.finished_at + 1 >= now());
  }

 private:
  StatusState& state_;
};

}  // namespace understudy::emulator::models::rs_m8194h
