#!/usr/bin/python3
"""Says whether the machine is too busy for tests that depend on the wall clock: it repeatedly sleeps for 10 ms, and
measures how late it wakes.

usage: reference_timer.py           until SIGTERM; then prints one line if the machine was too busy, and nothing if not
       reference_timer.py --judge   the same for delays in ms, one per line, from standard input
"""
import signal
import sys
import time

SLEEP_MS = 10
LATE_MS = 50  # shorter delays already cut a host's frame, or make a reply late
OFTEN = 0.01  # the share of wakes that may be late
EVER_MS = 500  # no wake may be this late, because hosts wait this long for a reply


def verdict(latenesses):
    """Returns one line, or nothing."""
    late = sum(1 for ms in latenesses if ms > LATE_MS)
    most = max(latenesses, default=0)
    if late <= OFTEN * len(latenesses) and most < EVER_MS:
        return ""
    return (f"the machine was too busy to judge tests that go by the wall clock: a timer of {SLEEP_MS} ms came up to "
            f"{most:.0f} ms late, and in {100 * late / len(latenesses):.1f} % of its rounds more than {LATE_MS} ms")


class Ended(Exception):
    pass


def end(*_):
    raise Ended


def measured():
    latenesses = []
    begin = time.monotonic()
    try:
        signal.signal(signal.SIGTERM, end)
        print("begins", file=sys.stderr, flush=True)
        while True:
            begin = time.monotonic()
            time.sleep(SLEEP_MS / 1000)
            latenesses.append(1000 * (time.monotonic() - begin) - SLEEP_MS)
    except Ended:
        # The last round counts as well: on a busy machine, the signal may come before the wake.
        latenesses.append(max(0.0, 1000 * (time.monotonic() - begin) - SLEEP_MS))
        return latenesses


def main():
    latenesses = [float(line) for line in sys.stdin] if sys.argv[1:] == ["--judge"] else measured()
    said = verdict(latenesses)
    if said:
        print(said)


if __name__ == "__main__":
    main()
