"""Finds the files of a folder that call member functions defined in other files of the same folder.

calls_of(outlines) takes the folder's sources, {name: outline.Outline}, and returns {file: {other: the call that shows
it}}. A header and the source of the same name count as one file, under that name without its ending.

A call is `name(...)` in a member function of the class, `object.name(...)`, or `&Class::name`. An object is
recognized by its name if the file, or a header of the folder, declares it with the class in its type. Calls of other
objects are not counted.
"""
import collections
import os
import re

CALL = re.compile(r"(?P<receiver>\.|->)?\s*(?<![\w:~])(?P<name>~?[A-Za-z_]\w*)\s*\(")
POINTER = re.compile(r"&\s*(?:\w+::)*(\w+)::(\w+)\b(?!\s*\()")
OBJECT = r"(?<![\w:])(?<!class )(?<!struct )\b%s\b(?!::)[\w:<>,&*\s]*?(\w+)\s*[;={(,)\[:]"
ALIAS = re.compile(r"\bauto\b[&*\s]*(\w+)\s*[:=]\s*[*&]?(\w+)")
TYPE = re.compile(r"(?:[\w>](?:&&?|\*)|[^\s-]>|\b(?P<word>\w+))\s+$")  # as in `Type& name(`, not as in `a & name(`
BEFORE_A_CALL = {"return", "else", "do", "case", "throw", "co_return", "co_yield", "co_await", "and", "or", "not"}


def stem(name):
    return os.path.splitext(name)[0]


def is_declaration(before):
    """Returns whether a type precedes `name(`, so that the statement declares a variable."""
    found = TYPE.search(before)
    return bool(found) and found["word"] not in BEFORE_A_CALL


def bare_calls(body):
    """Yields the names that are called without an object, or through `this`."""
    for call in CALL.finditer(body):
        begin = max(0, call.start("name") - 60)
        if not call["receiver"] and not is_declaration(body[begin:call.start("name")]):
            yield call["name"]
        elif call["receiver"] and body[:call.start("receiver")].endswith("this"):
            yield call["name"]


def name_before(text, end):
    """Returns the last name before a dot, also in `chip(axis).step()` and `chips_[0].step()`."""
    while end and (text[end - 1].isspace() or text[end - 1] in ")]"):
        end -= 1
        if text[end] in ")]":
            depth = 1
            while end and depth:
                end -= 1
                depth += (text[end] in ")]") - (text[end] in "([")
    begin = end
    while begin and (text[begin - 1].isalnum() or text[begin - 1] == "_"):
        begin -= 1
    return text[begin:end]


def calls_of_objects(text):
    for call in CALL.finditer(text):
        if call["receiver"]:
            yield name_before(text, call.start("receiver")), call["name"]


class Folder:
    def __init__(self, outlines):
        self.outlines = dict(sorted(outlines.items()))
        self.bases = collections.defaultdict(set)
        self.homes = {}  # class -> member -> the files that define it
        for name, one in self.outlines.items():
            for owner, bases in one.bases.items():
                self.bases[owner] |= set(bases)
            for function in one.functions:
                if function.owner:
                    self.homes.setdefault(function.owner, {}).setdefault(function.name, set()).add(stem(name))
        self.patterns = {owner: re.compile(OBJECT % owner) for owner in sorted(self.homes)}
        self.shared = collections.defaultdict(set)  # name of an object in a header -> its classes
        for name, one in self.outlines.items():
            if name.endswith(".h"):
                self.add_objects(one.text, self.shared)

    def add_objects(self, text, found):
        """Adds the names of objects, and of functions that return one, with their classes."""
        for owner, pattern in self.patterns.items():
            for name in pattern.findall(text):
                found[name].add(owner)

    def objects_of(self, text):
        found = collections.defaultdict(set)
        for name, classes in self.shared.items():
            found[name] |= classes
        self.add_objects(text, found)
        for name, source in ALIAS.findall(text):
            found[name] |= found.get(source, set())
        return found

    def files_of(self, owner, member, seen=()):
        """Returns the files in which a class, or one of its bases, defines the member."""
        here = self.homes.get(owner, {}).get(member, set())
        if here or owner in seen:
            return here
        return set().union(*(self.files_of(base, member, (*seen, owner)) for base in self.bases.get(owner, ())))

    def calls_in(self, one):
        """Yields (class, member) of each possible call."""
        for function in one.functions:
            if function.owner:
                yield from ((function.owner, name) for name in bare_calls(function.body))
        objects = self.objects_of(one.text)
        for receiver, name in calls_of_objects(one.text):
            yield from ((owner, name) for owner in sorted(objects.get(receiver, ())))
        yield from POINTER.findall(one.text)

    def edges(self):
        edges = collections.defaultdict(dict)
        for path, one in self.outlines.items():
            here = stem(path)
            for owner, name in self.calls_in(one):
                files = self.files_of(owner, name)
                for other in sorted(files) if here not in files else ():
                    edges[here].setdefault(other, f"{path} calls {owner}::{name}() of {other}")
        return edges


def calls_of(outlines):
    return Folder(outlines).edges()
