// Options about the languages that the manual leaves open; our option is first.
#pragma once

#include <cstdint>
#include <optional>

#include "interpreter/super_40nc/areas.h"

namespace understudy::interpreter::super_40nc {

struct Options {
  // --- when a listing is checked ------------------------------------------------------------------
  /// The numbers of the areas' first steps, as D8095 and D8096 count.
  enum class Bases : std::uint8_t { newer, older, each_from_0 } bases = Bases::newer;
  enum class Capacity : std::uint8_t { steps, lines } capacity = Capacity::steps;
  int c_capacity = 1500;  // D9042
  int stack_depth = 16;   // depth of blocks and branches
  int if_depth = 8;
  /// CJ, CJN or IF without contacts before it, and contacts without one of them after, are refused, or
  /// allowed: the jump then takes the last result.
  enum class LooseGroups : std::uint8_t {
    are_refused,
    take_last_result
  } loose_groups = LooseGroups::are_refused;
  /// Of two OUTs of one coil, the last wins, or they are refused.
  enum class DoubleCoils : std::uint8_t { last_wins, are_refused } double_coils = DoubleCoils::last_wins;
  /// If a label appears twice in one area, the first is used and the duplicate is reported, or it is refused.
  enum class DoubleLabels : std::uint8_t { load, are_refused } double_labels = DoubleLabels::load;
  /// True: after an output only its result remains of all blocks; false: all blocks remain.
  bool outputs_clear_blocks = false;
  /// True: a label in two areas belongs to the first one; false: each area has its own.
  bool labels_are_common = false;
  /// True: RST and ZRST accept T and C.
  bool timers_can_be_reset = true;
  /// Lines that the manual calls void in their area do nothing, or are refused.
  enum class VoidLines : std::uint8_t { do_nothing, are_refused } void_lines = VoidLines::do_nothing;
  bool knows_mset = true;
  bool end_may_be_missing = false;
  bool presets_may_be_registers = true;
  /// True: F, TMR and a radius without a value skip their line; false: they are refused.
  bool unset_lines_are_skipped = false;
  bool c3p_may_lack_fields = true;  // a missing coordinate does not change
  bool labels_must_exist = false;   // true: targets of jumps must exist; false: the program stops at the jump

  // --- numbers --------------------------------------------------------------------------------------
  /// An FMV that reaches beyond the end of its block writes up to the end, or does nothing.
  enum class FillBeyond : std::uint8_t { is_clipped, does_nothing } fill_beyond = FillBeyond::is_clipped;
  enum class DivisionByZero : std::uint8_t {
    changes_nothing,
    gives_zero
  } division_by_zero = DivisionByZero::changes_nothing;
  enum class Product : std::uint8_t { wraps, saturates } product = Product::wraps;
  bool sums_saturate = false;  // for ADD and SUB; false: they wrap
  /// ZRST with the higher end first is refused, clears only that end, or clears the whole range.
  enum class Swapped : std::uint8_t { is_refused, clears_first, clears_all } swapped = Swapped::is_refused;
  /// True: DIV does nothing if the remainder has no room; false: it stores the quotient alone.
  bool remainder_needs_room = false;
  /// A quotient is rounded towards 0, or downwards; the remainder follows from it.
  enum class Quotient : std::uint8_t { towards_0, downwards } quotient = Quotient::towards_0;
  /// True: RPM of 0 or less keeps an axis's speed; false: it means the minimum speed.
  bool rpm_0_keeps_speed = false;

  // --- the PLC --------------------------------------------------------------------------------------
  int scan_ms = 1;  // milliseconds between calls by the machine
  int timer_unit_ms = 1;
  /// True: the value of a running timer cannot be written.
  bool timers_ignore_writes = false;
  /// True: a counter counts beyond its preset; false: it stops there.
  bool counts_beyond_preset = false;
  /// A counter's contact compares value and preset at each scan, or is closed by the last count and opened
  /// only by RST.
  enum class CounterContact : std::uint8_t {
    compares,
    is_latched
  } counter_contact = CounterContact::compares;
  /// True: DRV, HOM and STR act at the rising edge of their condition; false: in every scan.
  bool motions_need_edge = true;
  bool modes_need_edge = false;  // likewise for ABSC, INCC, RPM, PSET, MSET and STP
  /// True: all LDP and the like of one bit share one memory; false: each has its own.
  bool bits_remember_edges = false;
  bool modes_stay_at_run = false;  // ABSC or INCC, and RPM, survive RUN
  /// True: at RUN, PLS, ALT and the like fire once if their condition is ON; false: they see no edge.
  bool outputs_fire_at_run = true;
  bool contacts_rise_at_run = false;   // at RUN, edge contacts whose bit is ON see an edge
  bool timers_count_at_once = false;   // timers count in the scan that turns them ON
  bool retentive_timers_hold = false;  // latched timers keep their value while OFF; false: it becomes 0
  bool all_timers_hold = false;
  bool timers_count_on = false;     // timers count beyond the preset
  bool empty_presets_close = true;  // a preset of 0 or less closes the contact at once
  /// The PLC may move axes of C (C21) while M8000 is OFF, whenever they are free, or never.
  enum class PlcMoves : std::uint8_t {
    while_c_rests,
    any_axis,
    only_others
  } plc_moves = PlcMoves::while_c_rests;

  // --- step programs ----------------------------------------------------------------------------------
  int slice = 64;                      // instructions of a program in a tick
  bool jumps_end_slice = true;         // taken jumps, CAL and RET end the slice
  bool pointer_moves_running = false;  // a write to D8000 or D8x00 moves the pointer of a running program
  int call_depth = 16;
  enum class LooseReturn : std::uint8_t {
    stops_program,
    is_ignored
  } loose_return = LooseReturn::stops_program;
  /// CAL with a count below 1 is skipped, or repeats without end.
  enum class NoPasses : std::uint8_t { are_skipped, mean_endless } no_passes = NoPasses::are_skipped;
  /// Motion of an axis that the program does not own (C21) has no effect, or stops the program.
  enum class NotOwned : std::uint8_t { is_void, stops_program } not_owned = NotOwned::is_void;
  /// START of an empty area ends silently, or is an error.
  enum class EmptyProgram : std::uint8_t {
    ends_silently,
    is_an_error
  } empty_program = EmptyProgram::ends_silently;
  /// F, plane, speeds and modes are loaded again by a start with the pointer at 0, or by every start.
  enum class FreshStart : std::uint8_t { pointer_at_0, every_start } fresh_start = FreshStart::pointer_at_0;
  // true: MRK of an axis program uses the axis's own field; false: the first one
  bool mark_is_by_own_field = false;
  bool wheel_ends_single_step = false;  // MPG ends a single step
  bool waits_follow_registers = false;  // TMR D reads its register while it waits
  bool waits_stand_inhibited = false;   // TMR is suspended under M8004
  /// True: a start in the middle of a line continues after that line; false: it stops the program.
  bool starts_inside_lines = false;
  bool marks_by_rpm = true;         // true: MRK goes to its target by RPM; false: by X14 alone
  bool contact_off_stops = false;   // true: M8x00 OFF stops an axis program; false: it pauses it
  bool start_begins_again = false;  // true: STR restarts a running program
  bool c3p_is_in_xy = false;        // true: C3P is in XY, whatever plane is set
  bool joins_paths = false;         // LIN and arcs that follow each other are joined while D9005 is ON
  bool rotation_0_waits = true;     // VDRV 0 waits until its axes stop
  bool continuous_by_key = true;    // M8600 acts as M8007

  bool operator==(const Options&) const = default;
};

/// Returns true if a field of RPM changes the speed of its axis.
constexpr bool sets_speed(const std::optional<std::int32_t>& rpm, const Options& options) {
  return rpm && (*rpm > 0 || !options.rpm_0_keeps_speed);
}

/// Returns the number of an area's first step, as D8095 and D8096 count.
constexpr int base_of(Area area, const Options& options) {
  if (options.bases == Options::Bases::each_from_0) return 0;
  return options.bases == Options::Bases::newer ? row_of(area).base : row_of(area).older_base;
}

}  // namespace understudy::interpreter::super_40nc
