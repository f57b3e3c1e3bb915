// A model's transition table, which defines how a part of its devices reacts to each event in each state. The
// code uses the model's own tables; this is their outline, for coverage.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/enumerators.h"

namespace understudy::emulator {

struct TransitionTable {
  std::string_view name;  // "reactions of an axis"
  std::vector<std::string> states;
  std::vector<std::string> events;
  /// Returns false for a cell that cannot occur. Null: all cells can occur.
  bool (*can_occur)(std::size_t state, std::size_t event) = nullptr;
};

/// Returns the names of the first values of an enumeration, with spaces: "in alarm".
template <class T, std::size_t count>
std::vector<std::string> words_of() {
  const auto word = [](std::string_view name) {
    std::string text(name);
    for (char& letter : text) letter = letter == '_' ? ' ' : letter;
    while (text.ends_with(' ')) text.pop_back();
    return text;
  };
  return [&]<std::size_t... number>(std::index_sequence<number...>) {
    return std::vector<std::string>{word(understudy::name_of<static_cast<T>(number)>())...};
  }
  (std::make_index_sequence<count>());
}

}  // namespace understudy::emulator
