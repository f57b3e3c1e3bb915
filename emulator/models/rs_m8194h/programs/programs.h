// RS-M8194H: macros: their download, storage and execution (8, 9). lang::Machine executes their lines.
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

/// The value for "no download". It has a macro's name only because each download has one.
inline const lang::Download kNoDownload{.name = {.is_isr = false, .number = 1}};

/// Inputs 115 to 119: the macro, the command, the line and the error.
using MacroReport = std::array<std::uint16_t, 5>;

struct ProgramState {
  lang::State rsm = lang::State::ready;
  lang::Download download = kNoDownload;  // valid while `rsm` says that a download is open
  lang::DownloadStatus downloaded{};
  lang::Execution execution{};
  MacroReport execution_fault{};
  bool paused = false;         // paused by a trigger
  std::uint8_t paused_by = 0;  // channel of that trigger
  int steps_left = 0;          // steps left in this tick

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
  /// Takes a message while a macro is being downloaded, or one that opens a download.
  lang::Fault take_download(const lang::Decoded& decoded);
  /// Return whether more lines fit into the download, and add one that fits.
  bool has_room_for(int lines) const;
  void add_line(const lang::Command& line);

  // --- store ------------------------------------------------------------------------------------
  /// Returns null for a macro that has no lines.
  const lang::Macro* macro(const lang::MacroName& name) const;
  const lang::TriggerTable& triggers() const;
  /// Stores a listing, and returns the channels of its triggers.
  std::vector<int> load(std::string_view text);
  std::string text() const;
  /// Returns where macros are, for observers (program_location.cpp).
  std::vector<ProgramLocation> locations() const;

  // --- running ----------------------------------------------------------------------------------
  int running_mp() const { return lang::running_mp(state_.execution); }
  bool mp_runs() const { return state_.execution.mp.is_alive(); }
  bool isr_runs() const { return !state_.execution.isrs.empty(); }
  bool is_alive() const { return state_.execution.is_alive(); }
  /// If so chosen, calls are refused while an MP runs.
  bool are_calls_refused() const {
    return mp_runs() && !chose(option("calls_while_an_mp_runs", "wait_their_turn"));
  }
  void start_mp(int number);
  /// Ends all macros, as MP_TERMINATE does.
  void terminate();
  /// Ends all macros and the pause, as RESET_CARD does.
  void reset() {
    state_.execution = {};
    state_.paused = false;
    state_.paused_by = 0;
  }
  void drop_wait() { lang::drop_wait(state_.execution, acts_on_); }
  void run_tick(Tick tick);
  void set_watch(ProgramWatch* watch) { acts_on_.set_watch(watch); }
  /// Ends a restored execution that no run of these macros can have reached.
  void check_restored();
  /// Return true if the memory's macros are compiled, and discard the compiled ones.
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
  // Not state: compiled from the text blocks whenever these have changed.
  mutable lang::MacroStore macros_;
  mutable lang::TriggerTable triggers_{};
  mutable std::uint64_t compiled_revision_ = UINT64_MAX;
};

}  // namespace understudy::emulator::models::rs_m8194h
