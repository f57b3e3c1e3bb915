// Parses JSON more strictly than the library, which silently keeps the last of several equal keys and limits
// the depth only by memory. Include this only in files that read JSON, because the library is slow to
// compile.
#pragma once

#include <climits>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::world {

/// Thrown for text that is nested more deeply than anything that we write.
struct TooDeepJson : std::runtime_error {
  TooDeepJson() : std::runtime_error("is nested too deeply") {}
};

/// Thrown for an object with too many members, because the library searches all members for each new one.
struct TooManyMembers : std::runtime_error {
  explicit TooManyMembers(std::size_t max)
      : std::runtime_error("an object has more than " + std::to_string(max) + " members") {}
};

/// Limits on the parsed text.
struct JsonBounds {
  int deepest = INT_MAX;               // how deeply objects and lists may nest
  std::size_t max_members = SIZE_MAX;  // of one object
};

/// Throws the result of `twice` for a key that occurs twice in an object, TooDeepJson and TooManyMembers for
/// text that exceeds `bounds`, and nlohmann's own exceptions for text that is not JSON.
template <typename Json, typename Twice>
Json parse_strict_json(std::string_view text, const Twice& twice, const JsonBounds& bounds = {}) {
  std::vector<std::set<std::string>> keys;  // one set per open object
  return Json::parse(text, [&](int depth, typename Json::parse_event_t event, Json& parsed) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (opens && depth >= bounds.deepest) throw TooDeepJson();
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event != Json::parse_event_t::key) return true;
    const auto& key = parsed.template get_ref<const std::string&>();
    if (!keys.back().insert(key).second) throw twice(key);
    if (keys.back().size() > bounds.max_members) throw TooManyMembers(bounds.max_members);
    return true;
  });
}

}  // namespace understudy::emulator::world
