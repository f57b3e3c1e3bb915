"""Tests tests/plain_words.py: what it finds on a page and in strings, at which line, and what it accepts."""
import pathlib
import sys

import pytest

PROJECT = pathlib.Path(__file__).parents[2]
sys.path.append(str(PROJECT / "tests"))
import plain_words  # noqa: E402


@pytest.mark.parametrize("text, line, phrase", [
    ("A list, of which the first counts.", 1, "of which"),
    ("It prints one line so that it may\nbe read.", 1, "so that it may"),
    ("It says so to\nwhoever asks.", 2, "whoever"),
    ("All is well.\n\nIt is served. What was dropped says why.", 3, "What was"),
    ("- Where a port is busy, it waits.", 1, "Where a"),
    ("The loopback is no\nboundary.", 1, "is no boundary"),
    ("The output could\nnot be had.", 1, "could not be had"),
    ("| `serve` | stands in for a device |", 1, "stands in for"),
    ("The device is told of it, as in life.", 1, "is told of"),
    ("Two there are.", 1, "Two there are"),
    ("```\nof which\n```\nHere is one of\none's own.", 4, "of one's own"),
])
def test_a_phrase_is_found(text, line, phrase):
    faults = list(plain_words.faults_of_page(text))
    assert (line, f'"{phrase}" is not plain English') in [(number, what.split(";")[0]) for number, what in faults], faults
    assert all("; expected " in what for _, what in faults)


@pytest.mark.parametrize("text", [
    "There is no password, and there are no files.",
    "What is a tick? It is a millisecond.",
    "## What is not modelled",
    "The keys below apply, all of which have defaults.",
    "Write `X is no Y` and [a page](of%20which.md), `in a\nway of which` one knows.",
    "The device is told about the exception, and stops unless it is told otherwise.",
    "Simulated time stands still; it is no longer moved. The clock stands at 2 s.",
    "```sh\necho of which\n```",
    "If a port is busy, `serve` waits.",
    "| a row | " + "x" * 130 + " |",
])
def test_plain_english_passes(text):
    assert list(plain_words.faults_of_page(text)) == []


def test_prose_wraps_at_one_width():
    assert [line for line, _ in plain_words.faults_of_page("short\n" + "word " * 25 + "\n")] == [2]


def test_strings_of_sources_are_read_and_comments_are_not():
    source = '#include "whoever.h"\n// whoever\nadd("--flag", "For whoever asks", "an \\"escaped\\" one");\n'
    assert list(plain_words.faults_of_strings(source)) == [
        (3, '"whoever" is not plain English; expected "anyone who", "a host that"')]
