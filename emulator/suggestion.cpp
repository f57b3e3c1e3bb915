#include "emulator/suggestion.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <numeric>
#include <vector>

namespace understudy::emulator {

namespace {

constexpr std::size_t kLongestWord = 64;  // no name is longer, and the work grows with it
constexpr std::size_t kLeastBeginning = 3;
constexpr std::size_t kMostListed = 8;

std::string small(std::string_view text) {
  std::string letters(text);
  std::transform(letters.begin(), letters.end(), letters.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return letters;
}

/// Levenshtein's distance, where two neighbours that are swapped count once. A row is about a longer and
/// longer beginning of `a`; each of its cells about one of `b`.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  std::vector<std::size_t> above = row;
  std::vector<std::size_t> two_above = row;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    two_above.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({other, above[j] + 1, row[j - 1] + 1});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> near_word(std::string_view word, std::span<const std::string> known) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  const std::string written = small(word);
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  std::optional<std::string> nearest;
  for (const std::string& candidate : known) {
    const std::size_t apart = distance(written, small(candidate));
    if (apart >= least || apart >= candidate.size()) continue;  // nothing of a short one may be left over
    least = apart;
    nearest = candidate;
  }
  if (nearest || word.size() < kLeastBeginning) return nearest;
  const auto longer = std::find_if(known.begin(), known.end(), [&](const std::string& candidate) {
    return small(candidate).starts_with(written);
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

}  // namespace understudy::emulator
