"""What a quantity is between arrivals, and what follows: values, doubles, zeros and extrema."""

from fractions import Fraction

from exact import MINUS, ROOTS, accumulate, add, decimal, is_count, is_zero, number, put, rational, read, read_function, sign
from exact import sign_on, slope
from pieces import check_pieces
from reading import need


def check_scenes(cert):
    """The scene with its pieces, and the one that is subtracted, if any: it has the same time."""
    scenes = [(cert, check_pieces(cert))]
    if "minus" in cert:
        need(all(cert["minus"][time] == cert[time] for time in ("time", "local")), "the times have different names")
        need("minus" not in cert["minus"], "a third scene")
        scenes.append((cert["minus"], check_pieces(cert["minus"])))
    return scenes


def seen(scenes, begin):
    """A quantity as an expression in scene time, from a time on, less that of a second scene, and when a next piece begins."""
    (cert, pieces), *others = scenes
    period, t, total, end = number(read_function(cert["period"])).get((), 0), cert["time"], {}, None
    need(begin >= 0, "the time is before the start")
    for wave, kind, delay, coefficient in cert["observed"]["waves"]:
        need(wave in pieces and kind in ("value", "slope"), f"unknown wave {wave} or operator {kind}")
        n = (begin - rational(delay)) // period
        end = min(filter(None, (end, rational(delay) + (max(n, -1) + 1) * period)))
        if n >= 0:
            need(n < len(pieces[wave]), "a period is missing")
            piece = slope(pieces[wave][n], cert["local"]) if kind == "slope" else pieces[wave][n]
            local = add({(): {((t, 1),): 1}}, {(): {(): -rational(delay) - n * period}})
            accumulate(total, put(piece, cert["local"], local), read(coefficient))
    accumulate(total, read(cert["observed"]["forcing"]))
    if others:
        less_, next_ = seen(others, begin)
        accumulate(total, less_, MINUS)
        end = min(filter(None, (end, next_)), default=None)
    for symbol in (symbol for symbol, square in ROOTS.items() if square == -1):  # the conjugate is the same
        need(is_zero(accumulate(put(total, symbol, {(): {((symbol, 1),): -1}}), total, MINUS)), "the quantity is not real")
    return total, end


def lifted(expression, by):
    return accumulate(accumulate({}, expression), {(): {(): {(): by}}})


def cells(cert, scenes, level):
    """Intervals without gaps from the first time of the window to the last, each with the quantity less a level and a
    derivative that has one sign there. That of order 0 is the quantity itself; with that of order 1, or of order k where
    those of orders 1 ... k - 1 are zero at one end, the quantity is strictly monotone; without one it is the level."""
    t, time = cert["time"], rational(cert["from"])
    need(time < rational(cert["to"]), "the window is empty")
    for begin, end, order in cert["cells"]:
        begin, end = rational(begin), rational(end)
        need(begin == time and begin < end, "the intervals have gaps")
        expression, next_ = seen(scenes, begin)
        need(next_ is None or end <= next_, "a wave arrives within an interval")
        expression = lifted(expression, -level)
        if order is None:
            need(is_zero(expression), "the quantity is not constant")
            yield begin, end, expression, order, 0
        else:
            need(type(order) is int and 0 <= order <= 64, "an order is no number")
            derivatives = [expression]
            for _ in range(order):
                derivatives.append(slope(derivatives[-1], t))
            flat = lambda at: all(sign(derivative, t, at) == 0 for derivative in derivatives[1:-1])
            need(flat(begin) or flat(end), "the derivatives between do not vanish")
            yield begin, end, expression, order, sign_on(derivatives[-1], t, begin, end)
        time = end
    need(time == rational(cert["to"]), "the intervals end early or late")


def check_value(cert):
    """The decimal is the value, correctly rounded."""
    time, (claim, slack) = rational(cert["at"]), decimal(cert)
    expression, _ = seen(check_scenes(cert), time)
    need(sign(lifted(expression, slack - claim), cert["time"], time) >= 0, "the value is another one: smaller")
    need(sign(lifted(expression, -slack - claim), cert["time"], time) <= 0, "the value is another one: larger")


def evenly_spaced(begin, end, count):
    need(is_count(count) and count > 0 and begin <= end, "no times, or they run backwards")
    return [begin + (end - begin) * i / max(count - 1, 1) for i in range(count)]


def check_doubles(cert):
    """Each value, one at each of evenly spaced times, is off by its bound at most."""
    scenes, t, times_ = check_scenes(cert), cert["time"], evenly_spaced(*map(rational, (cert["from"], cert["to"])), cert["points"])
    need(len(times_) == len(cert["values"]), "a value is missing, or there is one too many")
    for time, (value, off) in zip(times_, ([rational(own) for own in row] for row in cert["values"])):
        expression, _ = seen(scenes, time)
        is_near = sign(lifted(expression, off - value), t, time) >= 0 >= sign(lifted(expression, -off - value), t, time)
        need(is_near, f"the value at {time} is another one")


def check_roots(cert):
    """Zeros, also of limits where waves arrive, are where monotone parts change sign, or at ends of intervals."""
    t, found = cert["time"], []
    for begin, end, expression, order, _ in cells(cert, check_scenes(cert), Fraction(0)):
        if order is None:
            zeros = [(begin, end)]
        elif order == 0:
            continue
        else:
            zeros = [(at, at) for at in (begin, end) if sign(expression, t, at) == 0]
            if sign(expression, t, begin) * sign(expression, t, end) < 0:
                found.append((begin, end, expression))
        for first, last in zeros:
            joins = found and found[-1][2] is None and found[-1][1] == first
            found.append((found.pop()[0] if joins else first, last, None))
    claims = [tuple(map(rational, claim)) for claim in cert["zeros"]]
    need(len(claims) == len(found), f"{len(found)} zeros instead of {len(claims)}")
    need(all(a[1] < b[0] for a, b in zip(claims, claims[1:])), "two zeros are in one place")
    for (low, high), (begin, end, expression) in zip(claims, found):
        if expression is None:
            need((low, high) == (begin, end) if begin < end else low <= begin <= high, f"the zero at {begin} is not told")
        else:
            low, high = max(low, begin), min(high, end)
            need(low < high and sign(expression, t, low) * sign(expression, t, high) < 0, f"the zero after {begin} is not told")


def check_extremum(cert):
    """Nothing is beyond the rounded value by more than half a unit of its last place, and something comes as near to it. A
    distance is the larger of the largest value and of the negative of the smallest."""
    ways = {"largest": [1], "smallest": [-1], "distance": [1, -1]}[cert["goal"]]
    (claim, slack), t, (place, time), scenes, is_taken = decimal(cert), cert["time"], cert["attained"], check_scenes(cert), False
    for way in ways:
        bound = (way * claim if len(ways) > 1 else claim) + way * slack
        for i, (begin, end, expression, order, sign_) in enumerate(cells(cert, scenes, bound)):
            signs = [sign_] if order in (None, 0) else [sign(expression, t, at) for at in (begin, end)]
            need(all(sign_ * way <= 0 for sign_ in signs), f"a value between {begin} and {end} is beyond the extremum")
            if i == place and begin <= rational(time) <= end:
                is_taken |= sign(lifted(expression, 2 * way * slack), t, rational(time)) * way >= 0
    need(is_taken, "the extremum is not taken where it is said")
