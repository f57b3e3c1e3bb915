// A course is a case of a scenario file with disturbances. Courses are drawn, and shrunk when they fail.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/reading/hunt_plan.h"

namespace understudy::emulator::hunt {

struct Course {
  std::uint64_t case_number = 0;
  std::vector<play::Disturbance> disturbances{};  // in the order of their steps
  // The shrinker left out these steps of the scenario, and all steps from `end` on.
  std::set<std::size_t> left_out{};
  std::size_t end = SIZE_MAX;

  bool operator==(const Course&) const = default;
};

/// A case without disturbances. Its times limit what can be drawn.
struct Undisturbed {
  std::vector<SimTime> begins;  // when each step begins
  std::vector<SimTime> ends;    // when each step ends
  std::int64_t requests = 0;    // requests to all stations
};

/// The times at which a disturbance of an entry may begin.
struct Window {
  SimTime low{0};
  SimTime high{0};
};
/// Returns true if its moment is a time.
bool has_time(const play::Disturbance& disturbance);
Window window_of(const play::HuntPlan::Entry& entry, const Undisturbed& undisturbed);

/// Random numbers from a seed, equal on every machine.
class Dice {
 public:
  /// `number` is the number of the course.
  Dice(std::uint64_t seed, std::uint64_t number);
  std::uint64_t next();
  /// Returns a number below `count`, which is at least 1.
  std::uint64_t below(std::uint64_t count);
  bool one_in(std::uint64_t count) { return below(count) == 0; }

 private:
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
};

/// The data from which disturbances are drawn.
struct Ground {
  const play::HuntPlan& plan;
  const Undisturbed& undisturbed;
  std::span<const SimTime> moments{};  // when something new happened
};

/// Draws which disturbances a course may have at all, then how many of them, then their values and moments.
std::vector<play::Disturbance> draw_disturbances(const Ground& ground, Dice& dice);
/// Changes a few of the disturbances: adds a new one or one of `others`, removes one, or redraws the moment
/// or a value of one.
std::vector<play::Disturbance> changed(std::vector<play::Disturbance> disturbances,
                                       std::span<const play::Disturbance> others, const Ground& ground,
                                       Dice& dice);
/// Returns true if a course can have this disturbance.
bool is_possible(const play::Disturbance& disturbance, const Ground& ground);
/// Puts disturbances into the order of their steps.
void arrange(std::vector<play::Disturbance>& disturbances);

}  // namespace understudy::emulator::hunt
