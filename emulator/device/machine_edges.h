// The positions along an axis at which the machine's switches change the levels of inputs, for a device that
// detects edges at the exact pulse (Axes::meets_edges()). An input that is not listed keeps its level at
// every position: either it has no switch, or it is held, stuck or also driven by a wire, or pulses are being
// lost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::emulator {

struct MachineEdges {
  /// An input has one level from `first` to `last`, both included, and the other level elsewhere.
  struct Span {
    int input = -1;  // a digital terminal
    bool level_inside = true;
    std::int64_t first = 0;  // in the count of Axes::place_pulses()
    std::int64_t last = 0;
    std::int64_t slack = 0;  // >= 0; an input that is inside keeps its level this far beyond either end
    bool operator==(const Span&) const = default;
  };
  /// Like Span, but the level applies for `width` pulses from each `at + k * period`.
  struct Index {
    int input = -1;
    bool level_inside = true;
    std::int64_t at = 0;
    std::int64_t width = 1;
    std::int64_t period = 0;  // 0: no index
    // The positions of the machine's stops. Beyond a stop, the levels are those at the stop.
    std::int64_t first = INT64_MIN;
    std::int64_t last = INT64_MAX;
    bool operator==(const Index&) const = default;
  };
  /// The encoder count: floor((place - origin) * counts / pulses), between the machine's stops.
  struct Encoder {
    std::int64_t counts = 0;  // 0: no encoder, or the count cannot be known before the tick ends
    std::int64_t pulses = 1;
    std::int64_t origin = 0;
    std::int64_t first = INT64_MIN;
    std::int64_t last = INT64_MAX;
    bool mirrored = false;     // the device counts against the motor's direction
    bool reversed = false;     // the counts decrease while the motor's pulses increase
    std::int64_t surplus = 0;  // additional counts
    bool operator==(const Encoder&) const = default;

    /// Converts to another linear function with the same members.
    template <class Line>
    Line as() const {
      Line line;
      line.counts = counts;
      line.pulses = pulses;
      line.origin = origin;
      line.first = first;
      line.last = last;
      line.mirrored = mirrored;
      line.reversed = reversed;
      line.surplus = surplus;
      return line;
    }
  };
  static constexpr std::size_t kMaxSpans = 5;

  std::array<Span, kMaxSpans> spans{};
  std::size_t span_count = 0;
  Index index{};
  Encoder encoder{};

  bool operator==(const MachineEdges&) const = default;

  /// Returns null if the input has the same level at every position.
  const Span* span_of(int input) const {
    for (std::size_t i = 0; i < span_count; ++i) {
      if (spans[i].input == input) return &spans[i];
    }
    return nullptr;
  }
  /// Returns the edges as they appear to a device that counts against the motor's direction.
  MachineEdges reversed() const {
    MachineEdges made = *this;
    for (std::size_t i = 0; i < span_count; ++i) {
      made.spans[i].first = -spans[i].last;
      made.spans[i].last = -spans[i].first;
    }
    made.index.at = -index.at - (index.width - 1);
    turn_round(made.index.first, made.index.last);
    made.encoder.origin = -encoder.origin;
    made.encoder.mirrored = !encoder.mirrored;
    turn_round(made.encoder.first, made.encoder.last);
    return made;
  }

 private:
  static void turn_round(std::int64_t& first, std::int64_t& last) {
    const std::int64_t before = first;
    first = last == INT64_MAX ? INT64_MIN : -last;
    last = before == INT64_MIN ? INT64_MAX : -before;
  }
};

}  // namespace understudy::emulator
