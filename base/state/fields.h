// Describes the parts of a value. The fields are listed once, next to the type, and have the names of their
// members:
//
//   template <>
//   struct understudy::StateOf<Timer> {
//     static constexpr auto fields = FieldList{field<&Timer::mode>(), field<&Timer::since>()};
//     static void check(const Timer& timer);   // optional: throws StateError if the value is impossible
//   };
//   template <>
//   struct understudy::StateOf<Mode> {
//     static constexpr Mode last = Mode::sync;  // for an enumeration: its last value
//   };
//
// The list is used to save, restore and hash a value (state_bytes.h) and to compare two values
// (difference.h). Its order is the order of the bytes. The code does not compile if a member is missing from
// the list. A class with private fields makes its StateOf a friend. That StateOf names them in a structured
// binding (they cannot be counted otherwise) and has two counts: `members`, the number of all members, and
// `apart`, the number of members that are not state.
//
// A type whose saved form differs from its form in memory (a ring, a program kept as its lines) has a pair of
// functions instead, `write(const T&, StateWriter&)` and `read(T&, StateReader&)`. It may also have `fields`,
// or `reported(value)`, for comparing two values. StateHeldBy (state_bytes.h) is such a pair.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace understudy {

/// Describes the fields of a state. It is specialised for each type that is part of a state.
template <class T>
struct StateOf;

/// Returns the name of the array element with this index.
using ElementName = std::string (*)(std::size_t number);

template <class Owner, class T>
struct NamedField {
  std::string_view name;
  T Owner::*at = nullptr;
  ElementName element = nullptr;  // null: the index is used
};

/// A field whose name differs from the name of its member.
template <class Owner, class T>
constexpr NamedField<Owner, T> field(std::string_view name, T Owner::*at, ElementName element = nullptr) {
  return {name, at, element};
}

/// Returns the name of a member, without the trailing underscore of a private member. Both compilers print it
/// at the end of this function's name: "[with auto member = &Timer::since; ...]", "[member = &Timer::since]".
template <auto member>
constexpr std::string_view member_name() {
  constexpr std::string_view text = __PRETTY_FUNCTION__;
  constexpr std::string_view path = text.substr(0, text.find_first_of(";]", text.find("member = ")));
  constexpr std::string_view name = path.substr(path.rfind("::") + 2);
  return name.ends_with('_') ? name.substr(0, name.size() - 1) : name;
}

/// A field named after its member.
template <auto member>
constexpr auto field(ElementName element = nullptr) {
  return field(member_name<member>(), member, element);
}

namespace state_fields {

template <std::size_t number, class Field>
struct Numbered {
  Field field;
};

template <class Numbers, class... Field>
struct NumberedFields;
template <std::size_t... number, class... Field>
struct NumberedFields<std::index_sequence<number...>, Field...> : Numbered<number, Field>... {
  static constexpr std::size_t count = sizeof...(Field);

  constexpr explicit NumberedFields(Field... field) : Numbered<number, Field>{field}... {}
  /// Calls visit(field...) with all fields at once.
  constexpr decltype(auto) apply(auto&& visit) const {
    return visit(static_cast<const Numbered<number, Field>&>(*this).field...);
  }
};

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

/// Can initialize a member of any type, to count members. An optional member is initialised from its content
/// type.
struct AnyMember {
  template <class T>
  requires(!kIsOptional<T>) operator T&() const {  // NOLINT(google-explicit-constructor)
    std::abort();                                  // never called: counting constructs no members
  }
};

template <class T, std::size_t... i>
constexpr bool is_made_of(std::index_sequence<i...>) {
  return requires { T{(static_cast<void>(i), AnyMember{})...}; };
}

/// Returns true if the class has exactly `count` members.
template <class T, std::size_t count>
constexpr bool has_members() {
  if constexpr (requires { StateOf<T>::members; }) {
    return StateOf<T>::members == count;  // this class cannot be counted
  } else {
    return is_made_of<T>(std::make_index_sequence<count>()) &&
           !is_made_of<T>(std::make_index_sequence<count + 1>());
  }
}

/// Returns the number of members that are not part of the state.
template <class T>
constexpr std::size_t apart_of() {
  if constexpr (requires { StateOf<T>::apart; }) {
    return StateOf<T>::apart;
  } else {
    return 0;
  }
}

}  // namespace state_fields

/// The fields of a type. This is not a std::tuple because there are hundreds of such lists, and tuples take
/// much longer to compile.
template <class... Field>
struct FieldList : state_fields::NumberedFields<std::index_sequence_for<Field...>, Field...> {
  using state_fields::NumberedFields<std::index_sequence_for<Field...>, Field...>::NumberedFields;
};
template <class... Field>
FieldList(Field...) -> FieldList<Field...>;

template <class T>
concept HasFields = requires {
  StateOf<std::remove_cv_t<T>>::fields;
};

/// Returns all fields of a type. The code does not compile if a member is missing from the list.
template <HasFields T>
constexpr const auto& fields_of() {
  using Fields = std::remove_cvref_t<decltype(StateOf<T>::fields)>;
  static_assert(
      std::is_aggregate_v<T> || requires { StateOf<T>::members; },
      "the members of a class cannot be counted; StateOf must give their number");
  static_assert(state_fields::has_members<T, Fields::count + state_fields::apart_of<T>()>(),
                "StateOf does not list the fields that the type has");
  return StateOf<T>::fields;
}

/// Calls visit(field) for each field of a value, in order.
template <HasFields T>
constexpr void for_each_field(T& value, auto visit) {
  fields_of<std::remove_cv_t<T>>().apply([&](const auto&... named) { (visit(value.*named.at), ...); });
}

/// Copies only the fields of a value whose class cannot be copied. A restore first reads into such a copy,
/// and assigns it after everything has been read.
template <HasFields T>
auto copy_fields(const T& value) {
  return fields_of<T>().apply([&](const auto&... named) { return std::tuple(value.*named.at...); });
}
template <HasFields T>
using CopiedFields = decltype(copy_fields(std::declval<const T&>()));

template <HasFields T>
void assign_fields(T& value, const CopiedFields<T>& fields) {
  fields_of<T>().apply([&](const auto&... named) { std::tie(value.*named.at...) = fields; });
}

}  // namespace understudy
