#include "motion/state.h"

#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>

#include "motion/bad_motion.h"
#include "motion/state_checks.h"
#include "motion/state_fields.h"

namespace understudy::motion {

namespace {

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t n>
inline constexpr bool kIsArray<std::array<T, n>> = true;

/// A number as an unsigned one of the same size.
template <class T>
auto as_bits(T value) {
  if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<std::uint64_t>(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    return static_cast<std::uint8_t>(value);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<std::make_unsigned_t<std::underlying_type_t<T>>>(value);
  } else {
    return static_cast<std::make_unsigned_t<T>>(value);
  }
}

/// The bytes of a number, of which there are as many as it takes.
template <class Bits>
std::array<std::byte, sizeof(Bits)> bytes_of(Bits bits) {
  std::array<std::byte, sizeof(Bits)> bytes;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(bytes.data(), &bits, sizeof bits);
  } else {
    for (std::size_t i = 0; i < sizeof bits; ++i) bytes[i] = static_cast<std::byte>(bits >> (8 * i));
  }
  return bytes;
}

template <class Bits>
Bits bits_of(std::span<const std::byte, sizeof(Bits)> bytes) {
  Bits bits = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&bits, bytes.data(), sizeof bits);
  } else {
    for (std::size_t i = 0; i < sizeof bits; ++i) {
      bits = static_cast<Bits>(bits | static_cast<Bits>(std::to_integer<std::uint8_t>(bytes[i])) << (8 * i));
    }
  }
  return bits;
}

/// Gives all bytes of a value to `sink`, number by number.
template <class T, class Sink>
void write(const T& value, Sink& sink) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    sink(bytes_of(as_bits(value)));
  } else if constexpr (kIsOptional<T>) {
    write(value.has_value(), sink);
    if (value) write(*value, sink);
  } else if constexpr (kIsArray<T>) {
    for (const auto& element : value) write(element, sink);
  } else if constexpr (std::is_same_v<T, Point>) {
    for (Eigen::Index i = 0; i < kPathAxes; ++i) write(value[i], sink);
  } else {
    StateFields::of(value, [&](const auto&... field) { (write(field, sink), ...); });
  }
}

struct Source {
  std::span<const std::byte> bytes;
  std::size_t taken = 0;

  template <std::size_t count>
  std::span<const std::byte, count> next() {
    if (bytes.size() - taken < count)
      throw BadMotion(Refusal::out_of_range, "saved state", "the bytes end too early");
    taken += count;
    return std::span<const std::byte, count>(bytes.data() + taken - count, count);
  }
};

template <class T>
void read(T& value, Source& source) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    using Bits = decltype(as_bits(value));
    const auto bits = bits_of<Bits>(source.next<sizeof(Bits)>());
    if constexpr (std::is_same_v<T, double>) {
      value = std::bit_cast<double>(bits);
    } else if constexpr (std::is_same_v<T, bool>) {
      if (bits > 1) throw BadMotion(Refusal::out_of_range, "saved state", "a yes or no must be 0 or 1");
      value = bits != 0;
    } else {
      if constexpr (std::is_enum_v<T>) {
        if (bits > as_bits(kLastOf<T>)) {
          throw BadMotion(Refusal::out_of_range, "saved state", "an enumeration has no such value");
        }
      }
      value = static_cast<T>(bits);
    }
  } else if constexpr (kIsOptional<T>) {
    bool has = false;
    read(has, source);
    value.reset();
    if (has) read(value.emplace(), source);
  } else if constexpr (kIsArray<T>) {
    for (auto& element : value) read(element, source);
  } else if constexpr (std::is_same_v<T, Point>) {
    for (Eigen::Index i = 0; i < kPathAxes; ++i) read(value[i], source);
  } else {
    StateFields::of(value, [&](auto&... field) { (read(field, source), ...); });
    check_restored(value);
  }
}

}  // namespace

template <class T>
std::vector<std::byte> save(const T& value) {
  std::vector<std::byte> bytes;
  bytes.reserve(sizeof value);
  auto sink = [&](const auto& number) { bytes.insert(bytes.end(), number.begin(), number.end()); };
  write(value, sink);
  return bytes;
}

template <class T>
std::size_t restore(T& value, std::span<const std::byte> bytes) {
  T restored;
  Source source{.bytes = bytes};
  try {
    read(restored, source);
  } catch (const BadMotion& bad) {
    if (bad.refusal() == Refusal::out_of_range) throw;
    throw BadMotion(Refusal::out_of_range, "saved state", bad.what());
  }
  value = restored;
  return source.taken;
}

template <class T>
std::uint64_t hash(const T& value) {
  std::uint64_t sum = 0xcbf29ce484222325;
  auto sink = [&](const auto& number) {
    for (const std::byte byte : number) sum = (sum ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
  };
  write(value, sink);
  return sum;
}

#define UNDERSTUDY_STATE(Type)                                     \
  template std::vector<std::byte> save(const Type&);               \
  template std::size_t restore(Type&, std::span<const std::byte>); \
  template std::uint64_t hash(const Type&)

UNDERSTUDY_STATE(Axis);
UNDERSTUDY_STATE(Coordinated);
UNDERSTUDY_STATE(Counter);
UNDERSTUDY_STATE(ExternalDrive);
UNDERSTUDY_STATE(Follower);
UNDERSTUDY_STATE(Path);
UNDERSTUDY_STATE(PathRun);
UNDERSTUDY_STATE(Profile);
UNDERSTUDY_STATE(PulseDrive);
UNDERSTUDY_STATE(SpeedLaw);
UNDERSTUDY_STATE(Surroundings);
UNDERSTUDY_STATE(SyncTable);
UNDERSTUDY_STATE(UnitScale);

#undef UNDERSTUDY_STATE

}  // namespace understudy::motion
