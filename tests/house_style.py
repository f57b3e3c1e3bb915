#!/usr/bin/env python3
"""Checks the sources before ./test builds anything: the formatting, a few rules of style, the wording of the
documentation and of --help (plain_words.py), the changelog and its fragments (packaging/changelog.py), the files in
.github/ (github_files.py), the syntax of the page's scripts (page_scripts.py), and the sizes of circles of files,
classes and functions (growth.py).

usage: house_style.py [PROJECT]

Prints a line for each fault, "file:line: what is wrong; what was expected", and at the end the largest circle, class
and function. The exit code is 1 if there is a fault.
"""
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # leaves no files in this project's folders
sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "packaging"))
import changelog  # noqa: E402
import github_files  # noqa: E402
import growth  # noqa: E402
import page_scripts  # noqa: E402
import plain_words  # noqa: E402

LONGEST_FILE = 450  # lines; about 400 is the aim
LONGEST_TEST_NAME = 50
PRODUCT = ("base/", "motion/", "interpreter/", "pty/", "emulator/")
TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P)\((\w+), *(\w+)\)")
FOREIGN = [  # phrases in messages and comments of the product that a native speaker would not write, and replacements
    (re.compile(r'"[^"]*(?<!here )\bis no (?!longer|more|other|less|better|such)\w'), '"X is not a Y" for "X is no Y"'),
    (re.compile(r"\b(?:to|cannot|can|could not|could) be had\b"), '"is available", "can be opened" for "can be had"'),
    (re.compile(r"\b(?:two|three|four) there (?:is|are)\b", re.IGNORECASE), '"There are two" for "Two there are"'),
    (re.compile(r"\bso manieth\b"), '"one in this many" for "every so manieth"'),
    (re.compile(r"\bclock on the wall\b"), '"wall clock" for "clock on the wall"'),
    (re.compile(r"\bis there twice\b"), '"appears twice" for "is there twice"'),
    (re.compile(r"\bfor so long\b"), '"this long" for "for so long"'),
    (re.compile(r"\bthat there (?:is|are) not\b"), '"that does not exist" for "that there is not"'),
    (re.compile(r"\bone of both\b"), '"one of the two" for "one of both"'),
    (re.compile(r"\bless than (?:nothing|never)\b"), '"negative" for "less than nothing"'),
    (re.compile(r"//+ The same,? and nothing has changed"), '"Like check(); if it throws, nothing has changed"'),
]


def files_of(project):
    """Returns all sources below the folder. It does not need git, so it also works in a tarball."""
    found = []
    for folder, folders, names in os.walk(project):
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name != "build" and
                            not os.path.exists(os.path.join(folder, name, "CMakeCache.txt")))
        found += [os.path.relpath(os.path.join(folder, name), project) for name in sorted(names) if name.endswith((".h", ".cpp"))]
    return found


def faults_of_text(path, lines):
    if path.endswith(".h") and "#pragma once" not in lines:
        yield 1, "has no `#pragma once`; expected it behind the comment that begins the file"
    if len(lines) > LONGEST_FILE and not path.startswith(("tests/", "scenarios/", "docs/")):
        yield LONGEST_FILE, f"is {len(lines)} lines long; expected at most {LONGEST_FILE}, and one idea a file"
    for number, line in enumerate(lines, 1):
        test = TEST.match(line)
        if test and len(test.group(2)) > LONGEST_TEST_NAME:
            yield number, f"the test's name has {len(test.group(2))} letters; expected at most {LONGEST_TEST_NAME}"
        if test and not re.fullmatch(r"[A-Z0-9][A-Za-z0-9]*", test.group(2)):
            yield number, "the test's name is not in CamelCase; expected it to be"
        if path.endswith(".h") and line.startswith("using namespace"):
            yield number, "a header opens a namespace to whoever includes it; expected names in full"
        if path.startswith(PRODUCT):
            for foreign, better in FOREIGN:
                if foreign.search(line):
                    yield number, f"is not what a native speaker would write; expected {better}"


def badly_formatted(project, paths):
    program = shutil.which("clang-format")
    if program is None:
        return ["clang-format: is not installed; expected it (apt-get install clang-format)"]

    def look(some):
        said = subprocess.run([program, "--dry-run", "-Werror", *some], cwd=project, capture_output=True, text=True)
        found = re.findall(r"^(\S+?:\d+):\d+: error:", said.stderr, re.MULTILINE)
        return [f"{place}: is not formatted; expected what `clang-format -i` makes of it" for place in found]

    share = max(1, len(paths) // (4 * (os.cpu_count() or 1)))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        told = [line for lines in pool.map(look, [paths[i:i + share] for i in range(0, len(paths), share)]) for line in lines]
    first = {}
    for line in told:  # one finding per file is enough
        first.setdefault(line.split(":")[0], line)
    return list(first.values())


def main(project):
    paths = files_of(project)
    faults = badly_formatted(project, paths)
    for path in paths:
        with open(os.path.join(project, path), encoding="utf-8") as file:
            faults += [f"{path}:{number}: {what}" for number, what in faults_of_text(path, file.read().split("\n"))]
    judges = (plain_words, changelog, github_files, page_scripts)
    for place, number, what in (fault for judge in judges for fault in judge.faults_of(project)):
        faults.append(f"{place}:{number}: {what}")
    figures = growth.figures_of(project)
    faults += [f"{place}:{number}: {what}" for place, number, what in growth.faults_of(project, figures)]
    print("\n".join(faults) or f"{len(paths)} files: formatted, and as the house has it")
    for line in growth.largest(figures):
        print(line)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
