// Handles the faults of a world: they are injected, wait, begin, end and are cleared.
#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/world/check_fault.h"
#include "emulator/world/fault_watch.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/outside.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/world.h"
#include "pty/line.h"

namespace understudy::emulator::world {

std::size_t World::inject(const Fault& fault) {
  check_fault(*this, fault);
  run_due_lines();
  notify([&](OutsideListener& listener) { listener.on_inject(fault); });
  disturbed_ = true;
  const std::size_t number = next_fault_++;
  if (is_done_at_once(fault.kind) && !waits(fault)) {
    move_by_hand(fault);
    return number;
  }
  ArmedFault armed{.fault = fault};
  armed.course.in_force = armed.course.is_news = !waits(fault);
  faults_.emplace(number, armed);
  arm_faults();
  settle_faults();
  return number;
}

void World::move_by_hand(const Fault& fault) {
  if (fault.of_input) {
    const Tick ticks = std::max<Tick>(fault.over_ticks, 1);
    input_turns_.push_back({fault.device, fault.place, fault.amount, ticks, ticks});
    return;
  }
  PlantAxis& plant = plants_[fault.device][static_cast<std::size_t>(fault.place)];
  if (fault.kind == Fault::Kind::turn) return plant.turn(fault.amount, fault.over_ticks);
  plant.faults().slipped_pulses += fault.amount;
}

bool World::clear_fault(std::size_t number) {
  const auto found = faults_.find(number);
  if (found == faults_.end()) return false;
  remove_fault(found);
  arm_faults();
  return true;
}

void World::clear_faults() {
  if (faults_.empty()) return;
  while (!faults_.empty()) remove_fault(faults_.begin());
  arm_faults();
}

/// Removes a fault. The caller must call arm_faults() afterwards.
void World::remove_fault(std::map<std::size_t, ArmedFault>::iterator fault) {
  run_due_lines();
  notify([&](OutsideListener& listener) { listener.on_clear_fault(fault->first); });
  const std::size_t device = fault->second.fault.device;
  faults_.erase(fault);
  disturbed_ = true;
  apply_faults(device);
  apply_adapters();
  settle_power(device);
}

/// If a fault is waiting or changes with time, creates a watch and passes it to the stations.
void World::arm_faults() {
  const auto needs_watch = [](const auto& entry) {
    return waits(entry.second.fault) || entry.second.fault.period_ticks != 0;
  };
  fault_watch_.reset();
  if (std::any_of(faults_.begin(), faults_.end(), needs_watch)) {
    fault_watch_ = std::make_unique<FaultWatch>(*this, faults_, seed_);
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    for (const auto& station : lines_[i]->stations) {
      const auto is_its = [&](const auto& device) { return device.get() == &station->device(); };
      const auto device = std::find_if(devices_.begin(), devices_.end(), is_its) - devices_.begin();
      station->set_faults(fault_watch_.get(), static_cast<std::size_t>(device), i);
    }
  }
}

Tick World::next_fault_tick() const { return fault_watch_ ? fault_watch_->next_tick(done_) : kNever; }

/// Checks the faults at the end of a tick that was run.
void World::check_faults() {
  now_ = std::max(now_, time_of(done_));
  fault_watch_->check(now_, true);
  settle_faults();
  for (const auto& [number, armed] : faults_) {
    const Fault& fault = armed.fault;
    if (fault.kind != Fault::Kind::encoder_noise || !armed.course.in_force) continue;
    const MachineFaults& faults = plants_[fault.device][static_cast<std::size_t>(fault.place)].faults();
    if (faults.encoder_noise_counts == encoder_noise_counts(fault, done_)) continue;
    apply_faults(fault.device);
    disturbed_ = true;
  }
}

/// Applies the faults that have begun or ended.
void World::settle_faults() {
  for (auto& [number, armed] : faults_) {
    auto& [fault, course] = armed;
    if (!course.is_news) continue;
    course.is_news = false;
    disturbed_ = true;
    notify([&, which = number, in_force = course.in_force](OutsideListener& listener) {
      listener.on_fault(which, in_force);
    });
    switch (fault.kind) {
      case Fault::Kind::slip:
      case Fault::Kind::turn: move_by_hand(fault); break;
      case Fault::Kind::power_cut: settle_power(fault.device); break;
      case Fault::Kind::echo:
      case Fault::Kind::lumps:
      case Fault::Kind::unplug: apply_adapters(); break;
      default: apply_faults(fault.device); break;
    }
  }
}

/// Applies the faults of adapters. If a line has several faults of one kind, the last one counts.
void World::apply_adapters() {
  for (const auto& line : lines_) {
    pty::Adapter adapter;
    for (const auto& [number, armed] : faults_) {
      const Fault& fault = armed.fault;
      if (!is_of_adapter(fault.kind) || !armed.course.in_force) continue;
      const std::string& name = known_[fault.device].lines[static_cast<std::size_t>(fault.place)];
      if (name != line->line.name()) continue;
      if (fault.kind == Fault::Kind::echo) adapter.echoes = true;
      if (fault.kind == Fault::Kind::lumps) adapter.latency = SimTime{fault.amount};
      if (fault.kind == Fault::Kind::unplug) adapter.is_unplugged = true;
    }
    line->line.set_adapter(adapter);
  }
}

/// Applies the faults of a device. If a place has several faults of one kind, the last one counts.
void World::apply_faults(std::size_t device) {
  for (PlantAxis& plant : plants_[device]) {
    plant.set_faults({.slipped_pulses = plant.faults().slipped_pulses});
  }
  for (Input& input : inputs_[device]) input.stuck.reset();
  for (const auto& [number, armed] : faults_) {
    const Fault& fault = armed.fault;
    if (fault.device != device || !armed.course.in_force) continue;
    const auto place = static_cast<std::size_t>(fault.place);
    switch (fault.kind) {
      case Fault::Kind::stall: plants_[device][place].faults().stalled = true; break;
      case Fault::Kind::lost_steps: plants_[device][place].faults().loses_one_in = fault.amount; break;
      case Fault::Kind::alarm: plants_[device][place].faults().alarm = true; break;
      case Fault::Kind::stuck: inputs_[device][place].stuck = fault.amount != 0; break;
      case Fault::Kind::encoder_noise:
        plants_[device][place].faults().encoder_noise_counts = encoder_noise_counts(fault, done_);
        break;
      default: break;
    }
  }
  for (std::size_t a = 0; a < plants_[device].size(); ++a) {
    const PlantAxis& plant = plants_[device][a];
    if (plant.has_encoder())
      devices_[device]->axes()->set_encoder(static_cast<int>(a), plant.encoder_counts());
  }
  for (std::size_t i = 0; i < inputs_[device].size(); ++i) apply_input(device, static_cast<int>(i));
  send_edges(device);
}

}  // namespace understudy::emulator::world
