#!/usr/bin/env python3
"""Makes the table of unmodified hosts in simulated time (docs/host-time.md).

benchmarks/unmodified_hosts.py UNDERSTUDY [NAME...] [--runs 20] [--load 8] [--pause 20]

Each host polls ten times and pauses after each poll. It runs in real time with short pauses, then once in simulated
time, then several times beside programs that load the machine. It must print the same output, have the same recording,
and be 20 times faster than real time. Hosts that are not installed are left out. Those in C and C++ need a compiler,
libmodbus and Qt's SerialBus, those in JavaScript need the npm packages below NODE_PATH, and minimalmodbus needs its
folder in PYTHONPATH.
"""
import argparse
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HOSTS = Path(__file__).resolve().parent / "unmodified_hosts"
BENCH = """understudy: 1
lines: { rs485: { listen: [ 'modbus-tcp://127.0.0.1:5020' ], stations: [ { name: feeder, model: simple2-r3 } ] } }
"""
SERIAL_BENCH = "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n"
COLLECTD = """BaseDir "%s"
PIDFile "%s/pid"
Interval @PAUSE@
LoadPlugin csv
LoadPlugin modbus
<Plugin csv>
  DataDir "%s/csv"
</Plugin>
<Plugin modbus>
  <Data "code">
    RegisterBase 1
    RegisterType uint16
    RegisterCmd ReadHolding
    Type gauge
    Instance "code"
  </Data>
  <Host "feeder">
    Device "%s"
    Baudrate 19200
    Interval @PAUSE@
    <Slave 1>
      Instance "one"
      Collect "code"
    </Slave>
  </Host>
</Plugin>
"""

REAL_PAUSE_S = 2
TIMES_REAL = 20  # at least

PYTHON = ["/usr/bin/python3"]
# The host's name, its command, and its requirements: a file, "program NAME" or "module NAME".
TABLE = {
    "mbpoll": (["sh", "-c", "timeout -s INT $((PAUSE_S * 10)).5 mbpoll -m rtu -b 19200 -P even -a 1 -0 -r 1"
                            " -l ${PAUSE_S}000 $UNDERSTUDY_PORT | grep '^\\[' | uniq -c"], ["program mbpoll"]),
    "pyserial": ([*PYTHON, "pyserial_host.py"], ["module serial"]),
    "minimalmodbus": ([*PYTHON, "minimalmodbus_host.py"], ["module minimalmodbus"]),
    "pymodbus": ([*PYTHON, "pymodbus_host.py"], ["module pymodbus"]),
    "pymodbus, asyncio": ([*PYTHON, "pymodbus_async_host.py"], ["module pymodbus", "module serial_asyncio"]),
    "pymodbus, TCP": ([*PYTHON, "pymodbus_tcp_host.py"], ["module pymodbus"]),
    "libmodbus": (["{build}/libmodbus_host"], ["{build}/libmodbus_host"]),
    "libmodbus, TCP": (["{build}/libmodbus_host", "tcp"], ["{build}/libmodbus_host"]),
    "modbus-serial (Node.js)": (["node", "modbus_serial_host.js"], ["package modbus-serial"]),
    "modbus-serial, TCP": (["node", "modbus_serial_host.js", "tcp"], ["package modbus-serial"]),
    "jsmodbus (Node.js)": (["node", "jsmodbus_host.js"], ["package jsmodbus"]),
    "Qt SerialBus": (["{build}/qt_host"], ["{build}/qt_host"]),
    "collectd's modbus plugin": (["sh", "{build}/collectd.sh"], ["program collectd"]),
    "Tcl": (["tclsh", "tcl_host.tcl"], ["program tclsh"]),
    "C++ with three threads": (["{build}/three_threads"], ["{build}/three_threads"]),
    "Java, TCP": (["java", "-cp", "{build}", "JavaHost"], ["{build}/JavaHost.class"]),
}

COLLECTD_SCRIPT = """set -e
place=$(mktemp -d)
sed "s,@PLACE@,$place,g; s,@PORT@,$UNDERSTUDY_PORT,g; s,@PAUSE@,$PAUSE_S," {build}/collectd.conf > $place/conf
timeout -s TERM $((PAUSE_S * 10)).5 collectd -f -C $place/conf > /dev/null 2>&1 || true
cat $place/csv/*/modbus-one/* | cut -d, -f2 | uniq -c
rm -r $place
"""


def build(folder):
    """Compiles the hosts that can be compiled here."""
    def make(name, command):
        made = subprocess.run(command, cwd=HOSTS, capture_output=True, text=True, check=False)
        if made.returncode != 0:
            print(f"{name}: cannot be built: {made.stderr.strip().splitlines()[:1]}", file=sys.stderr)
    make("libmodbus", ["cc", "-O2", "libmodbus_host.c", "-o", f"{folder}/libmodbus_host", "-lmodbus"])
    make("three threads", ["c++", "-O2", "-std=c++20", "-pthread", "three_threads.cpp", "-o", f"{folder}/three_threads"])
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "Qt5SerialBus", "Qt5SerialPort"],
                           capture_output=True, text=True, check=False).stdout.split()
    make("Qt", ["c++", "-O1", "-fPIC", "qt_host.cpp", "-o", f"{folder}/qt_host", *flags])
    try:
        make("Java", ["javac", "-d", folder, "JavaHost.java"])
    except FileNotFoundError:
        pass
    config = COLLECTD % ("@PLACE@", "@PLACE@", "@PLACE@", "@PORT@")
    Path(folder, "collectd.conf").write_text(config, encoding="ascii")
    Path(folder, "collectd.sh").write_text(COLLECTD_SCRIPT.replace("{build}", folder), encoding="ascii")


def is_present(need):
    kind, _, name = need.partition(" ")
    if kind == "program":
        return subprocess.run(["which", name], capture_output=True, check=False).returncode == 0
    if kind == "module":
        return subprocess.run([*PYTHON, "-c", f"import {name}"], capture_output=True, check=False).returncode == 0
    if kind == "package":
        return any(Path(place, name).exists() for place in os.environ.get("NODE_PATH", "").split(":"))
    return Path(need).exists()


def run(understudy, bench, flags, command, pause_s):
    """Returns the command's output with its exit code, its errors, and how long it took."""
    environment = {**os.environ, "PAUSE_S": str(pause_s)}
    begin = time.monotonic()
    done = subprocess.run([understudy, "exec", bench, "--timeout", "300s", *flags, "--", *command], cwd=HOSTS,
                          env=environment, capture_output=True, text=True, check=False)
    return (done.stdout, done.returncode), done.stderr.strip(), time.monotonic() - begin


def simulated_s(recording):
    """Returns the last time in a recording, in seconds."""
    last = 0
    for line in Path(recording).read_text(encoding="utf-8").splitlines()[1:]:
        last = max(last, int(line.split('"t":')[1].split(",")[0]))
    return last / 1e9


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("understudy")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--load", type=int, default=8)
    parser.add_argument("--pause", type=int, default=20, help="after each poll in simulated time, in seconds")
    arguments = parser.parse_args()
    understudy = os.path.abspath(arguments.understudy)
    is_bad = False
    with tempfile.TemporaryDirectory() as folder:
        build(folder)
        for name, text in (("tcp.yaml", BENCH), ("serial.yaml", SERIAL_BENCH)):
            Path(folder, name).write_text(text, encoding="ascii")
        print(f"| host | simulated | it took | faster | {arguments.runs} runs beside a load of {arguments.load} | "
              "prints the same |\n|---|---|---|---|---|---|")
        for name, (words, needs) in TABLE.items():
            if arguments.names and name not in arguments.names:
                continue
            words = [word.replace("{build}", folder) for word in words]
            missing = [need for need in needs if not is_present(need.replace("{build}", folder))]
            if missing:
                print(f"{name}: left out: {missing[0]} is not installed", file=sys.stderr)
                continue
            bench = f"{folder}/{'tcp' if 'TCP' in name else 'serial'}.yaml"
            real, _, _ = run(understudy, bench, ["--tty-shim"], words, REAL_PAUSE_S)
            recording = f"{folder}/recording"
            simulated, errors, simulated_wall_s = run(understudy, bench, ["--host-time", "--record", recording], words,
                                                   arguments.pause)
            virtual_s = simulated_s(recording)
            spinning = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(arguments.load)]
            try:
                _, told, _ = run(understudy, bench, ["--host-time", "--repeat", str(arguments.runs)], words, arguments.pause)
            finally:
                for each in spinning:
                    each.kill()
                    each.wait()
            courses = told.splitlines()[-1].partition("exec: ")[2] if told else "?"
            is_same = real == simulated
            print(f"| {name} | {virtual_s:.0f} s | {simulated_wall_s:.2f} s | {virtual_s / simulated_wall_s:.0f} times | "
                  f"{courses} | {'yes' if is_same else 'NO'} |", flush=True)
            is_slow = virtual_s < TIMES_REAL * simulated_wall_s
            if not is_same or is_slow or not courses.endswith("all the same"):
                is_bad = True
                print(f"{name}: {shlex.join(words)}\nreal: {real}\nsimulated: {simulated} {errors}\n{told}", file=sys.stderr)
    return 1 if is_bad else 0


if __name__ == "__main__":
    sys.exit(main())
