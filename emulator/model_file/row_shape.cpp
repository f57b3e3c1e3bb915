#include "emulator/model_file/row_shape.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_enumeration.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_values.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

namespace {

using TypeKind = TypeMeaning::Kind;

constexpr int kMaxWords = 125;  // the limit for a request

/// Requires that columns are consistent. A list may contain the same information twice, but not contradictory
/// information.
void require_agreement(const ListRow& row, Type type) {
  const auto require = [&](Column column, bool agrees) {
    if (!row.has(column) || agrees) return;
    row.fail(column, quoted(row.text(column)) + " contradicts the type " + quoted(row.text(Column::type)) +
                         "; expected columns that agree, or only one of them");
  };
  require(Column::width, row.text(Column::width) == std::to_string(width_of(type)));
  require(Column::real, row.yes_or_no(Column::real) == (type == Type::f32));
  require(Column::is_signed, type == Type::f32 || row.yes_or_no(Column::is_signed) == is_signed(type));
}

/// Returns true if a row's range or enumeration has negative values.
bool has_negative_value(const ListRow& row) {
  if (row.has(Column::min)) return row.text(Column::min).starts_with('-');
  if (row.text(Column::max).starts_with('-')) return true;
  if (const auto all = parse_enumeration(row.text(Column::values)); all && !row.has(Column::range))
    return std::any_of(all->begin(), all->end(), [](const NamedValue& one) { return one.value < 0; });
  const auto ends = ends_of(row.text(row.has(Column::range) ? Column::range : Column::values));
  return ends && ends->first.starts_with('-');
}

/// Returns the type that the columns `width`, `signed` and `real` give.
Type plain_type(const ListRow& row, Table table) {
  const std::string& width = row.text(Column::width);
  if (is_table_of_bits(table)) {
    if (!width.empty() && width != "1")
      row.fail(Column::width, quoted(width) + " is not valid in this table; expected 1");
    return Type::bit;
  }
  if (!width.empty() && width != "16" && width != "32")
    row.fail(Column::width, quoted(width) + " is not valid; expected 16 or 32, and 1 in coil and discrete");
  const bool is_wide = width == "32";
  if (row.yes_or_no(Column::real)) {
    if (!is_wide) row.fail(Column::real, "a real number has 32 bits; expected the width 32");
    return Type::f32;
  }
  const bool has_sign =
      row.has(Column::is_signed) ? row.yes_or_no(Column::is_signed) : has_negative_value(row);
  if (is_wide) return has_sign ? Type::s32 : Type::u32;
  return has_sign ? Type::s16 : Type::u16;
}

/// Returns the number of words in the column `words`: "2", "4 bytes", "32 bit". 0: none.
int words_in_column(const ListRow& row) {
  if (!row.has(Column::words)) return 0;
  const std::string text = lower(row.text(Column::words));
  const auto number = parse_decimal(text, true);
  if (!number || number->places != 0 || number->digits < 1 || number->digits > 16 * kMaxWords) {
    row.fail(Column::words, quoted(row.text(Column::words)) +
                                " is not a number of registers; expected 1 to " + std::to_string(kMaxWords));
  }
  const auto count = static_cast<int>(number->digits);
  const auto says = [&](std::string_view what) { return text.find(what) != std::string::npos; };
  if (says("byte")) return (count + 1) / 2;
  if (says("bit") || count == 16 || count == 32 || count == 64) return (count + 15) / 16;
  return count;
}

RowShape shape_by_type(const ListRow& row, Table table) {
  const std::string& word = row.text(Column::type);
  if (word.empty()) {
    const Type type = plain_type(row, table);
    return {.type = type, .words = is_32_bit(type) ? 2 : 1};
  }
  const auto& meaning = row.type();
  if (!meaning) {
    row.fail(Column::type, quoted(word) +
                               " is not a type; expected u16, s16, u32, s32, f32 or bit, or another type "
                               "in docs/import.md");
  }
  RowShape shape{.kind = meaning->kind,
                 .type = meaning->type,
                 .words = meaning->words,
                 .bits = meaning->bits,
                 .order = meaning->order};
  const bool is_bit = shape.kind == TypeKind::number && shape.type == Type::bit;
  if (is_bit && !is_table_of_bits(table) && lower(word) != "bit") {
    shape.type = Type::u16;
    shape.is_flag = true;
    return shape;
  }
  if (is_bit != is_table_of_bits(table))
    row.fail(Column::type, "is not as wide as its table; expected bit in coil and discrete, and only there");
  if (shape.kind == TypeKind::number) require_agreement(row, shape.type);
  return shape;
}

/// Returns true if the row's integer type may also have 32 bits, because its word does not specify 16.
bool may_be_wider(const ListRow& row, const RowShape& shape) {
  const bool is_integer = shape.type == Type::u16 || shape.type == Type::s16;
  return shape.kind == TypeKind::number && is_integer && !shape.is_flag && !row.has(Column::width) &&
         row.text(Column::type).find_first_of("0123456789") == std::string::npos;
}

}  // namespace

RowShape shape_of(const ListRow& row, Table table, int printed_words) {
  RowShape shape = shape_by_type(row, table);
  if (row.has(Column::order)) {
    const auto order = order_called(row.text(Column::order));
    if (!order) {
      row.fail(Column::order,
               quoted(row.text(Column::order)) + " is not an order; expected abcd, cdab, badc or dcba");
    }
    shape.order = *order;
  }
  const bool is_pair = printed_words > 1;
  const int stated_words = is_pair ? printed_words : words_in_column(row);
  if (is_table_of_bits(table)) {
    shape.count = std::max(is_pair ? stated_words : 1, 1);
    return shape;
  }
  if (shape.words == 0) {  // text and raw words
    if (stated_words == 0)
      row.remark("no length", Column::type,
                 quoted(row.text(Column::type)) +
                     " has no length; one word is assumed (a column `words` sets the length)");
    shape.words = std::max(stated_words, 1);
    return shape;
  }
  if (stated_words == 0 || stated_words == shape.words) return shape;
  if (stated_words == 1 && !row.has(Column::words)) return shape;
  if (may_be_wider(row, shape) && stated_words == 2) {
    shape.type = shape.type == Type::s16 ? Type::s32 : Type::u32;
    shape.words = 2;
  } else if (may_be_wider(row, shape) && stated_words == 4) {
    shape.kind = TypeKind::only_words;
    shape.words = 4;
  } else if (is_pair && stated_words % shape.words == 0) {
    shape.count = stated_words / shape.words;
  } else if (is_pair) {
    row.fail(Column::address, quoted(row.text(Column::address)) + " are " + std::to_string(stated_words) +
                                  " registers; expected " + std::to_string(shape.words) + " for the type " +
                                  quoted(row.text(Column::type)));
  } else {
    const Column stated = row.has(Column::type) ? Column::type : Column::width;
    row.remark("length", Column::words,
               quoted(row.text(Column::words)) + " does not match the " + std::string(name_of(stated)) + " " +
                   quoted(row.text(stated)) + "; the " + std::string(name_of(stated)) + " is used");
  }
  return shape;
}

}  // namespace understudy::emulator::model_file
