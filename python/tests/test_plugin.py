"""Tests the plugin with pytest runs inside a test."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

import pytest

from leavings import gone, mentioned

pytest_plugins = ["pytester"]

SUITE = """
import os, pytest
def test_time_stands(bench, port):
    assert os.path.exists(port)
    assert bench.advance("1ms") == 1_000_000
def test_two(bench_factory):
    assert bench_factory(model="simple2-r3").port != bench_factory(model="simple2-r3").port
@pytest.mark.understudy(model="slim")
def test_fails(bench):
    bench.send("MA 100")
    bench.advance("30ms")
    assert False
"""


def run(pytester, *flags):
    pytester.makepyfile(SUITE)
    return pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "--basetemp=kept", *flags)


def check(pytester, result):
    result.assert_outcomes(passed=2, failed=1)
    named = [line.strip() for line in result.outlines if "/understudy-1/" in line]
    assert {os.path.basename(path) for path in named} == {"frames.txt", "understudy.rec", "report.html"}
    assert all(os.path.getsize(path) > 0 for path in named)


def test_a_failure_names_what_it_kept(pytester):
    check(pytester, run(pytester))


def test_it_works_beside_itself(pytester):
    check(pytester, run(pytester, "-n", "2"))


HOST_SUITE = '''
import sys, time
BENCH = "understudy: 1\\nlines: { line: { stations: [ { name: feeder, model: simple2-r3 } ] } }\\n"
HOST = """
import os, time
port = os.open(os.environ["UNDERSTUDY_PORT"], os.O_RDWR | os.O_NOCTTY)
began = time.time()
time.sleep(SECONDS)
print(time.strftime("%Y", time.gmtime(began)))
"""
def host(run_host, tmp_path, seconds, **arguments):
    (tmp_path / "bench.yaml").write_text(BENCH)
    return run_host(tmp_path / "bench.yaml", [sys.executable, "-c", HOST.replace("SECONDS", str(seconds))], **arguments)
def test_hour(run_host, tmp_path):
    result = host(run_host, tmp_path, 3600)
    assert (result.returncode, result.stdout) == (0, "2026\\n"), result.stderr
def test_same_each_time(run_host, tmp_path):
    assert "2 runs, all the same" in host(run_host, tmp_path, 60, repeat=2).stderr
def test_as_in_life(run_host, tmp_path):
    assert host(run_host, tmp_path, 0.1, host_time=False).stdout == time.strftime("%Y\\n")
def test_fails(run_host, tmp_path):
    host(run_host, tmp_path, 1)
    assert False
'''


def test_a_host_runs_in_simulated_time(pytester):
    pytester.makepyfile(HOST_SUITE)
    result = pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "--basetemp=kept")
    result.assert_outcomes(passed=3, failed=1)
    named = [line.strip() for line in result.outlines if "/understudy-1/" in line]
    assert {os.path.basename(path) for path in named} == {"frames.txt", "understudy.rec", "report.html"}


@pytest.mark.parametrize("ini, flags", [("understudy_host_time = false", []), ("", ["--understudy-real-time"])])
def test_a_host_runs_in_real_time(pytester, ini, flags):
    pytester.makeini(f"[pytest]\n{ini}\n")
    pytester.makepyfile(HOST_SUITE)
    result = pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "-k", "life or same", *flags)
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*--repeat: runs differ in real time*"])


FIRMWARE_SUITE = """
import pytest
@pytest.mark.parametrize("bench, version", [({"firmware": "1.40"}, 140), ({"firmware": "1.52"}, 152)], indirect=["bench"])
def test_firmware(bench, version):
    assert bench["Version"] == version
def test_unknown_firmware(bench_factory):
    with pytest.raises(Exception, match="firmware"):
        bench_factory(None, "--firmware", "9.99", model="simple2-r3")
"""

PACE_SUITE = """
import time
def test_time_runs(bench):
    begin = bench.pause()
    bench.resume()
    time.sleep(0.1)
    assert bench.pause() - begin > 50_000_000
"""


def test_firmware_is_a_parameter(pytester):
    pytester.makepyfile(FIRMWARE_SUITE)
    pytester.runpytest_subprocess("-p", "understudy.pytest_plugin").assert_outcomes(passed=3)


def test_real_time_is_a_flag(pytester):
    pytester.makepyfile(PACE_SUITE)
    pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "--understudy-real-time").assert_outcomes(passed=1)


COVERAGE_SUITE = """
import pytest
@pytest.mark.parametrize("level", [0, 1])
def test_ways(bench_factory, level):
    feeder = bench_factory("bench.yaml")
    feeder.coverage()
    feeder.input({"DIN_3": level})
    feeder["PROG_MAIN_RunTime_START"] = 0
    feeder.advance("100ms")
    assert feeder.coverage()["totals"]["lines_run"] == 2 + level
    assert feeder.coverage(again=True)["totals"]["lines_run"] == 0
"""


PYTEST_6 = """
import pytest
for name in ("CallInfo", "Config", "Parser", "Stash", "StashKey"):
    delattr(pytest, name)
"""


@pytest.mark.parametrize("flags", [(), ("-n", "2"), ("-p", "pytest_6")], ids=["alone", "xdist", "pytest_6"])
def test_coverage_of_all_tests_is_one_file(pytester, flags):
    pytester.makepyfile(COVERAGE_SUITE, pytest_6=PYTEST_6)
    (pytester.path / "feed.lst").write_text("a:  Jump_IN_ON b DIN_3\n    END\nb:  Out DOUT_1 ON\n    END\n")
    (pytester.path / "bench.yaml").write_text(
        "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3, program: feed.lst } ] } }\n")
    result = pytester.runpytest_subprocess(*flags, "-p", "understudy.pytest_plugin", "--understudy-coverage", "c.info")
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(["coverage of programs: 4 of 4 lines (100.0 %), 2 of 2 branches (100.0 %)"])
    assert "DA:1,2" in (pytester.path / "c.info").read_text()
    assert not list(pytester.path.glob("*-part-*"))


CHOICE_SUITE = """
import pytest
CHOSEN = [{"choices": {"station_0_request": answer}} for answer in ("broadcast", "ignored")]
@pytest.mark.parametrize("bench", CHOSEN, indirect=True, ids=lambda chosen: chosen["choices"]["station_0_request"])
def test_choice(bench, request):
    (row,) = [row for row in bench.choices() if row["id"] == "station_0_request"]
    assert row["chosen"] in request.node.name
"""

TEARDOWN_SUITE = """
import pytest
@pytest.fixture
def other(bench):
    yield
    assert bench.get("Cord_A") == {"Cord_A": 1}
def test_passes(other):
    pass
"""

UNDRAWN_SUITE = """
import os
import pathlib
import re
def test_fails(bench_factory, monkeypatch, tmp_path):
    first, second = bench_factory(model="slim"), bench_factory(model="slim")
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\\necho it cannot >&2\\nexit 3\\n")
    program.chmod(0o755)
    os.environ["UNDERSTUDY_PROGRAM"] = str(program)
    assert False
"""

SLOW_SUITE = """
import os, time, pytest
@pytest.mark.parametrize("number", range(2))
def test_slow(bench_factory, number):
    ports = [bench_factory(model=model).port for model in ("slim", "simple2-r3")]
    text = " ".join([str(os.getpid())] + ports)
    with open(f"begun{number}.part", "w") as file:
        file.write(text)
    os.rename(f"begun{number}.part", f"begun{number}")
    time.sleep(60)
"""


def test_choices_are_a_parameter(pytester):
    pytester.makepyfile(CHOICE_SUITE)
    pytester.runpytest_subprocess("-p", "understudy.pytest_plugin").assert_outcomes(passed=2)


def test_a_failed_teardown_keeps_files_too(pytester):
    pytester.makepyfile(TEARDOWN_SUITE)
    result = pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "--basetemp=kept")
    result.assert_outcomes(passed=1, errors=1)
    result.stdout.fnmatch_lines(["*/understudy-1/understudy.rec", "*/understudy-1/report.html"])


def test_what_cannot_be_drawn_is_not_named(pytester):
    pytester.makepyfile(UNDRAWN_SUITE)
    result = pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "--basetemp=kept")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*/understudy-1/understudy.rec", "replay, exit code 3: it cannot",
                                 "*/understudy-2/understudy.rec", "replay, exit code 3: it cannot"])
    result.stdout.no_fnmatch_line("*report.html*")


@pytest.mark.parametrize("flags, begun", [([], 1), (["-n", "2"], 2)], ids=["alone", "xdist"])
def test_killed_it_leaves_nothing_behind(pytester, flags, begun):
    pytester.makepyfile(SLOW_SUITE)
    folders = pathlib.Path(tempfile.mkdtemp(prefix="killed-"))  # a longer path would not be accepted
    command = [sys.executable, "-m", "pytest", "-p", "understudy.pytest_plugin", "--basetemp=kept", *flags]
    run = subprocess.Popen(command, env={**os.environ, "TMPDIR": str(folders)}, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, cwd=pytester.path)
    marks = [pytester.path / f"begun{number}" for number in range(begun)]
    try:
        gone(lambda: not all(mark.exists() for mark in marks), within_s=40)
    finally:
        run.kill()
        workers = [mark.read_text().split() for mark in marks if mark.exists()]
        for pid in {int(worker[0]) for worker in workers} - {run.pid}:
            os.kill(pid, signal.SIGKILL)
        run.wait()
    ports = [port for worker in workers for port in worker[1:]]
    assert len(ports) == 2 * begun
    gone(lambda: list(folders.iterdir()) or mentioned(str(folders)) or any(map(os.path.lexists, ports)))
    folders.rmdir()


def test_a_failing_course_shrinks_to_its_least(pytester):
    pytest.importorskip("hypothesis")
    example = pathlib.Path(__file__).parents[2] / "examples/hypothesis/test_course.py"
    result = pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "--basetemp=kept", str(example))
    result.assert_outcomes(failed=1)
    # Look only in the traceback, because pytest's summary repeats it in a CI.
    course = [line.partition("state.")[2] for line in result.outlines if re.match(r"E\s+state\.(?!machine_is)", line)]
    # One pulse in 20 is lost, so fewer than 20 lose none.
    assert course == ["lose_steps(one_in=20)", "move(pulses=20)", "teardown()"]


MISTAKES_SUITE = """
import pytest
@pytest.mark.understudy(modle="slim")
def test_misspelt(bench):
    pass
@pytest.mark.parametrize("bench", ["slim"], indirect=True)
def test_no_dict(bench):
    pass
@pytest.mark.parametrize("bench", [{"firmwar": "1.40"}], indirect=True)
def test_misspelt_parameter(bench):
    pass
"""


def test_mistakes_are_reported_to_the_tests_author(pytester):
    pytester.makepyfile(MISTAKES_SUITE)
    result = pytester.runpytest_subprocess("-p", "understudy.pytest_plugin")
    result.assert_outcomes(errors=3)
    said = result.stdout.str()
    assert "understudy: 'modle' is not an argument of a bench; the nearest is 'model'" in said
    assert "understudy: 'firmwar' is not an argument of a bench; the nearest is 'firmware'" in said
    assert "bench: the parameter is 'slim'; expected a dict, such as {'model': 'slim'}" in said
    assert "TypeError" not in said and "pytest_plugin.py" not in said
