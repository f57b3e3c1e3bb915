// A running daemon, used through its socket: time only advances on request.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "base/files/text_file.h"
#include "emulator/world/snapshot_file.h"
#include "tests/emulator/serve/control/running_daemon.h"
#include "tests/sanitized.h"

namespace understudy::emulator::serve {
namespace running_daemon_test {

TEST(RunningDaemon, AnAdvanceEndsExactlyWhereItWasToEnd) {
  Running daemon;
  std::int64_t time = 0;
  for (const auto& [by, ns] : std::vector<std::pair<std::string, std::int64_t>>{{"1ns", 1},
                                                                                {"999999ns", 999'999},
                                                                                {"0s", 0},
                                                                                {"250ms", 250'000'000},
                                                                                {"3h", 10'800'000'000'000}}) {
    time += ns;
    EXPECT_EQ(daemon.ask(R"({"do":"advance","by":")" + by + "\"}"),
              (Json{{"ok", true}, {"simulated_time_ns", time}}));
    EXPECT_EQ(daemon.ask(R"({"do":"status"})")["status"]["simulated_time_ns"], time);
  }
}

TEST(RunningDaemon, SaysTheSameInPiecesAsAtOnce) {
  Running daemon;
  Json names = Json::array();
  for (int i = 0; i < 32; ++i) {
    for (const char* half : {"", "_RegL", "_RegH"})
      names.push_back("feeder.PROG_MEM" + std::to_string(i) + half);
  }
  const std::vector<Json> messages{{{"do", "registers"}, {"device", "feeder"}},
                                   {{"do", "get"}, {"device", "turner"}, {"from", 100}},
                                   {{"do", "get"}, {"names", names}},
                                   {{"do", "look"}, {"names", names}, {"status", true}, {"events", 0}},
                                   {{"do", "choices"}, {"device", "feeder"}},
                                   {{"do", "faults"}},
                                   {{"do", "bench"}},
                                   {{"do", "bench"}, {"device", "feeder"}}};
  for (int i = 0; i < 100; ++i) daemon.ask(Json{{"do", "set"}, {"values", {{"feeder.PROG_MEM7", i}}}}.dump());
  for (const Json& message : messages) {
    Json in_pieces = daemon.ask(message.dump());
    std::string whole;
    std::atomic<bool> is_done = false;
    daemon.rig.daemon.post([&] {
      handle_message(daemon.rig.daemon, message.dump(), [&](const std::string& line) { whole = line; });
      is_done = true;
    });
    while (!is_done) std::this_thread::yield();
    Json at_once = Json::parse(whole);
    for (Json* reply : {&in_pieces, &at_once}) {
      EXPECT_EQ((*reply)["ok"], true) << message;
      if (reply->contains("status")) (*reply)["status"].erase("lateness");
    }
    EXPECT_EQ(in_pieces, at_once) << message;
    EXPECT_GT(whole.size(), 500U) << message;
  }
}

TEST(RunningDaemon, ServesOthersBetweenThePiecesOfAReply) {
  Running daemon(Speed{});
  // A client that requests much, again and again, and disconnects before the end.
  std::atomic<bool> is_over = false;
  std::vector<std::thread> greedy;
  for (int i = 0; i < fewer_if_sanitized(4, 4); ++i) {
    greedy.emplace_back([&] {
      while (!is_over) {
        try {
          ask_control(daemon.rig.folder.path + "/control", R"({"do":"registers","device":"feeder"})",
                      std::chrono::milliseconds(1));
        } catch (const ControlError&) {
        }
      }
    });
  }
  for (int i = 0; i < fewer_if_sanitized(15, 3); ++i)
    EXPECT_EQ(daemon.ask(R"({"do":"get","names":["time"]})")["ok"], true);
  is_over = true;
  for (std::thread& one : greedy) one.join();
  EXPECT_EQ(daemon.ask(R"({"do":"registers","device":"feeder"})")["registers"].size(), 200U);
}

TEST(RunningDaemon, AMoveTakesTheTimeThatTheManualComputes) {
  // 32000 pulses at 200 rpm of 3200 pulses, 50 ms ramps: 3.05 s (appendix A).
  Running daemon;
  EXPECT_EQ(daemon.ask(R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.Aaxis_Pulse":32000,)"
                       R"("feeder.Aaxis_Speed":200,"feeder.Aaxis_AccTime":5,"feeder.Aaxis_DecTime":5,)"
                       R"("feeder.Aaxis_Move_INC":1}})")["ok"],
            true);
  daemon.ask(R"({"do":"advance","by":"3048ms"})");
  EXPECT_EQ(daemon.get("feeder.STATUS.4"), 1);
  daemon.ask(R"({"do":"advance","by":"4ms"})");
  EXPECT_EQ(daemon.get("feeder.STATUS.4"), 0);
  EXPECT_EQ(daemon.get("feeder.Cord_A"), 32000);
  EXPECT_EQ(daemon.ask(R"({"do":"status"})")["status"]["devices"][0]["machines"]["A"]["position_pulses"],
            32000);
}

TEST(RunningDaemon, AWireCarriesAnOutputToAnInputOneTickLater) {
  Running daemon;
  daemon.ask(R"({"do":"set","values":{"feeder.DOUT_4":1}})");
  EXPECT_EQ(daemon.get("turner.DIN_10"), 0);
  daemon.ask(R"({"do":"advance","by":"3ms"})");
  EXPECT_EQ(daemon.get("turner.DIN_10"), 1);
  daemon.ask(R"({"do":"set","values":{"feeder.DOUT_4":0}})");
  daemon.ask(R"({"do":"advance","by":"3ms"})");
  EXPECT_EQ(daemon.get("turner.DIN_10"), 0);
}

TEST(RunningDaemon, AnAdvanceIsNoStallAndCannotBeResumedAway) {
  Running daemon;
  // So slow, and with a condition to check, that every tick of the advance has to be stepped: some tenths of
  // a second of work.
  daemon.ask(R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.Aaxis_Pulse":2000000000,)"
             R"("feeder.Aaxis_Speed":1,"feeder.Aaxis_Move_INC":1}})");
  const std::string never =
      R"({"do":"inject","fault":{"stuck":"feeder.DIN_2","level":1,"when":"feeder.A.position > 1900000000"}})";
  ASSERT_EQ(daemon.ask(never)["ok"], true);
  const std::string hours = is_sanitized() ? "900s" : "2h";
  const std::int64_t end = is_sanitized() ? 900'000'000'000 : 7'200'000'000'000;
  std::thread advance(
      [&] { EXPECT_EQ(daemon.ask(R"({"do":"advance","by":")" + hours + R"("})")["ok"], true); });
  bool was_refused = false;
  std::int64_t time = 0;
  while (time < end) {
    if (time > 0) was_refused = was_refused || daemon.ask(R"({"do":"resume"})")["ok"] == false;
    const Json status = daemon.ask(R"({"do":"status"})")["status"];
    time = status["simulated_time_ns"].get<std::int64_t>();
    EXPECT_LT(status["lateness"]["max_us"].get<double>(), 60e6);
    EXPECT_EQ(status["lateness"]["slips"], 0);
  }
  advance.join();
  EXPECT_EQ(time, end);
  EXPECT_TRUE(was_refused);
}

TEST(RunningDaemon, BadMessagesDoNotStopIt) {
  Running daemon;
  for (const std::string message :
       {"", "{", "null", "\xFF", R"({"do":"set","values":{"x":1}})", R"({"do":5})"}) {
    EXPECT_EQ(daemon.ask(message)["ok"], false) << message;
  }
  EXPECT_EQ(daemon.ask(R"({"do":"status"})")["ok"], true);
}

TEST(RunningDaemon, RealTimePassesByItselfUnlessPaused) {
  Running daemon(Speed{.factor = 100});
  const auto now = [&] {
    return daemon.ask(R"({"do":"status"})")["status"]["simulated_time_ns"].get<std::int64_t>();
  };
  const std::int64_t first = now();
  const timespec pause{.tv_sec = 0, .tv_nsec = 2'000'000};
  nanosleep(&pause, nullptr);
  EXPECT_GE(now(), first + 200'000'000);
  daemon.ask(R"({"do":"pause"})");
  const std::int64_t paused = now();
  nanosleep(&pause, nullptr);
  EXPECT_EQ(now(), paused);
  EXPECT_EQ(daemon.ask(R"({"do":"advance","by":"5ms"})")["simulated_time_ns"], paused + 5'000'000);
  daemon.ask(R"({"do":"resume"})");
  nanosleep(&pause, nullptr);
  EXPECT_GT(now(), paused + 5'000'000);
}

TEST(RunUntil, StopsAtTheEndOfTheFirstTickAtWhichItIsTrue) {
  Running daemon;
  // One revolution at 200 rpm with the shortest ramps, 10 ms each: 310 ms, from the end of the tick after the
  // write.
  daemon.ask(R"({"do":"advance","by":"40ms"})");
  daemon.ask(R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.Aaxis_Pulse":3200,)"
             R"("feeder.Aaxis_Speed":200,"feeder.Aaxis_Move_INC":1}})");
  const auto until = [&](const std::string& condition, const std::string& within = "10s") {
    return daemon.ask(Json{{"do", "run-until"}, {"condition", condition}, {"within", within}}.dump());
  };
  const auto reached = [](std::int64_t ms) {
    return Json{{"ok", true}, {"reached", true}, {"simulated_time_ns", ms * 1'000'000}};
  };
  // Full speed is 10.667 pulses per tick; the ramp's 10 ms contribute half of 10 ticks: 53.3, and 95 whole
  // ticks 1013.3.
  EXPECT_EQ(until("feeder.A.pulses >= 1066"), reached(41 + 105));
  EXPECT_EQ(until("feeder.STATUS.4 == 0"), reached(41 + 310));
  EXPECT_EQ(daemon.get("feeder.Cord_A"), 3200);
  EXPECT_EQ(until("feeder.STATUS.4 == 0"), reached(41 + 310)) << "already true";
  EXPECT_EQ(until("feeder.STATUS.4 == 1", "1500us"),
            (Json{{"ok", true}, {"reached", false}, {"simulated_time_ns", 352'500'000}}));
  EXPECT_EQ(until("time >= 400ms"), reached(400)) << "quiet ticks are checked as well";
}

TEST(RunUntil, RefusesWhatIsNoConditionAndMovesNothing) {
  Running daemon;
  struct Case {
    std::string message;
    std::string why;
  };
  for (const Case& c : std::vector<Case>{
           {R"({"do":"run-until","within":"1s"})", "'condition' is missing"},
           {R"({"do":"run-until","condition":"1"})", "'within' is missing"},
           {R"({"do":"run-until","condition":1,"within":"1s"})", "condition"},
           {R"({"do":"run-until","condition":"1","within":"1"})", "within: '1' is not a duration"},
           {R"({"do":"run-until","condition":"feeder.Cord_Z > 0","within":"1s"})", "the nearest is 'Cord_"},
           {R"({"do":"run-until","condition":"feeder.Cord_A >","within":"1s"})", "condition: column"},
           {R"({"do":"run-until","condition":"1","within":"1s","by":"1s"})", "'by'"}}) {
    const Json reply = daemon.ask(c.message);
    EXPECT_EQ(reply["ok"], false) << c.message;
    EXPECT_NE(reply["error"].get<std::string>().find(c.why), std::string::npos) << reply;
  }
  const Json no_result =
      daemon.ask(R"({"do":"run-until","condition":"1 / feeder.Cord_A > 0","within":"1s"})");
  EXPECT_EQ(no_result["ok"], false) << no_result;
  EXPECT_EQ(daemon.ask(R"({"do":"status"})")["status"]["simulated_time_ns"], 0);
}

TEST(RunUntil, IsForAClockThatStands) {
  Running daemon({.kind = Speed::Kind::factor});
  const std::string message = R"({"do":"run-until","condition":"time > 0","within":"1s"})";
  EXPECT_NE(daemon.ask(message)["error"].get<std::string>().find("time is already running"),
            std::string::npos);
  daemon.ask(R"({"do":"pause"})");
  EXPECT_EQ(daemon.ask(message)["reached"], true);
}

TEST(RunUntil, EndsWhereItIsWhenTimeIsPaused) {
  Running daemon;
  Json reply;
  std::thread waits(
      [&] { reply = daemon.ask(R"({"do":"run-until","condition":"feeder.Cord_A > 0","within":"8760h"})"); });
  // Nothing ever moves; it continues tick by tick until it is told to stop.
  while (daemon.ask(R"({"do":"status"})")["status"]["simulated_time_ns"] == 0) usleep(1000);
  const Json paused = daemon.ask(R"({"do":"pause"})");
  waits.join();
  EXPECT_EQ(reply["ok"], true) << reply;
  EXPECT_EQ(reply["reached"], false);
  EXPECT_EQ(reply["simulated_time_ns"], paused["simulated_time_ns"]);
  EXPECT_EQ(daemon.ask(R"({"do":"resume"})")["ok"], true);
}

TEST(RunningDaemon, ASnapshotIsReadAsideAndMadeThePresent) {
  Running daemon;
  const std::string file = daemon.rig.folder.path + "/state.json";
  const auto about = [&](const char* verb) { return Json{{"do", verb}, {"file", file}}.dump(); };
  daemon.ask(R"({"do":"set","values":{"feeder.Aaxis_Speed":200}})");
  daemon.ask(R"({"do":"advance","by":"5ms"})");
  ASSERT_EQ(daemon.ask(about("snapshot"))["ok"], true);
  daemon.ask(R"({"do":"set","values":{"feeder.Aaxis_Speed":7}})");
  daemon.ask(R"({"do":"advance","by":"1s"})");
  EXPECT_EQ(daemon.ask(about("restore")), (Json{{"ok", true}, {"simulated_time_ns", 5'000'000}}));
  EXPECT_EQ(daemon.get("feeder.Aaxis_Speed"), 200);
  EXPECT_EQ(daemon.get("time"), 5'000'000);
}

// There is no reply before it is written, and none of it is written on the daemon's own thread, which has
// continued by then.
TEST(SnapshotMessage, IsOfItsMomentAndWrittenAside) {
  DaemonRig rig;
  const std::string file = rig.folder.path + "/state.json";
  rig.daemon.world().advance_to(std::chrono::milliseconds(5));
  EXPECT_EQ(rig.reply_to(Json{{"do", "snapshot"}, {"file", file}}.dump()), "");
  rig.daemon.world().advance_to(std::chrono::milliseconds(500));
  std::optional<world::WorldState> state;
  for (int i = 0; i < 1000 && !state; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (const auto text = read_text_file(file)) state = world::parse_snapshot(*text, rig.daemon.bench_hash());
  }
  ASSERT_TRUE(state);
  rig.daemon.restore(*state);
  EXPECT_EQ(rig.daemon.world().now(), std::chrono::milliseconds(5));
}

TEST(RunningDaemon, WhatIsNoSnapshotIsRefusedAndChangesNothing) {
  Running daemon;
  const std::string file = daemon.rig.folder.path + "/state.json";
  const std::string restore = Json{{"do", "restore"}, {"file", file}}.dump();
  EXPECT_EQ(daemon.ask(restore)["error"],
            file + ": file: cannot be read (No such file or directory); expected a snapshot");
  for (const auto& [text, error] : std::vector<std::pair<std::string, std::string>>{
           {"", "file: is damaged or not JSON; expected a snapshot"},
           {std::string(100'000, '['), "file: is nested too deeply; expected a snapshot"},
           {R"({"understudy":1,"state":{"a":{}}})", "file: is nested too deeply; expected a snapshot"},
           {"{}", "understudy: is missing; expected a snapshot"}}) {
    std::ofstream(file) << text;
    EXPECT_EQ(daemon.ask(restore)["error"], file + ": " + error);
  }
  EXPECT_EQ(daemon.get("time"), 0);
}

}  // namespace running_daemon_test
}  // namespace understudy::emulator::serve
