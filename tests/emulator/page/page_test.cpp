// The page's server: who gets access, and what benches and browsers receive from each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "emulator/page/web_files.h"
#include "tests/emulator/page/page_rig.h"

namespace understudy::emulator::page {
namespace page_test {

using Clock = std::chrono::steady_clock;

/// A bench whose value counts the `look` messages.
std::string counting(const TestJson& message) {
  static std::atomic<int> count = 0;
  if (message["do"] != "look") return TestJson{{"ok", true}, {"echo", message}}.dump();
  ++count;
  TestJson reply{{"ok", true},      {"pid", 7},        {"simulated_time_ns", count * 1000},
                 {"paused", false}, {"speed", "real"}, {"advancing", false}};
  if (message.contains("names")) {
    reply["values"] = TestJson::array();
    for (const TestJson& name : message["names"]) {
      reply["values"].push_back(name == "fixed"  ? TestJson(5)
                                : name == "none" ? TestJson()
                                                 : TestJson(count.load()));
    }
  }
  if (message.contains("frames")) {
    const int first = std::max(message["frames"].get<int>(), 1);
    reply["frames"] = TestJson::array();
    for (int i = first; i <= 300 && i < first + 200; ++i)
      reply["frames"].push_back({{"number", i}, {"text", "frame"}});
    reply["next_frame"] = std::min(first + 200, 301);
  }
  if (message.contains("status")) reply["status"] = {{"alive", true}};
  return reply.dump();
}

/// Returns true if the page has closed the connection; what it sent before does not matter.
bool is_closed(TestBrowser& browser) {
  pollfd one{browser.descriptor(), POLLIN, 0};
  char bytes[4096];
  while (poll(&one, 1, 100) > 0) {
    if (recv(browser.descriptor(), bytes, sizeof(bytes), 0) <= 0) return true;
  }
  return false;
}

TEST(PageFiles, AreServedWithTheirTypesAndAStrictPolicy) {
  PageRig rig;
  const std::string at = std::to_string(rig.page.port());
  for (const auto& [path, type] :
       std::vector<std::pair<std::string, std::string>>{{"/", "text/html"},
                                                        {"/index.html", "text/html"},
                                                        {"/preact.js", "text/javascript"},
                                                        {"/uplot.js", "text/javascript"},
                                                        {"/uplot.css", "text/css"},
                                                        {"/page.js?x=1", "text/javascript"}}) {
    TestBrowser browser(rig.page.port());
    EXPECT_EQ(browser.ask("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + at + "\r\n"), "HTTP/1.1 200")
        << path;
    EXPECT_NE(browser.head().find("Content-Type: " + type), std::string::npos) << browser.head();
    for (const char* policy :
         {"default-src 'self'", "frame-ancestors 'none'", "X-Content-Type-Options: nosniff",
          "Cache-Control: no-store", "Referrer-Policy: no-referrer"}) {
      EXPECT_NE(browser.head().find(policy), std::string::npos) << policy;
    }
    EXPECT_FALSE(browser.read_all().empty());
  }
  for (const std::string path : {"/", "/rest.js", "/preact.js", "/page.css"}) {
    TestBrowser plain(rig.page.port());
    TestBrowser packing(rig.page.port());
    const std::string request = "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + at + "\r\n";
    EXPECT_EQ(plain.ask(request), "HTTP/1.1 200") << path;
    EXPECT_EQ(packing.ask(request + "Accept-Encoding: gzip, br\r\n"), "HTTP/1.1 200") << path;
    EXPECT_EQ(plain.head().find("Content-Encoding"), std::string::npos) << path;
    EXPECT_NE(packing.head().find("Content-Encoding: gzip"), std::string::npos) << path;
    EXPECT_LT(packing.read_all().size(), plain.read_all().size()) << path;
  }
  std::size_t bytes = 0;
  for (const EmbeddedFile& file : embedded_files()) bytes += file.bytes.size();
  EXPECT_LT(bytes, 300'000U);
}

/// A slow connection needs no further round trips for them.
TEST(PageFiles, HaveTheFirstScriptsInsideThePage) {
  PageRig rig;
  const std::string request = "GET / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(rig.page.port()) + "\r\n";
  TestBrowser browser(rig.page.port());
  EXPECT_EQ(browser.ask(request), "HTTP/1.1 200");
  const std::string head = browser.head();
  const std::string page = browser.read_all();
  EXPECT_EQ(page.find("src=\"page.js\""), std::string::npos);
  EXPECT_EQ(page.find("src=\"early.js\""), std::string::npos);
  EXPECT_NE(page.find("new WebSocket"), std::string::npos);
  EXPECT_NE(page.find("modules['./page.js']"), std::string::npos);
  const std::string before = "script-src 'self' 'nonce-";
  const std::size_t at = head.find(before);
  ASSERT_NE(at, std::string::npos) << head;
  const std::string nonce = head.substr(at + before.size(), 32);
  EXPECT_NE(nonce, rig.page.token());
  std::size_t scripts = 0;
  for (std::size_t i = page.find("<script"); i != std::string::npos; i = page.find("<script", i + 1)) {
    ++scripts;
    EXPECT_NE(page.substr(i, page.find('>', i) - i).find(" nonce=\"" + nonce + "\""), std::string::npos);
  }
  EXPECT_EQ(scripts, 2U);
}

TEST(PageFiles, HoldNoOtherFileAndNoSecret) {
  PageRig rig;
  const std::string host = "Host: 127.0.0.1:" + std::to_string(rig.page.port()) + "\r\n";
  for (const char* path : {"/../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/web/index.html", "/.",
                           "/..", "/none", "*", "http://127.0.0.1/", "/index.html/", "/ws"}) {
    TestBrowser browser(rig.page.port());
    EXPECT_EQ(browser.ask("GET " + std::string(path) + " HTTP/1.1\r\n" + host), "HTTP/1.1 404") << path;
    EXPECT_EQ(browser.read_all().find(rig.page.token()), std::string::npos);
  }
  TestBrowser head(rig.page.port());
  EXPECT_EQ(head.ask("HEAD / HTTP/1.1\r\n" + host), "HTTP/1.1 200");
  EXPECT_EQ(head.read_all(), "");
}

struct RequestCase {
  std::string request;  // PORT stands for the port; without the empty line
  const char* answer;   // empty: the connection is closed
};

TEST(PageRequests, ThatAreWrongAreRefused) {
  PageRig rig;
  const std::string upgrade =
      "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
      "dGhlIHNhbXBsZSBub25jZQ==\r\n";
  const std::vector<RequestCase> cases{
      {"GET / HTTP/1.1\r\n", "HTTP/1.1 403"},
      {"GET / HTTP/1.1\r\nHost: evil.example:PORT\r\n", "HTTP/1.1 403"},
      {"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n", "HTTP/1.1 403"},
      {"GET / HTTP/1.1\r\nHost: 127.0.0.1:PORT.evil.example\r\n", "HTTP/1.1 403"},
      {"GET / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nHost: evil.example\r\n", "HTTP/1.1 403"},
      {"GET / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://evil.example\r\n", "HTTP/1.1 403"},
      {"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n" + upgrade, "HTTP/1.1 403"},
      {"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: null\r\n" + upgrade, "HTTP/1.1 403"},
      {"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://evil.example:PORT\r\n" + upgrade,
       "HTTP/1.1 403"},
      {"GET /ws HTTP/1.1\r\nHost: evil.example:PORT\r\nOrigin: http://evil.example:PORT\r\n" + upgrade,
       "HTTP/1.1 403"},
      {"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: https://127.0.0.1:PORT\r\n" + upgrade,
       "HTTP/1.1 403"},
      {"GET /other HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://127.0.0.1:PORT\r\n" + upgrade,
       "HTTP/1.1 404"},
      {"POST / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n", "HTTP/1.1 405"},
      {"PUT /page.js HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n", "HTTP/1.1 405"},
      {"DELETE / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n", "HTTP/1.1 405"},
      {"OPTIONS / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n", "HTTP/1.1 405"},
      {"POST / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nContent-Length: 10\r\n", "HTTP/1.1 413"},
      {"GET / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nX: " + std::string(20'000, 'x') + "\r\n", "HTTP/1.1 431"},
      {"nonsense\r\n", "HTTP/1.1 400"},
      {std::string("\0\1\2\3\r\n", 6), "HTTP/1.1 400"},
  };
  for (const RequestCase& one : cases) {
    std::string request = one.request;
    for (std::size_t at; (at = request.find("PORT")) != std::string::npos;)
      request.replace(at, 4, std::to_string(rig.page.port()));
    SCOPED_TRACE(request.substr(0, 200));
    TestBrowser browser(rig.page.port());
    EXPECT_EQ(browser.ask(request), one.answer);
  }
}

TEST(PageSockets, WithoutTheTokenAreClosedAndHearNothing) {
  PageRig rig;
  std::string wrong = rig.page.token();
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  for (const std::string& first :
       {TestJson{{"token", wrong}}.dump(), TestJson{{"token", ""}}.dump(), TestJson{{"token", 7}}.dump(),
        std::string("{}"), std::string("nonsense"), std::string(), rig.page.token(),
        TestJson{{"do", "ask"}, {"id", 1}, {"message", {{"do", "bench"}}}}.dump()}) {
    TestBrowser browser(rig.page.port());
    ASSERT_TRUE(browser.open_socket(rig.page.port()));
    browser.write(TestBrowser::frame(first));
    EXPECT_TRUE(browser.hear().is_null()) << first;
    EXPECT_EQ(browser.why(), "the token is wrong") << first;
  }
  EXPECT_EQ(rig.browser()->why(), "");
  EXPECT_EQ(rig.hello["read_only"], false);
  EXPECT_EQ(rig.hello["benches"].size(), 1U);
}

TEST(PageSockets, ThatSayTooMuchAreClosed) {
  PageRig rig;
  const auto browser = rig.browser();
  browser->write(TestBrowser::frame(std::string(65 * 1024, ' ')));
  EXPECT_TRUE(browser->hear().is_null());
}

TEST(PageSockets, AreSixteen) {
  PageRig rig;
  std::vector<std::unique_ptr<TestBrowser>> all;
  for (int i = 0; i < 16; ++i) all.push_back(rig.browser());
  TestBrowser one_more(rig.page.port());
  ASSERT_TRUE(one_more.open_socket(rig.page.port()));
  one_more.say({{"token", rig.page.token()}});
  EXPECT_TRUE(one_more.hear().is_null());
  EXPECT_EQ(one_more.why(), "too many browsers");
  all.pop_back();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(rig.browser()->why(), "");
}

TEST(PageConnections, ByTheThousandLeaveItAlive) {
  PageRig rig([](PageOptions& options) { options.limits.request = std::chrono::milliseconds(500); });
  const auto begin = Clock::now();
  std::vector<std::unique_ptr<TestBrowser>> all;
  for (int i = 0; i < 1'000; ++i) {
    all.push_back(std::make_unique<TestBrowser>(rig.page.port()));
    if (i % 3 == 0) all.back()->write("GET / HTTP/1.1\r\nHost: 127");  // half a request
    if (i % 3 == 1) all.back()->hang_up();
  }
  // Connections that send nothing are closed, and then there are free places again.
  for (int i = 0; i < 50; ++i) {
    TestBrowser browser(rig.page.port());
    if (browser.ask("GET / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(rig.page.port()) + "\r\n") ==
        "HTTP/1.1 200")
      break;
    ASSERT_LT(i, 49);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(20));
}

TEST(PageConnections, OfStrangersDoNotKeepOthersOut) {
  PageRig rig;  // an unauthenticated client has 5 s
  std::vector<std::unique_ptr<TestBrowser>> unauthenticated;
  const auto come = [&](int count) {
    for (int i = 0; i < count; ++i) {
      unauthenticated.push_back(std::make_unique<TestBrowser>(rig.page.port()));
      if (i % 3 == 0) unauthenticated.back()->write("GET / HTTP/1.1\r\nHost: 127");
      if (i % 3 == 1) {
        EXPECT_TRUE(unauthenticated.back()->open_socket(rig.page.port()));
      }
    }
  };
  const auto begin = Clock::now();
  come(64);
  const auto owner = rig.browser();  // is admitted at once
  TestBrowser reader(rig.page.port());
  EXPECT_EQ(reader.ask("GET / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(rig.page.port()) + "\r\n"),
            "HTTP/1.1 200");
  come(200);
  EXPECT_EQ(rig.browser()->why(), "");
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(4)) << "the bench waited for no one";
  // The oldest were closed for new ones; the newest are still connected, and so is every client that had the
  // token.
  EXPECT_TRUE(is_closed(*unauthenticated.front()));
  EXPECT_FALSE(is_closed(*unauthenticated.back()));
  owner->say({{"do", "nonsense"}});
  EXPECT_EQ(owner->hear()["is"], "error");
}

TEST(PageLooks, AskForNamesByTheNumberThatTheBenchGaveThem) {
  PageRig rig;
  std::atomic<int> spelt_out = 0;
  std::atomic<int> by_number = 0;
  std::atomic<int> pid = 7;
  std::atomic<bool> is_forgotten = false;
  const auto answer = [&](const TestJson& message) {
    if (message["do"] != "look") return std::string(R"({"ok":true})");
    if (is_forgotten && message.contains("look")) return std::string(R"({"ok":false,"error":"not kept"})");
    is_forgotten = false;
    ++(message.contains("names") ? spelt_out : by_number);
    // Another daemon uses the same number for other names.
    const int value = message.contains("names") || pid == 7 ? 5 : 999;
    return TestJson{{"ok", true},      {"pid", pid.load()}, {"simulated_time_ns", 1},
                    {"paused", false}, {"speed", "real"},   {"advancing", false},
                    {"look", 3},       {"values", {value}}}
        .dump();
  };
  MadeUpBench bench(rig.socket(), answer);
  const auto browser = rig.browser();
  browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"it"}}});
  EXPECT_EQ(browser->hear_one("look")["values"]["it"], 5);
  const auto wait_for = [](const std::atomic<int>& count, int min) {
    for (int i = 0; i < 300 && count < min; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_GE(count, min);
  };
  wait_for(by_number, 5);
  EXPECT_EQ(spelt_out, 1);
  // Forgotten names are sent in full again, so nothing is lost.
  is_forgotten = true;
  wait_for(spelt_out, 2);
  wait_for(by_number, 10);
  // The same for names of another daemon; its replies by a wrong number are not shown.
  pid = 8;
  wait_for(spelt_out, 3);
  while (true) {
    const TestJson message = browser->hear();
    ASSERT_FALSE(message.is_null());
    EXPECT_NE(message.value("state", ""), "gone");
    if (message.contains("values")) {
      EXPECT_EQ(message["values"]["it"], 5);
      break;
    }
  }
}

TEST(PageLooks, AreOneForAllBrowsersAndAtMostThirtyASecond) {
  PageRig rig;
  MadeUpBench bench(rig.socket(), counting);
  std::vector<std::unique_ptr<TestBrowser>> all;
  for (int i = 0; i < 8; ++i) {
    all.push_back(rig.browser());
    all.back()->say({{"do", "watch"}, {"bench", 0}, {"names", {"a", "fixed", "b" + std::to_string(i)}}});
  }
  for (const auto& browser : all) ASSERT_FALSE(browser->hear_one("look").is_null());
  const int before = bench.looks();
  std::this_thread::sleep_for(std::chrono::milliseconds(2'000));
  const int looks = bench.looks() - before;
  EXPECT_LE(looks, 62);
  EXPECT_GE(looks, 5);  // a loaded machine
  all.clear();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const int last = bench.looks();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(bench.looks(), last) << "there is no observer";
}

TEST(PageLooks, TellOnlyWhatHasChanged) {
  PageRig rig;
  MadeUpBench bench(rig.socket(), counting);
  const auto browser = rig.browser();
  browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"a", "fixed", "none"}}, {"status", true}});
  const TestJson first = browser->hear_one("look");
  ASSERT_FALSE(first.is_null());
  EXPECT_EQ(first["values"]["fixed"], 5);
  EXPECT_TRUE(first["values"].contains("none") && first["values"]["none"].is_null());
  EXPECT_TRUE(first["values"].contains("a"));
  const TestJson second = browser->hear_one("look");
  ASSERT_FALSE(second.is_null());
  EXPECT_TRUE(second["values"].contains("a"));
  EXPECT_FALSE(second["values"].contains("fixed"));
  EXPECT_GT(second["time_ns"], first["time_ns"]);
}

TEST(PageLooks, TellEveryFrameOnce) {
  PageRig rig;
  MadeUpBench bench(rig.socket(), counting);
  for (int i = 0; i < 2; ++i) {  // the second browser gets the earlier ones as well
    const auto browser = rig.browser();
    browser->say({{"do", "watch"}, {"bench", 0}, {"frames", true}});
    int expected = 1;
    while (expected <= 300) {
      const TestJson look = browser->hear_one("look");
      ASSERT_FALSE(look.is_null()) << expected;
      if (!look.contains("frames")) continue;
      EXPECT_LE(look["frames"].size(), 200U);
      for (const TestJson& frame : look["frames"]) EXPECT_EQ(frame["number"], expected++);
    }
  }
}

/// From a bench that has forgotten some before the first request: frames 5 to 8, then 20 to 22, then 23.
class PageLosses : public testing::TestWithParam<const char*> {};

/// The daemon may still answer for a browser that has left when the next one comes.
TEST(PageLooks, UnderWayTakeNothingFromTheNextBrowser) {
  PageRig rig;
  std::atomic<bool> is_held = false;
  std::atomic<bool> is_under_way = false;
  const MadeUpBench bench(rig.socket(), [&](const TestJson& message) {
    while (is_held && message["do"] == "look") {
      is_under_way = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return counting(message);
  });
  const TestJson watch{{"do", "watch"}, {"bench", 0}, {"frames", true}};
  const auto first = rig.browser();
  first->say(watch);
  for (std::size_t received = 0; received < 300;)
    received += first->hear_one("look").value("frames", TestJson::array()).size();
  is_held = true;
  while (!is_under_way) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  first->say({{"do", "watch"}, {"bench", 0}});
  first->say({{"do", "nonsense"}});
  first->hear_one("error");
  const auto second = rig.browser();
  is_held = false;
  second->say(watch);
  TestJson look = second->hear_one("look");
  while (!look.contains("frames")) {
    ASSERT_TRUE(look.is_object());
    look = second->hear_one("look");
  }
  EXPECT_EQ(look["frames"][0]["number"], 1);
}

TEST_P(PageLosses, AreToldWhereverTheHoleIs) {
  const std::string key = GetParam();
  const std::string next_key = key == "frames" ? "next_frame" : "next_event";
  PageRig rig;
  std::atomic<int> asked = 0;
  std::atomic<int> max = 1;
  const auto answer = [&](const TestJson& message) {
    if (message["do"] != "look" || !message.contains(key)) return std::string(R"({"ok":true})");
    constexpr int kBegin[] = {5, 20, 23, 40};
    constexpr int kEnd[] = {9, 23, 24, 41};
    const int at = asked;
    const bool is_restored = max == 4;
    const int begin = at < max ? kBegin[at] : 0;
    const int end = at < max ? kEnd[at] : 0;
    TestJson reply{
        {"ok", true},     {"pid", 7},        {"simulated_time_ns", at}, {"restores", is_restored ? 1 : 0},
        {"paused", true}, {"speed", "real"}, {"advancing", false},      {key, TestJson::array()}};
    for (int number = begin; number < end; ++number) reply[key].push_back({{"number", number}});
    reply[next_key] = at < max ? end : kEnd[at - 1];
    if (at < max) asked = at + 1;
    return reply.dump();
  };
  MadeUpBench bench(rig.socket(), answer);
  const auto wait_for = [&](TestBrowser& browser, int last) {
    std::pair<std::vector<int>, int> reported;
    while (reported.first.empty() || reported.first.back() < last) {
      const TestJson look = browser.hear_one("look");
      if (look.is_null()) break;
      for (const TestJson& one : look.value(key, TestJson::array())) reported.first.push_back(one["number"]);
      reported.second += look.value(key + "_lost", 0);
    }
    return reported;
  };
  using Told = std::pair<std::vector<int>, int>;
  const auto browser = rig.browser();
  browser->say({{"do", "watch"}, {"bench", 0}, {key, true}});
  EXPECT_EQ(wait_for(*browser, 8), Told({5, 6, 7, 8}, 0)) << "frames before its first look are not missed";
  max = 2;
  EXPECT_EQ(wait_for(*browser, 22), Told({20, 21, 22}, 11));
  // There is also a gap within the frames that the page has stored.
  const auto later = rig.browser();
  later->say({{"do", "watch"}, {"bench", 0}, {key, true}});
  EXPECT_EQ(wait_for(*later, 22), Told({5, 6, 7, 8, 20, 21, 22}, 11));
  max = 3;
  EXPECT_EQ(wait_for(*browser, 23), Told({23}, 0));
  // Events that did not happen, because the world was restored, are not missed.
  max = 4;
  EXPECT_EQ(wait_for(*browser, 40), Told({40}, 0));
}

INSTANTIATE_TEST_SUITE_P(, PageLosses, testing::Values("frames", "events"),
                         [](const auto& key) { return std::string(key.param); });

TEST(PageLooks, ForgetWhatWasBeforeTheWorldWasRestored) {
  PageRig rig;
  std::atomic<int> restores = 0;
  const auto answer = [&](const TestJson& message) {
    if (message["do"] != "look") return std::string(R"({"ok":true})");
    const int now = restores;
    TestJson reply{
        {"ok", true},           {"pid", 7},        {"simulated_time_ns", now}, {"restores", now},
        {"paused", true},       {"speed", "real"}, {"advancing", false},       {"values", TestJson::array()},
        {"next_frame", now + 2}};
    reply["frames"] = TestJson::array();
    if (message.value("frames", 0) < now + 2) reply["frames"].push_back({{"number", now + 1}});
    return reply.dump();
  };
  MadeUpBench bench(rig.socket(), answer);
  const auto numbers = [](TestBrowser& browser) {
    while (true) {
      const TestJson look = browser.hear_one("look");
      if (look.is_null() || look.contains("frames")) return look.value("frames", TestJson::array());
    }
  };
  const auto first = rig.browser();
  first->say({{"do", "watch"}, {"bench", 0}, {"frames", true}});
  EXPECT_EQ(numbers(*first), TestJson::array({{{"number", 1}}}));
  restores = 1;
  EXPECT_EQ(numbers(*first), TestJson::array({{{"number", 2}}}));
  const auto later = rig.browser();
  later->say({{"do", "watch"}, {"bench", 0}, {"frames", true}});
  EXPECT_EQ(numbers(*later), TestJson::array({{{"number", 2}}}));
}

TEST(PageAsks, ArePassedOnAndAnsweredById) {
  PageRig rig;
  MadeUpBench bench(rig.socket(), counting);
  const auto browser = rig.browser();
  browser->say({{"do", "ask"}, {"bench", 0}, {"id", 41}, {"message", {{"do", "bench"}}}});
  const TestJson answer = browser->hear_one("answer");
  ASSERT_FALSE(answer.is_null());
  EXPECT_EQ(answer["id"], 41);
  EXPECT_EQ(answer["reply"]["echo"], (TestJson{{"do", "bench"}, {"as", "page"}}));
  browser->say({{"do", "ask"}, {"id", 42}, {"message", {{"do", "snapshot"}, {"file", "/etc/passwd"}}}});
  EXPECT_EQ(browser->hear_one("answer")["reply"]["ok"], false);
  EXPECT_EQ(bench.asked().size(), 1U);
  browser->write(TestBrowser::frame("nonsense"));
  EXPECT_EQ(browser->hear_one("error").value("is", ""), "error");
}

TEST(PageAsks, OfAReadOnlyPageChangeNothing) {
  PageRig rig([](PageOptions& options) { options.is_read_only = true; });
  MadeUpBench bench(rig.socket(), counting);
  const auto browser = rig.browser();
  EXPECT_EQ(rig.hello["read_only"], true);
  browser->say({{"do", "ask"}, {"id", 1}, {"message", {{"do", "set"}, {"values", {{"a", 1}}}}}});
  EXPECT_EQ(browser->hear_one("answer")["reply"]["ok"], false);
  EXPECT_TRUE(bench.asked().empty());
}

TEST(PageBenches, ThatGoAndComeBackAreSaidAtOnce) {
  PageRig rig;
  const auto browser = rig.browser();
  browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"a"}}});
  EXPECT_EQ(browser->hear_one("bench")["state"], "gone");
  std::uint64_t epoch = 0;
  for (int i = 0; i < 2; ++i) {
    {
      MadeUpBench bench(rig.socket(), counting);
      const TestJson state = browser->hear_one("bench");
      ASSERT_FALSE(state.is_null());
      EXPECT_EQ(state["state"], "there");
      EXPECT_GT(state["epoch"], epoch);
      epoch = state["epoch"];
      EXPECT_TRUE(browser->hear_one("look")["values"].contains("a"));
      browser->say({{"do", "ask"}, {"id", i}, {"message", {{"do", "bench"}}}});
      EXPECT_EQ(browser->hear_one("answer")["reply"]["ok"], true);
    }
    EXPECT_EQ(browser->hear_one("bench")["state"], "gone");
  }
  browser->say({{"do", "ask"}, {"id", 9}, {"message", {{"do", "bench"}}}});
  EXPECT_EQ(browser->hear_one("answer")["reply"]["ok"], false);
}

TEST(PageBenches, ThatSayNothingAreSaidToBeSilent) {
  PageRig rig;
  MadeUpBench bench(rig.socket(), [](const TestJson&) { return std::string(); });
  const auto browser = rig.browser();
  browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"a"}}});
  EXPECT_EQ(browser->hear_one("bench", 8'000)["state"], "silent");
}

TEST(PageBenches, ThatSayNonsenseAreGone) {
  for (const char* nonsense :
       {"nonsense", "{}", "[]", R"({"ok":true})", R"({"ok":true,"pid":-1})", R"({"ok":false,"error":"x"})"}) {
    PageRig rig;
    MadeUpBench bench(rig.socket(), [&](const TestJson&) { return std::string(nonsense); });
    const auto browser = rig.browser();
    browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"a"}}});
    EXPECT_EQ(browser->hear_one("bench")["state"], "gone") << nonsense;
  }
}

TEST(PageBrowsers, ThatNeverReadHoldNobodyUp) {
  PageRig rig;
  MadeUpBench bench(rig.socket(), counting);
  TestBrowser stuck(rig.page.port());
  const int little = 4'096;
  setsockopt(stuck.descriptor(), SOL_SOCKET, SO_RCVBUF, &little, sizeof(little));
  ASSERT_TRUE(stuck.open_socket(rig.page.port()));
  stuck.say({{"token", rig.page.token()}});
  stuck.say({{"do", "watch"}, {"bench", 0}, {"names", {"a"}}, {"frames", true}});
  for (int i = 0; i < 2'000; ++i)
    stuck.say({{"do", "ask"}, {"id", i}, {"message", {{"do", "bench"}, {"device", std::string(500, 'x')}}}});
  const auto browser = rig.browser();
  browser->say({{"do", "watch"}, {"bench", 0}, {"names", {"a"}}});
  for (int i = 0; i < 20; ++i) ASSERT_FALSE(browser->hear_one("look").is_null());
}

}  // namespace page_test
}  // namespace understudy::emulator::page
