#include "interpreter/slim/slots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "base/enumerators.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

using Kind = Operand::Kind;

constexpr std::array<std::string_view, 8> kConditionWords{"I", "NI", "Z", "NZ", "E", "NE", "G", "NG"};

struct Range {
  double min = 0;
  double max = 0;
};
constexpr Range kNoNegatives{0, std::numeric_limits<std::int32_t>::max()};
constexpr Range kAnyReal{-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};

/// The range of an integer variable.
constexpr Range integer_range(const Options& options) {
  return {static_cast<double>(integer_min(options)), kIntegerMax};
}

/// Returns true if the value of a query can also be used as a function: N0=PE, JG VM,R0,$A.
constexpr bool takes_quantities(const Options& options) {
  return options.chose(option("functions", "what_queries_show_too"));
}

constexpr bool is_constant(const Operand& operand) {
  return operand.kind == Kind::integer || operand.kind == Kind::real;
}

Error in_range(double number, Range range) {
  return number >= range.min && number <= range.max ? Error::none : Error::range;
}

Error check_whole(const Operand& operand, Range range) {
  if (operand.kind == Kind::integer) return in_range(operand.number, range);
  // An integer that is too large is a wrong value, whereas a fraction is a different kind of operand.
  const bool is_huge = operand.kind == Kind::real && std::abs(operand.number) >= 0x1p53;
  return is_huge ? Error::range : Error::syntax;
}

Error check_real(Operand& operand, Range range) {
  if (!is_constant(operand)) return Error::syntax;
  operand.kind = Kind::real;
  operand.number = rounded_real(operand.number);
  return in_range(operand.number, range);
}

/// Checks a constant, variable or function that will be compared with or assigned to a variable of one type.
Error check_typed(Operand& operand, bool for_integer, const Options& options) {
  switch (operand.kind) {
    case Kind::integer:
    case Kind::real:
      if (for_integer) return check_whole(operand, integer_range(options));
      return check_real(operand, kAnyReal);
    case Kind::integer_variable:
    case Kind::integer_array:
    case Kind::get_integer: return for_integer ? Error::none : Error::syntax;
    case Kind::real_variable:
    case Kind::real_array:
    case Kind::get_real: return for_integer ? Error::syntax : Error::none;
    case Kind::analog:
    case Kind::clock: return Error::none;
    case Kind::quantity: return takes_quantities(options) ? Error::none : Error::syntax;
    case Kind::port:
    case Kind::label:
    case Kind::text:
    case Kind::event:
    case Kind::condition: return Error::syntax;
  }
  return Error::syntax;
}

/// Checks the value of an assignment. Real variables also accept integers; parameters accept any number.
Error check_data(Operand& operand, const Operand* target, const Options& options) {
  const bool is_number = is_constant(operand) ||
                         (operand.kind == Kind::quantity && takes_quantities(options)) ||
                         is_variable(operand.kind) || operand.kind == Kind::analog ||
                         operand.kind == Kind::clock || asks_host(operand.kind);
  if (!is_number) return Error::syntax;
  if (target == nullptr) {
    if (!is_constant(operand)) return Error::none;
    operand.number = rounded_real(operand.number);
    return in_range(operand.number, kAnyReal);
  }
  if (holds_integer(target->kind)) return check_typed(operand, true, options);
  return is_constant(operand) ? check_typed(operand, false, options) : Error::none;
}

/// Adds an error. Syntax errors take precedence over range errors, because the values of an invalid command
/// do not matter.
void add_error(Error& sum, Error error) {
  if (sum == Error::none || error == Error::syntax) sum = error;
}

/// Matches items with slots, one after another, until a syntax error.
class Matching {
 public:
  Matching(const CommandRow& row, std::span<const std::string_view> items, const Operand* target,
           const Options& options)
      : row_(row), items_(items), target_(target), options_(options) {}

  Operands run() {
    for (const Slot slot : row_.slots) {
      const bool is_over = slot == Slot::none || result_.error == Error::syntax;
      const bool is_optional = slot == Slot::maybe_address || slot == Slot::maybe_input;
      if (is_over || (is_optional && items_.empty())) break;
      take(slot);
    }
    if (!items_.empty()) add_error(result_.error, Error::syntax);
    return std::move(result_);
  }

  static constexpr bool rules_are_in_order();

 private:
  /// How the operand of a slot is read, and how it is checked if the check does not depend on other operands.
  struct Rule {
    Slot slot;
    void (Matching::*take)(Slot) = &Matching::take_one;
    Error (Matching::*check)(Operand&, Range) const = nullptr;
    Range range{};
  };
  static const std::array<Rule, static_cast<std::size_t>(Slot::text) + 1> kRules;  // in the order of Slot

  void take(Slot slot) {
    if (items_.empty()) return add_error(result_.error, Error::syntax);
    (this->*kRules[static_cast<std::size_t>(slot)].take)(slot);
  }
  Error check(Slot slot, Operand& operand) const {
    const Rule& rule = kRules[static_cast<std::size_t>(slot)];
    return (this->*rule.check)(operand, rule.range);
  }

  // --- checks ----------------------------------------------------------------------------------
  static Error is(bool right) { return right ? Error::none : Error::syntax; }
  Error whole(Operand& operand, Range range) const { return check_whole(operand, range); }
  Error variant(Operand& operand, Range /*any*/) const {
    const auto number = static_cast<double>(row_.variant);
    return check_whole(operand, {number, number});
  }
  Error axis_module(Operand& operand, Range range) const {
    const Error error = check_whole(operand, range);
    const bool is_gap = operand.number > 5 && operand.number < 8;
    return error == Error::none && is_gap ? Error::range : error;
  }
  Error real(Operand& operand, Range range) const { return check_real(operand, range); }
  Error real_variable(Operand& operand, Range /*any*/) const {
    return is(operand.kind == Kind::real_variable);
  }
  Error integer_variable(Operand& operand, Range /*any*/) const { return is(holds_integer(operand.kind)); }
  Error variable(Operand& operand, Range /*any*/) const { return is(is_variable(operand.kind)); }
  Error stored_variable(Operand& operand, Range /*any*/) const {
    return is(is_variable(operand.kind) && !is_array(operand.kind));
  }
  Error port(Operand& operand, Range /*any*/) const { return is(operand.kind == Kind::port); }
  Error address(Operand& operand, Range range) const {
    return operand.kind == Kind::label ? Error::none : check_whole(operand, range);
  }
  Error event(Operand& operand, Range /*any*/) const {
    if (operand.kind != Kind::event) return Error::syntax;
    return operand.index <= options_.number(numbers("events")) ? Error::none : Error::range;
  }

  // --- readers ---------------------------------------------------------------------------------
  void take_nothing(Slot /*none*/) { add_error(result_.error, Error::syntax); }
  void take_one(Slot slot) {
    Item item = next_item();
    if (item.error == Error::none)
      item.error = check(is_printed_constant(slot, item.operand) ? Slot::real : slot, item.operand);
    add(std::move(item));
  }

  /// The manual prints the form of SAA with Rx,Ry and fa,fz, but explains it with four variables.
  bool is_printed_constant(Slot slot, const Operand& operand) const {
    return row_.verb == Verb::helix_absolute && slot == Slot::real_variable && is_constant(operand) &&
           result_.operands.size() >= 2 && !options_.chose(option("helix_variables", "four_variables"));
  }

  Item next_item() {
    Item item = parse_item(items_.front());
    items_ = items_.subspan(1);
    return item;
  }
  void add(Item item) {
    if (item.error != Error::none) add_error(result_.error, item.error);
    result_.operands.push_back(std::move(item.operand));
  }

  void take_word_of_name(Slot /*slot*/) {
    const std::string_view word = row_.command.substr(row_.command.find(' ') + 1);
    if (in_capitals(items_.front()) != word) add_error(result_.error, Error::syntax);
    items_ = items_.subspan(1);
  }
  void take_text(Slot /*slot*/) {
    if (!begins_with_quote(items_.front())) return add_error(result_.error, Error::syntax);
    add(parse_text(items_.front()));
    items_ = items_.subspan(1);
  }
  void take_data(Slot /*slot*/) {
    // The DATA command contains the variable as an operand.
    const Operand* target = result_.operands.empty() ? target_ : &result_.operands.back();
    Item item = next_item();
    if (item.error == Error::none) item.error = check_data(item.operand, target, options_);
    add(std::move(item));
  }
  void take_comparand(Slot /*slot*/) {
    Item item = next_item();
    if (items_.empty()) return add_error(result_.error, Error::syntax);
    const Item variable = parse_item(items_.front());
    const bool is_known = item.error == Error::none && variable.error == Error::none;
    if (is_known) item.error = check_typed(item.operand, holds_integer(variable.operand.kind), options_);
    add(std::move(item));
  }
  /// An event and its condition are separated by a blank, not by a comma.
  void take_event(Slot slot) {
    const std::string_view first = items_.front();
    const std::size_t blank = std::min(first.find(' '), first.find('\t'));
    const bool has_condition = row_.slots[1] == Slot::condition;
    if (has_condition != (blank != std::string_view::npos)) return add_error(result_.error, Error::syntax);
    Item item = parse_item(first.substr(0, blank));
    if (item.error == Error::none) item.error = check(slot, item.operand);
    add(std::move(item));
    if (has_condition) {
      condition_ = without_blanks(first.substr(blank));
    } else {
      items_ = items_.subspan(1);
    }
  }
  /// The word of the condition is in the same item as the event. The rest is checked like the operands of a
  /// jump.
  void take_condition(Slot /*slot*/) {
    const auto word = std::ranges::find(kConditionWords, in_capitals(condition_));
    items_ = items_.subspan(1);
    if (word == kConditionWords.end()) return add_error(result_.error, Error::syntax);
    const auto condition = static_cast<Condition>(word - kConditionWords.begin());
    result_.operands.push_back({.kind = Kind::condition, .index = static_cast<int>(condition)});
    switch (condition) {
      case Condition::input_on:
      case Condition::input_off: return take(Slot::input);
      case Condition::zero:
      case Condition::not_zero: return take(Slot::integer_variable);
      case Condition::equal:
      case Condition::not_equal:
      case Condition::greater:
      case Condition::not_greater: return take_comparison();
    }
  }
  void take_comparison() {
    take(Slot::comparand);
    const Kind kind = result_.operands.back().kind;
    // An event is checked every tick, so it cannot wait for the host.
    if (asks_host(kind)) add_error(result_.error, Error::syntax);
    take(Slot::variable);
  }

  const CommandRow& row_;
  std::span<const std::string_view> items_;
  const Operand* target_;
  const Options& options_;
  std::string_view condition_ = {};
  Operands result_ = {};
};

constexpr std::array<Matching::Rule, static_cast<std::size_t>(Slot::text) + 1> Matching::kRules = {{
    {Slot::none, &Matching::take_nothing},
    {Slot::real, &Matching::take_one, &Matching::real, kAnyReal},
    {Slot::real_variable, &Matching::take_one, &Matching::real_variable},
    {Slot::port, &Matching::take_one, &Matching::port},
    {Slot::input, &Matching::take_one, &Matching::whole, {1, kInputCount}},
    {Slot::maybe_input, &Matching::take_one, &Matching::whole, {1, kInputCount}},
    {Slot::dip_switch, &Matching::take_one, &Matching::whole, {1, kSwitchCount}},
    {Slot::address, &Matching::take_one, &Matching::address, kNoNegatives},
    {Slot::maybe_address, &Matching::take_one, &Matching::address, kNoNegatives},
    {Slot::line, &Matching::take_one, &Matching::whole, kNoNegatives},
    {Slot::integer_variable, &Matching::take_one, &Matching::integer_variable},
    {Slot::variable, &Matching::take_one, &Matching::variable},
    {Slot::stored_variable, &Matching::take_one, &Matching::stored_variable},
    {Slot::comparand, &Matching::take_comparand},
    {Slot::data, &Matching::take_data},
    {Slot::milliseconds, &Matching::take_one, &Matching::whole, kNoNegatives},
    {Slot::pulse_width, &Matching::take_one, &Matching::whole, {1, 65535}},
    // The unit is kHz or Hz: 1e-6 kHz is 0.001 Hz, and 1e6 Hz is 1 MHz.
    {Slot::frequency, &Matching::take_one, &Matching::real, {1e-6, 1e6}},
    {Slot::percent, &Matching::take_one, &Matching::real, {0, 100}},
    {Slot::thrust_level, &Matching::take_one, &Matching::whole, {1, 20000}},
    {Slot::levels, &Matching::take_one, &Matching::whole, {0, (1 << kPortCount) - 1}},
    {Slot::axis_module, &Matching::take_one, &Matching::axis_module, {0, 8}},
    {Slot::flag, &Matching::take_one, &Matching::whole, {0, 1}},
    {Slot::whole, &Matching::take_one, &Matching::whole, {kIntegerMin, kIntegerMax}},
    {Slot::variant, &Matching::take_one, &Matching::variant},
    {Slot::event, &Matching::take_event, &Matching::event},
    {Slot::condition, &Matching::take_condition},
    {Slot::word, &Matching::take_word_of_name},
    {Slot::text, &Matching::take_text},
}};

constexpr bool Matching::rules_are_in_order() {
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    const bool is_read_alone = kRules[i].take == &Matching::take_one;
    if (kRules[i].slot != static_cast<Slot>(i) || (is_read_alone && kRules[i].check == nullptr)) return false;
  }
  return true;
}
static_assert(Matching::rules_are_in_order(), "rules must be in the order of Slot, one for each");
static_assert(is_last<Slot::text>(), "rules must be in the order of Slot, one for each");

}  // namespace

Operands match_slots(const CommandRow& row, std::span<const std::string_view> items, const Operand* target,
                     const Options& options) {
  return Matching(row, items, target, options).run();
}

std::string_view condition_word(Condition condition) {
  return kConditionWords[static_cast<std::size_t>(condition)];
}

}  // namespace understudy::interpreter::slim
