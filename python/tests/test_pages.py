"""Runs the code blocks of the pages as they are printed."""
import importlib.util
import os
import pathlib
import re
import socket
import subprocess

import pytest
import understudy

pytest_plugins = ["pytester"]
DOCS = pathlib.Path(__file__).parents[2] / "docs"


def snippets(page, language="python"):
    return re.findall(rf"^```{language}\n(.*?)^```$", (DOCS / page).read_text(), re.M | re.S)


def free_port():
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        return str(held.getsockname()[1])


@pytest.mark.parametrize("snippet", snippets("network.md"), ids=range(len(snippets("network.md"))))
def test_network_page(snippet):
    pytest.importorskip("serial")
    port = free_port()
    with understudy.start(None, "--listen", "rfc2217://:" + port, model="simple2-r3", speed="real"):
        exec(compile(snippet.replace("5020", port), "docs/network.md", "exec"), {})


def test_benches_of_the_network_page(tmp_path):
    benches = snippets("network.md", "yaml")
    assert benches
    for text in benches:
        (tmp_path / "bench.yaml").write_text(text)
        program = os.environ.get("UNDERSTUDY_PROGRAM", "understudy")
        said = subprocess.run([program, "check", "bench.yaml"], cwd=tmp_path, capture_output=True, text=True)
        assert said.returncode == 0, said.stderr


@pytest.mark.parametrize("snippet", snippets("python.md"), ids=range(len(snippets("python.md"))))
def test_python_page(snippet, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exec(compile(snippet, "docs/python.md", "exec"), {})


def test_pytest_page(pytester):
    texts = snippets("pytest.md")
    assert sum("hypothesis" in text for text in texts) == 1
    has_hypothesis = importlib.util.find_spec("hypothesis") is not None
    texts = [text for text in texts if has_hypothesis or "hypothesis" not in text]
    pytester.makepyfile(**{f"test_{number}": text for number, text in enumerate(texts)})
    passed = 10 if has_hypothesis else 9
    pytester.runpytest_subprocess("-p", "understudy.pytest_plugin").assert_outcomes(passed=passed)


def test_a_snippet_that_is_wrong_fails(pytester):
    """Checks that the blocks really run: a wrong number in one is detected."""
    right = snippets("python.md")[0]
    wrong = right.replace('bench["Cord_A"] == 1000', 'bench["Cord_A"] == 1001')
    assert wrong != right
    with pytest.raises(AssertionError):
        exec(compile(wrong, "docs/python.md", "exec"), {})
    text = snippets("pytest.md")[0].replace('bench["Cord_A"] == 1000', 'bench["Cord_A"] == 1001')
    pytester.makepyfile(test_wrong=text)
    pytester.runpytest_subprocess("-p", "understudy.pytest_plugin").assert_outcomes(passed=2, failed=1)


def test_the_python_page_names_what_a_bench_has():
    page = (DOCS / "python.md").read_text()
    methods = [name for name in vars(understudy.Bench) if not name.startswith("_")]
    assert {name for name in methods if not re.search(rf"\b{name}\b", page)} == set()
