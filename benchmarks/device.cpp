// Measures the cost of a Simple2-R3: a tick of a world with one device, in each of its modes, compared with
// the bare arithmetic of a tick; and simulated seconds per second.
#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "benchmarks/busy_bench.h"
#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"

namespace understudy::benchmarks {

namespace {

using emulator::world::World;

constexpr int kRounds = 15;
constexpr Tick kTicks = 100'000;  // in a round
constexpr Tick kWarmUp = 20'000;  // ramps, first reads of tables
constexpr double kTickBar = 40;   // bare loops
constexpr Tick kHour = 3'600'000;
constexpr double kHourBar = 0.1;  // bare loops per tick

double nanoseconds_each(Tick count, const std::function<void()>& work) {
  const auto start = processor_time_here();
  work();
  return static_cast<double>((processor_time_here() - start).count()) / static_cast<double>(count);
}

/// The minimum work of a tick of two axes (one "bare loop"): two cubics, compared with limits, and stored.
struct BareAxis {
  double place, first, second, third, low, high;
  std::int64_t pulses;
};

double bare_tick() {
  std::array<BareAxis, 2> axes{{{0, 10, 0.001, 1e-9, -1e15, 1e15, 0}, {0, 11, 0.001, 1e-9, -1e15, 1e15, 0}}};
  return nanoseconds_each(kTicks, [&] {
    for (Tick tick = 1; tick <= kTicks; ++tick) {
      const auto k = static_cast<double>(tick);
      for (BareAxis& axis : axes) {
        const double place = axis.place + k * (axis.first + k * (axis.second + k * axis.third));
        if (place >= axis.low && place <= axis.high) axis.pulses = static_cast<std::int64_t>(place);
      }
      asm volatile("" : : "g"(&axes) : "memory");  // computes tick after tick, and stores all of it
    }
  });
}

class Contestant {
 public:
  explicit Contestant(Activity activity) : activity_(activity), world_(make_busy_world(1, activity)) {
    run(kWarmUp);
  }

  void run_round() {
    samples_.push_back(nanoseconds_each(kTicks, [&] { run(kTicks); }));
  }

  Activity activity() const { return activity_; }
  const std::vector<double>& samples() const { return samples_; }
  /// Returns the share of ticks that were run, not fast-forwarded.
  double share_run() const {
    const auto run = static_cast<double>(world_->ticks_run());
    return run / (run + static_cast<double>(world_->ticks_skipped()));
  }

 private:
  void run(Tick count) {
    const Tick until = tick_ + count;
    if (activity_ == Activity::sync) {
      for (; tick_ < until; world_->advance_to(time_of(++tick_))) turn_encoders(*world_, tick_ + 1);
    } else {
      world_->advance_to(time_of(tick_ = until));
    }
  }

  Activity activity_;
  std::unique_ptr<World> world_;
  Tick tick_ = 0;
  std::vector<double> samples_;
};

/// A position move of an hour, from a command to its end, without any event.
struct HourLongMove {
  double each_ns = 0;  // per tick
  std::uint64_t ticks_run = 0;
};

HourLongMove move_for_an_hour() {
  const std::unique_ptr<World> world = make_busy_world(1, Activity::idle);
  begin_hour_long_move(*world);
  const double each_ns = nanoseconds_each(kHour, [&] { world->advance_to(time_of(kHour + 1000)); });
  return {each_ns, world->ticks_run()};
}

void print_hour(std::span<const double> bare) {
  std::vector<double> ratios;
  HourLongMove last;
  double all_ns = 0;
  for (const double loop_ns : bare) {
    last = move_for_an_hour();
    ratios.push_back(last.each_ns / loop_ns);
    all_ns += last.each_ns;
  }
  std::printf("a move of an hour: %.0f us, %llu of %lld ticks run one by one\n",
              all_ns / static_cast<double>(bare.size()) * static_cast<double>(kHour) / 1000,
              static_cast<unsigned long long>(last.ticks_run), static_cast<long long>(kHour));
  print_verdict("a move of an hour, per tick, relative to a bare loop", median(ratios), kHourBar);
}

void run() {
  std::vector<double> bare;
  std::vector<std::unique_ptr<Contestant>> all;
  for (const Activity activity : {Activity::positions, Activity::velocity, Activity::sync, Activity::homing,
                                  Activity::waiting, Activity::idle}) {
    all.push_back(std::make_unique<Contestant>(activity));
  }
  for (int round = 0; round < kRounds; ++round) {
    bare.push_back(bare_tick());
    for (const auto& contestant : all) contestant->run_round();
  }
  std::printf("a world of one device, both axes and a program busy; medians of %d rounds of %lld ticks\n",
              kRounds, static_cast<long long>(kTicks));
  std::printf("%-24s %10s %12s %12s %18s\n", "", "ns/tick", "x bare loop", "ticks run", "simulated s/s");
  std::printf("%-24s %10.2f\n", "bare loop", median(bare));
  double busy = 0;  // bare loops
  for (const auto& contestant : all) {
    const double each_ns = median(contestant->samples());
    std::vector<double> ratios;
    for (std::size_t i = 0; i < bare.size(); ++i) ratios.push_back(contestant->samples()[i] / bare[i]);
    std::printf("%-24s %10.2f %12.1f %10.1f %% %18.0f\n", name_of(contestant->activity()).data(), each_ns,
                median(ratios), 100 * contestant->share_run(), 1e6 / each_ns);
    if (contestant->activity() == Activity::positions) busy = median(ratios);
  }
  print_hour(bare);
  print_verdict("a tick, both axes in position moves and a program running, relative to a bare loop", busy,
                kTickBar);
}

}  // namespace

}  // namespace understudy::benchmarks

int main() {
  using namespace understudy::benchmarks;
  try {
    run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "device: %s\n", error.what());
    return 2;
  }
}
