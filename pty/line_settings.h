// Defines the settings that both ends of a serial line must agree on, and the length of a character.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace understudy::pty {

/// Simulated time since the world's power-up. Always whole nanoseconds, never the wall clock.
using SimTime = std::chrono::nanoseconds;

/// A receiver samples each bit in its middle, counted from the start bit. After ten or eleven bits it still
/// samples the right bit if the other end is 2 % faster or slower.
inline constexpr std::int64_t kUsualBaudTolerancePpm = 20'000;

/// Returns true if a receiver at `baud` understands a sender at `host_baud`.
constexpr bool is_within(int host_baud, int baud, std::int64_t tolerance_ppm) {
  const std::int64_t off = host_baud > baud ? std::int64_t{host_baud} - baud : std::int64_t{baud} - host_baud;
  return off * 1'000'000 <= tolerance_ppm * baud;
}

/// Hosts may set mark and space, but no device supports them.
enum class Parity : std::uint8_t { none, odd, even, mark, space };

struct LineSettings {
  int baud = 19200;  // bits per second
  int data_bits = 8;
  Parity parity = Parity::even;
  int stop_bits = 1;

  bool operator==(const LineSettings&) const = default;

  /// Counts the start bit, data, parity and stop bits: 11 at 8E1.
  int bits_per_character() const { return 1 + data_bits + (parity == Parity::none ? 0 : 1) + stop_bits; }

  /// Returns the time of `count` characters sent back to back, rounded down to a nanosecond. It is computed
  /// from the whole count, so that long transmissions do not drift.
  SimTime duration_of(std::int64_t count) const {
    return SimTime{count * bits_per_character() * 1'000'000'000 / baud};
  }
};

/// Returns text such as "19200 8E1".
std::string to_string(const LineSettings& settings);

/// The settings of a host, as far as they are known. A Linux pty drops parity and forces 8 data bits; these
/// two are then unknown and assumed to match. RFC 2217 transmits them.
struct HostSettings {
  int baud = 0;
  int stop_bits = 1;
  std::optional<int> data_bits{};
  std::optional<Parity> parity{};

  bool operator==(const HostSettings&) const = default;
};

/// Returns true if a receiver with these settings understands the host.
bool accepts(const LineSettings& receiver, const HostSettings& host, std::int64_t baud_tolerance_ppm);

/// Returns "9600 8N1", or "9600 baud, 1 stop bit" if parity and data bits are unknown.
std::string to_string(const HostSettings& settings);

}  // namespace understudy::pty
