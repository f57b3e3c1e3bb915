#include "motion/path_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "motion/bad_motion.h"
#include "motion/bisection.h"
#include "motion/elementary.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/profile.h"
#include "motion/ramp.h"
#include "motion/tick.h"

namespace understudy::motion {

namespace {

double seconds(Tick ticks) { return static_cast<double>(ticks) / kTicksPerSecond; }
constexpr double kTick_s = 1 / kTicksPerSecond;

bool is_smooth(const Path& first, const Path& next, Joint joint) {
  switch (joint.rule) {
    case Joint::Rule::stop: return false;
    case Joint::Rule::join: return true;
    case Joint::Rule::join_below: return corner_deg(first, next) <= joint.corner_deg + kCornerTolerance_deg;
  }
  return false;
}

/// Returns true if the places are equal, except for rounding errors.
bool meets(const Point& end, const Point& begin) {
  const double size = 1 + end.cwiseAbs().maxCoeff();
  return (end - begin).cwiseAbs().maxCoeff() <= 1e-6 * size;
}

/// A law that makes planning impossible must be refused when it is set, not in the tick in which a chain
/// begins.
void require_plans(SpeedLaw law, double override_factor) {
  if (override_factor > 0) law.top_speed_u_s *= override_factor;
  bool may_creep = law.slow_down_at_u || law.slow_down_offset_u > 0;
  for (const double part : {1.0, 0.5, 0.1, 1e-3}) {
    const double speed = part * law.top_speed_u_s;
    may_creep = may_creep ||
                (law.slow_down_reckoned_by &&
                 ramp_distance(*law.slow_down_reckoned_by, speed, 0) > ramp_distance(law.down, speed, 0));
  }
  if (may_creep && law.start_speed_u_s <= 0) {
    throw BadMotion(Refusal::not_positive, "path run",
                    "start speed must be above 0 if slowing down may begin early; it is 0");
  }
  const Profile endless = plan_endless(law);
  constexpr double kLongest_u = 1e20;
  const double with_ramps_u =
      1 + 4 * endless.segments[static_cast<std::size_t>(endless.segment_count - 1)].position_u;
  for (const double length_u : {1.0, with_ramps_u, kLongest_u}) plan(length_u, law);
}

}  // namespace

/// Returns the path whose end determines the joint with the next path. Paths of no length have no direction,
/// so they cannot hide a corner.
const Path& PathRun::path_before(std::size_t number) {
  std::size_t before = number - 1;
  while (before > 0 && piece(before).path.length_u == 0 && piece(before).joined) --before;
  return piece(before).path;
}

void PathRun::append(const Path& path, Joint joint, Tick now) {
  if (full()) throw BadMotion(Refusal::no_room, "path run", "at most 32 paths can be queued");
  if (count_ > 0 && !meets(piece(count_ - 1).path.end, path.begin)) {
    throw BadMotion(Refusal::out_of_range, "path run", "a path must begin where the one before it ends");
  }
  const bool joined = count_ > 0 && is_smooth(path_before(count_), path, joint);
  const bool lengthens = joined && running_ && chain_count_ == count_ && chain_count_ > 0 &&
                         !(late_joint_ == LateJoint::from_rest && slowing_for_the_end(now));
  Piece& added = piece(count_);
  added = {.path = path, .begin_u = chain_end_u_, .joined = joined};
  ++count_;
  if (lengthens) {
    ++chain_count_;
    chain_end_u_ += path.length_u;
    replan(now);
  } else if (running_ && chain_count_ == 0) {
    lay_out_chain(now + 1);
  } else if (chain_count_ + 1 == count_) {
    added.joined = false;                // by then, the previous chain will have ended
    if (open_ && running_) replan(now);  // the run must now stop at its end
  }
}

void PathRun::set_open(bool open, Tick now) {
  if (open == open_) return;
  open_ = open;
  replan(now);
}

SpeedLaw PathRun::effective() const {
  SpeedLaw law = law_;
  law.top_speed_u_s *= override_;
  return law;
}

void PathRun::set_speed(const SpeedLaw& speed, Tick now) {
  check(speed);
  const bool same_ramps = speed.up == law_.up && speed.down == law_.down;
  if (!same_ramps && !at_rest(now)) {
    throw BadMotion(Refusal::out_of_range, "path run", "acceleration can be changed only at rest");
  }
  if (speed == law_) return;
  require_plans(speed, override_);
  law_ = speed;
  replan(now);
}

void PathRun::set_top_speed(double speed_u_s, Tick now) {
  SpeedLaw speed = law_;
  speed.top_speed_u_s = speed_u_s;
  set_speed(speed, now);
}

void PathRun::set_override(double factor, Tick now) {
  require_not_negative(factor, "path run", "override");
  if (factor > 10) throw BadMotion(Refusal::out_of_range, "path run", "override must be 0 to 10");
  if (factor == override_) return;
  if (law_.top_speed_u_s > 0) require_plans(law_, factor);
  override_ = factor;
  replan(now);
}

void PathRun::start(Tick now) {
  check(law_);
  if (running_) return;
  if (count_ > 0) lay_out_chain(now + 1);
  running_ = true;
}

void PathRun::stand_at(const Point& place) {
  for (Eigen::Index i = 0; i < kPathAxes; ++i) require_finite(place[i], "path run", "its place");
  if (count_ > 0 && !meets(place, piece(0).path.begin)) {
    throw BadMotion(Refusal::out_of_range, "path run", "the first path must begin where the axes are");
  }
  last_place_ = place;
}

void PathRun::pause(Tick now) {
  if (paused_) return;
  paused_ = true;
  replan(now);
}

void PathRun::resume(Tick now) {
  if (!paused_) return;
  paused_ = false;
  replan(now);
}

std::size_t PathRun::shorten(Tick now) {
  if (chain_count_ == 0) return count_ = 0;
  const double stop_u = slow_to_stop(sample(now), effective()).end_position_u;
  const double still_u = stop_u - 1e-9 * (1 + stop_u);
  std::size_t kept = 1;
  while (kept < chain_count_ && piece(kept).begin_u <= std::max(still_u, 0.0)) ++kept;
  if (kept < chain_count_) chain_end_u_ = piece(kept).begin_u;
  count_ = chain_count_ = kept;
  open_ = false;
  replan(now);
  return kept;
}

void PathRun::abandon() {
  head_ = count_ = chain_count_ = 0;
  chain_end_u_ = 0;
  profile_ = Profile{};
  running_ = paused_ = open_ = false;
}

double PathRun::elapsed_s(Tick now) const { return seconds(now - begin_tick_) - begin_after_s_; }

Sample PathRun::sample(Tick now) const {
  if (chain_count_ == 0) return {.position_u = chain_end_u_};
  // The run has not begun yet, so it does not have the start speed yet.
  if (elapsed_s(now) < 0) return {.position_u = profile_.sample(0).position_u};
  Sample here = profile_.sample(elapsed_s(now));
  // A path cannot reverse, but the last digits of an S-curve's end may be below 0.
  here.speed_u_s = std::max(0.0, here.speed_u_s);
  return here;
}

Point PathRun::velocity(Tick now) const {
  if (chain_count_ == 0) return Point::Zero();
  const Sample here = sample(now);
  const Piece* piece = &pieces_[head_];
  for (std::size_t next = 1; next < chain_count_; ++next) {
    const Piece& behind = pieces_[(head_ + next) % kMaxPaths];
    if (here.position_u < behind.begin_u) break;
    piece = &behind;
  }
  const Path& path = piece->path;
  const Point direction = path.direction_at(here.position_u - piece->begin_u);
  if (path.measure == Measure::vector) return here.speed_u_s * direction;
  // The speed is that of the axis that moves most; the rise of an arc does not count.
  double max = 0;
  for (Eigen::Index i = 0; i < kPathAxes; ++i) {
    const bool counts = path.kind == Path::Kind::line || path.abscissa[i] != 0 || path.ordinate[i] != 0;
    if (counts) max = std::max(max, std::abs(direction[i]));
  }
  return max > 0 ? Point(here.speed_u_s / max * direction) : Point(Point::Zero());
}

bool PathRun::at_rest(Tick now) const { return sample(now).speed_u_s == 0; }

bool PathRun::slowing_for_the_end(Tick now) const {
  if (chain_count_ == 0 || held()) return false;
  const Sample here = sample(now);
  const Profile stop = slow_to_stop(here, effective());
  return stop.end_position_u >= chain_end_u_ - 1e-9 * (1 + chain_end_u_);
}

/// Creates a chain from the joined paths at the front of the queue, and begins it.
void PathRun::lay_out_chain(Tick begin_at) {
  chain_count_ = 0;
  chain_end_u_ = 0;
  while (chain_count_ < count_) {
    Piece& next = piece(chain_count_);
    if (chain_count_ > 0 && !next.joined) break;
    next.begin_u = chain_end_u_;
    chain_end_u_ += next.path.length_u;
    ++chain_count_;
  }
  begin_tick_ = begin_at;
  begin_after_s_ = 0;
  ran_dry_ = false;
  if (held() || chain_end_u_ == 0) {
    profile_ = Profile{};
  } else if (keeps_speed_at_end()) {
    profile_ = cut_at_end(plan_endless(effective()));
  } else {
    profile_ = plan(chain_end_u_, effective());
  }
}

/// Cuts off the profile of a run that keeps its speed to the end.
Profile PathRun::cut_at_end(Profile profile) const {
  profile.cut_at(chain_end_u_);
  profile.end_exactly_at(chain_end_u_);
  return profile;
}

/// Plans the profile again from the place at `now`.
void PathRun::replan(Tick now) {
  if (chain_count_ == 0) return;
  Tick from = std::max(now, begin_tick_);
  const Sample here = sample(from);
  if (here.position_u >= chain_end_u_) return;
  // A motion from rest begins in the next tick, as everywhere. A motion that is already at its beginning does
  // not wait again; otherwise commands in every tick would keep it from ever starting.
  const bool stands = elapsed_s(from) >= profile_.duration_s;
  if (here.speed_u_s == 0 && stands) from = std::max(from, now + 1);
  if (held()) {
    profile_ = slow_to_stop(here, law_);
    profile_.cut_at(chain_end_u_);
  } else if (keeps_speed_at_end()) {
    const SpeedLaw law = effective();
    profile_ = cut_at_end(change_speed(here, law.top_speed_u_s, law));
  } else {
    const SpeedLaw law = effective();
    const Profile stop = slow_to_stop(here, law);
    // A path cannot reverse: if the run can no longer stop in time, it ends at the end of the chain.
    if (stop.end_position_u > chain_end_u_) {
      profile_ = stop;
      profile_.cut_at(chain_end_u_);
    } else {
      profile_ = change_target(here, chain_end_u_, law);
    }
  }
  begin_tick_ = from;
  begin_after_s_ = 0;
}

bool PathRun::pause_within(Tick tick, double along_u, const SpeedLaw& by, Stretch& gone) {
  if (paused_ || gone.course || chain_count_ == 0 || elapsed_s(tick - 1) < 0) return false;
  const Instant at = moment_at(gone, tick, along_u);
  Sample here = profile_.sample(elapsed_s(tick - 1) + at.after_s + (at.tick == tick ? kTick_s : 0));
  here.speed_u_s = std::max(0.0, here.speed_u_s);
  // The run may have entered further paths in this tick; it must return to the path of `along_u`.
  while (along_u < piece(0).begin_u && completed_ > 0) {
    head_ = (head_ + kMaxPaths - 1) % kMaxPaths;
    ++count_;
    ++chain_count_;
    --completed_;
  }
  paused_ = true;
  profile_ = slow_to_stop(here, by);
  profile_.cut_at(chain_end_u_);
  begin_tick_ = at.tick;
  begin_after_s_ = at.after_s;
  gone = {.to_u = sample(tick).position_u};
  go_to(gone.to_u);
  gone.last_piece = head_;
  return true;
}

std::size_t PathRun::queued_after(Tick tick) const {
  if (chain_count_ == 0) return count_;
  const double along_u = sample(tick).position_u;
  if (along_u >= chain_end_u_) return count_ - chain_count_;
  std::size_t passed = 0;
  while (passed + 1 < chain_count_ && along_u >= pieces_[(head_ + passed + 1) % kMaxPaths].begin_u) ++passed;
  return count_ - passed;
}

void PathRun::drop_front() {
  last_place_ = piece(0).path.end;
  head_ = (head_ + 1) % kMaxPaths;
  --count_;
  --chain_count_;
  ++completed_;
}

void PathRun::go_to(double along_u) {
  while (chain_count_ > 1 && along_u >= piece(1).begin_u) drop_front();
  const Piece& here = piece(0);
  last_place_ = here.path.at(along_u - here.begin_u);
}

void PathRun::check_queue() const {
  bool fits = head_ < kMaxPaths && count_ <= kMaxPaths && chain_count_ <= count_;
  fits = fits && chain_end_u_ >= 0 && std::isfinite(chain_end_u_) && override_ >= 0 && override_ <= 10;
  constexpr Tick kFarthest = Tick{1} << 56;
  fits = fits && begin_tick_ >= -kFarthest && begin_tick_ <= kFarthest && !profile_.endless();
  fits = fits && begin_after_s_ >= 0 && begin_after_s_ <= kTick_s;
  for (const Piece& each : pieces_) fits = fits && std::isfinite(each.begin_u);
  if (!fits) {
    throw BadMotion(Refusal::out_of_range, "path run", "the queue's numbers contradict each other");
  }
  if (running_) require_plans(law_, override_);
}

double PathRun::along_at(const Stretch& gone, Instant at) const {
  const Profile& profile = gone.course ? gone.course->profile : profile_;
  const Tick begin = gone.course ? gone.course->begin_tick : begin_tick_;
  const double after_s = gone.course ? gone.course->begin_after_s : begin_after_s_;
  return profile.sample(seconds(at.tick - begin) + (at.after_s - after_s)).position_u;
}

Instant PathRun::moment_at(const Stretch& gone, Tick tick, double along_u) const {
  const auto is_present = [&](double after_s) {
    return along_at(gone, {.tick = tick - 1, .after_s = after_s}) >= along_u;
  };
  if (is_present(0)) return {.tick = tick - 1};
  if (!is_present(kTick_s)) return {.tick = tick};
  const double after_s = turnover(0, kTick_s, is_present).after;
  if (after_s >= kTick_s) return {.tick = tick};
  return {.tick = tick - 1, .after_s = after_s};
}

const PathRun::Piece& PathRun::piece_on(const Stretch& gone, double along_u) const {
  // Completed paths stay in the ring until other paths are appended.
  std::size_t number = gone.last_piece;
  for (std::size_t i = 0; i < kMaxPaths && pieces_[number].begin_u > along_u; ++i) {
    number = (number + kMaxPaths - 1) % kMaxPaths;
  }
  return pieces_[number];
}

Point PathRun::place_on(const Stretch& gone, double along_u) const {
  const Piece& on = piece_on(gone, along_u);
  return on.path.at(along_u - on.begin_u);
}

double PathRun::direction_at(const Stretch& gone, double along_u, Eigen::Index i) const {
  const Piece& on = piece_on(gone, along_u);
  return on.path.direction_at(along_u - on.begin_u)[i];
}

double PathRun::end_of_span(const Stretch& gone, double along_u) const {
  const Piece& on = piece_on(gone, along_u);
  double end_u = on.begin_u + on.path.length_u;
  constexpr double kEighth_rad = kPi / 4;
  const double eighths = std::abs(on.path.sweep_rad) / kEighth_rad;
  if (on.path.kind == Path::Kind::arc && eighths > 1) {
    const double each_u = on.path.length_u / eighths;
    end_u = std::min(end_u, on.begin_u + (std::floor((along_u - on.begin_u) / each_u) + 1) * each_u);
  }
  const double beyond_u = std::nextafter(along_u, std::numeric_limits<double>::infinity());
  return std::min(std::max(end_u, beyond_u), std::max(gone.to_u, along_u));
}

const Point& PathRun::step(Tick tick, Stretch* gone) {
  completed_ = 0;
  if (chain_count_ == 0) return last_place_;
  const double since_s = elapsed_s(tick);
  const bool over = since_s * kTicksPerSecond >= profile_.duration_s * kTicksPerSecond - kTickTolerance;
  const double along_u = over ? profile_.end_position_u : profile_.sample(since_s).position_u;
  if (!over || along_u < chain_end_u_) {
    go_to(along_u);
    if (gone != nullptr) {
      gone->to_u = along_u;
      gone->last_piece = head_;
    }
    return last_place_;
  }
  if (gone != nullptr) {
    *gone = {.to_u = chain_end_u_,
             .last_piece = (head_ + chain_count_ - 1) % kMaxPaths,
             .course = Course{profile_, begin_tick_, begin_after_s_}};
  }
  ran_dry_ = keeps_speed_at_end();
  while (chain_count_ > 0) drop_front();
  if (count_ > 0) {
    lay_out_chain(tick);
    // Paths of no length end as soon as they begin.
    while (chain_count_ > 0 && chain_end_u_ == 0) {
      while (chain_count_ > 0) drop_front();
      if (count_ > 0) lay_out_chain(tick);
    }
  }
  return last_place_;
}

}  // namespace understudy::motion
