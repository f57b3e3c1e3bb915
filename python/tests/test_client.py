"""Tests the client with the program in UNDERSTUDY_PROGRAM."""
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import pytest
import understudy

from leavings import gone, mentioned

MOVE = {"Aaxis_SVON": 1, "Aaxis_Pulse": 1000, "Aaxis_Speed": 60, "Aaxis_AccTime": 1, "Aaxis_DecTime": 1}


@pytest.fixture
def folders():
    """A longer path would not be accepted for the folders of benches."""
    made = tempfile.mkdtemp(prefix="client-")
    yield pathlib.Path(made)
    shutil.rmtree(made)


@pytest.fixture
def bench():
    with understudy.start(model="simple2-r3") as one:
        yield one


def test_a_move_in_simulated_time(bench):
    bench.set({**MOVE, "Aaxis_Move_INC": 1})
    assert bench.run_until("device.STATUS.4 == 0 && Cord_A == 1000", within="2s")
    assert bench["Cord_A"] == 1000
    assert not bench.run_until("Cord_A == 1001", within="10ms")


def test_lost_steps_are_lost(bench):
    assert bench.inject({"lost_steps": "A", "one_in": 50}) == 1
    bench.set({**MOVE, "Aaxis_Move_INC": 1})
    bench.advance("1s")
    assert bench.eval("Cord_A - A.position") == 20
    assert [fault["number"] for fault in bench.faults()] == [1]
    bench.clear(1)
    assert bench.faults() == []


def test_a_snapshot_comes_back(bench):
    bench.advance("3ms")
    bench.snapshot("then")
    bench["Aaxis_Pulse"] = 77
    bench.restore("then")
    assert bench["Aaxis_Pulse"] != 77


def test_refusals_have_the_programs_words(bench):
    with pytest.raises(understudy.Refused, match="Cord_Q"):
        bench.get("Cord_Q")
    bench.power("off")
    with pytest.raises(understudy.Refused, match="power"):
        bench.get("Cord_A")
    with pytest.raises(understudy.NotThere, match="nosuch"):
        understudy.start("nosuch.yaml")


def test_a_daemon_that_never_answers_is_given_up(tmp_path):
    path = str(tmp_path / "silent")
    with socket.socket(socket.AF_UNIX) as silent:
        silent.bind(path)
        silent.listen()
        begin = time.monotonic()
        with pytest.raises(understudy.NotThere, match="timed out"):
            understudy.Bench(path, timeout_s=0.3)
        assert 0.25 < time.monotonic() - begin < 10


def test_a_second_client_attaches(bench):
    with understudy.attach(bench.control) as other:
        other["Aaxis_Pulse"] = 5
    assert bench["Aaxis_Pulse"] == 5
    assert os.path.exists(bench.port)


def test_it_ends_when_its_parent_is_killed():
    code = ("import understudy, time\nb = understudy.start(model='simple2-r3')\n"
            "print(b._daemon.folder, b.port, flush=True)\ntime.sleep(60)")
    parent = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    folder, port = parent.stdout.readline().split()
    assert os.path.exists(port)
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    parent.stdout.close()
    gone(lambda: os.path.lexists(port) or os.path.exists(folder))


def test_it_outlives_the_thread_that_started_it():
    started = []
    thread = threading.Thread(target=lambda: started.append(understudy.start(model="simple2-r3")))
    thread.start()
    thread.join()
    time.sleep(0.1)
    with started[0] as bench:
        assert bench.advance("1ms") == 1_000_000


def test_a_control_loop_in_lockstep(bench):
    bench.set({**MOVE, "Aaxis_Move_INC": 1})
    times = []
    for now in bench.lockstep("1ms", 50):
        times.append(now)
        if now == 20_000_000:
            assert bench["Cord_A"] > 0
    assert times == [1_000_000 * step for step in range(50)]


def test_a_snapshot_in_a_file_comes_back(bench, tmp_path):
    bench["Aaxis_Pulse"] = 4
    bench.save(str(tmp_path / "then.json"))
    bench["Aaxis_Pulse"] = 77
    bench.load(str(tmp_path / "then.json"))
    assert bench["Aaxis_Pulse"] == 4


def test_a_recording_is_whole_at_the_end(tmp_path):
    recording = tmp_path / "day.rec"
    with understudy.start(model="simple2-r3", record=str(recording)) as one:
        one["Aaxis_Pulse"] = 9
        one.advance("5ms")
    program = os.environ.get("UNDERSTUDY_PROGRAM", "understudy")
    subprocess.run([program, "replay", str(recording)], check=True, capture_output=True, timeout=20)


@pytest.mark.parametrize("needed", [(0, 0), (0, 9), (1, 5), (2, 0)])
def test_another_protocol_is_refused_and_ends(monkeypatch, folders, needed):
    monkeypatch.setattr("understudy.bench.NEEDED", needed)
    monkeypatch.setattr("tempfile.tempdir", str(folders))
    with pytest.raises(understudy.WrongVersion, match=rf"speaks protocol 1\.4 .* needs {needed[0]}\.{needed[1]},"):
        understudy.start(model="simple2-r3")
    assert list(folders.iterdir()) == []


class Answering:
    """Replaces the connection to another version of the program: it answers only `identify`."""

    def __init__(self, **versions):
        self.versions, self.is_closed = versions, False

    def ask(self, do):
        assert do == "identify"
        return {"daemon": {**self.versions, "lines": []}}

    def close(self):
        self.is_closed = True


@pytest.mark.parametrize("protocol, is_understood", [("1.0", True), ("1.1", True), ("1.10", True), ("0.9", False),
                                                     ("2.0", False), ("10.0", False), (None, False)])
def test_the_protocol_counts_and_not_the_programs_version(monkeypatch, protocol, is_understood):
    spoken = f"protocol {protocol}" if protocol else "a protocol without a version"
    connection = Answering(version="7.5.3", **({"protocol": protocol} if protocol else {}))
    monkeypatch.setattr("understudy.bench.Connection", lambda *_: connection)
    if is_understood:
        assert understudy.attach("a.control").protocol == protocol
    else:
        with pytest.raises(understudy.WrongVersion, match=f"understudy 7.5.3 speaks {spoken} on"):
            understudy.attach("a.control")
    assert connection.is_closed != is_understood


def test_the_protocol_is_the_newest_of_the_documentations_table(bench):
    page = (pathlib.Path(__file__).parents[2] / "docs/control.md").read_text(encoding="utf-8")
    versions = re.findall(r"^\| (\d+\.\d+) \|", page.split("## Versions of the protocol")[1], re.MULTILINE)
    assert versions[0] == bench.protocol


def test_a_program_that_is_not_there(bench):
    with pytest.raises(understudy.NotThere, match="no such program"):
        understudy.start(model="simple2-r3", program="/nosuch/understudy")


def test_a_guard_that_was_killed_leaves_its_work_to_us():
    with understudy.start(model="simple2-r3") as one:
        folder, pid, port = one._daemon.folder, one._daemon.pid, one.port
        os.kill(one._daemon._guard.pid, signal.SIGKILL)
    gone(lambda: os.path.lexists(port) or os.path.exists(folder) or os.path.exists(f"/proc/{pid}"))


@pytest.mark.parametrize("after_ms", range(0, 30, 3))
def test_killed_while_it_starts_it_leaves_nothing(folders, after_ms):
    code = ("import understudy, tempfile, time\ntempfile.tempdir = " + repr(str(folders)) +
            "\nprint(flush=True)\nb = understudy.start(model='simple2-r3')\ntime.sleep(60)")
    parent = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    parent.stdout.readline()
    time.sleep(after_ms / 1000)
    parent.kill()
    parent.wait()
    parent.stdout.close()
    time.sleep(0.02)  # a shell that was just started makes its folder first
    gone(lambda: any(folders.iterdir()) or mentioned(str(folders)))


def test_a_forked_process_does_not_hold_it():
    code = ("import os, sys, time, understudy\nb = understudy.start(model='simple2-r3')\n"
            "print(b._daemon.folder, flush=True)\n"
            "if os.fork() == 0:\n  b.close()\n  time.sleep(60)\n"
            "b.advance('1ms')\nprint('still there', flush=True)\ntime.sleep(60)")
    parent = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, start_new_session=True)
    try:
        folder = parent.stdout.readline().strip()
        assert parent.stdout.readline() == "still there\n"
        parent.kill()
        gone(lambda: os.path.exists(folder))
    finally:
        os.killpg(parent.pid, signal.SIGKILL)  # the forked one
        parent.wait()
        parent.stdout.close()


def test_choices_and_firmware_of_a_model():
    with understudy.start(model="simple2-r3", firmware="1.40", choices={"station_0_request": "ignored"}) as one:
        assert one["Version"] == 140
        chosen = {row["id"]: row["chosen"] for row in one.choices()}
        assert chosen["station_0_request"] == "ignored"
    with pytest.raises(understudy.NotThere, match="nosuch"):
        understudy.start(model="simple2-r3", choices={"nosuch": "x"})
    with pytest.raises(ValueError, match="bench file has its own"):
        understudy.start("bench.yaml", choices={"a": "b"})


def test_an_oscilloscope_sees_a_move(bench):
    bench.set(MOVE)
    assert bench.scope("A.position", "Cord_A", when="Cord_A > 10", before="5ms", after="5ms")["state"] == "armed"
    bench["Aaxis_Move_INC"] = 1
    bench.advance("500ms")
    assert bench.scope()["state"] == "done"
    samples = bench.samples()
    assert samples["A.position"] == samples["Cord_A"]  # no step is lost
    assert len(samples["Cord_A"]) == 11
    assert samples["Cord_A"][5] > 10 >= samples["Cord_A"][4]
    bench.scope_off()
    assert bench.scope() is None


def test_what_is_looked_at(bench):
    assert bench.where()[0]["state"] == "stopped"
    assert [row["address"] for row in bench.registers(find="Aaxis_Speed")] == ["0x1002"]
    assert len(bench.registers()) > 200  # more than one message has
    assert bench.send(bytes.fromhex("010300010001"), checksum=True) == 1
    bench.advance("50ms")
    seen = bench.look("Cord_A", frames=0, events=0, status=True)
    assert seen["values"] == [0]
    assert [frame["text"] for frame in seen["frames"]] == ["read 0x0001 device.HW_Code", "device.HW_Code = 49153"]
    assert seen["status"]["devices"]


def answers(control):
    """A socket exists for a moment before the program listens on it."""
    try:
        understudy.attach(control).close()
    except understudy.NotThere:
        return False
    return True


def test_to_and_fro_in_a_recording(folders):
    recording, control = str(folders / "day.rec"), str(folders / "control")
    with understudy.start(model="simple2-r3", record=recording) as one:
        one.advance("5ms")
        one.power("off")
        one.advance("5ms")
    program = os.environ.get("UNDERSTUDY_PROGRAM", "understudy")
    replay = subprocess.Popen([program, "replay", recording, "--page", "--control", control], stdout=subprocess.DEVNULL)
    try:
        gone(lambda: not answers(control))
        with understudy.attach(control) as one:
            timeline = one.timeline()
            assert timeline["end_ns"] == 10_000_000
            assert [(mark["what"], mark["time_ns"]) for mark in timeline["marks"]] == [("power", 5_000_000)]
            assert one.seek(to_ns=7_000_000) == 7_000_000
            assert one.seek(by="tick", steps=-3) == 4_000_000
            assert one.eval("power") == 1
            assert one.curves("power", dots=2) == {"power": {"least": [1, 0], "greatest": [1, 1]}}
            off = [span for span in one.spans() if span["kind"] == "power"]
            assert [(span["begin_ns"], span["end_ns"]) for span in off] == [(5_000_000, 10_000_000)]
            one.what_if()
            one.power("off")
            one.advance("1ms")
            with pytest.raises(understudy.Refused):
                one.seek(to_ns=0)
            one.what_if(False)
            assert one.timeline()["at_ns"] == 4_000_000
            assert one.eval("power") == 1
    finally:
        replay.terminate()
        replay.wait()


def test_a_long_path_of_temporary_files_does_not_matter(monkeypatch, tmp_path):
    deep = tmp_path / ("x" * 100)
    deep.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(deep))
    with understudy.start(model="simple2-r3") as one:
        assert one.advance("1ms") == 1_000_000


def test_an_interrupted_request_spoils_no_other(bench):
    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(KeyboardInterrupt):
            while True:  # a request is in progress nearly always
                bench.run_until("Cord_A == 1", within="100s")
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    bench["Aaxis_Pulse"] = 77
    assert bench["Aaxis_Pulse"] == 77
    assert bench.status()["speed"] == "manual"


def test_what_is_closed_says_so(bench):
    bench.close()
    with pytest.raises(understudy.NotThere, match="'get': the connection has been closed"):
        bench.get("Cord_A")


def test_firmware_is_a_text():
    with pytest.raises(TypeError, match="firmware: expected a text such as '1.52', not 1.4"):
        understudy.start(model="simple2-r3", firmware=1.40)


def test_flags_may_be_numbers():
    with understudy.start(None, "--station", 7, model="simple2-r3", speed=2) as bench:
        assert bench.status()["speed"] == "2x"


def test_an_oscilloscope_that_is_off_has_nothing(bench):
    assert bench.samples() == {}


def test_lines_to_send_on_are_named():
    with understudy.start(model="super-40nc") as bench:
        with pytest.raises(understudy.Refused, match="'line' is missing; expected one of RS232, RS485"):
            bench.send(b"\0")
        with pytest.raises(understudy.Refused, match="'RS422' is unknown; expected one of RS232, RS485"):
            bench.send(b"\0", line="RS422")
        assert bench.send(bytes.fromhex("000100000001"), line="RS485", checksum=True) == 1


@pytest.mark.parametrize("values, says", [
    ({"Aaxis_Speed": "fast"}, "Aaxis_Speed: 'fast' is not a number; expected 0 to 32768"),
    ({"Aaxis_Speed": 3.5}, "Aaxis_Speed: 3.5 is not a whole number; expected 0 to 32768"),
    ({"Aaxis_Speed": [1, 3]}, "Aaxis_Speed: [1,3] is not a number; expected 0 to 32768"),
    ({"Aaxis_Speed": None}, "Aaxis_Speed: null is not a number; expected 0 to 32768"),
    ({"Aaxis_Speed": 1 << 70}, "Aaxis_Speed: 1.1805916207174113e+21 is not a whole number; expected 0 to 32768"),
    ({"Aaxis_Speed": 40000}, "Aaxis_Speed: 40000 is out of range; expected 0 to 32768"),
    ({"DOUT_ALL.3": "on"}, "DOUT_ALL.3: 'on' is not a number; expected 0 or 1"),
])
def test_values_that_are_refused_are_quoted(bench, values, says):
    with pytest.raises(understudy.Refused) as refused:
        bench.set(values)
    assert str(refused.value) == says


def test_bits_and_inputs_may_be_true(bench):
    bench.set({"Aaxis_SVON": True})
    assert bench["Aaxis_SVON"] == 1
    bench["Aaxis_SVON"] = False
    assert bench["Aaxis_SVON"] == 0
    bench.input({"DIN_10": True})
    bench.advance("1ms")
    assert bench["DIN_10"] == 1
    bench.inject({"stuck": "DIN_10", "level": False})
    bench.advance("1ms")
    assert bench["DIN_10"] == 0


class Number:
    """A number like numpy's, which JSON does not support."""

    def __init__(self, value):
        self.value = value

    def __index__(self):
        return self.value


def test_numbers_of_other_packages_are_numbers(bench):
    bench["Aaxis_Speed"] = Number(77)
    assert bench["Aaxis_Speed"] == 77
    with pytest.raises(TypeError, match="is neither a number nor a text"):
        bench["Aaxis_Speed"] = object()
    assert bench["Aaxis_Speed"] == 77


def test_bytes_to_send_may_be_numbers(bench):
    first = bench.send([1, 3, 0, 1, 0, 1], checksum=True)
    bench.advance("50ms")
    assert bench.frames()[0]["number"] == first
    for wrong in (5, [300], [1, "x"], None):
        with pytest.raises(TypeError, match="send: expected a text, bytes or a list of numbers from 0 to 255"):
            bench.send(wrong)


def test_a_path_is_no_program(bench, tmp_path):
    for path in ("pick.lst", str(tmp_path)):
        with pytest.raises(understudy.Refused, match=r"program\(\) takes the text itself, such as open\("):
            bench.program(path)
    with pytest.raises(understudy.Refused) as refused:
        bench.program("Nonsense 1")
    assert "takes the text" not in str(refused.value)


def test_a_program_is_debugged(bench):
    bench.program("again:  VAR_Inc VAR32\n        Delay_mSec 5\n        Jump again\n        END\n")
    number = bench.set_break(line=2, when="PROG_VAR0 == 3")["number"]
    bench.set({"PROG_MAIN_RunTime_START": 0})
    stop = bench.continue_(within="1s")
    assert stop["breakpoint"] == number and stop["line"] == 2
    assert bench.stack()[0]["frames"][0]["line"] == 2
    assert bench.source().splitlines()[1].split() == ["Delay_mSec", "5"]
    assert bench.variables()["program"] == {"device.PROG_VAR0": 3}
    assert bench.step_program("line")["line"] == 3
    assert [one["hits"] for one in bench.breaks()] == [1]
    bench.delete_break(number)
    assert bench.breaks() == [] and bench.go_on(within="50ms") is None
    bench.delete_break()
    with pytest.raises(understudy.Refused, match="no routine is running"):
        bench.step_program("out")


@pytest.mark.parametrize("asked, says", [
    ({"bench": "nosuch.yaml"}, "nosuch.yaml"),
    ({"model": "slimm"}, "slimm"),
    ({"model": "simple2-r3", "firmware": "9.99"}, "9.99"),
    ({"model": "simple2-r3", "speed": "fast"}, "--speed: 'fast' is unknown"),
    ({"model": "simple2-r3", "choices": {"nosuch": "x"}}, "nosuch"),
])
def test_what_cannot_be_started_so_is_a_bad_setup(asked, says):
    with pytest.raises(understudy.BadSetup) as error:
        understudy.start(asked.pop("bench", None), **asked)
    assert says in str(error.value)
    assert "understudy-py-" not in str(error.value)  # a folder that is gone by now
    assert isinstance(error.value, understudy.NotThere)
