#!/usr/bin/env python3
"""Measures how fast the debug adapter answers while 15 stations run in real time, how many replies a host loses because
of logpoints, and the cost of an hour of a program before and after it had breakpoints.

usage: debugger.py EXECUTABLE [ROUNDS]
"""
import json
import os
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import time

STATIONS = 15
ANSWER_MS = 5  # the limit for 99 of 100 answers
COST = 1.01  # the limit, relative to the time without breakpoints: median over the pairs
READING_S = 5
REPLY_S = 1

PROGRAM = ("again:  VAR_Inc VAR32\n        Delay_mSec 2\n        VAR_GT VAR32 VAR33\n        Jump again\n        Jump again\n"
           "        END\n")


def bench_of(folder, stations):
    with open(os.path.join(folder, "count.lst"), "w", encoding="ascii") as file:
        file.write(PROGRAM)
    rows = "".join(f"      - {{ name: m{i}, model: simple2-r3, address: {i}, program: count.lst, "
                   "set: { AutoStart_MainProg: 1 } }\n" for i in range(1, stations + 1))
    path = os.path.join(folder, "bench.yaml")
    with open(path, "w", encoding="ascii") as file:
        file.write("understudy: 1\nlines:\n  a:\n    timing: instant\n    link: ./a.port\n    stations:\n" + rows)
    return path


class Served:
    def __init__(self, executable, folder, stations, *more):
        self.control = os.path.join(folder, "control")
        self.process = subprocess.Popen([executable, "serve", bench_of(folder, stations), "--control", self.control, *more],
                                        stdout=subprocess.PIPE, text=True)
        self.port = self.process.stdout.readline().split()[2]
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(self.control)
        self.stream = self.socket.makefile("rwb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stream.close()
        self.socket.close()
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()

    def ask(self, do, **fields):
        self.stream.write(json.dumps({"do": do, **fields}).encode() + b"\n")
        self.stream.flush()
        reply = json.loads(self.stream.readline())
        if not reply["ok"]:
            sys.exit(reply["error"])
        return reply

    def processor_seconds(self):
        with open(f"/proc/{self.process.pid}/stat", encoding="ascii") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Adapter:
    def __init__(self, executable):
        self.process = subprocess.Popen([executable, "dap"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.sent = 0

    def ask(self, command, **arguments):
        self.sent += 1
        text = json.dumps({"seq": self.sent, "type": "request", "command": command, "arguments": arguments}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(text), text))
        self.process.stdin.flush()
        while True:
            length = int(self.process.stdout.readline().split(b":")[1])
            self.process.stdout.readline()
            message = json.loads(self.process.stdout.read(length))
            if message["type"] == "response":
                if not message["success"]:
                    sys.exit(f"{command}: {message['message']}")
                return message.get("body", {})

    def end(self):
        self.ask("disconnect")
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()


def judge(what, value, limit, unit=""):
    print(f"{what}: {value:.3f}{unit}, at most {limit}{unit}: {'met' if value <= limit else 'NOT MET'}")


def answers(executable, folder):
    """Times each request while the bench runs in real time."""
    with Served(executable, folder, STATIONS) as served:
        adapter = Adapter(executable)
        adapter.ask("initialize", adapterID="understudy")
        adapter.ask("attach", control=served.control)
        adapter.ask("configurationDone")
        threads = adapter.ask("threads")["threads"]
        thread = threads[len(threads) // 2]["id"]
        frame = adapter.ask("stackTrace", threadId=thread)["stackFrames"][0]["id"]
        program = adapter.ask("scopes", frameId=frame)["scopes"][1]["variablesReference"]
        requests = {"threads": {}, "stackTrace": {"threadId": thread}, "scopes": {"frameId": frame},
                    "variables": {"variablesReference": program}, "evaluate": {"expression": "m7.PROG_VAR0 * 2"}}
        for command, arguments in requests.items():
            times_ms = []
            for _ in range(300):
                begin = time.perf_counter()
                adapter.ask(command, **arguments)
                times_ms.append(1e3 * (time.perf_counter() - begin))
            times_ms.sort()
            print(f"{command}: median {statistics.median(times_ms):.2f} ms")
            judge(f"{command}, 99 of 100", times_ms[len(times_ms) * 99 // 100], ANSWER_MS, " ms")
        adapter.end()


def crc(frame):
    value = 0xFFFF
    for byte in frame:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ 0xA001 if value & 1 else value >> 1
    return struct.pack("<H", value)


def replies(executable, folder):
    """Counts the replies that a host loses. It reads as fast as it can while a logpoint prints at every pass of a program."""
    with Served(executable, folder, 1) as served:
        served.ask("break", device="m1", line=1, log="now {m1.PROG_VAR0}")
        port = os.open(served.port, os.O_RDWR | os.O_NOCTTY)
        os.set_blocking(port, False)
        request = bytes([1, 3, 0, 0, 0, 2])
        reads = lost = 0
        stop = time.monotonic() + READING_S
        while time.monotonic() < stop:
            reads += 1
            os.write(port, request + crc(request))
            reply, end = b"", time.monotonic() + REPLY_S
            while len(reply) < 9 and time.monotonic() < end:
                try:
                    reply += os.read(port, 64)
                except BlockingIOError:
                    time.sleep(0.0001)
            lost += len(reply) != 9
        os.close(port)
        hits = served.ask("break")["breakpoints"][0]["hits"]
        print(f"{reads} reads during {hits} hits of a logpoint")
        if hits == 0:
            sys.exit("the logpoint was not hit")
        judge("lost replies", lost, 0)


def cost(executable, folder, rounds):
    """Compares an hour of a program before any breakpoint with one after a breakpoint was set and deleted, alternately in two
    daemons."""
    with Served(executable, folder, 1, "--speed", "manual") as plain:
        other = os.path.join(folder, "other")
        os.mkdir(other)
        with Served(executable, other, 1, "--speed", "manual") as debugged:
            ratios = []
            for number in range(rounds):
                point = debugged.ask("break", device="m1", line=2)["breakpoint"]["number"]
                debugged.ask("continue", within="1s")
                debugged.ask("break", delete=point)
                times = {}
                for served in (plain, debugged) if number % 2 == 0 else (debugged, plain):
                    begin = served.processor_seconds()
                    served.ask("advance", by="1h")
                    times[served] = served.processor_seconds() - begin
                ratios.append(times[debugged] / times[plain])
            print(f"an hour of a program: {times[plain]:.2f} s of processor time")
            judge("an hour after breakpoints were deleted, relative to one without", statistics.median(ratios), COST)


def main(executable, rounds="9"):
    executable = os.path.abspath(executable)
    for measure in (answers, replies, lambda *given: cost(*given, int(rounds))):
        with tempfile.TemporaryDirectory() as folder:
            measure(executable, folder)


if __name__ == "__main__":
    main(*sys.argv[1:])
