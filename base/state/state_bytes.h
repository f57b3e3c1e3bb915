// Saves state as bytes that are the same on every machine: little-endian numbers, the bit patterns of
// doubles, no padding. A value is saved, restored and hashed by the fields that its StateOf (fields.h) lists.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/enumerators.h"
#include "base/state/fields.h"
#include "base/state/shared_text.h"
#include "base/state/state_error.h"

namespace understudy {

class StateWriter;
class StateReader;

/// Returns the FNV-1a hash of `bytes`, continuing from the hash `onto`.
std::uint64_t hash_of(std::span<const std::byte> bytes, std::uint64_t onto = 0xcbf29ce484222325);

namespace state_bytes {

using state_fields::kIsOptional;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t n>
inline constexpr bool kIsArray<std::array<T, n>> = true;
template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;
template <>
inline constexpr bool kIsVector<std::string> = true;  // of bytes
template <class T>
inline constexpr bool kIsMap = false;
template <class Key, class T>
inline constexpr bool kIsMap<std::map<Key, T>> = true;
template <class Key, class T>
inline constexpr bool kIsMap<std::map<Key, T, std::less<>>> = true;
template <class T>
inline constexpr bool kIsTime = false;
template <class Count, class Period>
inline constexpr bool kIsTime<std::chrono::duration<Count, Period>> = true;

/// True for types that have their own write and read functions.
template <class T>
concept SavesItself = requires(const T& value, T& restored, StateWriter& writer, StateReader& reader) {
  StateOf<T>::write(value, writer);
  StateOf<T>::read(restored, reader);
};

template <class T>
concept Numeric = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Returns a number as an unsigned number of the same size.
template <class T>
auto as_bits(T value) {
  if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<std::uint64_t>(value);
  } else if constexpr (std::is_same_v<T, float>) {
    return std::bit_cast<std::uint32_t>(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    return static_cast<std::uint8_t>(value);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<std::make_unsigned_t<std::underlying_type_t<T>>>(value);
  } else {
    return static_cast<std::make_unsigned_t<T>>(value);
  }
}
template <class T>
using Bits = decltype(as_bits(T{}));

/// True for numbers for which every bit pattern is valid and whose saved bytes equal their memory on this
/// machine.
template <class T>
inline constexpr bool kIsAsInMemory =
    std::endian::native == std::endian::little&& std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

}  // namespace state_bytes

class StateWriter {
 public:
  /// If `shared` is not null, shared texts are stored in it, and the bytes contain only their digests.
  explicit StateWriter(std::size_t expected_bytes = 0, SharedTexts* shared = nullptr) : shared_(shared) {
    bytes_.resize(expected_bytes);
  }

  template <class T>
  void write(const T& value);
  void write_shared(const SharedText& value) {
    if (shared_ == nullptr) return write(value.text());
    write(value.digest());
    shared_->push_back(value);
  }
  /// Appends bytes that are already in saved form.
  void append(std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(room_for(bytes.size()), bytes.data(), bytes.size());
  }

  std::vector<std::byte> take() {
    bytes_.resize(size_);
    size_ = 0;
    return std::exchange(bytes_, {});
  }

 private:
  std::byte* room_for(std::size_t count) {
    if (bytes_.size() - size_ < count) [[unlikely]]
      bytes_.resize(std::max(2 * bytes_.size(), size_ + count));
    return bytes_.data() + std::exchange(size_, size_ + count);
  }

  static_assert(sizeof(std::size_t) == 8, "a size is saved as 64 bits");

  template <class T>
  static void put(std::byte* to, T value) {
    if constexpr (state_bytes::kIsAsInMemory<T>) {
      std::memcpy(to, &value, sizeof value);
    } else {
      const auto bits = state_bytes::as_bits(value);
      for (std::size_t i = 0; i < sizeof bits; ++i) to[i] = static_cast<std::byte>(bits >> (8 * i));
    }
  }

  template <class Values>
  void write_all(const Values& values) {
    using T = typename Values::value_type;
    if constexpr (state_bytes::Numeric<T>) {
      constexpr std::size_t kSize = sizeof(state_bytes::Bits<T>);
      std::byte* to = room_for(values.size() * kSize);
      if constexpr (state_bytes::kIsAsInMemory<T>) {
        if (!values.empty()) std::memcpy(to, values.data(), values.size() * kSize);
        return;
      }
      for (std::size_t i = 0; i < values.size(); ++i) put(to + i * kSize, values[i]);
    } else {
      for (const T& value : values) write(value);
    }
  }

  // The vector has spare room at its end, because thousands of numbers are appended one by one.
  std::vector<std::byte> bytes_;
  std::size_t size_ = 0;
  SharedTexts* shared_ = nullptr;
};

/// Reads what a StateWriter wrote. Every member function throws StateError if the bytes end too early or
/// contain a value that the type cannot have (a bool of 7, an enumerator that does not exist).
class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : rest_(bytes) {}
  /// Reads bytes of a writer that shared its texts. `shared` contains these texts in their order.
  StateReader(std::span<const std::byte> bytes, std::span<const SharedText> shared)
      : rest_(bytes), shared_(shared) {}

  template <class T>
  void read(T& value);

  std::span<const std::byte> rest() const { return rest_; }
  std::span<const std::byte> take(std::size_t count) {
    require_state(count <= rest_.size(), "the bytes end too early");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  void read_shared(SharedText& value);
  void require_end() const {
    require_state(rest_.empty(), "bytes are left over");
    require_state(!shared_ || shared_->empty(), "texts are left over");
  }

 private:
  template <class T>
  static T get(const std::byte* from) {
    using namespace state_bytes;
    if constexpr (kIsAsInMemory<T>) {
      T value;
      std::memcpy(&value, from, sizeof value);
      return value;
    }
    Bits<T> bits = 0;
    for (std::size_t i = 0; i < sizeof bits; ++i) {
      bits = static_cast<Bits<T>>(bits | static_cast<Bits<T>>(std::to_integer<std::uint8_t>(from[i]))
                                             << (8 * i));
    }
    if constexpr (std::is_floating_point_v<T>) {
      return std::bit_cast<T>(bits);
    } else if constexpr (std::is_same_v<T, bool>) {
      require_state(bits <= 1, "a boolean must be 0 or 1");
    } else if constexpr (std::is_enum_v<T>) {
      static_assert(is_last<StateOf<T>::last>(), "StateOf's last value differs from the enumeration's");
      require_state(bits <= as_bits(StateOf<T>::last), "an enumeration has a value that does not exist");
    }
    return static_cast<T>(bits);
  }

  template <class Values>
  void read_all(Values& values) {
    using T = typename Values::value_type;
    if constexpr (state_bytes::Numeric<T>) {
      constexpr std::size_t kSize = sizeof(state_bytes::Bits<T>);
      const std::byte* from = take(values.size() * kSize).data();
      if constexpr (state_bytes::kIsAsInMemory<T>) {
        if (!values.empty()) std::memcpy(values.data(), from, values.size() * kSize);
        return;
      }
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = get<T>(from + i * kSize);
    } else {
      for (T& value : values) read(value);
    }
  }

  std::span<const std::byte> rest_;
  std::optional<std::span<const SharedText>> shared_;
};

inline void StateReader::read_shared(SharedText& value) {
  if (!shared_) {
    std::string text;
    read(text);
    value = SharedText(std::move(text));
    return;
  }
  std::uint64_t digest = 0;
  read(digest);
  require_state(!shared_->empty(), "the texts end too early");
  require_state(shared_->front().digest() == digest, "a text differs from the one that was saved");
  value = shared_->front();
  shared_ = shared_->subspan(1);
}

/// Saves a class whose state is a single value: save() returns it, and restore() checks and assigns it.
template <class T>
struct StateHeldBy {
  static void write(const T& value, StateWriter& writer) { writer.write(value.save()); }
  static void read(T& value, StateReader& reader) {
    std::remove_cvref_t<decltype(value.save())> state;
    reader.read(state);
    value.restore(state);
  }
  static const auto& reported(const T& value) { return value.save(); }
};

// These functions are outside their classes so that a library can instantiate them once for its large types
// (motion/state_fields.h).

template <class T>
void StateWriter::write(const T& value) {
  using namespace state_bytes;
  if constexpr (Numeric<T>) {
    put(room_for(sizeof(Bits<T>)), value);
  } else if constexpr (kIsTime<T>) {
    write(std::int64_t{value.count()});
  } else if constexpr (kIsOptional<T>) {
    write(value.has_value());
    if (value) write(*value);
  } else if constexpr (kIsVector<T>) {
    write(static_cast<std::uint32_t>(value.size()));
    write_all(value);
  } else if constexpr (kIsMap<T>) {
    write(static_cast<std::uint32_t>(value.size()));
    for (const auto& [key, entry] : value) {
      write(key);
      write(entry);
    }
  } else if constexpr (kIsArray<T>) {
    write_all(value);
  } else if constexpr (SavesItself<T>) {
    StateOf<T>::write(value, *this);
  } else {
    static_assert(HasFields<T>, "a part of a state has no StateOf");
    for_each_field(value, [&](const auto& part) { write(part); });
  }
}

template <class T>
void StateReader::read(T& value) {
  using namespace state_bytes;
  if constexpr (Numeric<T>) {
    value = get<T>(take(sizeof(Bits<T>)).data());
  } else if constexpr (kIsTime<T>) {
    std::int64_t count = 0;
    read(count);
    value = T{count};
  } else if constexpr (kIsOptional<T>) {
    bool has = false;
    read(has);
    value.reset();
    if (has) read(value.emplace());
  } else if constexpr (kIsVector<T>) {
    std::uint32_t count = 0;
    read(count);
    // Each element takes at least one byte, so a wrong count is refused before memory is allocated for it.
    require_state(count <= rest_.size(), "the bytes end too early");
    value.assign(count, {});
    read_all(value);
  } else if constexpr (kIsMap<T>) {
    std::uint32_t count = 0;
    read(count);
    value.clear();
    for (; count > 0; --count) {
      typename T::key_type key{};
      read(key);
      require_state(value.empty() || value.rbegin()->first < key, "its entries are out of order");
      read(value[key]);
    }
  } else if constexpr (kIsArray<T>) {
    read_all(value);
  } else if constexpr (SavesItself<T>) {
    StateOf<T>::read(value, *this);
  } else {
    for_each_field(value, [&](auto& part) { read(part); });
    if constexpr (requires { StateOf<T>::check(value); }) StateOf<T>::check(value);
  }
}

}  // namespace understudy
