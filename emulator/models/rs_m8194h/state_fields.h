// The fields of an RS-M8194H's state (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/state/state_bytes.h"
#include "emulator/device/memory/eeprom_fields.h"
#include "emulator/models/rs_m8194h/state.h"
#include "interpreter/rs_m8194h/state_fields.h"

namespace understudy {

template <>
struct StateOf<interpreter::rs_m8194h::State> {
  static constexpr auto last = interpreter::rs_m8194h::State::isr_download;
};

template <>
struct StateOf<emulator::models::rs_m8194h::Fifo> {
  using Value = emulator::models::rs_m8194h::Fifo;
  static constexpr auto fields = FieldList{field<&Value::waiting>(), field<&Value::stop_wait>()};
  static void check(const Value& fifo) {
    // The number of blocks per command is a choice, but it is at least one.
    require_state(fifo.waiting.size() <= static_cast<std::size_t>(emulator::models::rs_m8194h::kFifoBlocks),
                  "the FIFO exceeds its capacity");
    for (const auto& command : fifo.waiting) {
      const bool waits = interpreter::rs_m8194h::find_code(command.code) != nullptr &&
                         !command.is_macro_line() &&
                         (command.row().fifo_blocks() > 0 ||
                          command.row().use.real_time == interpreter::rs_m8194h::RealTime::stop);
      require_state(waits, "a command in the FIFO is not one that waits there");
    }
  }
};

template <>
struct StateOf<emulator::models::rs_m8194h::HeldPath> {
  using Value = emulator::models::rs_m8194h::HeldPath;
  static constexpr auto fields = FieldList{field<&Value::command>(), field<&Value::codes>()};
  static void check(const Value& held) {
    for (const std::uint8_t code : held.codes) {
      require_state(code == 0 || emulator::models::rs_m8194h::axis_of_code(code) >= 0,
                    "a path has an axis that does not exist");
    }
  }
};

template <>
struct StateOf<emulator::models::rs_m8194h::LineScan> {
  using Value = emulator::models::rs_m8194h::LineScan;
  static constexpr auto fields =
      FieldList{field<&Value::set>(),          field<&Value::type>(),        field<&Value::pitch>(),
                field<&Value::running>(),      field<&Value::begin>(),       field<&Value::triggered>(),
                field<&Value::level_before>(), field<&Value::width_before>()};
};

template <>
struct StateOf<emulator::models::rs_m8194h::IsrMark> {
  using Value = emulator::models::rs_m8194h::IsrMark;
  static constexpr auto fields = FieldList{field<&Value::tick>(), field<&Value::axis>(),
                                           field<&Value::source>(), field<&Value::number>()};
  static void check(const Value& mark) {
    require_state(mark.axis < emulator::models::rs_m8194h::kAxes && mark.source <= Value::kCalled,
                  "an interrupt has a source that does not exist");
  }
};

namespace emulator::models::rs_m8194h {

template <class Part, std::size_t count>
consteval std::size_t counted() {
  static_assert(state_fields::has_members<Part, count>(), "a part of the state has different members");
  return count;
}
/// The members of the state are those of its parts, which are counted separately.
inline constexpr std::size_t kStateMembers =
    counted<ChipState, 10>() + counted<StreamState, 2>() + counted<DriveState, 2>() +
    counted<InterruptState, 5>() + counted<QueueState, 2>() + counted<ProgramState, 8>() +
    counted<TriggerState, 1>() + counted<FrnetState, 5>() + counted<StatusState, 4>() +
    counted<RequestState, 2>() + counted<MemoryState, 4>();

}  // namespace emulator::models::rs_m8194h

template <>
struct StateOf<emulator::models::rs_m8194h::State> {
  using Value = emulator::models::rs_m8194h::State;
  static constexpr std::size_t members = emulator::models::rs_m8194h::kStateMembers;
  static constexpr auto fields = FieldList{field<&Value::motors>(),
                                           field<&Value::environment>(),
                                           field<&Value::units>(),
                                           field<&Value::sync>(),
                                           field<&Value::paths>(),
                                           field<&Value::scans>(),
                                           field<&Value::scanning>(),
                                           field<&Value::fifo>(),
                                           field<&Value::held_paths>(),
                                           field<&Value::loaded>(),
                                           field<&Value::rsm>(),
                                           field<&Value::illegal_reason>(),
                                           field<&Value::download>(),
                                           field<&Value::downloaded>(),
                                           field<&Value::emergency_state>(),
                                           field<&Value::emergency_input>(),
                                           field<&Value::emergency_since>(),
                                           field<&Value::rint>(),
                                           field<&Value::interrupts>(),
                                           field<&Value::factor_axes>(),
                                           field<&Value::marks>(),
                                           field<&Value::enabled>(),
                                           field<&Value::execution>(),
                                           field<&Value::execution_fault>(),
                                           field<&Value::paused>(),
                                           field<&Value::paused_by>(),
                                           field<&Value::queued_triggers>(),
                                           field<&Value::trigger_holds>(),
                                           field<&Value::outputs>(),
                                           field<&Value::sent>(),
                                           field<&Value::inputs>(),
                                           field<&Value::powered_at>(),
                                           field<&Value::at_init>(),
                                           field<&Value::unscanned>(),
                                           field<&Value::holds_back>(),
                                           field<&Value::finished>(),
                                           field<&Value::finished_at>(),
                                           field<&Value::resetting_until>(),
                                           field<&Value::steps_left>(),
                                           field<&Value::touched>(),
                                           field<&Value::parameters>(),
                                           field<&Value::initial_table>(),
                                           field<&Value::blocks>(),
                                           field<&Value::eeprom>(),
                                           field<&Value::image>()};
  static void check(const Value& state) {
    constexpr std::size_t kMaxHeld = emulator::models::rs_m8194h::kFifoBlocks + motion::PathRun::kMaxPaths;
    require_state(state.held_paths.size() <= kMaxHeld, "more paths are held than fit");
    for (const auto& held : state.held_paths) {
      require_state(emulator::models::rs_m8194h::is_path(held.command), "a held path is not a path");
    }
    require_state(state.loaded.size() <= motion::PathRun::kMaxPaths, "more segments are loaded than fit");
    for (const auto& segment : state.loaded) {
      require_state(emulator::models::rs_m8194h::is_path(segment.command) &&
                        emulator::models::rs_m8194h::is_segment(segment),
                    "the loaded segment is not a segment");
    }
    for (const std::uint8_t channel : state.queued_triggers) {
      require_state(channel < interpreter::rs_m8194h::kTriggerCount,
                    "a trigger has a channel that does not exist");
    }
    for (std::size_t i = 0; i < state.enabled.size(); ++i) {
      const auto begin = state.enabled.begin();
      const bool is_new = std::find(begin, begin + static_cast<std::ptrdiff_t>(i), state.enabled[i]) ==
                          begin + static_cast<std::ptrdiff_t>(i);
      const bool exists = state.enabled[i] >> 4 < static_cast<int>(emulator::models::rs_m8194h::kAxes) &&
                          (state.enabled[i] & 0xF) <= emulator::models::rs_m8194h::IsrMark::kSynchronous;
      require_state(is_new && exists, "an enabled interrupt has a source that does not exist");
    }
    for (const auto& scan : state.scans) require_reach(scan.begin);
    require_reach(state.powered_at);
    require_reach(state.finished_at);
    require_reach(state.emergency_since);
    require_reach(state.resetting_until);
  }
};

}  // namespace understudy
