#include "emulator/hunt/course.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/variation.h"
#include "emulator/world/faults/trigger.h"

namespace understudy::emulator::hunt {

namespace {

using play::Disturbance;
using play::HuntPlan;
using When = Disturbance::When;

constexpr std::uint64_t kMaxDisturbances = 16;
constexpr SimTime kNear = std::chrono::milliseconds(5);  // to the beginning or the end of a step
constexpr SimTime kFine = std::chrono::microseconds(100);

/// Draws a time between two: any millisecond, or, as often, a moment near the beginning or the end of a step,
/// where things meet.
SimTime draw_time(const Undisturbed& undisturbed, SimTime low, SimTime high, Dice& dice) {
  if (dice.one_in(2)) {
    const std::size_t step = dice.below(undisturbed.begins.size());
    const SimTime edge = dice.one_in(2) ? undisturbed.begins[step] : undisturbed.ends[step];
    const SimTime near = edge - kNear + kFine * static_cast<std::int64_t>(dice.below(2 * kNear / kFine + 1));
    if (near >= low && near <= high) return near;
  }
  const auto ticks = static_cast<std::uint64_t>((high - low) / kTickLength) + 1;
  return low + kTickLength * static_cast<std::int64_t>(dice.below(ticks));
}

Disturbance draw_one(const HuntPlan& plan, std::size_t number, const Undisturbed& undisturbed, Dice& dice) {
  const HuntPlan::Entry& entry = plan.entries()[number];
  Disturbance drawn{.entry = number, .step = entry.first, .values = {}};
  for (const play::Variation& value : entry.values) {
    // The ends of a range are drawn more often than others.
    const std::uint64_t last = value.places() - 1;
    drawn.values.push_back(dice.one_in(8) ? (dice.one_in(2) ? 0 : last) : dice.below(last + 1));
  }
  drawn.when = entry.ways[dice.below(entry.ways.size())];
  if (entry.within >= SimTime{0}) drawn.when = When::at;
  switch (drawn.when) {
    case When::here: {
      std::vector<std::size_t> steps;
      for (std::size_t i = entry.first; i <= entry.last; ++i) {
        if (plan.has_room_before(i)) steps.push_back(i);
      }
      drawn.step = steps[dice.below(steps.size())];
      break;
    }
    case When::at: {
      const Window window = window_of(entry, undisturbed);
      drawn.moment = draw_time(undisturbed, window.low, window.high, dice).count();
      break;
    }
    case When::nth: {
      constexpr std::int64_t kMore = 2;
      drawn.moment =
          1 + static_cast<std::int64_t>(dice.below(static_cast<std::uint64_t>(undisturbed.requests + kMore)));
      break;
    }
  }
  return drawn;
}

}  // namespace

Window window_of(const HuntPlan::Entry& entry, const Undisturbed& undisturbed) {
  constexpr int kMore = 4;  // disturbances make a course longer, by a quarter as a guess
  const SimTime low = undisturbed.begins[entry.first];
  const SimTime end = undisturbed.ends.back();
  const bool is_open = entry.last + 1 >= undisturbed.begins.size();
  return {low, std::max(low, is_open ? end + end / kMore : undisturbed.begins[entry.last])};
}

Dice::Dice(std::uint64_t seed, std::uint64_t number) : seed_(world::draw(world::draw(seed, 1), number + 1)) {}

std::uint64_t Dice::next() { return world::draw(seed_, ++drawn_); }

std::uint64_t Dice::below(std::uint64_t count) {
  // The upper half of the product is spread evenly.
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(static_cast<Wide>(next()) * count >> 64);
}

void arrange(std::vector<Disturbance>& disturbances) {
  std::stable_sort(disturbances.begin(), disturbances.end(),
                   [](const Disturbance& a, const Disturbance& b) { return a.step < b.step; });
}

std::vector<Disturbance> draw_disturbances(const HuntPlan& plan, const Undisturbed& undisturbed, Dice& dice) {
  std::vector<std::size_t> allowed;
  for (std::size_t i = 0; i < plan.entries().size(); ++i) {
    if (dice.one_in(2)) allowed.push_back(i);
  }
  if (allowed.empty()) allowed.push_back(dice.below(plan.entries().size()));
  std::uint64_t count = 1;
  while (count < kMaxDisturbances && !dice.one_in(3)) ++count;
  std::vector<Disturbance> drawn;
  std::vector<std::vector<std::int64_t>> moments(plan.entries().size());  // by entry
  for (std::uint64_t i = 0; i < count && !allowed.empty(); ++i) {
    const std::size_t place = dice.below(allowed.size());
    const std::size_t number = allowed[place];
    const HuntPlan::Entry& entry = plan.entries()[number];
    Disturbance one = draw_one(plan, number, undisturbed, dice);
    if (entry.within >= SimTime{0} && !moments[number].empty()) {
      const auto steps = static_cast<std::uint64_t>(entry.within / kFine) + 1;
      one.moment = moments[number].front() + kFine.count() * static_cast<std::int64_t>(dice.below(steps));
    }
    moments[number].push_back(one.moment);
    drawn.push_back(std::move(one));
    if (moments[number].size() >= entry.most)
      allowed.erase(allowed.begin() + static_cast<std::ptrdiff_t>(place));
  }
  arrange(drawn);
  return drawn;
}

}  // namespace understudy::emulator::hunt
