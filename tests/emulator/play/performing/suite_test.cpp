// Which scenarios are played, on how many threads, and that it makes no difference.
#include "emulator/play/performing/suite.h"

#include <atomic>
#include <set>

#include "emulator/play/results/junit.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace suite_test {

std::vector<Scenario> named(const std::vector<std::string>& names) {
  std::vector<Scenario> scenarios;
  for (const std::string& name : names) {
    Scenario& scenario = scenarios.emplace_back();
    scenario.name = name;
    scenario.file = "test.yaml";
  }
  return scenarios;
}

std::vector<std::string> names_of(const std::vector<Scenario>& scenarios) {
  std::vector<std::string> names;
  for (const Scenario& scenario : scenarios) names.push_back(scenario.name);
  return names;
}

TEST(Suite, ShardsAreWrittenAsPartOfHowMany) {
  struct Case {
    const char* text;
    std::size_t number;  // 0: refused
    std::size_t of;
  };
  const std::vector<Case> cases = {{"1/1", 1, 1}, {"2/4", 2, 4},  {"4/4", 4, 4},   {"5/4", 0, 0},
                                   {"0/4", 0, 0}, {"-1/4", 0, 0}, {"1", 0, 0},     {"/4", 0, 0},
                                   {"1/", 0, 0},  {"", 0, 0},     {"1/2/3", 0, 0}, {"a/b", 0, 0},
                                   {"1/0", 0, 0}};
  for (const Case& c : cases) {
    const auto shard = parse_shard(c.text);
    EXPECT_EQ(shard.has_value(), c.number != 0) << c.text;
    if (!shard) continue;
    EXPECT_EQ(shard->number, c.number) << c.text;
    EXPECT_EQ(shard->of, c.of) << c.text;
  }
}

TEST(Suite, PatternsAndShardsChooseInOrder) {
  const std::vector<std::string> all = {"a move", "home from anywhere", "a long move", "EEPROM busy",
                                        "move (n=1)"};
  struct Case {
    const char* pattern;
    Shard shard;
    std::vector<std::string> chosen;
  };
  const std::vector<Case> cases = {
      {"", {1, 1}, all},
      {"*", {1, 1}, all},
      {"*move*", {1, 1}, {"a move", "a long move", "move (n=1)"}},
      {"a*", {1, 1}, {"a move", "a long move"}},
      {"a move", {1, 1}, {"a move"}},
      {"? move", {1, 1}, {"a move"}},
      {"[Eh]*", {1, 1}, {"home from anywhere", "EEPROM busy"}},
      {"nothing", {1, 1}, {}},
      {"", {1, 2}, {"a move", "a long move", "move (n=1)"}},
      {"", {2, 2}, {"home from anywhere", "EEPROM busy"}},
      {"*move*", {2, 2}, {"a long move"}},
      {"", {5, 7}, {"move (n=1)"}},
      {"", {7, 7}, {}},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(names_of(choose(named(all), c.pattern, c.shard)), c.chosen) << c.pattern << c.shard.number;
  }
}

TEST(Suite, EveryScenarioIsInExactlyOneShard) {
  std::vector<std::string> all;
  for (int i = 0; i < 23; ++i) all.push_back(std::to_string(i));
  for (std::size_t of = 1; of < 30; ++of) {
    std::multiset<std::string> seen;
    for (std::size_t number = 1; number <= of; ++number) {
      for (const std::string& name : names_of(choose(named(all), "", {number, of}))) seen.insert(name);
    }
    EXPECT_EQ(seen, std::multiset<std::string>(all.begin(), all.end())) << of;
  }
}

/// Moves of different lengths, every third of which fails, and one with branches.
std::vector<Scenario> many() {
  std::vector<Scenario> scenarios;
  for (int i = 0; i < 24; ++i) {
    const std::string pulses = std::to_string(200 * (24 - i));
    scenarios.push_back(scenario_of(kServoOn + "  - write: { feeder.Aaxis_Pulse: " + pulses +
                                    ", feeder.Aaxis_Speed: 200, feeder.Aaxis_AccTime: 5, "
                                    "feeder.Aaxis_DecTime: 5, feeder.Aaxis_Move_INC: 1 }\n"
                                    "  - wait: { until: feeder.STATUS.4 == 0, within: 4s }\n"
                                    "  - fork: { on: [ advance: 1s ] }\n"
                                    "  - expect: { feeder.Cord_A: " +
                                    (i % 3 == 0 ? "1" : pulses) + " }\n"));
    scenarios.back().name = "move " + std::to_string(i);
  }
  return scenarios;
}

std::string told(const std::vector<Scenario>& scenarios, int jobs) {
  std::vector<ScenarioResult> all;
  std::string text;
  const auto options_for = [](const Scenario&) { return RunOptions{.with_hash = true}; };
  run_suite(scenarios, options_for, jobs, [&](const std::vector<ScenarioResult>& results) {
    for (const ScenarioResult& result : results) {
      text += verdict_line(result) + " " + std::to_string(result.outcome_hash) + "\n" + why(result);
      all.push_back(result);
    }
  });
  return text + junit_text(all) + summary_line(all);
}

TEST(Suite, OneJobAndEightTellTheSameInTheSameOrder) {
  const auto scenarios = many();
  const std::string of_one = told(scenarios, 1);
  EXPECT_NE(of_one.find("40 passed, 8 failed; "), std::string::npos) << of_one;
  EXPECT_LT(of_one.find("move 0"), of_one.find("move 1"));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(told(scenarios, 8), of_one);
}

TEST(Suite, WithoutScenariosNothingIsTold) {
  EXPECT_EQ(told({}, 8), junit_text({}) + "0 passed, 0 failed; 0s simulated");
}

TEST(Suite, ThatNoStageCanBeHadIsThrownAfterWhatCameBefore) {
  const auto scenarios = many();
  std::atomic<int> made = 0;
  const RunOptions options{.make_stage = [&](const Scenario& scenario) -> std::unique_ptr<Stage> {
    ++made;
    if (scenario.name == "move 5") throw std::runtime_error("no port is free");
    return make_free_stage(scenario);
  }};
  std::vector<std::string> names;
  const auto tell = [&](const std::vector<ScenarioResult>& results) {
    names.push_back(results.front().name);
  };
  try {
    run_suite(
        scenarios, [&](const Scenario&) { return options; }, 4, tell);
    ADD_FAILURE() << "expected it to throw";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no port is free");
  }
  EXPECT_EQ(names, (std::vector<std::string>{"move 0", "move 1", "move 2", "move 3", "move 4"}));
  EXPECT_LT(made, 48);  // the rest is not played
}

}  // namespace suite_test
}  // namespace understudy::emulator::play
