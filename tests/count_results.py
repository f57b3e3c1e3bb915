#!/usr/bin/python3
"""Counts what ctest has run, from its JUnit file, and tells why each skipped test was skipped.

usage: count_results.py RESULTS.xml

Prints a line `skipped: NAME: reason` for each that was skipped, then `PASSED FAILED SKIPPED`.
"""
import re
import sys
import xml.etree.ElementTree

# XML has no such characters, and a test may print them.
NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f]|&#x?[0-9a-fA-F]+;")


def reason(output):
    """GoogleTest prints `FILE:LINE: Skipped`, then the reason; a script prints `skipped: reason`."""
    found = re.search(r": Skipped\n(.+)", output) or re.search(r"^skipped: (.+)", output, re.M)
    return found.group(1).strip() if found and found.group(1).strip() else "no reason is given"


def main():
    with open(sys.argv[1], encoding="utf-8", errors="replace") as file:
        root = xml.etree.ElementTree.fromstring(NOT_XML.sub("?", file.read()))
    passed = failed = skipped = 0
    for case in root.iter("testcase"):
        if case.get("status") == "run":
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
