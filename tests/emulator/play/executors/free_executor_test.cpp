// The host of an executor in virtual time, to the nanosecond. At 19200 8E1 a character is 11 bits, 572,916.67
// ns; times are rounded down from the first character on. A Simple2-R3 replies 750 us after a request's end.
#include "emulator/play/executors/free_executor.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include "emulator/play/executors/modbus_host.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::play {
namespace free_executor_test {

using Kind = HostReply::Kind;

constexpr const char* kAt19200 =
    "understudy: 1\n"
    "lines: { rs485: { baud: 19200, stations: [ { name: feeder, model: simple2-r3, address: 1 } ] } }\n";
constexpr const char* kAt115200 =
    "understudy: 1\n"
    "lines: { rs485: { baud: 115200, stations: [ { name: feeder, model: simple2-r3, address: 1 } ] } }\n";

SimTime ns(std::int64_t count) { return SimTime{count}; }

/// An executor and the traffic on its only line: when the first character of each request and each reply
/// starts.
class HeardStage : public pty::LineObserver {
 public:
  explicit HeardStage(const std::string& bench, FreeExecutorOptions options = {})
      : executor(world::parse_bench(models::all_models(), bench, "bench.yaml", "."), std::move(options)) {
    executor.with_world([&](world::World& world) { world.add_observer(0, *this); });
  }
  ~HeardStage() override {
    executor.with_world([&](world::World& world) { world.remove_observer(0, *this); });
  }
  void on_start_bit(SimTime at) override {
    if (starts.empty() || at - last_start > std::chrono::milliseconds(1)) starts.push_back(at);
    last_start = at;
  }
  void on_character(const pty::TimedByte& character, bool) override { received.push_back(character.value); }
  void on_nothing_more() override {}
  void on_transmission(const pty::Transmission& transmission) override {
    answers.push_back(transmission.start);
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

  FreeExecutor executor;
  std::vector<SimTime> starts;
  std::vector<SimTime> answers;
  std::vector<std::uint8_t> received;
  SimTime last_start{0};
};

TEST(FreeExecutor, T35IsCountedInCharactersUpTo19200AndFixedAbove) {
  struct Case {
    int baud;
    pty::Parity parity;
    std::int64_t nanoseconds;  // by hand, rounded up
  };
  const std::vector<Case> cases = {
      {9600, pty::Parity::even, 4'010'417},   // 3.5 * 11 / 9600 = 4.010416.67 ms
      {19200, pty::Parity::even, 2'005'209},  // 2.005208.33
      {19200, pty::Parity::none, 1'822'917},  // 10 bits with one stop bit: 1.822916.67
      {19201, pty::Parity::even, 1'750'000}, {115200, pty::Parity::even, 1'750'000},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(silence_between_frames({.baud = c.baud, .parity = c.parity}).count(), c.nanoseconds) << c.baud;
  }
}

TEST(FreeExecutor, AReadTakesItsFramesTimeAndTheNextOneWaitsForT35) {
  HeardStage received(kAt19200);
  const HostReply code = received.executor.read(0, 1, Table::holding, 0x0001, 1);  // HW_Code
  EXPECT_EQ(code.kind, Kind::good);
  EXPECT_EQ(code.words, std::vector<std::uint16_t>{0xC001});
  // 01 03 00 01 00 01 D5 CA is the manual's request, 01 03 02 C0 01 29 84 its reply.
  EXPECT_EQ(received.received, (std::vector<std::uint8_t>{0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA}));
  EXPECT_EQ(code.bytes, (std::vector<std::uint8_t>{0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84}));
  // 8 characters: 4,583,333; + 750,000; 7 characters: 4,010,416.
  EXPECT_EQ(received.answers, std::vector{ns(5'333'333)});
  EXPECT_EQ(received.executor.now(), ns(9'343'749));
  received.executor.read(0, 1, Table::holding, 0x0001, 1);
  EXPECT_EQ(received.starts, (std::vector{ns(0), ns(9'343'749 + 2'005'209)}));
  EXPECT_EQ(received.executor.now(), ns(11'348'958 + 9'343'749));
}

TEST(FreeExecutor, TheSameAt115200Baud) {
  HeardStage received(kAt115200);
  received.executor.read(0, 1, Table::holding, 0x0001, 1);
  received.executor.read(0, 1, Table::holding, 0x0001, 1);
  // 11 bits are 95,486.11 ns: 8 of them 763,888, 7 of them 668,402.
  EXPECT_EQ(received.answers[0], ns(763'888 + 750'000));
  EXPECT_EQ(received.starts, (std::vector{ns(0), ns(1'513'888 + 668'402 + 1'750'000)}));
}

TEST(FreeExecutor, TheGapComesOnTopOfT35ButTimeThatHasPassedCounts) {
  HeardStage received(kAt19200, {.gap = std::chrono::milliseconds(5)});
  received.executor.read(0, 1, Table::holding, 0x0001, 1);
  received.executor.read(0, 1, Table::holding, 0x0001, 1);
  EXPECT_EQ(received.starts[1], ns(9'343'749 + 2'005'209 + 5'000'000));
  received.executor.advance(std::chrono::seconds(1));
  const SimTime now = received.executor.now();
  received.executor.read(0, 1, Table::holding, 0x0001, 1);
  EXPECT_EQ(received.starts[2], now);
}

TEST(FreeExecutor, OneWordIsWrittenByFunction06AndMoreBy16) {
  HeardStage received(kAt19200);
  EXPECT_EQ(received.executor.write(0, 1, Table::holding, 0x1002, std::vector<std::uint16_t>{200}).kind,
            Kind::good);
  EXPECT_EQ(std::vector(received.received.begin(), received.received.begin() + 6),
            (std::vector<std::uint8_t>{0x01, 0x06, 0x10, 0x02, 0x00, 0xC8}));
  received.received.clear();
  EXPECT_EQ(received.executor.write(0, 1, Table::holding, 0x1002, std::vector<std::uint16_t>{200, 5}).kind,
            Kind::good);
  EXPECT_EQ(std::vector(received.received.begin(), received.received.begin() + 11),
            (std::vector<std::uint8_t>{0x01, 0x10, 0x10, 0x02, 0x00, 0x02, 0x04, 0x00, 0xC8, 0x00, 0x05}));
  EXPECT_EQ(received.executor.read(0, 1, Table::holding, 0x1002, 2).words,
            (std::vector<std::uint16_t>{200, 5}));
}

TEST(FreeExecutor, AnExceptionIsReported) {
  HeardStage received(kAt19200);
  const HostReply refused =
      received.executor.write(0, 1, Table::holding, 0x1002, std::vector<std::uint16_t>{40'000});
  EXPECT_EQ(refused.kind, Kind::exception);
  EXPECT_EQ(refused.exception, 3);  // beyond 32768
  // 8 characters, 750 us, 5 characters: 2,864,583.
  EXPECT_EQ(received.executor.now(), ns(5'333'333 + 2'864'583));
  EXPECT_EQ(received.executor.read(0, 1, Table::holding, 0x9999, 1).exception, 2);
}

TEST(FreeExecutor, WithoutAReplyItsTimeoutCountsFromTheRequestsEnd) {
  HeardStage received(kAt19200, {.timeout = std::chrono::milliseconds(70)});
  EXPECT_EQ(received.executor.read(0, 9, Table::holding, 0x0001, 1).kind,
            Kind::silence);  // there is no station 9
  EXPECT_EQ(received.executor.now(), ns(4'583'333 + 70'000'000));
  HeardStage patient(kAt19200);
  EXPECT_EQ(patient.executor.read(0, 9, Table::holding, 0x0001, 1).kind, Kind::silence);
  EXPECT_EQ(patient.executor.now(), ns(504'583'333));
}

TEST(FreeExecutor, APowerCutGarblesAReplyButNotTheNextRequest) {
  /// Cuts the power while the reply is on the line.
  struct Cut final : world::TickWatcher {
    explicit Cut(world::World& of) : world(of) {}
    void on_tick(Tick tick) override {
      if (tick == 7) world.switch_power(0, false);
    }
    world::World& world;
  };
  HeardStage received(kAt19200);
  std::unique_ptr<Cut> cut;
  received.executor.with_world([&](world::World& world) {
    cut = std::make_unique<Cut>(world);
    world.add_watcher(*cut);
  });
  const HostReply reply = received.executor.read(0, 1, Table::holding, 0x0001, 1);
  EXPECT_EQ(reply.kind, Kind::garbled);
  // The reply starts at 5,333,333; at 7 ms its third character is on the wire, which ends at 7,052,083.
  EXPECT_EQ(reply.bytes, (std::vector<std::uint8_t>{0x01, 0x03, 0x02}));
  // A character and t3.5 later it is clear that the reply has ended: + 572,916 + 2,005,209.
  EXPECT_EQ(received.executor.now(), ns(7'052'083 + 572'916 + 2'005'209));
  received.executor.with_world([&](world::World& world) {
    world.remove_watcher(*cut);
    world.switch_power(0, true);
  });
  EXPECT_EQ(received.executor.read(0, 1, Table::holding, 0x0001, 1).kind, Kind::good);
}

TEST(FreeExecutor, ExchangeSendsWhatItIsGivenAndTakesWhatComes) {
  HeardStage received(kAt19200);
  const std::vector<std::uint8_t> request{0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA};
  const std::vector<std::uint8_t> reply{0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84};
  const SimTime within = std::chrono::milliseconds(100);
  EXPECT_EQ(received.executor.exchange(0, request, reply.size(), within), reply);
  // It waits for one more character.
  EXPECT_EQ(received.executor.now(), ns(9'343'749 + 572'916 + 1));
  EXPECT_EQ(received.executor.exchange(0, request, 3, within).size(),
            4U);  // the third, and one that follows at once
  received.executor.advance(std::chrono::seconds(1));
  std::vector<std::uint8_t> broken = request;
  broken.back() ^= 1;
  const SimTime begin = received.executor.now();
  EXPECT_TRUE(received.executor.exchange(0, broken, reply.size(), within).empty());
  EXPECT_EQ(received.executor.now(), begin + ns(4'583'333) + within);
}

TEST(FreeExecutor, MoreBytesThanTheLineTakesAtOnceGoOutWithoutAGap) {
  HeardStage received(kAt19200);
  const std::vector<std::uint8_t> noise(3000, 0x55);
  received.executor.exchange(0, noise, SIZE_MAX, std::chrono::milliseconds(10));
  EXPECT_EQ(received.received.size(), noise.size());
  EXPECT_EQ(received.starts.size(), 1U);
  // 3000 * 11 / 19200 = 1.71875 s
  EXPECT_EQ(received.executor.now(), ns(1'718'750'000 + 10'000'000));
}

TEST(FreeExecutor, TheLastWriteActsFromTheTickAfterItIsCarriedOut) {
  HeardStage received(kAt19200);
  FreeExecutor& executor = received.executor;
  EXPECT_EQ(executor.tick_of_last_write(), 0);
  executor.write(0, 1, Table::holding, 0x1002, std::vector<std::uint16_t>{200});  // executed at 5.333 ms
  EXPECT_EQ(executor.tick_of_last_write(), 6);
  executor.read(0, 1, Table::holding, 0x1002, 1);
  EXPECT_EQ(executor.tick_of_last_write(), 6);
  executor.write(0, 1, Table::holding, 0x1002, std::vector<std::uint16_t>{40'000});  // refused
  EXPECT_EQ(executor.tick_of_last_write(), 6);
  executor.advance(std::chrono::milliseconds(100) - executor.now());
  std::vector<std::uint8_t> broadcast =
      write_request(0, Table::holding, 0x1002, std::vector<std::uint16_t>{300});
  executor.exchange(0, broadcast, SIZE_MAX,
                    std::chrono::milliseconds(20));  // at 105.333 ms; there is no reply
  EXPECT_EQ(executor.tick_of_last_write(), 106);
  EXPECT_EQ(executor.read(0, 1, Table::holding, 0x1002, 1).words, std::vector<std::uint16_t>{300});
}

TEST(FreeExecutor, RunUntilStopsAtTheVeryTick) {
  HeardStage received(kAt19200);
  FreeExecutor& executor = received.executor;
  int looks = 0;
  const auto at_7 = [&](world::World& world) {
    ++looks;
    return world.now() >= std::chrono::milliseconds(7);
  };
  EXPECT_TRUE(executor.run_until({at_7}, std::chrono::seconds(1)));
  EXPECT_EQ(executor.now(), std::chrono::milliseconds(7));
  EXPECT_EQ(looks, 8);  // at once, and at each tick
  EXPECT_TRUE(executor.run_until({at_7}, std::chrono::seconds(1)));
  EXPECT_EQ(executor.now(), std::chrono::milliseconds(7));
  EXPECT_FALSE(executor.run_until({[](world::World&) { return false; }}, ns(9'500'000)));
  EXPECT_EQ(executor.now(), ns(9'500'000));
}

/// If nothing happens, it checks only when its condition says so, and stops there.
TEST(FreeExecutor, RunUntilLooksOnlyWhereSomethingMayBeDifferent) {
  HeardStage received(kAt19200);
  FreeExecutor& executor = received.executor;
  executor.advance(std::chrono::seconds(1));
  int looks = 0;
  const Awaited in_an_hour{
      .is_met =
          [&](world::World& world) {
            ++looks;
            return world.now() >= std::chrono::hours(1);
          },
      .next_poll = [](Tick done) { return done < 3'600'000 ? Tick{3'600'000} : done + 1; }};
  EXPECT_TRUE(executor.run_until(in_an_hour, std::chrono::hours(2)));
  EXPECT_EQ(executor.now(), std::chrono::hours(1));
  EXPECT_LT(looks, 10);
  const Awaited never{.is_met = [&](world::World&) { return ++looks < 0; },
                      .next_poll = [](Tick) { return kNever; }};
  looks = 0;
  EXPECT_FALSE(executor.run_until(never, std::chrono::hours(3)));
  EXPECT_EQ(executor.now(), std::chrono::hours(3));
  EXPECT_LT(looks, 10);
}

TEST(FreeExecutor, FramingIsStrict) {
  HeardStage received(kAt19200);
  const std::vector<std::uint8_t> request{0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA};
  std::vector<std::uint8_t> two = request;
  two.insert(two.end(), request.begin(), request.end());
  EXPECT_TRUE(received.executor.exchange(0, two, SIZE_MAX, std::chrono::milliseconds(50)).empty());
  EXPECT_FALSE(received.executor.exchange(0, request, SIZE_MAX, std::chrono::milliseconds(50)).empty());
}

TEST(FreeExecutor, LinesHaveHostsOfTheirOwn) {
  FreeExecutor executor(
      world::parse_bench(
          models::all_models(),
          "understudy: 1\n"
          "lines:\n"
          "  one: { baud: 19200, stations: [ { name: a, model: simple2-r3, address: 1 } ] }\n"
          "  two: { baud: 115200, stations: [ { name: b, model: simple2-r3, address: 2 } ] }\n",
          "bench.yaml", "."),
      {});
  EXPECT_EQ(executor.write(0, 1, Table::holding, 0x1002, std::vector<std::uint16_t>{11}).kind, Kind::good);
  const SimTime begin = executor.now();
  EXPECT_EQ(executor.write(1, 2, Table::holding, 0x1002, std::vector<std::uint16_t>{22}).kind, Kind::good);
  EXPECT_EQ(executor.now(), begin + ns(763'888 + 750'000 + 763'888));  // that line was silent before
  EXPECT_EQ(executor.read(0, 1, Table::holding, 0x1002, 1).words, std::vector<std::uint16_t>{11});
  EXPECT_EQ(executor.read(1, 2, Table::holding, 0x1002, 1).words, std::vector<std::uint16_t>{22});
  EXPECT_EQ(executor.read(0, 2, Table::holding, 0x1002, 1).kind, Kind::silence);
}

TEST(ModbusHost, JudgesReplies) {
  const std::vector<std::uint8_t> read = read_request(1, Table::holding, 0x0001, 1);
  const std::vector<std::uint8_t> write =
      write_request(1, Table::holding, 0x1002, std::vector<std::uint16_t>{200});
  const auto with_crc = [](std::vector<std::uint8_t> bytes) {
    // CRC-16/MODBUS, bit by bit.
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
      crc ^= byte;
      for (int i = 0; i < 8; ++i) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xA001 : crc >> 1;
    }
    bytes.push_back(static_cast<std::uint8_t>(crc));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
    return bytes;
  };
  struct Case {
    const char* name;
    const std::vector<std::uint8_t>& request;
    std::vector<std::uint8_t> reply;
    Kind kind;
  };
  const std::vector<Case> cases = {
      {"nothing", read, {}, Kind::silence},
      {"the manual's", read, {0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84}, Kind::good},
      {"a wrong checksum", read, {0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x85}, Kind::garbled},
      {"cut", read, {0x01, 0x03, 0x02, 0xC0, 0x01, 0x29}, Kind::garbled},
      {"another station's", read, with_crc({0x02, 0x03, 0x02, 0xC0, 0x01}), Kind::garbled},
      {"another function's", read, with_crc({0x01, 0x04, 0x02, 0xC0, 0x01}), Kind::garbled},
      {"another byte count", read, with_crc({0x01, 0x03, 0x01, 0xC0, 0x01}), Kind::garbled},
      {"two words for one", read, with_crc({0x01, 0x03, 0x04, 0xC0, 0x01, 0x00, 0x00}), Kind::garbled},
      {"an exception", read, with_crc({0x01, 0x83, 0x02}), Kind::exception},
      {"another function's exception", read, with_crc({0x01, 0x86, 0x02}), Kind::garbled},
      {"an echo", write, write, Kind::good},
      {"another value's echo", write, with_crc({0x01, 0x06, 0x10, 0x02, 0x00, 0xC9}), Kind::garbled},
  };
  for (const Case& c : cases) EXPECT_EQ(judge_reply(c.request, c.reply).kind, c.kind) << c.name;
}

}  // namespace free_executor_test
}  // namespace understudy::emulator::play
