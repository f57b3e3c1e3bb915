// The output of `ctl watch`.
#include "emulator/serve/control/watch_table.h"
#include "emulator/serve/control/server.h"

#include "emulator/serve/control/scrolled_view.h"
#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace watch_table_test {

TEST(WatchTable, ShowsWhatMovesAndWhatIsOn) {
  DaemonRig rig;
  rig.ask(R"({"do":"set","values":{"feeder.Aaxis_SVON":1,"feeder.Aaxis_Pulse":3200,"feeder.Aaxis_Speed":200,)"
          R"("feeder.Aaxis_Move_INC":1,"feeder.DOUT_4":1}})");
  rig.ask(R"({"do":"input","values":{"turner.DIN_7":1,"turner.AIN_B":"2.5V"}})");
  // 10 ms of acceleration to 10666.7 pulses per second from 1 ms on: 53.3 pulses; 50 ms at that speed: 533.3.
  rig.daemon.world().advance_to(std::chrono::milliseconds(61));
  const std::string status = rig.reply_to(R"({"do":"status"})");
  const auto lines = watch_table(status, "", 0);
  const std::vector<std::string> expected{
      "time         61ms, speed manual",
      "lateness     p50 0 us, p99 0 us, max 0 us, 0 slips",
      "rs485        19200 8E1, host closed, 0 bytes in, 0 out",
      "",
      "feeder       simple2-r3, firmware 1.52",
      "  A                   586 pulses      10666.7 pulses/s   machine at 586",
      "  B                     0 pulses          0.0 pulses/s   machine at 0",
      "  registers  STATUS 1040  Aaxis_Mode 0  Baxis_Mode 0  Cord_A 586  Cord_B 0",
      "             PROG_MAIN_RunTime_Status 0  PROG_MAIN_NowLine 0  EEPROM_Writing 0",
      "  inputs     -",
      "  outputs    DOUT_4",
      "",
      "turner       simple2-r3, firmware 1.40",
  };
  ASSERT_GE(lines.size(), expected.size());
  EXPECT_EQ(
      std::vector<std::string>(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(expected.size())),
      expected);
  // The wire carried DOUT_4 to it.
  EXPECT_EQ(lines.at(lines.size() - 2), "  inputs     DIN_7  DIN_10  AIN_B 2500 mV");
  EXPECT_EQ(lines.back(), "  outputs    -");
}

TEST(WatchTable, FillsItsColumnsToTheLast) {
  DaemonRig rig;
  const std::string status = rig.reply_to(R"({"do":"status"})");
  const std::string line = watch_table(status, "", 0).at(7);
  ASSERT_TRUE(line.starts_with("  registers  STATUS ")) << line;
  EXPECT_EQ(watch_table(status, "", 0, line.size()).at(7), line);
  EXPECT_EQ(watch_table(status, "", 0, line.size() - 1).at(7), line.substr(0, line.rfind("  ")));
}

TEST(WatchTable, CountsFramesASecond) {
  DaemonRig rig;
  const std::string before = rig.reply_to(R"({"do":"status"})");
  Json after = Json::parse(before);
  after["status"]["lines"][0]["stations"][0]["requests"] = 40;
  after["status"]["lines"][0]["stations"][0]["replies"] = 30;
  after["status"]["lines"][0]["stations"][1]["requests"] = 5;
  EXPECT_EQ(watch_table(after.dump(), before, 0.5).at(2),
            "rs485        19200 8E1, host closed, 150.0 frames/s, 0 bytes in, 0 out");
  // After a restore there may be fewer.
  EXPECT_NE(watch_table(before, after.dump(), 0.5).at(2).find(", 0.0 frames/s"), std::string::npos);
}

TEST(WatchTable, SaysWhatHasNoPower) {
  DaemonRig rig;
  rig.ask(R"({"do":"power","device":"feeder","to":"off"})");
  const auto lines = watch_table(rig.reply_to(R"({"do":"status"})"), "", 0);
  EXPECT_EQ(lines.at(4), "feeder       simple2-r3, firmware 1.52, without power");
}

TEST(WatchTable, RefusesWhatIsNoStatus) {
  for (const char* const reply : {"", "{}", "[]", R"({"ok":true,"status":{}})"}) {
    EXPECT_THROW(watch_table(reply, "", 0), ControlError) << reply;
  }
}

TEST(WatchValues, ShowsWhatWasNamedAndWhyThereIsNone) {
  DaemonRig rig;
  rig.daemon.world().advance_to(std::chrono::milliseconds(1500));
  const std::vector<std::string> names{"feeder.HW_Code", "feeder.A.position"};
  EXPECT_EQ(watch_values(rig.reply_to(get_message(names))),
            (std::vector<std::string>{"time               1.5s", "feeder.HW_Code     49153",
                                      "feeder.A.position  0"}));
  EXPECT_EQ(get_message({"time"}), R"({"do":"get","names":["time"]})");
  rig.ask(R"({"do":"power","device":"feeder","to":"off"})");
  EXPECT_EQ(watch_values(rig.reply_to(get_message(names))),
            std::vector<std::string>{"feeder has no power; expected it to be on"});
  EXPECT_EQ(why_refused(rig.reply_to(get_message({"turner.HW_Cod"}))),
            "turner: no register is called 'HW_Cod'; the nearest is 'HW_Code'");
  EXPECT_THROW(why_refused("hello"), ControlError);
}

TEST(WatchTable, TakesTheWidthThereIs) {
  DaemonRig rig;
  const std::string status = rig.reply_to(R"({"do":"status"})");
  EXPECT_EQ(watch_table(status, "", 0, 200).at(7),
            "  registers  STATUS 0  Aaxis_Mode 0  Baxis_Mode 0  Cord_A 0  Cord_B 0  "
            "PROG_MAIN_RunTime_Status 0  PROG_MAIN_NowLine 0  EEPROM_Writing 0");
  EXPECT_EQ(watch_table(status, "", 0, 40).at(7), "  registers  STATUS 0  Aaxis_Mode 0");
  EXPECT_EQ(watch_table(status, "", 0, 40).at(8), "             Baxis_Mode 0  Cord_A 0");
}

using Lines = std::vector<std::string>;

TEST(ScrolledView, ShowsAllThatFitsAndFoldsWhatIsLong) {
  ScrolledView view;
  const Lines lines{"one", "two is long", "three", "four"};
  EXPECT_EQ(view.fit(lines, 4, 80), lines);
  EXPECT_EQ(view.fit(lines, 9, 6), (Lines{"one", "two is", "long", "three", "four"}));
  EXPECT_EQ(view.fit({"  abcdefghij"}, 9, 5), (Lines{"  abc", "defgh", "ij"}));
  EXPECT_EQ(view.fit({"some words that are longer than this"}, 9, 20),
            (Lines{"some words that are", "    longer than this"}));
  EXPECT_EQ(view.fit({"a\xE9\x81\x8B"
                      "b"},
                     9, 3),
            (Lines{"a", "\xE9\x81\x8B", "b"}))
      << "a character stays whole";
}

TEST(ScrolledView, MovesByTheUsualKeys) {
  ScrolledView view;
  Lines lines;
  for (int i = 1; i <= 20; ++i) lines.push_back(std::to_string(i));
  const auto shown = [&](const std::string& keys) {
    EXPECT_FALSE(view.press(keys));
    const Lines on_screen = view.fit(lines, 5, 80);
    EXPECT_EQ(on_screen.size(), 5U);
    EXPECT_EQ(on_screen.back(), "lines " + on_screen[0] + " to " + on_screen[3] +
                                    " of 20 (arrows, Page Up, Page Down; q ends)");
    return on_screen[0];
  };
  EXPECT_EQ(shown(""), "1");
  for (const auto& [keys, first] : std::vector<std::pair<std::string, std::string>>{{"j", "2"},
                                                                                    {"\x1b[B", "3"},
                                                                                    {"\x1bOB", "4"},
                                                                                    {"k", "3"},
                                                                                    {"\x1b[A", "2"},
                                                                                    {"\x1bOAkkk", "1"},
                                                                                    {"\x1b[6~", "5"},
                                                                                    {" ", "9"},
                                                                                    {"b", "5"},
                                                                                    {"\x1b[5~", "1"},
                                                                                    {"G", "17"},
                                                                                    {"j", "17"},
                                                                                    {" ", "17"},
                                                                                    {"g", "1"},
                                                                                    {"\x1b[F", "17"},
                                                                                    {"\x1b[H", "1"},
                                                                                    {"x\x1b[C", "1"},
                                                                                    {"\x1b[4~k", "16"},
                                                                                    {"\x1b[1~\r", "2"}}) {
    EXPECT_EQ(shown(keys), first) << keys;
  }
  EXPECT_TRUE(view.press("jq"));
  // With a larger window, or fewer lines, nothing is omitted that fits.
  view.press("G");
  lines.resize(6);
  EXPECT_EQ(view.fit(lines, 5, 80).front(), "3");
  EXPECT_EQ(view.fit(lines, 9, 80), lines);
  EXPECT_EQ(view.fit(lines, 1, 80).size(), 1U);
}

}  // namespace watch_table_test
}  // namespace understudy::emulator::serve
