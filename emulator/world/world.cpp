#include "emulator/world/world.h"

#include <algorithm>

namespace understudy::emulator {

World::World(const Bench& bench, const WorldOptions& options,
             const std::function<void(const std::string&)>& log)
    : wires_(bench.wires) {
  for (const DeviceSetup& setup : bench.devices) {
    devices_.push_back(make_device(*setup.model, setup.settings, log));
    plants_.emplace_back(setup.model->axes.size());
    inputs_.emplace_back(setup.model->terminals.size());
  }
  for (const MachineSetup& machine : bench.machines) {
    plants_[machine.device][static_cast<std::size_t>(machine.axis)] = PlantAxis(machine.plant);
  }
  for (const LineSetup& setup : bench.lines) {
    pty::LineOptions line_options{.settings = devices_[setup.stations.front()]->line_settings(),
                                  .timing = setup.timing,
                                  .enforce_settings = options.enforce_settings};
    lines_.push_back(std::make_unique<OneLine>(OneLine{pty::Line(setup.name, line_options, log), {}, {}}));
    OneLine& line = *lines_.back();
    for (const std::size_t number : setup.stations) {
      // Without wire time there is no silence to wait for, unless silence alone ends a frame.
      const bool no_silence = setup.timing == pty::Timing::instant && !options.strict_framing;
      const pty::RtuFraming framing{
          .strict = options.strict_framing,
          .silence = no_silence ? SimTime{0} : devices_[number]->model().rtu.end_silence,
          .patience = options.patience};
      if (line.stations.empty() || framing.silence < line.framing.silence) line.framing = framing;
      line.stations.push_back(std::make_unique<RtuStation>(*devices_[number], framing));
      line.line.attach(*line.stations.back());
    }
  }
  step_plant();  // a machine may stand on a switch at power-up
}

int World::find_device(std::string_view name) const {
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    if (devices_[i]->name() == name) return static_cast<int>(i);
  }
  return -1;
}

const PlantAxis& World::plant(std::size_t device, int axis) const {
  return plants_[device][static_cast<std::size_t>(axis)];
}

void World::advance_to(SimTime time) {
  while (true) {
    const SimTime line_time = next_line_time();
    const SimTime tick_time = time_of(done_ + 1);
    if (std::min(line_time, tick_time) > time) break;
    if (line_time < tick_time) {
      now_ = std::max(now_, line_time);
      run_lines(line_time);
      continue;
    }
    // Ticks at which nothing happens by itself are left out, up to the next thing that does happen.
    const Tick reachable = tick_at(std::min(time, line_time));
    const Tick active = bulk_ticks_ ? next_active_tick() : done_ + 1;
    if (active > done_ + 1) {
      const Tick last_quiet = std::min(reachable, active - 1);
      ticks_crossed_ += static_cast<std::uint64_t>(last_quiet - done_);
      done_ = last_quiet;
      for (const auto& device : devices_) device->set_now(done_);
    } else {
      run_tick();
    }
    now_ = std::max(now_, time_of(done_));
  }
  now_ = std::max(now_, time);
}

std::optional<SimTime> World::next_due() const {
  const SimTime due = std::min(next_line_time(), time_of(next_active_tick()));
  if (due == kForever) return std::nullopt;
  return due;
}

Tick World::next_active_tick() const {
  Tick next = kNever;
  for (const auto& device : devices_) next = std::min(next, device->next_active_tick(done_));
  return next;
}

SimTime World::next_line_time() const {
  SimTime next = kForever;
  for (const auto& line : lines_) next = std::min(next, line->line.due().value_or(kForever));
  return next;
}

void World::run_lines(SimTime time) {
  for (const auto& line : lines_) line->line.run(time);
}

void World::run_tick() {
  const Tick tick = done_ + 1;
  for (const auto& device : devices_) device->sample_inputs(tick);
  for (const auto& device : devices_) device->run_interpreters(tick);
  for (const auto& device : devices_) device->step_motion(tick);
  step_plant();
  done_ = tick;
  for (const auto& device : devices_) {
    device->set_now(tick);
    device->update_outputs(tick);
  }
  latch_wires();
  ++ticks_run_;
}

void World::step_plant() {
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    const auto axes = devices_[d]->model().axes;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      PlantAxis& plant = plants_[d][a];
      plant.move(devices_[d]->pulses_this_tick(static_cast<int>(a)));
      if (plant.has_encoder()) devices_[d]->set_encoder(static_cast<int>(a), plant.encoder_counts());
      const auto drive = [&](int terminal, bool level) {
        if (terminal < 0) return;
        inputs_[d][static_cast<std::size_t>(terminal)].plant = level;
        apply_input(d, terminal);
      };
      drive(axes[a].home_input, plant.at_home());
      drive(axes[a].lower_limit_input, plant.at_lower_limit());
      drive(axes[a].upper_limit_input, plant.at_upper_limit());
    }
  }
}

void World::latch_wires() {
  // Several wires on one input act like switches in parallel.
  for (const WireSetup& wire : wires_) {
    inputs_[wire.to_device][static_cast<std::size_t>(wire.to_terminal)].wired = false;
  }
  for (const WireSetup& wire : wires_) {
    Input& input = inputs_[wire.to_device][static_cast<std::size_t>(wire.to_terminal)];
    input.wired = input.wired || devices_[wire.from_device]->output(wire.from_terminal);
  }
  for (const WireSetup& wire : wires_) apply_input(wire.to_device, wire.to_terminal);
}

void World::set_external_input(std::size_t device, int terminal, bool on) {
  inputs_[device][static_cast<std::size_t>(terminal)].external = on;
  apply_input(device, terminal);
}

void World::apply_input(std::size_t device, int terminal) {
  const Input& input = inputs_[device][static_cast<std::size_t>(terminal)];
  devices_[device]->set_input(terminal, input.external || input.wired || input.plant);
}

}  // namespace understudy::emulator
