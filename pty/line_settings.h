// What a serial line's two ends must agree on, and how long a character takes.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace understudy::pty {

/// Simulated time since the world's power-up. Always whole nanoseconds, never the wall clock.
using SimTime = std::chrono::nanoseconds;

enum class Parity : std::uint8_t { none, odd, even };

struct LineSettings {
  int baud = 19200;  // bits a second
  int data_bits = 8;
  Parity parity = Parity::even;
  int stop_bits = 1;

  bool operator==(const LineSettings&) const = default;

  /// Start bit, data, parity, stop: 11 at 8E1.
  int bits_per_character() const { return 1 + data_bits + (parity == Parity::none ? 0 : 1) + stop_bits; }

  /// Time of `count` characters sent back to back, rounded down to a nanosecond. Computed from the
  /// whole count, so that long transmissions do not drift.
  SimTime duration_of(std::int64_t count) const {
    return SimTime{count * bits_per_character() * 1'000'000'000 / baud};
  }
};

/// "19200 8E1".
std::string to_string(const LineSettings& settings);

/// What can be seen of a host's settings through a Linux pty: it drops parity and forces 8 data bits.
struct HostSettings {
  int baud = 0;
  int stop_bits = 1;

  bool operator==(const HostSettings&) const = default;
};

}  // namespace understudy::pty
