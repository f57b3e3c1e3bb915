"""Runs the hosts of docs/node.md with npm's packages."""
import os
import pathlib
import re
import shutil
import subprocess

import pytest

PAGE = pathlib.Path(__file__).parents[2] / "docs/node.md"
PROGRAM = pathlib.Path(os.environ.get("UNDERSTUDY_PROGRAM") or shutil.which("understudy") or "understudy").resolve()


@pytest.fixture(name="folder", scope="module")
def project(tmp_path_factory):
    if os.environ.get("UNDERSTUDY_HEAVY_HOSTS") != "1":
        pytest.skip("UNDERSTUDY_HEAVY_HOSTS=1 is not set (it fetches packages with npm)")
    for tool in ("npm", "node"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is not installed")
    folder = tmp_path_factory.mktemp("node")
    for name, content in re.findall(r"`([a-z.]+)`:\n\n```(?:js|json)\n(.*?)^```$", PAGE.read_text(), re.M | re.S):
        (folder / name).write_text(content)
    assert (folder / "package.json").exists() and (folder / "host.js").exists()
    subprocess.run(["npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", "jsmodbus@5"], cwd=folder, check=True,
                   capture_output=True, timeout=600)
    return folder


def play(folder, *command):
    path = f"{PROGRAM.parent}:{os.environ['PATH']}"
    return subprocess.run(command, cwd=folder, env={**os.environ, "PATH": path}, capture_output=True, text=True,
                          timeout=120)


def test_npm_test_moves_an_axis_with_modbus_serial(folder):
    tested = play(folder, "npm", "test")
    assert tested.returncode == 0 and "\n# pass 1\n" in tested.stdout, tested.stdout + tested.stderr


def test_jsmodbus_reads_over_modbus_tcp(folder):
    command = re.search(r"^understudy exec .* -- node host.js$", PAGE.read_text(), re.M)
    said = play(folder, *command.group(0).split())
    assert said.returncode == 0, said.stderr
    assert said.stdout.startswith("HW_Code c001\n") and "ILLEGAL DATA ADDRESS" in said.stdout
