"""How certificates are read, refused and told, by both checkers; nothing is proven here."""

import json
import sys


class Wrong(Exception):
    """What a certificate claims does not follow."""


class Undecided(Wrong):
    """Enclosures do not tell whether it follows."""


# What Python raises where a certificate is not laid out as it should be.
MALFORMED = (LookupError, TypeError, ValueError, ArithmeticError, AttributeError, RecursionError, MemoryError)


def need(claim, told):
    if not claim:
        raise Wrong(told)


def decided(claim, told):
    if not claim:
        raise Undecided(told)


def printable(text):
    """On one line, without what a terminal would obey."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def one_each(pairs):
    """An object without repeated keys."""
    if len(dict(pairs)) < len(pairs):
        raise ValueError("a key stands twice")
    return dict(pairs)


def short(text):
    if len(text) > 12:
        raise ValueError("a number is too long")
    return int(text)


def no_number(text):
    raise ValueError(f"{text[:40]} is neither a text nor an integer")


def load(name):
    with open(name, encoding="utf-8") as file:
        ways = {"object_pairs_hook": one_each, "parse_int": short, "parse_float": no_number, "parse_constant": no_number}
        return json.load(file, **ways)


def judged(name, check):
    """Whether a file is proven, and what is told of it."""
    try:
        certificate = load(name)
    except (OSError, ValueError, RecursionError) as error:
        return False, f"cannot be read: {error}"
    try:
        check(certificate)
    except Wrong as error:
        return False, f"NOT proven: {error}"
    except MALFORMED as error:
        return False, f"NOT proven: it is not laid out as it should be: {error!r}"
    return True, f"proven ({certificate['kind']} of {json.dumps(certificate['title'], ensure_ascii=False)})"


def files(usage):
    """The names of files on the command line."""
    if not sys.argv[1:] or sys.argv[1].startswith("-"):
        print(f"usage: {sys.argv[0]} {usage}", file=sys.stderr)
        sys.exit(2)
    sys.set_int_max_str_digits(0)  # numbers have bounds of their own
    return sys.argv[1:]


def main(check):
    names = files("CERTIFICATE.json ...")
    sys.stdout.reconfigure(errors="backslashreplace")
    verdicts = [judged(name, check) for name in names]
    print("\n".join(printable(f"{name}: {told}") for name, (_, told) in zip(names, verdicts)))
    sys.exit(not all(proven for proven, _ in verdicts))
