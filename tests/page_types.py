#!/usr/bin/env python3
"""Checks the types of the live page's scripts with the TypeScript compiler: page_types.py. Nothing is compiled; types stand
in comments (JSDoc), and what the scripts load besides is described in page_types/. Exits with 1 at the first fault, with
77 if there is no compiler (apt-get install node-typescript)."""
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
MISSING = 77


def main():
    compiler = shutil.which("tsc")
    if compiler is None:
        print("tsc is not installed; expected it, to check the types of the page's scripts (apt-get install node-typescript)")
        return MISSING
    said = subprocess.run([compiler, "--project", os.path.join(HERE, "page_types")], capture_output=True, text=True,
                          cwd=os.path.dirname(HERE))
    print(said.stdout, end="")
    return 1 if said.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
