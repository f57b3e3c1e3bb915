#include "benchmarks/big_devices.h"

#include <malloc.h>

#include <cstdio>
#include <exception>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/process.h"
#include "benchmarks/processor_clock.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/models.h"
#include "emulator/world/snapshot.h"

namespace understudy::benchmarks {

using emulator::world::World;

void set(emulator::Device& device, std::string_view name, emulator::Value value) {
  const auto found = device.register_bank()->find(name);
  if (!found || emulator::write_value(*device.register_bank(), *found, value) != emulator::Refusal::none) {
    throw CannotRun(std::string(name) + " does not accept " + std::to_string(value));
  }
}

emulator::Value get(emulator::Device& device, std::string_view name) {
  const auto found = device.register_bank()->find(name);
  if (!found) throw CannotRun("no " + std::string(name));
  return emulator::read_value(*device.register_bank(), *found);
}

std::unique_ptr<World> make_devices(
    std::size_t devices, std::string_view model, const std::string& program, std::size_t port,
    const std::function<void(emulator::world::DeviceSetup&, std::size_t)>& finish) {
  emulator::world::Bench bench;
  for (std::size_t d = 0; d < devices; ++d) {
    emulator::world::DeviceSetup device;
    device.model = emulator::find_model(emulator::models::all_models(), model);
    device.settings.name = "d" + std::to_string(d);
    device.settings.program = program;
    finish(device, d);
    bench.devices.push_back(device);
    if (d % kStationsALine == 0) {
      emulator::world::LineSetup line;
      line.name = "line" + std::to_string(bench.lines.size());
      bench.lines.push_back(line);
    }
    bench.lines.back().stations.push_back({d, port});
    for (int axis = 0; axis < 4; ++axis) {
      emulator::world::PlantSetup plant;
      plant.lower_limit = -1'000'000;
      plant.upper_limit = 1'000'000;
      bench.machines.push_back({.device = d, .axis = axis, .plant = plant});
    }
  }
  return std::make_unique<World>(bench, emulator::world::WorldOptions{}, [](const std::string&) {});
}

double ticks_ns(World& world, Tick& done, Tick ticks) {
  const auto before = processor_time_here();
  world.advance_to(time_of(done += ticks));
  return static_cast<double>((processor_time_here() - before).count()) / static_cast<double>(ticks) /
         static_cast<double>(world.device_count());
}

double heap_bytes() { return static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd); }

double snapshot_us(World& world, std::string_view changing) {
  std::vector<double> samples;
  for (int i = 0; i < 200; ++i) {
    set(world.device(0), changing, i);
    const auto before = processor_time_here();
    const auto state = emulator::world::save(world);
    emulator::world::restore(world, state);
    samples.push_back(static_cast<double>((processor_time_here() - before).count()) / 1000);
  }
  return median(samples);
}

int run_benchmark(const char* name, const std::function<void()>& parts) {
  try {
    parts();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  }
}

}  // namespace understudy::benchmarks
