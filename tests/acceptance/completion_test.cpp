// `understudy completion`: shells complete every command and flag in --help.
#include <gtest/gtest.h>

#include <regex>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace completion_test {

bool is_here(const std::string& program) { return run({"which", program}).exit_code == 0; }

class Completion : public testing::Test {
 protected:
  /// Writes the completion script of that shell to a file.
  std::string script(const std::string& shell) const {
    const Finished made = understudy({"completion", shell});
    EXPECT_EQ(made.exit_code, 0) << made.errors;
    return folder_.write(shell, made.output);
  }
  PrivateFolder folder_;
};

/// Returns the first words of a section of a command's --help.
Words listed(Words command, const std::string& section) {
  command.emplace_back("--help");
  Words words;
  bool is_in = false;
  for (const std::string& line : lines_of(understudy(command).output)) {
    std::smatch found;
    if (!line.starts_with(" ")) is_in = line == section + ":";
    if (is_in && std::regex_search(line, found, std::regex("^  (?:-\\w,)?(--)?([a-z][\\w-]*)"))) {
      words.push_back(found[1].str() + found[2].str());
    }
  }
  return words;
}

TEST_F(Completion, OfBashKnowsEveryCommandAndFlag) {
  const std::string file = script("bash");
  const auto completed = [&](const std::string& words, int place) {
    const Finished finished =
        run({"bash", "-c",
             "source " + file + "; COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(place) +
                 "; _understudy; printf '%s\n' \"${COMPREPLY[@]}\""});
    EXPECT_EQ(finished.errors, "");
    return lines_of(finished.output);
  };
  EXPECT_EQ(completed("understudy ''", 1), listed({}, "Subcommands"));
  EXPECT_EQ(completed("understudy ctl ''", 2), listed({"ctl"}, "Subcommands"));
  for (const Words& command : {Words{"serve"}, Words{"run"}, Words{"ctl"}, Words{"ctl", "frames"}}) {
    std::string words = "understudy";
    for (const std::string& word : command) words += " " + word;
    EXPECT_EQ(completed(words + " --", static_cast<int>(command.size()) + 1), listed(command, "Options"))
        << words;
  }
  EXPECT_EQ(completed("understudy ctl --control x fr", 4), Words{"frames"});
  EXPECT_EQ(completed("understudy serve --model sl", 3), Words{"slim"});
  EXPECT_EQ(completed("understudy describe ''", 2), (Words{"rs-m8194h", "simple2-r3", "slim", "super-40nc"}));
  EXPECT_EQ(completed("understudy describe --format csv slim pa", 5), Words{"parameters"});
  EXPECT_EQ(completed("understudy ctl --port inject inject st", 5), (Words{"stall", "stuck"}));
  EXPECT_EQ(completed("understudy ctl inject stall ''", 4), Words{""}) << "an axis of a running bench";
  EXPECT_EQ(completed("understudy ctl power feeder o", 4), (Words{"on", "off"}));
  EXPECT_EQ(completed("understudy schema ''", 2), (Words{"bench", "scenario", "model"}));
  EXPECT_EQ(completed("understudy exec b.yaml -- --mo", 4), Words{""}) << "the command's own words";
}

TEST_F(Completion, OfZshIsAScriptWithEveryCommandAndFlag) {
  const std::string text = understudy({"completion", "zsh"}).output;
  for (const Words& command : {Words{}, Words{"ctl"}}) {
    for (const std::string& word : listed(command, "Subcommands")) {
      EXPECT_NE(text.find("'" + word + ":"), std::string::npos) << word;
    }
  }
  for (const std::string& flag : listed({"serve"}, "Options")) {
    EXPECT_NE(text.find("'" + flag + ":"), std::string::npos) << flag;
  }
  if (!is_here("zsh")) GTEST_SKIP() << "zsh is not installed";
  // Returns the completions that it would offer, without a terminal.
  const Finished offered = run({"zsh", "-fc",
                                "compdef() { : }; source " + script("zsh") +
                                    "; _describe() { print -rl -- ${(P)@[-1]%%:*} }; "
                                    "words=(understudy ctl ''); CURRENT=3; _understudy"});
  EXPECT_EQ(offered.errors, "");
  EXPECT_EQ(lines_of(offered.output), listed({"ctl"}, "Subcommands"));
}

TEST_F(Completion, OfFishOffersCommandsAndFlags) {
  if (!is_here("fish")) GTEST_SKIP() << "fish is not installed";
  const std::string file = script("fish");
  const auto offered = [&](const std::string& line) {
    const Finished finished = run({"fish", "--no-config", "-c",
                                   "source " + file + "; complete -C '" + line + "' | string split -f1 \\t"},
                                  {{"HOME", folder_.path()}});
    EXPECT_EQ(finished.errors, "");
    return lines_of(finished.output);
  };
  EXPECT_EQ(offered("understudy ctl fr"), Words{"frames"});
  EXPECT_EQ(offered("understudy serve --ca"), Words{"--capture"});
  EXPECT_EQ(offered("understudy serve --model sl"), Words{"slim"});
  EXPECT_EQ(offered("understudy describe --format csv super-40nc pa"), Words{"parameters"});
  EXPECT_EQ(offered("understudy ctl power feeder o"), (Words{"off", "on"}));
  EXPECT_EQ(offered("understudy completion "), (Words{"bash", "fish", "zsh"}));
}

TEST_F(Completion, OfAnotherShellIsRefused) {
  const Finished refused = understudy({"completion", "tcsh"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors,
            "understudy: completion: 'tcsh' is not a known shell; expected bash, zsh or fish\n");
}

}  // namespace completion_test
}  // namespace understudy::acceptance
