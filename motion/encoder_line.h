// What the encoder of a machine counts along an axis's travel, while the machine goes where the pulses take
// it: a straight line, in whole counts.
//
//   travel ── way, origin, stops ──> place ── counts / pulses ──> counts ── factor, zero, divider ──> count
#pragma once

#include <cstdint>
#include <optional>

namespace understudy::motion {

struct EncoderLine {
  // Of the machine: floor(place * counts / pulses), where place is the axis's, in its own sense, from where
  // the encoder stands at 0.
  std::int64_t counts = 0;         // for so many pulses; 0: nobody knows it before the tick is over
  std::int64_t pulses = 1;         // > 0
  std::int64_t origin = 0;         // travel where it stands at 0
  std::int64_t first = INT64_MIN;  // travel at the machine's stops: beyond them it stands
  std::int64_t last = INT64_MAX;
  bool mirrored = false;     // the machine's pulses rise while travel falls
  bool reversed = false;     // its counts fall while its pulses rise
  std::int64_t surplus = 0;  // counts too many
  // Of the controller: floor((counts * factor - zero) / divider).
  std::int64_t factor = 1;  // > 0
  std::int64_t zero = 0;
  std::int64_t divider = 1;  // > 0
  bool turned = false;       // and the other way round

  bool operator==(const EncoderLine&) const = default;

  bool is_known() const { return counts != 0; }
  std::int64_t at(std::int64_t travel) const;
  /// +1: the count rises with the travel.
  int way() const { return (mirrored != reversed) != turned ? -1 : +1; }
  /// How many pulses (1 ...) in `direction` until it has gone by `count_steps` (1 ...) the way it goes then;
  /// nothing if it never will.
  std::optional<std::int64_t> steps_until(std::int64_t travel, int direction, std::int64_t count_steps) const;
};

}  // namespace understudy::motion
