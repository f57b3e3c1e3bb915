// SUPER-40NC: a four-axis controller on Modbus RTU with two ports. Its state is one value. effects.cpp holds
// the effects of contacts and registers, commands.cpp the command contacts of a scan, keys.cpp the panel's
// keys, and axes.cpp the axes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/contacts.h"
#include "emulator/models/super_40nc/keys.h"
#include "emulator/models/super_40nc/manual_motions.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/settings.h"
#include "emulator/models/super_40nc/state.h"  // IWYU pragma: export
#include "emulator/models/super_40nc/terminals.h"
#include "emulator/models/super_40nc/user_table.h"
#include "emulator/models/super_40nc/watched_places.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/ladder.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/environment.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::super_40nc {

/// Returns the code that D8094 shows for `why`.
Code code_of(motion::Cause why);

class Super40nc final : public DeviceOf<Super40nc>,
                        public RegisterBankOf<Super40nc>,
                        public ModbusStation,
                        public KeptMemory,
                        public UserProgram,
                        public Terminals,
                        public Axes,
                        private motion::EdgeOwner {
 public:
  explicit Super40nc(const DeviceSettings& given);

  // --- registers -----------------------------------------------------------------------------------
  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  void register_written(const RegisterRow& row, std::size_t slot) override;
  bool keeps(const RegisterRow& row) const override;
  void registers_written() override { state_.touched = true; }
  void warn_not_implemented(const RegisterRow& row) const override;
  const MapPolicy& map_policy() const override { return map_policy_; }
  Addressing addressing(std::uint8_t address) const override;
  bool knows(std::uint8_t function) const override;
  bool answers_refusals() const override;
  DeviceAnswer admits(const RegisterRequest& request, Checked checked) const override;
  pty::SimTime end_silence(pty::SimTime usual) const override;
  void receive_failed(std::size_t port, pty::ReceiveError error) override;

  // --- memory --------------------------------------------------------------------------------------
  TextBlocks* text_blocks() override { return &state_.blocks; }
  const TextBlocks* text_blocks() const override { return &state_.blocks; }
  std::uint64_t kept_revision() const override { return state_.eeprom.revision() + state_.blocks.revision(); }
  void settle_memory() override { state_.eeprom.settle(state_.image); }

  /// Returns the errors of `text` as a program.
  std::vector<ProgramMistake> mistakes_in(std::string_view text) const;
  /// Returns the warnings about `text`: it loads, but something is odd.
  std::vector<ProgramMistake> warnings_about(std::string_view text) const;
  /// Areas that `text` does not name stay as they are. A refused listing shows in D8094 to D8096.
  void load_program(std::string_view text) override;
  std::string program_text() const override;
  std::vector<ProgramLocation> program_locations() const override;

  // --- time ----------------------------------------------------------------------------------------
  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick tick) override;
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  Tick next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const override;
  void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override;
  bool same_state(const Device& other) const override;

  // --- terminals and axes --------------------------------------------------------------------------
  bool has_terminal(int terminal) const override;
  bool output(int terminal) const override;
  bool output_moves(int terminal) const override;
  std::int32_t analog_level(int terminal) const override;
  std::int64_t pulses_this_tick(int axis_number) const override;
  double speed_pps(int axis_number) const override;
  std::int64_t pulses_to_come(int axis_number) const override;
  void set_encoder(int axis_number, std::int64_t counts) override;
  bool meets_edges() const override { return true; }
  std::int64_t place_pulses(int axis) const override;
  void set_edges(int axis, const MachineEdges& edges) override;

  // --- for effects.cpp -----------------------------------------------------------------------------
  State& state() { return state_; }
  const State& state() const { return state_; }
  AxisState& axis(int number) { return state_.axes[static_cast<std::size_t>(number)]; }
  const AxisState& axis(int number) const { return state_.axes[static_cast<std::size_t>(number)]; }
  motion::Axis& chip(int number) { return state_.chips[static_cast<std::size_t>(number)]; }
  const motion::Axis& chip(int number) const { return state_.chips[static_cast<std::size_t>(number)]; }
  const auto& environment(int axis) const { return state_.environment[static_cast<std::size_t>(axis)]; }
  auto& environment(int axis) { return state_.environment[static_cast<std::size_t>(axis)]; }
  /// Returns COUNTER1.
  std::int64_t machine_pulses(int number) const {
    return axis(number).command.at(chip(number).travel_pulses);
  }
  bool has_signal(int number, motion::Signal signal) const {
    return (chip(number).signals & motion::bit(signal)) != 0;
  }
  Settings registers() const { return Settings(state_.image, readings_, state_.parameters_in_force); }
  /// Writes a register as the device does: without its effect.
  void put(Kept kept, std::int32_t value, int axis = 0);
  /// Keeps the image's value in memory, if it is retentive.
  void keep_slot(std::size_t slot) { state_.eeprom.write(slot, state_.image[slot], 0, now()); }

  /// Returns the position that D8x17 shows, in the work coordinate.
  std::int64_t work_lu(int axis_number) const;
  void set_work_lu(int axis_number, std::int64_t position);
  std::int32_t counter(int axis_number, int number) const;
  void set_counter(int axis_number, int number, std::int32_t pulses);
  bool comparator_holds(int axis, int number) const;
  bool status(int axis_number, AxisStatus what) const;
  /// Returns the value of D8x64.
  std::int32_t operation_of(int axis_number) const;
  /// Returns the speed in the axis's own direction.
  double commanded_pps(int axis_number) const;
  /// Returns the speed in steps of the chip (D8x70).
  std::int32_t chip_speed(int axis_number) const;
  std::int64_t braking_pulses(int axis) const;
  std::int64_t remaining_pulses(int axis_number) const;
  /// Applies a written parameter of an axis: `number` of D9x00 + number; 0: a D8x.
  void apply_axis_parameters(int axis_number, int number);
  /// Applies the parameters of all axes.
  void apply_all_axis_parameters();
  /// Changes the path file (D9001) or the recipe (D9002).
  void change_file(std::int32_t number);
  void change_recipe(std::int32_t number);
  /// Applies D8022.
  void change_jog_speed();
  /// Applies D8020: the wheel's axis, or a command.
  void take_user_command(std::int32_t number);
  /// Returns D8019, the line of the user table.
  std::int32_t table_line() const;
  /// Returns true while ERC is given (M8x49, M8x52, M8x53).
  bool gives_erc(int axis) const { return now() < state_.erc_until[static_cast<std::size_t>(axis)]; }
  bool keeps_unlisted() const { return !chose(option("unlisted_contacts", "read_0")); }
  bool has_chip_pins() const { return chose(option("pins_fitted", "also_clr_ltc_and_erc")); }
  /// Returns the counts of VR1 to VR3.
  std::int32_t analog_counts(int number) const;
  void flash_written(bool is_recipe);
  int first_of_recipe() const;
  void take_recipe(std::int32_t number);
  /// Returns the state of M8022.
  bool is_pausing() const;
  /// Sets D8000 or D8x00. Programs are numbered in the order of their areas.
  void set_pointer(int program, std::int32_t step);
  /// Returns what D8000 and D8x00 add to the area's own step number.
  int shown_base(std::size_t program) const;
  /// Returns D8000 or D8x00.
  std::int32_t shown_step(std::size_t program) const;
  /// Computes D9042 and D9043 from D9045.
  void show_capacities();

  // --- for programs: program_machine.cpp -------------------------------------------------------------
  void report(const ErrorReport& error);
  void report(Code code) { report({.code = code}); }
  /// Reports at the current line of the mover's program, if there is one.
  void report(Code code, Mover of_its_line);
  void clear_error() { state_.error = {}; }
  void error_is_over();
  /// Sets the PLC line that begins a motion, counted as by D8095; 0 between such lines.
  void set_plc_step(int step) { plc_step_ = step; }
  /// Returns the step of the current line of a step program, counted as by D8095.
  int line_step(Mover mover) const;
  const interpreter::super_40nc::Options& language_options() const { return options_; }
  /// Returns the motion by hand, or nothing if a program's line waits for the axis.
  std::optional<ManualMotion> manual_motion(int axis_number) const;
  /// Handles an event by the table in manual_motions.h.
  void handle(int axis, ManualEvent event, Code code = Code::none);
  void handle(int axis, ManualMotion motion, ManualEvent event, Code code = Code::none);
  Grant ask(int axis_number, Request request);
  /// Looks up the table of ownership.h, under the chosen option.
  Grant granted(Activity holder, Request request) const { return grant(holder, request, lines_wait_); }
  std::int64_t relative_base_lu(int axis_number) const;
  /// Returns pulses to the target; not 0 if PSET, another D8x40 or CMX moved a target that was reached.
  std::int64_t distance_to(int axis_number, std::int64_t target_lu) const;
  std::int64_t search_pulses(int axis) const;
  motion::SpeedLaw line_law(int axis, double rpm, Mover mover) const;
  motion::SpeedLaw drive_law(int axis, std::int32_t rpm, Mover mover) const;
  // Each of these returns true if the motion has begun; if not, it reports its error.
  bool begin_drive(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover);
  bool begin_mark(int axis_number, std::int64_t distance, std::int64_t search, std::int32_t rpm, Mover mover);
  bool begin_blind_mark(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover);
  bool begin_turning(int axis_number, std::int32_t rpm, Mover mover);
  void change_turning(int axis_number, std::int32_t rpm, Mover mover);
  bool end_by_ramp(int axis_number, Mover mover);
  void stop_by_command(int axis_number);
  void start_home(int axis_number, int order = 0);
  void start_wheel(int axis_number, WheelSource source);
  void start_jog(int axis_number, int direction, bool AxisState::*asked_by);
  void release_jog(int axis_number, bool AxisState::*asked_by);
  void hold_axis(int axis_number);
  void go_on_axis(int axis_number);
  void break_program(Mover mover, int but_for = -1);
  void stop_all_of(Mover mover);
  bool is_awaited_by(Mover mover) const;
  /// Stops at once. A home or zero return that is abandoned has no further effect.
  void stop_axis(int axis_number, Code code = Code::none);
  bool is_held_in_reset(int axis) const;
  /// Returns true under M8004 or one of the above: starts by hand are then dropped without a code.
  bool is_inhibited(int axis) const;
  /// Returns true if levels that stayed ON through a reset act now.
  bool acts_behind_reset(int axis) const;
  bool is_stopped_by_emergency() const;
  /// Begins the signal Y0 + `signal`, or restarts it.
  void show_finished(std::size_t signal);
  /// Returns true if a line whose axes are at their targets already gives the signal.
  bool finishes_without_motion() const { return !chose(option("fsh_without_motion", "do_not_come")); }

  /// A LIN or an arc, in the machine coordinate.
  struct PathPlan {
    motion::Path path;
    std::array<bool, kAxisCount> takes{};
    std::array<std::int64_t, kAxisCount> target_lu{};  // in the work coordinate
    std::int32_t feed_lu_per_s = 0;
    int mode = 0;  // the value of the chip's PRMD
  };
  /// Returns what the axes of a path get together.
  Grant ask_for_path(const std::array<bool, kAxisCount>& takes);
  bool begin_path(const PathPlan& plan);
  /// Returns true if a new path continues the current one (D9005).
  bool joins_paths() const;
  /// Returns true if the current path can take one more piece with the same axes.
  bool has_room_on_path(const std::array<bool, kAxisCount>& takes) const;
  void join_path(const PathPlan& plan);
  /// Returns where the next LIN or arc begins.
  std::int64_t path_base_lu(int axis_number) const;
  bool is_on_path(int axis) const { return state_.path.takes(static_cast<std::size_t>(axis)); }
  void hold_path();
  void go_on_path();
  void slow_path();
  void stop_path();
  void apply_override();

  bool contact(int number) const { return state_.image[relay_slot(number)] != 0; }
  void set_contact(int number, bool on);

 protected:
  void power_up() override;
  void power_down() override;
  void write_own_state(StateWriter& writer) const override;
  std::function<void()> read_own_state(StateReader& reader) override;
  std::string own_difference(StateReader& a, StateReader& b) const override;
  std::function<void(NvImage&)> memory_writer() const override;
  void read_memory(const NvImage& image) override;

 private:
  // --- memory.cpp
  void blank_state();
  Eeprom factory_memory() const;
  std::uint32_t factory_bits(const RegisterRow& row) const;
  interpreter::super_40nc::Options chosen_options() const;
  MapPolicy chosen_map_policy() const;
  void reset_parameters();
  void take_parameters();
  void take_power_up_parameters();
  void read_files_again();

  // --- commands.cpp, keys.cpp: the scan's step of contacts
  bool is_on(int contact_number) const;
  bool rises(int contact_number) const;
  void read_keys();
  void read_jog_keys();
  bool is_locked(const Key& key) const;
  /// Returns true if the key is pressed in this scan; axis -1: on the main page.
  bool is_pressed(KeyDoes what, int axis) const;
  void give_up_orders();
  void obey_order_keys();
  void follow_order(OrderKey& key, Activity holder, Kept order_of_axis, void (Super40nc::*start)(int, int));
  void obey_contacts();
  /// Returns true if axes have errors that fall at the next tick, where that is chosen.
  bool has_errors_for_a_scan() const;
  void obey_stops();
  void stop_by_emergency(interpreter::super_40nc::Area area, bool is_new);
  void obey_jogs(int axis);
  void obey_wheel();
  bool is_wheel_locked(int axis) const;
  void hold_while_inhibited();
  void slow_by_hand(int axis);
  void obey_pages();
  bool is_level_again(int axis, int contact) const;
  /// Returns whether M8x97 to M8x99 show a motion.
  bool shows_running(bool is_by_contact) const;
  void see_contacts();

  // --- axes.cpp: what moves them
  void prepare(int axis_number, bool homes = false);
  /// Returns the tick before this one: a scan's moves start in the scan's own tick.
  Tick before_motion() const { return now() - 1; }
  void begun(int axis_number, motion::Cause why_not, Activity holder);
  void start_zero(int axis_number, int order = 0);
  void set_zero(int axis_number);
  void ended(int axis_number);
  void wheel_ended(int axis);
  /// Ends the program of an axis that has met something and was released.
  void program_broken(Mover mover, int axis, bool is_awaited, motion::Cause why);
  void home_ended(int axis_number, bool found, Code code);
  void fail(int axis_number, Code code);
  void let_go(int axis_number);
  void mirror_start(int axis_number, int mode, std::int64_t distance_pulses, const motion::SpeedLaw& law);
  void feed_wheel(std::int32_t edges);
  std::int64_t wheel_lu_per_count(int axis_number) const;
  void follow_ratio(int axis);
  void count(int axis_number, std::int64_t travel_before, std::int64_t wheel_counts, Tick clock_ticks = 1);
  void count_encoder(int axis_number, std::int64_t counts);
  void count_until(const motion::SharedTick& tick, int axis_number);
  void add_to_counter(int axis_number, int which, std::int64_t counts);
  bool counts_now(int axis_number) const;
  /// Returns true if a clock drives COUNTER4 (D9x25 = 3).
  bool counts_a_clock(int axis) const;
  void clear_counters(int axis_number);
  motion::SpeedLaw jog_law(int axis) const;
  /// Returns the limit that the axis stands on, if that blocks both directions.
  motion::Cause blocked_both_ways(int axis) const;
  motion::Cause blocked_on_path(int axis_number, const motion::Path& path) const;
  void count_index(int axis_number, std::int8_t phase_before);
  void latch_by_comparator(int axis_number);
  motion::AxisSettings motor_settings(int axis, bool homes) const;
  motion::AxisSettings motor_settings(int axis) const {
    return motor_settings(axis, chip(axis).homing.active());
  }

  void rest_axis(int axis_number);
  void cannot_go_on(int axis_number, const Rest& rest, Mover mover, bool is_awaited);
  /// Drops an end between ticks that has been handled.
  void forget_end(int axis);
  void path_ended();
  void step_axes(Tick tick, std::int32_t wheel_counts, std::array<std::int64_t, kAxisCount>& sent);
  void at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) override;
  bool awaits_path() const;
  void begin_path_backlash(const motion::Path& path);
  void end_path_backlash();
  void step_path_backlash(Tick tick, std::array<std::int64_t, kAxisCount>& sent);
  void step_arc_backlash(const std::array<std::int8_t, kAxisCount>& ways_before,
                         std::array<std::int64_t, kAxisCount>& sent);
  double override_percent() const;
  double path_feed() const;
  double feed_scale(const motion::Path& path) const;

  void run_plc();
  void look_at_contacts();
  /// Returns true if the PLC may switch FSH and END outputs between their signals.
  bool shares_signals() const { return chose(option("signal_outputs", "the_plc_has_them_between")); }

  // --- programs.cpp
  void make_programs_ready();
  interpreter::super_40nc::Options options_with_room() const;
  std::int32_t room_of_c() const;
  void show_line_counts();
  bool shows_line_counts() const { return chose(option("line_counts", "steps_of_the_programs")); }
  bool is_too_long(std::string_view kind, std::string_view name) const;
  void tell(interpreter::super_40nc::Event event, interpreter::super_40nc::Area area);
  void give_up_program(interpreter::super_40nc::Area area);
  bool programs_are_busy() const;
  void plc_to_run();
  void plc_to_stop();
  void clear_timers();

  // --- crossing.cpp
  Tick quiet_scans(bool moves) const;
  bool scans_in(Tick tick) const;
  void find_what_plc_watches();
  void note_what_plc_sees();
  void wake_plc_by_what_changed();
  /// Returns the first tick after `done` at which something is due by time.
  Tick next_timed_tick(Tick done) const;
  bool is_quiet(int axis_number) const;

  // --- comparators.cpp
  std::int64_t compared_number(int axis, std::size_t which) const;
  std::optional<motion::Comparator> comparator_of(int axis, std::size_t which) const;
  void set_comparators(int axis_number);
  void set_comparator(int axis, std::size_t place, motion::Comparator wanted);
  void see_counters(int axis_number);
  void compare_counters(int axis_number);
  void stop_by_comparator(int axis, bool by_ramp, motion::Cause why);

  // --- signals.cpp: inputs, limits and what the axes encounter
  void look_at_inputs();
  void see_first_signals();
  void update_environment(int axis_number);
  /// Returns X33 or X34: 0 not in use, 1 NO, 2 NC.
  Value limit_logic(int axis, int direction) const;
  /// Returns true if D8x18 and D8x19 are what acts of X33 and X34.
  bool has_limit_copies() const { return !chose(option("limit_copies", "plain_registers")); }

  // --- pins.cpp: pins of the chip that are fitted by choice
  bool has_voltage_inputs() const { return !chose(option("analog_counts", "in_counts_only")); }
  void see_pins();
  void hold_cleared();
  void clear_by_pin(int axis);
  void give_erc(int axis);
  void give_erc_behind(int axis, Code code);
  void keep_display(int axis);
  void take_latch(int axis, std::int64_t travel);

  // --- user_table.cpp
  void put_table_in_place();
  void leave_table();

  State state_;
  interpreter::super_40nc::StepCodes codes_;  // not state: made, like the ladder, of the memory's listings
  SharedLadder ladder_ = std::make_shared<const interpreter::super_40nc::Ladder>();
  std::array<bool, kAxisCount> is_restored_{};  // restored, and its edges not set again yet
  NamedBlocks::mapped_type ready_texts_;        // the texts of codes_ and ladder_
  WatchedPlaces watched_;
  std::vector<int> table_lines_;  // lines of the user table, while it runs
  interpreter::super_40nc::Options options_;
  MapPolicy map_policy_;
  bool lines_wait_ = false;                       // a choice, cached
  Readings readings_;                             // cached choices
  bool parameters_wait_ = false;                  // cached: written parameters act later, all at once
  int plc_step_ = 0;                              // not state: 0 outside a line
  std::array<MachineEdges, kAxisCount> edges_{};  // not state: set again after a restore
  std::array<CountedSoFar, kAxisCount> counted_{};
  std::int32_t wheel_of_tick_ = 0;
};

}  // namespace understudy::emulator::models::super_40nc
