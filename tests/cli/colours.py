"""colours.py PALETTE SCRIPT... - tells lines of gnuplot's scripts apart as people see them.

Sights: the usual one, and those without red or green cones, by the matrices of Machado, Oliveira and Fernandes (2009),
severity 1, on linear RGB. Distances are those of CIE Lab 1976 (D65). In grey two lines differ by their lightness, or
by their dashes or signs. Scenery ($grid) is not looked at. Prints what fails; the exit status is then 1.
"""
import itertools
import re
import sys

APART, APART_IN_GREY = 20, 10
SIGHTS = {
    "usual": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "no red cones": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216),
                     (-0.003882, -0.048116, 1.051998)),
    "no green cones": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413),
                       (-0.011820, 0.042940, 0.968881)),
}


def linear(colour):
    """The colour #RRGGBB in linear RGB."""
    parts = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]


def times(matrix, v):
    return [sum(a * b for a, b in zip(row, v)) for row in matrix]


def lab(colour, sight):
    """CIE L*, a*, b* of the colour as this sight sees it."""
    rgb = [min(max(c, 0), 1) for c in times(SIGHTS[sight], linear(colour))]
    xyz = times(((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505)), rgb)
    f = [t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116 for t in (xyz[0] / 0.95047, xyz[1], xyz[2] / 1.08883)]
    return 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])


def distance(one, other, sight):
    return sum((a - b) ** 2 for a, b in zip(lab(one, sight), lab(other, sight))) ** 0.5


def lines_of(plot):
    """The lines of a plot: colour, and dash, sign and fashion, which are seen in grey."""
    found = set()
    for part in re.split(r",\s*(?=\$|NaN|'')", plot):
        colour = re.search(r"lc rgb '(#[0-9A-F]{6}|black)'", part)
        kind = re.search(r"\b(?:w|with) (l|lines|linespoints|impulses|p|points|yerrorbars)\b", part)
        if not colour or not kind or "$grid" in part:
            continue
        dash, sign = re.search(r"\bdt (\([^)]*\)|\d+)", part), re.search(r"\bpt (\d+)", part)
        found.add((colour[1].replace("black", "#000000"), dash[1] if dash else "1", sign[1] if sign else "",
                   kind[1][0]))
    return found


def check_plot(plot):
    """What cannot be told apart in one plot."""
    for one, other in itertools.combinations(sorted(lines_of(plot)), 2):
        if one[0] == other[0]:
            continue # told apart by their dashes, or the line and the signs of one thing
        for sight in SIGHTS:
            if distance(one[0], other[0], sight) < APART:
                yield f"{one[0]} and {other[0]}, {sight}: {distance(one[0], other[0], sight):.1f}"
        grey = abs(lab(one[0], "usual")[0] - lab(other[0], "usual")[0])
        if grey < APART_IN_GREY and one[1:] == other[1:]:
            yield f"{one[0]} and {other[0]} in grey: {grey:.1f}"


def check_scale(scale):
    """A scale must grow lighter or darker throughout, and in steps that all can see."""
    colours = re.findall(r"#[0-9A-F]{6}", scale)
    for sight in SIGHTS:
        steps = [lab(b, sight)[0] - lab(a, sight)[0] for a, b in zip(colours, colours[1:])]
        if min(steps) * max(steps) <= 0 or min(abs(s) for s in steps) < 3:
            yield f"a scale, {sight}: lightness goes by {', '.join(f'{s:.0f}' for s in steps)}"


def main():
    palette = set(re.findall(r"#[0-9A-F]{6}", open(sys.argv[1], encoding="utf-8").read()))
    bad, plots, pairs = set(), 0, 0
    for name in sys.argv[2:]:
        script = open(name, encoding="utf-8").read()
        scales = re.findall(r"set palette defined \(([^)]*)\)", script)
        for plot in re.findall(r"^(?:set |do )?.*?plot (.*)$", script, re.M):
            plots += 1
            pairs += len(lines_of(plot)) > 1
            bad |= {f"{name}: {what}" for what in check_plot(plot)}
        for scale in scales:
            bad |= {f"{name}: {what}" for what in check_scale(scale)}
            script = script.replace(scale, "")
        bad |= {f"{name}: {c} is not in the palette" for c in re.findall(r"#[0-9A-F]{6}", script) if c not in palette}
    print("\n".join(sorted(bad)))
    print(f"{plots} plots, {pairs} with lines of two colours")
    return 1 if bad or pairs < 5 else 0


if __name__ == "__main__":
    sys.exit(main())
