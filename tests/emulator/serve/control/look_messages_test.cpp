// Messages of observers: the contents of a bench, its state, and what has happened.
#include "pty/rtu_crc.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace look_messages_test {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* kMachine =
    "plant:\n"
    "  feeder.A: { travel: [-20000, 20000], home: { at: 0, width: 200 }, limits: { lower: -18000, upper: "
    "18000 },\n"
    "              encoder: { per_revolution: 4000 } }\n";

struct LookRig : DaemonRig {
  LookRig() : DaemonRig({.kind = Speed::Kind::manual}, kMachine) {}

  void say(Bytes bytes, bool with_checksum = true) {
    if (with_checksum) understudy::pty::append_rtu_crc(bytes);
    world::World& world = daemon.world();
    world.host_opened(0);
    world.receive(0, bytes);
    run(100);
  }
  void run(int ms) { daemon.world().advance_to(daemon.world().now() + std::chrono::milliseconds(ms)); }
  /// Returns "write feeder.Aaxis_SVON = 1 by host".
  std::vector<std::string> events(int since = 1) {
    std::vector<std::string> texts;
    const Json reply = ask(Json{{"do", "events"}, {"since", since}}.dump());
    for (const Json& event : reply["events"]) {
      std::string text = event["what"];
      for (const char* key : {"name", "device", "line"}) {
        if (event.contains(key)) text += " " + event[key].get<std::string>();
        if (event.contains(key)) break;
      }
      if (event.contains("value")) text += " = " + event["value"].dump();
      if (event.contains("text")) text += ": " + event["text"].get<std::string>();
      if (event.contains("by")) text += " by " + event["by"].get<std::string>();
      texts.push_back(text);
    }
    return texts;
  }
};

using Texts = std::vector<std::string>;

/// A device whose names exist only while it has power.
struct OneSlim {
  OneSlim()
      : bench(world::parse_bench(
            models::all_models(),
            "understudy: 1\nlines: { a: { link: ./a.port, stations: [ { name: d, model: slim } ] } }\n",
            "bench.yaml", folder.path)),
        daemon(bench, options(), [](const std::string&) {}) {}
  static DaemonOptions options() {
    DaemonOptions made;
    made.speed = {.kind = Speed::Kind::manual};
    return made;
  }
  Json ask(const std::string& message) {
    std::string reply;
    handle_message(daemon, message, [&](const std::string& line) { reply = line; });
    return Json::parse(reply);
  }
  TestFolder folder;
  world::Bench bench;
  Daemon daemon;
};

TEST(BenchMessage, TellsLinesDevicesWiresAndMachines) {
  LookRig rig;
  const Json bench = rig.ask(R"({"do":"bench"})")["bench"];
  ASSERT_EQ(bench["lines"].size(), 1U);
  EXPECT_EQ(bench["lines"][0]["name"], "rs485");
  EXPECT_EQ(bench["lines"][0]["protocol"], "Modbus");
  EXPECT_EQ(bench["lines"][0]["stations"][1]["device"], "turner");
  EXPECT_EQ(bench["lines"][0]["stations"][1]["address"], 2);
  EXPECT_EQ(bench["devices"][1]["firmware"], "1.40");
  EXPECT_EQ(bench["devices"][0]["axes"], (Json{"A", "B"}));
  EXPECT_EQ(bench["wires"], (Json::array({{{"from", "feeder.DOUT_4"}, {"to", "turner.DIN_10"}}})));
  const Json device = rig.ask(R"({"do":"bench","device":"feeder"})")["device"];
  const Json machine = device["axes"][0]["machine"];
  EXPECT_EQ(machine["travel"], (Json{-20000, 20000}));
  EXPECT_EQ(machine["upper_limit"]["at"], 18000);
  EXPECT_EQ(machine["home"]["on"][0], 0);
  EXPECT_EQ(machine["encoder"]["counts_per_revolution"], 4000);
  // A terminal says what the machine uses it for.
  int homes = 0;
  for (const Json& terminal : device["terminals"]) {
    for (const Json& function : terminal.value("functions", Json::array()))
      homes += function == "A.home" ? 1 : 0;
  }
  EXPECT_EQ(homes, 1);
  EXPECT_FALSE(device["sections"].empty());
  EXPECT_EQ(rig.ask(R"({"do":"bench","device":"none"})")["ok"], false);
  EXPECT_EQ(rig.daemon.world().now(), SimTime{0});
}

TEST(RegistersMessage, FindsByNamesAndNumbersAsWritten) {
  LookRig rig;
  struct Case {
    const char* find;
    const char* name;
  };
  for (const Case& c : {Case{"cord_a", "Cord_A"}, Case{"Cord_A_H", "Cord_A"}, Case{"0x0E04", "Cord_A"},
                        Case{"0E05", "Cord_A"}, Case{"3589", "Cord_A"}, Case{"1002", "Aaxis_Speed"},
                        Case{"f000", "Aaxis_Home_Speed"}}) {
    const Json found =
        rig.ask(Json{{"do", "registers"}, {"device", "feeder"}, {"find", c.find}}.dump())["registers"];
    ASSERT_EQ(found.size(), 1U) << c.find << found;
    EXPECT_EQ(found[0]["name"], c.name) << c.find;
  }
  EXPECT_EQ(rig.ask(R"({"do":"registers","device":"feeder","find":"0x5555"})")["of"], 0);
}

TEST(RegistersMessage, NamesTheBitsOfStatus) {
  LookRig rig;
  const Json row = rig.ask(R"({"do":"registers","device":"feeder","find":"0x0000"})")["registers"][0];
  ASSERT_EQ(row["bits"].size(), 16U) << row;
  EXPECT_EQ(row["bits"][4]["name"], "A_moving");
  EXPECT_EQ(rig.value("feeder.STATUS.A_servo"), 0);
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_SVON":1}})");
  rig.run(2);
  EXPECT_EQ(rig.value("feeder.STATUS.A_servo"), 1);
  EXPECT_EQ(rig.value("feeder.STATUS"), 1 << 10);
}

TEST(RegistersMessage, PagesThroughAllOfThem) {
  LookRig rig;
  std::vector<std::string> names;
  Json reply;
  for (int from = 0;; from = reply["next"]) {
    reply = rig.ask(Json{{"do", "registers"}, {"device", "feeder"}, {"from", from}}.dump());
    ASSERT_EQ(reply["ok"], true) << reply;
    EXPECT_LE(reply["registers"].size(), 200U);
    for (const Json& row : reply["registers"]) names.push_back(row["name"]);
    if (!reply.contains("next")) break;
  }
  EXPECT_EQ(names.size(), reply["of"].get<std::size_t>());
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_GT(names.size(), 1'000U);  // 256 lines of programs alone have 1,024 cells
  const Json found = rig.ask(R"({"do":"registers","device":"feeder","find":"AAXIS_speed"})")["registers"];
  const auto is_it = [](const Json& row) { return row["name"] == "Aaxis_Speed"; };
  const auto row = std::find_if(found.begin(), found.end(), is_it);
  ASSERT_NE(row, found.end()) << found;
  EXPECT_EQ((*row)["access"], "R/W");
  EXPECT_TRUE(row->contains("max"));
  EXPECT_EQ(rig.ask(Json{{"do", "registers"}, {"device", "feeder"}, {"find", (*row)["address"]}}
                        .dump())["registers"][0],
            *row);
  // A page of values has the same registers.
  const Json values = rig.ask(R"({"do":"get","device":"feeder","find":"aaxis_speed"})")["values"];
  EXPECT_EQ(values.size(), found.size());
  EXPECT_EQ(values["feeder.Aaxis_Speed"], rig.value("feeder.Aaxis_Speed"));
  EXPECT_EQ(rig.ask(R"({"do":"registers","device":"feeder","count":201})")["ok"], false);
  EXPECT_EQ(rig.ask(R"({"do":"registers","device":"feeder","from":-1})")["ok"], false);
  EXPECT_EQ(rig.ask(R"({"do":"registers","device":"feeder","from":99999999})")["registers"].size(), 0U);
}

TEST(RegistersMessage, CountsSectionsAsTheBenchDoes) {
  LookRig rig;
  std::size_t all = 0;
  const Json bench = rig.ask(R"({"do":"bench","device":"feeder"})");
  for (const Json& section : bench["device"]["sections"]) {
    const Json page = rig.ask(
        Json{{"do", "registers"}, {"device", "feeder"}, {"section", section["number"]}, {"count", 1}}.dump());
    EXPECT_GT(page["of"], 0) << section;
    EXPECT_EQ(page["registers"][0]["section"], section["number"]);
    all += page["of"].get<std::size_t>();
  }
  EXPECT_EQ(all, rig.ask(R"({"do":"registers","device":"feeder","count":1})")["of"].get<std::size_t>());
}

TEST(ScopeMessage, BeginsAnewWhereTheWorldIsRestored) {
  LookRig rig;
  rig.run(20);
  ASSERT_EQ(rig.ask(R"({"do":"snapshot","name":"early"})")["ok"], true);
  rig.run(500);
  rig.ask(R"({"do":"scope","names":["time"],"condition":"feeder.DIN_5","before":"100ms","after":"50ms"})");
  rig.run(70);
  ASSERT_EQ(rig.ask(R"({"do":"restore","name":"early"})")["ok"], true);
  rig.run(30);
  rig.ask(R"({"do":"input","values":{"feeder.DIN_5":1}})");
  rig.run(60);
  const Json reply = rig.ask(R"({"do":"scope","from":0})");
  ASSERT_EQ(reply["scope"]["state"], "done") << reply;
  ASSERT_EQ(reply["scope"]["count"], 30 + 51);
  std::int64_t expected = 21'000'000;
  EXPECT_EQ(reply["scope"]["from_ns"], expected);
  for (const Json& time : reply["samples"][0]) {
    EXPECT_EQ(time, expected);
    expected += 1'000'000;
  }
}

TEST(ChoicesMessage, TellsWhichOptionIsInForce) {
  LookRig rig;
  const Json reply = rig.ask(R"({"do":"choices","device":"feeder"})");
  ASSERT_FALSE(reply["choices"].empty());
  for (const Json& choice : reply["choices"]) EXPECT_EQ(choice["chosen"], choice["options"][0]) << choice;
}

TEST(FaultsMessage, TellsEveryKindWithItsFields) {
  LookRig rig;
  const Json reply = rig.ask(R"({"do":"faults"})");
  std::set<std::string> names;
  for (const Json& kind : reply["kinds"]) {
    names.insert(kind["name"]);
    EXPECT_NE(kind["doc"], "") << kind;
    for (const Json& field : kind["fields"]) EXPECT_NE(field["doc"], "") << field;
  }
  for (const char* name : {"stall", "lost_steps", "slip", "stuck", "drop", "exception"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_EQ(reply["trigger"][0]["name"], "function");
}

TEST(FaultsMessage, TellsWordsThatInjectTakes) {
  LookRig rig;
  const std::map<std::string, Json> places{
      {"input", "feeder.DIN_2"}, {"device", "feeder"}, {"device_or_line", "feeder"}};
  const std::map<std::string, Json> some{{"number", 1}, {"duration", "5ms"}, {"bytes", "FF"}};
  int words = 0;
  const Json kinds = rig.ask(R"({"do":"faults"})")["kinds"];
  for (const Json& kind : kinds) {
    for (const Json& tried : kind["fields"]) {
      if (!tried.contains("words")) continue;
      for (const Json& word : tried["words"]) {
        nlohmann::ordered_json fault;  // the kind comes first
        fault[kind["name"].get<std::string>()] = places.at(kind["place"]);
        for (const Json& field : kind["fields"]) {
          const std::string name = field["name"];
          if (name == tried["name"]) {
            fault[name] = word;
          } else if (!field.contains("words")) {
            fault[name] = some.at(field["form"]);
          }
        }
        const Json reply = rig.ask(R"({"do":"inject","fault":)" + fault.dump() + "}");
        EXPECT_EQ(reply["ok"], true) << fault << reply;
        ++words;
      }
    }
  }
  EXPECT_GE(words, 2 + 3 * 7);  // on and off; the direction of all that act on messages
}

TEST(EventsMessage, TellsWhoWroteWhat) {
  LookRig rig;
  rig.ask(R"({"do":"events"})");
  rig.say({1, 6, 0x10, 0x14, 0, 1});
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_Speed":200}})");
  rig.ask(R"({"do":"set","as":"page","values":{"turner.Aaxis_Pulse":-5}})");
  rig.say({1, 16, 0x10, 0, 0, 2, 4, 0x7D, 0, 0, 0});
  rig.ask(R"({"do":"input","values":{"feeder.DIN_10":1}})");
  rig.ask(R"({"do":"power","device":"turner","to":"off"})");
  EXPECT_EQ(rig.events(),
            (Texts{"write feeder.Aaxis_SVON = 1 by host", "write feeder.Aaxis_Speed = 200 by control",
                   "write turner.Aaxis_Pulse = -5 by page", "write feeder.Aaxis_Pulse = 32000 by host",
                   "input feeder.DIN_10 = 1 by control", "power turner = 0 by control"}));
  EXPECT_EQ(rig.ask(R"({"do":"set","as":"king","values":{"feeder.Aaxis_Speed":200}})")["ok"], false);
}

TEST(EventsMessage, TellsRefusedAndDroppedFramesAndFaults) {
  LookRig rig;
  rig.say({1, 6, 0xFF, 0xFF, 0, 1});               // no such register
  rig.say({1, 3, 0, 0, 0, 1, 0xBA, 0xD0}, false);  // a bad checksum
  rig.say({1, 3, 0, 1, 0, 1});                     // reads are not events
  rig.ask(R"({"do":"inject","fault":{"stall":"feeder.A"}})");
  rig.ask(R"({"do":"clear","number":1})");
  const Texts events = rig.events();
  ASSERT_EQ(events.size(), 5U) << Json(events).dump(1);
  EXPECT_TRUE(events[0].starts_with("exception rs485: write 0xFFFF")) << events[0];
  EXPECT_EQ(events[1], "dropped rs485: dropped: bad CRC");
  EXPECT_EQ(events[2], "inject feeder: stall feeder.A by control");
  EXPECT_EQ(events[3], "fault feeder = 1: fault 1 stall feeder.A: begins");
  EXPECT_EQ(events[4], "clear = 1: fault 1 stall feeder.A by control");
}

TEST(EventsMessage, KeepsABoundedNumberInTheirOrder) {
  LookRig rig;
  for (int i = 0; i < 5'000; ++i)
    rig.ask(Json{{"do", "set"}, {"values", {{"feeder.Aaxis_Speed", 1 + i % 100}}}}.dump());
  const Json reply = rig.ask(R"({"do":"events","since":1})");
  EXPECT_EQ(reply["events"].size(), 200U);
  EXPECT_EQ(reply["events"][0]["number"], 1);  // before that, only those that wait for a number are bounded
  int number = 1;
  Json next = reply;
  while (!next["events"].empty()) {
    for (const Json& event : next["events"]) EXPECT_EQ(event["number"], number++);
    next = rig.ask(Json{{"do", "events"}, {"since", next["next"]}}.dump());
  }
  EXPECT_EQ(number - 1, 4'096);
}

TEST(LookMessage, TellsValuesFramesEventsAndTime) {
  LookRig rig;
  rig.say({1, 6, 0x10, 0x14, 0, 1});
  rig.ask(R"({"do":"input","values":{"feeder.DIN_10":1}})");
  rig.ask(R"({"do":"inject","fault":{"stuck":"feeder.DIN_9","level":"on"}})");
  rig.run(2);
  const Json look = rig.ask(
      R"({"do":"look","names":["feeder.Aaxis_SVON","nothing","feeder.DIN_10@by","feeder.DIN_9@by",)"
      R"("feeder.DIN_8@by","feeder.DOUT_4@by","feeder.A.position"],"frames":0,"events":0,"status":true})");
  ASSERT_EQ(look["ok"], true) << look;
  EXPECT_EQ(look["values"], (Json{1, nullptr, "held", "fault", "", "device", 0}));
  EXPECT_EQ(look["frames"].size(), 2U);
  EXPECT_EQ(look["frames"][0]["bytes"], "0106101400010cce");
  EXPECT_GT(look["frames"][1]["latency_ns"], 0);
  EXPECT_EQ(look["next_frame"], 3);
  EXPECT_EQ(look["events"].size(), 4U);
  EXPECT_EQ(look["status"]["lines"][0]["name"], "rs485");
  EXPECT_EQ(look["paused"], false);
  EXPECT_EQ(look["speed"], "manual");
  rig.ask(R"({"do":"power","device":"feeder","to":"off"})");
  EXPECT_EQ(rig.ask(R"({"do":"look","names":["feeder.Aaxis_SVON","feeder.power"]})")["values"],
            (Json{nullptr, 0}));
  EXPECT_EQ(rig.ask(R"({"do":"look","names":7})")["ok"], false);
  EXPECT_EQ(rig.ask(R"({"do":"look","frames":-1})")["ok"], false);
}

TEST(LookMessage, KeepsNamesForTheirNumber) {
  LookRig rig;
  const Json first = rig.ask(R"({"do":"look","names":["feeder.Aaxis_Speed","time"]})");
  const Json number = first["look"];
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_Speed":123}})");
  const Json again = rig.ask(Json{{"do", "look"}, {"look", number}}.dump());
  EXPECT_EQ(again["values"], (Json{123, 0}));
  EXPECT_EQ(again["look"], number);
  EXPECT_EQ(rig.ask(R"({"do":"look","names":["feeder.Aaxis_Speed","time"]})")["look"], number);
  EXPECT_NE(rig.ask(R"({"do":"look","names":["time","feeder.Aaxis_Speed"]})")["look"], number);
  for (const Json& wrong : {Json(99), Json(0), Json(-1), Json("1"), Json(nullptr)}) {
    EXPECT_EQ(rig.ask(Json{{"do", "look"}, {"look", wrong}}.dump())["ok"], false) << wrong;
  }
  EXPECT_EQ(rig.ask(Json{{"do", "look"}, {"look", number}, {"names", {"time"}}}.dump())["ok"], false);
  // If there are too many, the ones that were not looked at for longest are removed.
  for (int i = 0; i < 70; ++i) {
    rig.ask(Json{{"do", "look"}, {"names", {"n" + std::to_string(i)}}}.dump());
    if (i < 60) {
      EXPECT_EQ(rig.ask(Json{{"do", "look"}, {"look", number}}.dump())["ok"], true) << i;
    }
  }
  EXPECT_EQ(rig.ask(Json{{"do", "look"}, {"look", number}}.dump())["ok"], true);
  EXPECT_EQ(rig.daemon.observers().names.lists(), world::LookedNames::kMaxLists);
  for (int i = 0; i < 70; ++i) rig.ask(Json{{"do", "look"}, {"names", {"m" + std::to_string(i)}}}.dump());
  EXPECT_EQ(rig.ask(Json{{"do", "look"}, {"look", number}}.dump())["ok"], false);
}

TEST(LookMessage, KeepsABoundedNumberOfNames) {
  LookRig rig;
  Json numbers = Json::array();
  for (int i = 0; i < 60; ++i) {
    Json names = Json::array();
    for (int n = 0; n < 600; ++n) names.push_back(n == 0 ? "first" + std::to_string(i) : "feeder.Cord_A");
    const Json reply = rig.ask(Json{{"do", "look"}, {"names", names}}.dump());
    ASSERT_EQ(reply["values"].size(), 600U);
    EXPECT_EQ(reply["values"][599], 0);
    numbers.push_back(reply["look"]);
  }
  EXPECT_EQ(rig.daemon.observers().names.lists(), world::LookedNames::kMaxKept / 600);
  EXPECT_EQ(rig.ask(Json{{"do", "look"}, {"look", numbers.back()}}.dump())["ok"], true);
  EXPECT_EQ(rig.ask(Json{{"do", "look"}, {"look", numbers.front()}}.dump())["ok"], false);
}

TEST(LookMessage, FindsNamesThatComeLater) {
  // Many that never exist, and one that exists when the power is on.
  OneSlim slim;
  Json names = Json::array();
  for (int i = 0; i < 100; ++i) names.push_back("none" + std::to_string(i));
  names.push_back("d.VM");
  slim.ask(R"({"do":"power","to":"off"})");
  const Json off = slim.ask(Json{{"do", "look"}, {"names", names}}.dump());
  EXPECT_TRUE(off["values"][100].is_null());
  slim.ask(R"({"do":"power","to":"on"})");
  const Json on = slim.ask(Json{{"do", "look"}, {"look", off["look"]}}.dump());
  EXPECT_EQ(on["values"][100], slim.ask(R"({"do":"get","names":["d.VM"]})")["values"]["d.VM"]);
  EXPECT_FALSE(on["values"][100].is_null());
  slim.ask(R"({"do":"power","to":"off"})");
  EXPECT_TRUE(slim.ask(Json{{"do", "look"}, {"look", off["look"]}}.dump())["values"][100].is_null());
}

TEST(StepMessage, EndsAtTheEndOfTicks) {
  LookRig rig;
  rig.daemon.world().advance_to(std::chrono::microseconds(500));
  EXPECT_EQ(rig.ask(R"({"do":"step","ticks":0})")["ok"], false);
  EXPECT_EQ(rig.reply_to(R"({"do":"step","ticks":3})"), "");  // when it exists
  EXPECT_EQ(rig.ask(R"({"do":"step"})")["ok"], false);
}

TEST(SpeedMessage, ChangesThePaceWhileItRuns) {
  LookRig rig;
  for (const char* speed : {"real", "0.5x", "free", "10x", "manual"}) {
    EXPECT_EQ(rig.ask(Json{{"do", "speed"}, {"to", speed}}.dump())["speed"], speed);
    EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["speed"], speed);
  }
  for (const char* wrong : {"", "0", "-1", "fast", "10001"}) {
    EXPECT_EQ(rig.ask(Json{{"do", "speed"}, {"to", wrong}}.dump())["ok"], false) << wrong;
  }
}

TEST(ScopeMessage, KeepsEveryTickAroundTheMoment) {
  LookRig rig;
  rig.ask(
      R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.Aaxis_Pulse":3200,"feeder.Aaxis_Speed":200}})");
  rig.run(50);
  Json reply =
      rig.ask(R"({"do":"scope","names":["feeder.A.pulses","time"],"condition":"feeder.A.pulses >= 100",)"
              R"("before":"10ms","after":"20ms"})");
  EXPECT_EQ(reply["scope"]["state"], "armed");
  rig.run(500);
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_Move_INC":1}})");
  rig.run(1'000);
  reply = rig.ask(R"({"do":"scope","from":0})");
  ASSERT_EQ(reply["scope"]["state"], "done") << reply;
  EXPECT_EQ(reply["scope"]["count"], 31);
  const Json pulses = reply["samples"][0];
  ASSERT_EQ(pulses.size(), 31U);
  EXPECT_LT(pulses[9], 100);
  EXPECT_GE(pulses[10], 100);  // the first tick at which it is true
  const std::int64_t from = reply["scope"]["from_ns"];
  EXPECT_EQ(reply["scope"]["trigger_ns"].get<std::int64_t>() - from, 10'000'000);
  for (std::size_t i = 0; i < 31; ++i) {
    EXPECT_EQ(reply["samples"][1][i], from + static_cast<std::int64_t>(i) * 1'000'000) << i;
    EXPECT_GE(pulses[i], pulses[i > 0 ? i - 1 : 0]);
  }
  EXPECT_TRUE(rig.ask(R"({"do":"scope","off":true})")["scope"].is_null());
}

TEST(ScopeMessage, SeesRestAsWellAsMotion) {
  LookRig rig;
  rig.ask(R"({"do":"scope","names":["time","feeder.Cord_A"],"before":"0ms","after":"300ms"})");
  rig.run(5'000);
  const Json reply = rig.ask(R"({"do":"scope","from":0})");
  ASSERT_EQ(reply["scope"]["state"], "done");
  EXPECT_EQ(reply["scope"]["count"], 301);
  for (const Json& value : reply["samples"][1]) EXPECT_EQ(value, 0);
  for (const char* wrong :
       {R"({"do":"scope","names":[]})", R"({"do":"scope","names":["nothing"]})",
        R"({"do":"scope","names":["time"],"condition":"1 +"})",
        R"({"do":"scope","names":["time"],"after":"11s"})", R"({"do":"scope","names":["time"],"before":7})",
        R"({"do":"scope","names":["feeder.A.greatest_speed"]})"}) {
    EXPECT_EQ(rig.ask(wrong)["ok"], false) << wrong;
  }
}

TEST(ScopeMessage, KeepsWhatLedToAMomentBeforeALongRest) {
  LookRig rig;
  rig.run(50);
  rig.ask(
      R"({"do":"scope","names":["feeder.DIN_10"],"condition":"feeder.DIN_10","before":"10ms","after":"20ms"})");
  rig.run(100);
  rig.ask(R"({"do":"input","values":{"feeder.DIN_10":1}})");
  rig.run(5'000);
  const Json reply = rig.ask(R"({"do":"scope","from":0})");
  ASSERT_EQ(reply["scope"]["state"], "done") << reply;
  ASSERT_EQ(reply["scope"]["count"], 31);
  const std::int64_t from = reply["scope"]["from_ns"];
  EXPECT_EQ(reply["scope"]["trigger_ns"].get<std::int64_t>() - from, 10'000'000);
  for (std::size_t i = 0; i < 31; ++i) EXPECT_EQ(reply["samples"][0][i], i < 10 ? 0 : 1) << i;
}

TEST(ScopeMessage, LeavesTheWorldAsItIs) {
  LookRig watched;
  LookRig alone;
  watched.ask(R"({"do":"scope","names":["feeder.A.speed"],"condition":"feeder.A.speed > 1000"})");
  for (LookRig* rig : {&watched, &alone}) {
    rig->ask(
        R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.Aaxis_Pulse":3200,"feeder.Aaxis_Speed":200,"feeder.Aaxis_Move_INC":1}})");
    rig->run(2'000);
  }
  EXPECT_TRUE(watched.daemon.world().device(0).same_state(alone.daemon.world().device(0)));
}

TEST(SendMessage, IsARequestOfNobodyOnALineAtRest) {
  LookRig rig;
  const Json reply = rig.ask(R"({"do":"send","line":"rs485","bytes":"01 06 1014 0001","checksum":true})");
  ASSERT_EQ(reply["ok"], true) << reply;
  rig.run(100);
  EXPECT_EQ(rig.value("feeder.Aaxis_SVON"), 1);
  const Json frames = rig.ask(Json{{"do", "frames"}, {"since", reply["next_frame"]}}.dump())["frames"];
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0]["text"], "write 0x1014 feeder.Aaxis_SVON = 1");
  for (const char* wrong :
       {R"({"do":"send","bytes":""})", R"({"do":"send","bytes":"0"})", R"({"do":"send","bytes":"0 1"})",
        R"({"do":"send","bytes":"xx"})", R"({"do":"send","line":"none","bytes":"01"})", R"({"do":"send"})",
        R"({"do":"send","text":"","line":"rs485"})"}) {
    EXPECT_EQ(rig.ask(wrong)["ok"], false) << wrong;
  }
  rig.ask(R"({"do":"send","bytes":"01 06 1014 0000","checksum":true})");
  EXPECT_EQ(rig.ask(R"({"do":"send","bytes":"01 06 1014 0000","checksum":true})")["ok"], false)
      << "the line is busy";
}

TEST(SnapshotsByName, AreKeptAndRestoredAndForgotten) {
  LookRig rig;
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_Speed":111}})");
  EXPECT_EQ(rig.ask(R"({"do":"snapshot","name":"one"})")["ok"], true);
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_Speed":222}})");
  EXPECT_EQ(rig.ask(R"({"do":"restore","name":"one"})")["ok"], true);
  EXPECT_EQ(rig.value("feeder.Aaxis_Speed"), 111);
  EXPECT_EQ(rig.ask(R"({"do":"restore","name":"two"})")["ok"], false);
  EXPECT_EQ(rig.ask(R"({"do":"snapshot","name":""})")["ok"], false);
  EXPECT_EQ(rig.ask(R"({"do":"snapshots"})")["snapshots"].size(), 1U);
  for (int i = 0; i < 15; ++i) rig.ask(Json{{"do", "snapshot"}, {"name", std::to_string(i)}}.dump());
  EXPECT_EQ(rig.ask(R"({"do":"snapshot","name":"too many"})")["ok"], false);
  EXPECT_EQ(rig.ask(R"({"do":"snapshot","name":"one"})")["ok"], true);
  EXPECT_EQ(rig.ask(R"({"do":"snapshots","drop":"one"})")["snapshots"].size(), 15U);
  EXPECT_EQ(rig.ask(R"({"do":"snapshots","drop":"one"})")["ok"], false);
}

TEST(WhereMessage, TellsTheLineAndWhatItWaitsFor) {
  LookRig rig;
  EXPECT_EQ(rig.ask(R"({"do":"where","device":"feeder"})")["programs"][0]["state"], "stopped");
  ASSERT_EQ(
      rig.ask(R"({"do":"program","device":"feeder","text":"        Delay_mSec 500\n        END\n"})")["ok"],
      true);
  rig.ask(R"({"do":"set","values":{"feeder.PROG_MAIN_RunTime_START":0}})");
  rig.run(100);
  const Json place = rig.ask(R"({"do":"where","device":"feeder"})")["programs"][0];
  EXPECT_EQ(place["state"], "waiting") << place;
  EXPECT_EQ(place["line"], 1);
  EXPECT_EQ(place["text"], "Delay_mSec 500");
  EXPECT_GT(place["until_ns"], 500'000'000);
  rig.run(1'000);
  const Json end = rig.ask(R"({"do":"where","device":"feeder"})")["programs"][0];
  EXPECT_EQ(end["state"], "stopped");
  EXPECT_EQ(end["why"], "END");
}

}  // namespace look_messages_test
}  // namespace understudy::emulator::serve
