#!/usr/bin/env python3
"""Alters certificates at random, one place at a time, and tells which alterations the checker lets pass.

An alteration that passes is harmless where the pieces, times, values and zeros are as they were: they satisfy the altered
statement too. `alterations.py COUNT FILE…` exits with 1 where any other one passes, or where the two checkers disagree;
without python-flint there is one.
"""

import copy
import json
import random
import sys
from fractions import Fraction

import check
import exact

try:
    import check_arb

    CHECKERS = [check, check_arb]
except ImportError:
    CHECKERS = [check]


MOTIONS = ("events", "reading", "readings", "extreme", "zeros")


def places(node, path=()):
    """All places of a document."""
    yield path
    for key, child in node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ():
        yield from places(child, path + (key,))


def altered_text(text, random_):
    at = random_.randrange(len(text) + 1)
    kinds = [text[:at] + random_.choice("0123456789-/se") + text[at:], text[:at] + text[at + 1 :], "-" + text]
    if at < len(text):
        kinds.append(text[:at] + random_.choice("0123456789") + text[at + 1 :])
    return random_.choice(kinds)


def alter(document, random_):
    """One alteration: of a number, a sign, a name, an exponent; or a part left out, doubled, or moved. Half of them are of
    the pieces for the most part; the others choose among what a certificate holds, so that short claims have their share."""
    path = random_.choice(list(places(document))[1:])
    if random_.random() < 0.5:
        key = random_.choice(list(document))
        path = (key,) + random_.choice(list(places(document[key])))
    parent = document
    for key in path[:-1]:
        parent = parent[key]
    key, old = path[-1], parent[path[-1]]
    if isinstance(old, str) and random_.random() < 0.9:
        parent[key] = altered_text(old, random_)
    elif isinstance(old, int) and random_.random() < 0.9:
        parent[key] = old + random_.choice([-1, 1])
    elif isinstance(parent, list) and len(parent) > 1 and random_.random() < 0.5:
        other = random_.randrange(len(parent))
        parent[key], parent[other] = parent[other], parent[key]
    elif isinstance(parent, list) and random_.random() < 0.5:
        parent.insert(key, copy.deepcopy(old))
    else:
        del parent[key]
    return path


def outcome(checker, document):
    """Why it is not proven; what cannot be read is caught as well."""
    try:
        checker.check(document)
    except Exception as error:
        return type(error).__name__
    return None


def same_functions(one, other):
    """Whether two lists hold equal expressions."""
    equal = lambda a, b: exact.is_zero(exact.accumulate(exact.read(a), exact.read(b), exact.MINUS))
    return len(one) == len(other) and all(map(equal, one, other))


def normal(node):
    """A node whose numbers are written in one way."""
    if isinstance(node, list):
        return [normal(child) for child in node]
    if isinstance(node, dict):
        return {key: normal(child) for key, child in node.items()}
    try:
        return str(Fraction(node))
    except (TypeError, ValueError):
        return node


def same_formula(one, other):
    """Whether two formulas for every n are equal, number by number, in whatever order their terms stand."""
    if one.keys() != other.keys() or not same_functions(one["first"], other["first"]):
        return False
    is_sequence = "rate" not in one
    key = lambda term: json.dumps(normal(term[:: -1 if is_sequence else 1]))
    terms = [sorted(own["terms"], key=key) for own in (one, other)]
    orders = [[term[1 if is_sequence else 0] for term in own] for own in terms]
    numbers = [[own[key] or [] for key in ("rate", "ratio", "laguerre") if key in own] for own in (one, other)]
    parts = [[part for term in own for part in (term[::2] if is_sequence else [[[[], term[1]]]])] for own in terms]
    lists = [parts[i] + [[[[], number]] for number in numbers[i]] for i in (0, 1)]
    return orders[0] == orders[1] and same_functions(*lists)


def same_claims(one, other):
    """Whether both claim the same of the waves, whatever the way in which it is written, and name the same values and zeros:
    a decimal or a bracket may hold them more closely or less so."""
    for key, same in (("pieces", same_functions), ("general", same_formula)):
        claims = [document.get(key, {}) for document in (one, other)]
        if claims[0].keys() != claims[1].keys() or not all(same(own, claims[1][wave]) for wave, own in claims[0].items()):
            return False
    if ("minus" in one) != ("minus" in other) or "minus" in one and not same_claims(one["minus"], other["minus"]):
        return False
    times = () if one.get("kind") in MOTIONS else ("at", "from", "to")
    if any(one.get(key) != other.get(key) and Fraction(one[key]) != Fraction(other[key]) for key in times):
        return False
    if one.get("kind") in MOTIONS:
        spans = [[list(map(Fraction, document[key])) for key in ("at", "from", "until") if key in document] for document in (one, other)]
        if len(spans[0]) != len(spans[1]) or not all(a[0] <= b[1] and b[0] <= a[1] for a, b in zip(*spans)):
            return False
    if one.get("goal") != other.get("goal"):
        return False
    values = [exact.decimal(document) for document in (one, other) if "value" in document]
    if values and abs(values[0][0] - values[1][0]) > values[0][1] + values[1][1]:
        return False
    rows = [[list(map(Fraction, row)) for row in document.get("values", [])] for document in (one, other)]
    is_near = lambda a, b: abs(a[0] - b[0]) <= a[1] + b[1]
    if len(rows[0]) != len(rows[1]) or not all(map(is_near, *rows)):
        return False
    if one.get("kind") in MOTIONS:  # all else is the line, which a checker follows itself: what it finds is true of that line
        names = [[event[:2] for event in document["events"]] for document in (one, other)]
        if names[0] != names[1]:
            return False
        one, other = ({"zeros": all_times(document)} for document in (one, other))
    zeros = [[list(map(Fraction, pair)) for pair in document.get("zeros", [])] for document in (one, other)]
    overlap = lambda a, b: a[0] <= b[1] and b[0] <= a[1]
    return len(zeros[0]) == len(zeros[1]) and all(map(overlap, *zeros))


def all_times(document):
    """The intervals of times that are claimed of a motion."""
    rests = [time for rest in document.get("rests", []) for time in rest]
    return [event[2:] for event in document["events"]] + document.get("zeros", []) + rests


def verdict(original, document):
    """What becomes of an alteration: refused, harmless, or what is wrong with that."""
    verdicts = [outcome(checker, document) for checker in CHECKERS]
    if None not in verdicts:
        return "refused"
    # How closely a motion is enclosed is a matter of the checker.
    is_undecided = document.get("kind") in MOTIONS and "Undecided" in verdicts
    if set(verdicts) != {None} and not is_undecided:
        return f"judged differently: {verdicts}"
    return "harmless" if same_claims(document, original) else "missed"


def main(count, files):
    random_, documents = random.Random(1), [json.load(open(file, encoding="utf-8")) for file in files]
    caught = harmless = missed = 0
    while caught + harmless + missed < count:
        original = random_.choice(documents)
        document = copy.deepcopy(original)
        path = alter(document, random_)
        if document == original:
            continue
        told = verdict(original, document)
        caught += told == "refused"
        harmless += told == "harmless"
        if told not in ("refused", "harmless"):
            missed += 1
            print(f"{told} in {original['title']} ({original['kind']}): {path}")
    print(f"{count} alterations, {len(CHECKERS)} checkers: {caught} caught, {harmless} harmless, {missed} missed")
    return missed > 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), sys.argv[2:]))
