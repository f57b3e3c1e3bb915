// The encoder count of a machine as a function of an axis's travel, while the machine follows the pulses: a
// straight line in whole counts.
//
//   travel ── mirror, origin, stops ──> place ── counts/pulses ──> counts ── factor, zero, divider ──> count
#pragma once

#include <cstdint>
#include <optional>

namespace understudy::motion {

struct EncoderLine {
  // The machine's part: floor(place * counts / pulses). The place is the axis's position. It rises in the
  // machine's own direction and is 0 where the encoder reads 0. The encoder gives `counts` for every `pulses`
  // of the machine. If `counts` is 0, the count is not known before the tick ends.
  std::int64_t counts = 0;
  std::int64_t pulses = 1;         // > 0
  std::int64_t origin = 0;         // travel at which the encoder reads 0
  std::int64_t first = INT64_MIN;  // travel at the machine's stops; the encoder does not count beyond them
  std::int64_t last = INT64_MAX;
  bool mirrored = false;     // the machine's place rises while travel falls
  bool reversed = false;     // the encoder's counts fall while the machine's place rises
  std::int64_t surplus = 0;  // counts added to those of the encoder
  // The controller's part: floor((counts * factor - zero) / divider).
  std::int64_t factor = 1;  // > 0
  std::int64_t zero = 0;
  std::int64_t divider = 1;  // > 0
  bool turned = false;       // true: the controller counts in the opposite direction

  bool operator==(const EncoderLine&) const = default;

  bool is_known() const { return counts != 0; }
  std::int64_t at(std::int64_t travel) const;
  /// Returns +1 if the count rises with the travel, -1 if it falls.
  int sense() const { return (mirrored != reversed) != turned ? -1 : +1; }
  /// Returns how many pulses (1 or more) in `direction` are needed until the count has changed by
  /// `count_steps` (1 or more), or nothing if it never will.
  std::optional<std::int64_t> steps_until(std::int64_t travel, int direction, std::int64_t count_steps) const;
};

}  // namespace understudy::motion
