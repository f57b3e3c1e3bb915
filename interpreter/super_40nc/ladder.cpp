#include "interpreter/super_40nc/ladder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/numbers.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/plc_lines.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/structure.h"

namespace understudy::interpreter::super_40nc {
namespace {

constexpr bool is_edge_contact(Op op) {
  return op == Op::ldp || op == Op::ldf || op == Op::orp || op == Op::orf || op == Op::anp || op == Op::anf;
}
constexpr bool is_falling(Op op) { return op == Op::ldf || op == Op::orf || op == Op::anf; }
constexpr bool is_plain(Operand operand) { return !is_special(operand); }

/// Instructions that have a special kind of step if the device that they switch or write is a plain one.
constexpr std::pair<Op, Act> kActs[] = {
    {Op::anb, Act::join_series},  {Op::orb, Act::join_parallel}, {Op::mps, Act::branch},
    {Op::mrd, Act::branch_again}, {Op::mpp, Act::branch_last},   {Op::inv, Act::invert},
    {Op::out, Act::out},          {Op::set, Act::set},           {Op::rst, Act::reset},
    {Op::mov, Act::move},         {Op::add, Act::add},           {Op::sub, Act::subtract}};

constexpr Act at(Place place, Act begins) {
  return static_cast<Act>(static_cast<int>(begins) + static_cast<int>(place));
}

}  // namespace

class LadderMaker {
 public:
  LadderMaker(Ladder& ladder, const CellLayout& layout, const Options& options)
      : ladder_(ladder), layout_(layout), options_(options) {}

  void run() {
    ladder_.steps_.clear();
    int step = base_of(Area::plc, options_);
    LadderStep end;
    bool is_over = false;  // lines after END are kept, but never run
    for (std::size_t i = 0; i < ladder_.program_.lines.size(); ++i) {
      const Instruction& line = ladder_.program_.lines[i];
      ladder_.step_numbers_.push_back(step);
      step += steps_of(line);
      if (line.op == Op::end && !is_over) end.line = static_cast<std::uint16_t>(i);
      is_over |= line.op == Op::end;
      if (is_over || line.op == Op::nop) continue;
      make(line, static_cast<std::uint16_t>(i));
      note_reads(line);
    }
    ladder_.steps_.push_back(end);
    for (const auto& [letter, number] : reads_) ladder_.reads_.push_back({letter, number});
    check_timers();
  }

 private:
  std::uint16_t new_memory() { return static_cast<std::uint16_t>(ladder_.memory_count_++); }
  std::uint16_t memory_of(Operand bit) {
    if (!options_.chose(option("edge_memory", "the_bit_so_the_first_takes_the_edge"))) return new_memory();
    const auto [known, is_new] = memories_.try_emplace({bit.letter, bit.number});
    if (is_new) known->second = new_memory();
    return known->second;
  }
  bool has_memory(Op op) const {
    const ConditionUse how = row_of(op).in_plc;
    return how == ConditionUse::rising_edge || how == ConditionUse::falling_edge || needs_edge(op, options_);
  }

  std::uint32_t constant(std::int32_t value) {
    ladder_.constants_.push_back(static_cast<std::uint32_t>(value));
    return static_cast<std::uint32_t>(ladder_.constants_.size() - 1);
  }

  std::tuple<Bank, std::uint32_t> contact(Operand operand) {
    const bool is_always_on = operand.letter == Letter::m && operand.number == named::kAlwaysOn;
    if (is_always_on) return {Bank::constants, constant(1)};
    if (is_special(operand)) return {Bank::special, static_cast<std::uint32_t>(operand.number)};
    return {Bank::cells, contact_cell(layout_, operand)};
  }
  std::tuple<Bank, std::uint32_t> value(Operand operand) {
    if (operand.letter == Letter::k) return {Bank::constants, constant(operand.number)};
    if (is_special(operand)) return {Bank::special, static_cast<std::uint32_t>(operand.number)};
    return {Bank::cells, value_cell(layout_, operand)};
  }

  void make(const Instruction& line, std::uint16_t number) {
    LadderStep step;
    step.line = number;
    step.act = Act::general;
    const auto& [first, second, third, fourth] = line.fields;
    const Place place = place_of(line.op);
    if (relations_of(line.op) != 0) {
      step.act = at(place, Act::load_comparison);
      step.flags = relations_of(line.op);
      std::tie(step.bank_a, step.a) = value(first);
      std::tie(step.bank_b, step.b) = value(second);
    } else if (is_edge_contact(line.op)) {
      step.act = at(place, Act::load_edge);
      step.flags = is_falling(line.op) ? kFalling : 0;
      std::tie(step.bank_a, step.a) = contact(first);
      step.memory = memory_of(first);
    } else if (is_contact(line.op)) {
      step.act = at(place, Act::load);
      step.flags = is_inverted(line.op) ? kInverted : 0;
      std::tie(step.bank_a, step.a) = contact(first);
    } else {
      make_other(line, step);
    }
    if (step.act == Act::general && has_memory(line.op)) step.memory = new_memory();
    ladder_.steps_.push_back(step);
  }

  void make_other(const Instruction& line, LadderStep& step) {
    for (const auto& [op, act] : kActs) {
      if (op != line.op) continue;
      if (act <= Act::invert) {
        step.act = act;
      } else if (act <= Act::reset) {
        make_switch(line, act, step);
      } else {
        make_sum(line, act, act == Act::move ? 1 : 2, step);
      }
    }
    if (line.op == Op::out_tc) make_count(line, step);
  }

  void make_switch(const Instruction& line, Act act, LadderStep& step) {
    const Operand bit = line.fields[0];
    const bool is_counting = bit.letter == Letter::t || bit.letter == Letter::c;
    if (is_counting || is_special(bit)) return;
    step.act = act;
    step.c = contact_cell(layout_, bit);
    step.flags = is_retentive(bit) ? kRetentive : 0;
  }

  /// Creates the step of a timer or counter: a is the contact, b the preset, c the value.
  void make_count(const Instruction& line, LadderStep& step) {
    const Operand what = line.fields[0];
    const bool is_timer = what.letter == Letter::t;
    step.act = is_timer ? Act::timer : Act::counter;
    step.a = contact_cell(layout_, what);
    std::tie(step.bank_b, step.b) = value(line.fields[1]);
    step.c = value_cell(layout_, what);
    step.flags = is_retentive(what) ? kRetentive : 0;
    step.memory = new_memory();
    if (is_timer) ladder_.timers_.push_back(static_cast<std::uint32_t>(ladder_.steps_.size()));
  }

  void make_sum(const Instruction& line, Act act, std::size_t target, LadderStep& step) {
    if (act != Act::move && options_.chose(option("sum_size", "saturates"))) return;
    for (std::size_t i = 0; i <= target; ++i) {
      if (!is_plain(line.fields[i])) return;
    }
    step.act = act;
    std::tie(step.bank_a, step.a) = value(line.fields[0]);
    if (target == 2) std::tie(step.bank_b, step.b) = value(line.fields[1]);
    step.c = value_cell(layout_, line.fields[target]);
    step.flags = is_retentive(line.fields[target]) ? kRetentive : 0;
  }

  void note(Operand first, std::int64_t count = 1) {
    const Block* const block = block_of(first);
    if (block == nullptr) return;
    const std::int64_t last = std::min<std::int64_t>(first.number + count - 1, block->last);
    for (; first.number <= last; ++first.number) reads_.emplace(first.letter, first.number);
  }

  void note_reads(const Instruction& line) {
    const auto& [first, second, third, fourth] = line.fields;
    for (std::size_t i = 0; i < line.fields.size(); ++i) {
      note(line.fields[i]);
      const Slot slot = row_of(line.op).slots[i];
      const bool is_value = slot == Slot::source && line.fields[i].letter == Letter::t;
      if (is_value) timers_read_.insert(value_cell(layout_, line.fields[i]));
    }
    if (line.op == Op::zrst)
      note(first.number < second.number ? first : second,
           std::abs(std::int64_t{second.number} - first.number) + 1);
    if (line.op == Op::div) note(third, 2);
    if (line.op == Op::fmv) note(second, third.letter == Letter::k ? third.number : INT32_MAX);
  }

  /// Marks timers whose value is read, or that another instruction also uses. These timers must not be
  /// skipped.
  void check_timers() {
    std::set<std::uint32_t> seen = timers_read_;
    for (const std::uint32_t index : ladder_.timers_) {
      LadderStep& timer = ladder_.steps_[index];
      if (!seen.insert(timer.c).second) timer.flags |= kValueIsRead;
    }
  }

  Ladder& ladder_;
  const CellLayout& layout_;
  const Options& options_;
  std::set<std::pair<Letter, std::int32_t>> reads_;
  std::map<std::pair<Letter, std::int32_t>, std::uint16_t> memories_;  // edge memories, by bit
  std::set<std::uint32_t> timers_read_;                                // cells of timer values
};

Ladder::Ladder(const AreaProgram& program, const CellLayout& layout, const Options& options)
    : program_(program) {
  LadderMaker(*this, layout, options).run();
}

}  // namespace understudy::interpreter::super_40nc
