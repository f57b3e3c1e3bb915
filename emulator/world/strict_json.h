// Parses JSON more strictly than its library, which silently keeps the last of two equal keys and follows
// brackets as deep as memory allows. Only files that read JSON include this, because the library is slow to
// compile.
#pragma once

#include <climits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::world {

/// Thrown for text that is nested deeper than anything we write.
struct TooDeepJson : std::runtime_error {
  TooDeepJson() : std::runtime_error("is nested too deeply") {}
};

/// Throws the result of `twice` for a key that appears twice in one object, TooDeepJson if more than
/// `deepest` objects and lists are open, and nlohmann's own exceptions for text that is not JSON.
template <typename Json, typename Twice>
Json parse_strict_json(std::string_view text, const Twice& twice, int deepest = INT_MAX) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  return Json::parse(text, [&](int depth, typename Json::parse_event_t event, Json& parsed) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (opens && depth >= deepest) throw TooDeepJson();
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event != Json::parse_event_t::key) return true;
    const auto& key = parsed.template get_ref<const std::string&>();
    if (!keys.back().insert(key).second) throw twice(key);
    return true;
  });
}

}  // namespace understudy::emulator::world
