#!/usr/bin/env python3
"""Measures how long hunts take to find the planted faults of tests/planted_faults, and how many courses.

    benchmarks/hunts.py BUILD_FOLDER [--seeds 10] [--limit 300] [--mended 2000] [--only NAME ...] [--guidance guided]
    benchmarks/hunts.py BUILD_FOLDER --rate 20000

Each fault is hunted with each seed, with guidance and without, until it is found. Then its mended twin is hunted for a
number of courses, with seed 0. Prints the table of docs/hunt.md. With --rate, measures how long courses of one simulated
second take, and as many cases of a campaign that does the same.
"""

import argparse
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

PROJECT = pathlib.Path(__file__).resolve().parent.parent
FAULTS = PROJECT / "tests" / "planted_faults"


class Fault:
    """A scenario with `hunt`, and the host beside which it is played, if it has one."""

    def __init__(self, path, build, folder):
        self.path = path
        self.name = path.stem
        self.text = path.read_text()
        host = re.search(r"^# host: (.*)", self.text, re.M)
        self.command = host[1].split() if host else []
        if self.command[:1] == ["planted_host"]:
            self.command[0] = str(build / "tests" / "planted_host")
        elif self.command[:1] == ["watch"]:
            self.command[0] = str(compiled_watch(folder))

    def of_kind(self, kind, folder):
        """Returns the words that hunt this fault, or its mended twin ("careful")."""
        if self.command:
            return [str(self.path)], ["--"] + [kind if word == "KIND" else word for word in self.command]
        if kind == "careless":
            return [str(self.path)], []
        change = re.search(r"^# mended by: (.*)", self.text, re.M)[1]
        mended = pathlib.Path(folder) / self.path.name
        script = "/^#/!{\n" + change + "\n}"
        mended.write_text(subprocess.run(["sed", "-E", script, self.path], stdout=subprocess.PIPE, text=True,
                                         check=True).stdout)
        return [str(mended)], []


def hunt(build, fault, kind, flags, limit=None):
    """Hunts until something is found, or until the hunt ends. Returns its seconds, course and text, or None."""
    with tempfile.TemporaryDirectory() as folder:
        scenario, command = fault.of_kind(kind, folder)
        words = [str(build / "understudy"), "hunt"] + scenario + flags + ["--found", folder] + command
        if limit:
            words[3:3] = ["--for", f"{limit}s"]
        begin = time.monotonic()
        with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=FAULTS) as process:
            for line in process.stdout:
                course = re.match(r" +course (\d+): ", line)
                if not course:
                    continue
                seconds = time.monotonic() - begin
                process.terminate()
                process.stdout.read()
                found = next(pathlib.Path(folder).glob(f"{fault.name}-*.yaml")).read_text()
                return seconds, int(course[1]), found
            errors = process.stderr.read()
        if process.returncode != 0:
            sys.exit(f"{fault.name}: {errors}")
        return None


def compiled_watch(folder):
    """Compiles the host in C. Returns its path."""
    program = pathlib.Path(folder) / "watch"
    subprocess.run(["cc", "-O1", "-I/usr/include/modbus", "-o", program, FAULTS / "hosts" / "watch.c", "-lmodbus"],
                   check=True)
    return program


def middle(values):
    return statistics.median(values) if values else float("nan")


# A second of a controller with a program, and a disturbance in that second.
RATE = """understudy: 1
name: a second
bench: {{ lines: {{ rs485: {{ stations: [ {{ name: feeder, model: simple2-r3 }} ] }} }} }}
{vary}
steps:
  - program:
      feeder: |
        again:  Wait_IO DIN_10 ON
                Counter_Increase 1
                Delay_mSec 50
                Wait_IO DIN_10 OFF
                Jump again
  - write: {{ PROG_MAIN_RunTime_START: 0 }}
{inject}
  - advance: 995ms
"""
HUNTED = """hunt:
  may: [ inject: { stuck: feeder.DIN_10, level: on, for: { between: [ 1ms, 50ms ] } } ]
  never: feeder.A.speed != 0
"""


def measure_rate(build, courses):
    with tempfile.TemporaryDirectory() as folder:
        hunted, campaign = pathlib.Path(folder, "hunted.yaml"), pathlib.Path(folder, "campaign.yaml")
        hunted.write_text(RATE.format(vary="", inject="  - say: now") + HUNTED)
        inject = ("  - never: feeder.A.speed != 0\n  - inject: { stuck: feeder.DIN_10, level: on, for: 20ms, "
                  "at: \"${at}\" }")
        vary = f"vary: {{ at: {{ between: [ 1000us, 900000us ], samples: {courses} }} }}"
        campaign.write_text(RATE.format(vary=vary, inject=inject))
        for name, words in (("a hunt", ["hunt", hunted, "--courses", str(courses), "--found", folder]),
                            ("an unguided hunt", ["hunt", hunted, "--courses", str(courses), "--found", folder,
                                                  "--unguided"]),
                            ("a campaign", ["run", campaign])):
            begin = time.monotonic()
            subprocess.run([build / "understudy", *words], check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
            seconds = time.monotonic() - begin
            print(f"{name}: {courses} courses in {seconds:.1f} s, {courses / seconds * 60:.0f} per minute")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--limit", type=int, default=300, help="seconds for each hunt")
    parser.add_argument("--mended", type=int, default=2000, help="courses of each mended twin; 0: none")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--guidance", choices=["both", "guided", "unguided"], default="both")
    parser.add_argument("--rate", type=int, help="measure this many courses")
    given = parser.parse_args()
    if given.rate:
        return measure_rate(given.build, given.rate)
    with tempfile.TemporaryDirectory() as folder:
        measure(given, folder)


def measure(given, folder):
    print("| fault | found | seconds | at most | courses | disturbances | steps "
          "| unguided: found | seconds | courses | mended |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for path in sorted(FAULTS.glob("*.yaml")):
        if given.only and path.stem not in given.only:
            continue
        fault = Fault(path, given.build, folder)
        columns = {}
        for guidance, flags in (("guided", []), ("unguided", ["--unguided"])):
            seeds = range(given.seeds) if given.guidance in ("both", guidance) else []
            hunted = [hunt(given.build, fault, "careless", ["--seed", str(seed), "--jobs", str(given.jobs)] + flags,
                           given.limit) for seed in seeds]
            columns[guidance] = [one for one in hunted if one]
        guided, unguided = columns["guided"], columns["unguided"]
        disturbances = [one[2].count("# disturbance ") for one in guided]
        steps = [one[2].count("\n  - ") for one in guided]
        mended = "–"
        if given.mended:
            found = hunt(given.build, fault, "careful", ["--courses", str(given.mended), "--jobs", str(given.jobs)])
            mended = "found" if found else "none"
        seconds = [one[0] for one in guided]
        print(f"| {fault.name} | {len(guided)}/{given.seeds} | {middle(seconds):.1f} | {max(seconds, default=0):.1f} | "
              f"{middle([one[1] for one in guided]):.0f} | {middle(disturbances):.0f} | {middle(steps):.0f} | "
              f"{len(unguided)}/{given.seeds} | {middle([one[0] for one in unguided]):.1f} | "
              f"{middle([one[1] for one in unguided]):.0f} | {mended} |", flush=True)


if __name__ == "__main__":
    main()
