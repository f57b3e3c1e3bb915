// The five step programs of a SUPER-40NC at run time. The state of each program is a plain value. Events
// change it according to the table in events.h, and one slice per tick advances it line by line. (Manual,
// 軟體架構, STR 指令, M8000.)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_code.h"

namespace understudy::interpreter::super_40nc {

struct Call {
  int back = 0;             // step after CAL
  int label = 0;            // step
  std::int64_t passes = 0;  // passes left, including the running one; negative: passes that have begun

  bool operator==(const Call&) const = default;
};

struct StepState {
  Phase phase = Phase::idle;
  Phase resumes = Phase::executing;  // phase in which a paused or held program continues
  bool is_paused_by_key = false;     // paused by M8006 or PAUSE
  bool machine_holds = false;        // the machine holds motions, until resume_motions()
  bool waits_to_resume = false;      // because of M8004
  int step = 0;                      // the next or current step, counted from the beginning of its area
  int next_step = 0;                 // the step after a motion
  std::int64_t left_ms = 0;          // remaining time of TMR; 0: it has not begun
  std::int32_t wait_ms = 0;          // the time that TMR read last, if it reads repeatedly
  std::vector<Call> calls = {};
  std::uint64_t blocks = 0;  // result of the last contacts
  // Not part of the state: a line is being executed, and only this line may have moved the program's pointer.
  bool owns_pointer = false;
  // Modal values: initialized at a fresh start and kept at any other start. F and the plane are D8006 and
  // D8007.
  bool has_modes = false;
  Targets targets = Targets::absolute;
  std::array<std::int32_t, kAxisCount> rpm{};
  bool waits_for_drive = true;  // CHK

  bool operator==(const StepState&) const = default;
};

struct StepStates {
  std::array<StepState, kStepProgramCount> programs{};
  bool operator==(const StepStates&) const = default;
};

using StepCodes = std::array<StepCode, kStepProgramCount>;

/// Create an object for each tick or event, because it only refers to its arguments.
class StepPrograms : public StepControl {
 public:
  StepPrograms(StepStates& states, const StepCodes& codes, Machine& machine, const Options& options)
      : states_(states), codes_(codes), access_(machine), machine_(machine), options_(options) {}

  /// Handles an event from outside: start, contact_off, hold, stop, broken, file_changed (C), plc_stop,
  /// plc_run. Call it with `reset` and `emergency` before the slices of each tick in which they are ON.
  void take(Event event, Area area);
  void start(Area area) override;
  void stop(Area area) override { take(Event::stop, area); }
  /// Unloads a program before another one replaces it. The machine has already stopped its motions.
  void unload(Area area) { forget(area); }

  /// These run the slice of a tick, for one program or for all programs in the order of the areas. They first
  /// check the program's contact (M8000, M8x00): a contact that is ON starts a program that is not running; a
  /// contact that is OFF pauses it.
  void run_slice(Area area);
  void run_slices();

  /// Returns D8000 or D8x00.
  int step(Area area) const { return state(area).step; }
  /// Writes D8000 or D8x00. The write is ignored while the program is running; otherwise, it drops held
  /// motion.
  void set_step(Area area, int step);
  /// Returns M8022.
  bool shows_pausing() const;

  /// Returns for how many ticks a slice would do nothing but count, if no contact, register or axis changes.
  std::int64_t quiet_ms(Area area) const;
  /// Runs several ticks at once, at most quiet_ms().
  void fast_forward(Area area, std::int64_t ticks);
  /// Returns the contact that WAT or WTN waits for, or unset.
  Operand awaited(Area area) const;

 private:
  static void move_pointer(StepState& program, int step);
  struct Stepping;  // executes one instruction in its slice
  enum class Slice : std::uint8_t { continues, is_over };

  StepState& state(Area area) { return states_.programs[index_of(area)]; }
  const StepState& state(Area area) const { return states_.programs[index_of(area)]; }
  const StepCode& code(Area area) const { return codes_[index_of(area)]; }
  bool contact_is_on(Area area) const { return machine_.special_contact(row_of(area).run_contact); }
  void set_contact(Area area, bool on) { machine_.set_special_contact(row_of(area).run_contact, on); }
  bool is_single_step(Area area) const {
    return machine_.special_contact(row_of(area).run_contact - 8000 + named::kSingleStep);
  }
  /// Returns true while M8002 or the axis's M8x02 is ON: the lines after the line that switched it ON are not
  /// executed.
  bool is_stopped_short(Area area) const {
    const int axis = axis_of(area);
    return machine_.special_contact(named::kEmergencyStop) ||
           (axis >= 0 && machine_.special_contact(named::kReset + 100 * axis));
  }
  bool is_inhibited() const { return machine_.special_contact(named::kMotionInhibit); }
  void report(Area area, Code code);
  void fail(Area area, Code code);

  // in step_programs.cpp
  void begin(Area area, Reaction how);
  void load_modes(Area area);
  void clear(Area area);
  void forget(Area area);
  void stop_motors(Area area);
  void pause(Area area, bool by_key);
  void freeze(Area area);
  void resume(Area area);
  void change_file(Area area);
  void end_of_motion(Area area);
  bool finds_line(Area area);

  // in step_flow.cpp
  /// `line` is a copy, because the line may replace its own program (D9001).
  Slice execute(Area area, Instruction line);
  void begin_line(Area area);
  bool decide(Area area, bool outcome);
  Slice carry_out(Area area, const Instruction& line);
  Slice advance(Area area, const Instruction& line);
  Slice jump(Area area, int step);
  Slice jump_to_label(Area area);
  Slice call(Area area, const Instruction& line);
  Slice return_(Area area, const Instruction& line);
  std::int64_t passes_wanted(Area area, int back);
  Slice end(Area area);
  Slice wait(Area area, const Instruction& line, bool is_over);
  Slice wait_for_time(Area area, const Instruction& line);
  Slice read_contact(Area area, const Instruction& line);
  Slice control(Area area, const Instruction& line);
  bool is_in_group(Area area) const;
  bool follows_register(Area area) const;

  // in step_motion.cpp
  Slice set_mode(Area area, const Instruction& line);
  Slice move(Area area, const Instruction& line);
  Slice begin_arc(Area area, const Instruction& line);
  template <class Request>
  Slice begin_motion(Area area, const Instruction& line, const Request& request, bool waits);
  bool goes_on_by_path(Area area, const Instruction& line) const;
  AxisValues values_of(Area area, const Instruction& line) const;
  bool drop_forbidden_axes(Area area, AxisValues& values);
  std::int32_t feed() const { return machine_.special_register(named::kFeed); }
  Plane plane() const;

  StepStates& states_;
  const StepCodes& codes_;
  Access access_;
  Machine& machine_;
  const Options& options_;
  int watched_line_ = -1;  // the line that an observer was notified of; -1: none, or the line began earlier
};

}  // namespace understudy::interpreter::super_40nc
