"""Forces and contact radii of depth histories with one way in and one way out, by quadrature with 40 digits.

python3 histories.py > histories.csv          (Python 3.11, mpmath 1.3)

F = 8/(2 (1 - nu)) int_0^t1 G(t - s) a(s) d'(s) ds (+ eta d' a while it grows),   int_t1^t G(t - s) d'(s) ds + eta d' = 0
"""
from mpmath import mp, mpf, quad, findroot, exp, sqrt, atanh, acos, atan, gamma, pi

mp.dps = 40
MATERIALS = {  # equilibrium modulus, viscosity, [(modulus, relaxation time)]
    "elastic": (2, 0, []),
    "solid": (1, 0, [(4, 1)]),
    "maxwell": (0, 0, [(3, mpf("0.7"))]),
    "kelvin-voigt": (1, mpf("0.2"), []),
    "three": (mpf("0.5"), 0, [(20, mpf("0.001")), (2, mpf("0.1")), (1, 30)]),
    "fluid": (0, mpf("0.05"), [(1, mpf("0.02")), (2, 5)]),
}
SHAPES = {  # the equivalent line, first depth of a piece of its inverse
    "paraboloid": lambda x: x * x,
    "cone": lambda x: mpf("0.3") * pi / 2 * x,
    "power": lambda x: POWER * x ** mpf("1.5"),
    "sphere": lambda x: x * atanh(x),
    "flat-cone": lambda x: mpf("0.4") * x * acos(mpf("0.02") / x) if x > mpf("0.02") else mpf(0),
    "hyperboloid": lambda x: mpf("0.5") * x * atan(x / mpf("0.05")),
}
POWER = sqrt(pi) / 2 * mpf(3) / 2 * gamma(mpf(3) / 4) / gamma(mpf(5) / 4) * mpf("0.4")
INVERSES = {  # where they are closed
    "paraboloid": sqrt,
    "cone": lambda d: d / (mpf("0.3") * pi / 2),
    "power": lambda d: (d / POWER) ** (mpf(2) / 3),
}
HISTORIES = {
    "triangle": [(0, 0), (1, "0.01"), (2, 0)],
    "dwell": [(0, 0), (1, "0.01"), (2, "0.01"), (3, 0)],
    "slow-fast": [(0, 0), ("0.5", "0.002"), (1, "0.01"), ("1.1", "0.008"), (2, 0)],
    "late": [("0.25", "-0.005"), (1, "0.01"), ("1.5", "0.0125"), ("1.75", "-0.0025")],
    "step": [(0, "0.01"), (1, "0.01"), (3, "-0.005")],
}
CASES = [
    ("elastic", "sphere", "triangle"), ("solid", "paraboloid", "triangle"), ("solid", "sphere", "dwell"),
    ("solid", "power", "slow-fast"), ("solid", "flat-cone", "triangle"), ("solid", "hyperboloid", "late"),
    ("maxwell", "cone", "dwell"), ("maxwell", "paraboloid", "late"), ("kelvin-voigt", "paraboloid", "slow-fast"),
    ("kelvin-voigt", "cone", "dwell"), ("three", "paraboloid", "triangle"), ("three", "sphere", "slow-fast"),
    ("three", "cone", "step"), ("fluid", "power", "triangle"), ("fluid", "paraboloid", "dwell"),
]


def inverse(shape, depth):
    if shape in INVERSES:
        return INVERSES[shape](depth)
    line = SHAPES[shape]
    low, high = mpf(10) ** -30, mpf("0.5")
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if line(middle) < depth else (low, middle)
    return findroot(lambda x: line(x) - depth, (low, high), solver="anderson", tol=mpf(10) ** -70, verify=False)


def rows(material, shape, history):
    spring, eta, branches = MATERIALS[material]
    knots = [(mpf(float(t)), mpf(float(d))) for t, d in HISTORIES[history]]
    line = SHAPES[shape]
    modulus = lambda lag: spring + sum(g * exp(-lag / tau) for g, tau in branches)
    step = knots[0][1] if knots[0][1] > 0 else mpf(0)

    def segment(t):
        return next(i for i in range(len(knots) - 1) if t <= knots[i + 1][0])

    def speed(t):
        (t0, d0), (t1, d1) = knots[segment(t)], knots[segment(t) + 1]
        return (d1 - d0) / (t1 - t0)

    def depth(t):
        t0, d0 = knots[segment(t)]
        return d0 + (t - t0) * speed(t)

    def split(a, b):
        return [a] + [t for t, _ in knots if a < t < b] + [b]

    def load(since, t):
        """Of an element that was touched at a time, without the jump at the beginning."""
        times = split(since, t)
        return eta * speed(t) + sum(
            speed((a + b) / 2) * quad(lambda s: modulus(t - s), [a, b]) for a, b in zip(times, times[1:]))

    peak = max(knots, key=lambda k: k[1])[0]
    touch = knots[0][0] if knots[0][1] >= 0 else knots[0][0] - knots[0][1] / speed(knots[0][0] + mpf(10) ** -20)
    last = [t for t, d in knots if d == max(k[1] for k in knots)][-1]
    times = [touch + (peak - touch) * mpf(f) for f in ("0.1", "0.45")] if peak > touch else []
    times += [peak] if peak > touch else [knots[0][0] + mpf("0.25")]
    if last > peak:
        times.append((peak + last) / 2)
    times += [last + (knots[-1][0] - last) * mpf(f) for f in ("0.02", "0.1", "0.2", "0.3", "0.45", "0.6")]
    for t in times:
        t = mpf(float(t))
        if t <= last:
            t1 = min(t, peak)
        elif load(touch, t) + step * modulus(t - touch) < 0:
            yield t, mpf(0), mpf(0)
            continue
        elif load(touch, t) < 0:
            t1 = touch  # Among the elements of the first jump.
        else:
            low, high = touch, min(peak, t)
            if load(high, t) >= 0:
                t1 = high
            else:
                for _ in range(20):
                    middle = (low + high) / 2
                    low, high = (middle, high) if load(middle, t) > 0 else (low, middle)
                t1 = findroot(lambda s: load(s, t), (low, high), solver="anderson", tol=mpf(10) ** -60, verify=False)
        if step > 0:
            # All elements of the jump are touched at once: w = G(t) (step - g) + load, on a circle.
            extra = load(touch, t)
            rim = min(step, step + extra / modulus(t - touch))
            radius = inverse(shape, rim)
            area = quad(lambda x: modulus(t - touch) * (step - line(x)) + extra, [0, radius])
            yield t, 8 * area, radius
            continue
        radius = inverse(shape, depth(t1)) if t1 > touch else mpf(0)
        ends = split(touch, t1)
        area = sum(
            speed((a + b) / 2) * quad(lambda s: modulus(t - s) * inverse(shape, depth(s)), [a, a + (b - a) / 1000, a + (b - a) / 20, b])
            for a, b in zip(ends, ends[1:])) if t1 > touch else mpf(0)
        edge = eta * speed(t) if t1 == t else 0  # The element at the edge of a shrinking contact carries nothing.
        yield t, 8 * (area + edge * radius), radius


print("# F = 8/(2 (1 - nu)) int_0^t1 G(t - s) a(s) d'(s) ds and a by quadrature with 40 digits; python3 histories.py > histories.csv (Python 3.11, mpmath 1.3)")
print("material,shape,history,time_s,normal_force_n,contact_radius_m")
for case in CASES:
    for t, force, radius in rows(*case):
        print(*case, repr(float(t)), mp.nstr(force, 20), mp.nstr(radius, 20), sep=",", flush=True)
