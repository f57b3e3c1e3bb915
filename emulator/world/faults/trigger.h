// When a fault strikes: at which frames and times, under which condition, how often and for how long.
//
// A trigger is evaluated on occasions. For faults of frames, each frame of their place is an occasion. For
// faults of the machine or of a device it is each frame too, if the trigger is about frames; otherwise each
// moment at which the time or a condition may have changed. A FaultCourse counts occasions and hits. The
// result is a function of the occasions alone, so every run has the same hits.
#pragma once

#include <cstdint>
#include <string>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

struct FaultTrigger {
  // Which frames match. Matching frames are numbered from 1.
  std::int64_t function = -1;       // -1: any
  std::int64_t station = -1;        // that the frame is for; 0 is a broadcast; -1: any
  std::int64_t first_address = -1;  // a register from here to `last_address` is in it; -1: any
  std::int64_t last_address = -1;
  // Which occasions match in addition.
  SimTime at{-1};  // the first occasion from then on; with `lasts`, all until that time is over. -1: any time
  SimTime from{0};        // included
  SimTime to = kForever;  // not included
  std::string when{};     // an expression; empty: always
  // Which of the matching occasions are hit: all of these must hold.
  std::int64_t first_nth = 1;
  std::int64_t last_nth = kNever;
  std::int64_t every = 0;   // its number is a multiple; 0: any
  std::int64_t chance = 0;  // in kAlways; 0: not by chance
  std::int64_t seed =
      -1;  // of its own random stream; -1: derived from the world's seed and the fault's number
  // How often and how long.
  std::int64_t times = 0;  // the largest number of hits; 0: any number
  SimTime lasts{0};        // `for`: all matching occasions within that time after a hit are hit as well

  bool operator==(const FaultTrigger&) const = default;
};

inline constexpr std::int64_t kAlways = 100'000'000;  // 100%

/// The progress of a fault.
struct FaultCourse {
  std::int64_t seen = 0;     // frames of its place
  std::int64_t matched = 0;  // occasions that matched
  std::int64_t hits = 0;
  SimTime until{-1};      // when the hit in effect ends
  SimTime looked_at{-1};  // of time alone: the moment
  bool was_met = false;   // time and condition, when looked at last
  bool in_force = false;  // of machines and devices
  bool is_news = false;   // it has just begun or ended, and is still to be executed
  // For requests of a line: the last evaluated request, about which each station asks.
  std::uint64_t judged_character = 0;
  bool was_hit = false;

  bool operator==(const FaultCourse&) const = default;
};

/// Facts about a request, or about the request that a reply answers.
struct FrameFacts {
  SimTime at{0};
  int station = 0;
  int function = 0;
  int first = 0;  // register
  int count = 0;  // of them; 0: it is about none
};

/// Returns whether a trigger's expression is true.
class ConditionSource {
 public:
  virtual bool holds(const std::string& expression) = 0;

 protected:
  ~ConditionSource() = default;
};

/// Returns true if it is about frames, so that time alone does not trigger it.
bool is_about_frames(const FaultTrigger& trigger);
/// Returns true if only time decides, so that it strikes at exact moments rather than at ticks.
bool is_of_time_alone(const FaultTrigger& trigger);

/// Judges one frame and returns true if it is hit. Random numbers come from `stream` if the trigger has no
/// seed.
bool strikes_frame(const FaultTrigger& trigger, FaultCourse& course, const FrameFacts& frame,
                   ConditionSource& conditions, std::uint64_t stream);

/// Judges a trigger that is not about frames and returns true if it strikes now. `course` then tells whether
/// it is in effect.
bool strikes_time(const FaultTrigger& trigger, FaultCourse& course, SimTime now, ConditionSource& conditions,
                  std::uint64_t stream);

/// Returns the next moment at which a trigger of time alone must be judged, or kForever if it is finished.
SimTime next_moment(const FaultTrigger& trigger, const FaultCourse& course);
/// For other triggers: returns the first tick after `done` whose end may change something, or kNever if only
/// a frame can.
Tick next_look(const FaultTrigger& trigger, const FaultCourse& course, Tick done);

/// Returns the `n`th number, from 1, of the splitmix64 stream that begins at `seed`.
std::uint64_t draw(std::uint64_t seed, std::uint64_t n);

}  // namespace understudy::emulator::world
