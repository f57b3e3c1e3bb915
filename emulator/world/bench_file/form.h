// The vocabulary for declaring a file format: its keys and the forms of their values. Readers use it to tell
// which keys they know; `understudy schema` turns it into a JSON Schema.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace understudy::emulator::world {

struct KeyRow;

/// The form of a value.
struct Form {
  enum class Kind : std::uint8_t {
    text,      // a word, a number, a sentence: the reader knows more
    integer,   // from `lowest` to `highest`, decimal or 0x...
    level,     // on or off
    duration,  // 250ms
    words,     // one of `words`
    list,      // of `of`, `count` of them (0: one or more)
    names,     // a map from names of the user's, or of the bench's, to `of`
    keys,      // a map with the keys of `keys`
    either,    // one of `ways`
    steps,     // the steps of a scenario
  } kind = Kind::text;
  std::int64_t lowest = INT64_MIN;
  std::int64_t highest = INT64_MAX;
  std::span<const std::string_view> words{};
  const Form* of = nullptr;
  int count = 0;
  std::span<const KeyRow> keys{};
  std::span<const Form* const> ways{};
  /// For `text` and `names`: the kind of names in the bench. A schema for one bench lists them.
  enum class Of : std::uint8_t {
    anything,
    devices,
    lines,
    devices_and_lines,
    axes,
    inputs,
    turned,
    registers
  } names_of = Of::anything;
  /// What is required may be missing, at any depth: it stands elsewhere in the file.
  bool is_part = false;
};

struct KeyRow {
  std::string_view key;
  std::string_view doc;  // a sentence for the author of the file
  const Form* form = nullptr;
  bool required = false;
};

constexpr Form integer_form(std::int64_t lowest, std::int64_t highest) {
  return {.kind = Form::Kind::integer, .lowest = lowest, .highest = highest};
}
constexpr Form words_form(std::span<const std::string_view> words) {
  return {.kind = Form::Kind::words, .words = words};
}
/// Everything it refers to must outlive the form; all of it is constant.
constexpr Form list_form(const Form& of, int count = 0) {
  return {.kind = Form::Kind::list, .of = &of, .count = count};
}
constexpr Form names_form(const Form& of) { return {.kind = Form::Kind::names, .of = &of}; }
constexpr Form keys_form(std::span<const KeyRow> keys) { return {.kind = Form::Kind::keys, .keys = keys}; }
constexpr Form either_form(std::span<const Form* const> ways) {
  return {.kind = Form::Kind::either, .ways = ways};
}

constexpr Form part_form(Form whole) {
  whole.is_part = true;
  return whole;
}

constexpr Form names_form(const Form& of, Form::Of whose) {
  return {.kind = Form::Kind::names, .of = &of, .names_of = whose};
}

inline constexpr Form kText{};
inline constexpr Form kDeviceName{.names_of = Form::Of::devices};
inline constexpr Form kLineName{.names_of = Form::Of::lines};
inline constexpr Form kDeviceOrLineName{.names_of = Form::Of::devices_and_lines};
inline constexpr Form kAxisName{.names_of = Form::Of::axes};
inline constexpr Form kInputName{.names_of = Form::Of::inputs};
inline constexpr Form kLevel{.kind = Form::Kind::level};
inline constexpr Form kDuration{.kind = Form::Kind::duration};
inline constexpr Form kSteps{.kind = Form::Kind::steps};
inline constexpr Form kTextByName = names_form(kText);
inline constexpr Form kTextByDevice = names_form(kText, Form::Of::devices);
inline constexpr Form kTextByInput = names_form(kText, Form::Of::inputs);
inline constexpr Form kTextByTurned = names_form(kText, Form::Of::turned);  // inputs, and `in`
inline constexpr Form kTextByRegister = names_form(kText, Form::Of::registers);
inline constexpr Form kLevelByName = names_form(kLevel);
inline constexpr Form kTextList = list_form(kText);

}  // namespace understudy::emulator::world
