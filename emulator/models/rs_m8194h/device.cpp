#include "emulator/models/rs_m8194h/device.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "base/state/difference.h"
#include "base/state/state_bytes.h"
#include "emulator/device/device_of.h"
#include "emulator/device/machine_edges.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/terminals.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/memory.h"
#include "emulator/models/rs_m8194h/model.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/state_fields.h"  // IWYU pragma: keep, write() goes through the fields
#include "emulator/models/rs_m8194h/terminals.h"
#include "interpreter/rs_m8194h/run.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// 3.3.
constexpr std::string_view kPulseFormats[] = {"CW/CCW rising",      "CW/CCW falling",
                                              "PULSE rising/DIR -", "PULSE falling/DIR -",
                                              "PULSE rising/DIR +", "PULSE falling/DIR +"};

std::uint16_t word_of(std::span<const std::uint16_t> words, int number) {
  return words[static_cast<std::size_t>(number)];
}

MapPolicy policy_by_choice(const Device& device) {
  MapPolicy policy = rs_m8194h::model().registers->policy();
  if (device.chose(option("half_items", "exception_3"))) policy.cut_pair = Refusal::bad_value;
  return policy;
}

}  // namespace

RsM8194h::RsM8194h(const DeviceSettings& given)
    : DeviceOf(rs_m8194h::model(), given),
      RegisterBankOf(*this, *rs_m8194h::model().registers, given.firmware),
      KeptMemory(rs_m8194h::model().name, given.firmware),
      options_(rs_m8194h::language_options(given)),
      machine_(rs_m8194h::machine_options(given)),
      policy_(policy_by_choice(*this)) {
  state_.blocks = TextBlocks(block_kinds());
  state_.eeprom = factory_memory();
  blank();
}

Addressing RsM8194h::addressing(std::uint8_t address) const {
  if (is_deaf()) return Addressing::ignore;
  if (address == 0) {
    return chose(option("broadcast", "ignored")) ? Addressing::ignore : Addressing::obey_silently;
  }
  return address == station_number() ? Addressing::obey_and_reply : Addressing::ignore;
}

pty::SimTime RsM8194h::end_silence(pty::SimTime usual) const {
  constexpr std::chrono::milliseconds kOfTheUser(10);
  return chose(option("silent_time", "10ms")) ? pty::SimTime(kOfTheUser) : usual;
}

pty::SimTime RsM8194h::reply_delay() const {
  constexpr std::chrono::milliseconds kLater(5);
  return chose(option("response_delay", "5ms_later")) ? pty::SimTime(kLater) : pty::SimTime{0};
}

pty::LineSettings RsM8194h::line_settings(std::size_t port) const {
  pty::LineSettings settings = Device::line_settings(port);
  if (keeps_its_speed()) settings.baud = model().line.ports[port].bauds.front();
  return settings;
}

// --- the phases of a tick --------------------------------------------------------------------------------

void RsM8194h::sample_inputs(Tick tick) {
  const bool changed = take_inputs_changed();
  if (changed) state_.unscanned = frnet_inputs() != state_.inputs;
  if (changed || state_.holds_back) {
    pass_pins(tick);
    for (std::size_t a = 0; a < kAxes; ++a) {
      update_environment(a);
      watch_external(a, tick);
    }
  }
  if (scans_frnet_at(tick)) {
    const auto before = state_.inputs;
    scan_frnet();
    if (state_.inputs != before) check_triggers(before, false);
  }
}

void RsM8194h::step_motion(Tick tick) {
  const bool was_full = state_.paths.together.engaged && state_.paths.together.run.queued() > 1;
  step_axes(tick);
  on_path_speed(tick);
  on_path_end(was_full);
  for (std::size_t a = 0; a < kAxes; ++a) {
    // Its input stops what it has begun, and nothing else.
    if (!state_.motors[a].moving()) state_.units[a].external.running = 0;
    if (state_.units[a].paused_drive.what != Drive::What::none) check_paused_drive(a);
  }
  start_waiting_external();
  step_scans(tick);
}

void RsM8194h::update_outputs(Tick tick) {
  if (machine_.pause_holds_axes && !state_.paused) resume_motion();
  start_held();
  // Macros first; what they leave of the tick is the FIFO's.
  const bool ran_isr = isr_runs();
  state_.steps_left =
      lang::run_tick(state_.execution, tick, options_.steps_a_tick, state_.paused, options_.run, *this);
  if (ran_isr && !isr_runs()) pass_state(kIsrFinished);
  if (machine_.fifo_goes_on_beside_macros) state_.steps_left = options_.steps_a_tick;
  if (machine_.levels_repeat) repeat_levels();
  start_queued_trigger();
  run_fifo(state_.steps_left);
  state_.touched = false;
  state_.eeprom.step(tick, state_.image);
}

/// Whether nothing at all goes on, but for FRnet and what waits to be kept.
bool RsM8194h::rests() const {
  if (is_resetting() || (machine_.finished_states_show && state_.finished_at + 1 >= now())) return false;
  if (inputs_changed() || state_.touched || !state_.fifo.waiting.empty() || state_.fifo.stop_wait != 0)
    return false;
  if (state_.steps_left != options_.steps_a_tick || !state_.marks.empty()) return false;
  if (state_.execution.is_alive() || !state_.queued_triggers.empty()) return false;
  for (std::size_t a = 0; a < kAxes; ++a) {
    const motion::Axis& motor = state_.motors[a];
    const AxisUnit& unit = state_.units[a];
    if (motor.moving() || motor.must_recheck || motor.events != 0 || motor.events_between != 0) return false;
    if (unit.sent_pulses != 0 || state_.environment[a].version != motor.seen_version) return false;
    if (is_filtering(unit)) return false;
    if (unit.held_drive.what != Drive::What::none && !unit.held) return false;
    if (state_.scans[a].running) return false;
  }
  return state_.scanning == 0 && !state_.paths.together.engaged && state_.held_paths.empty();
}

Tick RsM8194h::next_active_tick(Tick done) const {
  if (!rests()) return done + 1;
  Tick next = std::max(done + 1, state_.eeprom.next_active_tick());
  if (state_.unscanned || state_.sent != state_.outputs) next = std::min(next, next_scan(done));
  for (const AxisUnit& unit : state_.units) {
    if (unit.out.pulse_until > done) next = std::min(next, unit.out.pulse_until);
  }
  return next;
}

void RsM8194h::prefetch(Tick tick) const {
  Device::prefetch(tick);
  for (std::size_t a = 0; a < kAxes; ++a) {
    understudy::prefetch(&state_.motors[a], 2 * kCacheLine);  // all that the middle of a move needs
    prefetch_line(&state_.environment[a]);
    prefetch_line(&state_.units[a].sent_pulses);
  }
  prefetch_line(&state_.sync);
  prefetch_line(&state_.paths.together.engaged);
  prefetch_line(&state_.fifo);
  prefetch_line(&state_.execution);
  prefetch_line(&state_.paused);
  prefetch_line(&state_.unscanned);
  prefetch_line(&state_.eeprom);
}

// --- terminals -------------------------------------------------------------------------------------------

bool RsM8194h::output(int terminal) const {
  if (terminal >= kFirstDo) return output_word(terminal, 1) != 0;
  if (!powered() || terminal < kFirstServo) return false;
  if (terminal < kFirstOut) return state_.units[static_cast<std::size_t>(terminal - kFirstServo)].basic.servo;
  if (terminal >= kFirstDi) return false;
  // At rest it is at the other level than its pulses: outEdge 0 is low, and low does not conduct.
  const OutSettings& out = state_.units[static_cast<std::size_t>(terminal - kFirstOut)].out;
  return (out.level == 0) != (now() < out.pulse_until);
}

std::uint32_t RsM8194h::output_word(int first, int count) const {
  if (first < kFirstDo) return Terminals::output_word(first, count);
  const int at = first - kFirstDo;
  std::uint64_t words = 0;
  for (int i = 0; i < 3 && powered(); ++i) {
    const int group = at / kFrnetChannels + i;
    if (group < kFrnetGroups) words |= std::uint64_t{word_of(state_.sent, group)} << (i * kFrnetChannels);
  }
  return static_cast<std::uint32_t>(words >> (at % kFrnetChannels) & ((std::uint64_t{1} << count) - 1));
}

std::int64_t RsM8194h::output_pulses(int terminal) const {
  if (terminal < kFirstOut || terminal >= kFirstOut + kOuts) return 0;
  return state_.units[static_cast<std::size_t>(terminal - kFirstOut)].out.pulses;
}

std::span<const std::string_view> RsM8194h::pulse_formats() const { return kPulseFormats; }

// --- axes ------------------------------------------------------------------------------------------------

std::int64_t RsM8194h::pulses_this_tick(int axis) const {
  return powered() ? state_.units[static_cast<std::size_t>(axis)].sent_pulses : 0;
}

double RsM8194h::speed_pps(int axis) const {
  const auto a = static_cast<std::size_t>(axis);
  if (!powered()) return 0;
  if (state_.paths.together.takes(a)) return state_.paths.together.speed_pps(a, now());
  const motion::Axis& motor = state_.motors[a];
  return motor.moving() ? motor.sample(now()).speed_u_s * static_cast<double>(motor.drive.direction) : 0;
}

std::optional<bool> RsM8194h::servo_on(int axis) const {
  return powered() && state_.units[static_cast<std::size_t>(axis)].basic.servo;
}

std::int64_t RsM8194h::pulses_to_come(int axis) const {
  const auto a = static_cast<std::size_t>(axis);
  if (!powered()) return 0;
  return state_.paths.together.takes(a) ? state_.paths.together.pulses_to_come(a, state_.motors)
                                        : state_.motors[a].pulses_to_come();
}

void RsM8194h::connect_encoder(int axis, std::int64_t counts) {
  AxisUnit& unit = state_.units[static_cast<std::size_t>(axis)];
  unit.encoder_raw = counts * machine_.edges_per_encoder_count;  // EP counts from here
  if (unit.has_encoder) unit.encoder_zero = unit.encoder_raw;
  set_encoder(axis, counts);
}

void RsM8194h::set_encoder(int axis, std::int64_t counts) {
  const auto a = static_cast<std::size_t>(axis);
  const bool is_first = !state_.units[a].has_encoder;
  tell_encoder(state_.units[a], state_.motors[a], counts * machine_.edges_per_encoder_count);
  if (is_first) rearm(a);
}

std::int64_t RsM8194h::place_pulses(int axis) const {
  return state_.motors[static_cast<std::size_t>(axis)].travel_pulses;
}

void RsM8194h::set_edges(int axis, const MachineEdges& edges) {
  edges_[static_cast<std::size_t>(axis)] = edges;
  update_environment(static_cast<std::size_t>(axis));
}

// --- its state as bytes -----------------------------------------------------------------------------------

void RsM8194h::write_own_state(StateWriter& writer) const { writer.write(state_); }

std::function<void()> RsM8194h::read_own_state(StateReader& reader) {
  const auto restored = std::make_shared<State>();
  restored->eeprom = state_.eeprom;
  restored->blocks = TextBlocks(block_kinds());
  reader.read(*restored);
  restored->eeprom.check_restored(state_.eeprom);
  restored->blocks.check_restored(state_.blocks);
  check_restored_registers(*this, restored->image, restored->eeprom.kept());
  return [this, restored] {
    // What was compiled stays so where the macros are the same.
    const bool is_same = compiled_revision_ == state_.blocks.revision() && state_.blocks == restored->blocks;
    state_ = *restored;
    if (!is_same) compiled_revision_ = UINT64_MAX;
    // What it cannot have been doing it does not go on with.
    if (!lang::is_sound(state_.execution, *this)) lang::terminate(state_.execution);
  };
}

std::string RsM8194h::own_difference(StateReader& a, StateReader& b) const {
  return difference_of_saved<State>(a, b);
}

}  // namespace understudy::emulator::models::rs_m8194h
