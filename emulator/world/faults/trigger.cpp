#include "emulator/world/faults/trigger.h"

#include <algorithm>
#include <cstdint>
#include "base/simulated_time.h"

namespace understudy::emulator::world {

namespace {

bool is_moment(const FaultTrigger& trigger) { return trigger.at >= SimTime{0}; }

SimTime begin_of(const FaultTrigger& trigger) { return std::max(trigger.at, trigger.from); }

/// Returns the end of the time during which the trigger is active; the end is not included.
SimTime end_of(const FaultTrigger& trigger) {
  return is_moment(trigger) && trigger.lasts > SimTime{0} ? trigger.at + trigger.lasts : trigger.to;
}

bool is_exhausted(const FaultTrigger& trigger, const FaultCourse& course) {
  if (is_moment(trigger) && trigger.lasts == SimTime{0}) return course.hits > 0;
  return trigger.times != 0 && course.hits >= trigger.times;
}

bool is_lucky(const FaultTrigger& trigger, std::int64_t number, std::uint64_t stream) {
  const std::uint64_t seed = trigger.seed >= 0 ? static_cast<std::uint64_t>(trigger.seed) : stream;
  const std::uint64_t high = draw(seed, static_cast<std::uint64_t>(number)) >> 32;
  return (high * static_cast<std::uint64_t>(kAlways) >> 32) < static_cast<std::uint64_t>(trigger.chance);
}

/// Returns true if the trigger selects the match with this number.
bool selects(const FaultTrigger& trigger, std::int64_t number, std::uint64_t stream) {
  if (number < trigger.first_nth || number > trigger.last_nth) return false;
  if (trigger.every != 0 && number % trigger.every != 0) return false;
  return trigger.chance == 0 || is_lucky(trigger, number, stream);
}

bool fits(const FaultTrigger& trigger, const FrameFacts& frame) {
  if (trigger.function >= 0 && trigger.function != frame.function) return false;
  if (trigger.station >= 0 && trigger.station != frame.station) return false;
  if (trigger.first_address < 0) return true;
  const auto concerns = [&](const FrameFacts::Addresses& addresses) {
    return addresses.count > 0 && trigger.last_address >= addresses.first &&
           trigger.first_address < std::int64_t{addresses.first} + addresses.count;
  };
  return concerns(frame.read) || concerns(frame.written);
}

bool is_met(const FaultTrigger& trigger, SimTime now, ConditionSource& conditions) {
  return now >= begin_of(trigger) && now < end_of(trigger) &&
         (trigger.when.empty() || conditions.holds(trigger.when));
}

void begin_to_last(const FaultTrigger& trigger, FaultCourse& course, SimTime now, SimTime lasts) {
  if (lasts > SimTime{0}) course.until = is_moment(trigger) ? end_of(trigger) : now + lasts;
}

/// Returns the first tick that does not end before `time`.
Tick tick_from(SimTime time) { return tick_at(time) + (time % kTickLength == SimTime{0} ? 0 : 1); }

}  // namespace

std::uint64_t draw(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + n * 0x9E3779B97F4A7C15;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
  z = (z ^ z >> 27) * 0x94D049BB133111EB;
  return z ^ z >> 31;
}

bool is_about_frames(const FaultTrigger& trigger) {
  return trigger.function >= 0 || trigger.first_address >= 0 || trigger.station >= 0 ||
         trigger.first_nth != 1 || trigger.last_nth != kNever || trigger.every != 0;
}

bool is_of_time_alone(const FaultTrigger& trigger) {
  return !is_about_frames(trigger) && trigger.when.empty() && trigger.chance == 0;
}

bool strikes_frame(const FaultTrigger& trigger, FaultCourse& course, const FrameFacts& frame,
                   ConditionSource& conditions, std::uint64_t stream) {
  ++course.seen;
  if (!fits(trigger, frame)) return false;
  const bool is_lasting = frame.at < course.until;
  if (!is_lasting && !is_met(trigger, frame.at, conditions)) return false;
  ++course.matched;
  if (is_exhausted(trigger, course)) return false;
  if (!is_lasting && !selects(trigger, course.matched, stream)) return false;
  ++course.hits;
  if (!is_lasting) begin_to_last(trigger, course, frame.at, trigger.lasts);
  return true;
}

bool strikes_time(const FaultTrigger& trigger, FaultCourse& course, SimTime now, ConditionSource& conditions,
                  std::uint64_t stream) {
  course.looked_at = is_of_time_alone(trigger) ? now : course.looked_at;
  // An exhausted trigger no longer changes.
  if (is_exhausted(trigger, course) && !course.in_force) return false;
  // A fault that occurs by chance lasts one tick, or longer if its trigger has a duration.
  const bool by_chance = trigger.chance != 0;
  const SimTime lasts = by_chance ? std::max(trigger.lasts, kTickLength) : trigger.lasts;
  const bool met = is_met(trigger, now, conditions);
  const bool is_occasion = met && (by_chance ? now >= course.until : !course.was_met);
  course.was_met = met;
  bool strikes = false;
  if (is_occasion) {
    ++course.matched;
    strikes = !is_exhausted(trigger, course) && selects(trigger, course.matched, stream);
  }
  if (strikes) {
    ++course.hits;
    begin_to_last(trigger, course, now, lasts);
  }
  course.in_force = lasts > SimTime{0} ? now < course.until : met && (strikes || course.in_force);
  return strikes;
}

SimTime next_moment(const FaultTrigger& trigger, const FaultCourse& course) {
  if (!is_of_time_alone(trigger)) return kForever;
  SimTime next = kForever;
  for (const SimTime time : {begin_of(trigger), end_of(trigger), course.until}) {
    if (time > course.looked_at) next = std::min(next, time);
  }
  return next;
}

Tick next_poll(const FaultTrigger& trigger, const FaultCourse& course, Tick done) {
  if (is_of_time_alone(trigger)) return kNever;
  const SimTime now = time_of(done);
  Tick next = kNever;
  const auto offer = [&](SimTime time) {
    if (time > now && time != kForever) next = std::min(next, tick_from(time));
  };
  if (course.in_force) offer(course.until);
  if (is_about_frames(trigger)) return next;
  if (is_exhausted(trigger, course) && !course.in_force) return next;
  if (now >= begin_of(trigger) && now < end_of(trigger)) return done + 1;
  offer(begin_of(trigger));
  return next;
}

}  // namespace understudy::emulator::world
