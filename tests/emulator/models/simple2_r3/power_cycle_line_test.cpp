// Power cycles as the line sees them: half-sent and half-received messages, requests right after power-up,
// the other station on the line, the speed that the DIP switches set.
//
// At 19200 baud a character of 11 bits takes 572 917 ns; a device replies 750 us after a request's last one.
#include <gtest/gtest.h>

#include "emulator/device/axes.h"
#include "emulator/models/models.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::models::simple2_r3 {
namespace power_cycle_line_test {

using namespace std::chrono_literals;

constexpr std::size_t kFeeder = 0;
constexpr std::size_t kTurner = 1;

constexpr SimTime characters(std::int64_t count, std::int64_t baud = 19'200) {
  return SimTime{(count * 11 * 1'000'000'000 + baud - 1) / baud};
}

struct PoweredLine {
  explicit PoweredLine(const std::string& timing = "wire", int baud = 19'200)
      : world(world::parse_bench(all_models(), world::two_devices(timing, baud), "two.yaml", "."), {},
              [this](const std::string& line) { log.push_back(line); }) {}

  void to(SimTime time) { world.advance_to(time); }
  void say(const world::Bytes& bytes) { world.receive(0, bytes); }
  void power(std::size_t device, bool on) { world.switch_power(device, on); }
  void cycle(std::size_t device) {
    power(device, false);
    power(device, true);
  }
  world::Bytes received() { return world::take_output(world); }
  /// Says it now, and what comes back within 100 ms.
  world::Bytes ask(const world::Bytes& bytes) {
    received();
    say(bytes);
    to(world.now() + 100ms);
    return received();
  }

  std::vector<std::string> log;
  world::World world;
};

const world::Bytes kSetSpeed = world::write_request(1, 0x1002, 200);  // its reply is the same
const world::Bytes kReadHardware = world::read_request(1, 0x0001, 1);
const world::Bytes kHardware = world::framed({1, 3, 2, 0xC0, 0x01});
const world::Bytes kHardwareOfTurner = world::framed({2, 3, 2, 0xC0, 0x01});

TEST(PowerCycleOnTheLine, AFrameOfWhichItMissedABeginningIsNotReceived) {
  for (std::size_t before = 1; before < kSetSpeed.size(); ++before) {
    for (const char* timing : {"wire", "instant"}) {
      PoweredLine line(timing);
      line.to(20ms);
      line.say(world::Bytes(kSetSpeed.begin(), kSetSpeed.begin() + static_cast<std::ptrdiff_t>(before)));
      line.to(20ms + characters(static_cast<std::int64_t>(before)));
      line.cycle(kFeeder);
      line.say(world::Bytes(kSetSpeed.begin() + static_cast<std::ptrdiff_t>(before), kSetSpeed.end()));
      line.to(200ms);
      EXPECT_EQ(line.received(), world::Bytes{}) << before << timing;
      EXPECT_EQ(world::get(line.world, "feeder.Aaxis_Speed"), 0) << before;
      EXPECT_EQ(line.ask(kReadHardware), kHardware) << "and it receives the next one";
    }
  }
}

TEST(PowerCycleOnTheLine, ARequestThatWasReceivedButNotServedYetIsForgotten) {
  PoweredLine line;
  line.to(20ms);
  line.say(kSetSpeed);
  line.to(20ms + characters(8) + 749us);
  line.cycle(kFeeder);
  line.to(200ms);
  EXPECT_EQ(line.received(), world::Bytes{});
  EXPECT_EQ(world::get(line.world, "feeder.Aaxis_Speed"), 0);
}

TEST(PowerCycleOnTheLine, OfAReplyTheHostGetsTheCharactersThatHadBegun) {
  const world::Bytes reply = kHardware;
  const SimTime begins = 20ms + characters(8) + 750us;
  for (const bool comes_back : {false, true}) {
    for (std::int64_t cut_us = -400; cut_us < 5000; cut_us += 100) {
      PoweredLine line;
      line.to(20ms);
      line.say(kReadHardware);
      const SimTime cut = begins + cut_us * 1us + 50us;  // in the middle between the edges of 100 us
      line.to(cut);
      line.power(kFeeder, false);
      if (comes_back) line.power(kFeeder, true);
      line.to(200ms);
      std::size_t begun = 0;
      while (begun < reply.size() && begins + characters(static_cast<std::int64_t>(begun)) < cut) ++begun;
      ASSERT_EQ(line.received(),
                world::Bytes(reply.begin(), reply.begin() + static_cast<std::ptrdiff_t>(begun)))
          << cut_us;
      if (!comes_back) continue;
      ASSERT_EQ(line.ask(kReadHardware), kHardware) << "whole again";
    }
  }
}

TEST(PowerCycleOnTheLine, WhatWasServedBeforeTheCutHasHappened) {
  // A host that receives half an answer knows only that the write took effect, and is kept if its time was
  // up.
  PoweredLine line;
  line.to(20ms);
  line.say(world::write_request(1, 0x2002, 55));          // Parms_Speed1: one word
  line.to(20ms + characters(8) + 750us + characters(3));  // served at 25.3 ms; kept in tick 31
  EXPECT_EQ(world::get(line.world, "feeder.Parms_Speed1"), 55);
  line.to(30ms);
  line.cycle(kFeeder);
  EXPECT_EQ(world::get(line.world, "feeder.Parms_Speed1"), 0);
  line.to(40ms);
  line.say(world::write_request(1, 0x2002, 55));  // served at 45.3 ms, kept in tick 51
  line.to(51ms);
  line.cycle(kFeeder);
  EXPECT_EQ(world::get(line.world, "feeder.Parms_Speed1"), 55);
}

TEST(PowerCycleOnTheLine, WithoutPowerItIsSilentAndTheOtherStationIsNot) {
  for (const char* timing : {"wire", "instant"}) {
    PoweredLine line(timing);
    line.to(10ms);
    line.power(kFeeder, false);
    EXPECT_EQ(line.ask(kReadHardware), world::Bytes{});
    EXPECT_EQ(line.ask(world::read_request(2, 1, 1)), kHardwareOfTurner);
    EXPECT_EQ(line.ask(world::write_request(0, 0x1002, 123)), world::Bytes{}) << "a broadcast";
    line.power(kFeeder, true);
    EXPECT_EQ(world::get(line.world, "feeder.Aaxis_Speed"), 0);
    EXPECT_EQ(world::get(line.world, "turner.Aaxis_Speed"), 123);
    EXPECT_EQ(line.ask(kReadHardware), kHardware);
    EXPECT_EQ(line.world.line(0).stations[kFeeder]->counters().requests, 1u)
        << "the requests that it could receive";
  }
}

TEST(PowerCycleOnTheLine, LeavesAReplyOfTheOtherStationAndItsWorkAlone) {
  PoweredLine line;
  world::set(line.world, "turner.ALL_SVON", 1);
  world::set(line.world, "turner.Aaxis_Pulse", 100'000);
  world::set(line.world, "turner.Aaxis_Speed", 200);
  world::set(line.world, "turner.PROG_MEM3", 33);
  line.to(10ms);
  world::set(line.world, "turner.Aaxis_Move_INC", 1);
  line.to(20ms);
  PoweredLine undisturbed;
  world::set(undisturbed.world, "turner.ALL_SVON", 1);
  world::set(undisturbed.world, "turner.Aaxis_Pulse", 100'000);
  world::set(undisturbed.world, "turner.Aaxis_Speed", 200);
  world::set(undisturbed.world, "turner.PROG_MEM3", 33);
  undisturbed.to(10ms);
  world::set(undisturbed.world, "turner.Aaxis_Move_INC", 1);
  undisturbed.to(20ms);

  line.say(world::read_request(2, 1, 1));
  undisturbed.say(world::read_request(2, 1, 1));
  for (int i = 0; i < 10; ++i) {
    line.to(20ms + i * 1ms + 300us);
    line.cycle(kFeeder);
  }
  line.to(300ms);
  undisturbed.to(300ms);
  EXPECT_EQ(line.received(), kHardwareOfTurner);
  EXPECT_EQ(undisturbed.received(), kHardwareOfTurner);
  EXPECT_TRUE(same_state(line.world.device(kTurner), undisturbed.world.device(kTurner)));
}

TEST(PowerCycleOnTheLine, ARequestRightAfterPowerUpMeetsACompleteDevice) {
  for (const char* timing : {"wire", "instant"}) {
    PoweredLine line(timing);
    world::set(line.world, "feeder.Parms_Speed1", 77);
    world::set(line.world, "feeder.Aaxis_Speed", 88);
    line.to(50ms);
    line.power(kFeeder, false);
    line.to(60ms);
    line.power(kFeeder, true);
    EXPECT_EQ(line.ask(world::read_request(1, 0x2002, 1)), world::framed({1, 3, 2, 0, 77}));
    line.cycle(kFeeder);
    EXPECT_EQ(line.ask(world::read_request(1, 0x1002, 1)), world::framed({1, 3, 2, 0, 0}));
    line.cycle(kFeeder);
    // A move at the same instant: servo, distance, speed, times and trigger.
    EXPECT_EQ(line.ask(world::write_request(1, 0x1014, 1)), world::write_request(1, 0x1014, 1));
    EXPECT_EQ(line.ask(world::framed({1, 0x10, 0x10, 0, 0, 6, 12, 0, 20, 0, 0, 0, 200, 0, 1, 0, 1, 0, 1})),
              world::framed({1, 0x10, 0x10, 0, 0, 6}));
    line.to(line.world.now() + 1s);
    EXPECT_EQ(world::get(line.world, "feeder.Cord_A"), 20);
  }
}

TEST(PowerCycleOnTheLine, TheSpeedIsThatOfTheSwitchWhenThePowerComes) {
  PoweredLine line;
  const int dip1 = find_terminal(line.world.device(kFeeder).model(), "DIP1");
  const auto ask_and_time = [&] {
    const SimTime begin = line.world.now();
    line.say(kReadHardware);
    while (line.world.line(0).line.output().empty() && line.world.now() < begin + 200ms)
      line.to(line.world.now() + 10us);
    return line.world.now() - begin;
  };
  // The first character of the answer is over after 8 characters, 750 us, and itself.
  const auto expect_about = [](SimTime time, std::int64_t baud) {
    EXPECT_GE(time, characters(9, baud) + 750us);
    EXPECT_LE(time, characters(9, baud) + 750us + 20us);
  };
  for (const std::size_t device : {kFeeder, kTurner}) line.world.set_external_input(device, dip1, 1);
  expect_about(ask_and_time(), 19'200);
  line.to(line.world.now() + 100ms);
  line.received();
  for (const std::size_t device : {kFeeder, kTurner}) line.cycle(device);
  EXPECT_EQ(line.world.line(0).line.options().settings.baud, 115'200);
  expect_about(ask_and_time(), 115'200);
  line.to(line.world.now() + 100ms);
  line.received();
  for (const std::size_t device : {kFeeder, kTurner}) line.world.set_external_input(device, dip1, 0);
  for (const std::size_t device : {kFeeder, kTurner}) line.cycle(device);
  expect_about(ask_and_time(), 19'200);
}

TEST(PowerCycleOnTheLine, AStationThatIsOffIsNotCalledDeaf) {
  PoweredLine line("wire", 115'200);
  line.to(10ms);
  line.world.host_settings(0, pty::HostSettings{.baud = 115'200, .stop_bits = 1});
  line.power(kFeeder, false);
  EXPECT_EQ(line.ask(kReadHardware), world::Bytes{});
  EXPECT_EQ(line.ask(world::read_request(2, 1, 1)), kHardwareOfTurner);
  EXPECT_EQ(line.log, std::vector<std::string>{});
  EXPECT_EQ(line.world.line(0).line.counters().bytes_unheard, 0u);
}

TEST(PowerCycleOnTheLine, PulseFormatIsThatOfTheSwitchWhenThePowerComes) {
  PoweredLine line;
  Device& feeder = line.world.device(kFeeder);
  const int dip2 = find_terminal(feeder.model(), "DIP2");
  EXPECT_EQ(feeder.axes()->pulse_format(), "CW/CCW");
  line.world.set_external_input(kFeeder, dip2, 1);
  line.to(10ms);
  EXPECT_EQ(feeder.axes()->pulse_format(), "CW/CCW");
  line.cycle(kFeeder);
  EXPECT_EQ(feeder.axes()->pulse_format(), "PLS/DIR");
  EXPECT_EQ(feeder.line_settings(0).baud, 19'200) << "DIP1 is a different switch";
}

}  // namespace power_cycle_line_test
}  // namespace understudy::emulator::models::simple2_r3
