// A recording to go to and fro in: any moment of it, from the keyframe before.
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
  /// Keyframes are as far apart as this, or farther where there would be too many.
  static constexpr SimTime kApart = std::chrono::seconds(1);
  static constexpr std::size_t kMostKeyframes = 1'000;

  /// Plays the events, in their order, from the state in which the recording begins; `on_way` is called at
  /// each keyframe, and at the end. The world is left there. It must outlive this, and be of the recording's
  /// bench.
  Timeline(World& world, const WorldState& begin, std::vector<RecordedEvent> events, SimTime end,
           const std::function<void()>& on_way);

  SimTime begin() const { return keyframes_.front().at; }
  SimTime end() const { return end_; }
  const std::vector<RecordedEvent>& events() const { return events_; }
  std::size_t keyframes() const { return keyframes_.size(); }

  /// Puts the world where it was at that time, after all that happened then; `take_back` takes it to the
  /// state of a keyframe, of which it is told the number: as many calls of `on_way` came before it.
  void go_to(SimTime time, const std::function<void(const WorldState&, std::size_t keyframe)>& take_back);

 private:
  struct Keyframe {
    SimTime at{0};
    std::size_t next_event = 0;
    WorldState state;
  };
  std::size_t play(std::size_t next_event, SimTime until);

  World& world_;
  std::vector<RecordedEvent> events_;
  SimTime end_;
  std::vector<Keyframe> keyframes_;
};

}  // namespace understudy::emulator::world
