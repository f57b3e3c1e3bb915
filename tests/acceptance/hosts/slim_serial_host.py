#!/usr/bin/python3
"""Uses python3-serial as the host of a served SLIM: slim_serial_host.py PORT CASE

Each case is a program as a user of pyserial writes it. Exits with 0, or with one line that says what was read and what
was expected.
"""
import sys
import time

import serial

PATIENCE_S = 3

# Stacks boxes: a stroke for each box, a quarter of a circle to the next stack, and a word after each.
PALLET = """DLP
TX=0
TY=1
OUT "BOXES"
N0=GETI
OUT "PITCH"
R0=GETR
CS 0
T1CS 0
R1=0
N1=0
$BOX
2MR R0,R1
XDN
OUT "BOX"
SET P1
WT 20
CLR P1
JE N0,N1,$DONE
N1=N0
JP $BOX
$DONE
AA 0,0,90
XDN
OUT "PALLET"
RET
END
"""


class Unexpected(Exception):
    """The reply differs from the command list."""


def expect(what, actual, expected):
    if actual != expected:
        raise Unexpected(f"{what}: {actual!r}; expected {expected!r}")


class Robot:
    def __init__(self, path):
        self.line = serial.serial_for_url(path, 9600, timeout=PATIENCE_S)

    def type(self, text):
        self.line.write(text.encode("latin-1") + b"\r")

    def expect_line(self, expected):
        read = self.line.read_until(b"\r\n")
        expect("line", read, expected.encode() + b"\r\n")

    def ask(self, query, expected):
        self.type(query)
        read = self.line.read_until(b"\r\n")
        expect(query, read, expected.encode() + b"\r\n")

    def expect_silence(self):
        self.line.timeout = 0.1
        expect("after everything", self.line.read(1), b"")
        self.line.timeout = PATIENCE_S


def palletising(path):
    robot = Robot(path)
    robot.line.write(PALLET.replace("\n", "\r").encode())  # all of it in one write
    robot.ask("?ERR", "0")
    robot.type("TVM=1000")
    robot.type("TVA=100000")
    robot.type("T1TVA=100000")
    robot.type("G")
    robot.expect_line("BOXES")
    robot.ask("two", "ERR 1")  # not a number, so the program asks again
    robot.type("2")
    robot.expect_line("PITCH")
    robot.ask("?PE", "ERR 1")  # while a program waits for a number, a line is not a command
    started = time.monotonic()
    robot.type("12.5")
    robot.expect_line("BOX")
    robot.expect_line("BOX")
    robot.expect_line("PALLET")
    # 2 x 12.5, then a quarter of a circle with the radius 25, which is 39.27. At 100000 units/s2 they take 2 sqrt(12.5
    # / a) = 22.4 ms twice and 39.27 / 1000 + 10 ms = 49.3 ms, and the waits take 2 x 20 ms: 134 ms.
    took = time.monotonic() - started
    if took < 0.134:
        raise Unexpected(f"took {took:.3f} s; expected 0.134 s or more")
    robot.ask("?PE", "0")
    robot.ask("?T1PE", "25")
    robot.ask("?N1", "2")
    robot.type("ULP")
    for line in PALLET.split("\n")[1:-1]:
        robot.expect_line(line)
    robot.expect_silence()


def half_lines(path):
    robot = Robot(path)
    for piece in (b"?", b"P", b"E", b"\r"):
        robot.line.write(piece)
        robot.line.flush()
        time.sleep(0.02)
    robot.expect_line("0")
    robot.line.write(b"N1=4\r\nR1=2.5\r?N1\r\n?R1\n?VER\r")  # several in one write, with three kinds of ends
    for expected in ("4", "2.5", "1.00"):
        robot.expect_line(expected)
    robot.line.write(b"?N1?\x1b?N1\r")  # ESC discards the beginning of the line
    robot.expect_line("4")
    robot.expect_silence()


def noise(path):
    robot = Robot(path)
    for byte in list(range(0x00, 0x09)) + list(range(0x0E, 0x1B)) + list(range(0x80, 0x100)):
        robot.line.write(bytes([byte, byte, 13]) + b"?N0\r" if byte % 16 == 3 else b"")
        if byte % 16 == 3:
            robot.expect_line("ERR 1")
            robot.expect_line("0")
    robot.line.write(b"x" * 200 + b"\r?ERR\r")
    robot.expect_line("ERR 1")  # one for the whole line
    robot.expect_line("1")
    robot.line.write(b"\xff\x00\xfe?PE\rRESET\r?ERR\r?PE\r")  # noise within a line corrupts that line only
    for expected in ("ERR 1", "0", "0"):
        robot.expect_line(expected)
    robot.expect_silence()


def reopening(path):
    for number in range(10):
        robot = Robot(path)
        robot.ask("?N7", str(number))
        robot.type(f"N7={number + 1}")
        robot.ask("?N7", str(number + 1))
        robot.line.close()


CASES = {
    "palletising": palletising,
    "half_lines": half_lines,
    "noise": noise,
    "reopening": reopening,
}


def main():
    path, case = sys.argv[1:]
    try:
        CASES[case](path)
    except Unexpected as unexpected:
        print(f"{case}: {unexpected}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
