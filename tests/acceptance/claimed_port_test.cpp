// Hosts that claim the port for themselves (TIOCEXCL), as Qt's QSerialPort does at each opening, and are
// killed. Root can open a claimed port anyway, so daemon and hosts run as an ordinary user here.
#include <fcntl.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace claimed_port_test {

constexpr uid_t kNobody = 65534;

void become_ordinary() {
  if (geteuid() != 0) return;
  if (setgroups(0, nullptr) != 0 || setgid(kNobody) != 0 || setuid(kNobody) != 0) _exit(99);
}

/// Runs `act` in a process of an ordinary user. Returns its result, or 128 + the signal that ended it.
template <typename Act>
int as_ordinary_user(const Act& act) {
  const pid_t child = fork();
  if (child == 0) {
    become_ordinary();
    _exit(act());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Returns 0 if a host gets the hardware code; it may have to wait until the daemon notices that the previous
/// host is gone.
int ask_for_hardware_code(const std::string& port) {
  int descriptor = -1;
  for (int attempt = 0; attempt < 100 && descriptor < 0; ++attempt) {
    descriptor = open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (descriptor < 0 && errno != EBUSY) return 1;
    if (descriptor < 0) usleep(10'000);
  }
  if (descriptor < 0) return 2;
  close(descriptor);
  Host host(port);
  if (!host.set_even_parity(B19200)) return 3;
  return exchange(host, kReadHardwareCode, kHardwareCodeReply.size()) == kHardwareCodeReply ? 0 : 4;
}

class ClaimedPort : public testing::Test {
 protected:
  void SetUp() override {
    chmod(folder_.path().c_str(), 0777);
    const std::string binary = folder_ / "understudy";  // that user may not have access to the build folder
    std::filesystem::copy_file(UNDERSTUDY_BINARY, binary);
    chmod(binary.c_str(), 0755);
    Words command{binary,   "serve", "--model",   "simple2-r3",
                  "--link", port(),  "--control", folder_ / "control"};
    if (geteuid() == 0) {
      const std::string user = std::to_string(kNobody);
      const Words as_user{"setpriv", "--reuid=" + user, "--regid=" + user, "--clear-groups"};
      command.insert(command.begin(), as_user.begin(), as_user.end());
    }
    daemon_ = std::make_unique<Process>(command);
    ASSERT_TRUE(eventually([&] { return daemon_->output().find("ready ") != std::string::npos; }))
        << daemon_->errors();
  }
  void TearDown() override {
    daemon_->send(SIGTERM);
    EXPECT_EQ(daemon_->wait(kPatience), 0) << daemon_->errors();
    EXPECT_FALSE(std::filesystem::is_symlink(port()));
  }

  std::string port() const { return folder_ / "port"; }
  const Process& daemon() const { return *daemon_; }
  /// The daemon's processor time so far, in hundredths of a second.
  long processor_time() const {
    std::ifstream file("/proc/" + std::to_string(daemon_->pid()) + "/stat");
    std::string text;
    std::getline(file, text);
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    long user = -1;
    long kernel = -1;
    fields >> user >> kernel;
    return user + kernel;
  }
  void expect_idle() const {
    const long before = processor_time();
    std::this_thread::sleep_for(Wait(1'000));
    EXPECT_LE(processor_time() - before, 10) << "of 100";
  }

 private:
  PrivateFolder folder_;
  std::unique_ptr<Process> daemon_;
};

TEST_F(ClaimedPort, IsFreeAgainWhenItsHostIsKilled) {
  for (int time = 0; time < 4; ++time) {
    const int killed = as_ordinary_user([&] {
      Host host(port());
      if (!host.set_even_parity(B19200) || ioctl(host.descriptor(), TIOCEXCL) != 0) return 1;
      if (exchange(host, kReadHardwareCode, kHardwareCodeReply.size()) != kHardwareCodeReply) return 2;
      return kill(getpid(), SIGKILL);
    });
    ASSERT_EQ(killed, 128 + SIGKILL);
    EXPECT_EQ(as_ordinary_user([&] { return ask_for_hardware_code(port()); }), 0) << time;
  }
  expect_idle();
  EXPECT_EQ(daemon().errors(), "");
}

TEST_F(ClaimedPort, StaysClaimedWhileItsHostIsThere) {
  EXPECT_EQ(as_ordinary_user([&] {
              Host other(port());
              Host host(port());
              if (ioctl(host.descriptor(), TIOCEXCL) != 0) return 1;
              other.close();  // makes the daemon check whether a host is present
              if (exchange(host, kReadHardwareCode, kHardwareCodeReply.size()) != kHardwareCodeReply)
                return 2;
              usleep(50'000);
              if (open(port().c_str(), O_RDWR | O_NOCTTY) >= 0 || errno != EBUSY) return 3;
              ioctl(host.descriptor(), TIOCNXCL);
              return 0;
            }),
            0);
  expect_idle();
}

// The daemon must release the line for a moment to find out who is present; here it finds the line claimed
// when it takes it back.
TEST_F(ClaimedPort, IsServedAgainWhenTheDaemonWasKeptOut) {
  const std::filesystem::path first = std::filesystem::read_symlink(port());
  ASSERT_EQ(chmod(first.c_str(), 0666), 0);
  const auto is_anew = [&] { return std::filesystem::read_symlink(port()) != first; };
  const auto claim_all_the_time = [&] {
    Host host(port());
    std::vector<std::unique_ptr<Host>> others;
    for (int i = 0; i < 100; ++i) others.push_back(std::make_unique<Host>(port()));
    if (!host.set_even_parity(B19200)) return 1;
    if (exchange(host, kReadHardwareCode, kHardwareCodeReply.size()) != kHardwareCodeReply) return 2;
    std::atomic<bool> is_over{false};
    std::thread claiming([&] {
      while (!is_over) ioctl(host.descriptor(), TIOCEXCL);
    });
    for (const auto& other : others) {
      other->close();
      usleep(2'000);
    }
    // Without its own slave, the daemon continues to serve.
    if (exchange(host, kReadHardwareCode, kHardwareCodeReply.size()) != kHardwareCodeReply) return 3;
    is_over = true;
    claiming.join();
    ioctl(host.descriptor(), TIOCEXCL);
    return kill(getpid(), SIGKILL);
  };
  // The scheduler decides who comes first at that moment.
  constexpr int kMaxAttempts = 12;
  for (int attempt = 0; attempt < kMaxAttempts && !is_anew(); ++attempt) {
    ASSERT_EQ(as_ordinary_user(claim_all_the_time), 128 + SIGKILL);
    EXPECT_EQ(as_ordinary_user([&] { return ask_for_hardware_code(port()); }), 0) << attempt;
  }
  if (!is_anew()) GTEST_SKIP() << "the daemon was never locked out";
  struct stat access {};
  EXPECT_EQ(stat(port().c_str(), &access), 0);
  EXPECT_EQ(access.st_mode & 0777U, 0666U) << "an earlier client is still admitted";
  EXPECT_TRUE(eventually([&] {
    return daemon().errors().find("left " + first.string() + " claimed (TIOCEXCL)") != std::string::npos;
  })) << daemon().errors();
  EXPECT_EQ(as_ordinary_user([&] { return ask_for_hardware_code(port()); }), 0);
  expect_idle();
}

}  // namespace claimed_port_test
}  // namespace understudy::acceptance
