// Loads and runs the PLC and the step programs of a SUPER-40NC, and notifies them of events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/program_watch.h"
#include "base/simulated_time.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/user_program.h"
#include "emulator/models/super_40nc/axis/axis_parts.h"
#include "emulator/models/super_40nc/panel/pressed_keys.h"
#include "emulator/models/super_40nc/path/moves.h"
#include "emulator/models/super_40nc/path/paths.h"
#include "emulator/models/super_40nc/programs/plc_watch.h"
#include "emulator/models/super_40nc/programs/program_state.h"
#include "emulator/models/super_40nc/programs/stored_programs.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/ladder.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

/// The parts on which programs act.
struct Controls {
  Ground& ground;
  AxisParts& parts;
  Paths& paths;
  Moves& moves;
  PressedKeys& keys;
  RegisterBank& bank;
};

class Programs : protected Chips, public Watched {
 public:
  Programs(const Controls& controls, ProgramState& state)
      : Chips(controls.parts.chips),
        controls_(controls),
        state_(state),
        options_(ground_.language_options()),
        stored_(controls.ground, state),
        watch_(controls.bank) {}

  StoredPrograms& stored() { return stored_; }
  const StoredPrograms& stored() const { return stored_; }

  // --- loading.cpp
  /// Loads a listing. Areas that it does not contain do not change. A refused listing is reported in D8094 to
  /// D8096.
  void load_program(std::string_view text);
  void make_programs_ready();
  /// Prepares the programs of a restored state if they differ.
  void restored();
  /// Changes the path file (D9001).
  void change_file(std::int32_t number);
  /// Applies a command of D8020: the user table, or a line of it.
  void take_user_command(std::int32_t number);
  /// Restores C's own program when the table has ended.
  void leave_table();
  /// Returns D8019, the line of the user table.
  std::int32_t table_line() const;

  // --- programs.cpp
  void handle(interpreter::super_40nc::Event event, Area area);
  /// Handles a program's motion that was cut off, for example at a limit. Unless the program has ended,
  /// resets it or (depending on a choice) pauses it.
  void broken(const Broken& broken);
  void path_broken(motion::Cause why);
  /// Runs a slice of each step program, if at least one of them is busy.
  void run_steps();
  bool are_busy() const;
  /// Returns the state of M8022.
  bool is_pausing() const;
  /// Sets D8000 or D8x00. Programs are numbered in the order of their areas.
  void set_pointer(int program, std::int32_t step);
  /// Returns the number that D8000 and D8x00 add to the step number within the area.
  int shown_base(std::size_t program) const;
  /// Returns D8000 or D8x00.
  std::int32_t shown_step(std::size_t program) const;
  std::vector<ProgramLocation> program_locations() const;
  ProgramLocation plc_location() const;

  // --- plc_runs.cpp
  void plc_to_run();
  void plc_to_stop();
  /// Starts the first scan again, with the present inputs.
  void begin_first_scan();
  void run_plc();
  bool plc_scans() const { return !ladder_->is_empty() && state_.plc.runs; }
  bool scans_in(Tick tick) const;
  /// Returns the number of ticks in which the PLC needs no scan, if nothing that it reads changes.
  Tick quiet_scans(bool moves) const;
  void note_what_plc_sees() { watch_.note(); }
  /// Called at the end of a tick. Checks whether the PLC must scan.
  void wake_plc_by_what_changed();
  /// Performs the scans of the skipped ticks after `done`, up to `tick`.
  void fast_forward(Tick done, Tick tick);

 private:
  /// A scan keeps the ladder with which it began, even if the device's ladder is replaced in the meantime.
  using SharedLadder = std::shared_ptr<const interpreter::super_40nc::Ladder>;

  void give_up_program(Area area);
  void put_table_in_place();
  /// Notifies the observer of the existing programs.
  void notify_watch() const;
  void clear_timers();

  Controls controls_;
  ProgramState& state_;
  const interpreter::super_40nc::Options& options_;
  StoredPrograms stored_;
  PlcWatch watch_;
  interpreter::super_40nc::StepCodes
      codes_;  // not state: compiled, like the ladder, from the memory's listings
  SharedLadder ladder_ = std::make_shared<const interpreter::super_40nc::Ladder>();
  NamedBlocks::mapped_type ready_texts_;  // the texts of codes_ and ladder_
  std::vector<int> table_lines_;          // lines of the user table, while it runs
};

}  // namespace understudy::emulator::models::super_40nc
