// Debugging over the control socket: the effect of each message in each state of the clock.
#include <future>

#include "tests/emulator/serve/control/running_daemon.h"

namespace understudy::emulator::serve {
namespace debug_messages_test {

constexpr const char* kProgram =
    "        Delay_mSec 5\n"
    "again:  Wait_IO DIN_5 ON\n"
    "        VAR_Inc VAR32\n"
    "        Delay_mSec 5\n"
    "        Jump again\n"
    "        END\n";

struct Debugged {
  explicit Debugged(Speed speed = {.kind = Speed::Kind::manual}) : running(speed) {
    EXPECT_EQ(ask({{"do", "program"}, {"device", "feeder"}, {"text", kProgram}})["ok"], true);
    set("feeder.PROG_MAIN_RunTime_START", 0);
  }
  Json ask(const Json& message) { return running.ask(message.dump()); }
  void set(const std::string& name, int value) {
    EXPECT_EQ(ask({{"do", "set"}, {"values", {{name, value}}}})["ok"], true);
  }
  void hold_input(bool on) {
    EXPECT_EQ(ask({{"do", "input"}, {"values", {{"feeder.DIN_5", on ? 1 : 0}}}})["ok"], true);
  }
  std::string error_of(const Json& message) {
    Json reply = ask(message);
    EXPECT_EQ(reply["ok"], false) << message << reply;
    return reply.value("error", "");
  }

  Running running;
};

TEST(Break, IsSetListedHitAndDeleted) {
  Debugged debugged;
  Json set =
      debugged.ask({{"do", "break"}, {"device", "feeder"}, {"line", 4}, {"when", "feeder.PROG_VAR0 >= 2"}});
  EXPECT_EQ(set["breakpoint"], (Json{{"number", 1},
                                     {"kind", "line"},
                                     {"device", "feeder"},
                                     {"found", true},
                                     {"line", 4},
                                     {"when", "feeder.PROG_VAR0 >= 2"},
                                     {"hits", 0}}));
  debugged.hold_input(true);
  Json stopped = debugged.ask({{"do", "continue"}, {"within", "1s"}});
  EXPECT_EQ(stopped["stop"], (Json{{"reason", "breakpoint"},
                                   {"text", "breakpoint 1: feeder line 4: Delay_mSec 5"},
                                   {"breakpoint", 1},
                                   {"device", "feeder"},
                                   {"line", 4},
                                   {"instruction", 3},
                                   {"code", "Delay_mSec 5"},
                                   {"callers", 0}}));
  EXPECT_EQ(debugged.running.get("feeder.PROG_VAR0"), 2);
  Json stacks = debugged.ask({{"do", "stack"}, {"device", "feeder"}});
  EXPECT_EQ(stacks["stacks"][0]["frames"][0],
            (Json{{"line", 4}, {"instruction", 3}, {"text", "Delay_mSec 5"}}))
      << stacks;
  EXPECT_EQ(stacks["stop"], stopped["stop"]);
  Json scopes = debugged.ask({{"do", "variables"}, {"device", "feeder"}})["scopes"];
  ASSERT_EQ(scopes.size(), 3U);
  EXPECT_EQ(scopes[0]["values"], (Json{{"feeder.PROG_VAR0", 2}, {"feeder.DIN_5", 1}})) << scopes;
  EXPECT_EQ(scopes[1]["values"]["feeder.A.position"], 0);
  EXPECT_EQ(scopes[2]["values"]["feeder.DIN_5"], 1);
  EXPECT_EQ(debugged.ask({{"do", "variables"}, {"device", "feeder"}, {"scope", "axes"}})["scopes"].size(),
            1U);
  EXPECT_EQ(debugged.ask({{"do", "break"}})["breakpoints"][0]["hits"], 1);
  EXPECT_EQ(debugged.ask({{"do", "break"}, {"delete", 1}}), (Json{{"ok", true}}));
  Json over = debugged.ask({{"do", "continue"}, {"within", "20ms"}});
  EXPECT_FALSE(over.contains("stop")) << over;
  EXPECT_EQ(over["simulated_time_ns"], stopped["simulated_time_ns"].get<std::int64_t>() + 20'000'000);
}

TEST(Break, EndsWhateverAdvances) {
  Debugged debugged;
  debugged.hold_input(true);
  debugged.ask({{"do", "break"}, {"device", "feeder"}, {"line", 3}});
  for (const Json& message : {Json{{"do", "advance"}, {"by", "1s"}}, Json{{"do", "step"}, {"ticks", 1000}},
                              Json{{"do", "run-until"}, {"condition", "time > 1h"}, {"within", "2h"}}}) {
    Json reply = debugged.ask(message);
    EXPECT_EQ(reply["stop"]["breakpoint"], 1) << message << reply;
    EXPECT_LT(reply["simulated_time_ns"], 1'000'000'000) << message;
  }
}

TEST(Break, TellsLogpointsAsEventsAlone) {
  Debugged debugged;
  debugged.hold_input(true);
  EXPECT_EQ(
      debugged.ask(
          {{"do", "break"}, {"device", "feeder"}, {"line", 3}, {"log", "now {feeder.PROG_VAR0}"}})["ok"],
      true);
  EXPECT_FALSE(debugged.ask({{"do", "advance"}, {"by", "300ms"}}).contains("stop"));
  std::vector<std::string> reported;
  Json reply = debugged.ask({{"do", "events"}, {"since", 1}});
  for (const Json& event : reply["events"]) {
    if (event["what"] == "logpoint") reported.push_back(event["text"]);
  }
  ASSERT_GT(reported.size(), 2U);
  EXPECT_EQ(reported[0].substr(0, 4), "now ");
}

TEST(DebugMessages, GiveTheTextInWhoseLinesTheyCount) {
  Debugged debugged;
  Json source = debugged.ask({{"do", "source"}, {"device", "feeder"}});
  EXPECT_FALSE(source.contains("path")) << "the bench names no file";
  EXPECT_EQ(source["lines"], (Json{1, 2, 3, 4, 5, 6}));
  EXPECT_NE(source["text"].get<std::string>().find("Wait_IO DIN_5 ON"), std::string::npos) << source;
  EXPECT_EQ(
      debugged.ask({{"do", "variables"}, {"device", "feeder"}, {"scope", "program"}})["scopes"][0]["words"],
      (Json{{"VAR32", "feeder.PROG_VAR0"}}));
}

TEST(DebugMessages, TellAStopToObservers) {
  Debugged debugged;
  debugged.hold_input(true);
  EXPECT_FALSE(debugged.ask({{"do", "look"}}).contains("stop"));
  debugged.ask({{"do", "break"}, {"device", "feeder"}, {"line", 3}});
  const Json stop = debugged.ask({{"do", "continue"}, {"within", "1s"}})["stop"];
  EXPECT_EQ(debugged.ask({{"do", "look"}})["stop"], stop);
}

TEST(DebugMessages, RefuseWhatMakesNoSense) {
  Debugged debugged;
  const Json at{{"do", "break"}, {"device", "feeder"}};
  const auto error = [&](const Json& more) {
    Json message = at;
    message.update(more);
    return debugged.error_of(message);
  };
  EXPECT_EQ(error(Json::object()), "nothing to stop at; expected line, instruction, when, write or on");
  EXPECT_EQ(error({{"line", 3}, {"write", "feeder.PROG_VAR0"}}),
            "write: cannot be combined with line; expected one of them");
  EXPECT_EQ(error({{"line", -3}}).substr(0, 5), "line:");
  EXPECT_EQ(error({{"line", "x"}}).substr(0, 5), "line:");
  EXPECT_EQ(error({{"line", 1e18}}).substr(0, 5), "line:");
  EXPECT_EQ(error({{"line", 3}, {"nth", 0}}), "nth: 0 is too small; expected 1 or more");
  EXPECT_EQ(error({{"line", 3}, {"when", "PROG_VAR0 +"}}).substr(0, 5), "when:");
  EXPECT_EQ(error({{"line", 3}, {"by", "host"}}), "by: needs write; expected both, or neither");
  EXPECT_EQ(error({{"line", 3}, {"program", "MP1"}}),
            "program: needs instruction; expected both, or neither");
  EXPECT_EQ(error({{"line", 3}, {"colour", "red"}}).find('\n'), std::string::npos);
  EXPECT_EQ(debugged.error_of({{"do", "break"}, {"on", "exception"}, {"device", "feeder"}}),
            "device: needs line or instruction; expected one of them");
  EXPECT_EQ(debugged.error_of({{"do", "break"}, {"line", 3}}).substr(0, 10), "the device");
  EXPECT_EQ(debugged.error_of({{"do", "break"}, {"delete", 7}}),
            "delete: there is no breakpoint 7; expected one that `break` lists");
  EXPECT_NE(debugged.error_of({{"do", "break"}, {"delete", "some"}}), "");
  EXPECT_EQ(debugged.error_of({{"do", "step"}, {"what", "back"}, {"device", "feeder"}}),
            "what: 'back' is unknown; expected instruction, line, over, out or stand");
  EXPECT_EQ(debugged.error_of({{"do", "step"}, {"what", "out"}, {"device", "feeder"}}),
            "no routine is running; expected a step within a called routine");
  EXPECT_EQ(debugged.error_of({{"do", "continue"}}),
            "'within' is missing, and the speed is manual; expected a duration");
  EXPECT_NE(debugged.error_of({{"do", "continue"}, {"within", 5}}), "");
  EXPECT_NE(debugged.error_of({{"do", "continue"}, {"within", "-5s"}}), "");
  EXPECT_NE(debugged.error_of({{"do", "stack"}, {"device", "nobody"}}), "");
  EXPECT_EQ(debugged.error_of({{"do", "variables"}, {"device", "feeder"}, {"scope", "all"}}),
            "scope: 'all' is unknown; expected program, axes or terminals");
  EXPECT_EQ(debugged.ask({{"do", "break"}})["breakpoints"].size(), 0U);
}

// --- the table of docs/debugging.md ----------------------------------------------------------------

enum class Clock { running, stopped, stepping };
enum class Event { hit, pause, resume, go_on, step, advance, set_break, restore, program, power };

constexpr int kClocks = 3;
constexpr int kEvents = 10;
constexpr const char* kTable[kClocks][kEvents] = {
    // hit, pause, resume, continue, step, advance, break, restore, program, power
    {"stopped", "stopped", "running", "refused", "refused", "refused", "running", "running", "running",
     "running"},
    {"stopped", "stopped", "running", "running", "stopped", "stopped", "stopped", "stopped", "stopped",
     "stopped"},
    {"stopped", "stopped", "refused", "refused", "refused", "refused", "stepping", "refused", "stopped",
     "stopped"}};

Json message_of(Event event) {
  switch (event) {
    case Event::hit: return {{"do", "input"}, {"values", {{"feeder.DIN_5", 1}}}};
    case Event::pause: return {{"do", "pause"}};
    case Event::resume: return {{"do", "resume"}};
    case Event::go_on: return {{"do", "continue"}};
    case Event::step: return {{"do", "step"}, {"what", "line"}, {"device", "feeder"}, {"within", "1ms"}};
    case Event::advance: return {{"do", "advance"}, {"by", "1ms"}};
    case Event::set_break: return {{"do", "break"}, {"device", "feeder"}, {"line", 5}};
    case Event::restore: return {{"do", "restore"}, {"name", "before"}};
    case Event::program:
      return {{"do", "program"}, {"device", "feeder"}, {"text", "        NOP\n        END\n"}};
    case Event::power: return {{"do", "power"}, {"device", "feeder"}, {"to", "off"}};
  }
  return {};
}

TEST(DebugMessages, DoInEachStateWhatTheTableSays) {
  for (int c = 0; c < kClocks; ++c) {
    for (int e = 0; e < kEvents; ++e) {
      const auto clock = static_cast<Clock>(c);
      const auto event = static_cast<Event>(e);
      SCOPED_TRACE("state " + std::to_string(c) + ", event " + message_of(event).dump());
      Debugged debugged(Speed{});
      EXPECT_EQ(debugged.ask({{"do", "break"}, {"device", "feeder"}, {"line", 3}})["ok"], true);
      EXPECT_EQ(debugged.ask({{"do", "pause"}})["ok"], true);
      EXPECT_EQ(debugged.ask({{"do", "advance"}, {"by", "20ms"}})["ok"], true);  // it waits for its input
      EXPECT_EQ(debugged.ask({{"do", "snapshot"}, {"name", "before"}})["ok"], true);
      std::future<Json> stepping;
      if (clock == Clock::running) debugged.ask({{"do", "resume"}});
      if (clock == Clock::stepping) {
        stepping = std::async(std::launch::async, [&] {
          return debugged.ask({{"do", "step"}, {"what", "line"}, {"device", "feeder"}, {"within", "8000h"}});
        });
        while (!debugged.ask({{"do", "look"}})["advancing"].get<bool>()) std::this_thread::yield();
      }
      Json reply = debugged.ask(message_of(event));
      const std::string expected = kTable[c][e];
      EXPECT_EQ(reply["ok"], expected != "refused") << reply;
      EXPECT_EQ(reply.dump().find("\\n"), std::string::npos);
      const auto is_in = [&](const std::string& wanted) {
        Json look = debugged.ask({{"do", "look"}});
        const bool is_advancing = look["advancing"].get<bool>();
        const bool is_paused = look["paused"].get<bool>();
        return wanted == (is_advancing ? "stepping" : is_paused ? "stopped" : "running");
      };
      const std::string clocks[] = {"running", "stopped", "stepping"};
      const std::string wanted = expected == "refused" ? clocks[c] : expected;
      for (int tries = 0; tries < 20'000 && !is_in(wanted); ++tries) std::this_thread::yield();
      EXPECT_TRUE(is_in(wanted)) << wanted;
      if (!stepping.valid()) continue;
      debugged.ask({{"do", "pause"}});
      Json step = stepping.get();
      EXPECT_EQ(step["ok"], true) << step;
      const std::string reason = step.contains("stop") ? step["stop"]["reason"].get<std::string>() : "";
      EXPECT_EQ(reason, event == Event::hit       ? "breakpoint"
                        : event == Event::program ? "program"
                        : event == Event::power   ? "power"
                                                  : "")
          << step;
    }
  }
}

}  // namespace debug_messages_test
}  // namespace understudy::emulator::serve
