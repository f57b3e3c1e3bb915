// The fields of the motion types (base/state/fields.h), in the order of the saved bytes.
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
  static constexpr auto fields =
      FieldList{field<&motion::Segment::begin_s>(), field<&motion::Segment::position_u>(),
                field<&motion::Segment::speed_u_s>(), field<&motion::Segment::acceleration_u_s2>(),
                field<&motion::Segment::jerk_u_s3>()};
  static void check(const motion::Segment& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Profile> {
  static constexpr auto fields =
      FieldList{field<&motion::Profile::segments>(), field<&motion::Profile::segment_count>(),
                field<&motion::Profile::duration_s>(), field<&motion::Profile::end_position_u>(),
                field<&motion::Profile::end_speed_u_s>()};
  static void check(const motion::Profile& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::RampLaw> {
  static constexpr auto fields =
      FieldList{field<&motion::RampLaw::kind>(), field<&motion::RampLaw::acceleration_u_s2>(),
                field<&motion::RampLaw::jerk_u_s3>(), field<&motion::RampLaw::section_u_s>(),
                field<&motion::RampLaw::duration_s>()};
  static void check(const motion::RampLaw& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SpeedLaw> {
  static constexpr auto fields = FieldList{field<&motion::SpeedLaw::start_speed_u_s>(),
                                           field<&motion::SpeedLaw::top_speed_u_s>(),
                                           field<&motion::SpeedLaw::up>(),
                                           field<&motion::SpeedLaw::down>(),
                                           field<&motion::SpeedLaw::when_short>(),
                                           field<&motion::SpeedLaw::slow_down_reckoned_by>(),
                                           field<&motion::SpeedLaw::slow_down_at_u>(),
                                           field<&motion::SpeedLaw::slow_down_offset_u>()};
  static void check(const motion::SpeedLaw& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::TickSegment> {
  static constexpr auto fields =
      FieldList{field<&motion::TickSegment::begin_ticks>(), field<&motion::TickSegment::place>(),
                field<&motion::TickSegment::first>(), field<&motion::TickSegment::second>(),
                field<&motion::TickSegment::third>()};
  static void check(const motion::TickSegment& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Instant> {
  static constexpr auto fields =
      FieldList{field<&motion::Instant::tick>(), field<&motion::Instant::after_s>()};
  static void check(const motion::Instant& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::PulseDrive> {
  static constexpr auto fields = FieldList{field<&motion::PulseDrive::now>(),
                                           field<&motion::PulseDrive::begin_tick>(),
                                           field("next_look", &motion::PulseDrive::next_check),
                                           field<&motion::PulseDrive::sent_pulses>(),
                                           field<&motion::PulseDrive::direction>(),
                                           field<&motion::PulseDrive::drive>(),
                                           field<&motion::PulseDrive::begin_after_s>(),
                                           field<&motion::PulseDrive::tolerance>(),
                                           field<&motion::PulseDrive::profile>()};
  static void check(const motion::PulseDrive& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Counter> {
  static constexpr auto fields =
      FieldList{field<&motion::Counter::range>(), field<&motion::Counter::ring_top>(),
                field<&motion::Counter::offset>()};
  static void check(const motion::Counter& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::UnitScale> {
  static constexpr auto fields =
      FieldList{field<&motion::UnitScale::multiplier>(), field<&motion::UnitScale::divider>(),
                field<&motion::UnitScale::truncates>()};
  static void check(const motion::UnitScale& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Comparator> {
  static constexpr auto fields =
      FieldList{field<&motion::Comparator::relation>(), field<&motion::Comparator::count>(),
                field<&motion::Comparator::reaction>(), field<&motion::Comparator::was_true>(),
                field<&motion::Comparator::counter>(),  field<&motion::Comparator::value>()};
  static void check(const motion::Comparator& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Environment::Zone> {
  static constexpr auto fields =
      FieldList{field<&motion::Environment::Zone::signal>(), field<&motion::Environment::Zone::from>(),
                field<&motion::Environment::Zone::to>(), field<&motion::Environment::Zone::slack>()};
  static void check(const motion::Environment::Zone& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::EncoderLine> {
  static constexpr auto fields =
      FieldList{field<&motion::EncoderLine::counts>(),   field<&motion::EncoderLine::pulses>(),
                field<&motion::EncoderLine::origin>(),   field<&motion::EncoderLine::first>(),
                field<&motion::EncoderLine::last>(),     field<&motion::EncoderLine::mirrored>(),
                field<&motion::EncoderLine::reversed>(), field<&motion::EncoderLine::surplus>(),
                field<&motion::EncoderLine::factor>(),   field<&motion::EncoderLine::zero>(),
                field<&motion::EncoderLine::divider>(),  field<&motion::EncoderLine::turned>()};
  static void check(const motion::EncoderLine& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Environment> {
  static constexpr auto fields =
      FieldList{field<&motion::Environment::version>(),      field<&motion::Environment::steady>(),
                field<&motion::Environment::zone_count>(),   field<&motion::Environment::zones>(),
                field<&motion::Environment::index_period>(), field<&motion::Environment::index_at>(),
                field<&motion::Environment::index_width>(),  field<&motion::Environment::index_from>(),
                field<&motion::Environment::index_to>(),     field<&motion::Environment::encoder>()};
  static void check(const motion::Environment& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Follower> {
  static constexpr auto fields =
      FieldList{field<&motion::Follower::numerator>(),     field<&motion::Follower::denominator>(),
                field<&motion::Follower::period_ticks>(),  field<&motion::Follower::top_speed_pps>(),
                field<&motion::Follower::slope_pps>(),     field<&motion::Follower::catches_up>(),
                field<&motion::Follower::gathered>(),      field<&motion::Follower::left_over>(),
                field<&motion::Follower::behind_pulses>(), field<&motion::Follower::period_pulses>(),
                field<&motion::Follower::phase>(),         field<&motion::Follower::speed_left_over>()};
  static void check(const motion::Follower& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::ExternalDrive> {
  static constexpr auto fields =
      FieldList{field<&motion::ExternalDrive::mode>(), field<&motion::ExternalDrive::pulses>(),
                field<&motion::ExternalDrive::plus_high>(), field<&motion::ExternalDrive::minus_high>(),
                field<&motion::ExternalDrive::running>()};
  static void check(const motion::ExternalDrive& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::HomingPhase> {
  static constexpr auto fields = FieldList{field<&motion::HomingPhase::does>(),
                                           field<&motion::HomingPhase::direction>(),
                                           field<&motion::HomingPhase::speed>(),
                                           field<&motion::HomingPhase::until>(),
                                           field<&motion::HomingPhase::until_on>(),
                                           field<&motion::HomingPhase::then>(),
                                           field<&motion::HomingPhase::marks>(),
                                           field<&motion::HomingPhase::code>(),
                                           field<&motion::HomingPhase::count>(),
                                           field<&motion::HomingPhase::again_while>(),
                                           field<&motion::HomingPhase::distance_pulses>(),
                                           field<&motion::HomingPhase::within_pulses>(),
                                           field<&motion::HomingPhase::ignores>(),
                                           field<&motion::HomingPhase::if_far>(),
                                           field<&motion::HomingPhase::next>(),
                                           field<&motion::HomingPhase::if_already>(),
                                           field<&motion::HomingPhase::if_gone>(),
                                           field<&motion::HomingPhase::if_limit>()};
  static void check(const motion::HomingPhase& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::HomingProgram> {
  static constexpr auto fields = FieldList{
      field<&motion::HomingProgram::phases>(), field<&motion::HomingProgram::phase_count>(),
      field<&motion::HomingProgram::speeds>(), field<&motion::HomingProgram::soft_limits_lead_on>()};
  static void check(const motion::HomingProgram& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Homing> {
  static constexpr auto fields = FieldList{field<&motion::Homing::program>(),
                                           field<&motion::Homing::phase>(),
                                           field<&motion::Homing::ended_in>(),
                                           field<&motion::Homing::ended_by>(),
                                           field<&motion::Homing::met>(),
                                           field<&motion::Homing::counted>(),
                                           field<&motion::Homing::began_pulses>(),
                                           field<&motion::Homing::reference_known>(),
                                           field<&motion::Homing::reference_pulses>()};
  static void check(const motion::Homing& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::AxisSettings> {
  static constexpr auto fields = FieldList{field<&motion::AxisSettings::at_limit_plus>(),
                                           field<&motion::AxisSettings::at_limit_minus>(),
                                           field<&motion::AxisSettings::at_soft_limit>(),
                                           field<&motion::AxisSettings::at_soft_limit_minus>(),
                                           field<&motion::AxisSettings::at_alarm>(),
                                           field<&motion::AxisSettings::at_emergency>(),
                                           field<&motion::AxisSettings::at_mark_on>(),
                                           field<&motion::AxisSettings::at_mark_off>(),
                                           field<&motion::AxisSettings::needs_servo>(),
                                           field<&motion::AxisSettings::waits_for_in_position>(),
                                           field<&motion::AxisSettings::waits_beside_limits>(),
                                           field<&motion::AxisSettings::raises>(),
                                           field<&motion::AxisSettings::soft_limit_plus>(),
                                           field<&motion::AxisSettings::soft_limit_minus>(),
                                           field<&motion::AxisSettings::soft_limits_of>(),
                                           field<&motion::AxisSettings::backlash_pulses>(),
                                           field<&motion::AxisSettings::backlash_speed_pps>(),
                                           field<&motion::AxisSettings::slips>()};
  static void check(const motion::AxisSettings& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Axis> {
  // In the order of the bytes. In memory, the members that a tick needs come first.
  static constexpr auto fields = FieldList{field<&motion::Axis::travel_pulses>(),
                                           field<&motion::Axis::watch_low>(),
                                           field<&motion::Axis::watch_high>(),
                                           field<&motion::Axis::base_pulses>(),
                                           field<&motion::Axis::seen_version>(),
                                           field<&motion::Axis::events>(),
                                           field<&motion::Axis::must_recheck>(),
                                           field<&motion::Axis::inverted>(),
                                           field<&motion::Axis::drive>(),
                                           field<&motion::Axis::settings>(),
                                           field<&motion::Axis::comparators>(),
                                           field<&motion::Axis::encoder_pulses>(),
                                           field<&motion::Axis::encoder_seen>(),
                                           field<&motion::Axis::backlash_sent>(),
                                           field<&motion::Axis::backlash_taken_pulses>(),
                                           field<&motion::Axis::signals>(),
                                           field<&motion::Axis::events_between>(),
                                           field<&motion::Axis::event_at>(),
                                           field<&motion::Axis::constant_pps>(),
                                           field<&motion::Axis::cause>(),
                                           field<&motion::Axis::last_direction>(),
                                           field<&motion::Axis::servo_on>(),
                                           field<&motion::Axis::task>(),
                                           field<&motion::Axis::in_backlash>(),
                                           field<&motion::Axis::slowing>(),
                                           field<&motion::Axis::comes_back>(),
                                           field<&motion::Axis::settling>(),
                                           field<&motion::Axis::encoder_is_known>(),
                                           field<&motion::Axis::target_pulses>(),
                                           field<&motion::Axis::law>(),
                                           field<&motion::Axis::follower>(),
                                           field<&motion::Axis::homing>()};
  static void check(const motion::Axis& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncAction> {
  static constexpr auto fields =
      FieldList{field<&motion::SyncAction::drive>(),         field<&motion::SyncAction::latch_command>(),
                field<&motion::SyncAction::latch_encoder>(), field<&motion::SyncAction::preset>(),
                field<&motion::SyncAction::preset_value>(),  field<&motion::SyncAction::output>(),
                field<&motion::SyncAction::interrupt>()};
  static void check(const motion::SyncAction& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncTable::Trigger> {
  static constexpr auto fields = FieldList{field<&motion::SyncTable::Trigger::factors>(),
                                           field<&motion::SyncTable::Trigger::activates>()};
  static void check(const motion::SyncTable::Trigger& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncTable::Latch> {
  static constexpr auto fields =
      FieldList{field<&motion::SyncTable::Latch::taken>(), field<&motion::SyncTable::Latch::travel_pulses>(),
                field<&motion::SyncTable::Latch::encoder_pulses>()};
  static void check(const motion::SyncTable::Latch& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::SyncTable> {
  static constexpr auto fields =
      FieldList{field<&motion::SyncTable::triggers>(), field<&motion::SyncTable::actions>(),
                field<&motion::SyncTable::latches>(), field<&motion::SyncTable::distance_pulses>(),
                field<&motion::SyncTable::speeds>()};
  static void check(const motion::SyncTable& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Path> {
  static constexpr auto fields = FieldList{field<&motion::Path::kind>(),
                                           field<&motion::Path::measure>(),
                                           field<&motion::Path::begin>(),
                                           field<&motion::Path::end>(),
                                           field<&motion::Path::length_u>(),
                                           field<&motion::Path::centre>(),
                                           field<&motion::Path::abscissa>(),
                                           field<&motion::Path::ordinate>(),
                                           field<&motion::Path::rise>(),
                                           field<&motion::Path::begin_angle_rad>(),
                                           field<&motion::Path::sweep_rad>(),
                                           field<&motion::Path::begin_radius_u>(),
                                           field<&motion::Path::radius_slope_u_rad>()};
  static void check(const motion::Path& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::PathRun::Piece> {
  static constexpr auto fields =
      FieldList{field<&motion::PathRun::Piece::path>(), field<&motion::PathRun::Piece::begin_u>(),
                field<&motion::PathRun::Piece::joined>()};
  static void check(const motion::PathRun::Piece& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::PathRun> {
  static constexpr auto fields =
      FieldList{field<&motion::PathRun::pieces_>(),      field<&motion::PathRun::head_>(),
                field<&motion::PathRun::count_>(),       field<&motion::PathRun::chain_count_>(),
                field<&motion::PathRun::chain_end_u_>(), field<&motion::PathRun::profile_>(),
                field<&motion::PathRun::begin_tick_>(),  field<&motion::PathRun::begin_after_s_>(),
                field<&motion::PathRun::law_>(),         field<&motion::PathRun::override_>(),
                field<&motion::PathRun::late_joint_>(),  field<&motion::PathRun::running_>(),
                field<&motion::PathRun::paused_>(),      field<&motion::PathRun::open_>(),
                field<&motion::PathRun::ran_dry_>(),     field<&motion::PathRun::completed_>(),
                field<&motion::PathRun::last_place_>()};
  static constexpr std::size_t members = 17;
  static void name_all(motion::PathRun& run) {  // does not compile if a member is missing
    [[maybe_unused]] auto& [pieces, head, count, chain_count, chain_end_u, profile, begin_tick, begin_after,
                            law, override, late_joint, running, paused, open, ran_dry, completed,
                            last_place] = run;
  }
  static void check(const motion::PathRun& value) { motion::check_restored(value); }
};

template <>
struct StateOf<motion::Coordinated> {
  static constexpr auto fields =
      FieldList{field<&motion::Coordinated::run>(),        field<&motion::Coordinated::axis_of>(),
                field<&motion::Coordinated::scale>(),      field<&motion::Coordinated::zero_pulses>(),
                field<&motion::Coordinated::engaged>(),    field<&motion::Coordinated::cause>(),
                field<&motion::Coordinated::slowing_for>()};
  static void check(const motion::Coordinated& value) { motion::check_restored(value); }
};

// The functions for values that other folders contain are instantiated once, in state.cpp.
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
