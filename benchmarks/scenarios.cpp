// Measures scenarios: a whole suite in virtual time, starting one, recording it, saving and restoring the
// state of a busy world.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/busy_bench.h"
#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"
#include "emulator/models/models.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/snapshot.h"

namespace understudy::benchmarks {

namespace {

using emulator::play::Scenario;
using emulator::play::ScenarioResult;
using emulator::world::World;

constexpr int kRounds = 21;
constexpr double kSuiteBar = 1.0 / 2000;  // processor time per simulated time
constexpr double kStartBar = 1;           // relative to the time of a suite's scenario
constexpr double kRecordingBar = 1.05;
constexpr double kSnapshotBar = 1;  // relative to the time to make the world

double seconds_of(std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); }

template <typename Work>
double processor_seconds(Work work) {
  const auto begin = processor_time_here();
  work();
  return seconds_of(processor_time_here() - begin);
}

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (path.ends_with(".yaml") && emulator::play::kind_of_file(path) == emulator::play::FileKind::scenario) {
      files.push_back(path);
    }
  }
  return files;
}

struct Played {
  std::size_t scenarios = 0;
  double simulated_s = 0;
};

/// Reads, checks and runs them, as `understudy run` does.
template <typename OptionsFor>
Played play_all(const std::vector<std::string>& files, OptionsFor options_for) {
  Played played;
  emulator::play::SharedReading shared{
      .models = emulator::models::all_models(), .benches = {}, .included = {}};
  for (const std::string& file : files) {
    for (const Scenario& scenario : emulator::play::load_scenarios(file, "", shared)) {
      ++played.scenarios;
      for (const ScenarioResult& result : emulator::play::run_scenario(scenario, options_for(scenario))) {
        played.simulated_s += seconds_of(result.simulated);
      }
    }
  }
  return played;
}

/// Records everything into a string.
class RecordingObserver final : public emulator::play::Observer {
 public:
  RecordingObserver(World& world, const emulator::world::RecordingHeader& header)
      : recorder_(world, header, [this](std::string_view line) { text_ += line; }) {}
  void world_restored(std::size_t) override {}
  void finish(ScenarioResult&) override {}

 private:
  std::string text_;
  emulator::world::Recorder recorder_;
};

emulator::play::RunOptions recorded(const Scenario& scenario) {
  emulator::play::RunOptions options;
  options.observers.push_back([&](World& world) {
    const emulator::world::RecordingHeader header{.version = "",
                                                  .bench = emulator::world::to_text(scenario.bench),
                                                  .options = {},
                                                  .seed = 0,
                                                  .snapshot = {}};
    return std::make_unique<RecordingObserver>(world, header);
  });
  return options;
}

/// Returns the milliseconds per scenario.
double measure_suite(const std::string& folder) {
  const std::vector<std::string> files = files_in(folder);
  Played played;
  std::vector<double> plain;
  std::vector<double> ratios;
  for (int round = 0; round < kRounds; ++round) {
    plain.push_back(processor_seconds(
        [&] { played = play_all(files, [](const Scenario&) { return emulator::play::RunOptions{}; }); }));
    ratios.push_back(processor_seconds([&] { play_all(files, recorded); }) / plain.back());
  }
  const double each_s = median(plain);
  std::printf("%zu scenarios of %s: %.1f simulated seconds in %.1f ms, %.0f times real time\n",
              played.scenarios, folder.c_str(), played.simulated_s, 1000 * each_s,
              played.simulated_s / each_s);
  print_verdict("the suite's processor time, relative to 1/2000 of its simulated time",
                each_s / played.simulated_s / kSuiteBar, 1);
  print_verdict("the suite with recordings, relative to without", median(ratios), kRecordingBar);
  return 1000 * each_s / static_cast<double>(played.scenarios);
}

void measure_start(const std::string& folder, double scenario_ms) {
  const std::string text =
      "understudy: 1\nname: start\n"
      "bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
      "steps: [ advance: 1ms ]\n";
  std::vector<double> starts_ms;
  for (int round = 0; round < 10 * kRounds; ++round) {
    starts_ms.push_back(
        1000 * processor_seconds([&] {
          emulator::play::run_scenario(
              emulator::play::parse_scenarios(emulator::models::all_models(), text, folder + "/start.yaml")
                  .front());
        }));
  }
  std::printf("reading, checking and starting a scenario: %.3f ms\n", median(starts_ms));
  print_verdict("starting a scenario, relative to running one of the suite", median(starts_ms) / scenario_ms,
                kStartBar);
}

void measure_snapshots() {
  const auto world = make_busy_world(1, Activity::positions);
  world->advance_to(std::chrono::seconds(1));
  std::vector<double> both_us;
  std::vector<double> made_us;
  std::size_t bytes = 0;
  for (int round = 0; round < 100 * kRounds; ++round) {
    made_us.push_back(1e6 * processor_seconds([] { make_busy_world(1, Activity::positions); }));
    both_us.push_back(1e6 * processor_seconds([&] {
                        const emulator::world::WorldState state = emulator::world::save(*world);
                        emulator::world::restore(*world, state);
                        if (round == 0) {
                          for (const auto& part : state.parts) bytes += part.bytes.size();
                        }
                      }));
  }
  std::printf(
      "a snapshot of a busy world of one device: %zu bytes; with its restore %.1f us, making the world "
      "%.1f us\n",
      bytes, median(both_us), median(made_us));
  print_verdict("a snapshot and its restore, relative to making the world", median(both_us) / median(made_us),
                kSnapshotBar);
}

}  // namespace

}  // namespace understudy::benchmarks

int main(int argc, char** argv) {
  using namespace understudy::benchmarks;
  const std::string folder = argc > 1 ? argv[1] : SCENARIOS_FOLDER;
  try {
    measure_start(folder, measure_suite(folder));
    measure_snapshots();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scenarios: %s\n", error.what());
    return 2;
  }
}
