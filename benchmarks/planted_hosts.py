#!/usr/bin/env python3
"""Measures how many cases a campaign needs to find the faults planted in the hosts of tests/planted_hosts.

    benchmarks/planted_hosts.py BUILD_FOLDER [--cases 2000] [--mended 2000] [--jobs 1] [--only NAME ...]

The scenarios there vary little, so that tests are quick. Here each has randomly drawn cases instead. Prints a row for
each host: the first case that fails, how many fail, and how many fail in the mended host.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

HOSTS = pathlib.Path(__file__).resolve().parent.parent / "tests" / "planted_hosts"

# What the cases of each host draw. One parameter of each has CASES values.
DRAWN = {
    "double_move": "number: { between: [ 400, 4800 ], samples: CASES }\n"
                   "  of: { one_of: [ reply, request ] }\n"
                   "  nth: { between: [ 1, 40 ] }",
    "stale_busy_bit": "number: { between: [ 1600, 4800 ], samples: CASES }\n"
                      "  nth: { between: [ 2, 60 ] }",
    "torn_value": "number: { between: [ 0, 4999 ], samples: CASES }",
    "timeout_race": "number: { between: [ 3200, 9600 ], samples: CASES }\n"
                    "  nth: { between: [ 5, 60 ] }\n"
                    "  by: { between: [ 1ms, 100ms ] }",
    "missing_wait": "number: [ 3200 ]\n"
                    "  start: { between: [ 1000, 15000 ], samples: CASES }",
    "counter_overflow": "number: { between: [ 0, 70000 ], samples: CASES }",
    "lost_command": "number: [ 800 ]\n"
                    "  at: { between: [ 100000us, 1200000us ], samples: CASES }",
    "starved_stop": "number: [ 64000 ]\n"
                    "  stop: { between: [ 500000us, 1800000us ], samples: CASES }\n"
                    "  lost: { one_of: [ 5%, 20%, 40%, 60%, 80% ] }",
    "word_order": "number: [ 20 ]\n"
                  "  at: { between: [ 0us, 6000000us ], samples: CASES }",
    "early_alarm_clear": "number: [ 16000 ]\n"
                         "  at: { between: [ 100000us, 900000us ], samples: CASES }\n"
                         "  lasts: { between: [ 1ms, 500ms ] }",
}


def drawn_scenario(name, cases):
    text = (HOSTS / f"{name}.yaml").read_text()
    vary = "vary:\n  " + DRAWN[name].replace("CASES", str(cases)) + "\n"
    return re.sub(r"^vary:.*\n(?: .*\n)*", vary, text, count=1, flags=re.M)


def play(given, name, kind, cases, folder):
    """Plays all cases. Returns the rows of the results, and the seconds."""
    scenario, results = folder / f"{name}.yaml", folder / f"{kind}.jsonl"
    scenario.write_text(drawn_scenario(name, cases))
    words = [given.build / "understudy", "exec", scenario, "--host-time", "--jobs", str(given.jobs), "--results", results,
             "--failures", folder / "failures", "--", given.build / "tests" / "planted_host", name, kind, "${number}"]
    begin = time.monotonic()
    done = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{name}: {done.stderr}")
    return [json.loads(line) for line in results.read_text().splitlines()], time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--cases", type=int, default=2000, help="cases of the host with the fault")
    parser.add_argument("--mended", type=int, default=2000, help="cases of the mended host")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", nargs="*", default=list(DRAWN))
    given = parser.parse_args()
    print("| host | cases | first found in case | failed | failed when mended | seconds |")
    print("|---|---|---|---|---|---|")
    for name in given.only:
        with tempfile.TemporaryDirectory() as folder:
            careless, seconds = play(given, name, "careless", given.cases, pathlib.Path(folder))
            careful, more = play(given, name, "careful", given.mended, pathlib.Path(folder))
        failed = [number for number, row in enumerate(careless, 1) if row["verdict"] != "passed"]
        mended = [row for row in careful if row["verdict"] != "passed"]
        print(f"| {name} | {len(careless)}, {len(careful)} | {failed[0] if failed else 'none'} | {len(failed)} | "
              f"{len(mended)} | {seconds + more:.0f} |", flush=True)
        for row in mended[:3]:
            print(f"  {row['parameters']}: {row['failure']}", flush=True)


if __name__ == "__main__":
    main()
