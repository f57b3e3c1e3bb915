// Waits of hosts in simulated time that end in less usual ways: loops that wait until a moment is past,
// libc's streams, signals of a line, advances by hand, message queues. The same scripts in real time say what
// is right.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/acceptance/host_time_rig.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_time_test {

constexpr const char* kSlimBench =
    "understudy: 1\nlines: { serial: { stations: [ { name: robot, model: slim } ] } }\n";

// What each of these waits for does not come, or late. Each of them then checks without a wait until its
// moment is past.
TEST_F(HostTime, EndsLoopsThatWaitUntilAMomentIsPast) {
  const Finished host = python_twice(R"(
import multiprocessing, select, time
def tell(name, wait):
    began = time.monotonic()
    result = wait()
    print(name, result, round(time.monotonic() - began, 2))
ends = multiprocessing.Pipe()
def loop(wait, unit_ns, units):
    now = lambda: time.monotonic_ns() // unit_ns
    end = now() + units
    while now() <= end:
        wait(end - now())
tell("pipe", lambda: ends[0].poll())
tell("pipe", lambda: ends[0].poll(2))
tell("milliseconds", lambda: loop(select.poll().poll, 1000000, 1000))
for name, wait in {"poll": lambda left: select.poll().poll(0), "select": lambda left: select.select([], [], [], 0),
                   "epoll": lambda left: select.epoll().poll(0), "sleep": lambda left: time.sleep(0)}.items():
    time.sleep((1000000000 - time.monotonic_ns() % 1000000000) / 1000000000)
    tell(name, lambda: loop(wait, 1000000000, 1))
)",
                                     {"--timeout", "60s"});
  EXPECT_EQ(host.output,
            "pipe False 0.0\npipe False 2.0\nmilliseconds None 1.0\npoll None 2.0\nselect None 2.0\nepoll "
            "None 2.0\n"
            "sleep None 2.0\n")
      << host.errors;
}

// These have several threads or processes that check at the same time.
TEST_F(HostTime, EndsTheTimedWaitsOfPythonsProcesses) {
  const Finished host = python(R"(
import multiprocessing, queue, subprocess, time
from concurrent.futures import ProcessPoolExecutor
def tell(name, wait):
    began = time.monotonic()
    result = wait()
    print(name, result, round(time.monotonic() - began, 1), flush=True)
def join():
    child = multiprocessing.Process(target=time.sleep, args=[5])
    child.start()
    child.join(2)
    was_alive = child.is_alive()
    child.join()
    return was_alive
def communicate():
    child = subprocess.Popen(["sleep", "5"], stdout=subprocess.PIPE)
    try:
        child.communicate(timeout=2)
    except subprocess.TimeoutExpired:
        child.kill()
        child.wait()
        return "expired"
def get():
    try:
        multiprocessing.Queue().get(timeout=2)
    except queue.Empty:
        return "empty"
def pool():
    with multiprocessing.Pool(2) as workers:
        return workers.map(abs, [-1, -2])
def executor():
    with ProcessPoolExecutor(2) as workers:
        return list(workers.map(abs, [-1, -2]))
for wait in join, communicate, get, pool, executor:
    tell(wait.__name__, wait)
)",
                               {"--timeout", "60s"});
  EXPECT_EQ(host.output,
            "join True 5.0\ncommunicate expired 2.0\nget empty 2.0\npool [1, 2] 0.0\nexecutor [1, 2] 0.0\n")
      << host.errors;
}

// A reply takes as long as with a wait, although the host only checks for it.
TEST_F(HostTime, GivesAHostThatOnlyChecksItsReplyInTime) {
  const Finished host = python_twice(R"(
import os, select, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
def check(timeout):
    return os.read(port, 7) if select.select([port], [], [], timeout)[0] else b""
def attempt():
    try:
        return os.read(port, 7)
    except BlockingIOError:
        return b""
for read in (lambda: check(2)), (lambda: check(0)), attempt:
    os.set_blocking(port, read != attempt)
    began = time.monotonic()
    os.write(port, bytes.fromhex("010300010001D5CA"))
    answer = b""
    while len(answer) < 7:
        answer += read()
    print(answer.hex(), round(time.monotonic() - began, 4))
)",
                                     {"--timeout", "60s"});
  const std::string waiting = host.output.substr(0, host.output.find('\n') + 1);
  EXPECT_EQ(host.output, waiting + waiting + waiting) << host.errors;
  EXPECT_EQ(waiting.substr(0, 15), "010302c0012984 ");
}

// Every function of libc that reads a stream, with a buffer and without one.
constexpr const char* kStreams = R"(
import ctypes, os, signal, termios, time, tty
libc = ctypes.CDLL(None, use_errno=True)
libc.fdopen.restype = libc.fgets.restype = ctypes.c_void_p
libc.fread.restype = ctypes.c_size_t
libc.getline.restype = libc.getdelim.restype = ctypes.c_ssize_t
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
def settle(least, tenths):
    settings = termios.tcgetattr(port)
    settings[4] = settings[5] = termios.B9600
    settings[6][termios.VMIN], settings[6][termios.VTIME] = least, tenths
    termios.tcsetattr(port, termios.TCSANOW, settings)
place = ctypes.create_string_buffer(200)
line, room, number = ctypes.c_void_p(None), ctypes.c_size_t(0), ctypes.c_int(-1)
def gets(size):
    return libc.fgets(place, size, file) and place.value
def characters(name):
    text = b""
    while not text.endswith(b"\n"):
        text += bytes([getattr(libc, name)(file)])
    return text
def scan(name):
    return getattr(libc, name)(file, b"%d", ctypes.byref(number)), number.value, characters("fgetc")
def delimited(*end):
    read = libc.getdelim if end else libc.getline
    return read(ctypes.byref(line), ctypes.byref(room), *end, file), ctypes.string_at(line)
def tell(name, read, asks=True):
    began = time.monotonic()
    if asks:
        libc.fputs(b"?PE\r", file)
    print(name, read(), libc.feof(file) != 0, libc.ferror(file) != 0, int(time.monotonic() - began))
for is_buffered in (True, False):
    settle(1, 0)
    file = ctypes.c_void_p(libc.fdopen(os.dup(port), b"r+"))
    if not is_buffered:
        libc.setbuf(file, None)
    tell("fgets", lambda: gets(100))
    tell("fgets in parts", lambda: [gets(2), gets(100)])
    tell("getline", delimited)
    tell("getdelim", lambda: [delimited(ord("\r")), characters("fgetc")])
    for name in ("fgetc", "getc", "getc_unlocked", "fgetc_unlocked", "_IO_getc", "__uflow"):
        tell(name, lambda: characters(name))
    tell("ungetc", lambda: [libc.ungetc(libc.fgetc(file), file), gets(100)])
    tell("fread", lambda: [libc.fread(place, 1, 3, file), place.raw[:3]])
    for name in ("fscanf", "__isoc99_fscanf"):
        tell(name, lambda: scan(name))
    settle(0, 15)
    tell("nothing", lambda: gets(100), False)
    tell("still", lambda: gets(100), False)  # the end lasts until it is cleared
    libc.clearerr(file)
    tell("cleared", lambda: gets(100))
    libc.fclose(file)
)";

TEST_F(HostTime, WaitsInEveryReadOfALibcStream) {
  const std::string slim = folder().write("slim.yaml", kSlimBench);
  const Words command{"--timeout", "60s", "--", kPython, "-c", kStreams};
  const auto run = [&](Words words) {
    words.insert(words.end(), command.begin(), command.end());
    return understudy(words);
  };
  const Finished real = run({"exec", slim});
  const Finished simulated = run({"exec", slim, "--host-time", "--twice"});
  EXPECT_EQ(simulated.exit_code, 0) << simulated.errors;
  EXPECT_EQ(simulated.output, real.output + real.output);
  EXPECT_NE(real.output.find("fread [3, b'0\\r\\n'] False False"), std::string::npos) << real.output;
  EXPECT_NE(real.output.find("nothing None True False 1"), std::string::npos) << real.output;
}

TEST_F(HostTime, ReadsALineForAShellScript) {
  const std::string slim = folder().write("slim.yaml", kSlimBench);
  const std::string script =
      "exec 3<>$UNDERSTUDY_PORT; stty 9600 raw -echo <&3; printf '?PE\\r' >&3; sed -u 1q <&3; echo done";
  const Finished host =
      understudy({"exec", slim, "--host-time", "--timeout", "60s", "--", "sh", "-c", script});
  EXPECT_EQ(host.exit_code, 0) << host.errors;
  EXPECT_EQ(host.output, "0\r\ndone\n");
}

TEST_F(HostTime, FillsAllPartsOfAReadv) {
  const Finished host = python_twice(R"(
import os, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
for least, sizes in ((7, [3, 90]), (7, [0, 1, 2, 0, 4]), (3, [2, 1])):
    settings[6][termios.VMIN], settings[6][termios.VTIME] = least, 0
    termios.tcsetattr(port, termios.TCSANOW, settings)
    os.write(port, bytes.fromhex("010300010001D5CA"))
    parts = [bytearray(size) for size in sizes]
    print(os.readv(port, parts), b"".join(parts)[:7].hex())
    if least == 3:
        time.sleep(0.1)
        print(os.read(port, 4).hex())
)");
  EXPECT_EQ(host.output, "7 010302c0012984\n7 010302c0012984\n3 010302\nc0012984\n") << host.errors;
}

TEST_F(HostTime, SendsTheSignalOfALineWhenItsByteArrives) {
  const Finished host = python_twice(R"(
import fcntl, os, signal, termios, time, tty
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
tty.setraw(port)
settings = termios.tcgetattr(port)
settings[4] = settings[5] = termios.B19200
termios.tcsetattr(port, termios.TCSANOW, settings)
got = []
def note(number, frame):
    got.append(number)
for number in (signal.SIGIO, signal.SIGRTMIN + 1):
    signal.signal(number, note)
fcntl.fcntl(port, fcntl.F_SETOWN, os.getpid())
plain = fcntl.fcntl(port, fcntl.F_GETFL)
fcntl.fcntl(port, fcntl.F_SETFL, plain | os.O_ASYNC)
print(fcntl.fcntl(port, fcntl.F_GETFL) == plain | os.O_ASYNC)
def ask(asks=True):
    os.write(port, bytes.fromhex("010300010001D5CA"))
    answer = b""
    began = time.monotonic()
    while asks and len(answer) < 7:
        signal.pause()
        answer += os.read(port, 7)
    print(answer.hex(), 0 < time.monotonic() - began < 0.05, set(got) - {signal.SIGALRM})
    got.clear()
    return began
ask()
ask()
fcntl.fcntl(port, fcntl.F_SETSIG, signal.SIGRTMIN + 1)
ask()
fcntl.fcntl(port, fcntl.F_SETFL, plain)
began = ask(False)
signal.signal(signal.SIGALRM, note)
signal.alarm(2)
signal.pause()
print(time.monotonic() - began, os.read(port, 7).hex())
fcntl.fcntl(port, fcntl.F_SETFL, plain | os.O_ASYNC)
os.close(port)
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
print(fcntl.fcntl(port, fcntl.F_GETFL) == plain)
)",
                                     {"--timeout", "60s"});
  EXPECT_EQ(
      host.output,
      "True\n010302c0012984 True {29}\n010302c0012984 True {29}\n010302c0012984 True {35}\n False set()\n"
      "2.0 010302c0012984\nTrue\n")
      << host.errors;
}

// The clock of the bench is paused. What another command advances ends the host's waits when they are over.
TEST_F(HostTime, EndsWaitsInAnAdvanceByHand) {
  const std::string ctl = std::string(UNDERSTUDY_BINARY) + " ctl ";
  const std::string advances = ctl + "advance 1500ms && " + ctl +
                               "run-until --within 10s 'feeder.DIN_3 == 1' >/dev/null && echo met; " + ctl +
                               "advance 1s; " + ctl + "resume >/dev/null";
  const std::string now = "date -u +%T.%N; ";
  const std::string host_script = ctl + "pause >/dev/null; (" + advances + ") & sleep 1; " + now +
                                  "sleep 1; " + now + ctl + "input feeder.DIN_3=on >/dev/null; sleep 5; " +
                                  now + "wait";
  for (int run = 0; run < 3; ++run) {
    const Finished host = exec({"sh", "-c", host_script}, {"--timeout", "60s"});
    EXPECT_EQ(host.exit_code, 0) << host.errors;
    EXPECT_EQ(host.output.substr(0, host.output.find("met")),
              "00:00:01.000000000\nsimulated time 1.5s\n00:00:02.000000000\n")
        << host.errors;
    EXPECT_NE(host.output.find("00:00:07.000000000\n"), std::string::npos) << host.output << host.errors;
  }
}

// An advance to the very end of a wait ends it, and the clock then stands.
TEST_F(HostTime, ActsAtTheEndOfAnAdvance) {
  const std::string ctl = std::string(UNDERSTUDY_BINARY) + " ctl ";
  const Finished host = exec({"sh", "-c",
                              ctl + "pause >/dev/null; (" + ctl + "advance 1s; " + ctl +
                                  "advance 1s) & sleep 1; date -u +%T; sleep 1; date -u +%T; wait"},
                             {"--timeout", "60s"});
  EXPECT_EQ(host.exit_code, 0) << host.errors;
  EXPECT_NE(host.output.find("00:00:01\n"), std::string::npos) << host.output;
  EXPECT_NE(host.output.find("00:00:02\n"), std::string::npos) << host.output;
}

// A stop holds the clock although the host waits, until somebody continues.
TEST_F(HostTime, StandsAtABreakpoint) {
  const PrivateFolder folder;
  folder.write("count.s2", "again:  VAR_Inc VAR32\n        Delay_mSec 5\n        Jump again\n");
  const std::string bench = folder.write("count.yaml",
                                         "understudy: 1\nlines: { l: { stations: [ { name: feeder, model: "
                                         "simple2-r3, program: count.s2 } ] } }\n");
  const std::string control = folder / "control";
  const std::string ctl = std::string(UNDERSTUDY_BINARY) + " ctl ";
  const std::string script = ctl + "set feeder.PROG_MAIN_RunTime_START=0 >/dev/null; " + ctl +
                             "break 2 nth=50 >/dev/null; sleep 1; date -u +%T";
  Process host(
      {UNDERSTUDY_BINARY, "exec", bench, "--host-time", "--control", control, "--", "sh", "-c", script});
  const auto ask = [&](Words words) {
    words.insert(words.begin(), "ctl");
    words.insert(words.end(), {"--control", control});
    return understudy(words).output;
  };
  ASSERT_TRUE(eventually([&] { return ask({"events"}).find("stop") != std::string::npos; })) << host.errors();
  const std::string status = ask({"status"});
  EXPECT_NE(status.find("paused"), std::string::npos) << status;
  EXPECT_EQ(ask({"get", "feeder.PROG_VAR0"}), "feeder.PROG_VAR0 50\n");
  EXPECT_NE(ask({"break", "delete", "all"}), "no answer");
  ask({"continue"});
  EXPECT_EQ(host.wait(kPatience), 0) << host.errors();
  EXPECT_EQ(host.output(), "00:00:01\n");
}

// From the end of the command on, no time passes, whatever it has left behind.
TEST_F(HostTime, EndsWithItsCommand) {
  const std::string spin = "while :; do :; done";
  const Process load({"sh", "-c", spin});
  for (int run = 0; run < 12; ++run) {
    const Finished host =
        exec({"sh", "-c", "sleep 1; (sleep 100; date) & echo hi"}, {"--record", folder() / "recording"});
    EXPECT_EQ(host.exit_code, 0) << host.errors;
    EXPECT_EQ(host.output, "hi\n");
    EXPECT_EQ(host.errors.find("did not load"), std::string::npos) << host.errors;
    EXPECT_NE(text_of(folder() / "recording").find("\n{\"t\":1000000000,\"do\":\"end\""), std::string::npos);
  }
}

TEST_F(HostTime, EndsWaitsForQueuesAndForSocketsWithATimeout) {
  const Finished host = python_twice(R"(
import ctypes, os, socket, struct, time
libc = ctypes.CDLL(None, use_errno=True)
class Time(ctypes.Structure):
    _fields_ = [("s", ctypes.c_long), ("ns", ctypes.c_long)]
class Attributes(ctypes.Structure):
    _fields_ = [(name, ctypes.c_long) for name in ("flags", "max", "size", "now", "a", "b", "c", "d")]
libc.mq_timedreceive.restype = ctypes.c_ssize_t
name = f"/understudy{os.getpid()}".encode()
queue = libc.mq_open(name, os.O_CREAT | os.O_RDWR, 0o600, ctypes.byref(Attributes(0, 1, 16)))
libc.mq_unlink(name)
place = ctypes.create_string_buffer(16)
def in_seconds(count):
    return ctypes.byref(Time(int(time.time()) + count, int(time.time() % 1 * 1e9)))
def receive(seconds):
    size = libc.mq_timedreceive(queue, place, ctypes.c_size_t(16), None, in_seconds(seconds))
    return os.strerror(ctypes.get_errno()) if size < 0 else place.raw[:size]
def send(seconds):
    sent = libc.mq_timedsend(queue, b"hello", ctypes.c_size_t(5), 0, in_seconds(seconds))
    return os.strerror(ctypes.get_errno()) if sent < 0 else sent
def tell(name, wait):
    began = time.monotonic()
    try:
        result = wait()
    except BlockingIOError:
        result = "nothing"
    print(name, result, round(time.monotonic() - began, 2), flush=True)
tell("empty", lambda: receive(1))
tell("send", lambda: send(1))
tell("full", lambda: send(1))
tell("receive", lambda: receive(1))
if os.fork() == 0:
    time.sleep(0.5)
    send(1)
    os._exit(0)
tell("of a child", lambda: receive(2))
os.wait()
near, far = socket.socketpair()
near.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("ll", 1, 0))
if os.fork() == 0:
    time.sleep(1.5)
    far.send(b"x")
    time.sleep(0.2)
    far.send(b"y")
    os._exit(0)
tell("recv", lambda: near.recv(1))
tell("recv", lambda: near.recv(1))
tell("recvfrom", lambda: near.recvfrom(1)[0])
tell("read", lambda: os.read(near.fileno(), 1))
tell("recvmsg", lambda: near.recvmsg(1)[0])
)");
  EXPECT_EQ(
      host.output,
      "empty Connection timed out 1.0\nsend 0 0.0\nfull Connection timed out 1.0\nreceive b'hello' 0.0\n"
      "of a child b'hello' 0.5\nrecv nothing 1.0\nrecv b'x' 0.5\nrecvfrom b'y' 0.2\nread nothing 1.0\n"
      "recvmsg nothing 1.0\n")
      << host.errors;
}

}  // namespace host_time_test
}  // namespace understudy::acceptance
