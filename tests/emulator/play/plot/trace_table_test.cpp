// Errors in a trace are reported with their line; and the contents of a plot are correct.
#include "emulator/play/plot/trace_table.h"

#include <gtest/gtest.h>

#include "emulator/play/plot/plot_script.h"

namespace understudy::emulator::play {
namespace trace_table_test {

template <typename Act>
std::string diagnostic_of(Act act) {
  try {
    act();
  } catch (const FileError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(TraceTable, CsvIsReadByColumns) {
  const TraceTable table = parse_csv_trace("time_ms,a,b.c\r\n0,1,2.5\n10,-3,1e3\n", "t.csv");
  EXPECT_EQ(table.names, (std::vector<std::string>{"a", "b.c"}));
  EXPECT_EQ(table.ticks, (std::vector<Tick>{0, 10}));
  EXPECT_EQ(table.columns, (std::vector<std::vector<double>>{{1, -3}, {2.5, 1000}}));
}

TEST(TraceTable, CsvErrorsHaveTheirLine) {
  const std::pair<const char*, const char*> kCases[] = {
      {"", "t.csv:1: is not a trace; expected a first line that begins with time_ms"},
      {"time,a\n", "t.csv:1: is not a trace; expected a first line that begins with time_ms"},
      {"time_ms,a\n0,1\nx,2\n", "t.csv:3: time_ms: 'x' is not a time; expected whole milliseconds"},
      {"time_ms,a\n5,1\n5,2\n",
       "t.csv:3: time_ms: '5' is not later than the previous time; expected ascending times"},
      {"time_ms,a,b\n0,1\n", "t.csv:2: has 1 values; expected 2"},
      {"time_ms,a\n0,1,2\n", "t.csv:2: has too many values; expected 1"},
      {"time_ms,a\n0,one\n", "t.csv:2: a: 'one' is not a number; expected one"},
      {"time_ms,a,b\n0,,1\n", "t.csv:2: a: '' is not a number; expected one"},
  };
  for (const auto& [text, expected] : kCases) {
    EXPECT_EQ(diagnostic_of([&, csv = text] { parse_csv_trace(csv, "t.csv"); }), expected) << text;
  }
}

constexpr const char* kHead =
    "$timescale 1 ms $end\n$scope module m $end\n$var wire 1 ! a $end\n"
    "$var integer 64 \" b $end\n$upscope $end\n$enddefinitions $end\n";

TEST(TraceTable, VcdKeepsValuesUntilTheyChange) {
  const TraceTable table =
      parse_vcd_trace(std::string(kHead) + "#0\n$dumpvars\n0!\nb101 \"\n$end\n#4\n1!\n#9\n", "t.vcd");
  EXPECT_EQ(table.names, (std::vector<std::string>{"m.a", "m.b"}));
  EXPECT_EQ(table.ticks, (std::vector<Tick>{0, 4, 9}));
  EXPECT_EQ(table.columns, (std::vector<std::vector<double>>{{0, 1, 1}, {5, 5, 5}}));
}

TEST(TraceTable, VcdErrorsHaveTheirLine) {
  const std::string head = kHead;
  const std::pair<std::string, const char*> kCases[] = {
      {"", "t.vcd:1: ends within its header; expected $enddefinitions"},
      {"hello", "t.vcd:1: 'hello' is not a declaration; expected one such as $var"},
      {"$timescale 1 us $end\n", "t.vcd:1: $timescale: is '1us'; expected 1 ms"},
      {"$scope module", "t.vcd:1: ends within a declaration; expected $end"},
      {head + "0!\n", "t.vcd:7: '0!' comes before any time; expected a time such as #0 first"},
      {head + "#x\n", "t.vcd:7: '#x' is not a time; expected one such as #250"},
      {head + "#5\n#5\n", "t.vcd:8: '#5' is not later than the previous time"},
      {head + "#0\n1?\n", "t.vcd:8: '?' is not a variable's code; expected a declared one"},
      {head + "#0\nb12 \"\n", "t.vcd:8: 'b12' is not a value; expected one such as 1, b101 or r2.5"},
  };
  for (const auto& [text, expected] : kCases) {
    EXPECT_EQ(diagnostic_of([&, vcd = text] { parse_vcd_trace(vcd, "t.vcd"); }), expected) << text;
  }
}

TEST(PlotScript, HasAPanelForEachKindOfThing) {
  const TraceTable table{
      .names = {"f.A.pulses", "f.A.speed", "f.A.position", "f.B.position", "f.DIN_1", "f.MODE"},
      .ticks = {0, 100},
      .columns = {{0, 50}, {0, 500}, {7, 57}, {3, 3}, {0, 1}, {4, 9}}};
  const std::string script =
      plot_script(table, std::vector<std::string>{}, PlotFormat::png, "it's.png", "t.csv");
  EXPECT_NE(script.find("set output 'it''s.png'"), std::string::npos);
  EXPECT_NE(script.find("title 'f.A.position' with lines"), std::string::npos);
  EXPECT_NE(script.find("title 'f.A.speed' with lines"), std::string::npos);
  EXPECT_NE(script.find("set ytics ('f.DIN_1' 0.5)"), std::string::npos);
  // It stays at 0 until the tick before the change.
  EXPECT_NE(script.find("$c4 << END\n0 0\n0.099 0\n0.1 1\nEND\n"), std::string::npos);
  // Pulses that the machine followed, values that did not change, and columns that nobody requested.
  for (const char* name : {"'f.A.pulses'", "'f.B.position'", "'f.MODE'"}) {
    EXPECT_EQ(script.find(name), std::string::npos) << name;
  }
  EXPECT_NE(
      plot_script(table, std::vector<std::string>{"f.MODE"}, PlotFormat::svg, "p", "t").find("'f.MODE'"),
      std::string::npos);
}

TEST(PlotScript, RefusesWhatCannotBeDrawn) {
  const TraceTable still{.names = {"f.A.position"}, .ticks = {0, 1}, .columns = {{5, 5}}};
  const auto script = [&](std::vector<std::string> also) {
    return diagnostic_of([&] { plot_script(still, also, PlotFormat::png, "p", "t.csv"); });
  };
  EXPECT_EQ(script({}), "t.csv: none of its values change; expected at least one that does");
  EXPECT_EQ(script({"f.A.positon"}),
            "t.csv: no column is called 'f.A.positon'; the nearest is 'f.A.position'");
  EXPECT_EQ(script({"f.A.position"}), "nothing");
}

}  // namespace trace_table_test
}  // namespace understudy::emulator::play
