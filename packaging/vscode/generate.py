#!/usr/bin/env python3
"""Writes the parts of the VS Code extension that come from the program's tables: grammars and snippets.

usage: generate.py UNDERSTUDY [FOLDER]

UNDERSTUDY is the program. `syntaxes/` and `snippets/` go into FOLDER; by default that is the extension's own folder,
whose files are committed. A test compares them with what the program's tables give.
"""
import json
import os
import sys

sys.dont_write_bytecode = True
import grammars  # noqa: E402
import snippets  # noqa: E402
from tables import Tables  # noqa: E402


def files(program):
    """Returns the text of each generated file by its path in the extension."""
    tables = Tables(program)
    made = {f"syntaxes/{name}.tmLanguage.json": grammar for name, grammar in grammars.all_of(tables).items()}
    made |= {f"snippets/{name}.json": some for name, some in snippets.all_of(tables).items()}
    return {path: json.dumps(content, indent=2, ensure_ascii=False) + "\n" for path, content in made.items()}


def main(program, folder=os.path.dirname(os.path.abspath(__file__))):
    for path, text in files(program).items():
        place = os.path.join(folder, path)
        os.makedirs(os.path.dirname(place), exist_ok=True)
        with open(place, "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(*sys.argv[1:])
