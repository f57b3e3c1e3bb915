"""Tests the archive that runs anywhere, and the wheel and the image that contain the program."""
import fcntl
import gzip
import hashlib
import importlib.util
import io
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tarfile
import venv
import zipfile

import pytest

PROJECT = pathlib.Path(__file__).parents[2]
PROGRAM = pathlib.Path(os.environ.get("UNDERSTUDY_PROGRAM") or shutil.which("understudy") or "understudy").resolve()


def output_of(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=300, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    if not (PROGRAM.parent / "cmake_install.cmake").exists():
        pytest.skip(f"{PROGRAM.parent} is not a build folder")
    for tool in ("cmake", "objdump", "dpkg-query"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is not installed")
    # Packing takes seconds: the processes of xdist share one.
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent
    with open(folder / "portable.lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        there = list((folder / "portable").glob("*.tar.gz"))
        # A system that is newer than the archive's own is good enough for a test.
        return there[0] if there else pathlib.Path(
            output_of(PROJECT / "packaging/portable.sh", folder / "portable", PROGRAM.parent,
                    env={**os.environ, "UNDERSTUDY_ANY_GLIBC": "1"}))


@pytest.fixture(scope="module")
def tree(archive, tmp_path_factory):
    folder = tmp_path_factory.mktemp("a tree")
    with tarfile.open(archive) as whole:
        whole.extractall(folder)
    (found,) = folder.iterdir()
    assert found.name + ".tar.gz" == archive.name
    return found


def test_the_archive_is_small_and_runs_where_it_lies(archive, tree):
    assert archive.stat().st_size <= 5_000_000
    program = tree / "bin/understudy"
    loaded = dict(line.strip().split(" => ") for line in output_of("ldd", program).splitlines() if " => /" in line)
    own = {name for name, place in loaded.items() if str(tree) in place}
    assert own == {path.name for path in (tree / "lib/understudy").iterdir()} - {"tty_shim.so", "host_time.so"}
    assert "libmodbus.so.5" in own or "libmodbus.so.5" not in loaded
    assert output_of(program, "models") == output_of(PROGRAM, "models")
    assert output_of(program, "tty-shim") == str(tree / "lib/understudy/tty_shim.so")
    output_of(program, "run", tree / "share/understudy/scenarios/simple2-r3/absolute_positions.yaml")


def test_the_archive_has_pages_schemas_and_licences(tree):
    for file in ("README.md", "LICENSE", "CHANGELOG.md", "share/understudy/schemas/bench.schema.json",
                 "share/man/man1/understudy-serve.1.gz", "share/bash-completion/completions/understudy",
                 "share/understudy/recipes/ci/gitlab.yml", "licences/libmodbus5", "licences/LGPL-2.1", "licences/uplot"):
        assert (tree / file).stat().st_size > 0, file
    assert not [path for path in tree.rglob("*") if path.is_symlink()]


def test_the_archive_lists_its_parts(tree):
    parts = json.loads((tree / "sbom.cdx.json").read_text())
    assert (parts["bomFormat"], parts["specVersion"]) == ("CycloneDX", "1.5")
    assert parts["metadata"]["component"]["version"] == output_of(PROGRAM, "--version")
    versions = {part["name"]: part["version"] for part in parts["components"]}
    assert all(version[0].isdigit() for version in versions.values()), versions
    assert {"glibc", "libmodbus5", "libyaml-cpp-dev", "libsqlite3-dev", "htm", "preact", "uplot"} <= versions.keys()


def test_nothing_in_the_archive_tells_when_or_by_whom_it_was_packed(archive):
    with tarfile.open(archive) as whole:
        members = whole.getmembers()
    assert len({member.mtime for member in members}) == 1
    assert {(member.uid, member.gid, member.uname, member.gname) for member in members} == {(0, 0, "", "")}
    assert {member.mode for member in members} <= {0o755, 0o644}
    names = [member.name.encode() for member in members]
    assert names == sorted(names, key=lambda name: name.split(b"/"))
    assert archive.read_bytes()[4:8] == b"\0\0\0\0", "gzip keeps no time"


@pytest.fixture(scope="module")
def wheel(archive, tmp_path_factory):
    for module in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"python3-{module} is not installed")
    return pathlib.Path(output_of(sys.executable, PROJECT / "packaging/program_wheel.py", archive,
                                tmp_path_factory.mktemp("wheel")))


def test_the_wheel_says_what_it_needs(wheel, tree):
    glibc = json.loads((tree / "sbom.cdx.json").read_text())["components"][0]
    tag = f"manylinux_{glibc['version'].replace('.', '_')}_{os.uname().machine}"
    assert wheel.name.endswith(f"-py3-none-{tag}.whl")
    with zipfile.ZipFile(wheel) as whole:
        assert whole.testzip() is None
        said = whole.read(next(name for name in whole.namelist() if name.endswith(".dist-info/WHEEL"))).decode()
    assert f"Tag: py3-none-{tag}\n" in said and "Root-Is-Purelib: false\n" in said


def test_the_wheel_brings_program_client_and_plugin(wheel, tmp_path):
    venv.create(tmp_path / "v", system_site_packages=True)  # for pytest
    output_of(sys.executable, "-m", "pip", "--disable-pip-version-check", f"--python={tmp_path}/v/bin/python", "install",
            "-q", "--no-index", "--ignore-installed", wheel)
    assert output_of(tmp_path / "v/bin/understudy", "models") == output_of(PROGRAM, "models")
    (tmp_path / "test_it.py").write_text("import understudy, sys\n"
                                         "def test_it(bench):\n    assert bench.advance('1ms') == 1_000_000\n"
                                         "    assert understudy.__file__.startswith(sys.prefix)\n"
                                         "    from understudy.daemon import program_path\n"
                                         "    assert program_path() == sys.prefix + '/bin/understudy'\n")
    plain = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "UNDERSTUDY_PROGRAM")}
    output_of(tmp_path / "v/bin/python", "-m", "pytest", "-q", "-p", "no:cacheprovider", tmp_path / "test_it.py", env=plain,
            cwd=tmp_path)


@pytest.fixture(scope="module")
def image(archive, tmp_path_factory):
    return pathlib.Path(output_of(PROJECT / "packaging/oci_image.py", archive, tmp_path_factory.mktemp("image")))


def blobs_of(image):
    """Returns the blobs by their digests, and the manifest."""
    with tarfile.open(image) as whole:
        blobs = {f"sha256:{hashlib.sha256(content).hexdigest()}": content
                 for content in (whole.extractfile(member).read() for member in whole if member.isfile())}
        (named,) = json.load(whole.extractfile("index.json"))["manifests"]
        assert json.load(whole.extractfile("oci-layout")) == {"imageLayoutVersion": "1.0.0"}
    return blobs, json.loads(blobs[named["digest"]])


def test_the_image_holds_what_its_digests_name(image, archive, tmp_path):
    blobs, manifest = blobs_of(image)
    for part in (manifest["config"], *manifest["layers"]):
        assert len(blobs[part["digest"]]) == part["size"]
    layers = [gzip.decompress(blobs[part["digest"]]) for part in manifest["layers"]]
    config = json.loads(blobs[manifest["config"]["digest"]])
    assert config["rootfs"]["diff_ids"] == [f"sha256:{hashlib.sha256(layer).hexdigest()}" for layer in layers]
    again = output_of(PROJECT / "packaging/oci_image.py", archive, tmp_path)
    assert pathlib.Path(again).read_bytes() == image.read_bytes(), "equal archives make equal images"


def test_the_program_of_the_image_serves_from_its_own_root(image, tmp_path):
    if subprocess.run(["unshare", "--mount", "true"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
        pytest.skip("namespaces are not allowed here")
    blobs, manifest = blobs_of(image)
    for part in manifest["layers"]:
        with tarfile.open(fileobj=io.BytesIO(blobs[part["digest"]])) as layer:
            layer.extractall(tmp_path / "root")
    config = json.loads(blobs[manifest["config"]["digest"]])["config"]
    root = tmp_path / "root"
    command = ["unshare", "--mount", f"--mount-proc={root}/proc", "chroot", root, *config["Entrypoint"]]
    assert output_of(*command, "models") == output_of(PROGRAM, "models")
    output_of(*command, "run", "/opt/understudy/share/understudy/scenarios/simple2-r3/absolute_positions.yaml")
    arguments = [word.replace("0.0.0.0:5020", "127.0.0.1:0") for word in config["Cmd"]]
    with subprocess.Popen([*command, *arguments], stdout=subprocess.PIPE, text=True) as served:
        try:
            port = int(re.fullmatch(r"ready line modbus-tcp://127\.0\.0\.1:(\d+) .*\n", served.stdout.readline())[1])
            with socket.create_connection(("127.0.0.1", port), timeout=30) as host:
                host.sendall(bytes.fromhex("000700000006 01 0300010001"))
                assert host.recv(11, socket.MSG_WAITALL).hex() == "000700000005" "01" "0302c001"
        finally:
            served.terminate()
    assert served.returncode == 0


def test_a_file_that_is_no_archive_makes_no_image(tmp_path):
    refused = subprocess.run([PROJECT / "packaging/oci_image.py", tmp_path / "understudy-1-linux.tar.gz"],
                             capture_output=True, text=True, timeout=60)
    assert refused.returncode == 1
    assert refused.stderr.startswith("oci_image.py: ") and refused.stderr.count("\n") == 1, refused.stderr


def test_run_takes_the_program_of_an_archive_beside_it(tmp_path):
    project = tmp_path / "a project"
    for file in ("run", "packaging/debian_packages.sh"):
        (project / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(PROJECT / file, project / file)
    (project / "CMakeLists.txt").write_text("project(understudy VERSION 9.8.7)\n")
    # Nothing is installed by a test, and nothing can be built.
    quiet = {**os.environ, "PATH": f"{tmp_path}/bin:{os.environ['PATH']}"}
    (tmp_path / "bin").mkdir()
    for name, script in (("cmake", "echo cmake was called >&2; exit 1"), ("id", "echo 1000"), ("sudo", "exit 1")):
        (tmp_path / "bin" / name).write_text(f"#!/bin/sh\n{script}\n")
        (tmp_path / "bin" / name).chmod(0o755)

    def pack(version, says):
        name = f"understudy-{version}-linux-{os.uname().machine}"
        program = tmp_path / "tree" / name / "bin/understudy"
        program.parent.mkdir(parents=True)
        program.write_text(f"#!/bin/sh\n[ \"$1\" = --version ] && echo {version} || echo {says} \"$@\"\n")
        program.chmod(0o755)
        with tarfile.open(tmp_path / f"{name}.tar.gz", "w:gz") as whole:
            whole.add(tmp_path / "tree" / name, name)
        shutil.rmtree(tmp_path / "tree")

    pack("9.8.6", "old")
    failed = subprocess.run([project / "run", "models"], env=quiet, capture_output=True, text=True, timeout=60)
    assert (failed.returncode, "cmake was called" in failed.stderr) == (4, True), "another version is not taken"
    pack("9.8.7", "first")
    assert output_of(project / "run", "models", env=quiet) == "first models"
    pack("9.8.7", "second")
    assert output_of(project / "run", "models", env=quiet) == "second models", "a newer archive is unpacked again"
    built = project / "build/release/understudy"
    built.parent.mkdir(parents=True)
    built.write_text("")
    built.chmod(0o755)
    failed = subprocess.run([project / "run", "models"], env=quiet, capture_output=True, text=True, timeout=60)
    assert failed.returncode == 4, "what was built is kept up to date"
