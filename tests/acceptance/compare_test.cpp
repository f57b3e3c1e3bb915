// `understudy compare` and `understudy calibrate`, with captures that `run` and `serve` have written.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/acceptance/at_terminal.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace compare_test {

using nlohmann::json;

std::string bench_with(const std::string& choices) {
  return "understudy: 1\nlines:\n  line:\n    stations:\n      - { name: box, model: simple2-r3, choices: "
         "{ " +
         choices + " } }\n";
}

/// Writes a scenario that reads and writes registers.
std::string scenario_on(const PrivateFolder& folder, const std::string& bench, int version) {
  return folder.write("scenario.yaml", "understudy: 1\nname: talk\nbench: " + bench +
                                           "\nsteps:\n"
                                           "  - expect: { box.HW_Code: 49153 }\n"
                                           "  - expect: { box.Version: " +
                                           std::to_string(version) +
                                           " }\n"
                                           "  - write: { box.Aaxis_Speed: 60 }\n"
                                           "  - expect: { box.Aaxis_Speed: 60 }\n");
}

class Compare : public testing::Test {
 protected:
  /// Returns the capture of a box with these choices, as pcapng.
  std::string capture_of(const std::string& choices, int version) const {
    const std::string bench = folder_.write("box.yaml", bench_with(choices));
    const Finished run =
        understudy({"run", scenario_on(folder_, "box.yaml", version), "--capture", folder_ / "captures"});
    EXPECT_EQ(run.exit_code, 0) << run.output << run.errors;
    return folder_ / "captures/talk.pcapng";
  }
  const PrivateFolder folder_;
  const std::string plain_ = folder_.write("plain.yaml", bench_with(""));
};

TEST_F(Compare, FindsEveryReplyTheSameOnAnEqualBench) {
  const std::string capture = capture_of("", 152);
  const Finished same = understudy({"compare", capture, "--bench", plain_, "--power-up"});
  EXPECT_EQ(same.exit_code, 0) << same.errors;
  EXPECT_EQ(same.output, capture + ": 4 exchanges: 4 same\n");
}

TEST_F(Compare, NamesTheDifferenceAndItsRemedy) {
  const std::string capture = capture_of("version_encoding: bcd", 338);
  const Finished other =
      understudy({"compare", capture, "--bench", plain_, "--power-up", "--format", "json"});
  EXPECT_EQ(other.exit_code, 1) << other.errors;
  const json report = json::parse(other.output, nullptr, false)[0];
  EXPECT_EQ(report["different"], 1) << other.output;
  EXPECT_EQ(report["same"], 3);
  EXPECT_EQ(report["agrees_with"], json{"box.version_encoding: bcd"});
  EXPECT_EQ(report["last_agreement"], "read 0x0001 box.HW_Code");
  EXPECT_TRUE(report["state"][0].get<std::string>().starts_with("box: STATUS 0 (0x0000), ")) << other.output;
  EXPECT_EQ(report["asked"][0], (json{{"choice", "box.version_encoding"},
                                      {"option", "hundredths"},
                                      {"section", "狀態相關"},
                                      {"place", report["first_difference"]},
                                      {"since_agreement", true}}))
      << other.output;
  EXPECT_EQ(report["not_same"][0]["controller"], "box.Version = 338");
  EXPECT_EQ(report["not_same"][0]["bench"], "box.Version = 152");
}

/// Three reads of HW_Code; `second` is the reply to the second one, or empty.
std::string three_reads(const std::string& second) {
  const auto read = [](const std::string& time, const std::string& reply) {
    const std::string request = time + "00 in  line 01 03 00 01 00 01 D5 CA\n";
    return request + (reply.empty() ? "" : time + "20 out line " + reply + "\n");
  };
  return read("0.1", "01 03 02 C0 01 29 84") + read("0.2", second) + read("0.3", "01 03 02 C0 01 29 84");
}

TEST_F(Compare, TakesTheSameDamageOnBothSidesForTheSame) {
  const std::string capture = folder_.write("damaged.txt", three_reads("01 03 02 C0 01 29 7B"));
  const std::string bench =
      folder_.write("damaging.yaml", bench_with("") + "faults: [ { corrupt_checksum: box, nth: 2 } ]\n");
  const Finished same = understudy({"compare", capture, "--bench", bench, "--power-up", "--format", "json"});
  EXPECT_EQ(same.exit_code, 0) << same.output << same.errors;
  EXPECT_EQ(json::parse(same.output, nullptr, false)[0]["different"], 0) << same.output;
}

TEST_F(Compare, NamesNoOptionForALostReply) {
  const std::string capture = folder_.write("lost.txt", three_reads(""));
  const Finished lost = understudy({"compare", capture, "--bench", plain_, "--power-up", "--format", "json"});
  EXPECT_EQ(lost.exit_code, 1) << lost.output << lost.errors;
  EXPECT_EQ(json::parse(lost.output, nullptr, false)[0]["agrees_with"], json::array()) << lost.output;
}

TEST_F(Compare, CalibratesABenchThatThenAgrees) {
  const std::string capture = capture_of("version_encoding: bcd", 338);
  const std::string evidence = folder_ / "evidence.json";
  EXPECT_EQ(understudy({"calibrate", capture, "--bench", plain_, "--power-up", "-o", evidence}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(evidence));
  const Finished choices = understudy({"calibrate", capture, "--bench", plain_, "--power-up", "--choices"});
  EXPECT_EQ(choices.output, "choices:  # of box\n  version_encoding: bcd\n") << choices.errors;
}

TEST_F(Compare, ShowsWhatIsMeasuredAmongTheChoices) {
  const std::string capture = capture_of("version_encoding: bcd", 338);
  const std::string evidence = folder_ / "evidence.json";
  ASSERT_EQ(
      understudy({"calibrate", capture, "--bench", plain_, "--power-up", "-o", evidence, "--box", "number 3"})
          .exit_code,
      0);
  const Finished choices =
      understudy({"describe", "simple2-r3", "choices", "--evidence", evidence, "--format", "json"});
  EXPECT_EQ(choices.exit_code, 0) << choices.errors;
  std::size_t measured = 0;
  for (const json& row : json::parse(choices.output, nullptr, false)) {
    if (row["id"] != "version_encoding") {
      if (row["confidence"] == "measured") ++measured;
      continue;
    }
    EXPECT_EQ(row["confidence"], "measured");
    EXPECT_EQ(row["measured"], "bcd");
    EXPECT_EQ(row["evidence"], "number 3 (1.52), " + capture + ":3");
  }
  EXPECT_LT(measured, 10U);
  const Finished foreign = understudy({"describe", "slim", "choices", "--evidence", evidence});
  EXPECT_EQ(foreign.errors, "understudy: describe: " + evidence + ": has no evidence about slim\n");
  const Finished wrong = understudy({"describe", "simple2-r3", "choices", "--evidence", plain_});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.errors.find("evidence: is none; expected a file of `understudy calibrate -o`"),
            std::string::npos);
}

TEST_F(Compare, WritesTheFirmwareThatWasFound) {
  const std::string old = folder_.write("box.yaml",
                                        "understudy: 1\nlines:\n  line:\n    stations:\n"
                                        "      - { name: box, model: simple2-r3, firmware: \"1.40\" }\n");
  ASSERT_EQ(understudy({"run", scenario_on(folder_, old, 140), "--capture", folder_ / "captures"}).exit_code,
            0);
  const std::string evidence = folder_ / "evidence.json";
  const Finished found = understudy(
      {"calibrate", folder_ / "captures/talk.pcapng", "--bench", plain_, "--power-up", "-o", evidence});
  EXPECT_EQ(found.exit_code, 0) << found.errors;
  EXPECT_NE(found.output.find("box.firmware: 1.40  (the bench has a different option)"), std::string::npos)
      << found.output;
  EXPECT_TRUE(found.output.ends_with("wrote " + evidence + "\n")) << found.output;
  const json written = json::parse(run({"cat", evidence}).output, nullptr, false);
  EXPECT_EQ(written["devices"], (json{{{"name", "box"}, {"model", "simple2-r3"}, {"firmware", "1.40"}}}));
}

/// Two minutes of a host that polls in vain: long enough for a search to take seconds.
std::string many_reads(const std::string& last_reply) {
  std::string text;
  constexpr int kReads = 12'000;
  for (int i = 0; i < kReads; ++i) {
    const std::string time = std::to_string(1 + i / 100) + "." + std::to_string(100 + i % 100).substr(1);
    text += time + "0 in  line 01 03 00 01 00 01 D5 CA\n" + time + "9 out line " +
            (i + 1 < kReads ? "01 03 02 C0 01 29 84" : last_reply) + "\n";
  }
  return text;
}

TEST_F(Compare, ReportsHowFarASearchIsAndEndsItAtCtrlC) {
  const std::string evidence = folder_ / "evidence.json";
  const auto search = [&](const std::string& capture) {
    return Words{UNDERSTUDY_BINARY, "calibrate", capture, "--bench", plain_, "--power-up", "-o", evidence};
  };
  const Environment terminal{{"TERM", "xterm"}, {"CI", ""}};
  const std::string same = folder_.write("same.txt", many_reads("01 03 02 C0 01 29 84"));
  {
    AtTerminal calibrate(search(same), terminal);
    EXPECT_TRUE(calibrate.shows("\rtrying each option: ")) << calibrate.screen();
    // It is shown four times a second. By then, some choices have been tried.
    for (int shown = 0; shown < 8; ++shown)
      EXPECT_TRUE(calibrate.shows(" hypotheses, ")) << calibrate.screen();
    calibrate.type("\x03");
    EXPECT_TRUE(calibrate.shows("interrupted after ")) << calibrate.screen();
    EXPECT_TRUE(calibrate.shows("the other choices were not")) << calibrate.screen();
    EXPECT_TRUE(calibrate.shows("wrote " + evidence)) << calibrate.screen();
    EXPECT_EQ(calibrate.wait(kPatience), 1);
  }
  const std::string written = run({"cat", evidence}).output;
  const json some = json::parse(written, nullptr, false);
  EXPECT_EQ(some["interrupted"], true) << written;
  EXPECT_GE(some["choices"].size(), 1U);
  EXPECT_LT(some["choices"].size(), 126U);
  // What was measured before is not replaced by nothing.
  const std::string other = folder_.write("other.txt", many_reads("01 03 02 C0 02 69 85"));
  AtTerminal calibrate(search(other), terminal);
  EXPECT_TRUE(calibrate.shows("; explained 11999 of 12000 replies")) << calibrate.screen();
  calibrate.type("\x03");
  EXPECT_TRUE(calibrate.shows("no options were found that explain everything")) << calibrate.screen();
  EXPECT_TRUE(calibrate.shows(other + ":23999, at 120.99s: the bench's own options")) << calibrate.screen();
  EXPECT_EQ(calibrate.wait(kPatience), 1);
  EXPECT_EQ(run({"cat", evidence}).output, written);
}

TEST_F(Compare, ReportsHowFarItIsAndEndsAtCtrlC) {
  const std::string other = folder_.write("other.txt", many_reads("01 03 02 C0 02 69 85"));
  AtTerminal compare({UNDERSTUDY_BINARY, "compare", other, "--bench", plain_, "--power-up"},
                     {{"TERM", "xterm"}, {"CI", ""}});
  EXPECT_TRUE(compare.shows("they differ; trying other options: ")) << compare.screen();
  compare.type("\x03");
  EXPECT_TRUE(compare.shows("12000 exchanges: 11999 same, 1 different")) << compare.screen();
  EXPECT_TRUE(compare.shows("interrupted: ")) << compare.screen();
  EXPECT_TRUE(compare.shows("first difference: " + other + ":23999")) << compare.screen();
  EXPECT_EQ(compare.wait(kPatience), 1);
}

TEST_F(Compare, RefusesFramesOfModbusForALineOfText) {
  const std::string bench = folder_.write(
      "slim.yaml", "understudy: 1\nlines: { line: { stations: [ { name: motor, model: slim } ] } }\n");
  const std::string capture = folder_.write("reads.txt", three_reads("01 03 02 C0 01 29 84"));
  const std::string log = folder_.write("bytes.txt",
                                        "0.1 > 01\n0.2 > 03 00 01\n0.3 > 00 01 D5 CA\n0.4 < 01 03 02 C0 01\n"
                                        "0.5 > 0D\n0.6 < 29 84\n");
  for (const Words& words : {Words{"compare", capture}, Words{"calibrate", capture},
                             Words{"compare", log, "--pattern", "{time} {dir} {hex}"}}) {
    Words all = words;
    all.insert(all.end(), {"--bench", bench});
    const Finished finished = understudy(all);
    EXPECT_EQ(finished.exit_code, 2) << finished.output;
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
    const std::string what = words[1] == capture
                                 ? "reads.txt:1: is a frame of Modbus, but the line of the bench "
                                   "speaks text; expected a capture of that line"
                                 : "none of its 1 requests is a line of text";
    EXPECT_NE(finished.errors.find(what), std::string::npos) << finished.errors;
  }
}

TEST_F(Compare, FindsThatAnotherSlaveIsNoneOfOurs) {
  // libmodbus's debug output of a slave made with pymodbus.
  const std::string log = PROJECT_FOLDER "/tests/emulator/box/captures/other_slave.txt";
  const Finished other = understudy({"compare", log, "--bench", plain_, "--every", "50ms", "--power-up"});
  EXPECT_EQ(other.exit_code, 1) << other.errors;
  EXPECT_NE(other.output.find("read as debug output of libmodbus"), std::string::npos) << other.output;
  const Finished none = understudy({"calibrate", log, "--bench", plain_, "--every", "50ms", "--power-up"});
  EXPECT_EQ(none.exit_code, 1) << none.errors;
  EXPECT_NE(none.output.find("no options explain"), std::string::npos) << none.output;
}

TEST_F(Compare, ReportsDifferencesAsSarif) {
  const std::string capture = capture_of("version_encoding: bcd", 338);
  const Finished sarif =
      understudy({"compare", capture, "--bench", plain_, "--power-up", "--format", "sarif"});
  EXPECT_EQ(sarif.exit_code, 1) << sarif.errors;
  const json results = json::parse(sarif.output, nullptr, false)["runs"][0]["results"];
  ASSERT_EQ(results.size(), 1U) << sarif.output;
  EXPECT_NE(results[0]["message"]["text"].get<std::string>().find("bench: box.Version = 152"),
            std::string::npos);
}

TEST_F(Compare, WritesAReportOfAllCaptures) {
  const std::string other = capture_of("version_encoding: bcd", 338);
  const std::string page = folder_ / "report.html";
  const Finished finished = understudy({"compare", other, "--bench", plain_, "--power-up", "--report", page});
  EXPECT_EQ(finished.exit_code, 1) << finished.errors;
  const std::string text = run({"cat", page}).output;
  EXPECT_NE(text.find("<h1>1 of 1 captures differ</h1>"), std::string::npos) << text;
  EXPECT_NE(text.find("<td>box.Version = 338</td>"), std::string::npos) << text;
  EXPECT_NE(text.find("<td>box.Version = 152</td>"), std::string::npos) << text;
  EXPECT_NE(text.find("box.version_encoding: bcd ("), std::string::npos) << "its section: " << text;
  EXPECT_NE(text.find("<td>box.version_encoding: hundredths</td>"), std::string::npos) << text;
  EXPECT_NE(text.find("<td>box: STATUS 0 (0x0000), "), std::string::npos) << text;
  EXPECT_EQ(text.find("<script"), std::string::npos);
  const Finished refused = understudy({"compare", other, "--bench", plain_, "--power-up", "--report", other});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("is an input capture"), std::string::npos) << refused.errors;
}

/// Records a scenario in which an input changes, and that writes a register past the line at its end.
TEST_F(Compare, TakesARecordingAsACapture) {
  folder_.write("box.yaml", bench_with("version_encoding: bcd"));
  const std::string scenario =
      folder_.write("scenario.yaml",
                    "understudy: 1\nname: talk\nbench: box.yaml\nsteps:\n  - expect: { box.HW_Code: 49153 }\n"
                    "  - input: { box.DIN_10: on }\n  - advance: 100ms\n  - expect: { box.DIN_10: 1 }\n"
                    "  - expect: { box.Version: 338 }\n");
  const Finished run = understudy({"run", scenario, "--record", folder_ / "recordings"});
  ASSERT_EQ(run.exit_code, 0) << run.output << run.errors;
  const std::string recording = folder_ / "recordings/talk.jsonl";
  const Finished other = understudy({"compare", recording, "--bench", plain_, "--format", "json"});
  EXPECT_EQ(other.exit_code, 1) << other.output << other.errors;
  const json report = json::parse(other.output, nullptr, false)[0];
  EXPECT_EQ(report["same"], 2) << "the input moved, too: " << other.output;
  EXPECT_EQ(report["different"], 1) << other.output;
  EXPECT_EQ(report["agrees_with"], json{"box.version_encoding: bcd"});
  const std::string bcd = folder_.write("bcd.yaml", bench_with("version_encoding: bcd"));
  EXPECT_EQ(understudy({"compare", recording, "--bench", bcd}).exit_code, 0);
  const Finished options = understudy({"calibrate", recording, "--bench", plain_, "--choices"});
  EXPECT_EQ(options.output, "choices:  # of box\n  version_encoding: bcd\n") << options.errors;
}

TEST_F(Compare, DoesNotJudgeAfterADeviceChangedOtherwise) {
  folder_.write("box.yaml", bench_with(""));
  const std::string scenario =
      folder_.write("scenario.yaml",
                    "understudy: 1\nname: talk\nbench: box.yaml\nsteps:\n  - expect: { box.HW_Code: 49153 }\n"
                    "  - power: { box: cycle }\n  - advance: 5s\n  - expect: { box.Version: 152 }\n");
  const Finished run = understudy({"run", scenario, "--record", folder_ / "recordings"});
  ASSERT_EQ(run.exit_code, 0) << run.output << run.errors;
  const std::string other = folder_.write("bcd.yaml", bench_with("version_encoding: bcd"));
  const Finished judged =
      understudy({"compare", folder_ / "recordings/talk.jsonl", "--bench", other, "--format", "json"});
  EXPECT_EQ(judged.exit_code, 0) << judged.output << judged.errors;
  const json report = json::parse(judged.output, nullptr, false)[0];
  EXPECT_EQ(report["undecidable"], 1) << judged.output;
  EXPECT_NE(report["notes"].dump().find("from power at "), std::string::npos) << judged.output;
}

TEST_F(Compare, MovesInputsAsAFileSays) {
  // A scenario with an input gives the capture; the file repeats what it did.
  const std::string bench = folder_.write("box.yaml", bench_with(""));
  const std::string scenario = folder_.write("scenario.yaml",
                                             "understudy: 1\nname: talk\nbench: box.yaml\nsteps:\n  - "
                                             "advance: 100ms\n  - input: { box.DIN_10: on }\n"
                                             "  - advance: 100ms\n  - expect: { box.DIN_10: 1 }\n");
  const Finished run = understudy({"run", scenario, "--capture", folder_ / "captures"});
  ASSERT_EQ(run.exit_code, 0) << run.output << run.errors;
  const std::string capture = folder_ / "captures/talk.pcapng";
  const std::string inputs = folder_.write("inputs.txt", "# an input\n0.100 box.DIN_10 on\n");
  const std::string no_inputs = folder_.write("none.txt", "# none moves\n");
  EXPECT_EQ(
      understudy({"compare", capture, "--bench", plain_, "--power-up", "--inputs", no_inputs}).exit_code, 1);
  const Finished taken = understudy({"compare", capture, "--bench", plain_, "--power-up"});
  EXPECT_EQ(taken.exit_code, 0) << taken.output << taken.errors;
  EXPECT_EQ(taken.output, capture +
                              ": 1 exchanges: 1 undecidable\n"
                              "  the levels of inputs were taken from replies: box.DIN_10\n");
  const Finished same = understudy({"compare", capture, "--bench", plain_, "--power-up", "--inputs", inputs});
  EXPECT_EQ(same.exit_code, 0) << same.output << same.errors;
  for (const auto& [text, what] :
       {std::pair{"0.1 box.DIN_10 maybe\n", "inputs.txt:1: 'maybe' is not one level"},
        std::pair{"0.1 box.DIN_77 on\n", "inputs.txt:1: "},
        std::pair{"soon box.DIN_10 on\n", "does not begin with a time"},
        std::pair{"0.2 box.DIN_10 on\n0.1 box.DIN_10 off\n", "is before the last one"}}) {
    folder_.write("inputs.txt", text);
    const Finished refused = understudy({"compare", capture, "--bench", plain_, "--inputs", inputs});
    EXPECT_EQ(refused.exit_code, 2) << text;
    EXPECT_NE(refused.errors.find(what), std::string::npos) << refused.errors;
  }
}

TEST_F(Compare, IsNamedByCommandsThatAreGivenACapture) {
  const std::string captures = PROJECT_FOLDER "/tests/emulator/box/captures/";
  for (const std::string file : {"tcp.pcap", "socat.txt", "user.pcapng"}) {
    const Finished replay = understudy({"replay", captures + file});
    EXPECT_EQ(replay.exit_code, 2);
    EXPECT_NE(replay.errors.find("for `understudy compare`; expected a recording"), std::string::npos)
        << replay.errors;
    const Finished import =
        understudy({"import", captures + file, "--name", "box", "-o", folder_ / "box.yaml"});
    EXPECT_EQ(import.exit_code, 2);
    EXPECT_NE(import.errors.find("for `understudy compare`; expected a list of registers"), std::string::npos)
        << import.errors;
  }
}

TEST_F(Compare, RefusesWhatItCannotReadInOneLine) {
  const std::string text = folder_.write("text.txt", "0.1 in line 01 03\n0.2 out line zz\n");
  const std::string other_station = folder_.write("other.txt", "0.1 in line 07 03 00 01 00 02 95 AD\n");
  const std::string image = folder_.write(
      "slim.nv.json",
      "{\"understudy\": 1, \"kind\": \"nv-image\", \"model\": \"slim\", \"firmware\": \"1.00\", "
      "\"registers\": {}}");
  const struct {
    Words words;
    std::string what;
  } cases[] = {
      {{"compare", text, "--bench", plain_}, "text.txt:2: 'zz' is not a byte; expected a line"},
      {{"compare", other_station, "--bench", plain_},
       "all requests are to station 7, which is not on line 'line' of the bench; expected a capture of "
       "station 1"},
      {{"compare", text, "--bench", plain_, "--every", "soon"}, "is not an interval"},
      {{"compare", text, "--bench", plain_, "--format", "xml"}, "is not a format"},
      {{"compare", plain_, "--bench", plain_}, "capture: is a bench; expected a capture"},
      {{"compare", text, text, "--bench", plain_, "--follow"}, "--follow follows one capture"},
      {{"compare", folder_ / "none", "--bench", plain_}, "expected a capture"},
      {{"compare", text, "--bench", folder_ / "none"}, "none"},
      {{"compare", text, "--bench", plain_, "--line", "other"}, "the bench has no line called 'other'"},
      {{"compare", text, "--bench", plain_, "--tolerance", "much"}, "is not a duration"},
      {{"compare", text, "--bench", plain_, "--from", folder_ / "none"},
       "does not exist; expected an NV image"},
      {{"compare", text, "--bench", plain_, "--from", image}, "the line has no device of that model"},
      {{"calibrate", text, "--bench", plain_, "-o", plain_}, "is the bench itself"},
  };
  for (const auto& row : cases) {
    const Finished finished = understudy(row.words);
    EXPECT_EQ(finished.exit_code, 2) << row.what;
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
    EXPECT_NE(finished.errors.find(row.what), std::string::npos) << finished.errors;
  }
}

}  // namespace compare_test
}  // namespace understudy::acceptance
