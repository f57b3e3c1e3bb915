// RS-M8194H: download, storage and execution of macros (8, 9). lang::Machine executes their lines.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/user_program.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/programs/status.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/macro_store.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/triggers.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

/// The value for "no download". It contains a macro's name only because every download has a name.
inline const lang::Download kNoDownload{.name = {.is_isr = false, .number = 1}};

/// Inputs 115 to 119: the macro, the command, the line and the error.
using MacroReport = std::array<std::uint16_t, 5>;

struct ProgramState {
  lang::State rsm = lang::State::ready;
  lang::Download download = kNoDownload;  // valid only if `rsm` is not `ready`
  lang::DownloadStatus downloaded{};
  lang::Execution execution{};
  MacroReport execution_fault{};
  bool paused = false;         // paused by a trigger
  std::uint8_t paused_by = 0;  // the channel of that trigger
  int steps_left = 0;          // remaining steps in this tick

  bool operator==(const ProgramState&) const = default;
};

class Programs final : public Part {
 public:
  Programs(const Ground& ground, ProgramState& state, Memory& memory, Status& status, Interrupts& interrupts,
           lang::Machine& machine)
      : Part(ground),
        state_(state),
        memory_(memory),
        status_(status),
        interrupts_(interrupts),
        acts_on_(machine) {}

  ProgramState& state() { return state_; }
  const ProgramState& state() const { return state_; }

  // --- download ---------------------------------------------------------------------------------
  bool is_downloading() const { return state_.rsm != lang::State::ready; }
  /// Handles a message that opens a download, or that arrives during a download.
  lang::Fault take_download(const lang::Decoded& decoded);
  /// These return true if more lines fit in the download, and add a line that fits.
  bool has_room_for(int lines) const;
  void add_line(const lang::Command& line);

  // --- store ------------------------------------------------------------------------------------
  /// Returns null for a macro that has no lines.
  const lang::Macro* macro(const lang::MacroName& name) const;
  const lang::TriggerTable& triggers() const;
  /// Stores a listing, and returns the channels of its triggers.
  std::vector<int> load(std::string_view text);
  std::string text() const;
  /// Returns the current positions of the macros, for observers (program_location.cpp).
  std::vector<ProgramLocation> locations() const;

  // --- running ----------------------------------------------------------------------------------
  int running_mp() const { return lang::running_mp(state_.execution); }
  bool mp_runs() const { return state_.execution.mp.is_alive(); }
  bool isr_runs() const { return !state_.execution.isrs.empty(); }
  bool is_alive() const { return state_.execution.is_alive(); }
  /// A choice can refuse calls while an MP is running.
  bool are_calls_refused() const {
    return mp_runs() && !chose(option("calls_while_an_mp_runs", "wait_their_turn"));
  }
  void start_mp(int number);
  /// Ends all macros, like MP_TERMINATE.
  void terminate();
  /// Ends all macros and the pause, like RESET_CARD.
  void reset() {
    state_.execution = {};
    state_.paused = false;
    state_.paused_by = 0;
  }
  void drop_wait() { lang::drop_wait(state_.execution, acts_on_); }
  void run_tick(Tick tick);
  void set_watch(ProgramWatch* watch) { acts_on_.set_watch(watch); }
  /// Ends a restored execution that running these macros cannot have produced.
  void check_restored();
  /// These return true if the compiled macros are up to date, and discard the compiled macros.
  bool is_compiled() const { return compiled_revision_ == memory_.state().blocks.revision(); }
  void forget_compiled() { compiled_revision_ = UINT64_MAX; }

  // --- what the interpreter reports to its machine --------------------------------------------------------
  int take_isr();
  void mp_ended();
  void terminated();
  void report(const lang::ExecutionFault& fault);

 private:
  void compile() const;
  void notify_watch() const;

  ProgramState& state_;
  Memory& memory_;
  Status& status_;
  Interrupts& interrupts_;
  lang::Machine& acts_on_;
  // Not part of the state: compiled from the text blocks whenever those have changed.
  mutable lang::MacroStore macros_;
  mutable lang::TriggerTable triggers_{};
  mutable std::uint64_t compiled_revision_ = UINT64_MAX;
};

}  // namespace understudy::emulator::models::rs_m8194h
