// What the manual leaves open about the languages; the first of each is ours.
#pragma once

#include <cstdint>
#include <optional>

#include "interpreter/super_40nc/areas.h"

namespace understudy::interpreter::super_40nc {

struct Options {
  // --- when a listing is checked ------------------------------------------------------------------
  /// Of the program memory, which D8095 and D8096 count in.
  enum class Bases : std::uint8_t { newer, older, each_from_0 } bases = Bases::newer;
  enum class Capacity : std::uint8_t { steps, lines } capacity = Capacity::steps;
  int c_capacity = 1500;  // D9042
  int stack_depth = 16;   // of blocks and branches
  int if_depth = 8;
  /// CJ, CJN or IF without contacts before it, contacts without one of them behind.
  enum class LooseGroups : std::uint8_t {
    are_refused,
    take_last_result
  } loose_groups = LooseGroups::are_refused;
  /// Two OUTs of one coil.
  enum class DoubleCoils : std::uint8_t { last_wins, are_refused } double_coils = DoubleCoils::last_wins;
  /// A label twice in one area: the first is taken, and reported.
  enum class DoubleLabels : std::uint8_t { load, are_refused } double_labels = DoubleLabels::load;
  /// An output leaves its result alone of all blocks, or leaves them all.
  bool outputs_clear_blocks = false;
  /// A label that two areas have is the first one's alone, or each area has its own.
  bool labels_are_common = false;
  /// RST and ZRST of T and C.
  bool timers_can_be_reset = true;
  /// Lines that the manual calls void in their area.
  enum class VoidLines : std::uint8_t { do_nothing, are_refused } void_lines = VoidLines::do_nothing;
  bool knows_mset = true;
  bool end_may_be_missing = false;
  bool presets_may_be_registers = true;
  /// F, TMR and a radius without a value: the line is skipped, or refused.
  bool unset_lines_are_skipped = false;
  bool c3p_may_lack_fields = true;  // such a coordinate does not change
  bool labels_must_exist = false;   // those that are jumped to; else the program stops there

  // --- numbers --------------------------------------------------------------------------------------
  /// FMV beyond the end of its block.
  enum class FillBeyond : std::uint8_t { is_clipped, does_nothing } fill_beyond = FillBeyond::is_clipped;
  enum class DivisionByZero : std::uint8_t {
    changes_nothing,
    gives_zero
  } division_by_zero = DivisionByZero::changes_nothing;
  enum class Product : std::uint8_t { wraps, saturates } product = Product::wraps;
  bool sums_saturate = false;  // of ADD and SUB; else they wrap
  /// ZRST with the higher end first.
  enum class Swapped : std::uint8_t { is_refused, clears_first, clears_all } swapped = Swapped::is_refused;
  /// DIV where the remainder has no room: the quotient alone, or nothing.
  bool remainder_needs_room = false;
  /// A quotient that is not whole, and the remainder with it.
  enum class Quotient : std::uint8_t { towards_0, downwards } quotient = Quotient::towards_0;
  /// RPM of 0 or less leaves an axis its speed; else it is the least there is.
  bool rpm_0_keeps_speed = false;

  // --- the PLC --------------------------------------------------------------------------------------
  int scan_ms = 1;  // how often the machine calls
  int timer_unit_ms = 1;
  /// The value of a timer that runs cannot be written.
  bool timers_ignore_writes = false;
  /// A counter stops at its preset, or counts on.
  bool counts_beyond_preset = false;
  /// Its contact is what value and preset say at each scan, or is closed by the last count and opened by RST
  /// alone.
  enum class CounterContact : std::uint8_t {
    compares,
    is_latched
  } counter_contact = CounterContact::compares;
  /// DRV, HOM, STR: at the rising edge of their condition, or in every scan.
  bool motions_need_edge = true;
  bool modes_need_edge = false;  // ABSC, INCC, RPM, PSET, MSET and STP as well
  /// One memory for all LDP and the like of a bit, or one for each.
  bool bits_remember_edges = false;
  bool modes_stay_at_run = false;  // ABSC or INCC, and RPM
  /// At RUN: PLS, ALT and the like fire once if their condition is ON, or see no edge.
  bool outputs_fire_at_run = true;
  bool contacts_rise_at_run = false;  // those of edges whose bit is ON
  bool timers_count_at_once = false;  // in the scan that turns them ON
  bool kept_timers_hold = false;      // the latched ones, their value while OFF; else it is 0
  bool all_timers_hold = false;
  bool timers_count_on = false;     // beyond the preset
  bool empty_presets_close = true;  // of 0 or less
  /// Axes of C (C21): while M8000 is OFF, whenever they are free, or never.
  enum class PlcMoves : std::uint8_t {
    while_c_rests,
    any_axis,
    only_others
  } plc_moves = PlcMoves::while_c_rests;

  // --- step programs ----------------------------------------------------------------------------------
  int slice = 64;                      // instructions of a program in a tick
  bool jumps_end_slice = true;         // those that are taken, CAL and RET
  bool pointer_moves_running = false;  // D8000 and D8x00 written while the program runs
  int call_depth = 16;
  enum class LooseReturn : std::uint8_t {
    stops_program,
    is_ignored
  } loose_return = LooseReturn::stops_program;
  /// CAL with a count below 1.
  enum class NoPasses : std::uint8_t { are_skipped, mean_endless } no_passes = NoPasses::are_skipped;
  /// Motion of an axis that the program does not own (C21).
  enum class NotOwned : std::uint8_t { is_void, stops_program } not_owned = NotOwned::is_void;
  /// START of an empty area.
  enum class EmptyProgram : std::uint8_t {
    ends_silently,
    is_an_error
  } empty_program = EmptyProgram::ends_silently;
  /// What loads F, plane, speeds and modes anew.
  enum class FreshStart : std::uint8_t { pointer_at_0, every_start } fresh_start = FreshStart::pointer_at_0;
  bool mark_is_by_own_field = false;    // of an axis program; else by the first one
  bool wheel_ends_single_step = false;  // MPG
  bool waits_follow_registers = false;  // TMR D, while it waits
  bool waits_stand_inhibited = false;   // TMR under M8004
  /// A start in the midst of a line goes on behind it, or stops the program.
  bool starts_inside_lines = false;
  bool marks_by_rpm = true;        // MRK, to its target; else by X14 alone
  bool contact_off_stops = false;  // M8x00 OFF, of an axis program; else it pauses
  bool start_begins_anew = false;  // STR, of a program that runs
  bool c3p_is_in_xy = false;       // whatever plane is set
  bool joins_paths = false;        // with D9005 ON, LIN and arcs that follow each other
  bool rotation_0_waits = true;    // VDRV 0 until its axes stand
  bool continuous_by_key = true;   // M8600 as M8007

  bool operator==(const Options&) const = default;
};

/// Whether a field of RPM changes the speed of its axis.
constexpr bool sets_speed(const std::optional<std::int32_t>& rpm, const Options& options) {
  return rpm && (*rpm > 0 || !options.rpm_0_keeps_speed);
}

/// The number of an area's first step, as D8095 and D8096 count.
constexpr int base_of(Area area, const Options& options) {
  if (options.bases == Options::Bases::each_from_0) return 0;
  return options.bases == Options::Bases::newer ? row_of(area).base : row_of(area).older_base;
}

}  // namespace understudy::interpreter::super_40nc
