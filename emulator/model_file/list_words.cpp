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

using TypeKind = TypeMeaning::Kind;
struct TypeWord {
  std::string_view word;
  TypeKind kind;
  Type type;
  int words;
  int bits = 0;
};
/// Two's complement and IEEE 754. INT has 16 bits, as in PLCs (IEC 61131-3).
constexpr std::array kTypeWords{
    TypeWord{"u16", TypeKind::number, Type::u16, 1},
    TypeWord{"uint16", TypeKind::number, Type::u16, 1},
    TypeWord{"uint16t", TypeKind::number, Type::u16, 1},
    TypeWord{"uint", TypeKind::number, Type::u16, 1},
    TypeWord{"word", TypeKind::number, Type::u16, 1},
    TypeWord{"ushort", TypeKind::number, Type::u16, 1},
    TypeWord{"unsigned", TypeKind::number, Type::u16, 1},
    TypeWord{"unsigned16", TypeKind::number, Type::u16, 1},
    TypeWord{"unsignedint", TypeKind::number, Type::u16, 1},
    TypeWord{"unsignedint16", TypeKind::number, Type::u16, 1},
    TypeWord{"unsignedshort", TypeKind::number, Type::u16, 1},
    TypeWord{"enum16", TypeKind::number, Type::u16, 1},
    TypeWord{"enum", TypeKind::number, Type::u16, 1},
    TypeWord{"acc16", TypeKind::number, Type::u16, 1},
    TypeWord{"bitfield16", TypeKind::number, Type::u16, 1},
    TypeWord{"bitfield", TypeKind::number, Type::u16, 1},
    TypeWord{"bitmask", TypeKind::number, Type::u16, 1},
    TypeWord{"16bitflags", TypeKind::number, Type::u16, 1},
    TypeWord{"8bitflags", TypeKind::number, Type::u16, 1},
    TypeWord{"16bit", TypeKind::number, Type::u16, 1},
    TypeWord{"u8", TypeKind::number, Type::u16, 1, 8},
    TypeWord{"uint8", TypeKind::number, Type::u16, 1, 8},
    TypeWord{"byte", TypeKind::number, Type::u16, 1, 8},
    TypeWord{"usint", TypeKind::number, Type::u16, 1, 8},
    TypeWord{"无符号", TypeKind::number, Type::u16, 1},
    TypeWord{"無符號", TypeKind::number, Type::u16, 1},
    TypeWord{"s16", TypeKind::number, Type::s16, 1},
    TypeWord{"i16", TypeKind::number, Type::s16, 1},
    TypeWord{"int16", TypeKind::number, Type::s16, 1},
    TypeWord{"int16t", TypeKind::number, Type::s16, 1},
    TypeWord{"sint16", TypeKind::number, Type::s16, 1},
    TypeWord{"int", TypeKind::number, Type::s16, 1},
    TypeWord{"short", TypeKind::number, Type::s16, 1},
    TypeWord{"signed", TypeKind::number, Type::s16, 1},
    TypeWord{"signed16", TypeKind::number, Type::s16, 1},
    TypeWord{"signedint", TypeKind::number, Type::s16, 1},
    TypeWord{"integer", TypeKind::number, Type::s16, 1},
    TypeWord{"integer16", TypeKind::number, Type::s16, 1},
    TypeWord{"sunssf", TypeKind::number, Type::s16, 1},
    TypeWord{"s8", TypeKind::number, Type::s16, 1, 8},
    TypeWord{"int8", TypeKind::number, Type::s16, 1, 8},
    TypeWord{"sint", TypeKind::number, Type::s16, 1, 8},
    TypeWord{"有符号", TypeKind::number, Type::s16, 1},
    TypeWord{"有符號", TypeKind::number, Type::s16, 1},
    TypeWord{"u32", TypeKind::number, Type::u32, 2},
    TypeWord{"uint32", TypeKind::number, Type::u32, 2},
    TypeWord{"uint32t", TypeKind::number, Type::u32, 2},
    TypeWord{"udint", TypeKind::number, Type::u32, 2},
    TypeWord{"dword", TypeKind::number, Type::u32, 2},
    TypeWord{"doubleword", TypeKind::number, Type::u32, 2},
    TypeWord{"ulong", TypeKind::number, Type::u32, 2},
    TypeWord{"unsigned32", TypeKind::number, Type::u32, 2},
    TypeWord{"unsignedint32", TypeKind::number, Type::u32, 2},
    TypeWord{"unsignedlong", TypeKind::number, Type::u32, 2},
    TypeWord{"acc32", TypeKind::number, Type::u32, 2},
    TypeWord{"enum32", TypeKind::number, Type::u32, 2},
    TypeWord{"bitfield32", TypeKind::number, Type::u32, 2},
    TypeWord{"32bitflags", TypeKind::number, Type::u32, 2},
    TypeWord{"32bit", TypeKind::number, Type::u32, 2},
    TypeWord{"ipaddr", TypeKind::number, Type::u32, 2},
    TypeWord{"s32", TypeKind::number, Type::s32, 2},
    TypeWord{"i32", TypeKind::number, Type::s32, 2},
    TypeWord{"int32", TypeKind::number, Type::s32, 2},
    TypeWord{"int32t", TypeKind::number, Type::s32, 2},
    TypeWord{"sint32", TypeKind::number, Type::s32, 2},
    TypeWord{"dint", TypeKind::number, Type::s32, 2},
    TypeWord{"long", TypeKind::number, Type::s32, 2},
    TypeWord{"signed32", TypeKind::number, Type::s32, 2},
    TypeWord{"signedint32", TypeKind::number, Type::s32, 2},
    TypeWord{"integer32", TypeKind::number, Type::s32, 2},
    TypeWord{"f32", TypeKind::number, Type::f32, 2},
    TypeWord{"float", TypeKind::number, Type::f32, 2},
    TypeWord{"float32", TypeKind::number, Type::f32, 2},
    TypeWord{"real", TypeKind::number, Type::f32, 2},
    TypeWord{"single", TypeKind::number, Type::f32, 2},
    TypeWord{"ieee754", TypeKind::number, Type::f32, 2},
    TypeWord{"ieee", TypeKind::number, Type::f32, 2},
    TypeWord{"浮点", TypeKind::number, Type::f32, 2},
    TypeWord{"浮點", TypeKind::number, Type::f32, 2},
    TypeWord{"bit", TypeKind::number, Type::bit, 1},
    TypeWord{"bool", TypeKind::number, Type::bit, 1},
    TypeWord{"boolean", TypeKind::number, Type::bit, 1},
    TypeWord{"coil", TypeKind::number, Type::bit, 1},
    TypeWord{"bcd", TypeKind::decimal, Type::u16, 1},
    TypeWord{"bcd16", TypeKind::decimal, Type::u16, 1},
    TypeWord{"bcd32", TypeKind::decimal, Type::u32, 2},
    TypeWord{"u64", TypeKind::only_words, Type::u16, 4},
    TypeWord{"s64", TypeKind::only_words, Type::u16, 4},
    TypeWord{"i64", TypeKind::only_words, Type::u16, 4},
    TypeWord{"uint64", TypeKind::only_words, Type::u16, 4},
    TypeWord{"int64", TypeKind::only_words, Type::u16, 4},
    TypeWord{"sint64", TypeKind::only_words, Type::u16, 4},
    TypeWord{"acc64", TypeKind::only_words, Type::u16, 4},
    TypeWord{"ulint", TypeKind::only_words, Type::u16, 4},
    TypeWord{"lint", TypeKind::only_words, Type::u16, 4},
    TypeWord{"lword", TypeKind::only_words, Type::u16, 4},
    TypeWord{"qword", TypeKind::only_words, Type::u16, 4},
    TypeWord{"longlong", TypeKind::only_words, Type::u16, 4},
    TypeWord{"f64", TypeKind::only_words, Type::f32, 4},
    TypeWord{"float64", TypeKind::only_words, Type::f32, 4},
    TypeWord{"double", TypeKind::only_words, Type::f32, 4},
    TypeWord{"lreal", TypeKind::only_words, Type::f32, 4},
    TypeWord{"words", TypeKind::only_words, Type::u16, 0},
    TypeWord{"raw", TypeKind::only_words, Type::u16, 0},
    TypeWord{"rawhex", TypeKind::only_words, Type::u16, 0},
    TypeWord{"hex", TypeKind::only_words, Type::u16, 0},
    TypeWord{"bytes", TypeKind::only_words, Type::u16, 0},
    TypeWord{"array", TypeKind::only_words, Type::u16, 0},
    TypeWord{"string", TypeKind::text, Type::u16, 0},
    TypeWord{"str", TypeKind::text, Type::u16, 0},
    TypeWord{"text", TypeKind::text, Type::u16, 0},
    TypeWord{"ascii", TypeKind::text, Type::u16, 0},
    TypeWord{"char", TypeKind::text, Type::u16, 0},
    TypeWord{"utf8", TypeKind::text, Type::u16, 0},
    TypeWord{"字符串", TypeKind::text, Type::u16, 0},
    TypeWord{"字串", TypeKind::text, Type::u16, 0},
};

/// Returns a word without parts in parentheses, blanks and punctuation: "rw" for "R/W".
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

template <typename Pairs>
auto find_word(const Pairs& table, std::string_view key) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == key; });
  return found == table.end() ? std::nullopt : std::optional(found->second);
}

const TypeWord* find_type(std::string_view key) {
  const auto* const found = std::find_if(kTypeWords.begin(), kTypeWords.end(),
                                         [&](const TypeWord& entry) { return entry.word == key; });
  return found == kTypeWords.end() ? nullptr : found;
}

TypeMeaning meaning_of(const TypeWord& word) {
  return {.kind = word.kind, .type = word.type, .words = word.words, .bits = word.bits};
}

/// Returns the meaning of a type that includes its word order: "uint32sw".
std::optional<TypeMeaning> with_order(std::string_view key) {
  constexpr std::size_t kShortest = 2;
  constexpr std::size_t kLongest = 4;
  for (std::size_t length = kShortest; length <= kLongest && length < key.size(); ++length) {
    const auto order = find_word(kOrders, key.substr(key.size() - length));
    const TypeWord* const word = find_type(key.substr(0, key.size() - length));
    if (!order || word == nullptr) continue;
    TypeMeaning meaning = meaning_of(*word);
    meaning.order = *order;
    return meaning;
  }
  return std::nullopt;
}

/// Returns the meaning of a type that includes a number: "string16" has 16 characters, "4bit" is part of a
/// word.
std::optional<TypeMeaning> with_number(std::string_view key) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t end = key.find_last_not_of(kDigits);
  const std::size_t begin = key.find_first_not_of(kDigits);
  if (end == std::string_view::npos) return std::nullopt;
  if (const auto bits = parse_integer(key.substr(0, begin)); bits && key.substr(begin) == "bit") {
    if (*bits < 1 || *bits > 15) return std::nullopt;
    return TypeMeaning{.kind = TypeKind::part, .bits = static_cast<int>(*bits)};
  }
  const auto number = parse_integer(key.substr(end + 1));
  const TypeWord* const word = find_type(key.substr(0, end + 1));
  if (!number || word == nullptr || word->words != 0 || *number < 1 || *number > 250) return std::nullopt;
  TypeMeaning meaning = meaning_of(*word);
  const bool counts_characters = word->kind == TypeKind::text || word->word == "bytes";
  meaning.words = static_cast<int>(counts_characters ? (*number + 1) / 2 : *number);
  return meaning;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string made(text);
  for (char& c : made) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return made;
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

std::optional<TypeMeaning> type_called(std::string_view word) {
  const std::string key = word_key(word);
  const TypeWord* const found = find_type(key);
  if (found != nullptr && found->words != 0) return meaning_of(*found);
  if (const auto meaning = with_order(key)) return meaning;
  // "STRING(16)": the number is in parentheses.
  std::string whole;
  for (const char c : word) {
    if (c != '(' && c != ')') whole += c;
  }
  if (const auto meaning = with_number(word_key(whole))) return meaning;
  return found == nullptr ? std::nullopt : std::optional(meaning_of(*found));
}

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
