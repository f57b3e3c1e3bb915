// What is between a line and its host: an echo, an adapter that passes on data in lumps, one that is pulled
// out. Times are those of 8E1 at 19200: a character takes 11 bits, and the reply follows 750 us after the
// eighth.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/emulator/world/faults/faulty_line.h"

namespace understudy::emulator::world {
namespace adapter_test {

using namespace std::chrono_literals;

constexpr SimTime character(std::int64_t count) { return SimTime{count * 11 * 1'000'000'000 / 19'200}; }
constexpr SimTime kReplyBegins = character(8) + 750us;

struct Came {
  SimTime at{0};
  std::uint8_t byte = 0;
};

/// Each byte that arrives within 100 ms of a request at a multiple of 100 ms, and its time.
std::vector<Came> ask_and_time(World& world, const Bytes& request) {
  const SimTime begin = (world.now() / 100ms + 1) * 100ms;
  world.advance_to(begin);
  world.receive(0, request, begin);
  std::vector<Came> came;
  while (world.now() < begin + 99ms) {
    world.advance_to(std::min(world.next_due().value_or(kForever), begin + 99ms));
    for (const std::uint8_t byte : world.line(0).line.output()) came.push_back({world.now() - begin, byte});
    world.take_output(0, world.line(0).line.output().size());
  }
  return came;
}

Bytes bytes_of(const std::vector<Came>& came) {
  Bytes bytes;
  for (const Came& one : came) bytes.push_back(one.byte);
  return bytes;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

void expect_echo(World& world) {
  const std::vector<Came> came = ask_and_time(world, kAskFeeder);
  ASSERT_EQ(bytes_of(came), kAskFeeder + kFeederSays);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(came[i].at, character(static_cast<std::int64_t>(i) + 1)) << "each at its time " << i;
  EXPECT_EQ(came[8].at, kReplyBegins + character(1)) << "and the reply at its own";
}

TEST(Echo, OfALineComesByteByByteBeforeTheReply) {
  for (const char* timing : {"wire", "instant"}) {
    World world(
        parse_bench(models::all_models(),
                    "understudy: 1\nlines: { a: { echo: on, baud: 19200, timing: " + std::string(timing) +
                        ", stations: [ { name: feeder, model: simple2-r3 } ] } }\n",
                    "bench.yaml", "."),
        {}, {});
    if (std::string(timing) == "wire") expect_echo(world);
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(bytes_of(ask_and_time(world, kAskFeeder)), kAskFeeder + kFeederSays) << timing;
    EXPECT_EQ(bytes_of(ask_and_time(world, {0xFF, 0x00})), (Bytes{0xFF, 0x00}))
        << "a request without a reply";
    world.host_closed(0);
    world.receive_departed(0, kAskFeeder);
    world.advance_to(world.now() + 50ms);
    world.host_opened(0);
    EXPECT_TRUE(world.line(0).line.output().empty()) << "data of a departed host do not go to the next one";
  }
}

TEST(Echo, BeginsInTheMiddleAndEndsByAFault) {
  FaultyLine line;
  line.inject("echo rs485 from=250ms to=550ms");
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays);
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays);
  expect_echo(line.world());
  EXPECT_EQ(line.ask(kAskTurner).bytes, kAskTurner + kTurnerSays);
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kAskFeeder + kFeederSays);
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays);
}

TEST(Echo, IsStruckByAFrame) {
  FaultyLine line;
  line.inject("echo rs485 nth=2 for=100ms");
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays);
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays) << "it starts with the reply";
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kAskFeeder + kFeederSays);
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays);
}

TEST(Lumps, AreHandedOverAtMultiplesOfTheirTime) {
  FaultyLine line;
  const std::size_t fault = line.inject("lumps rs485 by=16ms");
  const std::vector<Came> came = ask_and_time(line.world(), kAskFeeder);
  ASSERT_EQ(bytes_of(came), kFeederSays);
  for (std::size_t i = 0; i < came.size(); ++i) {
    const SimTime begin = 100ms;
    const SimTime over = begin + kReplyBegins + character(static_cast<std::int64_t>(i) + 1);
    EXPECT_EQ(begin + came[i].at, (over / 16ms + 1) * 16ms) << i;
  }
  line.world().clear_fault(fault);
  EXPECT_EQ(ask_and_time(line.world(), kAskFeeder).front().at, kReplyBegins + character(1));
}

// An adapter passes on its data as soon as it is full: 62 bytes.
TEST(Lumps, ComeSoonerWhereTheAdapterIsFull) {
  FaultyLine line;
  line.inject("lumps rs485 by=1s");
  const Bytes ask_for_50 = with_crc({0x01, 0x03, 0x10, 0x00, 0x00, 0x10});
  const std::vector<Came> first = ask_and_time(line.world(), ask_for_50);  // 37 bytes
  EXPECT_TRUE(first.empty());
  const std::vector<Came> second = ask_and_time(line.world(), ask_for_50);
  ASSERT_EQ(second.size(), 62U);
  EXPECT_EQ(second.front().at, second.back().at);
  EXPECT_EQ(second.back().at, kReplyBegins + character(62 - 37));
}

TEST(Unplug, LetsNothingThroughEitherWay) {
  FaultyLine line;
  line.inject("unplug rs485 from=150ms to=350ms");
  EXPECT_EQ(line.ask(kAskFeeder).bytes, kFeederSays);
  EXPECT_EQ(line.ask(kSetSpeed).bytes, Bytes{});
  EXPECT_EQ(line.ask(kAskFeeder).bytes, Bytes{});
  const Bytes ask_speed = with_crc({0x01, 0x03, 0x10, 0x02, 0x00, 0x01});
  EXPECT_EQ(line.ask(ask_speed).bytes, with_crc({0x01, 0x03, 0x02, 0x00, 0x00})) << "it was never received";
}

TEST(Unplug, EndsWhatIsOnItsWay) {
  FaultyLine line;
  line.inject("unplug rs485 from=108ms");  // some characters of the reply have left the wire
  const Bytes came = line.ask(kAskFeeder).bytes;
  EXPECT_LT(came.size(), kFeederSays.size());
  EXPECT_GT(came.size(), 0U);
}

TEST(AdapterFaults, AreOfLines) {
  FaultyLine line;
  for (const auto& [text, why] : std::vector<std::pair<std::string, std::string>>{
           {"echo feeder", "no line is called 'feeder'; expected 'rs485'"},
           {"unplug rs48", "no line is called 'rs48'; the nearest is 'rs485'"},
           {"lumps rs485", "lumps: by is missing; expected a duration such as 250ms"},
           {"lumps rs485 by=0ms", "lumps: by: 0s is out of range; expected 1ns to 8760h"}}) {
    try {
      line.inject(text);
      ADD_FAILURE() << text;
    } catch (const NameError& error) {
      EXPECT_EQ(error.what(), why);
    }
  }
}

}  // namespace adapter_test
}  // namespace understudy::emulator::world
