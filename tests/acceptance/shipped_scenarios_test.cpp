// The shipped scenarios: each asks a question and passes. They do the same in every run, on any machine, and
// have the same verdicts in real time over real ports with libmodbus.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace shipped_scenarios_test {

namespace fs = std::filesystem;

const std::string kFolder = PROJECT_FOLDER "/scenarios";
const std::string kOfModel = kFolder + "/simple2-r3";
const std::string kOfSlim = kFolder + "/slim";
const std::string kLineFaults = kOfModel + "/line_faults";
const std::string kProofs = PROJECT_FOLDER "/docs/fidelity/proofs";

/// The .yaml files of one folder, in order.
Words files_in(const std::string& folder) {
  Words files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Words operator+(Words some, const Words& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

const Words& all() {
  static const Words files = files_in(kOfModel) + files_in(kLineFaults) + files_in(kOfSlim) +
                             files_in(kFolder + "/rs-m8194h") + files_in(kFolder + "/super-40nc");
  return files;
}

/// The scenarios that distinguish the options of a choice, for all models. A test in the emulator's room has
/// more checks.
const Words& of_choices() {
  static const Words files = [] {
    Words found;
    for (const auto& folder : fs::directory_iterator(kProofs)) {
      if (folder.is_directory()) found = std::move(found) + files_in(folder.path().string());
    }
    std::sort(found.begin(), found.end());
    return found;
  }();
  return files;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string last_line_of(const std::string& text) {
  const Words lines = lines_of(text);
  return lines.empty() ? "" : lines.back();
}

// --- as they are -------------------------------------------------------------------------------------------

TEST(ShippedScenarios, EveryFileIsSound) {
  Words files;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  }
  EXPECT_GE(files.size(), all().size());
  EXPECT_GE(of_choices().size(), 40U);
  files = std::move(files) + of_choices();
  const Finished finished = understudy(Words{"check"} + files);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(lines_of(finished.output).size(), files.size());
}

TEST(ShippedScenarios, EachAsksAQuestionAndThePageKnowsIt) {
  EXPECT_GE(all().size(), 20U);
  const std::string page = text_of(kFolder + "/README.md");
  for (const std::string& file : all()) {
    const Words lines = lines_of(text_of(file));
    std::string comment;
    for (const std::string& line : lines) {
      if (!line.starts_with("#")) break;
      comment += line + "\n";
    }
    const std::size_t question = comment.find('?');
    EXPECT_NE(question, std::string::npos) << file << ": asks nothing";
    EXPECT_GT(comment.size(), question + 100) << file << ": explains nothing";
    EXPECT_NE(page.find("(" + fs::relative(file, kFolder).string() + ")"), std::string::npos)
        << file << " is not on the page";
  }
  const std::regex link("\\]\\(([^)]+)\\)");
  for (auto i = std::sregex_iterator(page.begin(), page.end(), link); i != std::sregex_iterator(); ++i) {
    EXPECT_TRUE(fs::exists(kFolder + "/" + (*i)[1].str())) << (*i)[1] << " is not there";
  }
}

// --- in free time ------------------------------------------------------------------------------------------

/// Returns the complete output of a run, with the hashes of everything that the devices sent and did.
std::string printed(const Words& flags = {}, const Environment& environment = {},
                    const std::string& program = UNDERSTUDY_BINARY,
                    const Words& files = all() + of_choices()) {
  // More than a thousand scenarios: with sanitizers and another test alongside they took 12 s.
  const Finished finished = run(Words{program, "run", "--hash"} + flags + files, environment, 8 * kPatience);
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_NE(last_line_of(finished.output).find(" passed, 0 failed; "), std::string::npos);
  return finished.output;
}

/// The hashes of a run, in its order.
Words hashes_in(const std::string& output) {
  Words hashes;
  for (const std::string& line : lines_of(output)) {
    if (line.starts_with("hash ")) hashes.push_back(line.substr(line.rfind(' ')));
  }
  return hashes;
}

TEST(ShippedScenarios, PassInFreeTimeAndDoTheSameInTwentyRuns) {
  const std::string first = printed({"--jobs", "2"});
  EXPECT_GE(hashes_in(first).size(), all().size() + 2 * 600);  // each choice has two options or more
  for (const char* jobs : {"1", "4"}) ASSERT_EQ(printed({"--jobs", jobs}), first) << jobs << " jobs";
  // Those without the choices' proofs, of which there are ten times as many.
  const std::string shipped = printed({}, {}, UNDERSTUDY_BINARY, all());
  for (int i = 1; i < 20; ++i) {
    ASSERT_EQ(printed({"--jobs", std::to_string(1 + i % 4)}, {}, UNDERSTUDY_BINARY, all()), shipped)
        << "run " << i;
  }
}

TEST(ShippedScenarios, DoDifferentThings) {
  // Scenarios of choices may do the same as those of another row; the emulator's own tests compare them
  // within a row.
  const Words hashes = hashes_in(understudy(Words{"run", "--hash"} + all()).output);
  EXPECT_GE(hashes.size(), all().size());
  // Two pairs are the same on purpose: a program that is loaded in two ways, and an override at its maximum
  // and beyond.
  EXPECT_EQ(std::set<std::string>(hashes.begin(), hashes.end()).size(), hashes.size() - 2)
      << "scenarios do the same, or nothing is hashed";
}

TEST(ShippedScenarios, DoTheSameUnderLoad) {
  const std::string alone = printed();
  std::vector<std::jthread> load;
  for (unsigned i = 0; i < 3 * std::thread::hardware_concurrency(); ++i) {
    load.emplace_back([](const std::stop_token& over) {
      for (volatile unsigned n = 0; !over.stop_requested();) n = n + 1;
    });
  }
  EXPECT_EQ(printed({"--jobs", "8"}), alone);
}

TEST(ShippedScenarios, DoTheSameOnAProcessorWithoutFusedMultiplication) {
  const std::string usual = printed();
  for (const char* without : {"-FMA,-AVX2,-AVX,-FMA4,-AVX512F", "-FMA,-AVX2"}) {
    EXPECT_EQ(printed({}, {{"GLIBC_TUNABLES", std::string("glibc.cpu.hwcaps=") + without}}), usual)
        << without;
  }
}

/// Programs that replace the file that they run from, in each scan and in each area.
const char* const kChangesItsFiles = R"(understudy: 1
name: files are changed by their own lines
bench:
  lines: { a: { timing: instant, stations: [ { device: mill, port: RS232 } ] } }
  devices:
    mill:
      model: super-40nc
      program: |
        AREA C
        LAB K1
        INC D9001
        INC D1
        LD= D9001 K3
        IF
        MOV K0 D9001
        ENDI
        JMP K1
        END
        AREA X
        LAB K1
        FMV K5 D9001 K1
        INC D2
        INC D3
        JMP K1
        END
        AREA PLC
        LD M8003
        ADD D9001 K1 D9001
        INC D4
        DEC D9001
        INC D5
        END
steps:
  - for:
      each: [ 0, 1, 2, 3 ]
      as: file
      steps:
        - program: { mill: "FILE ${file}\nLAB K1\nINC D9001\nINC D6\nLD= D9001 K3\nIF\nMOV K0 D9001\nENDI\nJMP K1\nEND\n" }
  - write: { mill.M8000: 1, mill.M8100: 1 }
  - advance: 300ms
)";

/// Freed memory is filled with a different value in each run, and none of it is kept for reuse.
TEST(ShippedScenarios, DoTheSameWhateverFreedMemoryHolds) {
  const PrivateFolder folder;
  const std::string path = folder.write("files.yaml", kChangesItsFiles);
  const auto hash_of = [&](const Environment& environment) {
    const Finished finished = run({UNDERSTUDY_BINARY, "run", "--hash", path}, environment);
    EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
    return finished.output;
  };
  const std::string of_files = hash_of({});
  const std::string usual = printed();
  for (const char* fill : {"90", "165"}) {
    const Environment environment{{"MALLOC_PERTURB_", fill},
                                  {"GLIBC_TUNABLES", "glibc.malloc.tcache_count=0"}};
    EXPECT_EQ(hash_of(environment), of_files) << fill;
    EXPECT_EQ(printed({}, environment), usual) << fill;
  }
}

TEST(ShippedScenarios, DoTheSameInAnotherBuild) {
  const char* const other = std::getenv("UNDERSTUDY_OTHER_BINARY");
  if (other == nullptr || *other == '\0') {
    GTEST_SKIP() << "UNDERSTUDY_OTHER_BINARY names no program of another build type";
  }
  ASSERT_TRUE(fs::exists(other)) << other;
  EXPECT_EQ(printed({}, {}, other), printed());
}

/// A third of the proofs; RunRecordings replays all other scenarios.
TEST(ShippedScenarios, AreReplayedFromTheirRecordings) {
  const PrivateFolder folder;
  Words files;
  for (std::size_t i = 0; i < of_choices().size(); i += 3) files.push_back(of_choices()[i]);
  ASSERT_EQ(understudy(Words{"run", "--record", folder.path()} + files).exit_code, 0);
  int replayed = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    const Finished again = understudy({"replay", entry.path().string()});
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    ++replayed;
  }
  EXPECT_GE(replayed, static_cast<int>(10 * files.size()));
}

TEST(ShippedScenarios, AHashShowsWhenSomethingIsDifferent) {
  const PrivateFolder folder;
  const auto hash_of = [&](const std::string& speed) {
    const std::string path = folder.write(
        "move.yaml",
        "understudy: 1\nbench: { lines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
        "steps: [ write: { feeder.Aaxis_Speed: " +
            speed + " } ]\n");
    return lines_of(understudy({"run", "--hash", path}).output).at(1);
  };
  EXPECT_EQ(hash_of("200").substr(0, 10), "hash move ");
  EXPECT_EQ(hash_of("200"), hash_of("200"));
  EXPECT_NE(hash_of("200"), hash_of("201"));
  const Finished refused = understudy({"run", "--hash", "--real-time", kOfModel + "/alarm.yaml"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors,
            "understudy: --hash: no two runs in real time are the same; expected it without --real-time\n");
}

// --- in real time ------------------------------------------------------------------------------------------

constexpr Wait kBound{150'000};     // all of them, in parallel
constexpr double kSimulated = 120;  // seconds in all
constexpr int kAttempts = 4;

/// "ok    alarm.yaml: an alarm, and clearing it", by scenario; without the time it took.
std::map<std::string, std::string> verdicts_of(const std::string& output) {
  std::map<std::string, std::string> verdicts;
  const std::regex verdict("^(ok|FAIL|-) +(.*) \\([^)]*\\)$");
  for (const std::string& line : lines_of(output)) {
    std::smatch found;
    if (std::regex_match(line, found, verdict)) verdicts[found[2]] = found[1];
  }
  return verdicts;
}

/// The simulated time in "46 passed, 0 failed; 37.3s simulated".
double simulated_seconds(const std::string& output) {
  const std::string line = last_line_of(output);
  const std::size_t at = line.find("; ");
  return at == std::string::npos ? -1 : std::strtod(line.c_str() + at + 2, nullptr);
}

/// Scenarios of all models, except those that take four seconds and more, because they run in real time.
Words short_ones() {
  const std::set<std::string> long_ones{
      "rs-m8194h/stop_lock.yaml",      "super-40nc/home_in_order.yaml",
      "super-40nc/index_table.yaml",   "super-40nc/mill_a_slot.yaml",
      "super-40nc/pause_an_arc.yaml",  "super-40nc/pick_and_place.yaml",
      "super-40nc/winder.yaml",        "super-40nc/mill_under_override.yaml",
      "super-40nc/peck_drilling.yaml", "super-40nc/five_programs.yaml",
      "super-40nc/cut_to_length.yaml"};
  Words files = files_in(kOfModel) + files_in(kOfSlim);
  for (const std::string model : {"rs-m8194h", "super-40nc"}) {
    for (const std::string& file : files_in(kFolder + "/" + model)) {
      if (!long_ones.contains(model + "/" + fs::path(file).filename().string())) files.push_back(file);
    }
  }
  return files;
}

TEST(ShippedScenariosInRealTime, HaveTheSameVerdicts) {
  const PrivateFolder folder;
  const Words files = short_ones();
  const Finished free = understudy(Words{"run"} + files);
  const auto expected = verdicts_of(free.output);
  EXPECT_GE(expected.size(), files.size());
  EXPECT_GT(simulated_seconds(free.output), 10) << last_line_of(free.output);
  EXPECT_LE(simulated_seconds(free.output), kSimulated) << last_line_of(free.output);

  // If the machine stops for half a second, any host's timeouts expire. The scenarios that were affected run
  // again, alone.
  std::string output;
  std::map<std::string, std::string> verdicts;
  Words left = files;
  for (int i = 0; i < kAttempts && !left.empty(); ++i) {
    const Words one_by_one = i == 0 ? Words{} : Words{"--jobs", "1"};
    Process real(Words{UNDERSTUDY_BINARY, "run", "--real-time", "--record", folder / "recordings"} +
                 one_by_one + left);
    ASSERT_TRUE(real.wait(kBound)) << "it takes too long";
    output = real.output();
    const auto seen = verdicts_of(output);
    for (const auto& [scenario, verdict] : seen) verdicts[scenario] = verdict;
    std::erase_if(left, [&](const std::string& file) {
      return std::none_of(seen.begin(), seen.end(), [&](const auto& one) {
        const auto other = expected.find(one.first);
        return one.first.starts_with(file + ": ") && (other == expected.end() || other->second != one.second);
      });
    });
  }
  EXPECT_EQ(verdicts, expected) << output;

  // Each of these runs, over a pty and in real time, replays in virtual time to the byte.
  std::size_t recordings = 0;
  for (const auto& entry : fs::directory_iterator(folder / "recordings")) {
    const Finished again = understudy({"replay", entry.path().string()});
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    ++recordings;
  }
  EXPECT_EQ(recordings, expected.size());
}

// --- recordings --------------------------------------------------------------------------------------------

TEST(RunRecordings, AllArePlayedAgainByteByByte) {
  const PrivateFolder folder;
  const Finished finished = understudy(Words{"run", "--record", folder / "all"} + all());
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  std::size_t recordings = 0;
  for (const auto& entry : fs::directory_iterator(folder / "all")) {
    const Finished again = understudy({"replay", entry.path().string()});
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    ++recordings;
  }
  EXPECT_EQ(recordings, verdicts_of(finished.output).size());
}

const std::string kFails =
    "understudy: 1\n"
    "name: it / fails\n"
    "bench: { lines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
    "steps:\n"
    "  - write: { feeder.Aaxis_SVON: 1 }\n"
    "  - fork:\n"
    "      well: [ expect: { feeder.Aaxis_SVON: 1 } ]\n"
    "      ill: [ expect: { feeder.Aaxis_SVON: 0 } ]\n";

/// Returns the command that a failed run prints; empty if it prints none.
std::string replay_command(const std::string& output) {
  const std::string word = "to run this again: ";
  for (const std::string& line : lines_of(output)) {
    if (const std::size_t at = line.find(word); at != std::string::npos) return line.substr(at + word.size());
  }
  return "";
}

TEST(RunRecordings, OneOfAFailureIsKeptAndRunsAgain) {
  const PrivateFolder folder;
  const std::string file = folder.write("fails.yaml", kFails);
  for (const Words& flags : {Words{}, Words{"--real-time"}, Words{"--record", folder / "kept"}}) {
    const Finished finished = understudy(Words{"run", file, "--junit", folder / "results.xml"} + flags);
    EXPECT_EQ(finished.exit_code, 1) << finished.errors;
    const std::string command = replay_command(finished.output);
    ASSERT_TRUE(command.starts_with("understudy replay ")) << finished.output;
    EXPECT_NE(text_of(folder / "results.xml").find(command), std::string::npos);
    const std::string path = command.substr(18);
    EXPECT_TRUE(path.ends_with("/it_fails_ill.jsonl")) << path;
    const Finished again = understudy({"replay", path});
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    EXPECT_NE(again.output.find(": the same: "), std::string::npos) << again.output;
    // One of the three plays fails; --record keeps the others as well.
    const auto kept = std::distance(fs::directory_iterator(fs::path(path).parent_path()), {});
    const bool all_are_kept = path.starts_with(folder.path());
    EXPECT_EQ(kept, all_are_kept ? 3 : 1);
    if (!all_are_kept) fs::remove_all(fs::path(path).parent_path());
  }
}

TEST(RunRecordings, AFolderThatIsNotAvailableIsReportedFirst) {
  const PrivateFolder folder;
  const std::string file = folder.write("fails.yaml", kFails);
  const Finished finished = understudy({"run", file, "--record", file + "/in"});
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_EQ(finished.output, "");
  EXPECT_EQ(finished.errors, "understudy: --record: " + file + "/in cannot be written: Not a directory\n");
}

}  // namespace shipped_scenarios_test
}  // namespace understudy::acceptance
