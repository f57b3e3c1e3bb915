// Finds where two values of the same type differ, and names the fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "base/text/one_line.h"

namespace understudy {

template <class T>
std::string first_difference(const T& a, const T& b, const std::string& path = "");

namespace state_fields {

/// Returns "path: a against b", without "path: " if the path is empty.
std::string difference_text(const std::string& path, const std::string& a, const std::string& b);
std::string difference_text(const std::string& path, const std::string& what);
/// Returns "path.name" or "path[name]".
std::string path_to(const std::string& path, std::string_view name);
std::string path_to_element(const std::string& path, const std::string& name);
/// Returns the text in quotes, with unprintable characters as \x07.
std::string text_in_quotes(std::string_view text);
std::string number_text(std::int64_t value);
std::string number_text(std::uint64_t value);
std::string number_text(double value);

template <class T>
std::string value_text(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return text_in_quotes(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    return number_text(static_cast<double>(value));
  } else if constexpr (std::is_signed_v<T>) {
    return number_text(static_cast<std::int64_t>(value));
  } else {
    return number_text(static_cast<std::uint64_t>(value));
  }
}

template <class T>
concept Row = requires(const T& value) {
  value.size();
  value[0];
};

/// Compares the elements of two sequences by index. `name` returns an element's name; if it is null, the
/// index is used.
template <class T>
std::string difference_in_row(const T& a, const T& b, const std::string& path, ElementName name) {
  const auto size_a = static_cast<std::size_t>(a.size());
  const auto size_b = static_cast<std::size_t>(b.size());
  if (size_a != size_b) {
    return difference_text(path, number_text(std::uint64_t{size_a}) + " elements",
                           number_text(std::uint64_t{size_b}) + " elements");
  }
  for (std::size_t i = 0; i < size_a; ++i) {
    using Index = std::conditional_t<std::is_signed_v<decltype(a.size())>, std::ptrdiff_t, std::size_t>;
    const auto& of_a = a[static_cast<Index>(i)];
    const auto& of_b = b[static_cast<Index>(i)];
    if constexpr (state_bytes::Numeric<std::remove_cvref_t<decltype(of_a)>>) {
      if (state_bytes::as_bits(of_a) == state_bytes::as_bits(of_b)) continue;  // needs no path text
    }
    const std::string called = name == nullptr ? number_text(std::uint64_t{i}) : name(i);
    if (auto found = first_difference(of_a, of_b, path_to_element(path, called)); !found.empty()) {
      return found;
    }
  }
  return "";
}

template <class T>
std::string difference_in_map(const T& a, const T& b, const std::string& path) {
  auto of_b = b.begin();
  for (const auto& [key, value] : a) {
    if (of_b == b.end() || key < of_b->first)
      return difference_text(path_to_element(path, value_text(key)), "something", "nothing");
    if (of_b->first < key) break;
    if (auto found = first_difference(value, of_b->second, path_to_element(path, value_text(key)));
        !found.empty()) {
      return found;
    }
    ++of_b;
  }
  return of_b == b.end()
             ? ""
             : difference_text(path_to_element(path, value_text(of_b->first)), "nothing", "something");
}

template <class Named, class T>
void compare_field(const Named& named, const T& a, const T& b, const std::string& path, std::string& found) {
  if (!found.empty()) return;
  if (named.element == nullptr) {
    found = first_difference(a, b, path_to(path, named.name));
  } else if constexpr (Row<T>) {
    found = difference_in_row(a, b, path_to(path, named.name), named.element);
  }
}

template <class T>
std::string difference_in_fields(const T& a, const T& b, const std::string& path) {
  std::string found;
  fields_of<T>().apply(
      [&](const auto&... named) { (compare_field(named, a.*named.at, b.*named.at, path, found), ...); });
  return found;
}

}  // namespace state_fields

/// Like first_difference(), for two values that copy_fields() returned.
template <HasFields T>
std::string difference_of_copies(const CopiedFields<T>& a, const CopiedFields<T>& b,
                                 const std::string& path) {
  std::string found;
  fields_of<T>().apply([&](const auto&... named) {
    const auto compare_all = [&]<std::size_t... i>(std::index_sequence<i...>) {
      (state_fields::compare_field(named, std::get<i>(a), std::get<i>(b), path, found), ...);
    };
    compare_all(std::index_sequence_for<decltype(named)...>());
  });
  return found;
}

/// Returns the first difference in the order of the fields: "drive.profile.segments[2].speed_u_s: 12 against
/// 13". Empty if there is none. `path` precedes the names.
template <class T>
std::string first_difference(const T& a, const T& b, const std::string& path) {
  using namespace state_bytes;
  using namespace state_fields;
  if constexpr (std::is_enum_v<T>) {
    return first_difference(static_cast<std::underlying_type_t<T>>(a),
                            static_cast<std::underlying_type_t<T>>(b), path);
  } else if constexpr (Numeric<T>) {
    return as_bits(a) == as_bits(b) ? "" : difference_text(path, value_text(a), value_text(b));
  } else if constexpr (kIsTime<T>) {
    return first_difference(a.count(), b.count(), path);
  } else if constexpr (kIsOptional<T>) {
    if (a.has_value() != b.has_value()) {
      return a ? difference_text(path, "something", "nothing")
               : difference_text(path, "nothing", "something");
    }
    return a ? first_difference(*a, *b, path) : "";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return a == b ? "" : difference_text(path, text_in_quotes(a), text_in_quotes(b));
  } else if constexpr (kIsMap<T>) {
    return difference_in_map(a, b, path);
  } else if constexpr (HasFields<T>) {
    return difference_in_fields(a, b, path);
  } else if constexpr (Row<T>) {
    return difference_in_row(a, b, path, nullptr);
  } else {
    if constexpr (requires { StateOf<T>::reported(a); }) {
      if (auto found = first_difference(StateOf<T>::reported(a), StateOf<T>::reported(b), path);
          !found.empty()) {
        return found;
      }
    }
    StateWriter of_a;
    StateWriter of_b;
    StateOf<T>::write(a, of_a);
    StateOf<T>::write(b, of_b);
    return of_a.take() == of_b.take() ? "" : difference_text(path, "other bytes");
  }
}

/// Reads a saved value from each reader, and returns the first difference between the values.
template <class T>
std::string difference_of_saved(StateReader& a, StateReader& b, const std::string& path = "") {
  const auto of_a = std::make_unique<T>();
  const auto of_b = std::make_unique<T>();
  a.read(*of_a);
  b.read(*of_b);
  return first_difference(*of_a, *of_b, path);
}

}  // namespace understudy
