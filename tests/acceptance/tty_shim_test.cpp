// The library that lets hosts that insist on parity use a pseudo-terminal: what it turns into success, and
// what it leaves alone. pymodbus at 8E1 is such a host: it sets its timeouts after it has opened the port.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace {

std::string shim_path() { return lines_of(understudy({"tty-shim"}).output).at(0); }

using SetAttributes = int (*)(int, int, const termios*);

class TtyShim : public testing::Test {
 protected:
  void SetUp() override {
    library_ = dlopen(shim_path().c_str(), RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(library_, nullptr) << dlerror();
    through_shim_ = reinterpret_cast<SetAttributes>(dlsym(library_, "tcsetattr"));
    ASSERT_NE(through_shim_, nullptr);
    int master = -1;
    int slave = -1;
    ASSERT_EQ(openpty(&master, &slave, nullptr, nullptr, nullptr), 0);
    master_ = pty::Descriptor(master);
    slave_ = pty::Descriptor(slave);
    ASSERT_EQ(tcgetattr(slave, &plain_), 0);
    cfmakeraw(&plain_);
    cfsetspeed(&plain_, B19200);
    ASSERT_EQ(tcsetattr(slave, TCSANOW, &plain_), 0);
  }
  void TearDown() override {
    if (library_ != nullptr) dlclose(library_);
  }

  /// What was set, with more flags.
  termios with(tcflag_t set, tcflag_t cleared = 0) const {
    termios asked = plain_;
    asked.c_cflag = (asked.c_cflag & ~cleared) | set;
    return asked;
  }
  /// 0, or the error.
  int shim(int descriptor, const termios& asked) const {
    errno = 0;
    return through_shim_(descriptor, TCSANOW, &asked) == 0 ? 0 : errno;
  }
  static int libc(int descriptor, const termios& asked) {
    errno = 0;
    return tcsetattr(descriptor, TCSANOW, &asked) == 0 ? 0 : errno;
  }
  int master() const { return master_.get(); }
  int slave() const { return slave_.get(); }

 private:
  void* library_ = nullptr;
  SetAttributes through_shim_ = nullptr;
  pty::Descriptor master_;
  pty::Descriptor slave_;
  termios plain_{};
};

TEST_F(TtyShim, TurnsTheErrorAboutParityIntoSuccess) {
  for (const tcflag_t parity : {PARENB, PARENB | PARODD}) {
    ASSERT_EQ(libc(slave(), with(PARENB)), EINVAL) << "this libc has no such error";
    EXPECT_EQ(shim(slave(), with(parity)), 0);
    EXPECT_EQ(shim(slave(), with(parity)), 0) << "again";
  }
}

TEST_F(TtyShim, LetsThroughWhatIsWellAnyway) {
  EXPECT_EQ(shim(slave(), with(0)), 0);
  termios faster = with(PARENB);
  cfsetspeed(&faster, B115200);
  EXPECT_EQ(shim(slave(), faster), 0);
  termios present{};
  ASSERT_EQ(tcgetattr(slave(), &present), 0);
  EXPECT_EQ(cfgetospeed(&present), static_cast<speed_t>(B115200));
}

TEST_F(TtyShim, LeavesOtherErrorsAlone) {
  EXPECT_EQ(shim(slave(), with(CS7 | PARENB, CSIZE)), EINVAL) << "seven bits were not set";
  EXPECT_EQ(shim(slave(), with(CS7, CSIZE)), EINVAL);
  EXPECT_EQ(shim(-1, with(PARENB)), EBADF);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_EQ(shim(ends[0], with(PARENB)), ENOTTY);
  close(ends[0]);
  close(ends[1]);
  EXPECT_EQ(shim(master(), with(PARENB)), libc(master(), with(PARENB))) << "the other end is no serial port";
}

TEST(TtyShimLibrary, NeedsNothingButLibc) {
  const Finished needs = run({"ldd", shim_path()});
  if (needs.exit_code == 127) GTEST_SKIP() << "ldd is not installed";
  EXPECT_EQ(needs.output.find("stdc++"), std::string::npos) << needs.output;
  EXPECT_EQ(needs.output.find("asan"), std::string::npos) << needs.output;
}

constexpr const char* kPymodbusAtEvenParity = R"(
import os, sys
from pymodbus.client import ModbusSerialClient
client = ModbusSerialClient(os.environ["UNDERSTUDY_PORT"], baudrate=19200, parity="E", timeout=2)
for opening in range(3):
    if not client.connect():
        sys.exit("did not connect")
    client.socket.timeout = 1.5
    print(client.read_holding_registers(1, 1, slave=1).registers)
    client.close()
)";

TEST(TtyShimWithPymodbus, IsWhatItTakesAt8E1) {
  if (!std::filesystem::exists("/usr/lib/python3/dist-packages/pymodbus"))
    GTEST_SKIP() << "python3-pymodbus is not installed";
  const PrivateFolder folder;
  const std::string bench = folder.write(
      "bench.yaml",
      "understudy: 1\nlines:\n  rs485: { stations: [ { name: feeder, model: simple2-r3, address: 1 } ] }\n");
  const auto exec = [&](const Words& flags) {
    Words words{"exec", bench, "--record", folder / "recording"};
    words.insert(words.end(), flags.begin(), flags.end());
    words.insert(words.end(), {"--", "/usr/bin/python3", "-c", kPymodbusAtEvenParity});
    return understudy(words);
  };
  const Finished without = exec({});
  EXPECT_NE(without.exit_code, 0) << "it works without: " << without.output;
  EXPECT_EQ(without.output, "");
  const Finished with = exec({"--tty-shim"});
  EXPECT_EQ(with.exit_code, 0) << with.errors;
  EXPECT_EQ(with.output, "[49153]\n[49153]\n[49153]\n");  // C001 hex
}

TEST(TtyShimWithExec, IsPutInFrontOfWhatIsPreloadedAlready) {
  const PrivateFolder folder;
  const std::string bench = folder.write(
      "bench.yaml",
      "understudy: 1\nlines:\n  rs485: { stations: [ { name: feeder, model: simple2-r3, address: 1 } ] }\n");
  const Words command{"exec", bench, "--tty-shim", "--", "sh", "-c", "echo $LD_PRELOAD"};
  EXPECT_EQ(understudy(command).output, shim_path() + "\n");
  EXPECT_EQ(understudy(command, {{"LD_PRELOAD", "libm.so.6"}}).output, shim_path() + ":libm.so.6\n");
}

}  // namespace
}  // namespace understudy::acceptance
