// Measures the cost of a SUPER-40NC: a tick with a PLC of 200 steps that changes something in every scan, C
// on a path of three axes and U in a DRV, alone and among 200 devices; a settled device at rest, which is
// fast-forwarded; its memory; and a snapshot with its restore, with empty and with full files and recipes.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/big_devices.h"
#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"
#include "emulator/device/user_program.h"
#include "emulator/world/world.h"

namespace understudy::benchmarks {

namespace {

using emulator::world::World;

constexpr int kRounds = 21;
constexpr Tick kTicks = 20'000;  // in a round
constexpr Tick kWarmUp = 3000;
constexpr Tick kHour = 3'600'000;
constexpr std::size_t kCrowd = 200;
constexpr Tick kTicksOfCrowd = 200;

constexpr double kTickBar_us = 1;
constexpr double kSettledBar = 20'000;  // simulated seconds per second
constexpr double kCrowdBar = 2.5;
constexpr double kBytesBar = 512 * 1024;
constexpr double kFullBytesBar = 2 * 1024 * 1024;
constexpr double kSnapshotBar_us = 200;
constexpr double kFullSnapshotBar_us = 1000;

/// 200 steps: rungs of contacts, timers, counters and numbers; D0 counts every scan.
std::string ladder(bool changes) {
  std::string text = "AREA PLC\n";
  if (changes) text += "LD M8003\nINC D0\n";
  for (int i = 0; i < 9; ++i) {
    const auto number = [&](int first, int limit) { return std::to_string((i * 7 + first) % limit); };
    text += "LD X" + number(12, 24) + "\nOR M" + number(3, 300) + "\nANI X" + number(15, 24) + "\nOUT M" +
            number(3, 300) + "\nLD M8003\nAND X" + number(2, 24) + "\nLDI M" + number(9, 300) +
            "\nORB\nOUT Y" + number(10, 16) + "\nLD X" + number(1, 24) + "\nOUT T" + number(0, 50) +
            " K500\nLD> D" + number(0, 400) + " K20\nMOV K7 D" + number(100, 400) + "\nLD M" +
            number(8, 300) + "\nOUT C" + number(2, 16) + " K9\n";
  }
  return text + "LD M299\nOUT Y30\nEND\n";
}

constexpr const char* kMotion =
    "AREA C\nF K30000\nLAB K1\nLIN K200000 K150000 K100000\nLIN K0 K0 K0\nJMP K1\nEND\n"
    "AREA U\nRPM K300\nLAB K1\nDRV K500000\nDRV K0\nJMP K1\nEND\n";

std::unique_ptr<World> make_world(std::size_t devices, const std::string& program) {
  return make_devices(devices, "super-40nc", program, 1, [](auto& device, std::size_t d) {
    device.settings.set = {{"D9003", 3},
                           {"D9000", static_cast<emulator::Value>(d % kStationsALine) + 1},
                           {"D9004", 10'000 + static_cast<emulator::Value>(d)}};
  });
}

std::unique_ptr<World> make_busy(std::size_t devices) {
  auto world = make_world(devices, ladder(true) + kMotion);
  for (std::size_t d = 0; d < devices; ++d) {
    set(world->device(d), "M8000", 1);
    set(world->device(d), "M8400", 1);
  }
  world->advance_to(time_of(kWarmUp));
  return world;
}

void measure_ticks() {
  const auto one = make_busy(1);
  const auto all = make_busy(kCrowd);
  Tick done_by_one = kWarmUp;
  Tick done_by_all = kWarmUp;
  std::vector<double> alone;
  std::vector<double> in_crowd;
  std::vector<double> ratios;
  for (int round = 0; round < kRounds; ++round) {
    alone.push_back(ticks_ns(*one, done_by_one, kTicks));
    in_crowd.push_back(ticks_ns(*all, done_by_all, kTicksOfCrowd));
    ratios.push_back(in_crowd.back() / alone.back());
  }
  std::printf("a tick, PLC, C on a path of three axes and U in a DRV: %.0f ns alone, %.0f ns among %zu\n",
              median(alone), median(in_crowd), kCrowd);
  print_verdict("a tick, relative to 1 us", median(alone) / 1000 / kTickBar_us, 1.00);
  print_verdict("a device's tick among 200, relative to its tick alone", median(ratios), kCrowdBar);
}

void measure_settled() {
  std::vector<double> seconds;
  for (int round = 0; round < 5; ++round) {
    const auto world = make_world(1, ladder(false));
    world->advance_to(time_of(kWarmUp));
    const auto before = processor_time_here();
    world->advance_to(time_of(kWarmUp + kHour));
    seconds.push_back(std::chrono::duration<double>(processor_time_here() - before).count());
  }
  const double simulated = static_cast<double>(kHour) / 1000 / median(seconds);
  std::printf("settled and at rest: %.0f simulated seconds per second\n", simulated);
  print_verdict("20,000 simulated seconds per second, relative to that rate", kSettledBar / simulated, 1.00);
}

/// Fills all path files and recipes.
std::string full_files() {
  std::string text;
  for (int file = 1; file < 20; ++file) {
    text += "FILE " + std::to_string(file) + "\n";
    for (int line = 0; line < 374; ++line) {
      const std::string far = std::to_string(line * 1000 + file);
      text += "LIN K" + far + " K-" + far + " K" + far + " K-" + far + "\n";
    }
    text += "END\n";
  }
  return text;
}

void fill(World& world) {
  emulator::Device& device = world.device(0);
  device.user_program()->load_program(full_files());
  for (int recipe = 0; recipe < 100; ++recipe) {
    set(device, "D9002", recipe);
    for (int number = 500; number < 1000; ++number) {
      set(device, "D" + std::to_string(number), -1'000'000 - 1000 * recipe - number);
    }
  }
}

void measure_memory() {
  constexpr std::size_t kMany = 30;
  const auto first = make_busy(1);  // now the data that all devices share exists
  const double before = heap_bytes();
  const auto many = make_busy(kMany);
  const double each = (heap_bytes() - before) / kMany;
  const double before_full = heap_bytes();
  const auto full = make_busy(1);
  fill(*full);
  const double of_full = heap_bytes() - before_full;
  std::printf("memory of a device: %.0f KiB, with every file and recipe full %.0f KiB\n", each / 1024,
              of_full / 1024);
  print_verdict("a device, relative to 512 KiB", each / kBytesBar, 1.00);
  print_verdict("a full device, relative to 2 MiB", of_full / kFullBytesBar, 1.00);
  const double empty_us = snapshot_us(*first, "D1");
  const double full_us = snapshot_us(*full, "D1");
  std::printf("snapshot and restore: %.0f us, full %.0f us\n", empty_us, full_us);
  print_verdict("snapshot and restore, relative to 200 us", empty_us / kSnapshotBar_us, 1.00);
  print_verdict("of a full device, relative to 1 ms", full_us / kFullSnapshotBar_us, 1.00);
}

}  // namespace

}  // namespace understudy::benchmarks

int main() {
  using namespace understudy::benchmarks;
  return run_benchmark("super_40nc", [] {
    measure_memory();
    measure_ticks();
    measure_settled();
  });
}
