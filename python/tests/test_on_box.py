"""Tests the client and the plugin with a controller at a port: a served bench plays the controller."""
import os
import signal
import subprocess
import sys
import textwrap
import time

import pytest

import understudy

pytest_plugins = ["pytester"]


@pytest.fixture
def box():
    with understudy.start(model="simple2-r3", speed="real") as served:
        yield served


def on(box, **more):
    return understudy.Bench(on={"line": box.port}, model="simple2-r3", **more)


def test_reads_need_no_permission(box):
    with on(box) as real:
        assert real["HW_Code"] == 0xC001
        assert real.get("HW_Code", "device.Cord_A") == {"HW_Code": 0xC001, "device.Cord_A": 0}
        assert real.eval("device.STATUS.4 == 0") == 1
        assert real.port == box.port


def test_what_is_not_allowed_is_not_sent(box):
    with on(box) as real:
        with pytest.raises(understudy.NotTellable, match="it is sent only with --allow-writes"):
            real["Aaxis_Pulse"] = 60
    with on(box, allow="writes") as real:
        real["Aaxis_Pulse"] = 60
        assert box["Aaxis_Pulse"] == 60
        with pytest.raises(understudy.NotTellable, match="move an axis; it is sent only with --allow-motion"):
            real["Aaxis_Move_INC"] = 1


def test_a_move_is_waited_for(box, capfd):
    with on(box, allow="motion") as real:
        real.set({"Aaxis_SVON": 1, "Aaxis_Pulse": 800, "Aaxis_Speed": 60, "Aaxis_AccTime": 1, "Aaxis_Move_INC": 1})
        assert real.run_until("device.STATUS.4 == 0", within="5s")
        assert real["Cord_A"] == 800
        assert not real.run_until("device.Cord_A == 1", within="20ms")
        before = real.advance("0ms")
        assert real.advance("30ms") >= before + 30_000_000
    assert "stop: device: ALL_STOP = 1: done" in capfd.readouterr().err


def test_a_refusal_is_told(box):
    with on(box, allow="motion") as real:
        with pytest.raises(understudy.Refused, match="Nothing"):
            real.get("Nothing")
        with pytest.raises(understudy.Refused):
            real["Aaxis_Pulse"] = "fast"
        with pytest.raises(understudy.NotTellable, match="needs a rig or a person"):
            real.input({"device.DIN_2": "on"})
        with pytest.raises(understudy.NotTellable, match="'snapshot' needs the internal state"):
            real.snapshot("a")


def test_nothing_answers(tmp_path):
    with pytest.raises(understudy.NotThere, match="expected a serial port"):
        understudy.Bench(on=f"line={tmp_path / 'none'}", model="simple2-r3")
    with pytest.raises(understudy.BadSetup, match="line"):
        understudy.Bench(on="no-port", model="simple2-r3")


def test_a_killed_client_leaves_nothing_behind(box):
    program = textwrap.dedent(f"""
        import understudy, os, signal
        real = understudy.Bench(on="line={box.port}", model="simple2-r3", allow="motion")
        real.set({{"Aaxis_SVON": 1, "Aaxis_Pulse": 800000, "Aaxis_Speed": 60, "Aaxis_Move_INC": 1}})
        os.kill(os.getpid(), signal.SIGKILL)
    """)
    killed = subprocess.run([sys.executable, "-c", program], check=False)
    assert killed.returncode == -signal.SIGKILL
    end = time.monotonic() + 10
    while box["STATUS"] & 16:
        assert time.monotonic() < end, "the stop goes out when the client is gone"
        time.sleep(0.02)
    assert 0 < box["Cord_A"] < 800000


SUITE = """
import pytest
def test_reads(bench):
    assert bench["HW_Code"] == 0xC001
def test_moves(bench):
    bench.set({"Aaxis_SVON": 1, "Aaxis_Pulse": 80, "Aaxis_Speed": 60, "Aaxis_Move_INC": 1})
    assert bench.run_until("device.STATUS.4 == 0", within="5s")
def test_goes_back(bench):
    bench.snapshot("a")
def test_fails(bench):
    assert bench["HW_Code"] == 1
def test_host(run_host, tmp_path):
    run_host(tmp_path / "none", ["true"])
"""


def test_the_plugin_asks_a_real_controller(pytester, box):
    pytester.makepyfile(SUITE)
    pytest_on = ["-p", "understudy.pytest_plugin", "-rs", f"--understudy-on=line={box.port}"]
    reads = pytester.runpytest_subprocess(*pytest_on)
    reads.assert_outcomes(passed=1, skipped=3, failed=1)
    reads.stdout.fnmatch_lines(["*it is sent only with --allow-*", "*'snapshot' needs the internal state*"])
    moves = pytester.runpytest_subprocess(*pytest_on, "--understudy-allow=motion")
    moves.assert_outcomes(passed=2, skipped=2, failed=1)
    assert os.path.exists(box.port)
