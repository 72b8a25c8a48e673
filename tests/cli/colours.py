"""colours.py PAGE SCRIPT... - tells lines of gnuplot's scripts apart as people see them. PAGE, pictures/page.gp, names
all colours; a script names them (blue), has them in an array (fill[c]) or in the style of a line (ls 3, ls look(b)).

Sights: the usual one, and those without red or green cones, by the matrices of Machado, Oliveira and Fernandes (2009),
severity 1, on linear RGB. Distances are those of CIE Lab 1976 (D65). In grey two lines differ by their lightness, or
by their dashes or signs. Scenery (globe_x) is not looked at. Prints what fails; the exit status is then 1.
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


MOST = 10  # strokes
COLOUR = r"lc rgb\s+('#[0-9A-F]{6}'|'black'|\w+(?:\[[^]]*\])?)"


class Script:
    """Its colours by name, its styles of lines, and its plots."""

    def __init__(self, text):
        text = re.sub(r"\\\n\s*", " ", text)  # lines that go on
        self.colours = dict(re.findall(r"(\w+) = '(#[0-9A-F]{6})'", text), black="#000000")
        self.arrays = {name: re.findall(r"'[^']*'|[\w-]+", items)
                       for name, items in re.findall(r"array (\w+)\[\d+\] = \[([^]]*)\]", text)}
        self.styles = {int(number): look for number, look in re.findall(r"set style line (\d+) (.*)", text)}
        self.plots = re.findall(r"\bplot (.*)$", text, re.M) + re.findall(r"^\w+ = [\"'](.* with .*)$", text, re.M)

    def item(self, word, i):
        """A word itself, or the i-th item of its array, i from 0; "": there is none."""
        items = self.arrays.get(word.partition("[")[0], []) if "[" in word else [word] * MOST
        return items[i].strip("'") if i < len(items) else ""

    def look(self, part, i):
        """Colour, dash and sign where the number of a loop is i + 1: of a style, ls n or ls 10 + n, or of its own."""
        if style := re.search(r"\bls (\d+ \+|\d+|\w+)", part):
            number = style[1]
            part += " " + self.styles.get(int(number) if number.isdigit() else i + 1 + 10 * number.endswith("+"), "")
        found = [re.search(form, part) for form in (COLOUR, r"\bdt (\([^)]*\)|\w+)", r"\bpt (\d+|\w+\[[^]]*\])")]
        colour, dash, sign = (self.item(f[1], i) if f else "" for f in found)
        return self.colours.get(colour, colour if colour.startswith("#") else ""), dash or "1", sign

    def lines_of(self, plot):
        """The lines of a plot: colour, and dash, sign and fashion, which are seen in grey."""
        found = set()
        for part in re.split(r",\s*(?=for \[|\$|NaN|'')", plot):
            kind = re.search(r"\b(?:w|with) (l|lines|linespoints|impulses|p|points|yerrorbars)\b", part)
            if kind and "globe_x" not in part:
                found |= {(*self.look(part, i), kind[1][0]) for i in range(MOST)}
        return {line for line in found if line[0]}


def check_plot(lines):
    """What cannot be told apart in one plot."""
    for one, other in itertools.combinations(sorted(lines), 2):
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
        text = open(name, encoding="utf-8").read()
        script = Script(text)
        for plot in script.plots:
            lines = script.lines_of(plot)
            plots += 1
            pairs += len(lines) > 1
            bad |= {f"{name}: {what}" for what in check_plot(lines)}
        for scale in re.findall(r"set palette defined \(([^)]*)\)", text):
            bad |= {f"{name}: {what}" for what in check_scale(scale)}
            text = text.replace(scale, "")
        bad |= {f"{name}: {c} is not in the palette" for c in re.findall(r"#[0-9A-F]{6}", text) if c not in palette}
    print("\n".join(sorted(bad)))
    print(f"{plots} plots, {pairs} with lines of two colours")
    return 1 if bad or pairs < 5 else 0


if __name__ == "__main__":
    sys.exit(main())
