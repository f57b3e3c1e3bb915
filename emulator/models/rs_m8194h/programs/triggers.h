// RS-M8194H: triggers. FRnet inputs start macros and events without a host (10, 5.4).
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/stops.h"
#include "emulator/models/rs_m8194h/programs/command_queue.h"
#include "emulator/models/rs_m8194h/programs/frnet.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/programs/programs.h"
#include "emulator/models/rs_m8194h/programs/status.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "interpreter/rs_m8194h/triggers.h"

namespace understudy::emulator::models::rs_m8194h {

struct TriggerState {
  std::vector<std::uint8_t> queued_triggers{};  // channels whose MP is waiting

  bool operator==(const TriggerState&) const = default;
};

class Triggers final : public Part {
 public:
  struct Known {
    const Memory& memory;
    const Status& status;
    const Frnet& frnet;
    Drives& drives;
    Stops& stops;
    Programs& programs;
    CommandQueue& queue;
  };
  Triggers(const Ground& ground, TriggerState& state, const Known& known)
      : Part(ground), state_(state), known_(known) {}

  void reset() { state_ = {}; }
  /// Handles a scan; the inputs were `before` until then. check_at_start() also counts levels that are
  /// already present, if the choice says so.
  void check(const FrnetWords& before);
  void check_at_start();
  /// Handles a write to holding register 9.
  void enable(bool on);
  /// Called when the channel has another trigger: its level no longer holds an axis.
  void replaced(int channel);
  /// Starts the MP of the first waiting channel, if it may start now.
  void start_queued();
  /// Returns true if no MP is waiting, and no level will call its MP again.
  bool rests() const { return state_.queued_triggers.empty() && !a_level_calls_again(); }

 private:
  void check(const FrnetWords& before, bool at_start);
  void on_level_end(int channel, const lang::Trigger& trigger);
  void fire(int channel, const lang::Trigger& trigger);
  void call_mp(int channel);
  void hold(int channel, const lang::Trigger& trigger);
  void abort_command();
  void pause(int channel);
  /// Returns true if the level of a channel is still present and, because of a choice, calls its MP again.
  bool calls_again(int channel) const;
  bool a_level_calls_again() const;
  void repeat_levels();
  bool may_start() const;

  TriggerState& state_;
  Known known_;
};

}  // namespace understudy::emulator::models::rs_m8194h
