// The last value of each enumeration that is part of the motion state (base/state/fields.h).
#pragma once

#include "base/state/fields.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/external_drive.h"
#include "motion/homing.h"
#include "motion/path_run.h"
#include "motion/synchronous.h"

namespace understudy {

template <>
struct StateOf<motion::Drive> {
  static constexpr auto last = motion::Drive::hanging;
};

template <>
struct StateOf<motion::RampLaw::Kind> {
  static constexpr auto last = motion::RampLaw::Kind::sections;
};

template <>
struct StateOf<motion::Short> {
  static constexpr auto last = motion::Short::cut_ramp;
};

template <>
struct StateOf<motion::Counter::Range> {
  static constexpr auto last = motion::Counter::Range::ring;
};

template <>
struct StateOf<motion::Comparator::Relation> {
  static constexpr auto last = motion::Comparator::Relation::equal_downwards;
};

template <>
struct StateOf<motion::Count> {
  static constexpr auto last = motion::Count::encoder;
};

template <>
struct StateOf<motion::Reaction> {
  static constexpr auto last = motion::Reaction::slow_down;
};

template <>
struct StateOf<motion::Signal> {
  static constexpr auto last = motion::Signal::emergency;
};

template <>
struct StateOf<motion::Cause> {
  static constexpr auto last = motion::Cause::homing_failed;
};

template <>
struct StateOf<motion::Task> {
  static constexpr auto last = motion::Task::coordinated;
};

template <>
struct StateOf<motion::ExternalDrive::Mode> {
  static constexpr auto last = motion::ExternalDrive::Mode::continuous;
};

template <>
struct StateOf<motion::HomingPhase::Does> {
  static constexpr auto last = motion::HomingPhase::Does::move_at_zero_speed;
};

template <>
struct StateOf<motion::HomingPhase::Then> {
  static constexpr auto last = motion::HomingPhase::Then::run_on;
};

template <>
struct StateOf<motion::SyncAction::Drive> {
  static constexpr auto last = motion::SyncAction::Drive::stop_at_once;
};

template <>
struct StateOf<motion::SyncAction::Preset> {
  static constexpr auto last = motion::SyncAction::Preset::speed;
};

template <>
struct StateOf<motion::Path::Kind> {
  static constexpr auto last = motion::Path::Kind::arc;
};

template <>
struct StateOf<motion::Measure> {
  static constexpr auto last = motion::Measure::longest_axis;
};

template <>
struct StateOf<motion::PathRun::LateJoint> {
  static constexpr auto last = motion::PathRun::LateJoint::from_rest;
};

}  // namespace understudy
