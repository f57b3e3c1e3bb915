// Many ticks of a SLIM in one step: random commands, pauses, switches and choices, the same as with single
// ticks. UNDERSTUDY_SEED and UNDERSTUDY_COURSES override.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/emulator/world/stepping.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace fast_forward_slim_test {

using namespace std::chrono_literals;

std::uint64_t seed() { return seed_or(99'501); }

int courses(int usual) {
  const char* given = std::getenv("UNDERSTUDY_COURSES");
  return given != nullptr ? std::atoi(given) : usual;
}

class RandomDialogue {
 public:
  explicit RandomDialogue(std::uint64_t seed_value) : random_(seed_value) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  bool one_in(std::int64_t many) { return between(1, many) == 1; }

  Bench bench() {
    Bench bench;
    DeviceSetup device;
    device.model = find_model(models::all_models(), "slim");
    device.settings.name = "robot";
    device.settings.modules = 3;
    for (const ChoiceRow& row : device.model->choices) {
      const auto options = options_of(row);
      if (options.size() == 1 || !one_in(5)) continue;
      device.settings.choices[std::string(row.id)] =
          options[static_cast<std::size_t>(between(0, static_cast<std::int64_t>(options.size()) - 1))];
    }
    bench.devices.push_back(device);
    LineSetup line;
    line.name = "rs232";
    line.stations.push_back(0);
    line.timing = pty::Timing::instant;
    bench.lines.push_back(line);
    for (int axis = 0; axis < 3; ++axis) {
      if (one_in(2)) continue;
      PlantSetup plant;
      const std::int64_t home = between(-60'000, 60'000);
      plant.home = PulseSpan{.first = home, .last = home + between(0, 4'000)};
      if (one_in(3)) plant.travel = PulseSpan{.first = -90'000, .last = 200'000};
      bench.machines.push_back({.device = 0, .axis = axis, .plant = plant});
    }
    return bench;
  }

  struct Act {
    SimTime at{0};
    std::string line{};
    int input = -1;
    std::int32_t level = 0;
    int power = -1;
  };

  std::vector<Act> acts(int count, const Model& model) {
    std::vector<Act> all;
    SimTime time{1'000'000};
    for (int i = 0; i < count; ++i) {
      time += one_in(3) ? SimTime{between(0, 20'000'000)} : SimTime{between(0, 1'500'000'000)};
      Act act{.at = time};
      if (one_in(12)) {
        do {
          act.input = static_cast<int>(between(0, static_cast<int>(model.terminals.size()) / 8 * 3 - 1));
        } while (!is_input(model.terminals[static_cast<std::size_t>(act.input)].kind));
        const TerminalRow& row = model.terminals[static_cast<std::size_t>(act.input)];
        act.level = static_cast<std::int32_t>(between(row.lowest, row.highest));
      } else if (one_in(60)) {
        act.power = !one_in(3);
      } else {
        act.line = line();
      }
      all.push_back(act);
    }
    return all;
  }

 private:
  std::string number(std::int64_t max) { return std::to_string(between(0, max)); }

  std::string line() {
    const std::string module = one_in(2) ? "" : one_in(2) ? "T1" : "T2";
    switch (between(0, 19)) {
      case 0: return module + "MA " + number(40'000);
      case 1: return module + "JGF";
      case 2: return module + "JGR";
      case 3: return module + "JG0";
      case 4: return module + "H";
      case 5: return module + "VM=" + number(900);
      case 6: return module + "VJ=" + number(300);
      case 7: return one_in(3) ? "TAPZ" : "TAREDO";
      case 8: return one_in(6) ? "TASTOP" : "TAREDO";
      case 9: return one_in(2) ? "PZ" : "REDO";
      case 10: return module + "P1SET 1," + number(20'000);
      case 11: return module + "SET P1";
      case 12: return "2MR " + number(20'000) + "," + number(20'000);
      case 13: return module + "AVM";
      case 14: return module + "?PE";
      case 15: return "ON EV1,$E";
      default: return module + "MR " + std::to_string(between(-1, 1) * between(1, 80'000));
    }
  }

  std::mt19937_64 random_;
};

void apply(World& world, const RandomDialogue::Act& act) {
  if (act.input >= 0) {
    world.set_external_input(0, act.input, act.level);
  } else if (act.power >= 0) {
    world.switch_power(0, act.power != 0);
  } else {
    const std::string sent = act.line + "\r";
    world.receive(0, std::span(reinterpret_cast<const std::uint8_t*>(sent.data()), sent.size()));
  }
}

TEST(SlimFastForward, RandomDialoguesAreTheSameInBulkAndByTicks) {
  std::uint64_t run = 0;
  std::uint64_t single = 0;
  std::int64_t moved = 0;
  for (int i = 0; i < courses(fewer_if_sanitized(120, 3)); ++i) {
    const std::uint64_t course = seed() + static_cast<std::uint64_t>(i);
    RandomDialogue dialogue(course);
    const Bench bench = dialogue.bench();
    World plain(bench, {}, {});
    World twin(bench, {}, {});
    const std::string name = "UNDERSTUDY_SEED=" + std::to_string(course) + " UNDERSTUDY_COURSES=1 at ";
    for (const RandomDialogue::Act& act : dialogue.acts(40, *bench.devices[0].model)) {
      plain.advance_to(act.at);
      by_single_ticks(twin, act.at);
      ASSERT_TRUE(same(plain, twin)) << name << format_duration(act.at);
      for (const int axis : {0, 1, 2}) {
        ASSERT_EQ(plain.sent_pulses(0, axis), twin.sent_pulses(0, axis)) << name << format_duration(act.at);
        moved += std::abs(plain.sent_pulses(0, axis));
      }
      apply(plain, act);
      apply(twin, act);
    }
    const SimTime end = plain.now() + 30s;
    plain.advance_to(end);
    by_single_ticks(twin, end);
    ASSERT_TRUE(same(plain, twin)) << name << "the end";
    run += plain.ticks_run();
    single += twin.ticks_run();
  }
  EXPECT_LT(run * 2, single);
  EXPECT_GT(moved, fewer_if_sanitized(100'000, 3));
}

TEST(SlimFastForward, AMoveOfAnHourIsAFewTicks) {
  RandomDialogue dialogue(1);
  Bench bench = dialogue.bench();
  bench.machines.clear();
  bench.devices[0].settings.choices.clear();
  World world(bench, {}, {});
  for (const char* line : {"VM=60", "MR 36000000"}) apply(world, {.line = line});
  world.advance_to(90min);
  EXPECT_EQ(world.sent_pulses(0, 0), 36'000'000);
  EXPECT_LT(world.ticks_run(), 500u);
}

}  // namespace fast_forward_slim_test
}  // namespace understudy::emulator::world
