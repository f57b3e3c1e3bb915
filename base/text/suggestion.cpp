#include "base/text/suggestion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace understudy {

namespace {

constexpr std::size_t kLongestWord = 64;  // no name is longer, and the work grows with it
constexpr std::size_t kLeastBeginning = 3;
constexpr std::size_t kMostListed = 8;

char small(char letter) { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); }

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

/// A bit for each letter that is there. Several letters share one, so that words may look more alike than
/// they are, never less.
std::uint64_t letters_of(std::string_view word) {
  std::uint64_t letters = 0;
  for (const char letter : word) letters |= std::uint64_t{1} << (small(letter) & 63);
  return letters;
}

/// A lower bound of the distance: each letter that is missing, or too many, is a change.
std::size_t least_distance(std::string_view a, std::uint64_t letters_of_a, std::string_view b) {
  const std::size_t longer = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
  const std::uint64_t letters_of_b = letters_of(b);
  return std::max({longer, static_cast<std::size_t>(std::popcount(letters_of_a & ~letters_of_b)),
                   static_cast<std::size_t>(std::popcount(letters_of_b & ~letters_of_a))});
}

/// Levenshtein's distance, where two neighbours that are swapped count once; `limit` if it is at least that.
/// A row is about a longer and longer beginning of `b`; each of its cells about one of `a`, in small letters.
std::size_t distance(std::string_view a, std::string_view b, std::size_t limit) {
  using Row = std::array<std::size_t, kLongestWord + 1>;
  std::array<Row, 3> rows;
  Row* row = &rows[0];
  Row* above = &rows[1];
  Row* two_above = &rows[2];
  std::iota(row->begin(), row->end(), std::size_t{0});
  std::size_t least_above = 0;
  char letter_before = 0;
  for (std::size_t i = 1; i <= b.size(); ++i) {
    std::swap(two_above, above);
    std::swap(above, row);
    const char letter = small(b[i - 1]);
    (*row)[0] = i;
    std::size_t least = i;
    for (std::size_t j = 1; j <= a.size(); ++j) {
      std::size_t changes = (*above)[j - 1] + (a[j - 1] == letter ? 0 : 1);
      changes = std::min({changes, (*above)[j] + 1, (*row)[j - 1] + 1});
      const bool is_swapped = i > 1 && j > 1 && a[j - 1] == letter_before && a[j - 2] == letter;
      if (is_swapped) changes = std::min(changes, (*two_above)[j - 2] + 1);
      (*row)[j] = changes;
      least = std::min(least, changes);
    }
    // What follows is made from these two rows.
    if (std::min(least, least_above) >= limit) return limit;
    least_above = least;
    letter_before = letter;
  }
  return std::min((*row)[a.size()], limit);
}

}  // namespace

std::optional<std::string> near_word(std::string_view word, std::span<const std::string> known) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  const std::string written = small(word);
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  const std::uint64_t letters = letters_of(written);
  const std::string* nearest = nullptr;
  for (const std::string& candidate : known) {
    const std::size_t limit = std::min(least, candidate.size());  // something of a short one must be left
    if (least_distance(written, letters, candidate) >= limit) continue;
    const std::size_t apart = distance(written, candidate, limit);
    if (apart >= limit) continue;
    least = apart;
    nearest = &candidate;
  }
  if (nearest != nullptr) return *nearest;
  if (word.size() < kLeastBeginning) return std::nullopt;
  const auto longer = std::find_if(known.begin(), known.end(), [&](const std::string& candidate) {
    return begins_with(candidate, written);
  });
  return longer == known.end() ? std::nullopt : std::optional(*longer);
}

std::string suggestion(std::string_view word, std::span<const std::string> known, const std::string& none) {
  if (known.empty()) return "; " + none;
  if (const auto nearest = near_word(word, known)) return "; the nearest is '" + *nearest + "'";
  if (known.size() == 1) return "; expected '" + known.front() + "'";
  if (known.size() > kMostListed) return "; expected one such as '" + known.front() + "'";
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  return "; expected one of " + list;
}

}  // namespace understudy
