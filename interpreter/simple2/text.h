// Small things about text that a listing needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace understudy::interpreter::simple2 {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_name_start(char c) { return (lower(c) >= 'a' && lower(c) <= 'z') || c == '_'; }
constexpr bool is_name_part(char c) { return is_name_start(c) || is_digit(c); }

constexpr bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// The rest of `text` after `prefix` in upper or lower case; empty if it does not begin so.
constexpr std::string_view after_prefix(std::string_view text, std::string_view prefix) {
  if (!same_name(text.substr(0, prefix.size()), prefix)) return {};
  return text.substr(prefix.size());
}

/// How many letters must be added, dropped or exchanged to make one of the other, upper and lower case alike;
/// `limit` if it is at least that.
inline std::size_t letters_apart(std::string_view a, std::string_view b, std::size_t limit) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= limit) return limit;
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char letter = lower(a[i]);
    std::size_t diagonal = row[0];
    std::size_t least = row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t exchanged = diagonal + (letter == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({exchanged, row[j] + 1, diagonal + 1});
      least = std::min(least, row[j + 1]);
    }
    if (least >= limit) return limit;  // no later row has less
  }
  return std::min(row[b.size()], limit);
}

/// Of `all`, whose names `name_of` gives, the first of those that are fewest letters apart from `word`.
template <class All, class NameOf>
auto nearest_name(const All& all, std::string_view word, NameOf name_of) {
  auto found = all.begin();
  std::size_t least = SIZE_MAX;
  for (auto candidate = all.begin(); candidate != all.end(); ++candidate) {
    const std::size_t apart = letters_apart(name_of(*candidate), word, least);
    if (apart >= least) continue;
    least = apart;
    found = candidate;
  }
  return found;
}

}  // namespace understudy::interpreter::simple2
