"""Tests packaging/changelog.py: what it refuses, and what it makes from fragments."""
import pathlib
import subprocess
import sys

import pytest

PROJECT = pathlib.Path(__file__).parents[2]
sys.path.append(str(PROJECT / "packaging"))
import changelog  # noqa: E402

FRAGMENTS = {"page.added.md": "**The page** shows axes.\n", "crash.fixed.md": "`run` crashed\nwithout a file.\n",
             "a-flag.added.md": "`--flag`.\n"}
OLD = "# Changelog\n\nAbout it.\n\n## 0.2.0 (2026-11-23)\n\n### Added\n\n- SLIM.\n"


@pytest.fixture
def project(tmp_path):
    (tmp_path / "CMakeLists.txt").write_text("project(understudy VERSION 0.3.0 LANGUAGES CXX\n")
    (tmp_path / "CHANGELOG.md").write_text(OLD)
    (tmp_path / "changes").mkdir()
    for name, text in FRAGMENTS.items():
        (tmp_path / "changes" / name).write_text(text)
    return tmp_path


def test_a_release_has_all_fragments_in_order(project, capsys):
    assert changelog.main(["release", "0.3.0", "2026-12-01"], project) == 0
    assert (project / "CHANGELOG.md").read_text() == (
        "# Changelog\n\nAbout it.\n\n## 0.3.0 (2026-12-01)\n\n### Added\n\n- `--flag`.\n- **The page** shows axes.\n\n"
        "### Fixed\n\n- `run` crashed\n  without a file.\n\n## 0.2.0 (2026-11-23)\n\n### Added\n\n- SLIM.\n")
    assert list((project / "changes").iterdir()) == []
    assert changelog.main(["check"], project) == 0
    assert changelog.main(["release", "0.3.0"], project) == 1, "it is there"


def test_show_changes_nothing(project, capsys):
    assert changelog.main(["show"], project) == 0
    assert capsys.readouterr().out.startswith("## Unreleased\n\n### Added\n\n- `--flag`.\n")
    assert (project / "CHANGELOG.md").read_text() == OLD and len(list((project / "changes").iterdir())) == 3


@pytest.mark.parametrize("name, text, fault", [
    ("page.new.md", "A page.\n", "changes/page.new.md:1: is not the name of a fragment; expected NAME.KIND.md"),
    ("Page.added.md", "A page.\n", "changes/Page.added.md:1: is not the name of a fragment"),
    ("x.added.md", "\n", "changes/x.added.md:1: is empty"),
    ("x.added.md", "a page.\n", "changes/x.added.md:1: does not begin with a capital"),
    ("x.added.md", "A page\n", "changes/x.added.md:2: does not end as a sentence does"),
    ("x.added.md", "A page.", "changes/x.added.md:1: does not end with one newline"),
    ("x.added.md", "A page.\n- Another.\n", "changes/x.added.md:2: is a heading or a bullet"),
    ("x.added.md", "A" + " page" * 24 + ".\n", "changes/x.added.md:1: is 122 characters wide; expected at most 118"),
])
def test_a_fragment_is_refused(project, capsys, name, text, fault):
    (project / "changes" / name).write_text(text)
    assert changelog.main(["check"], project) == 1
    assert capsys.readouterr().out.startswith(fault)


@pytest.mark.parametrize("text, fault", [
    (OLD.replace("(2026-11-23)", ""), "CHANGELOG.md:5: is not a release's heading"),
    (OLD.replace("0.2.0", "0.4.0"), "CHANGELOG.md:5: is newer than the project's version; expected at most 0.3.0"),
    (OLD + "\n## 0.2.1 (2026-11-24)\n", "CHANGELOG.md:11: is not older than the release above it"),
    (OLD.replace("Added", "New"), "CHANGELOG.md:7: is not a kind of change"),
    (OLD + "\n### Added\n", "CHANGELOG.md:11: appears twice in one release"),
])
def test_a_changelog_is_refused(project, capsys, text, fault):
    (project / "CHANGELOG.md").write_text(text)
    assert changelog.main(["check"], project) == 1
    assert capsys.readouterr().out.startswith(fault)


def test_a_change_of_the_product_needs_a_fragment(project, capsys):
    def git(*words):
        subprocess.run(["git", "-c", "user.name=x", "-c", "user.email=x@y", *words], cwd=project, check=True,
                       capture_output=True)
    try:
        git("init", "-q")
    except FileNotFoundError:
        pytest.skip("git is not installed")
    git("add", ".")
    git("commit", "-qm", "Begin")
    (project / "pty").mkdir()
    (project / "pty/port.cpp").write_text("int port;\n")
    git("add", ".")
    git("commit", "-qm", "Add a port")
    assert changelog.main(["check", "--since", "HEAD~"], project) == 1
    assert "pty/port.cpp has changed; expected a fragment" in capsys.readouterr().out
    (project / "changes/port.added.md").write_text("A port.\n")
    git("add", ".")
    git("commit", "-qm", "Tell of it")
    assert changelog.main(["check", "--since", "HEAD~2"], project) == 0
    assert changelog.main(["check", "--since", "nothing"], project) == 1


def test_what_it_does_not_understand_it_explains(project, capsys):
    assert changelog.main(["relaese"], project) == 2
    assert capsys.readouterr().err.startswith("Makes the changelog from fragments")
