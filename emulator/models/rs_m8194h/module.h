// RS-M8194H: the i-8094H module, which has the FIFO, the chip and the macros, and what the box knows of
// requests.
//
//   a request ──> window.cpp ──> the FIFO, or at once ──> commands.h: the effects of commands
//   a tick: inputs.cpp ──> motion (motion_step.cpp) and its edges (edges.cpp) ──> the FIFO (pace.cpp)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/machine_edges.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/user_program.h"
#include "emulator/models/rs_m8194h/ground.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/macro_store.h"
#include "motion/axis.h"
#include "motion/pulse_drive.h"
#include "motion/shared_tick.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

using lang::Took;

class Module final : public Part, private lang::Machine, private motion::EdgeOwner {
 public:
  explicit Module(const Ground& ground);

  // --- registers (window.cpp, whole_writes.cpp) ----------------------------------------------------
  bool low_word_first() const { return state_.image[kWordOrderSlot] == 1; }
  bool takes_parts() const { return chose(option("window_parts", "kept_for_the_command")); }
  /// `bank` knows which addresses have a register.
  DeviceAnswer admits(const RegisterRequest& request, Checked checked, const RegisterBank& bank) const;
  bool takes_whole(const RegisterRequest& request) const;
  DeviceAnswer take_whole(const RegisterRequest& request);
  bool diverts(const Place& place, std::uint32_t bits);
  void read_answered(const RegisterRequest& request);
  void exception_answered(const RefusedRequest& request);
  bool keeps(const RegisterRow& row) const;
  void register_written(const RegisterRow& row, std::size_t slot);

  // --- time (module.cpp) -----------------------------------------------------------------------------
  void sample_inputs(Tick tick, bool inputs_changed);
  void step_motion(Tick tick);
  void update_outputs(Tick tick);
  /// Return the next tick in which anything may change, and the next that must be run in full. Inputs are as
  /// they were at `done`.
  Tick next_active_tick(Tick done) const;
  Tick next_event_tick(Tick done, Tick max, const ClearTravel& ahead) const;
  void fast_forward_to(Tick tick, const ClearTravel& ahead, std::span<std::int64_t> pulses);
  void prefetch() const;

  double speed_pps(std::size_t axis) const;
  void set_encoder(std::size_t axis, std::int64_t counts);
  void connect_encoder(std::size_t axis, std::int64_t counts);
  void set_edges(std::size_t axis, const MachineEdges& edges);

  // --- memory and power (memory.cpp, power.cpp) --------------------------------------------------------
  void load_program(std::string_view text);
  std::string program_text() const;
  std::vector<ProgramLocation> program_locations() const;
  void power_up();
  void power_down();
  /// Goes on from a restored state.
  void take_over(const State& restored);

  // --- what commands do (commands.h) -------------------------------------------------------------
  State& state() { return state_; }
  const State& state() const { return state_; }
  bool module_is_absent() const { return input(kNoModuleSwitch) != 0; }
  /// Returns true if it was booted with the switch at Init.
  bool is_deaf() const { return state_.at_init && !chose(option("init_switch", "runs_all_the_same")); }
  bool is_resetting() const { return state_.resetting_until > now(); }

  /// Sets a register, and stores it if it is retentive.
  void put(std::size_t slot, std::uint32_t bits) {
    state_.image[slot] = bits;
    state_.eeprom.write(slot, bits, 0, now());
  }
  bool are_calls_refused() const;
  /// Takes a checked command from the window: executes it at once, or queues it.
  DeviceAnswer take(const lang::Command& command);
  /// Returns the refusal of a request for this fault; reason_of() is the number that input 102 then shows.
  DeviceAnswer answer_of(lang::Fault fault) const;
  std::uint8_t reason_of(lang::Fault fault) const;
  /// Returns the fault of a command for which there is no room in the FIFO or in the macro being downloaded.
  lang::Fault why_no_room(const lang::Command& command) const;
  /// Return the FIFO blocks that a command needs, and those that are free.
  int fifo_blocks_of(const lang::Command& command) const;
  int free_blocks() const;
  /// Adds a command to the FIFO. The caller has checked that there is room.
  void queue(const lang::Command& command);
  /// Executes a command now, or returns that it has to wait.
  Took carry_out(const lang::Command& command) override;

  Activity activity(std::size_t axis) const;
  bool is_driving(std::size_t axis) const;
  std::uint16_t error_code(std::size_t axis) const;
  AxisMask driving() const;
  /// Starts a drive of single axes (drives.cpp).
  Took drive(AxisMask axes, const Drive& what);
  bool takes_place_of_endless(std::size_t axis, const Drive& what);
  /// Starts one axis without a check for locks and waits; what it meets at its start becomes its error.
  void start(std::size_t axis, const Drive& what, bool without_ramps = false);
  motion::SpeedLaw law_of(std::size_t axis) const;
  /// Starts a path, which may have to wait, be held, or have no effect (path_commands.cpp).
  Took follow_path(const lang::Command& command);
  Took begin_path(const HeldPath& path);
  bool joins_stream(const HeldPath& path) const;
  /// Returns the axes of the held path, or none.
  AxisMask axes_of_held_path() const;
  /// Discards the held path: it will not run.
  void drop_held_path();
  /// The next four handle streams that end before their last segment (streams.cpp).
  void break_off_stream();
  void refuse_segment(const HeldPath& path);
  bool is_left_over(const HeldPath& segment);
  void forget_break(Stream stream);
  /// Returns true if the running stream accepts one more segment.
  bool has_room_for_segment() const;
  /// Returns whether a path may begin on these axes now, provided that no path is running.
  Start may_start(AxisMask axes, Starter who) const;
  Start may_start(std::size_t axis, Starter who, bool on_path = false) const;
  /// Sets the error bits for what keeps axes from starting.
  void note_obstacles(AxisMask axes);
  /// Begins the scans of LINE_SCAN_START; the flag of finished scans is off until all of them stand.
  void begin_scans(AxisMask axes);
  std::int64_t scan_travel(std::size_t axis) const;
  bool waits_behind_held(AxisMask axes) const;
  bool keeps_first_held(AxisMask axes) const;
  bool holds_a_drive(AxisMask axes) const;

  void halt(AxisMask axes, const StopRow& row);
  /// Slows the path down to its end.
  void slow_path(Tick tick);
  void take_off(std::size_t axis, WayOut way);
  void clear_stop(AxisMask axes);
  void clear_path_stop();
  void clear_emergency();
  void hold(AxisMask axes);
  void release(AxisMask axes);
  void reset_card();
  void load_initial();
  /// Returns the settings of a new box.
  BasicSettings factory_settings() const;
  void module_error();
  /// Records a state of input 101 that has passed within the tick.
  void pass_state(std::uint8_t finished);

  /// Updates what the motor watches and meets. Call it after a setting or a counter has changed.
  void rearm(std::size_t axis);
  bool is_active(std::size_t axis, motion::Signal signal) const;
  /// Records an event of an axis for the factors.
  void note_factor(std::size_t axis, Factor factor);
  void mark_isr(std::size_t axis, std::uint8_t source, Tick tick);
  /// Records the order in which sources of ISRs were enabled.
  void note_enabled(std::size_t axis, std::uint8_t source, bool is_on);
  void give_pulse(std::size_t axis, Tick tick, std::int64_t pulses = 1);
  void change_speed(std::size_t axis, motion::Instant at);
  /// Sets EXD_MP, EXD_FP or EXD_CP with their data, or turns them off.
  void set_external(std::size_t axis, motion::ExternalDrive::Mode mode, std::uint32_t data);

  // --- macros (macros.cpp) -------------------------------------------------------------------------
  int running_mp() const { return lang::running_mp(state_.execution); }
  bool mp_runs() const { return state_.execution.mp.is_alive(); }
  bool isr_runs() const { return !state_.execution.isrs.empty(); }
  void start_mp(int number);
  void start_isr(int number);
  void terminate();
  /// Takes a message while a macro is being downloaded, or one that opens a download.
  lang::Fault take_download(const lang::Decoded& decoded);
  void run_fifo(int& steps);
  /// Handles a write to holding 9.
  void enable_triggers(bool on);

 private:
  Eeprom factory_memory() const;
  /// Resets everything that is not retentive to its power-up value.
  void blank();
  void blank_module();
  bool is_obstructed(std::size_t axis, Obstacle obstacle, bool on_path) const;
  void update_environment(std::size_t axis);
  void pass_pins(Tick tick);
  /// Returns true while a filter holds back the level of an input.
  bool is_filtering(const AxisUnit& unit) const;
  /// Returns the FRnet inputs as they are now; those of the last scan are part of the state.
  std::array<std::uint16_t, kFrnetGroups> frnet_inputs() const;
  void scan_frnet();
  bool scans_frnet_at(Tick tick) const;
  Tick next_scan(Tick after) const;
  void watch_external(std::size_t axis, Tick tick);
  std::uint32_t external_edges(std::size_t axis, std::size_t which);
  bool is_free_for_external(std::size_t axis, std::int64_t at_ns) const;
  void obey_external(std::size_t axis, const motion::DriveOrder& order, std::int64_t at_ns);
  motion::SpeedLaw external_law(std::size_t axis) const;
  bool start_external(std::size_t axis, const motion::DriveOrder& order);
  void start_waiting_external();
  void step_axes(Tick tick);
  void check_paused_drive(std::size_t axis);
  // edges.cpp
  void at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) override;
  void check_factors(std::size_t axis, motion::Events events, Tick tick, std::int64_t pulses = 0);
  void act_together(motion::SharedTick& tick, std::size_t trigger, motion::Events events);
  void act_on_path(motion::SharedTick& tick, motion::SyncAction::Drive drive);
  motion::Events on_axis_end(std::size_t axis, motion::Events events);
  motion::SpeedLaw law_to_slow_path() const;
  void on_homed(std::size_t axis);
  void on_path_speed(Tick tick);
  void on_path_end(bool was_full);
  void note_end_of_path(std::size_t axis);
  bool is_no_cause(motion::Cause cause, bool is_at_its_end) const;
  bool is_path_complete() const;
  void step_scans(Tick tick);
  std::int64_t scan_spacing(const LineScan& scan) const;
  void end_scan(std::size_t axis);
  bool rests() const;
  void leave_path(std::size_t axis, Halt halt);
  void forget_errors(std::size_t axis);
  /// Returns true if, by choice, the drive is void because its speed was never set.
  bool lacks_speed(std::size_t axis, Drive::What what) const;
  /// Checks writes that become lines of the macro being downloaded.
  DeviceAnswer admits_lines(const RegisterRequest& request) const;
  /// Checks writes that are one message by choice (whole_writes.cpp).
  DeviceAnswer admits_whole(const RegisterRequest& request, Checked checked) const;
  void write_group(std::size_t group, std::uint32_t number);
  void start_held();
  std::array<std::uint8_t, 3> codes_of_path(const lang::Command& command) const;
  bool streams_need_initial() const;
  void break_off(Stream stream, bool has_more);
  bool keeps_path_off(const std::array<std::uint8_t, 3>& codes, const motion::Point& way);
  /// Draws a command that may begin, or that joins its stream. Throws BadMotion if it cannot be drawn.
  void draw(const HeldPath& path, bool joins);

  // lang::Machine
  const lang::Macro* macro(const lang::MacroName& name) const override;
  std::int32_t variable(std::size_t number) const override;
  void set_variable(std::size_t number, std::int32_t value) override;
  std::uint8_t byte_variable(std::size_t number) const override;
  std::int32_t read(const lang::Command& command) const override;
  bool stand(std::uint32_t axes) const override;
  bool frnet_input(std::uint32_t group, std::uint32_t channel) const override;
  int take_isr() override;
  void mp_ended() override;
  void terminated() override;
  void report(const lang::ExecutionFault& fault) override;

  /// Handles triggers after a scan (triggers.cpp).
  void check_triggers(const std::array<std::uint16_t, kFrnetGroups>& before, bool at_start);
  void fire(int channel, const lang::Trigger& trigger);
  void start_queued_trigger();
  void repeat_levels();
  void pause(int channel);
  void slow_down(AxisMask axes);
  void pause_motion();
  void resume_motion();
  bool may_start_trigger() const;
  const lang::TriggerTable& triggers() const;

  State state_;
  // Not state: compiled from the text blocks, again whenever these have changed.
  mutable lang::MacroStore macros_;
  mutable lang::TriggerTable triggers_{};
  mutable std::uint64_t compiled_revision_ = UINT64_MAX;
  void compile() const;
  int isr_of(const IsrMark& mark) const;
  std::array<MachineEdges, kAxes> edges_{};  // not state: set again after a restore
};

}  // namespace understudy::emulator::models::rs_m8194h
