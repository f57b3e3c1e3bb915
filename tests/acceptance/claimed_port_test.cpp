// Hosts that claim the port for themselves (TIOCEXCL), as Qt's QSerialPort does at each opening, and are
// killed. Root may open a claimed port all the same, so daemon and hosts are an ordinary user here.
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

/// Runs `act` in a process of an ordinary user: what it returns, or 128 + the signal that ended it.
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

/// 0 if a host gets the hardware code; it may have to wait for the daemon to see the one before go.
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
    const std::string binary = folder_ / "understudy";  // the build folder may be out of that user's reach
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
  /// Of the daemon's life so far, in hundredths of a second.
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
              other.close();  // has the daemon look who is there
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

// The daemon has to let go of the line for a moment to see who is there; here it finds it claimed when it
// wants it back.
TEST_F(ClaimedPort, IsServedAnewWhenTheDaemonWasKeptOut) {
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
    // Without a slave of its own the daemon serves on.
    if (exchange(host, kReadHardwareCode, kHardwareCodeReply.size()) != kHardwareCodeReply) return 3;
    is_over = true;
    claiming.join();
    ioctl(host.descriptor(), TIOCEXCL);
    return kill(getpid(), SIGKILL);
  };
  // Who comes first in that moment is the scheduler's choice.
  constexpr int kMaxAttempts = 12;
  for (int attempt = 0; attempt < kMaxAttempts && !is_anew(); ++attempt) {
    ASSERT_EQ(as_ordinary_user(claim_all_the_time), 128 + SIGKILL);
    EXPECT_EQ(as_ordinary_user([&] { return ask_for_hardware_code(port()); }), 0) << attempt;
  }
  if (!is_anew()) GTEST_SKIP() << "the daemon was never kept out";
  struct stat access {};
  EXPECT_EQ(stat(port().c_str(), &access), 0);
  EXPECT_EQ(access.st_mode & 0777U, 0666U) << "who was let in before is still let in";
  EXPECT_TRUE(eventually([&] {
    return daemon().errors().find("left " + first.string() + " claimed (TIOCEXCL)") != std::string::npos;
  })) << daemon().errors();
  EXPECT_EQ(as_ordinary_user([&] { return ask_for_hardware_code(port()); }), 0);
  expect_idle();
}

}  // namespace claimed_port_test
}  // namespace understudy::acceptance
