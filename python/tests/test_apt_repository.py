"""Tests the signed apt repository with apt itself, in separate folders."""
import pathlib
import shutil
import subprocess

import pytest

PROJECT = pathlib.Path(__file__).parents[2]


@pytest.fixture(name="deb")
def small_deb(tmp_path):
    for tool in ("apt-get", "dpkg-scanpackages", "gpg"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is not installed")
    root = tmp_path / "root"
    (root / "DEBIAN").mkdir(parents=True)
    (root / "DEBIAN/control").write_text("Package: understudy\nVersion: 9.8.7-1\nArchitecture: all\n"
                                         "Maintainer: nobody <nobody@understudy.invalid>\nDescription: small\n")
    deb = tmp_path / "understudy_9.8.7-1_all.deb"
    subprocess.run(["dpkg-deb", "--build", root, deb], check=True, capture_output=True)
    return deb


def repository(folder, *parts):
    return subprocess.run([PROJECT / "packaging/apt_repository.sh", str(folder), *parts], capture_output=True, text=True,
                          timeout=120)


class Apt:
    """An apt-get with a single source."""

    def __init__(self, folder, source):
        for part in ("state/lists/partial", "cache/archives/partial", "etc/apt.conf.d", "etc/preferences.d",
                     "etc/trusted.gpg.d"):
            (folder / part).mkdir(parents=True)
        (folder / "sources").write_text(source + "\n")
        (folder / "status").write_text("")
        self.folder = folder
        self.flags = [f"-oDir::State={folder}/state", f"-oDir::State::status={folder}/status",
                      f"-oDir::Cache={folder}/cache", f"-oDir::Etc={folder}/etc",
                      f"-oDir::Etc::sourcelist={folder}/sources", "-oDir::Etc::sourceparts=-",
                      "-oAPT::Sandbox::User="]

    def get(self, *words):
        return subprocess.run(["apt-get", "-q", *self.flags, *words], cwd=self.folder, capture_output=True, text=True,
                              timeout=120)


def test_apt_takes_what_is_signed_and_nothing_else(tmp_path, deb):
    folder = tmp_path / "repository"
    made = repository(folder, f"bookworm={deb}", f"trixie={deb}")
    assert made.returncode == 0, made.stderr
    assert made.stdout == f"deb [signed-by={folder}/understudy.gpg] file:{folder} SUITE/\n"
    apt = Apt(tmp_path / "apt", made.stdout.strip().replace("SUITE", "trixie"))
    updated = apt.get("update")
    assert updated.returncode == 0 and "W:" not in updated.stderr, updated.stderr
    taken = apt.get("download", "understudy")
    assert taken.returncode == 0, taken.stderr
    assert (tmp_path / "apt" / deb.name).read_bytes() == deb.read_bytes()

    signed = (folder / "trixie/InRelease").read_text()
    (folder / "trixie/InRelease").write_text(signed.replace("Label: Understudy", "Label: Overstudy"))
    (folder / "trixie/Release.gpg").unlink()
    another = Apt(tmp_path / "another", made.stdout.strip().replace("SUITE", "trixie"))
    refused = another.get("update")
    assert refused.returncode != 0 and "BADSIG" in refused.stderr, refused.stderr
    assert another.get("download", "understudy").returncode != 0


@pytest.mark.parametrize("words", [(), ("bookworm",), ("bookworm=missing.deb",)])
def test_a_wrong_call_is_reported_in_one_line(tmp_path, deb, words):
    refused = repository(tmp_path / "repository", *words)
    assert refused.returncode == 1
    assert refused.stderr.startswith("apt_repository.sh: ") and refused.stderr.count("\n") == 1, (refused.stderr, deb)
