// RS-M8194H: the motion chip with its four axes. It contains motors, counters, pins behind their filters, the
// signals that affect the motors, the path that carries some of the motors, and the outputs of X and Y.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "base/simulated_time.h"
#include "emulator/device/machine_edges.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/move.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

/// Triggers at equal distances along an axis (7.4.12).
struct LineScan {
  bool set = false;
  std::uint8_t type = 0;
  std::int32_t pitch = 0;
  bool running = false;
  std::int64_t begin = 0;      // travel at which it began
  std::int64_t triggered = 0;  // how many trigger positions were passed
  // The SET_OUT settings of its pin before the scan.
  std::uint8_t level_before = 0;
  std::uint8_t width_before = 0;

  bool operator==(const LineScan&) const = default;
};

struct ChipState {
  std::array<motion::Axis, kAxes> motors{};
  std::array<motion::Environment, kAxes> environment{};
  std::array<AxisUnit, kAxes> units{};
  motion::SyncTable sync{};
  Paths paths{};
  std::array<LineScan, kAxes> scans{};
  AxisMask scanning = 0;         // axes in LINE_SCAN_START
  bool holds_back = false;       // a filter holds back the level of an input
  bool emergency_input = false;  // EMG is active, before the filters
  Tick emergency_since = 0;      // when that last changed

  bool operator==(const ChipState&) const = default;
};

class Chip final : public Part {
 public:
  Chip(const Ground& ground, ChipState& state) : Part(ground), state_(state) {}

  AxisUnit& unit(std::size_t axis) { return state_.units[axis]; }
  const AxisUnit& unit(std::size_t axis) const { return state_.units[axis]; }
  motion::Axis& motor(std::size_t axis) { return state_.motors[axis]; }
  const motion::Axis& motor(std::size_t axis) const { return state_.motors[axis]; }
  LineScan& scan(std::size_t axis) { return state_.scans[axis]; }
  const LineScan& scan(std::size_t axis) const { return state_.scans[axis]; }
  const motion::Environment& environment(std::size_t axis) const { return state_.environment[axis]; }
  ChipState& state() { return state_; }
  const ChipState& state() const { return state_; }
  Paths& paths() { return state_.paths; }
  const Paths& paths() const { return state_.paths; }
  motion::SyncTable& sync() { return state_.sync; }
  const motion::SyncTable& sync() const { return state_.sync; }

  Activity activity(std::size_t axis) const;
  bool is_driving(std::size_t axis) const { return activity(axis) != Activity::idle; }
  AxisMask driving() const;
  /// Returns the signed speed of an axis.
  double speed_pps(std::size_t axis) const;
  /// Returns the speed law for drives of single axes.
  motion::SpeedLaw law_of(std::size_t axis) const;
  bool is_active(std::size_t axis, motion::Signal signal) const;
  /// Adds causes of a stop to ERROR_CODE.
  void add_errors(std::size_t axis, std::uint16_t bits);
  /// Returns ERROR_CODE as hosts read it.
  std::uint16_t error_code(std::size_t axis) const;

  // --- pins (pins.cpp) -------------------------------------------------------------------------
  void pass_pins(Tick tick);
  /// Returns true if the filter of a pin delays it.
  bool is_filtered(std::size_t axis, Pin pin) const;
  /// Returns true while a filter holds back the level of an input.
  bool is_filtering(std::size_t axis) const;
  bool holds_back() const { return state_.holds_back; }
  /// Passes all levels immediately, as at power-up.
  void pass_all_pins();
  /// Updates the signals that affect the motor. Call this after inputs or their settings have changed.
  void update_environment(std::size_t axis);
  /// Updates the limits and comparators of the motor, and the signals that affect it. Call this after a
  /// setting or a counter has changed.
  void rearm(std::size_t axis);
  void rearm_all();
  /// Sets the positions at which a machine's inputs change.
  void set_edges(std::size_t axis, const MachineEdges& edges);

  // --- the bench's encoder ----------------------------------------------------------------------
  void connect_encoder(std::size_t axis, std::int64_t counts);
  void set_encoder(std::size_t axis, std::int64_t counts);

  /// Outputs pulses at OUT_X or OUT_Y; other axes have no output (7.3.9).
  void give_pulse(std::size_t axis, Tick tick, std::int64_t pulses = 1);

  // --- power and RESET_CARD ----------------------------------------------------------------------
  /// Resets everything except positions, pins and the bench's encoder, and applies these settings of section
  /// 3.
  void blank(const std::array<BasicSettings, kAxes>& basic);
  void keep_counters_of(const ChipState& before);
  void keep_settings_of(const ChipState& before);

 private:
  void blank_axis(std::size_t axis, const BasicSettings& basic);

  ChipState& state_;
  // Not part of the state, because it is set again after a restore. It is allocated separately, because a
  // tick reads it only after an input has changed.
  const std::unique_ptr<std::array<MachineEdges, kAxes>> edges_ =
      std::make_unique<std::array<MachineEdges, kAxes>>();
};

}  // namespace understudy::emulator::models::rs_m8194h
