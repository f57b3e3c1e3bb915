// Refuses a restored chain with which ticks could index beyond a table or run forever.
#include "emulator/models/slim/chain/chain_fields.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/motor/fifo.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/outputs.h"

namespace understudy {

using namespace emulator::models::slim;

namespace {

void require_coordinate(double units) {
  require_state(std::abs(units) <= 1e16, "a coordinate is out of range");
}

// Also used for accelerations; each quantity has its own unit.
void require_speed(double value) {
  require_state(value >= kMinSpeed && value <= kMaxSpeed, "a speed is out of range");
}

}  // namespace

void StateOf<Group>::write(const Group& group, StateWriter& writer) {
  const auto& [motion, paths, end] = group;
  writer.write(motion.engaged);
  if (!motion.engaged) return;  // a motion that is not engaged is in its initial state
  writer.write(motion);
  writer.write(paths);
  writer.write(end);
}

void StateOf<Group>::read(Group& group, StateReader& reader) {
  auto& [motion, paths, end] = group;
  bool engaged = false;
  group = {};
  reader.read(engaged);
  if (!engaged) return;
  reader.read(motion);
  require_state(motion.engaged, "a group must be engaged");
  reader.read(paths);
  reader.read(end);
  for (const double units : end) require_coordinate(units);
}

void StateOf<Fifo<Job, kFifoLength>>::write(const Fifo<Job, kFifoLength>& fifo, StateWriter& writer) {
  writer.write(static_cast<std::uint8_t>(fifo.size()));
  for (std::size_t i = 0; i < fifo.size(); ++i) writer.write(fifo[i]);
}

void StateOf<Fifo<Job, kFifoLength>>::read(Fifo<Job, kFifoLength>& fifo, StateReader& reader) {
  std::uint8_t count = 0;
  reader.read(count);
  require_state(count <= fifo.capacity(), "a FIFO exceeds its capacity");
  fifo.truncate(0);
  for (Job job; count > 0; --count) {
    reader.read(job);
    fifo.push(job);
  }
}

void StateOf<ModuleSettings>::check(const ModuleSettings& settings) {
  require_within(settings.pulses_per_revolution, 1, INT32_MAX);
  for (const double speed :
       {settings.working_speed, settings.acceleration, settings.path_acceleration_units_s2,
        settings.path_speed_units_s, settings.line_speed_units_s}) {
    require_speed(speed);
  }
  if (settings.jog_speed != 0) require_speed(std::abs(settings.jog_speed));
  require_state(settings.smooth_corner_deg >= 0 && settings.smooth_corner_deg <= 180,
                "an angle is out of range");
}

void StateOf<Output>::check(const Output& output) {
  require_reach(output.since);
  require_within(output.width, 0, INT32_MAX);
  const bool fits = output.frequency_hz >= 0 && output.frequency_hz <= 1e6 && output.duty_percent >= 0 &&
                    output.duty_percent <= 100;
  require_state(fits && (output.mode != Output::Mode::pwm || output.frequency_hz >= 0.001),
                "an output's frequency or duty is out of range");
}

void StateOf<OutputOrder>::check(const OutputOrder& order) {
  require_within(order.output, 0, kOutputs - 1);
  require_within(order.trigger, 0, 1);
  require_coordinate(order.at_units);
  StateOf<Output>::check(
      Output{.mode = order.kind == OutputOrder::Kind::pwm ? Output::Mode::pwm : Output::Mode::level,
             .width = order.width,
             .frequency_hz = order.frequency_hz,
             .duty_percent = order.duty_percent});
}

void StateOf<PositionTrigger>::check(const PositionTrigger& trigger) {
  require_within(trigger.output, 0, kOutputs - 1);
  require_coordinate(trigger.at_units);
}

void StateOf<Job>::check(const Job& job) {
  const int max = job.coordinated() ? kMappable : kModules;
  for (const std::int8_t module : job.module_of) require_within(module, kNoModule, max - 1);
  require_state(job.module_of[0] >= 0, "a command must have a module");
  if (job.coordinated()) require_state(job.module_of[1] >= 0, "a coordinated command must have two modules");
  for (const double units : job.units) require_coordinate(units);
  for (const double units : job.ends) require_coordinate(units);
  require_state(std::isfinite(job.sweep_deg) && std::isfinite(job.growth_units_turn) &&
                    std::isfinite(job.smooth_corner_deg),
                "an angle is out of range");
  if (job.path_acceleration_units_s2 != 0) require_speed(job.path_acceleration_units_s2);
}

void StateOf<Module>::check(const Module& module) {
  require_within(module.jog_direction, -1, 1);
  require_within(module.next_jog_direction, -1, 1);
  require_within(module.held_jog_direction, -1, 1);
  require_within(module.analog, 0, kFullAnalog);
  require_reach(module.zero_pulses);
  require_reach(module.sent_pulses);
  require_coordinate(module.place_units);
  const bool moves = module.activity == Activity::move;
  if (moves || module.activity == Activity::home) {
    const Job::Kind kind = moves ? Job::Kind::move : Job::Kind::home;
    require_state(!module.fifo.empty() && module.fifo[0].kind == kind,
                  "a module runs a command that is not at the head of its FIFO");
  }
}

void StateOf<ChainState>::check(const ChainState& chain) {
  const auto& [options, modules, axes, environment, groups, map, continuous, paused, pz, number, now] = chain;
  for (const std::int8_t module : map) require_within(module, kNoModule, kMappable - 1);
  require_reach(now);
  for (int module = 0; module < kModules; ++module) {
    const auto& fifo = modules[static_cast<std::size_t>(module)].fifo;
    for (std::size_t i = 0; i < fifo.size(); ++i) {
      require_state(fifo[i].letter_of(module) >= 0, "a command is in the FIFO of another module");
    }
    const bool in_group = modules[static_cast<std::size_t>(module)].activity == Activity::group;
    require_state(in_group == (chain.group_of(module) != nullptr),
                  "a module's activity does not match its group");
  }
  for (const Group& group : groups) {
    if (!group.motion.engaged) continue;
    require_state(group.motion.axis_of[0] >= 0, "a group must have a module at X");
    for (const std::int8_t member : group.motion.axis_of) {
      require_within(member, kNoModule, kMappable - 1);
      if (member < 0) continue;
      const auto& fifo = modules[static_cast<std::size_t>(member)].fifo;
      require_state(group.paths <= fifo.size(), "a group has more paths than commands");
      for (std::size_t i = 0; i < group.paths; ++i) {
        require_state(fifo[i].module_of == group.motion.axis_of, "a group runs another group's command");
      }
    }
    require_state(group.paths <= group.motion.run.queued(), "a group has more commands than paths");
  }
}

}  // namespace understudy
