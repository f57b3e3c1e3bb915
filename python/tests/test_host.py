"""Tests host programs in simulated time, run by the client's exec."""
import ast
import sys
import time

import pytest
import understudy

BENCH = "understudy: 1\nlines: { line: { stations: [ { name: feeder, model: simple2-r3, address: 1 } ] } }\n"
HOST = """
import os, time
began = time.monotonic()
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
time.sleep(600)
print(time.monotonic() - began, os.environ.get("COLOUR"))
"""


@pytest.fixture
def bench(tmp_path):
    file = tmp_path / "bench.yaml"
    file.write_text(BENCH)
    return str(file)


def test_a_host_sleeps_in_simulated_time(bench):
    result = understudy.exec(bench, [sys.executable, "-c", HOST], host_time=True, env={"COLOUR": "red"})
    assert (result.returncode, result.stdout) == (0, "600.0 red\n"), result.stderr


def test_runs_are_compared(bench, tmp_path):
    result = understudy.exec(bench, [sys.executable, "-c", HOST], host_time=True, repeat=2,
                             record=str(tmp_path / "run"))
    assert result.returncode == 0, result.stderr
    assert "2 runs, all the same" in result.stderr
    assert (tmp_path / "run").read_bytes() == (tmp_path / "run.2").read_bytes()


WAITING_HOST = """
import os, time, understudy
time.sleep(2)
with understudy.attach(os.environ["UNDERSTUDY_CONTROL"]) as bench:
    print(bench.spans())
"""


def test_a_running_bench_tells_what_its_host_has_waited_for(bench):
    result = understudy.exec(bench, [sys.executable, "-c", WAITING_HOST], host_time=True)
    assert result.returncode == 0, result.stderr
    assert ast.literal_eval(result.stdout) == [
        {"lane": "host", "begin_ns": 0, "end_ns": 2_000_000_000, "kind": "wait", "text": "sleeps"}]


def test_real_time_ends_at_the_timeout(bench):
    began = time.monotonic()
    assert understudy.exec(bench, ["sleep", "600"], timeout_s=0.2).returncode == 124
    assert time.monotonic() - began < 300


def test_what_is_wrong_is_said(bench, monkeypatch):
    with pytest.raises(TypeError, match="a list of words"):
        understudy.exec(bench, "./my_host")
    monkeypatch.setenv("UNDERSTUDY_PROGRAM", "/no/such/program")
    with pytest.raises(understudy.NotThere, match="/no/such/program: cannot be started"):
        understudy.exec(bench, ["true"])
