#!/usr/bin/python3
"""A client of the Debug Adapter Protocol: dap_client.py UNDERSTUDY CASE. Every message that comes is checked against
the specification's rules for its kind; the first thing that is wrong ends the case."""
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

UNDERSTUDY = sys.argv[1]
PATIENCE = 60  # seconds; for conditions that come, not for how fast they do
REASONS = ("step", "breakpoint", "exception", "pause", "entry", "data breakpoint", "instruction breakpoint")


class Client:
    """Talks over two streams. Events are kept until they are asked for."""

    def __init__(self, reader, writer):
        self.reader, self.writer = reader, writer
        self.sent, self.seen, self.events = 0, 0, []

    def raw(self, data):
        self.writer.write(data)
        self.writer.flush()

    def receive(self):
        length = None
        while True:
            line = self.reader.readline()
            if not line:
                return None
            if line == b"\r\n":
                break
            name, value = line.decode().split(":", 1)
            if name == "Content-Length":
                length = int(value)
        message = json.loads(self.reader.read(length))
        assert message["seq"] == self.seen + 1, message
        self.seen = message["seq"]
        assert message["type"] in ("response", "event"), message
        if message["type"] == "event":
            assert isinstance(message["event"], str) and isinstance(message.get("body", {}), dict), message
            if message["event"] == "stopped":
                assert message["body"]["reason"] in REASONS, message
                assert isinstance(message["body"]["threadId"], int), message
        else:
            assert isinstance(message["success"], bool) and isinstance(message["request_seq"], int), message
            if not message["success"]:
                assert "\n" not in message["message"] and message["message"], message
        return message

    def ask_all(self, command, arguments=None):
        self.sent += 1
        message = {"seq": self.sent, "type": "request", "command": command}
        if arguments is not None:
            message["arguments"] = arguments
        text = json.dumps(message).encode()
        self.raw(b"Content-Length: %d\r\n\r\n" % len(text) + text)
        while True:
            answer = self.receive()
            assert answer is not None, command
            if answer["type"] == "event":
                self.events.append(answer)
                continue
            assert answer["request_seq"] == self.sent and answer["command"] == command, answer
            return answer

    def ask(self, command, **arguments):
        answer = self.ask_all(command, arguments)
        assert answer["success"], answer
        return answer.get("body")

    def refused(self, command, **arguments):
        answer = self.ask_all(command, arguments)
        assert not answer["success"], answer
        return answer["message"]

    def event(self, name):
        """Waits for the next event of that name. Others are kept."""
        while True:
            for place, event in enumerate(self.events):
                if event["event"] == name:
                    return self.events.pop(place).get("body", {})
            message = self.receive()
            assert message is not None, "the adapter has ended before the event " + name
            self.events.append(message)


class Adapter(Client):
    def __init__(self):
        self.process = subprocess.Popen([UNDERSTUDY, "dap"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        super().__init__(self.process.stdout, self.process.stdin)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.writer.close()
        assert self.process.wait(PATIENCE) == 0
        self.reader.close()

    def begin(self, request, stop_on_entry=True, breakpoints=(), path=None, **arguments):
        assert self.ask("initialize", adapterID="understudy")["supportsConfigurationDoneRequest"]
        self.ask(request, stopOnEntry=stop_on_entry, **arguments)
        self.event("initialized")
        set_ones = self.ask("setBreakpoints", source={"path": path}, breakpoints=list(breakpoints)) if path else None
        self.ask("setExceptionBreakpoints", filters=["program-error"])
        self.ask("configurationDone")
        return set_ones


class Served:
    """`understudy serve`, in manual time, of one device with a program in a file."""

    def __init__(self, model, ending, program, speed="manual"):
        self.folder = tempfile.TemporaryDirectory()
        self.control = self.folder.name + "/control"
        self.program = pathlib.Path(self.folder.name, "program" + ending)
        self.program.write_text(program)
        self.bench = pathlib.Path(self.folder.name, "bench.yaml")
        self.bench.write_text("understudy: 1\nlines:\n  a: { stations: [ { name: m, model: %s, program: %s } ] }\n"
                              % (model, self.program.name))
        self.recording = self.folder.name + "/recording.jsonl"
        self.process = subprocess.Popen([UNDERSTUDY, "serve", str(self.bench), "--speed", speed, "--control",
                                         self.control, "--record", self.recording], stdout=subprocess.DEVNULL)
        end = time.monotonic() + PATIENCE
        while not os.path.exists(self.control) and time.monotonic() < end:
            time.sleep(0.01)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()
        self.folder.cleanup()

    def end(self):
        """Ends it; its files stay."""
        self.process.terminate()
        assert self.process.wait(PATIENCE) == 0

    def ctl(self, *words):
        return subprocess.run([UNDERSTUDY, "ctl", "--control", self.control, *words], check=True,
                              stdout=subprocess.PIPE).stdout.decode()


# For each language: a program whose line `call` calls a routine, and goes on at `behind`. A step into the routine is at
# the first line of `routine`, the next one at the second: what takes no time is over in the tick of the line before.
# Then what starts it in the debug console; the name of its thread, and of a value that it has set when it is there.
LANGUAGES = {
    "simple2-r3": {"ending": ".lst", "start": "PROG_MAIN_RunTime_START = 0", "call": 2, "behind": 3, "thread": "m",
                   "value": ("VAR32", "7"),
                   "program": "        VAR_Direct VAR32 7\n        Delay_mSec 5\n        Delay_mSec 6\n        END\n"},
    "rs-m8194h": {"ending": ".mac", "start": "CALL_MPn = 41", "call": 4, "routine": (9, 10), "behind": 5,
                  "thread": "m", "value": ("VAR1", "7"),
                  "program": "MP 41\n  RSM_MACRO_SET_VAR VAR1 7\n  RSM_MACRO_TIMER 5\n  RSM_MACRO_MP_CALL 2\n"
                             "  RSM_MACRO_TIMER 5\nEND\n"
                             "MP 2\n  RSM_MACRO_TIMER 5\n  RSM_MACRO_TIMER 6\n  RSM_MACRO_TIMER 7\nEND\n"},
    "super-40nc": {"ending": ".40nc.lst", "start": "M8000 = 1", "call": 4, "routine": (7, 9), "behind": 5,
                   "thread": "m C", "value": ("D0", "7"),
                   "program": "AREA C\nMOV K7 D0\nTMR K20\nCAL K100 K1\nTMR K30\nEND\nLAB K100\nTMR K20\nTMR K30\n"
                              "RET\nAREA PLC\nEND\n"},
    "slim": {"ending": ".slim", "start": "command G", "call": 3, "routine": (6, 7), "behind": 4, "thread": "m",
             "value": ("N1", "7"), "program": "N1=7\nWT 5\nCALL 5\nWT 6\nRET\n$5 WT 7\nWT 8\nRET\n"},
}


def scopes_of(adapter, frame):
    """Returns the references of all scopes by their names, after a look at each of their variables."""
    scopes = adapter.ask("scopes", frameId=frame)["scopes"]
    assert [scope["name"] for scope in scopes[:4]] == ["State", "Program", "Axes", "Terminals"], scopes
    for scope in scopes:
        assert scope["variablesReference"] > 0, scope
        for variable in adapter.ask("variables", variablesReference=scope["variablesReference"],
                                    start=0, count=20)["variables"]:
            assert isinstance(variable["name"], str) and isinstance(variable["value"], str), variable
            assert isinstance(variable["variablesReference"], int), variable
    return {scope["name"]: scope["variablesReference"] for scope in scopes}


def values_of(adapter, reference):
    return {one["name"]: one["value"]
            for one in adapter.ask("variables", variablesReference=reference)["variables"]}


def case_language(model):
    language = LANGUAGES[model]
    with Served(model, language["ending"], language["program"]) as served, Adapter() as adapter:
        set_ones = adapter.begin("attach", control=served.control, path=str(served.program),
                                 breakpoints=[{"line": language["call"]}, {"line": 900}])["breakpoints"]
        assert set_ones[0]["verified"] and set_ones[0]["line"] == language["call"], set_ones
        assert not set_ones[1]["verified"] and "line 900" in set_ones[1]["message"], set_ones
        assert adapter.event("stopped")["reason"] == "entry"
        assert adapter.ask("threads")["threads"], "there is a thread before the program runs"
        assert adapter.ask("evaluate", expression=language["start"], context="repl")["result"]
        # Attached to a bench in manual time: `continue` moves it.
        assert adapter.ask("continue", threadId=1)["allThreadsContinued"]
        stopped = adapter.event("stopped")
        assert stopped["reason"] == "breakpoint" and stopped["hitBreakpointIds"] == [set_ones[0]["id"]], stopped
        number = stopped["threadId"]
        names = {one["id"]: one["name"] for one in adapter.ask("threads")["threads"]}
        assert names[number] == language["thread"], (number, names)

        def frames(thread):
            stack = adapter.ask("stackTrace", threadId=thread, startFrame=0, levels=20)
            assert stack["totalFrames"] == len(stack["stackFrames"]), stack
            for frame in stack["stackFrames"]:
                assert frame["source"]["path"] == str(served.program), frame
            return stack["stackFrames"]

        top = frames(number)[0]
        assert top["line"] == language["call"], top
        references = scopes_of(adapter, top["id"])
        name, value = language["value"]
        known = values_of(adapter, references["Program"])
        assert known.get(name) == value, known
        assert adapter.ask("evaluate", expression=name, frameId=top["id"], context="hover")["result"] == value
        assert adapter.ask("setVariable", variablesReference=references["Program"], name=name,
                           value="4 + 1")["value"] == "5"
        assert adapter.ask("evaluate", expression="1 + 2", frameId=top["id"], context="watch")["result"] == "3"
        assert "column" in adapter.refused("evaluate", expression="1 +", frameId=top["id"])
        assert adapter.ask("completions", text=name[:1], column=2, frameId=top["id"])["targets"]
        routine = language.get("routine")
        adapter.ask("stepIn", threadId=number)
        stopped = adapter.event("stopped")
        assert stopped["reason"] == "step", stopped
        number = stopped["threadId"]
        if routine is not None:
            assert [one["line"] for one in frames(number)][0] == routine[0], frames(number)
            assert len(frames(number)) == 2, frames(number)
            adapter.ask("next", threadId=number)
            assert adapter.event("stopped")["reason"] == "step"
            assert frames(number)[0]["line"] == routine[1], frames(number)
            adapter.ask("stepOut", threadId=number)
            stopped = adapter.event("stopped")
            assert stopped["reason"] == "step", stopped
        assert frames(stopped["threadId"])[0]["line"] == language["behind"], frames(stopped["threadId"])
        assert not adapter.events, adapter.events
        adapter.ask("stepOut", threadId=number)
        stopped = adapter.event("stopped")
        assert "no routine is running" in stopped["text"], stopped
        adapter.ask("disconnect")
        assert served.ctl("break") == "", "its breakpoints are gone"


def where_stopped(adapter, thread):
    """Returns the time and the frames of a thread."""
    frames = adapter.ask("stackTrace", threadId=thread)["stackFrames"]
    time_now = adapter.ask("evaluate", expression="time")["result"]
    return time_now, [frame["line"] for frame in frames]


def case_recording(model):
    """Steps to and fro in the recording of a program, and goes from stop to stop."""
    language = LANGUAGES[model]
    with Served(model, language["ending"], language["program"]) as served, Adapter() as adapter:
        start = language["start"]
        served.ctl(*(start.split(" ", 1) if start.startswith("command") else ("set", start.replace(" ", ""))))
        served.ctl("advance", "2s")
        served.end()
        set_ones = adapter.begin("launch", recording=served.recording, path=str(served.program),
                                 breakpoints=[{"line": language["call"]}])["breakpoints"]
        assert set_ones[0]["verified"], set_ones
        assert adapter.event("stopped")["reason"] == "entry"
        lines = adapter.ask("breakpointLocations", source={"path": str(served.program)}, line=1, endLine=99)
        assert {"line": language["call"]} in lines["breakpoints"], lines

        def stop_after(request, **arguments):
            adapter.ask(request, **arguments)
            stopped = adapter.event("stopped")
            return stopped, where_stopped(adapter, stopped["threadId"])

        stopped, at_breakpoint = stop_after("continue", threadId=1)
        thread = stopped["threadId"]
        assert stopped["reason"] == "breakpoint" and at_breakpoint[1][0] == language["call"], (stopped, at_breakpoint)
        assert adapter.ask("stackTrace", threadId=thread)["stackFrames"][0]["source"]["path"] == str(served.program)
        forward = [at_breakpoint] + [stop_after("stepIn", threadId=thread)[1] for _ in range(3)]
        assert len({time for time, _ in forward}) == 4, forward
        back = [forward[-1]] + [stop_after("stepBack", threadId=thread)[1] for _ in range(3)]
        assert back == forward[::-1], (forward, back)
        assert [stop_after("stepIn", threadId=thread)[1] for _ in range(3)] == forward[1:]
        assert stop_after("reverseContinue", threadId=thread)[1] == at_breakpoint
        stopped, begin = stop_after("reverseContinue", threadId=thread)
        assert stopped["reason"] == "pause" and "begins here" in stopped["text"] and begin[0].startswith("0"), stopped
        assert stop_after("continue", threadId=thread)[1] == at_breakpoint
        stopped, _ = stop_after("continue", threadId=thread)
        assert "ends here" in stopped["text"], stopped
        assert "cannot be changed" in adapter.refused("setExpression", expression=language["value"][0], value="5")
        adapter.ask("restart")
        assert adapter.event("stopped")["reason"] == "entry"
        adapter.ask("disconnect")


def goes_back(model):
    """Steps to and fro on a running bench, and looks at instructions by their addresses."""
    language = LANGUAGES[model]
    with Served(model, language["ending"], language["program"]) as served, Adapter() as adapter:
        served.end()  # the adapter starts its own
        adapter.begin("launch", bench=str(served.bench), path=str(served.program),
                      breakpoints=[{"line": language["call"]}])
        assert adapter.event("stopped")["reason"] == "entry"
        adapter.ask("stepBack", threadId=1)
        assert "nothing has happened" in adapter.event("stopped")["text"]
        adapter.ask("evaluate", expression=language["start"], context="repl")

        def stop_after(request, **arguments):
            adapter.ask(request, **arguments)
            stopped = adapter.event("stopped")
            return stopped, where_stopped(adapter, stopped["threadId"])

        stopped, at_breakpoint = stop_after("continue", threadId=1)
        thread = stopped["threadId"]
        forward = [at_breakpoint] + [stop_after("stepIn", threadId=thread)[1] for _ in range(3)]
        assert len({time for time, _ in forward}) == 4, forward
        back = [forward[-1]] + [stop_after("stepBack", threadId=thread)[1] for _ in range(3)]
        assert back == forward[::-1], (forward, back)
        assert [stop_after("stepIn", threadId=thread)[1] for _ in range(3)] == forward[1:]
        assert stop_after("reverseContinue", threadId=thread)[1] == at_breakpoint
        stopped, begin = stop_after("reverseContinue", threadId=thread)
        assert "debugging began here" in stopped["text"] and begin[0].startswith("0"), (stopped, begin)
        # The program was started at that moment, so it starts again.
        stopped, again = stop_after("continue", threadId=thread)
        assert again == at_breakpoint, (stopped, again)

        here = adapter.ask("stackTrace", threadId=thread)["stackFrames"][0]["instructionPointerReference"]
        around = adapter.ask("disassemble", memoryReference=here, instructionOffset=-1, instructionCount=3)
        before, at, after = around["instructions"]
        assert at["address"] == here and at["line"] == language["call"], around
        assert before["line"] < at["line"] < after["line"] and before["instruction"], around
        assert ("instructionBytes" in at) == (model in ("simple2-r3", "rs-m8194h")), at
        far = adapter.ask("disassemble", memoryReference=here, instructionOffset=1000, instructionCount=2)
        assert [one["presentationHint"] for one in far["instructions"]] == ["invalid"] * 2, far
        assert "not an address" in adapter.refused("disassemble", memoryReference="0x5", instructionCount=1)
        adapter.ask("setBreakpoints", source={"path": str(served.program)}, breakpoints=[])
        behind = next(one["address"] for one in adapter.ask("disassemble", memoryReference=here,
                                                            instructionOffset=0, instructionCount=20)["instructions"]
                      if one.get("line") == language["behind"])
        set_one = adapter.ask("setInstructionBreakpoints", breakpoints=[{"instructionReference": behind}])
        assert set_one["breakpoints"][0]["verified"], set_one
        stopped, there = stop_after("continue", threadId=thread)
        assert stopped["reason"] == "instruction breakpoint" and there[1][0] == language["behind"], (stopped, there)
        adapter.ask("disconnect")


def case_back():
    for model in LANGUAGES:
        goes_back(model)


def case_scenario():
    with tempfile.TemporaryDirectory() as folder, Adapter() as adapter:
        _, path = counting_bench(folder)
        scenario = failing_scenario(folder)
        assert "none.yaml" in adapter_refusal("scenario", "/none.yaml")
        adapter.begin("launch", scenario=scenario, path=path, breakpoints=[{"line": 1}])
        adapter.event("stopped")
        counted = []
        for request in ("continue", "continue", "continue", "reverseContinue", "reverseContinue"):
            adapter.ask(request, threadId=1)
            stopped = adapter.event("stopped")
            assert stopped["reason"] == "breakpoint", (request, stopped)
            counted.append(adapter.ask("evaluate", expression="PROG_VAR0")["result"])
        assert counted == ["1", "2", "3", "2", "1"], counted
        adapter.ask("disconnect")
    with tempfile.TemporaryDirectory() as folder, Adapter() as adapter:
        _, path = counting_bench(folder)
        scenario = failing_scenario(folder)
        adapter.begin("launch", stop_on_entry=False, scenario=scenario, path=path, breakpoints=[{"line": 1}])
        stopped = adapter.event("stopped")
        assert stopped["reason"] == "exception" and "1000" in stopped["text"], stopped
        at_failure = adapter.ask("evaluate", expression="PROG_VAR0")["result"]
        adapter.ask("reverseContinue", threadId=1)
        assert adapter.event("stopped")["reason"] == "breakpoint"
        assert adapter.ask("evaluate", expression="PROG_VAR0")["result"] == at_failure
        adapter.ask("reverseContinue", threadId=1)
        assert adapter.event("stopped")["reason"] == "breakpoint"
        assert int(adapter.ask("evaluate", expression="PROG_VAR0")["result"]) == int(at_failure) - 1
        adapter.ask("disconnect")


def failing_scenario(folder):
    scenario = pathlib.Path(folder, "fails.scenario.yaml")
    scenario.write_text("understudy: 1\nname: fails\nbench: bench.yaml\nsteps:\n  - advance: 300ms\n"
                        "  - expect: { m.PROG_VAR0: 1000 }\n")
    return str(scenario)


def adapter_refusal(key, value):
    with Adapter() as adapter:
        adapter.ask("initialize", adapterID="understudy")
        return adapter.refused("launch", **{key: value})


COUNTING = "again:  VAR_Inc VAR32\n        Delay_mSec 5\n        Jump again\n        END\n"


def counting_bench(folder):
    """Writes a bench whose program counts, and returns its path and that of the program."""
    path = pathlib.Path(folder, "count.lst")
    path.write_text(COUNTING)
    bench = pathlib.Path(folder, "bench.yaml")
    bench.write_text("understudy: 1\nlines:\n  a: { stations: [ { name: m, model: simple2-r3, program: count.lst,"
                     " set: { AutoStart_MainProg: 1 } } ] }\n")
    return str(bench), str(path)


def case_launch():
    with tempfile.TemporaryDirectory() as folder, Adapter() as adapter:
        bench, path = counting_bench(folder)
        set_ones = adapter.begin("launch", bench=bench, path=path,
                                 breakpoints=[{"line": 2, "condition": "PROG_VAR0 == 3"},
                                              {"line": 3, "logMessage": "now {PROG_VAR0}"},
                                              {"line": 3, "hitCondition": "often"},
                                              {"line": 3, "condition": "NOTHING > 1"},
                                              {"line": 0}])["breakpoints"]
        assert [one["verified"] for one in set_ones] == [True, True, False, False, True], set_ones
        assert set_ones[4]["line"] == 1 and "moved to line 1" in set_ones[4]["message"], set_ones
        adapter.ask("setBreakpoints", source={"path": path}, breakpoints=[
            {"line": 2, "condition": "PROG_VAR0 == 3"}, {"line": 3, "logMessage": "now {PROG_VAR0}"}])
        assert adapter.event("output")["output"].startswith("a "), "it says where hosts find the line"
        assert adapter.event("stopped")["reason"] == "entry"
        adapter.ask("continue", threadId=1)
        assert [adapter.event("output")["output"] for _ in range(2)] == ["now 1\n", "now 2\n"]
        stopped = adapter.event("stopped")
        assert stopped["reason"] == "breakpoint", stopped
        thread = stopped["threadId"]
        frame = adapter.ask("stackTrace", threadId=thread)["stackFrames"][0]["id"]
        assert adapter.ask("evaluate", expression="VAR32", frameId=frame, context="hover")["result"] == "3"
        assert adapter.ask("setExpression", expression="VAR32", value="40 + 2", frameId=frame)["value"] == "42"
        assert "out of range" in adapter.refused("setExpression", expression="VAR32", value="1000000000000")
        references = scopes_of(adapter, frame)
        assert adapter.ask("setVariable", variablesReference=references["Terminals"], name="DIN_5",
                           value="1")["value"] == "1"
        status = adapter.ask("variables", variablesReference=references["status"])["variables"][0]
        assert status["name"] == "STATUS" and status["type"] == "u16", status
        assert "A_ready" in values_of(adapter, status["variablesReference"]), "bits by name"
        info = adapter.ask("dataBreakpointInfo", name="VAR32", variablesReference=references["Program"])
        adapter.ask("setBreakpoints", source={"path": path}, breakpoints=[])
        assert adapter.ask("setDataBreakpoints", breakpoints=[{"dataId": info["dataId"]}])["breakpoints"][0]["verified"]
        adapter.ask("continue", threadId=thread)
        stopped = adapter.event("stopped")
        assert stopped["reason"] == "data breakpoint" and "the device changes it to 43" in stopped["text"], stopped
        adapter.ask("setDataBreakpoints", breakpoints=[])
        adapter.ask("continue", threadId=thread)
        assert adapter.refused("next", threadId=thread).startswith("next: the bench is running"), "or it has stopped"
        adapter.ask("pause", threadId=thread)
        assert adapter.event("stopped")["reason"] == "pause"
        adapter.ask("restart")
        assert adapter.event("stopped")["reason"] == "entry"
        assert adapter.ask("evaluate", expression="PROG_VAR0")["result"] == "0"
        adapter.ask("terminate")
        adapter.event("terminated")
        assert "expected `disconnect`" in adapter.refused("threads")
        adapter.ask("disconnect", terminateDebuggee=True)


def case_real_time():
    """A launched bench in real time begins when it is configured. A breakpoint stops it; others may go on with it."""
    with tempfile.TemporaryDirectory() as folder, Adapter() as adapter:
        bench, path = counting_bench(folder)
        control = folder + "/control"
        served = subprocess.Popen([UNDERSTUDY, "serve", bench, "--control", control], stdout=subprocess.DEVNULL)
        end = time.monotonic() + PATIENCE
        while not os.path.exists(control) and time.monotonic() < end:
            time.sleep(0.01)
        adapter.begin("attach", stop_on_entry=False, control=control, path=path, breakpoints=[{"line": 2}])
        assert adapter.event("stopped")["reason"] == "breakpoint"

        def ctl(*words):
            return subprocess.run([UNDERSTUDY, "ctl", "--control", control, *words], check=True,
                                  stdout=subprocess.PIPE).stdout.decode()
        ctl("break", "delete", "all")
        ctl("resume")
        adapter.event("continued")
        adapter.ask("pause", threadId=1)
        assert adapter.event("stopped")["reason"] == "pause"
        adapter.ask("disconnect")
        before = json.loads(ctl("--json", "status"))["status"]
        assert not before.get("paused"), "time goes on as it did"
        served.terminate()
        served.wait(PATIENCE)


def case_bad():
    with Adapter() as adapter:
        assert "initialize" in adapter.refused("launch", model="simple2-r3")
        assert adapter.refused("initialize", pathFormat="uri")
        adapter.ask("initialize", adapterID="understudy")
        assert adapter.refused("initialize")
        assert adapter.refused("threads") == "threads: no bench has been launched; expected `launch` or `attach` first"
        assert adapter.refused("launch") == "launch: expected one of bench, model, recording and scenario"
        assert "none.yaml" in adapter.refused("launch", bench="/none.yaml")
        assert "simple3" in adapter.refused("launch", model="simple3")
        assert "--nothing" in adapter.refused("launch", model="slim", args=["--nothing"])
        assert adapter.refused("launch", model="slim", args="--nothing")
        assert adapter.refused("launch", model="slim", stopOnEntry="yes")
        assert "/none/control" in adapter.refused("attach", control="/none/control")
        adapter.ask("launch", model="simple2-r3", stopOnEntry=True)
        adapter.event("initialized")
        assert "configurationDone" in adapter.refused("continue", threadId=1)
        assert "unknown" in adapter.refused("fly")
        adapter.ask("configurationDone")
        adapter.event("stopped")
        assert adapter.event("output")["output"].startswith("line "), "it says where hosts find the line"
        for text in (b"{", b"[]", b"7", b'{"type":"request"}', b'{"seq":"x","type":"request","command":"threads"}',
                     b'{"seq":1,"arguments":' + b"[" * 100000, b'{"seq":1,"a":' + b"[" * 500 + b"]" * 500 + b"}"):
            adapter.raw(b"Content-Length: %d\r\n\r\n" % len(text) + text)
            assert "not a request" in adapter.event("output")["output"]
        for command, arguments in (("stackTrace", {}), ("stackTrace", {"threadId": 99}), ("stackTrace", {"threadId": 1e30}),
                                   ("scopes", {"frameId": -5}), ("scopes", {"frameId": 2**62}),
                                   ("variables", {"variablesReference": 77}), ("variables", {}),
                                   ("variables", {"variablesReference": 1_000_000_005}), ("source", {}),
                                   ("source", {"sourceReference": 9}), ("source", {"source": 5}),
                                   ("setBreakpoints", {}), ("setBreakpoints", {"source": 5}),
                                   ("setBreakpoints", {"source": {}}),
                                   ("setBreakpoints", {"source": {"path": "a"}, "breakpoints": 5}),
                                   ("evaluate", {"expression": 7}), ("evaluate", {"expression": ""}),
                                   ("evaluate", {"expression": "command FLY", "context": "repl"}),
                                   ("evaluate", {"expression": "NOTHING = 7", "context": "repl"}),
                                   ("completions", {"text": "a"}), ("next", {}), ("next", {"threadId": "1"}),
                                   ("setVariable", {"variablesReference": 0, "name": "a", "value": "1"}),
                                   ("setExpression", {"expression": "STATUS", "value": "NOTHING"}),
                                   ("setExceptionBreakpoints", {"filters": [7]}),
                                   ("setDataBreakpoints", {}), ("attach", {}), ("launch", {})):
            assert adapter.refused(command, **arguments), command
        nobody = adapter.ask("setBreakpoints", source={"path": "/none.lst"}, breakpoints=[{"line": 1}, {}, 7])
        assert [one["verified"] for one in nobody["breakpoints"]] == [False] * 3, nobody
        assert "no device runs none.lst" in nobody["breakpoints"][0]["message"], nobody
        events = adapter.ask("setExceptionBreakpoints", filters=["limit", "nothing"],
                             filterOptions=[{"filterId": "alarm", "condition": "time > 3"}])["breakpoints"]
        assert [one["verified"] for one in events] == [True, False, False], events
        for _ in range(300):  # a flood, in halves
            adapter.sent += 1
            text = json.dumps({"seq": adapter.sent, "type": "request", "command": "threads"}).encode()
            adapter.raw(b"Content-Length: %d\r\n" % len(text))
            adapter.raw(b"\r\n" + text)
        while adapter.receive()["request_seq"] != adapter.sent:
            pass
        adapter.ask("disconnect")


# What is not the protocol, and a part of what is said of it. The adapter ends with 2.
NOT_FRAMES = ((b"Content-Length: many\r\n\r\n", "'many' is not a length"),
              (b"Content-Length: 99999999999999999999\r\n\r\n", "is not a length"),
              (b"Content-Length: 5000000\r\n\r\n", "expected 0 to 4194304"),
              (b"Content-Length: -1\r\n\r\n", "is not a length"),
              (b"Length: 5\r\n\r\nhello", "has no Content-Length"),
              (b"x" * 2000, "has no end"))


def case_framing():
    for data, says in NOT_FRAMES:
        process = subprocess.run([UNDERSTUDY, "dap"], input=data, capture_output=True, timeout=PATIENCE)
        assert process.returncode == 2 and says in process.stderr.decode(), (data, process)
        assert process.stderr.count(b"\n") == 1, process.stderr
        body = json.loads(process.stdout.split(b"\r\n\r\n", 1)[1])
        assert body["event"] == "output" and says in body["body"]["output"], body
    for data in (b"Content-Length: 10\r\n\r\n{", b"Content-Len"):
        process = subprocess.run([UNDERSTUDY, "dap"], input=data, capture_output=True, timeout=PATIENCE)
        assert process.returncode == 2 and b"in the middle of a message" in process.stderr, (data, process)
    process = subprocess.run([UNDERSTUDY, "dap"], input=b"", capture_output=True, timeout=PATIENCE)
    assert process.returncode == 0 and not process.stderr, process


def case_listen():
    server = subprocess.Popen([UNDERSTUDY, "dap", "--listen", "127.0.0.1:0"], stdout=subprocess.PIPE)
    port = int(server.stdout.readline().rsplit(b":", 1)[1])

    def connect():
        stream = socket.create_connection(("127.0.0.1", port), PATIENCE).makefile("rwb")
        return Client(stream, stream)

    first = connect()
    first.ask("initialize", adapterID="understudy")
    second = connect()
    assert "another client is connected" in second.refused("initialize", adapterID="understudy")
    assert second.receive() is None
    first.ask("launch", model="slim", stopOnEntry=True)
    first.ask("disconnect")
    while first.receive() is not None:
        pass
    end = time.monotonic() + PATIENCE
    while True:  # it may not have ended yet
        answer = connect().ask_all("initialize", {"adapterID": "understudy"})
        if answer["success"]:
            break
        assert time.monotonic() < end, answer
        time.sleep(0.01)
    server.terminate()
    assert server.wait(PATIENCE) == 0


if sys.argv[2] in LANGUAGES:
    case_language(sys.argv[2])
    case_recording(sys.argv[2])
else:
    globals()["case_" + sys.argv[2]]()
