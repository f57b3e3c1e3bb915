// Lists the fields of a world's state for snapshot.cpp (base/state/fields.h), in the order of the bytes.
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
  static constexpr auto fields = FieldList{field("external", &Value::external), field("wired", &Value::wired),
                                           field("plant", &Value::plant), field("stuck", &Value::stuck)};
};

template <>
struct StateOf<emulator::world::World::Supply> {
  using Value = emulator::world::World::Supply;
  static constexpr auto fields = FieldList{field("is_switched_on", &Value::is_switched_on)};
};

template <>
struct StateOf<emulator::world::World::InputTurn> {
  using Value = emulator::world::World::InputTurn;
  static constexpr auto fields = FieldList{
      field("device", &Value::device), field("terminal", &Value::terminal), field("counts", &Value::counts),
      field("ticks", &Value::ticks), field("ticks_left", &Value::ticks_left)};
};

template <>
struct StateOf<emulator::world::FaultTrigger> {
  using Value = emulator::world::FaultTrigger;
  static constexpr auto fields = FieldList{field("function", &Value::function),
                                           field("station", &Value::station),
                                           field("first_address", &Value::first_address),
                                           field("last_address", &Value::last_address),
                                           field("at", &Value::at),
                                           field("from", &Value::from),
                                           field("to", &Value::to),
                                           field("when", &Value::when),
                                           field("first_nth", &Value::first_nth),
                                           field("last_nth", &Value::last_nth),
                                           field("every", &Value::every),
                                           field("chance", &Value::chance),
                                           field("seed", &Value::seed),
                                           field("times", &Value::times),
                                           field("lasts", &Value::lasts)};
};

template <>
struct StateOf<emulator::world::FaultCourse> {
  using Value = emulator::world::FaultCourse;
  static constexpr auto fields = FieldList{field("seen", &Value::seen),
                                           field("matched", &Value::matched),
                                           field("hits", &Value::hits),
                                           field("until", &Value::until),
                                           field("looked_at", &Value::looked_at),
                                           field("was_met", &Value::was_met),
                                           field("in_force", &Value::in_force),
                                           field("is_news", &Value::is_news),
                                           field("judged_character", &Value::judged_character),
                                           field("was_hit", &Value::was_hit)};
};

template <>
struct StateOf<emulator::world::Fault> {
  using Value = emulator::world::Fault;
  static constexpr auto fields = FieldList{field("kind", &Value::kind),
                                           field("device", &Value::device),
                                           field("place", &Value::place),
                                           field("amount", &Value::amount),
                                           field("period_ticks", &Value::period_ticks),
                                           field("over_ticks", &Value::over_ticks),
                                           field("of_input", &Value::of_input),
                                           field("on_line", &Value::on_line),
                                           field("side", &Value::side),
                                           field("before", &Value::before),
                                           field("after", &Value::after),
                                           field("trigger", &Value::trigger)};
};

template <>
struct StateOf<emulator::world::ArmedFault> {
  using Value = emulator::world::ArmedFault;
  static constexpr auto fields = FieldList{field("fault", &Value::fault), field("course", &Value::course)};
};

template <>
struct StateOf<emulator::world::MachineFaults> {
  using Value = emulator::world::MachineFaults;
  static constexpr auto fields =
      FieldList{field("stalled", &Value::stalled), field("loses_one_in", &Value::loses_one_in),
                field("slipped_pulses", &Value::slipped_pulses), field("alarm", &Value::alarm),
                field("encoder_noise_counts", &Value::encoder_noise_counts)};
};

template <>
struct StateOf<emulator::world::DriveInputs> {
  using Value = emulator::world::DriveInputs;
  static constexpr auto fields =
      FieldList{field("servo", &Value::servo), field("alarm_clear", &Value::alarm_clear)};
};

template <>
struct StateOf<emulator::world::PlantAxis::State> {
  using Value = emulator::world::PlantAxis::State;
  static constexpr auto fields = FieldList{field("position_pulses", &Value::position_pulses),
                                           field("lost_pulses", &Value::lost_pulses),
                                           field("pulses_to_lose", &Value::pulses_to_lose),
                                           field("loses_one_in", &Value::loses_one_in),
                                           field("at_home", &Value::at_home),
                                           field("at_lower_limit", &Value::at_lower_limit),
                                           field("at_upper_limit", &Value::at_upper_limit),
                                           field("at_near_home", &Value::at_near_home),
                                           field("at_mark", &Value::at_mark),
                                           field("alarm_latched", &Value::alarm_latched),
                                           field("ready", &Value::ready),
                                           field("wired", &Value::wired),
                                           field("seen", &Value::seen),
                                           field("enabled_at", &Value::enabled_at),
                                           field("faults", &Value::faults),
                                           field("wheel_counts", &Value::wheel_counts),
                                           field("turn_counts", &Value::turn_counts),
                                           field("turn_ticks", &Value::turn_ticks),
                                           field("ticks_to_turn", &Value::ticks_to_turn)};
};

/// The world's own state. Its devices, machines and lines are separate parts.
template <>
struct StateOf<emulator::world::World> {
  using Value = emulator::world::World;
  static constexpr auto fields = FieldList{field("sent_pulses", &Value::sent_pulses_),
                                           field("inputs", &Value::inputs_),
                                           field("supplies", &Value::supplies_),
                                           field("faults", &Value::faults_),
                                           field("next_fault", &Value::next_fault_),
                                           field("disturbed", &Value::disturbed_),
                                           field("now", &Value::now_),
                                           field("done", &Value::done_),
                                           field("input_turns", &Value::input_turns_)};
  static constexpr std::size_t members = 27;
  /// Members for setup, for observers, and for how ticks were run.
  static constexpr std::size_t apart = 18;
  static void name_all(Value& all) {  // does not compile if a member is missing
    [[maybe_unused]] auto& [known, devices, axes, lines, text_lines, plants, driven_axes, contacts,
                            told_edges, input_turns, sent_pulses, inputs, supplies, wires, watchers,
                            stops_here, listener, faults, next_fault, fault_watch, seed, disturbed, now, done,
                            ticks, bulk_ticks, skip_tries] = all;
  }

  static auto& plants(auto& world) { return world.plants_; }
  static pty::Line& line(Value& world, std::size_t number) { return world.lines_[number]->line; }
  static auto& ticks(auto& world) { return world.ticks_; }
  static void rearm(Value& world) { world.arm_faults(); }
  /// Called when all parts are restored.
  static void tell(Value& world) {
    for (std::size_t d = 0; d < world.devices_.size(); ++d) world.tell_edges_anew(d);
  }
};

template <>
struct StateOf<emulator::world::World::TickCounts> {
  using Value = emulator::world::World::TickCounts;
  static constexpr auto fields = FieldList{field("run", &Value::run), field("crossed", &Value::crossed)};
};

}  // namespace understudy
