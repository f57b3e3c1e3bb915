// Moves to any moment of a recording, forwards or backwards, starting from the previous keyframe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

class Timeline {
 public:
  /// The minimum time between keyframes. It becomes longer if there would otherwise be too many keyframes.
  static constexpr SimTime kApart = std::chrono::seconds(1);
  static constexpr std::size_t kMaxKeyframes = 1'000;

  /// Applies the events in order, beginning with the state in which the recording begins. `on_way` is called
  /// at the end, and at each keyframe except the first; the world then stays in that state. The world must be
  /// created from the recording's bench and outlive this object.
  Timeline(World& world, const WorldState& begin, std::vector<RecordedEvent> events, SimTime end,
           const std::function<void()>& on_way);

  SimTime begin() const { return keyframes_.front().at; }
  SimTime end() const { return end_; }
  const std::vector<RecordedEvent>& events() const { return events_; }
  std::size_t keyframes() const { return keyframes_.size(); }
  SimTime time_of_keyframe(std::size_t number) const { return keyframes_[number].at; }

  /// Moves the world to that time, after all events of that moment. `set_state` puts the world into the state
  /// of a keyframe. It also receives the keyframe's number, which equals the number of earlier `on_way`
  /// calls.
  void go_to(SimTime time, const std::function<void(const WorldState&, std::size_t keyframe)>& set_state);
  /// Continues from the world's current time to `until`, or until the world is stopped. Afterwards, all
  /// events of that moment have happened.
  void play_on(SimTime until, const std::function<bool()>& is_stopped);

  /// Plays a stretch of time again in another world from the same bench, and calls `look` at its beginning,
  /// at intervals of `apart`, and at its end.
  void play_again(World& other, SimTime from, SimTime to, SimTime apart,
                  const std::function<void()>& look) const;

 private:
  struct Keyframe {
    SimTime at{0};
    std::size_t next_event = 0;
    WorldState state;
  };
  std::size_t play(World& world, std::size_t next_event, SimTime until) const;
  static void drop_output(World& world);

  World& world_;
  std::vector<RecordedEvent> events_;
  SimTime end_;
  std::vector<Keyframe> keyframes_;
  std::size_t next_event_ = 0;  // the first event that has not been applied to the world
};

}  // namespace understudy::emulator::world
