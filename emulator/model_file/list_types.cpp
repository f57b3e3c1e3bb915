// The words for types, in the languages of manuals and of other programs.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/parse_integer.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

namespace {

using TypeKind = TypeMeaning::Kind;
struct TypeWord {
  std::string_view word;
  TypeKind kind;
  Type type;
  int words;
  int bits = 0;
};
/// Two's complement and IEEE 754; INT has 16 bits, as in PLCs (IEC 61131-3).
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
    TypeWord{"uword", TypeKind::number, Type::u16, 1},
    TypeWord{"sword", TypeKind::number, Type::s16, 1},
    TypeWord{"udword", TypeKind::number, Type::u32, 2},
    TypeWord{"sdword", TypeKind::number, Type::s32, 2},
    TypeWord{"fp32", TypeKind::number, Type::f32, 2},
    TypeWord{"uqword", TypeKind::only_words, Type::u16, 4},
    TypeWord{"sqword", TypeKind::only_words, Type::u16, 4},
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

const TypeWord* find_type(std::string_view key) {
  const auto* const found = std::find_if(kTypeWords.begin(), kTypeWords.end(),
                                         [&](const TypeWord& entry) { return entry.word == key; });
  return found == kTypeWords.end() ? nullptr : found;
}

TypeMeaning meaning_of(const TypeWord& word) {
  return {.kind = word.kind, .type = word.type, .words = word.words, .bits = word.bits};
}

/// Returns the meaning of a type that says how its words are ordered: "uint32sw".
std::optional<TypeMeaning> with_order(std::string_view key) {
  constexpr std::size_t kShortest = 2;
  constexpr std::size_t kLongest = 4;
  for (std::size_t length = kShortest; length <= kLongest && length < key.size(); ++length) {
    const auto order = order_called(key.substr(key.size() - length));
    const TypeWord* const word = find_type(key.substr(0, key.size() - length));
    if (!order || word == nullptr) continue;
    TypeMeaning meaning = meaning_of(*word);
    meaning.order = *order;
    return meaning;
  }
  return std::nullopt;
}

/// Returns the meaning of a type with a number: "string16" has 16 characters, "4bit" is a part of a word.
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

/// The words for kinds of numbers whose width is a part of the type: "16-bit unsigned", "无符号16位".
constexpr std::array<std::pair<std::string_view, std::string_view>, 22> kNumberWords{{
    {"unsigned", "u"},   {"unsignedint", "u"}, {"unsignedinteger", "u"}, {"uint", "u"},
    {"无符号", "u"},     {"无符号整数", "u"},  {"无符号整型", "u"},      {"無符號", "u"},
    {"無符號整數", "u"}, {"signed", "s"},      {"signedint", "s"},       {"signedinteger", "s"},
    {"int", "s"},        {"integer", "s"},     {"有符号", "s"},          {"有符号整数", "s"},
    {"有符号整型", "s"}, {"有符號", "s"},      {"有符號整數", "s"},      {"float", "f"},
    {"浮点数", "f"},     {"浮點數", "f"},
}};

/// Returns the meaning of a type whose width is a word of its own: "32-bit float", "Unsigned 16 bits".
std::optional<TypeMeaning> with_width(std::string_view key) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t begin = key.find_first_of(kDigits);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = std::min(key.find_first_not_of(kDigits, begin), key.size());
  const std::string_view after = key.substr(end);
  // "bitsigned" is a bit and "signed", not bits.
  for (const std::string_view unit : {"bits", "bit", "位元", "位", ""}) {
    if (!after.starts_with(unit)) continue;
    const std::string kind = std::string(key.substr(0, begin)) + std::string(after.substr(unit.size()));
    const auto* const found = std::find_if(kNumberWords.begin(), kNumberWords.end(),
                                           [&](const auto& entry) { return entry.first == kind; });
    if (found == kNumberWords.end()) continue;
    const TypeWord* const word =
        find_type(std::string(found->second) + std::string(key.substr(begin, end - begin)));
    return word == nullptr ? std::nullopt : std::optional(meaning_of(*word));
  }
  return std::nullopt;
}

/// Returns the meaning of a type with its low word first, as ESPHome writes it: "U_DWORD_R".
std::optional<TypeMeaning> with_reversed_words(std::string_view key) {
  if (!key.ends_with("wordr") && key != "fp32r") return std::nullopt;
  const TypeWord* const word = find_type(key.substr(0, key.size() - 1));
  if (word == nullptr) return std::nullopt;
  TypeMeaning meaning = meaning_of(*word);
  meaning.order = {.words = WordOrder::Words::low_first};
  return meaning;
}

}  // namespace

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
  if (const auto meaning = with_width(key)) return meaning;
  if (const auto meaning = with_reversed_words(key)) return meaning;
  return found == nullptr ? std::nullopt : std::optional(meaning_of(*found));
}

}  // namespace understudy::emulator::model_file
