#include "emulator/model_file/row_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_values.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/row_shape.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

using models::imported::BitName;
using models::imported::ListedRegister;

namespace {

using TypeKind = TypeMeaning::Kind;

bool is_before(Value a, Value b, Type type) { return type == Type::f32 ? real_of(a) < real_of(b) : a < b; }

/// Returns the number of decimals that the row's own column gives.
std::optional<int> decimals_of(const ListRow& row) {
  const auto places = parse_integer(row.text(Column::decimals));
  if (!places || *places < 0 || *places > 9) return std::nullopt;
  return static_cast<int>(*places);
}

/// Returns the step of a row's counts: that of its scale, of its decimals, or of its unit.
std::optional<Step> step_of(const ListRow& row) {
  std::optional<Step> step;
  if (row.has(Column::scale)) step = step_of_scale(row.text(Column::scale));
  if (!step && row.has(Column::decimals)) {
    if (const auto places = decimals_of(row))
      step = Step{.step = {1, *places}, .text = row.text(Column::decimals) + " decimals"};
  }
  const auto of_unit = step_of_unit(row.text(Column::unit));
  if (of_unit && (!step || (step->step.digits == 1 && step->step.places == 0))) step = of_unit;
  if (!step) return std::nullopt;
  if (const auto offset = parse_decimal(row.text(Column::offset), false)) step->offset = *offset;
  return step;
}

/// Reads the numbers in a row. They are counts, unless one of them has decimals; in that case, all are in the
/// unit.
class RowNumbers {
 public:
  RowNumbers(const ListRow& row, const RowShape& shape, const std::string& min, const std::string& max)
      : row_(row), shape_(shape) {
    const bool are_whole = shape.kind == TypeKind::number || shape.kind == TypeKind::decimal;
    in_units_ = are_whole && shape.type != Type::f32 &&
                (has_decimals(min) || has_decimals(max) || has_decimals(row.text(Column::factory)));
  }

  Value value(Column column, const std::string& word) const {
    if (shape_.type == Type::f32) return real(column, word);
    const auto number = in_units_ ? counts(column, word) : whole(word);
    const auto coded = number && shape_.kind == TypeKind::decimal ? as_bcd(*number, shape_.words) : number;
    const TypeLimits limits = shape_.kind == TypeKind::decimal
                                  ? TypeLimits{0, shape_.words == 2 ? 99'999'999 : 9999}
                                  : limits_of(shape_.type);
    const bool is_possible = number && coded && *number >= limits.lowest && *number <= limits.highest;
    if (!is_possible) {
      row_.fail(column, quoted(word) + " is not valid; expected a whole number from " +
                            std::to_string(limits.lowest) + " to " + std::to_string(limits.highest));
    }
    return *coded;
  }

  /// False also for real numbers, which have no counts.
  bool are_counts() const { return !in_units_ && shape_.type != Type::f32; }

 private:
  Value real(Column column, std::string word) const {
    std::replace(word.begin(), word.end(), ',', '.');
    const auto real = parse_real(word);
    const auto single = static_cast<float>(real.value_or(0));
    if (!real || single - single != 0) row_.fail(column, quoted(word) + " is not a number; expected one");
    return value_of_real(single);
  }

  /// Parses an integer, which a unit may follow.
  static std::optional<std::int64_t> whole(const std::string& word) {
    if (const auto number = parse_integer(word)) return number;
    const auto number = parse_decimal(word, true);
    if (!number || number->places != 0) return std::nullopt;
    const std::string suffix = word.substr(word.find_last_of("0123456789") + 1);
    const bool is_unit =
        !suffix.empty() && word.find_first_not_of("-+0123456789") + suffix.size() == word.size();
    return is_unit ? std::optional(number->digits) : std::nullopt;
  }

  std::optional<std::int64_t> counts(Column column, const std::string& word) const {
    const auto number = parse_decimal(word, true);
    if (!number) return std::nullopt;
    const auto step = step_of(row_);
    if (!step) {
      row_.fail(column, quoted(word) +
                            " is in the unit, but the row has no step; expected counts, or a unit "
                            "such as 0.01Hz");
    }
    const auto counts = counts_of(*number, *step);
    if (!counts)
      row_.fail(column,
                quoted(word) + " is not a multiple of " + quoted(step->text) + "; expected a multiple");
    return counts;
  }

  const ListRow& row_;
  const RowShape& shape_;
  bool in_units_ = false;
};

/// The two ends of a range as they are written, and their columns.
struct Ends {
  std::string min;
  std::string max;
  Column first = Column::min;
  Column last = Column::max;
};

Ends written_ends(const ListRow& row) {
  Ends ends{.min = row.text(Column::min), .max = row.text(Column::max)};
  if (row.has(Column::range)) {
    if (!ends.min.empty() || !ends.max.empty())
      row.fail(Column::range, "cannot be combined with min and max; expected one of the two");
    ends.first = ends.last = Column::range;
    const auto found = ends_of(row.text(Column::range));
    if (!found)
      row.fail(Column::range, quoted(row.text(Column::range)) + " is not a range; expected 0..3000");
    std::tie(ends.min, ends.max) = *found;
  }
  return ends;
}

void take_range(const ListRow& row, const RowShape& shape, const Ends& ends, ListedRegister& listed) {
  const RowNumbers numbers(row, shape, ends.min, ends.max);
  const Value min = numbers.value(ends.first, ends.min);
  const Value max = numbers.value(ends.last, ends.max);
  if (is_before(max, min, listed.type)) {
    row.fail(ends.last, quoted(ends.max) + " is below " + ends.min +
                            "; expected a maximum that is not below the minimum");
  }
  listed.min = min;
  listed.max = max;
  listed.ranged = true;
  const auto step = numbers.are_counts() ? step_of(row) : std::nullopt;
  if (step && (step->step.digits != 1 || step->step.places != 0)) {
    row.remark("counts", ends.last,
               quoted(ends.max) + " is read as counts of " + quoted(step->text) +
                   "; with a decimal point it would be in the unit");
  }
}

void take_enumeration(const std::vector<NamedValue>& all, const RowShape& shape, ListedRegister& listed) {
  if (shape.kind != TypeKind::number || listed.type == Type::f32) return;
  const auto [min, max] = std::minmax_element(
      all.begin(), all.end(), [](const auto& one, const auto& other) { return one.value < other.value; });
  if (all.front().is_bit) {
    for (const NamedValue& bit : all) {
      try {
        auto bits = listed.bits;
        bits.push_back(bits_called(as_word(bit.name), std::to_string(bit.value), listed.type));
        require_apart(bits);
        listed.bits = std::move(bits);
      } catch (const std::invalid_argument&) {  // for example, reserved bits that have the same name
        continue;
      }
    }
    return;
  }
  const TypeLimits limits = limits_of(listed.type);
  if (min->value < limits.lowest || max->value > limits.highest) return;
  listed.min = min->value;
  listed.max = max->value;
  listed.ranged = true;
}

/// Reads a range or an enumeration from a text for people, which may contain neither of them.
void read_values(const ListRow& row, const RowShape& shape, ListedRegister& listed) {
  const std::string& text = row.text(Column::values);
  if (const auto all = parse_enumeration(text)) return take_enumeration(*all, shape, listed);
  ListedRegister tried = listed;
  try {
    const auto ends = ends_of(text);
    if (!ends) throw FileError("");
    take_range(row, shape, {ends->first, ends->second, Column::values, Column::values}, tried);
    listed = std::move(tried);
  } catch (const FileError&) {
    row.remark("values", Column::values,
               quoted(text) + " is neither a range nor an enumeration; it is ignored");
  }
}

}  // namespace

void read_range(const ListRow& row, const RowShape& shape, ListedRegister& listed) {
  if (shape.holds_only_words()) return;
  if (shape.is_flag) {
    listed.min = 0;
    listed.max = 1;
    listed.ranged = true;
  }
  const Ends ends = written_ends(row);
  if (ends.min.empty() && ends.max.empty()) {
    if (row.has(Column::values)) read_values(row, shape, listed);
    return;
  }
  if (ends.min.empty() || ends.max.empty())
    row.fail(ends.min.empty() ? ends.last : ends.first,
             "is given alone; expected both min and max, or neither");
  take_range(row, shape, ends, listed);
}

void read_factory(const ListRow& row, const RowShape& shape, ListedRegister& listed) {
  if (shape.holds_only_words()) return;
  const auto is_out = [&](Value value) {
    return listed.ranged &&
           (is_before(value, listed.min, listed.type) || is_before(listed.max, value, listed.type));
  };
  if (!row.has(Column::factory)) {
    listed.factory = is_out(0) ? listed.min : 0;
    return;
  }
  Ends ends;
  if (row.has(Column::min) || row.has(Column::range)) ends = written_ends(row);
  listed.factory =
      RowNumbers(row, shape, ends.min, ends.max).value(Column::factory, row.text(Column::factory));
}

void check_step(const ListRow& row) {
  if (row.has(Column::scale) && !step_of_scale(row.text(Column::scale))) {
    row.remark("scale", Column::scale,
               quoted(row.text(Column::scale)) + " is not a step; it is ignored. Expected 0.1, /10 or 10");
  }
  if (row.has(Column::decimals) && !decimals_of(row)) {
    row.remark("decimals", Column::decimals,
               quoted(row.text(Column::decimals)) + " is not a number from 0 to 9; it is ignored");
  }
}

std::string unit_of(const ListRow& row) {
  const std::string& unit = row.text(Column::unit);
  if (unit.empty() || !row.has(Column::scale) || step_of_unit(unit)) return unit;
  const auto step = step_of_scale(row.text(Column::scale));
  const auto number = parse_decimal(row.text(Column::scale), false);
  const bool is_plain = step && number && number->places > 0;  // "10" may be 10 or 0.1
  if (!is_plain) return unit;
  std::string text = row.text(Column::scale);
  std::replace(text.begin(), text.end(), ',', '.');
  return text + unit;
}

std::vector<std::uint16_t> factory_words(const ListRow& row, const RowShape& shape) {
  std::vector<std::uint16_t> words(static_cast<std::size_t>(shape.words));
  const std::string& text = row.text(Column::factory);
  if (text.empty()) return words;
  if (shape.kind == TypeKind::text) {
    for (std::size_t i = 0; i < text.size() && i / 2 < words.size(); ++i)
      words[i / 2] |= static_cast<std::uint16_t>(static_cast<unsigned char>(text[i]) << (i % 2 == 0 ? 8 : 0));
  } else {
    const auto real = parse_real(text);
    const auto number = parse_integer(text);
    if (shape.type == Type::f32 ? !real.has_value() : !number.has_value())
      row.fail(Column::factory, quoted(text) + " is not a number; expected one");
    const auto bits =
        shape.type == Type::f32 ? std::bit_cast<std::uint64_t>(*real) : static_cast<std::uint64_t>(*number);
    const std::size_t last = words.size() - 1;
    for (std::size_t i = 0; i < std::min<std::size_t>(words.size(), 4); ++i)
      words[last - i] = static_cast<std::uint16_t>(bits >> 16 * i);
    if (shape.order.words == WordOrder::Words::low_first) std::reverse(words.begin(), words.end());
  }
  if (shape.order.low_byte_first) {
    for (std::uint16_t& word : words) word = static_cast<std::uint16_t>(word >> 8 | word << 8);
  }
  return words;
}

std::string as_word(const std::string& text) {
  std::string made;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || std::isalnum(byte) != 0) {
      made += c;
    } else if (!made.ends_with('_')) {
      made += '_';
    }
  }
  while (made.ends_with('_')) made.pop_back();
  const bool begins_with_digit = !made.empty() && made.front() >= '0' && made.front() <= '9';
  return (begins_with_digit ? "_" : "") + made;
}

}  // namespace understudy::emulator::model_file
