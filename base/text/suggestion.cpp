#include "base/text/suggestion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy {

namespace {

constexpr std::size_t kLongestWord = 64;  // no known name is longer, and the work grows with the length
constexpr std::size_t kMinBeginning = 3;
constexpr std::size_t kMaxListed = 8;

constexpr char small(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string small(std::string_view text) {
  std::string letters(text);
  for (char& letter : letters) letter = small(letter);
  return letters;
}

bool begins_with(std::string_view text, std::string_view small_beginning) {
  return text.size() >= small_beginning.size() &&
         std::equal(small_beginning.begin(), small_beginning.end(), text.begin(),
                    [](char a, char b) { return a == small(b); });
}

/// Returns a bit for each letter of the word. Several letters share a bit, so words may look more similar
/// than they are, but never less.
std::uint64_t letters_of(std::string_view word) {
  std::uint64_t letters = 0;
  for (const char letter : word) letters |= std::uint64_t{1} << (small(letter) & 63);
  return letters;
}

/// Returns a lower bound of the distance: each missing or extra letter is a change.
std::size_t min_distance(std::string_view a, std::uint64_t letters_of_a, std::string_view b) {
  const std::size_t longer = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
  const std::uint64_t letters_of_b = letters_of(b);
  return std::max({longer, static_cast<std::size_t>(std::popcount(letters_of_a & ~letters_of_b)),
                   static_cast<std::size_t>(std::popcount(letters_of_b & ~letters_of_a))});
}

/// Returns the Levenshtein distance, counting a swap of two neighbours as one change, or `limit` if the
/// distance is at least `limit`. Each row is for a prefix of `b`, and each cell of a row is for a prefix of
/// `a`, which is in lower case.
std::size_t distance(std::string_view a, std::string_view b, std::size_t limit) {
  // A common prefix or suffix does not change the distance, and related names often have one.
  const auto is_same = [](char x, char y) { return x == small(y); };
  const auto beginning = static_cast<std::size_t>(std::ranges::mismatch(a, b, is_same).in1 - a.begin());
  a.remove_prefix(beginning);
  b.remove_prefix(beginning);
  while (!a.empty() && !b.empty() && is_same(a.back(), b.back())) {
    a.remove_suffix(1);
    b.remove_suffix(1);
  }
  if (a.empty() || b.empty()) return std::min(std::max(a.size(), b.size()), limit);
  using Row = std::array<std::size_t, kLongestWord + 1>;
  std::array<Row, 3> rows;
  Row* row = &rows[0];
  Row* above = &rows[1];
  Row* two_above = &rows[2];
  std::iota(row->begin(), row->end(), std::size_t{0});
  std::size_t min_above = 0;
  char letter_before = 0;
  for (std::size_t i = 1; i <= b.size(); ++i) {
    std::swap(two_above, above);
    std::swap(above, row);
    const char letter = small(b[i - 1]);
    (*row)[0] = i;
    std::size_t min = i;
    for (std::size_t j = 1; j <= a.size(); ++j) {
      std::size_t changes = (*above)[j - 1] + (a[j - 1] == letter ? 0 : 1);
      changes = std::min({changes, (*above)[j] + 1, (*row)[j - 1] + 1});
      const bool is_swapped = i > 1 && j > 1 && a[j - 1] == letter_before && a[j - 2] == letter;
      if (is_swapped) changes = std::min(changes, (*two_above)[j - 2] + 1);
      (*row)[j] = changes;
      min = std::min(min, changes);
    }
    // The next rows are computed from these two rows.
    if (std::min(min, min_above) >= limit) return limit;
    min_above = min;
    letter_before = letter;
  }
  return std::min((*row)[a.size()], limit);
}

/// Returns the first known word that is longer than `written` and begins with it.
std::optional<std::string> beginning_of(const std::string& written, std::span<const std::string> known) {
  if (written.size() < kMinBeginning) return std::nullopt;
  const auto longer = std::find_if(known.begin(), known.end(), [&](const std::string& candidate) {
    return begins_with(candidate, written);
  });
  return longer == known.end() ? std::nullopt : std::optional(*longer);
}

}  // namespace

std::optional<std::string> near_word(std::string_view word, std::span<const std::string> known) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  const std::string written = small(word);
  std::size_t min = std::max<std::size_t>(1, word.size() / 3) + 1;
  const std::uint64_t letters = letters_of(written);
  std::vector<std::size_t> bounds;  // a lower bound of each word's distance
  bounds.reserve(known.size());
  for (const std::string& candidate : known) bounds.push_back(min_distance(written, letters, candidate));
  const auto limit_of = [&](const std::string& candidate) {
    return std::min(min, candidate.size());  // at least one letter of a short word must match
  };
  if (!known.empty()) {
    // Start with the most similar word, because the other words then seldom need the full computation.
    const auto first = static_cast<std::size_t>(std::ranges::min_element(bounds) - bounds.begin());
    const std::size_t limit = limit_of(known[first]);
    if (bounds[first] >= min) return beginning_of(written, known);
    if (const std::size_t apart = distance(written, known[first], limit); apart < limit) min = apart + 1;
  }
  const std::string* nearest = nullptr;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string& candidate = known[i];
    const std::size_t limit = limit_of(candidate);
    if (bounds[i] >= limit) continue;
    const std::size_t apart = distance(written, candidate, limit);
    if (apart >= limit) continue;
    min = apart;
    nearest = &candidate;
  }
  return nearest != nullptr ? std::optional(*nearest) : beginning_of(written, known);
}

std::string suggestion(std::string_view word, std::span<const std::string> known, const std::string& none) {
  if (known.empty()) return "; " + none;
  if (const auto nearest = near_word(word, known)) return "; the nearest is '" + *nearest + "'";
  if (known.size() == 1) return "; expected '" + known.front() + "'";
  if (known.size() > kMaxListed) return "; expected one such as '" + known.front() + "'";
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  return "; expected one of " + list;
}

}  // namespace understudy
