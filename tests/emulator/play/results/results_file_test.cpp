// Results as rows: read back by Python's json and sqlite3, which are independent of this code; and resumed.
#include "emulator/play/results/results_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/files/growing_file.h"

namespace understudy::emulator::play {
namespace results_file_test {

using Verdict = ScenarioResult::Verdict;

ScenarioResult result_of(int a, Verdict verdict = Verdict::passed, const std::string& branch = "") {
  ScenarioResult result{.verdict = verdict, .name = "it's a \"case\"", .file = "dir/s.yaml"};
  result.which = {.values = {{"a", std::to_string(a)}, {"t", "20ms"}, {"f", "0.5"}, {"z", "007"}},
                  .is_varied = true};
  result.branch = branch;
  result.seed = 20;
  result.simulated = SimTime{3'061'338'541};
  result.outcome_hash = 0x1234;
  if (verdict == Verdict::failed) {
    result.steps = {{"dir/s.yaml", 9, "expect"}};
    result.failure = Failure{.at = SimTime{2'000'000'000}, .what = "x is 1; expected 2"};
    result.recording = "r.jsonl";
  }
  return result;
}
CaseKey key_of(int a, std::uint64_t made_of = 77) {
  return {.file = "dir/s.yaml", .identity = identity_of(result_of(a).which), .made_of = made_of};
}

std::string output_of(const std::string& command) {
  std::string output;
  if (FILE* const pipe = popen(command.c_str(), "r")) {
    for (int c = 0; (c = fgetc(pipe)) != EOF;) output += static_cast<char>(c);
    pclose(pipe);
  }
  return output;
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class Rows : public testing::TestWithParam<std::string> {
 protected:
  Rows() {
    std::string pattern = testing::TempDir() + "understudy-rows-XXXXXX";
    folder_ = mkdtemp(pattern.data());
    path_ = folder_ + "/rows" + GetParam();
  }
  ~Rows() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<ResultsFile> open(bool continues) const {
    return GetParam() == kSqliteEnding ? open_sqlite(path_, continues) : open_json_lines(path_, continues);
  }
  void add(ResultsFile& file, const std::vector<ScenarioResult>& results, std::uint64_t made_of = 77) const {
    std::vector<ResultRow> rows;
    for (const ScenarioResult& result : results) rows.push_back(row_of(result, made_of, true));
    file.add(rows);
  }
  /// Each row as Python reads it: the values, in the order of the columns.
  std::string read_back() const {
    const std::string script = folder_ + "/read.py";
    std::ofstream(script) << (GetParam() == kSqliteEnding ? R"(
import json, sqlite3, sys
base = sqlite3.connect(sys.argv[1])
assert base.execute('pragma integrity_check').fetchone() == ('ok',)
for row in base.execute('select * from results order by rowid'):
    row = list(row)
    row[4] = json.loads(row[4])
    print(row)
)"
                                                          : R"(
import json, sys
for line in open(sys.argv[1]): print(list(json.loads(line).values()))
)");
    return output_of("python3 " + script + " " + path_ + " 2>&1");
  }

  std::string folder_;
  std::string path_;
};

TEST_P(Rows, AreReadBackAsTheyWereMeant) {
  {
    const auto file = open(false);
    file->begin();
    add(*file, {result_of(1)});
    add(*file, {result_of(2, Verdict::failed)});
    ScenarioResult unreadable = result_of(3, Verdict::failed);
    unreadable.is_unreadable = true;
    unreadable.steps.clear();
    unreadable.recording.clear();
    add(*file, {unreadable});
    file->finish();
  }
  const std::string head = "['dir/s.yaml', 'it\\'s a \"case\"', '', '";
  const auto id = [](int a) { return identity_text(identity_of(result_of(a).which)); };
  const std::string rest = ", 't': '20ms', 'f': 0.5, 'z': '007'}, '";
  EXPECT_EQ(
      read_back(),
      head + id(1) + "', {'a': 1" + rest +
          "passed', '0000000000001234', 3.061338541, 20, None, None, None, None, None, "
          "'000000000000004d']\n" +
          head + id(2) + "', {'a': 2" + rest +
          "failed', '0000000000001234', 3.061338541, 20, 'dir/s.yaml:9: x is #; expected #', "
          "'x is 1; expected 2', 2.0, 'dir/s.yaml:9', 'r.jsonl', '000000000000004d']\n" +
          head + id(3) + "', {'a': 3" + rest +
          "unreadable', None, 3.061338541, 20, 'dir/s.yaml: x is #; expected #', 'x is 1; expected 2', None, "
          "None, None, '000000000000004d']\n");
}

TEST_P(Rows, ReportWhatRanBefore) {
  {
    const auto file = open(false);
    file->begin();
    add(*file, {result_of(1)});
    add(*file, {result_of(2, Verdict::failed)});
    add(*file, {result_of(3), result_of(3, Verdict::passed, "one"), result_of(3, Verdict::failed, "two")});
    ScenarioResult unreadable = result_of(4, Verdict::failed);
    unreadable.is_unreadable = true;
    add(*file, {unreadable});
    file->finish();
  }
  const auto file = open(true);
  EXPECT_EQ(file->has_failed(key_of(1)), false);
  EXPECT_EQ(file->has_failed(key_of(2)), true);
  EXPECT_EQ(file->has_failed(key_of(3)), true) << "a branch of it has";
  EXPECT_EQ(file->has_failed(key_of(4)), std::nullopt) << "it did not run";
  EXPECT_EQ(file->has_failed(key_of(5)), std::nullopt);
  EXPECT_EQ(file->has_failed(key_of(1, 78)), std::nullopt) << "made from something else";
  add(*file, {result_of(5)});
  file->finish();
  const std::string rows = read_back();
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 7) << rows;
}

TEST_P(Rows, ANewRunRestarts) {
  for (int run = 0; run < 2; ++run) {
    const auto file = open(false);
    if (run == 1) {
      EXPECT_NE(read_back(), "") << "the old contents stay until something is written";
    }
    file->begin();
    add(*file, {result_of(run)});
    file->finish();
  }
  const std::string rows = read_back();
  EXPECT_NE(rows.find("{'a': 1,"), std::string::npos) << rows;
  EXPECT_EQ(rows.find("{'a': 0,"), std::string::npos) << rows;
}

TEST_P(Rows, AreWrittenByOneAtATime) {
  const auto first = open(false);
  EXPECT_THROW(open(false), GrowingFileError);
  EXPECT_THROW(open(true), GrowingFileError);
}

TEST_P(Rows, OfSomebodyElseAreLeftAlone) {
  if (GetParam() == kSqliteEnding) {
    output_of("python3 -c \"import sqlite3; c = sqlite3.connect('" + path_ +
              "'); c.execute('create table results(x)'); c.commit()\"");
  } else {
    std::ofstream(path_) << "{\"case_id\": 5}\n";
  }
  const std::string before = text_of(path_);
  ASSERT_NE(before, "");
  EXPECT_THROW(open(true), GrowingFileError);
  EXPECT_EQ(text_of(path_), before);
  for (const char* const other : {"no rows at all\n", "no row, and no end"}) {
    std::ofstream(path_) << other;
    EXPECT_THROW(open(true), GrowingFileError) << other;
    EXPECT_EQ(text_of(path_), other);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Rows,
                         testing::Values(std::string(kJsonLinesEnding), std::string(kSqliteEnding)),
                         [](const auto& kind) { return kind.param.substr(1); });

TEST(JsonLines, ALineWithoutAnEndIsDropped) {
  std::string pattern = testing::TempDir() + "understudy-rows-XXXXXX";
  const std::string folder = mkdtemp(pattern.data());
  const std::string path = folder + "/rows.jsonl";
  const std::string first = json_text(row_of(result_of(1), 77, true)) + "\n";
  const std::string second = json_text(row_of(result_of(2), 77, true)) + "\n";
  // Torn anywhere, also between two bytes of one row; a branch alone does not count as the case.
  const std::string branch = json_text(row_of(result_of(2, Verdict::passed, "b"), 77, true)) + "\n";
  for (std::size_t length = 0; length < second.size(); length += 7) {
    std::ofstream(path) << first << branch << second.substr(0, length);
    const auto file = open_json_lines(path, true);
    EXPECT_EQ(file->has_failed(key_of(1)), false);
    EXPECT_EQ(file->has_failed(key_of(2)), std::nullopt);
    EXPECT_EQ(text_of(path), first + branch);
  }
  std::filesystem::remove_all(folder);
}

TEST(Sqlite, ParametersAreColumnsOfAView) {
  std::string pattern = testing::TempDir() + "understudy-rows-XXXXXX";
  const std::string folder = mkdtemp(pattern.data());
  const std::string path = folder + "/rows.sqlite";
  {
    const auto file = open_sqlite(path, false);
    file->begin();
    ScenarioResult other = result_of(9);
    other.which.values = {{"name", "mine"}, {"a", "9"}};
    file->add(std::vector{row_of(result_of(1), 1, true)});
    file->add(std::vector{row_of(other, 1, true)});
    file->finish();
  }
  EXPECT_EQ(output_of("python3 -c \"import sqlite3; print(sqlite3.connect('" + path +
                      "').execute('select a, t, f, parameter_name from cases order by a').fetchall())\""),
            "[(1, '20ms', 0.5, None), (9, None, None, 'mine')]\n");
  std::filesystem::remove_all(folder);
}

}  // namespace results_file_test
}  // namespace understudy::emulator::play
