// A port whose pseudo-terminal was lost: nothing spins, and the port is opened again after a while.
#include "emulator/serve/ports/port.h"
#include "emulator/models/models.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/emulator/serve/control/daemon_rig.h"
#include "tests/ordinary_user.h"

namespace understudy::emulator::serve {
namespace port_test {

using namespace std::chrono_literals;

/// While this object exists, no further file can be opened.
class NoDescriptors {
 public:
  NoDescriptors() {
    EXPECT_EQ(getrlimit(RLIMIT_NOFILE, &before_), 0);
    rlimit none = before_;
    none.rlim_cur = 3;  // standard input, output and errors are open
    EXPECT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  }
  ~NoDescriptors() { EXPECT_EQ(setrlimit(RLIMIT_NOFILE, &before_), 0); }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;

 private:
  rlimit before_{};
};

class LostPort : public testing::Test {
 protected:
  /// Runs the port until a condition is true.
  bool eventually(const std::function<bool()>& holds) {
    const WallTime until = wall_now() + 10s;
    while (!holds()) {
      if (wall_now() > until) return false;
      loop.wait(wall_now() + 1ms);
      presence->collect();
      port.poll(wall_now(), false);
    }
    return true;
  }
  int open_host() const { return open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK); }
  bool is_lost() const { return port.terminal()->is_lost(); }

  TestFolder folder;
  const std::string link = folder.path + "/port";
  world::World world{
      world::parse_bench(models::all_models(),
                         "understudy: 1\nlines: { a: { stations: [ { name: x, model: simple2-r3 } ] } }\n",
                         "bench.yaml", folder.path),
      {},
      {}};
  EventLoop loop;
  std::vector<std::string> log;
  std::shared_ptr<pty::PresenceWatch> presence = std::make_shared<pty::PresenceWatch>();
  Port port{loop, world, 0, link, presence, [] {}, [this](const std::string& line) { log.push_back(line); }};
};

// It releases the line to check whether a host is present, and cannot reopen it: the system has no descriptor
// left.
TEST_F(LostPort, IsTriedAgainEveryTenthOfASecond) {
  const int host = open_host();
  ASSERT_GE(host, 0);
  ASSERT_TRUE(eventually([&] { return port.host_present(); }));
  std::optional<WallTime> next;
  {
    const NoDescriptors none;
    const WallTime before = wall_now();
    close(host);
    ASSERT_TRUE(eventually([&] { return is_lost() && port.next_poll(false) > before + 99ms; }));
    next = port.next_poll(false);
    EXPECT_GE(*next, before + 100ms);
    EXPECT_LE(*next, wall_now() + 100ms);
    // Until then nothing wakes it: its descriptors are not watched, although they report a hang-up without
    // end.
    port.poll(*next - 1ns, false);
    EXPECT_EQ(port.next_poll(false), next);
    port.poll(*next, false);
    EXPECT_TRUE(is_lost());
    EXPECT_GT(port.next_poll(false), next);
    next = port.next_poll(false);
  }
  port.poll(*next - 1ns, false);
  EXPECT_TRUE(is_lost()) << "not before its time";
  port.poll(*next, false);
  EXPECT_FALSE(is_lost());
  EXPECT_EQ(port.next_poll(false), std::nullopt);
  EXPECT_EQ(log, std::vector<std::string>()) << "it is the same pseudo-terminal";
  const int another = open_host();
  ASSERT_GE(another, 0);
  EXPECT_TRUE(eventually([&] { return port.host_present(); }));
  close(another);
  EXPECT_TRUE(eventually([&] { return !port.host_present(); }));
}

// The link is removed, a host is hung up, and both come back with another pseudo-terminal.
TEST_F(LostPort, IsPulledOutAndPluggedInAgainByAFault) {
  const auto eventually_flushed = [&](const std::function<bool()>& holds) {
    return eventually([&] {
      world.advance_to(world.now() + 1ms);
      port.flush();
      return holds();
    });
  };
  const int host = open_host();
  ASSERT_GE(host, 0);
  ASSERT_TRUE(eventually([&] { return port.host_present(); }));
  ASSERT_EQ(chmod(port.terminal()->path().c_str(), 0660), 0);
  const std::size_t fault = world.inject({.kind = world::Fault::Kind::unplug, .on_line = true});
  EXPECT_TRUE(
      eventually_flushed([&] { return !std::filesystem::exists(std::filesystem::symlink_status(link)); }));
  char byte = 0;
  EXPECT_TRUE(eventually_flushed([&] { return read(host, &byte, 1) <= 0 && errno != EAGAIN; }));
  EXPECT_FALSE(port.host_present());
  EXPECT_FALSE(world.line(0).line.is_host_open());
  close(host);
  world.clear_fault(fault);
  EXPECT_TRUE(eventually_flushed([&] { return std::filesystem::exists(link); }));
  struct stat access {};
  EXPECT_EQ(stat(link.c_str(), &access), 0);
  EXPECT_EQ(access.st_mode & 0777U, 0660U);
  const int another = open_host();
  ASSERT_GE(another, 0);
  EXPECT_TRUE(eventually_flushed([&] { return port.host_present() && world.line(0).line.is_host_open(); }));
  close(another);
}

TEST(PortOfADaemon, InAFolderThatCannotBeWrittenReportsLinks) {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path + "/read-only");
  std::filesystem::permissions(folder.path + "/read-only", std::filesystem::perms(0555));
  const OrdinaryUser user(folder.path);
  const auto message = [&](const std::string& link) {
    const world::Bench bench = world::parse_bench(
        models::all_models(),
        "understudy: 1\nlines: { a: { link: " + link + ", stations: [ { name: x, model: simple2-r3 } ] } }\n",
        "bench.yaml", folder.path);
    DaemonOptions options;
    try {
      const Daemon daemon(bench, options, [](const std::string&) {});
      return std::string();
    } catch (const pty::PortError& error) {
      return std::string(error.what());
    }
  };
  const std::string refused = message("read-only/port");
  EXPECT_NE(refused.find("Permission denied"), std::string::npos) << refused;
  EXPECT_TRUE(refused.ends_with(" (--links FOLDER puts the links elsewhere)")) << refused;
  EXPECT_EQ(message("port"), "");
  EXPECT_EQ(message("none/port").find("--links"), std::string::npos) << "that is a different error";
}

}  // namespace port_test
}  // namespace understudy::emulator::serve
