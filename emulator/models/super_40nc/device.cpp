#include "emulator/models/super_40nc/device.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/contact_rows.h"
#include "emulator/models/super_40nc/files.h"
#include "emulator/models/super_40nc/model.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/program_machine.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/terminals.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"
#include "motion/tick.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The time of each signal; its output is Y of the same number.
struct FinishSignal {
  Kept time;
  int axis = 0;
};
constexpr std::array<FinishSignal, kSignalCount> kSignals{{{kept_x(d9x::kFinishSignalTime), 0},
                                                           {kept_x(d9x::kFinishSignalTime), 1},
                                                           {kept_x(d9x::kFinishSignalTime), 2},
                                                           {kept_x(d9x::kFinishSignalTime), 3},
                                                           {kept_x(d9x::kEndSignalTime), 0},
                                                           {kept_x(d9x::kEndSignalTime), 1},
                                                           {kept_x(d9x::kEndSignalTime), 2},
                                                           {kept_x(d9x::kEndSignalTime), 3},
                                                           {kept_d(d9::kFinishSignalTime), 0},
                                                           {kept_d(d9::kEndSignalTime), 0}}};

}  // namespace

Super40nc::Super40nc(const DeviceSettings& given)
    : DeviceOf(super_40nc::model(), given),
      RegisterBankOf(*this, *Device::model().registers, given.firmware),
      KeptMemory(Device::model().name, given.firmware) {
  options_ = chosen_options();
  map_policy_ = chosen_map_policy();
  lines_wait_ = chose(option("axis_conflicts", "programs_always_wait"));
  readings_ = {.multiplies_by_x12 = chose(option("multiplier", "from_x12")),
               .limits_deceleration = chose(option("long_deceleration", "limited_to_2_x2")),
               .starts_as_fast = chose(option("slow_speeds", "the_start_speed")),
               .truncates = chose(option("rounding", "towards_0"))};
  parameters_wait_ = !chose(option("parameter_moment", "by_kind"));
  state_.eeprom = factory_memory();
  state_.blocks = TextBlocks(block_kinds());
  set_input(kRunSwitch, 1);
}

MapPolicy Super40nc::chosen_map_policy() const {
  MapPolicy policy = map().policy();
  if (chose(option("holes", "read_0_swallow_writes"))) policy.unmapped = MapPolicy::Unmapped::reads_zero;
  if (chose(option("read_only_write", "exception_2"))) policy.read_only = MapPolicy::ReadOnly::refused;
  if (chose(option("half_write", "the_sign_fills_the_other_half"))) {
    policy.halves = MapPolicy::Halves::low_gives_the_sign;
  }
  if (chose(option("range_checks", "exception_3"))) policy.out_of_range = MapPolicy::OutOfRange::refused;
  if (chose(option("frame_effects", "each_in_its_turn"))) policy.effects = MapPolicy::Effects::one_by_one;
  if (chose(option("range_checks", "nearest_one"))) policy.out_of_range = MapPolicy::OutOfRange::clamped;
  return policy;
}

Addressing Super40nc::addressing(std::uint8_t address) const {
  // D9000 is the station number; 0 is also a number, and answers.
  if (address == 0 && chose(option("station_rule", "0_is_never_answered"))) return Addressing::obey_silently;
  const Kept kept = kept_d(d9::kStation);
  const Value number = chose(option("station_change", "at_the_next_power_up"))
                           ? std::clamp<Value>(state_.station, kept.min, kept.max)
                           : registers().of(kept);
  if (address == number) return Addressing::obey_and_reply;
  if (address != 0) return Addressing::ignore;
  const bool answers = chose(option("station_rule", "0_answered_as_well"));
  return answers ? Addressing::obey_and_reply : Addressing::obey_silently;
}

bool Super40nc::knows(std::uint8_t function) const {
  constexpr std::uint8_t kInputRegisters = 0x04;
  constexpr std::uint8_t kSeveralCoils = 0x0F;
  if (function == kInputRegisters) return chose(option("input_registers", "as_function_03"));
  return function != kSeveralCoils || !chose(option("coils_at_once", "exception_1"));
}

/// The usual silence is 3.5 characters.
pty::SimTime Super40nc::end_silence(pty::SimTime usual) const {
  if (chose(option("frame_gap", "10_ms"))) return std::chrono::milliseconds(10);
  return chose(option("frame_gap", "1_5_characters")) ? usual * 3 / 7 : usual;
}

DeviceAnswer Super40nc::admits(const RegisterRequest& request, Checked checked) const {
  constexpr std::size_t kMaxRegisters = 64;
  constexpr std::size_t kMaxBits = 1024;
  const bool is_of_bits = request.table == Table::coil || request.table == Table::discrete;
  const bool is_too_long = request.count > (is_of_bits ? kMaxBits : kMaxRegisters);
  const bool is_limited =
      checked == Checked::everything && chose(option("request_counts", "64_registers_1024_bits"));
  return is_limited && is_too_long ? Refusal::bad_value : Refusal::none;
}

bool Super40nc::answers_refusals() const { return !chose(option("exceptions", "no_answer")); }

void Super40nc::receive_failed(std::size_t port, pty::ReceiveError) {
  ++state_.receive_errors[port];
  state_.touched = true;  // D8097, D8098
}

// ---- the tick

void Super40nc::look_at_inputs() {
  is_restored_ = {};
  for (int i = 0; i < kInputCount; ++i) {
    state_.image[kFirstX.slot + static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(input(i));
  }
  for (int i = 0; i < kAnalogInCount; ++i) {
    state_.analog[static_cast<std::size_t>(i)] = analog_counts(i);
  }
  state_.emergency = input(kEmergencyTerminal) != 0;
  for (int number = 0; number < kAxisCount; ++number) update_environment(number);
  see_pins();
  see_first_signals();
  const bool runs = input(kRunSwitch) != 0;
  if (runs != state_.run_switch) {
    state_.run_switch = runs;
    state_.logo_at = runs && !state_.logo_over ? now() + state_.logo_ms : kNever;
    runs ? plc_to_run() : plc_to_stop();
  }
}

void Super40nc::sample_inputs(Tick tick) {
  if (state_.plc_quiet_scans > 0 && !scans_in(tick)) note_what_plc_sees();
  if (!take_inputs_changed()) return;
  const bool was_emergency = state_.emergency;
  look_at_inputs();
  // A contact that is ON before the first scan is not an edge, even if a listing came before the inputs did.
  if (state_.plc.runs && state_.plc.is_first_scan) {
    ProgramMachine machine(*this);
    language::run(state_.plc, *ladder_, machine, options_);
  }
  if (was_emergency != state_.emergency) state_.touched = true;
}

/// Runs PLC, keys, contacts and step programs in this order: later writers win.
void Super40nc::run_interpreters(Tick tick) {
  if (!scans_in(tick)) return;
  const bool contacts_first = chose(option("scan_order", "contacts_before_the_plc"));
  if (contacts_first) look_at_contacts();
  run_plc();
  if (!contacts_first) look_at_contacts();
  if (programs_are_busy()) {
    ProgramMachine machine(*this);
    language::StepPrograms(state_.steps, codes_, machine, options_).run_slices();
    state_.plc_quiet_scans = 0;  // they may have written what the PLC reads
  }
  leave_table();
}

void Super40nc::run_plc() {
  ProgramMachine machine(*this);
  language::StepPrograms steps(state_.steps, codes_, machine, options_);
  const auto ladder = ladder_;
  if (!ladder->is_empty() && state_.plc.runs) {
    // A scan that changed nothing, and had no new input, is the same again.
    const bool was_told = state_.touched;
    const language::Scanned scanned = language::scan(state_.plc, *ladder, machine, steps, options_);
    state_.plc_quiet_scans = was_told || scanned.has_changed ? 0 : scanned.quiet_scans;
    if (state_.plc_quiet_scans > 0) note_what_plc_sees();
  }
}

void Super40nc::look_at_contacts() {
  if (!state_.touched) return;
  state_.shows_file_changed = state_.file_changed;
  read_keys();
  obey_contacts();
  see_contacts();
  // M8023 is ON for one scan.
  state_.touched = state_.touched || state_.shows_file_changed;
  state_.file_changed = false;
}

bool Super40nc::programs_are_busy() const {
  return std::any_of(language::kAreas.begin(), language::kAreas.end(), [&](const language::AreaRow& row) {
    if (row.area == language::Area::plc) return false;
    const language::Phase phase = state_.steps.programs[language::index_of(row.area)].phase;
    const bool rests =
        phase == language::Phase::idle || phase == language::Phase::paused || phase == language::Phase::held;
    return !rests || contact(row.run_contact);
  });
}

void Super40nc::step_motion(Tick tick) {
  state_.has_ticked = true;
  const auto turned = static_cast<std::int32_t>(static_cast<std::uint32_t>(input(kWheelTerminal)) -
                                                static_cast<std::uint32_t>(state_.wheel_edges));
  state_.wheel_edges = input(kWheelTerminal);
  if (turned != 0) {
    if (!is_on(m8::kMotionInhibit)) feed_wheel(turned);
  }
  std::array<std::int64_t, kAxisCount> travel_before{};
  std::array<std::int64_t, kAxisCount> sent{};
  std::array<std::int8_t, kAxisCount> phases_before{};
  std::array<bool, kAxisCount> was_on_path{};
  for (int number = 0; number < kAxisCount; ++number) {
    travel_before[static_cast<std::size_t>(number)] = chip(number).travel_pulses;
    was_on_path[static_cast<std::size_t>(number)] = is_on_path(number);
    phases_before[static_cast<std::size_t>(number)] = chip(number).homing.phase;
  }
  step_axes(tick, turned, sent);
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    AxisState& state = axis(number);
    motion::Axis& motor = chip(number);
    state.sent_pulses = state.masked ? 0 : sent[n];
    state.followed_pulses = motor.travel_pulses - travel_before[n];
    count_index(number, phases_before[n]);
    count(number, counted_[n].travel, turned - counted_[n].wheel);
    latch_by_comparator(number);
    if (was_on_path[n] || (motor.events & motion::bit(motion::Event::ended)) == 0) continue;
    ended(number);
    state_.touched = true;
  }
  if (!state_.path.engaged && std::find(was_on_path.begin(), was_on_path.end(), true) != was_on_path.end()) {
    path_ended();
  }
}

void Super40nc::show_finished(std::size_t signal) {
  const FinishSignal& finish = kSignals[signal];
  if (now() < state_.signal_until[signal] && chose(option("fsh_restart", "time_goes_on"))) return;
  state_.signal_until[signal] = now() + 1 + registers().of(finish.time, finish.axis);
}

void Super40nc::update_outputs(Tick tick) {
  for (int number = 0; number < kAxisCount; ++number) {
    if (axis(number).clears != 0) clear_counters(number);
    compare_counters(number);
  }
  hold_cleared();
  for (std::size_t i = 0; i < kSignalCount; ++i) {
    const FinishSignal& signal = kSignals[i];
    if (registers().of(signal.time, signal.axis) == 0) continue;
    const bool is_over = tick >= state_.signal_until[i];
    if (tick > state_.signal_until[i] && shares_signals()) continue;
    state_.image[kFirstY.slot + i] = is_over ? 0 : 1;
  }
  if (tick >= state_.logo_at && !state_.logo_over) {
    if (!chose(option("logo_contact", "the_panel_alone"))) set_contact(m85::kLogoOver, true);
    state_.logo_over = true;
    state_.logo_at = kNever;
  }
  wake_plc_by_what_changed();
}

Tick Super40nc::next_timed_tick(Tick done) const {
  Tick next = std::max(done + 1, state_.logo_at);
  for (const Tick until : state_.erc_until) {
    if (until > done) next = std::min(next, until);
  }
  for (std::size_t i = 0; i < kSignalCount; ++i) {
    const bool is_on = state_.image[kFirstY.slot + i] != 0;
    const bool is_system = registers().of(kSignals[i].time, kSignals[i].axis) != 0;
    const bool is_plcs = shares_signals() && state_.signal_until[i] <= done;
    if (is_system && is_on && !is_plcs) next = std::min(next, std::max(done + 1, state_.signal_until[i]));
  }
  return next;
}

bool Super40nc::same_state(const Device& other) const {
  const auto* that = dynamic_cast<const Super40nc*>(&other);
  return that != nullptr && that->now() == now() && that->state_ == state_;
}

// ---- terminals and axes

bool Super40nc::output(int terminal) const {
  if (terminal >= kFirstServoTerminal) {
    if (!powered() || !has_terminal(terminal)) return false;
    if (terminal < kFirstChipPin) return !is_stopped_by_emergency();
    return gives_erc((terminal - kFirstChipPin) / kChipPinsOfAxis);
  }
  const int number = terminal - kFirstOutput;
  return powered() && number >= 0 && number < kOutputCount &&
         state_.image[kFirstY.slot + static_cast<std::size_t>(number)] != 0;
}

std::int32_t Super40nc::analog_level(int terminal) const {
  const int number = terminal - kFirstAnalogOut;
  if (!powered() || number < 0 || number >= kAnalogOutCount) return 0;
  const Value steps = registers().of(number == 0 ? kept_d(d8::kVout1) : kept_d(d8::kVout2));
  return static_cast<std::int32_t>((steps * kMaxMillivolts + kVoltageSteps / 2) / kVoltageSteps);
}

std::int64_t Super40nc::pulses_this_tick(int axis_number) const { return axis(axis_number).sent_pulses; }

double Super40nc::speed_pps(int axis_number) const {
  const AxisState& state = axis(axis_number);
  if (state.masked) return 0;
  const double speed = commanded_pps(axis_number);
  return (chip(axis_number).inverted ? -speed : speed) + 0.0;  // 0 has no sign
}

std::int64_t Super40nc::pulses_to_come(int axis_number) const {
  if (axis(axis_number).masked) return 0;
  return is_on_path(axis_number)
             ? state_.path.pulses_to_come(static_cast<std::size_t>(axis_number), state_.chips)
             : chip(axis_number).pulses_to_come();
}

double Super40nc::commanded_pps(int axis_number) const {
  const motion::Axis& motor = chip(axis_number);
  if (!motor.moving()) return 0;
  if (axis(axis_number).path_backlash != 0 && !state_.path_is_held) {
    const double direction = axis(axis_number).path_backlash < 0 ? -1 : +1;
    return direction * motor.settings.backlash_speed_pps;
  }
  if (is_on_path(axis_number)) return state_.path.speed_pps(static_cast<std::size_t>(axis_number), now());
  if (motor.task == motion::Task::following) {
    return static_cast<double>(axis(axis_number).followed_pulses) * motion::kTicksPerSecond;
  }
  return motor.sample(now()).speed_u_s * static_cast<double>(motor.drive.direction);
}

}  // namespace understudy::emulator::models::super_40nc
