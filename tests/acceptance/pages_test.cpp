// Runs the commands of README and docs/ as a reader pastes them, and compares the results with the pages. The
// `sh` blocks of a page run in order, in one shell, in a folder with the project's files. A comment `# -> a,
// b; why` lists texts that its command must print, in that order (`...` stands for anything). A block
// `output` after a command is its output. A block `dialogue PORT` is typed at the port (lines after `> `),
// with the replies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "tests/acceptance/running_understudy.h"
#include "tests/acceptance/tcp_client.h"

namespace understudy::acceptance {
namespace pages_test {

namespace fs = std::filesystem;

struct Block {
  std::string language;
  int line = 0;  // of its first line
  std::vector<std::string> lines;
};

std::vector<Block> blocks_of(const std::string& page) {
  std::ifstream file(std::string(PROJECT_FOLDER) + "/" + page);
  std::vector<Block> found;
  bool is_inside = false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.starts_with("```")) {
      is_inside = !is_inside;
      if (is_inside) found.push_back({line.substr(3), number + 1, {}});
    } else if (is_inside) {
      found.back().lines.push_back(line);
    }
  }
  return found;
}

/// Blocks of commands that do not run here, by their beginnings, and the reasons.
struct Left {
  std::string page;
  std::string begin;
  std::string why;
};
const std::vector<Left> kLeft = {
    {"README.md", "./run      # builds", "builds, and runs all tests"},
    {"CONTRIBUTING.md", "./test", "runs all tests"},
    {"CONTRIBUTING.md", "apt-get", "installs"},
    {"docs/install.md", "apt-get", "installs"},
    {"docs/install.md", "cmake", "builds; Installation"},
    {"docs/install.md", "cd build/release", "DebianPackage"},
    {"docs/install.md", "docker", "needs a container"},
    {"docs/install.md", "cp /usr/share", "needs systemd; Installation"},
    {"docs/install.md", "packaging/apt_repository.sh", "python/tests/test_apt_repository.py"},
    {"docs/install.md", "podman load", "needs podman; python/tests/test_portable.py"},
    {"docs/install.md", "tar -xzf", "python/tests/test_portable.py"},
    {"docs/install.md", "python3 -m venv", "python/tests/test_portable.py"},
    {"docs/motion.md", "cmake", "draws all pictures"},
    {"docs/page.md", "understudy page [", "a synopsis"},
    {"docs/python.md", "packaging/wheel.sh", "python/tests/test_packages.py"},
    {"docs/campaigns.md", "", "CampaignsPage"},
    {"docs/ci.md", "", "CiPage"},
    {"docs/import.md", "", "ImportPage"},
    {"docs/hunt.md", "", "HuntPage"},
    {"docs/editors.md", "", "EditorsPage"},
    {"docs/node.md", "", "needs npm; python/tests/test_node_page.py"},
    {"docs/windows.md", "", "needs Windows or Wine"},
    {"scenarios/README.md", "understudy run", "ShippedScenarios"},
};

bool is_left(const std::string& page, const Block& block) {
  return std::any_of(kLeft.begin(), kLeft.end(), [&](const Left& left) {
    return left.page == page && !block.lines.empty() && block.lines.front().starts_with(left.begin);
  });
}

/// Requirements of commands that may be missing here: the word that indicates them, and where they would be.
const std::vector<std::pair<std::string, std::string>> kNeeded = {
    {"mbpoll", "/usr/bin/mbpoll"},
    {"tshark", "/usr/bin/tshark"},
    {"understudy plot", "/usr/bin/gnuplot"},
    {"import os, serial", "/usr/lib/python3/dist-packages/serial"},
    {"from pymodbus", "/usr/lib/python3/dist-packages/pymodbus"},
};

/// Additional definitions of the page's shell.
const std::string kShell = std::string(TEST_FACTS) + "/hosts/page_shell.sh";

constexpr const char* kRun = R"(#!/bin/sh
[ $# -gt 0 ] || set -- serve scenarios/quickstart.yaml
exec understudy "$@"
)";

const std::regex kValue("^(.*\\S)\\s+# -> (.*)$");
const std::regex kBehind("^(\\./run|understudy) (serve|replay|page)\\b.*&$");
const std::regex kFirstTerminal("^((\\./run|understudy) (serve|page)\\b[^&]*|\\./run)$");

std::string without_comment(const std::string& line) { return line.substr(0, line.find(" #")); }

std::string trimmed(std::string text) {
  text.erase(text.find_last_not_of(" \t") + 1);
  text.erase(0, text.find_first_not_of(" \t"));
  return text;
}

/// Finds texts in this order; `...` stands for anything within a line, and a time for any time if `times` is
/// set.
std::regex pattern_of(const std::string& text, bool any_time) {
  std::string escaped = std::regex_replace(text, std::regex(R"([.^$|()\[\]{}*+?\\])"), "\\$&");
  escaped = std::regex_replace(escaped, std::regex(R"((\\\.){3})"), ".*");
  escaped = std::regex_replace(escaped, std::regex(" +"), "\\s+");
  if (any_time) escaped = std::regex_replace(escaped, std::regex(R"(\d+\\\.\d+s)"), "[0-9.]+s");
  const bool is_word = !escaped.empty() && std::isalnum(static_cast<unsigned char>(text.back())) != 0;
  return std::regex((std::isdigit(static_cast<unsigned char>(text.front())) != 0 ? "(^|[^-0-9.])" : "") +
                    escaped + (is_word ? "\\b" : ""));
}

void expect_in_order(const std::string& printed, const std::vector<std::string>& texts,
                     const std::string& where, bool any_time = false) {
  auto from = printed.cbegin();
  for (const std::string& text : texts) {
    std::smatch found;
    if (!std::regex_search(from, printed.cend(), found, pattern_of(text, any_time))) {
      ADD_FAILURE() << where << ": '" << text << "' is not printed; printed is\n" << printed;
      return;
    }
    from = found[0].second;
  }
}

std::vector<std::string> values_of(const std::string& comment) {
  std::vector<std::string> values;
  std::istringstream text(comment.substr(0, comment.find("; ")));
  for (std::string value; std::getline(text, value, ',');) values.push_back(trimmed(value));
  return values;
}

/// A page as a script, and its expected output.
class Script {
 public:
  explicit Script(const std::vector<Block>& blocks) : text_(". " + kShell + "\n") {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const Block& block = blocks[i];
      if (block.language == "sh") {
        const bool is_shown = i + 1 < blocks.size() && blocks[i + 1].language == "output";
        text_ += "out=$home/block." + std::to_string(block.line) + "\nexec >$out 2>&1\n" +
                 (is_shown ? "unjudged\n" : "judge\n");
        add(block, !is_shown);
        text_ += "wait_for_all\n";
        if (is_shown) shown_[block.line] = blocks[i + 1].lines;
      } else if (block.language.starts_with("dialogue ")) {
        converse(block, block.language.substr(9));
      }
    }
    text_ += "end_first\n";
  }
  const std::string& text() const { return text_; }
  const std::map<int, std::vector<std::string>>& values() const { return values_; }
  const std::map<int, std::vector<std::string>>& shown() const { return shown_; }

 private:
  void add(const Block& block, bool is_judged) {
    std::string statement;
    for (std::size_t i = 0; i < block.lines.size(); ++i) {
      const std::string& line = block.lines[i];
      const int number = block.line + static_cast<int>(i);
      statement += line + "\n";
      if (line.ends_with('\\')) continue;
      if (line.find("<<'END'") != std::string::npos) {
        while (++i < block.lines.size()) {
          statement += block.lines[i] + "\n";
          if (block.lines[i] == "END") break;
        }
      }
      text_ += "at=" + std::to_string(number) + "\n";
      const std::string plain = trimmed(without_comment(line));
      std::smatch found;
      if (std::regex_match(line, found, kValue)) {
        values_[number] = values_of(found[2]);
        const std::string file = "$home/value." + std::to_string(number);
        text_ += "unjudged\n{\n" + statement + "} >" + file + " 2>&1\ncat " + file + "\n" +
                 (is_judged ? "judge\n" : "");
      } else if (std::regex_match(plain, kBehind)) {
        text_ += "end_first\n" + statement;
      } else if (std::regex_match(plain, kFirstTerminal)) {
        text_ += "in_first_terminal " + plain + "\n";
      } else {
        text_ += statement;
      }
      statement.clear();
    }
  }
  void converse(const Block& block, const std::string& port) {
    text_ += "unjudged\nexec 8<>" + port + " && stty -F " + port + " 9600 cs8 -parenb raw -echo\n";
    for (std::size_t i = 0; i < block.lines.size(); ++i) {
      if (!block.lines[i].starts_with("> ")) continue;
      const std::string typed = block.lines[i].substr(2, block.lines[i].find("   ", 2) - 2);
      const bool is_answered = i + 1 < block.lines.size() && !block.lines[i + 1].starts_with("> ");
      text_ += "at=" + std::to_string(block.line + static_cast<int>(i)) + "\ntype_in '" + typed + "' '" +
               (is_answered ? block.lines[i + 1] : "") + "'\n";
    }
    text_ += "exec 8>&-\n";
  }

  std::string text_;
  std::map<int, std::vector<std::string>> values_;  // by line
  std::map<int, std::vector<std::string>> shown_;   // by the first line of the block before
};

std::vector<std::string> all_pages() {
  std::vector<std::string> pages = {"README.md", "CONTRIBUTING.md", "scenarios/README.md"};
  for (const auto& file : fs::directory_iterator(std::string(PROJECT_FOLDER) + "/docs")) {
    if (file.path().extension() == ".md") pages.push_back("docs/" + file.path().filename().string());
  }
  std::sort(pages.begin(), pages.end());
  return pages;
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class Page : public testing::TestWithParam<std::string> {};

TEST_P(Page, DoesWhatItSaysWhenItIsPasted) {
  const std::string& page = GetParam();
  std::vector<Block> blocks = blocks_of(page);
  std::erase_if(blocks, [&](const Block& block) { return is_left(page, block); });
  std::string text;
  for (const Block& block : blocks) {
    for (const std::string& line : block.lines) text += block.language == "sh" ? line + "\n" : "";
  }
  if (text.empty()) return;
  for (const auto& [word, path] : kNeeded) {
    if (text.find(word) != std::string::npos && !fs::exists(path))
      GTEST_SKIP() << path << " is not installed";
  }
  const PrivateFolder folder;
  for (const char* const part : {"scenarios", "examples"}) {
    if (text.find(part + std::string("/")) != std::string::npos)
      fs::copy(std::string(PROJECT_FOLDER) + "/" + part, folder / part, fs::copy_options::recursive);
  }
  fs::permissions(folder.write("run", kRun), fs::perms::owner_exec, fs::perm_options::add);
  const Script script(blocks);
  const char* const path = std::getenv("PATH");
  const std::string port = std::to_string(free_port());
  folder.write("script", std::regex_replace(script.text(), std::regex("\\b5020\\b"), port));
  const Finished played = run({"env", "-C", folder.path(), "bash", "script"},
                              {{"PATH", fs::path(UNDERSTUDY_BINARY).parent_path().string() + ":" +
                                            (path == nullptr ? "/usr/bin:/bin" : path)},
                               {"HOME", folder.path()},
                               {"XDG_RUNTIME_DIR", folder.path()}},
                              Wait(100'000));
  EXPECT_EQ(played.exit_code, 0) << played.errors;
  EXPECT_EQ(contents(folder / "failures"), "") << page << "\n" << played.errors;
  for (const auto& [line, values] : script.values())
    expect_in_order(contents(folder / ("value." + std::to_string(line))), values,
                    page + ":" + std::to_string(line));
  for (const auto& [line, shown] : script.shown())
    expect_in_order(contents(folder / ("block." + std::to_string(line))), shown,
                    page + ":" + std::to_string(line), true);
}

INSTANTIATE_TEST_SUITE_P(Pasted, Page, testing::ValuesIn(all_pages()), [](const auto& page) {
  return std::regex_replace(page.param, std::regex("[^A-Za-z0-9]"), "_");
});

/// This ensures that no block is missed because of its form.
TEST(PageBlocks, SayThatTheyAreCommandsAndWhatIsAValue) {
  const std::regex command("^(understudy|\\./run|mbpoll|\\$ ).*");
  const std::regex number_without_arrow(".*\\s# [0-9].*");
  for (const std::string& page : all_pages()) {
    for (const Block& block : blocks_of(page)) {
      if (is_left(page, block)) continue;
      for (std::size_t i = 0; i < block.lines.size(); ++i) {
        const std::string where = page + ":" + std::to_string(block.line + static_cast<int>(i));
        if (block.language.empty()) {
          EXPECT_FALSE(std::regex_match(block.lines[i], command))
              << where << ": a command in a block that is not `sh`";
        } else if (block.language == "sh") {
          EXPECT_FALSE(std::regex_match(block.lines[i], number_without_arrow))
              << where << ": a comment begins with a number; expected `# -> 1` for what a command prints";
        }
      }
    }
  }
}

TEST(PageBlocks, ThatAreNotPlayedAreStillThere) {
  for (const Left& left : kLeft) {
    const std::vector<Block> blocks = blocks_of(left.page);
    EXPECT_TRUE(std::any_of(blocks.begin(), blocks.end(),
                            [&](const Block& block) { return block.lines.front().starts_with(left.begin); }))
        << left.page << ": " << left.begin << " (" << left.why << ")";
  }
}

/// Returns the matching rows of a table that `describe` prints.
long rows_of(const Words& table, const std::regex& fits = std::regex(".*")) {
  Words words = {"describe"};
  words.insert(words.end(), table.begin(), table.end());
  words.insert(words.end(), {"--format", "csv"});
  const Words lines = lines_of(understudy(words).output);
  return std::count_if(lines.begin() + 1, lines.end(),
                       [&](const std::string& line) { return std::regex_match(line, fits); });
}

TEST(PageCounts, AreWhatTheTablesHold) {
  const Words simple2 = {"simple2-r3", "registers"};
  const Words super40nc = {"super-40nc", "registers"};
  const std::regex answer("\\| .*\\]\\([^)]*\\.yaml\\).*");
  const Words answers = lines_of(contents(std::string(PROJECT_FOLDER) + "/scenarios/README.md"));
  const struct {
    const char* page;
    const char* sentence;  // with the number in parentheses
    long counted;
  } counts[] = {
      {"README.md", "all ([0-9,]+) addresses",
       rows_of(simple2) + rows_of(simple2, std::regex("([^,]*,){4}32,.*"))},
      {"README.md", "all ([0-9,]+) instructions", rows_of({"simple2-r3", "instructions"})},
      {"docs/simple2-r3.md", "all ([0-9,]+) addresses",
       rows_of(simple2) + rows_of(simple2, std::regex("([^,]*,){4}32,.*"))},
      {"docs/simple2-r3.md", "all ([0-9,]+) instructions", rows_of({"simple2-r3", "instructions"})},
      {"README.md", "all ([0-9,]+) forms", rows_of({"slim", "commands"})},
      {"docs/slim.md", "all ([0-9,]+) forms", rows_of({"slim", "commands"})},
      {"README.md", "all ([0-9,]+) codes", rows_of({"rs-m8194h", "instructions"})},
      {"README.md", "([0-9,]+) contacts", rows_of(super40nc, std::regex("coil,.*"))},
      {"README.md", "([0-9][0-9,]*) inputs and", rows_of(super40nc, std::regex("discrete,.*"))},
      {"README.md", "([0-9,]+) registers of 32 bits on", rows_of(super40nc, std::regex("holding,.*"))},
      {"docs/super-40nc.md", "lists all ([0-9,]+) contacts", rows_of(super40nc)},
      {"docs/super-40nc.md", "the ([0-9,]+) mnemonics", rows_of({"super-40nc", "instructions"})},
      {"README.md", "([0-9,]+) scenarios, each of which answers",
       std::count_if(answers.begin(), answers.end(),
                     [&](const std::string& line) { return std::regex_match(line, answer); })}};
  for (const auto& one : counts) {
    const std::string text = contents(std::string(PROJECT_FOLDER) + "/" + one.page);
    std::smatch found;
    if (!std::regex_search(text, found, std::regex(one.sentence))) {
      ADD_FAILURE() << one.page << ": no '" << one.sentence << "'; expected it with " << one.counted;
      continue;
    }
    std::string number = found[1];
    std::erase(number, ',');
    EXPECT_EQ(number, std::to_string(one.counted)) << one.page << ": " << one.sentence;
  }
}

/// The runner itself notices errors.
TEST(PageBlocks, WithAnotherValueWouldBeNoticed) {
  const auto is_printed = [](const std::string& printed, const std::string& value) {
    return std::regex_search(printed, pattern_of(value, false));
  };
  EXPECT_TRUE(is_printed("feeder.Cord_A 16000\n", "16000"));
  EXPECT_FALSE(is_printed("feeder.Cord_A 160001\n", "16000"));
  EXPECT_FALSE(is_printed("feeder.Cord_A -16000\n", "16000"));
  EXPECT_TRUE(is_printed("[7234]: \t0\n", "[7234]: 0"));
  EXPECT_TRUE(is_printed("3 drop device nth=2: seen 0\n", "3 drop ...: seen 0"));
  EXPECT_EQ(values_of("1000, 1; as it stands"), (std::vector<std::string>{"1000", "1"}));
}

}  // namespace pages_test
}  // namespace understudy::acceptance
