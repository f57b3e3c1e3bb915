// Inspection afterwards: a replayed recording writes the trace, the capture and the page that the run would
// have written; and `run` writes traces and captures of everything it runs.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <set>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace drawn_recordings_test {

namespace fs = std::filesystem;

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(DrawnRecording, HasTheTraceAndCaptureOfTheDay) {
  const PrivateFolder folder;
  {
    RunningUnderstudy daemon({"--record", folder / "day.jsonl", "--trace", folder / "day.csv", "--trace-also",
                              "Aaxis_Speed,line.bytes_in", "--capture", folder / "day.pcapng"});
    ModbusHost host(daemon.port());
    EXPECT_TRUE(host.write(kAaxisSvon, 1));
    EXPECT_TRUE(host.write(kAaxisPulse, {3200, 0, 200, 1, 1, 1}));
    EXPECT_EQ(daemon.ctl({"input", "DIN_10=1"}).exit_code, 0);
    EXPECT_EQ(daemon.ctl({"inject", "stall", "device.A"}).exit_code, 0);
    EXPECT_EQ(daemon.ctl({"set", "Baxis_Speed=7", "Aaxis_Pulse=-70000"}).exit_code, 0);
    EXPECT_EQ(daemon.ctl({"power", "device", "off"}).exit_code, 0);
    EXPECT_TRUE(host.in_vain([](ModbusHost& asked) { return asked.read(kCordA); }).empty());
    EXPECT_EQ(daemon.stop(SIGTERM), 0);
  }
  const Finished finished = understudy({"replay", folder / "day.jsonl", "--trace", folder / "again.csv",
                                        "--trace-also", "Aaxis_Speed,line.bytes_in", "--capture",
                                        folder / "again.pcapng", "--report", folder / "again.html"});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
  EXPECT_GT(contents(folder / "day.csv").size(), 500U);
  EXPECT_TRUE(contents(folder / "again.csv") == contents(folder / "day.csv")) << "the traces differ";
  EXPECT_GT(contents(folder / "day.pcapng").size(), 300U);
  EXPECT_TRUE(contents(folder / "again.pcapng") == contents(folder / "day.pcapng")) << "the captures differ";
  const std::string page = contents(folder / "again.html");
  for (const char* text :
       {"aria-label=\"day.jsonl: motion and signals, from 0s to ", "data-name=\"device.A.position\"",
        "1 passed, 0 failed", "<code>write 0x1014 device.Aaxis_SVON = 1</code>",
        "<code>the recording begins</code>", "<code>a host opens line</code>",
        "<code>input device.DIN_10=1</code>", "<code>inject stall device.A</code>",
        "<code>set device.Baxis_Speed=7</code>", "<code>set device.Aaxis_Pulse=-70000</code>",
        "<code>power device off</code>"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

TEST(DrawnRecording, OfAFailedExecShowsTheMove) {
  const PrivateFolder folder;
  const std::string bench = folder.write(
      "bench.yaml",
      "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  const std::string poll = std::string(UNDERSTUDY_BINARY) + " poll $UNDERSTUDY_PORT --model simple2-r3 ";
  const Finished failed =
      understudy({"exec", bench, "--", "sh", "-c",
                  poll + "Aaxis_SVON=1 && " + poll +
                      "Aaxis_Speed=200 Aaxis_Pulse=320 Aaxis_Move_INC=1 && sleep 0.2; exit 5"});
  EXPECT_EQ(failed.exit_code, 5) << failed.errors;
  const std::string word = "understudy replay ";
  const std::size_t at = failed.errors.find(word);
  ASSERT_NE(at, std::string::npos) << failed.errors;
  const std::string recording = lines_of(failed.errors.substr(at + word.size())).at(0);
  const Finished drawn = understudy({"replay", recording, "--trace", folder / "t.vcd", "--capture",
                                     folder / "c.txt", "--report", folder / "r.html"});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.errors;
  EXPECT_TRUE(contents(folder / "t.vcd").starts_with("$version Understudy $end\n"));
  EXPECT_NE(contents(folder / "c.txt").find(" in  rs485 01 06 10 14 00 01"), std::string::npos)
      << contents(folder / "c.txt");
  EXPECT_NE(contents(folder / "r.html").find("data-name=\"feeder.A.position\""), std::string::npos);
  fs::remove_all(fs::path(recording).parent_path());
}

// --- traces and captures of whole runs ---------------------------------------------------------------

constexpr const char* kTwoCases =
    "understudy: 1\nname: \"move ${n}\"\n"
    "bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
    "cases: [ { n: 3200 }, { n: 6400 } ]\n"
    "steps:\n"
    "  - write: { Aaxis_SVON: 1 }\n"
    "  - snapshot: on\n"
    "  - write: { Aaxis_Pulse: \"${n}\", Aaxis_Speed: 200, Aaxis_AccTime: 5, Aaxis_DecTime: 5, "
    "Aaxis_Move_INC: 1 }\n"
    "  - fork: { well: [ advance: 1s ], pressed: [ input: { DIN_10: on }, advance: 2s ] }\n"
    "  - advance: 100ms\n"
    "  - restore: on\n"
    "  - advance: 50ms\n"
    "  - expect: { Cord_A: 0 }\n";

Words names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().stem().string());
  return {names.begin(), names.end()};
}

/// If time goes back, or a branch begins, the files start again, like recordings, which have the same
/// contents.
TEST(RunFiles, AreWhatTheRecordingsOfThePlaysWrite) {
  const PrivateFolder folder;
  const std::string cases = folder.write("cases.yaml", kTwoCases);
  const Finished finished = understudy({"run", cases, PROJECT_FOLDER "/scenarios/slim/pause_on_the_path.yaml",
                                        PROJECT_FOLDER "/scenarios/simple2-r3/line_faults/torn_frames.yaml",
                                        "--jobs", "4", "--trace", folder / "traces", "--capture",
                                        folder / "captures", "--record", folder / "recordings"});
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  const Words names = names_in(folder / "recordings");
  EXPECT_GE(names.size(), 8U);
  EXPECT_EQ(names_in(folder / "traces"), names);
  EXPECT_EQ(names_in(folder / "captures"), names);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Finished again = understudy({"replay", folder / ("recordings/" + name + ".jsonl"), "--trace",
                                       folder / "t.csv", "--capture", folder / "c.pcapng"});
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    EXPECT_TRUE(contents(folder / "t.csv") == contents(folder / ("traces/" + name + ".csv")));
    EXPECT_TRUE(contents(folder / "c.pcapng") == contents(folder / ("captures/" + name + ".pcapng")));
  }
}

TEST(RunFiles, OfPlaysThatFailAreThereToo) {
  const PrivateFolder folder;
  const std::string scenario = folder.write(
      "fails.yaml",
      "understudy: 1\nbench: { lines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
      "steps: [ advance: 10ms, expect: { Cord_A: 1 } ]\n");
  const Finished finished =
      understudy({"run", scenario, "--trace", folder / "all", "--capture", folder / "all", "--record",
                  folder / "all", "--trace-also", "feeder.Aaxis_Speed"});
  EXPECT_EQ(finished.exit_code, 1) << finished.errors;
  EXPECT_TRUE(lines_of(contents(folder / "all/fails.csv")).at(0).ends_with(",feeder.Aaxis_Speed"));
  EXPECT_TRUE(fs::exists(folder / "all/fails.pcapng"));
  EXPECT_TRUE(fs::exists(folder / "all/fails.jsonl"));
}

TEST(RunFiles, AreNotMadeUnlessAskedFor) {
  const PrivateFolder folder;
  const std::string scenario = folder.write("cases.yaml", kTwoCases);
  EXPECT_EQ(understudy({"run", scenario, "--trace", folder / "traces"}).exit_code, 0);
  EXPECT_EQ(names_in(folder.path()), (Words{"cases", "traces"}));
}

// --- refusals --------------------------------------------------------------------------------------

TEST(DrawnRecording, ThatDiffersIsShownAsFarAsItGoes) {
  const PrivateFolder folder;
  const std::string scenario = folder.write(
      "moves.yaml",
      "understudy: 1\nbench: { lines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
      "steps:\n  - advance: 100ms\n  - write: { Aaxis_SVON: 1 }\n  - expect: { HW_Code: 0xC001 }\n");
  EXPECT_EQ(understudy({"run", scenario, "--record", folder / "r"}).exit_code, 0);
  std::string text = contents(folder / "r/moves.jsonl");
  const std::size_t at = text.find("010302c0012984");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 14, "010302c0022985");
  const Finished finished = understudy({"replay", folder.write("other.jsonl", text), "--report",
                                        folder / "r.html", "--trace", folder / "t.csv"});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_NE(finished.errors.find(": differs: "), std::string::npos) << finished.errors;
  const std::string page = contents(folder / "r.html");
  EXPECT_NE(page.find("0 passed, 1 failed"), std::string::npos);
  EXPECT_NE(page.find("<b>differs: byte "), std::string::npos);
  EXPECT_GT(lines_of(contents(folder / "t.csv")).size(), 1U);
}

TEST(DrawnRecording, RefusesWhatItCannotDo) {
  const PrivateFolder folder;
  const std::string scenario = folder.write("cases.yaml", kTwoCases);
  EXPECT_EQ(understudy({"run", scenario, "--record", folder / "r"}).exit_code, 0);
  const std::string recording = folder / "r/move_3200_pressed.jsonl";
  const std::string before = contents(recording);
  const std::string csv = folder / "t.csv";
  const std::tuple<Words, int, std::string> kCases[] = {
      {{"replay", recording, "--report", recording},
       2,
       "--report: " + recording + ": is the recording itself; expected another path"},
      {{"replay", recording, "--capture", recording},
       2,
       "--capture: " + recording + ": is the recording itself; expected another path"},
      {{"replay", recording, "--trace", recording},
       2,
       "--trace: " + recording + ": has an unknown format; expected FILE.csv or FILE.vcd"},
      {{"replay", recording, "--trace", csv, "--capture", csv},
       2,
       "--trace: " + csv + ": is what --capture writes; expected another path"},
      {{"replay", recording, "--trace", csv, "--report", csv},
       2,
       "--report: " + csv + ": is what --trace writes; expected another path"},
      {{"replay", recording, "--capture", folder / "c.pcap"},
       2,
       "--capture: " + (folder / "c.pcap") +
           ": this old format is not supported; expected .pcapng, or another ending for a text log"},
      {{"replay", recording, "--trace-also", "Cord_A"},
       2,
       "--trace-also: has no effect without --trace; expected --trace FILE"},
      {{"replay", recording, "--trace", csv, "--trace-also", "Cord_AA"},
       2,
       "--trace-also: feeder: no register is called 'Cord_AA'; the nearest is 'Cord_A'"},
      {{"run", scenario, "--trace", csv},
       2,
       "--trace: " + csv + ": is a file name; expected a folder, for one file per scenario"},
      {{"run", scenario, "--capture", folder / "c.pcapng"},
       2,
       "--capture: " + (folder / "c.pcapng") +
           ": is a file name; expected a folder, for one file per scenario"},
      {{"run", scenario, "--trace-also", "Cord_A"},
       2,
       "--trace-also: has no effect without --trace; expected --trace DIR"},
      {{"run", scenario, "--trace", folder / "t", "--trace-also", "Cord_AA"},
       2,
       "--trace-also: " + scenario + ": feeder: no register is called 'Cord_AA'; the nearest is 'Cord_A'"},
      {{"run", scenario, "--trace", folder / "t", "--junit", folder / "t/x.csv"},
       2,
       "--trace: " + (folder / "t") + ": holds x.csv, which is what --junit writes; expected another folder"},
      {{"run", scenario, "--capture", scenario + "/in"},
       3,
       "--capture: " + scenario + "/in cannot be written: Not a directory"},
  };
  for (const auto& [words, code, errors] : kCases) {
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, code) << errors;
    EXPECT_EQ(finished.errors, "understudy: " + errors + "\n");
    EXPECT_EQ(finished.output, "");
  }
  EXPECT_EQ(contents(recording), before);
  EXPECT_EQ(names_in(folder.path()), (Words{"cases", "r"}));
}

}  // namespace drawn_recordings_test
}  // namespace understudy::acceptance
