#include "motion/shared_tick.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/coordinated.h"
#include "motion/path_tick.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {

namespace {

constexpr Events kAtEnd = events_of(Moment::end);

/// Actions can cause each other at one moment. After this many rounds, the rest waits for the next tick.
constexpr int kMaxAtOnce = 64;

}  // namespace

void step_together(const TickOfAxes& all, std::uint32_t singles, Coordinated* path, EdgeOwner* owner,
                   bool stays_engaged) {
  if (path != nullptr && !path->engaged) path = nullptr;
  std::array<Axis::QuietTick, SharedTick::kMax> quiet;
  std::uint32_t restless = 0;  // mask of the single axes that are not quiet
  std::size_t count = 0;
  for (std::uint32_t left = singles; left != 0; left &= left - 1) {
    const auto axis = static_cast<std::size_t>(std::countr_zero(left));
    const bool is_watched = (all.watched >> axis & 1U) != 0;
    Axis::QuietTick& quiet_tick = quiet[count++];
    const bool is_quiet =
        !is_watched && all.axes[axis].step_quietly(all.tick, all.environment[axis], quiet_tick);
    if (!is_quiet) [[unlikely]]
      restless |= 1U << axis;
  }
  std::optional<Coordinated::Ahead> ahead;
  if (path != nullptr) ahead = path->look_ahead(all.tick, all.axes, all.environment, stays_engaged);
  for (std::size_t axis = 0; ahead && axis < all.axes.size(); ++axis) {
    if ((all.watched >> axis & 1U) != 0 && path->takes(axis)) ahead->is_quiet = false;
  }
  count = 0;
  if (restless == 0 && (!ahead || ahead->is_quiet)) [[likely]] {
    for (std::uint32_t left = singles; left != 0; left &= left - 1) {
      all.pulses[static_cast<std::size_t>(std::countr_zero(left))] += quiet[count++].pulses;
    }
    if (path == nullptr) return;
    path->fast_forward(*ahead, all.axes, all.pulses);
    return path->settle(all.tick, all.axes);
  }
  SharedTick tick(all, path, owner);
  for (std::uint32_t left = singles; left != 0; left &= left - 1) {
    SharedTick::Member& member = tick.members_[tick.count_++];
    member.axis = static_cast<std::size_t>(std::countr_zero(left));
    member.is_quiet = (restless >> member.axis & 1U) == 0;
    member.quiet = quiet[count++];
  }
  tick.ahead_ = ahead;
  tick.run(stays_engaged);
}

SharedTick::Member* SharedTick::member_of(std::size_t axis) {
  for (Member& member : std::span(members_).first(count_)) {
    if (member.axis == axis) return &member;
  }
  return nullptr;
}

/// Returns a member whose tick was quiet to the beginning of the tick.
void SharedTick::open(Member& member) {
  if (member.part) return;
  Axis& axis = all_.axes[member.axis];
  if (member.is_quiet) axis.undo(member.quiet);
  member.part.emplace(axis, all_.environment[member.axis], all_.tick, member.quiet.followed);
}

void SharedTick::open_path() {
  if (path_ == nullptr || path_tick_) return;
  PathTick::Parts parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::int8_t number = path_->axis_of[i];
    if (number < 0 || static_cast<std::size_t>(number) >= all_.axes.size()) continue;
    Member* const member = member_of(static_cast<std::size_t>(number));
    open(*member);
    parts[i] = &*member->part;
  }
  path_tick_.emplace(*path_, *ahead_, all_.tick, all_.axes, parts, stays_engaged_);
}

void SharedTick::run(bool stays_engaged) {
  stays_engaged_ = stays_engaged;
  now_ = {.tick = all_.tick - 1};
  for (std::size_t i = 0; path_ != nullptr && i < path_->axis_of.size(); ++i) {
    const std::int8_t number = path_->axis_of[i];
    if (number < 0 || static_cast<std::size_t>(number) >= all_.axes.size()) continue;
    Member& member = members_[count_++];
    member.axis = static_cast<std::size_t>(number);
    member.is_on_path = true;
  }
  for (Member& member : std::span(members_).first(count_)) {
    if (!member.is_on_path && !member.is_quiet) open(member);
  }
  if (path_ != nullptr && !ahead_->is_quiet) open_path();
  handle_events();
  while (step_first()) handle_events();
  finish();
}

/// Moves the member with the earliest next moment to that moment. Returns false if no member has a next
/// moment.
bool SharedTick::step_first() {
  Member* first = nullptr;
  for (Member& member : std::span(members_).first(count_)) {
    if (!member.part || member.part->is_over()) continue;
    if (first == nullptr || is_before(member.part->next(), first->part->next())) first = &member;
  }
  const bool path_has = path_tick_ && !path_tick_->is_over();
  const bool is_path_first =
      path_has && (first == nullptr || is_before(path_tick_->next(), first->part->next()));
  if (all_.watched != 0 && owner_ != nullptr) {
    const Instant end{.tick = all_.tick};
    if (step_owner(is_path_first ? path_tick_->next() : first != nullptr ? first->part->next() : end)) {
      return true;
    }
  }
  if (is_path_first) {
    now_ = path_tick_->next();
    path_tick_->step_events();
    return true;
  }
  if (first == nullptr) return false;
  now_ = first->part->next();
  first->part->step_events();
  if (first->is_on_path && path_tick_) path_tick_->rearm();
  return true;
}

void SharedTick::handle_events() {
  for (int round = 0; round < kMaxAtOnce; ++round) {
    bool has_happened = false;
    for (Member& member : std::span(members_).first(count_)) {
      if (!member.part) continue;
      const Events events = member.part->take_events();
      if (events == 0 || owner_ == nullptr) continue;
      has_happened = true;
      act([&] { owner_->at_edge(*this, member.axis, events); });
    }
    if (!has_happened) return;
  }
}

/// Goes to the owner's next moment if that comes before the next edge.
bool SharedTick::step_owner(const Instant& until) {
  const auto found = owner_->next_moment(*this, until);
  if (!found) return false;
  now_ = *found;
  act([&] { owner_->at_moment(*this); });
  return true;
}

template <class Act>
void SharedTick::act(const Act& by_owner) {
  std::array<bool, kMax> had_to_recheck{};
  for (std::size_t i = 0; i < count_; ++i) {
    bool& must_recheck = all_.axes[members_[i].axis].must_recheck;
    had_to_recheck[i] = must_recheck;
    must_recheck = false;
  }
  by_owner();
  for (std::size_t i = 0; i < count_; ++i) {
    bool& must_recheck = all_.axes[members_[i].axis].must_recheck;
    if (members_[i].part) {
      members_[i].part->leave_start_to_next_tick();
      must_recheck ? members_[i].part->rearm() : members_[i].part->forget_next();
    }
    must_recheck = must_recheck || had_to_recheck[i];
  }
  if (path_tick_) path_tick_->rearm();
}

void SharedTick::bring(std::size_t axis) {
  if (is_closed_) return;
  if (path_ != nullptr && path_->takes(axis)) {
    open_path();
    path_tick_->go_to(now_);
    return;
  }
  Member* const member = member_of(axis);
  if (member == nullptr) return;
  open(*member);
  if (!member->part->is_over()) member->part->go_to(now_);
}

AxisPlace SharedTick::place_ahead(std::size_t axis, const Instant& at) {
  Member& member = *member_of(axis);
  if (!member.is_on_path) return member.part->place_at(at);
  AxisPlace place{.travel_pulses = all_.axes[axis].travel_pulses,
                  .backlash_sent = all_.axes[axis].backlash_sent};
  for (std::size_t i = 0; path_tick_ && i < path_->axis_of.size(); ++i) {
    if (path_->axis_of[i] == static_cast<std::int8_t>(axis))
      place.travel_pulses = path_tick_->travel_at(i, at);
  }
  return place;
}

void SharedTick::slow_path(Cause why, const SpeedLaw& by) {
  if (path_ == nullptr) return;
  if (is_closed_) {
    path_->run.set_speed(by, now_.tick);
    return path_->slow_down(now_.tick, why);
  }
  open_path();
  path_tick_->go_to(now_);
  path_tick_->slow_down(why, by);
}

void SharedTick::finish() {
  now_ = {.tick = all_.tick};
  if (path_ != nullptr && !path_tick_) path_->fast_forward(*ahead_, all_.axes, all_.pulses);
  if (path_ != nullptr) path_->settle(all_.tick, all_.axes);
  handle_events();
  is_closed_ = true;
  std::array<Events, kMax> at_end{};
  for (std::size_t i = 0; i < count_; ++i) {
    Member& member = members_[i];
    if (member.part) {
      all_.pulses[member.axis] += member.part->finish();
      at_end[i] = static_cast<Events>(all_.axes[member.axis].events & kAtEnd);
    } else if (!member.is_on_path) {
      all_.pulses[member.axis] += member.quiet.pulses;
    }
  }
  for (std::size_t i = 0; i < count_ && owner_ != nullptr; ++i) {
    if (at_end[i] != 0) owner_->at_edge(*this, members_[i].axis, at_end[i]);
  }
}

}  // namespace understudy::motion
