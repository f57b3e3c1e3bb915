#include "emulator/model_file/row_numbers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_values.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/row_shape.h"

namespace understudy::emulator::model_file {

namespace {

using TypeKind = TypeMeaning::Kind;

/// Returns the number of decimals that the row's own column gives.
std::optional<int> decimals_of(const ListRow& row) {
  const auto places = parse_integer(row.text(Column::decimals));
  if (!places || *places < 0 || *places > 9) return std::nullopt;
  return static_cast<int>(*places);
}

/// Returns the step that the columns `scale` and `decimals` give.
std::optional<Step> step_in_columns(const ListRow& row) {
  if (row.has(Column::scale)) {
    if (auto step = step_of_scale(row.text(Column::scale))) return step;
  }
  if (!row.has(Column::decimals)) return std::nullopt;
  const auto places = decimals_of(row);
  if (!places) return std::nullopt;
  return Step{.step = {1, *places}, .text = row.text(Column::decimals) + " decimals"};
}

bool are_equal(const Step& one, const Step& other) {
  const auto counts = counts_of(one.step, Step{.step = other.step});
  return counts && *counts == 1;
}

/// Returns true for a scale such as 10 or x10, which multiplies in some lists and divides in others.
bool may_multiply(const ListRow& row, const Step& step) {
  return step.text == row.text(Column::scale) && step.step.digits == 1 && step.step.places > 0 &&
         step.text.find_first_of("./,") == std::string::npos;
}

}  // namespace

std::optional<bool> on_or_off_called(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, bool>, 8> kWords{{{"on", true},
                                                                     {"off", false},
                                                                     {"ein", true},
                                                                     {"aus", false},
                                                                     {"enabled", true},
                                                                     {"disabled", false},
                                                                     {"开", true},
                                                                     {"关", false}}};
  for (const auto& [known, is_on] : kWords) {
    if (known == lower(word)) return is_on;
  }
  return yes_or_no_called(word);
}

bool is_one(const Step& step) { return step.step.digits == 1 && step.step.places == 0; }

void check_step(const ListRow& row) {
  if (row.has(Column::scale) && !step_of_scale(row.text(Column::scale))) {
    row.remark("scale", Column::scale,
               quoted(row.text(Column::scale)) + " is not a step; it is ignored. Expected 0.1, /10 or 10");
  }
  if (row.has(Column::decimals) && !decimals_of(row)) {
    row.remark("decimals", Column::decimals,
               quoted(row.text(Column::decimals)) + " is not a number from 0 to 9; it is ignored");
  }
  if (row.has(Column::offset) && !parse_decimal(row.text(Column::offset), false)) {
    row.remark("offset", Column::offset,
               quoted(row.text(Column::offset)) + " is not a number; it is ignored");
  }
  const auto of_unit = step_of_unit(row.text(Column::unit));
  const auto in_columns = step_in_columns(row);
  if (!of_unit || is_one(*of_unit) || !in_columns || is_one(*in_columns) || are_equal(*of_unit, *in_columns))
    return;
  const bool is_scale = in_columns->text == row.text(Column::scale);
  row.remark("two steps", is_scale ? Column::scale : Column::decimals,
             quoted(in_columns->text) + " is ignored, because the unit " + quoted(row.text(Column::unit)) +
                 " has a step of its own");
}

std::optional<Step> step_of(const ListRow& row) {
  std::optional<Step> step = step_of_unit(row.text(Column::unit));
  if (!step || is_one(*step)) {
    if (const auto in_columns = step_in_columns(row)) step = in_columns;
  }
  if (!step) return std::nullopt;
  if (const auto offset = parse_decimal(row.text(Column::offset), false)) step->offset = *offset;
  return step;
}

RowNumbers::RowNumbers(const ListRow& row, const RowShape& shape, const Ends& ends)
    : row_(row), shape_(shape) {
  const bool are_whole = shape.kind == TypeKind::number || shape.kind == TypeKind::decimal;
  if (!are_whole || shape.type == Type::f32) return;
  const std::array<std::pair<Column, const std::string*>, 3> all{
      {{ends.first, &ends.min}, {ends.last, &ends.max}, {Column::factory, &row.text(Column::factory)}}};
  for (const auto& [column, word] : all) {
    if (in_units_ || !has_decimals(*word)) continue;
    in_units_ = true;
    column_with_decimals_ = column;
    with_decimals_ = *word;
  }
}

TypeLimits RowNumbers::limits() const {
  if (shape_.kind == TypeKind::decimal) return {0, shape_.words == 2 ? 99'999'999 : 9999};
  return limits_of(shape_.type);
}

Value RowNumbers::limit(bool is_highest) const {
  if (shape_.type == Type::f32) {
    constexpr float kGreatest = std::numeric_limits<float>::max();
    return value_of_real(is_highest ? kGreatest : -kGreatest);
  }
  if (shape_.is_flag) return is_highest ? 1 : 0;
  constexpr int kBitsOfByte = 8;
  if (shape_.kind == TypeKind::number && shape_.bits == kBitsOfByte) {
    if (is_signed(shape_.type)) return is_highest ? INT8_MAX : INT8_MIN;
    return is_highest ? UINT8_MAX : 0;
  }
  const Value limit = is_highest ? limits().highest : limits().lowest;
  return shape_.kind == TypeKind::decimal ? as_bcd(limit, shape_.words).value_or(0) : limit;
}

std::string RowNumbers::limit_text(bool is_highest) const {
  if (shape_.kind == TypeKind::decimal) return std::to_string(is_highest ? limits().highest : 0);
  return value_text(limit(is_highest), shape_.type);
}

Value RowNumbers::value(Column column, const std::string& word) const {
  if (shape_.type == Type::f32) return real(column, word);
  const bool is_switch = column == Column::factory && (shape_.is_flag || shape_.type == Type::bit);
  if (is_switch) {
    if (const auto is_on = on_or_off_called(word)) return *is_on ? 1 : 0;
  }
  const auto number = in_units_ ? counts(column, word) : whole(column, word);
  const auto coded = number && shape_.kind == TypeKind::decimal ? as_bcd(*number, shape_.words) : number;
  const bool is_possible = number && coded && *number >= limits().lowest && *number <= limits().highest;
  if (!is_possible) {
    row_.fail(column, quoted(word) + " is not valid; expected a whole number from " +
                          std::to_string(limits().lowest) + " to " + std::to_string(limits().highest));
  }
  return *coded;
}

void RowNumbers::say_what_commas_mean(Column column, const std::string& word) const {
  if (!may_have_thousands(word)) return;
  std::string meant = word;
  std::replace(meant.begin(), meant.end(), ',', '.');
  row_.remark("comma", column, quoted(word) + " is read as " + meant + "; its comma separates decimals");
}

Value RowNumbers::real(Column column, std::string word) const {
  say_what_commas_mean(column, word);
  std::replace(word.begin(), word.end(), ',', '.');
  if (word.starts_with('+')) word.erase(0, 1);
  const auto real = parse_real(word);
  const auto single = static_cast<float>(real.value_or(0));
  if (!real || single - single != 0) row_.fail(column, quoted(word) + " is not a number; expected one");
  return value_of_real(single);
}

/// Parses a whole number, which may have its unit after it. 0xFFFF can be -1.
std::optional<std::int64_t> RowNumbers::whole(Column column, const std::string& word) const {
  if (const auto number = parse_integer(word)) {
    const bool is_pattern = word.starts_with("0x") || word.starts_with("0X");
    const bool has_sign_bit = is_pattern && is_signed(shape_.type) && *number > limits().highest &&
                              *number <= 2 * limits().highest + 1;
    if (!has_sign_bit) return number;
    const Value value = value_of(static_cast<std::uint32_t>(*number), shape_.type);
    row_.remark("sign bit", column,
                quoted(word) + " is read as " + std::to_string(value) + ", because the type has a sign");
    return value;
  }
  const auto number = parse_decimal(word.substr(0, word.find_last_of("0123456789") + 1), false);
  return number && number->places == 0 ? std::optional(number->digits) : std::nullopt;
}

std::optional<std::int64_t> RowNumbers::counts(Column column, const std::string& word) const {
  const auto number = parse_decimal(word, true);
  if (!number) return std::nullopt;
  const auto step = step_of(row_);
  if (!step) {
    std::string plain = with_decimals_;
    std::erase(plain, ',');
    row_.fail(column_with_decimals_, quoted(with_decimals_) +
                                         " is in the unit, but the row has no step; expected counts" +
                                         (may_have_thousands(with_decimals_) ? " such as " + plain : "") +
                                         ", or a unit such as 0.01Hz");
  }
  say_what_commas_mean(column, word);
  if (may_multiply(row_, *step)) {
    row_.remark("divisor", Column::scale,
                quoted(step->text) + " is read as " + std::to_string(power_of_ten(step->step.places)) +
                    " counts for one of the unit, as /" + std::to_string(power_of_ten(step->step.places)) +
                    " is");
  }
  const auto counts = counts_of(*number, *step);
  if (!counts)
    row_.fail(column, quoted(word) + " is not a multiple of " + quoted(step->text) + "; expected a multiple");
  return counts;
}

}  // namespace understudy::emulator::model_file
