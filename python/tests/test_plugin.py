"""The plugin, by test runs within a test."""
import os

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
    bench.advance("3ms")
    assert False
"""


def run(pytester, *flags):
    pytester.makepyfile(SUITE)
    return pytester.runpytest_subprocess("-p", "understudy.pytest_plugin", "--basetemp=kept", *flags)


def check(pytester, result):
    result.assert_outcomes(passed=2, failed=1)
    named = [line.strip() for line in result.outlines if "/understudy-1/" in line]
    assert {os.path.basename(path) for path in named} == {"frames.json", "understudy.rec", "report.html"}
    assert all(os.path.getsize(path) > 0 for path in named)


def test_a_failure_names_what_it_kept(pytester):
    check(pytester, run(pytester))


def test_it_works_beside_itself(pytester):
    check(pytester, run(pytester, "-n", "2"))


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
