"""Speed of the package: python crates/python/bench.py [--rust]

The rigid mass on a fixed bar, mu = 1, through 201 periods, as in docs/performance.md. With --rust the benchmark of the
library runs in between, and the share of its speed is told.
"""

import json
import pathlib
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from fractions import Fraction

import numpy as np

import wavestep as ws

END = 402
POINTS = 10_000_000
ROOT = pathlib.Path(__file__).parents[2]


def runs(work: Callable[[], object], times: int = 20) -> list[float]:
    """How long each of several runs takes, in seconds."""

    def once() -> float:
        begun = time.perf_counter()
        work()
        return time.perf_counter() - begun

    return [once() for _ in range(times)]


def best(work: Callable[[], object]) -> float:
    """The shortest of several runs, in seconds."""
    return min(runs(work))


def rust() -> float:
    """Seconds for the same values in the benchmark of the library, at the median of the best instructions."""
    group = "rigid-mass mu=1 n≤200/compiled ascending"
    command = ["cargo", "bench", "-q", "-p", "wavestep-benches", "--bench", "methods", "--", group]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    samples = (ROOT / "target/criterion").glob("rigid-mass mu=1*/compiled ascending/*/new/sample.json")

    def middle(file: pathlib.Path) -> float:
        sample: dict[str, list[float]] = json.loads(file.read_text())
        return statistics.median(t / n for t, n in zip(sample["times"], sample["iters"], strict=True)) / 1e9

    return min(map(middle, samples))


def import_time() -> float:
    """Seconds that `import wavestep` adds to the start of Python."""
    run = [sys.executable, "-c"]
    return best(lambda: subprocess.run([*run, "import wavestep"], check=True)) - best(
        lambda: subprocess.run([*run, ""], check=True)
    )


def main() -> None:
    f = ws.scene("rigid-mass", mu=1).signal("f")
    times = np.arange(POINTS) * (END / POINTS)
    curve = f.compiled(0, END)
    values = np.empty_like(times)
    own = runs(lambda: curve(times, out=values))
    if "--rust" in sys.argv:
        library = rust()
        middle = statistics.median(own + runs(lambda: curve(times, out=values)))
        print(f"10^7 values: {middle * 1e3:.1f} ms, {library / middle:.0%} of the speed in Rust ({library * 1e3:.1f} ms)")
    copied = best(lambda: np.copyto(values, times))
    fresh = best(lambda: curve(times))
    print(f"10^7 values into a given array {min(own) * 1e3:.1f} ms, into a new one {fresh * 1e3:.1f} ms")
    print(f"10^7 doubles copied: {copied * 1e3:.1f} ms")
    some = np.random.default_rng(1).uniform(0, END, 1000)
    print(f"1000 certified values: {best(lambda: f(some)) * 1e3:.2f} ms")
    many, one = 2000, 1.5
    print(f"one value of a curve: {best(lambda: [curve(one) for _ in range(many)]) / many * 1e6:.2f} us")
    short = ws.scene("rigid-mass", mu=1).signal("f")
    half = Fraction(1, 2)
    print(f"one certified value: {best(lambda: short(half)) * 1e6:.0f} us")
    print(f"import wavestep: {import_time() * 1e3:.1f} ms")


if __name__ == "__main__":
    main()
