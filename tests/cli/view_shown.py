"""view_shown.py ISOROLL SOURCE WORK - what a page of isoroll view shows to one who read nothing: its words, what is in
sight, the compared paths, the neighbour, the state in its address, films.

Prints a line "PASS words" or "FAIL words" for each check. Bounds: places 1e-6, as in view_page.py; a neighbour's
distance is compared with two runs of isoroll, whose errors of 1e-12 are 1e-6 of it."""
import math
import os
import re

import chromium
from view_tools import box, check, quiet, run, still, table, text, work, write

START = {"normal": (0.36, 0.48, 0.8), "angular_velocity": (0.9, -0.3, -0.225)}
SIZES = ((1440, 900), (390, 844), (1920, 1080))
J = (1, 2, 5)


def scene_of(head, effects="", start=START, end=20):
    initial = ", ".join(f"{name}: {list(v)}" for name, v in start.items())
    return f"{head}\ninitial: {{{initial}}}\ntime: {{end: {end}, step: 0.1}}\n{effects}"


REDUCED = "reduced: {{k: {}, J: [1, 2, 5]}}"
PAGES = {
    "neumann": scene_of(REDUCED.format(-1), "effects: {attitude: {}}\n"),
    "braden": scene_of(REDUCED.format(1)),
    "chaotic": scene_of(REDUCED.format(0.5), end=100),
    "parted": scene_of(REDUCED.format(0.5), end=1000),
    "metres": scene_of("ball: {mass: 2, radius: 0.5, inertia: [0.1, 0.15, 0.2]}\nsurface: {kind: plane}"),
    "rest": "point: {k: -1, J: [1.0, 1.5, 2.0], eps: 0.5}\ninitial: {gamma: [0.36, 0.48, 0.8], M: [0, 0, 0]}\n"
            "time: {end: 10, step: 0.1}\n",
    "hill": scene_of(REDUCED.format(0.5), "effects: {gravity: {mgb: 0.1, up: [0.36, 0.48, 0.8]}}\n", end=2),
}


def make_pages():
    for name, scene in PAGES.items():
        write(name + ".yaml", scene)
        run("view", name + ".yaml", "-o", name + ".html")
    run("section", "chaotic.yaml", "--starts", "20", "--crossings", "100", "--quiet", "-o", "sea.csv")
    run("view", "sea.csv", "-o", "sea.html")


now_open = []


def opened(browser, name, width=1440, height=900, fragment="", media=still):
    """Opens a page, and closes the one before."""
    while now_open:
        now_open.pop().close()
    page = browser.open(os.path.join(work, name + ".html"), width, height, fragment, media)
    now_open.append(page)
    page.frame()
    return page


def resized(page, width, height):
    page.size(width, height)
    page.wait(f"innerWidth === {width}")
    page.frame()


def seen(page, name):
    return page.evaluate(f"document.getElementById('{name}').checkVisibility()")


# --- words --------------------------------------------------------------------------------------------------------

def words(browser):
    for name, k in (("neumann", -1), ("braden", 1), ("chaotic", 0.5)):
        page = opened(browser, name)
        title, about = text(page, "title"), text(page, "about")
        check(f"{name}: the title says what it is", "ball" in title and "point" in title and ".yaml" not in title, title)
        check(f"{name}: the file is named below", name + ".yaml" in about, about)
        check(f"{name}: an attitude is listed where it is stated", ("attitude" in about) == (name == "neumann"), about)
        formula = text(page, "right-words")
        check(f"{name}: the formula of V", "V = −ε (γ, Jγ)" in formula, formula)
        power = page.evaluate("(document.querySelector('#right-words sup') || {textContent: '1'}).textContent")
        power = float(power.strip("\u2060").replace("−", "-"))
        check(f"{name}: its exponent is -1/k", abs(power + 1 / k) < 1e-3, power)
        V = page.evaluate("physics.V([0.6, 0, 0.8])")
        own = -page.evaluate("page.eps") * (0.36 * J[0] + 0.64 * J[2]) ** power
        check(f"{name}: the sphere is shaded by it", abs(V / own - 1) < 1e-9, (V, own))
        numbers = text(page, "numbers")
        check(f"{name}: what is 0 within rounding is called so", "0 within rounding" in numbers, numbers)
        small = re.findall(r"·10⁻(?:1[5-9]|¹[⁵⁶⁷⁸⁹]|[²³]\S)", numbers)
        check(f"{name}: no digits of rounding errors", not [x for x in small if x != "·10⁻¹⁵"], small)
        shown = numbers + text(page, "models")
        check(f"{name}: no unit of a scene without units", not re.search("J[²³⁴⁵]|mass[²·]|/time", shown), shown)
        quiet(page, name)
    page = opened(browser, "metres")
    numbers = text(page, "numbers") + text(page, "models")
    check("metres: units in mass, length and time", "mass·length²/time²" in numbers, numbers)
    check("metres: J is no unit", not re.search("J[²³⁴⁵/]|J stands", numbers), numbers)
    now = page.evaluate("steady(3.1e-17, 1) + steady(0.5, 1)")
    check("a component of a rounding error is 0", now == "00.5000", now)


def alone(browser):
    page = opened(browser, "rest", fragment="#view=compare,beside")
    check("rest: an orbit that begins at rest has no neighbour", not seen(page, "beside"))
    quiet(page, "rest")
    page = opened(browser, "hill")
    caption = text(page, "left-words")
    check("hill: the caption says why there is no twin", "no twin" in caption and "gravity" in caption, caption)
    check("hill: one sphere", seen(page, "ball") and not seen(page, "right") and not seen(page, "compare"))
    check("hill: the title says gravity", "gravity" in text(page, "title"), text(page, "title"))
    quiet(page, "hill")


# --- what is in sight ---------------------------------------------------------------------------------------------

def inside(page, name, height):
    _, y, _, tall = box(page, name)
    return y >= 0 and y + tall <= height


def in_sight(browser):
    for name in ("neumann", "hill", "sea"):
        page = opened(browser, name)
        for width, height in SIZES:
            resized(page, width, height)
            for place in (0, 1e6):
                page.evaluate(f"scrollTo(0, {place})")
                check(f"{name}, {width} x {height}: Play and the time are in sight, scrolled to {place:g}",
                      inside(page, "play", height) and inside(page, "scrub", height), box(page, "play"))
    page.evaluate("scrollTo(0, 0)")
    for width, height in ((1440, 900), (1920, 1080)):
        resized(page, width, height)
        low = box(page, "bar")[1]
        check(f"{width} x {height}: the sections are in sight with the motion",
              all(inside(page, canvas, low) for canvas in ("ball", "point", "section-ball", "section-point")))
    resized(page, 390, 844)
    ball, own = box(page, "ball"), box(page, "section-ball")
    check("on a phone the section follows its model", 0 < own[1] - ball[1] - ball[3] < 60, (ball, own))


def sharp(browser):
    """A slow computer draws with fewer pixels, and its texts with all."""
    page = opened(browser, "neumann")
    for view in ("", "controls.compare(true);"):
        sizes = page.evaluate(f"""(() => {{ {view} controls.setQuality(0.45); controls.draw();
            return controls.shown().map((p) => [p.canvas.width, p.marks.canvas.width,
                                                p.canvas.parentElement.clientWidth]); }})()""")
        for few, all_of_them, wide in sizes:
            check("texts keep all pixels of the screen", all_of_them == wide and few < 0.6 * wide, sizes)


# --- the sea, the neighbour ---------------------------------------------------------------------------------------

def sea(browser):
    page = opened(browser, "sea")
    orbits = page.evaluate("""isoroll.sections().orbits.map((number) => { const o = orbitOf(number);
        return {number, verdict: o.verdict, colour: isoroll.sections().colourOf(number),
                grows: Math.max(...o.near) / o.near[0]}; })""")
    kinds = {o["verdict"] for o in orbits}
    check("there are chaotic and regular orbits", {"chaotic", "regular"} <= kinds, kinds)
    for o in orbits:
        red, green, blue = (int(o["colour"][i:i + 2], 16) for i in (1, 3, 5))
        grey = max(red, green, blue) - min(red, green, blue) < 24
        check("the sea is grey, undecided orbits are dark, and nothing else", grey == (o["verdict"] != "regular"), o)
    shades = page.evaluate("""(([t]) => column(t, 'orbit').length && Object.fromEntries(
        Array.from(column(t, 'orbit'), (number, i) => [number, column(t, 'shade')[i]])))(tables('orbits'))""")
    check("the data say which orbits are grey", shades == {str(o["number"]): {"chaotic": "grey", "undecided": "dark",
          "regular": "colour"}[o["verdict"]] for o in orbits}, shades)
    least = min(o["grows"] for o in orbits if o["verdict"] == "chaotic")
    most = max(o["grows"] for o in orbits if o["verdict"] == "regular")
    check("neighbours in the sea run away, others do not", least > 30 and most < 1000, (least, most))
    quiet(page, "sea")


def moved_start():
    """omega turned about n by 1e-6."""
    w, n = START["angular_velocity"], START["normal"]
    cross = [n[(i + 1) % 3] * w[(i + 2) % 3] - n[(i + 2) % 3] * w[(i + 1) % 3] for i in range(3)]
    return {**START, "angular_velocity": tuple(a + 1e-6 * b for a, b in zip(w, cross))}


def neighbour(browser):
    speed = math.hypot(*START["angular_velocity"])
    for name, k, verdict in (("neumann", -1, "regular"), ("chaotic", 0.5, "chaotic")):
        write("moved.yaml", scene_of(REDUCED.format(k), start=moved_start()))
        write("first.yaml", scene_of(REDUCED.format(k)))
        for file in ("first", "moved"):
            run("run", file + ".yaml", "--as", "both", "-o", file + ".csv")
        first, moved = table("first.csv"), table("moved.csv")
        page = opened(browser, name, fragment="#view=beside")
        rows = page.evaluate("""(({t, near, beside}) => Array.from(t, (x, i) =>
            [x, near[i], ...beside[i]]))(controls.orbit)""")
        rows = {round(row[0], 9): row[1:] for row in rows}
        worst = place = 0
        for a, b in zip(first, moved):
            def apart(of, size):
                return [(a[of + i] - b[of + i]) / size for i in "123"]
            own = math.hypot(*apart("omega", speed), *apart("n", 1))
            near = rows[round(a["t"], 9)]
            worst = max(worst, abs(near[0] / own - 1))
            place = max(place, max(abs(near[1 + i] - b[f"gamma{i + 1}"]) for i in range(3)))
        check(f"{name}: the neighbour's distance is that of two runs", worst < 1e-4, worst)
        check(f"{name}: so is its place", place < 1e-9, place)
        check(f"{name}: it begins 1e-6 away", abs(rows[0.0][0] / 1e-6 - 1) < 1e-6, rows[0.0])
        told = text(page, "beside-words")
        check(f"{name}: the words say {verdict}", f"is {verdict}" in told, told)
        check(f"{name}: the curve is seen", seen(page, "growth"))
        quiet(page, "neighbour, " + name)
    rate = float(re.search(r"exponent ([\d.]+)", told).group(1))
    folding = float(re.search(r"t = ([\d.]+)", told).group(1))
    check("chaotic: e-folding and exponent", abs(rate * folding - 1) < 0.1, told)
    rise = math.log(rows[100.0][0] / rows[0.0][0]) / 100
    check("chaotic: the curve grows about so", 0.5 < rise / rate < 2, (rise, rate))


# --- the compared paths -------------------------------------------------------------------------------------------

def compared(browser):
    page = opened(browser, "chaotic", fragment="#t=33&view=compare")
    for width, height in SIZES:
        resized(page, width, height)
        left, right = box(page, "ball-path"), box(page, "point-path")
        check(f"{width} px: the paths lie side by side", abs(left[1] - right[1]) < 3 and abs(left[2] - right[2]) < 3
              and right[0] >= left[0] + left[2] and not seen(page, "ball"), (left, right))
    states = page.evaluate("""controls.paths.map((p) => p.states.map(({place, text, colour}) =>
        ({text, colour, place: place.clone().normalize().toArray()})))""")
    check("the numbers are 0 to 8 on both", [[s["text"] for s in side] for side in states] == [list("012345678")] * 2)
    worst = 0
    for n, gamma in zip(*states):
        image = [x / math.sqrt(moment) for x, moment in zip(n["place"], J)]
        size = math.hypot(*image)
        worst = max(worst, *(abs(x / size - y) for x, y in zip(image, gamma["place"])))
        check("equal states have equal colours", n["colour"] == gamma["colour"], (n, gamma))
    check("equal numbers are equal states: gamma = J^(-1/2) n/|J^(-1/2) n|", worst < 1e-6, worst)
    spread = min(math.dist(a["place"], b["place"]) for a, b in zip(states[0], states[0][1:]))
    check("they are different states", spread > 0.05, spread)
    page.evaluate("document.getElementById('compare').focus()")
    page.key(" ")
    check("the key of the button leaves it", seen(page, "ball") and not seen(page, "ball-path"))
    check("and it says so", page.evaluate("document.getElementById('compare').ariaPressed") == "false")
    quiet(page, "compared")
    page = opened(browser, "parted", fragment="#t=20&view=compare")
    same = text(page, "pace-words")
    page.evaluate("isoroll.seek(950)")
    page.frame()
    other = text(page, "pace-words")
    check("where the two computations have parted, no state is called equal",
          "are equal states" in same and "no longer equal states" in other, (same, other))


# --- the address, films, full screen ------------------------------------------------------------------------------

def address(browser):
    there = "#s=0.5&view=compare,beside&eye=0.3,0.2,1.5"
    page = opened(browser, "neumann", fragment=there, media=())
    state = page.evaluate("isoroll.state()")
    check("the address sets clock and time, and they stand", state["clock"] == "s" and not state["playing"]
          and abs(state["s"] - 0.5) < 1e-9, state)
    check("it sets the views", page.evaluate("[controls.compared, controls.beside]") == [True, True])
    check("it sets the eye", page.evaluate("[camera.azimuth, camera.elevation, camera.zoom]") == [0.3, 0.2, 1.5])
    page.evaluate("controls.compare(false); isoroll.setClock('t'); isoroll.seek(7.25)")
    length = page.evaluate("history.length")
    page.wait("address.text() === location.hash")
    now = page.evaluate("location.hash")
    check("what changes is written into it", now == "#t=7.25&view=beside&eye=0.3,0.2,1.5", now)
    check("without a step back for each change", page.evaluate("history.length") == length)
    page.evaluate("location.hash = '#t=3'")
    page.wait("isoroll.time() !== 7.25")
    check("another address on the open page is followed", page.evaluate("isoroll.time()") == 3)
    page = opened(browser, "sea", fragment="#orbit=4&t=2")
    check("it sets the orbit of a section", page.evaluate("isoroll.sections().chosen") == 4)
    page = opened(browser, "neumann", fragment="#t=abc")
    for wrong in ("#t=abc&eye=1,x&orbit=none&view=", "#%E0%A4%A", "#t=1e999&eye=0,0,0", "#s"):
        page.evaluate(f"location.hash = '{wrong}'; address.read()")
        check(f"{wrong} changes nothing", page.evaluate("isoroll.time()") == 0
              and page.evaluate("camera.zoom") == 1, page.evaluate("isoroll.state()"))
    quiet(page, "wrong addresses")
    check("no cookie, nothing stored", page.evaluate("document.cookie") == "" and page.evaluate("localStorage.length") == 0)


def films(browser):
    page = opened(browser, "neumann")
    page.evaluate("film.save = async (blob, ending) => { window.saved = [blob.type, blob.size, ending, "
                  "[...new Uint8Array(await blob.slice(0, 4).arrayBuffer())]]; }")
    page.evaluate("document.getElementById('film').click()")
    check("a film runs the motion", page.evaluate("isoroll.state().playing"))
    page.evaluate("window.size = 0; film.recorder.addEventListener('dataavailable', (e) => { size += e.data.size; })")
    page.wait("film.recorder.requestData(), window.size > 2000")
    page.evaluate("document.getElementById('film').click()")
    page.wait("window.saved")
    kind, size, ending, first = page.evaluate("window.saved")
    check("a film is webm", kind == "video/webm" and ending == "webm" and size > 2000
          and first == [0x1A, 0x45, 0xDF, 0xA3], (kind, size, first))
    page.evaluate("window.saved = null; document.getElementById('picture').click()")
    page.wait("window.saved")
    check("a picture is PNG", page.evaluate("window.saved[3]") == [0x89, 0x50, 0x4E, 0x47])
    x, y, wide, tall = box(page, "screen")
    page.click(x + wide / 2, y + tall / 2)
    page.wait("!!document.fullscreenElement")
    check("the button fills the screen", page.evaluate("document.fullscreenElement === document.documentElement"))
    quiet(page, "films")


make_pages()
with chromium.Browser() as one:
    for part in (words, alone, in_sight, sharp, sea, neighbour, compared, address, films):
        part(one)
print("PASS the end")
