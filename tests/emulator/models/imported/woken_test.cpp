// Registers that show a relation or a view change with the pulses of an axis, and everything that depends on
// them is updated in time: a wire from an output, and an axis whose speed is such a register.
#include <gtest/gtest.h>

#include "tests/emulator/model_file/described.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::models::imported {
namespace woken_test {

const std::string kList =
    "table,address,name,access,width,signed\n"
    "holding,0,GO,R/W,16,0\n"
    "holding,1,SPEED,R/W,16,0\n"
    "holding,2,POSITION,R,32,1\n"
    "holding,4,Y_SPEED,R/W,16,0\n"
    "holding,5,Y_NOW,R,16,1\n"
    "holding,6,Y_COUNTS,R,32,1\n"
    "coil,0,ZONE,R,1,0\n"
    "coil,1,FAST,R,1,0\n"
    "coil,2,TURNED,R,1,0\n";

world::World world_of(const std::string& x_speed) {
  const std::string model = model_file::model_with(
      kList,
      "outputs: { ZONE_OUT: ZONE, FAST_OUT: FAST, TURNED_OUT: TURNED }\naxes:\n  X: { speed: " + x_speed +
          ", forward: GO.0, position: POSITION }\n"
          "  Y: { speed: Y_SPEED, acceleration_time: 2s, forward: GO.1, actual_speed: Y_NOW,\n"
          "       encoder: Y_COUNTS, pulses_per_revolution: 200 }\n"
          "shows: { ZONE: POSITION > 5000, FAST: Y_NOW > 50, TURNED: Y_COUNTS >= 100 }\n");
  const std::string bench =
      "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: it, model: " +
      model_file::quoted_scalar(model) +
      " } ] }, b: { stations: [ { name: n, model: simple2-r3 } ] } }\n"
      "plant: { it.Y: { encoder: { per_revolution: 100 } } }\n"
      "wires: [ it.ZONE_OUT -> n.DIN_0, it.FAST_OUT -> n.DIN_1, it.TURNED_OUT -> n.DIN_2 ]\n";
  return {world::parse_bench(model_file::with_described(), bench, "bench.yaml", "."), {}, {}};
}

Tick tick_of(world::World& world, int input) {
  const Tick first = tick_at(world.now());
  while (world.device(1).input(input) == 0 && tick_at(world.now()) < first + 20'000)
    world.advance_to(world.now() + kTickLength);
  return tick_at(world.now()) - first;
}

/// Finds the moment by single ticks; in one long step it is on at this moment, and not before.
void expect_in_time(int input, Value go) {
  const auto begin = [&](world::World& world) {
    world::set(world, "it.SPEED", 1000);
    world::set(world, "it.Y_SPEED", 100);
    world::set(world, "it.GO", go);
  };
  world::World by_ticks = world_of("SPEED");
  begin(by_ticks);
  by_ticks.set_bulk_ticks(false);
  const Tick tick = tick_of(by_ticks, input);
  ASSERT_LT(tick, 20'000);
  for (const Tick each : {tick - 1, tick, tick + 3000}) {
    world::World world = world_of("SPEED");
    begin(world);
    world.advance_to(time_of(each));
    EXPECT_EQ(world.device(1).input(input) != 0, each >= tick) << each << " of " << tick;
  }
}

TEST(DescribedWires, HaveWhatARelationShowsOfAPositionAtItsTick) { expect_in_time(0, 1); }
TEST(DescribedWires, HaveWhatARelationShowsOfASpeedAtItsTick) { expect_in_time(1, 2); }
TEST(DescribedWires, HaveWhatARelationShowsOfAnEncoderAtItsTick) { expect_in_time(2, 2); }

TEST(DescribedWires, CostNothingWhereTheAxesStand) {
  world::World world = world_of("SPEED");
  world.advance_to(std::chrono::hours(1));
  EXPECT_LT(world.ticks_run(), 100U);
}

/// X runs at the speed of Y, to the pulse of each tick, one tick later.
TEST(DescribedAxes, FollowASpeedThatAnotherOneShows) {
  world::World world = world_of("Y_NOW");
  world::set(world, "it.Y_SPEED", 100);
  world::set(world, "it.GO", 3);
  world.advance_to(std::chrono::seconds(2));  // Y's ramp: 100 pulses
  EXPECT_NEAR(static_cast<double>(world::get(world, "it.POSITION")), 100, 2);
  world.advance_to(std::chrono::seconds(12));
  EXPECT_NEAR(static_cast<double>(world::get(world, "it.POSITION")), 1100, 2);
  world::set(world, "it.Y_SPEED", 10);
  world.advance_to(std::chrono::seconds(112));
  const double y = static_cast<double>(world.plant(0, 1).position_pulses());
  EXPECT_NEAR(static_cast<double>(world::get(world, "it.POSITION")), y, 4);
}

}  // namespace woken_test
}  // namespace understudy::emulator::models::imported
