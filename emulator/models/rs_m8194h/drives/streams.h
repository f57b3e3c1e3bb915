// RS-M8194H: the running path, the held paths, and streams that end before their last segment (7.4).
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

/// The number of FIFO blocks, which is also the maximum number of held segments of a stream.
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
/// These return true if the path is a segment of a stream, and if it is the last segment.
bool is_segment(const HeldPath& path);
bool is_last_segment(const HeldPath& path);

struct StreamState {
  // paths that wait for DRV_START; a segment is followed by the other segments of its stream
  std::vector<HeldPath> held_paths{};
  // segments of the running stream: the current one, and those that are ready to follow it
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
  /// Returns true if all axes of a path are at its end.
  bool is_complete() const;
  /// Handles a path that has ended or is about to end.
  void on_path_end(bool was_full);
  /// Removes the segments that have been run.
  void forget_done();

  /// Return the speed law for slowing down to the end of the path, and slow down the path by it.
  motion::SpeedLaw law_to_slow_down() const;
  void slow_down(Tick tick);
  void stop(motion::Instant at = {});
  /// Ends a starved stream on this axis because a drive of single axes begins.
  void on_single_drive(std::size_t axis);

  /// Breaks off the stream that is running or slowing down, or that has starved.
  void break_off();
  /// Ends the stream of a segment that must not begin, so the following segments do not begin.
  void refuse(const HeldPath& path);
  /// Returns true if a segment belongs to the rest of a stream that was broken off.
  bool is_left_over(const HeldPath& segment);
  void forget_break(Stream stream);

 private:
  void break_off(Stream stream, bool has_more);

  StreamState& state_;
  Chip& chip_;
  Interrupts& interrupts_;
};

}  // namespace understudy::emulator::models::rs_m8194h
