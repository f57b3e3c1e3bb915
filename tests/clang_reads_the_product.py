#!/usr/bin/python3
"""Every source file of the product, read by clang as well (syntax and types only, so it costs little).

usage: clang_reads_the_product.py COMPILE_COMMANDS.json SOURCE_FOLDER

The build for fuzzing is clang's; what only g++ takes would break it unseen. Prints what clang says, and how many
files it read. Exit 0: it took them all; 77: there is no clang here.
"""
import collections
import concurrent.futures
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ONLY_GCC = ("-Wno-restrict", "-Wno-maybe-uninitialized", "-fpch-preprocess", "-Wno-array-bounds",
            "-Wno-stringop-overflow")


def each_alone(entry):
    """A file that the build compiles together with others is read alone: it has to include what it needs."""
    if "/Unity/" not in entry["file"]:
        return [entry]
    with open(entry["file"], encoding="utf-8") as file:
        parts = re.findall(r'^#include "(.+)"', file.read(), re.MULTILINE)
    return [entry | {"file": part, "command": entry["command"].replace(entry["file"], part)} for part in parts]


def reading(entry, clang):
    """The compiler's own command, as clang's, with nothing written."""
    words = shlex.split(entry["command"])
    compiler = next(i for i, word in enumerate(words) if os.path.basename(word).split("-")[0] in ("c++", "g++", "clang++"))
    words = words[compiler + 1:]
    words.remove("-c")
    at = words.index("-o")
    del words[at:at + 2]
    words = [word for word in words if word not in ONLY_GCC and not word.startswith("-O")]
    return [clang, "-fsyntax-only"] + words


def read_once(entries, clang, folder):
    """The standard headers that many files include, as one that clang has read: most of the time goes into them. Whether
    each file includes those that it needs is what the preset `tidy` looks at."""
    counts = collections.Counter()
    for entry in entries:
        with open(entry["file"], encoding="utf-8") as file:
            counts.update(set(re.findall(r"^#include <([a-z_]+)>$", file.read(), re.MULTILINE)))
    header = os.path.join(folder, "often.h")
    with open(header, "w", encoding="utf-8") as file:
        file.writelines(f"#include <{name}>\n" for name in sorted(counts) if counts[name] >= 5)
    words = ["-std=c++20", "-x", "c++-header", header, "-o", header + ".pch"]
    subprocess.run([clang] + words, check=True)
    return ["-include-pch", header + ".pch"]


def main():
    commands, folder = sys.argv[1], os.path.abspath(sys.argv[2])
    clang = shutil.which("clang++") or shutil.which("clang++-14")
    if not clang:
        print("skipped: clang++ is not installed")
        return 77
    with open(commands, encoding="utf-8") as file:
        entries = json.load(file)
    rooms = ("base", "motion", "interpreter", "pty", "emulator", "tests/fuzz")
    entries = [alone for entry in entries for alone in each_alone(entry)]
    entries = {e["file"]: e for e in entries if os.path.relpath(e["file"], folder).startswith(tuple(r + "/" for r in rooms))}

    often = tempfile.TemporaryDirectory()
    known = read_once(entries.values(), clang, often.name)

    def read(entry):
        words = reading(entry, clang)
        if "-fno-exceptions" not in words:
            words += known
        run = subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True, check=False)
        return run.returncode, run.stderr

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for code, text in pool.map(read, entries.values()):
            sys.stdout.write(text)
            failed += code != 0
    print(f"clang has read {len(entries)} files, {failed} of them with errors")
    return 1 if failed or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
