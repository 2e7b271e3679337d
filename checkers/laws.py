"""From the drawing of a line to its laws: linear forms that are zero on each period, and others that are continuous."""

from exact import LATEST, MINUS, ONE, add, is_zero, less, number_at, plus, put, read, read_function, slope, times, whole
from reading import need


def periods(rows, cert):
    """How many periods a time is; the far end of an endless bar has none."""
    if rows is None:
        return None
    values, time, period = {}, read_function(rows), read_function(cert["period"])
    count = number_at({(): time}, values) / number_at({(): period}, values)
    need(is_zero({(): add(add({}, time), period, {(): {(): -count}})}), "a time is no multiple of the period")
    need(abs(count) <= LATEST, "a time is too late")
    return count


def laws(cert):
    """What is zero on each period and what is continuous from 0 on, by the laws of the elements: those of runs, which move
    as one, between links, bars and springs, which pass a force on. A place has a clock, ahead by so many periods."""
    line, t, ends = cert["line"], cert["time"], ("free", "fixed", "endless")
    is_end = [element["is"] in ends for element in line]
    need(is_end == [True] + [False] * (len(line) - 2) + [True], "a line has two ends")
    runs, links, clocks = [[]], [], [line[0]["clock"]]
    for element in line:
        if element["is"] in ("bar", "spring"):
            links.append(element)
            clocks.append(element["clock"] if element["is"] == "bar" else clocks[-1])
            runs.append([])
        else:
            need(element["is"] in ends + ("mass", "support", "force", "velocity", "motion"), "an unknown element")
            runs[-1].append(element)
    clocks = [periods(clock, cert) for clock in clocks]

    def own(run, *kinds):
        return [element for element in runs[run] if element["is"] in kinds]

    def of(element, key):
        return {(): read_function(element[key])}

    def wave(name, lag=0):
        return {(name, "value", lag): {(): ONE}}

    def acting(function, lag):
        return {(None, "forcing", lag): function}

    def load(element, run):
        """The course of a load from its beginning to its end."""
        total, course = {}, read(element["course"])
        is_late = element["until"] is None or periods(element["from"], cert) < periods(element["until"], cert)
        need(is_late, "a load ends before it begins")
        for key, factor in (("from", {(): ONE}), ("until", MINUS)):
            if element[key] is not None:
                later = put(course, t, add({(): {((t, 1),): 1}}, read_function(element[key])))
                total = plus(total, times(factor, acting(later, clocks[run] + periods(element[key], cert))))
        return total

    def bar(link, run):
        """Velocity V + f + g and compressive force X + Z (f - g) of a bar at its left end (run = link) or its right one; a
        wave enters at each end that is not endless, and takes the travel time to the other one."""
        element, here, there = links[link], clocks[run], clocks[link + (run == link)]
        for way, end in (("right", link), ("left", link + 1)):
            need((element[way] is None) == bool(own(end, "endless")), "a bar lacks a wave, or has one from nowhere")
        travel = periods(element["travel"], cert)
        need(travel is None or travel > 0, "a bar without length")
        late = lambda way: wave(element[way], travel + here - there) if element[way] else {}
        now = lambda way: wave(element[way]) if element[way] else {}
        f, g = (now("right"), late("left")) if run == link else (late("right"), now("left"))
        velocity = plus(acting(of(element, "velocity"), here), f, g)
        return velocity, plus(acting(of(element, "force"), here), times(of(element, "impedance"), less(f, g)))

    def velocities(run):
        """All that is known of the velocity of a run."""
        found = [load(element, run) for element in own(run, "velocity")] + [{} for _ in own(run, "fixed")]
        found += [bar(link, run)[0] for link in (run - 1, run) if 0 <= link < len(links) and links[link]["is"] == "bar"]
        found += [plus(wave(element["wave"]), acting(of(element, "from"), clocks[run])) for element in own(run, "motion")]
        need(found, "a velocity is missing")
        return found

    def closing(link):
        return less(velocities(link)[0], velocities(link + 1)[0])

    def force(link, run):
        """The compressive force in a link; in a spring k a + d a'."""
        if not 0 <= link < len(links):
            return {}
        spring = links[link]
        if spring["is"] == "bar":
            return bar(link, run)[1]
        return plus(times(of(spring, "stiffness"), wave(spring["wave"])), times(of(spring, "damping"), closing(link)))

    def slope_of(velocity):
        steep = lambda kind, c: ("forcing", slope(c, t)) if kind == "forcing" else ("slope", c)
        return {(name, steep(kind, c)[0], lag): steep(kind, c)[1] for (name, kind, lag), c in velocity.items()}

    equations, starts = [], []
    stored = [(link, closing(i)) for i, link in enumerate(links) if link["is"] == "spring"]
    for run in range(len(runs)):
        if own(run, "endless"):
            need(len(runs[run]) == 1, "an endless line ends with a bar")
            continue
        first, *others = velocities(run)
        equations += [less(first, other) for other in others]
        stored += [(support, first) for support in own(run, "support")]
        if own(run, "fixed", "velocity"):
            continue
        balance = plus(less(force(run - 1, run), force(run, run)), *(load(element, run) for element in own(run, "force")))
        for mass in own(run, "mass"):
            balance = less(balance, times(of(mass, "mass"), slope_of(first)))
        for support in own(run, "support"):
            pushes = times(of(support, "stiffness"), wave(support["wave"]))
            balance = less(balance, plus(pushes, times(of(support, "damping"), first)))
        equations.append(balance)
        gained = lambda mass: times(of(mass, "mass"), less(first, acting(of(mass, "velocity"), clocks[run])))
        starts += [plus(*map(gained, own(run, "mass")))] if own(run, "mass") else []  # masses that start together share it
    for element, rate in stored:  # what springs are shortened by, and supports displaced
        need(element["wave"] is not None or is_zero(of(element, "stiffness")), "a spring has no compression")
        if element["wave"] is not None:
            equations.append(less(slope_of(wave(element["wave"])), rate))
            starts.append(wave(element["wave"]))
    return [whole(form) for form in equations], [(whole(form), {}) for form in starts]
