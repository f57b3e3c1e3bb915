// The present lines of programs, for every model that runs some.
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace where_message_test {

struct ProgramCase {
  const char* model;
  const char* program;
  const char* name;   // of the waiting program; empty if there is none
  const char* start;  // a register that starts it
  int value;
  int line;  // in the text that the device returns
  const char* text;
  bool waits_for_time;
};

constexpr ProgramCase kCases[] = {
    {"simple2-r3", "        NOP\n        Delay_mSec 500\n        END\n", "", "PROG_MAIN_RunTime_START", 0, 2,
     "Delay_mSec 500", true},
    {"simple2-r3", "        Wait_IO DIN_5 ON\n        END\n", "", "PROG_MAIN_RunTime_START", 0, 1, "Wait_IO",
     false},
    {"rs-m8194h",
     "MP 41\n  RSM_MACRO_MP_CALL 2\nEND\nMP 2\n  RSM_MACRO_SET_VAR VAR1 1\n  RSM_MACRO_TIMER 500\nEND\n",
     "MP2", "CALL_MP", 41, 3, "RSM_MACRO_TIMER 500", true},
    {"super-40nc", "AREA C\nNOP\nTMR K500\nEND\nAREA PLC\nEND\n", "C", "M8000", 1, 3, "TMR K500", true},
    {"super-40nc", "AREA X\nWAT X5\nEND\nAREA PLC\nEND\n", "X", "M8100", 1, 2, "WAT X5", false},
};

TEST(WhereMessage, TellsTheLineOfEveryModelsPrograms) {
  for (const ProgramCase& one : kCases) {
    SCOPED_TRACE(std::string(one.model) + ": " + one.program);
    TestFolder folder;
    const world::Bench bench =
        world::parse_bench(models::all_models(),
                           "understudy: 1\nlines: { a: { link: ./a.port, stations: [ { name: d, model: " +
                               std::string(one.model) + " } ] } }\n",
                           "bench.yaml", folder.path);
    DaemonOptions options;
    options.speed = {.kind = Speed::Kind::manual};
    Daemon daemon(bench, options, [](const std::string&) {});
    const auto ask = [&](const Json& message) {
      Json reply;
      handle_message(daemon, message.dump(), [&](const std::string& line) { reply = Json::parse(line); });
      EXPECT_EQ(reply["ok"], true) << reply;
      return reply;
    };
    const Json before = ask({{"do", "where"}})["programs"];
    for (const Json& place : before) EXPECT_EQ(place["state"], "stopped") << place;
    ask({{"do", "program"}, {"text", one.program}});
    ask({{"do", "set"}, {"values", {{one.start, one.value}}}});
    daemon.world().advance_to(daemon.world().now() + std::chrono::milliseconds(50));
    const Json programs = ask({{"do", "where"}})["programs"];
    Json found;
    for (const Json& place : programs) {
      if (place.value("program", "") == one.name) found = place;
    }
    ASSERT_FALSE(found.is_null()) << programs;
    EXPECT_EQ(found["state"], "waiting") << found;
    EXPECT_EQ(found["line"], one.line) << found;
    EXPECT_TRUE(found["text"].get<std::string>().starts_with(one.text)) << found;
    EXPECT_NE(found.value("waits_for", ""), "") << found;
    EXPECT_EQ(found.contains("until_ns"), one.waits_for_time) << found;
    if (!one.waits_for_time) continue;
    // It ends when it says so.
    const SimTime until{found["until_ns"].get<std::int64_t>()};
    EXPECT_GT(until, SimTime{std::chrono::milliseconds(450)});
    EXPECT_LT(until, SimTime{std::chrono::milliseconds(600)});
    daemon.world().advance_to(until + std::chrono::milliseconds(20));
    const Json after = ask({{"do", "where"}})["programs"];
    for (const Json& place : after) EXPECT_NE(place.value("text", ""), found["text"]) << place;
  }
}

}  // namespace where_message_test
}  // namespace understudy::emulator::serve
