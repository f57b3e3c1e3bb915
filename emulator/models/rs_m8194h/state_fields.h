// The fields of an RS-M8194H's state (base/state/fields.h), in the order of the bytes.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/state/state_bytes.h"
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
  static constexpr auto fields =
      FieldList{field("waiting", &Value::waiting), field("stop_wait", &Value::stop_wait)};
  static void check(const Value& fifo) {
    // How many blocks a command takes is a choice, but each takes at least one.
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
  static constexpr auto fields = FieldList{field("command", &Value::command), field("codes", &Value::codes)};
  static void check(const Value& held) {
    for (const std::uint8_t code : held.codes) {
      require_state(code == 0 || emulator::models::rs_m8194h::axis_of_code(code) >= 0,
                    "a path has no such axis");
    }
  }
};

template <>
struct StateOf<emulator::models::rs_m8194h::LineScan> {
  using Value = emulator::models::rs_m8194h::LineScan;
  static constexpr auto fields = FieldList{field("set", &Value::set),
                                           field("type", &Value::type),
                                           field("pitch", &Value::pitch),
                                           field("running", &Value::running),
                                           field("begin", &Value::begin),
                                           field("triggered", &Value::triggered),
                                           field("level_before", &Value::level_before),
                                           field("width_before", &Value::width_before)};
};

template <>
struct StateOf<emulator::models::rs_m8194h::IsrMark> {
  using Value = emulator::models::rs_m8194h::IsrMark;
  static constexpr auto fields = FieldList{field("tick", &Value::tick), field("axis", &Value::axis),
                                           field("source", &Value::source), field("number", &Value::number)};
  static void check(const Value& mark) {
    require_state(mark.axis < emulator::models::rs_m8194h::kAxes && mark.source <= Value::kCalled,
                  "an interrupt has no such source");
  }
};

template <>
struct StateOf<emulator::models::rs_m8194h::State> {
  using Value = emulator::models::rs_m8194h::State;
  static constexpr auto fields = FieldList{field("motors", &Value::motors),
                                           field("here", &Value::environment),
                                           field("units", &Value::units),
                                           field("sync", &Value::sync),
                                           field("paths", &Value::paths),
                                           field("scans", &Value::scans),
                                           field("scanning", &Value::scanning),
                                           field("fifo", &Value::fifo),
                                           field("held_paths", &Value::held_paths),
                                           field("loaded", &Value::loaded),
                                           field("rsm", &Value::rsm),
                                           field("illegal_reason", &Value::illegal_reason),
                                           field("download", &Value::download),
                                           field("downloaded", &Value::downloaded),
                                           field("emergency_state", &Value::emergency_state),
                                           field("emergency_input", &Value::emergency_input),
                                           field("emergency_since", &Value::emergency_since),
                                           field("rint", &Value::rint),
                                           field("interrupts", &Value::interrupts),
                                           field("factor_axes", &Value::factor_axes),
                                           field("marks", &Value::marks),
                                           field("enabled", &Value::enabled),
                                           field("execution", &Value::execution),
                                           field("execution_fault", &Value::execution_fault),
                                           field("paused", &Value::paused),
                                           field("paused_by", &Value::paused_by),
                                           field("queued_triggers", &Value::queued_triggers),
                                           field("trigger_holds", &Value::trigger_holds),
                                           field("outputs", &Value::outputs),
                                           field("sent", &Value::sent),
                                           field("inputs", &Value::inputs),
                                           field("powered_at", &Value::powered_at),
                                           field("at_init", &Value::at_init),
                                           field("unscanned", &Value::unscanned),
                                           field("holds_back", &Value::holds_back),
                                           field("finished", &Value::finished),
                                           field("finished_at", &Value::finished_at),
                                           field("resetting_until", &Value::resetting_until),
                                           field("steps_left", &Value::steps_left),
                                           field("touched", &Value::touched),
                                           field("parameters", &Value::parameters),
                                           field("initial_table", &Value::initial_table),
                                           field("blocks", &Value::blocks),
                                           field("eeprom", &Value::eeprom),
                                           field("image", &Value::image)};
  static void check(const Value& state) {
    constexpr std::size_t kMaxHeld = emulator::models::rs_m8194h::kFifoBlocks + motion::PathRun::kMaxPaths;
    require_state(state.held_paths.size() <= kMaxHeld, "more is held than there is room for");
    for (const auto& held : state.held_paths) {
      require_state(emulator::models::rs_m8194h::is_path(held.command), "what is held is not a path");
    }
    require_state(state.loaded.size() <= motion::PathRun::kMaxPaths, "more is loaded than there is room for");
    for (const auto& segment : state.loaded) {
      require_state(emulator::models::rs_m8194h::is_path(segment.command) &&
                        emulator::models::rs_m8194h::is_segment(segment),
                    "what is loaded is not a segment");
    }
    for (const std::uint8_t channel : state.queued_triggers) {
      require_state(channel < interpreter::rs_m8194h::kTriggerCount, "a trigger has no such channel");
    }
    for (std::size_t i = 0; i < state.enabled.size(); ++i) {
      const auto begin = state.enabled.begin();
      const bool is_new = std::find(begin, begin + static_cast<std::ptrdiff_t>(i), state.enabled[i]) ==
                          begin + static_cast<std::ptrdiff_t>(i);
      const bool exists = state.enabled[i] >> 4 < static_cast<int>(emulator::models::rs_m8194h::kAxes) &&
                          (state.enabled[i] & 0xF) <= emulator::models::rs_m8194h::IsrMark::kSynchronous;
      require_state(is_new && exists, "an interrupt that is enabled has no such source");
    }
    for (const auto& scan : state.scans) require_reach(scan.begin);
    require_reach(state.powered_at);
    require_reach(state.finished_at);
    require_reach(state.emergency_since);
    require_reach(state.resetting_until);
  }
};

}  // namespace understudy
