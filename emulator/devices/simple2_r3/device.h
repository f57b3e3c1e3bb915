// Simple2-R3: a two-axis pulse controller on Modbus RTU. Its state is one value; what registers do is in
// effects.cpp, what a tick does in device.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/device.h"
#include "emulator/devices/simple2_r3/registers.h"
#include "motion/pulse_drive.h"

namespace understudy::emulator::simple2_r3 {

inline constexpr int kInputCount = 11;
inline constexpr int kOutputCount = 7;

enum class Command : std::uint8_t { none, incremental, absolute };

struct AxisState {
  motion::PulseDrive motor;
  Command command = Command::none;  // whose trigger register reads 1
  bool servo_on = false;
  std::int32_t coordinate_pulses = 0;
  std::int64_t pulses_this_tick = 0;  // as they leave the device: after DIR_Polarity
  Tick alarm_clear_until = 0;         // the first tick at which ACLR is over
  std::int64_t encoder_counts = 0;    // as the plant has them
  std::int64_t encoder_preset = 0;    // what a write to ENCx added

  bool operator==(const AxisState&) const = default;
};

struct State {
  std::array<std::uint32_t, kSlotCount> image{};
  std::array<AxisState, 2> axes;
  std::uint16_t inputs = 0;          // bit n: DIN n, as looked at in this tick
  std::uint8_t written_outputs = 0;  // bit n: the last level written to DOUT n
  bool touched = false;              // registers were written since the last tick

  bool operator==(const State&) const = default;
};

/// Everything that a position move needs, latched when it starts (appendix A).
struct MoveParameters {
  std::int64_t distance_pulses = 0;
  std::uint32_t speed_rpm = 0;
  std::uint32_t acceleration_10ms = 0;
  std::uint32_t deceleration_10ms = 0;
};

class Simple2R3 final : public Device {
 public:
  explicit Simple2R3(const DeviceSettings& settings);

  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  void registers_written() override { state_.touched = true; }

  Addressing addressing(std::uint8_t address) const override;
  pty::LineSettings line_settings() const override;

  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick) override {}
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  bool same_state(const Device& other) const override;

  bool output(int terminal) const override;
  std::int64_t pulses_this_tick(int axis) const override;
  void set_encoder(int axis, std::int64_t counts) override;

  // --- for effects.cpp ---------------------------------------------------------------------
  State& state() { return state_; }
  const State& state() const { return state_; }

  bool alarm(int axis) const;
  bool ready(int axis) const;
  bool upper_limit(int axis) const;
  bool lower_limit(int axis) const;
  bool alarm_clear(int axis) const;
  /// The level really on DOUT `number`, special functions included.
  bool output_level(int number) const;

  /// Appendix A. Dropped while the servo is off, an alarm lasts or a limit blocks that way.
  void start_move(int axis, Command command, const MoveParameters& move);
  void stop(int axis);
  void switch_servo(int axis, bool on);
  void reset_to_factory();

 private:
  /// An input's level, if the register at `assignment_slot` gives it its special function.
  bool assigned_input(std::size_t assignment_slot, int number) const;
  bool blocked(int axis, int direction) const;
  /// Until 1.40 the coordinate counted the motor's sense (firmware note "1.40 以前").
  bool quirk_coordinate_counts_physical_sense() const { return firmware() <= 140; }

  State state_;
};

}  // namespace understudy::emulator::simple2_r3
