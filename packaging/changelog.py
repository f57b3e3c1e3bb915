#!/usr/bin/env python3
"""Makes the changelog from fragments: changes/NAME.KIND.md describes one change for users.

usage: changelog.py check [--since COMMIT]    are the fragments and CHANGELOG.md well formed?
       changelog.py show                      print the section of the changes that are not released yet
       changelog.py release VERSION [DATE]    write that section into CHANGELOG.md, and remove the fragments

With --since, `check` also requires a new or changed fragment if the product has changed since that commit.
CONTRIBUTING.md says how to write a fragment. Prints a line for each fault, and then exits with 1.
"""
import datetime
import os
import re
import subprocess
import sys

KINDS = {"added": "Added", "changed": "Changed", "deprecated": "Deprecated", "removed": "Removed",
         "fixed": "Fixed", "security": "Security"}  # the kinds and order of keepachangelog.com
FRAGMENT = re.compile(rf"[a-z0-9][a-z0-9-]*\.({'|'.join(KINDS)})\.md")
NOT_FRAGMENTS = ("README.md",)
WIDTH = 120
HEADING = re.compile(r"## (\d+)\.(\d+)\.(\d+) \((\d{4}-\d{2}-\d{2})\)")
PRODUCT = ("base/", "motion/", "interpreter/", "pty/", "emulator/", "python/understudy/")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def fragments_of(project):
    """Yields (kind, path below the project, text) of each fragment, sorted by name."""
    folder = os.path.join(project, "changes")
    names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
    for name in names:
        found = FRAGMENT.fullmatch(name)
        if found:
            yield found.group(1), f"changes/{name}", read(os.path.join(folder, name))


def faults_of_names(project):
    folder = os.path.join(project, "changes")
    for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
        if name not in NOT_FRAGMENTS and not FRAGMENT.fullmatch(name):
            yield f"changes/{name}", 1, ("is not the name of a fragment; expected NAME.KIND.md, NAME of lower-case letters, "
                                         f"digits and '-', KIND one of {', '.join(KINDS)}")


def faults_of_fragment(text):
    """Yields (line, what is wrong and what was expected)."""
    lines = text.split("\n")
    if not text.strip():
        yield 1, "is empty; expected what changes for a user, in a sentence or a few"
        return
    if lines[-1] != "" or (len(lines) > 1 and lines[-2] == ""):
        yield len(lines), "does not end with one newline; expected it to"
    if not re.match(r"[A-Z`*]", text):
        yield 1, "does not begin with a capital, a `name` or a **subject**; expected one of them"
    if not text.rstrip().endswith((".", ")", "`")):
        yield len(lines), "does not end as a sentence does; expected a full stop"
    for number, line in enumerate(lines, 1):
        if len(line) > WIDTH - 2:  # a bullet indents it by two
            yield number, f"is {len(line)} characters wide; expected at most {WIDTH - 2}"
        if line.startswith(("#", "-", "* ")):
            yield number, "is a heading or a bullet; expected prose: one fragment is one bullet"


def faults_of_changelog(text, version):
    """Yields (line, what is wrong and what was expected); `version` is the project's version."""
    last = None
    kinds = []
    for number, line in enumerate(text.split("\n"), 1):
        if len(line) > WIDTH:
            yield number, f"is {len(line)} characters wide; expected at most {WIDTH}"
        if line.startswith("## "):
            found = HEADING.fullmatch(line)
            if not found:
                yield number, "is not a release's heading; expected `## VERSION (YEAR-MONTH-DAY)`"
                continue
            numbers = tuple(int(found.group(i)) for i in (1, 2, 3))
            if last is None and numbers > version:
                yield number, f"is newer than the project's version; expected at most {'.'.join(map(str, version))}"
            if last is not None and numbers >= last:
                yield number, "is not older than the release above it; expected the newest first"
            last, kinds = numbers, []
        elif line.startswith("### "):
            if line[4:] not in KINDS.values():
                yield number, f"is not a kind of change; expected one of {', '.join(KINDS.values())}"
            elif line in kinds:
                yield number, "appears twice in one release; expected it only once"
            kinds.append(line)


def version_of(project):
    found = re.search(r"project\(\w+ VERSION (\d+)\.(\d+)\.(\d+)", read(os.path.join(project, "CMakeLists.txt")))
    return tuple(int(number) for number in found.groups())


def faults_since(project, commit):
    said = subprocess.run(["git", "diff", "--name-only", f"{commit}...HEAD"], cwd=project, capture_output=True, text=True)
    if said.returncode != 0:
        yield "changes", 1, f"cannot be compared with {commit}; expected a commit (git: {said.stderr.strip()})"
        return
    changed = said.stdout.split("\n")
    touched = [path for path in changed if path.startswith(PRODUCT) and os.path.basename(path) != "CMakeLists.txt"]
    if touched and not any(path.startswith("changes/") or path == "CHANGELOG.md" for path in changed):
        yield "changes", 1, (f"has nothing new since {commit}, but {touched[0]} has changed; expected a fragment, if a user "
                             "can notice the change (CONTRIBUTING.md)")


def faults_of(project):
    """Yields (path, line, what is wrong and what was expected) for all fragments and the changelog, if it exists."""
    yield from faults_of_names(project)
    for _, path, text in fragments_of(project):
        yield from ((path, line, what) for line, what in faults_of_fragment(text))
    changelog = os.path.join(project, "CHANGELOG.md")
    if os.path.exists(changelog):
        faults = faults_of_changelog(read(changelog), version_of(project))
        yield from (("CHANGELOG.md", line, what) for line, what in faults)


def section_of(project, heading):
    parts = [heading]
    fragments = list(fragments_of(project))
    for kind, title in KINDS.items():
        bullets = ["- " + text.strip().replace("\n", "\n  ") for of_kind, _, text in fragments if of_kind == kind]
        if bullets:
            parts.append(f"### {title}\n\n" + "\n".join(bullets))
    return "\n\n".join(parts) + "\n"


def release(project, version, date):
    """Writes the section, or returns the faults that prevent it, like faults_of()."""
    faults = list(faults_of(project))
    expected = ".".join(map(str, version_of(project)))
    if version != expected:
        faults.append(("CMakeLists.txt", 1, f"has version {expected}; expected {version}: set it first"))
    path = os.path.join(project, "CHANGELOG.md")
    before, mark, after = read(path).partition("\n## ")
    if after.startswith(version + " "):
        faults.append(("CHANGELOG.md", 1, f"already has a section for {version}; expected a version that is not released"))
    if not list(fragments_of(project)):
        faults.append(("changes", 1, "has no fragment; expected at least one"))
    if faults:
        return faults
    with open(path, "w", encoding="utf-8") as file:
        file.write(before + "\n" + section_of(project, f"## {version} ({date})") + mark + after)
    for _, fragment, _ in list(fragments_of(project)):
        os.remove(os.path.join(project, fragment))
    return []


def main(words, project):
    if words[:1] == ["show"] and len(words) == 1:
        print(section_of(project, "## Unreleased"), end="")
        faults = []
    elif words[:1] == ["release"] and len(words) in (2, 3):
        faults = release(project, words[1], words[2] if len(words) == 3 else datetime.date.today().isoformat())
    elif words == ["check"] or (words[:2] == ["check", "--since"] and len(words) == 3):
        faults = list(faults_of(project))
        if len(words) == 3:
            faults += faults_since(project, words[2])
    else:
        print(__doc__, file=sys.stderr)
        return 2
    for path, line, what in faults:
        print(f"{path}:{line}: {what}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
