// SLIM's dialogue with each option, and with hosts of different habits.
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace dialogue_options_test {

TEST(SlimDialogue, SpeaksAsItsOptionsSay) {
  const auto all_said = [](DialogueScript& script, const std::string& line) {
    script.send(line + "\r");
    std::string message;
    for (std::string next = script.next(); next != "(nothing)"; next = script.next()) message += next + "|";
    return message;
  };
  {
    DialogueScript script(2, {{"query_reply", "name_and_value"}, {"acknowledgement", "ok"}});
    EXPECT_EQ(all_said(script, "?PE"), "PE=0|");
    EXPECT_EQ(all_said(script, "?T1VM"), "T1VM=1000|");
    EXPECT_EQ(all_said(script, "N0=3"), "OK|");
    EXPECT_EQ(all_said(script, "?N0"), "N0=3|");
    EXPECT_EQ(all_said(script, "nonsense"), "ERR 1|");
  }
  {
    DialogueScript script(1, {{"error_reply", "nothing"}});
    EXPECT_EQ(all_said(script, "nonsense"), "");
    EXPECT_EQ(all_said(script, "?ERR"), "1|");
  }
  {
    DialogueScript script(1, {{"immediate_column", "taken"}});
    EXPECT_EQ(all_said(script, "XMA R0"), "ERR 4|");  // allowed, but no module is X
  }
  {
    DialogueScript script(1, {{"power_up_servo", "off"}});
    EXPECT_EQ(all_said(script, "?ST"), "0|");
    EXPECT_EQ(all_said(script, "MA 5"), "ERR 9|");
  }
  {
    DialogueScript script(1, {{"pulses_per_revolution", "1000"}});
    // A tenth of the pulses per second: 10000 are 0.6 + 0.1 s.
    EXPECT_EQ(all_said(script, "MA 10000"), "");
    script.pass(695);
    EXPECT_EQ(all_said(script, "?MD"), "1|");
    script.pass(10);
    EXPECT_EQ(all_said(script, "?MD"), "0|");
  }
  {
    DialogueScript script(1, {{"ineffective_pause", "error_3"}});
    EXPECT_EQ(all_said(script, "TAREDO"), "ERR 3|");
  }
}

TEST(SlimDialogue, ReportsOnceWhatIsNotModelled) {
  std::vector<std::string> reported;
  world::World world(slim_bench(2), world::WorldOptions{},
                     [&](const std::string& text) { reported.push_back(text); });
  auto& device = dynamic_cast<Slim&>(world.device(0));
  for (const char* line : {"?AC", "?AC", "EL=5", "T1EL=6", "FT 100", "?PE"}) device.receive_line(line);
  ASSERT_EQ(reported.size(), 3u);
  EXPECT_EQ(reported[0].rfind("robot: AC is not modelled: ", 0), 0u) << reported[0];
  EXPECT_EQ(reported[1].rfind("robot: EL is not modelled: ", 0), 0u) << reported[1];
  EXPECT_EQ(reported[2].rfind("robot: FT is not modelled: ", 0), 0u) << reported[2];
}

TEST(SlimDialogue, ToleratesWhatTerminalsDo) {
  DialogueScript script;
  script.send("?PE\r\n?PE\n\r\n\r\r?pe\r");  // LF after CR, LF alone, empty lines
  for (int i = 0; i < 3; ++i) EXPECT_EQ(script.next(), "0");
  EXPECT_EQ(script.next(), "(nothing)");
  script.send("?P");  // half a line
  EXPECT_EQ(script.next(), "(nothing)");
  script.send("E\r");
  EXPECT_EQ(script.next(), "0");
  script.send(std::string(128, 'X') + "\r?PE\r");
  EXPECT_EQ(script.next(), "ERR 1");
  EXPECT_EQ(script.next(), "0");
  script.send("\x00\x01\xFF\xFE garbage \x7F\r");
  script.send("?PE\r");
  while (true) {
    const std::string line = script.next();
    ASSERT_NE(line, "(nothing)");
    if (line == "0") break;
    EXPECT_EQ(line, "ERR 1");
  }
}

}  // namespace dialogue_options_test

}  // namespace understudy::emulator::models::slim
