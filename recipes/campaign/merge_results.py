#!/usr/bin/env python3
"""Merges the results of shards, and prints a summary of the campaign.

merge_results.py ALL.sqlite SHARD.sqlite...

ALL.sqlite is replaced. Exit code: 1 if a case failed, 2 if a case could not be read, or if a file is not a database of
results.
"""
import os
import sqlite3
import sys

ID = 0x55535459  # in databases from `understudy run --results`


def require_own(path):
    """Replace only a database of results; another file of that name may be there by mistake."""
    with open(path, "rb") as there:
        head = there.read(100)
    if head and (head[:16] != b"SQLite format 3\0" or int.from_bytes(head[68:72], "big") != ID):
        raise sqlite3.DatabaseError(f"{path} is not a results file; expected one to replace, or a free path")


def merge(target, sources):
    if os.path.lexists(target):
        require_own(target)
        os.remove(target)
    # The first shard provides the tables.
    with sqlite3.connect(f"file:{sources[0]}?mode=ro", uri=True) as first, sqlite3.connect(target) as whole:
        first.backup(whole)
    whole = sqlite3.connect(target, isolation_level=None)
    for source in sources:
        whole.execute("ATTACH ? AS shard", (source,))
        if whole.execute("PRAGMA shard.application_id").fetchone() != (ID,):
            raise sqlite3.DatabaseError(f"{source} has no results; expected what `understudy run --results` has made")
        whole.execute("INSERT OR REPLACE INTO main.results SELECT * FROM shard.results")
        whole.execute("INSERT OR IGNORE INTO main.parameter_names SELECT * FROM shard.parameter_names")
        whole.execute("DETACH shard")
    return whole


def main(arguments):
    if len(arguments) < 2 or arguments[0] in arguments[1:]:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        whole = merge(arguments[0], arguments[1:])
    except (OSError, sqlite3.Error) as error:
        print(f"merge_results: {error}", file=sys.stderr)
        return 2
    counts = dict(whole.execute("SELECT verdict, count(*) FROM results GROUP BY verdict"))
    seconds = whole.execute("SELECT coalesce(sum(simulated_s), 0) FROM results").fetchone()[0]
    for kind, count, first, recording in whole.execute(
        # SQLite takes the name from the row with the longest recording.
        "SELECT kind, count(*), name, max(recording) FROM results WHERE kind IS NOT NULL GROUP BY kind ORDER BY 2 DESC"
    ):
        print(f"{count} failed alike: {kind}\n    such as {first}\n    recorded in {recording}")
    print(", ".join(f"{count} {verdict}" for verdict, count in sorted(counts.items())) + f"; {seconds:.0f} s simulated")
    return 2 if "unreadable" in counts else 1 if "failed" in counts else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
