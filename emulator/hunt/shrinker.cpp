#include "emulator/hunt/shrinker.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/variation.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::hunt {

namespace {

using play::Disturbance;
using When = Disturbance::When;

}  // namespace

bool Shrinker::try_course(Course course) {
  if (course == best_.course || best_.plays >= kMaxPlays) return false;
  ++best_.plays;
  Outcome outcome = course_player_.play(course);
  if (outcome.kind != kind_) return false;
  best_.course = std::move(course);
  best_.outcome = std::move(outcome);
  return true;
}

bool Shrinker::fails(const Course& course) {
  ++best_.plays;
  return course_player_.play(course).kind == kind_;
}

Shrunk Shrinker::shrink(const Course& course, const Outcome& outcome) {
  best_ = {.course = course, .outcome = outcome};
  end_early();
  remove_disturbances();
  for (std::size_t i = 0; i < best_.course.disturbances.size(); ++i) simplify(i);
  Course in_order = best_.course;
  arrange(in_order.disturbances);
  try_course(std::move(in_order));
  remove_disturbances();
  leave_out_steps();
  best_.is_minimal = is_minimal();
  return std::move(best_);
}

/// Leaves out everything after the step that failed.
void Shrinker::end_early() {
  if (best_.outcome.failed_step == SIZE_MAX) return;
  Course shorter = best_.course;
  shorter.end = best_.outcome.failed_step + 1;
  std::erase_if(shorter.disturbances, [&](const Disturbance& one) { return one.step >= shorter.end; });
  try_course(std::move(shorter));
}

/// Removes a disturbance. If it makes a host repeat a request, later requests have lower numbers without it.
bool Shrinker::try_without(std::size_t number) {
  constexpr std::int64_t kMaxRepeats = 3;
  Course smaller = best_.course;
  const Disturbance removed = smaller.disturbances[number];
  smaller.disturbances.erase(smaller.disturbances.begin() + static_cast<std::ptrdiff_t>(number));
  if (try_course(smaller)) return true;
  for (std::int64_t repeats = 1; repeats <= kMaxRepeats; ++repeats) {
    Course earlier = smaller;
    for (Disturbance& one : earlier.disturbances) {
      const bool is_before = removed.when == When::nth && one.moment <= removed.moment;
      if (one.when == When::nth && one.moment > repeats && !is_before) one.moment -= repeats;
    }
    if (earlier != smaller && try_course(std::move(earlier))) return true;
  }
  return false;
}

/// Removes disturbances one by one until each is needed.
bool Shrinker::remove_disturbances() {
  bool is_smaller = false;
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = best_.course.disturbances.size(); i-- > 0;) {
      again = try_without(i) || again;
    }
    is_smaller = is_smaller || again;
  }
  return is_smaller;
}

/// Finds the smallest number with which the course fails, assuming that it fails with all greater ones.
void Shrinker::lower(std::size_t number, std::uint64_t low, std::uint64_t high,
                     const std::function<void(Disturbance&, std::uint64_t)>& set) {
  const auto attempt = [&](std::uint64_t value) {
    Course lower = best_.course;
    set(lower.disturbances[number], value);
    return try_course(std::move(lower));
  };
  if (low >= high || attempt(low)) return;
  while (low + 1 < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    (attempt(middle) ? high : low) = middle;
  }
}

void Shrinker::simplify(std::size_t number) {
  const Disturbance& one = best_.course.disturbances[number];
  const auto& values = course_player_.plan().entries()[one.entry].values;
  if (one.when == When::nth) {
    lower(number, 1, static_cast<std::uint64_t>(one.moment),
          [](Disturbance& it, std::uint64_t value) { it.moment = static_cast<std::int64_t>(value); });
  }
  if (has_time(one)) round_moment(number);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t present = best_.course.disturbances[number].values[i];
    const auto set = [i](Disturbance& it, std::uint64_t value) { it.values[i] = value; };
    if (!values[i].has_list()) {
      lower(number, 0, present, set);
      continue;
    }
    for (std::uint64_t place = 0; place < present; ++place) {
      Course simpler = best_.course;
      set(simpler.disturbances[number], place);
      if (try_course(std::move(simpler))) break;
    }
  }
}

/// Finds the roundest time near the current one with which the course still fails.
void Shrinker::round_moment(std::size_t number) {
  using namespace std::chrono_literals;
  constexpr std::array<SimTime, 5> kUnits{1s, 100ms, 10ms, 1ms, 100us};
  const Disturbance& one = best_.course.disturbances[number];
  const SimTime present(one.moment);
  const Window window = window_of(course_player_.plan().entries()[one.entry], course_player_.undisturbed());
  for (const SimTime unit : kUnits) {
    const SimTime below = present / unit * unit;
    for (const SimTime rounded : {below, below + unit}) {
      if (rounded == present) return;
      if (rounded < window.low || rounded > window.high) continue;
      Course rounder = best_.course;
      rounder.disturbances[number].moment = rounded.count();
      if (try_course(std::move(rounder))) return;
    }
  }
}

/// Returns how the course ends without any disturbance, and without each of them.
std::vector<std::string> Shrinker::ends_without(const Course& course) {
  std::vector<std::string> ends;
  const auto add = [&](const Course& other) {
    ++best_.plays;
    const Outcome outcome = course_player_.play(other);
    ends.push_back(outcome.is_cut_short ? "cut short" : outcome.kind);
  };
  Course other = course;
  other.disturbances.clear();
  add(other);
  for (std::size_t i = 0; course.disturbances.size() > 1 && i < course.disturbances.size(); ++i) {
    other = course;
    other.disturbances.erase(other.disturbances.begin() + static_cast<std::ptrdiff_t>(i));
    add(other);
  }
  return ends;
}

/// Leaves out steps of the scenario, the last one first, if the course then still fails because of its
/// disturbances: without any, and without each of them, it must end as it did with all steps. A step that
/// others need would make it fail in another way.
void Shrinker::leave_out_steps() {
  const std::vector<std::string> ends = ends_without(best_.course);
  const auto& steps = course_player_.scenario().steps;
  const std::size_t last = std::min(best_.course.end, steps.size());
  for (std::size_t i = last; i-- > 0;) {
    if (std::holds_alternative<play::SayStep>(steps[i].what) || i == best_.outcome.failed_step) continue;
    if (course_player_.plan().steps()[i].continues) continue;
    Course shorter = best_.course;
    shorter.left_out.insert(i);
    for (std::size_t j = i + 1; j < steps.size() && course_player_.plan().steps()[j].continues; ++j)
      shorter.left_out.insert(j);
    if (shorter.left_out.contains(best_.outcome.failed_step)) continue;
    if (best_.plays < kMaxPlays && ends_without(shorter) == ends) try_course(std::move(shorter));
  }
}

bool Shrinker::is_minimal() {
  for (std::size_t i = 0; i < best_.course.disturbances.size(); ++i) {
    Course smaller = best_.course;
    smaller.disturbances.erase(smaller.disturbances.begin() + static_cast<std::ptrdiff_t>(i));
    if (fails(smaller)) return false;
  }
  return true;
}

}  // namespace understudy::emulator::hunt
