"""changes.py CERTIFICATE COUNT - makes COUNT false copies of a certificate; check.py must refuse each of them.

Each copy has one change that makes an inclusion false: a box of half its size, a number with the other sign, a step
left out, another number of the ball, another m. The certificate itself must be verified.
"""
import random
import sys
from fractions import Fraction

from check import Checker, Refused

BOXES = ("state", "to", "derivative", "sigma", "zero")  # they are larger than needed by about an eighth


def shrink(lines, choose):
    """A box of half its size."""
    chart = [i + 1 for i, line in enumerate(lines) if line.startswith("x ")]  # of one point, to rounding: not tight
    boxes = [i for i, line in enumerate(lines) if line.split()[0] in BOXES and any_radius(line)]
    at = choose([i for i in boxes if i not in chart])
    words = lines[at].split()
    i = choose([i for i in range(1, len(words), 4) if int(words[i + 2], 16)])
    words[i + 3] = f"{int(words[i + 3], 16) - 1:x}"
    return at, " ".join(words), f"ball {(i + 3) // 4} of half its size"


def any_radius(line):
    words = line.split()
    return any(int(words[i + 2], 16) for i in range(1, len(words), 4))


def apart(words, i):
    """Whether the ball does not hold 0, by far."""
    m, e, r, s = (int(word, 16) for word in words[i : i + 4])
    return m != 0 and abs(m).bit_length() + e > r.bit_length() + s + 3


def turn(lines, choose):
    """A number with the other sign."""
    kinds = BOXES + ("m", "x", "step", "centre", "drift", "middle", "frame", "frame-o", "cone", "size", "window")
    found = []
    for at, line in enumerate(lines):
        words = line.split()
        if words[0] in kinds:
            found += [(at, i) for i in range(1, len(words), 4) if apart(words, i)]
    at, i = choose(found)
    words = lines[at].split()
    words[i] = words[i][1:] if words[i][0] == "-" else "-" + words[i]
    return at, " ".join(words), f"ball {(i + 3) // 4} with the other sign"


def omit(lines, choose):
    """A step and its state."""
    at = choose([i for i, line in enumerate(lines) if line.startswith("step") and lines[i + 1].startswith("state")])
    return at, None, "a step is left out"


def ball(lines, choose):
    """Another ball: a moment a little off, or k; an interval of k by its length, as small parts hide in its boxes."""
    at = choose([i for i, line in enumerate(lines) if line.split()[0] in ("k", "moments")])
    words = lines[at].split()
    places = (1, 2) if words[0] == "k" else (choose((1, 2, 3)),)
    length = Fraction(words[2]) - Fraction(words[1]) if words[0] == "k" else 0
    off = choose((1, -1)) * max(Fraction(1, 10**12), length)
    for i in places:
        words[i] = str(Fraction(words[i]) + off)
    return at, " ".join(words), "another ball"


def claim(lines, choose):
    """m or x beside the right one, or half the error, or another sign."""
    at = choose([i for i, line in enumerate(lines) if line.split()[0] in ("m", "sign")])
    words = lines[at].split()
    if words[0] == "sign":
        words[1] = "negative" if words[1] == "positive" else "positive"
    elif choose((0, 1)):
        words[4] = f"{int(words[4], 16) - 3:x}"
    else:
        m, e, r, s = (int(word, 16) for word in words[1:])
        words[1] = f"{m + (2 << (r.bit_length() + s - e)):x}"
    return at, " ".join(words), "another claim"


def changed(text, kind, choose):
    lines = [line for line in text.split("\n") if line and line[0] != "#"]
    at, line, what = kind(lines, choose)
    if line is None:
        del lines[at : at + 2]
    else:
        lines[at] = line
    return "\n".join(lines) + "\n", f"line {at + 1}: {what}"


def main():
    with open(sys.argv[1], encoding="ascii") as file:
        text = file.read()
    cache, wrong = set(), 0
    Checker(cache).run(text)  # it is verified, or this ends
    kinds = (shrink, turn, omit, ball, claim, shrink, turn, omit)
    generator = random.Random(1)
    for i in range(int(sys.argv[2])):
        false, what = changed(text, kinds[i % len(kinds)], generator.choice)
        try:
            Checker(cache).run(false)
        except Refused as refused:
            if "--tell" in sys.argv:
                print(f"{what}: {refused}")
        else:
            wrong += 1
            print(f"NOT REFUSED: {what}")
    print(f"{sys.argv[2]} changes, {wrong} not refused")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
