#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""points - writes points.txt: python3 tests/math/points.py

One line a point: the function, its arguments and the correctly rounded result, as the
bits of doubles in hexadecimal (a function of one argument has 0 for the second), and how
far the true result is from the middle of two doubles, in millionths of their distance.
All of it comes from mpmath at 300 bits, or 1400 for angles, and shares nothing with
runtime/engine/scan/math*.c. Of many random points those are kept that are nearest to such
a middle, then some as they come, then chosen ones.
"""
import math
import os
import random
import struct
import mpmath as m
from mpmath import mp, mpf

HARD, PLAIN, TRIED = 60, 60, 4000


def bits(x):
    return '%016x' % struct.unpack('<Q', struct.pack('<d', x))[0]


def double(n):
    return struct.unpack('<d', struct.pack('<Q', n))[0]


def finite():
    while True:
        x = double(random.getrandbits(64))
        if x and math.isfinite(x):
            return x


def rounded(v):
    """The nearest double, ties to even, and how far @v is from the middle of two."""
    if v == 0:
        return 0.0, 1.0
    size = abs(v)
    power = max(int(m.floor(m.log(size, 2))), -1022)
    while size >= mpf(2)**(power + 1):
        power += 1
    while power > -1022 and size < mpf(2)**power:
        power -= 1
    scaled = size * mpf(2)**(52 - power)
    whole = int(m.floor(scaled))
    rest = scaled - whole
    whole += rest > mpf(1) / 2 or (rest == mpf(1) / 2 and whole % 2)
    away = float(abs(rest - mpf(1) / 2))
    if whole >= 2**(53 + 1023 - power):
        return math.copysign(math.inf, v), away
    return math.copysign(math.ldexp(whole, power - 52), v), away


def uniform(a, b):
    return lambda: random.uniform(a, b)


def spread(a, b):
    return lambda: random.choice([-1, 1]) * 2.0**random.uniform(a, b)


def near_1(a, b):
    return lambda: 1 + random.choice([-1, 1]) * 2.0**-random.uniform(a, b)


def inside(make):
    def draw():
        while True:
            x = make()
            if -1 <= x <= 1:
                return x
    return draw


def multiple():
    mp.prec = 1400
    return float(random.getrandbits(random.randint(1, 62)) * m.pi / 2)


def power_pair():
    kind = random.randrange(4)
    if kind == 0:
        x = abs(finite())
    elif kind == 1:
        x = near_1(1, 50)()
    elif kind == 2:
        return float(random.randrange(-3000, 3000) or 1), float(random.randrange(-40, 40))
    else:
        x = random.uniform(0, 10)
    y = random.uniform(-1080, 1026) if random.random() < .4 else random.uniform(-9, 9)
    return x, y / ((x - 1) * 1.44 if abs(x - 1) < 1e-3 else math.log2(x) or 1)


ANGLES = [finite, uniform(-4, 4), spread(-40, 60), multiple]
DRAW = {
    'exp': [uniform(-746, 710), spread(-60, 9), uniform(-1, 1)],
    'log': [lambda: abs(finite()), near_1(1, 53), uniform(0, 9)],
    'log10': [lambda: abs(finite()), near_1(1, 53), uniform(0, 999)],
    'sin': ANGLES, 'cos': ANGLES, 'tan': ANGLES,
    'asin': [uniform(-1, 1), spread(-60, 0), inside(near_1(1, 53))],
    'acos': [uniform(-1, 1), spread(-60, 0), inside(near_1(1, 53))],
    'atan': [finite, uniform(-3, 3), spread(-30, 60)],
}
PAIRS = {
    'pow': [power_pair],
    'atan2': [lambda: (finite(), finite()),
              lambda: (random.uniform(-1, 1), random.uniform(-1, 1)),
              lambda: (spread(-20, 20)(), spread(-20, 20)())],
}
REAL = {'log10': lambda x: m.log(x) / m.log(mpf(10)), 'atan2': m.atan2,
        'pow': lambda x, y: x**int(y) if x < 0 else x**y}

# The double nearest to a multiple of pi/2; ends of the range of results; exact
# results and exact ties; powers of 10.
WORST = math.ldexp(6381956970095103, 797)
CHOSEN = {
    'exp': [(x,) for x in (709.782712893384, 709.7827128933839, -708.3964185322641,
                           -708.4, -745.1332191019411, -745.1332191019412, 1.0, -1.0,
                           2.0**-53, 2.0**-54, -2.0**-54, -2.0**-55, 5e-324)],
    'log': [(5e-324,), (2.0**-1022,), (1.7976931348623157e308,), (2.0,), (0.5,)],
    'log10': [(float(10**k),) for k in range(1, 23)] + [(2.0,), (5e-324,)],
    'sin': [(WORST,), (-WORST,), (1e22,), (math.pi,), (5e-324,), (1.7976931348623157e308,)],
    'cos': [(WORST,), (1e22,), (math.pi / 2,), (5e-324,), (2.0**-27,)],
    'tan': [(WORST,), (-WORST,), (1e22,), (math.pi / 2,), (math.pi / 4,), (5e-324,)],
    'asin': [(1.0,), (-1.0,), (0.5,), (1 - 2.0**-53,), (5e-324,), (2.0**-27,)],
    'acos': [(-1.0,), (0.5,), (1 - 2.0**-53,), (2.0**-53 - 1,), (5e-324,), (2.0**-27,)],
    'atan': [(1.0,), (-1.0,), (1e308,), (5e-324,), (0.0625,), (2.4142135623730951,)],
    'pow': [(2.0, -1074.0), (2.0, -1075.0), (2.0, 1023.0), (2.0, 0.5), (10.0, 22.0),
            (10.0, 308.0), (10.0, -308.0), (-2.0, 3.0), (-2.0, 62.0), (2.0**27 + 1, 2.0),
            (2.0**27 + 3, 2.0), (3.0, 34.0), (94906265.0, 2.0), (208063.0, 3.0),
            (1 + 2.0**-52, 2.0**62), (1 - 2.0**-53, 2.0**62), (9.0, 1.5), (5e-324, 0.5),
            (5e-324, 0.9), (1.7976931348623157e308, 0.999)],
    'atan2': [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (5e-324, 1.0), (5e-324, 3.0),
              (5e-324, -1.0), (1e308, 5e-324), (5e-324, 1e308), (3.0, 4.0)],
}


def result(name, args):
    mp.prec = 1400 if name in ('sin', 'cos', 'tan') else 300
    real = REAL.get(name) or getattr(m, name)
    return rounded(real(*map(mpf, args)))


def points(name):
    draws = DRAW.get(name) or PAIRS[name]
    found = []
    while len(found) < TRIED:
        args = random.choice(draws)()
        args = args if isinstance(args, tuple) else (args,)
        if not all(map(math.isfinite, args)) or (name == 'pow' and args[0] == 0):
            continue
        value, away = result(name, args)
        if not math.isfinite(value):
            continue
        found.append((away, args, value))
    plain = found[:PLAIN]
    hard = sorted(found[PLAIN:])[:HARD]
    chosen = [(away, args, value) for args in CHOSEN[name]
              for value, away in [result(name, args)]]
    for away, args, value in hard + plain + chosen:
        second = bits(args[1]) if len(args) > 1 else bits(0.0)
        yield '%s %s %s %s %d\n' % (name, bits(args[0]), second, bits(value),
                                  math.floor(away * 1e6))


random.seed(5)
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'points.txt'), 'w') as f:
    f.write('# Made by tests/math/points.py, which says what it is.\n')
    for name in list(DRAW) + list(PAIRS):
        f.writelines(points(name))
