// What each value of motion consists of, for state.cpp: all fields, in order. A field that is added and not
// listed here is a compile error, because a structured binding names every field.
#pragma once

#include <concepts>
#include <type_traits>

#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/external_drive.h"
#include "motion/following.h"
#include "motion/homing.h"
#include "motion/path_run.h"
#include "motion/synchronous.h"

namespace understudy::motion {

template <class T, class Wanted>
concept Like = std::same_as<std::remove_const_t<T>, Wanted>;  // the type, const or not

/// `of(value, visit)` calls visit(field...) once, with all fields in order.
struct StateFields {
  // clang-format off
  static void of(Like<Segment> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<Profile> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<RampLaw> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<SpeedLaw> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h] = v; visit(a, b, c, d, e, f, g, h);
  }
  static void of(Like<TickSegment> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<Instant> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<PulseDrive> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i] = v; visit(a, b, c, d, e, f, g, h, i);
  }
  static void of(Like<Counter> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<UnitScale> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<Comparator> auto& v, auto visit) {
    auto& [a, b, c, d, e, f] = v; visit(a, b, c, d, e, f);
  }
  static void of(Like<Surroundings::Zone> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<Surroundings> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g] = v; visit(a, b, c, d, e, f, g);
  }
  static void of(Like<Follower> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = v; visit(a, b, c, d, e, f, g, h, i, j, k, l);
  }
  static void of(Like<ExternalDrive> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<HomingPhase> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = v;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  }
  static void of(Like<HomingProgram> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<Homing> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h] = v; visit(a, b, c, d, e, f, g, h);
  }
  static void of(Like<AxisSettings> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = v; visit(a, b, c, d, e, f, g, h, i, j, k);
  }
  static void of(Like<Axis> auto& v, auto visit) {
    // As they lie in memory; in the bytes settings follow the drive.
    auto& [a, b, c, d, e, f, g, h, signals, events_between, task, cause, last_direction, servo_on,
           i, j, k, l, m, n, o, event_at, in_backlash, x, y, z, aa, ab, ac, ad, ae] = v;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, signals, events_between, event_at, cause, last_direction,
          servo_on, task, in_backlash, x, y, z, aa, ab, ac, ad, ae);
  }
  static void of(Like<SyncAction> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g] = v; visit(a, b, c, d, e, f, g);
  }
  static void of(Like<SyncTable::Trigger> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<SyncTable::Latch> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<SyncTable> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<Path> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = v; visit(a, b, c, d, e, f, g, h, i, j, k, l, m);
  }
  static void of(Like<PathRun::Piece> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<PathRun> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = v; visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  }
  static void of(Like<Coordinated> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g] = v; visit(a, b, c, d, e, f, g);
  }
  // clang-format on
};

/// The values that an enumeration of the state may have: up to and with this one.
template <class E>
inline constexpr E kLastOf = [] { static_assert(sizeof(E) == 0, "say its last value below"); }();
template <>
inline constexpr Drive kLastOf<Drive> = Drive::hanging;
template <>
inline constexpr RampLaw::Kind kLastOf<RampLaw::Kind> = RampLaw::Kind::sections;
template <>
inline constexpr Short kLastOf<Short> = Short::cut_ramp;
template <>
inline constexpr Counter::Range kLastOf<Counter::Range> = Counter::Range::ring;
template <>
inline constexpr Comparator::Relation kLastOf<Comparator::Relation> = Comparator::Relation::equal;
template <>
inline constexpr Count kLastOf<Count> = Count::encoder;
template <>
inline constexpr Reaction kLastOf<Reaction> = Reaction::slow_down;
template <>
inline constexpr Signal kLastOf<Signal> = Signal::emergency;
template <>
inline constexpr Cause kLastOf<Cause> = Cause::homing_failed;
template <>
inline constexpr Task kLastOf<Task> = Task::coordinated;
template <>
inline constexpr ExternalDrive::Mode kLastOf<ExternalDrive::Mode> = ExternalDrive::Mode::continuous;
template <>
inline constexpr HomingPhase::Does kLastOf<HomingPhase::Does> = HomingPhase::Does::hang;
template <>
inline constexpr HomingPhase::Then kLastOf<HomingPhase::Then> = HomingPhase::Then::run_on;
template <>
inline constexpr SyncAction::Drive kLastOf<SyncAction::Drive> = SyncAction::Drive::stop_at_once;
template <>
inline constexpr SyncAction::Preset kLastOf<SyncAction::Preset> = SyncAction::Preset::speed;
template <>
inline constexpr Path::Kind kLastOf<Path::Kind> = Path::Kind::arc;
template <>
inline constexpr Measure kLastOf<Measure> = Measure::longest_axis;
template <>
inline constexpr PathRun::LateJoint kLastOf<PathRun::LateJoint> = PathRun::LateJoint::from_rest;

}  // namespace understudy::motion
