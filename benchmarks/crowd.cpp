// Measures a thousand busy Simple2-R3 in one process: the work of a tick, compared with that of a single
// device in its own world, and how late a 1 kHz loop that does this work wakes up, compared with a loop that
// does nothing. The two sides of each comparison take turns, so that other load on the machine affects both.
// Loops wait as the daemon does.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "benchmarks/busy_bench.h"
#include "benchmarks/figures.h"
#include "benchmarks/process.h"
#include "benchmarks/processor_clock.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::benchmarks {

namespace {

using emulator::serve::EventLoop;
using emulator::serve::wall_now;
using emulator::world::World;

constexpr std::size_t kDevices = 1000;
constexpr int kDefaultSeconds = 20;
constexpr int kTicksASlice = 1000;
constexpr Tick kWarmUp = 3000;
constexpr double kLatenessBar = 1.5;
constexpr double kCrowdBar = 2.0;
constexpr int kRounds = 41;
constexpr Tick kTicksOfAll = 100;        // in a round
constexpr Tick kTicksOfOne = 20 * 1000;  // take about a fifth of that time

double microseconds(Nanoseconds time) { return static_cast<double>(time.count()) / 1000; }

struct Slice {
  std::vector<double> lateness_us;  // from the due time to the wake-up
  std::vector<double> work_us;
};

/// Wakes up at every millisecond for a second, and does `work` each time.
template <typename Work>
Slice run_slice(EventLoop& loop, Work work) {
  Slice slice;
  slice.lateness_us.reserve(kTicksASlice);
  slice.work_us.reserve(kTicksASlice);
  Nanoseconds due = emulator::serve::wall_now() + 2 * kTickLength;
  for (int i = 0; i < kTicksASlice; ++i, due += kTickLength) {
    while (emulator::serve::wall_now() < due) loop.wait(due);
    slice.lateness_us.push_back(microseconds(emulator::serve::wall_now() - due));
    const Nanoseconds before = processor_time_here();
    work();
    slice.work_us.push_back(microseconds(processor_time_here() - before));
  }
  return slice;
}

/// Advances the world by this many ticks, one at a time. Returns the processor time per tick and device.
double tick_ns(World& world, Tick& done, Tick ticks) {
  const Nanoseconds before = processor_time_here();
  for (const Tick end = done + ticks; done < end;) world.advance_to(time_of(++done));
  const auto took = static_cast<double>((processor_time_here() - before).count());
  return took / static_cast<double>(ticks) / static_cast<double>(world.device_count());
}

/// Compares a device's tick among others with its tick alone. The ratio depends mostly on the processor's
/// caches.
void compare_with_one(World& all, Tick& done) {
  const std::unique_ptr<World> one = make_busy_world(1, Activity::positions);
  Tick done_by_one = kWarmUp;
  one->advance_to(time_of(done_by_one));
  std::vector<double> in_crowd;
  std::vector<double> alone;
  std::vector<double> ratios;
  for (int round = 0; round < kRounds; ++round) {
    alone.push_back(tick_ns(*one, done_by_one, kTicksOfOne));
    in_crowd.push_back(tick_ns(all, done, kTicksOfAll));
    ratios.push_back(in_crowd.back() / alone.back());
  }
  std::printf("a device's tick: %.1f ns alone, %.1f ns among %zu; medians of %d alternating rounds\n",
              median(alone), median(in_crowd), kDevices, kRounds);
  print_verdict("a device's tick among 1000, relative to its tick alone", median(ratios), kCrowdBar);
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void print_row(const char* what, const std::vector<double>& samples) {
  std::printf("%-28s %10.1f %10.1f %10.1f %10.1f\n", what, percentile(samples, 0.5),
              percentile(samples, 0.99), percentile(samples, 0.999), percentile(samples, 1.0));
}

void run(int seconds) {
  const std::unique_ptr<World> world = make_busy_world(kDevices, Activity::positions);
  EventLoop loop;
  Tick tick = kWarmUp;
  world->advance_to(time_of(tick));
  const auto run_tick = [&] {
    const std::uint64_t run_before = world->ticks_run();
    world->advance_to(time_of(++tick));
    if (world->ticks_run() == run_before) throw CannotRun("the devices are not busy");
  };

  compare_with_one(*world, tick);
  std::vector<double> unpaced_us;
  for (int i = 0; i < 5 * kTicksASlice; ++i) {
    const Nanoseconds before = processor_time_here();
    run_tick();
    unpaced_us.push_back(microseconds(processor_time_here() - before));
  }
  Slice bare;
  Slice ours;
  std::vector<double> ratios;  // one for each pair of seconds
  for (int second = 0; second < seconds; ++second) {
    const Slice nothing = run_slice(loop, [] {});
    const Slice crowd = run_slice(loop, run_tick);
    ratios.push_back(percentile(crowd.lateness_us, 0.999) / percentile(nothing.lateness_us, 0.999));
    append(bare.lateness_us, nothing.lateness_us);
    append(ours.lateness_us, crowd.lateness_us);
    append(ours.work_us, crowd.work_us);
  }
  std::array<double, 1> load{};
  getloadavg(load.data(), 1);
  std::printf("%zu busy devices in one world, %d seconds of each loop; load average %.1f\n", kDevices,
              seconds, load[0]);
  std::printf("%-28s %10s %10s %10s %10s\n", "microseconds", "p50", "p99", "p99.9", "max");
  print_row("a tick's work, back to back", unpaced_us);
  print_row("a tick's work, at 1 kHz", ours.work_us);
  print_row("lateness of a bare loop", bare.lateness_us);
  print_row("lateness with the devices", ours.lateness_us);
  print_verdict("p99.9 of lateness, relative to the bare loop's, median over pairs of seconds",
                median(ratios), kLatenessBar);
}

}  // namespace

}  // namespace understudy::benchmarks

/// Usage: crowd [SECONDS]
int main(int count, char** arguments) {
  using namespace understudy::benchmarks;
  try {
    const int seconds = count > 1 ? std::atoi(arguments[1]) : kDefaultSeconds;
    if (seconds < 1) throw CannotRun("SECONDS: expected a positive number");
    run(seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "crowd: %s\n", error.what());
    return 2;
  }
}
