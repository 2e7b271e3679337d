"""Judges altered certificates: a line `[original, altered]` in, a line out: refused, harmless, or what is wrong."""

import json
import pathlib
import resource
import signal
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "checkers"))
import alterations

# An alteration may make a number so long that only time or memory refuse it.
SECONDS, BYTES = 20, 2 << 30


def late(*_):
    raise TimeoutError


def verdict(original, altered):
    if altered == original:
        return "harmless"
    told = alterations.verdict(original, altered)
    return "refused" if "TimeoutError" in told or "MemoryError" in told else told


signal.signal(signal.SIGALRM, late)
resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
for line in sys.stdin:
    signal.alarm(SECONDS)
    try:
        told = verdict(*json.loads(line))
    except Exception as error:
        told = f"not judged: {error!r}"
    signal.alarm(0)
    print(told, flush=True)
