#include "emulator/world/recording/recent_course.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/timeline.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

RecentCourse::RecentCourse(World& world)
    : world_(world),
      begin_at_(world.now()),
      begin_(save(world)),
      recorder_(world, [this](RecordedEvent event) { take(std::move(event)); }) {}

void RecentCourse::take(RecordedEvent event) {
  // What stations send follows from the other events.
  if (is_paused_ || is_too_long_ || event.what == RecordedEvent::What::sent ||
      event.what == RecordedEvent::What::end)
    return;
  timeline_.reset();
  if (events_.size() == kMaxEvents) {
    is_too_long_ = true;
    events_ = {};
    return;
  }
  events_.push_back(std::move(event));
}

Timeline& RecentCourse::timeline() {
  if (timeline_ && world_.now() <= timeline_->end()) return *timeline_;
  timeline_ = std::make_unique<Timeline>(world_, begin_, events_, world_.now(), [] {});
  return *timeline_;
}

void RecentCourse::drop_after(SimTime moment) {
  const auto later = std::upper_bound(events_.begin(), events_.end(), moment,
                                      [](SimTime at, const RecordedEvent& event) { return at < event.at; });
  if (later == events_.end()) return;
  events_.erase(later, events_.end());
  timeline_.reset();
}

}  // namespace understudy::emulator::world
