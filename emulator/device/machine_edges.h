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
  static constexpr std::size_t kMostSpans = 5;

  std::array<Span, kMostSpans> spans{};
  std::size_t span_count = 0;
  Index index{};

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
    made.index.first = index.last == INT64_MAX ? INT64_MIN : -index.last;
    made.index.last = index.first == INT64_MIN ? INT64_MAX : -index.first;
    return made;
  }
};

}  // namespace understudy::emulator
