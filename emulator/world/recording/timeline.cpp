#include "emulator/world/recording/timeline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

Timeline::Timeline(World& world, const WorldState& begin, std::vector<RecordedEvent> events, SimTime end,
                   const std::function<void()>& on_way)
    : world_(world), events_(std::move(events)) {
  restore(world_, begin);
  end_ = std::max(end, world_.now());
  keyframes_.push_back({.at = world_.now(), .next_event = 0, .state = begin});
  const SimTime apart = std::max(kApart, (end_ - world_.now()) / static_cast<std::int64_t>(kMaxKeyframes));
  std::size_t next = 0;
  for (SimTime at = world_.now() + apart; at < end_; at += apart) {
    next = play(world_, next, at);
    keyframes_.push_back({.at = at, .next_event = next, .state = save(world_)});
    on_way();
  }
  next_event_ = play(world_, next, end_);
  on_way();
}

/// Plays the events up to `until`. Returns the index of the first later event.
std::size_t Timeline::play(World& world, std::size_t next_event, SimTime until) const {
  for (; next_event < events_.size() && events_[next_event].at <= until; ++next_event) {
    world.advance_to(events_[next_event].at);
    apply(world, events_[next_event]);
  }
  world.advance_to(until);
  drop_output(world);
  return next_event;
}

/// Drops output that no host has read, so that it does not reach a host that opens the line later.
void Timeline::drop_output(World& world) {
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    world.take_output(i, world.line(i).line.output().size());
  }
}

void Timeline::play_on(SimTime until, const std::function<bool()>& is_stopped) {
  until = std::min(until, end_);
  for (bool is_over = until <= world_.now(); !is_over;) {
    const bool is_next = next_event_ < events_.size() && events_[next_event_].at <= until;
    const SimTime target = is_next ? events_[next_event_].at : until;
    world_.advance_to(target);
    is_over = !is_next || is_stopped();
    for (; next_event_ < events_.size() && events_[next_event_].at <= world_.now(); ++next_event_)
      apply(world_, events_[next_event_]);
  }
  drop_output(world_);
}

void Timeline::go_to(SimTime time,
                     const std::function<void(const WorldState&, std::size_t keyframe)>& set_state) {
  time = std::clamp(time, begin(), end_);
  const auto later = std::upper_bound(keyframes_.begin(), keyframes_.end(), time,
                                      [](SimTime at, const Keyframe& keyframe) { return at < keyframe.at; });
  // If the previous keyframe is near, it is better, because observers then see the events that led to the
  // moment.
  const bool has_near = later - keyframes_.begin() > 1 && time - (later - 2)->at <= 2 * kApart;
  const Keyframe& from = *(later - (has_near ? 2 : 1));
  set_state(from.state, static_cast<std::size_t>(&from - keyframes_.data()));
  restore(world_, from.state);  // also restores the hosts of that time, in place of the current hosts
  next_event_ = play(world_, from.next_event, time);
}

void Timeline::play_again(World& other, SimTime from, SimTime to, SimTime apart,
                          const std::function<void()>& look) const {
  from = std::clamp(from, begin(), end_);
  to = std::clamp(to, from, end_);
  const auto later = std::upper_bound(keyframes_.begin(), keyframes_.end(), from,
                                      [](SimTime at, const Keyframe& keyframe) { return at < keyframe.at; });
  const Keyframe& keyframe = *(later - 1);
  restore(other, keyframe.state);
  std::size_t next = play(other, keyframe.next_event, from);
  look();
  for (SimTime at = from; at < to;) {
    at = std::min(to, at + apart);
    next = play(other, next, at);
    look();
  }
}

}  // namespace understudy::emulator::world
