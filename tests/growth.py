"""Measures the structure of the code: circles of files by calls of members, member functions of a class, and lines of a
function. Each figure has a limit. A table has the exceptions with their present figures, which they must not exceed, so
they can only shrink. An entry that is higher than its figure is refused as well.

growth.faults_of(project) yields (path, line, what is wrong and what was expected); growth.largest(project) yields a
line for the largest figure of each kind.
"""
import os

import member_calls
import no_circles
import outline

MODELS = "emulator/models"
ITSELF = "tests/growth.py"


class Rule:
    """`limit` applies to everything except `exceptions`; an entry may exceed its figure by `slack`."""

    def __init__(self, what, limit, slack, exceptions):
        self.what, self.limit, self.slack, self.exceptions = what, limit, slack, exceptions


CIRCLE = Rule("files in a circle by calls of members", 3, 0, {})
MEMBERS = Rule("member functions", 60, 2, {})
LINES = Rule("lines", 60, 4, {
    "motion/homing_tables.cpp super40nc_homing": 64,
})
RULES = (CIRCLE, MEMBERS, LINES)


class Figure:
    def __init__(self, rule, key, value, path, line=1):
        self.rule, self.key, self.value, self.path, self.line = rule, key, value, path, line


def outlines_of(project):
    for path in no_circles.files_of(project):
        with open(os.path.join(project, path), encoding="utf-8") as file:
            yield path, outline.Outline(file.read())


def circles_by_calls(outlines):
    """Yields the sizes of circles. The largest one of a folder has its name, the next one NAME (2), and so on."""
    folders = {}
    for path, one in outlines.items():
        folder, name = os.path.split(path)
        if path.startswith(MODELS + "/"):
            folders.setdefault(folder, {})[name] = one
    for folder, sources in sorted(folders.items()):
        circles = no_circles.circles_of(member_calls.calls_of(sources))
        for rank, circle in enumerate(sorted(circles, key=len, reverse=True), 1):
            yield Figure(CIRCLE, folder if rank == 1 else f"{folder} ({rank})", len(circle), folder)


def members_of_classes(outlines):
    for path, one in outlines.items():
        if path.startswith(MODELS + "/"):
            for name, declared in one.declared.items():
                yield Figure(MEMBERS, f"{path} {name}", len(declared), path, one.lines_of_class[name])


def lines_of_functions(outlines):
    """Yields the lengths of functions, except those that are mostly tables."""
    for path, one in outlines.items():
        for function in one.functions:
            if not function.is_table:
                yield Figure(LINES, f"{path} {function.full_name}", function.lines, path, function.line)


def figures_of(project):
    """Returns the largest figure of each key, in the order of rules and files."""
    outlines = dict(outlines_of(project))
    found = {}
    for measure in (circles_by_calls, members_of_classes, lines_of_functions):
        for figure in measure(outlines):
            known = found.get((figure.rule, figure.key))
            if known is None or known.value < figure.value:
                found[figure.rule, figure.key] = figure
    return list(found.values())


def fault_of(figure):
    """Returns the fault of a figure, with or without an entry, or None."""
    rule = figure.rule
    entry = rule.exceptions.get(figure.key)
    if figure.value > (rule.limit if entry is None else entry):
        return f"{figure.key} has {figure.value} {rule.what}; expected at most " + (
            f"{rule.limit}" if entry is None else f"{entry}, its entry in {ITSELF}")
    return None


def fault_of_entry(rule, key, value):
    """Returns the fault of an entry, or None. `value` is the present figure, or None if the name does not exist."""
    entry = rule.exceptions[key]
    if value is None:
        return f"the entry of {key} names nothing; delete it"
    if value <= rule.limit:
        return f"{key} has {value} {rule.what}, and needs no entry; delete it"
    if entry > value + rule.slack:
        return f"{key} has only {value} {rule.what}, and its entry says {entry}; lower it to {value}"
    return None


def line_of_entry(key):
    with open(os.path.abspath(__file__), encoding="utf-8") as file:
        return next((number for number, line in enumerate(file, 1) if f'"{key}"' in line), 1)


def faults_of(project, figures=None):
    figures = figures_of(project) if figures is None else figures
    for figure in figures:
        what = fault_of(figure)
        if what:
            yield figure.path, figure.line, what
    values = {(figure.rule, figure.key): figure.value for figure in figures}
    for rule in RULES if os.path.isdir(os.path.join(project, MODELS)) else ():
        for key in rule.exceptions:
            what = fault_of_entry(rule, key, values.get((rule, key)))
            if what:
                yield ITSELF, line_of_entry(key), what


def largest(figures):
    for rule in RULES:
        of_rule = [figure for figure in figures if figure.rule is rule]
        if of_rule:
            first = max(of_rule, key=lambda figure: figure.value)
            yield f"the most {rule.what}: {first.value}, {first.key}; the limit is {rule.limit}"
