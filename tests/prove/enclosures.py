"""enclosures.py - what must hold in the rows of 'isoroll run --certify', whatever they are.

    enclosures.py laws FILE...        constants of the motion stay inside their enclosures, row by row
    enclosures.py overlap FILE FILE...
                                      two files of the same numbers overlap, and the next two, ...; columns that only one
                                      has are left out
    enclosures.py reference ISOROLL FOLDER LONGEST
                                      states computed elsewhere, to 15 or 25 digits, lie inside (times up to LONGEST)
"""
import csv
import subprocess
import sys
from fractions import Fraction

from mpmath import iv, mp, mpf


def exact(text):
    x = Fraction(text)
    return mpf(x.numerator) / mpf(x.denominator)


def interval(middle, radius):
    return iv.mpf([exact(middle) - exact(radius), exact(middle) + exact(radius)])


def read(lines):
    """What the lines of # say, and rows of intervals by their names."""
    lines = list(lines)
    says = dict(line[2:].strip().split(": ", 1) for line in lines if line.startswith("# ") and ": " in line)
    mp.dps = iv.dps = int(says["digits"]) + 30
    table = list(csv.reader(line for line in lines if line[0] != "#"))
    names = table[0]
    return says, [{n: interval(row[i], row[i + 1]) for i, n in list(enumerate(names))[::2]} for row in table[1:]]


def vector(row, name):
    return [row[f"{name}{i}"] for i in (1, 2, 3)] if f"{name}1" in row else None


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def overlap(a, b):
    return mpf(a.a) <= mpf(b.b) and mpf(b.a) <= mpf(a.b)


def fractions(text):
    return [iv.mpf(Fraction(x).numerator) / Fraction(x).denominator for x in text.split()]


def constants(says, row):
    """Names, the enclosure of each here, and its value if that is known."""
    (k,), J = fractions(says["k"]), fractions(says["J"])
    K = fractions(says["rotor.momentum"]) if "rotor.momentum" in says else [iv.mpf(0)] * 3
    c = interval(*says["level.c"].split()) if "level.c" in says else iv.mpf(0)
    det = J[0] * J[1] * J[2]
    w, n, M, gamma = (vector(row, name) for name in ("omega", "n", "M", "gamma"))
    if n:
        g = sum(x * x / j for x, j in zip(n, J))
        Jw = [x * j for x, j in zip(w, J)]
        yield "|n|", dot(n, n), iv.mpf(1)
        yield "(omega, n)", dot(w, n), iv.mpf(0)
        yield "h", dot(w, Jw) / 2 - c * iv.exp(iv.log(g) * (-1 / k)), interval(*says["h"].split())
        if says["k"] == "1" and "level.c" not in says:
            L = cross([x + y for x, y in zip(Jw, K)], n)
            yield "F at k = 1", dot(L, L), None
        if says["k"] == "-1" and "rotor.momentum" not in says and "level.c" not in says:
            yield "F at k = -1", (dot(Jw, Jw) + det * dot(w, Jw) * sum((x / j) ** 2 for x, j in zip(n, J))) / g, None
    if gamma:
        q = sum(x * x * j for x, j in zip(gamma, J))
        eps = interval(*says["eps"].split())
        yield "|gamma|", dot(gamma, gamma), iv.mpf(1)
        yield "(M, gamma)", dot(M, gamma), iv.mpf(0)
        yield "H", dot(M, M) / 2 - eps * iv.exp(iv.log(q) * (-1 / k)), c * det / k**2


def laws(path):
    with open(path, encoding="ascii") as file:
        says, rows = read(file)
    first, wrong = {}, 0
    for i, row in enumerate(rows):
        for name, here, value in constants(says, row):
            value = first.setdefault(name, here) if value is None else value
            low, high = mpf(here.a), mpf(here.b)
            small = high - low < mpf(10) ** (3 - int(says["digits"])) * (1 + abs(low))
            if not overlap(here, value) or not small:
                print(f"FAIL {path}, row {i}: {name} is {here}, and {value}")
                wrong += 1
    print(f"{path}: {len(rows)} rows, {len(first)} integrals and the constraints: {wrong} wrong")
    return wrong or not rows


def compare(first, second):
    tables = []
    for path in (first, second):
        with open(path, encoding="ascii") as file:
            tables.append(read(file)[1])
    wrong = count = 0
    for a, b in zip(*tables):
        for name in a.keys() & b.keys():
            count += 1
            if not overlap(a[name], b[name]):
                print(f"FAIL {name}: {a[name]} and {b[name]}")
                wrong += 1
    print(f"{first}, {second}: {count} numbers compared, {wrong} apart")
    return wrong or not count or len(tables[0]) != len(tables[1])


# --- states computed elsewhere -----------------------------------------------------------------------------------------------


def scene_of(row, kind):
    J = ", ".join(row[f"J{i}"] for i in (1, 2, 3))
    if kind == "levels":
        start = f"gamma: [{row['g1_0']}, {row['g2_0']}, {row['g3_0']}], M: [{row['M1_0']}, {row['M2_0']}, {row['M3_0']}]"
        model, end = f"point: {{k: {row['k']}, J: [{J}], eps: {row['eps']}}}", row["s"]
    else:
        start = ", ".join(
            f"{name}: [{', '.join(row[f'{x}{i}_0'] for i in (1, 2, 3))}]"
            for name, x in (("normal", "n"), ("angular_velocity", "w"))
        )
        model, end = f"reduced: {{k: {row['k']}, J: [{J}]}}", row["t"]
    rotor = f"effects: {{rotor: {{momentum: [{row['K1']}, {row['K2']}, {row['K3']}]}}}}\n" if kind == "rotor" else ""
    return f"{model}\ninitial: {{{start}, project: true}}\n{rotor}time: {{end: {end}, step: 1000}}\noutput: {{as: both}}\n"


def reference(isoroll, folder, longest):
    own = {"w": "omega", "n": "n", "M": "M", "g": "gamma"}
    wrong = count = 0
    for kind in ("free_ball", "rotor", "levels"):
        with open(f"{folder}/{kind}.csv", encoding="ascii") as file:
            table = list(csv.DictReader(line for line in file if line[0] != "#"))
        for row in table:
            if float(row["s" if kind == "levels" else "t"]) > longest or not -4 < float(row["k"]) < 4:
                continue
            run = [isoroll, "run", "-", "--certify", "--digits", "30"]
            done = subprocess.run(run, input=scene_of(row, kind), capture_output=True, text=True, check=False)
            if done.returncode != 0:
                print(f"FAIL {row['id']}: {done.stderr}")
                wrong += 1
                continue
            found = read(done.stdout.splitlines())[1][-1]
            for column in row:
                name = own.get(column[:-1], column) + (column[-1] if column[-1].isdigit() else "")
                if name not in found or column not in row:
                    continue
                x = exact(row[column])
                digits = len(row[column].lower().split("e")[0].lstrip("-0.").replace(".", ""))
                digits = 16 if kind == "rotor" else digits  # more are written, but they are not right
                near = max(mpf(10) ** (3 - min(digits, 27)), 100 * exact(row.get("err") or "0")) * (1 + abs(x))
                count += 1
                if not overlap(found[name], iv.mpf([x - near, x + near])):
                    print(f"FAIL {row['id']}: {name} is {found[name]}, and {row[column]}")
                    wrong += 1
    print(f"{count} numbers of the reference: {wrong} outside")
    return wrong or not count


def main():
    if sys.argv[1] == "laws":
        wrong = sum(laws(path) for path in sys.argv[2:])
    elif sys.argv[1] == "overlap":
        wrong = sum(compare(*pair) for pair in zip(sys.argv[2::2], sys.argv[3::2]))
    else:
        wrong = reference(sys.argv[2], sys.argv[3], float(sys.argv[4]))
    sys.exit(wrong > 0)


main()
