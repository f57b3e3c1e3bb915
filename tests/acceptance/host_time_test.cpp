// Unmodified hosts in simulated time (exec --host-time), on real pseudo-terminals.
#include <elf.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/acceptance/host_time_rig.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_time_test {

bool has_module(const std::string& name) {
  return std::filesystem::exists("/usr/lib/python3/dist-packages/" + name);
}

TEST_F(HostTime, AnswersClocksAndSleeps) {
  const Finished host = python(R"(
import os, time
os.environ["TZ"] = "UTC"
time.tzset()
began, up = time.time(), time.monotonic()
print(time.strftime("%Y-%m-%d %H:%M:%S"), up)
time.sleep(86400)
print(time.time() - began, time.monotonic() - up, time.strftime("%Y-%m-%d"))
)");
  EXPECT_EQ(host.exit_code, 0) << host.errors;
  EXPECT_EQ(host.output, "2026-01-01 00:00:00 3600.0\n86400.0 86400.0 2026-01-02\n");
}

/// Their end is often noticed before their greeting.
TEST_F(HostTime, GivesTheExitCodeOfHostsThatEndAtOnce) {
  for (int i = 0; i < 20; ++i) {
    const Finished host = exec({"false"});
    EXPECT_EQ(host.exit_code, 1) << host.errors;
  }
}

TEST_F(HostTime, WaitsForALineAsLongAsItTakes) {
  // Eight characters to the device, seven back, each of 11 bits at 19,200 baud, and the silence before the
  // reply.
  const Finished host = python_twice(R"(
import os, select, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
request = bytes.fromhex("010300010001D5CA")
for wait in (lambda: select.select([port], [], [], 2)[0], lambda: select.poll().register(port) or True):
    began = time.monotonic()
    os.write(port, request)
    answer = b""
    while len(answer) < 7 and select.select([port], [], [], 2)[0]:
        answer += os.read(port, 7)
    print(answer.hex(), time.monotonic() - began < 0.02)
began = time.monotonic()
print(select.select([port], [], [], 2)[0], time.monotonic() - began)
poll = select.poll()
poll.register(port, select.POLLIN)
began = time.monotonic()
print(poll.poll(2500), time.monotonic() - began)
epoll = select.epoll()
epoll.register(port, select.EPOLLIN)
began = time.monotonic()
print(epoll.poll(3), time.monotonic() - began)
os.write(port, request)
print(epoll.poll(3) == [(port, 1)])
)");
  EXPECT_EQ(host.output, "010302c0012984 True\n010302c0012984 True\n[] 2.0\n[] 2.5\n[] 3.0\nTrue\n");
}

TEST_F(HostTime, EndsReadsByVminAndVtime) {
  const Finished host = python_twice(R"(
import os, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
def patience(least, tenths):
    settings = termios.tcgetattr(port)
    settings[4] = settings[5] = termios.B19200
    settings[6][termios.VMIN], settings[6][termios.VTIME] = least, tenths
    termios.tcsetattr(port, termios.TCSANOW, settings)
request = bytes.fromhex("010300010001D5CA")
def asked(least, tenths, size, asks=True):
    patience(least, tenths)
    began = time.monotonic()
    if asks:
        os.write(port, request)
    print(len(os.read(port, size)), round(time.monotonic() - began, 1))
    if asks:
        termios.tcdrain(port)
        time.sleep(0.1)
        termios.tcflush(port, termios.TCIFLUSH)
asked(7, 0, 100)           # all of the reply
asked(100, 5, 100)         # half a second after its last byte
asked(0, 15, 100, False)   # nothing comes for a second and a half
asked(0, 15, 100)          # the first byte
)");
  EXPECT_EQ(host.output, "7 0.0\n7 0.5\n0 1.5\n1 0.0\n");
}

TEST_F(HostTime, TakesTcdrainForAsLongAsTheWire) {
  const Finished host = python(R"(
import os, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
began = time.monotonic()
os.write(port, bytes(192))  # of 11 bits
termios.tcdrain(port)
print(round(time.monotonic() - began, 6))
)");
  EXPECT_EQ(host.output, "0.11\n") << host.errors;
}

TEST_F(HostTime, MovesPyserial) {
  if (!has_module("serial")) GTEST_SKIP() << "python3-serial is not installed";
  const Finished host = python_twice(R"(
import os, serial, time
port = serial.Serial(os.environ["UNDERSTUDY_PORT"], 19200, parity="E", timeout=0.5)
began = time.monotonic()
for poll in range(20):
    port.write(bytes.fromhex("010300010001D5CA"))
    port.flush()
    assert port.read(7).hex() == "010302c0012984"
    time.sleep(3)
print(port.read(1), round(time.monotonic() - began))
)");
  EXPECT_EQ(host.output, "b'' 61\n");
}

TEST_F(HostTime, MovesPymodbus) {
  if (!has_module("pymodbus")) GTEST_SKIP() << "python3-pymodbus is not installed";
  const Finished host = python_twice(R"(
import os, time
from pymodbus.client import ModbusSerialClient
client = ModbusSerialClient(os.environ["UNDERSTUDY_PORT"], baudrate=19200, parity="E", timeout=2)
began = time.time()
for poll in range(6):
    assert client.connect()
    assert client.read_holding_registers(1, 1, slave=1).registers == [49153]
    time.sleep(10)
    if poll % 2: client.close()
client.connect()
print(client.read_holding_registers(1, 1, slave=9).isError(), round(time.time() - began))
)");
  EXPECT_EQ(host.output, "True 62\n");
}

TEST_F(HostTime, MovesPymodbusWithAsyncio) {
  if (!has_module("pymodbus") || !has_module("serial_asyncio")) GTEST_SKIP() << "it is not installed";
  const Finished host = python_twice(R"(
import asyncio, os, time
from pymodbus.client import AsyncModbusSerialClient
async def main():
    client = AsyncModbusSerialClient(os.environ["UNDERSTUDY_PORT"], baudrate=19200, parity="E", timeout=2)
    await client.connect()
    began = time.time()
    for poll in range(6):
        assert (await client.read_holding_registers(1, 1, slave=1)).registers == [49153]
        await asyncio.sleep(10)
    print(round(time.time() - began))
asyncio.run(main())
)");
  EXPECT_EQ(host.output, "60\n");
}

TEST_F(HostTime, MovesLibmodbus) {
  const Finished host = python_twice(R"(
import ctypes, os, time
library = ctypes.CDLL("libmodbus.so.5", use_errno=True)
library.modbus_new_rtu.restype = ctypes.c_void_p
library.modbus_new_rtu.argtypes = [ctypes.c_char_p, ctypes.c_int, ctypes.c_char, ctypes.c_int, ctypes.c_int]
context = ctypes.c_void_p(library.modbus_new_rtu(os.environ["UNDERSTUDY_PORT"].encode(), 19200, b"E", 8, 1))
library.modbus_set_slave(context, 1)
assert library.modbus_connect(context) == 0
registers = (ctypes.c_uint16 * 1)()
began = time.monotonic()
for poll in range(60):
    assert library.modbus_read_registers(context, 1, 1, registers) == 1 and registers[0] == 49153
    time.sleep(0.02)
print(time.monotonic() - began > 1.5)
library.modbus_set_slave(context, 9)
began = time.monotonic()
print(library.modbus_read_registers(context, 1, 1, registers), time.monotonic() - began)
)");
  EXPECT_EQ(host.output, "True\n-1 0.5\n");
}

TEST_F(HostTime, EndsEveryWaitOfAHostOfThreeThreads) {
  const Finished host = exec({WAITING_HOST});
  EXPECT_EQ(host.exit_code, 0) << host.errors;
  EXPECT_EQ(host.output,
            "condition-timeout 2500 good\n"
            "condition-signal 700 good\n"
            "condition-by-date 3000 good\n"
            "semaphore-timeout 4000 good\n"
            "semaphore-post 300 good\n"
            "mutex-timeout 1500 good\n"
            "counting-timeout 1200 good\n"
            "future 900 good\n"
            "timerfd-read 1000 good\n"
            "timerfd-late 1100 good\n"
            "timerfd-epoll 150 good\n"
            "timerfd-rest 0 good\n"
            "alarm-ends-sleep 2000 good\n"
            "itimer-three 900 good\n"
            "no-alarm-any-more 1000 good\n"
            "timer-ends-sleep 1500 good\n"
            "signal-timeout 500 good\n"
            "c11-timeout 1000 good\n"
            "drained-by-tcsetattr 110 good\n"
            "long-write 5729 good\n"
            "select-interrupted 1000 good\n"
            "poll-interrupted 1000 good\n"
            "epoll-interrupted 1000 good\n"
            "nanosleep-interrupted 1000 good\n"
            "condition-not-interrupted 3000 good\n"
            "read-restarted 2009 good\n"
            "semaphore-interrupted 1000 good\n"
            "read-interrupted 1000 good\n"
            "select-closed 2000 good\n"
            "poll-closed 2000 good\n"
            "read-closed 2000 good\n"
            "beats 46\n");
}

TEST_F(HostTime, TellsHowManyCoursesRunsHad) {
  const std::string script = R"(
import os, time
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
time.sleep(1 if os.path.exists("FILE") else 2)
open("FILE", "w")
)";
  const std::string mark = folder() / "mark";
  std::string changing = script;
  for (std::size_t at = 0; (at = changing.find("FILE")) != std::string::npos;) changing.replace(at, 4, mark);
  const Finished different = python(changing, {"--repeat", "3"});
  EXPECT_EQ(different.exit_code, 1);
  EXPECT_NE(different.errors.find("run 2 differs from run 1 at 1s: "), std::string::npos) << different.errors;
  EXPECT_NE(different.errors.find("3 runs, 2 different courses: 1 2\n"), std::string::npos)
      << different.errors;
  const Finished same = python(changing, {"--twice"});
  EXPECT_EQ(same.exit_code, 0);
  EXPECT_EQ(same.errors, "understudy: exec: 2 runs, all the same\n");
  EXPECT_EQ(python("pass", {"--repeat", "0"}).errors,
            "understudy: --repeat: 0 is too few; expected 1 or more runs\n");
}

TEST_F(HostTime, HoldsForWhatAShellStarts) {
  const Finished host = exec({"sh", "-c", "sleep 60; sleep 3600 & sleep 1800; wait; date -u '+%F %T'"});
  EXPECT_EQ(host.exit_code, 0) << host.errors;
  EXPECT_EQ(host.output, "2026-01-01 01:01:00\n");
}

TEST_F(HostTime, ReplaysAsEveryRun) {
  const Finished host = python_twice(
      "import os, time\nport = open(os.environ['UNDERSTUDY_PORT'], 'r+b', buffering=0)\ntime.sleep(5)");
  const Finished again = understudy({"replay", folder() / "first"});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
}

TEST_F(HostTime, TellsOfAThreadThatDoesNotWait) {
  const Finished host = python("while True: pass", {"--timeout", "5s"});
  EXPECT_EQ(host.exit_code, 124);
  EXPECT_NE(host.errors.find("thread 1 of python3"), std::string::npos) << host.errors;
  EXPECT_NE(host.errors.find("does not wait, so the clock is stopped"), std::string::npos) << host.errors;
}

/// The beginning of a program is enough to recognize it.
std::string program(unsigned char bits, bool is_dynamic) {
  Elf64_Ehdr own;
  std::ifstream("/proc/self/exe", std::ios::binary).read(reinterpret_cast<char*>(&own), sizeof own);
  own.e_ident[EI_CLASS] = bits;
  own.e_phnum = 1;
  own.e_phoff = sizeof own;
  Elf64_Phdr part{};
  part.p_type = is_dynamic ? PT_INTERP : PT_LOAD;
  std::string text(sizeof own + sizeof part, '\0');
  std::memcpy(text.data(), &own, sizeof own);
  std::memcpy(text.data() + sizeof own, &part, sizeof part);
  return text;
}

TEST_F(HostTime, RefusesWhatCannotLoadTheLibrary) {
  const auto host = [&](const std::string& name, const std::string& text) {
    const std::string path = folder().write(name, text);
    chmod(path.c_str(), 0755);
    return path;
  };
  const std::string still = host("static", program(ELFCLASS64, false));
  const std::string narrow = host("narrow", program(ELFCLASS32, true));
  const std::string script = host("script", "#!" + still + "\n");
  struct Case {
    Words command;
    std::string message;
  };
  for (const Case& each :
       {Case{{still}, still + " is statically linked"}, Case{{script}, still + " is statically linked"},
        Case{{narrow}, narrow + " is for a different processor (32 bits)"},
        Case{{"env", "-i", "sleep", "0.3"}, "did not load our library"}}) {
    const Finished refused = exec(each.command);
    EXPECT_EQ(refused.exit_code, 125) << refused.errors;
    EXPECT_NE(refused.errors.find(each.message), std::string::npos) << refused.errors;
  }
  EXPECT_EQ(exec({"/no/such/host"}).exit_code, 127);
}

TEST_F(HostTime, RefusesFlagsThatDisagree) {
  const Finished speed = exec({"true"}, {"--speed", "real"});
  EXPECT_EQ(speed.exit_code, 2);
  EXPECT_EQ(
      speed.errors,
      "understudy: --host-time: the host's waits determine how fast time passes; expected no --speed\n");
  const Finished name = exec({"true"}, {"--listen", "rtu://somewhere.example:5020"});
  EXPECT_EQ(name.exit_code, 3);
  EXPECT_NE(name.errors.find("rtu://somewhere.example:5020: host names cannot be resolved in simulated time"),
            std::string::npos)
      << name.errors;
  const Finished twice =
      exec({"true"}, {"--listen", "rtu://localhost:5020", "--listen", "rtu://127.0.0.1:5020"});
  EXPECT_EQ(twice.exit_code, 3);
  EXPECT_NE(twice.errors.find("are the same address for a host on this machine"), std::string::npos)
      << twice.errors;
}

}  // namespace host_time_test
}  // namespace understudy::acceptance
