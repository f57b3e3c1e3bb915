// RS-M8194H: the commands of synchronous actions, interrupts, stops and macros (7.3, 7.5, 8, 9).
#pragma once

#include "emulator/models/rs_m8194h/setting_commands.h"

namespace understudy::emulator::models::rs_m8194h {

/// Sets nDRV, nLATCH, nPRESET, nOUT, nINT and the ISR of each axis in a mask. The parameters begin at
/// `first`.
inline void set_actions(Module& it, AxisMask axes, const Command& command, std::size_t first) {
  for_each_axis(axes, [&](std::size_t a) {
    motion::SyncAction& action = it.chip.sync().actions[a];
    const std::int64_t preset = action.preset_value;
    action = {.drive = static_cast<motion::SyncAction::Drive>(command.values[first]),
              .latch_command = command.values[first + 1] == 1,
              .latch_encoder = command.values[first + 1] == 2,
              .preset = static_cast<motion::SyncAction::Preset>(command.values[first + 2]),
              .preset_value = preset,
              .output = command.values[first + 3] == 1,
              .interrupt = command.values[first + 4] == 1};
    it.chip.unit(a).action_isr = byte_at(command, first + 5 + a);
    it.interrupts.note_enabled(a, IsrMark::kSynchronous, action.interrupt);
    it.chip.rearm(a);
  });
}
inline void set_factors(Module& it, AxisMask triggers, std::uint32_t factors) {
  for_each_axis(triggers, [&](std::size_t a) {
    it.chip.sync().triggers[a].factors = static_cast<motion::Events>(factors & 0xFFU);
    it.interrupts.forget_factor(a, static_cast<std::size_t>(Factor::synchronous));
    it.chip.rearm(a);
  });
}
inline void set_activated(Module& it, AxisMask triggers, AxisMask activated) {
  for_each_axis(triggers, [&](std::size_t a) {
    it.chip.sync().triggers[a].activates = activated;
    it.chip.rearm(a);
  });
}

inline Took sync_action(Module& it, const Command& command) {
  const AxisMask triggers = axes_at(command, 0);
  const AxisMask activated = axes_at(command, 1);
  set_activated(it, triggers, activated);
  set_actions(it, activated, command, 3);
  set_factors(it, triggers, command.values[2]);
  return Took::done;
}
inline Took clear_sync_action(Module& it, const Command& command) {
  const bool keeps_axes = it.chose(option("clear_sync_scope", "factors"));
  const bool keeps_actions = keeps_axes || it.chose(option("clear_sync_scope", "factors_and_axes"));
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    motion::SyncTable::Trigger& trigger = it.chip.sync().triggers[a];
    for_each_axis(keeps_actions ? AxisMask{0} : trigger.activates, [&](std::size_t other) {
      it.chip.sync().actions[other] = {.preset_value = it.chip.sync().actions[other].preset_value};
      it.chip.unit(other).action_isr = 0;
      it.interrupts.note_enabled(other, IsrMark::kSynchronous, false);
    });
    trigger = {.activates = keeps_axes ? trigger.activates : AxisMask{0}};
  });
  it.chip.rearm_all();
  return Took::done;
}
inline Took activation_factors(Module& it, const Command& command) {
  set_factors(it, axes_at(command, 0), command.values[1]);
  return Took::done;
}
inline Took activation_axis(Module& it, const Command& command) {
  set_activated(it, axes_at(command, 0), axes_at(command, 1));
  return Took::done;
}
inline Took set_action(Module& it, const Command& command) {
  set_actions(it, axes_at(command, 0), command, 1);
  return Took::done;
}
/// Sets C+ or C-, which disables the soft limits (7.3.6).
inline Took set_compare(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    AxisUnit& unit = it.chip.unit(a);
    unit.compare[command.values[1] & 1U] = {.value = command.signed_value(3), .source = byte_at(command, 2)};
    unit.basic.soft_limits = false;
    it.chip.rearm(a);
  });
  return Took::done;
}
inline Took set_preset(Module& it, const Command& command) {
  const AxisMask axes =
      it.chose(option("preset_values", "one_for_all")) ? AxisMask{kAllAxes} : axes_at(command, 0);
  for_each_axis(axes,
                [&](std::size_t a) { it.chip.sync().actions[a].preset_value = command.signed_value(1); });
  return Took::done;
}
inline Took set_out(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    OutSettings& out = it.chip.unit(a).out;
    out.level = byte_at(command, 1);
    out.width_code = byte_at(command, 2);
  });
  return Took::done;
}

template <bool on>
Took switch_interrupts(Module& it, const Command&) {
  it.interrupts.state().interrupts = on;
  if (on) it.interrupts.clear(Rint::user);
  return Took::done;
}
inline Took enable_factor(Module& it, const Command& command) {
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    AxisUnit& unit = it.chip.unit(a);
    const std::size_t factor = command.values[1] % kIsrFactors;
    unit.factors |= static_cast<std::uint8_t>(1U << factor);
    unit.isr_of[factor] = byte_at(command, 2);
    it.interrupts.note_enabled(a, static_cast<std::uint8_t>(factor), true);
    it.interrupts.forget_factor(a, factor);
    it.chip.rearm(a);
  });
  return Took::done;
}
inline Took disable_factor(Module& it, const Command& command) {
  constexpr std::uint32_t kAllFactors = 10;
  for_each_axis(axes_at(command, 0), [&](std::size_t a) {
    for (std::size_t factor = 0; factor < kIsrFactors; ++factor) {
      if (command.values[1] != kAllFactors && command.values[1] != factor) continue;
      it.chip.unit(a).factors &= static_cast<std::uint8_t>(~(1U << factor));
      it.chip.unit(a).isr_of[factor] = 0;
      it.interrupts.note_enabled(a, static_cast<std::uint8_t>(factor), false);
      it.interrupts.forget_factor(a, factor);
    }
    it.chip.rearm(a);
  });
  return Took::done;
}

inline Took hold(Module& it, const Command& command) {
  it.stops.hold(axes_at(command, 0));
  return Took::done;
}
inline Took release(Module& it, const Command& command) {
  it.stops.release(axes_at(command, 0));
  return Took::done;
}
inline Took stop_axes(Module& it, const Command& command) {
  it.stops.halt(axes_at(command, 0), stop_row(command.verb()));
  return Took::done;
}
/// Stops the axes of the running interpolation, or, if none is running, the axes of AXIS_ASSIGN.
inline Took stop_path(Module& it, const Command& command) {
  const Paths& paths = it.chip.paths();
  AxisMask axes = paths.together.engaged ? paths.axes : mask_of_codes(paths.assigned);
  if (!paths.together.engaged && it.chose(option("vstop_idle", "nothing"))) axes = 0;
  if (!paths.together.engaged && it.chose(option("vstop_idle", "locks_all_axes"))) axes = kAllAxes;
  it.stops.halt(axes, stop_row(command.verb()));
  return Took::done;
}
inline Took emergency_stop(Module& it, const Command& command) {
  it.stops.halt(kAllAxes, stop_row(command.verb(), command.values[0]));
  it.queue.clear_all();
  if (it.chose(option("emergency_and_macros", "end"))) it.programs.terminate();
  it.drives.state().emergency_state = true;
  return Took::done;
}
inline Took clear_stop(Module& it, const Command& command) {
  it.stops.clear_stop(axes_at(command, 0));
  return Took::done;
}
inline Took clear_path_stop(Module& it, const Command&) {
  it.stops.clear_path_stop();
  return Took::done;
}
inline Took clear_emergency_stop(Module& it, const Command&) {
  it.stops.clear_emergency();
  return Took::done;
}
inline Took stop_wait(Module& it, const Command& command) {
  it.queue.wait_for(axes_at(command, 0));
  return Took::done;
}
inline Took load_initial(Module& it, const Command&) {
  if (it.chip.driving() != 0 && it.chose(option("load_initial_on_the_way", "waits_until_all_stand"))) {
    return Took::waits;
  }
  it.load_initial();
  return Took::done;
}
inline Took begin_mp(Module& it, const Command& command) {
  it.programs.start_mp(static_cast<int>(command.values[0]));
  return Took::done;
}
inline Took call_isr(Module& it, const Command& command) {
  it.interrupts.call(static_cast<int>(command.values[0]));
  return Took::done;
}
inline Took terminate(Module& it, const Command&) {
  it.programs.terminate();
  return Took::done;
}

// clang-format off
inline constexpr CommandRow kEventCommands[] = {
    {Verb::sync_action,            sync_action},
    {Verb::clear_sync_action,      clear_sync_action},
    {Verb::set_activation_factors, activation_factors},
    {Verb::set_activation_axis,    activation_axis},
    {Verb::set_action,             set_action},
    {Verb::set_compare,            set_compare},
    {Verb::set_preset,             set_preset},
    {Verb::set_out,                set_out},
    {Verb::enable_int,             switch_interrupts<true>},
    {Verb::disable_int,            switch_interrupts<false>},
    {Verb::intfactor_enable,       enable_factor},
    {Verb::intfactor_disable,      disable_factor},
    {Verb::drv_hold,               hold},
    {Verb::drv_start,              release},
    {Verb::stop_slowly,            stop_axes},
    {Verb::stop_suddenly,          stop_axes},
    {Verb::vstop_slowly,           stop_path},
    {Verb::vstop_suddenly,         stop_path},
    {Verb::clear_stop,             clear_stop},
    {Verb::clear_vstop,            clear_path_stop},
    {Verb::emergency_stop,         emergency_stop},
    {Verb::clear_emergency_stop,   clear_emergency_stop},
    {Verb::stop_wait,              stop_wait},
    {Verb::load_initial,           load_initial},
    {Verb::mp_call,                begin_mp},
    {Verb::isr_call,               call_isr},
    {Verb::mp_terminate,           terminate},
};
// clang-format on

}  // namespace understudy::emulator::models::rs_m8194h
