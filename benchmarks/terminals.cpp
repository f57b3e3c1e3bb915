// Measures terminals at rest: a tick of the tests' controller with its 320 grouped terminals, compared with
// the same controller without them, while its motors run and its hand wheel turns.
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/trace/trace.h"
#include "emulator/world/world.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::benchmarks {

namespace {

namespace workbench = emulator::workbench;
using emulator::Model;
using emulator::world::World;

constexpr int kRounds = 31;
constexpr Tick kTicks = 50'000;
constexpr double kBar = 1.02;

const Model& model_without_groups() {
  static const Model made = [] {
    Model without = workbench::model();
    without.terminals = without.terminals.first(workbench::kFirstOfGroups);
    without.terminal_groups = {};
    without.make = [](const emulator::DeviceSettings& settings) -> std::unique_ptr<emulator::Device> {
      return std::make_unique<workbench::Workbench>(model_without_groups(), settings);
    };
    return without;
  }();
  return made;
}

std::unique_ptr<World> make_world(const Model& model) {
  const emulator::ListedModel models[] = {&model};
  auto world = std::make_unique<World>(
      emulator::world::parse_bench(
          models,
          "understudy: 1\nlines: { a: { stations: [ { name: it, model: workbench } ] } }\n"
          "plant: { it.A: { limits: { lower: -5 }, encoder: { per_revolution: 400 } } }\n"
          "faults: [ { turn: it.MPG, counts: 1000000000, in: 100000s } ]\n",
          "bench.yaml", "/tmp"),
      emulator::world::WorldOptions{}, [](const std::string&) {});
  auto& device = static_cast<workbench::Workbench&>(world->device(0));
  motion::SpeedLaw law;
  law.top_speed_u_s = 10'000;
  law.up = law.down = motion::RampLaw::by_slope(100'000);
  for (workbench::Motor& motor : device.state.motors.motors) motor.axis.run(+1, law, device.now());
  return world;
}

double nanoseconds_each(World& world) {
  const auto start = processor_time_here();
  world.advance_to(world.now() + kTicks * kTickLength);
  return static_cast<double>((processor_time_here() - start).count()) / static_cast<double>(kTicks);
}

/// Returns the median of the pairs' ratios.
double compare(const char* what, World& with, World& without) {
  std::vector<double> ratios;
  std::vector<double> times;
  nanoseconds_each(with);
  nanoseconds_each(without);
  for (int round = 0; round < kRounds; ++round) {
    const bool is_first = round % 2 == 0;
    const double one = nanoseconds_each(is_first ? with : without);
    const double other = nanoseconds_each(is_first ? without : with);
    times.push_back(is_first ? one : other);
    ratios.push_back(is_first ? one / other : other / one);
  }
  std::printf("%-24s %8.1f ns per tick with terminals, %6.3f times that without\n", what, median(times),
              median(ratios));
  return median(ratios);
}

void run() {
  const auto with = make_world(workbench::model());
  const auto without = make_world(model_without_groups());
  const double ratio = compare("no observer", *with, *without);
  {
    const auto signals = [](const World& world) { return emulator::world::trace_signals(world, {}); };
    const auto format = [] { return emulator::world::vcd_format([](std::string_view) {}); };
    const emulator::world::Trace of_one(*with, signals(*with), format());
    const emulator::world::Trace of_other(*without, signals(*without), format());
    compare("with a trace", *with, *without);
  }
  print_verdict("a tick with 320 terminals at rest, relative to one without", ratio, kBar);
}

}  // namespace

}  // namespace understudy::benchmarks

int main() {
  try {
    understudy::benchmarks::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "terminals: %s\n", error.what());
    return 2;
  }
}
