"""Runs SciPy, JiTCDDE and diffrax on six of the problems, and writes errors and times into docs/delay-equations.md."""

import importlib.metadata
import json
import pathlib

from solvers import SOLVERS, error, place, processor, short

HERE = pathlib.Path(__file__).parent
CHOSEN = ["pure-delay-4", "history-3", "lags-1", "neutral-smooth-1", "second-order-4", "neutral-jump-2"]

if __name__ == "__main__":
    problems = {p["name"]: p for p in json.loads((HERE / "problems.json").read_text(encoding="utf-8"))}
    installed = {}
    for name in SOLVERS:
        try:
            installed[name] = importlib.metadata.version(name.lower())
        except importlib.metadata.PackageNotFoundError:
            print(f"{name} is not installed")
    rows = [
        "| problem | equation |" + "".join(f" {name} {version} |" for name, version in installed.items()),
        "|---|---|" + "---|" * len(installed),
    ]
    for name in CHOSEN:
        p, cells = problems[name], []
        for solver in installed:
            found, spent, prepared = SOLVERS[solver][0](p)
            ready = f" + {short(prepared)}" if prepared else ""
            cells.append(f"{error(p, found):.0e}, {short(spent)}{ready}")
        rows.append(f"| `{name}` | {p['equation']} | {' | '.join(cells)} |")
    rows += ["", *[f"- {name}: {SOLVERS[name][1]}." for name in installed]]
    rows += [f"- One run on one core of {processor()}."]
    print("\n".join(rows))
    place(HERE.parents[1] / "docs/delay-equations.md", rows)
