"""Writes problems.json and values.csv: fifty delay equations with their exact solutions to 100 digits.

`python make.py` writes both anew; `--check` fails if they would change.
"""

import csv
import io
import json
import pathlib
import sys

import sympy as sp

import wavestep as ws

HERE = pathlib.Path(__file__).parent
DIGITS = 100
TIMES = ["1/2", "3/2", "10/3", "31/3", "51/2"]  # in delays
t = sp.Symbol("t", real=True)

# Terms are "coefficient, derivative, lag" of c*x^(derivative)(t - lag*delay); lag 0 is the present.
# Where `start` is not given, the solution begins as the history ends.
PROBLEMS = []


def parsed(text):
    return sp.sympify(text, {"t": t})


def add(name, terms, delay="1", history="0", forcing="0", start=None, order=1):
    ends = [str(sp.diff(parsed(history), t, j).subs(t, 0)) for j in range(order)]
    terms = [term.split() for term in terms.split(",") if not term.startswith("0 ")]
    PROBLEMS.append({
        "name": name,
        "order": order,
        "delay": delay,
        "terms": [{"c": c, "derivative": int(j), "lag": int(k)} for c, j, k in terms],
        "forcing": forcing,
        "history": history,
        "start": (start or " ".join(ends)).split(),
    })


def fill():
    for i, b in enumerate(["-1", "-1/4", "-3/2", "-2", "1/2"], 1):
        add(f"pure-delay-{i}", f"{b} 0 1", history="1")
    for i, (a, b, delay) in enumerate(
        [("-1", "-1", "1"), ("-2", "1", "1/2"), ("-1", "-3/2", "2"),
         ("1/2", "-1", "1"), ("-5", "4", "1/3")], 1
    ):
        add(f"hayes-{i}", f"{a} 0 0, {b} 0 1", delay, "1")
    for i, (a, b, delay) in enumerate(
        [("-1", "1/2", "1"), ("-1", "-1", "1"), ("-1/2", "-2", "1/3"), ("-3", "2", "2"), ("0", "-1", "1")], 1
    ):
        add(f"step-{i}", f"{a} 0 0, {b} 0 1", delay, start="1")
    for i, (history, start) in enumerate(
        [("t", None), ("1 + t", None), ("cos(t)", None), ("exp(t)", None), ("exp(-t/2)", None),
         ("t**2", "1"), ("sin(3*t)", "-1/2")], 1
    ):
        add(f"history-{i}", "-1/2 0 0, -3/4 0 1", "1", history, start=start)
    for i, forcing in enumerate(["sin(t)", "cos(2*t)", "exp(-t)", "t", "t*exp(-2*t)", "1"], 1):
        add(f"forced-{i}", "-1 0 0, -1/2 0 1", "1", forcing=forcing)
    for i, (terms, history) in enumerate(
        [("-1 0 0, 1/2 0 1, -1/3 0 2", "1"), ("-1 0 1, 1/2 0 2", "1"), ("-2 0 0, -1 0 1, 1 0 3", "cos(t)"),
         ("-1/2 0 1, -1/2 0 2", "1"), ("-1/3 0 0, -1/4 0 1, -1/5 0 2, -1/6 0 3", "1 + t")], 1
    ):
        add(f"lags-{i}", terms, "1/2", history)
    # A rigid mass strikes a bar whose far end is fixed, with mu = 1/4, 1, 4; then braked by a dashpot, then with a far
    # end that reflects a third; then no bar at all.
    for i, (terms, delay) in enumerate(
        [("-1 0 0, -1 0 1, 1 1 1", "1/2"), ("-1 0 0, -1 0 1, 1 1 1", "2"), ("-1 0 0, -1 0 1, 1 1 1", "8"),
         ("-3/2 0 0, -1/2 0 1, 1 1 1", "1/2"), ("-1 0 0, 1/3 0 1, -1/3 1 1", "1"), ("-2 0 0, 1/2 1 1", "1")], 1
    ):
        add(f"neutral-jump-{i}", terms, delay, start="1")
    for i, (terms, history) in enumerate(
        [("-1 0 0, 1/4 0 1, 1/2 1 1", "1"), ("-2 0 0, -1 0 1, -1/3 1 1", "cos(t)"), ("-1 0 1, 1/4 1 1", "1 + t"),
         ("-1 0 0, 1/3 1 1, 1/4 1 2", "exp(t)")], 1
    ):
        add(f"neutral-smooth-{i}", terms, "1", history)
    # Delayed feedback, chatter of a tool, delayed damping, a forced oscillator, and neutral ones: a mass on a spring
    # and a bar, and two with a delayed acceleration.
    for i, (terms, delay, history, forcing, start) in enumerate(
        [("-1 0 0, -1/4 0 1", "1", "1", "0", None), ("-5/4 0 0, 1/4 0 1, -1/10 1 0", "2", "0", "0", "0 1"),
         ("-1 0 0, -1/2 1 1", "1", "cos(t)", "0", None), ("-4 0 0, -1/5 1 0, 1 0 1", "1", "0", "cos(2*t)", None),
         ("-3 0 0, -1 1 0, 3 0 1, -1 1 1, 1 2 1", "1", "0", "0", "0 1"), ("-1 0 0, 1/2 2 1", "1", "1", "0", None),
         ("-2 0 0, -1 1 0, 1/3 2 1, -1/2 0 2", "1/2", "1 + t", "0", None)], 1
    ):
        add(f"second-order-{i}", terms, delay, history, forcing, start, order=2)


def lagged(expression, lag, delay):
    return expression.subs(t, t - lag * sp.Rational(delay))


def scene(p):
    """The equation of y = x - history, which is zero before t = 0, in wavestep's language."""
    phi, order, delay = parsed(p["history"]), p["order"], p["delay"]
    forcing = parsed(p["forcing"]) - sp.diff(phi, t, order)
    neutral, terms = "", ""
    for term in p["terms"]:
        c, j, k = term["c"], term["derivative"], term["lag"]
        forcing += sp.Rational(c) * lagged(sp.diff(phi, t, j), k, delay)
        index = f"[n-{k}]" if k else "[n]"
        wave = f"y{index}" if j == 0 else f"y{index}'" if order == 1 else f"v{index}" if j == 1 else f"v{index}'"
        terms += f" + ({c})*{wave}"
        if j == order:
            neutral += f" - ({c})*{'yv'[order - 1]}{index}"
    forcing = str(sp.expand(forcing)).replace("**", "^")
    starts = [sp.Rational(s) - sp.diff(phi, t, j).subs(t, 0) for j, s in enumerate(p["start"])]
    top = "yv"[order - 1]
    lines = [f'recurrence "{p["name"]}"', f"period {delay}, local s, time t"]
    if order == 2:
        lines += ["wave y, v", "equation y[n]' = v[n]", f"continuous y[n] starts at {starts[0]}"]
    else:
        lines += ["wave y"]
    lines += [f"equation {top}[n]' = {forcing}{terms}", f"continuous {top}[n]{neutral} starts at {starts[-1]}"]
    return "\n".join([*lines, f"observe x = y[n] + {str(phi).replace('**', '^')}", ""])


def equation(p):
    """For people."""
    text = ""
    for term in p["terms"]:
        at = f"t - {sp.Rational(p['delay']) * term['lag']}" if term["lag"] else "t"
        c = sp.Rational(term["c"])
        factor = "" if abs(c) == 1 else f"{abs(c)} "
        text += f" {'-' if c < 0 else '+'} {factor}x{chr(39) * term['derivative']}({at})"
    if p["forcing"] != "0":
        text += f" + {p['forcing'].replace('**', '^')}"
    return f"x{chr(39) * p['order']}(t) = " + text[1:].removeprefix("+ ")


def files():
    fill()
    table = io.StringIO()
    rows = csv.writer(table, lineterminator="\n")
    rows.writerow(["name", "t", "x"])
    for p in PROBLEMS:
        signal = ws.read(scene(p)).signal("x")
        times = [str(sp.Rational(p["delay"]) * sp.Rational(time)) for time in TIMES]
        p["equation"] = equation(p)
        p["values"] = {time: str(signal.digits(time, DIGITS).decimal(DIGITS)) for time in times}
        rows.writerows([p["name"], time, value] for time, value in p["values"].items())
    lines = ",\n".join(json.dumps(p) for p in PROBLEMS)
    return {"problems.json": f"[\n{lines}\n]\n", "values.csv": table.getvalue()}


if __name__ == "__main__":
    for name, text in files().items():
        if "--check" not in sys.argv:
            (HERE / name).write_text(text, encoding="utf-8")
        elif (HERE / name).read_text(encoding="utf-8") != text:
            sys.exit(f"{name} would change")
    print(f"{len(PROBLEMS)} problems")
