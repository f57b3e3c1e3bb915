// Determines at compile time which values of an enumeration have names, and what those names are. Tables that
// need a row for each value use this.
#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>

namespace understudy {

template <auto value>
constexpr bool has_name() {
  // The compiler writes "... value = Colour::red]" for a value that has a name, and "... value = (Colour)7]"
  // for a value that has none.
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_suffix(1);
  const std::size_t bracket = text.rfind(')');
  return bracket == std::string_view::npos ||
         text.find_first_not_of("0123456789", bracket + 1) != std::string_view::npos;
}

/// Returns the name of an enumerator.
template <auto value>
constexpr auto name_of() {
  std::string_view text = __PRETTY_FUNCTION__;  // as above
  text.remove_suffix(1);
  return text.substr(text.rfind(':') + 1);
}

/// Returns true if the enumeration has no value after `last`.
template <auto last>
constexpr bool is_last() {
  using T = decltype(last);
  using Number = std::underlying_type_t<T>;
  return !has_name<static_cast<T>(static_cast<Number>(static_cast<Number>(last) + 1))>();
}

}  // namespace understudy
