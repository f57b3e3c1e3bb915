// Fake boxes: a Simple2-R3 with hidden options is asked, and calibrate() must find them from the capture.
#include "emulator/box/calibrate/calibration.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

#include "emulator/box/compare/comparison.h"
#include "tests/emulator/box/fake_box.h"

namespace understudy::emulator::box {
namespace calibration_test {

/// Choices that the requests below exercise, with another option than the default.
const std::vector<std::pair<std::string, std::string>> kHidden = {
    {"version_encoding", "bcd"},
    {"unmapped_addresses", "zero_and_ignored"},
    {"write_to_read_only", "ignored"},
    {"write_out_of_range", "clamped"},
    {"read_of_write_only", "exception_02"},
    {"trigger_read_back", "zero"},
    {"password_read_back", "zero"},
    {"first_password", "65535"},
};

/// What a host may have sent: reads of many registers, refused requests, a move.
Requests requests() {
  const auto read = [](int address, int count) {
    return frame({1, 3, static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address), 0,
                  static_cast<std::uint8_t>(count)});
  };
  const auto write = [](int address, int value) {
    return frame({1, 6, static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address),
                  static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)});
  };
  return {read(0x0001, 2),  read(0x0000, 1),    read(0x0003, 1),  // nothing is at 3
          write(0x0001, 5), read(0x0001, 1),    write(0x1003, 3001),
          read(0x1003, 1),  write(0x1003, 250), read(0x1003, 1),
          read(0x100C, 1),  read(0xFF07, 1),    read(0xFF09, 1),
          write(0x1014, 1), write(0x1002, 60),  frame({1, 16, 0x10, 0, 0, 2, 4, 0x0C, 0x80, 0, 0}),
          write(0x1005, 1), read(0x1005, 1),    read(0x0000, 1),
          read(0x0E00, 2)};
}

std::string describe(const world::Bench& bench, const Hypothesis& hypothesis) {
  std::string text;
  for (const auto& [key, option] : hypothesis)
    text += choice_id(bench, key) + ": " + option_name(bench, key, option) + " ";
  return text;
}

/// UNDERSTUDY_FAKE_BOXES=500 tries so many.
std::size_t boxes() {
  const char* const given = std::getenv("UNDERSTUDY_FAKE_BOXES");
  return given != nullptr ? std::stoul(given) : kHidden.size();
}

TEST(Calibration, FindsOneToEightHiddenOptionsAndNoneWrong) {
  const world::Bench plain = bench_of("simple2-r3");
  const CalibrateSettings settings{.compare = {.from_power_up = true}, .threads = 1};
  std::mt19937 random(40);
  std::size_t hidden = 0;
  std::size_t found = 0;
  for (std::size_t box = 0; box < boxes(); ++box) {
    const std::size_t count = 1 + box % kHidden.size();
    auto shuffled = kHidden;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    const Options options(shuffled.begin(), shuffled.begin() + static_cast<std::ptrdiff_t>(count));
    const Capture capture = FakeBox::captured(bench_of("simple2-r3", options), requests());
    const Calibration calibration = calibrate(plain, {capture}, settings, {});
    ASSERT_TRUE(calibration.explains)
        << count << " hidden; the furthest is " << describe(plain, calibration.explanations.front());
    for (const RowFinding& finding : calibration.findings) {
      const std::string id = choice_id(plain, finding.key);
      const auto truth = options.find(id);
      const std::string own = option_name(plain, finding.key, finding.before);
      const std::string expected = truth != options.end() ? truth->second : own;
      std::set<std::string> remaining;
      for (const std::uint8_t option : finding.remaining)
        remaining.insert(option_name(plain, finding.key, option));
      EXPECT_TRUE(remaining.contains(expected)) << id << " of " << count << " hidden";
      if (truth == options.end()) continue;
      // An option that no reply shows stays undecided, which is honest.
      if (finding.state == RowFinding::State::not_exercised) continue;
      ++hidden;
      if (finding.state == RowFinding::State::measured) ++found;
    }
  }
  RecordProperty("hidden_and_exercised", std::to_string(hidden));
  RecordProperty("found", std::to_string(found));
  EXPECT_GE(found * 100, hidden * 95) << found << " of " << hidden;
  EXPECT_GE(found, 20U);
}

TEST(Calibration, LeavesAnEqualBenchAsItIs) {
  const world::Bench plain = bench_of("simple2-r3");
  const Capture capture = FakeBox::captured(plain, requests());
  const CalibrateSettings settings{.compare = {.from_power_up = true}, .threads = 1};
  const Calibration calibration = calibrate(plain, {capture}, settings, {});
  EXPECT_TRUE(calibration.explains);
  EXPECT_EQ(describe(plain, calibration.explanations.front()), "");
  for (const RowFinding& finding : calibration.findings)
    EXPECT_TRUE(finding.remaining.contains(finding.before)) << choice_id(plain, finding.key);
}

TEST(Calibration, SaysThatNothingExplainsAnotherDevice) {
  Capture capture = FakeBox::captured(bench_of("simple2-r3"), requests());
  capture.exchanges[4].reply = frame({1, 3, 2, 0x12, 0x34});  // another hardware code
  const CalibrateSettings settings{.compare = {.from_power_up = true}, .threads = 1};
  capture.exchanges.resize(6);
  const Calibration calibration = calibrate(bench_of("simple2-r3"), {capture}, settings, {});
  EXPECT_FALSE(calibration.explains);
  EXPECT_EQ(calibration.exchange, 4U);
}

TEST(Calibration, NamesTheOptionThatRemediesADifference) {
  const world::Bench plain = bench_of("simple2-r3");
  const Capture capture =
      FakeBox::captured(bench_of("simple2-r3", {{"version_encoding", "bcd"}}), requests());
  const CompareSettings settings{.from_power_up = true};
  const Comparison comparison = compare(plain, capture, settings, Extent::whole);
  ASSERT_EQ(comparison.first_difference, 0U);
  EXPECT_EQ(comparison.judgements[0].box, "box.HW_Code = 49153, Version = 338");
  EXPECT_EQ(comparison.judgements[0].bench, "box.HW_Code = 49153, Version = 152");
  const auto good = remedies(plain, capture, 0, {.compare = settings, .threads = 1});
  ASSERT_EQ(good.size(), 1U);
  EXPECT_EQ(describe(plain, good.front()), "version_encoding: bcd ");
}

TEST(Calibration, KeepsWhatIsCertainWhenItIsInterrupted) {
  const world::Bench plain = bench_of("simple2-r3");
  const Capture capture =
      FakeBox::captured(bench_of("simple2-r3", {{"version_encoding", "bcd"}}), requests());
  const CalibrateSettings settings{.compare = {.from_power_up = true}, .threads = 1};
  const Calibration whole = calibrate(plain, {capture}, settings);
  ASSERT_TRUE(whole.explains);
  std::set<std::size_t> counts;  // of findings
  for (const std::size_t polls : {0U, 1U, 100U, 500U, 700U, 800U, 1'000'000U}) {
    std::size_t polled = 0;
    const Calibration part =
        calibrate(plain, {capture}, settings, {.is_over = [&] { return polled++ >= polls; }});
    EXPECT_EQ(part.is_interrupted, part.findings.size() < whole.findings.size()) << polls;
    EXPECT_LE(part.tried, whole.tried);
    ASSERT_LE(part.findings.size(), whole.findings.size());
    ASSERT_EQ(part.explanations.size(), 1U);
    EXPECT_EQ(describe(plain, part.explanations.front()), part.explains ? "version_encoding: bcd " : "")
        << polls;
    for (std::size_t i = 0; i < part.findings.size(); ++i) {
      EXPECT_EQ(part.findings[i].key, whole.findings[i].key);
      EXPECT_EQ(part.findings[i].state, whole.findings[i].state);
      EXPECT_EQ(part.findings[i].remaining, whole.findings[i].remaining);
    }
    counts.insert(part.findings.size());
  }
  EXPECT_GE(counts.size(), 3U) << "none, some and all of them";
}

TEST(Calibration, TellsHowFarItIs) {
  Capture capture = FakeBox::captured(bench_of("simple2-r3", {{"version_encoding", "bcd"}}), requests());
  const CalibrateSettings settings{.compare = {.from_power_up = true}, .threads = 1};
  CalibrateTally tally;
  const Calibration found = calibrate(bench_of("simple2-r3"), {capture}, settings, {.tally = &tally});
  EXPECT_EQ(tally.tried, found.tried);
  EXPECT_EQ(tally.planned, found.tried);
  EXPECT_EQ(tally.explained, capture.exchanges.size());
  EXPECT_EQ(tally.captures, 1U);
  EXPECT_EQ(tally.phase, CalibrateTally::Phase::trying_each);
  capture.exchanges[4].reply = frame({1, 3, 2, 0x12, 0x34});  // nothing explains that
  capture.exchanges.resize(6);
  CalibrateTally furthest;
  calibrate(bench_of("simple2-r3"), {capture}, settings, {.tally = &furthest});
  EXPECT_EQ(furthest.explained, 4U);
  EXPECT_EQ(furthest.captures, 0U);
}

TEST(Comparison, NamesTheChoicesThatWereAskedBeforeADifference) {
  const world::Bench plain = bench_of("simple2-r3");
  // The map of registers is made with these once, so requests do not ask for them.
  const std::set<std::string> kept{"unmapped_addresses", "write_to_read_only", "write_out_of_range",
                                   "read_of_write_only"};
  for (const auto& [hidden, option] : kHidden) {
    const Capture capture = FakeBox::captured(bench_of("simple2-r3", {{hidden, option}}), requests());
    const Comparison comparison = compare(plain, capture, {.from_power_up = true}, Extent::whole);
    // No reply of these requests shows a password.
    EXPECT_EQ(comparison.first_difference.has_value(),
              std::string(hidden).find("password") == std::string::npos)
        << hidden;
    if (!comparison.first_difference) continue;
    std::set<std::string> asked;
    std::set<std::string> at_start;
    for (std::size_t i = 0; i < comparison.judgements.size(); ++i) {
      const auto& around = comparison.judgements[i].around;
      ASSERT_EQ(around != nullptr, i == *comparison.first_difference) << hidden << ", exchange " << i;
      if (!around) continue;
      EXPECT_TRUE(around->state.front().starts_with("box: STATUS ")) << around->state.front();
      for (const AskedChoice& one : around->asked) {
        if (one.is_since_agreement) asked.insert(one.choice);
        if (one.place == 0) at_start.insert(one.choice);
        EXPECT_NE(one.choice + ": " + one.option, "box." + hidden + ": " + option) << "of the bench";
      }
    }
    EXPECT_EQ(asked.contains("box." + hidden), !kept.contains(hidden)) << hidden;
    EXPECT_EQ(at_start.contains("box." + hidden), kept.contains(hidden)) << hidden;
    EXPECT_EQ(asked.contains("box.first_password"), hidden == "first_password") << hidden;
  }
}

TEST(Comparison, TakesInputsFromWhatRepliesShow) {
  const struct {
    std::string model, input;
    std::vector<std::uint8_t> read;
  } cases[] = {
      {"simple2-r3", "DIN_10", frame({1, 3, 0x0D, 0x1A, 0, 1})},
      {"simple2-r3", "DIN_10", frame({1, 3, 0x0D, 0x10, 0, 11})},
      {"super-40nc", "X5", frame({0, 2, 0, 0, 0, 20})},
  };
  using enum Verdict;
  for (const auto& row : cases) {
    world::Bench held = bench_of(row.model);
    const auto terminals = held.devices.front().model->terminals;
    const auto input = std::ranges::find(terminals, row.input, &TerminalRow::name);
    ASSERT_NE(input, terminals.end());
    held.inputs.push_back({.device = 0, .terminal = static_cast<int>(input - terminals.begin()), .level = 1});
    Capture capture = FakeBox::captured(held, {row.read, row.read}, std::chrono::seconds(5));
    Capture released = FakeBox::captured(bench_of(row.model), {row.read, row.read}, std::chrono::seconds(6));
    capture.exchanges.insert(capture.exchanges.end(), released.exchanges.begin(), released.exchanges.end());
    const auto verdicts = [&](bool knows_inputs) {
      std::vector<Verdict> all;
      const CompareSettings settings{.from_power_up = true, .knows_inputs = knows_inputs};
      for (const Judgement& one : compare(bench_of(row.model), capture, settings, Extent::whole).judgements)
        all.push_back(one.verdict);
      return all;
    };
    EXPECT_EQ(verdicts(false), (std::vector{undecidable, same, undecidable, same})) << row.model;
    EXPECT_EQ(verdicts(true), (std::vector{different, different, same, same})) << row.model;
  }
}

TEST(Comparison, LeavesInputsToTheMachineOfTheBench) {
  const auto bench = [](int home) {
    return world::parse_bench(
        models::all_models(),
        "understudy: 1\nlines: { line: { stations: [ { name: box, model: simple2-r3 } ] } }\n"
        "plant: { box.A: { home: { at: " +
            std::to_string(home) + ", width: 200 } } }\n",
        "bench.yaml", ".");
  };
  const auto read = frame({1, 3, 0x0D, 0x14, 0, 1});  // DIN_4, the home switch of axis A
  for (const auto& [of_box, of_bench] : {std::pair{0, 5000}, std::pair{5000, 0}}) {
    const Capture capture = FakeBox::captured(bench(of_box), {read, read}, std::chrono::seconds(5));
    const Comparison judged = compare(bench(of_bench), capture, {.from_power_up = true}, Extent::whole);
    EXPECT_EQ(judged.judgements[0].verdict, Verdict::different);
    EXPECT_EQ(judged.judgements[1].verdict, Verdict::different);
  }
}

TEST(Comparison, LearnsWhatABoxHeldBeforeTheCapture) {
  const auto read = frame({1, 3, 0x10, 3, 0, 1});
  const auto write = frame({1, 6, 0x10, 3, 0, 100});
  Capture capture = FakeBox::captured(bench_of("simple2-r3", {}, "Aaxis_AccTime: 250"),
                                      {read, read, write, read}, std::chrono::seconds(5));
  const world::Bench plain = bench_of("simple2-r3");
  const auto verdicts = [&](bool from_power_up) {
    std::vector<Verdict> all;
    for (const Judgement& one :
         compare(plain, capture, {.from_power_up = from_power_up}, Extent::whole).judgements)
      all.push_back(one.verdict);
    return all;
  };
  using enum Verdict;
  EXPECT_EQ(verdicts(false), (std::vector{undecidable, same, same, same}));
  EXPECT_EQ(verdicts(true), (std::vector{different, different, same, same}));
  capture.exchanges[1].reply = frame({1, 3, 2, 0, 251});  // something goes on that began before
  EXPECT_EQ(verdicts(false)[1], undecidable);
  capture.exchanges[3].reply = frame({1, 3, 2, 0, 101});  // the host wrote 100
  EXPECT_EQ(verdicts(false)[3], different);
}

}  // namespace calibration_test
}  // namespace understudy::emulator::box
