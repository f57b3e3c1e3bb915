"""The program's tables, as `understudy describe` prints them."""
import json
import os
import re
import shutil
import subprocess
import tempfile

MODELS = ("simple2-r3", "super-40nc", "rs-m8194h", "slim")


class Tables:
    def __init__(self, program):
        self.program = shutil.which(program) or program

    def describe(self, model, what):
        """Returns the rows of a table, each with its columns by name."""
        said = subprocess.run([self.program, "describe", model, what, "--format", "json"], capture_output=True,
                              text=True, check=True)
        return json.loads(said.stdout)

    def first_files(self, model):
        """Returns the first bench and scenario of a model by their names, as `init` writes them."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([self.program, "init", "--model", model, folder], capture_output=True, check=True)
            texts = {}
            for name in sorted(os.listdir(folder)):
                if name.endswith(".yaml"):
                    with open(os.path.join(folder, name), encoding="utf-8") as file:
                        texts[name] = file.read()
            return texts

    def refused_in_programs(self, model, lines, reason):
        """Returns the lines that `check` refuses for this reason in a program."""
        refused = set()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "program")
            for first in range(0, len(lines), 50):  # check stops at the hundredth error
                some = lines[first:first + 50]
                with open(path, "w", encoding="utf-8") as file:
                    file.write("\n".join(some) + "\n")
                said = subprocess.run([self.program, "check", "--model", model, "--format", "json", path],
                                      capture_output=True, text=True, check=False)
                for finding in json.loads(said.stdout)["files"][0]["findings"]:
                    if reason in finding["message"]:
                        refused.add(some[finding["line"] - 1])
        return refused

    def refused_slim_commands(self):
        """Returns the rows of SLIM's commands that a program cannot contain: queries, and those of the editor."""
        rows = self.describe("slim", "commands")
        as_written = {row["syntax"]: re.sub(r"^Tp", "T1", re.sub(r"\bn\b", "1", row["syntax"])) for row in rows}
        refused = self.refused_in_programs("slim", list(as_written.values()), "is not allowed in a program")
        return [row for row in rows if row["syntax"].startswith("?") or as_written[row["syntax"]] in refused]
