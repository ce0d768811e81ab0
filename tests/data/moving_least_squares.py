#!/usr/bin/env python3
"""Functions of moving least squares and their gradients, in exact fractions, without the program.

    python3 tests/data/moving_least_squares.py        writes moving_least_squares.csv beside itself

The formulas are (10)-(18) of paper 000 as printed but for (18), whose p_,i term is what the product rule gives:
A is inverted where it stands, about the origin, which fractions bear. m.
"""
import os
import random
from fractions import Fraction as F

OMEGA = F(1, 10**5)


def weight(r, d2, support):
    """w and its gradient, at way r = x - x_J."""
    s = d2 / support**2
    if s >= 1:
        return F(0), [F(0), F(0)]
    end = (1 + OMEGA) ** -2
    scale = OMEGA**-2 - end
    slope = -2 * (s + OMEGA) ** -3 / support**2 / scale
    return ((s + OMEGA) ** -2 - end) / scale, [2 * slope * r[0], 2 * slope * r[1]]


def inverse(a):
    (p, q, r), (s, t, u), (v, w, x) = a
    cofactors = [[t * x - u * w, r * w - q * x, q * u - r * t],
                 [u * v - s * x, p * x - r * v, r * s - p * u],
                 [s * w - t * v, q * v - p * w, p * t - q * s]]
    determinant = p * cofactors[0][0] + q * cofactors[1][0] + r * cofactors[2][0]
    return [[c / determinant for c in row] for row in cofactors]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def row_times(p, a):
    return [sum(p[i] * a[i][j] for i in range(3)) for j in range(3)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def functions(x, nodes, supports):
    basis = [[F(1), n[0], n[1]] for n in nodes]
    weights, slopes = [], []
    for n, support in zip(nodes, supports):
        r = [x[0] - n[0], x[1] - n[1]]
        w, g = weight(r, r[0] ** 2 + r[1] ** 2, support)
        weights.append(w)
        slopes.append(g)
    moment = lambda factors: [[sum(f * p[i] * p[j] for f, p in zip(factors, basis)) for j in range(3)]
                              for i in range(3)]
    a_inverse = inverse(moment(weights))
    p = [F(1), x[0], x[1]]
    row = row_times(p, a_inverse)
    values = [w * dot(row, b) for w, b in zip(weights, basis)]
    gradients = []
    for i in range(2):
        p_i = [F(0), F(int(i == 0)), F(int(i == 1))]
        a_i = moment([g[i] for g in slopes])
        first = row_times(p_i, a_inverse)
        second = row_times(row, product(a_i, a_inverse))
        gradients.append([w * (dot(first, b) - dot(second, b)) + g[i] * dot(row, b)
                          for w, g, b in zip(weights, slopes, basis)])
    return values, gradients


def sets():
    # D is the same for all nodes
    nodes = [("0", "0"), ("1", "0.1"), ("2.1", "-0.1"), ("-0.1", "1.1"), ("0.9", "0.9"), ("2", "1")]
    yield "six", ("0.5", "0"), [(F(a), F(b)) for a, b in nodes], [F(2)] * 6
    random.seed(7)
    cloud, supports = [], []
    for i in range(-3, 4):
        for j in range(-3, 4):
            cloud.append((F(i) + F(random.randint(-250, 250), 1000), F(j) + F(random.randint(-250, 250), 1000)))
            supports.append(F(random.randint(1800, 3400), 1000))
    node = cloud[24]
    for name, off in (("between", ("0.41", "-0.27")), ("near_a_node", ("1e-6", "2e-6")),
                      ("nearer", ("-1e-9", "3e-10")), ("at_a_node", ("0", "0")), ("midway", ("0.5", "0.5"))):
        yield name, tuple(str(float(n + F(o))) for n, o in zip(node, off)), cloud, supports
    far = [(n[0] + 1000, n[1] - 500) for n in cloud]
    yield "far_from_the_origin", ("1000.5", "-499.75"), far, supports
    uneven = [(n[0] * abs(n[0]) + n[0] / 8, n[1]) for n in cloud]
    yield "uneven", ("0.0625", "0.375"), uneven, [3 * s for s in supports]


def main():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "moving_least_squares.csv")
    with open(path, "w", encoding="utf-8") as out:
        out.write("set,x,y,node_x,node_y,support,value,gradient_x,gradient_y\n")
        for name, x, nodes, supports in sets():
            # what the program reads is taken as it reads it
            at = [F(float(c)) for c in x]
            places = [(F(float(a)), F(float(b))) for a, b in nodes]
            sizes = [F(float(s)) for s in supports]
            values, gradients = functions(at, places, sizes)
            for n, s, v, gx, gy in zip(places, sizes, values, *gradients):
                numbers = [float(at[0]), float(at[1]), float(n[0]), float(n[1]), float(s), float(v), float(gx), float(gy)]
                out.write(name + "," + ",".join(repr(number) for number in numbers) + "\n")


main()
