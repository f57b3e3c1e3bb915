// Many ticks in one step while axes move: the same world as with single ticks, for any setup. Benches,
// choices and events are drawn at random; UNDERSTUDY_SEED and UNDERSTUDY_COURSES override.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "emulator/device/axes.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/world/stepping.h"

namespace understudy::emulator::world {
namespace fast_forward_test {

using namespace std::chrono_literals;

std::uint64_t seed() { return seed_or(99'001); }

int courses(int usual) {
  const char* given = std::getenv("UNDERSTUDY_COURSES");
  return given != nullptr ? std::atoi(given) : usual;
}

/// A bench of two Simple2-R3 and the events on it.
class RandomCourse {
 public:
  explicit RandomCourse(std::uint64_t seed_value) : random_(seed_value) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  bool one_in(std::int64_t many) { return between(1, many) == 1; }
  std::int64_t of_any_size(std::int64_t max) {
    std::uniform_real_distribution<double> exponent(0, std::log2(static_cast<double>(max)));
    return std::llround(std::exp2(exponent(random_)));
  }

  std::string bench() {
    std::string text = "understudy: 1\nseed: " + std::to_string(between(1, 1000)) +
                       "\nlines:\n  rs485:\n    timing: " + (one_in(3) ? "wire" : "instant") +
                       "\n    stations:\n" + station("feeder", 1) + station("turner", 2) + "plant:\n";
    for (const char* axis : {"feeder.A", "feeder.B", "turner.A", "turner.B"}) text += machine(axis);
    return text + "wires: [ feeder.DOUT_4 -> turner.DIN_3, turner.DOUT_5 -> feeder.DIN_9 ]\n";
  }

  struct Act {
    SimTime at{0};
    std::string name{};  // a register
    std::int64_t value = 0;
    int input = -1;  // of the first device
    int power = -1;
    std::optional<FaultText> fault{};
    bool clears = false;
  };

  std::vector<Act> acts(int count) {
    std::vector<Act> all;
    SimTime time{0};
    for (const char* device : {"feeder", "turner"}) {
      all.push_back({.at = time, .name = std::string(device) + ".ALL_SVON", .value = 1});
    }
    for (int i = 0; i < count; ++i) {
      time += one_in(3) ? SimTime{between(0, 20'000'000)} : SimTime{between(0, 900'000'000)};
      act(time, all);
    }
    return all;
  }

 private:
  std::string station(const std::string& name, int address) {
    std::string choices;
    for (const ChoiceRow& row : find_model(models::all_models(), "simple2-r3")->choices) {
      const auto options = options_of(row);
      if (options.size() == 1 || !one_in(4)) continue;
      choices +=
          (choices.empty() ? "" : ", ") + std::string(row.id) + ": " +
          std::string(
              options[static_cast<std::size_t>(between(0, static_cast<std::int64_t>(options.size()) - 1))]);
    }
    std::string set;
    for (const char* pin : {"DIN2_Aaxis_UP_Limit", "DIN3_Aaxis_DN_Limit", "DIN4_Aaxis_Home"}) {
      if (one_in(2)) set += (set.empty() ? "" : ", ") + std::string(pin) + ": 1";
    }
    for (const char* polarity : {"Aaxis_DIR_Polarity", "Baxis_DIR_Polarity", "Baxis_ENC_Polarity"}) {
      if (one_in(3)) set += (set.empty() ? "" : ", ") + std::string(polarity) + ": 1";
    }
    return "      - { name: " + name + ", model: simple2-r3, address: " + std::to_string(address) +
           (one_in(4) ? ", firmware: \"1.40\"" : "") + ", set: { " + set + " }, choices: { " + choices +
           " } }\n";
  }

  std::string machine(const std::string& axis) {
    std::string what;
    const auto add = [&](const std::string& more) { what += (what.empty() ? "" : ", ") + more; };
    if (one_in(2)) {
      add("encoder: { per_revolution: " + std::to_string(of_any_size(20'000)) +
          (one_in(3) ? ", reversed: true }" : " }"));
    }
    if (one_in(3)) add("home: { at: " + std::to_string(between(-400, 400)) + ", width: 30 }");
    if (one_in(3)) add("limits: { lower: " + std::to_string(between(-90'000, -1'000)) + ", upper: 60000 }");
    if (one_in(4)) add("travel: [" + std::to_string(between(-90'000, -1'000)) + ", 70000]");
    if (one_in(4)) add("drive: { ready_after: 30ms }");
    return "  " + axis + ": { " + what + " }\n";
  }

  void act(SimTime time, std::vector<Act>& all) {
    const std::string device = one_in(2) ? "feeder." : "turner.";
    const std::string axis = device + (one_in(2) ? "Aaxis_" : "Baxis_");
    const auto write = [&](const std::string& name, std::int64_t value) {
      all.push_back({.at = time, .name = name, .value = value});
    };
    switch (between(0, 15)) {
      case 0: write(axis + "GoHome", 1); break;
      case 1:
      case 2: write(axis + "DirectmRPM", between(-1, 1) * of_any_size(2'000'000)); break;
      case 3: write(axis + "STOP", 1); break;
      case 4: write(axis + "Speed", between(0, 300)); break;
      case 5: write(axis + (one_in(3) ? "SyncMode" : "ACLR"), 1); break;
      case 6: write(axis + "SVON", !one_in(4)); break;
      case 7:
        all.push_back({.at = time, .value = between(0, 1), .input = static_cast<int>(between(0, 10))});
        break;
      case 8:
        if (one_in(3))
          all.push_back({.at = time, .value = !one_in(3), .power = static_cast<int>(between(0, 1))});
        break;
      case 9: all.push_back({.at = time, .fault = some_fault()}); break;
      case 10: all.push_back({.at = time, .clears = true}); break;
      default:
        write(axis + "Pulse", between(-1, 1) * of_any_size(400'000));
        write(axis + "Speed", one_in(8) ? 0 : of_any_size(2'000));
        write(axis + "AccTime", between(0, 60));
        write(axis + "DecTime", between(0, 60));
        write(axis + (one_in(3) ? "Move_ABS" : "Move_INC"), 1);
    }
  }

  FaultText some_fault() {
    static const FaultText kFaults[] = {
        {"stall", "feeder.A", {{"for", "40ms"}}},
        {"lost_steps", "turner.B", {{"one_in", "7"}, {"for", "200ms"}}},
        {"alarm", "turner.A", {{"for", "90ms"}}},
        {"stuck", "feeder.DIN_2", {{"level", "1"}, {"for", "50ms"}}},
        {"slip", "feeder.B", {{"pulses", "13"}}},
        {"stall", "feeder.B", {{"when", "feeder.A.pulses > 700"}, {"for", "30ms"}}}};
    return kFaults[between(0, std::size(kFaults) - 1)];
  }

  std::mt19937_64 random_;
};

void apply(World& world, const RandomCourse::Act& act) {
  if (!act.name.empty()) {
    if (world.device(act.name[0] == 'f' ? 0 : 1).powered())
      set(world, act.name, static_cast<Value>(act.value));
  } else if (act.input >= 0) {
    world.set_external_input(0, act.input, static_cast<std::int32_t>(act.value));
  } else if (act.power >= 0) {
    world.switch_power(static_cast<std::size_t>(act.power), act.value != 0);
  } else if (act.fault) {
    world.inject(find_fault(world.known(), *act.fault));
  } else if (act.clears) {
    world.clear_faults();
  }
}

World world_of(const std::string& bench) {
  return World(parse_bench(models::all_models(), bench, "course.yaml", "."), {}, {});
}

TEST(WorldFastForward, RandomCoursesAreTheSameInBulkAndByTicks) {
  std::uint64_t skipped = 0;
  std::uint64_t run = 0;
  std::uint64_t single = 0;
  for (int i = 0; i < courses(150); ++i) {
    RandomCourse course(seed() + static_cast<std::uint64_t>(i));
    const std::string bench = course.bench();
    World plain = world_of(bench);
    World twin = world_of(bench);
    const std::string name = "UNDERSTUDY_SEED=" + std::to_string(seed() + static_cast<std::uint64_t>(i)) +
                             " UNDERSTUDY_COURSES=1\n" + bench;
    for (const RandomCourse::Act& act : course.acts(25)) {
      plain.advance_to(act.at);
      by_single_ticks(twin, act.at);
      ASSERT_TRUE(same(plain, twin)) << name << format_duration(act.at);
      for (std::size_t d = 0; d < 2; ++d) {
        ASSERT_TRUE(saves_the_same(plain.device(d), twin.device(d))) << name << format_duration(act.at);
        for (const int axis : {0, 1})
          ASSERT_EQ(plain.sent_pulses(d, axis), twin.sent_pulses(d, axis)) << name;
      }
      apply(plain, act);
      apply(twin, act);
    }
    const SimTime end = plain.now() + 20s;
    plain.advance_to(end);
    by_single_ticks(twin, end);
    ASSERT_TRUE(same(plain, twin)) << name << "at the end";
    skipped += plain.ticks_skipped();
    run += plain.ticks_run();
    single += twin.ticks_run();
  }
  // The test is meaningful only if many ticks are skipped, and axes move.
  EXPECT_LT(run * 3, single);
  EXPECT_GT(skipped, 10'000u);
}

std::string one_device(const std::string& plant) {
  return "understudy: 1\nlines:\n  rs485: { timing: instant, stations: [ { name: feeder, model: simple2-r3, "
         "address: 1 } ] }\nplant:\n  feeder.A: " +
         plant + "\n";
}

TEST(WorldFastForward, AnHourLongMoveIsAFewTicks) {
  // 3200 pulses per revolution at 60 rpm: 3200 pulses per second, for an hour.
  for (const char* plant :
       {"{ }", "{ encoder: { per_revolution: 4000 } }",
        "{ limits: { lower: -100, upper: 20000000 }, home: { at: 5000000, width: 10 } }"}) {
    World world = world_of(one_device(plant));
    set(world, "feeder.ALL_SVON", 1);
    set(world, "feeder.Aaxis_Pulse", 3'600 * 3'200);
    set(world, "feeder.Aaxis_Speed", 60);
    set(world, "feeder.Aaxis_AccTime", 50);
    set(world, "feeder.Aaxis_DecTime", 50);
    set(world, "feeder.Aaxis_Move_INC", 1);
    world.advance_to(1h + 10s);
    EXPECT_EQ(world.plant(0, 0).position_pulses(), 3'600 * 3'200) << plant;
    EXPECT_FALSE(world.device(0).axes()->speed_pps(0) != 0);
    EXPECT_LT(world.ticks_run(), 500u) << plant;
  }
}

TEST(WorldFastForward, AnHourInVelocityModeToo) {
  World world = world_of(one_device("{ encoder: { per_revolution: 4000 } }"));
  set(world, "feeder.ALL_SVON", 1);
  set(world, "feeder.Aaxis_DirectmRPM", 60'000);
  world.advance_to(1h);
  // 2 rpm per second from the factory: half of it while the speed rises.
  EXPECT_NEAR(static_cast<double>(world.plant(0, 0).position_pulses()), (3'600.0 - 15) * 3'200, 3'200);
  EXPECT_LT(world.ticks_run(), 2'000u);
}

TEST(WorldFastForward, AWatcherSeesEveryTick) {
  struct Eye final : TickWatcher {
    void on_tick(Tick) override { ++ticks; }
    int ticks = 0;
  } eye;
  World world = world_of(one_device("{ }"));
  world.add_watcher(eye);
  set(world, "feeder.ALL_SVON", 1);
  set(world, "feeder.Aaxis_DirectmRPM", 60'000);
  world.advance_to(5s);
  EXPECT_EQ(eye.ticks, 5'000);
  world.remove_watcher(eye);
}

TEST(WorldFastForward, RestoredItFastForwardsAgain) {
  World world = world_of(one_device("{ }"));
  set(world, "feeder.ALL_SVON", 1);
  set(world, "feeder.Aaxis_DirectmRPM", 60'000);
  world.advance_to(5s);
  const WorldState snapshot = save(world);
  world.advance_to(1h);
  restore(world, snapshot);
  const std::uint64_t before = world.ticks_run();
  world.advance_to(10min);
  EXPECT_LT(world.ticks_run() - before, 100u);
}

}  // namespace fast_forward_test
}  // namespace understudy::emulator::world
