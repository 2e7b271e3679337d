"""Formulas for every n: the first ones satisfy the laws, and from some n on all do, by one identity."""

import json
import math
from fractions import Fraction

from exact import MINUS, ONE, accumulate, frozen, is_count, is_zero, key_of, plus, power, put, read, read_function, slope
from exact import times
from pieces import check_periods, check_statement
from reading import need


def check_general(cert):
    equations, continuity = check_statement(cert)
    equations = list(map(without_sums, equations))
    forms, laws_ = cert["general"], equations + [form for form, _ in continuity]
    keys = [key for form in laws_ for key in form]
    need(set(forms) == set(cert["waves"]) and '"#' not in json.dumps(cert), "waves, formulas, or names of symbols")
    need(all(is_free(c, cert) for form in laws_ for (_, kind, _), c in form.items() if kind != "forcing"), "a coefficient")
    kinds = {kind for form, _ in continuity for _, kind, _ in form}
    need(kinds <= {"value", "forcing"}, "a sum or a slope that is continuous")
    latest = max(lag for _, _, lag in keys)
    if all("rate" in own for own in forms.values()):
        check_echoes(cert, equations, continuity, latest)
    else:
        check_sequences(cert, equations, continuity, latest)


def without_sums(form):
    """With sums over all earlier periods: less the same form one period before, which holds as well."""
    if all(kind != "sum" for _, kind, _ in form):
        return form
    total = {}
    for (wave, kind, lag), c in form.items():
        parts = ({(wave, "value", lag + 1): c},) if kind == "sum" else ({(wave, kind, lag): c}, times(MINUS, {(wave, kind, lag + 1): c}))
        total = plus(total, *parts)
    return total


def is_free(expression, cert):
    return all(is_zero(slope(expression, cert[time])) for time in ("local", "time"))


def check_sequences(cert, equations, continuity, latest):
    """Waves that are constant on each period: sums of c n^j r^n. Each r^n is as good as a symbol of its own."""
    need(not continuity and all(kind != "slope" for form in equations for _, kind, _ in form), "derivatives of sequences")
    forms = {wave: [(read(c), j, read(ratio)) for c, j, ratio in own["terms"]] for wave, own in cert["general"].items()}
    begins = latest + max(len(own["first"]) for own in cert["general"].values()) + 1

    def value(wave, n):
        first, total = cert["general"][wave]["first"], {}
        if n < len(first):
            return read(first[n])
        for c, j, ratio in forms[wave]:
            accumulate(total, c, power(ratio, n, {(): {(): {(): Fraction(n) ** j}}}))
        return total

    need(all(is_free(part, cert) for own in forms.values() for c, _, ratio in own for part in (c, ratio)), "a sequence")
    need(all(is_count(j) for own in forms.values() for _, j, _ in own), "a power is no integer, or too large")
    pieces = {wave: [value(wave, n) for n in range(begins)] for wave in forms}
    check_periods(cert, equations, continuity, pieces)
    for i, equation in enumerate(equations):
        sums = {}  # by ratios, times their powers n - latest
        for (wave, kind, lag), coefficient in equation.items():
            if kind == "forcing":
                need(is_free(coefficient, cert), "a load that changes")
                accumulate(sums.setdefault(key_of({(): ONE}), {}), coefficient)
                continue
            for c, j, ratio in forms[wave]:
                before = {(): {(): {(("#n", 1),): 1, (): Fraction(-lag)}}}
                factor = power(ratio, latest - lag, power(before, j, c))
                accumulate(sums.setdefault(key_of(ratio), {}), coefficient, factor)
        need(all(map(is_zero, sums.values())), f"equation {i} for every n")


def check_echoes(cert, equations, continuity, latest):
    """Waves are sums of echoes, w(t) = sum of e_k(t - k D), so laws hold for each delay k D; from some k on, with T_k Laguerre's
    polynomials L_k(c x) or x^k/k!,  e_k(x) = r^k exp(-b x) (sum of c_i T_(k-i)(x)).  Laplace's transform of exp(-b x) T_k(x) is
    v^k/u^(k+1) with u = p + b, and v = u - c or 1; that of a slope is p times that of the function, less its value at 0."""
    s, forms, functions = cert["local"], cert["general"], {(): ONE}
    need(all(is_count(i) for own in forms.values() for i, _ in own["terms"]), "an echo is no number, or too late")
    begins = 2 + latest + max(max([len(own["first"])] + [i for i, _ in own["terms"]]) for own in forms.values())
    some = next(iter(forms.values()))
    same = ("rate", "ratio", "laguerre")
    need(all([own[key] for key in same] == [some[key] for key in same] for own in forms.values()), "different echoes")
    b, r = ({(): read_function(some[key])} for key in ("rate", "ratio"))
    c = None if some["laguerre"] is None else {(): read_function(some["laguerre"])}
    need(c is None or not is_zero(c), "Laguerre's polynomials of nothing")
    symbol = lambda name: {(): {(): {((name, 1),): 1}}}
    terms = {wave: [(i, {(): read_function(own_c)}) for i, own_c in own["terms"]] for wave, own in forms.items()}
    need(all(is_free(part, cert) for part in [b, r, c or b] + [c_ for own in terms.values() for _, c_ in own]), "an echo")

    def basic(k):
        """T_k(x)."""
        need(k >= 0, "an echo before the first one")
        if not c:
            return power(symbol(s), k, {(): {(): {(): Fraction(1, math.factorial(k))}}})
        total, minus = {}, accumulate({}, accumulate({}, c, MINUS), symbol(s))
        for j in range(k + 1):
            accumulate(total, power(minus, j, {(): {(): {(): Fraction(math.comb(k, j), math.factorial(j))}}}))
        return total

    def echo(wave, k):
        if k < len(forms[wave]["first"]):
            return read(forms[wave]["first"][k])
        total = {}
        for i, c_i in terms[wave]:
            accumulate(total, basic(k - i), c_i)
        decay = {frozen(accumulate({}, accumulate({}, b, MINUS), symbol(s))[()]): functions[()]}
        return power(r, k, accumulate({}, total, decay))

    def late(form, k):
        """What a form has of the delay k D."""
        total = {}
        for (wave, kind, lag), coefficient in form.items():
            if kind == "forcing" and lag == k:
                accumulate(total, put(coefficient, cert["time"], symbol(s)[()]))
            elif kind != "forcing" and lag <= k:
                known = echo(wave, k - lag)
                accumulate(total, slope(known, s) if kind == "slope" else known, coefficient)
        return total

    for k in range(begins):
        need(all(is_zero(late(equation, k)) for equation in equations), f"an equation for echo {k}")
        for form, start in continuity:
            value = put(late(form, k), s, {(): {(): 0}})
            need(is_zero(accumulate(value, {} if k else start, MINUS)), f"continuity of echo {k}")

    p = symbol("#p")
    u = accumulate(accumulate({}, p), b)
    v = accumulate(accumulate({}, u), c, MINUS) if c else functions
    orders = [lag + i for form in equations for wave, kind, lag in form if wave for i, _ in terms[wave]]
    for form, kinds in [(equation, ("slope",)) for equation in equations] + [(form, ("value",)) for form, _ in continuity]:
        transform, start = {}, {}  # over r^(k - latest) (v/u)^k and over r^(k - latest)
        for (wave, kind, lag), coefficient in form.items():
            for i, c_i in terms.get(wave, ()):
                j, own = lag + i, power(r, latest - lag, accumulate({}, coefficient, c_i))
                whole_ = power(v, max(orders) - j, power(u, j - min(orders), own))
                accumulate(transform, whole_, p if kind == "slope" else functions)
                accumulate(start, own if kind in kinds and c else {})
        need(kinds == ("value",) or is_zero(transform), "an equation for all later echoes")
        need(is_zero(start), "the values with which all later echoes begin")
