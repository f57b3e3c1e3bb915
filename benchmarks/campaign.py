#!/usr/bin/env python3
"""Measures the cost of a case in a campaign, and whether memory use grows with the number of cases.

benchmarks/campaign.py UNDERSTUDY [CASES [ROUNDS]]

Plays CASES (5000) of examples/campaign on two threads, alternately with and without result files.
"""
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENARIO = pathlib.Path(__file__).resolve().parents[1] / "examples/campaign/move.yaml"
ALL = 100_000
PROCESSOR_S = 240.0  # seconds for all cases: two minutes on two cores
RESULTS_BAR = 1.25
MEMORY_BAR = 1.25


def play(understudy, cases, *flags):
    """Returns the processor time in seconds, and the peak memory in KiB."""
    command = [understudy, "run", str(SCENARIO), "--jobs", "2", "--shard", f"1/{ALL // cases}", *flags]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(2)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def verdict(what, ratio, bar):
    print(f"{'met' if ratio <= bar else 'NOT MET':8s} {what}: {ratio:.3f} (bar: at most {bar:.3f})")


def main(understudy, cases=5000, rounds=5):
    cases, rounds = int(cases), int(rounds)
    with tempfile.TemporaryDirectory() as folder:
        results = ["--results", f"{folder}/rows.jsonl", "--results", f"{folder}/rows.sqlite", "--junit", f"{folder}/rows.xml"]
        plain, with_results = [], []
        for _ in range(rounds):
            plain.append(play(understudy, cases, "--hash")[0])
            with_results.append(play(understudy, cases, *results)[0])
        each_ms = 1000 * statistics.median(with_results) / cases
        print(
            f"a case: {each_ms:.3f} ms of processor time with results as lines, in a database and as JUnit;"
            f" {ALL} of them {each_ms * ALL / 1000:.1f} s, {each_ms * ALL / 2000:.1f} s on two free cores"
        )
        verdict(f"{ALL} cases, relative to {PROCESSOR_S:.0f} s of processor time", each_ms * ALL / 1000 / PROCESSOR_S, 1)
        verdict(
            "a case with results, relative to one without",
            statistics.median(b / a for a, b in zip(plain, with_results)),
            RESULTS_BAR,
        )
        few, many = (play(understudy, count, *results)[1] for count in (cases // 10, 4 * cases))
        print(f"memory: {few} KiB for {cases // 10} cases, {many} KiB for {4 * cases}")
        verdict("memory for forty times as many cases", many / few, MEMORY_BAR)


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 4:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
