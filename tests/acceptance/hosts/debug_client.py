#!/usr/bin/python3
"""VS Code's own test client for debug adapters drives `understudy dap`: debug_client.py UNDERSTUDY MODULES.

MODULES is a folder for Node modules, which npm fetches if UNDERSTUDY_HEAVY_HOSTS is 1. The cases are in
debug_client/debug_client.mjs."""
import os
import subprocess
import sys

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(os.path.dirname(HERE)))
import npm_modules  # noqa: E402

UNDERSTUDY, MODULES = (os.path.abspath(path) for path in sys.argv[1:3])
FOLDER = os.path.join(HERE, "debug_client")

try:
    npm_modules.fetch(FOLDER, MODULES, "1 MB")
except npm_modules.Missing as missing:
    print("skipped:", missing)
    sys.exit(77)
sys.exit(subprocess.run(["node", "--test", os.path.join(FOLDER, "debug_client.mjs")], check=False,
                        env=os.environ | {"UNDERSTUDY": UNDERSTUDY, "MODULES": MODULES}).returncode)
