// The fields of a world's state for snapshot.cpp (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/world/world.h"
#include "pty/state_fields.h"

namespace understudy {

template <>
struct StateOf<emulator::world::Fault::Kind> {
  static constexpr auto last = emulator::world::Fault::Kind::hang_up;
};

template <>
struct StateOf<emulator::world::Fault::Side> {
  static constexpr auto last = emulator::world::Fault::Side::both;
};

template <>
struct StateOf<emulator::world::World::Input> {
  using Value = emulator::world::World::Input;
  static constexpr auto fields = FieldList{field<&Value::external>(), field<&Value::wired>(),
                                           field<&Value::plant>(), field<&Value::stuck>()};
};

template <>
struct StateOf<emulator::world::World::Supply> {
  using Value = emulator::world::World::Supply;
  static constexpr auto fields = FieldList{field<&Value::is_switched_on>()};
};

template <>
struct StateOf<emulator::world::World::InputTurn> {
  using Value = emulator::world::World::InputTurn;
  static constexpr auto fields =
      FieldList{field<&Value::device>(), field<&Value::terminal>(), field<&Value::counts>(),
                field<&Value::ticks>(), field<&Value::ticks_left>()};
};

template <>
struct StateOf<emulator::world::FaultTrigger> {
  using Value = emulator::world::FaultTrigger;
  static constexpr auto fields =
      FieldList{field<&Value::function>(),     field<&Value::station>(), field<&Value::first_address>(),
                field<&Value::last_address>(), field<&Value::at>(),      field<&Value::from>(),
                field<&Value::to>(),           field<&Value::when>(),    field<&Value::first_nth>(),
                field<&Value::last_nth>(),     field<&Value::every>(),   field<&Value::chance>(),
                field<&Value::seed>(),         field<&Value::times>(),   field<&Value::lasts>()};
};

template <>
struct StateOf<emulator::world::FaultCourse> {
  using Value = emulator::world::FaultCourse;
  static constexpr auto fields =
      FieldList{field<&Value::seen>(),     field<&Value::matched>(),   field<&Value::hits>(),
                field<&Value::until>(),    field<&Value::looked_at>(), field<&Value::was_met>(),
                field<&Value::in_force>(), field<&Value::is_news>(),   field<&Value::judged_character>(),
                field<&Value::was_hit>()};
};

template <>
struct StateOf<emulator::world::Fault> {
  using Value = emulator::world::Fault;
  static constexpr auto fields =
      FieldList{field<&Value::kind>(),     field<&Value::device>(),       field<&Value::place>(),
                field<&Value::amount>(),   field<&Value::period_ticks>(), field<&Value::over_ticks>(),
                field<&Value::of_input>(), field<&Value::on_line>(),      field<&Value::side>(),
                field<&Value::before>(),   field<&Value::after>(),        field<&Value::trigger>()};
};

template <>
struct StateOf<emulator::world::ArmedFault> {
  using Value = emulator::world::ArmedFault;
  static constexpr auto fields = FieldList{field<&Value::fault>(), field<&Value::course>()};
};

template <>
struct StateOf<emulator::world::MachineFaults> {
  using Value = emulator::world::MachineFaults;
  static constexpr auto fields =
      FieldList{field<&Value::stalled>(), field<&Value::loses_one_in>(), field<&Value::slipped_pulses>(),
                field<&Value::alarm>(), field<&Value::encoder_noise_counts>()};
};

template <>
struct StateOf<emulator::world::DriveInputs> {
  using Value = emulator::world::DriveInputs;
  static constexpr auto fields = FieldList{field<&Value::servo>(), field<&Value::alarm_clear>()};
};

template <>
struct StateOf<emulator::world::PlantAxis::State> {
  using Value = emulator::world::PlantAxis::State;
  static constexpr auto fields = FieldList{field<&Value::position_pulses>(),
                                           field<&Value::lost_pulses>(),
                                           field<&Value::pulses_to_lose>(),
                                           field<&Value::loses_one_in>(),
                                           field<&Value::at_home>(),
                                           field<&Value::at_lower_limit>(),
                                           field<&Value::at_upper_limit>(),
                                           field<&Value::at_near_home>(),
                                           field<&Value::at_mark>(),
                                           field<&Value::alarm_latched>(),
                                           field<&Value::ready>(),
                                           field<&Value::wired>(),
                                           field<&Value::seen>(),
                                           field<&Value::enabled_at>(),
                                           field<&Value::faults>(),
                                           field<&Value::wheel_counts>(),
                                           field<&Value::turn_counts>(),
                                           field<&Value::turn_ticks>(),
                                           field<&Value::ticks_to_turn>()};
};

/// The world's own state. Its devices, machines and lines are separate parts.
template <>
struct StateOf<emulator::world::World> {
  using Value = emulator::world::World;
  static constexpr auto fields =
      FieldList{field<&Value::sent_pulses_>(), field<&Value::inputs_>(),     field<&Value::supplies_>(),
                field<&Value::faults_>(),      field<&Value::next_fault_>(), field<&Value::disturbed_>(),
                field<&Value::now_>(),         field<&Value::done_>(),       field<&Value::input_turns_>()};
  static constexpr std::size_t members = 27;
  /// The number of members that are not in `fields`: the setup, observers, and counts of how ticks were run.
  static constexpr std::size_t apart = 18;
  static void name_all(Value& all) {  // does not compile if a member is missing
    [[maybe_unused]] auto& [known, devices, axes, lines, text_lines, plants, driven_axes, contacts,
                            sent_edges, input_turns, sent_pulses, inputs, supplies, wires, watchers,
                            stops_here, listener, faults, next_fault, fault_watch, seed, disturbed, now, done,
                            ticks, bulk_ticks, skip_tries] = all;
  }

  static auto& plants(auto& world) { return world.plants_; }
  static pty::Line& line(Value& world, std::size_t number) { return world.lines_[number]->line; }
  static auto& ticks(auto& world) { return world.ticks_; }
  static void rearm(Value& world) { world.arm_faults(); }
  /// Called after all parts have been restored.
  static void notify(Value& world) {
    for (std::size_t d = 0; d < world.devices_.size(); ++d) world.resend_edges(d);
  }
};

template <>
struct StateOf<emulator::world::World::TickCounts> {
  using Value = emulator::world::World::TickCounts;
  static constexpr auto fields = FieldList{field<&Value::run>(), field("crossed", &Value::skipped)};
};

}  // namespace understudy
