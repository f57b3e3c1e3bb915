#include "emulator/world/look/curves.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

Curves::Curves(World& world, const std::vector<std::string>& names, SimTime from, SimTime to,
               std::size_t dots)
    : world_(world), probes_(world), from_(from), to_(to), dots_(dots) {
  for (const std::string& name : names) {
    Row row{.handle = probes_.resolve(name).handle,
            .min = std::vector<double>(dots),
            .max = std::vector<double>(dots)};
    static_cast<void>(probes_.value(row.handle));  // throws for a name that only scenarios have
    rows_.push_back(std::move(row));
  }
}

void Curves::watch() {
  if (!std::exchange(is_watching_, true)) world_.add_watcher(*this);
}

void Curves::stop() {
  if (std::exchange(is_watching_, false)) world_.remove_watcher(*this);
}

Tick Curves::next_poll(Tick done) const {
  Tick next = kNever;
  for (const Row& row : rows_) next = std::min(next, probes_.next_change(row.handle, done));
  return next;
}

std::size_t Curves::dot_of(SimTime time) const {
  const auto length = static_cast<double>((to_ - from_).count());
  const auto part = static_cast<double>((std::clamp(time, from_, to_) - from_).count()) / length;
  return std::min(dots_ - 1, static_cast<std::size_t>(part * static_cast<double>(dots_)));
}

/// Repeats the last values in all dots up to this dot, which may receive further values.
void Curves::last_until(std::size_t dot) {
  for (; dot_ < dot; ++dot_) {
    for (Row& row : rows_) row.min[dot_ + 1] = row.max[dot_ + 1] = row.last;
  }
}

void Curves::look() { take(world_.now()); }

void Curves::take(SimTime time) {
  const std::size_t dot = dot_of(time);
  if (has_values_) last_until(dot);
  for (Row& row : rows_) {
    row.last = probes_.value(row.handle).real();
    row.min[dot] = has_values_ ? std::min(row.min[dot], row.last) : row.last;
    row.max[dot] = has_values_ ? std::max(row.max[dot], row.last) : row.last;
  }
  if (!has_values_) dot_ = dot;
  has_values_ = true;
}

void Curves::finish() {
  stop();
  if (has_values_) last_until(dots_ - 1);
}

}  // namespace understudy::emulator::world
