"""The client against the program, UNDERSTUDY_PROGRAM."""
import glob
import os
import signal
import subprocess
import sys
import threading
import time

import pytest
import understudy

MOVE = {"Aaxis_SVON": 1, "Aaxis_Pulse": 1000, "Aaxis_Speed": 60, "Aaxis_AccTime": 1, "Aaxis_DecTime": 1}


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
    end = time.monotonic() + 10
    while (os.path.exists(port) or os.path.exists(folder)) and time.monotonic() < end:
        time.sleep(0.01)
    assert not os.path.lexists(port)
    assert not os.path.exists(folder)


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


def test_another_version_is_refused_and_ends(monkeypatch):
    monkeypatch.setattr("understudy.bench.KNOWN", (0, 1))
    before = set(glob.glob("/tmp/understudy-py-*"))
    with pytest.raises(understudy.WrongVersion, match="knows 0.1"):
        understudy.start(model="simple2-r3")
    assert set(glob.glob("/tmp/understudy-py-*")) <= before
