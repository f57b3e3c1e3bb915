// A recording opened in the page: any moment of it, and where a scenario failed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "emulator/serve/control/server.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/emulator/page/test_browser.h"

namespace understudy::acceptance {
namespace page_recording_test {

using emulator::page::TestBrowser;
using emulator::page::TestJson;

constexpr const char* kFailing = R"(understudy: 1
name: ends elsewhere
bench:
  lines:
    rs485:
      stations: [ { name: feeder, model: simple2-r3, address: 1 } ]
steps:
  - write: { feeder.Aaxis_SVON: 1 }
  - write: { feeder.Aaxis_Pulse: 3200, feeder.Aaxis_Speed: 20, feeder.Aaxis_AccTime: 1, feeder.Aaxis_DecTime: 1, feeder.Aaxis_Move_INC: 1 }
  - wait: { until: "feeder.STATUS.4 == 0", within: 20s }
  - expect: { feeder.Cord_A: 3201 }
)";

/// The page with the recording of a scenario that fails.
class PageOfARecording : public testing::Test {
 protected:
  void record(const std::string& text) {
    const std::string scenario = folder_.write("failing.yaml", text);
    const Finished run = understudy({"run", scenario, "--record", folder_.path()});
    ASSERT_EQ(run.exit_code, 1) << run.errors;
    run_ = run.output;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      if (entry.path().string().find("jsonl") != std::string::npos) recording_ = entry.path();
    }
    ASSERT_NE(recording_, "") << run.output;
    EXPECT_EQ(understudy({"replay", recording_}).exit_code, 0);
    open_page({});
  }
  void open_page(const Words& more) {
    browser_.reset();
    process_.reset();
    Words words{UNDERSTUDY_BINARY, "replay", recording_, "--page", "--control", folder_ / "control"};
    words.insert(words.end(), more.begin(), more.end());
    process_ = std::make_unique<Process>(words);
    ASSERT_TRUE(eventually([&] {
      return process_->output().find("#") != std::string::npos &&
             process_->output().find('\n', process_->output().find('#')) != std::string::npos;
    })) << process_->errors();
    const std::string output = process_->output();
    const std::size_t at = output.find("127.0.0.1:") + 10;
    const std::size_t hash = output.find('#');
    const auto port = static_cast<std::uint16_t>(std::stoi(output.substr(at)));
    browser_ = std::make_unique<TestBrowser>(port);
    ASSERT_TRUE(browser_->open_socket(port));
    browser_->say({{"token", output.substr(hash + 1, output.find('\n', hash) - hash - 1)}});
    ASSERT_EQ(browser_->hear().value("is", ""), "hello");
  }
  TestJson ask(const TestJson& message) {
    browser_->say({{"do", "ask"}, {"id", 1}, {"message", message}});
    return browser_->hear_one("answer")["reply"];
  }
  std::int64_t position_at(std::int64_t time_ns) {
    EXPECT_EQ(ask({{"do", "seek"}, {"to_ns", time_ns}})["simulated_time_ns"], time_ns);
    return ask({{"do", "get"}, {"names", {"feeder.A.position"}}})["values"]["feeder.A.position"]
        .get<std::int64_t>();
  }

  const PrivateFolder folder_;
  std::string recording_;
  std::string run_;  // what `run` has printed
  std::unique_ptr<Process> process_;
  std::unique_ptr<TestBrowser> browser_;
};

class PageOfAFailure : public PageOfARecording {
 protected:
  void SetUp() override { record(kFailing); }
};

/// A loop in which some lines begin in the tick after a keyframe. There is a keyframe each second.
constexpr const char* kLooping = R"(understudy: 1
name: never done
bench: { lines: { rs232: { stations: [ { name: robot, model: slim } ] } } }
steps:
  - program: { robot: "$L0\nWT 1\n$L1\nCLR P1\n$L2\nN1=2\nCLR P1\nJP $L0\n" }
  - send: { text: G }
  - advance: 2300ms
  - assert: time < 1s
)";

class PageOfALoop : public PageOfARecording {
 protected:
  void SetUp() override { record(kLooping); }
  std::int64_t step(bool back) {
    const TestJson reply = ask({{"do", "step"}, {"what", "line"}, {"back", back}});
    EXPECT_EQ(reply["ok"], true) << reply.dump();
    return reply["simulated_time_ns"].get<std::int64_t>();
  }
};

TEST_F(PageOfAFailure, MarksWhereItFailedAndWhy) {
  const TestJson timeline = ask({{"do", "timeline"}})["timeline"];
  ASSERT_FALSE(timeline["marks"].empty());
  const TestJson& mark = timeline["marks"].back();
  EXPECT_EQ(mark["what"], "failed");
  EXPECT_NE(mark["text"].get<std::string>().find("3201"), std::string::npos) << mark.dump();
  EXPECT_LE(mark["time_ns"], timeline["end_ns"]);
  EXPECT_FALSE(timeline.contains("marks_left_out"));
}

TEST_F(PageOfAFailure, GoesToAndFro) {
  const std::int64_t end = ask({{"do", "timeline"}})["timeline"]["end_ns"].get<std::int64_t>();
  EXPECT_EQ(position_at(end), 3200);
  const std::int64_t half = position_at(end / 2);
  EXPECT_GT(half, 0);
  EXPECT_LT(half, 3200);
  EXPECT_EQ(position_at(0), 0);
  EXPECT_EQ(position_at(end / 2), half);
  const TestJson one_back = ask({{"do", "seek"}, {"by", "tick"}, {"steps", -1}});
  EXPECT_LE(end / 2 - one_back["simulated_time_ns"].get<std::int64_t>(), 1'000'000);
  EXPECT_LT(one_back["simulated_time_ns"], end / 2);
}

TEST_F(PageOfAFailure, TellsWhatLedToEachMoment) {
  const auto reported = [&](const char* what) {
    const TestJson list = ask({{"do", what}})[what];
    std::vector<std::string> texts;
    for (const TestJson& one : list) {
      texts.push_back(one.contains("what") ? one.value("what", "") + " " + one.value("name", "")
                                           : one.value("text", ""));
    }
    return texts;
  };
  const std::int64_t end = ask({{"do", "timeline"}})["timeline"]["end_ns"].get<std::int64_t>();
  ASSERT_GT(end, 2'500'000'000);  // farther from its requests than keyframes are apart
  position_at(end);
  const std::vector<std::string> frames = reported("frames");
  ASSERT_GE(frames.size(), 6U);
  EXPECT_EQ(frames.front(), "write 0x1014 feeder.Aaxis_SVON = 1");
  const std::vector<std::string> events = reported("events");
  ASSERT_GE(events.size(), 6U);
  EXPECT_EQ(events.front(), "write feeder.Aaxis_SVON");
  position_at(0);
  EXPECT_EQ(reported("frames"), std::vector<std::string>{});
  EXPECT_EQ(reported("events"), std::vector<std::string>{});
  position_at(end);
  EXPECT_EQ(reported("frames"), frames);
  EXPECT_EQ(reported("events"), events);
}

/// The page shows what happened; if someone could change that, everyone would see something else.
TEST_F(PageOfAFailure, RefusesWhateverActs) {
  const std::int64_t end = ask({{"do", "timeline"}})["timeline"]["end_ns"].get<std::int64_t>();
  position_at(end / 2);
  const auto seen = [&] {
    return ask({{"do", "get"},
                {"names",
                 {"feeder.A.position", "feeder.A.speed", "feeder.A.target", "feeder.power", "feeder.STATUS",
                  "feeder.Aaxis_Speed", "feeder.DIN_2", "time"}}})["values"];
  };
  const TestJson before = seen();
  const std::vector<TestJson> acting = {
      {{"do", "power"}, {"device", "feeder"}, {"to", "off"}},
      {{"do", "set"}, {"values", {{"feeder.Aaxis_Speed", 7}}}},
      {{"do", "input"}, {"values", {{"feeder.DIN_2", 1}}}},
      {{"do", "turn"}, {"values", {{"feeder.A", 5}}}},
      {{"do", "command"}, {"device", "feeder"}, {"text", "x"}},
      {{"do", "program"}, {"device", "feeder"}, {"text", "NOP"}},
      {{"do", "inject"}, {"fault", {{"slip", "feeder.A"}, {"pulses", 50}}}},
      {{"do", "inject"}, {"fault", {{"drop", "feeder"}}}},
      {{"do", "clear"}},
      {{"do", "send"}, {"line", "rs485"}, {"bytes", "01 03 00 00 00 01"}, {"checksum", true}},
      {{"do", "snapshot"}, {"name", "here"}},
      {{"do", "restore"}, {"name", "here"}},
      {{"do", "snapshots"}, {"drop", "here"}},
      {{"do", "advance"}, {"by", "5ms"}},
      {{"do", "run-until"}, {"condition", "time > 0"}},
      {{"do", "pause"}},
      {{"do", "resume"}},
      {{"do", "speed"}, {"to", "real"}}};
  for (const TestJson& message : acting) {
    const TestJson reply = ask(message);
    EXPECT_EQ(reply["ok"], false) << message.dump();
    EXPECT_NE(reply.value("error", "").find("recording"), std::string::npos) << reply.dump();
    // The control socket gives the same.
    const std::string word = message["do"];
    if (word == "power") {
      EXPECT_EQ(understudy({"ctl", "--control", folder_ / "control", "power", "off"}).exit_code, 2);
    }
  }
  EXPECT_EQ(seen(), before);
  for (const char* const word :
       {"status", "identify", "bench", "faults", "list", "frames", "events", "scope", "snapshots"})
    EXPECT_EQ(ask({{"do", word}})["ok"], true) << word;
  EXPECT_EQ(ask({{"do", "program"}, {"device", "feeder"}})["ok"], true);
}

TEST_F(PageOfAFailure, OpensAtTheTimeOfUntilOrAtItsEnd) {
  const std::int64_t half_way = position_at(250'000'000);
  open_page({"--until", "250ms"});
  EXPECT_EQ(ask({{"do", "timeline"}})["timeline"]["at_ns"], 250'000'000);
  EXPECT_EQ(position_at(250'000'000), half_way);
  open_page({"--until", "10h"});
  const TestJson timeline = ask({{"do", "timeline"}})["timeline"];
  EXPECT_EQ(timeline["at_ns"], timeline["end_ns"]);
}

TEST_F(PageOfAFailure, OpensAtTheFailureWithItsStory) {
  const TestJson timeline = ask({{"do", "timeline"}})["timeline"];
  const TestJson& story = timeline["story"];
  EXPECT_EQ(timeline["at_ns"], story["time_ns"]);
  EXPECT_EQ(timeline["scenario"], "ends elsewhere");
  EXPECT_NE(story.value("text", "").find("(failing.yaml:11: expect"), std::string::npos) << story.dump();
  EXPECT_EQ(story["names"], TestJson({"feeder.Cord_A"}));
  std::vector<std::string> reported;
  for (const TestJson& moment : story["moments"]) reported.push_back(moment.value("text", ""));
  ASSERT_EQ(reported.size(), 2U) << story.dump();
  EXPECT_EQ(reported[0], "host writes feeder.Aaxis_SVON = 1");
  EXPECT_NE(reported[1].find("feeder.Aaxis_Move_INC = 1"), std::string::npos);
  for (const std::string& moment : reported)
    EXPECT_NE(run_.find("  " + moment + "\n"), std::string::npos) << run_;
  EXPECT_NE(run_.find("understudy replay " + recording_ + " --page\n"), std::string::npos) << run_;
}

/// Whoever wants to try something else says so; all see that it is not what happened, and there is a way
/// back.
TEST_F(PageOfAFailure, IsAlteredOnlyWhereSomebodyAsksForIt) {
  const std::int64_t end = ask({{"do", "timeline"}})["timeline"]["end_ns"].get<std::int64_t>();
  const std::int64_t half = position_at(end / 2);
  EXPECT_EQ(ask({{"do", "what-if"}})["altered"], true);
  EXPECT_EQ(ask({{"do", "timeline"}})["timeline"]["altered_at_ns"], end / 2);
  browser_->say({{"do", "watch"}, {"bench", 0}, {"names", {"feeder.A.position"}}});
  EXPECT_EQ(browser_->hear_one("look")["altered_at_ns"], end / 2);
  EXPECT_EQ(ask({{"do", "power"}, {"device", "feeder"}, {"to", "off"}})["ok"], true);
  EXPECT_EQ(ask({{"do", "advance"}, {"by", "500ms"}})["ok"], true);
  const auto position = [&] {
    return ask({{"do", "get"}, {"names", {"feeder.A.position"}}})["values"]["feeder.A.position"];
  };
  EXPECT_LT(position(), 3200);
  const TestJson refused = ask({{"do", "seek"}, {"to_ns", 0}});
  EXPECT_EQ(refused["ok"], false);
  EXPECT_NE(refused.value("error", "").find("altered"), std::string::npos);
  const TestJson back = ask({{"do", "what-if"}, {"off", true}});
  EXPECT_EQ(back["altered"], false);
  EXPECT_EQ(back["simulated_time_ns"], end / 2);
  EXPECT_EQ(position(), half);
  EXPECT_EQ(ask({{"do", "power"}, {"device", "feeder"}, {"to", "off"}})["ok"], false);
  EXPECT_EQ(position_at(end), 3200);
}

/// A step back plays from the keyframe before, so it could miss lines that begin near a keyframe.
TEST_F(PageOfAFailure, IsMovedByCtlAsWell) {
  const auto ctl = [this](Words words) {
    words.insert(words.begin(), "ctl");
    words.insert(words.end(), {"--control", folder_ / "control"});
    return understudy(words);
  };
  const Finished timeline = ctl({"timeline"});
  EXPECT_NE(timeline.output.find(" 3201"), std::string::npos) << timeline.output << timeline.errors;
  EXPECT_EQ(ctl({"seek", "250ms"}).output, "simulated time 250ms\n");
  EXPECT_EQ(ctl({"seek", "tick", "5", "back"}).output, "simulated time 245ms\n");
  EXPECT_EQ(ctl({"seek", "tick"}).output, "simulated time 246ms\n");
  for (const Words& wrong :
       {Words{"seek"}, Words{"seek", "7"}, Words{"seek", "1s", "2s"}, Words{"seek", "tick", "0"},
        Words{"seek", "tick", "back", "5"}, Words{"what-if", "on"}, Words{"timeline", "from=x"}}) {
    const Finished refused = ctl(wrong);
    EXPECT_EQ(refused.exit_code, 2) << wrong.back();
    EXPECT_NE(refused.errors.find("; expected "), std::string::npos) << refused.errors;
  }
  EXPECT_NE(ctl({"set", "feeder.Aaxis_Speed=200"}).errors.find("a recording cannot be changed"),
            std::string::npos);
  EXPECT_EQ(ctl({"what-if"}).exit_code, 0);
  EXPECT_EQ(ctl({"set", "feeder.Aaxis_Speed=200"}).exit_code, 0);
  EXPECT_EQ(ctl({"what-if", "off"}).output, "simulated time 246ms\n");
  EXPECT_NE(ctl({"set", "feeder.Aaxis_Speed=200"}).exit_code, 0);
  // A verb that does not exist is not called forbidden.
  EXPECT_NE(emulator::serve::ask_control(folder_ / "control", R"({"do":"jump"})").find("'jump' is not a"),
            std::string::npos);
}

TEST_F(PageOfAFailure, IsReachedByNoHostUnlessAltered) {
  const auto get = [&](const char* name) {
    return ask({{"do", "get"}, {"names", {name}}})["values"][name].get<std::int64_t>();
  };
  const std::string port = ask({{"do", "identify"}})["daemon"]["lines"][0]["pty"];
  ASSERT_EQ(ask({{"do", "seek"}, {"to_ns", 1'000'000'000}})["ok"], true);
  const std::int64_t recorded = get("feeder.Aaxis_Speed");
  ASSERT_NE(recorded, 200);
  {
    Host host(port);
    ASSERT_TRUE(host.set_even_parity(B19200));
    host.write(kSetSpeed200);
    EXPECT_TRUE(is_silent(host));
    ASSERT_EQ(ask({{"do", "step"}, {"ticks", 50}})["ok"], true);
    EXPECT_TRUE(is_silent(host)) << "the recorded replies are not for this host";
    EXPECT_NE(get("feeder.Aaxis_Speed"), 200);
    EXPECT_EQ(ask({{"do", "seek"}, {"to_ns", 1'000'000'000}})["ok"], true);
    ASSERT_EQ(ask({{"do", "what-if"}})["altered"], true);
    host.write(kSetSpeed200);
    ASSERT_TRUE(eventually([&] {
      EXPECT_EQ(ask({{"do", "step"}, {"ticks", 50}})["ok"], true);
      return get("feeder.Aaxis_Speed") == 200;
    }));
    EXPECT_EQ(host.read(kSetSpeed200.size()), kSetSpeed200);
    ASSERT_EQ(ask({{"do", "what-if"}, {"off", true}})["altered"], false);
    EXPECT_EQ(get("feeder.Aaxis_Speed"), recorded);
    host.write(kSetSpeed200);
    ASSERT_EQ(ask({{"do", "step"}, {"ticks", 50}})["ok"], true);
    EXPECT_NE(get("feeder.Aaxis_Speed"), 200);
  }
}

TEST_F(PageOfALoop, StepsBackThroughTheSameLines) {
  EXPECT_EQ(ask({{"do", "seek"}, {"to_ns", 990'000'000}})["ok"], true);
  std::vector<std::int64_t> forth;
  while (forth.empty() || forth.back() < 1'010'000'000) forth.push_back(step(false));
  ASSERT_GT(forth.size(), 5U);
  EXPECT_TRUE(std::ranges::any_of(forth, [](std::int64_t ns) { return ns == 1'001'000'000; }));
  for (std::size_t i = forth.size() - 1; i-- > 0;) EXPECT_EQ(step(true), forth[i]);
}

TEST_F(PageOfAFailure, HasCurvesAndSpans) {
  const std::int64_t end = ask({{"do", "timeline"}})["timeline"]["end_ns"].get<std::int64_t>();
  const TestJson curves =
      ask({{"do", "curves"}, {"names", {"feeder.A.position", "feeder.A.speed"}}, {"dots", 50}});
  ASSERT_EQ(curves["ok"], true) << curves.dump();
  EXPECT_EQ(curves["step_ns"], 1'000'000);
  const TestJson& position = curves["curves"][0];
  ASSERT_EQ(position["least"].size(), 50U);
  EXPECT_EQ(position["least"][0], 0);
  EXPECT_EQ(position["greatest"][49], 3200);
  for (std::size_t i = 0; i + 1 < 50; ++i) EXPECT_LE(position["greatest"][i], position["least"][i + 1]) << i;

  const TestJson spans = ask({{"do", "spans"}, {"dots", 4000}});
  ASSERT_EQ(spans["ok"], true) << spans.dump();
  EXPECT_FALSE(spans.contains("next"));
  std::map<std::string, int> kinds;
  for (const TestJson& span : spans["spans"]) {
    ++kinds[span["kind"]];
    EXPECT_LE(span["begin_ns"], span["end_ns"]);
    EXPECT_LE(span["end_ns"], end + 20'000'000);
    if (span["kind"] != "frame") continue;
    EXPECT_GT(span["latency_ns"], 0) << span.dump();
  }
  EXPECT_EQ(kinds["failed"], 1);
  EXPECT_EQ(kinds["frame"], 3);  // the two writes, and the read that is not as expected
  EXPECT_GE(kinds["event"], 1);
  // Seen from far away the writes are one.
  const TestJson few = ask({{"do", "spans"}, {"dots", 2}});
  EXPECT_LT(few["of"], spans["of"]);

  for (const TestJson& message :
       {TestJson{{"do", "curves"}, {"names", {"feeder.nonsense"}}},
        TestJson{{"do", "curves"}, {"names", TestJson::array()}},
        TestJson{{"do", "curves"}, {"names", {"time"}}, {"dots", 0}},
        TestJson{{"do", "curves"}, {"names", {"time"}}, {"dots", 9999}},
        TestJson{{"do", "curves"}, {"names", {"time"}}, {"from_ns", 5}, {"to_ns", 5}},
        TestJson{{"do", "spans"}, {"to_ns", -1}}, TestJson{{"do", "spans"}, {"nonsense", 1}}}) {
    EXPECT_EQ(ask(message)["ok"], false) << message.dump();
  }
}

/// Returns what told.js in the file replies to a message, after one that moves.
TestJson reply_of_file(const PrivateFolder& folder, const std::string& data, std::int64_t at,
                       const TestJson& message) {
  std::filesystem::copy_file(std::string(PROJECT_FOLDER) + "/emulator/page/web/told.js", folder / "told.mjs",
                             std::filesystem::copy_options::overwrite_existing);
  folder.write("data.json", data);
  folder.write("ask.mjs", R"(import fs from 'fs';
globalThis.document = { getElementById: () => ({ textContent: fs.readFileSync(process.argv[2], 'utf8') }) };
const { Told } = await import(process.argv[3]);
const told = new Told({ hello: () => {}, look: (look) => { if (look.time_ns === Number(process.argv[4])) values = look.values; } });
let values = null;
await told.ask(0, { do: 'seek', to_ns: Number(process.argv[4]) });
const message = JSON.parse(process.argv[5]);
if (message.names) told.watch(0, { names: message.names });
const reply = await told.ask(0, message);
setTimeout(() => console.log(JSON.stringify({ ...reply, values })), 20);
)");
  const Finished run = acceptance::run({"node", folder / "ask.mjs", folder / "data.json", folder / "told.mjs",
                                        std::to_string(at), message.dump()});
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  return TestJson::parse(run.output, nullptr, false);
}

TEST_F(PageOfAFailure, IsOneFileThatAnswersAsItsServer) {
  const Finished run = understudy({"replay", recording_, "--export", folder_ / "story.html"});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  std::ifstream written(folder_ / "story.html");
  const std::string file{std::istreambuf_iterator<char>(written), {}};
  EXPECT_EQ(file.find(folder_.path()), std::string::npos);
  EXPECT_EQ(file.find("src="), std::string::npos) << "it loads nothing";
  EXPECT_NE(file.find("<strong>failed at "), std::string::npos) << "readers without scripts see the story";
  const std::string begin = "id=\"told\">";
  const std::size_t at = file.find(begin) + begin.size();
  const std::string data = file.substr(at, file.find("</script>", at) - at);
  const TestJson reported = TestJson::parse(data);
  const TestJson timeline = ask({{"do", "timeline"}})["timeline"];
  EXPECT_EQ(reported["timeline"], timeline);
  EXPECT_EQ(reported["frames"].size(), ask({{"do", "frames"}})["frames"].size());
  EXPECT_EQ(reported["events"].size(), ask({{"do", "events"}})["events"].size());
  EXPECT_EQ(reported["values"]["feeder.A.position"], 3200);

  const std::int64_t moment = 1'234'000'000;
  for (const std::int64_t from : {0, 500'000'000}) {
    const std::int64_t to = from == 0 ? 2'000'000'000 : 600'000'000;
    const std::int64_t dots = from == 0 ? 200 : 100;
    const TestJson message{{"do", "curves"},
                           {"names", {"feeder.A.position", "feeder.A.speed"}},
                           {"from_ns", from},
                           {"to_ns", to},
                           {"dots", dots}};
    const TestJson there = ask(message);
    const TestJson here = reply_of_file(folder_, data, moment, message);
    for (std::size_t name = 0; name < 2; ++name) {
      for (const char* const which : {"least", "greatest"}) {
        const TestJson& one = there["curves"][name][which];
        const TestJson& other = here["curves"][name][which];
        ASSERT_EQ(other.size(), one.size()) << here.dump();
        // The file has a value for each tick, which may lie in the next dot.
        const double one_tick = name == 0 ? 2.0 : 110.0;
        for (std::size_t i = 0; i < one.size(); ++i)
          EXPECT_NEAR(other[i].get<double>(), one[i].get<double>(), one_tick) << which << " " << i;
      }
    }
    EXPECT_NEAR(here["values"]["feeder.A.position"].get<double>(), static_cast<double>(position_at(moment)),
                2.0);
  }
  const TestJson spans{{"do", "spans"}, {"from_ns", 0}, {"to_ns", 3'000'000'000}, {"dots", 4000}};
  EXPECT_EQ(reply_of_file(folder_, data, moment, spans)["spans"].size(), ask(spans)["spans"].size());
}

TEST_F(PageOfAFailure, StepsFromEventToEvent) {
  const std::int64_t end = ask({{"do", "timeline"}})["timeline"]["end_ns"].get<std::int64_t>();
  position_at(end);
  std::set<std::int64_t> times;
  const TestJson events = ask({{"do", "events"}})["events"];
  for (const TestJson& event : events) times.insert(event["time_ns"].get<std::int64_t>());
  ASSERT_GE(times.size(), 2U);
  position_at(*times.begin() - 1);
  for (const std::int64_t time : times)
    EXPECT_EQ(ask({{"do", "seek"}, {"by", "event"}, {"steps", 1}})["simulated_time_ns"], time);
}

TEST_F(PageOfAFailure, IsAPictureWithoutABrowser) {
  const auto drawn = [&](const std::string& name, const Words& more) {
    Words words{"replay", recording_, "--picture", folder_ / name};
    words.insert(words.end(), more.begin(), more.end());
    const Finished run = understudy(words);
    EXPECT_EQ(run.exit_code, 0) << run.errors;
    std::ifstream file(folder_ / name);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const std::string timeline = drawn("timeline.svg", {});
  EXPECT_NE(timeline.find("feeder.A position"), std::string::npos);
  EXPECT_NE(timeline.find("ends elsewhere: failed at "), std::string::npos);
  EXPECT_EQ(timeline.find("feeder.B position"), std::string::npos) << "it stands";
  EXPECT_NE(drawn("axes.svg", {"--panel", "axes"}).find(">3,200 pulses<"), std::string::npos);
  EXPECT_NE(drawn("early.svg", {"--panel", "axes", "--at", "0s"}).find(">0 pulses<"), std::string::npos);
  EXPECT_NE(drawn("path.svg", {"--panel", "path"}).find("feeder.A.position to the right"), std::string::npos);
  EXPECT_NE(drawn("bus.svg", {"--panel", "bus"}).find("write 0x1014 feeder.Aaxis_SVON = 1"),
            std::string::npos);
  const std::string bits = drawn("timeline.png", {});
  EXPECT_TRUE(bits.starts_with("\x89PNG")) << bits.size();
  EXPECT_EQ(drawn("again.png", {}), bits);
}

TEST_F(PageOfAFailure, RefusesWhatDoesNotFitWithOneFile) {
  const std::string file = folder_ / "story.html";
  for (const Words& words :
       {Words{"--panel", "bus"}, Words{"--picture", folder_ / "picture.gif"},
        Words{"--picture", folder_ / "picture.svg", "--panel", "nonsense"}, Words{"--at", "1s"},
        Words{"--export", file, "--page"}, Words{"--export", file, "--report", folder_ / "other.html"},
        Words{"--export", recording_}, Words{"--export", file, "--at", "soon"},
        Words{"--export", file, "--at", "9000s"}, Words{"--export", folder_ / "story.svg"}}) {
    Words all{"replay", recording_};
    all.insert(all.end(), words.begin(), words.end());
    const Finished run = understudy(all);
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_NE(run.errors.find("--"), std::string::npos) << run.errors;
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(PageOfAFailure, WritesNoFilesOfAReplayBesideIt) {
  for (const char* const flag : {"--trace", "--trace-also", "--capture", "--report"}) {
    const Finished run = understudy({"replay", recording_, "--page", flag, folder_ / "file.csv"});
    EXPECT_EQ(run.exit_code, 2) << flag;
    EXPECT_NE(run.errors.find(flag), std::string::npos) << run.errors;
  }
}

}  // namespace page_recording_test
}  // namespace understudy::acceptance
