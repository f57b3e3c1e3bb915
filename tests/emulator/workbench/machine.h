// The motors of the made-up controller. They detect edges at the exact pulse; B counts against the motor's
// direction. A hand wheel turns A while A follows it; an output sends a pulse for every tenth pulse of A.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/state/fields.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/machine_edges.h"
#include "motion/axis.h"
#include "motion/state_fields.h"
#include "tests/emulator/workbench/machine_terminals.h"

namespace understudy::emulator::workbench {

struct Motor {
  motion::Axis axis{};
  motion::Environment environment{};
  std::int64_t sent_pulses = 0;  // pulses sent in the last tick

  bool operator==(const Motor&) const = default;
};

struct MotorsState {
  std::array<Motor, kMotorCount> motors{};
  std::int32_t wheel_seen = 0;
  std::int32_t external_seen = 0;
  std::int64_t external_edges = 0;
  std::int64_t compared = 0;    // the output's pulses
  std::uint8_t low_active = 0;  // a bit for each MotorInput that is active at level 0

  bool operator==(const MotorsState&) const = default;
};

class Motors {
 public:
  static constexpr std::int64_t kComparedEvery = 10;
  static constexpr std::size_t kReversed = 1;

  /// The state must outlive this object.
  explicit Motors(MotorsState& its) : state(its) {
    for (Motor& motor : state.motors) motor.axis.servo_on = true;
    state.motors[kReversed].axis.inverted = true;
  }

  /// Updates a motor's environment: zones for inputs that depend on the position, levels for the others.
  void update_environment(const Device& device, std::size_t number) {
    struct Function {
      MotorInput input;
      motion::Signal signal;
      motion::Signal reversed;
    };
    using motion::Signal;
    static constexpr Function kFunctions[] = {{kUpper, Signal::limit_plus, Signal::limit_minus},
                                              {kLower, Signal::limit_minus, Signal::limit_plus},
                                              {kHome, Signal::home, Signal::home},
                                              {kNear, Signal::near_home, Signal::near_home},
                                              {kMark, Signal::mark, Signal::mark},
                                              {kIndex, Signal::index, Signal::index}};
    const MachineEdges& edges = edges_[number];
    motion::Environment now;
    for (const Function& function : kFunctions) {
      const int input = motor_input(number, function.input);
      const bool active_level = (state.low_active >> function.input & 1) == 0;
      const Signal signal = number == kReversed ? function.reversed : function.signal;
      if (const MachineEdges::Span* const span = edges.span_of(input)) {
        const bool is_inside = span->level_inside == active_level;
        (is_inside ? now.add(signal, span->first, span->last, span->slack)
                   : now.add_outside(signal, span->first, span->last, span->slack));
      } else if (edges.index.period != 0 && edges.index.input == input) {
        now.index_period = edges.index.period;
        now.index_at = edges.index.at;
        now.index_width = edges.index.width;
        now.index_from = edges.index.first;
        now.index_to = edges.index.last;
      } else {
        now.set_steady(signal, (device.input(input) != 0) == active_level);
      }
    }
    motion::Environment& environment = state.motors[number].environment;
    now.version = environment.version;
    if (now == environment) return;
    ++now.version;
    environment = now;
  }

  void check_inputs(const Device& device) {
    for (std::size_t i = 0; i < kMotorCount; ++i) update_environment(device, i);
    const std::int32_t turned = difference(device.input(kHandWheel), state.wheel_seen);
    state.wheel_seen = device.input(kHandWheel);
    motion::Axis& axis = state.motors[0].axis;
    if (turned != 0 && axis.task == motion::Task::following) axis.feed(turned);
    state.external_edges += std::abs(difference(device.input(kExternal), state.external_seen));
    state.external_seen = device.input(kExternal);
  }

  void set_edges(const Device& device, std::size_t number, const MachineEdges& edges) {
    edges_[number] = number == kReversed ? edges.reversed() : edges;
    update_environment(device, number);
  }
  std::int64_t place_pulses(std::size_t number) const {
    const std::int64_t travel = state.motors[number].axis.travel_pulses;
    return number == kReversed ? -travel : travel;
  }

  void step(Tick tick) {
    const std::int64_t before = state.motors[0].axis.travel_pulses;
    for (Motor& motor : state.motors) motor.sent_pulses = motor.axis.step(tick, motor.environment);
    compare(before);
  }

  bool is_quiet() const {
    return std::all_of(state.motors.begin(), state.motors.end(), [](const Motor& motor) {
      const motion::Axis& axis = motor.axis;
      return !axis.moving() && !axis.must_recheck && axis.events == 0 && axis.events_between == 0 &&
             motor.sent_pulses == 0 && motor.environment.version == axis.seen_version;
    });
  }

  Tick next_event_tick(Tick done, Tick max, const ClearTravel& ahead) const {
    Tick last = max;
    for (std::size_t i = 0; i < kMotorCount && last > done; ++i) {
      const motion::Axis& axis = state.motors[i].axis;
      PulseRoom room = ahead.room(static_cast<int>(i));
      if (i == kReversed) room = {.min = -room.max, .max = -room.min};
      last = axis.quiet_until(done + 1, last, state.motors[i].environment,
                              {.low = axis.travel_pulses + room.min, .high = axis.travel_pulses + room.max});
    }
    return last + 1;
  }

  void fast_forward_to(Tick tick, std::span<std::int64_t> pulses) {
    const std::int64_t before = state.motors[0].axis.travel_pulses;
    for (std::size_t i = 0; i < kMotorCount; ++i) {
      Motor& motor = state.motors[i];
      pulses[i] += motor.axis.fast_forward_to(tick - 1);
      motor.sent_pulses = motor.axis.step(tick, motor.environment);
      pulses[i] += motor.sent_pulses;
    }
    compare(before);
  }

  MotorsState& state;

 private:
  /// Returns the difference of two counts that wrap at 32 bits.
  static std::int32_t difference(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
  }
  static std::int64_t tenth(std::int64_t travel) {
    return travel / kComparedEvery - (travel % kComparedEvery < 0 ? 1 : 0);
  }
  void compare(std::int64_t before) {
    state.compared += std::abs(tenth(state.motors[0].axis.travel_pulses) - tenth(before));
  }

  std::array<MachineEdges, kMotorCount> edges_{};  // not state: they are computed again
};

}  // namespace understudy::emulator::workbench

namespace understudy {

template <>
struct StateOf<emulator::workbench::Motor> {
  using Value = emulator::workbench::Motor;
  static constexpr auto fields =
      FieldList{field<&Value::axis>(), field<&Value::environment>(), field<&Value::sent_pulses>()};
};

template <>
struct StateOf<emulator::workbench::MotorsState> {
  using Value = emulator::workbench::MotorsState;
  static constexpr auto fields =
      FieldList{field<&Value::motors>(),         field<&Value::wheel_seen>(), field<&Value::external_seen>(),
                field<&Value::external_edges>(), field<&Value::compared>(),   field<&Value::low_active>()};
};

}  // namespace understudy
