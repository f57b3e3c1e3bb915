#!/usr/bin/env python3
"""Refuses circles of includes between folders, and therefore between rooms.

usage: no_circles.py PROJECT [EXTRA_EDGE...]      an edge is FOLDER:FOLDER, and counts as an include
       no_circles.py PROJECT --calls FOLDER       shows calls of members that form circles of files

The configuration of the build checks the dependencies between rooms (cmake/rooms.cmake); this script checks the folders
inside a room. It prints a line for each circle and exits with 1. It only shows circles by calls; growth.py has the
limits of their sizes.
"""
import collections
import os
import re
import sys

sys.dont_write_bytecode = True  # leaves no files in this project's folders
import member_calls  # noqa: E402
import outline  # noqa: E402

HOUSE = ("base", "motion", "interpreter", "pty", "emulator")
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


def files_of(project):
    for room in HOUSE:
        for folder, _, names in os.walk(os.path.join(project, room)):
            for name in sorted(names):
                if name.endswith((".h", ".cpp")):
                    yield os.path.relpath(os.path.join(folder, name), project)


def edges_of(project):
    known = set(files_of(project))
    edges = collections.defaultdict(dict)  # folder -> folder -> the include that shows it
    for path in sorted(known):
        with open(os.path.join(project, path), encoding="utf-8") as file:
            for included in INCLUDE.findall(file.read()):
                here, there = os.path.dirname(path), os.path.dirname(included)
                if included in known and here != there:
                    edges[here].setdefault(there, f"{path} includes {included}")
    return edges


def circles_of(edges):
    """Returns the groups of folders, or of files, that reach each other (Tarjan)."""
    order, lowest, waiting, circles = {}, {}, [], []

    def visit(folder):
        order[folder] = lowest[folder] = len(order)
        waiting.append(folder)
        for other in sorted(edges.get(folder, {})):
            if other not in order:
                visit(other)
                lowest[folder] = min(lowest[folder], lowest[other])
            elif other in waiting:
                lowest[folder] = min(lowest[folder], order[other])
        if lowest[folder] == order[folder]:
            circle = []
            while not circle or circle[-1] != folder:
                circle.append(waiting.pop())
            if len(circle) > 1:
                circles.append(sorted(circle))

    for folder in sorted(edges):
        if folder not in order:
            visit(folder)
    return circles


def show(circles, edges, what):
    for circle in circles:
        print(f"a circle of {len(circle)} {what}: {' '.join(circle)}")
        for here in circle:
            for there, shown_by in sorted(edges[here].items()):
                if there in circle:
                    print(f"  {shown_by}")


def show_calls(project, folder):
    outlines = {}
    for path in files_of(project):
        if os.path.dirname(path) == folder.rstrip("/"):
            with open(os.path.join(project, path), encoding="utf-8") as file:
                outlines[os.path.basename(path)] = outline.Outline(file.read())
    if not outlines:
        print(f"{folder}: holds no sources; expected a folder of the house, such as emulator/models/slim")
        return 1
    edges = member_calls.calls_of(outlines)
    show(circles_of(edges), edges, "files")
    return 0


def main(project, extra):
    if extra[:1] == ["--calls"] and len(extra) == 2:
        return show_calls(project, extra[1])
    edges = edges_of(project)
    if len(edges) < 10:
        print(f"{project}: found no house; expected the project's root")
        return 1
    for edge in extra:
        here, there = edge.split(":")
        edges[here].setdefault(there, f"{here} includes {there}, as asked")
    circles = circles_of(edges)
    show(circles, edges, "folders")
    return 1 if circles else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
