// Every output, with everything that may already exist at its path: a file with other contents is never lost.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/files/content_kind.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace replaced_outputs_test {

namespace fs = std::filesystem;
using Kind = ContentKind;

constexpr const char* kBench =
    "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n";
constexpr const char* kPlay = "understudy: 1\nname: play\nbench: bench.yaml\nsteps: [ advance: 5ms ]\n";
constexpr const char* kFails =
    "understudy: 1\nname: play\nbench: bench.yaml\nsteps: [ expect: { HW_Code: 1 } ]\n";
constexpr const char* kSaves =
    "understudy: 1\nname: play\nbench: bench.yaml\nsteps: [ save: { feeder: out.json } ]\n";

/// An output: the command that writes it (files begin with @), the file, and the exit code if it is refused.
struct Output {
  std::string name;
  Words words;
  std::string file;
  Kind kind;
  int refused = 3;
  int well = 0;
};

const std::vector<Output> kOutputs = {
    {"run --junit", {"run", "@play.yaml", "--junit", "@out.xml"}, "out.xml", Kind::junit},
    {"run --report", {"run", "@play.yaml", "--report", "@out.html"}, "out.html", Kind::page},
    {"run --results", {"run", "@play.yaml", "--results", "@out.jsonl"}, "out.jsonl", Kind::results},
    {"run --results, SQLite",
     {"run", "@play.yaml", "--results", "@out.sqlite"},
     "out.sqlite",
     Kind::database},
    {"run --record", {"run", "@play.yaml", "--record", "@kept"}, "kept/play.jsonl", Kind::recording},
    {"run --failures",
     {"run", "@fails.yaml", "--failures", "@kept"},
     "kept/play.jsonl",
     Kind::recording,
     3,
     1},
    {"run --trace", {"run", "@play.yaml", "--trace", "@kept"}, "kept/play.csv", Kind::trace},
    {"run --capture", {"run", "@play.yaml", "--capture", "@kept"}, "kept/play.pcapng", Kind::capture},
    {"save", {"run", "@saves.yaml"}, "out.json", Kind::nv_image, 2},
    {"exec --record", {"exec", "@bench.yaml", "--record", "@out", "--", "true"}, "out", Kind::recording},
    {"exec --record, older part",
     {"exec", "@bench.yaml", "--record", "@out", "--", "true"},
     "out.1",
     Kind::recording},
    {"exec --trace", {"exec", "@bench.yaml", "--trace", "@out.csv", "--", "true"}, "out.csv", Kind::trace},
    {"exec --trace, VCD",
     {"exec", "@bench.yaml", "--trace", "@out.vcd", "--", "true"},
     "out.vcd",
     Kind::trace},
    {"exec --capture",
     {"exec", "@bench.yaml", "--capture", "@out.pcapng", "--", "true"},
     "out.pcapng",
     Kind::capture},
    {"exec --capture, text",
     {"exec", "@bench.yaml", "--capture", "@out.txt", "--", "true"},
     "out.txt",
     Kind::capture},
    {"replay --trace", {"replay", "@day.jsonl", "--trace", "@out.csv"}, "out.csv", Kind::trace},
    {"replay --capture", {"replay", "@day.jsonl", "--capture", "@out.txt"}, "out.txt", Kind::capture},
    {"replay --report", {"replay", "@day.jsonl", "--report", "@out.html"}, "out.html", Kind::page},
};

/// What may exist there, and its kind; without a kind, an output of the same kind may replace it.
struct There {
  std::string what;
  std::optional<std::string> text;
  std::optional<Kind> kind;
};

class ReplacedOutputs : public testing::Test {
 protected:
  ReplacedOutputs() {
    for (const auto& [name, text] : {std::pair{"bench.yaml", kBench},
                                     {"play.yaml", kPlay},
                                     {"fails.yaml", kFails},
                                     {"saves.yaml", kSaves}}) {
      folder_.write(name, text);
    }
    EXPECT_EQ(understudy({"exec", at("bench.yaml"), "--record", at("day.jsonl"), "--", "true"}).exit_code, 0);
  }
  std::string at(const std::string& name) const { return folder_ / name; }
  Words with_paths(const Words& words) const {
    Words made;
    for (const std::string& word : words) made.push_back(word.starts_with("@") ? at(word.substr(1)) : word);
    return made;
  }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(at(name), std::ios::binary).rdbuf();
    return text.str();
  }

  PrivateFolder folder_;
};

TEST_F(ReplacedOutputs, LoseNothingOfAnotherKind) {
  const std::vector<There> things = {
      {"nothing", {}, {}},
      {"an empty file", "", {}},
      {"a text", "precious\n", Kind::other},
      {"a bench", kBench, Kind::bench},
      {"a recording", R"({"understudy":1,"kind":"recording","version":"0.1.0"})", Kind::recording},
      {"a row of results", "{\"file\":\"a.yaml\",\"name\":\"x\"}\n", Kind::results},
  };
  for (const Output& output : kOutputs) {
    for (const There& there : things) {
      fs::create_directories(at("kept"));
      if (there.text) folder_.write(output.file, *there.text);
      const bool is_refused = there.kind && *there.kind != output.kind;
      const Finished finished = understudy(with_paths(output.words));
      const std::string what = output.name + " over " + there.what;
      EXPECT_EQ(finished.exit_code, is_refused ? output.refused : output.well)
          << what << ": " << finished.errors;
      if (is_refused) {
        EXPECT_EQ(content(output.file), *there.text) << what;
        const std::string why = *there.kind == Kind::other
                                    ? "it is not " + std::string(name_of(output.kind))
                                    : "it is " + std::string(name_of(*there.kind)) + "; expected " +
                                          std::string(name_of(output.kind)) + " to replace";
        EXPECT_NE((finished.errors + finished.output).find(why), std::string::npos)
            << what << ": " << finished.errors << finished.output;
      } else if (!output.file.ends_with(".1")) {  // that one comes later, if at all
        EXPECT_EQ(name_of(content_of(content(output.file))), name_of(output.kind)) << what;
      }
      fs::remove_all(at("kept"));
      for (const auto& entry : fs::directory_iterator(folder_.path())) {
        if (entry.path().filename().string().starts_with("out")) fs::remove(entry.path());
      }
    }
  }
}

TEST_F(ReplacedOutputs, OfTheSameKindAreReplacedAgain) {
  for (const Output& output : kOutputs) {
    if (output.file.ends_with(".1")) continue;
    fs::create_directories(at("kept"));
    for (int time = 0; time < 2; ++time) {
      const Finished finished = understudy(with_paths(output.words));
      EXPECT_EQ(finished.exit_code, output.well) << output.name << ": " << finished.errors;
      // A message mentions rows that took long.
      const bool is_said =
          finished.errors.find("replacing the rows of an earlier run; --resume continues it") !=
          std::string::npos;
      EXPECT_EQ(is_said, time == 1 && output.name.starts_with("run --results"))
          << output.name << finished.errors;
    }
    fs::remove_all(at("kept"));
  }
}

TEST_F(ReplacedOutputs, OfInitAndImportReplaceNothingAtAll) {
  folder_.write("list.csv", "address,name\n1,SPEED\n");
  for (const std::string text : {"", "precious", kBench}) {
    folder_.write("mine.yaml", text);
    EXPECT_EQ(understudy({"import", at("list.csv"), "-o", at("mine.yaml")}).exit_code, 2);
    EXPECT_EQ(content("mine.yaml"), text);
    fs::create_directories(at("first"));
    folder_.write("first/bench.yaml", text);
    EXPECT_EQ(understudy({"init", at("first")}).exit_code, 2);
    EXPECT_EQ(content("first/bench.yaml"), text);
  }
}

TEST_F(ReplacedOutputs, OfARunningDaemonAsWell) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  EXPECT_EQ(daemon.ctl({"scope", "Cord_A"}).exit_code, 0);
  EXPECT_EQ(daemon.ctl({"advance", "10ms"}).exit_code, 0);
  const std::vector<std::pair<Words, std::string>> verbs = {{{"snapshot", at("out.json")}, "out.json"},
                                                            {{"scope", "--trace", at("out.csv")}, "out.csv"}};
  for (const auto& [words, file] : verbs) {
    for (const std::string text : {"precious", kBench}) {
      folder_.write(file, text);
      EXPECT_NE(daemon.ctl(words).exit_code, 0);
      EXPECT_EQ(content(file), text);
    }
    folder_.write(file, "");
    EXPECT_EQ(daemon.ctl(words).exit_code, 0);
    fs::permissions(at(file), fs::perms(0600));
    EXPECT_EQ(daemon.ctl(words).exit_code, 0) << "one of the same";
    EXPECT_EQ(fs::status(at(file)).permissions(), fs::perms(0600)) << file;
  }
}

TEST_F(ReplacedOutputs, HaveTheModeOfWhatTheyReplace) {
  for (const Output& output : kOutputs) {
    if (output.file.ends_with(".1")) continue;
    fs::create_directories(at("kept"));
    folder_.write(output.file, "");
    fs::permissions(at(output.file), fs::perms(0600));
    EXPECT_EQ(understudy(with_paths(output.words)).exit_code, output.well);
    EXPECT_EQ(fs::status(at(output.file)).permissions(), fs::perms(0600)) << output.name;
    fs::remove_all(at("kept"));
  }
}

}  // namespace replaced_outputs_test
}  // namespace understudy::acceptance
