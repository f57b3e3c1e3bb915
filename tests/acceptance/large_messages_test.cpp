// A large message of a client on the control socket, in every language: its reply is bounded, and hosts on
// the lines do not wait for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <nlohmann/json.hpp>

#include "emulator/serve/control/server.h"
#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace large_messages_test {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxMistakes = 100;

std::string times(const std::string& line, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line;
  return text;
}

class LargeMessages : public testing::Test {
 protected:
  struct Exchange {
    Json reply;
    std::size_t bytes = 0;
    Clock::duration took{};          // until the reply was there
    Clock::duration longest_wait{};  // a host's waiting time for its reply meanwhile
    int polls = 0;
  };
  Exchange ask(const Json& message) {
    Exchange exchange;
    ModbusHost host(daemon_->port());
    EXPECT_FALSE(host.read(kHardwareCode).empty());
    const auto asked = std::async(std::launch::async, [&] {
      const auto begin = Clock::now();
      const std::string reply = emulator::serve::ask_control(daemon_->control(), message.dump());
      exchange.took = Clock::now() - begin;
      exchange.bytes = reply.size();
      exchange.reply = Json::parse(reply);
    });
    while (asked.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      const auto begin = Clock::now();
      EXPECT_FALSE(host.read(kHardwareCode).empty()) << "no reply within a second";
      exchange.longest_wait = std::max(exchange.longest_wait, Clock::now() - begin);
      ++exchange.polls;
    }
    return exchange;
  }
  /// If the message took long, a host has waited for a part of that time at most. A busy machine may itself
  /// make it wait for a part of a second.
  static void expect_served(const Exchange& exchange, const std::string& what) {
    if (exchange.took < std::chrono::seconds(1)) return;
    EXPECT_LT(exchange.longest_wait, exchange.took / 2) << what;
    EXPECT_GT(exchange.polls, 2) << what;
  }

  const std::unique_ptr<RunningUnderstudy> daemon_ = RunningUnderstudy::of_bench(R"(understudy: 1
lines:
  line: { stations: [ { name: feeder, model: simple2-r3 } ] }
  b: { stations: [ { name: mill, model: super-40nc } ] }
  c: { stations: [ { name: cell, model: rs-m8194h, address: 1 } ] }
  d: { stations: [ { name: chain, model: slim } ] }
)");
};

TEST_F(LargeMessages, OfAWrongProgramGetAHundredMistakes) {
  struct Case {
    std::string device;
    std::string text;
  };
  const std::vector<Case> cases = {
      {"feeder", times("LDX M8003\n", 220'000)}, {"mill", "AREA PLC\n" + times("LDX M8003\n", 220'000)},
      {"cell", times("LDX M8003\n", 220'000)},   {"cell", "MP 1\n" + times("TRIGGER 8.0 none\n", 120'000)},
      {"chain", times("LDX M8003\n", 220'000)},
  };
  for (const Case& c : cases) {
    const Exchange exchange = ask({{"do", "program"}, {"device", c.device}, {"text", c.text}});
    const std::string what = c.device + ": " + c.text.substr(0, 30);
    ASSERT_EQ(exchange.reply.value("ok", true), false) << what;
    const Json& mistakes = exchange.reply.at("mistakes");
    EXPECT_EQ(mistakes.size(), kMaxMistakes) << what;
    EXPECT_LT(exchange.bytes, 40'000U) << what;
    const std::string error = exchange.reply.at("error");
    EXPECT_TRUE(error.starts_with("line ")) << error;
    EXPECT_TRUE(error.ends_with(" (and at least 99 more)")) << error;
    EXPECT_TRUE(
        mistakes.back().at("what").get<std::string>().ends_with(" (mistake 100; reading stopped here)"))
        << mistakes.back();
    EXPECT_LE(mistakes.front().at("line").get<int>(), mistakes.back().at("line").get<int>());
    expect_served(exchange, what);
  }
}

TEST_F(LargeMessages, OfAProgramThatIsTooLongLetHostsBeServed) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"feeder", times("NOP\n", 800'000)},
      {"mill", "AREA PLC\n" + times("LD M0\n", 500'000) + "END\n"},
      {"cell", "MP 1\n" + times("RSM_MACRO_SET_RVAR 1 2\n", 160'000) + "END\n"},
      {"chain", times("MA 100\n", 500'000)},
  };
  for (const auto& [device, text] : cases) {
    const Exchange exchange = ask({{"do", "program"}, {"device", device}, {"text", text}});
    EXPECT_EQ(exchange.reply.value("ok", true), false) << device;
    EXPECT_LE(exchange.reply.at("mistakes").size(), kMaxMistakes);
    expect_served(exchange, device);
  }
}

TEST_F(LargeMessages, ThatNameTooMuchAreRefused) {
  nlohmann::json values = nlohmann::json::object();  // an ordered object searches all keys for each new one
  Json names = Json::array();
  for (int i = 0; i < 60'000; ++i) {
    values["feeder.0x" + std::to_string(10'000 + i)] = i;
    names.push_back("feeder.nothing" + std::to_string(i));
  }
  const std::string long_text = times("x", 3'000'000);
  struct Case {
    Json message;
    std::string says;
  };
  const std::vector<Case> cases = {
      {{{"do", "set"}, {"values", Json(values)}},
       "an object has more than 4096 members; expected fewer, in several messages"},
      {{{"do", "input"}, {"values", Json(values)}},
       "an object has more than 4096 members; expected fewer, in several messages"},
      {{{"do", "turn"}, {"values", Json(values)}},
       "an object has more than 4096 members; expected fewer, in several messages"},
      {{{"do", "eval"}, {"expression", long_text}}, "is too long; expected a text of at most 65536 bytes"},
      {{{"do", "get"}, {"names", {long_text}}}, "is too long; expected a text of at most 65536 bytes"},
      {{{"do", "set"}, {"values", {{long_text, 1}}}}, "is too long; expected a text of at most 65536 bytes"},
      {{{"do", "get"}, {"names", names}}, "feeder: no register is called 'nothing0'"},
  };
  for (const Case& c : cases) {
    const Exchange exchange = ask(c.message);
    EXPECT_EQ(exchange.reply.value("ok", true), false);
    const std::string error = exchange.reply.at("error");
    EXPECT_NE(error.find(c.says), std::string::npos) << error.substr(0, 200);
    EXPECT_LT(error.size(), 400U);
    expect_served(exchange, c.says);
  }
}

// A program that fits is accepted, however it was sent.
TEST_F(LargeMessages, OfAProgramThatFitsAreTaken) {
  const std::string comment = "# " + times("why ", 8'000) + "\n";
  EXPECT_EQ(
      ask({{"do", "program"}, {"device", "chain"}, {"text", comment + "MA 100\n"}}).reply.value("ok", false),
      true);
  EXPECT_EQ(ask({{"do", "program"}, {"device", "chain"}}).reply.at("text"), "MA 100\n");
}

}  // namespace large_messages_test
}  // namespace understudy::acceptance
