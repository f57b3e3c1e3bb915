// One axis's pulse generator, as a value: it steps by ticks, and says how many pulses it sent.
//
// The axis knows directions and pulses. What a pulse means (a coordinate, a direction pin) and when a
// move is allowed (servo, alarm, limit) is for its owner to say.
#pragma once

#include <cstdint>

#include "motion/profile.h"

namespace understudy::motion {

enum class Drive : std::uint8_t {
  idle,
  position,  // a profile is running
  hanging,   // a move at speed 0: it counts as moving, sends nothing, and ends only by stop()
};

struct Axis {
  Drive drive = Drive::idle;
  std::int8_t direction = +1;    // +1 or -1, of the running move
  Tick start_tick = 0;           // the tick at which the profile is at its beginning
  std::int64_t sent_pulses = 0;  // of the running move, counted from 0 upwards
  Profile profile;

  bool operator==(const Axis&) const = default;

  /// Begins a move from standstill at `first_tick`, which is the first tick to be stepped; a move that
  /// is running is dropped where it is. A profile of no distance ends the motion at once.
  void start(const Profile& move, int move_direction, Tick first_tick);
  /// Begins a move that never sends a pulse.
  void hang(int move_direction);
  /// No pulse after this.
  void stop();

  bool moving() const { return drive != Drive::idle; }

  /// The tick's pulses, signed. Ticks must come in order, but may be skipped: the pulses of what was
  /// skipped then come together.
  std::int64_t step(Tick tick);

  /// The next tick whose step can send a pulse or end the move, when `done` is the last one stepped;
  /// kNever when nothing runs.
  Tick next_active_tick(Tick done) const;

  static constexpr Tick kNever = INT64_MAX;
};

}  // namespace understudy::motion
