"""Hypothesis strategies that draw from `hunt` in a scenario file: a Python test can apply to its own bench the
disturbances that `understudy hunt` applies to a scenario. Needs the package `hypothesis`."""
from __future__ import annotations

import copy
import functools
import json
import re
import subprocess
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

from hypothesis import strategies as st

from .bench import Bench
from .daemon import program_path
from .errors import BadSetup, NotThere

MOST = 16  # disturbances of an example, as in a course of a hunt
MICROSECOND = 1000  # in nanoseconds


class Disturbance:
    """A step of `may` with drawn values. A fault has a moment: a time, counted from apply(), or a request."""

    def __init__(self, step: Dict[str, Any], moment: str, number: int = 0) -> None:
        self.step = step
        self.moment = moment  # "at", "from": a time; "nth": a request; "here": none
        self.number = number  # nanoseconds, or the number of the request

    def __repr__(self) -> str:
        return json.dumps(self._with_moment(0))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Disturbance) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))

    def _with_moment(self, begin_ns: int) -> Dict[str, Any]:
        step = copy.deepcopy(self.step)
        if self.moment == "nth":
            step["inject"]["nth"] = self.number
        elif self.moment != "here":
            step["inject"][self.moment] = f"{begin_ns + self.number}ns"
        return step

    def apply(self, bench: Bench) -> None:
        """Applies it to a bench. A fault waits for its moment; everything else happens now."""
        begin_ns = int(bench.status()["simulated_time_ns"]) if self.moment in ("at", "from") else 0
        (kind, what), = self._with_moment(begin_ns).items()
        APPLIERS[kind](bench, what)


def _turn(bench: Bench, what: Dict[str, Any]) -> None:
    values = dict(what)
    within = values.pop("in", None)
    bench.turn(values, within)


def _each(act: Callable[[Bench, Any, str], Any]) -> Callable[[Bench, Dict[str, Any]], None]:
    def act_on_all(bench: Bench, what: Dict[str, Any]) -> None:
        for device, value in what.items():
            act(bench, value, device)
    return act_on_all


APPLIERS: Dict[str, Callable[[Bench, Any], Any]] = {
    "inject": Bench.inject,
    "input": Bench.input,
    "turn": _turn,
    "write": Bench.set,
    "advance": Bench.advance,
    "power": _each(lambda bench, to, device: bench.power(str(to), device)),
    "command": _each(lambda bench, text, device: bench.command(str(text), device)),
}


@functools.lru_cache(maxsize=None)
def _plan(scenario: str, command: Tuple[str, ...]) -> Dict[str, Any]:
    words = [program_path(), "hunt", scenario, "--plan", *(["--", *command] if command else [])]
    try:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise NotThere(f"{words[0]}: cannot be started; expected the program understudy in $PATH, or its path in "
                       "UNDERSTUDY_PROGRAM") from error
    if done.returncode != 0:
        raise BadSetup(done.stderr.strip())
    plan: Dict[str, Any] = json.loads(done.stdout)
    for entry in plan["may"]:
        kind = next(iter(entry["step"]))
        if kind not in APPLIERS:
            raise BadSetup(f"{scenario}: hunt.may: `{kind}` cannot be applied to a bench; expected one of "
                           + ", ".join(APPLIERS))
    return plan


def _filled(node: Any, values: Sequence[str]) -> Any:
    """Puts the drawn values into a step. Whole numbers become numbers."""
    if isinstance(node, dict):
        if set(node) == {"drawn"}:
            return _filled(values[node["drawn"]], values)
        return {key: _filled(value, values) for key, value in node.items()}
    if isinstance(node, list):
        return [_filled(element, values) for element in node]
    return int(node) if re.fullmatch(r"-?(0|[1-9][0-9]*)", node) else node


@st.composite
def _of_entry(draw: Callable[..., Any], entry: Dict[str, Any], requests: int) -> Disturbance:
    step = _filled(entry["step"], [draw(st.sampled_from(values)) for values in entry["values"]])
    moment = draw(st.sampled_from(entry["moments"]))
    number = 0
    if moment == "nth":
        number = draw(st.integers(1, requests + 2))
    elif moment != "here":
        low, high = entry["from_ns"] // MICROSECOND, entry["to_ns"] // MICROSECOND
        number = draw(st.integers(low, high)) * MICROSECOND
    return Disturbance(step, moment, number)


def disturbance(scenario: Any, command: Optional[Sequence[str]] = None) -> st.SearchStrategy[Disturbance]:
    """Draws one of the entries of `may` in a scenario file, its values and its moment: for a rule of a state machine."""
    plan = _plan(str(scenario), tuple(map(str, command or ())))
    return st.one_of([_of_entry(entry, plan["requests"]) for entry in plan["may"]])


@st.composite
def _course(draw: Callable[..., Any], plan: Dict[str, Any]) -> List[Disturbance]:
    drawn: List[Disturbance] = []
    for entry in plan["may"]:
        of_entry: List[Disturbance] = draw(st.lists(_of_entry(entry, plan["requests"]), max_size=entry["times"]))
        for one in of_entry[1:]:
            if "within_ns" in entry:  # of the first
                one.number = of_entry[0].number + draw(st.integers(0, entry["within_ns"] // MICROSECOND)) * MICROSECOND
        drawn += of_entry
    return drawn[:MOST]


def disturbances(scenario: Any, command: Optional[Sequence[str]] = None) -> st.SearchStrategy[List[Disturbance]]:
    """Draws the disturbances of a whole test: each entry of `may` as often as its `times` allows, or not at all."""
    return _course(_plan(str(scenario), tuple(map(str, command or ()))))
