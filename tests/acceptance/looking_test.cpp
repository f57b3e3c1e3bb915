// Reports, traces, plots and host checks, as scripts request them.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace looking_test {

constexpr const char* kScenario =
    "understudy: 1\nname: a move\n"
    "bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
    "steps:\n"
    "  - write: { Aaxis_SVON: 1 }\n"
    "  - write: { Aaxis_Pulse: 3200, Aaxis_Speed: 200, Aaxis_AccTime: 5, Aaxis_DecTime: 5, Aaxis_Move_INC: 1 "
    "}\n"
    "  - send: { bytes: 09 03 00 01 00 01 +crc, reply: nothing, within: 20ms }\n"
    "  - wait: { until: STATUS.4 == 0, within: 4s }\n"
    "  - expect: { Cord_A: 3200 }\n";
constexpr const char* kLintRules = "rs485: 1 request to station 9, which does not exist; first at ";

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Report, IsOnePageAboutAllScenarios) {
  const PrivateFolder folder;
  const std::string scenario = folder.write("move.yaml", kScenario);
  const Finished finished = understudy({"run", scenario, "--report", folder / "report.html"});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
  const std::string page = contents(folder / "report.html");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(page.find("<svg class=\"picture\""), std::string::npos);
  EXPECT_TRUE(page.ends_with("</html>\n"));
  // In real time as well.
  const Finished real = understudy({"run", scenario, "--real-time", "--report", folder / "real.html"});
  EXPECT_EQ(real.exit_code, 0) << real.output << real.errors;
  EXPECT_NE(contents(folder / "real.html").find("data-name=\"feeder.A.position\""), std::string::npos);
}

TEST(Report, ThatCannotBeWrittenIsReportedBeforeAnythingRuns) {
  const PrivateFolder folder;
  const std::string scenario = folder.write("move.yaml", kScenario);
  const Finished finished = understudy({"run", scenario, "--report", folder / "no/report.html"});
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_EQ(finished.output, "");
  EXPECT_EQ(finished.errors, "understudy: --report: " + (folder / "no/report.html") +
                                 " cannot be written: No such file or directory\n");
}

TEST(Lint, OfScenariosIsReportedAtTheEndAndInJunit) {
  const PrivateFolder folder;
  const std::string scenario = folder.write("move.yaml", kScenario);
  const Finished finished = understudy({"run", scenario, "--lint", "--junit", folder / "junit.xml"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_TRUE(finished.errors.starts_with("lint: " + scenario + ": a move: " + kLintRules))
      << finished.errors;
  EXPECT_EQ(lines_of(finished.errors).size(), 1U);
  const std::string junit = contents(folder / "junit.xml");
  EXPECT_NE(junit.find(std::string("lint: ") + kLintRules), std::string::npos) << junit;
  EXPECT_NE(junit.find("failures=\"0\""), std::string::npos);
  EXPECT_EQ(understudy({"run", scenario}).errors, "");
}

TEST(Lint, OfARunningBenchIsReportedWhenItEnds) {
  RunningUnderstudy running({"--lint"});
  const Finished asked =
      understudy({"poll", running.port(), "0x0001", "--station", "9", "--timeout", "100ms"});
  EXPECT_EQ(asked.exit_code, 1);
  EXPECT_EQ(understudy({"poll", running.port(), "0x0001"}).exit_code, 0);
  const std::string at_once =
      "understudy: line line: a host sends requests to station 9, which does not exist; the line has 1 "
      "(device)\n";
  EXPECT_EQ(running.errors(), at_once);
  EXPECT_EQ(running.stop(SIGTERM), 0);
  const std::string errors = running.errors();
  EXPECT_TRUE(
      errors.starts_with(at_once + "lint: line: 1 request to station 9, which does not exist; first at "))
      << errors;
  EXPECT_EQ(lines_of(errors).size(), 2U) << errors;
}

TEST(Lint, OfACommandIsReportedWhenItIsOver) {
  const PrivateFolder folder;
  const std::string bench = folder.write(
      "bench.yaml",
      "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  const Finished finished =
      understudy({"exec", bench, "--lint", "--", "sh", "-c",
                  std::string(UNDERSTUDY_BINARY) +
                      " poll $UNDERSTUDY_PORT 0x0001 --station 9 --timeout 100ms 2>/dev/null; true"});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.errors.find(std::string("\nlint: ") + kLintRules), std::string::npos) << finished.errors;
}

/// A trace of a short move.
std::string traced(const PrivateFolder& folder, const std::string& name) {
  RunningUnderstudy running({"--speed", "manual", "--timing", "instant", "--trace", folder / name,
                             "--trace-also", "Aaxis_Speed,STATUS.4"});
  EXPECT_EQ(running.ctl({"set", "Aaxis_SVON=1"}).exit_code, 0);
  EXPECT_EQ(running.ctl({"set", "Aaxis_Pulse=3200", "Aaxis_Speed=200", "Aaxis_AccTime=5"}).exit_code, 0);
  EXPECT_EQ(running.ctl({"set", "Aaxis_Move_INC=1"}).exit_code, 0);
  EXPECT_EQ(running.ctl({"advance", "1s"}).exit_code, 0);
  EXPECT_EQ(running.stop(SIGTERM), 0);
  return folder / name;
}

TEST(TraceFlag, WritesWhatMovedAndWhatWasAskedFor) {
  const PrivateFolder folder;
  const auto lines = lines_of(contents(traced(folder, "t.csv")));
  ASSERT_GT(lines.size(), 300U);  // 3200 pulses take 300 ms and a ramp
  EXPECT_TRUE(lines[0].starts_with("time_ms,device.A.pulses,device.A.speed,device.A.position,")) << lines[0];
  EXPECT_TRUE(lines[0].ends_with(",Aaxis_Speed,STATUS.4")) << lines[0];
  EXPECT_TRUE(lines.back().starts_with("1000,3200,0,3200,")) << lines.back();
  EXPECT_TRUE(lines.back().ends_with(",200,0")) << lines.back();
  EXPECT_TRUE(
      contents(traced(folder, "t.vcd")).starts_with("$version Understudy $end\n$timescale 1 ms $end\n"));
}

TEST(TraceFlag, RefusesWhatItCannotDo) {
  const PrivateFolder folder;
  const auto serve = [&](const Words& flags) {
    Words words{"serve", "--model", "simple2-r3", "--control", folder / "control"};
    words.insert(words.end(), flags.begin(), flags.end());
    return understudy(words);
  };
  const std::tuple<Words, int, std::string> kCases[] = {
      {{"--trace", "t.txt"},
       2,
       "understudy: --trace: t.txt: has an unknown format; expected FILE.csv or FILE.vcd\n"},
      {{"--trace-also", "Cord_A"},
       2,
       "understudy: --trace-also: has no effect without --trace; expected --trace FILE\n"},
      {{"--trace", folder / "t.csv", "--trace-also", "Cord_AA"},
       2,
       "understudy: --trace-also: device: no register is called 'Cord_AA'; the nearest is 'Cord_A'\n"},
  };
  for (const auto& [flags, code, errors] : kCases) {
    const Finished finished = serve(flags);
    EXPECT_EQ(finished.exit_code, code) << flags[0];
    EXPECT_EQ(finished.errors, errors);
    EXPECT_EQ(finished.output, "");
  }
  EXPECT_EQ(serve({"--trace", folder / "no/t.csv"}).exit_code, 3);
}

TEST(Plot, DrawsPngAndSvg) {
  const PrivateFolder folder;
  const std::string csv = traced(folder, "t.csv");
  const Finished png = understudy({"plot", csv});
  EXPECT_EQ(png.exit_code, 0) << png.errors;
  EXPECT_EQ(png.output, (folder / "t.png") + "\n");
  EXPECT_TRUE(contents(folder / "t.png").starts_with("\x89PNG\r\n"));
  const Finished svg =
      understudy({"plot", traced(folder, "t.vcd"), "-o", folder / "drawn.svg", "--also", "device.Cord_A"});
  EXPECT_EQ(svg.exit_code, 0) << svg.errors;
  const std::string drawn = contents(folder / "drawn.svg");
  EXPECT_NE(drawn.find("<svg"), std::string::npos);
  for (const char* text : {"device.A.position", "device.A.speed", "device.Cord_A", "simulated time [s]"}) {
    EXPECT_NE(drawn.find(text), std::string::npos) << text;
  }
}

TEST(Plot, ReportsErrorsInOneLine) {
  const PrivateFolder folder;
  const std::string csv = folder.write("t.csv", "time_ms,a.A.position\n0,1\n5,2\n");
  const std::string bad = folder.write("bad.csv", "time_ms,a\n0,x\n");
  const std::string text = folder.write("t.txt", "");
  const std::tuple<Words, int, std::string> kCases[] = {
      {{"plot", bad}, 2, bad + ":2: a: 'x' is not a number; expected one\n"},
      {{"plot", text}, 2, text + ": is not a trace; expected FILE.csv or FILE.vcd\n"},
      {{"plot", folder / "none.csv"},
       2,
       (folder / "none.csv") + ": cannot be read (No such file or directory); expected a trace\n"},
      {{"plot", csv, "-o", "p.pdf"},
       2,
       "understudy: --output: p.pdf: has an unknown format; expected FILE.png or FILE.svg\n"},
      {{"plot", csv, "-o", folder / "no/p.png"},
       3,
       "understudy: --output: " + (folder / "no/p.png") + " cannot be written: No such file or directory\n"},
  };
  for (const auto& [words, code, errors] : kCases) {
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, code) << errors;
    EXPECT_EQ(finished.errors, errors);
  }
  const Finished without = understudy({"plot", csv}, {{"PATH", folder.path()}});
  EXPECT_EQ(without.exit_code, 3);
  EXPECT_EQ(
      without.errors,
      "understudy: plot: gnuplot cannot be started (the Debian package is gnuplot-nox): No such file or "
      "directory\n");
}

/// The daemon's count of stalls that it left out of simulated time.
std::string slips_of(const RunningUnderstudy& daemon) {
  const std::string status = daemon.ctl({"--json", "status"}).output;
  const std::size_t at = status.find("\"slips\":");
  return at == std::string::npos ? status : status.substr(at, status.find_first_of(",}", at) - at);
}

TEST(Trace, OfAQuietChainLosesNoTime) {
  const PrivateFolder folder;
  const auto daemon =
      RunningUnderstudy::of_model("slim", {"--modules", "2", "--trace", folder / "quiet.csv"});
  Host host(daemon->port());
  const Bytes request = pty::hex("3F 50 45 0D");  // ?PE
  const Bytes reply = exchange(host, request, 3);
  EXPECT_EQ(reply.size(), 3u);
  std::this_thread::sleep_for(Wait(5'000));
  EXPECT_EQ(exchange(host, request, 3), reply);
  EXPECT_EQ(slips_of(*daemon), "\"slips\":0");
  EXPECT_EQ(daemon->errors().find("stalled"), std::string::npos) << daemon->errors();
}

TEST(RunJunit, GoesToStandardOutputAndTheRestMakesWay) {
  const PrivateFolder folder;
  folder.write("b.yaml",
               "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  const std::string scenario = folder.write(
      "s.yaml",
      "understudy: 1\nbench: b.yaml\nsteps: [ assert: feeder.Cord_A == 0, assert: feeder.DIN_1 == 1 ]\n");
  const Finished finished = understudy({"run", scenario, "--junit", "-"});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_TRUE(finished.output.starts_with("<?xml version=\"1.0\"")) << finished.output;
  EXPECT_TRUE(finished.output.ends_with("</testsuites>\n")) << finished.output;
  EXPECT_TRUE(finished.errors.starts_with("FAIL  " + scenario)) << finished.errors;
  EXPECT_TRUE(finished.errors.ends_with("0 passed, 1 failed; 0s simulated\n")) << finished.errors;
  EXPECT_FALSE(std::filesystem::exists("-"));
}

}  // namespace looking_test
}  // namespace understudy::acceptance
