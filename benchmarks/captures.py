#!/usr/bin/env python3
"""Measures `compare`: an hour of a line's capture, and the memory that a much longer capture needs.

usage: captures.py PROGRAM [HOURS]
"""
import os
import subprocess
import sys
import tempfile

BENCH = "understudy: 1\nlines: { line: { stations: [ { name: box, model: simple2-r3 } ] } }\n"
REQUEST = "01 03 00 01 00 01 D5 CA"  # HW_Code
REPLY = "01 03 02 C0 01 29 84"
EVERY_MS = 100
AN_HOUR = 3600 * 1000 // EVERY_MS  # exchanges
HELD = 100_000  # exchanges that `compare` holds to search for options


def write_capture(path, exchanges):
    with open(path, "w", encoding="ascii") as file:
        for i in range(exchanges):
            at = 1000 + i * EVERY_MS
            file.write(f"{at // 1000}.{at % 1000:03d}000000 in line {REQUEST}\n"
                       f"{(at + 9) // 1000}.{(at + 9) % 1000:03d}000000 out line {REPLY}\n")


def measure(program, folder, exchanges):
    """Returns the processor time in seconds and the memory in KiB."""
    capture = os.path.join(folder, "capture.txt")
    write_capture(capture, exchanges)
    command = [program, "compare", capture, "--bench", os.path.join(folder, "bench.yaml"), "--power-up"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        said = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0 or f"{exchanges} exchanges" not in said:
        sys.exit(f"cannot be measured: {said}")
    size = os.path.getsize(capture)
    os.unlink(capture)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss, size


def judge(what, value, limit, unit):
    print(f"{what}: {value:.2f} {unit}; at most {limit:g}: {'met' if value <= limit else 'NOT MET'}")


def main(program, hours=40):
    with tempfile.TemporaryDirectory(prefix="understudy-captures-") as folder:
        with open(os.path.join(folder, "bench.yaml"), "w", encoding="ascii") as file:
            file.write(BENCH)
        hour, _, _ = measure(program, folder, AN_HOUR)
        judge(f"an hour of capture, {AN_HOUR} exchanges", hour, 1.0, "s of processor time")
        _, before, _ = measure(program, folder, HELD + AN_HOUR)
        took, after, size = measure(program, folder, hours * AN_HOUR)
        print(f"{hours} hours, {size / 1e6:.0f} MB: {took:.1f} s of processor time, {after} KiB; "
              f"{HELD + AN_HOUR} exchanges: {before} KiB")
        judge("memory for the long capture", after / before, 1.25, "times")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], *(int(hours) for hours in sys.argv[2:]))
