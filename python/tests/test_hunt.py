"""Hunts find planted faults in programs of all languages, and none where they are mended. All faults are measured, with
ten seeds each, by benchmarks/hunts.py; here is a sample."""
import importlib.util
import os
import pathlib
import shutil
import subprocess

import pytest

pytest_plugins = ["pytester"]
PROJECT = pathlib.Path(__file__).parents[2]
PROGRAM = pathlib.Path(os.environ.get("UNDERSTUDY_PROGRAM") or shutil.which("understudy") or "understudy").resolve()
SPEC = importlib.util.spec_from_file_location("hunts", PROJECT / "benchmarks" / "hunts.py")
assert SPEC and SPEC.loader
hunts = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(hunts)

# How many courses are enough to find it.
FAULTS = {"tied_hand": 300, "start_beats_stop": 100, "number_from_anyone": 200, "part_that_did_not_come": 100,
          "service_keys": 2000}


def fault_called(name):
    return hunts.Fault(hunts.FAULTS / f"{name}.yaml")


def hunted(fault, kind, folder, courses):
    words = [PROGRAM, "hunt", fault.of_kind(kind, folder), "--courses", str(courses), "--found", folder / "found"]
    return subprocess.run(words, capture_output=True, text=True, cwd=hunts.FAULTS, check=False)


@pytest.mark.parametrize("name", [name for name in FAULTS if name != "service_keys"])
def test_a_planted_fault_is_found_unless_it_is_mended(name, tmp_path):
    fault = fault_called(name)
    said = hunted(fault, "careless", tmp_path, FAULTS[name])
    assert said.returncode == 1, said.stdout + said.stderr
    (found,) = (tmp_path / "found").glob(f"{name}-*.yaml")
    assert found.with_suffix(".jsonl").exists() and found.with_suffix(".html").exists()
    failed = subprocess.run([PROGRAM, "run", found], capture_output=True, text=True, check=False)
    assert failed.returncode == 1, failed.stdout + failed.stderr
    mended = hunted(fault, "careful", tmp_path, FAULTS[name] // 4)
    assert mended.returncode == 0, mended.stdout + mended.stderr


def without_disturbances(text):
    """Yields the text without one of its disturbances: all lines of a step, whose first has the comment."""
    lines = text.splitlines(keepends=True)
    for number, line in enumerate(lines):
        if "  # disturbance " not in line:
            continue
        end = number + 1
        while end < len(lines) and lines[end].startswith("    "):
            end += 1
        yield "".join(lines[:number] + lines[end:])


@pytest.mark.parametrize("name", ["tied_hand", "start_beats_stop", "service_keys"])
def test_a_finding_passes_without_any_one_of_its_disturbances(name, tmp_path):
    fault = fault_called(name)
    hunted(fault, "careless", tmp_path, FAULTS[name])
    found = next((tmp_path / "found").glob(f"{name}-*.yaml")).read_text()
    fewer = list(without_disturbances(found))
    assert fewer
    for number, text in enumerate(fewer):
        (tmp_path / f"fewer{number}.yaml").write_text(text)
        passed = subprocess.run([PROGRAM, "run", f"fewer{number}.yaml"], cwd=tmp_path, capture_output=True, text=True,
                                check=False)
        assert passed.returncode == 0, text + passed.stdout


def test_the_marker_hunts_before_a_test(pytester, monkeypatch):
    monkeypatch.setenv("UNDERSTUDY_PROGRAM", str(PROGRAM))
    press = hunts.FAULTS / "bouncing_press.yaml"
    pytester.makepyfile(f"""
        import pytest
        @pytest.mark.understudy_hunt({str(press)!r}, courses=50)
        def test_found(): raise AssertionError("not reached")
        @pytest.mark.understudy_hunt({str(press)!r}, courses=1, flags=["--unguided"])
        def test_passes(): pass
        @pytest.mark.understudy_hunt("none.yaml")
        def test_wrong(): pass
        """)
    result = pytester.runpytest("-p", "understudy.pytest_plugin", "--strict-markers", "-p", "no:cacheprovider")
    result.assert_outcomes(passed=1, errors=2)
    result.stdout.fnmatch_lines(["*FAIL*bouncing_press-*.yaml: Counter1_Value is 2; expected 1*", "*exit code 2*"])
    result.stdout.no_fnmatch_line("*not reached*")
