"""Bad input raises exceptions with place and remedy; nothing else crosses the border."""

import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import wavestep as ws
from wavestep import _native

MASS = ws.scene("rigid-mass", mu=1)
F: Any = MASS.signal("f")
CURVE: Any = F.compiled(0, 2)
ROD = 'scene "A"\nbar rod { impedance = 1, travl = 1 }\nline free - rod | fixed'

BAD: dict[str, Callable[[], object]] = {
    "scene": lambda: ws.scene("rigid-mas"),
    "text": lambda: ws.read(ROD),
    "symbol": lambda: ws.scene("rigid-mass", mu=-1),
    "unset symbol": lambda: ws.scene("rigid-mass").signal("f")(1),
    "name": lambda: MASS.signal("speed"),
    "early": lambda: F(-1),
    "early array": lambda: F([0.5, -1.0]),
    "nan": lambda: F(float("nan")),
    "nan array": lambda: F(np.array([1.0, np.nan])),
    "infinite": lambda: F.digits(float("inf")),
    "word": lambda: F("one"),
    "unit": lambda: ws.scene("hopkinson").signal("force")("3"),
    "object": lambda: F(object()),
    "texts": lambda: F(["1/2"]),
    "complex": lambda: F(np.array([1j])),
    "shape": lambda: CURVE(np.zeros(3), out=np.zeros(4)),
    "same array": lambda: (lambda t: CURVE(t, out=t))(np.zeros(3)),
    "kind of out": lambda: CURVE(np.zeros(3), out=np.zeros(3, dtype="float32")),
    "outside": lambda: CURVE(2.5),
    "outside array": lambda: CURVE(np.array([0.0, 3.0, 1.0])),
    "nan in a curve": lambda: CURVE(np.array([0.0, np.nan])),
    "no digits": lambda: F.digits(1, 0),
    "negative digits": lambda: F.digits(1, -1),
    "digits": lambda: F.digits(1, 10**30),
    "method": lambda: F.values([1], method="magic"),
    "both": lambda: F.values([1], method="certified", within="1e-9"),
    "tolerance": lambda: F.values([1], within="nearly"),
    "window": lambda: F.roots(2, 1),
    "order": lambda: MASS.derive("f", 5000),
    "negative order": lambda: MASS.derive("f", [-1]),
    "bars": lambda: MASS.field(1),
    "cells": lambda: ws.scene("hopkinson").field("1 us", cells=0),
    "quantity": lambda: ws.scene("hopkinson").diagram("speed"),
    "observable": lambda: ws.scene("hopkinson").plot("speed"),
    "formula": lambda: MASS.derive("f", 0)[0].equals("exp(-s"),
}


@pytest.mark.parametrize("what", BAD)
def test_bad_input_is_told_with_a_remedy(what: str) -> None:
    with pytest.raises(ws.InputError) as caught:
        BAD[what]()
    error = caught.value
    assert isinstance(error, ws.Error) and isinstance(error, ValueError)
    remedies = [error.remedy, *(place.remedy for place in error.diagnostics)]
    assert any(remedies) or "give " in str(error)
    assert "--" not in str(error)
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


def test_mistakes_in_texts_have_their_place() -> None:
    with pytest.raises(ws.InputError) as caught:
        ws.read(ROD)
    (place,) = caught.value.diagnostics
    assert (place.line, place.column, place.width) == (2, 26, 5)
    assert place.text[place.column - 1 :][: place.width] == "travl"
    assert place.remedy == "did you mean `travel`?"
    assert str(place).splitlines()[1:3] == ["    " + place.text, " " * 29 + "^^^^^ unknown property"]
    assert str(caught.value) == str(place)


def test_panics_become_exceptions() -> None:
    with pytest.raises(ws.InternalError, match="on purpose"):
        _native._fail()


def in_another_process(code: str) -> "subprocess.Popen[str]":
    # A process that was begun in the background may have its interrupts ignored.
    first = "import signal\nimport wavestep as ws\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    run = [sys.executable, "-c", first + code]
    return subprocess.Popen(run, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


@pytest.mark.skipif(sys.platform == "win32", reason="signals differ")
@pytest.mark.parametrize(
    "work",
    [
        'ws.scene("rigid-mass", mu="1/3").signal("f").digits(1200, 10_000)',
        'ws.scene("cushioned-impact", mu="1/2").signal("force").compiled(0, 1900)',
        'ws.scene("hopkinson-with-release").diagram(end="300 ms")',
        'ws.sweep("rigid-mass", {"mu": ["1/3", "1/7"]}, max="velocity", end=300)',
    ],
)
def test_interruption_stops_work_and_leaves_the_problem_as_it_was(work: str) -> None:
    # Each would take minutes.
    code = f"""
p = ws.scene("rigid-mass", mu=1)
print("begun", flush=True)
try:
    {work}
    print("done")
except KeyboardInterrupt:
    print("stopped", p.signal("f")(0))
"""
    process = in_another_process(code)
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    try:
        assert process.communicate(timeout=30)[0] == "stopped 1.0\n"
    finally:
        process.kill()


def test_memory_is_kept_to() -> None:
    code = """
ws.set_memory(1_000_000)
try:
    print(ws.scene("hopkinson").signal("force").digits("1 s"))
except ws.Error as error:
    print(type(error).__name__, error)
"""
    told = in_another_process(code).communicate(timeout=60)[0]
    assert "memory" in told and "set_memory" in told and "--" not in told, told
