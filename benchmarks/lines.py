#!/usr/bin/env python3
"""Measures benches of 1, 10, 100 and 1,000 lines with a device each and at most 4,096 open files: the time until all are
ready, memory, processor time at rest, and a request to each of at most twenty randomly chosen lines.

usage: lines.py EXECUTABLE [SECONDS]
"""
import os
import random
import resource
import subprocess
import sys
import tempfile
import time

FILES = 4096
MEMORY_PER_LINE_KB = 40  # the limit, between 1 and 1,000 lines
AT_REST = 0.001  # the limit with 1,000 lines, as a share of a processor


def bench_of(lines):
    rows = (f"  l{i}: {{ timing: instant, stations: [ {{ name: d{i}, model: simple2-r3 }} ] }}\n" for i in range(lines))
    return "understudy: 1\nlines:\n" + "".join(rows)


def processor_seconds(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory_kb(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


def measure(executable, lines, seconds, folder):
    path = os.path.join(folder, f"{lines}.yaml")
    with open(path, "w", encoding="ascii") as file:
        file.write(bench_of(lines))
    begin = time.monotonic()
    served = subprocess.Popen([executable, "serve", path], stdout=subprocess.PIPE, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (FILES, FILES)))
    try:
        ports = [served.stdout.readline().split()[2] for _ in range(lines)]
        ready, started = time.monotonic() - begin, processor_seconds(served.pid)
        time.sleep(seconds)
        at_rest = (processor_seconds(served.pid) - started) / seconds
        memory = memory_kb(served.pid)
        for port in random.Random(1).sample(ports, min(20, lines)) * 2:  # opened, closed and opened again
            said = subprocess.run([executable, "poll", port, "--model", "simple2-r3", "HW_Code", "--timeout", "10s"],
                                  capture_output=True, text=True, check=True).stdout
            if "49153" not in said:
                sys.exit(f"{port}: answered {said!r}")
    finally:
        served.terminate()
        served.wait()
    print(f"{lines:6} lines   ready in {ready:6.2f} s   started in {started:5.2f} s of processor time   "
          f"{memory / 1024:6.1f} MB   at rest {100 * at_rest:.3f} % of a processor")
    return memory, at_rest


def main(executable, seconds="5"):
    with tempfile.TemporaryDirectory() as folder:
        found = [measure(executable, lines, float(seconds), folder) for lines in (1, 10, 100, 1000)]
    per_line = (found[-1][0] - found[0][0]) / 999
    for what, figure, limit in (("memory of a line, KB", per_line, MEMORY_PER_LINE_KB),
                                ("1,000 lines at rest, processors", found[-1][1], AT_REST)):
        print(f"{what}: {figure:.4g}, at most {limit}: {'met' if figure <= limit else 'NOT MET'}")


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
