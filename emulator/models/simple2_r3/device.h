// Simple2-R3: a two-axis pulse controller on Modbus RTU. Its state is one value; effects.cpp has the effects
// of registers, device.cpp the tick.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/registers.h"
#include "interpreter/simple2/execution/execution.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr int kInputCount = 11;
inline constexpr int kOutputCount = 7;
inline constexpr int kAnalogCount = 2;
inline constexpr int kSwitchCount = 2;
// The first terminal of each kind.
inline constexpr int kFirstOutput = kInputCount;
inline constexpr int kFirstAnalog = kFirstOutput + kOutputCount;
inline constexpr int kFirstSwitch = kFirstAnalog + kAnalogCount;
inline constexpr int kTerminalCount = kFirstSwitch + kSwitchCount;

/// Timer1, Timer2: 32 bits, in the timer's unit (Simple2R3::timer_time). The value is computed from its
/// start, so a running timer costs nothing.
struct Timer {
  std::uint32_t value = 0;  // at `since`
  Tick since = 0;
  bool running = false;

  /// Returns the value at `now`. On overflow it wraps to 0, or saturates if `stays`.
  std::uint32_t at(Tick now, bool stays) const {
    const std::uint64_t sum = value + (running ? static_cast<std::uint64_t>(now - since) : 0);
    return stays && sum > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(sum);
  }
  void set(std::uint32_t new_value, Tick now) {
    value = new_value;
    since = now;
  }
  void run(bool on, Tick now, bool stays) {
    set(at(now, stays), now);
    running = on;
  }

  bool operator==(const Timer&) const = default;
};

/// The speed of a program's moves, if they do not share the axis's registers.
struct ProgramSpeed {
  std::uint32_t speed_rpm = 0;
  std::uint32_t acceleration_10ms = 0;
  std::uint32_t deceleration_10ms = 0;

  bool operator==(const ProgramSpeed&) const = default;
};

/// The parameters of a position move, latched when it starts (appendix A).
struct MoveParameters {
  std::int64_t distance_pulses = 0;
  std::uint32_t speed_rpm = 0;
  std::uint32_t acceleration_10ms = 0;
  std::uint32_t deceleration_10ms = 0;
  bool of_the_axis = false;  // the speed and times come from the axis's registers at 0x1002, 0x1008
  bool by_trigger = false;   // started by the register that shows it

  bool operator==(const MoveParameters&) const = default;
};

/// A command that waits for SVON, if a choice makes it wait.
struct KeptCommand {
  Mode mode = Mode::position;
  Command command = Command::none;  // of position mode; none: no command waits
  MoveParameters move{};
  std::int64_t value = 0;  // mRPM or percent

  bool operator==(const KeptCommand&) const = default;
};

/// What stops an axis. An instruction and SVOFF stop it forcibly.
enum class Stopping : std::uint8_t { forcibly, by_register };

/// The members that a tick needs come first and, up to the beginning of `eeprom`, on one cache line (a test
/// checks this).
struct alignas(64) State {
  bool touched = true;               // registers or inputs may have changed since motion looked at them
  bool unlocked = true;              // PROG_UNLOCK
  std::uint8_t switches = 0;         // bit n: DIP n + 1, as at power-up
  std::uint8_t written_outputs = 0;  // bit n: the last level written to DOUT n
  std::uint16_t inputs = 0;          // bit n: DIN n, as sampled in this tick
  std::uint16_t assignments = 0;     // bit n: the register 0x0A00 + n, as at power-up
  std::array<std::uint16_t, kAnalogCount> adc{};  // as sampled in this tick
  std::uint16_t password = 0;                     // NEW_PWD, independent of the image while it is locked
  Tick first_tick = 1;                            // after power-up: AutoStart_MainProg is checked there
  interpreter::simple2::Execution execution;
  Eeprom eeprom;
  std::array<AxisState, 2> axes;
  alignas(64) std::array<std::uint32_t, kSlotCount> image{};
  interpreter::simple2::Program program;  // the cells of the image, in a form that can run
  std::array<Timer, 2> timers;
  std::array<ProgramSpeed, 2> program_speeds{};
  std::array<KeptCommand, 2> kept{};  // by axis

  bool operator==(const State&) const = default;
};

/// Returns the pulses a revolution, never 0, by which the caller divides. A host may write half of a 32-bit
/// register alone, so the register can hold anything.
std::uint32_t resolution_of(const State& state, int axis);

class Simple2R3 final : public StatefulDevice<Simple2R3, State>,
                        public RegisterBankOf<Simple2R3>,
                        public ModbusStation,
                        public KeptMemory,
                        public UserProgram,
                        public Terminals,
                        public Axes {
 public:
  explicit Simple2R3(const DeviceSettings& given);

  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  const MapPolicy& map_policy() const override { return map_policy_; }
  bool answers_refusals() const override { return !chose(option("exceptions", "no_answer")); }
  void register_written(const RegisterRow& row, std::size_t slot) override;
  void registers_written() override {
    state_.touched = true;
    was_saving_.reset();
  }
  void warn_not_implemented(const RegisterRow& row) const override {
    Device::warn_not_implemented(row.name, row.not_implemented);
  }

  bool keeps(const RegisterRow& row) const override;
  std::uint64_t kept_revision() const override { return state_.eeprom.revision(); }
  void settle_memory() override { state_.eeprom.settle(state_.image); }
  void load_program(std::string_view listing) override;
  std::string program_text() const override;
  std::vector<ProgramLocation> program_locations() const override;
  void watch_program(ProgramWatch* watch) override { program_watch_ = watch; }

  Addressing addressing(std::uint8_t address) const override;
  pty::LineSettings line_settings(std::size_t port) const override;

  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick tick) override;
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  Tick next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const override;
  void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override;
  void prefetch(Tick tick) const override;

  bool output(int terminal) const override;
  bool output_moves(int /*terminal*/) const override {
    return false;
  }  // switched by commands, in ticks of their own
  std::int64_t pulses_this_tick(int axis) const override;
  double speed_pps(int axis) const override;
  std::int64_t pulses_to_come(int axis) const override;
  std::optional<bool> servo_on(int axis) const override;
  /// Returns the resolution in velocity mode: the value now, or the one that its last command found.
  std::uint32_t resolution_in_velocity(int axis) const;
  double speed_of_pulses(int axis_number) const;
  void set_encoder(int axis, std::int64_t counts) override;
  std::string_view pulse_format() const override { return pulse_formats()[pulse_format_number()]; }
  std::span<const std::string_view> pulse_formats() const override;
  std::size_t pulse_format_number() const override { return dip_switch(1) ? 1 : 0; }
  std::optional<int> duty_percent(int axis) const override;

  // --- for effects.cpp ---------------------------------------------------------------------
  /// Returns DIN 0 to 10 as sampled in the last tick; before the first tick after power-up, as sampled now.
  std::uint16_t inputs() const { return is_just_up() ? input_levels() : state_.inputs; }
  std::uint16_t adc(std::size_t number) const {
    return is_just_up() ? adc_at(static_cast<int>(number)) : state_.adc[number];
  }
  State& state() { return state_; }
  const State& state() const { return state_; }

  /// Returns true if the register at `assignment_slot` (0x0A00 to 0x0A0D) gives its pin a function.
  bool assigned(std::size_t assignment_slot) const;
  bool alarm(int axis) const;
  bool ready(int axis) const;
  bool upper_limit(int axis) const;
  bool lower_limit(int axis) const;
  bool alarm_clear(int axis) const;
  /// Returns the actual level at DOUT `number`, special functions included.
  bool output_level(int number) const;
  /// Sets DOUT n to the level of bit n, for each bit n that is set in `which`.
  void write_outputs(std::uint8_t which, std::uint8_t levels);

  /// Starts a move (appendix A). The move is dropped while the servo is off, an alarm lasts or a limit blocks
  /// its direction.
  void start_move(int axis_number, Command command, const MoveParameters& move);
  /// Starts homing, with the axis's Home_Speed, Home_AccTime and GoHome_DIR. Homing is dropped as moves are.
  void go_home(int axis_number, bool by_trigger = false);
  /// Start the other modes. transitions.h says what each command does to the present motion.
  void run_velocity(int axis_number, std::int64_t milli_rpm);
  void output_pwm(int axis_number, std::uint8_t percent);
  void follow_encoder(int axis_number);
  void stop(int axis_number, Stopping how = Stopping::forcibly);
  void switch_servo(int axis_number, bool on);
  /// Applies a write to EncSync, SyncRPM or SyncSlope of the axis.
  void sync_changed(int axis_number);
  /// Applies a write to Speed, AccTime, DecTime or Resoultion of the axis.
  void speed_changed(int axis_number);
  void preset_coordinate(int axis_number, std::int32_t pulses);
  void clear_alarm(int axis_number);
  /// Show a command in DirectmRPM and DirectPWM that was not a write to them.
  void show_velocity(int axis, std::int32_t milli_rpm);
  void show_pwm(int axis, std::uint8_t percent);
  void reset_to_factory();
  void erase_program();
  /// Compares PWD_Input with the password, and locks or unlocks.
  void judge_lock();
  /// Handles a write to NEW_PWD; it has no effect while the device is locked.
  void change_password(std::uint16_t password);
  bool unlocked() const;
  void start_program(std::uint8_t line);
  void stop_program();
  /// The clock of the timers: its unit in ticks, and its time in units.
  Tick timer_unit() const { return timer_unit_; }  // in ticks
  Tick timer_time() const { return now() / timer_unit_; }
  void run_timer(Timer& timer, bool on) { timer.run(on, timer_time(), timers_stay()); }
  std::uint32_t timer_value(const Timer& timer) const { return timer.at(timer_time(), timers_stay()); }
  /// Reloads the program after all cells of the image may have changed.
  void reload_program();
  const interpreter::simple2::Dialect& dialect() const { return dialect_; }

 protected:
  void power_up() override;
  void power_down() override;
  void check_restored(State& restored) const override;
  std::function<void(NvImage&)> memory_writer() const override;
  void read_memory(const NvImage& image) override;

 private:
  std::span<const int> line_bauds() const;
  /// Returns a DIP switch; DIP1 is number 0.
  bool dip_switch(int number) const;
  std::uint8_t switch_levels() const;
  /// Returns true if no tick has been run since power-up.
  bool is_just_up() const { return now() + 1 + boot_ticks_ == state_.first_tick; }
  /// Return the levels at the terminals now.
  std::uint16_t input_levels() const;
  std::uint16_t adc_at(int number) const;
  bool sees_something_new() const;
  /// Returns the next active tick, without regard to the axes.
  Tick next_tick_without_axes(Tick done) const;
  Tick next_slot(Tick done) const;
  DriveSettings drive_settings(int number) const;
  Crossing crossing(int axis, Tick done, const ClearTravel& ahead) const;
  Eeprom factory_memory() const;
  /// Resets the state, except for the memory and the encoders' counts.
  void blank_state();
  std::uint32_t factory_bits(const RegisterRow& row) const;
  /// Sets the timers to their values at power-up.
  void reset_timers();
  /// Returns an input's level if the register at `assignment_slot` gives it its special function, else false.
  bool assigned_input(std::size_t assignment_slot, int number) const;
  /// Returns true if the coordinate counts in the motor's direction, as it did until 1.40 (firmware note
  /// "1.40 以前").
  bool quirk_coordinate_counts_physical_sense() const { return counts_physical_sense_; }

  /// Returns the law of a position move: appendix A and the 100 kHz limit.
  motion::SpeedLaw law_of(int axis, std::uint32_t speed_rpm, std::uint32_t acceleration_10ms,
                          std::uint32_t deceleration_10ms) const;
  MapPolicy chosen_map_policy() const;
  bool is_refused_as_too_fast(int axis, std::int64_t milli_rpm) const;
  void leave_home(AxisState& axis) const;
  /// Returns true if a command with that outcome leaves its register unchanged.
  bool is_forgotten(Outcome outcome) const {
    return outcome != Outcome::kept && chose(option("dropped_value", "forgotten"));
  }
  bool timers_stay() const { return chose(option("timer_overflow", "stays")); }
  bool shows_command_values() const { return !chose(option("command_values", "not_shown")); }
  void find_flags_if_told();
  /// Returns true if commands need Ready, and it is missing.
  bool lacks_ready(int axis) const;
  /// Returns true if SVOFF forbids anything.
  bool servo_matters(int axis) const;
  /// Returns true if the servo is off, and that matters.
  bool lacks_servo(int axis) const;
  /// Returns the axis's reaction to an event, in its present state and under the chosen options.
  Outcome reaction(int axis_number, Event event) const;
  /// Returns `towards` if a limit that is on forbids that direction, else `away`.
  Event event_by_direction(int axis, int direction, Event towards, Event away) const;
  /// Returns true if a command begins; if not, does what happens instead.
  bool may_begin(int axis_number, Outcome outcome, const KeptCommand& what);
  void carry_out_kept(int axis);
  void forget_kept(int axis);
  /// Checks again whether SVOFF forbids pulses.
  void apply_servo_state(int axis_number);
  /// Sets the axis's limits and alarm, and handles the changes.
  void apply_signals(int axis_number, motion::Signals on);
  void handle_in_sync(int axis_number, Outcome outcome);
  bool ignores(motion::Signal signal) const;
  void begin_following(int axis_number);
  motion::Follower sync_follower(int axis_number) const;
  /// Returns the change of speed in 0.5 ms, by VelMode_ACC.
  std::uint32_t velocity_step_urpm(int axis) const;
  /// Returns the count of the encoder that sync mode follows.
  std::int64_t followed_count(int axis) const;
  /// Returns the tick that counts as the last one before a motion commanded now.
  Tick tick_before_motion() const { return chose(option("move_begins", "one_tick_in")) ? now() - 1 : now(); }
  void run_program(Tick tick);
  void program_has_ended();
  motion::Signals signals_of(int axis) const;
  /// Updates the motor's signals, before a command that they may forbid.
  void refresh_signals(int axis_number);

  // Values computed from firmware and choices, for frequent use: not state. They fill one cache line.
  alignas(64) interpreter::simple2::Dialect dialect_;
  bool assigned_at_power_up_ = false;
  bool adc_10_bits_ = false;
  bool motion_first_ = false;
  bool limits_physical_ = false;
  bool alarm_latches_ = false;
  bool alarm_takes_servo_ = false;
  bool coordinate_saturates_ = false;
  std::uint32_t velocity_unit_urpm_ = 1;  // unit of VelMode_ACC, in each 0.5 ms
  bool velocity_pulses_first_ = false;
  bool velocity_settings_latched_ = false;
  bool stops_with_encoder_ = false;
  bool sync_follows_other_ = false;
  bool counts_physical_sense_ = false;
  Tick timer_unit_ = 1;

  Tick boot_ticks_ = 0;
  MapPolicy map_policy_;
  // within one request: whether the EEPROM was being written when the request came
  std::optional<bool> was_saving_;
  ProgramWatch* program_watch_ = nullptr;
};

}  // namespace understudy::emulator::models::simple2_r3
