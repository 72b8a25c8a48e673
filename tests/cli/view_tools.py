"""view_tools.py - what the tests of pages share. A script is called as SCRIPT ISOROLL SOURCE WORK, and prints a line
"PASS words" or "FAIL words" for each check."""
import os
import subprocess
import sys

isoroll, source, work = sys.argv[1:]
still = (("prefers-reduced-motion", "reduce"),)


def check(words, good, detail=""):
    print("PASS" if good else "FAIL", words, "" if good else detail, flush=True)


def run(*arguments, **more):
    subprocess.run([isoroll, *arguments], check=True, cwd=work, **more)


def table(path):
    """The rows of a file as dictionaries."""
    lines = [line.rstrip("\n").split(",") for line in open(os.path.join(work, path)) if not line.startswith("#")]
    return [dict(zip(lines[0], map(float, row))) for row in lines[1:]]


def write(name, text):
    with open(os.path.join(work, name), "w") as file:
        file.write(text)


def quiet(page, words):
    check(words + ": no message of the console", not page.messages(), str(page.messages())[:600])
    others = [url for url in page.requests() if not url.startswith("file://") and url != "data:,"]
    check(words + ": no request but the page's", not others, str(others)[:300])


def box(page, name):
    """Place and size of an element: x, y, width, height."""
    return page.evaluate(f"""(() => {{ const b = document.getElementById('{name}').getBoundingClientRect();
        return [b.x, b.y, b.width, b.height]; }})()""")


def text(page, name):
    """The words of an element."""
    return page.evaluate(f"document.getElementById('{name}').textContent")
