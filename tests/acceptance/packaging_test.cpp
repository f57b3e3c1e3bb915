// What `cmake --install` and `cpack` make: it runs from where it was put, and says of itself what is true.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace packaging_test {

namespace fs = std::filesystem;

std::string contents(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

bool is_here(const std::string& program) { return run({"which", program}).exit_code == 0; }

/// Every command's words, from `understudy` itself ({}) down to `ctl resume`.
void collect_commands(const Words& command, std::vector<Words>& all) {
  all.push_back(command);
  Words asking = command;
  asking.emplace_back("--help");
  bool in_commands = false;
  for (const std::string& line : lines_of(understudy(asking).output)) {
    std::smatch found;
    if (in_commands && std::regex_search(line, found, std::regex("^  ([a-z-]+) "))) {
      Words sub = command;
      sub.push_back(found[1]);
      collect_commands(sub, all);
    }
    if (line == "Subcommands:") in_commands = true;
  }
}

class Installation : public testing::Test {
 protected:
  void SetUp() override {
    const Finished installed = run({CMAKE_PROGRAM, "--install", BUILD_FOLDER, "--prefix", prefix()});
    ASSERT_EQ(installed.exit_code, 0) << installed.output << installed.errors;
  }

  std::string prefix() const { return folder_ / "prefix"; }
  std::string program() const { return prefix() + "/bin/understudy"; }
  std::string page() const { return prefix() + "/share/man/man1/understudy.1.gz"; }
  std::string unit() const { return contents(prefix() + "/lib/systemd/system/understudy@.service"); }
  const PrivateFolder& folder() const { return folder_; }

 private:
  PrivateFolder folder_;
};

TEST_F(Installation, RunsFromWhereItIs) {
  const Finished models = run({program(), "models"});
  EXPECT_EQ(models.exit_code, 0) << models.errors;
  EXPECT_EQ(models.output, understudy({"models"}).output);
  EXPECT_NE(models.output.find("simple2-r3"), std::string::npos);
}

TEST_F(Installation, BringsBenchesThatAreValidAndPagesThatReadmeLinksTo) {
  for (const auto& bench : fs::directory_iterator(prefix() + "/share/understudy/scenarios")) {
    if (bench.path().extension() != ".yaml") continue;
    const Finished checked = run({program(), "check", bench.path()});
    EXPECT_EQ(checked.exit_code, 0) << checked.errors;
  }
  const std::string documentation = prefix() + "/share/doc/understudy/";
  const std::string readme = contents(documentation + "README.md");
  const std::regex link("\\]\\((docs/[^)#]+)\\)");
  for (std::sregex_iterator it(readme.begin(), readme.end(), link), end; it != end; ++it)
    EXPECT_TRUE(fs::exists(documentation + (*it)[1].str())) << (*it)[1];
  EXPECT_TRUE(fs::exists(documentation + "LICENSE"));
  EXPECT_TRUE(fs::exists(documentation + "copyright"));
}

TEST_F(Installation, BringsCompletionForShells) {
  for (const auto* const file :
       {"bash-completion/completions/understudy", "zsh/vendor-completions/_understudy",
        "fish/vendor_completions.d/understudy.fish"}) {
    EXPECT_NE(contents(prefix() + "/share/" + file).find("frames"), std::string::npos) << file;
  }
}

TEST_F(Installation, BringsSchemasForEditors) {
  for (const auto* const kind : {"bench", "scenario", "model"}) {
    const std::string schema = prefix() + "/share/understudy/schemas/" + kind + ".schema.json";
    EXPECT_EQ(contents(schema), understudy({"schema", kind}).output) << kind;
  }
  EXPECT_TRUE(fs::exists(prefix() + "/share/understudy/vscode/settings.json"));
}

TEST_F(Installation, HasAManPageWithEveryCommandAndFlagThatHelpTellsOf) {
  std::string text = run({"zcat", page()}).output;
  for (const auto& [roff, plain] : {std::pair<const char*, const char*>{"\\\\-", "-"},
                                    {"\\\\f[BIR]", ""},
                                    {"\\\\\\(aq", "'"},
                                    {"\\\\\\(dq", "\""},
                                    {"\\\\&", ""},
                                    {"`", ""}})
    text = std::regex_replace(text, std::regex(roff), plain);
  std::vector<Words> commands;
  collect_commands({}, commands);
  EXPECT_GT(commands.size(), 10U);
  for (Words command : commands) {
    command.emplace_back("--help");
    for (const std::string& line : lines_of(understudy(command).output)) {
      std::smatch found;
      if (line.starts_with("Usage: ") && command.size() > 1) {
        EXPECT_NE(text.find(line.substr(7)), std::string::npos) << line;
      }
      if (!std::regex_match(line, found, std::regex("  (-\\S+|[A-Z]\\S*) .*?  +(\\S.*)"))) continue;
      if (found[1] == "-h,--help" || found[1] == "--version") continue;  // of all, of none
      const std::string explained = std::regex_replace(found[2].str(), std::regex("`"), "");
      EXPECT_NE(text.find(found[1].str()), std::string::npos) << line;
      EXPECT_NE(text.find(explained), std::string::npos) << line;
    }
  }
  EXPECT_EQ(text.find('@' + std::string("COMMANDS")), std::string::npos);
  EXPECT_NE(text.find(understudy({"--version"}).output.substr(0, 5)), std::string::npos);
}

TEST_F(Installation, HasAManPageThatIsSetWithoutWarnings) {
  if (!is_here("man")) GTEST_SKIP() << "man is not installed";
  const Finished set = run({"man", "--warnings", "-l", page()}, {{"LC_ALL", "C.UTF-8"}, {"MANPAGER", "cat"}});
  EXPECT_EQ(set.exit_code, 0);
  EXPECT_EQ(set.errors, "");
  EXPECT_NE(set.output.find("understudy serve [OPTIONS] [BENCH]"), std::string::npos) << set.output;
}

TEST_F(Installation, HasAManPageForEachCommand) {
  if (!is_here("man")) GTEST_SKIP() << "man is not installed";
  std::vector<Words> commands;
  collect_commands({}, commands);
  for (const Words& command : commands) {
    if (command.size() != 1) continue;
    const std::string its = prefix() + "/share/man/man1/understudy-" + command[0] + ".1.gz";
    const Finished set = run({"man", "--warnings", "-l", its}, {{"LC_ALL", "C.UTF-8"}, {"MANPAGER", "cat"}});
    EXPECT_EQ(set.exit_code, 0) << its;
    EXPECT_EQ(set.errors, "") << its;
    EXPECT_NE(set.output.find("understudy " + command[0] + " [OPTIONS]"), std::string::npos) << set.output;
  }
}

/// A relative link and none at all: the folder of the bench may be one that a user cannot write to.
TEST_F(Installation, ServesAShippedBenchWithItsLinksElsewhere) {
  fs::create_directory(folder() / "links");
  Process daemon({program(), "serve", prefix() + "/share/understudy/scenarios/quickstart.yaml", "--links",
                  folder() / "links", "--control", folder() / "control"});
  ASSERT_TRUE(eventually([&] { return daemon.output().ends_with('\n'); })) << daemon.errors();
  EXPECT_EQ(ModbusHost(folder() / "links/quickstart.port").read(kHardwareCode), Registers{0xC001});
}

/// What systemd does with the unit, in short: the specifiers, the variables, the words.
Words start_command(const std::string& unit,
                    const std::vector<std::pair<std::string, std::string>>& replaced) {
  std::smatch found;
  if (!std::regex_search(unit, found, std::regex("\nExecStart=(.*)"))) return {};
  std::istringstream line(found[1].str());
  Words words;
  for (std::string word; line >> word;) {
    for (const auto& [mark, text] : replaced)
      for (std::size_t at = 0; (at = word.find(mark, at)) != std::string::npos; at += text.size())
        word.replace(at, mark.size(), text);
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

TEST_F(Installation, HasAUnitWhoseCommandServesABench) {
  fs::create_directories(folder() / "run/understudy/feeder");
  folder().write("feeder.yaml", R"(understudy: 1
lines:
  bus: { stations: [ { name: a, model: simple2-r3 } ] }
)");
  const std::string manager = folder() / "notify";
  const Descriptor listener(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  manager.copy(address.sun_path, sizeof(address.sun_path) - 1);
  ASSERT_EQ(bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);

  EXPECT_NE(unit().find("\nType=notify\n"), std::string::npos);
  const Words command = start_command(unit(), {{"%t", folder() / "run"},
                                               {"%S", folder() / "state"},
                                               {"%i", "feeder"},
                                               {"/etc/understudy", folder().path()},
                                               {"$SERVE_FLAGS", ""},
                                               {"dialout", std::to_string(getegid())}});
  ASSERT_FALSE(command.empty());
  EXPECT_EQ(command[0], program());
  Process daemon(command, {{"NOTIFY_SOCKET", manager}});
  std::array<char, 256> heard{};
  ASSERT_TRUE(eventually([&] { return recv(listener.get(), heard.data(), heard.size(), 0) > 0; }))
      << daemon.errors();
  EXPECT_STREQ(heard.data(), "READY=1");
  const std::string port = folder() / "run/understudy/feeder/bus.port";
  EXPECT_EQ(fs::status(port).permissions(), fs::perms(0660)) << "open to the group";
  EXPECT_EQ(ModbusHost(port).read(kHardwareCode), Registers{0xC001});
}

/// With nothing on PATH but these programs.
Finished with_programs(const Words& programs, const std::string& script) {
  const PrivateFolder folder;
  for (const std::string& program : programs) {
    std::string path = run({"which", program}).output;
    path.pop_back();
    fs::create_symlink(path, folder / program);
  }
  return run({"bash", "-uec",
              "PATH=" + folder.path() + "; . " PROJECT_FOLDER "/packaging/debian_packages.sh; " + script});
}

TEST(DebianPackages, AreListedWhereTheyCannotBeInstalled) {
  const Finished listed = with_programs({"id"}, "install_missing g++ no-such-package; echo on we go");
  EXPECT_EQ(listed.exit_code, 0) << listed.errors;
  EXPECT_EQ(listed.output,
            "nothing can be installed here (no apt-get, or not root); needed, by Debian 12's names: g++ "
            "no-such-package\non we go\n");
  EXPECT_EQ(listed.errors, "");
}

TEST(DebianPackages, OfTheBuildAreNamedOnThePage) {
  const Finished packages =
      run({"bash", "-uec",
           ". " PROJECT_FOLDER "/packaging/debian_packages.sh; printf '%s\n' ${build_packages[@]}"});
  const std::string page = contents(PROJECT_FOLDER "/docs/install.md");
  ASSERT_GT(lines_of(packages.output).size(), 5U);
  for (const std::string& package : lines_of(packages.output)) {
    EXPECT_NE(page.find(" " + package), std::string::npos) << package;
  }
}

TEST(DebianPackage, HoldsAProgramThatRunsAndNamesWhatItNeeds) {
  if (!is_here("dpkg-shlibdeps")) GTEST_SKIP() << "dpkg-dev is not installed";
  const PrivateFolder folder;
  Process cpack(
      {CPACK_PROGRAM, "--config", BUILD_FOLDER "/CPackConfig.cmake", "-G", "DEB", "-B", folder.path()});
  ASSERT_EQ(cpack.wait(Wait(60'000)), 0) << cpack.output() << cpack.errors();
  std::string package;
  for (const auto& file : fs::directory_iterator(folder.path()))
    if (file.path().extension() == ".deb") package = file.path();
  ASSERT_NE(package, "") << cpack.output();

  const std::string needed = run({"dpkg-deb", "-f", package, "Depends"}).output;
  for (const char* library : {"libc6", "libmodbus5"})
    EXPECT_NE(needed.find(library), std::string::npos) << needed;
  EXPECT_EQ(run({"dpkg-deb", "-f", package, "Package"}).output, "understudy\n");
  // The pages name them all, where the package was made for the Debian that they tell of.
  if (needed.find("libmodbus5 (") != std::string::npos) {
    const std::regex name("([a-z][-a-z0-9.+]*) \\(");
    for (std::sregex_iterator it(needed.begin(), needed.end(), name), end; it != end; ++it) {
      for (const char* page : {"/docs/ci.md", "/docs/install.md"}) {
        EXPECT_NE(contents(PROJECT_FOLDER + std::string(page)).find("`" + (*it)[1].str() + "`"),
                  std::string::npos)
            << page << " " << (*it)[1];
      }
    }
  }

  ASSERT_EQ(run({"dpkg-deb", "-x", package, folder / "root"}).exit_code, 0);
  EXPECT_EQ(run({folder / "root/usr/bin/understudy", "models"}).output, understudy({"models"}).output);
  const std::string unit = contents(folder / "root/usr/lib/systemd/system/understudy@.service");
  EXPECT_NE(unit.find("ExecStart=/usr/bin/understudy serve "), std::string::npos) << unit;
  const std::string page = run({"zcat", folder / "root/usr/share/man/man1/understudy.1.gz"}).output;
  EXPECT_NE(page.find("cp /usr/share/understudy/scenarios/quickstart.yaml"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "root/usr/share/doc/understudy/LICENSE")) << "Debian has it";

  ASSERT_EQ(run({"dpkg-deb", "-e", package, folder / "control"}).exit_code, 0);
  for (const char* script : {"postinst", "prerm", "postrm"})
    EXPECT_EQ(run({"sh", "-n", folder / (std::string("control/") + script)}).exit_code, 0) << script;
}

}  // namespace packaging_test
}  // namespace understudy::acceptance
