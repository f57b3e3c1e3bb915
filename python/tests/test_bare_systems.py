"""Tests systems that lack common parts: a missing part is reported in one line, or is not needed."""
import os
import pathlib
import shutil
import subprocess

import pytest

PROJECT = pathlib.Path(__file__).parents[2]
PROGRAM = pathlib.Path(os.environ.get("UNDERSTUDY_PROGRAM") or shutil.which("understudy") or "understudy").resolve()
SCENARIO = PROJECT / "scenarios/simple2-r3/absolute_positions.yaml"


def play(mounts, *words, **environment):
    """Runs the program in a mount namespace after the mounts, which no other process sees."""
    inside = f"mount --make-rprivate / && {mounts} && exec \"$0\" \"$@\""
    return subprocess.run(["unshare", "--mount", "sh", "-c", inside, PROGRAM, *words], cwd="/", capture_output=True,
                          text=True, timeout=60, env={**os.environ, **environment})


@pytest.fixture(autouse=True)
def namespaces():
    if subprocess.run(["unshare", "--mount", "mount", "-t", "tmpfs", "tmpfs", "/mnt"], stderr=subprocess.DEVNULL,
                      check=False).returncode != 0:
        pytest.skip("mount namespaces are not allowed here")
    if any(str(path).startswith("/tmp/") for path in (PROGRAM, PROJECT)):
        pytest.skip("the program lies in /tmp, which these tests hide")


@pytest.mark.parametrize("mounts", ["mount -t tmpfs -o ro tmpfs /mnt", "mount -t tmpfs -o noexec tmpfs /tmp"],
                         ids=["read_only_home", "noexec_tmp"])
@pytest.mark.parametrize("words", [("run", SCENARIO), ("exec", "--model", "simple2-r3", "--tty-shim", "--", "true")],
                         ids=["run", "exec"])
def test_it_needs_no_home_and_starts_nothing_from_tmp(mounts, words):
    done = play(mounts, *words, HOME="/mnt")
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("mounts, words, said", [
    ("mount -t tmpfs tmpfs /dev/pts", ("serve", "--model", "simple2-r3"), "no pseudo-terminal is available"),
    ("mount -t tmpfs -o ro tmpfs /tmp", ("serve", "--model", "simple2-r3"), "expected a writable /tmp"),
    ("mount -t tmpfs -o ro tmpfs /mnt", ("run", SCENARIO, "--record", "/mnt/kept"), "/mnt/kept cannot be written"),
], ids=["no_dev_pts", "read_only_tmp", "read_only_folder"])
def test_what_is_missing_is_reported_in_one_line(mounts, words, said):
    done = play(mounts, *words)
    assert done.returncode == 3, done.stderr
    assert said in done.stderr and done.stderr.count("\n") == 1, done.stderr
    assert done.stdout == ""
