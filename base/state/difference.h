// Where two values of one type differ, by the names of their fields.
#pragma once

#include <cstddef>
#include <sstream>
#include <string>
#include <type_traits>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"

namespace understudy {

namespace state_fields {

template <class T>
std::string value_text(const T& value) {
  std::ostringstream text;
  text.precision(17);
  if constexpr (std::is_enum_v<T>) {
    text << static_cast<long long>(value);
  } else {
    text << +value;
  }
  return text.str();
}

}  // namespace state_fields

/// "drive.profile.segments[2].speed_u_s: 12 against 13", the first difference in the order of the fields;
/// empty if there is none. `path` is put in front of the names.
template <class T>
std::string first_difference(const T& a, const T& b, const std::string& path = "") {
  using namespace state_bytes;
  const auto told = [&](const std::string& what) { return (path.empty() ? "" : path + ": ") + what; };
  if constexpr (Numeric<T>) {
    if (as_bits(a) == as_bits(b)) return "";
    return told(state_fields::value_text(a) + " against " + state_fields::value_text(b));
  } else if constexpr (kIsTime<T>) {
    return first_difference(a.count(), b.count(), path);
  } else if constexpr (kIsOptional<T>) {
    if (a.has_value() != b.has_value()) {
      return told(a.has_value() ? "something against nothing" : "nothing against something");
    }
    return a ? first_difference(*a, *b, path) : "";
  } else if constexpr (kIsVector<T> || kIsArray<T>) {
    if (a.size() != b.size()) {
      return told(std::to_string(a.size()) + " elements against " + std::to_string(b.size()) + " elements");
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (auto found = first_difference(a[i], b[i], path + "[" + std::to_string(i) + "]"); !found.empty()) {
        return found;
      }
    }
    return "";
  } else if constexpr (HasFields<T>) {
    std::string found;
    std::apply(
        [&](const auto&... named) {
          const auto look = [&](const auto& field) {
            if (!found.empty()) return;
            const std::string name(field.name);
            found = first_difference(a.*field.at, b.*field.at, path.empty() ? name : path + "." + name);
          };
          (look(named), ...);
        },
        fields_of<T>());
    return found;
  } else {
    StateWriter of_a;
    StateWriter of_b;
    StateOf<T>::write(a, of_a);
    StateOf<T>::write(b, of_b);
    return of_a.take() == of_b.take() ? "" : told("other bytes");
  }
}

}  // namespace understudy
