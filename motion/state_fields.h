// What each value of motion consists of (base/state/fields.h), in the order of the bytes.
#pragma once

#include <string>

#include "base/state/difference.h"
#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/external_drive.h"
#include "motion/following.h"
#include "motion/homing.h"
#include "motion/path_run.h"
#include "motion/state_checks.h"
#include "motion/state_enumerations.h"
#include "motion/synchronous.h"

namespace understudy {

template <>
struct StateOf<motion::Point> {
  static void write(const motion::Point& point, StateWriter& writer) {
    for (Eigen::Index i = 0; i < motion::kPathAxes; ++i) writer.write(point[i]);
  }
  static void read(motion::Point& point, StateReader& reader) {
    for (Eigen::Index i = 0; i < motion::kPathAxes; ++i) reader.read(point[i]);
  }
};

template <>
struct StateOf<motion::Segment> {
  static constexpr auto fields = FieldList{field("begin_s", &motion::Segment::begin_s),
                                           field("position_u", &motion::Segment::position_u),
                                           field("speed_u_s", &motion::Segment::speed_u_s),
                                           field("acceleration_u_s2", &motion::Segment::acceleration_u_s2),
                                           field("jerk_u_s3", &motion::Segment::jerk_u_s3)};
  static void check(const motion::Segment& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Profile> {
  static constexpr auto fields = FieldList{field("segments", &motion::Profile::segments),
                                           field("segment_count", &motion::Profile::segment_count),
                                           field("duration_s", &motion::Profile::duration_s),
                                           field("end_position_u", &motion::Profile::end_position_u),
                                           field("end_speed_u_s", &motion::Profile::end_speed_u_s)};
  static void check(const motion::Profile& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::RampLaw> {
  static constexpr auto fields = FieldList{
      field("kind", &motion::RampLaw::kind), field("acceleration_u_s2", &motion::RampLaw::acceleration_u_s2),
      field("jerk_u_s3", &motion::RampLaw::jerk_u_s3), field("section_u_s", &motion::RampLaw::section_u_s),
      field("duration_s", &motion::RampLaw::duration_s)};
  static void check(const motion::RampLaw& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SpeedLaw> {
  static constexpr auto fields =
      FieldList{field("start_speed_u_s", &motion::SpeedLaw::start_speed_u_s),
                field("top_speed_u_s", &motion::SpeedLaw::top_speed_u_s),
                field("up", &motion::SpeedLaw::up),
                field("down", &motion::SpeedLaw::down),
                field("when_short", &motion::SpeedLaw::when_short),
                field("slow_down_reckoned_by", &motion::SpeedLaw::slow_down_reckoned_by),
                field("slow_down_at_u", &motion::SpeedLaw::slow_down_at_u),
                field("slow_down_offset_u", &motion::SpeedLaw::slow_down_offset_u)};
  static void check(const motion::SpeedLaw& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::TickSegment> {
  static constexpr auto fields =
      FieldList{field("begin_ticks", &motion::TickSegment::begin_ticks),
                field("place", &motion::TickSegment::place), field("first", &motion::TickSegment::first),
                field("second", &motion::TickSegment::second), field("third", &motion::TickSegment::third)};
  static void check(const motion::TickSegment& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Instant> {
  static constexpr auto fields =
      FieldList{field("tick", &motion::Instant::tick), field("after_s", &motion::Instant::after_s)};
  static void check(const motion::Instant& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::PulseDrive> {
  static constexpr auto fields = FieldList{field("now", &motion::PulseDrive::now),
                                           field("begin_tick", &motion::PulseDrive::begin_tick),
                                           field("next_look", &motion::PulseDrive::next_look),
                                           field("sent_pulses", &motion::PulseDrive::sent_pulses),
                                           field("direction", &motion::PulseDrive::direction),
                                           field("drive", &motion::PulseDrive::drive),
                                           field("begin_after_s", &motion::PulseDrive::begin_after_s),
                                           field("tolerance", &motion::PulseDrive::tolerance),
                                           field("profile", &motion::PulseDrive::profile)};
  static void check(const motion::PulseDrive& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Counter> {
  static constexpr auto fields =
      FieldList{field("range", &motion::Counter::range), field("ring_top", &motion::Counter::ring_top),
                field("offset", &motion::Counter::offset)};
  static void check(const motion::Counter& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::UnitScale> {
  static constexpr auto fields = FieldList{field("multiplier", &motion::UnitScale::multiplier),
                                           field("divider", &motion::UnitScale::divider),
                                           field("truncates", &motion::UnitScale::truncates)};
  static void check(const motion::UnitScale& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Comparator> {
  static constexpr auto fields = FieldList{
      field("relation", &motion::Comparator::relation), field("count", &motion::Comparator::count),
      field("reaction", &motion::Comparator::reaction), field("was_true", &motion::Comparator::was_true),
      field("counter", &motion::Comparator::counter),   field("value", &motion::Comparator::value)};
  static void check(const motion::Comparator& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Environment::Zone> {
  static constexpr auto fields = FieldList{
      field("signal", &motion::Environment::Zone::signal), field("from", &motion::Environment::Zone::from),
      field("to", &motion::Environment::Zone::to), field("slack", &motion::Environment::Zone::slack)};
  static void check(const motion::Environment::Zone& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::EncoderLine> {
  static constexpr auto fields = FieldList{
      field("counts", &motion::EncoderLine::counts),     field("pulses", &motion::EncoderLine::pulses),
      field("origin", &motion::EncoderLine::origin),     field("first", &motion::EncoderLine::first),
      field("last", &motion::EncoderLine::last),         field("mirrored", &motion::EncoderLine::mirrored),
      field("reversed", &motion::EncoderLine::reversed), field("surplus", &motion::EncoderLine::surplus),
      field("factor", &motion::EncoderLine::factor),     field("zero", &motion::EncoderLine::zero),
      field("divider", &motion::EncoderLine::divider),   field("turned", &motion::EncoderLine::turned)};
  static void check(const motion::EncoderLine& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Environment> {
  static constexpr auto fields = FieldList{field("version", &motion::Environment::version),
                                           field("steady", &motion::Environment::steady),
                                           field("zone_count", &motion::Environment::zone_count),
                                           field("zones", &motion::Environment::zones),
                                           field("index_period", &motion::Environment::index_period),
                                           field("index_at", &motion::Environment::index_at),
                                           field("index_width", &motion::Environment::index_width),
                                           field("index_from", &motion::Environment::index_from),
                                           field("index_to", &motion::Environment::index_to),
                                           field("encoder", &motion::Environment::encoder)};
  static void check(const motion::Environment& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Follower> {
  static constexpr auto fields = FieldList{field("numerator", &motion::Follower::numerator),
                                           field("denominator", &motion::Follower::denominator),
                                           field("period_ticks", &motion::Follower::period_ticks),
                                           field("top_speed_pps", &motion::Follower::top_speed_pps),
                                           field("slope_pps", &motion::Follower::slope_pps),
                                           field("catches_up", &motion::Follower::catches_up),
                                           field("gathered", &motion::Follower::gathered),
                                           field("left_over", &motion::Follower::left_over),
                                           field("behind_pulses", &motion::Follower::behind_pulses),
                                           field("period_pulses", &motion::Follower::period_pulses),
                                           field("phase", &motion::Follower::phase),
                                           field("speed_left_over", &motion::Follower::speed_left_over)};
  static void check(const motion::Follower& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::ExternalDrive> {
  static constexpr auto fields =
      FieldList{field("mode", &motion::ExternalDrive::mode), field("pulses", &motion::ExternalDrive::pulses),
                field("plus_high", &motion::ExternalDrive::plus_high),
                field("minus_high", &motion::ExternalDrive::minus_high),
                field("running", &motion::ExternalDrive::running)};
  static void check(const motion::ExternalDrive& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::HomingPhase> {
  static constexpr auto fields = FieldList{field("does", &motion::HomingPhase::does),
                                           field("way", &motion::HomingPhase::direction),
                                           field("speed", &motion::HomingPhase::speed),
                                           field("until", &motion::HomingPhase::until),
                                           field("until_on", &motion::HomingPhase::until_on),
                                           field("then", &motion::HomingPhase::then),
                                           field("marks", &motion::HomingPhase::marks),
                                           field("code", &motion::HomingPhase::code),
                                           field("count", &motion::HomingPhase::count),
                                           field("again_while", &motion::HomingPhase::again_while),
                                           field("distance_pulses", &motion::HomingPhase::distance_pulses),
                                           field("within_pulses", &motion::HomingPhase::within_pulses),
                                           field("ignores", &motion::HomingPhase::ignores),
                                           field("if_far", &motion::HomingPhase::if_far),
                                           field("next", &motion::HomingPhase::next),
                                           field("if_already", &motion::HomingPhase::if_already),
                                           field("if_gone", &motion::HomingPhase::if_gone),
                                           field("if_limit", &motion::HomingPhase::if_limit)};
  static void check(const motion::HomingPhase& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::HomingProgram> {
  static constexpr auto fields =
      FieldList{field("phases", &motion::HomingProgram::phases),
                field("phase_count", &motion::HomingProgram::phase_count),
                field("speeds", &motion::HomingProgram::speeds),
                field("soft_limits_lead_on", &motion::HomingProgram::soft_limits_lead_on)};
  static void check(const motion::HomingProgram& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Homing> {
  static constexpr auto fields = FieldList{field("program", &motion::Homing::program),
                                           field("phase", &motion::Homing::phase),
                                           field("ended_in", &motion::Homing::ended_in),
                                           field("ended_by", &motion::Homing::ended_by),
                                           field("met", &motion::Homing::met),
                                           field("counted", &motion::Homing::counted),
                                           field("began_pulses", &motion::Homing::began_pulses),
                                           field("reference_known", &motion::Homing::reference_known),
                                           field("reference_pulses", &motion::Homing::reference_pulses)};
  static void check(const motion::Homing& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::AxisSettings> {
  static constexpr auto fields =
      FieldList{field("at_limit_plus", &motion::AxisSettings::at_limit_plus),
                field("at_limit_minus", &motion::AxisSettings::at_limit_minus),
                field("at_soft_limit", &motion::AxisSettings::at_soft_limit),
                field("at_soft_limit_minus", &motion::AxisSettings::at_soft_limit_minus),
                field("at_alarm", &motion::AxisSettings::at_alarm),
                field("at_emergency", &motion::AxisSettings::at_emergency),
                field("at_mark_on", &motion::AxisSettings::at_mark_on),
                field("at_mark_off", &motion::AxisSettings::at_mark_off),
                field("needs_servo", &motion::AxisSettings::needs_servo),
                field("waits_for_in_position", &motion::AxisSettings::waits_for_in_position),
                field("waits_beside_limits", &motion::AxisSettings::waits_beside_limits),
                field("raises", &motion::AxisSettings::raises),
                field("soft_limit_plus", &motion::AxisSettings::soft_limit_plus),
                field("soft_limit_minus", &motion::AxisSettings::soft_limit_minus),
                field("soft_limits_of", &motion::AxisSettings::soft_limits_of),
                field("backlash_pulses", &motion::AxisSettings::backlash_pulses),
                field("backlash_speed_pps", &motion::AxisSettings::backlash_speed_pps),
                field("slips", &motion::AxisSettings::slips)};
  static void check(const motion::AxisSettings& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Axis> {
  // In the order of the bytes; in memory the members that a tick needs come first.
  static constexpr auto fields = FieldList{field("travel_pulses", &motion::Axis::travel_pulses),
                                           field("watch_low", &motion::Axis::watch_low),
                                           field("watch_high", &motion::Axis::watch_high),
                                           field("base_pulses", &motion::Axis::base_pulses),
                                           field("seen_version", &motion::Axis::seen_version),
                                           field("events", &motion::Axis::events),
                                           field("attentive", &motion::Axis::must_recheck),
                                           field("inverted", &motion::Axis::inverted),
                                           field("drive", &motion::Axis::drive),
                                           field("settings", &motion::Axis::settings),
                                           field("comparators", &motion::Axis::comparators),
                                           field("encoder_pulses", &motion::Axis::encoder_pulses),
                                           field("encoder_seen", &motion::Axis::encoder_seen),
                                           field("backlash_sent", &motion::Axis::backlash_sent),
                                           field("play_pulses", &motion::Axis::backlash_taken_pulses),
                                           field("signals", &motion::Axis::signals),
                                           field("events_between", &motion::Axis::events_between),
                                           field("event_at", &motion::Axis::event_at),
                                           field("constant_pps", &motion::Axis::constant_pps),
                                           field("cause", &motion::Axis::cause),
                                           field("last_direction", &motion::Axis::last_direction),
                                           field("servo_on", &motion::Axis::servo_on),
                                           field("task", &motion::Axis::task),
                                           field("in_backlash", &motion::Axis::in_backlash),
                                           field("slowing", &motion::Axis::slowing),
                                           field("comes_back", &motion::Axis::comes_back),
                                           field("settling", &motion::Axis::settling),
                                           field("encoder_is_known", &motion::Axis::encoder_is_known),
                                           field("target_pulses", &motion::Axis::target_pulses),
                                           field("law", &motion::Axis::law),
                                           field("follower", &motion::Axis::follower),
                                           field("homing", &motion::Axis::homing)};
  static void check(const motion::Axis& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncAction> {
  static constexpr auto fields = FieldList{field("drive", &motion::SyncAction::drive),
                                           field("latch_command", &motion::SyncAction::latch_command),
                                           field("latch_encoder", &motion::SyncAction::latch_encoder),
                                           field("preset", &motion::SyncAction::preset),
                                           field("preset_value", &motion::SyncAction::preset_value),
                                           field("output", &motion::SyncAction::output),
                                           field("interrupt", &motion::SyncAction::interrupt)};
  static void check(const motion::SyncAction& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncTable::Trigger> {
  static constexpr auto fields = FieldList{field("factors", &motion::SyncTable::Trigger::factors),
                                           field("activates", &motion::SyncTable::Trigger::activates)};
  static void check(const motion::SyncTable::Trigger& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncTable::Latch> {
  static constexpr auto fields =
      FieldList{field("taken", &motion::SyncTable::Latch::taken),
                field("travel_pulses", &motion::SyncTable::Latch::travel_pulses),
                field("encoder_pulses", &motion::SyncTable::Latch::encoder_pulses)};
  static void check(const motion::SyncTable::Latch& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncTable> {
  static constexpr auto fields =
      FieldList{field("triggers", &motion::SyncTable::triggers),
                field("actions", &motion::SyncTable::actions), field("latches", &motion::SyncTable::latches),
                field("distance_pulses", &motion::SyncTable::distance_pulses),
                field("speeds", &motion::SyncTable::speeds)};
  static void check(const motion::SyncTable& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Path> {
  static constexpr auto fields = FieldList{field("kind", &motion::Path::kind),
                                           field("measure", &motion::Path::measure),
                                           field("begin", &motion::Path::begin),
                                           field("end", &motion::Path::end),
                                           field("length_u", &motion::Path::length_u),
                                           field("centre", &motion::Path::centre),
                                           field("abscissa", &motion::Path::abscissa),
                                           field("ordinate", &motion::Path::ordinate),
                                           field("rise", &motion::Path::rise),
                                           field("begin_angle_rad", &motion::Path::begin_angle_rad),
                                           field("sweep_rad", &motion::Path::sweep_rad),
                                           field("begin_radius_u", &motion::Path::begin_radius_u),
                                           field("radius_slope_u_rad", &motion::Path::radius_slope_u_rad)};
  static void check(const motion::Path& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::PathRun::Piece> {
  static constexpr auto fields = FieldList{field("path", &motion::PathRun::Piece::path),
                                           field("begin_u", &motion::PathRun::Piece::begin_u),
                                           field("joined", &motion::PathRun::Piece::joined)};
  static void check(const motion::PathRun::Piece& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::PathRun> {
  static constexpr auto fields = FieldList{field("pieces", &motion::PathRun::pieces_),
                                           field("head", &motion::PathRun::head_),
                                           field("count", &motion::PathRun::count_),
                                           field("chain_count", &motion::PathRun::chain_count_),
                                           field("chain_end_u", &motion::PathRun::chain_end_u_),
                                           field("profile", &motion::PathRun::profile_),
                                           field("begin_tick", &motion::PathRun::begin_tick_),
                                           field("begin_after_s", &motion::PathRun::begin_after_s_),
                                           field("law", &motion::PathRun::law_),
                                           field("override", &motion::PathRun::override_),
                                           field("late_joint", &motion::PathRun::late_joint_),
                                           field("running", &motion::PathRun::running_),
                                           field("paused", &motion::PathRun::paused_),
                                           field("open", &motion::PathRun::open_),
                                           field("ran_dry", &motion::PathRun::ran_dry_),
                                           field("completed", &motion::PathRun::completed_),
                                           field("last_place", &motion::PathRun::last_place_)};
  static constexpr std::size_t members = 17;
  static void name_all(motion::PathRun& run) {  // does not compile if there are others
    [[maybe_unused]] auto& [pieces, head, count, chain_count, chain_end_u, profile, begin_tick, begin_after,
                            law, override, late_joint, running, paused, open, ran_dry, completed,
                            last_place] = run;
  }
  static void check(const motion::PathRun& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Coordinated> {
  static constexpr auto fields = FieldList{field("run", &motion::Coordinated::run),
                                           field("axis_of", &motion::Coordinated::axis_of),
                                           field("scale", &motion::Coordinated::scale),
                                           field("zero_pulses", &motion::Coordinated::zero_pulses),
                                           field("engaged", &motion::Coordinated::engaged),
                                           field("cause", &motion::Coordinated::cause),
                                           field("slowing_for", &motion::Coordinated::slowing_for)};
  static void check(const motion::Coordinated& value) { motion::check_restored(value); }
};

// The functions for values that other folders hold are instantiated once, in state.cpp.
#define UNDERSTUDY_STATE_ELSEWHERE(Type)                        \
  extern template void StateWriter::write(const motion::Type&); \
  extern template void StateReader::read(motion::Type&);        \
  extern template std::string first_difference(const motion::Type&, const motion::Type&, const std::string&)

UNDERSTUDY_STATE_ELSEWHERE(Axis);
UNDERSTUDY_STATE_ELSEWHERE(Coordinated);
UNDERSTUDY_STATE_ELSEWHERE(Environment);
UNDERSTUDY_STATE_ELSEWHERE(UnitScale);

#undef UNDERSTUDY_STATE_ELSEWHERE

}  // namespace understudy
