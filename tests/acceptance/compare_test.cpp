// `understudy compare` and `understudy calibrate`, with captures that `run` and `serve` have written.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

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
  const Finished other = understudy({"compare", capture, "--bench", plain_, "--power-up", "--json"});
  EXPECT_EQ(other.exit_code, 1) << other.errors;
  const json report = json::parse(other.output, nullptr, false)[0];
  EXPECT_EQ(report["different"], 1) << other.output;
  EXPECT_EQ(report["same"], 3);
  EXPECT_EQ(report["agrees_with"], json{"box.version_encoding: bcd"});
  EXPECT_EQ(report["not_same"][0]["controller"], "box.Version = 338");
  EXPECT_EQ(report["not_same"][0]["bench"], "box.Version = 152");
}

TEST_F(Compare, CalibratesABenchThatThenAgrees) {
  const std::string capture = capture_of("version_encoding: bcd", 338);
  const std::string evidence = folder_ / "evidence.json";
  EXPECT_EQ(understudy({"calibrate", capture, "--bench", plain_, "--power-up", "-o", evidence}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(evidence));
  const Finished choices = understudy({"calibrate", capture, "--bench", plain_, "--power-up", "--choices"});
  EXPECT_EQ(choices.output, "choices:  # of box\n  version_encoding: bcd\n") << choices.errors;
}

TEST_F(Compare, RefusesWhatItCannotReadInOneLine) {
  const std::string text = folder_.write("text.txt", "0.1 in line 01 03\n0.2 out line zz\n");
  const std::string image = folder_.write(
      "slim.nv.json",
      "{\"understudy\": 1, \"kind\": \"nv-image\", \"model\": \"slim\", \"firmware\": \"1.00\", "
      "\"registers\": {}}");
  const struct {
    Words words;
    std::string what;
  } cases[] = {
      {{"compare", text, "--bench", plain_}, "text.txt:2: 'zz' is not a byte; expected a line"},
      {{"compare", plain_, "--bench", plain_}, "capture: is a bench; expected a capture"},
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
