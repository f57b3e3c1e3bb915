// RS-M8194H: the FIFO. It executes commands in order, as many as fit in a tick.
#pragma once

#include <cstddef>
#include <vector>

#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/programs/programs.h"
#include "emulator/models/rs_m8194h/programs/status.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"

namespace understudy::emulator::models::rs_m8194h {

/// The waiting commands, and the axes of a STOP_WAIT that has begun and has left the queue.
struct Fifo {
  std::vector<lang::Command> waiting{};
  AxisMask stop_wait = 0;

  bool operator==(const Fifo&) const = default;
};

struct QueueState {
  Fifo fifo{};
  bool touched = false;  // an immediate command has run since the last tick, so waiting commands may continue

  bool operator==(const QueueState&) const = default;
};

class CommandQueue final : public Part {
 public:
  CommandQueue(const Ground& ground, QueueState& state, const Chip& chip, const Status& status,
               Programs& programs, lang::Machine& machine)
      : Part(ground), state_(state), chip_(chip), status_(status), programs_(programs), acts_on_(machine) {}

  QueueState& state() { return state_; }
  const QueueState& state() const { return state_; }
  bool is_empty() const { return state_.fifo.waiting.empty(); }

  /// Handles a checked command from the window: executes or queues it, or returns why it cannot.
  lang::Fault take(const lang::Command& command);
  /// Returns the fault of a command that does not fit in the FIFO or in the macro that is being downloaded.
  lang::Fault why_no_room(const lang::Command& command) const;
  /// Adds a command. The caller must have checked that there is room.
  void queue(const lang::Command& command);
  int free_blocks() const;
  /// Executes as many commands as fit in the tick.
  void run();
  /// Empties the queue. A STOP_WAIT that has begun is no longer in the queue, so it continues.
  void clear() { state_.fifo.waiting.clear(); }
  void clear_all() { state_.fifo = {}; }
  /// Drops the command for which the queue is waiting: a STOP_WAIT, or the first command.
  void drop_first();
  void wait_for(AxisMask axes) { state_.fifo.stop_wait = axes; }

 private:
  int blocks_of(const lang::Command& command) const;
  bool is_held() const;

  QueueState& state_;
  const Chip& chip_;
  const Status& status_;
  Programs& programs_;
  lang::Machine& acts_on_;
};

}  // namespace understudy::emulator::models::rs_m8194h
