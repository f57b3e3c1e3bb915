#include "emulator/world/look/program_spans.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/user_program.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

void ProgramSpans::watch() {
  if (!std::exchange(is_watching_, true)) world_.add_watcher(*this);
}

void ProgramSpans::stop() {
  if (std::exchange(is_watching_, false)) world_.remove_watcher(*this);
}

void ProgramSpans::take(SimTime time) {
  last_ = time;
  std::vector<Span> present;
  for (std::size_t i = 0; i < world_.device_count(); ++i) {
    const Device& device = world_.device(i);
    if (!device.powered() || device.user_program() == nullptr) continue;
    for (ProgramLocation& place : device.user_program()->program_locations()) {
      if (place.state == ProgramLocation::State::stopped) continue;
      present.push_back({.device = device.name(),
                         .program = std::move(place.program),
                         .line = place.line,
                         .text = std::move(place.text),
                         .waits_for = std::move(place.waits_for),
                         .has_failed = place.state == ProgramLocation::State::failed,
                         .begin = time,
                         .end = time});
    }
  }
  const auto is_same = [](const Span& one, const Span& other) {
    return one.line == other.line && one.has_failed == other.has_failed && one.program == other.program &&
           one.waits_for == other.waits_for && one.device == other.device;
  };
  for (Span& span : under_way_) {
    const auto found =
        std::find_if(present.begin(), present.end(), [&](const Span& other) { return is_same(span, other); });
    if (found != present.end()) {
      found->begin = span.begin;
      continue;
    }
    span.end = time;
    over_.push_back(std::move(span));
  }
  under_way_ = std::move(present);
}

std::vector<ProgramSpans::Span> ProgramSpans::finish() {
  stop();
  last_ = std::max(last_, world_.now());
  for (Span& span : under_way_) span.end = last_;
  std::move(under_way_.begin(), under_way_.end(), std::back_inserter(over_));
  under_way_.clear();
  return std::move(over_);
}

}  // namespace understudy::emulator::world
