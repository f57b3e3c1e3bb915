// Several daemons of one user: each has its own control socket, and `ctl` talks to the chosen one.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace control_choice_test {

namespace fs = std::filesystem;

/// Daemons without a given socket path, in their own runtime folder.
class SeveralDaemons : public testing::Test {
 protected:
  Environment environment() const {
    return {{"XDG_RUNTIME_DIR", folder_.path()}, {"UNDERSTUDY_CONTROL", ""}};
  }
  std::unique_ptr<Process> serve(const std::string& name) {
    const std::string bench = folder_.write(name + ".yaml", "understudy: 1\nlines: { rs485: { link: ./" +
                                                                name + ".port, stations: [ { name: " + name +
                                                                ", model: simple2-r3 } ] } }\n");
    auto daemon = std::make_unique<Process>(Words{UNDERSTUDY_BINARY, "serve", bench}, environment());
    EXPECT_TRUE(eventually([&] { return daemon->output().ends_with('\n'); })) << daemon->errors();
    EXPECT_EQ(daemon->errors(), "");
    return daemon;
  }
  std::string bench(const std::string& name) const { return folder_ / (name + ".yaml"); }
  std::string port(const std::string& name) const { return folder_ / (name + ".port"); }
  std::string socket(const Process& daemon) const {
    return folder_ / ("understudy/" + std::to_string(daemon.pid()) + ".control");
  }
  Finished ctl(Words words) const {
    words.insert(words.begin(), "ctl");
    return understudy(words, environment());
  }
  /// `get power` of the only device identifies the chosen daemon.
  void expect_chosen(const Words& flags, const std::string& name) const {
    Words words = flags;
    words.insert(words.end(), {"get", name + ".power"});
    const Finished finished = ctl(words);
    EXPECT_EQ(finished.output, name + ".power 1\n") << finished.errors;
    EXPECT_EQ(finished.exit_code, 0);
  }

  PrivateFolder folder_;
};

TEST_F(SeveralDaemons, TheOnlyOneIsMeant) {
  const Finished none = ctl({"status"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(none.errors, "understudy: ctl: no daemon answers in " + (folder_ / "understudy") +
                             "; expected a running `understudy serve`, or --control SOCKET\n");
  const auto feeder = serve("feeder");
  EXPECT_TRUE(fs::is_socket(socket(*feeder)));
  expect_chosen({}, "feeder");
  feeder->send(SIGTERM);
  EXPECT_EQ(feeder->wait(kPatience), 0);
  EXPECT_FALSE(fs::exists(socket(*feeder)));
}

TEST_F(SeveralDaemons, OfTwoNoneIsGuessedAndEachIsNamed) {
  const auto feeder = serve("feeder");
  const auto turner = serve("turner");
  for (const Words& words : {Words{"pause"}, Words{"watch", "--times", "1"}, Words{"frames", "--once"}}) {
    const Finished refused = ctl(words);
    EXPECT_EQ(refused.exit_code, 2) << words[0];
    EXPECT_EQ(refused.output, "") << words[0];
    EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
    for (const std::string& part :
         {std::string("ctl: 2 daemons are running; expected --bench FILE, --port LINK or --control SOCKET"),
          socket(*feeder) + " (bench " + bench("feeder") + ", port " + port("feeder") + ")",
          socket(*turner) + " (bench " + bench("turner") + ", port " + port("turner") + ")"}) {
      EXPECT_NE(refused.errors.find(part), std::string::npos) << part << " in " << refused.errors;
    }
  }
  const Finished list = ctl({"daemons"});
  EXPECT_EQ(lines_of(list.output).size(), 2U) << list.output;
  EXPECT_NE(list.output.find(port("turner")), std::string::npos) << list.output;
  for (const auto* const name : {"feeder", "turner"}) {
    expect_chosen({"--bench", bench(name)}, name);
    expect_chosen({"--port", port(name)}, name);
    expect_chosen({"--port", fs::canonical(port(name)).string()}, name);
  }
  expect_chosen({"--control", socket(*turner)}, "turner");
}

TEST_F(SeveralDaemons, AreListedForScripts) {
  const auto feeder = serve("feeder");
  const auto turner = serve("turner");
  for (const Words& words : {Words{"daemons", "--json"}, Words{"--json", "daemons"}}) {
    const Finished list = ctl(words);
    EXPECT_EQ(list.exit_code, 0) << list.errors;
    const auto daemons = nlohmann::json::parse(list.output).at("daemons");
    ASSERT_EQ(daemons.size(), 2U);
    const auto is_feeders = [&](const auto& daemon) { return daemon.at("socket") == socket(*feeder); };
    const auto found = std::find_if(daemons.begin(), daemons.end(), is_feeders);
    ASSERT_NE(found, daemons.end()) << list.output;
    EXPECT_EQ(found->at("bench"), bench("feeder"));
    EXPECT_EQ(found->at("answers"), true);
    EXPECT_EQ(found->at("ports").size(), 1U);
    EXPECT_EQ(found->at("ports")[0].at("link"), port("feeder"));
    EXPECT_EQ(found->at("ports")[0].at("pty"), fs::canonical(port("feeder")).string());
  }
}

TEST_F(SeveralDaemons, OfTwoThatServeOneBenchAPortTells) {
  const auto first = serve("feeder");
  const std::string links = folder_ / "links";
  fs::create_directory(links);
  Process second(Words{UNDERSTUDY_BINARY, "serve", bench("feeder"), "--links", links}, environment());
  ASSERT_TRUE(eventually([&] { return second.output().ends_with('\n'); })) << second.errors();
  const Finished refused = ctl({"--bench", bench("feeder"), "status"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors.find(
                "understudy: ctl: 2 daemons match --bench " + bench("feeder") +
                "; expected an additional --port LINK, or --control SOCKET, for one of: " + folder_.path()),
            0U)
      << refused.errors;
  expect_chosen({"--bench", bench("feeder"), "--port", port("feeder")}, "feeder");
  const Finished nobody = ctl({"--bench", folder_ / "mill.yaml", "--port", port("feeder"), "status"});
  EXPECT_EQ(nobody.exit_code, 3);
  EXPECT_EQ(nobody.errors.find("understudy: ctl: no daemon serves " + (folder_ / "mill.yaml") + " on " +
                               port("feeder") + "; running: "),
            0U)
      << nobody.errors;
}

TEST_F(SeveralDaemons, OneThatIsNotThereIsNotReplacedByAnother) {
  const auto feeder = serve("feeder");
  for (const Words& flags :
       {Words{"--bench", folder_ / "mill.yaml"}, Words{"--port", folder_ / "mill.port"}}) {
    const Finished refused = ctl({flags[0], flags[1], "pause"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_EQ(refused.errors.find("understudy: ctl: no daemon serves " + flags[1] +
                                  "; running: " + socket(*feeder)),
              0U)
        << refused.errors;
  }
  EXPECT_EQ(ctl({"--bench", bench("feeder"), "--control", socket(*feeder), "status"}).exit_code, 2);
}

TEST_F(SeveralDaemons, OneThatWasKilledIsForgotten) {
  const auto killed = serve("feeder");
  const auto alive = serve("turner");
  killed->send(SIGKILL);
  EXPECT_EQ(killed->wait(kPatience), 128 + SIGKILL);
  EXPECT_TRUE(fs::exists(socket(*killed)));
  expect_chosen({}, "turner");
  EXPECT_FALSE(fs::exists(socket(*killed)));
}

TEST_F(SeveralDaemons, OneThatStandsStillIsNamedAsWell) {
  const auto still = serve("feeder");
  const auto alive = serve("turner");
  still->send(SIGSTOP);
  const Finished refused = ctl({"status"});
  expect_chosen({"--bench", bench("turner")}, "turner");
  still->send(SIGCONT);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find(socket(*still) + " (does not answer)"), std::string::npos) << refused.errors;
}

}  // namespace control_choice_test
}  // namespace understudy::acceptance
