"""Fixtures for pytest: `-p understudy.pytest_plugin`. A failed test keeps its recording, its report and its frames."""
import json
import os
import subprocess
from pathlib import Path
from typing import Any, Callable, Dict, Generator, List, Tuple

import pytest

from .bench import Bench, start
from .errors import UnderstudyError

Kept = List[Tuple[Bench, Path]]
KEPT = pytest.StashKey[Kept]()
FAILED = pytest.StashKey[bool]()


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.getgroup("understudy").addoption("--understudy-real-time", action="store_true",
                                            help="benches run in real time, not by hand")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "understudy(bench=None, **arguments): what the fixture `bench` starts")


@pytest.hookimpl(hookwrapper=True)  # type: ignore[misc]
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, Any, None]:
    outcome = yield
    report = outcome.get_result()
    benches: Kept = item.stash.get(KEPT, [])
    if not report.failed or not benches or report.when == "teardown":
        return
    item.stash[FAILED] = True
    for bench, folder in benches:
        try:
            text = json.dumps(bench.frames(1000), indent=1)
        except UnderstudyError as error:
            text = json.dumps({"error": str(error)})
        (folder / "frames.json").write_text(text + "\n")
        report.sections.append(("understudy", "\n".join(str(folder / name) for name in (
            "frames.json", "understudy.rec", "report.html"))))


@pytest.fixture
def bench_factory(request: pytest.FixtureRequest, tmp_path: Path) -> Generator[Callable[..., Bench], None, None]:
    """Starts benches as `understudy.start` does, each with a folder and a recording."""
    kept: Kept = request.node.stash.setdefault(KEPT, [])
    speed = "real" if request.config.getoption("--understudy-real-time") else "manual"

    def make(bench: Any = None, *flags: str, **arguments: Any) -> Bench:
        folder = tmp_path / f"understudy-{len(kept) + 1}"
        folder.mkdir()
        made = start(bench, *flags, **{"speed": speed, "record": str(folder / "understudy.rec"), **arguments})
        kept.append((made, folder))
        return made

    yield make
    for made, folder in kept:
        made.close()
        if request.node.stash.get(FAILED, False):
            program = os.environ.get("UNDERSTUDY_PROGRAM") or "understudy"
            subprocess.run([program, "replay", str(folder / "understudy.rec"), "--report", str(folder / "report.html")],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60, check=False)


@pytest.fixture
def bench(request: pytest.FixtureRequest, bench_factory: Callable[..., Bench]) -> Bench:
    """What the marker `understudy` names; an indirect parameter's entries come over it; a Simple2-R3 without either."""
    marker = request.node.get_closest_marker("understudy")
    positional = list(marker.args) if marker else []
    arguments: Dict[str, Any] = {**(marker.kwargs if marker else {}), **getattr(request, "param", {})}
    flags = ["--firmware", str(arguments.pop("firmware"))] if "firmware" in arguments else []
    if not positional and "bench" not in arguments:
        arguments.setdefault("model", "simple2-r3")
    named = positional[0] if positional else arguments.pop("bench", None)
    return bench_factory(named, *positional[1:], *flags, **arguments)


@pytest.fixture
def port(bench: Bench) -> str:
    """The path of the bench's first port."""
    return bench.port
