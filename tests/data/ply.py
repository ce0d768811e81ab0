#!/usr/bin/env python3
"""Failure indices and strengths of plies that know nothing of the program (paper 000, appendix A, with the
corrections of docs/theory.md).

    python3 tests/data/ply.py        writes ply_constants.csv, ply_indices.csv and ply_strengths.csv beside itself

SI units, angles in degrees. gfrp: paper 000, Table 2; the other is of usual size and no ply's. Planes of fracture
are searched in steps of 0.02 degrees; strengths are found by halving the load. `modes`
are those that a load of 1.0005 of the strength begins: kinking fibres and the matrix beside them begin together.
"""
import math
import os
import random

CONSTANTS = ["E1", "E2", "nu12", "G12", "Xt", "Xc", "Yt", "Yc", "S", "eps1t", "alpha0"]
PLIES = {
    "gfrp": [34.28e9, 11.57e9, 0.24244, 2.05e9, 697.8e6, 443.76e6, 89.7216e6, 148.33e6, 33.1e6, 0.023, 53.0],
    "carbon": [138e9, 9.2e9, 0.31, 5.3e9, 1850e6, 1150e6, 54e6, 195e6, 82e6, 0.0138, 55.0],
}
MODES = ["fibre_tension", "fibre_compression", "matrix_tension", "matrix_compression", "shear"]


def crushing(s2, t, k, ST, etaT, etaL):
    best = 0.0
    for step in range(4501):
        a = math.radians(step * 0.02)
        c, s = math.cos(a), math.sin(a)
        across = max(0.0, -s2 * c * (s - etaT * c))
        along = max(0.0, c * (t + etaL * s2 * c))
        best = max(best, (across / ST) ** 2 + (along / k["S"]) ** 2)
    return best


def indices(law, k, s1, s2, t12):
    t = abs(t12)
    f = dict.fromkeys(MODES, 0.0)
    a0 = math.radians(k["alpha0"])
    ST = k["Yc"] * math.cos(a0) * (math.sin(a0) + math.cos(a0) / math.tan(2 * a0))
    pulled = lambda s, shear: (s / k["Yt"]) ** 2 + (shear / k["S"]) ** 2
    if law == "max-stress":
        f["fibre_tension" if s1 >= 0 else "fibre_compression"] = (s1 / k["Xt" if s1 >= 0 else "Xc"]) ** 2
        f["matrix_tension" if s2 >= 0 else "matrix_compression"] = (s2 / k["Yt" if s2 >= 0 else "Yc"]) ** 2
        f["shear"] = (t / k["S"]) ** 2
    elif law == "hashin":
        if s1 >= 0:
            f["fibre_tension"] = (s1 / k["Xt"]) ** 2 + (t / k["S"]) ** 2
        else:
            f["fibre_compression"] = (s1 / k["Xc"]) ** 2
        if s2 >= 0:
            f["matrix_tension"] = pulled(s2, t)
        else:
            f["matrix_compression"] = max(0.0, (s2 / (2 * ST)) ** 2 + ((k["Yc"] / (2 * ST)) ** 2 - 1) * s2 / k["Yc"]
                                          + (t / k["S"]) ** 2)
    else:
        etaT = -1 / math.tan(2 * a0)
        etaL = -k["S"] * math.cos(2 * a0) / (k["Yc"] * math.cos(a0) ** 2)
        r = k["S"] / k["Xc"]
        kk = r + etaL
        psic = math.atan((1 - math.sqrt(1 - 4 * kk * r)) / (2 * kk))
        psi = (t + (k["G12"] - k["Xc"]) * psic) / (k["G12"] + s1 - s2)
        c, s = math.cos(psi), math.sin(psi)
        s2m = s * s * s1 + c * c * s2 - 2 * s * c * t
        tm = -s * c * s1 + s * c * s2 + (c * c - s * s) * t
        if s1 >= 0:
            f["fibre_tension"] = max(0.0, (s1 - k["nu12"] * s2) / k["E1"] / k["eps1t"])
        elif s2m < 0:
            f["fibre_compression"] = max(0.0, abs(tm) + etaL * s2m) / k["S"]
        else:
            f["fibre_compression"] = pulled(s2m, tm)
        if s2 >= 0:
            f["matrix_tension"] = pulled(s2, t)
        elif s1 >= -k["Yc"]:
            f["matrix_compression"] = crushing(s2, t, k, ST, etaT, etaL)
        elif s2m >= 0:
            f["matrix_compression"] = pulled(s2m, tm)
        else:
            f["matrix_compression"] = crushing(s2m, abs(tm), k, ST, etaT, etaL)
    return f


def strength(law, k, degrees, sign):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    at = lambda load: indices(law, k, sign * load * c * c, sign * load * s * s, -sign * load * s * c)
    low, high = 0.0, 1e6
    while max(at(high).values()) < 1:
        low, high = high, 1.02 * high
    for _ in range(40):
        middle = 0.5 * (low + high)
        if max(at(middle).values()) >= 1:
            high = middle
        else:
            low = middle
    f = at(1.0005 * high)
    return high, "+".join(m for m in MODES if f[m] >= 1)


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    header = "# tests/data/ply.py\n"
    with open(os.path.join(folder, "ply_constants.csv"), "w") as out:
        out.write(header + "ply," + ",".join(CONSTANTS) + "\n")
        for name, values in PLIES.items():
            out.write(name + "," + ",".join(repr(v) for v in values) + "\n")
    random.seed(18)
    laws = ["max-stress", "hashin", "larc02"]
    with open(os.path.join(folder, "ply_indices.csv"), "w") as out:
        out.write(header + "ply,law,s1,s2,t12," + ",".join(MODES) + "\n")
        for name, values in PLIES.items():
            k = dict(zip(CONSTANTS, values))
            states = [(0.0, 0.0, k["S"]), (-k["Xc"], 0.0, 0.0), (0.0, -k["Yc"], 0.0)]
            for _ in range(24):
                states.append((random.uniform(-k["Xc"], k["Xt"]) * 0.8, random.uniform(-k["Yc"], k["Yt"]),
                               random.uniform(-k["S"], k["S"])))
            for law in laws:
                for s in states:
                    f = indices(law, k, *s)
                    out.write(f"{name},{law}," + ",".join(repr(x) for x in s) + ","
                              + ",".join(f"{f[m]:.9g}" for m in MODES) + "\n")
    with open(os.path.join(folder, "ply_strengths.csv"), "w") as out:
        out.write(header + "ply,law,angle,sign,strength,modes\n")
        for name, values in PLIES.items():
            k = dict(zip(CONSTANTS, values))
            for law in laws:
                for degrees in (0, 10, 30, 45, 72, 90):
                    for sign in (1, -1):
                        load, mode = strength(law, k, degrees, sign)
                        out.write(f"{name},{law},{degrees},{sign},{load:.9g},{mode}\n")


if __name__ == "__main__":
    main()
