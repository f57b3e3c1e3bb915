// A scenario that runs next to a daemon whose loop ends: it is abandoned, and nobody waits for it.
#include "emulator/play/performing/side_scenario.h"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>
#include <thread>

#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace side_scenario_test {

using namespace std::chrono_literals;

struct LoopError : std::runtime_error {
  LoopError() : std::runtime_error("the loop has failed") {}
};

std::unique_ptr<serve::Daemon> make_daemon(const Scenario& scenario) {
  serve::DaemonOptions options;
  options.watch_signals = false;
  return std::make_unique<serve::Daemon>(scenario.bench, options, [](const std::string&) {});
}

/// Something to wait for that fails in the daemon's loop.
class Trap {
 public:
  explicit Trap(serve::Daemon& daemon)
      : daemon_(daemon), descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    daemon_.loop().watch(descriptor_, serve::EventLoop::readable, [](std::uint32_t) { throw LoopError(); });
  }
  ~Trap() {
    daemon_.loop().unwatch(descriptor_);
    close(descriptor_);
  }
  Trap(const Trap&) = delete;
  Trap& operator=(const Trap&) = delete;
  void spring() const {
    const std::uint64_t one = 1;
    EXPECT_EQ(write(descriptor_, &one, sizeof one), static_cast<ssize_t>(sizeof one));
  }

 private:
  serve::Daemon& daemon_;
  int descriptor_;
};

/// Next to steps that last an hour, or wait that long.
void end_beside(const std::string& steps, bool by_failure) {
  const Scenario scenario = scenario_of(steps);
  const auto daemon = make_daemon(scenario);
  const Trap trap(*daemon);
  bool was_over = false;
  SideScenario side_scenario(scenario, *daemon, [&] { was_over = true; });
  // It is in the middle of its steps by then, or earlier: the result is the same.
  std::thread springs([&] {
    std::this_thread::sleep_for(30ms);
    if (by_failure) return trap.spring();
    daemon->post([&] { daemon->stop(); });
  });
  if (by_failure) {
    EXPECT_THROW(daemon->run(), LoopError);
  } else {
    daemon->run();
  }
  springs.join();
  EXPECT_TRUE(daemon->is_over());
  EXPECT_FALSE(daemon->post([] { ADD_FAILURE() << "this does not run"; }));
  EXPECT_FALSE(was_over);
}

TEST(SideScenario, IsGivenUpWhereTheDaemonEnds) {
  for (const bool by_failure : {true, false}) {
    end_beside("  - advance: 1h\n", by_failure);
    end_beside("  - wait: { until: feeder.STATUS == 1, within: 1h }\n", by_failure);
    end_beside("  - always: feeder.power\n  - advance: 1h\n", by_failure);
  }
}

TEST(SideScenario, IsGivenUpWhereTheDaemonFailsAtOnce) {
  const Scenario scenario = scenario_of("  - always: feeder.power\n  - advance: 1h\n");
  const auto daemon = make_daemon(scenario);
  const Trap trap(*daemon);
  trap.spring();
  SideScenario side_scenario(scenario, *daemon, [] { ADD_FAILURE() << "it has ended"; });
  EXPECT_THROW(daemon->run(), LoopError);
}

TEST(Daemon, DropsWhatWasPostedTooLate) {
  const auto daemon = make_daemon(scenario_of("  - say: nothing\n"));
  auto held = std::make_shared<int>(0);
  EXPECT_TRUE(daemon->post([&] {
    daemon->stop();
    EXPECT_TRUE(daemon->post([held] { ADD_FAILURE() << "the loop has ended"; }));
    EXPECT_EQ(held.use_count(), 2);
  }));
  daemon->run();
  EXPECT_EQ(held.use_count(), 1);
}

}  // namespace side_scenario_test
}  // namespace understudy::emulator::play
