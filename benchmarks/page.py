#!/usr/bin/env python3
"""Measures the cost of the live page for a bench of fifteen stations, and how soon it reports a change.

usage: page.py UNDERSTUDY [ROUNDS [SECONDS]]

A bench runs and a host talks to it all the time, alternately with and without a page and a browser that watches
everything, each time with a separate daemon. Prints ratios between runs with and without the page: the daemon's
processor time, the time of a host's exchange, and the daemon's lateness. Also prints the time from before a register is
written until its event arrives at the browser.
"""
import base64
import json
import os
import select
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time
import tty

STATIONS = 15


def crc(frame):
    value = 0xFFFF
    for byte in frame:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ 0xA001 if value & 1 else value >> 1
    return struct.pack("<H", value)


class Host:
    def __init__(self, port):
        self.descriptor = os.open(port, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.descriptor)
        settings = termios.tcgetattr(self.descriptor)
        settings[4] = settings[5] = termios.B115200
        termios.tcsetattr(self.descriptor, termios.TCSANOW, settings)

    def exchange(self, request, size):
        begin = time.monotonic()
        os.write(self.descriptor, request + crc(request))
        reply = b""
        while len(reply) < size:
            if not select.select([self.descriptor], [], [], 2)[0]:
                raise RuntimeError("no reply")
            reply += os.read(self.descriptor, 256)
        return time.monotonic() - begin


class Browser:
    """The part of a WebSocket that the page needs (RFC 6455)."""

    def __init__(self, address):
        place, self.token = address.split("/#")
        host, port = place.removeprefix("http://").split(":")
        self.socket = socket.create_connection((host, int(port)))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\nOrigin: http://{host}:{port}\r\n"
                             "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                             f"Sec-WebSocket-Key: {key}\r\n\r\n").encode())
        self.input = b""
        while b"\r\n\r\n" not in self.input:
            self.input += self.socket.recv(4096)
        head, self.input = self.input.split(b"\r\n\r\n", 1)
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise RuntimeError(head.decode())
        self.say({"token": self.token})

    def frame(self, opcode, payload):
        head = bytes([0x80 | opcode])
        if len(payload) < 126:
            head += bytes([0x80 | len(payload)])
        else:
            head += bytes([0x80 | 126]) + struct.pack(">H", len(payload))
        self.socket.sendall(head + bytes(4) + payload)

    def say(self, message):
        self.frame(1, json.dumps(message).encode())

    def need(self, count):
        while len(self.input) < count:
            more = self.socket.recv(65536)
            if not more:
                raise RuntimeError("the page has closed")
            self.input += more

    def hear(self):
        while True:
            self.need(2)
            opcode, size, begin = self.input[0] & 15, self.input[1], 2
            if size == 126:
                self.need(4)
                size, begin = struct.unpack(">H", self.input[2:4])[0], 4
            elif size == 127:
                self.need(10)
                size, begin = struct.unpack(">Q", self.input[2:10])[0], 10
            self.need(begin + size)
            payload, self.input = self.input[begin:begin + size], self.input[begin + size:]
            if opcode == 9:
                self.frame(10, payload)
            elif opcode == 8:
                raise RuntimeError(payload[2:].decode())
            elif opcode == 1:
                return json.loads(payload)


def processor_seconds(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Visit:
    """A page with a browser that watches everything."""

    def __init__(self, program, control):
        self.page = subprocess.Popen([program, "page", "--control", control], stdout=subprocess.PIPE, text=True)
        self.browser = Browser(self.page.stdout.readline().split()[1])
        names = [f"d{i}.{name}" for i in range(1, STATIONS + 1)
                 for name in ("A.position", "A.speed", "A.lost", "B.position", "STATUS", "DIN_1", "DIN_1@by", "DOUT_1")]
        self.browser.say({"do": "watch", "bench": 0, "names": names, "frames": True, "events": True, "status": True})
        self.events, self.looks, self.news = {}, 0, threading.Condition()
        self.listener = threading.Thread(target=self.listen, daemon=True)
        self.listener.start()

    def listen(self):
        try:
            while True:
                message = self.browser.hear()
                if message["is"] != "look":
                    continue
                self.looks += 1
                at = time.monotonic()
                with self.news:
                    for event in message.get("events", []):
                        if event["what"] == "write":
                            self.events.setdefault(event.get("value"), at)
                    self.news.notify_all()
        except (RuntimeError, OSError, ValueError):
            pass

    def time_of(self, value, deadline):
        with self.news:
            self.news.wait_for(lambda: value in self.events, max(0, deadline - time.monotonic()))
            return self.events.get(value)

    def end(self):
        self.page.terminate()
        self.page.wait()
        self.listener.join(2)
        return self.looks


def end_bench(daemon, host):
    os.close(host.descriptor)
    daemon.terminate()
    daemon.wait()


def lateness_us(control):
    """Returns the median, the 99th percentile and the maximum of the daemon's recent wake-up delays."""
    with socket.socket(socket.AF_UNIX) as wire:
        wire.connect(control)
        wire.sendall(b'{"do":"status"}\n')
        reply = b""
        while not reply.endswith(b"\n"):
            reply += wire.recv(65536)
    lateness = json.loads(reply)["status"]["lateness"]
    return lateness["p50_us"], lateness["p99_us"], lateness["max_us"]


def main():
    program = sys.argv[1]
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 4
    folder = tempfile.mkdtemp(prefix="understudy-page-")
    bench = os.path.join(folder, "bench.yaml")
    control = os.path.join(folder, "control")
    with open(bench, "w", encoding="utf-8") as file:
        file.write("understudy: 1\nlines:\n  rs485:\n    link: ./bench.port\n    timing: instant\n    stations:\n")
        for i in range(1, STATIONS + 1):
            file.write(f"      - {{ name: d{i}, model: simple2-r3, address: {i} }}\n")
    def begin_bench():
        daemon = subprocess.Popen([program, "serve", bench, "--ignore-baud", "--control", control], stdout=subprocess.PIPE, text=True)
        daemon.stdout.readline()
        host = Host(os.path.join(folder, "bench.port"))
        for i in range(1, STATIONS + 1):  # every axis A moves for days
            for register, value in ((0x1014, 1), (0x1000, 0), (0x1001, 0x7000), (0x1002, 100), (0x1005, 1)):
                host.exchange(struct.pack(">BBHH", i, 6, register, value), 8)
        return daemon, host

    shares = {True: [], False: []}
    exchanges = {True: [], False: []}
    late = {True: [], False: []}
    looks = 0
    read = struct.pack(">BBHH", 1, 3, 0x0E04, 2)
    for turn in range(2 * rounds):
        works = turn % 2 == 0
        daemon, host = begin_bench()  # a new daemon, because its lateness covers its whole life
        visit = Visit(program, control) if works else None
        time.sleep(0.3)
        begin, before = time.monotonic(), processor_seconds(daemon.pid)
        while time.monotonic() - begin < seconds:
            exchanges[works].append(host.exchange(read, 9))
            time.sleep(0.005)
        shares[works].append((processor_seconds(daemon.pid) - before) / (time.monotonic() - begin) * 100)
        late[works].append(lateness_us(control))
        if visit:
            looks += visit.end()
        end_bench(daemon, host)

    daemon, host = begin_bench()
    visit = Visit(program, control)
    time.sleep(0.5)
    delays, lost = [], 0
    for value in range(1000, 1100):
        begin = time.monotonic()  # before the exchange that changes the register
        host.exchange(struct.pack(">BBHH", 2, 6, 0x8000, value), 8)
        at = visit.time_of(value, begin + 2)
        if at is None:
            lost += 1
        else:
            delays.append(at - begin)
        time.sleep(0.013)
    visit.end()
    end_bench(daemon, host)

    def line(what, with_it, without):
        print(f"{what:44} {with_it:9.3f} {without:9.3f} {with_it / without if without else float('nan'):7.3f}")

    print(f"{'':44} {'with':>9} {'without':>9} {'ratio':>7}")
    line("daemon's time, % of one processor", statistics.median(shares[True]), statistics.median(shares[False]))
    for name, rank in (("median", 0.5), ("99th percentile", 0.99)):
        at = {works: sorted(all_)[int(rank * len(all_))] * 1e6 for works, all_ in exchanges.items()}
        line(f"an exchange, {name}, us", at[True], at[False])
    for name, rank in (("median", 0), ("99th percentile", 1), ("worst", 2)):
        line(f"lateness of ticks, {name}, us", *(statistics.median(half[rank] for half in late[works]) for works in (True, False)))
    print(f"{looks} updates at the browser")
    # A change that was never reported counts as later than all others.
    ranked = sorted(delays) + [float("inf")] * lost
    print(f"change to event at the browser: median {ranked[len(ranked) // 2] * 1000:.1f} ms, 99th percentile "
          f"{ranked[int(len(ranked) * 0.99)] * 1000:.1f} ms, of {len(ranked)}, {lost} never reported (bar: median below 50 ms)")
    if lost:
        print("NOT MET: each change has an event")



main()
