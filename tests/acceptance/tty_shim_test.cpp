// The library that lets hosts that insist on parity use a pseudo-terminal: which calls it makes succeed, and
// which it leaves alone. pymodbus at 8E1 is such a host: it sets its timeouts after it has opened the port.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <linux/serial.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace tty_shim_test {

std::string shim_path() { return lines_of(understudy({"tty-shim"}).output).at(0); }

using SetAttributes = int (*)(int, int, const termios*);
using Ioctl = int (*)(int, unsigned long, ...);

class TtyShim : public testing::Test {
 protected:
  void SetUp() override {
    library_ = dlopen(shim_path().c_str(), RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(library_, nullptr) << dlerror();
    through_shim_ = reinterpret_cast<SetAttributes>(dlsym(library_, "tcsetattr"));
    ASSERT_NE(through_shim_, nullptr);
    ioctl_ = reinterpret_cast<Ioctl>(dlsym(library_, "ioctl"));
    ASSERT_NE(ioctl_, nullptr);
    int master = -1;
    int slave = -1;
    ASSERT_EQ(openpty(&master, &slave, nullptr, nullptr, nullptr), 0);
    master_ = Descriptor(master);
    slave_ = Descriptor(slave);
    ASSERT_EQ(tcgetattr(slave, &plain_), 0);
    cfmakeraw(&plain_);
    cfsetspeed(&plain_, B19200);
    ASSERT_EQ(tcsetattr(slave, TCSANOW, &plain_), 0);
  }
  void TearDown() override {
    if (library_ != nullptr) dlclose(library_);
  }

  /// The settings, with more flags.
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
  /// Like the above, for an ioctl.
  int control(int descriptor, unsigned long request, void* argument) const {
    errno = 0;
    return ioctl_(descriptor, request, argument) == 0 ? 0 : errno;
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
  Ioctl ioctl_ = nullptr;
  Descriptor master_;
  Descriptor slave_;
  termios plain_{};
};

TEST_F(TtyShim, TurnsTheErrorAboutParityIntoSuccess) {
  for (const tcflag_t parity : {PARENB, PARENB | PARODD}) {
    ASSERT_EQ(libc(slave(), with(PARENB)), EINVAL) << "this libc does not have this error";
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
  EXPECT_EQ(shim(master(), with(PARENB)), libc(master(), with(PARENB)))
      << "the other end is not a serial port";
}

TEST_F(TtyShim, AnswersForModemLinesAsIfWiredThrough) {
  constexpr int kAll = TIOCM_CTS | TIOCM_DSR | TIOCM_CD | TIOCM_RTS | TIOCM_DTR;
  int lines = 0;
  ASSERT_EQ(ioctl(slave(), TIOCMGET, &lines), -1) << "this kernel's pseudo-terminals have modem lines";
  const auto now = [&] {
    int answered = -1;
    EXPECT_EQ(control(slave(), TIOCMGET, &answered), 0);
    return answered;
  };
  EXPECT_EQ(now(), kAll);
  lines = TIOCM_RTS | TIOCM_CTS;  // the host cannot set CTS
  EXPECT_EQ(control(slave(), TIOCMBIC, &lines), 0);
  EXPECT_EQ(now(), kAll & ~TIOCM_RTS);
  lines = TIOCM_DTR;
  EXPECT_EQ(control(slave(), TIOCMBIC, &lines), 0);
  lines = TIOCM_RTS;
  EXPECT_EQ(control(slave(), TIOCMBIS, &lines), 0);
  EXPECT_EQ(now(), kAll & ~TIOCM_DTR);
  lines = TIOCM_DTR;
  EXPECT_EQ(control(slave(), TIOCMSET, &lines), 0);
  EXPECT_EQ(now(), kAll & ~TIOCM_RTS);
}

TEST_F(TtyShim, RemembersRs485ModeAndLowLatency) {
  serial_rs485 mode{};
  EXPECT_EQ(control(slave(), TIOCGRS485, &mode), 0);
  EXPECT_EQ(mode.flags, 0U);
  mode.flags = SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND;
  mode.delay_rts_after_send = 3;
  EXPECT_EQ(control(slave(), TIOCSRS485, &mode), 0);
  serial_rs485 again{};
  EXPECT_EQ(control(slave(), TIOCGRS485, &again), 0);
  EXPECT_EQ(again.flags, mode.flags);
  EXPECT_EQ(again.delay_rts_after_send, 3U);
  serial_struct serial{};
  EXPECT_EQ(control(slave(), TIOCGSERIAL, &serial), 0);
  EXPECT_EQ(serial.type, PORT_16550A) << "an existing UART";
  EXPECT_EQ(serial.flags & ASYNC_LOW_LATENCY, 0);
  serial.flags |= ASYNC_LOW_LATENCY;
  EXPECT_EQ(control(slave(), TIOCSSERIAL, &serial), 0);
  serial = {};
  EXPECT_EQ(control(slave(), TIOCGSERIAL, &serial), 0);
  EXPECT_NE(serial.flags & ASYNC_LOW_LATENCY, 0);
}

TEST_F(TtyShim, LeavesOtherRequestsAndDescriptorsAlone) {
  int number = 0;
  EXPECT_EQ(control(slave(), FIONREAD, &number), 0);
  EXPECT_EQ(control(slave(), TIOCMIWAIT, nullptr), ENOTTY);
  EXPECT_EQ(control(slave(), TIOCMGET, nullptr), EFAULT);
  EXPECT_EQ(control(-1, TIOCMGET, &number), EBADF);
  EXPECT_EQ(control(master(), TIOCMGET, &number), ENOTTY) << "the other end is not a serial port";
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_EQ(control(ends[0], TIOCMGET, &number), ENOTTY);
  close(ends[0]);
  close(ends[1]);
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

/// A program that runs under `exec`, with or without the shim.
Finished run_host(const char* script, bool with_shim) {
  const PrivateFolder folder;
  const std::string bench = folder.write(
      "bench.yaml",
      "understudy: 1\nlines:\n  rs485: { stations: [ { name: feeder, model: simple2-r3, address: 1 } ] }\n");
  Words words{"exec", bench, "--record", folder / "recording"};
  if (with_shim) words.emplace_back("--tty-shim");
  words.insert(words.end(), {"--", "/usr/bin/python3", "-c", script});
  return understudy(words);
}

constexpr const char* kPyserialWithEverything = R"(
import os, serial, serial.rs485
port = serial.Serial(os.environ["UNDERSTUDY_PORT"], 19200, parity="E", timeout=2)
port.parity = "E"
port.timeout = 1.5
print(port.cts, port.dsr, port.cd, port.ri)
port.rts = False
port.dtr = False
port.rts = True
port.rs485_mode = serial.rs485.RS485Settings()
port.set_low_latency_mode(True)
port.write(bytes.fromhex("010300010001D5CA"))
print(port.read(7).hex())
)";

TEST(TtyShimWithPyserial, HasModemLinesRs485ModeAndLowLatency) {
  if (!std::filesystem::exists("/usr/lib/python3/dist-packages/serial"))
    GTEST_SKIP() << "python3-serial is not installed";
  EXPECT_NE(run_host(kPyserialWithEverything, false).exit_code, 0) << "it works without";
  const Finished with = run_host(kPyserialWithEverything, true);
  EXPECT_EQ(with.exit_code, 0) << with.errors;
  EXPECT_EQ(with.output, "True True True False\n010302c0012984\n");
}

constexpr const char* kLibmodbusWithRs485 = R"(
import ctypes, os
library = ctypes.CDLL("libmodbus.so.5", use_errno=True)
library.modbus_new_rtu.restype = ctypes.c_void_p
library.modbus_new_rtu.argtypes = [ctypes.c_char_p, ctypes.c_int, ctypes.c_char, ctypes.c_int, ctypes.c_int]
context = ctypes.c_void_p(library.modbus_new_rtu(os.environ["UNDERSTUDY_PORT"].encode(), 19200, b"E", 8, 1))
library.modbus_set_slave(context, 1)
assert library.modbus_connect(context) == 0
print(library.modbus_rtu_set_serial_mode(context, 1), library.modbus_rtu_get_serial_mode(context))
print(library.modbus_rtu_set_rts(context, 1))
registers = (ctypes.c_uint16 * 1)()
print(library.modbus_read_registers(context, 1, 1, registers), registers[0])
)";

TEST(TtyShimWithLibmodbus, HasRs485ModeAndRts) {
  const Finished without = run_host(kLibmodbusWithRs485, false);
  EXPECT_EQ(without.output, "-1 0\n0\n1 49153\n") << without.errors;
  const Finished with = run_host(kLibmodbusWithRs485, true);
  EXPECT_EQ(with.exit_code, 0) << with.errors;
  EXPECT_EQ(with.output, "0 1\n0\n1 49153\n");
}

TEST(TtyShimHint, IsShownToPeopleWhoseLineHasParity) {
  struct Case {
    std::string model;
    bool is_told;
  };
  for (const Case& each : {Case{"simple2-r3", true}, Case{"slim", false}}) {
    const PrivateFolder folder;
    const Words serve{UNDERSTUDY_BINARY, "serve",         "--model",   each.model,
                      "--link",          folder / "port", "--control", folder / "c"};
    std::string command;
    for (const std::string& word : serve) command += word + " ";
    // `script` gives it a terminal of its own.
    const Process on_terminal({"script", "-qfec", command, "/dev/null"});
    EXPECT_TRUE(eventually([&] { return on_terminal.output().find("ready ") != std::string::npos; }));
    const bool is_told = on_terminal.output().find("LD_PRELOAD=$(understudy tty-shim)") != std::string::npos;
    EXPECT_EQ(is_told, each.is_told) << on_terminal.output();
  }
  const RunningUnderstudy in_a_script;
  EXPECT_EQ(in_a_script.errors(), "");
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

}  // namespace tty_shim_test
}  // namespace understudy::acceptance
