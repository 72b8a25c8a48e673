"""integrable.py ISOROLL COUNT DIGITS ... - `isoroll prove` at k = 1 and -1, where m is 0, for COUNT random J.

Each enclosure must hold 0, be as narrow as its digits say, and be narrower than that with fewer digits. A line for
each J tells the seconds of each number of digits. Start it by hand: 50 J at 30, 60 and 120 digits take hours. The test
`prove` has a short one. The exit status is 0 if all holds.
"""
import json
import random
import resource
import subprocess
import sys
import tempfile

SCENE = """reduced: {{k: {k}, J: [{J[0]}, {J[1]}, {J[2]}]}}
initial: {{normal: [0, 0, 1], angular_velocity: [1, 0, 0]}}
time: {{end: 1}}
"""


def seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def enclose(isoroll, k, J, digits):
    """Both bounds of m, and the seconds of a core that it took."""
    before = seconds()
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(SCENE.format(k=k, J=J))
        file.flush()
        out = subprocess.run([isoroll, "prove", file.name, "--digits", str(digits), "--json"], check=True,
                             capture_output=True).stdout
    m = json.loads(out)["m"]
    return m["low"], m["high"], seconds() - before


def main():
    if len(sys.argv) < 4:
        print(__doc__, file=sys.stderr)
        return 2
    isoroll, count, all_digits = sys.argv[1], int(sys.argv[2]), sorted(map(int, sys.argv[3:]))
    generator = random.Random(35)
    wrong, totals = 0, [0.0] * len(all_digits)
    for i in range(count):
        k = -1 if i % 2 else 1
        J = [(100 + 100 * j + generator.randrange(90)) / 100 for j in range(3)]
        line, last = f"k = {k}, J = {J}:", float("inf")
        for j, digits in enumerate(all_digits):
            low, high, took = enclose(isoroll, k, J, digits)
            good = low <= 0 <= high and high - low < min(last, 2.1 * 10.0**-digits)
            wrong += not good
            line += f"  {digits} digits: {high - low:.1e}, {took:.1f} s{'' if good else ' WRONG'}"
            last, totals[j] = high - low, totals[j] + took
        print(line, flush=True)
    means = ", ".join(f"{total / count:.1f} s at {digits} digits" for digits, total in zip(all_digits, totals))
    print(f"{count} J, {wrong} wrong; on average {means}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
