// What a bad line does to a message, whatever the protocol: small stages, through which it goes in order.
//
//   message ──> stage ──> stage ──> pieces, each with how late it is
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pty/line_settings.h"

namespace understudy::pty {

struct WireFault {
  enum class Kind : std::uint8_t {
    drop,              // nothing of it is left
    delay,             // it is late by `time`
    corrupt_checksum,  // its last byte is inverted
    truncate,          // its first `size` bytes are left
    duplicate,         // it comes twice, the second time late by `time`
    noise,             // it comes between `before` and `after`
    split,             // its first `size` bytes come, and the rest late by `time`
    collision,         // somebody says `before` (empty: 0x55 throughout) at the same time; 0 wins
  } kind = Kind::drop;
  SimTime time{0};
  std::size_t size = 0;
  std::vector<std::uint8_t> before{};
  std::vector<std::uint8_t> after{};

  bool operator==(const WireFault&) const = default;
};

struct WirePiece {
  SimTime late{0};
  std::vector<std::uint8_t> bytes;

  bool operator==(const WirePiece&) const = default;
};

/// The most pieces, however often a message is doubled.
inline constexpr std::size_t kMostWirePieces = 16;

/// What comes out, in the order of time; at equal times the original before its double. A piece without bytes
/// is left out.
std::vector<WirePiece> through_faults(std::span<const std::uint8_t> message,
                                      std::span<const WireFault> stages);

}  // namespace understudy::pty
