// The common parts of the benchmarks of the two large controllers: worlds of many of them, their ticks, their
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

/// Returns a register by its name. Throws CannotRun if there is none, or if it refuses the value.
void set(emulator::Device& device, std::string_view name, emulator::Value value);
emulator::Value get(emulator::Device& device, std::string_view name);

inline constexpr std::size_t kStationsALine = 15;

/// Makes this many devices of a model, each with four machines, with fifteen stations on a line at the
/// device's port `port`. `finish` gets the setup of each, and its number.
std::unique_ptr<emulator::world::World> make_devices(
    std::size_t devices, std::string_view model, const std::string& program, std::size_t port,
    const std::function<void(emulator::world::DeviceSetup&, std::size_t)>& finish);

/// Nanoseconds of processor time of a device's tick: `ticks` more, after those `done`.
double ticks_ns(emulator::world::World& world, Tick& done, Tick ticks);

/// The memory of this process.
double heap_bytes();

/// Returns the microseconds to save and to restore; the register `changing` of the first device is written
/// before each.
double snapshot_us(emulator::world::World& world, std::string_view changing);

/// Runs the parts of a benchmark and returns its exit code. Reports why it cannot run.
int run_benchmark(const char* name, const std::function<void()>& parts);

}  // namespace understudy::benchmarks
