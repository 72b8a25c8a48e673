"""view_live.py ISOROLL SOURCE WORK - the laboratory of `isoroll view --live` in a Chromium.

Prints a line "PASS words" or "FAIL words" for each check. Bounds were set before the first look: what the page computes
is the C library without AVX2, so a regular orbit agrees with the command to rounding that has grown for its time."""
import json
import math
import os
import random
import subprocess
import time

import chromium
from view_tools import box, check, run, still, table, text, work, write

STATE = 1e-12  # of states until t = 100, regular orbits
CROSSING = 1e-10  # of l and x, ten crossings

# k, J, n, omega of regular orbits: a shell, a plane, the outside, the inside
ORBITS = [(-1, [1, 2, 5], [0.36, 0.48, 0.8], [0.9, -0.3, -0.225]),
          (1, [1, 1.5, 2], [0.6, 0, 0.8], [0.8, 0.1, -0.6]),
          (0.5, [1, 1.1, 1.2], [0.36, 0.48, 0.8], [0.9, -0.3, -0.225]),
          (2, [2, 3, 4], [0.6, 0, 0.8], [0.8, 0.1, -0.6])]


def quiet(page, words):
    check(words + ": no message of the console", not page.messages(), str(page.messages())[:600])
    others = [url for url in page.requests() if not url.startswith(("file://", "blob:")) and url != "data:,"]
    check(words + ": no request but the page's", not others, str(others)[:300])


def scene(orbit, more=""):
    k, J, n, omega = orbit
    return (f"reduced: {{k: {k}, J: {J}}}\ninitial: {{normal: {n}, angular_velocity: {omega}}}\n"
            f"time: {{end: 100, step: 5}}\n{more}")


def settled(page):
    """Waits until orbit, section and verdict of the last change are there."""
    page.wait("lab.filled === lab.pending")
    page.frame()


def ask(page, job, given, options):
    """The library in the page, asked by a Worker as the page asks it; columns as lists."""
    return page.evaluate(f"""(async () => {{ const helper = new Helper();
        const found = await helper.ask('{job}', {json.dumps(given)}, {json.dumps(options)});
        for (const table of found.tables || [found])
            for (const name in table.columns) table.columns[name] = [...table.columns[name]];
        helper.worker.terminate(); return found; }})()""")


def state(page):
    return page.evaluate("lab.state")


# --- the same numbers as the command ------------------------------------------------------------------------------

def same_numbers(page):
    worst, farthest = 0, 0
    for orbit in ORBITS:
        k, J, n, omega = orbit
        given = {"reduced": {"k": k, "J": J}, "initial": {"normal": n, "angular_velocity": omega},
                 "time": {"end": 100, "step": 5}, "output": {"as": "both"}}
        write("orbit.yaml", scene(orbit, "output: {as: both}\n"))
        for backend, names in (("ball", ("t", "tau", "s", "omega", "n")), ("point", ("M", "gamma"))):
            run("run", "orbit.yaml", "--backend", backend, "-o", "orbit.csv", stderr=subprocess.DEVNULL)
            rows, found = table("orbit.csv"), ask(page, "run", {**given, "effects": {"attitude": {}}}, {})["tables"][0]["columns"]
            for i, row in enumerate(rows):
                for name in names:
                    columns = [name] if name in row else [name + j for j in "123"]
                    size = max(1, max(abs(row[c]) for c in columns))
                    worst = max(worst, max(abs(row[c] - found[c][i]) for c in columns) / size)
            check(f"{backend}, k = {k}: all rows", len(rows) == len(found["t"]) == 21)
        run("section", "orbit.yaml", "--model", "point", "--crossings", "10", "-o", "section.csv", stderr=subprocess.DEVNULL)
        rows = table("section.csv")
        found = ask(page, "section", given, {"crossings": 10, "model": "point"})["columns"]
        check(f"k = {k}: ten crossings", len(rows) == len(found["l"]) == 10)
        farthest = max([farthest] + [abs(row[c] - found[c][i]) for i, row in enumerate(rows) for c in "lx"])
    check(f"states until t = 100 are the command's: {worst:.1e}", worst < STATE)
    check(f"ten crossings are the command's: {farthest:.1e}", farthest < CROSSING)


# --- every control ------------------------------------------------------------------------------------------------

def slide(page, k):
    page.evaluate(f"(() => {{ const s = document.getElementById('lab-k'); s.value = {k}; "
                  "s.dispatchEvent(new Event('input')); })()")


def controls(page):
    settled(page)
    check("a scene of its own: chaotic", text(page, "lab-words").startswith("Verdict: chaotic"), text(page, "lab-words"))
    check("the section is filled", page.evaluate("chart.dots.length") > 8000)
    check("chaotic orbits are grey in it, others are not", shades(page) >= {"grey", "colour"} and page.evaluate(
        "chart.dots.every((dot) => !dot.orbit || dot.shade)"), shades(page))
    page.evaluate("void (lab.DRAWS = 1, judge.SHARES = [24])")  # enough for what follows
    for given, k, words in ((-1.02, -1, "rolls around a sphere"), (0.49, 0.5, "outside of a sphere"),
                            (1.01, 1, "rolls on a plane"), (2, 2, "inside a sphere"), (-0.02, -0.1, "around"),
                            (0.03, 0.1, "outside")):
        slide(page, k if k == 2 else given)
        settled(page)
        check(f"k = {given} becomes {k}", state(page)["k"] == k, str(state(page)))
        check(f"k = {k}: the page says so", words in text(page, "left-words"), text(page, "left-words"))
        check(f"k = {k}: the section is filled", page.evaluate("chart.dots.length") > 900)
        if k in (-1, 1):
            check(f"k = {k}: regular", "regular" in text(page, "lab-words"), text(page, "lab-words"))
            check(f"k = {k}: no orbit is grey", "grey" not in shades(page), shades(page))
    slide(page, 0.5)
    settled(page)

    x, y, width, height = box(page, "lab-section")
    before, count = state(page), page.evaluate("lab.pending")
    page.click(x + 0.6 * width, y + 0.3 * height)
    page.wait("lab.pending > " + str(count))
    settled(page)
    after = state(page)
    check("a click in the section starts there, on the section",
          min(abs(v) for v in after["n"]) < 1e-12 and after["omega"] != before["omega"], str(after))
    own = page.evaluate("chart.dots.filter((dot) => dot.orbit === 0).length")
    check("its own crossings are shown", own == 200, str(own))

    keys_move_sliders(page)

    x, y, width, height = box(page, "lab-J")
    page.click(x + 0.5 * width, y + 0.6 * height)
    settled(page)
    J = state(page)["J"]
    check("J keeps its sum", abs(sum(J) - 8) < 4e-3 and J != [1, 2, 5] and J[0] == J[1], str(J))
    page.evaluate("document.getElementById('lab-J').focus()")
    page.key("ArrowRight")
    settled(page)
    check("an arrow key moves J", state(page)["J"] != J)

    before = state(page)
    page.evaluate("document.getElementById('lab-throw').click()")
    x, y, width, height = box(page, "ball")
    page.drag(x + 0.4 * width, y + 0.5 * height, 120, -20)
    settled(page)
    after = state(page)
    check("a thrown ball has another spin, and no twist", after["omega"] != before["omega"] and
          abs(sum(a * b for a, b in zip(after["omega"], after["n"]))) < 1e-9, str(after))
    page.evaluate("document.getElementById('ball').focus()")
    page.key("ArrowUp")
    settled(page)
    check("an arrow key throws it", state(page)["omega"] != after["omega"])
    page.evaluate("isoroll.play(false)")
    page.evaluate("address.write()")  # what it does by itself when nothing has moved for a while
    address, shown = page.evaluate("location.hash"), state(page)
    page.evaluate("document.getElementById('lab-begin').click()")
    settled(page)
    check("Begin anew: the first state", state(page)["k"] == 0.5 and state(page)["J"] == [1, 2, 5], str(state(page)))
    return address, shown


def shades(page):
    """Of the section's orbits but the page's own."""
    return set(page.evaluate("[...new Set(chart.dots.filter((dot) => dot.orbit).map((dot) => dot.shade))]"))


def keys_move_sliders(page):
    """A slider that has the focus takes the keys."""
    for name, key, found in (("lab-k", "ArrowRight", ("k", 0.55)), ("lab-k", "ArrowLeft", ("k", 0.5)),
                             ("lab-level", "ArrowRight", ("level", 0.05)), ("lab-K1", "ArrowLeft", ("rotor", [-0.1, 0, 0])),
                             ("lab-K1", "ArrowRight", ("rotor", [0, 0, 0])), ("lab-level", "ArrowLeft", ("level", 0)),
                             ("lab-weight", "ArrowRight", ("weight", 0.05)), ("lab-weight", "Home", ("weight", 0))):
        page.evaluate(f"document.getElementById('{name}').focus()")
        page.key(key)
        page.wait("lab.filled === lab.pending")
        check(f"{key} moves {name}", state(page)[found[0]] == found[1], str(state(page)))
    slide(page, 0.1)
    page.evaluate("document.getElementById('lab-k').focus()")
    page.key("ArrowLeft")
    settled(page)
    check("a key steps over k = 0", state(page)["k"] == -0.1, str(state(page)))
    slide(page, 0.5)
    settled(page)


def address_opens(browser, address, shown):
    page = browser.open(os.path.join(work, "lab.html"), fragment=address, media=still)
    page.wait("lab.pending === 1 && lab.filled === 1")
    found = state(page)
    check("the address opens the same state", found["k"] == shown["k"] and all(
        abs(a - b) < 1e-11 for name in ("J", "n", "omega") for a, b in zip(found[name], shown[name])),
        f"{found} {shown}")
    quiet(page, "from the address")
    page.close()


def put(page, name, value):
    page.evaluate(f"(() => {{ const s = document.getElementById('{name}'); s.value = {value}; "
                  "s.dispatchEvent(new Event('input')); })()")
    settled(page)


def worst_of(page, effects, columns):
    """The orbit of the page against `isoroll run` of the same scene."""
    shown = page.evaluate("lab.scene()")
    write("forces.yaml", json.dumps({**shown, "output": {"as": "both" if "M1" in columns else "ball"}}))
    run("run", "forces.yaml", "--backend", "ball", "-o", "forces.csv", stderr=subprocess.DEVNULL)
    rows = table("forces.csv")
    check(f"{effects}: they are in the scene", set(shown["effects"]) == {"attitude", *effects}, str(shown["effects"]))
    found = page.evaluate("({t: [...controls.orbit.t], " + ", ".join(
        f"{c}: [...controls.orbit.column('{c}')]" for c in columns) + "})")
    check(f"{effects}: all rows", len(rows) == len(found["t"]))
    return max(abs(row[c] - found[c][i]) / max(1, abs(row[c])) for i, row in enumerate(rows[:400]) for c in columns)


def forces(page):
    page.evaluate("lab.change({k: 0.5, J: [1, 1.1, 1.2], n: [0.36, 0.48, 0.8], omega: [0.9, -0.3, -0.225]})")
    put(page, "lab-level", 0.4)
    c = page.evaluate("lab.scene().effects.level.c")
    H = c * 1 * 1.1 * 1.2 / 0.25
    check("the level H is shown", abs(float(text(page, "lab-level-words").split()[0]) - H) < 1e-3 * H, text(page, "lab-level-words"))
    M, gamma = (page.evaluate(f"controls.orbit.{name}[0]") for name in ("M", "gamma"))
    check("it is this part of the point's energy", abs(0.4 * sum(v * v for v in M) / 2 - H) < 1e-12 * H)
    put(page, "lab-K2", 0.3)
    check("the rotor has this momentum", page.evaluate("lab.scene().effects.rotor.momentum") == [0, 0.3, 0])
    names = [name + j for name in ("n", "omega") for j in "123"]
    gap = worst_of(page, ["level", "rotor"], names + ["M1", "gamma2"])
    check(f"level and rotor: the rows of the command: {gap:.1e}", gap < 1e-10)
    check("the section is filled", page.evaluate("chart.dots.length") > 700)
    put(page, "lab-level", 0.02)
    put(page, "lab-K2", 0.01)
    check("small remainders are none", page.evaluate("lab.state.level === 0 && lab.state.rotor[1] === 0"))
    page.evaluate("lab.change({k: 2})")
    put(page, "lab-weight", 1)
    gap = worst_of(page, ["gravity"], names)
    check(f"weight: the rows of the command: {gap:.1e}", gap < 1e-10)
    check("no point under gravity: the page says so, and shows the ball alone",
          "breaks the isomorphism" in text(page, "left-words") and box(page, "right")[2] == 0, text(page, "left-words"))
    check("its own crossings alone", page.evaluate("chart.dots.length") == 200)
    address = page.evaluate("'#' + lab.address().join('&')")
    check("the address has the weight", "weight=1" in address, address)
    put(page, "lab-weight", 0)
    check("the point is there again", box(page, "right")[2] > 100 and page.evaluate("controls.pictures.length") == 2)


def twin_and_judge(page):
    """The twin begins 1e-6 away, also after a change, and does what the exponent says."""
    page.evaluate("void (judge.SHARES = [216])")
    page.evaluate("lab.change({k: 0.5, J: [1, 2, 5], n: [0.36, 0.48, 0.8], omega: [0.9, -0.3, -0.225]})")
    settled(page)
    near = page.evaluate("[...controls.orbit.near]")
    check("the twin begins 1e-6 away", abs(near[0] - 1e-6) < 1e-12, str(near[0]))
    page.evaluate("void (controls.beside || document.getElementById('beside').click())")
    page.frame()
    check("its distance is drawn", box(page, "growth")[3] > 80 and "factor e" in text(page, "beside-words"),
          text(page, "beside-words"))
    page.wait("lab.shared === lab.pending")
    told, words = page.evaluate("judge.told"), text(page, "lab-words")
    write("judged.yaml", scene((0.5, [1, 2, 5], [0.36, 0.48, 0.8], [0.9, -0.3, -0.225])))
    run("chaos", "judged.yaml", "--starts", "216", "--turns", "1000", "--model", "point", "--json",
        stdout=open(os.path.join(work, "judged.json"), "w"))
    share = json.load(open(os.path.join(work, "judged.json")))["share"]
    low, high = (float(told["share"]["share." + name]) for name in ("low", "high"))
    check("the chaotic share is the command's", max(low, share["low"]) < min(high, share["high"]) and
          float(told["share"]["share.followed"]) == 216, f"{low} {high} {share}")
    check("exponent and share are told", "Exponent: 0.0" in words and "95 % confidence (216 orbits)" in words, words)
    growth = math.log(max(near) / near[0]) / (told["exponent"] * page.evaluate("controls.range()[1]"))
    check("the twin leaves as the exponent says", 0.5 < growth < 2, str(growth))
    check("the exponent has its error", 0.05 < told["exponent"] < 0.09 and told["error"] > 0, str(told["exponent"]))
    page.evaluate("void (judge.SHARES = [24])")
    slide(page, -1)
    page.wait("lab.shared === lab.pending")
    check("a regular orbit has a frequency ratio", "Frequency ratio: 1.2342377" in text(page, "lab-words") and
          max(page.evaluate("[...controls.orbit.near]")) < 1e-3, text(page, "lab-words"))


def tale(page):
    """The story: each step drives the controls, and it can be left."""
    page.evaluate("document.getElementById('story-begin').click()")
    for step, (k, J, compared, clock) in enumerate([(1, 1.2, False, "t"), (1, 1.2, True, "t"), (1, 2, True, "t"),
                                                    (1, 2, False, "s"), (0.5, 2, False, "t")]):
        settled(page)
        page.wait(f"controls.compared === {str(compared).lower()} && isoroll.clock() === '{clock}'")
        found = state(page)
        check(f"step {step + 1} of the story", found["k"] == k and found["J"][1] == J and
              text(page, "story-words").startswith(f"{step + 1} of 5. "), f"{found} {text(page, 'story-words')}")
        if step == 3:  # what follows later is called here, not by a clock: this machine may be busy
            page.evaluate("void (story.later = (seconds, act) => story.timers.push(act))")
        if step < 4:
            page.evaluate("document.getElementById('story-next').click()")
    for i, k in enumerate((1, -1)):
        page.evaluate(f"void story.timers[{i}]()")
        settled(page)
        check(f"it goes on by itself to k = {k}", state(page)["k"] == k and page.evaluate("story.timers.length") == 2)
    page.evaluate("document.getElementById('story-leave').click()")
    check("it can be left", text(page, "story-words") == "" and box(page, "story-next")[2] == 0 and
          page.evaluate("story.timers.length") == 0 and state(page)["k"] == -1)


def taken(page):
    """What the page gives away works in the command."""
    page.evaluate("void lab.change({k: 0.5, J: [1, 1.1, 1.2], level: 0.4, rotor: [0, 0.3, 0]})")
    settled(page)
    folder = os.path.join(work, "taken")
    page.call("Page.setDownloadBehavior", behavior="allow", downloadPath=folder)
    page.evaluate("document.getElementById('lab-scene').click()")
    path, patience = os.path.join(folder, "scene.yaml"), time.monotonic() + 60
    while not os.path.exists(path) and time.monotonic() < patience:
        time.sleep(0.05)
    check("scene.yaml is saved", os.path.exists(path))
    write("scene.yaml", open(path).read())
    page.evaluate("document.getElementById('lab-command').click()")
    lines = text(page, "lab-commands").splitlines()
    run(*lines[0].split()[1:], stderr=subprocess.DEVNULL)
    rows = table("orbit.csv")
    gap = max(abs(row[c] - page.evaluate(f"controls.orbit.column('{c}')[{i}]")) for i, row in ((0, rows[0]), (300, rows[300]))
              for c in ("omega1", "n2", "M3"))
    check(f"the command for the orbit gives its rows: {gap:.1e}", len(rows) == 1201 and gap < 1e-10)
    words = [line.split()[1:] for line in lines[1:]]
    for command in words:  # fewer orbits, for a short test
        at = command.index("--starts") + 1
        command[at] = "2"
        run(*command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    check("and those for section and share work", [w[0] for w in words] == ["section", "chaos"])
    page.evaluate("document.getElementById('lab-link').click()")
    page.wait("document.getElementById('lab-taken').textContent.includes('Link')")
    check("a film is recorded", page.evaluate("""(document.getElementById('lab-film').click(),
        Boolean(film.recorder) && controls.playing)"""))  # at once: the film may end before a busy machine draws
    page.frame()
    page.evaluate("film.ended()")  # before its ten seconds are over
    page.wait("document.getElementById('lab-taken').textContent === 'The film is saved.'")


# --- it refuses, goes on, and stays quick ---------------------------------------------------------------------------

def refusals(page):
    page.evaluate("lab.change({k: 0})")
    settled(page)
    check("what cannot be is refused in the library's words", "The library refuses: k = 0: " in text(page, "lab-words"),
          text(page, "lab-words"))
    page.evaluate("lab.change({k: 0.5, J: [2, 2, 2], level: 0, rotor: [0, 0, 0]})")
    settled(page)
    check("equal moments: an orbit", page.evaluate("controls.orbit.count") == 1201)
    page.evaluate("lab.change({J: [1, 2, 5]})")
    settled(page)
    check("and it goes on", "Verdict" in text(page, "lab-words"), text(page, "lab-words"))


def play(page):
    """Random actions, none of which waits for what the last one asked for."""
    random.seed(36)
    for _ in range(100):
        kind = random.randrange(7)
        if kind == 0:
            slide(page, random.uniform(-3, 3))
        elif kind == 1:
            page.evaluate(f"triangle.move(triangle.parts([{random.uniform(0, 300)}, {random.uniform(0, 110)}]))")
        elif kind == 2:
            page.evaluate(f"void lab.throwBall({random.uniform(-200, 200)}, {random.uniform(-200, 200)})")
        elif kind == 3:
            page.evaluate(f"void lab.startAt({random.uniform(-3, 3)}, {random.uniform(-0.9, 0.9)})")
        elif kind == 4:
            page.evaluate(f"void lab.change({{level: {random.uniform(-1, 1)}, rotor: [0, {random.uniform(-2, 2)}, 1], "
                          f"weight: {random.choice((0, 0, 1))}}})")
        elif kind == 5:
            page.key(random.choice([" ", "1", "2", "3", "End", "Home", "ArrowRight"]))
        else:
            time.sleep(random.uniform(0, 0.2))
    begun = time.monotonic()
    page.frame()
    check("the page is not frozen", time.monotonic() - begun < 60)
    settled(page)
    bad = page.evaluate("Object.values(controls.now).flat().filter((v) => !Number.isFinite(v)).length")
    check("after random play every number is finite", bad == 0, str(bad))
    quiet(page, "random play")


def drawn(page, name):
    """The part of a picture that has any colour."""
    return page.evaluate(f"""(() => {{ const c = document.getElementById('{name}');
        const all = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
        return all.filter((v, i) => i % 4 === 3 && v > 0).length / (c.width * c.height); }})()""")


def image(page, name):
    return page.evaluate(f"document.getElementById('{name}').toDataURL()")


def small(browser):
    page = browser.open(os.path.join(work, "lab.html"), 390, 844, media=still + (("prefers-color-scheme", "dark"),))
    settled(page)
    check("390 pixels: nothing sticks out", page.evaluate("document.documentElement.scrollWidth") <= 390)
    check("390 pixels: the section is seen", box(page, "lab-section")[2] > 300)
    quiet(page, "390 pixels, dark")
    page.close()


run("view", "--live", "-o", "lab.html")
check("the page is below 2.5 MB", os.path.getsize(os.path.join(work, "lab.html")) < 2.5e6)
with chromium.Browser() as browser:
    page = browser.open(os.path.join(work, "lab.html"), height=1400, media=still)
    settled(page)
    same_numbers(page)
    address, shown = controls(page)
    forces(page)
    twin_and_judge(page)
    tale(page)
    taken(page)
    refusals(page)
    play(page)
    page.close()
    address_opens(browser, address, shown)
    small(browser)
with chromium.Browser("--disable-3d-apis") as browser:
    page = browser.open(os.path.join(work, "lab.html"), media=still)
    settled(page)
    check("without WebGL: words, and the section", page.evaluate("chart.dots.length") > 8000 and
          "no WebGL" in text(page, "trouble"), text(page, "trouble"))
    check("without WebGL: flat pictures", all(drawn(page, name) > 0.03 for name in ("ball", "point")))
    before = image(page, "ball")
    page.evaluate("isoroll.seek(3)")
    page.frame()
    check("they move", image(page, "ball") != before)
    slide(page, 2)
    settled(page)
    check("without WebGL k can be turned", state(page)["k"] == 2)
    quiet(page, "without WebGL")
print("PASS the end")
