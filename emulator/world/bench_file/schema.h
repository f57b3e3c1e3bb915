// The vocabulary for declaring a file format: its keys and the schemas of their values. Readers use it to
// recognize their keys, and `understudy schema` converts it to a JSON Schema.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace understudy::emulator::world {

struct Key;

/// Describes the values that a key accepts.
struct Schema {
  enum class Kind : std::uint8_t {
    text,      // any scalar, which the reader checks
    integer,   // from `lowest` to `highest`, decimal or 0x...
    level,     // on or off
    duration,  // 250ms
    words,     // one of `words`
    list,      // a list of `of`, with `count` elements, or with at least one if `count` is 0
    names,     // a map from names (any names, or names in the bench) to `of`
    keys,      // a map with these `keys`
    either,    // one of `alternatives`
    steps,     // the steps of a scenario
  } kind = Kind::text;
  std::int64_t lowest = INT64_MIN;
  std::int64_t highest = INT64_MAX;
  std::span<const std::string_view> words{};
  const Schema* of = nullptr;
  int count = 0;
  std::span<const Key> keys{};
  std::span<const Schema* const> alternatives{};
  /// For `text` and `names`: the kind of names in the bench. A schema for a specific bench lists these names.
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
  /// Required keys may be missing at any depth, because they are in another place of the file.
  bool is_part = false;
};

struct Key {
  std::string_view key;
  std::string_view doc;  // a sentence for users who write the file
  const Schema* schema = nullptr;
  bool required = false;
};

constexpr Schema integer_schema(std::int64_t lowest, std::int64_t highest) {
  return {.kind = Schema::Kind::integer, .lowest = lowest, .highest = highest};
}
constexpr Schema words_schema(std::span<const std::string_view> words) {
  return {.kind = Schema::Kind::words, .words = words};
}
/// The results refer to the arguments of these functions, so the arguments must outlive them.
constexpr Schema list_schema(const Schema& of, int count = 0) {
  return {.kind = Schema::Kind::list, .of = &of, .count = count};
}
constexpr Schema names_schema(const Schema& of) { return {.kind = Schema::Kind::names, .of = &of}; }
constexpr Schema keys_schema(std::span<const Key> keys) { return {.kind = Schema::Kind::keys, .keys = keys}; }
constexpr Schema any_of_schemas(std::span<const Schema* const> alternatives) {
  return {.kind = Schema::Kind::either, .alternatives = alternatives};
}

constexpr Schema part_schema(Schema whole) {
  whole.is_part = true;
  return whole;
}

constexpr Schema names_schema(const Schema& of, Schema::Of whose) {
  return {.kind = Schema::Kind::names, .of = &of, .names_of = whose};
}

inline constexpr Schema kText{};
inline constexpr Schema kDeviceName{.names_of = Schema::Of::devices};
inline constexpr Schema kLineName{.names_of = Schema::Of::lines};
inline constexpr Schema kDeviceOrLineName{.names_of = Schema::Of::devices_and_lines};
inline constexpr Schema kAxisName{.names_of = Schema::Of::axes};
inline constexpr Schema kInputName{.names_of = Schema::Of::inputs};
inline constexpr Schema kLevel{.kind = Schema::Kind::level};
inline constexpr Schema kDuration{.kind = Schema::Kind::duration};
inline constexpr Schema kSteps{.kind = Schema::Kind::steps};
inline constexpr Schema kTextByName = names_schema(kText);
inline constexpr Schema kTextByDevice = names_schema(kText, Schema::Of::devices);
inline constexpr Schema kTextByInput = names_schema(kText, Schema::Of::inputs);
inline constexpr Schema kTextByTurned = names_schema(kText, Schema::Of::turned);  // inputs, and `in`
inline constexpr Schema kTextByRegister = names_schema(kText, Schema::Of::registers);
inline constexpr Schema kLevelByName = names_schema(kLevel);
inline constexpr Schema kTextList = list_schema(kText);

}  // namespace understudy::emulator::world
