"""Examples, and what is imported."""

import doctest
import pathlib
import re
import subprocess
import sys

import pytest

import wavestep as ws
from wavestep import _convert, _errors, _results, _sweep

ROOT = pathlib.Path(__file__).parents[3]
PAGES = [ROOT / "docs/python.md", ROOT / "docs/sweeps.md"]


def examples() -> list[doctest.DocTest]:
    finder = doctest.DocTestFinder(exclude_empty=True)
    found = [test for module in (ws, _convert, _errors, _results, _sweep) for test in finder.find(module)]
    found += finder.find(ws.set_memory, "set_memory", globs={})
    for file in PAGES:
        page = file.read_text(encoding="utf-8").replace("```", "\n```")
        found.append(doctest.DocTestParser().get_doctest(page, {}, file.name, str(file), 0))
    return [test for test in found if test.examples]


@pytest.mark.parametrize("example", examples(), ids=lambda test: test.name)
def test_examples_run(example: doctest.DocTest) -> None:
    assert doctest.DocTestRunner().run(example).failed == 0


def test_there_are_examples() -> None:
    assert len(examples()) >= 20
    for name in ws.__all__:
        assert getattr(ws, name).__doc__, name


def test_the_package_is_imported_without_others() -> None:
    code = "import sys, wavestep; print(*{'dataclasses', 'numpy', 'pandas', 'sympy', 'typing'} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], check=True, capture_output=True).stdout == b"\n"
    assert set(ws.__all__) <= set(dir(ws))
    with pytest.raises(AttributeError, match="no attribute 'stress'"):
        ws.stress  # type: ignore[attr-defined]


def test_the_python_of_the_readme(capsys: pytest.CaptureFixture[str]) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```python\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
    exec(block, {})
    printed = block.splitlines()[-1].split("# ")[1]
    assert capsys.readouterr().out == printed + "\n"
