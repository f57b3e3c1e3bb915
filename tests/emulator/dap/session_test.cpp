// Requests in each phase of a session, and requests that are wrong: each gets one reply, and the session goes
// on.
#include "emulator/dap/session.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/dap/bench_link.h"
#include "tests/emulator/serve/control/running_daemon.h"

namespace understudy::emulator::dap {
namespace session_test {

using serve::Running;
using serve::Speed;

/// A session attached to a running daemon.
class Client {
 public:
  explicit Client(Running& running)
      : session_(
            [&running](std::string_view, const Json&) {
              return Launched{.link = std::make_unique<SocketLink>(running.rig.folder.path + "/control")};
            },
            [this](const Json& message) { heard_.push_back(message); }) {}

  /// Returns the only reply.
  Json ask(const std::string& command, const Json& arguments = Json::object()) {
    heard_.clear();
    Json request{{"seq", ++sent_}, {"type", "request"}, {"command", command}};
    if (!arguments.is_null()) request["arguments"] = arguments;
    session_.handle(request.dump());
    Json reply;
    for (const Json& message : heard_) {
      if (message["type"] == "event") continue;
      EXPECT_TRUE(reply.is_null()) << "two replies to " << request;
      reply = message;
    }
    EXPECT_EQ(reply["request_seq"], sent_) << request;
    EXPECT_EQ(reply["command"], command);
    if (!reply["success"].get<bool>()) {
      const std::string why = reply.value("message", std::string());
      EXPECT_FALSE(why.empty()) << request;
      EXPECT_EQ(why.find('\n'), std::string::npos) << request;
      EXPECT_EQ(reply["body"]["error"]["format"], why);
    }
    return reply;
  }
  std::string refusal_of(const std::string& command, const Json& arguments = Json::object()) {
    return ask(command, arguments).value("message", std::string());
  }
  void send_raw(const std::string& text) {
    heard_.clear();
    session_.handle(text);
  }
  const std::vector<Json>& received() const { return heard_; }
  Session& session() { return session_; }

 private:
  std::vector<Json> heard_;
  int sent_ = 0;
  Session session_;
};

/// The phases in which a request is answered: Fresh, Ready, Configuring, Stopped, rUnning, Ended.
struct Row {
  const char* command;
  const char* phases;
};
constexpr std::array<Row, 31> kTable{{{"initialize", "F"},
                                      {"launch", "R"},
                                      {"attach", "R"},
                                      {"configurationDone", "C"},
                                      {"setBreakpoints", "CSU"},
                                      {"breakpointLocations", "CSU"},
                                      {"setExceptionBreakpoints", "CSU"},
                                      {"setDataBreakpoints", "CSU"},
                                      {"dataBreakpointInfo", "CSU"},
                                      {"setInstructionBreakpoints", "CSU"},
                                      {"disassemble", "CSU"},
                                      {"threads", "CSU"},
                                      {"stackTrace", "CSU"},
                                      {"source", "CSU"},
                                      {"scopes", "CSU"},
                                      {"variables", "CSU"},
                                      {"setVariable", "CSU"},
                                      {"setExpression", "CSU"},
                                      {"evaluate", "CSU"},
                                      {"completions", "CSU"},
                                      {"continue", "S"},
                                      {"next", "S"},
                                      {"stepIn", "S"},
                                      {"stepOut", "S"},
                                      {"stepBack", "S"},
                                      {"reverseContinue", "S"},
                                      {"pause", "SU"},
                                      {"restart", "SU"},
                                      {"terminate", "FRCSUE"},
                                      {"disconnect", "FRCSUE"},
                                      {"gotoTargets", ""}}};

void bring_to(Client& client, char phase) {
  if (phase == 'F') return;
  EXPECT_EQ(client.ask("initialize")["success"], true);
  if (phase == 'R') return;
  EXPECT_EQ(client.ask("attach", {{"stopOnEntry", phase == 'S'}})["success"], true);
  if (phase == 'C') return;
  EXPECT_EQ(client.ask("configurationDone")["success"], true);
  if (phase == 'E') client.ask("terminate");
}

TEST(DapSession, AnswersEachRequestInItsPhases) {
  Running running(Speed{});
  const std::array<std::pair<char, const char*>, 6> phases{
      {{'F', "the session is not initialized; expected `initialize` first"},
       {'R', "no bench has been launched; expected `launch` or `attach` first"},
       {'C', "the session is being configured; expected `configurationDone` first"},
       {'S', "the bench has stopped; expected it to run"},
       {'U', "the bench is running; expected it to be stopped by `pause`"},
       {'E', "the bench has ended; expected `disconnect`"}}};
  for (const auto& [phase, sentence] : phases) {
    for (const Row& row : kTable) {
      Client client(running);
      bring_to(client, phase);
      const std::string why = client.refusal_of(row.command);
      if (std::string_view(row.phases).empty()) {
        EXPECT_NE(why.find("is unknown"), std::string::npos) << why;
        continue;
      }
      const bool is_answered = std::string_view(row.phases).find(phase) != std::string_view::npos;
      EXPECT_EQ(why == std::string(row.command) + ": " + sentence, !is_answered)
          << row.command << " in " << phase << ": " << why;
    }
  }
}

TEST(DapSession, RefusesWrongArgumentsInASentence) {
  Running running;
  Client client(running);
  bring_to(client, 'S');
  const std::array<const char*, 16> keys{
      "threadId",    "frameId",    "source",  "breakpoints", "line",    "variablesReference",
      "name",        "value",      "column",  "text",        "filters", "filterOptions",
      "granularity", "expression", "context", "startFrame"};
  const std::vector<Json> wrong{nullptr,
                                -1,
                                0,
                                std::uint64_t{18446744073709551615U},
                                1e300,
                                "",
                                "x\ny",
                                true,
                                Json::array({5}),
                                Json::array({{{"line", "x"}}}),
                                Json{{"path", 5}},
                                Json{{"sourceReference", 99}}};
  for (const Row& row : kTable) {
    const std::string command = row.command;
    if (command == "terminate" || command == "disconnect" || command == "restart") continue;
    for (const Json& arguments : {Json(5), Json("x"), Json::array()})
      EXPECT_EQ(client.refusal_of(command, arguments), command + ": arguments: expected an object");
    for (const char* const key : keys) {
      for (const Json& value : wrong) {
        client.ask(command, {{key, value}});
        if (client.session().is_running()) client.ask("pause");
        while (client.session().is_running()) client.session().poll();
      }
    }
  }
  EXPECT_EQ(client.ask("threads")["body"]["threads"].size(), 2U);
  EXPECT_EQ(client.refusal_of("variables", {{"variablesReference", std::uint64_t{18446744073709551615U}}}),
            "variables: variablesReference: expected a whole number");
}

TEST(DapSession, RefusesALaunchAtAnImpossibleSpeed) {
  Running running;
  Client client(running);
  bring_to(client, 'R');
  for (const char* const speed : {"fast", "0", "-1", "20000", "nan", ""}) {
    EXPECT_EQ(client.refusal_of("launch", {{"speed", speed}}),
              "launch: speed: '" + std::string(speed) +
                  "' is not a speed; expected real, free, manual or a factor");
    EXPECT_EQ(client.session().is_running(), false);
  }
  EXPECT_EQ(client.ask("launch", {{"speed", "2.5"}})["success"], true);
}

TEST(DapSession, SaysWhatIsNotARequest) {
  Running running;
  Client client(running);
  for (const std::string text : {"", "{", "[]", "5", "null", "{}", R"({"seq":"1","type":"request"})",
                                 "\xff\xfe", R"({"seq":1,"type":"request","command":"initialize"} more)"}) {
    client.send_raw(text);
    ASSERT_EQ(client.received().size(), 1U) << text;
    EXPECT_EQ(client.received()[0]["event"], "output") << text;
  }
  client.send_raw(std::string(100'000, '[') + std::string(100'000, ']'));
  EXPECT_EQ(client.received().at(0)["event"], "output");
  for (const char* const text :
       {R"({"seq":1,"type":"response","command":"initialize"})", R"({"seq":1,"type":"request"})",
        R"({"seq":1,"type":"request","command":5})", R"({"seq":1,"type":"request","command":"a\nb"})"}) {
    client.send_raw(text);
    ASSERT_EQ(client.received().size(), 1U) << text;
    EXPECT_EQ(client.received()[0]["success"], false) << text;
  }
  EXPECT_EQ(client.ask("initialize")["success"], true);
}

TEST(DapSession, EndsWithItsBench) {
  auto running = std::make_unique<Running>();
  Client client(*running);
  bring_to(client, 'S');
  running.reset();
  EXPECT_NE(client.refusal_of("evaluate", {{"expression", "time"}}).find("control"), std::string::npos);
  client.session().poll();
  ASSERT_FALSE(client.received().empty());
  EXPECT_EQ(client.received().back()["event"], "terminated");
  EXPECT_EQ(client.refusal_of("threads"), "threads: the bench has ended; expected `disconnect`");
  EXPECT_EQ(client.ask("disconnect")["success"], true);
  EXPECT_TRUE(client.session().is_over());
}

TEST(DapSession, LeavesTheBenchAsItWasFound) {
  Running running(Speed{});
  const auto look = [&] { return Json::parse(running.ask(R"({"do":"look"})").dump()); };
  {
    Client client(running);
    bring_to(client, 'S');
    client.ask("setExceptionBreakpoints", {{"filters", {"program-error", "limit"}}});
    EXPECT_EQ(running.ask(R"({"do":"break"})")["breakpoints"].size(), 2U);
    EXPECT_TRUE(look().value("paused", false));
  }
  EXPECT_EQ(running.ask(R"({"do":"break"})")["breakpoints"].size(), 0U);
  EXPECT_FALSE(look().value("paused", false));
}

}  // namespace session_test
}  // namespace understudy::emulator::dap
