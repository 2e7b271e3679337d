"""Formulas, events, fields and pictures."""

import dataclasses
from fractions import Fraction
from xml.etree import ElementTree

import numpy as np
import pytest
import sympy

import wavestep as ws


def test_formulas_are_the_same_in_sympy() -> None:
    s, mu = sympy.symbols("s mu")
    f = [formula.sympy() for formula in ws.scene("rigid-mass").derive("f", range(2))]
    assert f[0] == sympy.exp(-s)
    assert sympy.simplify(f[1] - sympy.exp(-s) * (1 - 2 * s + sympy.exp(-2 * mu))) == 0
    # The value of f[n] in the third period is that of the signal.
    third = ws.scene("rigid-mass").derive("f", 2)[0]
    value = third.sympy().subs({mu: sympy.Rational(1, 4), s: sympy.Rational(1, 5)}).evalf(30)
    digits = ws.scene("rigid-mass", mu="1/4").signal("f").digits("6/5", 30)
    assert abs(value - sympy.Float(str(digits), 30)) < 1e-28
    assert third.order == 2 and third.latex().startswith(r"\begin{align*}")
    assert third._repr_latex_().startswith(r"$$\begin{aligned}")


@pytest.mark.parametrize("name", ws.SCENES)
def test_formulas_of_all_scenes_are_read_by_sympy(name: str) -> None:
    problem = ws.scene(name)
    try:
        formulas = problem.derive((problem.waves or problem.observables)[0], range(3))
    except ws.UnsupportedError as error:
        assert "local contact" in str(error)
        return
    for formula in formulas:
        # The text that SymPy writes is read as the same function.
        text = str(formula.sympy()).replace("**", "^")
        assert formula.equals(text), formula


def test_orders_in_any_way() -> None:
    problem = ws.scene("rigid-mass")
    all_of_them = problem.derive("f", range(6))
    assert problem.derive("f", [4, 2, 3]) == [all_of_them[n] for n in (4, 2, 3)]
    assert problem.derive("f", range(0, 6, 5)) == [all_of_them[0], all_of_them[5]]
    assert problem.derive("f", []) == []


def test_events() -> None:
    history = ws.scene("saint-venant", mu=1).events(digits=12)
    assert [event.kind for event in history.events] == ["impact", "opening", "closing", "opening"]
    opening = history.events[1]
    assert (str(opening.time), opening.between) == ("3.06766764162", ("hammer", "rod"))
    assert history.ending == "parted" and history.until is None
    assert float(history.contacts[0].impulses[0]) == pytest.approx(1.68761893980065)
    energies = [body.energy for body in opening.bodies]
    assert sum(float(energy) for energy in energies if energy is not None) == pytest.approx(0.5)
    assert history.to_frame()["time"].tolist() == [float(event.time) for event in history.events]
    assert "opening" in history._repr_html_()
    short = ws.scene("saint-venant", mu=1).events(until=2)
    assert len(short.events) == 1 and short.until is not None and short.until.exact == 2
    with pytest.raises(dataclasses.FrozenInstanceError):
        opening.kind = "closing"  # type: ignore[misc]


def test_fields() -> None:
    # A rod with velocity 1 strikes a wall; at 1/2 its right half stands still.
    rod = ws.read(
        'scene "A"\nbar rod { impedance = 2, travel = 1, velocity = 1 }\nline free - rod | fixed'
    )
    field = rod.field("1/2", cells=4)
    (bar,) = field.bars
    assert field.time == Fraction(1, 2) and bar.x.tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert bar.velocity.tolist() == [1, 1, 0, 0, 0] and bar.force.tolist() == [0, 0, 2, 2, 2]
    assert not bar.bounds["velocity"].any()
    averages = rod.field("3/8", cells=4, averages=True)
    assert averages.bars[0].velocity.tolist() == [1, 1, 0.5, 0]
    assert averages.to_frame().shape == (4, 6)
    assert field.to_frame().columns.tolist()[:3] == ["bar", "x", "velocity"]


def test_pictures_are_pictures() -> None:
    bars = ws.scene("hopkinson")
    for picture in (bars.plot(end="300 us"), bars.plot("force"), bars.diagram("strain")):
        assert ElementTree.fromstring(picture._repr_svg_()).tag.endswith("svg")
    assert ElementTree.fromstring(bars.signal("force")._repr_svg_()).tag.endswith("svg")
    assert "<td>force" in ws.scene("hopkinson")._repr_html_().replace(", force", "<td>force")


def test_values_of_exact_numbers() -> None:
    value = ws.scene("rigid-mass", mu=1).signal("strain_fixed").digits(1)
    assert value.exact == Fraction(-2) and float(value) == -2 and set(value.bounds) == {Fraction(-2)}
    assert np.isclose(float(value.decimal()), -2) and float(value.mpf()) == -2
