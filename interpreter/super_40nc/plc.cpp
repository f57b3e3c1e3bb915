#include "interpreter/super_40nc/plc.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "base/program_watch.h"
#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/ladder.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/numbers.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/plc_lines.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::interpreter::super_40nc {
namespace {

/// The memory of a timer that no scan has executed since RUN.
constexpr std::int32_t kNotTimedYet = INT32_MIN;
constexpr auto kWatchedPart = static_cast<int>(Area::plc);

/// The working data of a scan: pointers to cells and constants, and shift registers of bits for blocks and
/// branches, whose bit 0 is the top.
class Scan {
 public:
  Scan(PlcState& plc, const Ladder& ladder, Machine& machine, StepControl& programs, const Options& options)
      : plc_(plc),
        machine_(machine),
        cells_(machine.cells().data()),
        banks_{cells_, ladder.constants().data()},
        lines_(plc, ladder, machine, programs, options),
        options_(options),
        depth_mask_((std::uint64_t{1} << stack_depth(options)) - 1),
        a_unit_is_over_(plc.unit_ms + scan_ms(options) >= timer_unit_ms(options)),
        growth_(timer_unit_ms(options) <= 1 ? scan_ms(options) : 1) {}

  /// `is_watched`: an observer is notified of each step. Expensive calls are inlined in both variants. With
  /// two callers, the compiler would not inline them on its own, and a scan would take a fifth longer.
  template <bool is_watched>
  void steps(const LadderStep* step) {
    for (;; ++step) {
      if constexpr (is_watched) begin(*step);
      switch (step->act) {
        case Act::load: push(reported<is_watched>(*step, contact(*step) != inverted(*step))); break;
        case Act::series:
          blocks_ &= ~std::uint64_t{1} | bit(reported<is_watched>(*step, contact(*step) != inverted(*step)));
          break;
        case Act::parallel:
          blocks_ |= bit(reported<is_watched>(*step, contact(*step) != inverted(*step)));
          break;
        case Act::load_edge: push(reported<is_watched>(*step, edge(*step))); break;
        case Act::series_edge:
          blocks_ &= ~std::uint64_t{1} | bit(reported<is_watched>(*step, edge(*step)));
          break;
        case Act::parallel_edge: blocks_ |= bit(reported<is_watched>(*step, edge(*step))); break;
        case Act::load_comparison: push(reported<is_watched>(*step, holds(*step))); break;
        case Act::series_comparison:
          blocks_ &= ~std::uint64_t{1} | bit(reported<is_watched>(*step, holds(*step)));
          break;
        case Act::parallel_comparison: blocks_ |= bit(reported<is_watched>(*step, holds(*step))); break;
        case Act::join_series: blocks_ = (blocks_ >> 1) & (~std::uint64_t{1} | blocks_); break;
        case Act::join_parallel: blocks_ = (blocks_ >> 1) | (blocks_ & 1); break;
        case Act::branch: branches_ = (branches_ << 1) | (blocks_ & 1); break;
        case Act::branch_again: blocks_ = (blocks_ & ~std::uint64_t{1}) | (branches_ & 1); break;
        case Act::branch_last:
          blocks_ = (blocks_ & ~std::uint64_t{1}) | (branches_ & 1);
          branches_ >>= 1;
          break;
        case Act::invert: blocks_ ^= 1; break;
        case Act::out: put(step->c, static_cast<std::uint32_t>(blocks_ & 1), step->flags); break;
        case Act::set:
          if (result()) put(step->c, 1, step->flags);
          break;
        case Act::reset:
          if (result()) put(step->c, 0, step->flags);
          break;
        case Act::timer: time(*step); break;
        case Act::counter: count(*step); break;
        case Act::move:
          if (result()) put(step->c, plain(step->bank_a, step->a), step->flags);
          break;
        case Act::add:
          if (result()) {
            put(step->c, plain(step->bank_a, step->a) + plain(step->bank_b, step->b), step->flags);
          }
          break;
        case Act::subtract:
          if (result()) {
            put(step->c, plain(step->bank_a, step->a) - plain(step->bank_b, step->b), step->flags);
          }
          break;
        case Act::general: has_changed_ |= lines_.carry_out(*step, result()); break;
        case Act::end: return;
      }
    }
  }

  Scanned ended() {
    has_changed_ |= lines_.end_scan();
    plc_.unit_ms = timers_run_ && !a_unit_is_over_ ? plc_.unit_ms + scan_ms(options_) : 0;
    return {has_changed_, has_changed_ ? 0 : quiet_scans_};
  }

 private:
  void begin(const LadderStep& step) const {
    if (step.line != kNoLine) machine_.watch()->runs(kWatchedPart, step.line, 1);
  }
  template <bool is_watched>
  bool reported(const LadderStep& step, bool conducts) const {
    if constexpr (is_watched) machine_.watch()->decides(kWatchedPart, step.line, conducts, 1);
    return conducts;
  }

  static std::uint64_t bit(bool value) { return value ? 1 : 0; }
  bool result() const { return (blocks_ & 1) != 0; }
  void push(bool value) { blocks_ = ((blocks_ << 1) & depth_mask_) | bit(value); }

  static bool inverted(const LadderStep& step) { return (step.flags & kInverted) != 0; }
  [[gnu::always_inline]] bool contact(const LadderStep& step) const {
    if (step.bank_a == Bank::special) [[unlikely]] {
      return machine_.special_contact(static_cast<int>(step.a));
    }
    return banks_[static_cast<std::size_t>(step.bank_a)][step.a] != 0;
  }

  std::uint32_t plain(Bank bank, std::uint32_t at) const {
    return banks_[static_cast<std::size_t>(bank)][at];
  }
  [[gnu::always_inline]] std::uint32_t value(Bank bank, std::uint32_t at) const {
    if (bank == Bank::special) [[unlikely]] {
      return static_cast<std::uint32_t>(machine_.special_register(static_cast<int>(at)));
    }
    return plain(bank, at);
  }
  [[gnu::always_inline]] bool holds(const LadderStep& step) const {
    const auto first = static_cast<std::int32_t>(value(step.bank_a, step.a));
    const auto second = static_cast<std::int32_t>(value(step.bank_b, step.b));
    return (relation_of(first, second) & step.flags) != 0;
  }

  /// Returns true at the bit's rising or falling edge.
  [[gnu::always_inline]] bool edge(const LadderStep& step) {
    const bool is_on = contact(step);
    const bool was_on = remember(step.memory, is_on);
    return is_on != was_on && is_on == ((step.flags & kFalling) == 0);
  }
  bool remember(std::uint16_t memory, bool is_on) {
    std::uint8_t& kept = plc_.memories[memory];
    const bool was_on = kept != 0;
    kept = is_on ? 1 : 0;
    has_changed_ |= is_on != was_on;
    return was_on;
  }

  [[gnu::always_inline]] void put(std::uint32_t cell, std::uint32_t value, std::uint8_t flags) {
    if (cells_[cell] == value) return;
    cells_[cell] = value;
    has_changed_ = true;
    if ((flags & kRetentive) != 0) machine_.retentive_cell_written(cell);
  }

  /// Runs a timer. Its value is 0 in the scan in which it is switched on, and increases in each later scan.
  [[gnu::always_inline]] void time(const LadderStep& step) {
    const bool is_on = result();
    const bool was_on = remember(step.memory, is_on);
    const bool holds_value =
        options_.chose(option("kept_timers", "all_timers_keep_it")) ||
        (options_.chose(option("kept_timers", "keep_their_value")) && (step.flags & kRetentive) != 0);
    if (!is_on && holds_value) return;
    if ((!is_on || !was_on) && !holds_value) put(step.c, 0, step.flags);
    if (!is_on) return put(step.a, 0, step.flags);
    if (was_on) undo_write(step);
    const bool counts = was_on || options_.chose(option("timer_first_scan", "counts"));
    const auto preset = static_cast<std::int32_t>(value(step.bank_b, step.b));
    auto present = static_cast<std::int32_t>(cells_[step.c]);
    if (counts && (present < preset || options_.chose(option("timer_past_preset", "counts_on"))) &&
        a_unit_is_over_) {
      const bool had_changed = has_changed_;
      const std::int32_t max = options_.chose(option("timer_past_preset", "counts_on")) ? INT32_MAX : preset;
      present = static_cast<std::int32_t>(std::min<std::int64_t>(max, std::int64_t{present} + growth_));
      put(step.c, static_cast<std::uint32_t>(present), step.flags);
      if ((step.flags & kValueIsRead) == 0 && present < preset) has_changed_ = had_changed;
    }
    put(step.a, closes(present, preset) ? 1 : 0, step.flags);
    if (options_.chose(option("timer_write", "ignored"))) timed(step) = present;
    if (present < preset) {
      timers_run_ |= was_on;
      const std::int64_t left = std::int64_t{preset} - present - 1;
      quiet_scans_ =
          std::min(quiet_scans_, timer_unit_ms(options_) <= 1 && scan_ms(options_) == 1 ? left : 0);
      if ((step.flags & kValueIsRead) != 0) quiet_scans_ = 0;
    }
  }

  bool closes(std::int32_t present, std::int32_t preset) const {
    return present >= preset &&
           (preset > 0 || !options_.chose(option("preset_not_positive", "never_closes")));
  }

  std::int32_t& timed(const LadderStep& step) {
    if (plc_.timed.size() <= step.memory) plc_.timed.resize(std::size_t{step.memory} + 1, kNotTimedYet);
    return plc_.timed[step.memory];
  }
  /// Undoes a write to the timer's value if a choice ignores such writes.
  void undo_write(const LadderStep& step) {
    if (!options_.chose(option("timer_write", "ignored")) || timed(step) == kNotTimedYet) return;
    put(step.c, static_cast<std::uint32_t>(timed(step)), step.flags);
  }

  [[gnu::always_inline]] void count(const LadderStep& step) {
    const bool is_on = result();
    const bool was_on = remember(step.memory, is_on);
    const auto preset = static_cast<std::int32_t>(value(step.bank_b, step.b));
    auto present = static_cast<std::int32_t>(cells_[step.c]);
    const bool may_count =
        options_.chose(option("counter_past_preset", "counts_on")) ? present < INT32_MAX : present < preset;
    const bool counts = is_on && !was_on && !plc_.is_first_scan && may_count;
    if (counts) put(step.c, static_cast<std::uint32_t>(++present), step.flags);
    if (options_.chose(option("counter_contact", "compares_at_each_scan"))) {
      put(step.a, closes(present, preset) ? 1 : 0, step.flags);
    } else if (counts && closes(present, preset)) {
      put(step.a, 1, step.flags);
    }
  }

  PlcState& plc_;
  Machine& machine_;
  std::uint32_t* cells_;
  const std::uint32_t* banks_[2];
  PlcLines lines_;
  const Options& options_;
  std::uint64_t depth_mask_;
  bool a_unit_is_over_;
  std::int32_t growth_;  // the increase of a timer in this scan
  std::uint64_t blocks_ = 0;
  std::uint64_t branches_ = 0;
  bool has_changed_ = false;
  bool timers_run_ = false;
  std::int64_t quiet_scans_ = INT64_MAX;
};

}  // namespace

void run(PlcState& plc, const Ladder& ladder, Machine& machine, const Options& options) {
  const Access access(machine);
  plc.runs = true;
  plc.is_first_scan = true;
  plc.memories.assign(ladder.memory_count(), 0);
  plc.timed.clear();
  for (const LadderStep& step : ladder.steps()) {
    const bool is_edge = step.act >= Act::load_edge && step.act <= Act::parallel_edge;
    const bool sees_present = !options.chose(option("run_contact_edges", "those_that_are_on_rise"));
    if (is_edge && sees_present)
      plc.memories[step.memory] = access.contact(ladder.line(step.line).fields[0]) ? 1 : 0;
    // A timer that is still ON continues.
    if (step.act == Act::timer) plc.memories[step.memory] = machine.cells()[step.c] != 0 ? 1 : 0;
  }
  if (options.chose(option("plc_modes", "stay")) && std::exchange(plc.has_modes, true)) return;
  plc.targets = machine.parameter_in_force(named::kTargetsOfC) == 0 ? Targets::absolute : Targets::relative;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    plc.rpm[static_cast<std::size_t>(axis)] = machine.rpm_at_power_up(axis);
  }
}

void stop(PlcState& plc, Machine& machine) {
  plc.runs = false;
  if (plc.jogs == Jogs{}) return;
  plc.jogs = {};
  machine.plc_jog({}, {});
}

Scanned scan(PlcState& plc, const Ladder& ladder, Machine& machine, StepControl& programs,
             const Options& options) {
  if (!plc.runs) return {};
  if (plc.memories.size() != ladder.memory_count()) plc.memories.assign(ladder.memory_count(), 0);
  Scan scan(plc, ladder, machine, programs, options);
  const LadderStep* const first = ladder.steps().data();
  machine.watch() == nullptr ? scan.steps<false>(first) : scan.steps<true>(first);
  Scanned scanned = scan.ended();
  if (plc.is_first_scan) scanned = {true, 0};
  plc.is_first_scan = false;
  return scanned;
}

namespace {

/// Returns true if a contact is ON in scans that change nothing, and so have no edges.
bool conducts_quietly(const Instruction& line, const Access& access) {
  if (const Relations relations = relations_of(line.op); relations != 0) {
    return (relation_of(access.value(line.fields[0]), access.value(line.fields[1])) & relations) != 0;
  }
  return access.contact(line.fields[0]) != is_inverted(line.op);
}

void report_skipped(const Ladder& ladder, const Machine& machine, const Access& access, std::int64_t scans) {
  for (const LadderStep& step : ladder.steps()) {
    if (step.line == kNoLine) continue;
    machine.watch()->runs(kWatchedPart, step.line, scans);
    if (step.act > Act::parallel_comparison) continue;
    const bool is_edge = step.act >= Act::load_edge && step.act <= Act::parallel_edge;
    machine.watch()->decides(kWatchedPart, step.line,
                             !is_edge && conducts_quietly(ladder.line(step.line), access), scans);
  }
}

}  // namespace

void fast_forward(PlcState& plc, const Ladder& ladder, Machine& machine, std::int64_t scans,
                  const Options& options) {
  if (!plc.runs) return;
  const std::span<std::uint32_t> cells = machine.cells();
  const Access access(machine);
  if (machine.watch() != nullptr) report_skipped(ladder, machine, access, scans);
  for (const std::uint32_t index : ladder.timers()) {
    const LadderStep& timer = ladder.steps()[index];
    if (plc.memories[timer.memory] == 0 || timer_unit_ms(options) > 1) continue;
    const std::int64_t preset = access.value(ladder.line(timer.line).fields[1]);
    const std::int64_t present = static_cast<std::int32_t>(cells[timer.c]);
    if (present >= preset) continue;
    const bool is_retentive = (timer.flags & kRetentive) != 0;
    // A retentive value is saved in each scan, so the scans are counted one by one.
    for (std::int64_t scan = is_retentive ? 1 : scans; scan <= scans; ++scan) {
      cells[timer.c] = static_cast<std::uint32_t>(present + scan);
      if (is_retentive) machine.retentive_cell_written(timer.c);
    }
    if (options.chose(option("timer_write", "ignored")) && timer.memory < plc.timed.size())
      plc.timed[timer.memory] = static_cast<std::int32_t>(cells[timer.c]);
  }
}

}  // namespace understudy::interpreter::super_40nc
