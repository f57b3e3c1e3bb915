// A complete table contains exactly one handler for each key. A constexpr table does not compile if a key has
// no handler or more than one. Interpreters use such tables for their opcodes, and devices for their
// commands:
//
//   constexpr HandlerRow<Verb, Action> kOutputActions[] = {{Verb::set_port, set_port}, ...};
//   constexpr CompleteTable<Verb, Action> kActions(kVerbs, kMotionActions, kOutputActions);
//   ...
//   kActions[verb](device);
#pragma once

#include <array>
#include <cstddef>

namespace understudy {

/// A row of the table. Any type with a `key` and a `handler` can be used instead.
template <typename Key, typename Handler>
struct HandlerRow {
  Key key;
  Handler handler;
};

/// Maps keys, which are one-byte numbers or enumerations, to handlers.
template <typename Key, typename Handler>
class CompleteTable {
 public:
  /// A key may appear several times in `keys`, because keys are often a column of another table.
  constexpr explicit CompleteTable(const auto& keys, const auto&... groups_of_rows) {
    (add(groups_of_rows), ...);
    std::array<bool, kSize> is_key{};
    for (const Key key : keys) {
      is_key[place(key)] = true;
      require_handler(key, has(key));
    }
    for (std::size_t i = 0; i < kSize; ++i) require_key(static_cast<Key>(i), is_key[i] || !is_filled_[i]);
  }

  constexpr bool has(Key key) const { return is_filled_[place(key)]; }
  /// Returns the handler of `key`, or Handler{} if the key is not in the table.
  constexpr const Handler& operator[](Key key) const { return handlers_[place(key)]; }

 private:
  static_assert(sizeof(Key) == 1);
  static constexpr std::size_t kSize = 256;

  static constexpr std::size_t place(Key key) { return static_cast<unsigned char>(key); }
  constexpr void add(const auto& rows) {
    for (const auto& row : rows) {
      require_first_handler(row.key, !has(row.key));
      is_filled_[place(row.key)] = true;
      handlers_[place(row.key)] = row.handler;
    }
  }

  // If a handler is missing, clang's error message contains the key's number. g++'s shows only the call.
  static constexpr void require_handler(Key /*key*/, bool has_one) {
    if (!has_one) throw "a key has no handler";
  }
  static constexpr void require_first_handler(Key /*key*/, bool is_first) {
    if (!is_first) throw "a key has two handlers";
  }
  static constexpr void require_key(Key /*key*/, bool is_key) {
    if (!is_key) throw "a handler has an unknown key";
  }

  std::array<Handler, kSize> handlers_{};
  std::array<bool, kSize> is_filled_{};  // g++'s sanitizers cannot compare with null here (GCC bug 71962)
};

}  // namespace understudy
