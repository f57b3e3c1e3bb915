#include "emulator/world/world.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/large_pages.h"
#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/terminals.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/fault_watch.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/outside.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/view/world_view.h"
#include "pty/line.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

namespace {

/// Asks for large pages if there are many devices. Devices are close together in memory, because they were
/// created one after another.
void keep_together(const std::vector<std::unique_ptr<Device>>& devices) {
  constexpr std::size_t kCrowd = 100;
  constexpr std::ptrdiff_t kMaxOfOne = std::ptrdiff_t{64} << 10;  // bytes; more: other data is between
  if (devices.size() < kCrowd) return;
  const auto by_address = [](const auto& a, const auto& b) { return std::less<>()(a.get(), b.get()); };
  const auto [low, high] = std::minmax_element(devices.begin(), devices.end(), by_address);
  const auto* const first = reinterpret_cast<const char*>(low->get());
  const auto* const last = reinterpret_cast<const char*>(high->get());
  if (last - first < kMaxOfOne * static_cast<std::ptrdiff_t>(devices.size()))
    ask_for_large_pages(first, last);
}

/// Converts a time on the host's clock to simulated time, which runs faster if `patience` is longer.
SimTime as_long_as(SimTime time, SimTime patience) {
  const double factor = static_cast<double>(patience.count()) / static_cast<double>(kFramePatience.count());
  const double scaled = static_cast<double>(time.count()) * factor;
  constexpr double kMax = static_cast<double>(kHorizon.count());
  return scaled >= kMax ? kHorizon : SimTime{static_cast<std::int64_t>(scaled)};
}

/// Creates a line with its stations.
std::unique_ptr<WorldLine> made_line(const LineSetup& setup,
                                     const std::vector<std::unique_ptr<Device>>& devices,
                                     const WorldOptions& options,
                                     const std::function<void(const std::string&)>& log) {
  const StationSetup& first = setup.stations.front();
  pty::LineOptions line_options{.settings = devices[first.device]->line_settings(first.port),
                                .timing = setup.timing,
                                .echoes = setup.echoes,
                                .enforce_settings = options.enforce_settings,
                                .baud_tolerance_ppm = setup.baud_tolerance_ppm};
  const StationConditions conditions{.is_instant = setup.timing == pty::Timing::instant,
                                     .strict_framing = options.strict_framing,
                                     .patience = options.patience,
                                     .rest_patience = as_long_as(setup.byte_timeout, options.patience)};
  const LineProtocol& protocol = protocol_of(devices[first.device]->model());
  auto line =
      std::make_unique<WorldLine>(WorldLine{pty::Line(setup.name, line_options, log), protocol, {}, {}});
  for (const auto& [number, port] : setup.stations) {
    Device& device = *devices[number];
    const pty::RtuFraming framing = protocol.framing(device.model(), conditions);
    if (line->stations.empty() || framing.silence < line->framing.silence) line->framing = framing;
    line->stations.push_back(protocol.make_station(device, port, conditions));
    line->line.attach(*line->stations.back());
  }
  return line;
}

}  // namespace

World::World(const Bench& bench, const WorldOptions& options,
             const std::function<void(const std::string&)>& log)
    : known_(known_devices_of(bench)),
      driven_axes_(bench.devices.size()),
      supplies_(bench.devices.size()),
      wires_(bench.wires),
      seed_(bench.seed) {
  for (const DeviceSetup& setup : bench.devices) {
    devices_.push_back(make_device(*setup.model, setup.settings, log));
    axes_.push_back(devices_.back()->axes());
    plants_.emplace_back(setup.model->axes.size());
    sent_pulses_.emplace_back(setup.model->axes.size(), 0);
    inputs_.emplace_back(setup.model->terminals.size());
    for (std::size_t i = 0; i < setup.model->terminals.size(); ++i) {
      inputs_.back()[i].external = devices_.back()->input(static_cast<int>(i));  // for DIP switches
    }
  }
  keep_together(devices_);
  for (const MachineSetup& machine : bench.machines) {
    PlantAxis& plant = plants_[machine.device][static_cast<std::size_t>(machine.axis)];
    plant = PlantAxis(machine.plant);
    if (plant.has_encoder()) axes_[machine.device]->connect_encoder(machine.axis, plant.encoder_counts());
  }
  for (const LineSetup& setup : bench.lines) {
    lines_.push_back(made_line(setup, devices_, options, log));
    if (lines_.back()->protocol.may_be_unasked()) unasked_lines_.push_back(lines_.back().get());
  }
  for (const InputSetup& setup : bench.inputs) {
    set_external_input(setup.device, setup.terminal, setup.level);
  }
  for (const Fault& fault : bench.faults) inject(fault);
  for (const MachineSetup& machine : bench.machines) connect_drive(machine);
  // A machine may be at a switch at power-up.
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    wire_contacts(d);
    step_plant(d);
  }
  begin_edges();
  const auto is_of_machine = [](const WireSetup& wire) { return wire.from_axis >= 0; };
  if (std::any_of(wires_.begin(), wires_.end(), is_of_machine)) latch_wires();
  // No host could receive anything that devices send at power-up, so transmission begins in the first tick.
  poll_text(kTickLength);
}

World::~World() = default;

/// Connects the contacts of the machines to inputs. Without a drive, an alarm can only be injected, and there
/// is no alarm contact if another contact uses its input.
void World::wire_contacts(std::size_t number) {
  const auto rows = devices_[number]->model().axes;
  auto& wired = contacts_.emplace_back();
  std::vector<ContactWire> alarms;
  for (std::size_t a = 0; a < rows.size(); ++a) {
    for (std::size_t i = 0; i < kContactNames.size(); ++i) {
      const auto contact = static_cast<Contact>(i);
      const int input = input_of(rows[a], plants_[number][a], contact);
      if (input >= 0) wired.push_back({a, contact, input});
    }
    const bool has_drive = plants_[number][a].has_drive();
    if (!has_drive && rows[a].alarm_input >= 0) alarms.push_back({a, Contact::alarm, rows[a].alarm_input});
  }
  for (const ContactWire& alarm : alarms) {
    const auto is_its = [&](const ContactWire& other) { return other.input == alarm.input; };
    if (std::none_of(wired.begin(), wired.end(), is_its)) wired.push_back(alarm);
  }
}

const PlantAxis& World::plant(std::size_t device, int axis) const {
  return plants_[device][static_cast<std::size_t>(axis)];
}

void World::advance_to(SimTime time) {
  // Ticks do not change when lines are due, unless devices send without a request. Watchers may change it.
  SimTime line_time = next_line_time();
  // True if watchers were notified of a quiet tick and nothing has happened since.
  bool is_at_rest = false;
  while (true) {
    const SimTime tick_time = time_of(done_ + 1);
    if (std::min(line_time, tick_time) > time) break;
    if (line_time < tick_time) {
      now_ = std::max(now_, line_time);
      run_lines(line_time);
      line_time = next_line_time();
      is_at_rest = false;
      continue;
    }
    // Ticks in which nothing happens are skipped, up to the next tick in which something happens.
    const Tick reachable = tick_at(std::min(time, line_time));
    Tick active = bulk_ticks_ ? next_active_tick() : done_ + 1;
    if (active > done_ + 1) active = std::min(active, next_fault_tick());
    const bool tries = active == done_ + 1 && may_fast_forward(reachable);
    const Tick skipped = tries ? last_tick_to_skip(reachable) : done_;
    bool is_rest = false;
    if (skipped > done_) {
      fast_forward_to(skipped);
    } else if (active > done_ + 1) {
      const Tick alike = last_alike();
      is_rest = is_at_rest && alike > done_;
      is_at_rest = true;
      const Tick last_quiet =
          watchers_.empty() || is_rest ? std::min({reachable, active - 1, alike}) : done_ + 1;
      ticks_.skipped += static_cast<std::uint64_t>(last_quiet - done_);
      done_ = last_quiet;
      for (const auto& device : devices_) device->set_now(done_);
    } else {
      is_at_rest = false;
      run_tick();
      if (fault_watch_) check_faults();
      if (!unasked_lines_.empty()) {
        now_ = std::max(now_, time_of(done_));
        poll_text(now_);
        line_time = next_line_time();
      }
    }
    now_ = std::max(now_, time_of(done_));
    if (watchers_.empty()) continue;
    show_tick(is_rest);
    if (std::exchange(stops_here_, false)) return;
    line_time = next_line_time();
  }
  now_ = std::max(now_, time);
}

/// Returns the last tick up to which no watcher needs quiet ticks.
Tick World::last_alike() const {
  Tick next = kNever;
  for (const TickWatcher* watcher : watchers_) {
    next = std::min(next, watcher->next_poll(done_));
    if (next == done_ + 1) break;
  }
  return next == kNever ? kNever : next - 1;
}

void World::show_tick(bool is_rest) {
  // This is a copy, because a watcher may remove itself.
  const std::vector<TickWatcher*> present = watchers_;
  for (TickWatcher* watcher : present) is_rest ? watcher->on_rest(done_) : watcher->on_tick(done_);
}

std::optional<SimTime> World::next_due() const {
  Tick tick = std::min(next_active_tick(), next_fault_tick());
  // While axes only continue to move, the process need not wake up, unless watchers need to be notified.
  if (tick == done_ + 1 && !disturbed_ && watchers_.empty()) tick = next_event_tick(kNever);
  const SimTime due = std::min(next_line_time(), time_of(tick));
  if (due == kForever) return std::nullopt;
  return due;
}

Tick World::next_active_tick() const {
  if (disturbed_ || !input_turns_.empty()) return done_ + 1;
  Tick next = kNever;
  for (std::size_t d = 0; d < devices_.size() && next > done_ + 1; ++d) {
    if (devices_[d]->powered()) next = std::min(next, devices_[d]->next_active_tick(done_));
    if (next == done_ + 1) break;
    for (const PlantAxis& plant : plants_[d]) next = std::min(next, plant.next_active_tick(done_));
  }
  return next;
}

SimTime World::next_line_time() const {
  SimTime next = fault_watch_ ? fault_watch_->next_moment() : kForever;
  if (next != kForever) next = std::max(next, now_);
  for (const auto& line : lines_) next = std::min(next, line->line.due().value_or(kForever));
  return next;
}

/// Runs everything on the lines that is due at `time`, after the faults that take effect at that moment.
void World::run_lines(SimTime time) {
  if (fault_watch_) {
    fault_watch_->check(now_, false);
    settle_faults();
  }
  for (const auto& line : lines_) line->line.run(time);
  if (fault_watch_) settle_faults();
}

/// Makes lines send what devices want to send after a tick or an outside event.
void World::poll_text(SimTime now) {
  for (WorldLine* line : unasked_lines_) {
    for (const auto& station : line->stations) {
      if (station->poll_text(now)) line->line.due_changed();
    }
  }
}

void World::run_tick() {
  disturbed_ = false;
  ++done_;
  if (!input_turns_.empty()) turn_inputs();
  // Devices interact only through wires, latched last. So each runs all phases while it is in the cache.
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    prefetch_device(d + 2);
    run_device(d);
  }
  latch_wires();
  ++ticks_.run;
}

/// Prefetches the data for run_device(), and the device two places later with its pointers to other data.
void World::prefetch_device(std::size_t number) const {
  if (number >= devices_.size()) return;
  if (number + 2 < devices_.size()) prefetch_line(devices_[number + 2].get());
  devices_[number]->prefetch(done_);
  for (const PlantAxis& plant : plants_[number]) prefetch_line(&plant);
  prefetch(sent_pulses_[number].data(), sent_pulses_[number].size() * sizeof(std::int64_t));
}

void World::run_device(std::size_t number) {
  Device& device = *devices_[number];
  const bool powered = device.powered();
  if (powered) {
    device.sample_inputs(done_);
    device.run_interpreters(done_);
    device.step_motion(done_);
  }
  step_plant(number);
  device.set_now(done_);
  if (!powered) return;
  device.update_outputs(done_);
  // The drives of the device receive its outputs in the next tick.
  for (const std::size_t a : driven_axes_[number]) {
    if (plants_[number][a].seen_inputs() != drive_inputs(number, a)) disturbed_ = true;
  }
}

void World::step_plant(std::size_t number) {
  if (plants_[number].empty()) return;
  Device& device = *devices_[number];
  Axes& driven_axes = *axes_[number];
  const auto axes = device.model().axes;
  bool all_quiet = true;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    PlantAxis& plant = plants_[number][a];
    const std::int64_t pulses = driven_axes.pulses_this_tick(static_cast<int>(a));
    count_sent(sent_pulses_[number][a], pulses);
    if (plant.step_quietly(pulses)) {
      const bool has_turned = pulses != 0 && plant.has_encoder();
      if (has_turned) driven_axes.set_encoder(static_cast<int>(a), plant.quiet_encoder_counts());
      continue;
    }
    all_quiet = false;
    const DriveInputs outputs = plant.has_drive() ? drive_inputs(number, a) : DriveInputs{};
    const PlantAxis::State& state = plant.save();
    const std::pair before(state.position_pulses, state.wheel_counts);
    plant.step(done_, pulses, outputs);
    if (plant.has_encoder() && std::pair(state.position_pulses, state.wheel_counts) != before) {
      driven_axes.set_encoder(static_cast<int>(a), plant.encoder_counts());
    }
  }
  if (all_quiet) {  // no contact has changed
    if (meets_edges(number)) check_positions(number);
    return;
  }
  for (const ContactWire& wire : contacts_[number]) {
    bool& is_on = inputs_[number][static_cast<std::size_t>(wire.input)].plant;
    const bool level = plants_[number][wire.axis].contact(wire.contact);
    if (is_on == level) continue;
    is_on = level;
    apply_input(number, wire.input);
  }
  if (meets_edges(number)) send_edges(number);
}

bool World::level_of(const WireSetup& wire) const {
  if (wire.from_axis < 0) return devices_[wire.from_device]->terminals()->output(wire.from_terminal);
  return plants_[wire.from_device][static_cast<std::size_t>(wire.from_axis)].contact(wire.from_contact);
}

void World::latch_wires() {
  // Several wires on one input act like switches in parallel.
  for (const WireSetup& wire : wires_) {
    if (wire.to_axis >= 0) latch_drive(wire);
    if (wire.to_axis < 0) inputs_[wire.to_device][static_cast<std::size_t>(wire.to_terminal)].wired = false;
  }
  for (const WireSetup& wire : wires_) {
    if (wire.to_axis >= 0) continue;
    Input& input = inputs_[wire.to_device][static_cast<std::size_t>(wire.to_terminal)];
    input.wired = input.wired || level_of(wire);
  }
  for (const WireSetup& wire : wires_) {
    if (wire.to_axis >= 0) continue;
    apply_input(wire.to_device, wire.to_terminal);
    if (meets_edges(wire.to_device)) send_edges(wire.to_device);
  }
}

void World::set_external_input(std::size_t device, int terminal, std::int32_t level) {
  run_due_lines();
  notify([&](OutsideListener& listener) { listener.on_input(device, terminal, level); });
  inputs_[device][static_cast<std::size_t>(terminal)].external = level;
  apply_input(device, terminal);
  send_edges(device);
}

std::int32_t World::external_input(std::size_t device, int terminal) const {
  return inputs_[device][static_cast<std::size_t>(terminal)].external;
}

void World::apply_input(std::size_t device, int terminal) {
  const Input& input = inputs_[device][static_cast<std::size_t>(terminal)];
  std::int32_t level = input.external;
  if (input.wired || input.plant) level = 1;
  devices_[device]->set_input(terminal, input.stuck ? *input.stuck : level);
}

/// First runs what is due at this moment, in the same order as a replay.
void World::run_due_lines() {
  if (now_ > SimTime{0}) run_lines(now_);
}

Refusal World::write(std::size_t device, const PreparedWrite& write) {
  run_due_lines();
  notify([&](OutsideListener& listener) { listener.on_write(device, write); });
  return write_prepared(*devices_[device]->register_bank(), write);
}

std::optional<std::string> World::assign(std::size_t device, const std::string& name, double value) {
  run_due_lines();
  NamedValues* const values = devices_[device]->named_values();
  if (values == nullptr) return "cannot be set; expected a name of the device";
  if (auto diagnostic = values->assign(name, value)) return diagnostic;
  notify([&](OutsideListener& listener) { listener.on_assign(device, name, value); });
  poll_text(now_);
  return std::nullopt;
}

void World::switch_power(std::size_t device, bool on) {
  if (supplies_[device].is_switched_on == on) return;
  run_due_lines();
  notify([&](OutsideListener& listener) { listener.on_power(device, on); });
  supplies_[device].is_switched_on = on;
  settle_power(device);
}

/// Switches the power of a device: it is on if its supply is on and no fault cuts it off.
void World::settle_power(std::size_t device) {
  const auto cuts = [&](const auto& entry) {
    const auto& [fault, course] = entry.second;
    return fault.kind == Fault::Kind::power_cut && fault.device == device && course.in_force;
  };
  const bool on = supplies_[device].is_switched_on && std::none_of(faults_.begin(), faults_.end(), cuts);
  if (devices_[device]->powered() == on) return;
  devices_[device]->switch_power(on);
  disturbed_ = true;
  resend_edges(device);
  for (const auto& line : lines_) {
    for (const auto& station : line->stations) {
      if (&station->device() != devices_[device].get()) continue;
      station->reset();
      line->line.discard_pending(*station, now_);
    }
    // DIP switches may have changed the device's speed. The line uses the settings of its first powered
    // station.
    const auto speaks = std::find_if(line->stations.begin(), line->stations.end(),
                                     [](const auto& station) { return station->device().powered(); });
    if (speaks != line->stations.end()) line->line.set_settings((*speaks)->settings());
  }
  poll_text(now_);
}

}  // namespace understudy::emulator::world
