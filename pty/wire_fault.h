// Models what a bad line does to a message of any protocol. The message passes through stages in order:
//
//   message ──> stage ──> stage ──> pieces, each with its delay
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pty/line_settings.h"

namespace understudy::pty {

struct WireFault {
  enum class Kind : std::uint8_t {
    drop,              // the message is lost
    delay,             // it arrives late by `time`
    corrupt_checksum,  // its last byte is inverted
    truncate,          // only its first `size` bytes remain
    duplicate,         // it arrives twice, the second time late by `time`
    noise,             // it arrives between `before` and `after`
    split,             // its first `size` bytes arrive on time, the rest late by `time`
    collision,  // another sender transmits `before` (empty: 0x55 throughout) at the same time; 0 bits win
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

/// The largest number of pieces, however often a message is duplicated.
inline constexpr std::size_t kMaxWirePieces = 16;

/// Returns the pieces in chronological order; at equal times the original precedes its duplicate. Pieces
/// without bytes are left out.
std::vector<WirePiece> through_faults(std::span<const std::uint8_t> message,
                                      std::span<const WireFault> stages);

}  // namespace understudy::pty
