// A TCP door in its own process: whatever unknown clients send, however they disconnect; who waits, and who
// takes turns.
#include "emulator/serve/ports/tcp_door.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "emulator/serve/ports/tcp_places.h"
#include "pty/port_link.h"
#include "tests/emulator/serve/ports/door_rig.h"
#include "tests/pty/pty_host.h"

namespace understudy::emulator::serve {
namespace tcp_door_test {

using pty::hex;
using Bytes = DoorClient::Bytes;

struct Exchange {
  Bytes request;
  Bytes reply;
};
const Exchange kRaw{hex("01 03 00 01 00 01 D5 CA"), hex("01 03 02 C0 01 29 84")};
const Exchange kGateway{hex("12 34 00 00 00 06 01 03 00 01 00 01"), hex("12 34 00 00 00 05 01 03 02 C0 01")};

/// Possibly after the first telnet options.
bool has(const Bytes& received, const Bytes& reply) {
  return std::search(received.begin(), received.end(), reply.begin(), reply.end()) != received.end();
}

struct Protocol {
  const char* address;
  Exchange exchange;
  std::vector<const char*> malformed;  // none of them, nor the beginning of one, is a request
};
const std::vector<Protocol> kProtocols{
    {"rtu://127.0.0.1:0",
     kRaw,
     {"01 03 00 01 00 01 D5 CB", "01 10 10 02 00 02 F0 00 C8 00 00", "FF FF FF FF FF FF FF FF FF",
      "00 00 00 00 00 00", "12 34 00 00 00 06 01 03 00 01 00 01", "47 45 54 20 2F 0D 0A"}},
    {"rfc2217://127.0.0.1:0",
     kRaw,
     {"FF FA 2C 01 00 00 4B 00 FF F0", "FF FA 2C 05 FF FF 01 FF F0", "FF FF FF FF", "FF FA 2C FF FA 2C FF",
      "FF FB 2C FF FD 2C FF FC FF FE", "00 0D 00 0D 00", "FF F3 FF F6 FF FA FF F0 FF"}},
    {"modbus-tcp://127.0.0.1:0",
     kGateway,
     {"00 00 00 00 00 00 00 00", "00 00 00 00 00 01 00 00", "00 01 00 00 01 2C 01 06 10 02 00 C8",
      "00 01 00 00 FF FF 01 03 00 01 00 01", "00 01 00 07 00 06 01 06 10 02 00 C8", "01 03 00 01 00 01 D5 CA",
      "47 45 54 20 2F 20 48 54 54 50"}}};

// Also for a name that stands for several addresses.
TEST(TcpPlaces, AreAllTakenOrNone) {
  world::TcpAddress first = world::parse_tcp_address("rtu://127.0.0.1:0");
  const std::vector<Descriptor> listeners = listen_at(first);
  world::TcpAddress second = world::parse_tcp_address("rtu://localhost:" + std::to_string(first.port));
  EXPECT_THROW(listen_at(second), pty::PortError);
}

class EachProtocol : public testing::TestWithParam<std::size_t> {
 protected:
  const Protocol& protocol = kProtocols[GetParam()];
  const Exchange& exchange = protocol.exchange;

  /// A valid client gets its reply.
  void expect_served(DoorRig& rig, const std::string& after) {
    DoorClient good(rig);
    good.say(exchange.request);
    EXPECT_TRUE(rig.eventually([&] {
      good.is_over();
      return has(good.received(), exchange.reply);
    })) << after;
    good.close();
  }
};

INSTANTIATE_TEST_SUITE_P(TcpDoor, EachProtocol, testing::Values(0, 1, 2));

// Every beginning of every malformed message, after a valid one or not, followed by each possible end.
TEST_P(EachProtocol, OutlivesWhateverStrangersSendAndHoweverTheyGo) {
  enum class End { fin, close, reset, silence };
  DoorRig rig(protocol.address);
  std::uint64_t served = 0;
  for (const char* message : protocol.malformed) {
    const Bytes whole = hex(message);
    for (std::size_t cut = 1; cut <= whole.size(); ++cut) {
      for (const End end : {End::fin, End::close, End::reset, End::silence}) {
        const std::string what = std::string(message) + " cut at " + std::to_string(cut) + ", end " +
                                 std::to_string(static_cast<int>(end));
        DoorClient stranger(rig);
        stranger.say(std::span(whole).first(cut));
        rig.run();
        if (end == End::fin) {
          stranger.close_sending_half();
          EXPECT_TRUE(stranger.sees_the_end()) << what;
        }
        if (end == End::reset) stranger.reset();
        if (end != End::silence) stranger.close();
        if (end == End::silence) {
          for (int i = 0; i < 3; ++i) rig.run();
          stranger.close();
        }
        expect_served(rig, what);
        EXPECT_EQ(rig.requests(), ++served) << what;
      }
    }
  }
}

TEST_P(EachProtocol, AnswersAClientThatHasClosedItsSendingHalf) {
  DoorRig rig(protocol.address);
  for (int i = 0; i < 20; ++i) {
    DoorClient client(rig);
    client.say(exchange.request);
    if (i % 2 == 0) rig.run();  // together, or one after another
    client.close_sending_half();
    EXPECT_TRUE(client.sees_the_end()) << i;
    EXPECT_TRUE(has(client.received(), exchange.reply)) << i;
  }
  EXPECT_EQ(rig.log, std::vector<std::string>());
}

// A line takes time: the replies still arrive, and a client that connects meanwhile has to wait, but is not
// refused.
TEST_P(EachProtocol, LetsTheNextWaitForOneThatHasSaidAll) {
  DoorRig rig(
      protocol.address,
      "understudy: 1\nlines: { a: { timing: wire, stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  for (int i = 0; i < 10; ++i) {
    DoorClient first(rig);
    first.say(exchange.request);
    first.close_sending_half();
    DoorClient second(rig);
    second.say(exchange.request);
    second.close_sending_half();
    EXPECT_TRUE(first.sees_the_end());
    EXPECT_TRUE(second.sees_the_end());
    for (DoorClient* client : {&first, &second}) EXPECT_TRUE(has(client->received(), exchange.reply)) << i;
  }
  EXPECT_EQ(rig.log, std::vector<std::string>());
}

// --- descriptors ---------------------------------------------------------------------------------

/// While this object exists, no more descriptors are available than now.
class NoMoreDescriptors {
 public:
  NoMoreDescriptors() {
    EXPECT_EQ(getrlimit(RLIMIT_NOFILE, &before_), 0);
    rlimit none = before_;
    const Descriptor next(dup(0));
    none.rlim_cur = static_cast<rlim_t>(next.get());
    EXPECT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  }
  ~NoMoreDescriptors() { EXPECT_EQ(setrlimit(RLIMIT_NOFILE, &before_), 0); }
  NoMoreDescriptors(const NoMoreDescriptors&) = delete;
  NoMoreDescriptors& operator=(const NoMoreDescriptors&) = delete;

 private:
  rlimit before_{};
};

TEST_P(EachProtocol, WithoutDescriptorsRestsUntilThereIsOne) {
  DoorRig rig(protocol.address);
  rig.run();
  DoorClient waiting(rig);
  waiting.say(exchange.request);
  {
    const NoMoreDescriptors none;
    rig.run();
    const WallTime before = wall_now();
    rig.loop.wait(before + std::chrono::milliseconds(100));
    EXPECT_GE(wall_now() - before, std::chrono::milliseconds(100)) << "it is not reported repeatedly";
  }
  EXPECT_TRUE(rig.eventually([&] {
    waiting.is_over();
    return has(waiting.received(), exchange.reply);
  }));
}

// --- masters of a gateway ------------------------------------------------------------------------

TEST(Gateway, ServesItsMastersInTurn) {
  DoorRig rig("modbus-tcp://127.0.0.1:0");
  std::vector<std::unique_ptr<DoorClient>> masters;
  for (std::size_t m = 0; m < TcpDoor::kMaxMasters; ++m) {
    masters.push_back(std::make_unique<DoorClient>(rig));
    rig.run();
    for (std::uint8_t i = 0; i < 20; ++i) {
      Bytes request = kGateway.request;
      request[0] = static_cast<std::uint8_t>(m);
      request[1] = i;
      masters.back()->say(request);
    }
  }
  const std::size_t all = 20 * kGateway.reply.size();
  masters.front()->hear(all);
  for (const auto& master : masters)
    EXPECT_GE(master->hear(all - kGateway.reply.size()).size(), all - kGateway.reply.size());
  for (std::size_t m = 0; m < masters.size(); ++m) {
    const Bytes received = masters[m]->hear(all);
    for (std::uint8_t i = 0; i < 20; ++i) {
      Bytes reply = kGateway.reply;
      reply[0] = static_cast<std::uint8_t>(m);
      reply[1] = i;
      const auto begin = received.begin() + static_cast<std::ptrdiff_t>(i * reply.size());
      ASSERT_TRUE(std::equal(reply.begin(), reply.end(), begin)) << m << " " << int{i};
    }
  }
  DoorClient one_too_many(rig);
  EXPECT_TRUE(one_too_many.sees_the_end());
  ASSERT_EQ(rig.log.size(), 1U);
  EXPECT_NE(rig.log.front().find("32 masters"), std::string::npos) << rig.log.front();
}

// Its reply would be taken for the reply to the next request of the same function.
TEST(Gateway, AwaitsTheReplyToOneThatHasGone) {
  DoorRig rig("modbus-tcp://127.0.0.1:0",
              "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n"
              "faults: [ { delay: feeder, by: 500ms, nth: 1 } ]\n");
  auto gone = std::make_unique<DoorClient>(rig);
  gone->say(kGateway.request);
  ASSERT_TRUE(rig.eventually([&] { return rig.requests() == 1; }));
  gone->reset();
  DoorClient other(rig);
  other.say(hex("00 02 00 00 00 06 01 03 10 02 00 01"));  // Aaxis_Speed, which is 0
  EXPECT_EQ(other.hear(11), hex("00 02 00 00 00 05 01 03 02 00 00"));
}

TEST(Gateway, GivesUnit255TheOnlyStation) {
  struct Case {
    const char* settings;
    const char* station;  // of the bench
    std::vector<int> answered;
    std::vector<int> silent;
  };
  const std::string two =
      "[ { name: feeder, model: simple2-r3, address: 3 }, { name: turner, model: "
      "simple2-r3, address: 4 } ]";
  for (const auto& [settings, stations, answered, silent] :
       {Case{"", "[ { name: feeder, model: simple2-r3, address: 7 } ]", {7, 255}, {1, 8, 247}},
        Case{"&unit=any", "[ { name: feeder, model: simple2-r3, address: 7 } ]", {7, 255, 1, 0, 254}, {}},
        Case{"", two.c_str(), {3, 4}, {255, 1}}, Case{"&unit=4", two.c_str(), {3, 4, 255}, {1, 0}},
        Case{"&unit=any", two.c_str(), {3, 4}, {255, 1}}}) {
    DoorRig rig(
        std::string("modbus-tcp://127.0.0.1:0?timeout=20ms") + settings,
        "understudy: 1\nlines: { a: { timing: instant, stations: " + std::string(stations) + " } }\n");
    DoorClient master(rig);
    const auto ask = [&](int unit) {
      Bytes request = kGateway.request;
      request[6] = static_cast<std::uint8_t>(unit);
      master.forget();
      master.say(request);
    };
    for (const int unit : answered) {
      ask(unit);
      Bytes reply = kGateway.reply;
      reply[6] = static_cast<std::uint8_t>(unit);
      EXPECT_EQ(master.hear(reply.size()), reply) << settings << " " << unit;
    }
    EXPECT_EQ(rig.log, std::vector<std::string>());
    for (const int unit : silent) {
      ask(unit);
      if (unit == 0) {  // has no reply; the next request has one
        ask(answered.front());
        EXPECT_EQ(master.hear(kGateway.reply.size()).size(), kGateway.reply.size()) << settings;
        continue;
      }
      Bytes refusal = hex("12 34 00 00 00 03 00 83 0B");
      refusal[6] = static_cast<std::uint8_t>(unit);
      EXPECT_EQ(master.hear(refusal.size()), refusal) << settings << " " << unit;
    }
    // The daemon's log, not the gateway's, reports stations that do not exist.
    const bool asks_all = std::ranges::find(silent, 0) != silent.end();
    ASSERT_EQ(rig.log.size(), asks_all ? 1U : 0U) << settings;
    if (!asks_all) continue;
    EXPECT_NE(rig.log.front().find("unit 0, which is a broadcast, "), std::string::npos) << rig.log.front();
    EXPECT_NE(rig.log.front().find("(feeder)"), std::string::npos) << rig.log.front();
  }
}

TEST(Gateway, SaysNothingOfAStationThatDoesNotAnswerIfItIsNotTo) {
  for (const char* settings : {"?timeout=20ms&exception=off", "?exception=off&timeout=20ms"}) {
    DoorRig rig(std::string("modbus-tcp://127.0.0.1:0") + settings);
    DoorClient master(rig);
    Bytes absent = kGateway.request;
    absent[6] = 9;
    master.say(absent);
    master.say(kGateway.request);
    EXPECT_EQ(master.hear(kGateway.reply.size()), kGateway.reply) << "nothing before it";
  }
}

// --- faults --------------------------------------------------------------------------------------

TEST(GatewayFaults, ChangeTheAnswerOnItsWay) {
  struct Case {
    const char* fault;
    Bytes received;
    bool ends;
  };
  const auto changed = [](std::size_t at) {
    Bytes reply = kGateway.reply;
    ++reply[at];
    return reply;
  };
  const Bytes cut(kGateway.reply.begin(), kGateway.reply.begin() + 9);
  for (const auto& [fault, received, ends] :
       {Case{"{ wrong_transaction: feeder }", changed(1), false},
        Case{"{ wrong_unit: a }", changed(6), false}, Case{"{ hang_up: feeder, keep: 9 }", cut, true},
        Case{"{ hang_up: feeder, keep: 0 }", {}, true},
        Case{"{ hang_up: feeder, keep: 99 }", kGateway.reply, true},
        Case{"{ split: feeder, keep: 3, by: 20ms }", kGateway.reply, false},
        Case{"{ exception: feeder, code: 10 }", hex("12 34 00 00 00 03 01 83 0A"), false},
        Case{"{ exception: feeder, code: 11 }", hex("12 34 00 00 00 03 01 83 0B"), false}}) {
    DoorRig rig("modbus-tcp://127.0.0.1:0", kOneFeeder + std::string("faults: [ ") + fault + " ]\n");
    DoorClient master(rig);
    master.say(kGateway.request);
    EXPECT_EQ(master.hear(received.size()), received) << fault;
    if (ends) {
      EXPECT_TRUE(master.sees_the_end()) << fault;
      continue;
    }
    master.forget();
    master.say(kGateway.request);
    EXPECT_EQ(master.hear(received.size()), received) << fault << ", each one";
  }
}

TEST(GatewayFaults, SplitAnAnswerByAPause) {
  DoorRig rig("modbus-tcp://127.0.0.1:0",
              kOneFeeder + std::string("faults: [ { split: feeder, keep: 4, by: 300ms } ]\n"));
  DoorClient master(rig);
  master.say(kGateway.request);
  EXPECT_EQ(master.hear(4).size(), 4U);
  const WallTime first = wall_now();
  EXPECT_EQ(master.hear(11), kGateway.reply);
  EXPECT_GE(wall_now() - first, std::chrono::milliseconds(100));
}

TEST(GatewayFaults, EndARawConnectionInMidReply) {
  DoorRig rig("rtu://127.0.0.1:0",
              kOneFeeder + std::string("faults: [ { hang_up: feeder, keep: 3, nth: 2 } ]\n"));
  DoorClient host(rig);
  host.say(kRaw.request);
  EXPECT_EQ(host.hear(7), kRaw.reply);
  host.forget();
  host.say(kRaw.request);
  EXPECT_TRUE(host.sees_the_end());
  EXPECT_EQ(host.received(), Bytes(kRaw.reply.begin(), kRaw.reply.begin() + 3));
  DoorClient next(rig);
  next.say(kRaw.request);
  EXPECT_EQ(next.hear(7), kRaw.reply);
}

TEST_P(EachProtocol, IsGoneWhileItIsUnplugged) {
  DoorRig rig(protocol.address);
  DoorClient before(rig);
  ASSERT_TRUE(rig.eventually([&] { return rig.port->host_present(); }));
  const std::size_t fault = rig.world.inject({.kind = world::Fault::Kind::unplug, .on_line = true});
  EXPECT_TRUE(before.sees_the_end());
  EXPECT_TRUE(DoorClient(rig).sees_the_end());
  EXPECT_EQ(rig.log.size(), 1U);
  EXPECT_NE(rig.log.back().find("but a fault has unplugged the line"), std::string::npos) << rig.log.back();
  rig.world.clear_fault(fault);
  rig.run();
  expect_served(rig, "plugged in again");
}

}  // namespace tcp_door_test
}  // namespace understudy::emulator::serve
