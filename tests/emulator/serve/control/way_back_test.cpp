// Back on a running bench: the same moments as on the way forward, and another course from there.
#include <fcntl.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/files/descriptor.h"
#include "tests/emulator/serve/control/running_daemon.h"

namespace understudy::emulator::serve {
namespace way_back_test {

/// Counts as long as its input is on.
constexpr const char* kProgram =
    "again:  Wait_IO DIN_5 ON\n"
    "        VAR_Inc VAR32\n"
    "        Delay_mSec 300\n"
    "        Jump again\n"
    "        END\n";

/// What one sees at a stop: the time, the line, the counter, the input.
using Moment = std::tuple<std::int64_t, int, std::int64_t, std::int64_t>;

struct Debugged {
  Debugged() {
    EXPECT_EQ(ask({{"do", "program"}, {"device", "feeder"}, {"text", kProgram}})["ok"], true);
    EXPECT_EQ(ask({{"do", "set"}, {"values", {{"feeder.PROG_MAIN_RunTime_START", 0}}}})["ok"], true);
    hold_input(true);
  }
  Json ask(const Json& message) { return running.ask(message.dump()); }
  void hold_input(bool on) {
    EXPECT_EQ(ask({{"do", "input"}, {"values", {{"feeder.DIN_5", on ? 1 : 0}}}})["ok"], true);
  }
  Moment moment(const Json& reply) {
    EXPECT_EQ(reply.value("ok", false), true) << reply;
    const int line = reply.contains("stop") ? reply["stop"].value("line", 0) : 0;
    return {reply.value("simulated_time_ns", std::int64_t{-1}), line, running.get("feeder.PROG_VAR0"),
            running.get("feeder.DIN_5")};
  }
  Moment step(bool back = false) {
    Json message{{"do", "step"}, {"what", "line"}, {"device", "feeder"}};
    if (back) message["back"] = true;
    return moment(ask(message));
  }
  std::string refusal(const Json& message) {
    const Json reply = ask(message);
    EXPECT_EQ(reply["ok"], false) << message << reply;
    return reply.value("error", "");
  }

  Running running;
};

TEST(WayBack, HasTheMomentsOfTheWayForward) {
  Debugged debugged;
  std::vector<Moment> forward;
  for (int i = 0; i < 12; ++i) forward.push_back(debugged.step());
  // Events from outside are part of the course.
  debugged.hold_input(false);
  EXPECT_EQ(debugged.ask({{"do", "set"}, {"values", {{"feeder.PROG_VAR0", 500}}}})["ok"], true);
  debugged.hold_input(true);
  EXPECT_LT(std::get<2>(forward.back()), 500);
  std::get<2>(forward.back()) = 500;  // back at that moment, everything of it has happened
  for (int i = 0; i < 12; ++i) forward.push_back(debugged.step());
  EXPECT_GT(std::get<2>(forward.back()), 500);
  for (std::size_t i = forward.size() - 1; i-- > 0;) EXPECT_EQ(debugged.step(true), forward[i]) << i;
}

TEST(WayBack, LeadsToAnotherCourse) {
  Debugged debugged;
  Debugged straight;
  debugged.step();
  const Moment at_first = debugged.step();
  EXPECT_EQ(debugged.ask({{"do", "advance"}, {"by", "1s"}})["ok"], true);
  EXPECT_EQ(debugged.ask({{"do", "set"}, {"values", {{"feeder.PROG_VAR0", 9'000}}}})["ok"], true);
  EXPECT_EQ(debugged.ask({{"do", "advance"}, {"by", "2s"}})["ok"], true);
  // Without breakpoints, back is to where debugging began.
  const Json begun = debugged.ask({{"do", "continue"}, {"back", true}});
  EXPECT_EQ(begun.value("simulated_time_ns", -1), 0) << begun;
  debugged.step();
  EXPECT_EQ(debugged.step(), at_first);
  for (Debugged* one : {&debugged, &straight})
    EXPECT_EQ(one->ask({{"do", "run-until"}, {"condition", "time >= 4s"}, {"within", "5s"}})["ok"], true);
  EXPECT_EQ(debugged.running.get("feeder.PROG_VAR0"), straight.running.get("feeder.PROG_VAR0"));
}

TEST(WayBack, GoesFromBreakpointToBreakpoint) {
  Debugged debugged;
  EXPECT_EQ(debugged.ask({{"do", "break"}, {"device", "feeder"}, {"line", 2}})["ok"], true);
  std::vector<Moment> forward;
  for (int i = 0; i < 4; ++i)
    forward.push_back(debugged.moment(debugged.ask({{"do", "continue"}, {"within", "1s"}})));
  for (std::size_t i = 3; i-- > 0;)
    EXPECT_EQ(debugged.moment(debugged.ask({{"do", "continue"}, {"back", true}})), forward[i]);
  // What observers see ends there, too.
  const Json events = debugged.ask({{"do", "events"}, {"since", 1}})["events"];
  for (const Json& event : events) EXPECT_LE(event["time_ns"], std::get<0>(forward[0])) << event;
}

TEST(WayBack, IsRefusedWhereThereIsNone) {
  Debugged debugged;
  const Json back{{"do", "step"}, {"what", "line"}, {"device", "feeder"}, {"back", true}};
  EXPECT_EQ(debugged.refusal(back),
            "back: nothing has happened since debugging began; expected `continue` or `step` first");
  const Moment there = debugged.step();
  EXPECT_EQ(debugged.refusal({{"do", "continue"}, {"back", 1}}).substr(0, 5), "back:");
  EXPECT_EQ(debugged.refusal({{"do", "continue"}, {"back", true}, {"within", "1s"}}).substr(0, 7), "within:");
  EXPECT_EQ(debugged.refusal({{"do", "step"}, {"what", "stand"}, {"device", "feeder"}, {"back", true}})
                .substr(0, 11),
            "what: stand");
  // A refusal leaves the bench where it was, and at its stop.
  EXPECT_EQ(debugged.moment(debugged.ask({{"do", "stack"}, {"device", "feeder"}})), there);
  {
    const Descriptor host(
        ::open((debugged.running.rig.folder.path + "/feeder.port").c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    ASSERT_TRUE(host);
    EXPECT_EQ(debugged.refusal(back),
              "back: a host has rs485 open; expected no host on the line, or a recording");
  }
  EXPECT_EQ(debugged.ask({{"do", "snapshot"}, {"name", "here"}})["ok"], true);
  EXPECT_EQ(debugged.ask({{"do", "advance"}, {"by", "1s"}})["ok"], true);
  EXPECT_EQ(debugged.ask({{"do", "restore"}, {"name", "here"}})["ok"], true);
  EXPECT_EQ(debugged.refusal(back).substr(0, 27), "back: nothing has happened ");
}

}  // namespace way_back_test
}  // namespace understudy::emulator::serve
