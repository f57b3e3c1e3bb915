// Control messages: the effect of each, and that a bad one gets one line and changes nothing.
#include "emulator/serve/control/messages.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "base/version.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace messages_test {

TEST(ControlMessages, StatusTellsTimeLinesStationsAndDevices) {
  DaemonRig rig;
  const Json reply = rig.ask(R"({"do":"status"})");
  EXPECT_EQ(reply["ok"], true);
  const Json& status = reply["status"];
  EXPECT_EQ(status["simulated_time"], "0s");
  EXPECT_EQ(status["simulated_time_ns"], 0);
  EXPECT_EQ(status["speed"], "manual");
  EXPECT_EQ(status["paused"], false);
  ASSERT_EQ(status["lines"].size(), 1u);
  const Json& line = status["lines"][0];
  EXPECT_EQ(line["name"], "rs485");
  EXPECT_EQ(line["link"], rig.folder.path + "/feeder.port");
  EXPECT_TRUE(line["pty"].get<std::string>().starts_with("/dev/pts/"));
  EXPECT_EQ(line["settings"], "19200 8E1");
  EXPECT_EQ(line["timing"], "wire");
  EXPECT_EQ(line["host"], "closed");
  ASSERT_EQ(line["stations"].size(), 2u);
  EXPECT_EQ(line["stations"][1]["device"], "turner");
  EXPECT_EQ(line["stations"][1]["address"], 2);
  ASSERT_EQ(status["devices"].size(), 2u);
  EXPECT_EQ(status["devices"][0]["name"], "feeder");
  EXPECT_EQ(status["devices"][0]["model"], "simple2-r3");
  EXPECT_EQ(status["devices"][1]["firmware"], "1.40");
  EXPECT_EQ(status["devices"][0]["machines"]["A"]["position_pulses"], 0);
  EXPECT_TRUE(rig.is_untouched());
}

TEST(ControlMessages, GetReadsRegistersHalvesAndBits) {
  DaemonRig rig;
  const Json reply = rig.ask(
      R"({"do":"get","names":["feeder.HW_Code","feeder.HW_Code.15","turner.Version","feeder.Aaxis_Resoultion",)"
      R"("feeder.Aaxis_Resoultion_L","feeder.Axis_Home_Speed"]})");
  EXPECT_EQ(reply["ok"], true);
  EXPECT_EQ(reply["values"], (Json{{"feeder.HW_Code", 0xC001},
                                   {"feeder.HW_Code.15", 1},
                                   {"turner.Version", 140},
                                   {"feeder.Aaxis_Resoultion", 3200},
                                   {"feeder.Aaxis_Resoultion_L", 3200},
                                   {"feeder.Axis_Home_Speed", 0}}));
  EXPECT_TRUE(rig.is_untouched());
}

TEST(ControlMessages, SetWritesAsTheWireWouldWithItsEffects) {
  DaemonRig rig;
  EXPECT_EQ(
      rig.reply_to(
          R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.Aaxis_Pulse":-500,"feeder.Aaxis_Speed":60,)"
          R"("turner.Aaxis_Speed":7,"feeder.Aaxis_Move_INC":1}})"),
      R"({"ok":true})");
  EXPECT_EQ(rig.value("feeder.Aaxis_Pulse"), -500);
  EXPECT_EQ(rig.value("turner.Aaxis_Speed"), 7);
  EXPECT_EQ(rig.value("feeder.STATUS.4"), 1) << "values are written in the order given: the servo first";
}

TEST(ControlMessages, InputHoldsAnInputAndLetsItGo) {
  DaemonRig rig;
  EXPECT_EQ(rig.reply_to(R"({"do":"input","values":{"feeder.DIN_10":1,"turner.DIN_0":1}})"),
            R"({"ok":true})");
  EXPECT_TRUE(rig.daemon.world().device(0).input(10));
  EXPECT_TRUE(rig.daemon.world().device(1).input(0));
  EXPECT_EQ(rig.reply_to(R"({"do":"input","values":{"feeder.DIN_10":0}})"), R"({"ok":true})");
  EXPECT_FALSE(rig.daemon.world().device(0).input(10));
  EXPECT_TRUE(rig.daemon.world().device(1).input(0));
}

TEST(ControlMessages, PauseAndResumeTellTheSimulatedTime) {
  DaemonRig rig(Speed{});
  const Json paused = rig.ask(R"({"do":"pause"})");
  EXPECT_EQ(paused["ok"], true);
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["paused"], true);
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["simulated_time_ns"], paused["simulated_time_ns"]);
  EXPECT_EQ(rig.ask(R"({"do":"pause"})"), paused) << "the second time changes nothing";
  EXPECT_EQ(rig.ask(R"({"do":"resume"})"), paused);
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["paused"], false);
}

TEST(ControlMessages, TimeThatRunsByItselfCannotBeAdvanced) {
  DaemonRig rig(Speed{});
  const Json refused = rig.ask(R"({"do":"advance","by":"1ms"})");
  EXPECT_EQ(refused["ok"], false);
  rig.reply_to(R"({"do":"pause"})");
  EXPECT_EQ(rig.reply_to(R"({"do":"advance","by":"1ms"})"), "") << "in progress: its reply comes later";
  EXPECT_EQ(rig.ask(R"({"do":"advance","by":"1ms"})"), refused) << "one at a time";
}

TEST(ControlMessages, GetKnowsWhateverConditionsKnow) {
  DaemonRig rig;
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.0x1000":500,"feeder.Aaxis_Speed":60,)"
          R"("feeder.Aaxis_Move_INC":1}})");
  rig.ask(R"({"do":"input","values":{"turner.AIN_B":"2.5V"}})");
  rig.daemon.world().advance_to(std::chrono::seconds(1));
  const Json reply = rig.ask(
      R"({"do":"get","names":["time","feeder.A.position","feeder.A.pulses","feeder.power","rs485.bytes_in",)"
      R"("turner.AIN_B","feeder.0x1000","feeder.0x1001","feeder.0x1014.0","feeder.0x0e04","feeder.Cord_A"]})");
  EXPECT_EQ(reply["ok"], true) << reply;
  EXPECT_EQ(reply["values"], (Json{{"time", 1'000'000'000},
                                   {"feeder.A.position", 500},
                                   {"feeder.A.pulses", 500},
                                   {"feeder.power", 1},
                                   {"rs485.bytes_in", 0},
                                   {"turner.AIN_B", 2500},
                                   {"feeder.0x1000", 500},
                                   {"feeder.0x1001", 0},
                                   {"feeder.0x1014.0", 1},
                                   {"feeder.0x0e04", 500},
                                   {"feeder.Cord_A", 500}}));
  EXPECT_EQ(reply["units"], (Json{{"time", "ns"}, {"turner.AIN_B", "mV"}}));
  EXPECT_EQ(rig.reply_to(R"({"do":"eval","expression":"feeder.A.position / 3 + 1"})"),
            R"({"ok":true,"value":167})");
  EXPECT_EQ(rig.reply_to(R"({"do":"eval","expression":"feeder.0x1000 == feeder.Cord_A && time > 3ms"})"),
            R"({"ok":true,"value":1})");
  EXPECT_EQ(rig.reply_to(R"({"do":"eval","expression":"time * 2"})"),
            R"({"ok":true,"value":2000000000,"unit":"ns"})");
  EXPECT_EQ(rig.reply_to(R"({"do":"eval","expression":"1.5 * 3"})"), R"({"ok":true,"value":4.5})");
}

TEST(ControlMessages, WithoutPowerThereAreNoRegistersToGet) {
  DaemonRig rig;
  rig.ask(R"({"do":"power","device":"feeder","to":"off"})");
  const std::string refused = R"({"ok":false,"error":"feeder has no power; expected it to be on"})";
  EXPECT_EQ(rig.reply_to(R"({"do":"get","names":["turner.Cord_A","feeder.Cord_A"]})"), refused);
  EXPECT_EQ(rig.reply_to(R"({"do":"eval","expression":"feeder.Cord_A"})"), refused);
  EXPECT_EQ(rig.reply_to(R"({"do":"get","names":["feeder.power","feeder.A.position"]})"),
            R"({"ok":true,"values":{"feeder.power":0,"feeder.A.position":0}})");
}

TEST(ControlMessages, IdentifyTellsWhichDaemonItIs) {
  DaemonRig rig;
  const Json daemon = rig.ask(R"({"do":"identify"})")["daemon"];
  EXPECT_EQ(daemon["pid"], getpid());
  EXPECT_EQ(daemon["version"], program_version());
  EXPECT_EQ(daemon["protocol"], "1.4");
  EXPECT_EQ(daemon["bench"], "");
  ASSERT_EQ(daemon["lines"].size(), 1U);
  EXPECT_EQ(daemon["lines"][0]["name"], "rs485");
  EXPECT_EQ(daemon["lines"][0]["link"], rig.folder.path + "/feeder.port");
  EXPECT_EQ(daemon["lines"][0]["pty"], rig.daemon.ports()[0]->terminal()->path());
}

struct Bad {
  std::string message;
  std::string error;  // its beginning
};

TEST(ControlMessages, WhatIsNoMessageGetsOneLineAndChangesNothing) {
  const std::string no_json = "the message is not JSON; expected one object on one line";
  const std::string no_object = "expected an object with a word under \"do\"";
  const std::vector<Bad> cases = {
      {"", no_json},
      {"{", no_json},
      {"status", no_json},
      {"{\"do\":\"status\"} {}", no_json},
      {"{'do':'status'}", no_json},
      {"{\"do\":\"status\",}", no_json},
      {"{\"do\":\"\xFF\xFE\"}", no_json},
      {"{\"do\":\"\xED\xA0\x80\"}", no_json},
      {"\"\\ud800\"", no_json},
      {std::string("{\"do\":\"status\"\0}", 16), no_json},
      {"{\"do\":\"set\",\"values\":{\"feeder.Aaxis_Speed\":1e400}}", no_json},
      {std::string(16000, '['), "the message is nested too deeply; expected one object on one line"},
      {std::string(16000, '{'), no_json},
      {"null", no_object},
      {"42", no_object},
      {"[]", no_object},
      {"[{\"do\":\"status\"}]", no_object},
      {"\"status\"", no_object},
      {"{}", no_object},
      {"{\"DO\":\"status\"}", no_object},
      {"{\"do\":1}", no_object},
      {"{\"do\":null}", no_object},
      {"{\"do\":[\"status\"]}", no_object},
      {"{\"do\":\"\"}",
       "'' is not a command; expected one of status, identify, get, eval, set, input, turn, command, power, "
       "program, inject, clear, list, frames, snapshot, restore, advance, run-until, pause, resume"},
      {"{\"do\":\"jump\"}", "'jump' is not a command; expected "},
      {"{\"do\":\"seek\",\"to_ns\":1}",
       "seek: this daemon does not serve a recording; expected a daemon that `replay "},
      {"{\"do\":\"a\\nb\"}", "'a\\nb' is not a command; expected "},
      {"{\"do\":\"status\",\"x\":1}", "'x' is not a key of this message"},
      {"{\"do\":\"pause\",\"values\":{}}", "'values' is not a key of this message"},
      {"{\"do\":\"resume\",\"by\":\"1s\"}", "'by' is not a key of this message"},
  };
  DaemonRig rig;
  for (const Bad& bad : cases) {
    const Json reply = rig.ask(bad.message);
    EXPECT_EQ(reply["ok"], false) << bad.message.substr(0, 80);
    const std::string error = reply["error"];
    EXPECT_TRUE(error.starts_with(bad.error)) << bad.message.substr(0, 80) << ": " << error;
    EXPECT_EQ(reply.size(), 2u);
  }
  EXPECT_TRUE(rig.is_untouched());
  EXPECT_FALSE(rig.daemon.pacer().paused());
}

TEST(ControlMessages, BadValuesGetOneLineAndChangeNothing) {
  const auto set = [](const std::string& values) { return R"({"do":"set","values":)" + values + "}"; };
  const auto input = [](const std::string& values) { return R"({"do":"input","values":)" + values + "}"; };
  const auto get = [](const std::string& names) { return R"({"do":"get","names":)" + names + "}"; };
  const auto by = [](const std::string& duration) { return R"({"do":"advance","by":)" + duration + "}"; };
  const auto eval = [](const std::string& text) { return R"({"do":"eval","expression":")" + text + "\"}"; };
  const std::string no_object =
      " is not an object of names and whole numbers; expected an object that is not empty";
  const std::string no_levels = " is not an object of names and levels; expected an object that is not empty";
  const std::string speed = "feeder.Aaxis_Speed: ";
  const std::string no_number = " is not a number; expected 0 to 32768";
  const std::string not_whole = " is not a whole number; expected 0 to 32768";
  const std::string no_list = " is not a list of names; expected one";
  const std::string no_time = " is not a duration with a unit; expected one such as \"250ms\"";
  const std::vector<Bad> cases = {
      {R"({"do":"set"})", "'values' is missing"},
      {R"({"do":"set","values":{"feeder.Aaxis_Speed":1},"now":1})", "'now' is not a key of this message"},
      {set("[]"), "values: []" + no_object},
      {set("{}"), "values: {}" + no_object},
      {set("null"), "values: null" + no_object},
      {set("\"feeder.Aaxis_Speed=1\""), "values: 'feeder.Aaxis_Speed=1'" + no_object},
      {set(R"({"feeder.Aaxis_Speed":"1"})"), speed + "'1'" + no_number},
      {set(R"({"feeder.Aaxis_Speed":1.5})"), speed + "1.5" + not_whole},
      {set(R"({"feeder.Aaxis_Speed":1.0})"), speed + "1.0" + not_whole},
      {set(R"({"feeder.Aaxis_Speed":null})"), speed + "null" + no_number},
      {set(R"({"feeder.Aaxis_Speed":[1]})"), speed + "[1]" + no_number},
      {set(R"({"feeder.Aaxis_Speed":{}})"), speed + "{}" + no_number},
      {set(R"({"feeder.Aaxis_Speed":18446744073709551615})"),
       speed + "18446744073709551615 is out of range; expected 0 to 32768"},
      {set(R"({"feeder.Aaxis_Speed":99999999999999999999999})"), speed + "9.999999999999999e+22" + not_whole},
      {set(R"({"feeder.Aaxis_Speed":-99999999999999999999999})"),
       speed + "-9.999999999999999e+22" + not_whole},
      {set(R"({"feeder.Aaxis_Speed":9223372036854775807})"),
       "feeder.Aaxis_Speed: 9223372036854775807 is out of range; expected 0 to 32768"},
      {set(R"({"feeder.Aaxis_Speed":-9223372036854775808})"),
       "feeder.Aaxis_Speed: -9223372036854775808 is out"},
      {set(R"({"feeder.Aaxis_Speed":32769})"),
       "feeder.Aaxis_Speed: 32769 is out of range; expected 0 to 32768"},
      {set(R"({"feeder.STATUS":1})"), "feeder.STATUS cannot be written; it is read-only"},
      {set(R"({"feeder.STATUS.3":1})"), "feeder.STATUS.3 cannot be written; it is read-only"},
      {set(R"({"feeder.DOUT_ALL.3":2})"), "feeder.DOUT_ALL.3: 2 is out of range"},
      {set(R"({"feedr.Aaxis_Speed":1})"), "no device is called 'feedr'; the nearest is 'feeder'"},
      {set(R"({"Aaxis_Speed":1})"),
       "'Aaxis_Speed' must begin with its device; expected one of feeder.Aaxis_Speed, turner.Aaxis_Speed"},
      {set(R"({"feeder":1})"), "'feeder' is a device; expected feeder.REGISTER"},
      {input(R"({"DIN_1":1})"),
       "'DIN_1' must begin with its device; expected one of feeder.DIN_1, turner.DIN_1"},
      {input(R"({"feeder":1})"), "'feeder' is a device; expected feeder.INPUT"},
      {get(R"(["feeder"])"), "'feeder' is a device; expected feeder.NAME"},
      {get(R"(["A.position"])"),
       "'A.position' must begin with its device; expected one of feeder.A.position, turner.A.position"},
      {get(R"(["feeder.A.positon"])"), "axis A has no 'positon'; the nearest is 'position'"},
      {get(R"(["feeder.0x0003"])"), "feeder: no register is at 0x0003"},
      {get(R"(["feeder.0x1002.16"])"), "feeder: 0x1002 has no bit '16'; expected 0 to 15"},
      {get(R"(["feeder.A.greatest_speed"])"), "feeder.A.greatest_speed exists only in scenarios"},
      {eval("feeder.STATUS +"), "column 16 of 'feeder.STATUS +': unexpected end; expected "},
      {eval("1 / feeder.STATUS.0"), "column 3 of '1 / feeder.STATUS.0': division by zero"},
      {eval("feeder.STATUS == yes"),
       "column 18 of 'feeder.STATUS == yes': 'yes' is unknown here; expected on"},
      {R"({"do":"eval"})", "'expression' is missing"},
      {R"({"do":"frames","since":1,"last":1})", "since: cannot be combined with last; expected one of them"},
      {R"({"do":"frames","since":-1})", "since: -1 is not a whole number; expected one of 0 or more"},
      {set(R"({"":1})"), "the device is missing"},
      {set(R"({"feeder.":1})"), "feeder: no register is called ''"},
      {set(R"({"feeder.Aaxis_Sped":1})"),
       "feeder: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'"},
      {set(R"({"turner.NEW_PWD":1})"), "turner: register 'NEW_PWD' exists from firmware 1.51 on"},
      // Valid ones next to them change nothing either.
      {set(R"({"feeder.Aaxis_Speed":1,"turner.Aaxis_Speed":2,"feeder.Aaxis_AccTime":3001})"),
       "feeder.Aaxis_AccTime: 3001 is out of range; expected 0 to 3000"},
      {set(R"({"feeder.Aaxis_SVON":1,"feeder.HW_Code":1})"), "feeder.HW_Code cannot be written"},
      {set(R"({"feeder.Aaxis_SVON":1,"feeder.Nothing":1})"), "feeder: no register is called 'Nothing'"},
      {set(R"({"feeder.Factory_Reset":1,"feeder.Aaxis_Speed":null})"), speed + "null" + no_number},
      {R"({"do":"input"})", "'values' is missing"},
      {input("{}"), "values: {}" + no_levels},
      {input(R"({"feeder.DIN_1":2})"), "feeder.DIN_1: 2 is not a level; expected 0 or 1"},
      {input(R"({"feeder.DIN_1":-1})"), "feeder.DIN_1: -1 is not a level; expected 0 or 1"},
      {input(R"({"feeder.DIN_1":null})"), "feeder.DIN_1: null is not a level; expected on or off"},
      {input(R"({"feeder.DIN_1":[true]})"), "feeder.DIN_1: [true] is not a level; expected on or off"},
      {input(R"({"feeder.DIN_1":1,"feeder.DIN_11":1})"), "no input of feeder is called 'DIN_11'"},
      {input(R"({"feeder.DIN_1":1,"feeder.DOUT_1":1})"), "no input of feeder is called 'DOUT_1'"},
      {input(R"({"feeder.DIN_1":1,"turner.DIN_1":7})"), "turner.DIN_1: 7 is not a level; expected 0 or 1"},
      {R"({"do":"get"})", "'names' is missing"},
      {get("[]"), "names: []" + no_list},
      {get("{}"), "names: {}" + no_list},
      {get("\"feeder.STATUS\""), "names: 'feeder.STATUS'" + no_list},
      {get("[1]"), "names: [1]" + no_list},
      {get(R"(["feeder.STATUS",null])"), "names: [\"feeder.STATUS\",null]" + no_list},
      {get(R"(["feeder.STATUS","feeder.STATUS.16"])"),
       "feeder: register 'STATUS' has no bit '16'; expected 0 to 15"},
      {get(R"(["\u0000"])"), "no device is called '"},
      {R"({"do":"advance"})", "'by' is missing"},
      {by("250"), "by: 250" + no_time},
      {by("\"250\""), "by: '250'" + no_time},
      {by("\"-1s\""), "by: '-1s'" + no_time},
      {by("\"\""), "by: ''" + no_time},
      {by("[\"1s\"]"), "by: [\"1s\"]" + no_time},
      {by("\"99999999999999999999s\""), "by: '99999999999999999999s'" + no_time},
      {by("\"8761h\""), "by: is more than a year; expected at most a year"},
  };
  DaemonRig rig;
  for (const Bad& bad : cases) {
    const Json reply = rig.ask(bad.message);
    EXPECT_EQ(reply["ok"], false) << bad.message;
    EXPECT_TRUE(reply["error"].get<std::string>().starts_with(bad.error))
        << bad.message << ": " << reply["error"];
    EXPECT_TRUE(rig.is_untouched()) << bad.message;
  }
}

TEST(ControlMessages, ASetIsNeverDoneByHalf) {
  // Each of these alone would be accepted; after the other it is not: 2048 + 1024 exceeds 3000.
  for (const std::string values :
       {R"({"feeder.Aaxis_AccTime.11":1,"feeder.Aaxis_AccTime.10":1})",
        R"({"feeder.Aaxis_AccTime":2048,"feeder.Aaxis_AccTime.10":1})",
        R"({"turner.Aaxis_Speed":9,"feeder.Aaxis_AccTime.11":1,"feeder.Aaxis_AccTime.10":1})"}) {
    DaemonRig rig;
    const Json reply = rig.ask(R"({"do":"set","values":)" + values + "}");
    EXPECT_EQ(reply["ok"], false) << values;
    EXPECT_TRUE(rig.is_untouched()) << values;
  }
}

TEST(ControlMessages, ASetThatSaysOkHasWrittenEveryValue) {
  // The reset sets Axis_SyncRPM to 3000, where bit 6 would exceed the range; before it, it would not.
  DaemonRig rig;
  ASSERT_EQ(rig.ask(R"({"do":"set","values":{"feeder.Axis_SyncRPM":1}})")["ok"], true);
  const Json reply = rig.ask(R"({"do":"set","values":{"feeder.Factory_Reset":1,"feeder.Axis_SyncRPM.6":1}})");
  EXPECT_EQ(reply["ok"].get<bool>(), rig.value("feeder.Axis_SyncRPM.6") == 1) << reply;
}

TEST(ControlMessages, AKeyThatIsThereTwiceIsRefusedAndDoesNothing) {
  DaemonRig rig;
  for (const auto& [message, key] : std::vector<std::pair<std::string, std::string>>{
           {R"({"do":"status","do":"pause"})", "do"},
           {R"({"do":"set","values":{"feeder.Aaxis_Speed":1,"feeder.Aaxis_Speed":2}})",
            "feeder.Aaxis_Speed"}}) {
    const Json reply = rig.ask(message);
    EXPECT_EQ(reply["ok"], false) << message;
    EXPECT_EQ(reply["error"], "'" + key + "' appears twice; expected it only once");
  }
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["paused"], false);
  EXPECT_TRUE(rig.is_untouched());
}

TEST(ControlMessages, WhateverGoesWrongIsAReply) {
  DaemonRig rig;
  std::vector<std::string> replies;
  handle_message(rig.daemon, R"({"do":"status"})", [&](const std::string& line) {
    replies.push_back(line);
    // As the library throws it, for example when there is no memory for a text.
    if (replies.size() == 1) throw std::length_error("too long");
  });
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[1], R"({"ok":false,"error":"too long"})");
}

/// Programs are written in this encoding.
TEST(ControlMessages, EachHasItsHeadingOnThePage) {
  std::ostringstream page;
  page << std::ifstream(PROJECT_FOLDER "/docs/control.md").rdbuf();
  DaemonRig rig;
  const std::string error = rig.ask(R"({"do":"jump"})")["error"];
  const std::string before = "expected one of ";
  const std::size_t at = error.find(before);
  ASSERT_NE(at, std::string::npos) << error;
  std::istringstream verbs(error.substr(at + before.size()));
  int count = 0;
  for (std::string verb; verbs >> verb; ++count) {
    if (verb.ends_with(',')) verb.pop_back();
    EXPECT_NE(page.str().find("\n### " + verb + "\n"), std::string::npos) << verb;
  }
  EXPECT_GT(count, 30);
}

}  // namespace messages_test
}  // namespace understudy::emulator::serve
