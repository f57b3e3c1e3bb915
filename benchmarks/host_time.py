#!/usr/bin/env python3
"""Measures hosts in simulated time (exec --host-time): the cost of a wait, a host that polls every 20 ms, a campaign
of hosts that run 10 s each; and that `exec` without it is as fast as `serve`, which has no support for simulated hosts.

benchmarks/host_time.py UNDERSTUDY [WAITS]

Needs a C compiler and libmodbus. The limits are for an idle machine: run it alone.
"""
import os
import statistics
import subprocess
import sys
import tempfile
import time

WAIT_US = 100  # at most, in real time
TIMES_REAL = 50  # at least, polling every 20 ms
RUNS_A_MINUTE = 1000  # at least, of 10 s each, on two cores
WITHOUT = 1.05  # at most: an exchange with `exec` in real time, divided by one with `serve`
ROUNDS = 7  # of both, in turn

BENCH = "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n"
INSTANT = """understudy: 1
lines: { rs485: { link: ./port, timing: instant, stations: [ { name: feeder, model: simple2-r3 } ] } }
"""
CAMPAIGN = """understudy: 1
name: runs of ten seconds
bench: bench.yaml
vary: { n: { from: 1, to: %d, step: 1 } }
steps:
  - inject: { drop: feeder, nth: "${n}" }
  - host: { within: 60s }
"""
HOST = r"""
#include <modbus/modbus.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
static void wait_ms(long ms) {
  const struct timespec time = {ms / 1000, ms % 1000 * 1000000};
  nanosleep(&time, NULL);
}
static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec + time.tv_nsec / 1e9;
}
int main(int count, char **words) {
  const int rounds = atoi(words[1]), pause = atoi(words[2]), polls = atoi(words[3]);
  const double began = now();
  modbus_t *line = modbus_new_rtu(getenv("UNDERSTUDY_PORT"), 19200, 'E', 8, 1);
  modbus_set_slave(line, 1);
  modbus_set_response_timeout(line, 0, 200000);
  if (polls && modbus_connect(line) != 0) return 1;
  for (int i = 0; i < rounds; ++i) {
    unsigned short words_read[2];
    if (polls) modbus_read_registers(line, 0, 1, words_read);
    if (pause) wait_ms(pause);
  }
  printf("%f\n", now() - began);
  return count != 4;
}
"""


def run(understudy, folder, *host):
    """Returns the real time and the simulated time in seconds."""
    begin = time.monotonic()
    said = subprocess.run([understudy, "exec", f"{folder}/bench.yaml", "--host-time", "--", f"{folder}/host", *host],
                          capture_output=True, text=True, check=True).stdout
    return time.monotonic() - begin, float(said)


def exchanges(folder, rounds):
    """Returns a command that exchanges as often as it can, and prints how long that took in seconds."""
    return [f"{folder}/host", str(rounds), "0", "1"]


def with_exec(understudy, folder, rounds):
    said = subprocess.run([understudy, "exec", f"{folder}/instant.yaml", "--", *exchanges(folder, rounds)],
                          capture_output=True, text=True, check=True).stdout
    return float(said)


def with_serve(understudy, folder, rounds):
    # It records, because exec does.
    with subprocess.Popen([understudy, "serve", f"{folder}/instant.yaml", "--record", f"{folder}/recording"],
                          stdout=subprocess.PIPE, text=True) as server:
        try:
            if not server.stdout.readline().startswith("ready"):
                sys.exit("serve did not start")
            return float(subprocess.run(exchanges(folder, rounds), capture_output=True, text=True, check=True,
                                        env={**os.environ, "UNDERSTUDY_PORT": f"{folder}/port"}).stdout)
        finally:
            server.terminate()


def verdict(what, is_met, bar):
    print(f"{'met' if is_met else 'NOT MET':8s} {what} (bar: {bar})")


def main(understudy, waits=20000):
    understudy, waits = os.path.abspath(understudy), int(waits)
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("bench.yaml", BENCH), ("instant.yaml", INSTANT), ("host.c", HOST),
                           ("campaign.yaml", CAMPAIGN % (waits // 40))):
            with open(f"{folder}/{name}", "w", encoding="ascii") as file:
                file.write(text)
        subprocess.run(["cc", "-O2", f"{folder}/host.c", "-o", f"{folder}/host", "-I/usr/include/modbus", "-lmodbus"], check=True)
        start = min(run(understudy, folder, "0", "1", "0")[0] for _ in range(3))
        real = min(run(understudy, folder, str(waits), "1", "0")[0] for _ in range(3)) - start
        wait_us = 1e6 * real / waits
        verdict(f"a wait: {wait_us:.1f} us", wait_us <= WAIT_US, f"at most {WAIT_US}")
        times = max(simulated / (real - start)
                    for real, simulated in (run(understudy, folder, str(waits // 4), "20", "1") for _ in range(3)))
        verdict(f"a poll every 20 ms: {times:.0f} times as fast as real time", times >= TIMES_REAL, f"at least {TIMES_REAL}")
        begin = time.monotonic()
        subprocess.run([understudy, "exec", f"{folder}/campaign.yaml", "--host-time", "--jobs", "2", "--", f"{folder}/host",
                        "100", "100", "1"], stdout=subprocess.DEVNULL, check=True)
        a_minute = 60 * (waits // 40) / (time.monotonic() - begin)
        verdict(f"runs of 10 s with 100 polls: {a_minute:.0f} per minute", a_minute >= RUNS_A_MINUTE, f"at least {RUNS_A_MINUTE}")
        pairs = [(with_exec(understudy, folder, waits), with_serve(understudy, folder, waits)) for _ in range(ROUNDS)]
        without = statistics.median(one / other for one, other in pairs)
        verdict(f"an exchange with exec in real time: {without:.3f} times one with serve, {1e6 * pairs[0][0] / waits:.0f} us",
                without <= WITHOUT, f"at most {WITHOUT}")


if __name__ == "__main__":
    main(*sys.argv[1:])
