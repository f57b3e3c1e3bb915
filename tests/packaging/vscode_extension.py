#!/usr/bin/env python3
"""Tests of the VS Code extension (packaging/vscode).

usage: vscode_extension.py PROJECT UNDERSTUDY MODULES [unittest's arguments]

MODULES is a folder for Node modules. If they are missing, npm fetches them if UNDERSTUDY_HEAVY_HOSTS is 1; otherwise the
tests of colours and schemas are skipped.
"""
import functools
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
PROJECT, PROGRAM, MODULES = (os.path.abspath(path) for path in sys.argv[1:4])
EXTENSION = os.path.join(PROJECT, "packaging", "vscode")
sys.path[:0] = [HERE, os.path.dirname(HERE), EXTENSION]
import generate  # noqa: E402
import listings  # noqa: E402
import npm_modules  # noqa: E402
import vsix  # noqa: E402
from tables import MODELS, Tables  # noqa: E402


def read(*path):
    with open(os.path.join(EXTENSION, *path), encoding="utf-8") as file:
        return file.read()


def understudy(*arguments, folder=None):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=folder, check=False)


@functools.cache
def package():
    return json.loads(read("package.json"))["contributes"]


def expanded(body):
    """Returns the text of a snippet, with the words that stand in the places."""
    text = "\n".join(body) if isinstance(body, list) else body
    text = re.sub(r"\$\{\d+\|([^,|]*)[^|]*\|\}", r"\1", text)
    text = re.sub(r"\$\{\d+:((?:\\.|[^}\\])*)\}", r"\1", text)
    return re.sub(r"\\([\\$}])", r"\1", re.sub(r"(?<!\\)\$\d", "", text))


def findings(model, texts):
    """Returns what `check` finds in each of the texts."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [os.path.join(folder, str(number)) for number in range(len(texts))]
        for path, text in zip(paths, texts):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        said = understudy("check", "--model", model, "--format", "json", *paths)
        by_path = {file["file"]: file["findings"] for file in json.loads(said.stdout)["files"]}
        return [by_path[path] for path in paths]


@functools.cache
def fetch_modules():
    """Fetches the Node modules if that is allowed. Skips the test if they are missing, or not those of the lock file."""
    try:
        npm_modules.fetch(HERE, MODULES, "80 MB")
    except npm_modules.Missing as missing:
        raise unittest.SkipTest(str(missing)) from None


class Generated(unittest.TestCase):
    def test_committed_files_are_what_the_tables_give(self):
        for path, text in generate.files(PROGRAM).items():
            self.assertEqual(read(path), text, f"{path}: differs; expected what packaging/vscode/generate.py writes")

    def test_each_language_has_a_grammar_and_snippets(self):
        languages = {language["id"] for language in package()["languages"]}
        self.assertEqual(languages, {"understudy-" + model for model in MODELS})
        self.assertEqual({grammar["language"] for grammar in package()["grammars"]}, languages)
        self.assertEqual({snippets["language"] for snippets in package()["snippets"]}, languages | {"yaml"})
        for grammar in package()["grammars"]:
            self.assertEqual(json.loads(read(grammar["path"]))["scopeName"], grammar["scopeName"])


class Snippets(unittest.TestCase):
    def test_each_instruction_of_a_program_has_one(self):
        for model in ("simple2-r3", "super-40nc", "rs-m8194h"):
            prefixes = {some["prefix"] for some in json.loads(read("snippets", model + ".json")).values()}
            for row in Tables(PROGRAM).describe(model, "instructions"):
                mnemonic = re.sub("tc$", "", row["mnemonic"])
                in_programs = row.get("areas", "MP").strip() not in ("", "RTC", "RTC IT") and "_CLOSE" not in mnemonic
                self.assertEqual(mnemonic in prefixes, in_programs, mnemonic)

    def test_simple2_snippets_load_with_sample_operands(self):
        samples = {"flag": "JMP1", "param": "MEM0", "logic": "ON", "DIN number": "DIN_1", "DOUT number": "DOUT_1",
                   "amount": "5", "array logic bits": "0b1", "array change mask": "0b1", "counter": "1", "timer": "2",
                   "loop count": "3", "imm8": "-4", "STATUS bit": "7"}
        texts = []
        for some in json.loads(read("snippets", "simple2-r3.json")).values():
            body = re.sub(r"\$\{\d+:([^}]*)\}", lambda place: samples[place[1]], some["body"])
            texts.append(f"JMP1: NOP\n{body}\n")
        self.assertEqual([found for found in findings("simple2-r3", texts) if found], [])

    def test_first_benches_and_scenarios_are_valid(self):
        snippets = json.loads(read("snippets", "yaml.json"))
        for model in MODELS:
            with tempfile.TemporaryDirectory() as folder:
                for kind, name in (("bench", "bench.yaml"), ("scenario", "first_move.yaml")):
                    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                        file.write(expanded(snippets[f"understudy {kind} {model}"]["body"]) + "\n")
                self.assertEqual(understudy("check", folder).returncode, 0)


class ProblemMatchers(unittest.TestCase):
    BENCH = "understudy: 1\nlines: { a: { stations: [ { name: a, model: simple2-r3 } ] } }\n"

    def matches(self, name, text):
        pattern = next(some["pattern"] for some in package()["problemMatchers"] if some["name"] == name)
        found = filter(None, (re.match(pattern["regexp"], line) for line in text.splitlines()))
        keys = ("file", "line", "column", "severity", "message")
        return [{key: match[pattern[key]] for key in keys if key in pattern} for match in found]

    def in_folder(self, files, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            said = understudy(*arguments, folder=folder)
            return said.stdout + said.stderr

    def test_check_has_each_finding_with_its_place(self):
        said = self.in_folder({"a.lst": "  Jump nowhere\n", "b.lst": "NOP\n"}, "check", "--model", "simple2-r3", "a.lst",
                              "b.lst")
        self.assertEqual(self.matches("understudy", said), [
            {"file": "a.lst", "line": "1", "column": "8", "severity": None,
             "message": "operand 1: no line is labelled 'nowhere'; expected a label, JMP1 to JMP64, or @0 to @255"}])

    def test_check_has_warnings_as_such(self):
        said = self.in_folder({"a.lst": "AREA C\nJMP K1\nEND\n"}, "check", "--model", "super-40nc", "a.lst")
        found = self.matches("understudy", said)
        self.assertEqual([(some["line"], some["severity"]) for some in found], [("2", "warning")], said)

    def test_run_has_the_failed_step(self):
        scenario = "understudy: 1\nbench: bench.yaml\nsteps:\n  - expect: { a.Aaxis_Mode: 3 }\n"
        said = self.in_folder({"bench.yaml": self.BENCH, "a.yaml": scenario}, "run", "a.yaml")
        found = self.matches("understudy-run", said)
        self.assertEqual([(some["file"], some["line"]) for some in found], [("a.yaml", "4")], said)
        self.assertIn("Aaxis_Mode", found[0]["message"])


class Adapter:
    """The debug adapter, started as VS Code starts it: by the contribution's `runtime`, which is found in PATH."""

    def __init__(self, debugger):
        self.sent = 0
        path = os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"]
        self.process = subprocess.Popen([debugger["runtime"], *debugger["runtimeArgs"]], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, env=os.environ | {"PATH": path})

    def receive(self):
        length = int(self.process.stdout.readline().split(b":")[1])
        self.process.stdout.readline()
        return json.loads(self.process.stdout.read(length))

    def ask(self, command, arguments):
        self.sent += 1
        text = json.dumps({"seq": self.sent, "type": "request", "command": command, "arguments": arguments}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(text), text))
        self.process.stdin.flush()
        while True:
            message = self.receive()
            if message["type"] == "response" and message["request_seq"] == self.sent:
                return message

    def end(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()


class Debugger(unittest.TestCase):
    def configurations(self):
        """Returns the snippets of launch.json as a user gets them, without the names in the places."""
        def plain(value):
            if not isinstance(value, str):
                return value
            text = value[2:-1] if value.startswith('^"') else value  # VS Code: the rest is the JSON to insert
            return re.sub(r"\$\{\d+:([^}]*)\}", r"\1", text).replace("\\$", "$")
        debugger = package()["debuggers"][0]
        bodies = [snippet["body"] for snippet in debugger["configurationSnippets"]]
        return [{key: plain(value) for key, value in body.items()} for body in bodies + debugger["initialConfigurations"]]

    def test_configurations_have_only_attributes_that_are_described(self):
        attributes = package()["debuggers"][0]["configurationAttributes"]
        for configuration in self.configurations():
            described = set(attributes[configuration["request"]]["properties"])
            self.assertLessEqual(set(configuration) - {"type", "request", "name"}, described)

    def test_launch_configurations_start(self):
        with tempfile.TemporaryDirectory() as folder:
            understudy("init", "--model", "simple2-r3", folder)
            said = understudy("run", "--record", folder, os.path.join(folder, "first_move.yaml"))
            recordings = [name for name in os.listdir(folder) if name.endswith(".jsonl")]
            self.assertEqual(len(recordings), 1, said.stdout + said.stderr)
            os.rename(os.path.join(folder, recordings[0]), os.path.join(folder, "run.jsonl"))
            for configuration in self.configurations():
                arguments = {key: value.replace("${workspaceFolder}", folder) if isinstance(value, str) else value
                             for key, value in configuration.items()}
                if arguments["request"] == "launch":
                    adapter = Adapter(package()["debuggers"][0])
                    self.assertTrue(adapter.ask("initialize", {"adapterID": "understudy"})["success"])
                    answer = adapter.ask("launch", arguments)
                    self.assertTrue(answer["success"], (answer, arguments))
                    adapter.ask("disconnect", {})
                    adapter.end()


class Recipes(unittest.TestCase):
    def test_tasks_name_the_problem_matchers_and_are_those_of_the_page(self):
        with open(os.path.join(PROJECT, "recipes", "vscode", "tasks.json"), encoding="utf-8") as file:
            text = file.read()
        matchers = ["$" + some["name"] for some in package()["problemMatchers"]]
        self.assertEqual([task["problemMatcher"] for task in json.loads(text)["tasks"]], matchers)
        with open(os.path.join(PROJECT, "docs", "editors.md"), encoding="utf-8") as file:
            self.assertIn(f"```jsonc\n{text}```\n", file.read())


class Package(unittest.TestCase):
    def test_it_has_each_file_that_it_names(self):
        with tempfile.TemporaryDirectory() as folder:
            with zipfile.ZipFile(vsix.build(folder, PROGRAM)) as archive:
                names = set(archive.namelist())
                manifest = json.loads(archive.read("extension/package.json"))
                for part in ("extension.vsixmanifest", "[Content_Types].xml"):
                    xml.etree.ElementTree.fromstring(archive.read(part))
                for name in filter(lambda name: name.endswith(".json"), names):
                    json.loads(archive.read(name))
        self.assertEqual(manifest["version"], understudy("--version").stdout.split()[-1])
        contributed = manifest["contributes"]
        named = {path for key in ("grammars", "snippets") for path in (some["path"] for some in contributed[key])}
        named |= {some["configuration"] for some in contributed["languages"]}
        named |= {some["url"] for some in contributed["yamlValidation"]}
        self.assertEqual({"extension/" + path.removeprefix("./") for path in named} - names, set())
        self.assertEqual({name.rsplit(".", 1)[-1] for name in names} - {"xml"}, set(vsix.TYPES))

    def test_another_program_is_refused(self):
        for program, what in {"/bin/false": "exit code 1", "/bin/true": "version such as", "/nonsense": "No such file"}.items():
            with tempfile.TemporaryDirectory() as folder:
                said = subprocess.run([sys.executable, os.path.join(EXTENSION, "vsix.py"), folder, program],
                                      capture_output=True, text=True, check=False)
                self.assertEqual((said.returncode, said.stdout, os.listdir(folder)), (1, "", []))
                self.assertRegex(said.stderr, f"^vsix.py: {program}.*{what}.*; expected the program `understudy`\n$")

    def test_equal_input_gives_equal_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            made = []
            for name in ("a", "b"):
                with open(vsix.build(os.path.join(folder, name), PROGRAM), "rb") as file:
                    made.append(file.read())
            self.assertEqual(*made)


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        fetch_modules()

    def findings(self, name, schema, text):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, name)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            said = subprocess.run(["node", os.path.join(HERE, "schemas.mjs"), MODULES, f"{path}={schema}"],
                                  capture_output=True, text=True, check=False)
        self.assertEqual(said.returncode, 0, said.stderr)
        return json.loads(said.stdout)

    def test_the_manifest_is_valid(self):
        self.assertEqual(self.findings("package.json", "vscode-extensions", read("package.json")), [])

    def test_a_wrong_manifest_is_not(self):
        wrong = read("package.json").replace('[".lst"]', '".lst"')
        self.assertEqual([what for *_, what in self.findings("package.json", "vscode-extensions", wrong)],
                         ['Incorrect type. Expected "array".'])

    def test_the_language_configuration_is_valid(self):
        """The newest schema expects an object for a line comment, but all versions of VS Code read a string."""
        text = read("language-configuration.json").replace('"lineComment": ";"', '"lineComment": { "comment": ";" }')
        self.assertEqual(self.findings("language-configuration.json", "language-configuration", text), [])


class Colours(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        fetch_modules()

    def coloured(self, cases):
        """Returns the words of each (model, text) with their scopes."""
        asked = json.dumps([{"grammar": model, "text": text} for model, text in cases])
        said = subprocess.run(["node", os.path.join(HERE, "colours.mjs"), MODULES, os.path.join(EXTENSION, "syntaxes")],
                              input=asked, capture_output=True, text=True, check=False)
        self.assertEqual(said.stderr, "")
        return json.loads(said.stdout)

    def test_each_word_of_the_projects_listings(self):
        """Also, no token is marked as invalid, because `check` accepts the listings."""
        shipped = list(listings.all_of(PROJECT))
        counted = dict.fromkeys(MODELS, 0)
        cases = []
        for model in MODELS:
            some = [(path, text) for path, of, text in shipped if of == model]
            for (path, text), found in zip(some, findings(model, [text for _, text in some])):
                if not any(finding.get("level") != "warning" for finding in found):
                    cases.append((path, model, text))
                    counted[model] += 1
        wrong = [(path, word) for (path, *_), words in
                 zip(cases, self.coloured([(model, text) for _, model, text in cases]))
                 for word in words if word[2] == "" or word[2].startswith("invalid")]
        self.assertEqual(wrong, [])
        for model, least in {"simple2-r3": 20, "super-40nc": 80, "rs-m8194h": 10, "slim": 10}.items():
            self.assertGreaterEqual(counted[model], least, model)

    def test_each_instruction_of_the_tables(self):
        tables = Tables(PROGRAM)
        cases = [("simple2-r3", row["mnemonic"]) for row in tables.describe("simple2-r3", "instructions")]
        for row in tables.describe("super-40nc", "instructions"):
            mnemonic = row["mnemonic"].removesuffix("tc")
            cases += [("super-40nc", f"AREA {'PLC' if area == 'P' else area}\n0 {mnemonic.lower()}") for area in row["areas"]]
        for row in tables.describe("rs-m8194h", "instructions"):
            if "_CLOSE" not in row["mnemonic"]:
                cases += [("rs-m8194h", f"{area} 1\n{row['mnemonic']}") for area in row["areas"].split()
                          if area in ("MP", "ISR")]
        for some in json.loads(read("snippets", "slim.json")).values():
            cases.append(("slim", expanded(some["body"]).replace("EVk", "EV1")))
        for case, words in zip(cases, self.coloured(cases)):
            of_last_line = [scope for line, _, scope in words if line == words[-1][0] and scope != "constant.numeric.step"]
            self.assertTrue(of_last_line[0].startswith(("keyword.", "support.", "variable.", "entity.name.module")),
                            (case, words))

    def test_unknown_instructions_and_their_operands_are_plain(self):
        cases = [("simple2-r3", "Jumpp again"), ("simple2-r3", "maybe: Outt DOUT_0 ON"), ("super-40nc", "AREA C\nLINE K1"),
                 ("super-40nc", "LD X0"), ("rs-m8194h", "MP 1\nRSM_MACRO_SET_W X 1"), ("rs-m8194h", "RSM_SET_V X 1"),
                 ("slim", "MOVE 100"), ("slim", "T1OUT 5")]
        for case, words in zip(cases, self.coloured(cases)):
            last = case[1].split("\n")[-1].split(": ")[-1]
            self.assertEqual(words[-1][1:], [last, ""], case)

    def test_instructions_of_another_area_are_invalid(self):
        cases = [("super-40nc", "AREA PLC\n3500 LIN K1"), ("super-40nc", "AREA X\n F K10"), ("super-40nc", "FILE 3\nANP X1"),
                 ("rs-m8194h", "MP 1\n RSM_SET_V X 1"), ("rs-m8194h", "ISR 2\nRSM_MACRO_FOR 3"), ("slim", "PG"), ("slim", "SAVE D")]
        for case, words in zip(cases, self.coloured(cases)):
            self.assertIn("invalid.illegal.wrong-place", [scope for *_, scope in words], case)


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1] + sys.argv[4:], exit=False).result
    for _, why in result.skipped:
        print("skipped:", why)
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped else 0)
