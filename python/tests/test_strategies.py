"""Tests the Hypothesis strategies: they draw from `hunt` in a scenario file, and tests apply the steps to a bench."""
import os
import pathlib
import shutil

import pytest

hypothesis = pytest.importorskip("hypothesis")
import understudy  # noqa: E402
from understudy.strategies import Disturbance, disturbance, disturbances  # noqa: E402

PROGRAM = os.environ.get("UNDERSTUDY_PROGRAM") or shutil.which("understudy") or "understudy"
BENCH = "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n"
PRESS = """understudy: 1
bench: bench.yaml
steps:
  - say: begin
  - advance: 200ms
hunt:
  may:
    - inject: { stuck: feeder.DIN_10, level: { one_of: [ on, off ] }, for: { between: [ 1ms, 10ms ] } }
      times: 3
      within: 20ms
      from: begin
    - input: { DIN_9: { one_of: [ on, off ] } }
    - write: { feeder.Aaxis_AccTime: { between: [ 1, 3000 ] } }
    - power: { feeder: cycle }
"""
# A contact that bounces is counted twice.
COUNTING = """again:  Wait_IO DIN_10 ON
        Counter_Increase 1
        Wait_IO DIN_10 OFF
        Jump again
"""


@pytest.fixture(name="folder", scope="module")
def make_folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("strategies")
    (folder / "bench.yaml").write_text(BENCH)
    (folder / "press.yaml").write_text(PRESS)
    return folder


def examples(strategy, count=100):
    drawn = []

    @hypothesis.settings(max_examples=count, database=None, derandomize=True, deadline=None)
    @hypothesis.given(strategy)
    def draw(one):
        drawn.append(one)

    draw()
    return drawn


def test_all_that_may_happen_is_drawn_within_its_bounds(folder):
    kinds, levels, lengths, most = set(), set(), set(), 0
    for course in examples(disturbances(folder / "press.yaml")):
        stuck = [one for one in course if "inject" in one.step]
        most = max(most, len(stuck))
        kinds |= {next(iter(one.step)) for one in course}
        for one in stuck:
            assert one.moment == "at"
            assert 0 <= one.number - stuck[0].number <= 20_000_000, course
            levels.add(one.step["inject"]["level"])
            lengths.add(one.step["inject"]["for"])
        for one in course:
            if "write" in one.step:
                assert 1 <= one.step["write"]["feeder.Aaxis_AccTime"] <= 3000
    assert kinds == {"inject", "input", "write", "power"}
    assert levels == {"on", "off"} and most == 3
    assert lengths <= {f"{n}ms" for n in range(1, 11)} and len(lengths) > 3


def test_each_of_them_can_be_done_to_a_bench(folder):
    with understudy.start(str(folder / "bench.yaml"), program=PROGRAM) as bench:
        bench.advance("3ms")
        for one in examples(disturbance(folder / "press.yaml"), 40):
            one.apply(bench)
        bench.clear()
        fault = Disturbance({"inject": {"stuck": "feeder.DIN_10", "level": "on", "for": "4ms"}}, "at", 10_000_000)
        now_ns = bench.status()["simulated_time_ns"]
        fault.apply(bench)
        assert bench["DIN_10"] == 0
        bench.advance("11ms")
        assert bench["DIN_10"] == 1
        assert bench.status()["simulated_time_ns"] == now_ns + 11_000_000


def test_hypothesis_finds_the_fault_and_shrinks_it(folder):
    with understudy.start(str(folder / "bench.yaml"), program=PROGRAM) as bench:
        bench.program(COUNTING)
        bench["PROG_MAIN_RunTime_START"] = 0
        bench.snapshot("begin")
        failed = []

        @hypothesis.settings(max_examples=200, database=None, derandomize=True, deadline=None)
        @hypothesis.given(disturbances(folder / "press.yaml"))
        def one_press_is_one_part(course):
            bench.restore("begin")
            bench.clear()
            for one in course:
                if "inject" in one.step:
                    one.apply(bench)
            bench.input({"DIN_10": "on"})
            bench.advance("200ms")
            if bench["Counter1_Value"] != 1:
                failed.append(course)
                raise AssertionError(bench["Counter1_Value"])

        with pytest.raises(AssertionError):
            one_press_is_one_part()
    assert len(failed[-1]) == 1, failed[-1]
    assert failed[-1][0].step["inject"]["level"] == "off"


def test_what_cannot_be_drawn_is_refused(folder):
    (folder / "send.yaml").write_text(PRESS.replace("- power: { feeder: cycle }", "- send: { text: A }"))
    with pytest.raises(understudy.BadSetup, match="send"):
        disturbances(folder / "send.yaml")
    with pytest.raises(understudy.BadSetup, match=r"none\.yaml"):
        disturbance(pathlib.Path("none.yaml"))
