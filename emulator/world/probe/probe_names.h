// The names of the values that can be read from a world without using its lines: for expressions in
// scenarios, fault triggers, `ctl run-until` and traces. The inventory (view/inventory.h) is enough to
// resolve the names; probes.h reads the values.
//
//   time                       simulated time, a duration
//   feeder.Cord_A, .STATUS.4   registers and their bits, as a host would read them now; .0x1000 by address
//   robot.T2PE                 values of devices without registers (NamedValues)
//   feeder.DIN_3, .AIN_A       terminals: inputs (analog ones are voltages), outputs, switches; a register
//                              of the same name takes precedence; for a counted input, its count modulo 2^32
//   mill.CMP.pulses            pulses sent by an output whose pulses are counted
//   mill.DI_8                  a group of terminals as one word
//   feeder.A.pulses            pulses that axis A has sent since the world began, in the motor's direction
//   feeder.A.target            the value of .pulses at the end of its move or path; equal to .pulses if the
//                              end is not known
//   feeder.A.speed             its planned speed, in pulses per second, real
//   feeder.A.servo             1 while the device has its servo on; if the model has one
//   feeder.A.pwm               its duty cycle in percent, 0 outside PWM mode; if the model has one
//   feeder.A.greatest_speed, .greatest_acceleration    the planned maximum so far, as magnitudes, real; in
//                              scenarios, since the beginning or the last `reset: peaks`
//   feeder.A.position          the machine's position, in pulses; .lost: pulses that did not move it
//   feeder.A.encoder           its encoder's count
//   feeder.A.home, .upper_limit, .lower_limit, .ready, .alarm     its switches and its drive; and
//                              .near_home, .mark, .index if it has them
//   feeder.power               1 while it has power
//   feeder.pulse_format        the present pulse format, by number; if the model has several
//   feeder.requests, .replies, .exceptions    of its stations
//   rs485.bytes_in, .bytes_out, .collisions   of a line
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "emulator/world/expression/expression.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

class ProbeNames final : public NameResolver {
 public:
  enum class What : std::uint8_t {
    time,
    reg,
    named,
    input,
    output,
    output_pulses,
    terminal_group,
    pulses,
    target,
    speed,
    servo,
    pwm,
    greatest_speed,
    greatest_acceleration,
    position,
    lost,
    encoder,
    home,
    upper_limit,
    lower_limit,
    near_home,
    mark,
    index,
    ready,
    alarm,
    power,
    pulse_format,
    requests,
    replies,
    exceptions,
    bytes_in,
    bytes_out,
    collisions,
  };
  struct Probe {
    What what = What::time;
    std::size_t device = 0;  // the device, or the line
    int place = 0;           // the axis or terminal
    NamedPlace reg{};
    const TerminalGroup* group = nullptr;
    std::string value_name{};
    Unit unit = Unit::none;
    std::string name;
  };

  /// The inventory must outlive this object.
  explicit ProbeNames(const Inventory& inventory) : inventory_(inventory) {}

  /// Throws NameError. A name that was resolved before gets the same handle.
  NamedNumber resolve(std::string_view name) const override;
  const Probe& probe(std::int32_t handle) const { return probes_[static_cast<std::size_t>(handle)]; }
  /// Returns true if the value exists only in scenarios.
  bool is_of_scenarios(std::int32_t handle) const;

 private:
  Probe find(std::string_view name) const;
  bool find_of_axis(std::string_view rest, Probe& probe) const;
  bool find_of_terminal(const Model& model, std::string_view rest, Probe& probe) const;

  const Inventory& inventory_;
  mutable std::vector<Probe> probes_;                              // by handle
  mutable std::unordered_map<std::string, std::int32_t> handles_;  // by name; looked up, never iterated
};

}  // namespace understudy::emulator::world
