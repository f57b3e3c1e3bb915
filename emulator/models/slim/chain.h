// A chain of up to eight SLIM modules, as a value: its commands, without any text.
//
//   issued ──> FIFO of T0 ──┐
//         ──> FIFO of T1 ──┤ a command starts at the head of all the FIFOs it is in
//         ──> ...          ┘
//                └─> one module: a move, a homing          (motion/axis.h)
//                └─> a group: a line, an arc, a spiral     (motion/coordinated.h), up to three at a time
//                └─> at once: outputs, coordinates, motor control
//
// A running command stays at the head until it is done. Jogs and thrust are not queued.
//
// Coordinates, distances and path speeds are in user units, VM and VJ in RPM or RPS as FU says, angles in
// degrees. Modules are 0 .. 7, outputs 1 .. 4, as in the commands. All commands come between ticks. They
// return Error::none, or they are refused and change nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/pauses.h"
#include "motion/axis.h"
#include "motion/coordinated.h"

namespace understudy::emulator::models::slim {

/// Axis letters.
enum class Letter : std::uint8_t { x, y, z, w };

/// The value of assign() for "no module".
inline constexpr int kUnassigned = 8;
/// Modules 0 .. 5 can be coordinated.
inline constexpr int kMappable = 6;

/// ?MD.
enum class Mode : std::uint8_t { idle = 0, position = 1, jog = 2, torque = 3, coordinated = 4, analog = 5 };

/// The bits of ?ST that the chain determines.
struct ModuleStatus {
  bool servo_on = false;
  bool moving = false;
  bool paused = false;  // by TAPZ, or by PZ within its scope
  bool homed = false;
  bool jog = false;
  bool buffer_not_empty = false;
  bool in_blend = false;  // the path passes through several commands without stopping
  Mode mode = Mode::idle;

  bool operator==(const ModuleStatus&) const = default;
};

/// An arc, a helix (with `height_units`) or a spiral about a centre, in X and Y.
struct ArcOrder {
  bool absolute = true;  // applies to centre and height; false: relative to the arc's beginning
  double centre_x_units = 0;
  double centre_y_units = 0;
  double sweep_deg = 0;  // > 0 counter-clockwise
  std::optional<double> height_units{};
  // by choice: the centre is the end, and the radius determines the sweep
  std::optional<double> radius_units{};
};

class Chain {
 public:
  /// Module 0 is always linked.
  explicit Chain(const ChainOptions& options = {});
  bool operator==(const Chain&) const = default;

  // ---- One module, by number. Refused with not_assigned for a module other than 0 that has an axis letter.

  Error move(int module, bool absolute, double units);
  Error home(int module);
  /// `direction` is +1 for JGF, -1 for JGR, 0 for JG0.
  Error jog(int module, int direction);
  Error thrust(int module, std::int32_t force);  // 1 .. 20000
  Error set_coordinate(int module, double units);
  /// XMA, XMR ...: moves the module that has the letter now.
  Error move_axis(Letter letter, bool absolute, double units);

  /// HON and HOFF wait for their turn in the FIFO. IHON and IHOFF act at once; IHOFF discards the module's
  /// motion and FIFO.
  Error set_servo(int module, bool on);
  Error set_servo_at_once(int module, bool on);
  /// RESET: stops at once, discards the FIFO, and sets motor control as after power-up.
  Error reset(int module);

  // ---- Outputs 1 .. 4 of a module

  Error set_output(int module, int output, bool on);          // SET, CLR: queued
  Error set_output_at_once(int module, int output, bool on);  // ISET, ICLR
  Error toggle_output(int module, int output);
  Error pulse_output(int module, int output, std::int32_t width_4ms);  // >= 1
  Error pwm(int module, int output, double frequency_hz, double duty_percent);
  Error set_outputs(int module, int mask);  // 0 .. 15
  /// P1SET, P2SET, P1CLR, P2CLR (`trigger` 1 or 2): queued, armed when their turn comes.
  Error arm(int module, int trigger, int output, bool sets, double at_units);

  // ---- Coordinated

  /// TX= ...: `module` is 0 .. 5 or kUnassigned.
  Error assign(Letter letter, int module);
  int assigned(Letter letter) const;  // kUnassigned: none
  /// Takes two to four coordinates: X, Y, Z, W.
  Error line(std::span<const double> units, bool absolute);
  Error arc(const ArcOrder& order);
  /// `growth_units` is the growth of the radius, in a turn or in all. By choice `sweep_deg` is the radius at
  /// the end.
  Error spiral(double centre_x_units, double centre_y_units, double sweep_deg, double growth_units);
  /// CM: `mode` is 0, 1 or 2.
  Error set_continuous_path(int mode);

  // ---- Stopping and continuing: pauses.h

  Error pause() { return steer(InPause::tapz); }
  Error resume() { return steer(InPause::taredo); }
  Error discard() { return steer(InPause::taupz); }
  Error emergency_stop() { return steer(InPause::tastop); }
  Error pause_queues() { return steer(InPause::pz); }
  Error resume_queues() { return steer(InPause::redo); }
  Error clear_queues() { return steer(InPause::clear_buffer); }

  // ---- Settings. Ranges are those of ModuleSettings.

  void set_linked(int module, bool linked);
  /// Refused while the module moves or has a command to do.
  Error set_scale(int module, std::int64_t multiplier, std::int64_t divider);
  Error set_pulses_per_revolution(int module, std::int32_t pulses);
  Error set_speed_unit(int module, SpeedUnit unit);
  Error set_working_speed(int module, double rpm_or_rps);  // ends AVM
  Error set_jog_speed(int module, double rpm_or_rps);
  Error set_acceleration(int module, double rpm_or_rps_per_s);
  Error set_path_speed(int module, double units_s);  // PR3 of one module, and of the path that it is on
  Error set_line_speed(int module, double units_s);  // PR4; by choice also for lines of two axes
  Error set_tvm(double units_s);                     // for all linked modules, at once
  Error set_path_acceleration(int module, double units_s2);  // PR2, TVA: the running path keeps its own
  Error set_smooth_corner(int module, double degrees);       // PR7, 0 .. 180
  Error set_analog_speed(int module);                        // AVM
  void set_options(const ChainOptions& options);             // FIFOs that are longer than allowed stay so

  // ---- Inputs, between ticks

  void set_horg(int module, bool on);
  void set_analog(int module, int value);  // clamped to 0 .. kFullAnalog
  /// Returns the environment, for zones along the travel, whose edges are handled at their pulse. Raise the
  /// version after a change.
  motion::Environment& environment(int module) { return environment_[at(module)]; }

  // ---- State

  const ModuleSettings& settings(int module) const { return modules_[at(module)].settings; }
  bool linked(int module) const { return modules_[at(module)].linked; }
  bool full(int module) const;
  std::size_t queued(int module) const { return modules_[at(module)].fifo.size(); }
  /// DN: returns true if all earlier commands are completed. A jog or thrust does not count, unless it is
  /// stopping.
  bool done(int module) const;
  /// Returns true if the module does something, or a command waits for it.
  bool busy(int module) const;
  bool moving(int module) const;
  /// Returns the activity of the module, or the activity that a pause holds.
  Activity activity_or_held(int module) const;
  bool servo_on(int module) const { return axes_[at(module)].servo_on; }
  bool paused() const { return paused_; }
  bool queues_paused() const { return queues_paused_; }
  bool horg(int module) const {
    return (environment_[at(module)].steady & motion::bit(motion::Signal::home)) != 0;
  }
  int analog(int module) const { return modules_[at(module)].analog; }
  bool analog_speed(int module) const { return modules_[at(module)].analog_speed; }
  ContinuousPath continuous_path() const { return continuous_; }
  /// Returns true if, by choice, lines of two axes go by PR4, not PR3.
  bool lines_have_own_speed() const { return options_.chose(option("line_speed", "pr4_of_its_own")); }
  ModuleStatus status(int module) const;
  double coordinate(int module) const;
  std::int64_t travel(int module) const { return axes_[at(module)].travel_pulses; }
  double speed_pps(int module) const;  // signed
  std::int64_t pulses_to_come(int module) const;
  std::int32_t thrust_of(int module) const { return modules_[at(module)].thrust; }
  bool output(int module, int number) const;  // level after the last tick
  const Output& output_state(int module, int number) const;
  /// Returns the error for which a queued command was dropped when its turn came, and resets it to none.
  Error take_late_error(int module);
  int groups_running() const;
  const motion::Axis& axis(int module) const { return axes_[at(module)]; }

  // ---- Time

  /// Runs one tick; ticks up to next_active_tick() may be skipped.
  void step(Tick tick);
  /// Like stepping all ticks up to `now`, in which nothing may happen; later commands count from `now`.
  void skip_to(Tick now) { now_ = now; }
  std::int64_t pulses(int module) const { return modules_[at(module)].sent_pulses; }  // of the last tick
  /// Returns the first tick after `done` at which something may happen without a command, or kNever.
  Tick next_active_tick(Tick done) const;
  /// Like next_active_tick(), while modules only continue their motion within the free travel of their
  /// machines; at most `most` + 1.
  Tick next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const;
  /// Runs all ticks up to `tick`, before that event, in one step. Adds the pulses of each module.
  void fast_forward_to(Tick tick, std::span<std::int64_t> pulses);

 private:
  template <class T>
  friend struct understudy::StateOf;  // chain_fields.h

  /// A coordinated motion. Its paths are the heads of its modules' FIFOs, one after another.
  struct Group {
    motion::Coordinated motion;
    std::uint8_t paths = 0;                     // how many of the FIFOs' heads are its paths
    motion::Point end = motion::Point::Zero();  // end of the last path

    bool operator==(const Group&) const = default;
  };

  static std::size_t at(int module) { return static_cast<std::size_t>(module); }

  // Options that are looked up in several places.
  bool has_servo_at_power_up() const { return !options_.chose(option("power_up_servo", "off")); }
  bool reserves_moves_only() const { return options_.chose(option("reserved_module", "moves_by_number")); }
  bool thrust_runs() const { return options_.chose(option("thrust", "runs_at_vj")); }
  bool new_speed_counts_at_once() const { return options_.chose(option("new_speed", "at_once")); }
  bool speeds_are_of_t0() const { return options_.chose(option("unequal_speeds", "as_t0_has_them")); }
  bool acceleration_may_change() const {
    return options_.chose(option("acceleration_in_motion", "next_command"));
  }
  bool triggers_stay() const {
    return options_.chose(option("position_outputs", "each_time_from_either_side_on_the_commanded_position"));
  }
  bool is_refused_as_empty(const motion::Path& path) const {
    return path.length_u == 0 && options_.chose(option("path_without_length", "error_2"));
  }
  bool in_pause_scope(int module) const {
    return module == 0 || !options_.chose(option("pause_scope", "t0"));
  }
  bool in_pause_scope(const Group& group) const;
  /// Returns the pauses of a module or a group: TAPZ, and PZ within its scope.
  Pauses pauses_of(const auto& what) const {
    return slim::pauses_of(queues_paused_ && in_pause_scope(what), paused_);
  }
  bool held(const auto& what) const { return pauses_of(what) != Pauses::none; }

  // Commands: chain_commands.cpp, chain_coordinated.cpp, chain_outputs.cpp.
  Error refusal(int module) const;                                            // of any command
  Error refusal_of_motion(int module, InPause what = InPause::motion) const;  // of a motion
  Error refusal_by_number(int module, InPause what = InPause::motion) const;  // of a motion by module number
  Error refusal_of_jog(int module) const;                                     // of a jog or thrust
  bool mapped(int module) const;
  bool servo_expected(int module) const;  // after all queued commands
  double end_expected(int module) const;
  Error enqueue(Job job);  // in the FIFOs of module_of
  Error enqueue_move(int module, bool absolute, double units);
  Error enqueue_output(int module, const OutputOrder& order);
  Error enqueue_coordinated(Job job);
  Error replace_jog(int module, int direction, std::int32_t force);
  void begin_jog(int module, int direction, Tick begin_at);
  void begin_thrust(int module, std::int32_t force, Tick begin_at);
  void begin_next(int module, Tick begin_at);
  void stop_jog(int module);
  void hold_jog(int module);
  void go_on_with_jog(int module);
  void order_jog(int module, int direction, std::int32_t force);

  // Queues: chain_queues.cpp.
  void serve(Tick begin_at);  // starts the commands that can start; they begin at that tick
  // These four return true if the FIFO has changed.
  bool serve_head(int module, Tick begin_at);
  bool start_move(int module, Tick begin_at);
  bool start_home(int module, Tick begin_at);
  bool start_group(int module, Tick begin_at);
  void extend(Group& group);
  void note_ends(const Job& job, std::size_t place, const motion::Point& end);
  bool at_all_places(const Job& job, std::size_t place) const;
  bool free_to_move(int module) const;
  const ModuleSettings& path_settings(const Job& job) const;
  bool goes_by_line_speed(const Job& job) const;
  double path_speed(const Job& job, const ModuleSettings& settings) const;
  void tell_path(int module, double units_s, bool of_lines);
  bool within_reach(const Job& job, const motion::Path& path) const;
  motion::Point begin_of(const Job& job) const;
  void carry_out_order(int module, const OutputOrder& order, Tick begin_at);
  void place_triggers(int module);
  void put_coordinate(int module, double units);
  void home_found(int module);
  void drop_job(std::uint64_t number);
  void drop_head(int module, Error why);

  // Stopping: chain_stops.cpp.
  Error steer(InPause what);
  void give_up(bool in_scope_only);
  void clear_waiting();
  void stop_all();
  void stop_outputs(int module);
  void hold();
  void release();
  void cut(int module, motion::Cause why);              // no more pulses; drops the running command
  void forget_queue(int module, std::size_t kept = 0);  // after the first `kept`
  void end_group(Group& group, motion::Cause why);
  void release_group(Group& group, Tick begin_at);
  void slow_for_discard(int module);
  Group* group_of(int module);
  const Group* group_of(int module) const;
  void refresh_speed(int module);

  // The tick: chain_step.cpp.
  void step_groups();
  bool undisturbed(int module) const;
  bool waits(int module) const;
  bool stands(const Group& group, Tick done) const;
  void step_axes(Tick tick);
  void after_motion(int module, Tick begin_at);
  void meet_triggers(int module, motion::Events events);
  void step_motion(std::uint32_t singles, motion::Coordinated* path, std::span<std::int64_t> pulses);

  ChainOptions options_;
  std::array<Module, kModules> modules_{};
  std::array<motion::Axis, kModules> axes_{};
  std::array<motion::Environment, kModules> environment_{};
  std::array<Group, kMappable / 2> groups_{};
  std::array<std::int8_t, kLetters> map_{kNoModule, kNoModule, kNoModule, kNoModule};
  ContinuousPath continuous_ = ContinuousPath::off;
  bool paused_ = false;
  bool queues_paused_ = false;
  std::uint64_t last_number_ = 0;
  Tick now_ = 0;
};

}  // namespace understudy::emulator::models::slim
