// A trace compared with another observer of the same world, in both formats; and VCD as others read it.
#include "emulator/world/trace/trace.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "emulator/device/axes.h"
#include "emulator/play/plot/trace_table.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::world {
namespace trace_test {

/// Traces while a scenario runs.
class TracingObserver final : public play::Observer {
 public:
  TracingObserver(World& world, std::string& csv, std::string& vcd)
      : csv_(world, trace_signals(world, kAlso),
             csv_format([&csv](std::string_view lines) { csv += lines; })),
        vcd_(world, trace_signals(world, kAlso),
             vcd_format([&vcd](std::string_view lines) { vcd += lines; })) {}
  void world_restored(std::size_t) override {}
  void finish(play::ScenarioResult&) override {}
  static inline const std::vector<std::string> kAlso{"feeder.STATUS.4", "rs485.bytes_in"};

 private:
  Trace csv_;
  Trace vcd_;
};

/// Some values at the end of every tick.
class Witness final : public play::Observer, private TickWatcher {
 public:
  using Rows = std::vector<std::pair<Tick, std::vector<double>>>;
  static inline const std::vector<std::string> kNames{"feeder.A.position", "feeder.A.speed", "feeder.DIN_10",
                                                      "feeder.power", "rs485.bytes_in"};
  Witness(World& world, Rows& rows) : world_(world), rows_(rows) { world_.add_watcher(*this); }
  ~Witness() override { world_.remove_watcher(*this); }
  void world_restored(std::size_t) override {}
  void finish(play::ScenarioResult&) override {}

 private:
  void on_tick(Tick tick) override {
    const Device& device = world_.device(0);
    // By these names the inputs are registers, which read 0 without power.
    rows_.push_back(
        {tick,
         {static_cast<double>(world_.plant(0, 0).position_pulses()), device.axes()->speed_pps(0),
          device.powered() ? static_cast<double>(device.input(10)) : 0.0, device.powered() ? 1.0 : 0.0,
          static_cast<double>(world_.line(0).line.counters().bytes_in)}});
  }
  World& world_;
  Rows& rows_;
};

struct Traced {
  std::string csv;
  std::string vcd;
  Witness::Rows rows;
  SimTime end{0};
};

Traced traced() {
  Traced traced;
  play::RunOptions options;
  options.observers.push_back([&](World& world) -> std::unique_ptr<play::Observer> {
    return std::make_unique<TracingObserver>(world, traced.csv, traced.vcd);
  });
  options.observers.push_back([&](World& world) -> std::unique_ptr<play::Observer> {
    return std::make_unique<Witness>(world, traced.rows);
  });
  const std::string steps =
      play::kServoOn +
      "  - write: { feeder.Aaxis_Pulse: -1000, feeder.Aaxis_Speed: 200, feeder.Aaxis_AccTime: 5, "
      "feeder.Aaxis_DecTime: 5, feeder.Aaxis_Move_INC: 1 }\n"
      "  - advance: 40ms\n  - input: { feeder.DIN_10: on }\n  - advance: 500ms\n"
      "  - power: { feeder: off }\n  - advance: 100ms\n";
  const play::ScenarioResult result = play::played(steps, "", options);
  EXPECT_TRUE(play::has_passed(result)) << play::why(result);
  traced.end = result.steps.back().end;
  return traced;
}

void expect_equal(const play::TraceTable& table, const Traced& traced) {
  ASSERT_FALSE(table.ticks.empty());
  EXPECT_EQ(table.ticks.front(), 0);
  EXPECT_EQ(table.ticks.back(), tick_at(traced.end));
  EXPECT_LT(table.ticks.size(), traced.rows.size()) << "quiet ticks have no rows";
  for (std::size_t k = 0; k < Witness::kNames.size(); ++k) {
    const auto found = std::find(table.names.begin(), table.names.end(), Witness::kNames[k]);
    ASSERT_NE(found, table.names.end()) << Witness::kNames[k];
    const auto& column = table.columns[static_cast<std::size_t>(found - table.names.begin())];
    std::size_t row = 0;
    for (const auto& [tick, values] : traced.rows) {
      while (row + 1 < table.ticks.size() && table.ticks[row + 1] <= tick) ++row;
      ASSERT_EQ(column[row], values[k]) << Witness::kNames[k] << " at tick " << tick;
    }
  }
}

TEST(Trace, HasInCsvWhatHappened) {
  const Traced all = traced();
  expect_equal(play::parse_csv_trace(all.csv, "t.csv"), all);
}

TEST(Trace, HasInVcdWhatHappened) {
  const Traced all = traced();
  const play::TraceTable vcd = play::parse_vcd_trace(all.vcd, "t.vcd");
  expect_equal(vcd, all);
  EXPECT_EQ(vcd.names, play::parse_csv_trace(all.csv, "t.csv").names);
}

TEST(Trace, HasEachColumnOnceHoweverOftenItIsAskedFor) {
  play::Scenario scenario = play::scenario_of("  - advance: 1ms\n");
  const World world(scenario.bench, {}, {});
  const std::size_t usual = trace_signals(world, {}).size();
  EXPECT_EQ(trace_signals(world, {"feeder.Cord_A", "feeder.A.position", "feeder.power"}).size(), usual);
  EXPECT_EQ(trace_signals(world, {"feeder.Aaxis_Speed", "feeder.Aaxis_Speed"}).size(), usual + 1);
  EXPECT_THROW(trace_signals(world, {"feeder.Aaxis_Sped"}), NameError);
}

std::string output_of(const std::string& command) {
  std::string output;
  if (FILE* const pipe = popen((command + " 2>&1").c_str(), "r")) {
    for (int c = 0; (c = fgetc(pipe)) != EOF;) output += static_cast<char>(c);
    output += "exit " + std::to_string(pclose(pipe) >> 8);
  }
  return output;
}

/// Reads by IEEE 1364, 18.2, and prints the last value of each variable whose full name is given.
constexpr const char* kVcdReader = R"(
import sys
words = open(sys.argv[1]).read().split()
scopes, names, kinds, values, at, time = [], {}, {}, {}, 0, None
while words[at] != '$enddefinitions':
    end = words.index('$end', at)
    what = words[at + 1:end]
    if words[at] == '$timescale': assert ''.join(what) == '1ms', what
    elif words[at] == '$scope': scopes.append(what[1])
    elif words[at] == '$upscope': scopes.pop()
    elif words[at] == '$var':
        kind, size, code, name = what
        assert code not in kinds
        assert (kind, size) in (('wire', '1'), ('integer', '64'), ('real', '64')), what
        names['.'.join(scopes + [name])] = code
        kinds[code] = kind
    else: assert words[at] == '$version', words[at]
    at = end + 1
assert not scopes
at += 2
while at < len(words):
    word = words[at]
    if word[0] == '#':
        assert time is None or int(word[1:]) > time
        time = int(word[1:])
    elif word[0] in '01':
        assert kinds[word[1:]] == 'wire'
        values[word[1:]] = int(word[0])
    else:
        at += 1
        if word[0] == 'b':
            assert kinds[words[at]] == 'integer' and len(word) <= 65
            number = int(word[1:], 2)
            values[words[at]] = number - 2**64 if number >= 2**63 else number
        else:
            assert word[0] == 'r' and kinds[words[at]] == 'real'
            values[words[at]] = float(word[1:])
    at += 1
assert set(values) == set(kinds), 'a variable without a value'
print(time, *[values[names[name]] for name in sys.argv[2:]])
)";

class VcdFile : public testing::Test {
 protected:
  void SetUp() override {
    path_ = testing::TempDir() + "understudy" + std::to_string(getpid());
    std::ofstream(path_ + ".vcd") << traced().vcd;
  }
  void TearDown() override {
    for (const char* ending : {".vcd", ".py", ".fst", ".back.vcd"}) std::filesystem::remove(path_ + ending);
  }
  std::string read(const std::string& vcd) {
    std::ofstream(path_ + ".py") << kVcdReader;
    return output_of("python3 " + path_ + ".py " + vcd +
                     " feeder.A.position feeder.A.speed feeder.DIN_10 feeder.power feeder.STATUS.4");
  }
  std::string path_;
};

// Two requests of 8 and 21 characters with their replies take 29.286 ms, and then it is 640 ms.
TEST_F(VcdFile, IsReadByAnotherParser) { EXPECT_EQ(read(path_ + ".vcd"), "669 -1000 0.0 0 0 0\nexit 0"); }

TEST_F(VcdFile, IsTakenByGtkwavesTools) {
  if (std::system("command -v vcd2fst fst2vcd >/dev/null") != 0) GTEST_SKIP() << "GTKWave is not installed";
  const std::string converted = output_of("vcd2fst " + path_ + ".vcd " + path_ + ".fst");
  ASSERT_TRUE(converted.ends_with("exit 0")) << converted;
  const std::string back = output_of("fst2vcd -o " + path_ + ".back.vcd " + path_ + ".fst");
  ASSERT_TRUE(back.ends_with("exit 0")) << back;
  std::ifstream file(path_ + ".back.vcd");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  for (const char* name : {"position", "speed", "DIN_10", "STATUS.4"}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
  // -1000 in 64 bits is unchanged.
  EXPECT_NE(text.find("b1111111111111111111111111111111111111111111111111111110000011000"),
            std::string::npos);
}

}  // namespace trace_test
}  // namespace understudy::emulator::world
