"""laboratory.py ISOROLL [MINUTES] - how fast the page of `isoroll view --live` is in a Chromium, and what memory it takes
in so many minutes of play (2). By hand, as all measurements of time."""
import os
import random
import sys
import tempfile
import time

here = os.path.dirname(os.path.abspath(__file__))
minutes = int(sys.argv.pop(2)) if len(sys.argv) > 2 else 2
sys.argv += [os.path.dirname(os.path.dirname(here)), tempfile.mkdtemp()]
sys.path.insert(0, os.path.join(os.path.dirname(here), "cli"))
import chromium  # noqa: E402
from view_tools import run, work  # noqa: E402

CROSSINGS = """(async () => {
    const helpers = Array.from({ length: %d }, () => new Helper()), scene = lab.scene(),
        all = (starts, crossings) => Promise.all(helpers.map((one, seed) =>
            one.ask("section", scene, { model: "point", starts, crossings, seed })));
    await all(1, 1); // the library is ready
    const begun = performance.now();
    await all(80 / helpers.length, 500);
    helpers.forEach((one) => one.worker.terminate());
    return performance.now() - begun; })()"""
PICTURES = """new Promise((tell) => {
    const drawn = controls.drawn;
    setTimeout(() => tell((controls.drawn - drawn) / 10), 10000); })"""


def memory(page):
    page.call("HeapProfiler.collectGarbage")
    page.call("Performance.enable")
    found = {one["name"]: one["value"] for one in page.call("Performance.getMetrics")["metrics"]}
    return f"{found['JSHeapUsedSize'] / 1e6:.1f} MB, {found['Nodes']:.0f} nodes, {page.evaluate('controls.drawn')} pictures"


run("view", "--live", "-o", "lab.html")
print(f"size of the page: {os.path.getsize(os.path.join(work, 'lab.html')) / 1e6:.2f} MB")
with chromium.Browser() as browser:
    page = browser.open(os.path.join(work, "lab.html"))
    page.wait("lab.shared === lab.pending")
    print(f"first picture after {page.evaluate('performance.getEntriesByType(`paint`)[0].startTime'):.0f} ms")
    page.evaluate("isoroll.play(true)")
    page.evaluate(PICTURES)  # meanwhile the page chooses how many pixels it draws
    page.evaluate("isoroll.play(true)")
    print(f"pictures a second: {page.evaluate(PICTURES):.1f}")
    page.evaluate("isoroll.play(false)")
    for workers in (1, 2):
        best = min(page.evaluate(CROSSINGS % workers) for _ in range(3))
        print(f"80 orbits, 500 crossings each, {workers} Worker(s): {best:.0f} ms")
    for minute in range(minutes + 1):
        print(f"after {minute} minutes: {memory(page)}", flush=True)
        for _ in range(6 if minute < minutes else 0):
            page.evaluate(f"void lab.change({{k: {random.choice((0.5, -1, 2, 1, -0.4))}}})")
            time.sleep(10)
            page.evaluate("isoroll.play(true)")
    print("messages of the console:", page.messages() or "none")
