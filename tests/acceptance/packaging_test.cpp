// The results of `cmake --install` and `cpack`: the program runs from where it was installed, and its own
// statements are true.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

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

/// The words of every command, from `understudy` itself ({}) down to `ctl resume`.
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

/// All tests of this suite run in one process and use one installation, which takes seconds to make.
class Installation : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_folder = std::make_unique<PrivateFolder>(); }
  static void TearDownTestSuite() { shared_folder.reset(); }

  void SetUp() override {
    if (fs::exists(prefix())) return;
    const Finished installed = run({CMAKE_PROGRAM, "--install", BUILD_FOLDER, "--prefix", prefix()});
    ASSERT_EQ(installed.exit_code, 0) << installed.output << installed.errors;
  }

  std::string prefix() const { return folder() / "prefix"; }
  std::string program() const { return prefix() + "/bin/understudy"; }
  std::string page() const { return prefix() + "/share/man/man1/understudy.1.gz"; }
  std::string unit() const { return contents(prefix() + "/lib/systemd/system/understudy@.service"); }
  const PrivateFolder& folder() const { return *shared_folder; }

 private:
  static inline std::unique_ptr<PrivateFolder> shared_folder;
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

/// Returns the relative links of all pages below a folder, including folders that are links themselves.
Words dead_links_below(const std::string& folder) {
  Words dead;
  const std::regex link("\\]\\(([^)#\\s]+)[^)]*\\)");
  int links = 0;
  const auto options = fs::directory_options::follow_directory_symlink;
  for (const auto& file : fs::recursive_directory_iterator(folder, options)) {
    if (file.path().extension() != ".md") continue;
    const std::string text = contents(file.path());
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const std::string target = (*it)[1];
      if (target.find("://") != std::string::npos) continue;
      ++links;
      // Follows a link as the system does, and as a browser does, for which a link to a folder is that
      // folder.
      const fs::path followed = file.path().parent_path() / target;
      if (!fs::exists(followed) || !fs::exists(followed.lexically_normal()))
        dead.push_back(file.path().string() + ": " + target);
    }
  }
  EXPECT_GT(links, 800) << folder;
  return dead;
}

TEST_F(Installation, HasNoDeadLinkOnItsPages) {
  EXPECT_EQ(dead_links_below(prefix() + "/share/doc/understudy"), Words());
}

/// The folders of third_party/: libraries that are part of the program.
Words vendored() {
  Words folders;
  for (const auto& entry : fs::directory_iterator(PROJECT_FOLDER "/third_party"))
    if (entry.is_directory()) folders.push_back(entry.path().filename());
  EXPECT_GE(folders.size(), 3U);
  return folders;
}

/// Checks that Debian's `copyright` file has a paragraph for each of them, and the text that it names.
void expect_licences_in(const std::string& copyright) {
  for (const std::string& folder : vendored()) {
    const std::regex paragraph("\nFiles: third_party/" + folder + "/\\*\nCopyright: .+\nLicense: (\\S+)\n");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(copyright, found, paragraph)) << folder;
    EXPECT_NE(copyright.find("\n\nLicense: " + found[1].str() + "\n "), std::string::npos) << folder;
  }
}

TEST_F(Installation, HasTheChangesThatAreNotReleasedYet) {
  const std::string project = PROJECT_FOLDER;
  const std::string released = contents(project + "/CHANGELOG.md");
  const std::size_t newest = released.find("\n## ");
  ASSERT_NE(newest, std::string::npos);
  const Finished shown = run({"/usr/bin/python3", project + "/packaging/changelog.py", "show"});
  ASSERT_EQ(shown.exit_code, 0) << shown.errors;
  const bool has_some = shown.output.find("\n### ") != std::string::npos;
  EXPECT_EQ(contents(prefix() + "/share/doc/understudy/CHANGELOG.md"),
            released.substr(0, newest) + (has_some ? "\n" + shown.output : "") + released.substr(newest));
}

TEST_F(Installation, BringsTheLicencesOfVendoredLibraries) {
  const std::string documentation = prefix() + "/share/doc/understudy/";
  expect_licences_in(contents(documentation + "copyright"));
  for (const std::string& folder : vendored()) {
    const std::string licence = "/third_party/" + folder + "/LICENSE";
    EXPECT_EQ(contents(documentation + licence), contents(PROJECT_FOLDER + licence)) << folder;
  }
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
  EXPECT_TRUE(fs::exists(prefix() + "/share/understudy/recipes/vscode/settings.json"));
}

TEST_F(Installation, BringsTheExtensionForVsCode) {
  if (!is_here("python3")) GTEST_SKIP() << "python3 is not installed";
  const std::string version = lines_of(understudy({"--version"}).output).front();
  EXPECT_TRUE(fs::exists(prefix() + "/share/understudy/vscode/understudy-" + version + ".vsix"));
}

TEST_F(Installation, HasAManPageWithEveryCommandAndFlagOfHelp) {
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

/// A relative link, and none at all: a user may not be able to write to the bench's folder.
TEST_F(Installation, ServesAShippedBenchWithItsLinksElsewhere) {
  fs::create_directory(folder() / "links");
  Process daemon({program(), "serve", prefix() + "/share/understudy/scenarios/quickstart.yaml", "--links",
                  folder() / "links", "--control", folder() / "control"});
  ASSERT_TRUE(eventually([&] { return daemon.output().ends_with('\n'); })) << daemon.errors();
  EXPECT_EQ(ModbusHost(folder() / "links/quickstart.port").read(kHardwareCode), Registers{0xC001});
}

/// Imitates systemd's use of the unit: the specifiers, the variables, the words.
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
  std::array<char, 256> received{};
  ASSERT_TRUE(eventually([&] { return recv(listener.get(), received.data(), received.size(), 0) > 0; }))
      << daemon.errors();
  EXPECT_STREQ(received.data(), "READY=1");
  const std::string port = folder() / "run/understudy/feeder/bus.port";
  EXPECT_EQ(fs::status(port).permissions(), fs::perms(0660)) << "open to the group";
  EXPECT_EQ(ModbusHost(port).read(kHardwareCode), Registers{0xC001});
}

/// With only these programs in PATH.
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
            "nothing can be installed here (no apt-get); needed (Debian 12 names): g++ "
            "no-such-package\non we go\n");
  EXPECT_EQ(listed.errors, "");
}

/// An ordinary user can also query what is installed.
TEST(DebianPackages, ThatAreThereAreNotListed) {
  if (!is_here("dpkg-query")) GTEST_SKIP() << "this is not Debian";
  const std::string user = "id() { echo 1000; }; apt-get() { false; }; ";
  const Finished one = with_programs({"dpkg-query"}, user + "install_missing dpkg no-such-package bash");
  EXPECT_EQ(one.output,
            "nothing can be installed here (not root, and no sudo); needed (Debian 12 names): "
            "no-such-package\n")
      << one.errors;
  EXPECT_EQ(with_programs({"dpkg-query"}, user + "install_missing dpkg bash").output, "");
}

/// The two scripts with a project that builds in a moment.
class RunScript : public testing::Test {
 protected:
  RunScript() {
    for (const char* const part : {"packaging", "scenarios"}) fs::create_directories(project() + "/" + part);
    for (const char* const file : {"run", "CMakePresets.json", "packaging/debian_packages.sh"})
      fs::copy_file(std::string(PROJECT_FOLDER) + "/" + file, project() + "/" + file);
    folder_.write("a project/CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(small NONE)\n"
                  "add_custom_target(understudy COMMAND cp ${CMAKE_SOURCE_DIR}/program "
                  "${CMAKE_BINARY_DIR}/understudy VERBATIM)\n");
    fs::permissions(folder_.write("a project/program", "#!/bin/sh\necho \"it runs $*\"\n"),
                    fs::perms::owner_exec, fs::perm_options::add);
  }
  std::string project() const { return folder_ / "a project"; }
  Finished in(const std::string& project, const Words& words = {}) const {
    // Tests do not install anything.
    Words command = {"env",  "-C",
                     "/",    "bash",
                     "-c",   "id() { echo 1000; }; sudo() { false; }; export -f id sudo; exec \"$@\"",
                     "bash", project + "/run"};
    command.insert(command.end(), words.begin(), words.end());
    return run(command, {}, Wait(60'000));
  }
  PrivateFolder folder_;
};

TEST_F(RunScript, BuildsAgainWhereItsFolderWasMoved) {
  EXPECT_EQ(in(project(), {"models"}).output, "it runs models\n");
  fs::rename(project(), folder_ / "moved");
  const Finished moved = in(folder_ / "moved", {"models"});
  EXPECT_EQ(moved.exit_code, 0) << moved.errors;
  EXPECT_EQ(moved.output, "it runs models\n") << moved.errors;
}

TEST_F(RunScript, PrintsLinesThatCanBePastedWhereThePathHasASpace) {
  const Finished shown = in(project());
  ASSERT_EQ(shown.exit_code, 0) << shown.errors;
  int pasted = 0;
  for (const std::string& line : lines_of(shown.output)) {
    if (line.find("  mbpoll ") != 0) continue;
    ++pasted;
    const Finished words = run({"bash", "-c", "mbpoll() { printf '%s\n' \"$@\"; }; " + line});
    const Words message = lines_of(words.output);
    EXPECT_NE(std::find(message.begin(), message.end(), project() + "/scenarios/quickstart.port"),
              message.end())
        << line << "\n"
        << words.output;
  }
  EXPECT_EQ(pasted, 3) << shown.output;
}

std::string judged(const std::string& latenesses) {
  const std::string script = std::string(PROJECT_FOLDER) + "/tests/reference_timer.py";
  return run({"bash", "-c", "printf '" + latenesses + "' | /usr/bin/python3 " + script + " --judge"}).output;
}

TEST(ReferenceTimer, DistinguishesABusyMachineFromAQuietOne) {
  std::string quiet;
  for (int i = 0; i < 1000; ++i) quiet += i % 200 == 0 ? "60\\n" : "0.1\\n";
  EXPECT_EQ(judged(quiet), "") << "sometimes every wake-up is late";
  EXPECT_NE(judged(quiet + "700\\n").find("came up to 700 ms late"), std::string::npos);
  std::string busy;
  for (int i = 0; i < 1000; ++i) busy += i % 50 == 0 ? "60\\n" : "0.1\\n";
  EXPECT_NE(judged(busy).find("in 2.0 % of its rounds more than 50 ms"), std::string::npos) << judged(busy);
}

/// Simulates a machine that stands still for a second, by stopping its process.
TEST(ReferenceTimer, NoticesThatItStoodStill) {
  Process timer({"/usr/bin/python3", std::string(PROJECT_FOLDER) + "/tests/reference_timer.py"});
  ASSERT_TRUE(eventually([&] { return timer.errors() == "begins\n"; })) << timer.errors();
  timer.send(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));  // the time that it misses
  timer.send(SIGTERM);
  timer.send(SIGCONT);
  EXPECT_EQ(timer.wait(kPatience), 0) << timer.errors();
  EXPECT_NE(timer.output().find("too busy to judge"), std::string::npos) << timer.output();
}

/// The first checks of ./test do not need git: a tarball is enough, on a machine without git.
TEST(HouseStyle, IsJudgedWithoutGit) {
  if (!is_here("clang-format")) GTEST_SKIP() << "clang-format is not installed";
  const PrivateFolder folder;
  for (const char* const part : {"project/base", "project/build/release", "project/other", "bin"})
    fs::create_directories(folder / part);
  const std::string formatter = run({"which", "clang-format"}).output;
  fs::create_symlink(formatter.substr(0, formatter.size() - 1), folder / "bin/clang-format");
  folder.write("project/base/a.h", "int x();\n");
  folder.write("project/build/release/b.h", "int x();\n");
  folder.write("project/other/CMakeCache.txt", "");
  folder.write("project/other/c.h", "int x();\n");
  const Finished judged = run({"env", "PATH=" + folder / "bin", "/usr/bin/python3",
                               std::string(PROJECT_FOLDER) + "/tests/house_style.py", folder / "project"});
  EXPECT_EQ(judged.exit_code, 1);
  EXPECT_EQ(judged.output,
            "base/a.h:1: has no `#pragma once`; expected it behind the comment that begins the file\n");
  EXPECT_EQ(judged.errors, "");
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
  ASSERT_EQ(cpack.wait(Wait(300'000)), 0) << cpack.output() << cpack.errors();
  std::string package;
  for (const auto& file : fs::directory_iterator(folder.path()))
    if (file.path().extension() == ".deb") package = file.path();
  ASSERT_NE(package, "") << cpack.output();

  const std::string needed = run({"dpkg-deb", "-f", package, "Depends"}).output;
  for (const char* library : {"libc6", "libmodbus5"})
    EXPECT_NE(needed.find(library), std::string::npos) << needed;
  EXPECT_EQ(run({"dpkg-deb", "-f", package, "Package"}).output, "understudy\n");
  // The pages name all of them, if the package was built for the Debian release that they describe.
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

  // Equal sources make an equal package: no file has the time of this run.
  std::set<std::string> times;
  const std::regex time("[0-9]{4}-[0-9]{2}-[0-9]{2} [0-9]{2}:[0-9]{2}");
  for (const std::string& line : lines_of(run({"dpkg-deb", "-c", package}).output)) {
    std::smatch found;
    if (std::regex_search(line, found, time)) times.insert(found[0]);
  }
  EXPECT_EQ(times.size(), 1U) << *times.begin() << " to " << *times.rbegin();

  ASSERT_EQ(run({"dpkg-deb", "-x", package, folder / "root"}).exit_code, 0);
  EXPECT_EQ(run({folder / "root/usr/bin/understudy", "models"}).output, understudy({"models"}).output);
  const std::string unit = contents(folder / "root/usr/lib/systemd/system/understudy@.service");
  EXPECT_NE(unit.find("ExecStart=/usr/bin/understudy serve "), std::string::npos) << unit;
  const std::string page = run({"zcat", folder / "root/usr/share/man/man1/understudy.1.gz"}).output;
  EXPECT_NE(page.find("cp /usr/share/understudy/scenarios/quickstart.yaml"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "root/usr/share/doc/understudy/LICENSE")) << "Debian has it";
  expect_licences_in(contents(folder / "root/usr/share/doc/understudy/copyright"));

  EXPECT_EQ(dead_links_below(folder / "root/usr/share/doc/understudy"), Words());

  ASSERT_EQ(run({"dpkg-deb", "-e", package, folder / "control"}).exit_code, 0);
  for (const char* script : {"postinst", "prerm", "postrm"})
    EXPECT_EQ(run({"sh", "-n", folder / (std::string("control/") + script)}).exit_code, 0) << script;
}

}  // namespace packaging_test
}  // namespace understudy::acceptance
