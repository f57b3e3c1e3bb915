"""Tests the wheel, and the Debian package that is made from it."""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import zipfile

import pytest

PROJECT = pathlib.Path(__file__).parents[2]
VERSION = re.search(r"project\(understudy VERSION (\S+)", (PROJECT / "CMakeLists.txt").read_text()).group(1)


def built(script, folder):
    for module in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"python3-{module} is not installed")
    done = subprocess.run([PROJECT / "packaging" / script, str(folder)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return pathlib.Path(done.stdout.strip())


def test_the_wheel_has_the_programs_version_and_the_plugin(tmp_path):
    wheel = built("wheel.sh", tmp_path)
    assert wheel.name == f"understudy-{VERSION}-py3-none-any.whl"
    with zipfile.ZipFile(wheel) as whole:
        names = whole.namelist()
        points = whole.read(f"understudy-{VERSION}.dist-info/entry_points.txt").decode()
    modules = {f"understudy/{file.name}" for file in (PROJECT / "python/understudy").iterdir() if file.is_file()}
    assert modules == {name for name in names if name.startswith("understudy/")}
    assert f"understudy-{VERSION}.dist-info/LICENSE" in names
    assert points.split() == ["[pytest11]", "understudy.pytest_plugin", "=", "understudy.pytest_plugin"]


def test_the_wheel_unpacked_gives_pytest_its_fixtures(tmp_path):
    wheel = built("wheel.sh", tmp_path)
    with zipfile.ZipFile(wheel) as whole:
        whole.extractall(tmp_path / "modules")
    (tmp_path / "test_it.py").write_text("def test_it(bench): assert bench.advance('1ms') == 1_000_000\n")
    for flags in ([], ["-p", "understudy.pytest_plugin"]):
        done = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *flags, "test_it.py"],
                              cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path / "modules")},
                              capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stdout + done.stderr


def test_equal_input_gives_equal_bytes(tmp_path):
    assert built("wheel.sh", tmp_path / "a").read_bytes() == built("wheel.sh", tmp_path / "b").read_bytes()


def test_the_package_of_debian(tmp_path):
    deb = built("python_deb.sh", tmp_path)
    assert deb.name == f"python3-understudy_{VERSION}-1_all.deb"
    listed = subprocess.run(["dpkg-deb", "-c", deb], capture_output=True, text=True, check=True).stdout
    for file in ("understudy/bench.py", "understudy/py.typed", f"understudy-{VERSION}.dist-info/entry_points.txt"):
        assert f"./usr/lib/python3/dist-packages/{file}\n" in listed
