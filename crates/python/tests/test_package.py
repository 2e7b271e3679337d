"""Examples, and what the package costs."""

import doctest
import pathlib
import re
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
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


def best(work: Callable[[], object], times: int = 10) -> float:
    def once() -> float:
        begun = time.perf_counter()
        work()
        return time.perf_counter() - begun

    return min(once() for _ in range(times))


def test_calls_cost_little() -> None:
    f = ws.scene("rigid-mass", mu=1).signal("f")
    curve, times = f.compiled(0, 402), np.random.default_rng(1).uniform(0, 402, 1000)
    assert best(lambda: f(times)) < 5e-3
    assert best(lambda: [curve(1.5) for _ in range(1000)]) < 1000 * 20e-6


def test_the_package_is_imported_quickly_and_without_others() -> None:
    run = [sys.executable, "-c"]
    code = "import sys, wavestep; assert not {'numpy', 'sympy', 'pandas'} & set(sys.modules)"
    subprocess.run([*run, code], check=True)
    bare = best(lambda: subprocess.run([*run, ""], check=True))
    assert best(lambda: subprocess.run([*run, "import wavestep"], check=True)) - bare < 30e-3


def test_the_python_of_the_readme(capsys: pytest.CaptureFixture[str]) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```python\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
    exec(block, {})
    printed = block.splitlines()[-1].split("# ")[1]
    assert capsys.readouterr().out == printed + "\n"
