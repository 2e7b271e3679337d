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
    verdicts = [alterations.outcome(checker, altered) for checker in alterations.CHECKERS]
    if "TimeoutError" in verdicts or "MemoryError" in verdicts:
        return "refused"
    if len({verdict is None for verdict in verdicts}) > 1:
        return f"judged differently: {verdicts}"
    if verdicts[0] is not None:
        return "refused"
    return "harmless" if alterations.same_claims(altered, original) else "missed"


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
