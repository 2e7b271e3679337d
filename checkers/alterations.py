#!/usr/bin/env python3
"""Alters certificates at random, one place at a time, and tells which alterations the checker lets pass.

An alteration that passes is harmless where the pieces, the time and the value are as they were: they satisfy the altered
statement too. `alterations.py COUNT FILE…` exits with 1 where any other one passes.
"""

import copy
import json
import random
import sys
from fractions import Fraction

import check


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
    """One alteration: of a number, a sign, a name, an exponent; or a part left out, doubled, or moved."""
    path = random_.choice(list(places(document))[1:])
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


def outcome(document):
    try:
        check.check(document)
    except Exception as error:  # what cannot be read is caught as well
        return type(error).__name__
    return None


def same_claims(one, other):
    """Whether both claim the same of the waves, whatever the way in which it is written."""
    minus = {(): {(): {(): -1}}}
    equal = lambda a, b: check.is_zero(check.accumulate(check.read(a), check.read(b), minus))
    pieces = [document["pieces"] for document in (one, other)]
    if pieces[0].keys() != pieces[1].keys():
        return False
    for wave, functions in pieces[0].items():
        others = pieces[1][wave]
        if len(functions) != len(others) or not all(map(equal, functions, others)):
            return False
    numbers = lambda document: [Fraction(document.get(key, 0)) for key in ("value", "at")]
    return numbers(one) == numbers(other)


def main(count, files):
    random_, documents = random.Random(1), [json.load(open(file, encoding="utf-8")) for file in files]
    caught = harmless = missed = 0
    while caught + harmless + missed < count:
        original = random_.choice(documents)
        document = copy.deepcopy(original)
        path = alter(document, random_)
        if document == original:
            continue
        if outcome(document) is not None:
            caught += 1
        elif same_claims(document, original):
            harmless += 1
        else:
            missed += 1
            print(f"missed in {original['title']} ({original['kind']}): {path}")
    print(f"{count} alterations: {caught} caught, {harmless} harmless, {missed} missed")
    return missed > 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), sys.argv[2:]))
