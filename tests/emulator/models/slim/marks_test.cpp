// The marks of an activity on its module are gone when it ends, in any way: every activity with every way to
// end. Afterwards the module equals one that has never moved, and moves like it.
#include "emulator/models/slim/motor/marks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace marks_test {

constexpr int kIt = 0;
constexpr int kPartner = 1;

ChainOptions with(std::initializer_list<Option> chosen) {
  ChainOptions options;
  for (const Option each : chosen) options.choose(each);
  return options;
}

OneChain bench_with(const ChainOptions& options) {
  OneChain bench(options);
  bench.map({kIt, kPartner});
  for (const int module : {kIt, kPartner}) {
    bench.speeds(module, 10'000, 10'000);
    bench.jog_speed(module, 1000);
    bench.chain.settings().set_path_speed(module, 1000);
    bench.chain.settings().set_path_acceleration(module, 10'000);
  }
  return bench;
}

using Act = void (*)(OneChain& bench);

/// A running activity, and its marks at that time.
struct Motion {
  const char* name;
  Act begin;
  Act before = nullptr;  // what happened first, a while ago
  Tick ticks = 100;      // the mark that it has run
};

void analog(OneChain& bench, int value) {
  bench.chain.set_analog(kIt, value);
  bench.step();
}
void by_analog(OneChain& bench) {
  analog(bench, kFullAnalog);
  bench.chain.set_analog_speed(kIt);
}
void move(OneChain& bench) { bench.chain.move(kIt, false, 100'000); }
void jog(OneChain& bench) { bench.chain.jog(kIt, +1); }
void thrust(OneChain& bench) { bench.chain.thrust(kIt, 500); }
void home(OneChain& bench) { bench.chain.home(kIt); }
void line(OneChain& bench) { bench.line({100'000, 50'000}); }

constexpr Motion kMotions[] = {
    {"MR", move},
    {"MR by AVM", move, by_analog},
    {"MR that AVM stops", [](OneChain& bench) { analog(bench, 0); },
     [](OneChain& bench) {
       by_analog(bench);
       move(bench);
     },
     20},
    {"MR that AVM has stopped", [](OneChain& bench) { analog(bench, 0); },
     [](OneChain& bench) {
       by_analog(bench);
       move(bench);
     },
     3000},
    {"MR that AVM keeps from starting", move, [](OneChain& bench) { bench.chain.set_analog_speed(kIt); }},
    {"H", home},
    {"JGF", jog},
    {"JGF at 0",
     [](OneChain& bench) {
       bench.jog_speed(kIt, 0);
       jog(bench);
       bench.jog_speed(kIt, 1000);
     }},
    {"JGF that AVM stops", [](OneChain& bench) { analog(bench, 0); },
     [](OneChain& bench) {
       by_analog(bench);
       jog(bench);
     },
     20},
    {"JGF that AVM has stopped", [](OneChain& bench) { analog(bench, 0); },
     [](OneChain& bench) {
       by_analog(bench);
       jog(bench);
     },
     500},
    {"JGF that turns", [](OneChain& bench) { bench.chain.jog(kIt, -1); }, jog, 20},
    {"JGF before FT", thrust, jog, 20},
    {"JGF that stops", [](OneChain& bench) { bench.chain.jog(kIt, 0); }, jog, 20},
    {"FT", thrust},
    {"FT before JGR", [](OneChain& bench) { bench.chain.jog(kIt, -1); }, thrust, 20},
    {"JGR behind MR", [](OneChain& bench) { bench.chain.jog(kIt, -1); }, move, 20},
    {"FT behind MR", thrust, move, 20},
    {"2MR", line},
    {"2MR and 2MR",
     [](OneChain& bench) {
       line(bench);
       line(bench);
     }},
    {"MR and H behind it",
     [](OneChain& bench) {
       move(bench);
       home(bench);
     }},
};

void pause(OneChain& bench) {
  bench.chain.pause();
  bench.steps(50);
}
void pause_queues(OneChain& bench) {
  bench.chain.pause_queues();
  bench.steps(50);
}
void other_orders(OneChain& bench) {
  for (const int direction : {+1, -1}) {
    bench.chain.jog(kIt, direction);
    bench.steps(20);
    bench.chain.thrust(kIt, 7);
    bench.steps(20);
    bench.chain.move(kIt, false, 10);
    bench.steps(20);
  }
}

struct WayOut {
  enum Leaves : std::uint8_t { later, only_avm, nothing };
  const char* name;
  Act act;
  Leaves leaves = later;  // marks that are still set right after it; `later`: it takes some time
};
constexpr WayOut kWaysOut[] = {
    {"its end", [](OneChain& bench) { bench.steps(20'000); }},
    {"JG0", [](OneChain& bench) { bench.chain.jog(kIt, 0); }},
    {"TASTOP", [](OneChain& bench) { bench.chain.emergency_stop(); }, WayOut::only_avm},
    {"IHOFF", [](OneChain& bench) { bench.chain.set_servo_at_once(kIt, false); }, WayOut::nothing},
    {"IHOFF of its partner", [](OneChain& bench) { bench.chain.set_servo_at_once(kPartner, false); }},
    {"HOFF",
     [](OneChain& bench) {
       bench.chain.set_servo(kIt, false);
       bench.steps(20'000);
     }},
    {"RESET", [](OneChain& bench) { bench.chain.reset(kIt); }, WayOut::nothing},
    {"RESET of its partner", [](OneChain& bench) { bench.chain.reset(kPartner); }},
    {"other orders", other_orders},
    {"VM",
     [](OneChain& bench) {
       bench.chain.settings().set_working_speed(kIt, 1);
       bench.steps(50);
     }},
    {"voltage again", [](OneChain& bench) { analog(bench, kFullAnalog); }},
    {"TAPZ, TAUPZ",
     [](OneChain& bench) {
       pause(bench);
       bench.chain.discard();
     }},
    {"TAPZ, and TAUPZ at once",
     [](OneChain& bench) {
       bench.chain.pause();
       bench.chain.discard();
     }},
    {"TAPZ, TAREDO",
     [](OneChain& bench) {
       pause(bench);
       bench.chain.resume();
       bench.steps(50);
     }},
    {"TAPZ, JG0, TAREDO",
     [](OneChain& bench) {
       pause(bench);
       bench.chain.jog(kIt, 0);
       bench.chain.resume();
     }},
    {"TAPZ, TASTOP",
     [](OneChain& bench) {
       pause(bench);
       bench.chain.emergency_stop();
     },
     WayOut::only_avm},
    {"TAPZ, IHOFF",
     [](OneChain& bench) {
       pause(bench);
       bench.chain.set_servo_at_once(kIt, false);
     },
     WayOut::nothing},
    {"TAPZ, RESET",
     [](OneChain& bench) {
       pause(bench);
       bench.chain.reset(kIt);
     },
     WayOut::nothing},
    {"PZ, CLR BUF",
     [](OneChain& bench) {
       pause_queues(bench);
       bench.chain.clear_queues();
     }},
    {"PZ, REDO",
     [](OneChain& bench) {
       pause_queues(bench);
       bench.chain.resume_queues();
       bench.steps(50);
     }},
    {"PZ, TAPZ, TAREDO, REDO",
     [](OneChain& bench) {
       pause_queues(bench);
       pause(bench);
       bench.chain.resume();
       bench.steps(50);
       bench.chain.resume_queues();
       bench.steps(50);
     }},
    {"PZ, TAPZ, CLR BUF, TAUPZ",
     [](OneChain& bench) {
       pause_queues(bench);
       pause(bench);
       bench.chain.clear_queues();
       bench.chain.discard();
     }},
    {"PZ, voltage, other orders, CLR BUF",
     [](OneChain& bench) {
       pause_queues(bench);
       analog(bench, kFullAnalog);
       other_orders(bench);
       bench.chain.clear_queues();
     }},
    {"CLR BUF", [](OneChain& bench) { bench.chain.clear_queues(); }},
};

/// An event that stops a motion at once clears all marks, before anything else could.
void expect_left(const Module& module, WayOut::Leaves leaves) {
  for (const ModuleMark& mark : kModuleMarks) {
    const bool may_be_left =
        leaves == WayOut::later || (leaves == WayOut::only_avm && mark.name == "analog_speed");
    EXPECT_TRUE(may_be_left || mark.is_off(module)) << mark.name;
  }
}

/// An activity that its own end has not ended is ended here; then everything is as the bench set it.
void come_to_rest(OneChain& bench) {
  Chain& chain = bench.chain;
  chain.resume();
  chain.resume_queues();
  chain.jog(kIt, 0);
  bench.steps(100);
  chain.pause();
  chain.discard();
  bench.steps(2000);
  chain.settings().set_working_speed(kIt, 1);  // ends AVM
  for (const int module : {kIt, kPartner}) chain.set_servo_at_once(module, true);
  bench.step();
}

/// A module that has only been at that position: it has no mark at all.
Module unmarked(const Module& like) {
  Module module;
  module.settings = like.settings;
  module.linked = true;
  module.homed = like.homed;
  module.analog = like.analog;
  module.zero_pulses = like.zero_pulses;
  module.place_units = like.place_units;
  return module;
}

void expect_unmarked(const OneChain& bench) {
  for (const int number : {kIt, kPartner}) {
    const Module& module = bench.chain.module_at(number);
    for (const ModuleMark& mark : kModuleMarks) EXPECT_TRUE(mark.is_off(module)) << mark.name;
    EXPECT_EQ(module, unmarked(module));
    EXPECT_EQ(module.place_units, bench.chain.coordinate(number));
    EXPECT_FALSE(bench.chain.axis(number).moving());
    EXPECT_FALSE(bench.chain.busy(number));
  }
  EXPECT_EQ(bench.chain.groups_running(), 0);
  EXPECT_FALSE(bench.chain.paused() || bench.chain.queues_paused());
}

Tick ticks_of_a_move(OneChain& bench) {
  const std::int64_t before = bench.travel(kIt);
  const Tick begin = bench.tick;
  EXPECT_EQ(bench.chain.move(kIt, false, 5000), Error::none);
  const Tick ticks = bench.finish() - begin;
  EXPECT_EQ(bench.travel(kIt), before + 5000);
  return ticks;
}

TEST(SlimMarks, EveryWayOutOfEveryActivityTakesThemOff) {
  OneChain fresh = bench_with({});
  const Tick expected = ticks_of_a_move(fresh);
  for (const ChainOptions& options :
       {with({option("jog_while_moving", "ends_the_move")}),
        with({option("jog_while_moving", "ends_the_move"), option("thrust", "runs_at_vj"),
              option("thrust_end", "a_move_too"), option("clear_buffer_in_pause", "what_waits"),
              option("pauses", "one_pause"),
              option("emergency_stop", "nothing_queued_not_paused_servo_off")})}) {
    for (const Motion& motion : kMotions) {
      for (const WayOut& way : kWaysOut) {
        SCOPED_TRACE(std::string(motion.name) + ", " + way.name);
        OneChain bench = bench_with(options);
        if (motion.before != nullptr) {
          motion.before(bench);
          bench.steps(200);
        }
        motion.begin(bench);
        bench.steps(motion.ticks);
        EXPECT_TRUE(bench.chain.busy(kIt)) << "it does nothing";
        way.act(bench);
        expect_left(bench.chain.module_at(kIt), way.leaves);
        come_to_rest(bench);
        expect_unmarked(bench);
        EXPECT_EQ(ticks_of_a_move(bench), expected);
        if (HasFailure()) return;
      }
    }
  }
}

/// A row clears its own member and no other; the events that clear it are tested above.
TEST(SlimMarks, ARowClearsItsOwnMemberAlone) {
  for (const ModuleMark& mark : kModuleMarks) {
    Module module;
    module.activity = Activity::jog;
    module.jog_direction = module.next_jog_direction = module.held_jog_direction = -1;
    module.thrust = module.next_thrust = module.held_thrust = 500;
    module.starved = module.analog_speed = true;
    mark.take_off(module);
    for (const ModuleMark& each : kModuleMarks)
      EXPECT_EQ(each.is_off(module), &each == &mark) << mark.name << ", " << each.name;
  }
}

/// A move that AVM has stopped is at rest, and is not a jog that waits for its voltage.
TEST(SlimMarks, AMoveWithoutVoltageLeavesNoneToItsSuccessor) {
  OneChain bench = bench_with({});
  by_analog(bench);
  move(bench);
  bench.steps(100);
  analog(bench, 0);
  bench.steps(3000);
  bench.chain.clear_queues();
  bench.chain.set_coordinate(kIt, 0.4);
  bench.step();
  EXPECT_EQ(bench.chain.module_at(kIt).place_units, 0.4);
  Chain skipped = bench.chain;
  std::array<std::int64_t, kModules> pulses{};
  skipped.fast_forward_to(bench.tick + 100, pulses);
  bench.steps(100);
  EXPECT_EQ(skipped, bench.chain);
}

}  // namespace marks_test
}  // namespace understudy::emulator::models::slim
