// Differences of two snapshots are reported by path and name, and every difference is reported.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "emulator/models/simple2_r3/device.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/state_fields.h"
#include "emulator/world/stations/rtu_station.h"
#include "emulator/world/stations/station_fields.h"
#include "tests/emulator/world/two_devices.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace snapshot_difference_test {

using namespace std::chrono_literals;

models::simple2_r3::State& state_of(World& world, std::size_t device) {
  return dynamic_cast<models::simple2_r3::Simple2R3&>(world.device(device)).state();
}

TEST(SnapshotDifference, IsReportedByPathAndName) {
  struct Case {
    std::string reported;
    std::function<void(World& world)> change;
  };
  const std::vector<Case> cases = {
      {"", [](World&) {}},
      {"world.inputs[0][4].external: 0 against 1", [](World& w) { set_input(w, "feeder.DIN_4", true); }},
      {"world.faults[1]: nothing against something",
       [](World& w) {
         w.inject(find_fault(w.known(), {"stall", "turner.B", {}}));
       }},
      {"feeder.image[Aaxis_SVON]: 0 against 1", [](World& w) { set(w, "feeder.Aaxis_SVON", 1); }},
      {"turner.image[MAIN_LINE{}_CMD+2]: 0 against 7",
       [](World& w) { state_of(w, 1).image[models::simple2_r3::slot("MAIN_LINE{}_CMD") + 2] = 7; }},
      {"turner.axes[1].motor.travel_pulses: 0 against 5",
       [](World& w) { state_of(w, 1).axes[1].motor.travel_pulses = 5; }},
      {"feeder.axes[0].homed: false against true", [](World& w) { state_of(w, 0).axes[0].homed = true; }},
      {"feeder.program.lines[255].flag: 0 against 9",
       [](World& w) { state_of(w, 0).program.set_cell(1023, 9); }},
      {"feeder.timers[1].value: 0 against 3", [](World& w) { state_of(w, 0).timers[1].value = 3; }},
      {"rs485.is_host_open: true against false", [](World& w) { w.host_closed(0); }},
      {"rs485.turner.counters.replies: 0 against 2",
       [](World& w) {
         auto& station = dynamic_cast<RtuStation&>(*w.line(0).stations[1]);
         RtuStation::State state = station.save();
         state.counters.replies = 2;
         StateWriter writer;
         writer.write(state);
         const std::vector<std::byte> bytes = writer.take();
         StateReader reader(bytes);
         station.read_state(reader)();
       }},
      {"rs485.edge.counters.bytes_discarded: 0 against 4",
       [](World& w) {
         pty::Line::State state = w.line(0).line.save();
         state.edge.counters.bytes_discarded = 4;
         StateOf<World>::line(w, 0).restore(state);
       }},
  };
  for (const auto& [reported, change] : cases) {
    World world = make_world("wire");
    world.advance_to(50ms);
    const WorldState before = save(world);
    change(world);
    EXPECT_EQ(difference(world, before, save(world)), reported);
  }
}

TEST(SnapshotDifference, OfMachinesIsReportedByTheirAxes) {
  World one = make_world("wire");
  World other = make_world("wire");
  const auto push = [](World& world, const std::string& pulses) {
    world.inject(find_fault(world.known(), {"slip", "turner.B", {{"pulses", pulses}}}));
    world.advance_to(1ms);
  };
  push(one, "30");
  push(other, "31");
  EXPECT_EQ(difference(one, save(one), save(other)), "turner.B.machine.position_pulses: 30 against 31");
}

/// Any changed byte that gives another state of the world gives a named difference.
void expect_all_told(World& world) {
  const WorldState state = save(world);
  const std::size_t step = is_sanitized() ? 19 : 7;
  std::size_t reported = 0;
  for (std::size_t part = 0; part < state.parts.size(); ++part) {
    for (std::size_t at = 0; at < state.parts[part].bytes.size(); at += step) {
      WorldState other = state;
      other.parts[part].bytes[at] ^= std::byte{1};
      try {
        const std::string found = difference(world, state, other);
        EXPECT_NE(found, "") << state.parts[part].name << " byte " << at;
        EXPECT_EQ(found.find("other bytes"), std::string::npos) << found;
        EXPECT_NE(found.find(" against "), std::string::npos) << found;
        ++reported;
      } catch (const StateError&) {
        // It is not a state of such a world.
      }
    }
  }
  EXPECT_GT(reported * step, 3500U);
  EXPECT_EQ(difference(world, state, state), "");
}

TEST(SnapshotDifference, NothingOfASimple2StaysUntold) {
  World world = make_world("wire");
  world.inject(find_fault(world.known(), {"drop", "feeder", {{"nth", "3"}}}));
  world.receive(0, write_request(1, 0x1014, 1), 0ns);
  world.advance_to(3ms);
  expect_all_told(world);
}

TEST(SnapshotDifference, NothingOfASlimStaysUntold) {
  World world(
      parse_bench(models::all_models(),
                  "understudy: 1\nlines: { t: { stations: [ { name: chain, model: slim, modules: 2 } ] } }\n",
                  "t.yaml", "."),
      {}, {});
  for (const std::string line : {"DLP\r", "MA 1000\r", "END\r", "MR 500\r", "T1MR 200\r", "N3=7\r"}) {
    world.receive(0, {reinterpret_cast<const std::uint8_t*>(line.data()), line.size()}, world.now());
    world.advance_to(world.now() + 20ms);
  }
  expect_all_told(world);
}

TEST(SnapshotDifference, WhatIsNotOfSuchAWorldIsRefused) {
  World world = make_world();
  const WorldState state = save(world);
  WorldState torn = state;
  torn.parts[1].bytes.pop_back();
  EXPECT_THROW(difference(world, state, torn), StateError);
  EXPECT_THROW(difference(world, torn, state), StateError);
  torn = state;
  torn.parts.pop_back();
  EXPECT_THROW(difference(world, state, torn), StateError);
}

}  // namespace snapshot_difference_test
}  // namespace understudy::emulator::world
