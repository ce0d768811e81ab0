#!/usr/bin/env python3
"""Tables of flow stress that know nothing of the program: formulas written once more, in 50 decimal digits.

    python3 tests/data/flow_stress.py        writes flow_stress_constants.csv, flow_stress.csv and
                                             flow_stress_adiabatic.csv beside itself

SI units. Constants of zerilli-armstrong: their paper of 1987 (OFHC copper, iron); of goijaerts: X30Cr13, their
paper of 2000; the others are of usual size and no metal's.
"""
import os
from decimal import Decimal, getcontext

getcontext().prec = 50
D = Decimal
ZERO, ONE = D(0), D(1)

SETS = [
    ("steel", "johnson-cook", dict(A=253e6, B=685e6, n=0.312, C=0.0973, rate0=1, m=2.044, T0=296, Tmelt=1698)),
    ("hard", "linear", {"yield": 400e6, "hardening": 120e6}),
    ("ideal", "perfect", {"yield": 400e6}),
    ("bar", "voce", {"yield": 450e6, "hardening": 129.24e6, "saturation": 715e6, "exponent": 16.93}),
    ("iron", "zerilli-armstrong-bcc", dict(C0=65e6, C1=1033e6, C3=0.00698, C4=0.000415, C5=266e6, n=0.289)),
    ("copper", "zerilli-armstrong-fcc", dict(C0=65e6, C2=890e6, C3=0.0028, C4=0.000115)),
    ("nickel", "zerilli-armstrong-fcc", dict(C0=110e6, C2=700e6, C3=0.0019, C4=0.00008, strain_exponent=0.7)),
    ("sheet", "swift", dict(K=950e6, strain0=0.012, n=0.21)),
    ("aluminium", "hockett-sherby", {"yield": 130e6, "saturation": 320e6, "N": 4.7, "p": 0.81}),
    ("X30Cr13", "goijaerts", {"yield": 420e6, "rise": 133e6, "rise_strain": 0.0567, "root": 406e6,
                              "hardening": 70.7e6}),
    ("sawtooth", "calamaz", dict(A=253e6, B=685e6, n=0.312, a=1.6, b=0.4, c=6, d=1, C=0.0973, rate0=1, m=2.044,
                                 T0=296, Tmelt=1698)),
    ("titanium", "calamaz", dict(A=968e6, B=380e6, n=0.421, a=2, b=5, c=2, d=1.4, C=0.0197, rate0=0.1, m=0.577,
                                 T0=293, Tmelt=1878)),
    ("cold", "calamaz", dict(A=300e6, B=500e6, n=0.3, a=1.2, b=1, c=3, d=1)),
    ("measured", "table", dict(strain=[0, 0.002, 0.01, 0.05, 0.2, 0.7, 1.6], C=0.02, rate0=0.1, m=1.1, T0=293, Tmelt=1750,
                               stress=[310e6, 355e6, 402e6, 480e6, 566e6, 671e6, 702e6])),
    ("with_a_peak", "table", dict(strain=[0, 0.1, 0.25, 0.3, 1, 2], stress=[400e6, 640e6, 700e6, 700e6, 520e6, 505e6])),
    ("straight", "table", dict(strain=[0, 0.5], stress=[250e6, 400e6])),
]

DEFAULTS = dict(C=0, rate0=1, m=1, T0=293.15, Tmelt=None, strain_exponent=0.5)


def exact(x):
    """The double that the program reads, digit by digit."""
    return D(float(x))


def power(x, p):
    return ZERO if x == 0 else (x.ln() * p).exp()


def thermal_viscous(k, rate, temperature):
    factor = ONE
    if rate > k["rate0"]:
        factor += k["C"] * (rate / k["rate0"]).ln()
    if k["Tmelt"] is None:
        return factor
    cold = (temperature - k["T0"]) / (k["Tmelt"] - k["T0"])
    cold = min(max(cold, ZERO), ONE)
    return factor * (ONE - power(cold, k["m"]))


def tanh(x):
    e = (-2 * x).exp()
    return (ONE - e) / (ONE + e)


def flow_stress(law, k, e, rate, temperature):
    if law == "johnson-cook":
        return (k["A"] + k["B"] * power(e, k["n"])) * thermal_viscous(k, rate, temperature)
    if law == "linear":
        return k["yield"] + k["hardening"] * e
    if law == "perfect":
        return k["yield"]
    if law == "voce":
        return k["saturation"] - (k["saturation"] - k["yield"]) * (-k["exponent"] * e).exp() + k["hardening"] * e
    if law == "zerilli-armstrong-bcc":
        return k["C0"] + k["C1"] * (-(k["C3"] - k["C4"] * rate.ln()) * temperature).exp() + k["C5"] * power(e, k["n"])
    if law == "zerilli-armstrong-fcc":
        decay = (-(k["C3"] - k["C4"] * rate.ln()) * temperature).exp()
        return k["C0"] + k["C2"] * power(e, k["strain_exponent"]) * decay
    if law == "swift":
        return k["K"] * power(k["strain0"] + e, k["n"])
    if law == "hockett-sherby":
        return k["saturation"] - (k["saturation"] - k["yield"]) * (-k["N"] * power(e, k["p"])).exp()
    if law == "goijaerts":
        rise = k["rise"] * (ONE - (-e / k["rise_strain"]).exp())
        return k["yield"] + rise + k["root"] * e.sqrt() + k["hardening"] * e
    if law == "calamaz":
        hardened = k["A"] + k["B"] * power(e, k["n"]) / power(e, k["a"]).exp()
        softened = ONE
        if k["Tmelt"] is not None:
            melting = min(temperature / k["Tmelt"], ONE)
            share, shift = ONE - power(melting, k["d"]), power(melting, k["b"])
            softened = share + (ONE - share) * tanh(ONE / power(e + shift, k["c"]))
        return hardened * softened * thermal_viscous(k, rate, temperature)
    if law == "table":
        return curve(k["strain"], k["stress"], e) * thermal_viscous(k, rate, temperature)
    raise ValueError(law)


def hermite_slopes(x, y):
    """PCHIP's: weighted harmonic means inside, one-sided three-point formula at the ends."""
    n = len(x)
    h = [x[i + 1] - x[i] for i in range(n - 1)]
    delta = [(y[i + 1] - y[i]) / h[i] for i in range(n - 1)]
    if n == 2:
        return [delta[0], delta[0]]
    slopes = []
    for i in range(n):
        if 0 < i < n - 1:
            if delta[i - 1] * delta[i] <= 0:
                slopes.append(ZERO)
            else:
                a, b = 2 * h[i] + h[i - 1], h[i] + 2 * h[i - 1]
                slopes.append((a + b) / (a / delta[i - 1] + b / delta[i]))
            continue
        near, far = (0, 1) if i == 0 else (n - 2, n - 3)
        s = ((2 * h[near] + h[far]) * delta[near] - h[near] * delta[far]) / (h[near] + h[far])
        if s * delta[near] <= 0:
            s = ZERO
        elif delta[near] * delta[far] <= 0 and abs(s) > 3 * abs(delta[near]):
            s = 3 * delta[near]
        slopes.append(s)
    return slopes


def curve(x, y, e):
    """Cubic Hermite interpolation in the basis of its four polynomials; constant beyond the last point."""
    if e >= x[-1]:
        return y[-1]
    slopes = hermite_slopes(x, y)
    i = max(j for j in range(len(x)) if x[j] <= e)
    h = x[i + 1] - x[i]
    s = (e - x[i]) / h
    return (y[i] * (1 + 2 * s) * (1 - s) ** 2 + y[i + 1] * s * s * (3 - 2 * s)
            + h * slopes[i] * s * (1 - s) ** 2 - h * slopes[i + 1] * s * s * (1 - s))


STRAINS = ["0", "1e-5", "0.003", "0.04", "0.27", "0.9", "1.7", "4"]
RATES = ["0.002", "30", "70000"]
TEMPERATURES = ["90", "400", "1100", "1750"]


def complete(constants):
    known = {name: [exact(v) for v in value] if isinstance(value, list) else exact(value)
             for name, value in constants.items()}
    for name, value in DEFAULTS.items():
        known.setdefault(name, None if value is None else exact(value))
    return known


def adiabatic(law, k, rate, start, strains, capacity, share=0.9):
    """σ and T where share of the plastic work heats capacity (J/(m³ K)): the classical Runge-Kutta method, with
    steps that grow with the strain as its root is steep at 0."""
    e, t, rows = 0.0, start, []

    def heating(at, temperature):
        return share * float(flow_stress(law, k, D(at), D(rate), D(temperature))) / capacity

    for target in strains:
        steps, first = 60, e
        for i in range(1, steps + 1):
            next_e = first + (target - first) * (i / steps) ** (3 if first == 0.0 else 1)
            h = next_e - e
            k1 = heating(e, t)
            k2 = heating(e + h / 2, t + h / 2 * k1)
            k3 = heating(e + h / 2, t + h / 2 * k2)
            k4 = heating(next_e, t + h * k3)
            t += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            e = next_e
        rows.append((e, float(flow_stress(law, k, D(e), D(rate), D(t))), t))
    return rows


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(folder, "flow_stress_constants.csv"), "w") as out:
        out.write("# Constants of the sets of flow_stress.csv, SI: written by flow_stress.py\nset,law,constant,value\n")
        for name, law, constants in SETS:
            for constant, value in constants.items():
                text = ";".join(repr(float(v)) for v in (value if isinstance(value, list) else [value]))
                out.write(f"{name},{law},{constant},{text}\n")
    with open(os.path.join(folder, "flow_stress.csv"), "w") as out:
        out.write("# computed: written by flow_stress.py, 50 digits\nset,strain,rate_1_s,T_K,sigma_Pa\n")
        for name, law, constants in SETS:
            k = complete(constants)
            varies = law not in ("linear", "perfect", "voce", "swift", "hockett-sherby", "goijaerts")
            for e in STRAINS:
                for rate in RATES if varies else RATES[1:2]:
                    for temperature in TEMPERATURES if varies else TEMPERATURES[1:2]:
                        sigma = flow_stress(law, k, exact(e), exact(rate), exact(temperature))
                        out.write(f"{name},{e},{rate},{temperature},{float(sigma)!r}\n")
    with open(os.path.join(folder, "flow_stress_adiabatic.csv"), "w") as out:
        out.write("# computed: written by flow_stress.py; adiabatic, 0.9 of the work heats 4e6 J/(m3 K), from 296 K\n"
                  "set,rate_1_s,strain,sigma_Pa,T_K\n")
        for name, law, constants in SETS:
            if law not in ("zerilli-armstrong-fcc", "calamaz", "table"):
                continue
            for rate in (1.0, 1e4):
                for e, sigma, t in adiabatic(law, complete(constants), rate, 296.0, [0.02, 0.1, 0.3, 0.8, 1.5], 4e6):
                    out.write(f"{name},{rate:g},{e!r},{sigma:.10g},{t:.8g}\n")


main()
