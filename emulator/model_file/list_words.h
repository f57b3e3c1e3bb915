// The words of register lists, as tables of data: column headings, types, access modes, register tables and
// byte orders, in the languages of manuals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/device/register_map/row.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// The columns of a list. `left_out` is for information only.
enum class Column : std::uint8_t {
  table,
  function,
  address,
  name,
  access,
  writable,
  type,
  width,
  words,
  order,
  is_signed,
  min,
  max,
  range,
  values,
  unit,
  scale,
  decimals,
  offset,
  persistent,
  factory,
  real,
  bits,
  since,
  left_out,
};
inline constexpr std::size_t kColumns = static_cast<std::size_t>(Column::left_out);

/// A heading and one of its meanings, in the form that heading_key() returns. Lower ranks take precedence;
/// headings with rank 0 are the names of the columns.
struct Heading {
  std::string_view key;
  Column column;
  int rank;
};
std::span<const Heading> headings();
/// Returns the name of a column for messages, for `--columns` and for model files.
std::string_view name_of(Column column);
/// Returns the column with that name.
std::optional<Column> column_called(std::string_view name);
/// Returns a heading in lower case, without parts in parentheses, and with single blanks instead of
/// punctuation.
std::string heading_key(std::string_view heading);
/// Returns true if a heading indicates that its numbers are hexadecimal: "Address (hex)".
bool says_hexadecimal(std::string_view heading);

using models::imported::WordOrder;
/// Returns nothing for an unknown word.
std::optional<WordOrder> order_called(std::string_view word);

/// The meaning of a type word. Values of a type that no Type describes, or that has more than two words, are
/// only stored as words.
struct TypeMeaning {
  enum class Kind : std::uint8_t {
    number,   // one of Type
    decimal,  // BCD: four digits per word
    text,
    only_words,
    part,  // some of the bits of a word
  } kind = Kind::number;
  Type type = Type::u16;
  int words = 1;  // 0: the list specifies the number
  int bits = 0;   // for a part, or for a number with fewer than 16 bits
  WordOrder order{};
};
/// Returns nothing for an unknown word.
std::optional<TypeMeaning> type_called(std::string_view word);

std::optional<Access> access_called(std::string_view word);
/// Like table_called(), but with the words that lists use.
std::optional<Table> listed_table_called(std::string_view word);
/// Returns the table of a function ("3", "0x03", "FC04"), or of the first of several functions ("3/6/16").
std::optional<Table> table_of_function(std::string_view text);
/// Returns nothing for a text that means neither yes nor no.
std::optional<bool> yes_or_no_called(std::string_view word);
/// Returns true if the name means that the maker reserves the address: "Reserved".
bool is_reserved(std::string_view name);

/// Returns a text in lower case.
std::string lower(std::string_view text);
/// Returns a word in lower case, without parts in parentheses, blanks and punctuation: "R/W" is "rw".
std::string word_key(std::string_view text);

}  // namespace understudy::emulator::model_file
