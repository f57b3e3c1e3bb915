"""Tests the files for CI systems and labgrid: their commands are run, except those that need a service."""
import importlib.util
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile

import pytest

yaml = pytest.importorskip("yaml")
PROJECT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("UNDERSTUDY_PROGRAM", "understudy")


def run_as_ci(command, folder, **environment):
    (folder / "tests").mkdir()
    (folder / "tests/one.yaml").write_text(
        "understudy: 1\nbench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
        "steps:\n  - expect: { feeder.Aaxis_Speed: 0 }\n")
    (folder / "bin").mkdir()
    (folder / "bin/understudy").symlink_to(shutil.which(PROGRAM))
    path = f"{folder / 'bin'}:{os.environ['PATH']}"
    done = subprocess.run(["bash", "-ec", command], cwd=folder, env={**os.environ, "PATH": path, **environment},
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "1 passed, 0 failed" in done.stdout
    assert {"results.xml", "report.html", "recordings"} <= set(os.listdir(folder))


def test_the_action_of_github(tmp_path):
    action = yaml.safe_load((PROJECT / "recipes/ci/github/action.yml").read_text())
    step = action["runs"]["steps"][1]
    values = {name: text["default"] for name, text in action["inputs"].items()}
    environment = {name: values[value.split("inputs.")[1].rstrip(" }")] for name, value in step["env"].items()}
    run_as_ci(step["run"], tmp_path, **environment)


def test_the_component_of_gitlab(tmp_path):
    spec, jobs = yaml.safe_load_all((PROJECT / "recipes/ci/gitlab.yml").read_text())
    (command,) = jobs["understudy"]["script"]
    for name, said in spec["spec"]["inputs"].items():
        command = command.replace(f"$[[ inputs.{name} ]]", str(said["default"]))
    assert "$[[" not in command
    run_as_ci(command, tmp_path)


@pytest.mark.parametrize("file, flag", [("env.yaml", "--link=./feeder.port"), ("network.yaml", "--listen=rtu://:PORT")])
def test_labgrid_opens_the_port(file, flag):
    if importlib.util.find_spec("labgrid") is None:
        pytest.skip("python3-labgrid is not installed")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="labgrid-"))
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        port = str(held.getsockname()[1])
    served = subprocess.Popen([PROGRAM, "serve", "--model", "simple2-r3", flag.replace("PORT", port)], cwd=folder,
                              stdout=subprocess.PIPE, text=True)
    try:
        text = (PROJECT / "examples/labgrid" / file).read_text()
        (folder / file).write_text(text.replace("5020", port))
        shutil.copy(PROJECT / "examples/labgrid/read_code.py", folder)
        assert served.stdout.readline().startswith("ready ")
        named = [] if file == "env.yaml" else [file]
        done = subprocess.run([sys.executable, folder / "read_code.py", *named], cwd=folder, capture_output=True,
                              text=True, timeout=30)
        assert done.stdout == "01 03 02 c0 01 29 84\n", done.stderr  # HW_Code is 0xC001, then its CRC
    finally:
        served.terminate()
        served.communicate()
        shutil.rmtree(folder)
