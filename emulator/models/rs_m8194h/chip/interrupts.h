// RS-M8194H: events for hosts and macros: RINT_STATE, the factors of the axes, and interrupts that are
// waiting for their ISRs (4.15, 4.16, 7.3.12).
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

/// The maximum number of waiting interrupts, if they are counted.
inline constexpr std::size_t kMaxMarks = 256;

/// An interrupt that is waiting for its ISR.
struct IsrMark {
  static constexpr std::uint8_t kSynchronous = 8;
  static constexpr std::uint8_t kCalled = 9;  // MP_ISR_CALL

  Tick tick = 0;
  std::uint8_t axis = 0;
  std::uint8_t source = 0;  // nINT 0 to 7, or one of the above
  std::uint8_t number = 0;  // the ISR that was called, or that was bound at the time of the event

  auto operator<=>(const IsrMark&) const = default;
};

/// Bits of RINT_STATE (12.1.8).
enum class Rint : std::uint8_t {
  line_scan,
  mp_completed,
  user,
  stream,
  reserved_4,
  reserved_5,
  axes,
  module
};
constexpr std::uint8_t bit_of(Rint bit) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(bit));
}

/// Returns an axis and a source as one number.
constexpr std::uint8_t name_of_source(std::size_t axis, std::uint8_t source) {
  return static_cast<std::uint8_t>(axis << 4U | source);
}

struct InterruptState {
  std::uint8_t rint = 0;    // without bit 6, which depends on the error codes
  bool interrupts = false;  // ENABLE_INT
  std::array<AxisMask, kFactors> factor_axes{};
  std::vector<IsrMark> marks{};
  // sources of ISRs, by name_of_source(), in the order in which they were enabled
  std::vector<std::uint8_t> enabled{};

  bool operator==(const InterruptState&) const = default;
};

class Interrupts final : public Part {
 public:
  Interrupts(const Ground& ground, InterruptState& state, const Chip& chip)
      : Part(ground), state_(state), chip_(chip) {}

  InterruptState& state() { return state_; }
  const InterruptState& state() const { return state_; }

  void reset() { state_ = {}; }
  void raise(Rint bit) { state_.rint |= bit_of(bit); }
  void clear(Rint bit) { state_.rint &= static_cast<std::uint8_t>(~bit_of(bit)); }

  /// Handles the events of an axis that are factors: records them, and marks the ISRs that they call.
  void check_factors(std::size_t axis, motion::Events events, Tick tick, std::int64_t pulses = 0);
  /// Handles the interrupt of an axis's synchronous action, which is recorded for `noted_axis`.
  void on_synchronous(std::size_t axis, std::size_t noted_axis, Tick tick);
  /// Records an axis event for the factors.
  void note_factor(std::size_t axis, Factor factor);
  void forget_factor(std::size_t axis, std::size_t factor);
  /// Records the order in which ISR sources were enabled.
  void note_enabled(std::size_t axis, std::uint8_t source, bool is_on);
  /// Marks an ISR that a command calls.
  void call(int number);
  /// Returns true if the ISR of a mark should run now.
  bool is_due() const;
  IsrMark take_mark();
  void forget_marks() { state_.marks.clear(); }
  /// Returns the number of the ISR that a mark calls; 0: none.
  int isr_of(const IsrMark& mark) const;

 private:
  void mark_isr(std::size_t axis, std::uint8_t source, Tick tick);
  int bound_isr(const IsrMark& mark) const;

  InterruptState& state_;
  const Chip& chip_;
};

}  // namespace understudy::emulator::models::rs_m8194h
