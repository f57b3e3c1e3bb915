// Inspection with `ctl`: names, expressions, decoded frames.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/acceptance/at_terminal.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace ctl_looking_test {

using Json = nlohmann::json;

TEST(CtlGet, TakesWhateverConditionsTake) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  ASSERT_EQ(daemon.ctl({"advance", "1500ms"}).exit_code, 0);
  ASSERT_EQ(daemon.ctl({"input", "AIN_A=2.5V"}).exit_code, 0);
  EXPECT_EQ(
      daemon.ctl({"get", "time", "device.A.position", "AIN_A", "power", "line.bytes_in", "0x0001"}).output,
      "time 1.5s\ndevice.A.position 0\nAIN_A 2.5V\npower 1\nline.bytes_in 0\n0x0001 49153\n");
  EXPECT_EQ(daemon.ctl({"get", "device"}).errors,
            "understudy: ctl get: 'device' is a device; expected device.NAME\n");
  for (const char* axis : {"device.A", "A", "device.A."}) {
    const std::string errors = daemon.ctl({"get", axis}).errors;
    EXPECT_EQ(errors.find("understudy: ctl get: 'device.A' is an axis; expected one of its values: "
                          "device.A.pulses, device.A.target, device.A.speed, device.A.servo, device.A.pwm, "),
              0U)
        << errors;
  }
}

TEST(CtlEval, PrintsWhatAnExpressionComesTo) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  EXPECT_EQ(daemon.ctl({"eval", "HW_Code - 0xC000"}).output, "1\n");
  EXPECT_EQ(daemon.ctl({"eval", "time + 250ms"}).output, "250ms\n");
  EXPECT_EQ(daemon.ctl({"eval", "device.A.position == 0 && DIN_1 == off"}).output, "1\n");
  const Finished refused = daemon.ctl({"eval", "HW_Code +"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("column 10 of 'HW_Code +': unexpected end"), std::string::npos)
      << refused.errors;
  EXPECT_EQ(daemon.ctl({"eval"}).exit_code, 2);
}

TEST(CtlWatch, ShowsJustWhatIsNamed) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  EXPECT_EQ(daemon.ctl({"watch", "--times", "2", "--every", "10ms", "HW_Code", "A.position"}).output,
            "time        0s\nHW_Code     49153\nA.position  0\n\n"
            "time        0s\nHW_Code     49153\nA.position  0\n\n");
  const Finished refused = daemon.ctl({"watch", "--times", "1", "HW_Cod"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors,
            "understudy: ctl watch: device: no register is called 'HW_Cod'; the nearest is "
            "'HW_Code'\n");
}

// At a terminal, keys scroll to the lines that do not fit into the window, and a wide window is used.
TEST(CtlWatch, ScrollsInASmallWindow) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  AtTerminal screen({UNDERSTUDY_BINARY, "ctl", "--control", daemon.control(), "watch", "--every", "50ms"},
                    {{"TERM", "xterm"}}, {.rows = 5, .columns = 60});
  ASSERT_TRUE(screen.shows("\x1b[Htime ")) << screen.screen();
  EXPECT_TRUE(screen.shows("lines 1 to 4 of ")) << screen.screen();
  screen.type("j");
  EXPECT_TRUE(screen.shows("\x1b[Hlateness ")) << screen.screen();
  screen.type("\x1b[6~");
  EXPECT_TRUE(screen.shows("lines 6 to 9 of ")) << screen.screen();
  screen.type("G");
  EXPECT_TRUE(screen.shows("  outputs    -")) << screen.screen();
  screen.type("\x1b[H");
  EXPECT_TRUE(screen.shows("\x1b[Htime ")) << screen.screen();
  screen.resize({.rows = 40, .columns = 160});
  EXPECT_TRUE(
      screen.shows("  registers  STATUS 0  Aaxis_Mode 0  Baxis_Mode 0  Cord_A 0  Cord_B 0  "
                   "PROG_MAIN_RunTime_Status 0  PROG_MAIN_NowLine 0  EEPROM_Writing 0"))
      << screen.screen();
  screen.type("q");
  EXPECT_EQ(screen.wait(kPatience), 0);
}

/// The lines of `ctl frames --once WORDS` without their times.
Words frames(const RunningUnderstudy& daemon, Words words) {
  words.insert(words.begin(), {"frames", "--once"});
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  Words lines = lines_of(finished.output);
  for (std::string& line : lines) {
    EXPECT_TRUE(std::regex_search(line, std::regex("^[0-9.]+[mu]?s "))) << line;
    line.erase(0, line.find(' ') + 1);
  }
  return lines;
}

TEST(CtlFrames, TellsWhatHasJustGoneOverTheLine) {
  const RunningUnderstudy daemon({"--timing", "instant"});
  EXPECT_EQ(frames(daemon, {}), Words{});
  ASSERT_EQ(understudy({"poll", daemon.port(), "--model", "simple2-r3", "Aaxis_SVON=1", "Cord_A"}).exit_code,
            0);
  Host host(daemon.port());
  host.write(pty::hex("01 03 00 00 00 01 BA D0"));
  const Words all{"line -> write 0x1014 device.Aaxis_SVON = 1", "line <- done",
                  "line -> read 0x0E04 device.Cord_A", "line <- device.Cord_A = 0",
                  "line -> 01 03 00 00 00 01 BA D0  (dropped: bad CRC)"};
  EXPECT_TRUE(eventually([&] { return frames(daemon, {}).size() == all.size(); }));
  EXPECT_EQ(frames(daemon, {}), all);
  EXPECT_EQ(frames(daemon, {"--last", "1"}), Words{all.back()});
  const Words objects = lines_of(daemon.ctl({"--json", "frames", "--once", "--last", "2"}).output);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(Json::parse(objects[0])["number"], 4);
  EXPECT_EQ(Json::parse(objects[0])["way"], "out");
  EXPECT_EQ(Json::parse(objects[1])["remark"], "dropped: bad CRC");
  EXPECT_EQ(daemon.ctl({"frames", "--last", "201"}).exit_code, 2);
  EXPECT_EQ(daemon.ctl({"frames", "--times", "-1"}).exit_code, 2);
  EXPECT_EQ(daemon.ctl({"frames", "--every", "1ms"}).exit_code, 2);
}

TEST(CtlFrames, TellsLinesOfTextAsWell) {
  const auto daemon = RunningUnderstudy::of_model("slim", {"--timing", "instant"});
  Host host(daemon->port());
  const std::string text = "?PE\r";
  host.write(Bytes(text.begin(), text.end()));
  EXPECT_TRUE(eventually([&] { return frames(*daemon, {}).size() == 2; }));
  EXPECT_EQ(frames(*daemon, {}), (Words{"line -> \"?PE\"", "line <- \"0\""}));
}

TEST(StandardInput, IsAFileWhereAListingIsExpected) {
  const std::string program = UNDERSTUDY_BINARY;
  for (const char* const path : {"-", "/dev/stdin"}) {
    const Finished made = run({"/bin/sh", "-c", "printf 'Out DOUT_0 ON\n' | " + program + " asm " + path});
    EXPECT_EQ(made.exit_code, 0) << made.errors;
    EXPECT_EQ(lines_of(made.output).size(), 1U) << made.output;
    const Finished back =
        run({"/bin/sh", "-c",
             "printf 'Out DOUT_0 ON\n' | " + program + " asm - | " + program + " disasm " + path});
    EXPECT_NE(back.output.find("Out DOUT_0"), std::string::npos) << back.output << back.errors;
    const Finished wrong = run({"/bin/sh", "-c", "printf 'Jmp\n' | " + program + " asm " + path});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_EQ(wrong.errors.find(std::string(path) + ":1"), 0U) << wrong.errors;
  }
  const RunningUnderstudy daemon({"--speed", "manual"});
  EXPECT_EQ(run({"/bin/sh", "-c",
                 "printf 'Out DOUT_0 ON\n' | " + program + " ctl --control " + daemon.control() +
                     " program device -"})
                .exit_code,
            0);
  EXPECT_NE(daemon.ctl({"program"}).output.find("Out DOUT_0"), std::string::npos);
}

/// As much as a device can hold, which is more than a line of 64 KiB.
TEST(CtlProgram, TellsWhatIsOddAboutWhatItLoads) {
  const PrivateFolder folder;
  const auto daemon = RunningUnderstudy::of_model("super-40nc", {"--speed", "manual"});
  const std::string odd = folder.write("odd.lst", "AREA C\nLAB K1\nLAB K1\nJMP K9\nEND\n");
  const Finished loaded = daemon->ctl({"program", "device", odd});
  EXPECT_EQ(loaded.exit_code, 0);
  EXPECT_EQ(
      loaded.errors,
      "understudy: ctl program: " + odd +
          ":3:1: warning: label K1 appears twice; expected one, as in line 2\nunderstudy: ctl program: " +
          odd +
          ":4:1: warning: JMP K9 names a label that the area does not have; "
          "expected LAB K9\n");
  const Finished well = daemon->ctl({"program", "device", folder.write("well.lst", "AREA C\nEND\n")});
  EXPECT_EQ(well.output + well.errors, "");
}

TEST(CtlProgram, LoadsAFullDeviceAndGivesItBack) {
  std::string files;
  for (int number = 0; number < 80; ++number) {
    files += "FILE " + std::to_string(number) + "\n";
    for (int line = 0; line < 370; ++line) {
      files += "LIN K" + std::to_string(number) + " K" + std::to_string(line) + "\n";
    }
    files += "END\n";
  }
  std::string macros;
  for (int number = 1; number <= 157; ++number) {
    macros += "MP " + std::to_string(number) + "\n";
    const int lines = number <= 40    ? 8
                      : number <= 90  ? 16
                      : number <= 130 ? 32
                      : number <= 150 ? 64
                      : number <= 155 ? 128
                                      : 512;
    for (int line = 0; line < lines; ++line)
      macros += "RSM_MACRO_SET_VAR VAR1 " + std::to_string(line) + "\n";
    macros += "END\n";
  }
  const PrivateFolder folder;
  for (const auto& [model, listing] : {std::pair("super-40nc", files), std::pair("rs-m8194h", macros)}) {
    EXPECT_GT(listing.size(), 65'536U) << model;
    const auto daemon = RunningUnderstudy::of_model(model, {"--speed", "manual"});
    const Finished loaded = daemon->ctl({"program", "device", folder.write("full", listing)});
    ASSERT_EQ(loaded.exit_code, 0) << model << " " << loaded.errors;
    const std::string given_back = daemon->ctl({"program"}).output;
    EXPECT_GT(given_back.size(), 65'536U) << model;
    const Finished again = daemon->ctl({"program", "device", folder.write("again", given_back)});
    EXPECT_EQ(again.exit_code, 0) << model << " " << again.errors;
    EXPECT_EQ(daemon->ctl({"program"}).output, given_back) << model;
    // Numbers that do not occur in another line.
    const std::string last = model == std::string("super-40nc") ? "LIN K79 K369" : "VAR1 511\nEND";
    EXPECT_NE(given_back.find(last), std::string::npos) << given_back.substr(0, 500);
  }
}

TEST(CtlBreak, DebugsAProgram) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  const std::string file = daemon.folder().write(
      "count.lst", "again:  VAR_Inc VAR32\n        Delay_mSec 5\n        Jump again\n        END\n");
  ASSERT_EQ(daemon.ctl({"program", "device", file}).exit_code, 0);
  EXPECT_EQ(daemon.ctl({"break", "2", "when=PROG_VAR0 == 3"}).output,
            "1 device=device found=true line=2 when=PROG_VAR0 == 3 hits=0\n");
  ASSERT_EQ(daemon.ctl({"set", "PROG_MAIN_RunTime_START=0"}).exit_code, 0);
  EXPECT_EQ(daemon.ctl({"continue", "within=1s"}).output, "breakpoint 1: device line 2: Delay_mSec 5\n");
  EXPECT_EQ(daemon.ctl({"stack"}).output, "waiting\n  line 2 Delay_mSec 5\n");
  EXPECT_EQ(daemon.ctl({"variables", "scope=program"}).output, "device.PROG_VAR0 3\n");
  EXPECT_EQ(daemon.ctl({"step", "line"}).output.substr(0, 20), "step: device line 3:");
  EXPECT_EQ(daemon.ctl({"break"}).output, "1 device=device found=true line=2 when=PROG_VAR0 == 3 hits=1\n");
  EXPECT_EQ(daemon.ctl({"break", "delete", "1"}).exit_code, 0);
  EXPECT_EQ(daemon.ctl({"break"}).output, "");
  EXPECT_EQ(daemon.ctl({"step", "3"}).exit_code, 0) << "ticks";
  daemon.ctl({"break", "write=PROG_VAR0"});
  const Finished until = daemon.ctl({"run-until", "PROG_VAR0 == 99"});
  EXPECT_EQ(until.exit_code, 1);
  EXPECT_EQ(until.errors, "understudy: ctl run-until: 'PROG_VAR0 == 99' did not become true before a stop\n");
  const std::pair<Words, const char*> wrong[] = {
      {{"break", "device"}, "nothing to stop at; expected line, instruction, when, write or on"},
      {{"break", "colour=red"}, "expected DEVICE LINE, instruction=N"},
      {{"break", "3", "4"}, "'4' is not understood; expected one line"},
      {{"break", "delete"}, "expected a number after delete, or all"},
      {{"step", "back"}, "what: 'back' is unknown"},
      {{"continue", "soon"}, "expected within=10s"},
      {{"variables", "sort=axes"}, "expected DEVICE or scope="}};
  for (const auto& [words, why] : wrong) {
    const Finished refused = daemon.ctl(words);
    EXPECT_EQ(refused.exit_code, 2) << why;
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
    EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
  }
}

TEST(CtlCommand, GivesADeviceACommandByItsName) {
  const auto daemon = RunningUnderstudy::of_model("rs-m8194h", {"--speed", "manual"});
  EXPECT_EQ(daemon->ctl({"command", "RSM_SET_V X 1000"}).exit_code, 0);
  EXPECT_EQ(daemon->ctl({"command", "device", "RSM_FIXED_MOVE X 50"}).exit_code, 0);
  daemon->ctl({"advance", "1s"});
  EXPECT_EQ(daemon->ctl({"get", "LP_X"}).output, "LP_X 50\n");
  const std::pair<Words, const char*> wrong[] = {
      {{"command", "RSM_FLY X"}, "understudy: ctl command: column 1: "},
      {{"command"}, "expected a device and a command in quotes"},
      {{"command", "device", "RSM_FIXED_MOVE", "X 50"}, "expected a device and a command in quotes"},
      {{"command", "RSM_MACRO_NEXT"}, "understudy: ctl command: device refuses it: "},
  };
  for (const auto& [words, why] : wrong) {
    const Finished refused = daemon->ctl(words);
    EXPECT_EQ(refused.exit_code, 2) << why;
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
  }
  const RunningUnderstudy other({"--speed", "manual"});
  EXPECT_NE(other.ctl({"command", "STOP"}).errors.find("simple2-r3 has no named commands"),
            std::string::npos);
}

}  // namespace ctl_looking_test
}  // namespace understudy::acceptance
