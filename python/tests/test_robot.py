"""Tests the library for Robot Framework, by Robot if it is installed, and by a substitute that supports what the
example uses."""
import fnmatch
import importlib.util
import inspect
import pathlib
import re
import subprocess
import sys

import pytest
from understudy import Refused
from understudy.robot import Understudy

SUITE = pathlib.Path(__file__).parents[2] / "examples/robot/feeder.robot"


def keywords():
    return [name for name, method in inspect.getmembers(Understudy, inspect.isfunction) if not name.startswith("_")]


class StandIn:
    """Splits a line by Robot's rules: two spaces separate cells, `name=value` passes an argument by name, and `${x} =`
    assigns."""

    def __init__(self, text):
        self.tables = {}
        table = rows = None
        for line in text.splitlines():
            if line.startswith("***"):
                table = self.tables.setdefault(line.strip("* "), {})
            elif line.strip():
                cells = re.split(r" {2,}", line.rstrip())
                if not line.startswith(" "):
                    rows = table.setdefault(cells[0], [])
                    cells = [""] + cells[1:]
                if cells[1:]:
                    rows.append(cells[1:])
        self.library = Understudy()
        self.variables = {}

    def run(self, test):
        try:
            self.call(*self.tables["Settings"]["Test Setup"][0])
            for row in self.tables["Test Cases"][test]:
                self.call(*row)
        finally:
            self.call(*self.tables["Settings"]["Test Teardown"][0])
            self.library._end_suite(None, None)

    def call(self, *cells):
        if cells[0].endswith("} ="):
            self.variables[cells[0][:-2]] = self.call(*cells[1:])
            return None
        if cells[0] == "Run Keyword And Expect Error":
            with pytest.raises(Exception) as caught:
                self.call(*cells[2:])
            assert fnmatch.fnmatch(str(caught.value), cells[1])
            return None
        if cells[0] in self.tables["Keywords"]:
            for row in self.tables["Keywords"][cells[0]]:
                self.call(*row)
            return None
        method = getattr(self.library, cells[0].lower().replace(" ", "_"))
        taken = inspect.signature(method).parameters
        takes_any = any(one.kind is one.VAR_KEYWORD for one in taken.values())
        positional, named = [], {}
        for cell in cells[1:]:
            cell = self.variables.get(cell, cell)
            name, equals, value = cell.partition("=") if isinstance(cell, str) else ("", "", cell)
            if equals and (takes_any or name in taken):
                named[name] = value
            else:
                positional.append(cell)
        return method(*positional, **named)


@pytest.mark.parametrize("test", StandIn(SUITE.read_text()).tables["Test Cases"])
def test_the_example(test):
    StandIn(SUITE.read_text()).run(test)


def test_a_keyword_that_fails_says_why():
    library = Understudy()
    with pytest.raises(AssertionError, match="Start Bench"):
        library.get_value("Cord_A")
    library.start_bench(model="simple2-r3")
    with pytest.raises(AssertionError, match="Cord_A is 0; expected 5"):
        library.value_should_be("Cord_A", "5")
    with pytest.raises(AssertionError, match="did not become true within 5ms"):
        library.run_until("Cord_A == 1", "5ms")
    with pytest.raises(AssertionError, match="no frame has"):
        library.last_frames_should_contain("read")
    library._end_suite(None, None)


def test_what_a_keyword_is_given_wrongly_is_quoted():
    library = Understudy()
    library.start_bench(model="simple2-r3")
    with pytest.raises(Refused, match="Aaxis_Speed: 'fast' is not a number; expected 0 to 32768"):
        library.set_values(Aaxis_Speed="fast")
    with pytest.raises(Refused, match="number: 'x' is not a whole number; expected one"):
        library.clear_fault("x")
    with pytest.raises(Refused, match="bytes: '01 0' is not hexadecimal digits"):
        library.send_bytes("01 0")
    with pytest.raises(AssertionError, match="line: 'rs485' is unknown; expected one of line"):
        library.get_port("rs485")
    library._end_suite(None, None)


def test_snapshots_and_inputs():
    library = Understudy()
    library.start_bench(model="simple2-r3")
    library.take_snapshot("begin")
    library.set_inputs(DIN_10="1", AIN_A="2.5V")
    library.advance_time("1ms")
    assert library.get_value("ADC_A") == 1000
    library.restore_snapshot("begin")
    assert library.get_value("ADC_A") == 0
    library._end_suite(None, None)


def test_keywords_are_few_and_documented():
    assert 20 <= len(keywords()) <= 25
    assert all(getattr(Understudy, name).__doc__ for name in keywords())


def test_the_example_by_robot_itself(tmp_path):
    if importlib.util.find_spec("robot") is None:
        pytest.skip("Robot Framework is not installed; Debian 12 does not have it")
    done = subprocess.run([sys.executable, "-m", "robot", "--outputdir", str(tmp_path), str(SUITE)], capture_output=True,
                          text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
