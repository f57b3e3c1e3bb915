#include "emulator/model_file/list_words.h"

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
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator::model_file {

namespace {

constexpr std::array<std::pair<std::string_view, Access>, 33> kAccessWords{{
    {"r", Access::read},
    {"ro", Access::read},
    {"read", Access::read},
    {"rd", Access::read},
    {"readonly", Access::read},
    {"lesen", Access::read},
    {"nurlesen", Access::read},
    {"只读", Access::read},
    {"读", Access::read},
    {"唯讀", Access::read},
    {"只讀", Access::read},
    {"讀", Access::read},
    {"w", Access::write},
    {"wo", Access::write},
    {"write", Access::write},
    {"writeonly", Access::write},
    {"schreiben", Access::write},
    {"nurschreiben", Access::write},
    {"只写", Access::write},
    {"写", Access::write},
    {"只寫", Access::write},
    {"寫", Access::write},
    {"rw", Access::read_write},
    {"wr", Access::read_write},
    {"readwrite", Access::read_write},
    {"readandwrite", Access::read_write},
    {"writeread", Access::read_write},
    {"lesenschreiben", Access::read_write},
    {"lesenundschreiben", Access::read_write},
    {"读写", Access::read_write},
    {"可读写", Access::read_write},
    {"讀寫", Access::read_write},
    {"可讀寫", Access::read_write},
}};

constexpr std::array<std::pair<std::string_view, Table>, 24> kTableWords{{
    {"holding", Table::holding},
    {"holdingregister", Table::holding},
    {"holdingregisters", Table::holding},
    {"hr", Table::holding},
    {"4x", Table::holding},
    {"保持寄存器", Table::holding},
    {"保持暫存器", Table::holding},
    {"input", Table::input},
    {"inputregister", Table::input},
    {"inputregisters", Table::input},
    {"ir", Table::input},
    {"3x", Table::input},
    {"输入寄存器", Table::input},
    {"輸入暫存器", Table::input},
    {"coil", Table::coil},
    {"coils", Table::coil},
    {"0x", Table::coil},
    {"线圈", Table::coil},
    {"線圈", Table::coil},
    {"discrete", Table::discrete},
    {"discreteinput", Table::discrete},
    {"discreteinputs", Table::discrete},
    {"di", Table::discrete},
    {"1x", Table::discrete},
}};

constexpr std::array<std::pair<int, Table>, 8> kTablesOfFunctions{{{1, Table::coil},
                                                                   {2, Table::discrete},
                                                                   {3, Table::holding},
                                                                   {4, Table::input},
                                                                   {5, Table::coil},
                                                                   {6, Table::holding},
                                                                   {15, Table::coil},
                                                                   {16, Table::holding}}};

constexpr std::array<std::pair<std::string_view, bool>, 16> kYesOrNo{{{"", false},
                                                                      {"0", false},
                                                                      {"no", false},
                                                                      {"n", false},
                                                                      {"false", false},
                                                                      {"nein", false},
                                                                      {"否", false},
                                                                      {"1", true},
                                                                      {"yes", true},
                                                                      {"y", true},
                                                                      {"true", true},
                                                                      {"x", true},
                                                                      {"ja", true},
                                                                      {"j", true},
                                                                      {"是", true},
                                                                      {"✓", true}}};

constexpr std::array<std::string_view, 16> kReserved{
    "reserved", "reserve", "reserviert", "spare", "unused", "empty", "undefined",    "not used",
    "frei",     "保留",    "预留",       "預留",  "备用",   "備用",  "nicht belegt", "n/a"};

constexpr WordOrder kHighFirst{.words = WordOrder::Words::high_first};
constexpr WordOrder kLowFirst{.words = WordOrder::Words::low_first};
constexpr WordOrder kHighFirstSwapped{.words = WordOrder::Words::high_first, .low_byte_first = true};
constexpr WordOrder kLowFirstSwapped{.words = WordOrder::Words::low_first, .low_byte_first = true};
constexpr std::array<std::pair<std::string_view, WordOrder>, 23> kOrders{{
    {"be", kHighFirst},          {"big", kHighFirst},
    {"bigendian", kHighFirst},   {"abcd", kHighFirst},
    {"ab", kHighFirst},          {"msb", kHighFirst},
    {"highword", kHighFirst},    {"highfirst", kHighFirst},
    {"high", kHighFirst},        {"abcdefgh", kHighFirst},
    {"sw", kLowFirst},           {"cdab", kLowFirst},
    {"wordswap", kLowFirst},     {"lowword", kLowFirst},
    {"lowfirst", kLowFirst},     {"low", kLowFirst},
    {"swapped", kLowFirst},      {"sb", kHighFirstSwapped},
    {"badc", kHighFirstSwapped}, {"le", kLowFirstSwapped},
    {"dcba", kLowFirstSwapped},  {"littleendian", kLowFirstSwapped},
    {"ba", kLowFirstSwapped},
}};

template <typename Pairs>
auto find_word(const Pairs& table, std::string_view key) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == key; });
  return found == table.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::string lower(std::string_view text) {
  std::string made(text);
  for (char& c : made) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return made;
}

std::string word_key(std::string_view text) {
  std::string key;
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    const auto byte = static_cast<unsigned char>(c);
    if (depth == 0 && (byte >= 0x80 || std::isalnum(byte) != 0)) key += static_cast<char>(std::tolower(byte));
    if (c == ')' && depth > 0) --depth;
  }
  return key;
}

std::string heading_key(std::string_view heading) {
  std::string key;
  int depth = 0;
  for (const char c : heading) {
    if (c == '(' || c == '[') ++depth;
    const auto byte = static_cast<unsigned char>(c);
    if (depth == 0) {
      if (byte >= 0x80 || std::isalnum(byte) != 0) {
        key += static_cast<char>(std::tolower(byte));
      } else if (!key.empty() && key.back() != ' ') {
        key += ' ';
      }
    }
    if ((c == ')' || c == ']') && depth > 0) --depth;
  }
  if (key.ends_with(' ')) key.pop_back();
  return key;
}

bool says_hexadecimal(std::string_view heading) { return lower(heading).find("hex") != std::string::npos; }

std::string_view name_of(Column column) {
  for (const Heading& heading : headings()) {
    if (heading.column == column && heading.rank == 0) return heading.key;
  }
  return "";
}

std::optional<Column> column_called(std::string_view name) {
  for (const Heading& heading : headings()) {
    if (heading.rank == 0 && heading.column != Column::left_out && heading.key == name) return heading.column;
  }
  return std::nullopt;
}

std::optional<WordOrder> order_called(std::string_view word) { return find_word(kOrders, word_key(word)); }

std::optional<Access> access_called(std::string_view word) { return find_word(kAccessWords, word_key(word)); }

std::optional<Table> listed_table_called(std::string_view word) {
  return find_word(kTableWords, word_key(word));
}

std::optional<Table> table_of_function(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t begin = text.find_first_of(kDigits);
  if (begin == std::string_view::npos) return std::nullopt;
  const bool is_hexadecimal = lower(text.substr(begin)).starts_with("0x");
  const std::string_view known = is_hexadecimal ? "0123456789abcdefABCDEFxX" : kDigits;
  std::string digits(text.substr(begin, text.find_first_not_of(known, begin) - begin));
  if (!is_hexadecimal) digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  const auto number = parse_integer(lower(digits));
  if (!number) return std::nullopt;
  const auto found = std::find_if(kTablesOfFunctions.begin(), kTablesOfFunctions.end(),
                                  [&](const auto& entry) { return entry.first == *number; });
  return found == kTablesOfFunctions.end() ? std::nullopt : std::optional(found->second);
}

std::optional<bool> yes_or_no_called(std::string_view word) { return find_word(kYesOrNo, lower(word)); }

bool is_reserved(std::string_view name) {
  return std::find(kReserved.begin(), kReserved.end(), lower(name)) != kReserved.end();
}

}  // namespace understudy::emulator::model_file
