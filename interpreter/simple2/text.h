// Small text functions for listings.
#pragma once

#include <algorithm>
#include <string_view>

namespace understudy::interpreter::simple2 {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_name_start(char c) { return (lower(c) >= 'a' && lower(c) <= 'z') || c == '_'; }
constexpr bool is_name_part(char c) { return is_name_start(c) || is_digit(c); }

constexpr bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// Returns the rest of `text` after `prefix`, which may be in upper or lower case, or an empty text if `text`
/// does not begin with it.
constexpr std::string_view after_prefix(std::string_view text, std::string_view prefix) {
  if (!same_name(text.substr(0, prefix.size()), prefix)) return {};
  return text.substr(prefix.size());
}

}  // namespace understudy::interpreter::simple2
