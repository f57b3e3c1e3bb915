#include "interpreter/slim/slots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

using Kind = Operand::Kind;

constexpr std::array<std::string_view, 8> kConditionWords{"I", "NI", "Z", "NZ", "E", "NE", "G", "NG"};

struct Range {
  double least;
  double most;
};

/// Of a slot that takes a constant; nothing for other slots.
constexpr std::optional<Range> whole_range(Slot slot, int variant) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  switch (slot) {
    case Slot::input:
    case Slot::maybe_input: return Range{1, kInputCount};
    case Slot::dip_switch: return Range{1, kSwitchCount};
    case Slot::line:
    case Slot::milliseconds: return Range{0, kMost};
    case Slot::pulse_width: return Range{1, 65535};
    case Slot::thrust_level: return Range{1, 20000};
    case Slot::levels: return Range{0, (1 << kPortCount) - 1};
    case Slot::axis_module: return Range{0, 8};
    case Slot::flag: return Range{0, 1};
    case Slot::whole: return Range{kIntegerLeast, kIntegerMost};
    case Slot::variant: return Range{static_cast<double>(variant), static_cast<double>(variant)};
    case Slot::none:
    case Slot::real:
    case Slot::real_variable:
    case Slot::port:
    case Slot::address:
    case Slot::maybe_address:
    case Slot::integer_variable:
    case Slot::variable:
    case Slot::stored_variable:
    case Slot::comparand:
    case Slot::data:
    case Slot::frequency:
    case Slot::percent:
    case Slot::event:
    case Slot::condition:
    case Slot::word:
    case Slot::text: return std::nullopt;
  }
  return std::nullopt;
}

constexpr std::optional<Range> real_range(Slot slot) {
  constexpr double kMost = std::numeric_limits<float>::max();
  switch (slot) {
    case Slot::real: return Range{-kMost, kMost};
    case Slot::frequency: return Range{1e-6, 1e6};  // in kHz 0.001 Hz, in Hz what ticks are told
    case Slot::percent: return Range{0, 100};
    case Slot::none:
    case Slot::real_variable:
    case Slot::port:
    case Slot::input:
    case Slot::maybe_input:
    case Slot::dip_switch:
    case Slot::address:
    case Slot::maybe_address:
    case Slot::line:
    case Slot::integer_variable:
    case Slot::variable:
    case Slot::stored_variable:
    case Slot::comparand:
    case Slot::data:
    case Slot::milliseconds:
    case Slot::pulse_width:
    case Slot::thrust_level:
    case Slot::levels:
    case Slot::axis_module:
    case Slot::flag:
    case Slot::whole:
    case Slot::variant:
    case Slot::event:
    case Slot::condition:
    case Slot::word:
    case Slot::text: return std::nullopt;
  }
  return std::nullopt;
}

/// Of an integer variable.
constexpr Range integer_range(const Dialect& dialect) {
  return {static_cast<double>(dialect.integer_least), kIntegerMost};
}

constexpr bool is_constant(const Operand& operand) {
  return operand.kind == Kind::integer || operand.kind == Kind::real;
}

Error in_range(double number, Range range) {
  return number >= range.least && number <= range.most ? Error::none : Error::range;
}

Error check_whole(const Operand& operand, Range range) {
  if (operand.kind == Kind::integer) return in_range(operand.number, range);
  // Digits beyond what a whole number holds are a wrong value, a fraction is another kind of thing.
  const bool is_huge = operand.kind == Kind::real && std::abs(operand.number) >= 0x1p53;
  return is_huge ? Error::range : Error::syntax;
}

Error check_real(Operand& operand, Range range) {
  if (!is_constant(operand)) return Error::syntax;
  operand.kind = Kind::real;
  operand.number = rounded_real(operand.number);
  return in_range(operand.number, range);
}

/// A constant, variable or function for a variable of one type.
Error check_typed(Operand& operand, bool for_integer, const Dialect& dialect) {
  switch (operand.kind) {
    case Kind::integer:
    case Kind::real:
      if (for_integer) return check_whole(operand, integer_range(dialect));
      return check_real(operand, *real_range(Slot::real));
    case Kind::integer_variable:
    case Kind::integer_array:
    case Kind::get_integer: return for_integer ? Error::none : Error::syntax;
    case Kind::real_variable:
    case Kind::real_array:
    case Kind::get_real: return for_integer ? Error::syntax : Error::none;
    case Kind::analog:
    case Kind::clock: return Error::none;
    case Kind::quantity: return dialect.quantities ? Error::none : Error::syntax;
    case Kind::port:
    case Kind::label:
    case Kind::text:
    case Kind::event:
    case Kind::condition: return Error::syntax;
  }
  return Error::syntax;
}

/// What an assignment gives. A real variable takes integers, too; a parameter takes any number.
Error check_data(Operand& operand, const Operand* target, const Dialect& dialect) {
  const bool is_number = is_constant(operand) || (operand.kind == Kind::quantity && dialect.quantities) ||
                         is_variable(operand.kind) || operand.kind == Kind::analog ||
                         operand.kind == Kind::clock || asks_host(operand.kind);
  if (!is_number) return Error::syntax;
  if (target == nullptr) {
    const Range range = *real_range(Slot::real);
    if (is_constant(operand)) operand.number = rounded_real(operand.number);
    return is_constant(operand) ? in_range(operand.number, range) : Error::none;
  }
  if (holds_integer(target->kind)) return check_typed(operand, true, dialect);
  return is_constant(operand) ? check_typed(operand, false, dialect) : Error::none;
}

Error check_slot(Slot slot, const CommandRow& row, Operand& operand, const Dialect& dialect) {
  if (const std::optional<Range> range = whole_range(slot, row.variant)) {
    const Error error = check_whole(operand, *range);
    const bool is_gap = slot == Slot::axis_module && operand.number > 5 && operand.number < 8;
    return error == Error::none && is_gap ? Error::range : error;
  }
  if (const std::optional<Range> range = real_range(slot)) {
    const bool takes_variable =
        row.takes_module() && (row.verb == Verb::move_absolute || row.verb == Verb::move_relative) &&
        dialect.module_move_from_variable == Dialect::ModuleMoveFromVariable::accepted;
    if (takes_variable && operand.kind == Kind::real_variable) return Error::none;
    return check_real(operand, *range);
  }
  const auto is = [&](bool right) { return right ? Error::none : Error::syntax; };
  switch (slot) {
    case Slot::real_variable: return is(operand.kind == Kind::real_variable);
    case Slot::port: return is(operand.kind == Kind::port);
    case Slot::event:
      if (operand.kind != Kind::event) return Error::syntax;
      return operand.index <= dialect.event_count ? Error::none : Error::range;
    case Slot::integer_variable: return is(holds_integer(operand.kind));
    case Slot::variable: return is(is_variable(operand.kind));
    case Slot::stored_variable: return is(is_variable(operand.kind) && !is_array(operand.kind));
    case Slot::address:
    case Slot::maybe_address:
      return operand.kind == Kind::label ? Error::none : check_whole(operand, *whole_range(Slot::line, 0));
    case Slot::none:
    case Slot::real:
    case Slot::input:
    case Slot::maybe_input:
    case Slot::dip_switch:
    case Slot::line:
    case Slot::comparand:
    case Slot::data:
    case Slot::milliseconds:
    case Slot::pulse_width:
    case Slot::frequency:
    case Slot::percent:
    case Slot::thrust_level:
    case Slot::levels:
    case Slot::axis_module:
    case Slot::flag:
    case Slot::whole:
    case Slot::variant:
    case Slot::condition:
    case Slot::word:
    case Slot::text: return Error::syntax;
  }
  return Error::syntax;
}

/// Syntax weighs more than range: what is not a command at all has no value that could be wrong.
void add_error(Error& sum, Error error) {
  if (sum == Error::none || error == Error::syntax) sum = error;
}

/// One after the other, until a syntax error.
class Matching {
 public:
  Matching(const CommandRow& row, std::span<const std::string_view> items, const Operand* target,
           const Dialect& dialect)
      : row_(row), items_(items), target_(target), dialect_(dialect) {}

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

 private:
  void take(Slot slot) {
    if (items_.empty()) return add_error(result_.error, Error::syntax);
    switch (slot) {
      case Slot::word: return take_word_of_name();
      case Slot::text: return take_text();
      case Slot::condition: return take_condition();
      case Slot::comparand: return take_comparand();
      case Slot::data: return take_data();
      case Slot::event: return take_event();
      case Slot::none:
      case Slot::real:
      case Slot::real_variable:
      case Slot::port:
      case Slot::input:
      case Slot::maybe_input:
      case Slot::dip_switch:
      case Slot::address:
      case Slot::maybe_address:
      case Slot::line:
      case Slot::integer_variable:
      case Slot::variable:
      case Slot::stored_variable:
      case Slot::milliseconds:
      case Slot::pulse_width:
      case Slot::frequency:
      case Slot::percent:
      case Slot::thrust_level:
      case Slot::levels:
      case Slot::axis_module:
      case Slot::flag:
      case Slot::whole:
      case Slot::variant: return take_one(slot);
    }
  }
  void take_one(Slot slot) {
    Item item = next_item();
    if (item.error == Error::none) {
      item.error = is_printed_constant(slot, item.operand)
                       ? check_slot(Slot::real, row_, item.operand, dialect_)
                       : check_slot(slot, row_, item.operand, dialect_);
    }
    add(std::move(item));
  }

  /// The form of SAA is printed with Rx,Ry and fa,fz, and explained with four variables.
  bool is_printed_constant(Slot slot, const Operand& operand) const {
    return row_.verb == Verb::helix_absolute && slot == Slot::real_variable && is_constant(operand) &&
           result_.operands.size() >= 2 && dialect_.helix_constants;
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

  void take_word_of_name() {
    const std::string_view word = row_.command.substr(row_.command.find(' ') + 1);
    if (in_capitals(items_.front()) != word) add_error(result_.error, Error::syntax);
    items_ = items_.subspan(1);
  }
  void take_text() {
    if (!begins_with_quote(items_.front())) return add_error(result_.error, Error::syntax);
    add(parse_text(items_.front()));
    items_ = items_.subspan(1);
  }
  void take_data() {
    // The DATA command names the variable itself.
    const Operand* target = result_.operands.empty() ? target_ : &result_.operands.back();
    Item item = next_item();
    if (item.error == Error::none) item.error = check_data(item.operand, target, dialect_);
    add(std::move(item));
  }
  void take_comparand() {
    Item item = next_item();
    if (items_.empty()) return add_error(result_.error, Error::syntax);
    const Item variable = parse_item(items_.front());
    const bool is_known = item.error == Error::none && variable.error == Error::none;
    if (is_known) item.error = check_typed(item.operand, holds_integer(variable.operand.kind), dialect_);
    add(std::move(item));
  }
  /// A blank, not a comma, is between an event and its condition.
  void take_event() {
    const std::string_view first = items_.front();
    const std::size_t blank = std::min(first.find(' '), first.find('\t'));
    const bool has_condition = row_.slots[1] == Slot::condition;
    if (has_condition != (blank != std::string_view::npos)) return add_error(result_.error, Error::syntax);
    Item item = parse_item(first.substr(0, blank));
    if (item.error == Error::none) item.error = check_slot(Slot::event, row_, item.operand, dialect_);
    add(std::move(item));
    if (has_condition) {
      condition_ = without_blanks(first.substr(blank));
    } else {
      items_ = items_.subspan(1);
    }
  }
  /// Its word is in the same item as the event; what follows is checked like the operands of a jump.
  void take_condition() {
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
    // An event is looked at every tick; it cannot wait for the host.
    if (asks_host(kind)) add_error(result_.error, Error::syntax);
    take(Slot::variable);
  }

  const CommandRow& row_;
  std::span<const std::string_view> items_;
  const Operand* target_;
  const Dialect& dialect_;
  std::string_view condition_ = {};
  Operands result_ = {};
};

}  // namespace

Operands match_slots(const CommandRow& row, std::span<const std::string_view> items, const Operand* target,
                     const Dialect& dialect) {
  return Matching(row, items, target, dialect).run();
}

std::string_view condition_word(Condition condition) {
  return kConditionWords[static_cast<std::size_t>(condition)];
}

}  // namespace understudy::interpreter::slim
