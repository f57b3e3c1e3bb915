#!/usr/bin/python3
"""Counts the tests that ctest ran, and says why tests were skipped.

usage: count_results.py RESULTS.xml SHARDS

RESULTS.xml is ctest's JUnit file. If ctest ran a shard of many tests, the folder SHARDS contains NAME.xml, in which
GoogleTest reports each of them. A shard without this file ended too early, and counts as failed.
Prints a line `skipped: NAME: reason` for each skipped test, then `PASSED FAILED SKIPPED`.
"""
import os
import re
import sys
import xml.etree.ElementTree

# Tests may print these characters, which XML does not allow.
NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f]")
REFERENCE = re.compile("&#(x[0-9a-fA-F]+|[0-9]+);")
NO_REASON = "no reason is given"


def read(path):
    # In an attribute, a parser replaces the end of a line with a space, unless it is written as a reference.
    with open(path, encoding="utf-8", errors="replace") as file:
        text = NOT_XML.sub("?", file.read())
    return xml.etree.ElementTree.fromstring(REFERENCE.sub(lambda found: "&#10;" if is_line_end(found.group(1)) else "?", text))


def is_line_end(digits):
    return (int(digits[1:], 16) if digits[0] == "x" else int(digits)) == 10


def reason(output):
    """Returns the reason: GoogleTest prints it after `FILE:LINE: Skipped`, a script as `skipped: reason`."""
    found = re.search(r": Skipped\n(.+)", output) or re.search(r"^skipped: (.+)", output, re.M)
    return found.group(1).strip() if found and found.group(1).strip() else NO_REASON


def count_shard(path):
    """Counts in GoogleTest's own file. A skipped test has a message: `FILE:LINE`, and the reason in the next line."""
    passed = failed = skipped = 0
    for case in read(path).iter("testcase"):
        if case.get("status") != "run":
            continue
        told = case.find("skipped")
        if case.find("failure") is not None:
            failed += 1
        elif told is not None:
            skipped += 1
            why = told.get("message", "").split("\n", 1)
            print(f"skipped: {case.get('classname')}.{case.get('name')}: {why[1].strip() if len(why) > 1 else NO_REASON}")
        else:
            passed += 1
    return passed, failed, skipped


def main():
    passed = failed = skipped = 0
    for case in read(sys.argv[1]).iter("testcase"):
        shard = os.path.join(sys.argv[2], case.get("name") + ".xml")
        has_passed = case.get("status") == "run"
        if os.path.exists(shard):
            won, lost, left = count_shard(shard)
            passed += won
            skipped += left
            failed += lost if has_passed else max(lost, 1)
            continue
        if ".shard_" in case.get("name"):
            print(f"{case.get('name')}: ended before its last test")
            failed += 1
            continue
        if has_passed:
            passed += 1
            continue
        told = case.find("skipped")
        if told is not None and told.get("message", "").startswith("SKIP_"):
            skipped += 1
            name = case.get("name").split("  # ")[0]
            print(f"skipped: {name}: {reason(case.findtext('system-out') or '')}")
        else:  # or it could not be started at all
            failed += 1
    print(passed, failed, skipped)


if __name__ == "__main__":
    main()
