// What an axis encounters along its travel: its input signals, and where they change.
//
// The plant fills this in. Signals that depend on the position are zones and an index mark, so that an axis
// can react at the exact pulse of an edge, as a chip does, not at the end of the tick.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "motion/encoder_line.h"

namespace understudy::motion {

/// The inputs of one axis. On means active, independent of the polarity of the wiring.
enum class Signal : std::uint8_t {
  limit_plus,   // +EL, LMT+, upper limit
  limit_minus,  // -EL, LMT-, lower limit
  near_home,    // IN0
  home,         // ORG, DOG, IN1
  index,        // EZ, C, Z, IN2: one per revolution
  mark,         // IN3
  alarm,
  in_position,
  emergency,
};
inline constexpr int kSignals = 9;

/// One bit per signal.
using Signals = std::uint16_t;
constexpr Signals bit(Signal signal) { return static_cast<Signals>(1U << static_cast<unsigned>(signal)); }

struct Environment {
  /// `signal` is on from `from` to `to`, both included, in pulses of the axis's travel.
  struct Zone {
    Signal signal = Signal::home;
    std::int64_t from = 0;
    std::int64_t to = -1;    // below `from`: the zone is empty
    std::int64_t slack = 0;  // >= 0; a signal that is on stays on this far beyond either end
    bool operator==(const Zone&) const = default;
  };

  static constexpr std::size_t kMaxZones = 12;

  /// Increment this after changing anything below; axes check again only then.
  std::uint32_t version = 0;
  Signals steady = 0;  // signals that are on at every position
  std::uint8_t zone_count = 0;
  std::array<Zone, kMaxZones> zones{};
  // The index is on for `index_width` pulses from each `index_at + k * index_period`. Period 0: no index.
  std::int64_t index_period = 0;
  std::int64_t index_at = 0;
  std::int64_t index_width = 1;
  // Beyond these two positions, the index does not change: the machine does not move further, even if more
  // pulses come.
  std::int64_t index_from = INT64_MIN;
  std::int64_t index_to = INT64_MAX;
  EncoderLine encoder{};  // the encoder count along the travel

  bool operator==(const Environment&) const = default;

  /// Throws BadMotion(no_room) if there are already kMaxZones. Increments the version.
  void add(Signal signal, std::int64_t from, std::int64_t to, std::int64_t slack = 0);
  /// Adds a signal that is on everywhere except between `from` and `to`. After it has gone off there, it goes
  /// on again only `slack` beyond that range. Throws the same errors as add().
  void add_outside(Signal signal, std::int64_t from, std::int64_t to, std::int64_t slack = 0);
  void set_steady(Signal signal, bool on);

  /// Returns the signals at `travel`. `before` contains the signals that were on before, because slack may
  /// keep them on.
  Signals at(std::int64_t travel, Signals before = 0) const;
  bool depends_on_place() const { return zone_count > 0 || index_period > 0; }

  /// Returns how many pulses (1 or more) in `direction` (+1 or -1) are needed until some signal may change,
  /// or nothing if none will change.
  std::optional<std::int64_t> steps_until_change(std::int64_t travel, int direction) const;
};

}  // namespace understudy::motion
