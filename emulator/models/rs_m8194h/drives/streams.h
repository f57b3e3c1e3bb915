// RS-M8194H: the path that runs, those that are held, and streams that end before their last segment (7.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "interpreter/rs_m8194h/command.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

/// The blocks of the FIFO, and the most segments of a stream that are held.
inline constexpr int kFifoBlocks = 30;

/// A held interpolation, with the axes for which it was sent.
struct HeldPath {
  lang::Command command{};
  std::array<std::uint8_t, 3> codes{};

  bool operator==(const HeldPath&) const = default;
};

/// Returns true if the command is an interpolation.
bool is_path(const lang::Command& command);
/// Returns true if `other` is a segment of the same stream.
bool follows(const HeldPath& first, const HeldPath& other);
/// Return true if the path is a segment of a stream, and if it is the last one.
bool is_segment(const HeldPath& path);
bool is_last_segment(const HeldPath& path);

struct StreamState {
  // paths that wait for DRV_START; a segment is followed by those of its stream
  std::vector<HeldPath> held_paths{};
  // segments of the running stream: the current one and those ready behind it
  std::vector<HeldPath> loaded{};

  bool operator==(const StreamState&) const = default;
};

class Streams final : public Part {
 public:
  Streams(const Ground& ground, StreamState& state, Chip& chip, Interrupts& interrupts)
      : Part(ground), state_(state), chip_(chip), interrupts_(interrupts) {}

  std::vector<HeldPath>& held() { return state_.held_paths; }
  const std::vector<HeldPath>& held() const { return state_.held_paths; }
  std::vector<HeldPath>& loaded() { return state_.loaded; }

  void reset() { state_ = {}; }
  /// Returns the axes of the held path, or none.
  AxisMask axes_of_held() const;
  /// Discards the held path, which will not run.
  void drop_held();

  /// Returns true if the path is a segment of the running stream.
  bool joins(const HeldPath& path) const;
  /// Returns true if the running stream accepts one more segment.
  bool has_room() const;
  /// Returns true if all axes of a path are where it ends.
  bool is_complete() const;
  /// Handles a path that has ended, or whose end has come near.
  void on_path_end(bool was_full);
  /// Forgets the segments that have been run.
  void forget_done();

  /// Return the law by which the path slows down to its end, and slow the path down by it.
  motion::SpeedLaw law_to_slow_down() const;
  void slow_down(Tick tick);
  void stop(motion::Instant at = {});
  /// Ends a starved stream on this axis, because a drive of single axes begins.
  void on_single_drive(std::size_t axis);

  /// Breaks off the stream that runs or slows down, or that has starved.
  void break_off();
  /// Breaks off the stream of a segment that may not begin; the segments behind it do not begin either.
  void refuse(const HeldPath& path);
  /// Returns true if a segment belongs to what is left of a stream that was broken off.
  bool is_left_over(const HeldPath& segment);
  void forget_break(Stream stream);

 private:
  void break_off(Stream stream, bool has_more);

  StreamState& state_;
  Chip& chip_;
  Interrupts& interrupts_;
};

}  // namespace understudy::emulator::models::rs_m8194h
