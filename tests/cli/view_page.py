"""view_page.py ISOROLL SOURCE WORK - pages of isoroll view in a Chromium.

Prints a line "PASS words" or "FAIL words" for each check. The bound of positions is that of the cubic curves between
rows that are VIEW_TURN apart (apps/isoroll/view.h); at rows the page is exact to rounding."""
import math
import os
import random

import chromium
from view_tools import box, check, quiet, run, source, still, table, text, work, write

BOUND = 1e-6


def vector(row, name, first=1, size=3):
    return [row[f"{name}{first + i}"] for i in range(size)]


def apart(a, b):
    return max(abs(x - y) for x, y in zip(a, b)) / max(1, max(map(abs, b)))


def distance(state, row, names=("n", "gamma", "contact", "centre"), length=1):
    """The largest difference of a page's place, in n, gamma and space, and a row of isoroll run; places in space are
    measured in `length`."""
    q = vector(row, "q", 0, 4)
    worst = min(apart(state["q"], q), apart(state["q"], [-x for x in q]))
    for name in names:
        if name + "1" in row and name in state:
            size = length if name.startswith("c") else 1
            worst = max(worst, apart(state[name], [x / size for x in vector(row, name)]))
    return worst


# --- scenes -------------------------------------------------------------------------------------------------------

START = "normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]"
SCENES = {  # the ball, its start, end and step, effects
    "shell": ("reduced: {k: -1, J: [1, 2, 5]}",
              "normal: [0.6, 0, 0.8], angular_velocity: [0.8, 0.1, -0.6]", 30, 0.1, ""),
    "plane": ("ball: {mass: 2, radius: 0.5, inertia: [0.1, 0.15, 0.2]}\nsurface: {kind: plane}", START, 20, 0.2, ""),
    "outside": ("reduced: {k: 0.5, J: [1, 2, 5]}", START, 20, 0.2, ""),
    "bowl": ("reduced: {k: 1.5, J: [1, 2, 3]}",
             "normal: [0.6, 0, 0.8], angular_velocity: [0.8, 1.5, -0.6]", 5, 0.05,
             "  gravity: {mgb: -0.7, up: [0, 0.6, 0.8]}\n"),
}


def scene(name, columns=None):
    ball, start, end, step, effects = SCENES[name]
    effects += "  attitude: {}\n" if columns else ""
    text = f"{ball}\ninitial: {{{start}}}\ntime: {{end: {end}, step: {step}}}\n"
    text += f"effects:\n{effects}" if effects else ""
    return text + (f"output: {{columns: [{columns}]}}\n" if columns else "")


def columns_of(name):
    twin = "tau, s, M1, M2, M3, gamma1, gamma2, gamma3, " if name != "bowl" else ""
    return ("t, " + twin + "omega1, omega2, omega3, n1, n2, n3, q0, q1, q2, q3, "
            "contact1, contact2, contact3, centre1, centre2, centre3")


def positions(page, name):
    """Positions read back from the page against isoroll run, at rows and at random times between them."""
    numbers = random.Random(1)
    end, step = SCENES[name][2:4]
    times = sorted([step * numbers.randrange(int(end / step)) for _ in range(8)] + [end]
                   + [end * numbers.random() for _ in range(12)])
    write("times.txt", "\n".join(repr(t) for t in times))
    write("wide.yaml", scene(name, columns_of(name)))
    run("run", "wide.yaml", "--times", "times.txt", "-o", "wide.csv")
    rows = table("wide.csv")
    check(f"{name}: as many rows as times", len(rows) == len(times))
    worst = max(distance(page.evaluate(f"isoroll.seek({row['t']!r})"), row) for row in rows)
    check(f"{name}: positions at t", worst <= BOUND, worst)
    worst = max(distance(page.evaluate(f"isoroll.seek({row['t']!r})"), row, ("omega", "M")) for row in rows)
    check(f"{name}: omega and M at t", worst <= (1e-3 if name == "bowl" else 1e-5), worst)  # of third, fourth order
    for clock in ("tau", "s"):
        if clock not in rows[0]:
            continue
        page.evaluate(f"isoroll.setClock('{clock}')")
        states = [page.evaluate(f"isoroll.seek({row[clock]!r})") for row in rows]
        worst = max(max(distance(state, row), abs(state["t"] - row["t"]) / end) for state, row in zip(states, rows))
        check(f"{name}: positions at {clock}", worst <= BOUND, worst)
    page.evaluate("isoroll.setClock('t')")


def pace(page, name, k, J):
    """ds/dt read back from the page against (k^2/det J) q^(1+1/(2k)), dtau/dt against q^(1-1/(2k))."""
    worst, slowest, fastest = 0, math.inf, 0
    page.evaluate("isoroll.setClock('t')")
    for i in range(1, 20):
        t, d = i, 1e-3
        before, now, after = (page.evaluate(f"isoroll.seek({x!r})") for x in (t - d, t, t + d))
        q = 1 / sum(x * x / y for x, y in zip(now["n"], J))
        rate = k * k / math.prod(J) * q ** (1 + 1 / (2 * k))
        slowest, fastest = min(slowest, rate), max(fastest, rate)
        worst = max(worst, abs((after["s"] - before["s"]) / (2 * d) / rate - 1),
                    abs((after["tau"] - before["tau"]) / (2 * d) / q ** (1 - 1 / (2 * k)) - 1))
    check(f"{name}: ds/dt and dtau/dt", worst <= 1e-4, worst)  # of second order in d
    check(f"{name}: the other clock is faster, then slower", fastest > 1.1 * slowest, (slowest, fastest))
    # the same time in s, evenly: equal steps of s are no equal steps of t
    page.evaluate("isoroll.setClock('s')")
    to = page.evaluate("isoroll.range()[1]")
    steps = [page.evaluate(f"isoroll.seek({to * i / 40!r}).t") for i in range(41)]
    gains = [b - a for a, b in zip(steps, steps[1:])]
    check(f"{name}: with s running evenly t does not", max(gains) > 1.1 * min(gains) > 0, gains)
    page.evaluate("isoroll.setClock('t')")


def colours(page, name):
    """How many colours one of the pictures in space has."""
    return page.evaluate(
        f"""(() => {{ controls.draw();
        const from = document.getElementById('{name}'), to = document.createElement('canvas');
        const g = to.getContext('2d');
        to.width = 200; to.height = 200; g.drawImage(from, 0, 0, 200, 200);
        return new Set(new Uint32Array(g.getImageData(0, 0, 200, 200).data.buffer)).size; }})()""")


def scenes(browser):
    for name in SCENES:
        write(name + ".yaml", scene(name))
        run("view", name + ".yaml", "-o", name + ".html")
        page = browser.open(os.path.join(work, name + ".html"), media=still)
        positions(page, name)
        if name in ("shell", "outside"):
            pace(page, name, *{"shell": (-1, (1, 2, 5)), "outside": (0.5, (1, 2, 5))}[name])
        end = SCENES[name][2]
        page.key("End")
        page.frame()
        at, button = page.evaluate("isoroll.state().t"), page.evaluate("document.getElementById('play').textContent")
        check(f"{name}: End is the end", abs(at - end) < 1e-9 * end and button == "Play again", (at, button))
        for canvas in ("ball",) if name == "bowl" else ("ball", "point"):
            found = colours(page, canvas)
            check(f"{name}: the picture '{canvas}' is not blank", found > 200, found)
        quiet(page, name)


def parted(browser):
    """A chaotic orbit: its two computations part, and M and gamma stay those of one of them: (M, gamma) = 0."""
    write("chaos.yaml", f"{SCENES['outside'][0]}\ninitial: {{{START}}}\ntime: {{end: 1000, step: 0.1}}\n")
    run("view", "chaos.yaml", "-o", "chaos.html")
    page = browser.open(os.path.join(work, "chaos.html"), media=still)
    worst = 0
    for i in range(40):
        now = page.evaluate(f"isoroll.seek({25 * i + 25}.05)")
        worst = max(worst, abs(sum(a * b for a, b in zip(now["M"], now["gamma"]))) / math.hypot(*now["M"]))
    check("chaos: M is at a right angle to gamma, also between rows", worst <= 1e-4, worst)  # rows turn by 0.3
    words = text(page, "difference-words")
    check("chaos: the page says from when on the computations part", "From t = " in words, words)


# --- numbers, slopes, very large spheres ---

def extremes(browser):
    def opened(name, text):
        write(name + ".yaml", text)
        run("view", name + ".yaml", "-o", name + ".html")
        return browser.open(os.path.join(work, name + ".html"), media=still)
    page = opened("slow", "reduced: {k: -1, J: [1, 2, 5]}\ninitial: {normal: [0.6, 0, 0.8], "
                  "angular_velocity: [8.0e-7, 1.0e-7, -6.0e-7]}\ntime: {end: 3.0e+7, step: 1.0e+5}\n")
    cells = page.evaluate("[...document.querySelectorAll('#state td')].map((e) => e.textContent)")
    check("small numbers have digits", "8·10⁻⁷" in cells and not any("0.0000" == c for c in cells[:3]), cells)
    ball = "ball: {mass: 2, radius: 0.5, inertia: [0.1, 0.15, 0.2]}\nsurface: {kind: plane}\n"
    page = opened("slope", ball + f"initial: {{{START}}}\ntime: {{end: 2, step: 0.1}}\n"
                  "effects: {gravity: {g: 9.8, up: [0, 0.6, 0.8]}}\n")
    found = page.evaluate("""dot(upOf(controls.orbit), turned(controls.orbit.q[0], controls.orbit.n[0]))""")
    check("a slope is drawn with its angle", abs(found - (0.48 * 0.6 + 0.8 * 0.8)) < 1e-9, found)
    for k in (1.0000001, 0.99, 1.001):
        page = opened("large", f"reduced: {{k: {k}, J: [1, 2, 5]}}\ninitial: {{{START}}}\n"
                      "time: {end: 20, step: 0.2}\n")
        check(f"k = {k}: begins beside the ball", page.evaluate("document.getElementById('frame').value") == "follow")
        ball = page.evaluate("""(() => { const ball = controls.pictures[0];
            ball.show(controls.now, controls.trail()); ball.draw();
            const at = ball.ball.getWorldPosition(new THREE.Vector3()).project(ball.eye);
            return [at.x, at.y, Math.abs(at.z)]; })()""")
        check(f"k = {k}: the ball is in the middle", max(map(abs, ball[:2])) < 1e-6 and ball[2] < 1, ball)
        found = colours(page, "ball")
        check(f"k = {k}: the ball is not blank", found > 200, found)
        quiet(page, f"k = {k}")


# --- trajectories -------------------------------------------------------------------------------------------------

def trajectories(browser):
    """What a file lacks is computed from row to row: it must agree with isoroll run of the scene."""
    for name in ("shell", "plane", "bowl"):
        run("run", name + ".yaml", "-o", "plain.csv")
        run("view", "plain.csv", "-o", "plain.html")
        write("wide.yaml", scene(name, columns_of(name)))
        run("run", "wide.yaml", "-o", "wide.csv")
        page = browser.open(os.path.join(work, "plain.html"), media=still)
        # such a file does not say the radius: it is the unit of length
        radius = 0.5 if name == "plane" else 1
        worst = max(distance(page.evaluate(f"isoroll.seek({row['t']!r})"), row, length=radius)
                    for row in table("wide.csv")[::7])
        check(f"trajectory {name}: positions at rows", worst <= BOUND, worst)
        last = table("wide.csv")[-1]
        now = page.evaluate(f"isoroll.seek({last['t']!r})")
        worst = max((abs(now[clock] / last[clock] - 1) for clock in ("tau", "s") if clock in last), default=0)
        check(f"trajectory {name}: the other clocks at the end", worst <= 1e-9, worst)
        quiet(page, "trajectory " + name)
    run("run", f"{source}/examples/09_off_the_top/scene.yaml", "-o", "off.csv")
    run("view", "off.csv", "-o", "off.html")
    page = browser.open(os.path.join(work, "off.html"), media=still)
    page.key("End")
    page.frame()
    words = text(page, "left-words")
    check("off the top: contact is lost at the end", "contact is lost at the end" in words, words)
    words = text(page, "state")
    check("off the top: no bound of friction is enough there", "mu needed∞" in words, words)
    run("run", "shell.yaml", "--step", "3e-4", "-o", "many.csv")
    run("view", "many.csv", "-o", "many.html")
    page = browser.open(os.path.join(work, "many.html"))
    words = text(page, "notes")
    check("100001 rows: the page says what it has", "of 100001." in words, words)
    page.evaluate("isoroll.play(true); window.was = isoroll.drawn(); new Promise(r => setTimeout(r, 3000))")
    print("frames a second with 100001 rows:", page.evaluate("(isoroll.drawn() - window.was) / 3"))
    page.wait("isoroll.time() > 0")


# --- a section ----------------------------------------------------------------------------------------------------

def section(browser):
    run("section", "outside.yaml", "--starts", "12", "--crossings", "60", "--quiet", "-o", "section.csv")
    run("view", "section.csv", "-o", "section.html")
    page = browser.open(os.path.join(work, "section.html"), width=1280, height=1600, media=still)
    rows, number = table("section.csv"), 5
    for plot in (0, 1):
        wanted = number + plot
        page.evaluate("document.getElementById('sections').scrollIntoView()")
        # where another orbit's dot is nearer, that one runs: a dot is found that stands alone
        x, y = page.evaluate(f"isoroll.sections().alone({plot}, {wanted})")
        page.click(x, y)
        check(f"a click in section {plot} chooses the orbit", page.evaluate("isoroll.sections().chosen") == wanted,
              page.evaluate("isoroll.sections().chosen"))
        check("and runs it, though it stood still", page.evaluate("isoroll.state().playing"))
        state = page.evaluate("isoroll.seek(0)")
        off = max(abs(state["n"][2]), abs(state["gamma"][2]))
        check("its orbit starts on the section", off < 1e-9, off)
        own = [row for row in rows if row["orbit"] == wanted]
        found = page.evaluate("isoroll.sections().crossings()")
        worst = max(max(abs(math.remainder(a["l"] - b["l"], 2 * math.pi)), abs(a["x"] - b["x"]))
                    for a, b in zip(found[:6], own))  # on a chaotic orbit rounding errors grow from return to return
        check("it crosses where the file says", len(found) >= 3 and worst <= 2e-3, (len(found), worst))
    page.evaluate("document.getElementById('section-point').focus()")
    page.key("ArrowRight")
    check("arrow keys choose the next orbit", page.evaluate("isoroll.sections().chosen") == number + 2)
    page.frame()
    check("the sections are not blank", page.evaluate(
        """(() => { const g = document.getElementById('section-ball').getContext('2d');
        return new Set(new Uint32Array(g.getImageData(0, 0, 500, 300).data.buffer)).size; })()""") > 8)
    quiet(page, "section")
    page.close()


def section_of_a_level(browser):
    """On a level H the point is faster by H: the plot of (l, L) shows its own L."""
    write("level.yaml", open(os.path.join(work, "outside.yaml")).read() + "effects: {level: {c: 0.3}}\n")
    run("section", "level.yaml", "--as", "ball", "--starts", "3", "--crossings", "10", "--quiet", "-o", "level.csv")
    run("view", "level.csv", "-o", "level.html")
    page = browser.open(os.path.join(work, "level.html"), media=still)
    gap = page.evaluate("""(() => { const a = Number(tables('section')[0].lines.axis) - 1, gamma = controls.orbit.gamma[0], M = controls.orbit.M[0],
        l = Math.atan2(-gamma[(a + 2) % 3], gamma[(a + 1) % 3]);
        return Math.abs(isoroll.sections().place(1, l, M[a] / Math.hypot(...M))[1] - M[a]); })()""")
    check(f"a level: L is that of the point: {gap:.1e}", gap < 1e-9)
    page.close()


# --- keys, sizes, themes ------------------------------------------------------------------------------------------

def keyboard(browser):
    page = browser.open(os.path.join(work, "shell.html"), media=still)
    check("reduced motion: it does not start by itself", not page.evaluate("isoroll.state().playing"))
    seen = []
    for _ in range(18):
        page.key("Tab")
        seen.append(page.evaluate("document.activeElement.id || document.activeElement.className"))
        check("the focus is seen on " + (seen[-1] or "the page"), page.evaluate(
            "document.activeElement === document.body || "
            "getComputedStyle(document.activeElement).outlineStyle !== 'none'"))
    wanted = ["ball", "point", "compare", "beside", "speed", "trail", "frame", "reset", "picture", "film", "screen",
              "clock", "play", "scrub"]
    check("Tab reaches everything, in the order of the page", seen[:len(wanted)] == wanted, seen)
    page.evaluate("document.activeElement.blur()")
    for key, test in ((" ", "isoroll.state().playing"), (" ", "!isoroll.state().playing"),
                      ("3", "isoroll.clock() === 's'"), ("2", "isoroll.clock() === 'tau'"),
                      ("1", "isoroll.clock() === 't'"), ("End", "isoroll.time() === isoroll.range()[1]"),
                      ("ArrowLeft", "isoroll.time() < isoroll.range()[1]"), ("Home", "isoroll.time() === 0"),
                      ("ArrowRight", "isoroll.time() > 0"), ("+", "isoroll.state().speed === 2"),
                      ("-", "isoroll.state().speed === 1")):
        page.key(key)
        check(f"key '{key}': {test}", page.evaluate(test))
    before = page.evaluate("camera.azimuth")
    page.evaluate("document.getElementById('point').focus()")
    page.key("ArrowRight")
    turned = page.evaluate("camera.azimuth")
    check("arrow keys turn the pictures, and leave the time", turned != before)
    x, y, *size = box(page, "ball")
    page.drag(x + 60, y + 60, 80, 30)
    check("a drag turns both pictures", page.evaluate("camera.azimuth") != turned)
    page.evaluate("isoroll.play(true)")
    page.wait("isoroll.time() > 0.5")
    quiet(page, "keyboard")
    page = browser.open(os.path.join(work, "shell.html"))
    check("without reduced motion it starts", page.evaluate("isoroll.state().playing"))
    page.wait("isoroll.time() > 0.2")


def sizes(browser):
    for name in ("shell", "bowl", "section"):
        for width in (390, 1920):
            page = browser.open(os.path.join(work, name + ".html"), width=width, height=900, media=still)
            wide = page.evaluate("document.documentElement.scrollWidth")
            check(f"{name}, {width} px: nothing sticks out", wide <= width, wide)
            left = box(page, "ball")
            right = left if name == "bowl" else box(page, "point")
            stacked = right[1] >= left[1] + left[3]
            check(f"{name}, {width} px: side by side, or on a phone one above the other",
                  name == "bowl" or stacked == (width < 500))
            check(f"{name}, {width} px: pictures are large",
                  min(left[2], right[2]) > 0.4 * min(width, 760) and left[3] > 190, left)
            # labels do not overlap: no text is wider than its box
            cut = page.evaluate("""
                [...document.querySelectorAll('.clock span, figcaption, button, h1, h2, .legend li')]
                .filter((e) => e.getClientRects().length && getComputedStyle(e).display !== 'inline')
                .filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent)""")
            check(f"{name}, {width} px: no text is cut", not cut, cut)
    shades = {}
    for theme in ("light", "dark"):
        page = browser.open(os.path.join(work, "shell.html"), media=still + (("prefers-color-scheme", theme),))
        shades[theme] = page.evaluate("getComputedStyle(document.body).backgroundColor")
    light, dark = (sum(map(int, shades[theme][4:-1].split(","))) for theme in ("light", "dark"))
    check("light and dark", light > 600 and dark < 150, shades)


# --- hostile texts, no WebGL --------------------------------------------------------------------------------------

def hostile(browser):
    name = "<img src=x onerror=alert(1)>&amp;'\".csv"
    run("run", "shell.yaml", "-o", "plain.csv")
    lines = open(os.path.join(work, "plain.csv")).read().split("\n")
    lines[1:1] = ["# note: </script><script>alert(2)</script>", "# title: <img src=x onerror=alert(3)>"]
    write(name, "\n".join(lines))
    run("view", name, "-o", "hostile.html")
    page = browser.open(os.path.join(work, "hostile.html"), media=still)
    check("a hostile name is text", name in page.evaluate("[...document.querySelectorAll('dd')].map((e) => e.textContent)"))
    check("no element of it", page.evaluate("document.querySelectorAll('img, iframe, object, embed').length") == 0)
    check("nothing of it runs", not page.events("Page.javascriptDialogOpening"))
    quiet(page, "hostile")


def without_webgl():
    with chromium.Browser("--disable-3d-apis") as browser:
        page = browser.open(os.path.join(work, "shell.html"), media=still)
        check("without WebGL: words", "no WebGL" in text(page, "trouble"))
        check("without WebGL: numbers", abs(page.evaluate("isoroll.seek(7).t") - 7) < 1e-9)
        page.frame()
        check("without WebGL: the table", page.evaluate("document.getElementById('state').rows.length") >= 5)
        quiet(page, "without WebGL")


with chromium.Browser() as one:
    for part in (scenes, parted, extremes, trajectories, section, section_of_a_level, keyboard, sizes, hostile):
        part(one)
without_webgl()
print("PASS the end")
