// Common parts of the benchmarks of the two large controllers: worlds with many of them, the cost of a tick,
// memory.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "emulator/device/device.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/world.h"

namespace understudy::benchmarks {

/// Sets a register by its name. Throws CannotRun if it does not exist or refuses the value.
void set(emulator::Device& device, std::string_view name, emulator::Value value);
emulator::Value get(emulator::Device& device, std::string_view name);

inline constexpr std::size_t kStationsALine = 15;

/// Makes this many devices of a model, each with four machines, with fifteen stations on a line at the
/// device's port `port`. `finish` receives the setup of each device, and its number.
std::unique_ptr<emulator::world::World> make_devices(
    std::size_t devices, std::string_view model, const std::string& program, std::size_t port,
    const std::function<void(emulator::world::DeviceSetup&, std::size_t)>& finish);

/// Runs `ticks` more ticks, after those `done`. Returns the processor time per tick and device in
/// nanoseconds.
double ticks_ns(emulator::world::World& world, Tick& done, Tick ticks);

/// Returns the memory that this process has allocated.
double heap_bytes();

/// Returns the microseconds to save and to restore; the register `changing` of the first device is written
/// before each snapshot.
double snapshot_us(emulator::world::World& world, std::string_view changing);

/// Runs the parts of a benchmark and returns its exit code. If it cannot run, prints the reason.
int run_benchmark(const char* name, const std::function<void()>& parts);

}  // namespace understudy::benchmarks
