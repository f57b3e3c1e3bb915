// The course of a world since a certain moment, kept in memory so that it can be played again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/timeline.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

class RecentCourse {
 public:
  /// The maximum number of outside events. A longer course is not kept.
  static constexpr std::size_t kMaxEvents = 100'000;

  /// Begins now. The world must outlive this object.
  explicit RecentCourse(World& world);

  /// Returns false if there were too many events.
  bool is_whole() const { return !is_too_long_; }
  SimTime begin() const { return begin_at_; }
  /// Returns the course up to now. If no event has occurred since the last call and the world has not passed
  /// the end of the course, returns the same object; otherwise, plays the whole course again. Call this
  /// outside World::advance_to(), while a Pause exists.
  Timeline& timeline();
  /// Drops all events after this moment, because the world takes a different course from there.
  void drop_after(SimTime moment);

  /// While this object exists, events are not kept, because they come from the course itself.
  class Pause {
   public:
    explicit Pause(RecentCourse& course) : course_(course) { course_.is_paused_ = true; }
    ~Pause() { course_.is_paused_ = false; }
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    RecentCourse& course_;
  };

 private:
  void take(RecordedEvent event);

  World& world_;
  SimTime begin_at_;
  WorldState begin_;
  std::vector<RecordedEvent> events_;
  bool is_paused_ = false;
  bool is_too_long_ = false;
  std::unique_ptr<Timeline> timeline_;  // created from `events_`; null if it must be created again
  Recorder recorder_;                   // the last member, because it calls take() as soon as it exists
};

}  // namespace understudy::emulator::world
