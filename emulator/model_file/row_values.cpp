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

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_enumeration.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_values.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/row_numbers.h"
#include "emulator/model_file/row_shape.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

using models::imported::BitName;
using models::imported::ListedRegister;

namespace {

bool is_before(Value a, Value b, Type type) { return type == Type::f32 ? real_of(a) < real_of(b) : a < b; }

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

class RangeReader {
 public:
  RangeReader(const ListRow& row, const RowShape& shape, ListedRegister& listed,
              world::Diagnostics& diagnostics)
      : row_(row), shape_(shape), listed_(listed), diagnostics_(diagnostics) {}

  bool read() {
    if (shape_.is_flag) set_range(0, 1);
    attempt([&] { ends_ = written_ends(row_); });
    const bool has_ends = !ends_.min.empty() || !ends_.max.empty();
    const bool has_values = is_right_ && row_.has(Column::values);
    if (has_values && !has_ends) read_values();
    if (has_values && has_ends) read_bits_of_values();
    const RowNumbers numbers(row_, shape_, ends_);
    if (has_ends) take_range(numbers);
    attempt([&] { take_factory(numbers); });
    return is_right_;
  }

 private:
  template <typename Read>
  bool attempt(const Read& read) {
    const bool did = diagnostics_.attempt(read);
    is_right_ &= did;
    return did;
  }

  void set_range(Value min, Value max) {
    listed_.min = min;
    listed_.max = max;
    listed_.ranged = true;
  }

  Value end(const RowNumbers& numbers, bool is_max) const {
    const Column column = is_max ? ends_.last : ends_.first;
    const std::string& word = is_max ? ends_.max : ends_.min;
    if (!word.empty()) return numbers.value(column, word);
    row_.remark("alone", is_max ? ends_.first : ends_.last,
                quoted(is_max ? ends_.min : ends_.max) + " is given alone; the range " +
                    (is_max ? "ends at " : "begins at ") + numbers.limit_text(is_max) +
                    ", the limit of the type");
    return numbers.limit(is_max);
  }

  void take_range(const RowNumbers& numbers) {
    Value min = 0;
    Value max = 0;
    const bool has_min = attempt([&] { min = end(numbers, false); });
    const bool has_max = attempt([&] { max = end(numbers, true); });
    if (!has_min || !has_max) return;
    attempt([&] { accept_range(numbers, min, max); });
  }

  void accept_range(const RowNumbers& numbers, Value min, Value max) {
    if (is_before(max, min, listed_.type)) {
      row_.fail(ends_.max.empty() ? ends_.first : ends_.last,
                quoted(ends_.max) + " is below " + ends_.min +
                    "; expected a maximum that is not below the minimum");
    }
    set_range(min, max);
    // A list of this program has counts, and steps only in its units.
    const bool may_be_in_unit = row_.has(Column::scale) || row_.has(Column::decimals);
    const auto step = may_be_in_unit && numbers.are_counts() ? step_of(row_) : std::nullopt;
    if (step && !is_one(*step) && !ends_.max.empty()) {
      row_.remark("counts", ends_.last,
                  quoted(ends_.max) + " is read as counts of " + quoted(step->text) +
                      "; with a decimal point it would be in the unit");
    }
  }

  void ignore_values(const std::string& kind, const std::string& why) const {
    row_.remark(kind, Column::values, quoted(row_.text(Column::values)) + " " + why + "; it is ignored");
  }

  /// Reads a range or an enumeration from a text for people, which may contain neither.
  void read_values() {
    if (const auto all = parse_enumeration(row_.text(Column::values))) return take_enumeration(*all);
    const auto ends = ends_of(row_.text(Column::values));
    try {
      if (!ends) throw FileError("");
      ends_ = {ends->first, ends->second, Column::values, Column::values};
      const RowNumbers numbers(row_, shape_, ends_);
      accept_range(numbers, numbers.value(Column::values, ends_.min),
                   numbers.value(Column::values, ends_.max));
    } catch (const FileError&) {
      ends_ = {};
      ignore_values("values", "is neither a range nor an enumeration");
    }
  }

  /// The range has its own columns, so values are only for people, unless they name bits.
  void read_bits_of_values() {
    const auto all = parse_enumeration(row_.text(Column::values));
    if (all && all->front().is_bit) take_enumeration(*all);
  }

  void take_enumeration(const std::vector<NamedValue>& all) {
    if (all.front().is_bit) {
      for (const NamedValue& bit : all) take_bit(bit);
      return;
    }
    Value min = all.front().value;
    Value max = min;
    for (const NamedValue& one : all) {
      min = std::min<Value>(min, one.value);
      max = std::max<Value>(max, one.last);
    }
    if (min == max) return ignore_values("one value", "names only one value");
    ends_ = {std::to_string(min), std::to_string(max), Column::values, Column::values};
    try {
      const RowNumbers numbers(row_, shape_, {});
      set_range(numbers.value(Column::values, ends_.min), numbers.value(Column::values, ends_.max));
    } catch (const FileError&) {
      ignore_values("values beyond", "goes beyond the type");
    }
    ends_ = {};
  }

  void take_bit(const NamedValue& bit) {
    const std::string range =
        std::to_string(bit.value) + (bit.last > bit.value ? "-" + std::to_string(bit.last) : "");
    try {
      auto bits = listed_.bits;
      bits.push_back(bits_called(as_word(bit.name), range, listed_.type));
      require_apart(bits);
      listed_.bits = std::move(bits);
    } catch (const std::invalid_argument& error) {
      if (is_reserved(bit.name)) return;  // such bits share a name, and need none
      row_.remark("bit name", Column::values, "bit " + range + " has no name here: " + error.what());
    }
  }

  void take_factory(const RowNumbers& numbers) {
    const auto is_out = [&](Value value) {
      return listed_.ranged &&
             (is_before(value, listed_.min, listed_.type) || is_before(listed_.max, value, listed_.type));
    };
    listed_.factory = row_.has(Column::factory) ? numbers.value(Column::factory, row_.text(Column::factory))
                      : is_out(0)               ? listed_.min
                                                : 0;
  }

  const ListRow& row_;
  const RowShape& shape_;
  ListedRegister& listed_;
  world::Diagnostics& diagnostics_;
  Ends ends_;
  bool is_right_ = true;
};

}  // namespace

bool read_numbers(const ListRow& row, const RowShape& shape, ListedRegister& listed,
                  world::Diagnostics& diagnostics) {
  if (!shape.holds_only_words()) return RangeReader(row, shape, listed, diagnostics).read();
  for (const Column column : {Column::min, Column::max, Column::range, Column::values}) {
    if (!row.has(column)) continue;
    row.remark("no range", column,
               quoted(row.text(column)) + " is ignored, because the type only stores words");
    break;
  }
  return true;
}

void check_numbers(const ListRow& row, world::Diagnostics& diagnostics) {
  if (!row.has(Column::min) && !row.has(Column::max)) return;  // the default may be a text
  for (const Column column : {Column::min, Column::max, Column::factory}) {
    diagnostics.attempt([&] {
      const std::string& word = row.text(column);
      const bool is_number = parse_integer(word) || parse_decimal(word, true) || parse_real(word);
      if (word.empty() || is_number || (column == Column::factory && on_or_off_called(word))) return;
      row.fail(column, quoted(word) + " is not a number; expected one");
    });
  }
}

std::string unit_of(const ListRow& row) {
  const std::string& unit = row.text(Column::unit);
  const bool begins_with_digit = !unit.empty() && unit.front() >= '0' && unit.front() <= '9';  // "4-20 mA"
  if (unit.empty() || begins_with_digit || !row.has(Column::scale)) return unit;
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
  if (shape.kind == TypeMeaning::Kind::text) {
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
