#include "emulator/model_file/list_addresses.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/parse_integer.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

namespace {

constexpr std::string_view kDecimalDigits = "0123456789";
constexpr std::string_view kHexadecimalDigits = "0123456789abcdefABCDEF";

/// The table that the first digit of a Modicon number means.
constexpr std::array<std::pair<int, Table>, 4> kBlocks{
    {{4, Table::holding}, {3, Table::input}, {1, Table::discrete}, {0, Table::coil}}};

bool consists_of(std::string_view text, std::string_view known) {
  return !text.empty() && text.find_first_not_of(known) == std::string_view::npos;
}

std::string_view stripped(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return text;
}

std::optional<std::int64_t> decimal(std::string_view digits) {
  if (!consists_of(digits, kDecimalDigits) || digits.size() > 7) return std::nullopt;
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size() - 1));
  return parse_integer(digits);
}

std::optional<std::int64_t> hexadecimal(std::string_view digits) {
  if (!consists_of(digits, kHexadecimalDigits) || digits.size() > 6) return std::nullopt;
  return parse_integer("0x" + std::string(digits));
}

/// Returns the digits of a number in a hexadecimal form, or nothing for other forms.
std::string_view hexadecimal_digits(std::string_view text) {
  constexpr std::array<std::string_view, 6> kBefore{"0x", "0X", "&H", "16#", "x", "X"};
  for (const std::string_view before : kBefore) {
    if (text.starts_with(before)) return text.substr(before.size());
  }
  if (text.starts_with('$')) return text.substr(1);
  if (text.ends_with('H') || text.ends_with('h')) return text.substr(0, text.size() - 1);
  return {};
}

/// Parses "4x0001" and "4:0001". A text that begins with 0x is a hexadecimal number instead.
std::optional<PrintedAddress> parse_with_block(std::string_view text) {
  if (text.size() < 5 || text[0] < '1' || text[0] > '4') return std::nullopt;
  if (text[1] != 'x' && text[1] != 'X' && text[1] != ':') return std::nullopt;
  const auto number = decimal(text.substr(2));
  if (!number) return std::nullopt;
  for (const auto& [digit, table] : kBlocks) {
    if (digit == text[0] - '0')
      return PrintedAddress{.number = *number, .last = *number, .table = table, .counts_from_one = true};
  }
  return std::nullopt;
}

std::optional<PrintedAddress> parse_one(std::string_view text, bool is_hexadecimal) {
  text = stripped(text);
  if (const auto with_block = parse_with_block(text)) return with_block;
  if (const auto number = hexadecimal(hexadecimal_digits(text)))
    return PrintedAddress{.number = *number, .last = *number, .is_hexadecimal = true};
  const auto number = is_hexadecimal ? hexadecimal(text) : decimal(text);
  if (number) return PrintedAddress{.number = *number, .last = *number, .is_hexadecimal = is_hexadecimal};
  // "HR100", "D100", "%MW100": letters, followed by a decimal number.
  const std::size_t begin = text.find_first_of(kDecimalDigits);
  if (begin == 0 || begin == std::string_view::npos || begin > 9) return std::nullopt;
  const std::string_view letters = text.substr(0, begin);
  const bool are_letters = std::all_of(letters.begin(), letters.end(), [](unsigned char c) {
    return std::isalpha(c) != 0 || c == '%' || c == ' ' || c == '_';
  });
  const auto after = decimal(text.substr(begin));
  if (!are_letters || !after) return std::nullopt;
  return PrintedAddress{.number = *after, .last = *after, .table = listed_table_called(letters)};
}

/// Removes a bit number from the end: "10.3", "10.b3", "10:3". Returns its number, or -1.
int take_bit(std::string_view& text) {
  const std::size_t sign = text.find_last_of(".:");
  if (sign == std::string_view::npos || sign == 0) return -1;
  std::string_view digits = text.substr(sign + 1);
  if (digits.starts_with('b') || digits.starts_with('B')) digits.remove_prefix(1);
  const auto bit = digits.size() <= 2 ? decimal(digits) : std::nullopt;
  if (!bit || *bit > 15) return -1;
  text = text.substr(0, sign);
  return static_cast<int>(*bit);
}

/// A plain number such as 40001 or 400001: its table, and its offset in the table's block.
struct Block {
  Table table = Table::holding;
  std::int64_t offset = 0;
};
std::optional<Block> block_of(std::int64_t number) {
  const bool is_long = number >= 100'000;
  const std::int64_t size = is_long ? 100'000 : 10'000;
  for (const auto& [digit, table] : kBlocks) {
    if (digit != number / size) continue;
    const std::int64_t offset = number % size - 1;
    if (offset < 0 || offset > UINT16_MAX) return std::nullopt;
    return Block{.table = table, .offset = offset};
  }
  return std::nullopt;
}

}  // namespace

bool has_hexadecimal_letters(std::string_view text) {
  return text.size() >= 2 && consists_of(text, kHexadecimalDigits) && !consists_of(text, kDecimalDigits) &&
         std::isdigit(static_cast<unsigned char>(text.front())) != 0;
}

std::optional<PrintedAddress> parse_address(std::string_view text, bool is_hexadecimal) {
  text = stripped(text.substr(0, text.find('(')));
  if (const auto one = parse_one(text, is_hexadecimal)) return one;
  std::string_view whole = text;
  if (const int bit = take_bit(whole); bit >= 0) {
    if (auto one = parse_one(whole, is_hexadecimal)) {
      one->bit = bit;
      return one;
    }
  }
  constexpr std::array<std::string_view, 11> kBetween{"...", "..", " to ", "~", "～", "–",
                                                      "—",   "-",  "/",    ",", "&"};
  for (const std::string_view between : kBetween) {
    const std::size_t at = text.find(between);
    if (at == std::string_view::npos) continue;
    auto first = parse_one(text.substr(0, at), is_hexadecimal);
    const auto last = parse_one(text.substr(at + between.size()), is_hexadecimal);
    constexpr std::int64_t kMaxWords = 125;
    if (!first || !last || last->number <= first->number || last->number - first->number >= kMaxWords)
      return std::nullopt;
    first->last = last->number;
    return first;
  }
  return std::nullopt;
}

std::optional<WireAddress> wire_address(const PrintedAddress& printed, AddressReading reading) {
  std::int64_t number = printed.number;
  std::optional<Table> table = printed.table;
  if (printed.counts_from_one || (reading == AddressReading::from_one && !printed.is_hexadecimal)) {
    --number;
  } else if (reading == AddressReading::modicon && !printed.is_hexadecimal) {
    const auto block = block_of(number);
    if (!block) return std::nullopt;
    number = block->offset;
    table = block->table;
  }
  const std::int64_t last = number + printed.words() - 1;
  if (number < 0 || last > UINT16_MAX) return std::nullopt;
  return WireAddress{.address = static_cast<std::uint16_t>(number), .table = table};
}

bool AddressEvidence::add(const PrintedAddress& printed, std::optional<Table> table, bool holds_words) {
  lowest = std::min(lowest, printed.number);
  if (printed.counts_from_one) return true;  // the form of the address determines the table
  if (printed.is_hexadecimal) {
    all_are_modicon = false;
    return false;
  }
  const auto block = block_of(printed.number);
  const bool suits =
      block && (!table || block->table == *table) && (!holds_words || !is_table_of_bits(block->table));
  if (!suits) {
    all_are_modicon = false;
    return false;
  }
  if (block->table == Table::coil) return true;
  any_has_a_block = true;
  if (printed.number > UINT16_MAX) beyond_the_wire = true;
  constexpr std::int64_t kFirstOnes = 10;
  if (block->offset < kFirstOnes) begins_a_block = true;
  return true;
}

std::optional<AddressReading> AddressEvidence::certain() const {
  if (!all_are_modicon || !any_has_a_block) return AddressReading::wire;
  return beyond_the_wire ? std::optional(AddressReading::modicon) : std::nullopt;
}

std::optional<AddressReading> AddressEvidence::likely() const {
  if (const auto only = certain()) return only;
  return begins_a_block ? std::optional(AddressReading::modicon) : std::nullopt;
}

}  // namespace understudy::emulator::model_file
