// Where along an axis the switches of its machine change the levels of inputs: this is what a device that
// meets edges at the pulse where they lie is told (Axes::meets_edges()). An input that is not here has its
// level, wherever the axis is: it is wired to no switch, or held, stuck, or on by a wire as well; or pulses
// are being lost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::emulator {

struct MachineEdges {
  /// An input has one level from `first` to `last`, both included, and the other one elsewhere.
  struct Span {
    int input = -1;  // a digital terminal
    bool level_inside = true;
    std::int64_t first = 0;  // in the count of Axes::place_pulses()
    std::int64_t last = 0;
    std::int64_t slack = 0;  // >= 0; once inside, it stays so as far as this beyond either end
    bool operator==(const Span&) const = default;
  };
  /// The same, for `width` pulses from every `at + k * period`.
  struct Index {
    int input = -1;
    bool level_inside = true;
    std::int64_t at = 0;
    std::int64_t width = 1;
    std::int64_t period = 0;  // 0: there is none
    // The machine's stops: beyond them it is as it is there.
    std::int64_t first = INT64_MIN;
    std::int64_t last = INT64_MAX;
    bool operator==(const Index&) const = default;
  };
  /// What its encoder counts: floor((place - origin) * counts / pulses), between the machine's stops.
  struct Encoder {
    std::int64_t counts = 0;  // 0: it has none, or nobody knows before a tick is over what it will count
    std::int64_t pulses = 1;
    std::int64_t origin = 0;
    std::int64_t first = INT64_MIN;
    std::int64_t last = INT64_MAX;
    bool mirrored = false;     // of a device whose count runs against the motor's sense
    bool reversed = false;     // its counts fall where the motor's pulses rise
    std::int64_t surplus = 0;  // counts too many
    bool operator==(const Encoder&) const = default;

    /// As a line of another name, which has all of these.
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
  static constexpr std::size_t kMostSpans = 5;

  std::array<Span, kMostSpans> spans{};
  std::size_t span_count = 0;
  Index index{};
  Encoder encoder{};

  bool operator==(const MachineEdges&) const = default;

  /// Null where the input has its level wherever the axis is.
  const Span* span_of(int input) const {
    for (std::size_t i = 0; i < span_count; ++i) {
      if (spans[i].input == input) return &spans[i];
    }
    return nullptr;
  }
  /// As a device sees it whose count runs against the motor's sense.
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
