#include "emulator/world/world.h"
#include "emulator/device/terminals.h"

#include <gtest/gtest.h>

#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace world_test {

using namespace std::chrono_literals;

TEST(World, HasNothingDueWhileIdle) {
  World world = make_world();
  world.advance_to(1ms);  // the machine is on its home switch: seen in the first tick
  EXPECT_EQ(world.next_due(), std::nullopt);
  world.advance_to(std::chrono::hours(24));
  EXPECT_EQ(world.next_due(), std::nullopt);
  EXPECT_EQ(world.now(), std::chrono::hours(24));
  EXPECT_EQ(world.device(0).now(), 86'400'000);
  EXPECT_LT(world.ticks_run(), 10u);
  EXPECT_EQ(world.ticks_run() + world.ticks_skipped(), 86'400'000u);
}

TEST(World, IsDueNextTickAfterOutsideInputAndThenAtItsOwnEvent) {
  World world = make_world();
  world.advance_to(10'300us);
  set(world, "feeder.Aaxis_SVON", 1);
  EXPECT_EQ(world.next_due(), 11ms);
  world.advance_to(11ms);
  EXPECT_EQ(world.next_due(), std::nullopt);
  set_input(world, "turner.DIN_3", true);
  EXPECT_EQ(world.next_due(), 12ms);
  world.advance_to(12ms);
  EXPECT_EQ(world.next_due(), std::nullopt);

  set(world, "turner.Baxis_ACLR", 1);  // 200 ticks from tick 13 on
  world.advance_to(13ms);
  EXPECT_EQ(world.next_due(), 213ms);
  world.advance_to(213ms);
  EXPECT_EQ(get(world, "turner.Baxis_ACLR"), 0);

  set(world, "feeder.Aaxis_Pulse", 5);
  set(world, "feeder.Aaxis_Move_INC", 1);  // at speed 0: it does not end, and nothing happens
  world.advance_to(220ms);
  EXPECT_EQ(world.next_due(), std::nullopt);
  set(world, "feeder.Aaxis_Speed", 200);
  set(world, "feeder.Aaxis_Move_INC", 1);
  world.advance_to(221ms);
  EXPECT_EQ(world.next_due(), 231ms);  // the end of its ramp: until then it only continues
  world.advance_to(300ms);
  EXPECT_EQ(get(world, "feeder.Cord_A"), 5);
  world.advance_to(400ms);  // the encoder's speed covers 100 ms after its start
  EXPECT_EQ(world.next_due(), std::nullopt);
}

TEST(World, IsDueWhenACharacterIsOnItsLine) {
  World world = make_world("wire", 115'200);
  world.advance_to(5ms);
  world.receive(0, Bytes{0x55}, 5ms);
  EXPECT_EQ(world.next_due(), 5ms + 95'486ns);  // 11 bits
}

TEST(World, TimesInThePastDoNothing) {
  World world = make_world();
  world.advance_to(7'500us);
  world.advance_to(3ms);
  world.advance_to(-1ms);
  EXPECT_EQ(world.now(), 7'500us);
  EXPECT_EQ(world.device(0).now(), 7);
}

TEST(World, ATickComesBeforeAFrameAtTheSameInstant) {
  // Sent so that 8 characters and the silence of 750 us end at exactly 20 ms; then a nanosecond earlier.
  const SimTime exchange = SimTime{8LL * 11 * 1'000'000'000 / 19'200} + 750us;
  for (const bool in_time : {true, false}) {
    World world = make_world("wire", 19'200);
    set(world, "feeder.Aaxis_SVON", 1);
    set(world, "feeder.Aaxis_Resoultion", 3000);
    set(world, "feeder.Aaxis_Pulse", 100);
    set(world, "feeder.Aaxis_Speed", 20);
    const SimTime served = in_time ? 20ms - 1ns : 20ms;
    world.advance_to(served - exchange);
    world.receive(0, write_request(1, 0x1005, 1), served - exchange);
    world.advance_to(20ms - 1ns);
    EXPECT_EQ(get(world, "feeder.Aaxis_Move_INC"), in_time);
    world.advance_to(20ms);
    EXPECT_EQ(get(world, "feeder.Aaxis_Move_INC"), 1);
    // 1 pulse/ms with ramps of 10 ms takes 110 ms. Served before tick 20 it has t = 0 there; at 20 ms it is
    // served after that tick, and has t = 0 in tick 21.
    const Tick end = (in_time ? 20 : 21) + 110;
    world.advance_to(time_of(end - 1));
    EXPECT_EQ(get(world, "feeder.STATUS.4"), 1);
    world.advance_to(time_of(end));
    EXPECT_EQ(get(world, "feeder.STATUS.4"), 0);
  }
}

TEST(World, ARequestReadsWhatTheTickAtItsInstantHasDone) {
  World world = make_world("instant");
  set(world, "feeder.Aaxis_SVON", 1);
  set(world, "feeder.Aaxis_Resoultion", 3000);
  set(world, "feeder.Aaxis_Pulse", 100);
  set(world, "feeder.Aaxis_Speed", 20);
  set(world, "feeder.Aaxis_Move_INC", 1);  // t = 0 in tick 1
  // Given in advance: one for the last nanosecond of tick 49, one for the moment of tick 50.
  world.receive(0, read_request(1, 0x0E04, 1), 50ms - 1ns);
  world.receive(0, read_request(1, 0x0E04, 1), 50ms);
  world.advance_to(60ms);
  EXPECT_EQ(take_output(world), [] {
    Bytes both = framed({0x01, 0x03, 0x02, 0x00, 43});  // t = 48 ms: 48 - 5
    const Bytes second = framed({0x01, 0x03, 0x02, 0x00, 44});
    both.insert(both.end(), second.begin(), second.end());
    return both;
  }());
}

TEST(Wires, ReachTheOtherDeviceOneTickLater) {
  World world = make_world();
  world.advance_to(10'500us);
  set(world, "feeder.DOUT_4", 1);
  world.advance_to(11ms);  // the output's tick
  EXPECT_EQ(get(world, "turner.DIN_10"), 0);
  world.advance_to(12ms);
  EXPECT_EQ(get(world, "turner.DIN_10"), 1);
  set(world, "feeder.DOUT_4", 0);
  world.advance_to(13ms);
  EXPECT_EQ(get(world, "turner.DIN_10"), 1);
  world.advance_to(14ms);
  EXPECT_EQ(get(world, "turner.DIN_10"), 0);
}

TEST(Wires, CarryWhatADeviceDoesByItselfWithTheSameTick) {
  World world = make_world();
  set(world, "feeder.DOUT1_Aaxis_ACLR", 1);
  world.advance_to(10ms);
  set(world, "feeder.Aaxis_ACLR", 1);  // on in ticks 11 to 210
  for (const Tick tick : {11, 12, 13, 209, 210, 211, 212, 213}) {
    world.advance_to(time_of(tick));
    EXPECT_EQ(world.device(0).terminals()->output(11 + 1), tick < 211) << tick;
    EXPECT_EQ(get(world, "turner.DIN_0"), tick >= 12 && tick < 212) << tick;
  }
}

TEST(Wires, OnOneInputActLikeSwitchesInParallelWithTheOutside) {
  World world = make_world();
  for (const int levels : {0, 1, 2, 3, 4, 5, 6, 7}) {
    set(world, "turner.DOUT_0", levels & 1);
    set(world, "turner.DOUT_5", (levels >> 1) & 1);
    set_input(world, "feeder.DIN_7", (levels & 4) != 0);
    world.advance_to(world.now() + 2ms);
    EXPECT_EQ(get(world, "feeder.DIN_7"), levels != 0) << levels;
  }
}

TEST(Wires, StopAnAxisTwoTicksAfterTheWrite) {
  World world = make_world();
  for (const auto& [name, value] :
       std::vector<std::pair<std::string_view, Value>>{{"feeder.Baxis_SVON", 1},
                                                       {"feeder.DIN7_Baxis_UP_Limit", 1},
                                                       {"feeder.Baxis_Resoultion", 3000},
                                                       {"feeder.Baxis_Pulse", 1000},
                                                       {"feeder.Baxis_Speed", 20},
                                                       {"feeder.Baxis_Move_INC", 1}}) {
    ASSERT_EQ(set(world, name, value), Refusal::none) << name;
  }
  world.advance_to(106ms);  // t = 105 ms
  set(world, "turner.DOUT_5", 1);
  world.advance_to(200ms);
  EXPECT_EQ(get(world, "feeder.Cord_B"), 101);  // tick 107 still moves, tick 108 sees the input
}

TEST(World, AMachineOnASwitchAtPowerUpShowsItAtOnce) {
  World world = make_world();
  EXPECT_EQ(get(world, "feeder.DIN_4"), 1);
  EXPECT_EQ(get(world, "turner.DIN_9"), 0);
  world.advance_to(1ms);
  EXPECT_EQ(get(world, "feeder.DIN_4"), 1);
  EXPECT_EQ(get(world, "turner.DIN_9"), 0);
}

TEST(World, TwoDevicesOnALineAnswerEachForItself) {
  for (const std::string timing : {"instant", "wire"}) {
    World world = make_world(timing, 115'200);
    struct Case {
      int station;
      Bytes reply;  // to a read of Version
    };
    for (const auto& [station, reply] : std::vector<Case>{{1, framed({0x01, 0x03, 0x02, 0x00, 152})},
                                                          {2, framed({0x02, 0x03, 0x02, 0x00, 140})},
                                                          {3, {}},
                                                          {15, {}},
                                                          {0, {}}}) {
      world.receive(0, read_request(station, 0x0002, 1));
      world.advance_to(world.now() + 20ms);
      EXPECT_EQ(take_output(world), reply) << timing << " " << station;
    }
    world.receive(0, write_request(2, 0x1014, 1));
    world.advance_to(world.now() + 20ms);
    EXPECT_EQ(take_output(world), write_request(2, 0x1014, 1)) << timing;
    EXPECT_EQ(get(world, "feeder.Aaxis_SVON"), 0) << timing;
    EXPECT_EQ(get(world, "turner.Aaxis_SVON"), 1) << timing;
  }
}

TEST(World, ABroadcastIsExecutedByBothInSilence) {
  World world = make_world("wire", 19'200);
  world.receive(0, write_request(0, 0x1013, 1));  // ALL_SVON
  world.advance_to(20ms);
  EXPECT_EQ(take_output(world), Bytes{});
  EXPECT_EQ(get(world, "feeder.STATUS"), 0xC00);
  EXPECT_EQ(get(world, "turner.STATUS"), 0xC00);
}

TEST(World, DevicesOfOtherSettingsAreOfAnotherState) {
  World a = make_world();
  World b = make_world();
  EXPECT_TRUE(same_state(a.device(0), b.device(0)));
  set(a, "feeder.PROG_VAR0", 1);
  EXPECT_FALSE(same_state(a.device(0), b.device(0)));
  set(b, "feeder.PROG_VAR0", 1);
  EXPECT_TRUE(same_state(a.device(0), b.device(0)));
  a.advance_to(1ms);
  EXPECT_FALSE(same_state(a.device(0), b.device(0)));
}

}  // namespace world_test
}  // namespace understudy::emulator::world
