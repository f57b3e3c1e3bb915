"""The snippets of the pages run as they stand there."""
import pathlib
import re

import pytest

pytest_plugins = ["pytester"]
DOCS = pathlib.Path(__file__).parents[2] / "docs"


def snippets(page):
    return re.findall(r"^```python\n(.*?)^```$", (DOCS / page).read_text(), re.M | re.S)


@pytest.mark.parametrize("snippet", snippets("python.md"), ids=range(len(snippets("python.md"))))
def test_python_page(snippet, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exec(compile(snippet, "docs/python.md", "exec"), {})


def test_pytest_page(pytester):
    pytester.makepyfile(**{f"test_{number}": text for number, text in enumerate(snippets("pytest.md"))})
    pytester.runpytest_subprocess("-p", "understudy.pytest_plugin").assert_outcomes(passed=7)


def test_the_python_page_names_what_a_bench_has():
    import understudy
    page = (DOCS / "python.md").read_text()
    methods = [name for name in vars(understudy.Bench) if not name.startswith("_")]
    assert {name for name in methods if not re.search(rf"\b{name}\b", page)} == set()
