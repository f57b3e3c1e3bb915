// The faulty wire between a line and a station, tested without either of them.
#include "emulator/world/stations/faulty_wire.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::world {
namespace faulty_wire_test {

using namespace std::chrono_literals;
using Kind = pty::WireFault::Kind;

/// Records the questions it gets, and does to messages what a test requests.
struct Faults final : FrameFaults {
  bool is_early(const ReceivedFrame&) override { return true; }
  std::vector<pty::WireFault> on_request(const ReceivedFrame& frame) override {
    device = frame.device;
    line = frame.line;
    return request;
  }
  Treatment on_serving(const ReceivedFrame&) override { return treatment; }
  std::vector<pty::WireFault> on_reply(const ReceivedFrame&) override { return reply; }

  std::vector<pty::WireFault> request;
  std::vector<pty::WireFault> reply;
  Treatment treatment;
  std::size_t device = 0;
  std::size_t line = 0;
};

struct Silence final : pty::Transmitter {
  void transmit(std::span<const std::uint8_t>) override {}
  void answer(std::span<const std::uint8_t>, std::uint64_t) override {}
};

/// A station that records what reaches it, and what leaves it.
struct Rig final : FaultyWire::End {
  void serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character, pty::SimTime,
                   pty::Transmitter&) override {
    log += "serve " + text(bytes) + " of " + std::to_string(last_character) + "\n";
  }
  void transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                pty::Transmitter&) override {
    log += "say " + text(bytes) + " to " + std::to_string(last_character) + "\n";
  }
  bool receive(const Bytes& bytes, pty::SimTime now) {
    return wire.passes({.bytes = bytes, .last_character = 7, .is_for_device = true, .now = now}, nobody);
  }
  void answer(const Bytes& bytes, pty::SimTime now) {
    wire.answer({.bytes = {}, .last_character = 7, .is_for_device = true, .now = now}, bytes, nobody);
  }
  std::string log_until(pty::SimTime now) {
    wire.run(now, nobody);
    return std::exchange(log, {});
  }

  std::string log{};
  Silence nobody{};
  std::vector<FaultyWire::Late> late{};
  FaultyWire wire{*this, late};
  Faults faults{};
};

TEST(FaultyWire, LetsAllThroughWhereNothingIsBroken) {
  Rig rig;
  EXPECT_TRUE(rig.receive({1, 2}, 5ms));
  rig.answer({3}, 5ms);
  EXPECT_EQ(rig.log, "say 03 to 7\n");
  EXPECT_EQ(rig.wire.due(), std::nullopt);
  rig.wire.check_completed({.bytes = {}, .is_for_device = true});
  EXPECT_FALSE(rig.wire.take_early_frame());
}

TEST(FaultyWire, ReportsWhichDeviceReceives) {
  Rig rig;
  rig.wire.set_faults(&rig.faults, 4, 7);
  EXPECT_TRUE(rig.receive({1, 2}, 5ms));
  EXPECT_EQ(rig.faults.device, 4u);
  EXPECT_EQ(rig.faults.line, 7u);
}

TEST(FaultyWire, GarblesDropsAndDelaysInBothDirections) {
  struct Case {
    const char* what;
    std::vector<pty::WireFault> stages;
    const char* request;  // at once, and 10 ms later
    const char* late_request;
    const char* reply;
    const char* late_reply;
  };
  const Case cases[] = {
      {"drop", {{.kind = Kind::drop}}, "", "", "", ""},
      {"truncate", {{.kind = Kind::truncate, .size = 1}}, "serve 01 of 7\n", "", "say 01 to 7\n", ""},
      {"delay", {{.kind = Kind::delay, .time = 10ms}}, "", "serve 01 02 of 7\n", "", "say 01 02 to 7\n"},
      {"duplicate",
       {{.kind = Kind::duplicate, .time = 10ms}},
       "serve 01 02 of 7\n",
       "serve 01 02 of 7\n",
       "say 01 02 to 7\n",
       "say 01 02 to 7\n"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    Rig rig;
    rig.wire.set_faults(&rig.faults, 0, 0);
    rig.faults.request = rig.faults.reply = c.stages;
    EXPECT_FALSE(rig.receive({1, 2}, 5ms));
    EXPECT_EQ(rig.log_until(15ms - 1ns), c.request);
    EXPECT_EQ(rig.log_until(15ms), c.late_request);
    rig.answer({1, 2}, 20ms);
    EXPECT_EQ(rig.log_until(30ms - 1ns), c.reply);
    EXPECT_EQ(rig.log_until(30ms), c.late_reply);
    EXPECT_EQ(rig.wire.due(), std::nullopt);
  }
}

TEST(FaultyWire, KeepsLateMessagesInTheOrderOfTime) {
  Rig rig;
  rig.wire.set_faults(&rig.faults, 0, 0);
  rig.faults.reply = {{.kind = Kind::delay, .time = 10ms}};
  rig.faults.request = {{.kind = Kind::delay, .time = 2ms}};
  rig.answer({1}, 0ms);
  EXPECT_FALSE(rig.receive({2}, 0ms));
  EXPECT_FALSE(rig.receive({3}, 8ms));  // at the same moment as the reply, and after it
  EXPECT_EQ(rig.wire.due(), 2ms);
  EXPECT_EQ(rig.log_until(20ms), "serve 02 of 7\nsay 01 to 7\nserve 03 of 7\n");
}

TEST(FaultyWire, LosesWhatIsTooMuchAndWhatIsReset) {
  Rig rig;
  rig.wire.set_faults(&rig.faults, 0, 0);
  rig.faults.reply = {{.kind = Kind::delay, .time = 10ms}};
  for (std::size_t i = 0; i < FaultyWire::kMaxLate + 5; ++i) rig.answer({1}, 0ms);
  EXPECT_EQ(rig.late.size(), FaultyWire::kMaxLate);
  rig.wire.check_completed({.bytes = {}, .is_for_device = true});
  EXPECT_EQ(rig.wire.due(), 0ms);
  rig.wire.reset();
  EXPECT_EQ(rig.wire.due(), std::nullopt);
  EXPECT_FALSE(rig.wire.take_early_frame());
}

TEST(FaultyWire, RefusesLateMessagesThatCannotBe) {
  const FaultyWire::Late early{.at = 1ms, .bytes = {1}};
  const FaultyWire::Late later{.at = 2ms, .bytes = {1}};
  FaultyWire::check({early, later, later});
  EXPECT_THROW(FaultyWire::check({later, early}), std::invalid_argument);
  EXPECT_THROW(FaultyWire::check({{.at = 1ms}}), std::invalid_argument);
  EXPECT_THROW(FaultyWire::check(std::vector(FaultyWire::kMaxLate + 1, early)), std::invalid_argument);
}

}  // namespace faulty_wire_test
}  // namespace understudy::emulator::world
