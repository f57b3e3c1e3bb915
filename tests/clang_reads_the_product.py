#!/usr/bin/python3
"""Every source file of the product, read by clang as well (syntax and types only, so it costs little).

usage: clang_reads_the_product.py COMPILE_COMMANDS.json SOURCE_FOLDER

The build for fuzzing is clang's; what only g++ takes would break it unseen. Prints what clang says, and how many
files it read. Exit 0: it took them all; 77: there is no clang here.
"""
import concurrent.futures
import json
import os
import shlex
import shutil
import subprocess
import sys

ONLY_GCC = ("-Wno-restrict", "-Wno-maybe-uninitialized", "-fpch-preprocess", "-Wno-array-bounds",
            "-Wno-stringop-overflow")

ROOMS = ("base", "motion", "interpreter", "pty", "emulator", "tests/fuzz")


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


def is_of_the_product(file, commands, folder):
    built = os.path.relpath(file, os.path.dirname(os.path.abspath(commands)))
    path = os.path.relpath(file, folder) if built.startswith("..") else built
    return path.startswith(tuple(room + "/" for room in ROOMS))


def main():
    commands, folder = sys.argv[1], os.path.abspath(sys.argv[2])
    clang = shutil.which("clang++") or shutil.which("clang++-14")
    if not clang:
        print("skipped: clang++ is not installed")
        return 77
    with open(commands, encoding="utf-8") as file:
        entries = json.load(file)
    # What the build compiles together is read together. That each file includes what it needs, the preset `tidy` sees.
    entries = {e["file"]: e for e in entries if is_of_the_product(e["file"], commands, folder)}

    def read(entry):
        run = subprocess.run(reading(entry, clang), cwd=entry["directory"], capture_output=True, text=True, check=False)
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
