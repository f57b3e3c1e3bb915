"""Measures the cost of a step of 1 ms in lockstep from Python.

Prints the median of twenty rounds in microseconds; `limit` is the highest acceptable cost.
"""
import statistics
import time

import understudy

STEPS = 1000
ROUNDS = 20
LIMIT_US = 60.0

with understudy.start(model="simple2-r3") as bench:
    figures = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        for _now in bench.lockstep("1ms", STEPS):
            pass
        figures.append((time.perf_counter() - begin) / STEPS * 1e6)
print(f"lockstep_step_us {statistics.median(figures):.1f} fastest {min(figures):.1f} limit {LIMIT_US:.0f}")
