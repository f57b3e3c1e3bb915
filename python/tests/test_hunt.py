"""Hunts find planted faults in programs and in hosts of several languages, and none where they are mended. All twenty
faults with ten seeds are measured by benchmarks/hunts.py; here is a sample."""
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess

import pytest
from test_pages import snippets

pytest_plugins = ["pytester"]
PROJECT = pathlib.Path(__file__).parents[2]
PROGRAM = pathlib.Path(os.environ.get("UNDERSTUDY_PROGRAM") or shutil.which("understudy") or "understudy").resolve()
SPEC = importlib.util.spec_from_file_location("hunts", PROJECT / "benchmarks" / "hunts.py")
assert SPEC and SPEC.loader
hunts = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(hunts)

# The number of courses that are enough to find each fault.
FAULTS = {"tied_hand": 300, "start_beats_stop": 100, "number_from_anyone": 200, "part_that_did_not_come": 100,
          "service_keys": 3000, "timeout_race": 40, "retried_count": 24, "ignored_return": 60,
          "unchecked_exit": 40}
NEEDED = {"retried_count": ["serial"], "unchecked_exit": ["mbpoll"], "ignored_return": ["cc"]}


def fault_called(name, folder):
    for what in NEEDED.get(name, []):
        if what == "serial":
            pytest.importorskip(what)
        elif not shutil.which(what):
            pytest.skip(f"{what} is not installed")
    fault = hunts.Fault(hunts.FAULTS / f"{name}.yaml", PROGRAM.parent, folder)
    if fault.command and fault.command[0].endswith("planted_host") and not os.path.exists(fault.command[0]):
        pytest.skip("the hosts are not built")
    return fault


def hunted(fault, kind, folder, courses, *flags):
    scenario, command = fault.of_kind(kind, folder)
    words = [PROGRAM, "hunt", *scenario, "--courses", str(courses), "--found", folder / "found", *flags, *command]
    return subprocess.run(words, capture_output=True, text=True, cwd=hunts.FAULTS, check=False)


@pytest.mark.parametrize("name", [name for name in FAULTS if name != "service_keys"])
def test_a_planted_fault_is_found_unless_it_is_mended(name, tmp_path):
    fault = fault_called(name, tmp_path)
    said = hunted(fault, "careless", tmp_path, FAULTS[name])
    assert said.returncode == 1, said.stdout + said.stderr
    found = sorted((tmp_path / "found").glob(f"{name}-*.yaml"))[0]  # a fault may show in several ways
    assert found.with_suffix(".jsonl").exists() and found.with_suffix(".html").exists()
    again = re.search(r"^# `understudy (.*)` runs it again", found.read_text(), re.M)
    words = again[1] if again else f"run {found}"
    failed = subprocess.run(f"{PROGRAM} {words}", shell=True, cwd=hunts.FAULTS, capture_output=True, text=True,
                            check=False)
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


@pytest.mark.parametrize("name", ["tied_hand", "start_beats_stop", "service_keys", "retried_count", "unchecked_exit"])
def test_a_finding_passes_without_any_one_of_its_disturbances(name, tmp_path):
    fault = fault_called(name, tmp_path)
    hunted(fault, "careless", tmp_path, FAULTS[name])
    path = sorted((tmp_path / "found").glob(f"{name}-*.yaml"))[0]
    found = path.read_text()
    again = re.search(r"^# `understudy (.*)` runs it again", found, re.M)
    words = again[1] if again else f"run {path}"
    fewer = list(without_disturbances(found))
    assert fewer
    for number, text in enumerate(fewer):
        less = path.with_name(f"fewer{number}.yaml")
        less.write_text(text)
        passed = subprocess.run(f"{PROGRAM} {words.replace(str(path), str(less))}", shell=True, cwd=hunts.FAULTS,
                                capture_output=True, text=True, check=False)
        assert passed.returncode == 0, text + passed.stdout


def test_findings_beside_a_host_do_not_depend_on_the_number_of_jobs(tmp_path):
    fault = fault_called("stale_busy_bit", tmp_path)
    texts = []
    for jobs in "1", "3":
        folder = tmp_path / jobs
        said = hunted(fault, "careless", folder, 60, "--jobs", jobs)
        found = [path.read_text() for path in sorted(folder.glob("found/*.yaml"))]
        # The checksum also covers the folder's name.
        texts.append([re.sub(r"/[13]/|# The next hunt .*", "/", text) for text in found])
        texts.append(said.stdout.replace(str(folder), "").splitlines())
    assert texts[0] and texts[0] == texts[2]
    assert texts[1] == texts[3]


def test_the_host_of_the_page(tmp_path):
    if not shutil.which("mbpoll"):
        pytest.skip("mbpoll is not installed")
    (tmp_path / "one_move.yaml").write_text(snippets("hunt.md", "yaml")[1])
    path = f"{PROGRAM.parent}:{os.environ['PATH']}"
    said = subprocess.run(["bash", "-ec", snippets("hunt.md", "sh")[2]], cwd=tmp_path, capture_output=True, text=True,
                          env=dict(os.environ, PATH=path), check=False)
    assert said.returncode == 0, said.stdout + said.stderr
    printed = [text for text in snippets("hunt.md", "text") if "one_move" in text]
    assert len(printed) == 1 and printed[0] in said.stdout, said.stdout
    assert "--host-time -- sh one_move.sh" in said.stdout, said.stdout
    found = list((tmp_path / "found").glob("*.yaml"))
    assert len(found) == 1 and found[0].read_text() in said.stdout, said.stdout
    assert "  - inject: { drop: feeder, of: reply, nth: 3 }  # disturbance 1 of 1\n" in found[0].read_text()
    assert "(feeder.A.pulses is 1600)" in said.stdout, said.stdout


@pytest.mark.parametrize("words, message", [
    (["--courses", "0"], "--courses: 0 is too few; expected 1 or more"),
    (["--", "true"], "uses a line, which belongs to the host program"),
    (["--", "./no_such_program"], "./no_such_program: cannot be started; expected a program"),
])
def test_what_cannot_be_hunted_is_refused(words, message, tmp_path):
    said = subprocess.run([PROGRAM, "hunt", hunts.FAULTS / "bouncing_press.yaml", *words], cwd=tmp_path,
                          capture_output=True, text=True, check=False)
    assert said.returncode in (2, 127)
    assert message in said.stderr


def test_a_scenario_with_a_host_needs_a_command(tmp_path):
    said = subprocess.run([PROGRAM, "hunt", hunts.FAULTS / "double_move.yaml"], cwd=tmp_path, capture_output=True,
                          text=True, check=False)
    assert said.returncode == 2
    assert "-- COMMAND`" in said.stderr and "understudy hunt" in said.stderr


def test_the_option_of_a_choice_is_in_the_finding(tmp_path):
    text = (hunts.FAULTS / "bouncing_press.yaml").read_text()
    text = text.replace("\nsteps:", "\nchoice: { exceptions: [ no_answer ] }\nsteps:")
    (tmp_path / "press.yaml").write_text(text)
    subprocess.run([PROGRAM, "hunt", "press.yaml", "--courses", "50"], cwd=tmp_path, capture_output=True, check=False)
    found = next((tmp_path / "found").glob("*.yaml"))
    assert "\nchoice: { exceptions: [ no_answer ] }\n" in found.read_text()
    assert subprocess.run([PROGRAM, "run", found], capture_output=True, check=False).returncode == 1


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
