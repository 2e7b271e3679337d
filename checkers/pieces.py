"""Pieces: functions on the first periods that satisfy the laws, and are the only ones that do."""

from exact import LATEST, MINUS, ROOTS, accumulate, is_count, is_zero, number_at, on_period, put, read, read_form
from exact import read_function
from laws import laws
from reading import need


def rank(rows):
    rows, found = [row[:] for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((row for row in rows[found:] if row[column]), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        rows.insert(found, pivot)
        found += 1
        for row in rows[found:]:
            share = row[column] / pivot[column]
            row[:] = [a - share * b for a, b in zip(row, pivot)]
    return found


def check_determined(equations, continuity, waves):
    """No other functions satisfy the statement: what has no derivatives on the period itself, differentiated, and the
    other equations determine all derivatives there; with what is continuous, all values at its start."""
    values = {}

    def row(form, kind):
        return [number_at(form.get((wave, kind, 0), {}), values) for wave in waves]

    slopes = [row(equation, "slope") for equation in equations]
    levels = [row(equation, "value") for equation in equations]
    plain = [level for level, slope_ in zip(levels, slopes) if not any(slope_)]
    starts = [row(form, "value") for form, _ in continuity]
    need(rank([r for r in slopes if any(r)] + plain) == len(waves), "the equations leave derivatives open")
    need(rank(starts + plain) == len(waves), "what is continuous leaves values open")


def statement(cert):
    """Forms that are zero on each period, and continuous ones with their starts: as stated, or as the drawing has them."""
    if "line" in cert:
        return laws(cert)
    return list(map(read_form, cert["equations"])), [(read_form(law), read(law["start"])) for law in cert["continuity"]]


def holds(rows, *symbols):
    """Whether a symbol stands anywhere in what is written of polynomials."""
    if isinstance(rows, dict):
        return any(symbol in rows for symbol in symbols)
    return isinstance(rows, list) and any(holds(row, *symbols) for row in rows)


def check_symbols(cert):
    """Times, waves and roots have names apart, periods are positive, and nothing depends on a time where it must not."""
    local, time, waves = cert["local"], cert["time"], cert["waves"]
    need(all(type(name) is str and name for name in [local, time, *waves]) and local != time, "names of times or waves")
    need(not ROOTS.keys() & {local, time, *waves}, "a time or a wave is no root")
    need("pi" not in {local, time, *waves, *ROOTS, *cert.get("numbers", {})}, "pi is the number")
    # Claims hold where the period is positive; a number is, and any other period for some positive numbers if not all is less.
    period = read_function(cert["period"])
    tops = [c for top in period.values() for c in top.values()]
    factors = [c for below in period for factor, _ in below for _, c in factor]
    is_number = all(not m for top in period.values() for m in top) and all(not m for below in period for f, _ in below for m, _ in f)
    is_positive = number_at({(): period}, {}) > 0 if is_number else any(c > 0 for c in tops) or any(c < 0 for c in factors)
    need(is_positive and not holds(cert["period"], "pi", *ROOTS), "a period is not positive")
    forms = [] if "line" in cert else cert["equations"] + cert["continuity"]
    elements = cert.get("line", [])
    fixed = [cert["period"]] + [element[key] for element in elements for key in element if key != "course"]
    fixed += [c for form in forms for *_, c in form["waves"]] + [form["start"] for form in forms if "start" in form]
    of_time = [element["course"] for element in elements if "course" in element] + [function for form in forms for _, function in form["forcing"]]
    if "observed" in cert:
        fixed += [c for *_, c in cert["observed"]["waves"]]
        of_time.append(cert["observed"]["forcing"])
    general = list(cert.get("general", {}).values())
    fixed += [own[key] for own in general for key in own if key != "first"]
    of_local = list(cert.get("pieces", {}).values()) + [own["first"] for own in general]
    need(not holds(fixed, local, time), "a number depends on time")
    need(not holds(of_time, local) and not holds(of_local, time), "a function depends on another time")


def check_statement(cert):
    """The laws, which are as many as waves and have one solution."""
    check_symbols(cert)
    equations, continuity = statement(cert)
    need(type(cert["waves"]) is list, "waves are a list")
    need(len(equations) == len(cert["waves"]) == len(set(cert["waves"])), "waves and equations")
    named = {wave for form in equations + [form for form, _ in continuity] for wave, *_ in form} - {None}
    need(named <= set(cert["waves"]), "a law of an unknown wave")
    check_determined(equations, continuity, cert["waves"])
    return equations, continuity


def check_periods(cert, equations, continuity, pieces):
    """Every equation holds on every period; what is continuous is, and starts as stated."""
    zero, end = {(): {(): 0}}, read_function(cert["period"])
    for n in range(min(map(len, pieces.values()))):
        for i, equation in enumerate(equations):
            need(is_zero(on_period(equation, pieces, n, cert)), f"equation {i} on period {n}")
        for i, (form, start) in enumerate(continuity):
            begin = put(on_period(form, pieces, n, cert), cert["local"], zero)
            before = put(on_period(form, pieces, n - 1, cert), cert["local"], end) if n else start
            accumulate(begin, before, MINUS)
            need(is_zero(begin), f"continuity {i} at the start of period {n}")


def check_pieces(cert):
    """The pieces satisfy the laws, and nothing else does so."""
    pieces = {wave: [read(piece) for piece in all_] for wave, all_ in cert["pieces"].items()}
    need(set(pieces) == set(cert["waves"]), "waves and pieces")
    need(is_count(cert["through"], LATEST), "a period is no number, or too late")
    need(all(len(all_) == cert["through"] + 1 for all_ in pieces.values()), "pieces are missing")
    check_periods(cert, *check_statement(cert), pieces)
    return pieces
