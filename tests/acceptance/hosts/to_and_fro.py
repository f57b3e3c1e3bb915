#!/usr/bin/python3
"""Random programs, stepped to and fro: to_and_fro.py UNDERSTUDY MODEL.

The states on the way back are those of the way forward, in reverse, and a run with breakpoints ends in the same state
as one without. A state is the snapshot of the whole bench. UNDERSTUDY_PROGRAMS sets the number of programs.
"""
import json
import os
import random
import socket
import subprocess
import sys
import tempfile

UNDERSTUDY, MODEL = sys.argv[1:3]
PROGRAMS = int(os.environ.get("UNDERSTUDY_PROGRAMS", "8"))
STEPS = 10
RUN_MS = 300
PATIENCE = 60  # seconds
SEED = 35


class Refused(Exception):
    pass


class Bench:
    """`understudy serve` of one controller, in manual time."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        path = self.folder.name + "/control"
        self.process = subprocess.Popen(
            [UNDERSTUDY, "serve", "--model", MODEL, "--speed", "manual", "--control", path], stdout=subprocess.PIPE)
        self.process.stdout.readline()
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(PATIENCE)
        self.socket.connect(path)
        self.stream = self.socket.makefile("rwb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stream.close()
        self.socket.close()
        self.process.terminate()
        assert self.process.wait(PATIENCE) == 0
        self.process.stdout.close()
        self.folder.cleanup()

    def ask(self, do, **fields):
        self.stream.write(json.dumps({"do": do, **fields}).encode() + b"\n")
        self.stream.flush()
        reply = json.loads(self.stream.readline())
        if not reply["ok"]:
            raise Refused(reply["error"])
        return reply

    def now_ns(self):
        return self.ask("stack", device="device")["simulated_time_ns"]

    def state(self):
        """Returns the whole state of the bench, without what the daemon's own clock has counted."""
        path = self.folder.name + "/state"
        self.ask("snapshot", file=path)
        with open(path, encoding="utf-8") as file:
            return {key: value for key, value in json.load(file)["state"].items() if key != "edge"}


class Simple2:
    start = ("set", {"values": {"PROG_MAIN_RunTime_START": 0}})
    inputs = ["DIN_%d" % number for number in range(4)]
    values = ["PROG_VAR%d" % number for number in range(4)]

    @staticmethod
    def program(draw):
        count = draw.randint(6, 25)
        flag = lambda: "JMP%d" % draw.randint(1, count)
        memory = lambda: "VAR%d" % draw.randint(32, 35)
        pin = lambda: "DIN_%d" % draw.randint(0, 3)
        lines = []
        for number in range(1, count + 1):
            lines.append("JMP%d: " % number + draw.choice([
                lambda: "NOP", lambda: "VAR_Inc " + memory(), lambda: "VAR_Inc " + memory(), lambda: "VAR_Dec " + memory(),
                lambda: "Jump " + flag(), lambda: "Jump_IN_ON %s %s" % (flag(), pin()),
                lambda: "Jump_IN_OFF %s %s" % (flag(), pin()),
                lambda: "Wait_IO %s %s" % (pin(), draw.choice(["ON", "OFF"])),
                lambda: "Delay_mSec %d" % draw.randint(0, 9), lambda: "VAR_GT %s %s" % (memory(), memory()),
                lambda: "VAR_GT_0 %s %s" % (flag(), memory()), lambda: "Out DOUT_1 " + draw.choice(["ON", "OFF"])])())
        return "\n".join([*lines, "JMP%d: END" % (count + 1), "JMP%d: END" % (count + 2)]) + "\n"


class Slim:
    start = ("command", {"text": "G"})
    inputs = ["IN%d" % number for number in range(1, 5)]
    values = ["N0", "N1", "N2"]

    @staticmethod
    def program(draw):
        count = draw.randint(6, 25)
        label = lambda: "$L%d" % draw.randrange(count)
        pin = lambda: str(draw.randint(1, 4))
        lines = []
        for number in range(count):
            lines.append("$L%d " % number + draw.choice([
                lambda: "N%d=%d" % (draw.randrange(3), draw.randrange(2)), lambda: "N%d=N%d+1" % (draw.randrange(3), draw.randrange(3)),
                lambda: "SET P1", lambda: "CLR P2", lambda: "JP " + label(), lambda: "JI %s,%s" % (pin(), label()),
                lambda: "JNI %s,%s" % (pin(), label()), lambda: "JZ N%d,%s" % (draw.randrange(3), label()),
                lambda: "JTI %s,%d,%s" % (pin(), draw.randrange(6), label()), lambda: "WI " + pin(), lambda: "WNI " + pin(),
                lambda: "WT %d" % draw.randrange(9), lambda: "CALL " + label(), lambda: "MR %d" % draw.randint(-50, 50),
                lambda: draw.choice(["RET", "DN"])])())
        return "\n".join(lines) + "\n"


class Macros:
    start = ("set", {"values": {"CALL_MPn": 41}})
    inputs = []
    values = ["VAR%d" % number for number in range(4)]

    @classmethod
    def body(cls, draw, depth):
        lines = []
        var = lambda: "VAR%d" % draw.randrange(4)
        for _ in range(draw.randint(1, 6 if depth == 0 else 3)):
            what = draw.randrange(9)
            if what == 0 and depth < 3:
                lines += ["RSM_MACRO_FOR %d" % draw.randint(1, 3), *cls.body(draw, depth + 1), "RSM_MACRO_NEXT"]
            elif what == 1 and depth < 3:
                lines += ["RSM_MACRO_IF %s %s %d" % (var(), draw.choice(["<", ">", "="]), draw.randrange(4)),
                          *cls.body(draw, depth + 1)]
                if draw.random() < 0.5:
                    lines += ["RSM_MACRO_ELSE", *cls.body(draw, depth + 1)]
                lines += ["RSM_MACRO_END_IF"]
            elif what == 2:
                lines += ["RSM_MACRO_MP_CALL %d" % draw.choice([2, 3])]
            elif what == 3:
                lines += ["RSM_MACRO_FIXED_MOVE X %d" % draw.randint(-40, 40)]
            elif what < 6:
                lines += ["RSM_MACRO_TIMER %d" % draw.randint(1, 9)]
            else:
                lines += ["RSM_MACRO_SET_VAR %s %d" % (var(), draw.randrange(9))]
        return lines

    @classmethod
    def program(cls, draw):
        macros = {41: cls.body(draw, 0), 2: cls.body(draw, 2), 3: ["RSM_MACRO_TIMER 3", "RSM_MACRO_SET_VAR VAR3 1"]}
        macros[2] = [line for line in macros[2] if not line.endswith("_CALL 2")] or ["RSM_MACRO_TIMER 2"]
        return "".join("MP %d\n%s\nEND\n" % (number, "\n".join(lines)) for number, lines in macros.items())


class Super40nc:
    start = ("set", {"values": {"M8000": 1}})
    inputs = ["X1%d" % number for number in range(4)]
    values = ["D%d" % number for number in range(4)]

    @classmethod
    def body(cls, draw, depth):
        number = lambda letter: letter + str(draw.randrange(4))
        device = lambda: draw.choice([number("M"), number("X1")])
        lines = []
        for _ in range(draw.randint(2, 8) if depth == 0 else draw.randint(0, 3)):
            what = draw.randrange(14)
            if what == 0 and depth < 4:
                lines += [draw.choice(["LD ", "LDI "]) + device(), draw.choice(["AND ", "OR ", "ANI "]) + device(), "IF",
                          *cls.body(draw, depth + 1), *(["ELSE", *cls.body(draw, depth + 1)] if draw.random() < 0.5 else []),
                          "ENDI"]
            elif what == 1:
                lines += ["LD " + device(), draw.choice(["CJ K", "CJN K"]) + str(draw.randrange(4))]
            else:
                lines += [draw.choice([
                    lambda: "SET " + number("M"), lambda: "RST " + number("M"), lambda: "INC " + number("D"),
                    lambda: "ADD %s K3 %s" % (number("D"), number("D")), lambda: "TMR K%d" % draw.randrange(9),
                    lambda: draw.choice(["WAT ", "WTN "]) + device(), lambda: "CAL K%d K%d" % (draw.choice([10, 11]), draw.randint(1, 2)),
                    lambda: "MOV K%d %s" % (draw.randrange(4), number("D")), lambda: "LAB K%d" % draw.randrange(4),
                    lambda: "DRV K%d" % draw.randint(1, 9)])()]
        return lines

    @classmethod
    def program(cls, draw):
        ladder = ["AREA PLC", *(line for number in range(draw.randint(1, 4)) for line in
                                ("LD X1%d" % number, draw.choice(["AND", "OR"]) + " M%d" % number,
                                 draw.choice(["OUT Y1%d", "SET M%d", "INC D%d"]) % number)), "END"]
        return "\n".join([*ladder, "AREA C", "RPM K100", *cls.body(draw, 0), *cls.body(draw, 0), "END", "LAB K10",
                          *cls.body(draw, 3), "RET", "LAB K11", "TMR K2", "RET"]) + "\n"


LANGUAGE = {"simple2-r3": Simple2, "slim": Slim, "rs-m8194h": Macros, "super-40nc": Super40nc}[MODEL]


def load(bench, draw):
    """Loads a program that the device takes, and starts it."""
    while True:
        text = LANGUAGE.program(draw)
        try:
            bench.ask("program", device="device", text=text)
            break
        except Refused:
            pass
    do, fields = LANGUAGE.start
    bench.ask(do, **({"device": "device"} if do == "command" else {}), **fields)
    return text


def disturb(bench, draw):
    """Changes something from outside: it is part of the course."""
    if LANGUAGE.inputs and draw.random() < 0.4:
        bench.ask("input", values={draw.choice(LANGUAGE.inputs): draw.randrange(2)})
    if draw.random() < 0.2:
        bench.ask("set", values={draw.choice(LANGUAGE.values): draw.randrange(5)})


def moment(bench):
    stack = bench.ask("stack", device="device")
    return stack["simulated_time_ns"], stack["stacks"], bench.state()


def check_to_and_fro(bench, draw):
    """Returns the number of steps, back again."""
    what = draw.choice(["instruction", "line"])
    program = {"program": "C"} if MODEL == "super-40nc" else {}
    moments = []
    for _ in range(STEPS):
        stop = bench.ask("step", what=what, device="device", within="200ms", **program).get("stop")
        if stop is None or stop["reason"] != "step":
            break  # it waits, or has ended: the way back leads to the last line first
        disturb(bench, draw)
        moments.append(moment(bench))
    else:
        moments.pop()
    for expected in reversed(moments):
        bench.ask("step", what=what, device="device", back=True, **program)
        found = moment(bench)
        assert found == expected, (what, found[:2], expected[:2])
    return len(moments)


def run(bench, draw, lines):
    """Runs for a while, with inputs that change, and stops at breakpoints. Returns the state and the number of stops."""
    for line in lines:
        bench.ask("break", device="device", line=line, nth=draw.randint(1, 3))
    if lines:
        bench.ask("break", when="time / 1ms % 7 == 0")
    changes = random.Random(7)
    stops = 0
    begin_ns = bench.now_ns()
    for end_ms in range(RUN_MS // 3, RUN_MS + 1, RUN_MS // 3):
        while (left := begin_ns + end_ms * 1_000_000 - bench.now_ns()) > 0:
            stops += "stop" in bench.ask("continue", within="%dns" % left)
        disturb(bench, changes)
    bench.ask("break", delete="all")
    return bench.state(), stops


def main():
    draw = random.Random(SEED)
    steps = stops = 0
    with Bench() as bench:
        bench.ask("snapshot", name="begin")
        for number in range(PROGRAMS):
            bench.ask("restore", name="begin")
            text = load(bench, draw)
            try:
                bench.ask("snapshot", name="loaded")
                steps += check_to_and_fro(bench, draw)
                bench.ask("restore", name="loaded")
                plain, _ = run(bench, draw, [])
                bench.ask("restore", name="loaded")
                lines = bench.ask("source", device="device")["lines"]
                stopped, count = run(bench, draw, draw.sample(lines, min(4, len(lines))))
                stops += count
                assert stopped == plain, "the breakpoints have changed the run"
            except (AssertionError, Refused):
                print("program %d (seed %d):\n%s" % (number, SEED, text), file=sys.stderr)
                raise
    print("%s: %d programs, %d steps to and fro, %d stops at breakpoints" % (MODEL, PROGRAMS, steps, stops))
    assert steps >= PROGRAMS and stops >= PROGRAMS * 3, "too few steps and stops to prove anything"


main()
