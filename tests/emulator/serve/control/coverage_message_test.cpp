// The executed lines of programs, requested over the control socket.
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace coverage_message_test {

class CoverageMessage : public testing::Test {
 protected:
  CoverageMessage() : daemon_(bench(), options(), [](const std::string&) {}) {}

  Json ask(const Json& message) {
    Json reply;
    handle_message(daemon_, message.dump(), [&](const std::string& line) { reply = Json::parse(line); });
    return reply;
  }
  void run_program() {
    ask({{"do", "set"}, {"values", {{"d.PROG_MAIN_RunTime_START", 0}}}});
    daemon_.world().advance_to(daemon_.world().now() + std::chrono::milliseconds(50));
  }

  TestFolder folder_;
  Daemon daemon_;

 private:
  world::Bench bench() const {
    return world::parse_bench(
        models::all_models(),
        "understudy: 1\nlines: { a: { link: ./a.port, stations: [ { name: d, model: simple2-r3, program: "
        "\"Wait_IO DIN_5 ON\\nEND\\n\" } ] }, b: { link: ./b.port, stations: [ { name: e, model: slim } ] } "
        "}\n",
        "bench.yaml", folder_.path);
  }
  static DaemonOptions options() {
    DaemonOptions options;
    options.speed = {.kind = Speed::Kind::manual};
    return options;
  }
};

TEST_F(CoverageMessage, CountsFromTheFirstMessageOn) {
  run_program();
  Json reply = ask({{"do", "coverage"}, {"device", "d"}});
  EXPECT_EQ(reply["totals"]["lines_run"], 0) << reply;
  EXPECT_EQ(reply["since_ns"], 50'000'000) << reply;
  run_program();
  reply = ask({{"do", "coverage"}});
  EXPECT_EQ(reply["since_ns"], 50'000'000) << reply;
  EXPECT_EQ(reply["totals"], Json::parse(R"({"lines":2,"lines_run":1,"branches":2,"branches_taken":1})"));
  ASSERT_EQ(reply["covered"].size(), 1U) << reply;
  EXPECT_EQ(reply["covered"][0]["lines"], Json::parse("[[1,1,0,1],[2,0]]")) << reply;
  EXPECT_TRUE(reply["covered"][0]["listing"].get<std::string>().starts_with("        Wait_IO DIN_5 ON\n"));
  reply = ask({{"do", "coverage"}, {"again", true}});
  EXPECT_EQ(reply["totals"]["lines_run"], 0) << reply;
  EXPECT_EQ(reply["since_ns"], 100'000'000) << reply;
}

TEST_F(CoverageMessage, ThatIsWrongBeginsNothing) {
  for (const Json& wrong : {Json{{"do", "coverage"}, {"device", "x"}}, Json{{"do", "coverage"}, {"again", 1}},
                            Json{{"do", "coverage"}, {"file", "c.info"}}}) {
    const Json reply = ask(wrong);
    EXPECT_EQ(reply["ok"], false) << wrong;
    EXPECT_EQ(daemon_.observers().coverage, nullptr) << wrong;
  }
}

}  // namespace coverage_message_test
}  // namespace understudy::emulator::serve
