// When a fault strikes: at which frames, at which times, under which condition, how often and for how long.
//
// A trigger is asked on occasions. Faults of frames are asked at each frame of their place; so are faults of
// the machine or of a device if their trigger is about frames, else they are asked when time or a condition
// may have changed. A FaultCourse counts the occasions and the hits: with it a trigger is a function of the
// occasions alone, so it hits the same ones in every run.
#pragma once

#include <cstdint>
#include <string>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

struct FaultTrigger {
  // Which frames match. Those that do are numbered from 1.
  std::int64_t function = -1;       // -1: any
  std::int64_t station = -1;        // that the frame is for; 0 is a broadcast; -1: any
  std::int64_t first_address = -1;  // a register from here to `last_address` is in it; -1: any
  std::int64_t last_address = -1;
  // Which occasions match as well.
  SimTime at{-1};         // the first one from then on; with `lasts` all until that is over. -1: any time
  SimTime from{0};        // included
  SimTime to = kForever;  // not included
  std::string when{};     // an expression; empty: always
  // Which of those that match are hit: all of these must hold.
  std::int64_t first_nth = 1;
  std::int64_t last_nth = kNever;
  std::int64_t every = 0;   // its number is a multiple; 0: any
  std::int64_t chance = 0;  // in kAlways; 0: not by chance
  std::int64_t seed = -1;   // of its own stream; -1: made of the world's seed and the fault's number
  // How much of it.
  std::int64_t times = 0;  // at most this many hits; 0: any number
  SimTime lasts{0};        // `for`: whatever matches within that time after a hit is hit as well

  bool operator==(const FaultTrigger&) const = default;
};

inline constexpr std::int64_t kAlways = 100'000'000;  // 100%

/// How far a fault has got.
struct FaultCourse {
  std::int64_t seen = 0;     // frames of its place
  std::int64_t matched = 0;  // occasions that matched
  std::int64_t hits = 0;
  SimTime until{-1};      // what a hit lasts to
  SimTime looked_at{-1};  // of time alone: the moment
  bool was_met = false;   // time and condition, when looked at last
  bool in_force = false;  // of machines and devices
  bool is_news = false;   // it has just begun or ended, and is still to be carried out
  // Of a line's requests: the one judged last, which each station asks about.
  std::uint64_t judged_character = 0;
  bool was_hit = false;

  bool operator==(const FaultCourse&) const = default;
};

/// A request, or the one that a reply answers.
struct FrameFacts {
  SimTime at{0};
  int station = 0;
  int function = 0;
  int first = 0;  // register
  int count = 0;  // of them; 0: it is about none
};

/// Knows whether a trigger's expression holds.
class ConditionSource {
 public:
  virtual bool holds(const std::string& expression) = 0;

 protected:
  ~ConditionSource() = default;
};

/// Whether it is about frames, so that time alone does not trigger it.
bool is_about_frames(const FaultTrigger& trigger);
/// Whether nothing but time decides, so that it strikes at exact moments and not at ticks.
bool is_of_time_alone(const FaultTrigger& trigger);

/// Judges one frame; returns whether it is hit. Chance is drawn from `stream` if the trigger has no seed.
bool strikes_frame(const FaultTrigger& trigger, FaultCourse& course, const FrameFacts& frame,
                   ConditionSource& conditions, std::uint64_t stream);

/// Looks at a trigger that is not about frames; returns whether it strikes now. `course` says whether it is
/// in force.
bool strikes_time(const FaultTrigger& trigger, FaultCourse& course, SimTime now, ConditionSource& conditions,
                  std::uint64_t stream);

/// The next moment to look at a trigger of time alone; kForever if it is finished.
SimTime next_moment(const FaultTrigger& trigger, const FaultCourse& course);
/// For other triggers: the first tick after `done` whose end may change something; kNever if only a frame
/// can.
Tick next_look(const FaultTrigger& trigger, const FaultCourse& course, Tick done);

/// The `n`th number, from 1, of the splitmix64 stream that begins at `seed`.
std::uint64_t draw(std::uint64_t seed, std::uint64_t n);

}  // namespace understudy::emulator::world
