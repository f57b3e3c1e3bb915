"""Fixtures for pytest: `-p understudy.pytest_plugin`. A failed test keeps its recording, its report and its frames."""
from __future__ import annotations  # pytest before 7.0 lacks some of the types

import contextlib
import difflib
import inspect
import itertools
import os
import subprocess
from pathlib import Path
from typing import Any, Callable, Dict, Generator, List, Mapping, Optional, Sequence
from weakref import WeakKeyDictionary

import pytest

from .bench import Bench, start
from .daemon import program_path
from .errors import NotTellable
from .host import exec as exec_host

REPLAYED_WITHIN_S = 60.0
# This plugin's data about the current tests and runs; pytest has its own place for such data only from 7.0 on.
KEPT: WeakKeyDictionary[pytest.Item, List[Path]] = WeakKeyDictionary()
FAILED: WeakKeyDictionary[pytest.Item, bool] = WeakKeyDictionary()
SUM: WeakKeyDictionary[pytest.Config, str] = WeakKeyDictionary()
NUMBERS = itertools.count(1)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.getgroup("understudy").addoption("--understudy-real-time", action="store_true",
                                            help="run benches in real time instead of advancing time by hand")
    parser.getgroup("understudy").addoption("--understudy-coverage", metavar="FILE",
                                            help="write the line coverage of the controllers' programs to this "
                                                 "file: FILE.info for lcov, FILE.xml for Cobertura, or FILE.html")
    parser.getgroup("understudy").addoption("--understudy-on", metavar="LINE=PORT", action="append",
                                            help="use a real controller at this port instead of the bench's devices on "
                                                 "that line; tests that need more than its line are skipped")
    parser.getgroup("understudy").addoption("--understudy-allow", action="append", default=[],
                                            choices=["writes", "memory", "outputs", "motion"],
                                            help="requests that may be sent to a real controller [only reads]")
    parser.getgroup("understudy").addoption("--understudy-rig", metavar="COMMAND",
                                            help="command that acts on the machine, as for `run --rig`")
    parser.getgroup("understudy").addoption("--understudy-envelope", metavar="FILE",
                                            help="file with limits for requests, as for `run --envelope`")
    parser.addini("understudy_host_time", "whether run_host puts host programs into simulated time", type="bool", default=True)


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "understudy(bench=None, **arguments): what the fixture `bench` starts")
    config.addinivalue_line("markers", "understudy_hunt(scenario, courses=2000, seed=0, command=None, flags=()): hunts in "
                                       "this scenario before the test, which fails if something is found")


def part_of_coverage(config: pytest.Config, number: str) -> Optional[Path]:
    """Returns the file of one bench, next to the file of the sum, or None if no file was requested."""
    wanted = config.getoption("--understudy-coverage")
    if not wanted:
        return None
    whole = Path(config.invocation_params.dir, wanted)
    return whole.with_name(f"{whole.name}-part-{number}.info")


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Adds up what the benches of all tests, and of all workers of pytest-xdist, have written."""
    pattern = part_of_coverage(session.config, "*")
    if pattern is None or hasattr(session.config, "workerinput"):
        return
    parts = sorted(str(part) for part in pattern.parent.glob(pattern.name))
    if not parts:
        SUM[session.config] = "coverage of programs: no test has started a bench"
        return
    program = os.environ.get("UNDERSTUDY_PROGRAM") or "understudy"
    whole = str(Path(session.config.invocation_params.dir, session.config.getoption("--understudy-coverage")))
    done = subprocess.run([program, "coverage", *parts, "--output", whole], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, errors="replace", check=False)
    SUM[session.config] = (done.stdout + done.stderr).strip()
    if done.returncode != 0:
        session.exitstatus = pytest.ExitCode.INTERNAL_ERROR
        return
    for part in parts:
        os.unlink(part)


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    if config in SUM:
        terminalreporter.write_line(SUM[config])


@pytest.hookimpl(hookwrapper=True)  # type: ignore[misc]
def pytest_runtest_makereport(item: pytest.Item, call: "pytest.CallInfo[None]") -> Generator[None, Any, None]:
    outcome = yield
    report = outcome.get_result()
    if call.excinfo is not None and isinstance(call.excinfo.value, NotTellable):
        report.outcome = "skipped"
        path, line, _ = item.location
        report.longrepr = (path, (line or 0) + 1, f"Skipped: {call.excinfo.value}")
    FAILED[item] = FAILED.get(item, False) or report.failed
    # The benches are closed by now, so their recordings are complete. pytest shows a section of the teardown next to
    # the failure if its name contains "teardown".
    if report.when == "teardown" and FAILED[item]:
        lines = [line for folder in KEPT.get(item, []) for line in draw(folder)]
        if lines:
            report.sections.append(("understudy (kept at teardown)", "\n".join(lines)))


def draw(folder: Path) -> List[str]:
    """Creates the report and the frames from the recording. Returns the files that exist, and the errors."""
    recording, page, frames = folder / "understudy.rec", folder / "report.html", folder / "frames.txt"
    program = program_path()
    said = []
    try:
        done = subprocess.run([program, "replay", str(recording), "--report", str(page), "--capture", str(frames)],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                              timeout=REPLAYED_WITHIN_S, check=False)
        if done.returncode != 0:
            said = [f"replay, exit code {done.returncode}: {(done.stderr or done.stdout).strip()}"]
    except (OSError, subprocess.TimeoutExpired) as error:
        said = [f"replay: {error}"]
    return [str(file) for file in (recording, page, frames) if file.exists()] + said


def require_known(arguments: Mapping[str, Any]) -> None:
    """Reports a misspelt argument at the author's test, not in this file."""
    known = [name for name, it in inspect.signature(start).parameters.items() if it.kind is not it.VAR_POSITIONAL]
    for name in arguments:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            hint = f"the nearest is {near[0]!r}" if near else "expected one of " + ", ".join(known)
            pytest.fail(f"understudy: {name!r} is not an argument of a bench; {hint}", pytrace=False)


@pytest.fixture
def bench_factory(request: pytest.FixtureRequest, tmp_path: Path) -> Generator[Callable[..., Bench], None, None]:
    """Starts benches like `understudy.start`, each with its own folder and recording."""
    benches: List[Bench] = []
    kept = KEPT.setdefault(request.node, [])
    on = request.config.getoption("--understudy-on")
    speed = "real" if request.config.getoption("--understudy-real-time") else "manual"

    def make_on_box(bench: Any, flags: Sequence[str], arguments: Dict[str, Any]) -> Bench:
        if flags:
            pytest.skip(f"{' '.join(map(str, flags))}: a real controller accepts no flags of `serve`")
        option = request.config.getoption
        settings = {"on": on, "allow": option("--understudy-allow"), "rig": option("--understudy-rig"),
                    "envelope": option("--understudy-envelope"), **arguments}
        made = start(bench, **settings)
        benches.append(made)
        return made

    def make(bench: Any = None, *flags: str, **arguments: Any) -> Bench:
        if on:
            return make_on_box(bench, flags, arguments)
        folder = tmp_path / f"understudy-{len(kept) + 1}"
        folder.mkdir()
        if "record" not in arguments:
            kept.append(folder)
        settings: Dict[str, Any] = {"speed": speed, "record": str(folder / "understudy.rec"), **arguments}
        part = part_of_coverage(request.config, f"{os.getpid()}-{next(NUMBERS)}")
        counted = () if part is None or "--coverage" in flags else ("--coverage", str(part))
        made = start(bench, *flags, *counted, **settings)
        benches.append(made)
        return made

    yield make
    with contextlib.ExitStack() as all_of_them:
        for made in benches:
            all_of_them.callback(made.close)


@pytest.fixture
def bench(request: pytest.FixtureRequest, bench_factory: Callable[..., Bench]) -> Bench:
    """Starts the bench that the marker `understudy` describes. The entries of an indirect parameter override it.
    Without both, it is a Simple2-R3."""
    marker = request.node.get_closest_marker("understudy")
    positional = list(marker.args) if marker else []
    given = getattr(request, "param", {})
    if not isinstance(given, Mapping):
        pytest.fail(f"bench: the parameter is {given!r}; expected a dict, such as {{'model': 'slim'}}", pytrace=False)
    arguments: Dict[str, Any] = {**(marker.kwargs if marker else {}), **given}
    require_known(arguments)
    if not positional and "bench" not in arguments:
        arguments.setdefault("model", "simple2-r3")
    named = positional[0] if positional else arguments.pop("bench", None)
    return bench_factory(named, *positional[1:], **arguments)


@pytest.fixture
def run_host(request: pytest.FixtureRequest,
             tmp_path: Path) -> "Callable[..., subprocess.CompletedProcess[str]]":
    """Runs a host program like `understudy.exec`, in simulated time unless `host_time=False`, the setting
    `understudy_host_time` or --understudy-real-time says otherwise. A failed test keeps the recordings."""
    if request.config.getoption("--understudy-on"):
        pytest.skip("a host program runs with emulated controllers only")
    kept = KEPT.setdefault(request.node, [])
    is_real = request.config.getoption("--understudy-real-time") or not request.config.getini("understudy_host_time")

    def run(bench: Any, command: Sequence[str], *flags: str,
            **arguments: Any) -> "subprocess.CompletedProcess[str]":
        folder = tmp_path / f"understudy-{len(kept) + 1}"
        folder.mkdir()
        if "record" not in arguments:
            kept.append(folder)
        settings: Dict[str, Any] = {"host_time": not is_real, "record": str(folder / "understudy.rec"), **arguments}
        return exec_host(bench, command, *flags, **settings)

    return run


@pytest.fixture
def hunt(tmp_path: Path) -> Callable[..., str]:
    """Searches for disturbances that break a scenario, like `understudy hunt`. The test fails if there are findings,
    which are in the folder `found` of `tmp_path`. Returns the output of the hunt."""

    def run(scenario: Any, courses: int = 2000, seed: int = 0, command: Optional[Sequence[str]] = None,
            flags: Sequence[str] = ()) -> str:
        words = [program_path(), "hunt", str(scenario), "--courses", str(courses), "--seed", str(seed), "--found",
                 str(tmp_path / "found"), *flags, *(["--", *map(str, command)] if command else [])]
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                              check=False)
        if done.returncode == 1:
            pytest.fail(f"understudy hunt {scenario}:\n{done.stdout}", pytrace=False)
        if done.returncode != 0:
            pytest.fail(f"understudy hunt {scenario}: exit code {done.returncode}\n{done.stderr}", pytrace=False)
        return done.stdout

    return run


@pytest.fixture(autouse=True)
def _hunt_of_marker(request: pytest.FixtureRequest) -> None:
    marker = request.node.get_closest_marker("understudy_hunt")
    if marker:
        request.getfixturevalue("hunt")(*marker.args, **marker.kwargs)


@pytest.fixture
def port(bench: Bench) -> str:
    """Returns the path of the bench's first port."""
    return bench.port
