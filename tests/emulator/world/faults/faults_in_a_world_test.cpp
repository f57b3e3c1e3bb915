// Faults in a world: what they override, several in one place, and what returns when they are cleared.
#include <gtest/gtest.h>

#include <functional>

#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/faults/faulty_world.h"
#include "tests/emulator/world/same_world.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace faults_in_a_world_test {

using namespace std::chrono_literals;

TEST(StuckInputs, OverrideTheOutsideTheWiresAndTheMachine) {
  for (const int stuck : {0, 1}) {
    for (const int levels : {0, 1, 2, 3, 4, 5, 6, 7}) {
      World world = make_faulty_world();
      run(world, 5);
      const std::size_t number = inject(world, "stuck", "feeder.DIN_4", {{"level", stuck}});
      set_input(world, "feeder.DIN_4", (levels & 1) != 0);
      set(world, "turner.DOUT_5", (levels >> 1) & 1);
      if ((levels & 4) != 0) inject(world, "slip", "feeder.A", {{"pulses", 110}});  // onto the home switch
      run(world, 3);
      EXPECT_EQ(get(world, "feeder.DIN_4"), stuck) << levels;
      EXPECT_EQ(world.plant(0, 0).at_home(), (levels & 4) != 0) << "the switch itself works";
      ASSERT_TRUE(world.clear_fault(number));
      run(world, 1);
      EXPECT_EQ(get(world, "feeder.DIN_4"), levels != 0) << levels << ": as it would have been";
    }
  }
}

TEST(StuckInputs, AreStuckForWhatEachOfTheThreeDoesLater) {
  World world = make_faulty_world();
  inject(world, "stuck", "feeder.DIN_4", {{"level", 0}});
  for (const bool on : {true, false, true}) {
    set_input(world, "feeder.DIN_4", on);
    set(world, "turner.DOUT_5", on);
    inject(world, "slip", "feeder.A", {{"pulses", on ? 110 : -110}});
    for (int i = 0; i < 4; ++i) {
      run(world, 1);
      EXPECT_EQ(get(world, "feeder.DIN_4"), 0);
    }
  }
}

TEST(StuckInputs, AreSeenFromTheNextTickOn) {
  World world = make_faulty_world();
  world.advance_to(100ms + 400us);
  const std::size_t number = inject(world, "stuck", "turner.DIN_3", {{"level", 1}});
  EXPECT_EQ(get(world, "turner.DIN_3"), 0);
  EXPECT_EQ(world.next_due(), 101ms);
  world.advance_to(101ms);
  EXPECT_EQ(get(world, "turner.DIN_3"), 1);
  world.clear_fault(number);
  EXPECT_EQ(get(world, "turner.DIN_3"), 1);
  world.advance_to(102ms);
  EXPECT_EQ(get(world, "turner.DIN_3"), 0);
}

TEST(Faults, HaveNumbersThatAreNotUsedAgain) {
  World world = make_faulty_world();
  EXPECT_EQ(inject(world, "stall", "feeder.A"), 1u);
  EXPECT_EQ(inject(world, "slip", "feeder.A", {{"pulses", 5}}), 2u);
  EXPECT_EQ(inject(world, "stall", "feeder.B"), 3u);
  EXPECT_FALSE(world.clear_fault(2)) << "ends at once";
  EXPECT_TRUE(world.clear_fault(3));
  EXPECT_FALSE(world.clear_fault(3));
  EXPECT_FALSE(world.clear_fault(0));
  EXPECT_FALSE(world.clear_fault(99));
  EXPECT_EQ(inject(world, "stall", "feeder.B"), 4u);
  ASSERT_EQ(world.faults().size(), 2u);
  EXPECT_EQ(world.faults().begin()->first, 1u);
  EXPECT_EQ(world.faults().rbegin()->first, 4u);
}

TEST(Faults, OfOneKindAtOnePlaceTheLatestRemainingOneCounts) {
  World world = make_faulty_world();
  const std::size_t off = inject(world, "stuck", "feeder.DIN_1", {{"level", 0}});
  const std::size_t on = inject(world, "stuck", "feeder.DIN_1", {{"level", 1}});
  const std::size_t rare = inject(world, "lost_steps", "feeder.A", {{"one_in", 50}});
  const std::size_t often = inject(world, "lost_steps", "feeder.A", {{"one_in", 2}});
  const std::size_t stall = inject(world, "stall", "feeder.A");
  const std::size_t again = inject(world, "stall", "feeder.A");
  const auto seen = [&] {
    run(world, 2);
    return get(world, "feeder.DIN_1");
  };
  EXPECT_EQ(seen(), 1);
  EXPECT_EQ(world.plant(0, 0).faults().loses_one_in, 2);
  world.clear_fault(on);
  world.clear_fault(often);
  world.clear_fault(stall);
  set_input(world, "feeder.DIN_1", true);
  EXPECT_EQ(seen(), 0);
  EXPECT_EQ(world.plant(0, 0).faults().loses_one_in, 50);
  EXPECT_TRUE(world.plant(0, 0).faults().stalled);
  world.clear_fault(off);
  world.clear_fault(rare);
  world.clear_fault(again);
  EXPECT_EQ(seen(), 1);
  EXPECT_EQ(world.plant(0, 0).faults(), MachineFaults{});
}

TEST(Faults, OfOtherKindsCoexistAndLeaveOtherPlacesAlone) {
  World world = make_faulty_world();
  inject(world, "stall", "feeder.A");
  inject(world, "lost_steps", "feeder.A", {{"one_in", 7}});
  const std::size_t alarm = inject(world, "alarm", "turner.B");
  inject(world, "stuck", "feeder.DIN_9", {{"level", 1}});
  EXPECT_EQ(world.plant(0, 0).faults(), (MachineFaults{.stalled = true, .loses_one_in = 7}));
  EXPECT_EQ(world.plant(0, 1).faults(), MachineFaults{});
  EXPECT_EQ(world.plant(1, 0).faults(), MachineFaults{});
  EXPECT_EQ(world.plant(1, 1).faults(), (MachineFaults{.alarm = true}));
  world.clear_fault(alarm);
  EXPECT_EQ(world.plant(0, 0).faults(), (MachineFaults{.stalled = true, .loses_one_in = 7}));
  EXPECT_EQ(world.plant(1, 1).faults(), MachineFaults{});
  EXPECT_EQ(world.device(0).input(9), 1);
}

TEST(Faults, AnUnrelatedOneDoesNotDisturbTheCountOfLostSteps) {
  // 1 pulse per tick; one in ten is lost, whatever other faults are added and cleared meanwhile.
  for (const bool disturbed : {false, true}) {
    World world = make_faulty_world();
    set(world, "feeder.Aaxis_SVON", 1);
    set(world, "feeder.Aaxis_Resoultion", 3000);
    set(world, "feeder.Aaxis_Pulse", 700);
    set(world, "feeder.Aaxis_Speed", 20);
    inject(world, "lost_steps", "feeder.A", {{"one_in", 10}});
    set(world, "feeder.Aaxis_Move_INC", 1);
    for (int i = 0; i < 400; ++i) {
      run(world, 2);
      if (!disturbed) continue;
      if (i % 7 == 0) inject(world, "stuck", "feeder.DIN_9", {{"level", 1}});
      if (i % 11 == 0)
        world.clear_fault(world.faults().rbegin()->first != 1 ? world.faults().rbegin()->first : 0);
    }
    EXPECT_EQ(get(world, "feeder.Cord_A"), 700);
    EXPECT_EQ(world.plant(0, 0).position_pulses(), 630) << disturbed;
    EXPECT_EQ(world.plant(0, 0).lost_pulses(), 70) << disturbed;
  }
}

TEST(Faults, OfTheBenchAreThereFromTheFirstTick) {
  World world = make_faulty_world(
      "inputs: { feeder.DIN_10: on, feeder.AIN_A: 2.5V, turner.DIP2: 1 }\n"
      "faults:\n"
      "  - { stuck: feeder.DIN_10, level: off }\n"
      "  - { stuck: feeder.DIN_1, level: 1 }\n"
      "  - { slip: feeder.A, pulses: 105 }\n"
      "  - { alarm: turner.B }\n");
  ASSERT_EQ(world.faults().size(), 3u);
  EXPECT_EQ(world.plant(0, 0).position_pulses(), 105);
  world.advance_to(1ms);
  EXPECT_EQ(get(world, "feeder.DIN_ALL"), 1 << 1 | 1 << 4) << "stuck, and the home switch";
  EXPECT_EQ(get(world, "feeder.ADC_A"), 1000);  // 400 per volt
  EXPECT_EQ(world.external_input(0, 10), 1);
  // Without an alarm, DIN_5 of an axis B would have a closed contact.
  EXPECT_EQ(get(world, "turner.DIN_5"), 0);
  world.clear_fault(world.faults().begin()->first);
  run(world, 1);
  EXPECT_EQ(get(world, "feeder.DIN_10"), 1) << "held on from outside";
}

TEST(Faults, InAQuietWorldAlsoTakeEffectInTheNextTick) {
  // Each fault in a world that skips quiet ticks and in one that runs every tick: both are equal after every
  // tick, and the effect occurs after exactly this many ticks.
  struct Case {
    std::string kind, place;
    std::vector<std::pair<std::string, std::int64_t>> amounts;
    std::function<bool(const World&)> effect;
    Tick after;
  };
  const auto reads = [](std::string name, Value value) {
    return [=](const World& world) { return get(world, name) == value; };
  };
  for (const Case& c : std::vector<Case>{
           {"stuck", "feeder.DIN_1", {{"level", 1}}, reads("feeder.DIN_1", 1), 1},
           // A contact of the machine moves in its tick, and the controller reads it in the next one.
           {"alarm", "feeder.A", {}, reads("feeder.DIN_0", 1), 2},
           {"alarm", "turner.B", {}, reads("turner.DIN_5", 0), 2},
           {"alarm", "turner.B", {}, [](const World& w) { return !w.plant(1, 1).ready(); }, 1},
           {"slip", "feeder.A", {{"pulses", 110}}, reads("feeder.DIN_4", 1), 2},
           {"slip", "feeder.A", {{"pulses", 110}}, reads("feeder.ENCA", -220), 1},
           {"slip",
            "turner.B",
            {{"pulses", 6000}},
            [](const World& w) { return w.plant(1, 1).position_pulses() == 5000; },
            1}}) {
    World bulk = make_faulty_world();
    World single = make_faulty_world();
    single.set_bulk_ticks(false);
    for (World* world : {&bulk, &single}) world->advance_to(1000ms + 300us);
    ASSERT_GT(bulk.ticks_skipped(), 900u);
    const Fault broken = fault(bulk, c.kind, c.place, c.amounts);
    ASSERT_FALSE(c.effect(bulk)) << to_text(bulk.known(), broken);
    for (World* world : {&bulk, &single}) world->inject(broken);
    for (Tick tick = 1; tick <= 5; ++tick) {
      for (World* world : {&bulk, &single}) world->advance_to(time_of(1000 + tick));
      EXPECT_EQ(c.effect(bulk), tick >= c.after) << to_text(bulk.known(), broken) << " tick " << tick;
      EXPECT_EQ(c.effect(single), tick >= c.after) << to_text(bulk.known(), broken) << " tick " << tick;
      for (std::size_t device = 0; device < 2; ++device) {
        EXPECT_TRUE(same_state(bulk.device(device), single.device(device))) << tick;
        for (int axis = 0; axis < 2; ++axis) {
          EXPECT_TRUE(same_state(bulk.plant(device, axis), single.plant(device, axis))) << tick;
        }
      }
    }
  }
}

TEST(ClearFaults, LeavesWhatClearingEachInTurnLeaves) {
  const auto broken = [](World& world) {
    run(world, 5);
    inject(world, "stuck", "feeder.DIN_4", {{"level", 1}});
    inject(world, "stall", "feeder.A", {});
    inject(world, "stuck", "feeder.DIN_4", {{"level", 0}});
    inject(world, "lost_steps", "feeder.A", {{"one_in", 5}});
    run(world, 3);
  };
  World at_once = make_faulty_world();
  broken(at_once);
  at_once.clear_faults();
  World in_turn = make_faulty_world();
  broken(in_turn);
  while (!in_turn.faults().empty()) in_turn.clear_fault(in_turn.faults().begin()->first);
  EXPECT_TRUE(at_once.faults().empty());
  run(at_once, 5);
  run(in_turn, 5);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(same_state(at_once.device(i), in_turn.device(i))) << i;
  at_once.clear_faults();  // there are none
}

TEST(ClearFaults, OfThousandsCostsLessThanInjectingThem) {
  // Each fault that is added or cleared alone causes all conditions of the others to be read again.
  using Clock = std::chrono::steady_clock;
  World world = make_faulty_world();
  const auto begin = Clock::now();
  const int count = is_sanitized() ? 500 : 2000;
  for (int i = 0; i < count; ++i) {
    Fault fault = find_fault(world.known(), {"stall", "feeder.A", {}});
    fault.trigger.when = "feeder.A.pulses > " + std::to_string(i + 1);
    world.inject(fault);
  }
  const auto injected = Clock::now();
  world.clear_faults();
  EXPECT_LT((Clock::now() - injected) * 2, injected - begin);
  EXPECT_TRUE(world.faults().empty());
}

}  // namespace faults_in_a_world_test
}  // namespace understudy::emulator::world
