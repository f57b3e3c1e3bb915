// `understudy page` and `serve --page` as processes, next to a bench that continues whatever happens to them.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/emulator/page/test_browser.h"

namespace understudy::acceptance {
namespace page_test {

using emulator::page::TestBrowser;
using emulator::page::TestJson;

/// The token in "page http://127.0.0.1:1234/#TOKEN".
struct Address {
  std::uint16_t port = 0;
  std::string token;
};
Address address_in(const std::string& output) {
  const std::size_t at = output.find("page http://127.0.0.1:");
  if (at == std::string::npos || output.find('\n', at) == std::string::npos) return {};
  const std::size_t port = at + 22;
  const std::size_t hash = output.find('#', port);
  return {.port = static_cast<std::uint16_t>(std::stoi(output.substr(port))),
          .token = output.substr(hash + 1, output.find('\n', hash) - hash - 1)};
}

Address address_of(const Process& process) {
  Address address;
  EXPECT_TRUE(eventually([&] {
    address = address_in(process.output());
    return address.port != 0;
  })) << process.errors();
  return address;
}

std::unique_ptr<TestBrowser> browser_at(const Address& address) {
  auto browser = std::make_unique<TestBrowser>(address.port);
  EXPECT_TRUE(browser->open_socket(address.port));
  browser->say({{"token", address.token}});
  EXPECT_EQ(browser->hear().value("is", ""), "hello");
  return browser;
}

TEST(Page, ShowsWhatAHostWritesAndHoldsWhatIsClicked) {
  const RunningUnderstudy server;
  Process page({UNDERSTUDY_BINARY, "page", "--control", server.control()});
  const auto browser = browser_at(address_of(page));
  browser->say({{"do", "watch"},
                {"bench", 0},
                {"names", {"device.Aaxis_Speed", "device.DIN_3", "device.DIN_3@by"}},
                {"frames", true},
                {"events", true}});
  TestJson look = browser->hear_one("look");
  ASSERT_FALSE(look.is_null());
  EXPECT_EQ(look["values"]["device.DIN_3"], 0);
  ASSERT_EQ(understudy({"poll", server.port(), "--model", "simple2-r3", "Aaxis_Speed=123"}).exit_code, 0);
  bool has_seen_value = false;
  bool has_seen_event = false;
  while (!has_seen_value || !has_seen_event) {
    look = browser->hear_one("look");
    ASSERT_FALSE(look.is_null());
    has_seen_value =
        has_seen_value || look.value("/values/device.Aaxis_Speed"_json_pointer, TestJson()) == 123;
    for (const TestJson& event : look.value("events", TestJson::array())) {
      has_seen_event =
          has_seen_event || (event["what"] == "write" && event["by"] == "host" && event["value"] == 123);
    }
  }
  browser->say({{"do", "ask"}, {"id", 1}, {"message", {{"do", "input"}, {"values", {{"device.DIN_3", 1}}}}}});
  EXPECT_EQ(browser->hear_one("answer")["reply"]["ok"], true);
  EXPECT_EQ(server.ctl({"get", "DIN_3"}).output, "DIN_3 1\n");
  for (bool is_held = false; !is_held;) {
    look = browser->hear_one("look");
    ASSERT_FALSE(look.is_null());
    is_held = look.value("/values/device.DIN_3@by"_json_pointer, TestJson()) == "held";
  }
  page.send(SIGTERM);
  EXPECT_EQ(page.wait(kPatience), 0);
}

TEST(Page, ShowsAllThatAreRunningWithoutAControl) {
  const PrivateFolder folder;
  const auto at_home = [&](Words words) {
    words.insert(words.begin(), UNDERSTUDY_BINARY);
    return std::make_unique<Process>(
        words, Environment{{"XDG_RUNTIME_DIR", folder.path()}, {"UNDERSTUDY_CONTROL", ""}});
  };
  const auto nobody = at_home({"page"});
  EXPECT_EQ(nobody->wait(std::chrono::seconds(10)), 3);
  EXPECT_EQ(nobody->errors(), "understudy: page: no daemon answers in " + (folder / "understudy") +
                                  "; expected a running `understudy serve`, or --control SOCKET\n");
  std::vector<std::unique_ptr<Process>> daemons;
  for (int i = 0; i < 2; ++i) daemons.push_back(at_home({"serve", "--model", "simple2-r3"}));
  for (const auto& daemon : daemons) {
    ASSERT_TRUE(eventually([&] { return daemon->output().find("ready") != std::string::npos; }));
  }
  const auto page = at_home({"page"});
  const Address address = address_of(*page);
  TestBrowser browser(address.port);
  ASSERT_TRUE(browser.open_socket(address.port));
  browser.say({{"token", address.token}});
  EXPECT_EQ(browser.hear()["benches"].size(), 2U);
}

TEST(Page, IsStoppedAndKilledWithoutHarmToTheBench) {
  const RunningUnderstudy server;
  Process page({UNDERSTUDY_BINARY, "page", "--control", server.control()});
  const auto browser = browser_at(address_of(page));
  browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"time"}}, {"status", true}});
  ASSERT_FALSE(browser->hear_one("look").is_null());
  page.send(SIGSTOP);
  EXPECT_EQ(server.ctl({"get", "Cord_A"}).exit_code, 0);
  EXPECT_EQ(understudy({"poll", server.port(), "--model", "simple2-r3", "Cord_A"}).exit_code, 0);
  page.send(SIGKILL);
  EXPECT_EQ(page.wait(kPatience), 128 + SIGKILL);
  EXPECT_EQ(understudy({"poll", server.port(), "--model", "simple2-r3", "Cord_A"}).exit_code, 0);
}

TEST(Page, BesideABenchEndsWithIt) {
  Address address;
  {
    const RunningUnderstudy server({"--page"});
    address = address_of(server.process());
    const auto browser = browser_at(address);
    browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"time"}}});
    EXPECT_FALSE(browser->hear_one("look").is_null());
  }
  EXPECT_TRUE(eventually([&] { return !TestBrowser(address.port).is_connected(); }));
}

TEST(Page, ARecordingShowsWhereItsScenarioFailed) {
  const PrivateFolder folder;
  const std::string scenario =
      folder.write("fails.yaml",
                   "understudy: 1\n"
                   "bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
                   "steps:\n"
                   "  - write: { feeder.Aaxis_Speed: 60000 }\n    exception: 3\n"
                   "  - advance: 1700ms\n"
                   "  - assert: feeder.Cord_A == 1\n");
  ASSERT_EQ(understudy({"run", scenario, "--record", folder.path()}).exit_code, 1);
  Process page({UNDERSTUDY_BINARY, "replay", folder / "fails.jsonl", "--page"});
  const auto browser = browser_at(address_of(page));
  int id = 0;
  const auto ask = [&](const TestJson& message) {
    browser->say({{"do", "ask"}, {"id", ++id}, {"message", message}});
    return browser->hear_one("answer")["reply"];
  };
  const TestJson timeline = ask({{"do", "timeline"}})["timeline"];
  ASSERT_EQ(timeline["marks"].size(), 2U) << timeline;
  EXPECT_EQ(timeline["marks"][0]["what"], "exception");
  EXPECT_EQ(timeline["marks"][1]["what"], "failed");
  EXPECT_EQ(timeline["marks"][1]["text"], "'feeder.Cord_A == 1' does not hold (feeder.Cord_A is 0)");
  EXPECT_EQ(timeline["marks"][1]["time_ns"], timeline["end_ns"]);
  EXPECT_FALSE(timeline.contains("marks_left_out"));
  EXPECT_EQ(ask({{"do", "seek"}, {"to_ns", timeline["end_ns"]}})["simulated_time_ns"], timeline["end_ns"]);
  // The past of this moment is sent again, once: the request 1.7 s before, and its reply.
  browser->say({{"do", "watch"}, {"bench", 0}, {"frames", true}});
  const TestJson look = browser->hear_one("look");
  EXPECT_EQ(look.value("frames", TestJson::array()).size(), 2U) << look;
  EXPECT_EQ(ask({{"do", "seek"}, {"to_ns", 0}})["simulated_time_ns"], 0);
}

TEST(Page, ThatCannotHaveItsPortSaysSo) {
  const RunningUnderstudy server;
  Process first({UNDERSTUDY_BINARY, "page", "--control", server.control()});
  const Finished second =
      understudy({"page", "--control", server.control(), "--port", std::to_string(address_of(first).port)});
  EXPECT_EQ(second.exit_code, 3);
  EXPECT_EQ(lines_of(second.errors).size(), 1U) << second.errors;
  EXPECT_EQ(understudy({"page", "--control", server.control(), "--listen", "nowhere"}).exit_code, 3);
  EXPECT_EQ(understudy({"page", "--control", server.control(), "--port", "70000"}).exit_code, 2);
}

}  // namespace page_test
}  // namespace understudy::acceptance
