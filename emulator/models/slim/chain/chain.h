// A chain of up to eight SLIM modules as a value: its commands, but not their text form.
//
//   issued ──> FIFO of T0 ──┐
//         ──> FIFO of T1 ──┤ a command starts when it is at the head of all its FIFOs
//         ──> ...          ┘
//                └─> one module: a move, a homing          (motion/axis.h)
//                └─> a group: a line, an arc, a spiral     (motion/coordinated.h), up to three at a time
//                └─> immediate: outputs, coordinates, motor control
//
// A running command stays at the head until it has finished. Jogs and thrust are not queued.
//
// Coordinates, distances and path speeds are in user units, VM and VJ in RPM or RPS (depending on FU), angles
// in degrees. Modules are 0 .. 7 and outputs 1 .. 4, as in the commands. All commands are executed between
// ticks. They return Error::none, or are refused without changing anything.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/queues.h"
#include "emulator/models/slim/chain/settings.h"
#include "emulator/models/slim/chain/stops.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/pauses.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::slim {

/// Axis letters.
enum class Letter : std::uint8_t { x, y, z, w };

/// The value of assign() for "no module".
inline constexpr int kUnassigned = 8;

/// The values of ?MD.
enum class Mode : std::uint8_t { idle = 0, position = 1, jog = 2, torque = 3, coordinated = 4, analog = 5 };

/// The bits of ?ST that the chain determines.
struct ModuleStatus {
  bool servo_on = false;
  bool moving = false;
  bool paused = false;  // by TAPZ, or by PZ if the module is in its scope
  bool homed = false;
  bool jog = false;
  bool buffer_not_empty = false;
  bool in_blend = false;  // the path continues through several commands without stopping
  Mode mode = Mode::idle;

  bool operator==(const ModuleStatus&) const = default;
};

/// An arc, a helix (with `height_units`) or a spiral about a centre, in X and Y.
struct ArcOrder {
  bool absolute = true;  // applies to centre and height; false: relative to the beginning of the arc
  double centre_x_units = 0;
  double centre_y_units = 0;
  double sweep_deg = 0;  // > 0 counter-clockwise
  std::optional<double> height_units{};
  // a choice: the centre is the end, and the radius determines the sweep
  std::optional<double> radius_units{};
};

class Chain {
 public:
  /// Module 0 is always linked.
  explicit Chain(const ChainOptions& options = {});
  bool operator==(const Chain&) const = default;

  // ---- One module, by number. Modules other than 0 that have an axis letter are refused with not_assigned.

  Error move(int module, bool absolute, double units);
  Error home(int module);
  /// `direction` is +1 for JGF, -1 for JGR, 0 for JG0.
  Error jog(int module, int direction);
  Error thrust(int module, std::int32_t force);  // 1 .. 20000
  Error set_coordinate(int module, double units);
  /// XMA, XMR ...: moves the module that has this letter.
  Error move_axis(Letter letter, bool absolute, double units);

  /// HON and HOFF wait in the FIFO. IHON and IHOFF are executed immediately; IHOFF discards the module's
  /// motion and FIFO.
  Error set_servo(int module, bool on);
  Error set_servo_at_once(int module, bool on);
  /// RESET: stops at once, discards the FIFO, and resets motor control as after power-up.
  Error reset(int module);

  // ---- Outputs 1 .. 4 of a module

  Error set_output(int module, int output, bool on);          // SET, CLR: queued
  Error set_output_at_once(int module, int output, bool on);  // ISET, ICLR
  Error toggle_output(int module, int output);
  Error pulse_output(int module, int output, std::int32_t width_4ms);  // >= 1
  Error pwm(int module, int output, double frequency_hz, double duty_percent);
  Error set_outputs(int module, int mask);  // 0 .. 15
  /// P1SET, P2SET, P1CLR, P2CLR (`trigger` 1 or 2): queued, and armed when they reach the head.
  Error arm(int module, int trigger, int output, bool sets, double at_units);

  // ---- Coordinated

  /// TX= ...: `module` is 0 .. 5 or kUnassigned.
  Error assign(Letter letter, int module);
  int assigned(Letter letter) const;  // kUnassigned: none
  /// Takes two to four coordinates: X, Y, Z, W.
  Error line(std::span<const double> units, bool absolute);
  Error arc(const ArcOrder& order);
  /// `growth_units` is the growth of the radius, per turn or in total (a choice). A choice can make
  /// `sweep_deg` the radius at the end.
  Error spiral(double centre_x_units, double centre_y_units, double sweep_deg, double growth_units);
  /// CM: `mode` is 0, 1 or 2.
  Error set_continuous_path(int mode);

  // ---- Stopping and continuing: stops.h

  Error pause() { return steer(state_, InPause::tapz); }
  Error resume() { return steer(state_, InPause::taredo); }
  Error discard() { return steer(state_, InPause::taupz); }
  Error emergency_stop() { return steer(state_, InPause::tastop); }
  Error pause_queues() { return steer(state_, InPause::pz); }
  Error resume_queues() { return steer(state_, InPause::redo); }
  Error clear_queues() { return steer(state_, InPause::clear_buffer); }

  // ---- Settings

  ChainSettings settings() { return ChainSettings(state_); }
  Error set_analog_speed(int module);             // AVM
  void set_options(const ChainOptions& options);  // FIFOs that are longer than allowed keep their commands

  // ---- Inputs, between ticks

  void set_horg(int module, bool on);
  void set_analog(int module, int value);  // clamped to 0 .. kFullAnalog
  /// Returns the environment, for setting zones along the travel, whose edges are handled at their pulse.
  /// Increment the version after a change.
  motion::Environment& environment(int module) { return state_.environment[at(module)]; }

  // ---- State

  /// Returns the module, with its FIFO, settings, activity and the pulses of the last tick.
  const Module& module_at(int module) const { return state_.modules[at(module)]; }
  const motion::Axis& axis(int module) const { return state_.axes[at(module)]; }
  const ChainOptions& options() const { return state_.options; }
  bool linked(int module) const { return state_.modules[at(module)].linked; }
  bool full(int module) const { return is_full(state_, module); }
  /// DN: returns true if all earlier commands have finished. A jog or thrust does not count, unless it is
  /// stopping.
  bool done(int module) const;
  /// Returns true if the module is active, or a command is waiting for it.
  bool busy(int module) const { return state_.modules[at(module)].busy(); }
  bool moving(int module) const;
  bool paused() const { return state_.paused; }
  bool queues_paused() const { return state_.queues_paused; }
  bool horg(int module) const {
    return (state_.environment[at(module)].steady & motion::bit(motion::Signal::home)) != 0;
  }
  ModuleStatus status(int module) const;
  double coordinate(int module) const {
    return state_.modules[at(module)].coordinate(state_.axes[at(module)]);
  }
  double speed_pps(int module) const;  // signed
  std::int64_t pulses_to_come(int module) const;
  /// Returns the level after the last tick. This is defined here so that the compiler can inline it, because
  /// it is called at every tick.
  bool output(int module, int number) const {
    return state_.modules[at(module)].outputs[at(number - 1)].level_at(state_.now);
  }
  /// Returns the error because of which a queued command was dropped when it reached the head, and resets it
  /// to none.
  Error take_late_error(int module);
  int groups_running() const;

  // ---- Time

  /// Runs one tick. Ticks before next_active_tick() may be skipped.
  void step(Tick tick);
  /// Skips all ticks up to `now`, in which nothing may happen. Later commands count from `now`.
  void skip_to(Tick now) { state_.now = now; }
  /// Returns the first tick after `done` in which something may happen without a command, or kNever.
  Tick next_active_tick(Tick done) const;
  /// Like next_active_tick(), but also skips ticks in which modules only continue their motion within the
  /// free travel of their machines. Returns at most `limit` + 1.
  Tick next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const;
  /// Runs all ticks up to `tick` in one step; `tick` must be before next_event_tick(). Adds the pulses of
  /// each module to `pulses`.
  void fast_forward_to(Tick tick, std::span<std::int64_t> pulses);

 private:
  template <class T>
  friend struct understudy::StateOf;  // chain_fields.h

  ChainState state_;
};

}  // namespace understudy::emulator::models::slim
