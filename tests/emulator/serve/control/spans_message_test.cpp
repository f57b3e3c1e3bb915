// The waits of a host in simulated time, asked for while it runs.
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "emulator/serve/daemon/kept_waits.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace spans_message_test {

using std::chrono::milliseconds;

/// A bench whose host has waited as the tests say.
class SpansMessage : public testing::Test {
 protected:
  void wait(std::size_t thread, milliseconds begin, milliseconds end, const std::string& text) {
    rig_.daemon.world().advance_to(end);
    rig_.daemon.record_wait(thread, begin, text);
  }
  Json ask(const std::string& more = "") { return rig_.ask(R"({"do":"spans")" + more + "}"); }
  DaemonRig& rig() { return rig_; }

 private:
  DaemonRig rig_;
};

Json span(const char* lane, std::int64_t begin_ms, std::int64_t end_ms, const char* text) {
  Json made{{"lane", lane},
            {"begin_ns", begin_ms * 1'000'000},
            {"end_ns", end_ms * 1'000'000},
            {"kind", "wait"},
            {"text", text}};
  if (std::string(text).ends_with("in vain")) made["bad"] = true;
  return made;
}

TEST_F(SpansMessage, TellsWhatTheHostHasWaitedFor) {
  EXPECT_EQ(ask(), Json::parse(R"({"ok":true,"spans":[],"of":0})"));
  wait(1, milliseconds(0), milliseconds(100), "sleeps");
  wait(2, milliseconds(50), milliseconds(250), "waits for a reply in vain");
  wait(1, milliseconds(100), milliseconds(300), "waits for a reply");
  rig().daemon.observers().waits.add_source([] {
    return std::vector<HostWait>{{2, milliseconds(250), milliseconds(300), "waits for data"}};
  });
  const Json all = ask();
  EXPECT_EQ(
      all["spans"],
      (Json{span("host", 0, 100, "sleeps"), span("host thread 2", 50, 250, "waits for a reply in vain"),
            span("host", 100, 300, "waits for a reply"), span("host thread 2", 250, 300, "waits for data")}));
  EXPECT_EQ(all["of"], 4);
  EXPECT_FALSE(all.contains("left_out"));
  EXPECT_EQ(
      ask(R"(,"from_ns":260000000)")["spans"],
      (Json{span("host", 100, 300, "waits for a reply"), span("host thread 2", 250, 300, "waits for data")}));
  EXPECT_EQ(ask(R"(,"from_ns":1000000,"to_ns":49000000)")["spans"],
            (Json::array({span("host", 0, 100, "sleeps")})));
  // Waits of a lane that lie within a dot, which is 300 ms here, are one.
  const Json coarse = ask(R"(,"dots":1)")["spans"];
  Json joined = span("host thread 2", 50, 300, "waits for a reply in vain");
  joined["count"] = 2;
  EXPECT_EQ(coarse,
            (Json{span("host", 0, 100, "sleeps"), joined, span("host", 100, 300, "waits for a reply")}));
  rig().daemon.observers().waits.add_source({});
  EXPECT_EQ(ask()["of"], 3);
}

TEST_F(SpansMessage, KeepsTheLastWaits) {
  constexpr std::int64_t kWaits = static_cast<std::int64_t>(KeptWaits::kMax) + 10;
  for (std::int64_t i = 0; i < kWaits; ++i) wait(1, milliseconds(i), milliseconds(i + 1), "sleeps");
  const std::string from = R"(,"from_ns":)" + std::to_string((kWaits - 3) * 1'000'000 + 1);
  const Json last = ask(from);
  EXPECT_EQ(last["of"], 3) << last;
  EXPECT_EQ(last["left_out"], 10);
  EXPECT_EQ(ask(R"(,"to_ns":9000000,"dots":4000)")["spans"], Json::array()) << "they are no longer kept";
  std::size_t reported = 0;
  for (Json page{{"next", 0}}; page.contains("next"); reported += page["spans"].size()) {
    page = ask(R"(,"dots":4000,"from":)" + page["next"].dump());
    EXPECT_LE(page["spans"].size(), 2000U);
    EXPECT_EQ(page["of"], KeptWaits::kMax);
  }
  EXPECT_EQ(reported, KeptWaits::kMax);
}

TEST_F(SpansMessage, RefusesWhatIsNoStretch) {
  wait(1, milliseconds(0), milliseconds(100), "sleeps");
  EXPECT_EQ(ask(R"(,"dots":0)")["error"], "dots: expected 1 to 4000");
  EXPECT_EQ(ask(R"(,"from_ns":5000000,"to_ns":5000000)")["error"],
            "to_ns: is not later than from_ns; expected a time span between 0 and the last moment");
  EXPECT_EQ(ask(R"(,"kind":"wait")")["ok"], false);
}

}  // namespace spans_message_test
}  // namespace understudy::emulator::serve
