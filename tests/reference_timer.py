#!/usr/bin/python3
"""Says whether the machine is too busy to judge what goes by the wall clock: it sleeps for 10 ms, again and again, and
looks how late it wakes.

usage: reference_timer.py           until SIGTERM; then prints one line if the machine was too busy, and nothing if not
       reference_timer.py --judge   the same of latenesses in ms, one a line, from standard input
"""
import signal
import sys
import time

SLEEP_MS = 10
LATE_MS = 50  # a host's bytes are cut, a reply comes after its time, by less than that
OFTEN = 0.01  # this share of wakes may be late
EVER_MS = 500  # and none as late as this: hosts wait for replies that long


def verdict(latenesses):
    """One line, or nothing."""
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
        # The round that the end came into counts too: a busy machine may not let it wake before.
        latenesses.append(max(0.0, 1000 * (time.monotonic() - begin) - SLEEP_MS))
        return latenesses


def main():
    latenesses = [float(line) for line in sys.stdin] if sys.argv[1:] == ["--judge"] else measured()
    said = verdict(latenesses)
    if said:
        print(said)


if __name__ == "__main__":
    main()
