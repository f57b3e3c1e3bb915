"""Checks the syntax of the live page's scripts for house_style.py: a syntax error leaves the whole page empty, and no
other test that runs by default opens the page in a browser."""
import os
import re
import shutil
import subprocess
import tempfile

SCRIPTS = "emulator/page/web"


def faults_of(project):
    """Yields (path, line, what is wrong) for each script of the page that does not parse as a module."""
    folder = os.path.join(project, SCRIPTS)
    names = sorted(name for name in os.listdir(folder) if name.endswith(".js")) if os.path.isdir(folder) else []
    program = shutil.which("node")
    if names and program is None:
        yield SCRIPTS, 1, "node is not installed; expected it, to parse the scripts (apt-get install nodejs)"
        return
    with tempfile.TemporaryDirectory() as copies:  # node recognizes a module by its suffix
        for name in names:
            copy = os.path.join(copies, name[:-3] + ".mjs")
            shutil.copyfile(os.path.join(folder, name), copy)
            said = subprocess.run([program, "--check", copy], capture_output=True, text=True)
            if said.returncode != 0:
                line = re.search(r"\.mjs:(\d+)", said.stderr)
                error = re.search(r"^\w*Error: .*", said.stderr, re.MULTILINE)
                yield (os.path.join(SCRIPTS, name), int(line.group(1)) if line else 1,
                       f"does not parse ({error.group() if error else said.stderr.strip()}); expected a module")
