#include "emulator/hunt/course.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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
constexpr SimTime kNear = std::chrono::milliseconds(5);  // this close to the beginning or the end of a step
constexpr SimTime kFine = std::chrono::microseconds(100);

/// Draws a number from -1024 to 1024, small ones more often.
std::int64_t draw_distance(Dice& dice, std::uint64_t powers = 11) {
  const std::int64_t max = std::int64_t{1} << dice.below(powers);
  return static_cast<std::int64_t>(dice.below(static_cast<std::uint64_t>(2 * max) + 1)) - max;
}

/// Draws a time between two times. Half the time it is any millisecond; otherwise it is near the beginning or
/// the end of a step, where things coincide, or near a moment at which something new happened.
SimTime draw_time(const Ground& ground, SimTime low, SimTime high, Dice& dice) {
  if (dice.one_in(2)) {
    const Undisturbed& undisturbed = ground.undisturbed;
    const std::size_t step = dice.below(undisturbed.begins.size());
    const SimTime edge = dice.one_in(2) ? undisturbed.begins[step] : undisturbed.ends[step];
    SimTime near = edge - kNear + kFine * static_cast<std::int64_t>(dice.below(2 * kNear / kFine + 1));
    if (!ground.moments.empty() && dice.one_in(2)) {
      near = ground.moments[dice.below(ground.moments.size())];
      // A separate statement, because both operands draw, and compilers differ in which operand of a sum they
      // evaluate first.
      near += kFine * draw_distance(dice);
    }
    if (near >= low && near <= high) return near;
  }
  const auto ticks = static_cast<std::uint64_t>((high - low) / kTickLength) + 1;
  return low + kTickLength * static_cast<std::int64_t>(dice.below(ticks));
}

/// The ends of a range are drawn more often than other values.
std::uint64_t draw_value(const play::Variation& value, Dice& dice) {
  const std::uint64_t last = value.places() - 1;
  return dice.one_in(8) ? (dice.one_in(2) ? 0 : last) : dice.below(last + 1);
}

void draw_moment(Disturbance& drawn, const Ground& ground, Dice& dice) {
  const HuntPlan::Entry& entry = ground.plan.entries()[drawn.entry];
  drawn.when = entry.ways[dice.below(entry.ways.size())];
  if (entry.within >= SimTime{0}) drawn.when = When::at;
  switch (drawn.when) {
    case When::here: {
      std::vector<std::size_t> steps;
      for (std::size_t i = entry.first; i <= entry.last; ++i) {
        if (ground.plan.has_room_before(i)) steps.push_back(i);
      }
      drawn.step = steps[dice.below(steps.size())];
      break;
    }
    case When::at:
    case When::late: {
      const Window window = window_of(entry, ground.undisturbed);
      drawn.moment = draw_time(ground, window.low, window.high, dice).count();
      break;
    }
    case When::nth: {
      constexpr std::int64_t kMore = 2;
      drawn.moment = 1 + static_cast<std::int64_t>(
                             dice.below(static_cast<std::uint64_t>(ground.undisturbed.requests + kMore)));
      break;
    }
  }
}

Disturbance draw_one(const Ground& ground, std::size_t number, Dice& dice) {
  const HuntPlan::Entry& entry = ground.plan.entries()[number];
  Disturbance drawn{.entry = number, .step = entry.at_step, .values = {}};
  for (const play::Variation& value : entry.values) drawn.values.push_back(draw_value(value, dice));
  draw_moment(drawn, ground, dice);
  return drawn;
}

/// Moves the disturbances of each entry with `within`, so that they all happen within that time of the first
/// one.
void gather(std::vector<Disturbance>& all, const HuntPlan& plan, Dice& dice) {
  for (std::size_t number = 0; number < plan.entries().size(); ++number) {
    const SimTime within = plan.entries()[number].within;
    if (within < SimTime{0}) continue;
    const Disturbance* first = nullptr;
    for (Disturbance& one : all) {
      if (one.entry != number) continue;
      if (first == nullptr) {
        first = &one;
      } else if (one.moment < first->moment || one.moment - first->moment > within.count()) {
        const auto steps = static_cast<std::uint64_t>(within / kFine) + 1;
        one.moment = first->moment + kFine.count() * static_cast<std::int64_t>(dice.below(steps));
      }
    }
  }
}

/// Moves times that were changed too far to the nearest possible ones.
void keep_in_windows(std::vector<Disturbance>& all, const Ground& ground) {
  for (Disturbance& one : all) {
    if (!has_time(one)) continue;
    const Window window = window_of(ground.plan.entries()[one.entry], ground.undisturbed);
    one.moment = std::clamp(one.moment, window.low.count(), window.high.count());
  }
}

std::size_t count_of(const std::vector<Disturbance>& all, std::size_t entry) {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [&](const Disturbance& one) { return one.entry == entry; }));
}

/// Draws the moment again: near the current one, near that of another disturbance, or anywhere.
void change_moment(Disturbance& one, const std::vector<Disturbance>& all, const Ground& ground, Dice& dice) {
  const Disturbance& other = all[dice.below(all.size())];
  if (one.when == When::here || other.when != one.when || dice.one_in(4)) {
    one.step = ground.plan.entries()[one.entry].at_step;
    return draw_moment(one, ground, dice);
  }
  const bool is_number = one.when == When::nth;
  const std::int64_t unit = is_number ? 1 : kFine.count();
  const std::int64_t moved = other.moment + unit * draw_distance(dice, is_number ? 4 : 11);
  one.moment = std::max<std::int64_t>(moved, is_number ? 1 : 0);
}

void change_value(Disturbance& one, const Ground& ground, Dice& dice) {
  const auto& values = ground.plan.entries()[one.entry].values;
  if (values.empty()) return;
  const std::size_t i = dice.below(values.size());
  const std::uint64_t last = values[i].places() - 1;
  if (dice.one_in(2)) {
    one.values[i] = draw_value(values[i], dice);
  } else if (dice.one_in(2)) {
    one.values[i] = std::min(last, one.values[i] + 1 + dice.below(4));
  } else {
    one.values[i] -= std::min(one.values[i], 1 + dice.below(4));
  }
}

/// Returns the time at which a disturbance begins, if that is known.
std::optional<SimTime> begin_of(const Disturbance& one, const Undisturbed& undisturbed) {
  if (has_time(one)) return SimTime(one.moment);
  if (one.when == When::here) return undisturbed.begins[one.step];
  return std::nullopt;
}

/// Continues from the state at a moment at which something new happened: keeps the disturbances before it,
/// and draws others after it.
void go_on_from_moment(std::vector<Disturbance>& all, const Ground& ground, Dice& dice) {
  constexpr std::uint64_t kMaxMore = 3;
  const SimTime moment = ground.moments[dice.below(ground.moments.size())];
  const auto is_later = [&](const Disturbance& one) {
    const auto begin = begin_of(one, ground.undisturbed);
    return begin && *begin > moment;
  };
  std::erase_if(all, is_later);
  const auto& entries = ground.plan.entries();
  const std::uint64_t more = 1 + dice.below(kMaxMore);
  for (std::uint64_t i = 0; i < more; ++i) {
    const Disturbance one = draw_one(ground, dice.below(entries.size()), dice);
    const bool has_room = all.size() < kMaxDisturbances && count_of(all, one.entry) < entries[one.entry].max;
    if (has_room && (one.when == When::nth || is_later(one))) all.push_back(one);
  }
}

}  // namespace

bool has_time(const Disturbance& one) { return one.when == When::at || one.when == When::late; }

Window window_of(const HuntPlan::Entry& entry, const Undisturbed& undisturbed) {
  constexpr int kMore = 4;  // disturbances make a course longer; a quarter is a guess
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
  // Steps that wait for their moments come after those that act at once.
  const auto place = [](const Disturbance& one) {
    return std::pair(one.step, one.when == When::late ? one.moment : -1);
  };
  std::stable_sort(disturbances.begin(), disturbances.end(),
                   [&](const Disturbance& a, const Disturbance& b) { return place(a) < place(b); });
}

std::vector<Disturbance> draw_disturbances(const Ground& ground, Dice& dice) {
  const auto& entries = ground.plan.entries();
  std::vector<std::size_t> allowed;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (dice.one_in(2)) allowed.push_back(i);
  }
  if (allowed.empty()) allowed.push_back(dice.below(entries.size()));
  std::uint64_t count = 1;
  while (count < kMaxDisturbances && !dice.one_in(3)) ++count;
  std::vector<Disturbance> drawn;
  for (std::uint64_t i = 0; i < count && !allowed.empty(); ++i) {
    const std::size_t place = dice.below(allowed.size());
    const std::size_t number = allowed[place];
    drawn.push_back(draw_one(ground, number, dice));
    if (count_of(drawn, number) >= entries[number].max)
      allowed.erase(allowed.begin() + static_cast<std::ptrdiff_t>(place));
  }
  gather(drawn, ground.plan, dice);
  keep_in_windows(drawn, ground);
  arrange(drawn);
  return drawn;
}

std::vector<Disturbance> changed(std::vector<Disturbance> all, std::span<const Disturbance> others,
                                 const Ground& ground, Dice& dice) {
  const auto& entries = ground.plan.entries();
  const bool goes_on = !ground.moments.empty() && dice.one_in(4);
  if (goes_on) go_on_from_moment(all, ground, dice);
  const std::uint64_t changes = goes_on ? 0 : 1 + dice.below(4);
  for (std::uint64_t i = 0; i < changes; ++i) {
    const std::uint64_t how = all.empty() ? 0 : dice.below(6);
    if (how <= 1) {  // one more, newly drawn or from another course
      const bool is_taken = how == 1 && !others.empty();
      Disturbance one =
          is_taken ? others[dice.below(others.size())] : draw_one(ground, dice.below(entries.size()), dice);
      // A disturbance soon after another one often continues its effect.
      if (!is_taken && !all.empty() && dice.one_in(2)) change_moment(one, all, ground, dice);
      const bool has_room =
          all.size() < kMaxDisturbances && count_of(all, one.entry) < entries[one.entry].max;
      if (has_room) all.push_back(one);
    } else if (how == 2 && all.size() > 1) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(dice.below(all.size())));
    } else if (how <= 4) {
      change_moment(all[dice.below(all.size())], all, ground, dice);
    } else {
      change_value(all[dice.below(all.size())], ground, dice);
    }
  }
  gather(all, ground.plan, dice);
  keep_in_windows(all, ground);
  arrange(all);
  return all;
}

bool is_possible(const Disturbance& one, const Ground& ground) {
  const HuntPlan& plan = ground.plan;
  if (one.entry >= plan.entries().size()) return false;
  const HuntPlan::Entry& entry = plan.entries()[one.entry];
  const bool has_way = std::find(entry.ways.begin(), entry.ways.end(), one.when) != entry.ways.end();
  const bool is_in_time =
      one.when == When::here ? one.step >= entry.first && one.step <= entry.last &&
                                   plan.has_room_before(one.step) && one.moment == 0
                             : one.step == entry.at_step && one.moment >= 0 && one.moment <= kHorizon.count();
  if (!has_way || !is_in_time || one.values.size() != entry.values.size()) return false;
  if (one.when == When::nth && one.moment == 0) return false;
  const Window window = window_of(entry, ground.undisturbed);
  const SimTime moment(one.moment);
  if (has_time(one) && (moment < window.low || moment > window.high)) return false;
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    if (one.values[i] >= entry.values[i].places()) return false;
  }
  return true;
}

}  // namespace understudy::emulator::hunt
