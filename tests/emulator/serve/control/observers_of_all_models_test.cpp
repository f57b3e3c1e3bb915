// Information that observers get about every model alike: where a move will end, how programs are started and
// stopped, what the memory contains.
#include "emulator/device/program_language.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace observers_of_all_models_test {

/// One device, called d, with a stopped clock.
struct OneDevice {
  explicit OneDevice(const std::string& model, const std::string& settings = "")
      : bench(world::parse_bench(
            models::all_models(),
            "understudy: 1\nlines: { a: { link: ./a.port, stations: [ { name: d, model: " + model + settings +
                " } ] } }\n",
            "bench.yaml", folder.path)),
        daemon(bench, options(), [](const std::string&) {}) {}
  static DaemonOptions options() {
    DaemonOptions made;
    made.speed = {.kind = Speed::Kind::manual};
    return made;
  }
  Json ask(const Json& message) {
    Json reply;
    handle_message(daemon, message.dump(), [&](const std::string& line) { reply = Json::parse(line); });
    EXPECT_EQ(reply["ok"], true) << message << " " << reply;
    return reply;
  }
  void run(int ms) { daemon.world().advance_to(daemon.world().now() + std::chrono::milliseconds(ms)); }
  /// "set NAME=VALUE", "input NAME=LEVEL", "command TEXT", "text TEXT", "program TEXT".
  void act(const std::string& what) {
    const std::string word = what.substr(0, what.find(' '));
    const std::string rest = what.substr(word.size() + 1);
    if (word == "command") ask({{"do", "command"}, {"text", rest}});
    if (word == "program") ask({{"do", "program"}, {"text", rest}});
    if (word == "text") ask({{"do", "send"}, {"line", "a"}, {"text", rest}});
    if (word == "set" || word == "input") {
      const std::size_t sign = rest.find('=');
      ask({{"do", word}, {"values", {{rest.substr(0, sign), std::stoll(rest.substr(sign + 1))}}}});
    }
    run(100);
  }
  Json value(const std::string& name) { return ask({{"do", "get"}, {"names", {name}}})["values"][name]; }

  const TestFolder folder;
  const world::Bench bench;
  Daemon daemon;
};

// --- where a move will end
// -----------------------------------------------------------------------------------

struct MoveCase {
  const char* name;
  const char* model;
  std::vector<std::string> acts;
  std::vector<std::string> axes;  // that move
  std::vector<std::int64_t> ends;
};

const std::vector<MoveCase>& moves() {
  static const std::vector<MoveCase> all{
      {"a move",
       "simple2-r3",
       {"set Aaxis_SVON=1", "set Aaxis_Pulse=3200", "set Aaxis_Speed=60", "set Aaxis_Move_INC=1"},
       {"A"},
       {3200}},
      {"a move back, of an axis that is turned round",
       "simple2-r3",
       {"set Aaxis_DIR_Polarity=1", "set Aaxis_SVON=1", "set Aaxis_Pulse=3200", "set Aaxis_Speed=60",
        "set Aaxis_Move_INC=1"},
       {"A"},
       {-3200}},
      {"a move", "rs-m8194h", {"command RSM_SET_V X 5000", "command RSM_FIXED_MOVE X -5000"}, {"X"}, {-5000}},
      {"a line",
       "rs-m8194h",
       {"command RSM_AXIS_ASSIGN X Y 0", "command RSM_SET_VV 5000", "command RSM_LINE_2D 6000 -2000"},
       {"X", "Y"},
       {6000, -2000}},
      {"a line",
       "super-40nc",
       {"program AREA C\nF K20000\nLIN K20000 K-10000\nEND\nAREA PLC\nEND\n", "set M8000=1"},
       {"X", "Y"},
       {}},
      {"a move",
       "super-40nc",
       {"program AREA X\nINCC\nRPM K100\nDRV K20000\nEND\nAREA PLC\nEND\n", "set M8100=1"},
       {"X"},
       {}},
      {"a line", "slim", {"text TX=0", "text TY=1", "text 2MA 3000,-1500"}, {"T0", "T1"}, {}},
      {"a move", "slim", {"text MA 300000"}, {"T0"}, {}},
  };
  return all;
}

/// A path of a SUPER-40NC consists of axes that its program C owns.
std::string settings_of(const MoveCase& move) {
  if (move.model == std::string_view("slim")) return ", modules: 2";
  const bool is_path = move.model == std::string_view("super-40nc") && move.axes.size() > 1;
  return is_path ? ", set: { D9003: 4, D9181: 1 }" : "";
}

TEST(AxisTarget, IsWhereTheMoveEnds) {
  for (const MoveCase& one : moves()) {
    SCOPED_TRACE(std::string(one.model) + ": " + one.name);
    OneDevice bench(one.model, settings_of(one));
    for (const std::string& axis : one.axes) EXPECT_EQ(bench.value("d." + axis + ".target"), 0);
    for (const std::string& act : one.acts) bench.act(act);
    std::map<std::string, std::int64_t> reported;
    for (const std::string& axis : one.axes) {
      const std::string name = "d." + axis;
      ASSERT_NE(bench.value(name + ".speed"), 0.0) << axis;
      reported[axis] = bench.value(name + ".target");
      EXPECT_NE(reported[axis], bench.value(name + ".pulses").get<std::int64_t>()) << axis;
    }
    bench.run(60'000);
    for (std::size_t i = 0; i < one.axes.size(); ++i) {
      const std::string name = "d." + one.axes[i];
      EXPECT_EQ(bench.value(name + ".pulses"), reported[one.axes[i]]) << name;
      EXPECT_EQ(bench.value(name + ".target"), reported[one.axes[i]]) << name;
      if (!one.ends.empty()) {
        EXPECT_EQ(reported[one.axes[i]], one.ends[i]) << name;
      }
    }
  }
}

TEST(AxisTarget, OfASpeedAndOfAStopIsWhereItIs) {
  OneDevice bench("simple2-r3");
  for (const char* act : {"set Aaxis_SVON=1", "set Aaxis_Pulse=32000", "set Aaxis_Speed=60",
                          "set Aaxis_AccTime=100", "set Aaxis_DecTime=100", "set Aaxis_Move_INC=1"}) {
    bench.act(act);
  }
  bench.run(1'000);
  EXPECT_EQ(bench.value("d.A.target"), 32'000);
  bench.ask({{"do", "set"}, {"values", {{"Aaxis_STOP", 1}}}});
  bench.run(50);
  EXPECT_EQ(bench.value("d.A.target"), bench.value("d.A.pulses"));
}

// --- a missing encoder
// ---------------------------------------------------------------------------------------

TEST(AxisEncoder, ThatIsNotThereCountsNothing) {
  for (const Model* model : models::all_models()) {
    OneDevice bench{std::string(model->name)};
    const Json axes = bench.ask({{"do", "bench"}, {"device", "d"}})["device"]["axes"];
    for (const Json& axis : axes) {
      EXPECT_EQ(bench.value("d." + axis["name"].get<std::string>() + ".encoder"), 0) << model->name;
    }
  }
}

// --- starting and stopping programs
// ----------------------------------------------------------------------------

struct ControlCase {
  const char* model;
  const char* program;  // waits for a long time
  std::size_t start;    // which of the language's controls it is
  int number;
  std::size_t stop;
};

constexpr ControlCase kControls[] = {
    {"simple2-r3", "        Wait_IO DIN_5 ON\n        END\n", 0, 0, 1},
    {"rs-m8194h", "MP 41\n  RSM_MACRO_TIMER 5000\nEND\n", 0, 41, 1},
    {"super-40nc", "AREA C\nTMR K5000\nEND\nAREA PLC\nEND\n", 0, 0, 2},
    {"super-40nc", "AREA X\nWAT X5\nEND\nAREA PLC\nEND\n", 3, 0, 4},
    {"super-40nc", "AREA U\nWAT X5\nEND\nAREA PLC\nEND\n", 9, 0, 10},
    {"slim", "WI 3\nRET\n", 0, 0, 1},
};

/// As a page does it.
void press(OneDevice& bench, const Json& control, int number) {
  const auto filled = [&](const char* key) {
    std::string text = control.at(key);
    if (const std::size_t at = text.find("{}"); at != std::string::npos)
      text.replace(at, 2, std::to_string(number));
    return text;
  };
  if (control.contains("command")) return bench.act("command " + filled("command"));
  if (control.contains("text")) return bench.act("command " + filled("text"));
  std::istringstream pairs(filled("set"));
  for (std::string pair; pairs >> pair;) bench.act("set " + pair);
}

TEST(ProgramControls, StartAndStopTheProgramsOfEveryModel) {
  for (const ControlCase& one : kControls) {
    SCOPED_TRACE(std::string(one.model) + ": " + one.program);
    OneDevice bench(one.model);
    const Json controls = bench.ask({{"do", "bench"}, {"device", "d"}})["device"]["program"]["controls"];
    const auto runs = [&] {
      return bench.ask({{"do", "status"}})["status"]["devices"][0]["runs"].get<bool>();
    };
    bench.act(std::string("program ") + one.program);
    EXPECT_FALSE(runs());
    for (int round = 0; round < 2; ++round) {  // a key that was pressed is pressed again
      press(bench, controls.at(one.start), one.number);
      EXPECT_TRUE(runs()) << round;
      press(bench, controls.at(one.stop), one.number);
      EXPECT_FALSE(runs()) << round;
    }
  }
}

TEST(LineByHand, IsObeyedWithoutAWordOnTheLine) {
  OneDevice bench("slim");
  const auto refusal_of = [&](const char* text) {
    std::string why;
    handle_message(bench.daemon, Json{{"do", "command"}, {"text", text}}.dump(),
                   [&](const std::string& line) { why = Json::parse(line).value("error", ""); });
    return why;
  };
  const auto frames = [&] { return bench.ask({{"do", "frames"}})["frames"].size(); };
  bench.act("program WI 3\nN1=GETI\nRET\n");
  const std::size_t before = frames();
  EXPECT_EQ(refusal_of("VM=321"), "");
  EXPECT_EQ(bench.value("d.VM"), 321);
  EXPECT_EQ(refusal_of("G"), "");
  EXPECT_EQ(refusal_of("G"), "d refuses it: it is busy (reason 3)") << "it is already running";
  EXPECT_EQ(refusal_of("nonsense"), "d refuses it: the command is not accepted (reason 1)");
  bench.run(20);
  EXPECT_EQ(frames(), before) << "nobody receives its replies";
  // The number of the program.
  bench.ask({{"do", "input"}, {"values", {{"d.IN3", 1}}}});
  bench.run(20);
  EXPECT_EQ(refusal_of("VM=322"), "d refuses it: it is busy");
  EXPECT_EQ(refusal_of("EXIT"), "");
  EXPECT_EQ(refusal_of("VM=322"), "");
  // Text that a host is typing into the editor belongs to the host.
  bench.act("text PA");
  bench.run(100);
  EXPECT_EQ(refusal_of("VM=323"), "d refuses it: it is busy");
  EXPECT_EQ(bench.value("d.VM"), 322);
}

TEST(ProgramControls, AreThereForEveryLanguage) {
  for (const Model* model : models::all_models()) {
    if (model->language == nullptr) continue;
    EXPECT_GE(model->language->controls().size(), 2U) << model->name;
    for (const ProgramControl& control : model->language->controls()) {
      const bool has_number = control.what.find("{}") != std::string_view::npos;
      EXPECT_EQ(has_number, control.highest > 0) << control.word;
    }
  }
}

// --- the contents of the memory
// --------------------------------------------------------------------------------

TEST(KeptWrites, AreCountedWhenTheyAreDone) {
  OneDevice bench("simple2-r3");
  const auto writes = [&] {
    return bench.ask({{"do", "status"}})["status"]["devices"][0]["kept_writes"].get<int>();
  };
  const int before = writes();
  bench.act("set Aaxis_Speed=77");  // is not persistent
  EXPECT_EQ(writes(), before);
  bench.act("set Aaxis_Home_Speed=77");
  bench.run(2'000);
  EXPECT_EQ(writes(), before + 1);
  bench.act("set PROG_MEM0=1");
  bench.act("set PROG_MEM1=2");
  bench.run(2'000);
  EXPECT_EQ(writes(), before + 3);
}

// --- what one does, and why one is refused

/// Somebody without a host can try these, so every message must be accepted and something must move.
TEST(FirstMoves, AreAcceptedAndMoveAnAxis) {
  using Ordered = nlohmann::ordered_json;  // registers are written in the order of the message
  constexpr std::pair<const char*, const char*> kDevices[] = {{"simple2-r3", ""},
                                                              {"rs-m8194h", ""},
                                                              {"super-40nc", ""},
                                                              {"slim", ", modules: 1"},
                                                              {"slim", ", modules: 2"}};
  for (const auto& [model, more] : kDevices) {
    OneDevice one(model, more);
    const auto tell = [&](const Ordered& message) {
      Ordered reply;
      handle_message(one.daemon, message.dump(),
                     [&](const std::string& line) { reply = Ordered::parse(line); });
      EXPECT_EQ(reply["ok"], true) << message << reply;
      return reply;
    };
    const Ordered device = tell({{"do", "bench"}, {"device", "d"}})["device"];
    ASSERT_TRUE(device.contains("first_move")) << model;
    for (const Ordered& message : device["first_move"]) {
      if (message.contains("program")) {
        tell({{"do", "program"}, {"device", "d"}, {"text", message["program"]}});
      } else if (message.contains("command")) {
        tell({{"do", "command"}, {"text", message["command"]}});
      } else {
        Ordered values = Ordered::object();
        for (const auto& [name, value] : message["set"].items()) values["d." + name] = value;
        tell({{"do", "set"}, {"values", values}});
      }
      one.run(100);
    }
    one.run(5000);
    double moved = 0;
    for (const Ordered& axis : device["axes"])
      moved += std::abs(one.value("d." + axis["name"].get<std::string>() + ".position").get<double>());
    EXPECT_GT(moved, 0) << model << device["first_move"];
  }
  // A program of one's own is not replaced.
  OneDevice mill("super-40nc");
  mill.ask({{"do", "program"}, {"device", "d"}, {"text", "AREA X\nEND\n"}});
  EXPECT_EQ(mill.ask({{"do", "bench"}, {"device", "d"}})["device"]["first_move"],
            Json::parse(R"([{"set":{"M8100":1}}])"));
  OneDevice blank("super-40nc");
  EXPECT_EQ(blank.ask({{"do", "bench"}, {"device", "d"}})["device"]["first_move"],
            Json::parse(R"([{"program":"AREA X\nRPM K100\nDRV K1000\nEND\n"},{"set":{"M8100":1}}])"));
}

/// Takes the last frame that the device has sent.
Json last_reply(OneDevice& one) {
  const Json frames = one.ask({{"do", "frames"}, {"raw", true}})["frames"];
  return frames.empty() ? Json() : frames.back();
}

TEST(ErrorLines, HaveTheirMeaningAndAreRefusals) {
  OneDevice one("slim");
  one.act("text NONSENSE");
  const Json reply = last_reply(one);
  EXPECT_EQ(reply.value("text", ""),
            "\"ERR 1\": this is not a valid command: check its spelling and operands");
  EXPECT_EQ(reply.value("exception", false), true);
  const Json events = one.ask({{"do", "events"}})["events"];
  EXPECT_EQ(events.back().value("what", ""), "exception") << events;
  one.act("text ?PE");
  EXPECT_EQ(last_reply(one).value("exception", false), false) << last_reply(one);
  OneDevice same("slim", ", choices: { error_codes: 1_for_all }");
  same.act("text NONSENSE");
  EXPECT_NE(last_reply(same).value("text", "").find("error_codes"), std::string::npos) << last_reply(same);
}

/// A limit switch that a device ignores needs no search through its parameters.
TEST(Terminals, NameTheRegisterThatUsesThem) {
  OneDevice mill("super-40nc");
  std::map<std::string, std::string> used;
  const Json device = mill.ask({{"do", "bench"}, {"device", "d"}})["device"];
  for (const Json& terminal : device["terminals"])
    if (terminal.contains("used_by")) used[terminal["name"]] = terminal["used_by"];
  EXPECT_EQ(used.size(), 8U);
  std::set<std::string> registers;
  for (const auto& [terminal, name] : used) registers.insert(name);
  EXPECT_EQ(registers,
            (std::set<std::string>{"D9163", "D9164", "D9263", "D9264", "D9363", "D9364", "D9463", "D9464"}));
}

TEST(BenchMessage, DescribesAllDevicesAtOnce) {
  OneDevice one("simple2-r3");
  const Json all = one.ask({{"do", "bench"}, {"device", "*"}})["devices"];
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0], one.ask({{"do", "bench"}, {"device", "d"}})["device"]);
}

/// Newcomers know what they want, and not what the manual calls it.
TEST(RegistersMessage, FindsByMeaningAndByTheManualsWords) {
  struct Case {
    const char* model;
    const char* find;
    const char* name;
  };
  for (const Case& c :
       {Case{"super-40nc", "position in work", "D8117"}, Case{"super-40nc", "原點低速", "D9180"},
        Case{"super-40nc", "座標", "M8107"}, Case{"simple2-r3", "acceleration", "Aaxis_AccTime"},
        Case{"simple2-r3", "座標", "Cord_A"}, Case{"rs-m8194h", "axes that are driving", "DRIVING_AXIS"}}) {
    OneDevice one(c.model);
    const Json found = one.ask({{"do", "registers"}, {"device", "d"}, {"find", c.find}})["registers"];
    const auto is_it = [&](const Json& row) { return row["name"] == c.name; };
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), is_it)) << c.find << found.dump();
  }
}

}  // namespace observers_of_all_models_test
}  // namespace understudy::emulator::serve
