"""Finds the shortest course of moves and faults for which a host goes wrong.

The host below believes the controller's counter. Hypothesis finds a course after which the machine is elsewhere, and
shrinks it: this test fails on purpose. One bench serves all courses; each begins with a restored snapshot.
"""
import pytest
from hypothesis import settings, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule


class Host:
    """This part would be your program: it talks to the controller, and keeps its own position."""

    def __init__(self, bench):
        self.bench = bench
        self.position_pulses = 0
        bench.set({"Aaxis_SVON": 1, "Aaxis_Speed": 600, "Aaxis_AccTime": 1, "Aaxis_DecTime": 1})

    def move(self, pulses):
        self.bench.set({"Aaxis_Pulse": pulses, "Aaxis_Move_INC": 1})
        assert self.bench.run_until("device.STATUS.4 == 0", within="10s")
        self.position_pulses += pulses


class Course(RuleBasedStateMachine):
    bench = None

    def __init__(self):
        super().__init__()
        self.bench.restore("begin")
        self.host = Host(self.bench)
        self.is_slipping = False

    @rule(pulses=st.integers(min_value=1, max_value=2000))
    def move(self, pulses):
        self.host.move(pulses)

    @rule(milliseconds=st.integers(min_value=1, max_value=500))
    def wait(self, milliseconds):
        self.bench.advance(f"{milliseconds}ms")

    @precondition(lambda self: not self.is_slipping)
    @rule(one_in=st.integers(min_value=20, max_value=200))
    def lose_steps(self, one_in):
        self.bench.inject({"lost_steps": "A", "one_in": one_in})
        self.is_slipping = True

    @precondition(lambda self: self.is_slipping)
    @rule()
    def mend(self):
        self.bench.clear()
        self.is_slipping = False

    @invariant()
    def machine_is_where_the_host_believes(self):
        assert self.bench.eval("A.position") == self.host.position_pulses


@pytest.mark.understudy(model="simple2-r3", record=None)  # a bench that is being recorded cannot go back
def test_course(bench):
    bench.snapshot("begin")
    Course.bench = bench
    # The simulation is deterministic, so a failing course fails again.
    machine = Course.TestCase
    machine.settings = settings(max_examples=100, stateful_step_count=10, deadline=None, derandomize=True, database=None)
    machine().runTest()
