// Decides when a fault takes effect: at which frames and times, under which condition, how often and for how
// long.
//
// A trigger is evaluated on occasions. For faults of frames, each frame at the fault's place is an occasion.
// For faults of the machine or of a device, each frame is also an occasion if the trigger refers to frames;
// otherwise, an occasion is each moment at which the time or a condition may have changed. A FaultCourse
// counts occasions and hits. The result depends only on the occasions, so every run has the same hits.
#pragma once

#include <cstdint>
#include <string>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

struct FaultTrigger {
  // These fields decide which frames match. Matching frames are numbered from 1.
  std::int64_t function = -1;       // -1: any
  std::int64_t station = -1;        // the addressed station; 0: broadcasts; -1: any
  std::int64_t first_address = -1;  // the frame accesses a register from here to `last_address`; -1: any
  std::int64_t last_address = -1;
  // These fields also decide which occasions match.
  SimTime at{-1};   // the first occasion from then on, or, with `lasts`, all occasions until that time is
                    // over; -1: any time
  SimTime from{0};  // inclusive
  SimTime to = kForever;  // exclusive
  std::string when{};     // an expression; empty: always true
  // These fields decide which matching occasions are hits. All of them must be fulfilled.
  std::int64_t first_nth = 1;
  std::int64_t last_nth = kNever;
  std::int64_t every = 0;   // the number of the match is a multiple of this; 0: any number
  std::int64_t chance = 0;  // the probability, in parts of kAlways; 0: not by chance
  /// The seed of the fault's own random stream; -1: derived from the world's seed and the fault's number.
  std::int64_t seed = -1;
  // These fields decide how often and for how long the fault takes effect.
  std::int64_t times = 0;  // the maximum number of hits; 0: no limit
  SimTime lasts{0};        // `for`: all matching occasions within that time after a hit are also hits

  bool operator==(const FaultTrigger&) const = default;
};

inline constexpr std::int64_t kAlways = 100'000'000;  // 100%

/// The progress of a fault.
struct FaultCourse {
  std::int64_t seen = 0;     // frames at the fault's place
  std::int64_t matched = 0;  // occasions that matched
  std::int64_t hits = 0;
  SimTime until{-1};      // the end of the present hit
  SimTime looked_at{-1};  // when a trigger that depends only on time was last evaluated
  bool was_met = false;   // true if the time and the condition matched at the last check
  bool in_force = false;  // for faults of machines and devices
  bool is_news = false;   // the fault has just begun or ended, but this has not been applied yet
  // For faults of requests on a line: the last evaluated request, and the result, because each station on the
  // line asks about the same request.
  std::uint64_t judged_character = 0;
  bool was_hit = false;

  bool operator==(const FaultCourse&) const = default;
};

/// Facts about a request, or about the request to which a reply belongs.
struct FrameFacts {
  SimTime at{0};
  int station = 0;
  int function = 0;
  /// A range of registers; none if their number is 0.
  struct Addresses {
    int first = 0;
    int count = 0;
  };
  Addresses read{};
  Addresses written{};
};

/// Evaluates the conditions of triggers.
class ConditionSource {
 public:
  virtual bool holds(const std::string& expression) = 0;

 protected:
  ~ConditionSource() = default;
};

/// Returns true if the trigger refers to frames, so that time alone does not trigger it.
bool is_about_frames(const FaultTrigger& trigger);
/// Returns true if only time decides, so that the fault takes effect at exact moments rather than at ticks.
bool is_of_time_alone(const FaultTrigger& trigger);

/// Evaluates a trigger for a frame, and returns true if the frame is hit. If the trigger has no seed, random
/// numbers come from `stream`.
bool strikes_frame(const FaultTrigger& trigger, FaultCourse& course, const FrameFacts& frame,
                   ConditionSource& conditions, std::uint64_t stream);

/// Evaluates a trigger that does not refer to frames, and returns true if the fault takes effect now.
/// Afterwards, `course` shows whether the fault is active.
bool strikes_time(const FaultTrigger& trigger, FaultCourse& course, SimTime now, ConditionSource& conditions,
                  std::uint64_t stream);

/// Returns the next moment at which a trigger that depends only on time must be evaluated, or kForever if it
/// is finished.
SimTime next_moment(const FaultTrigger& trigger, const FaultCourse& course);
/// For all other triggers: returns the first tick after `done` whose end may change something, or kNever if
/// only a frame can.
Tick next_poll(const FaultTrigger& trigger, const FaultCourse& course, Tick done);

/// Returns the `n`th number, counted from 1, of the splitmix64 stream that begins at `seed`.
std::uint64_t draw(std::uint64_t seed, std::uint64_t n);

}  // namespace understudy::emulator::world
