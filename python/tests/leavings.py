"""Finds files and processes that a process has left behind."""
import os
import time


def gone(still, within_s=15):
    end = time.monotonic() + within_s
    while still() and time.monotonic() < end:
        time.sleep(0.01)
    assert not still()


def mentioned(text):
    """Returns the processes whose command line contains the text."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/cmdline", "rb") as line:
                if int(pid) != os.getpid() and text.encode() in line.read():
                    found.append(int(pid))
        except OSError:
            pass
    return found
