"""handbook.py ISOROLL SOURCE WORK - reads the pages of the manual WORK/one, made of WORK/sources: links, identifiers,
formulas, names; in Chromium, if it is there, how wide pages are. handbook.sh runs it."""
import ast
import re
import sys
from html.parser import HTMLParser
from pathlib import Path

import chromium

manual, sources = Path(sys.argv[3]) / "one", Path(sys.argv[3]) / "sources"


def check(words, good, detail=""):
    print("PASS" if good else "FAIL", words, detail if not good else "", flush=True)


class Read(HTMLParser):
    """What is checked of a page: identifiers, addresses, formulas, the text that is no code."""
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.loaded, self.text, self.formulas, self.code = [], [], [], "", 0, 0
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids += [given["id"]] if "id" in given else []
        self.links += [given["href"]] if tag == "a" and "href" in given else []
        self.loaded += [given[name] for name in ("src", "srcset", "data", "poster") if name in given]
        self.loaded += [given["href"]] if tag == "link" else []
        self.formulas += tag == "math"
        self.code += tag in ("code", "pre", "annotation", "script")

    def handle_endtag(self, tag):
        self.code -= tag in ("code", "pre", "annotation", "script")

    def handle_data(self, data):
        self.text += "" if self.code else data


pages = {path.name: Read(path) for path in manual.glob("*.html")}
check("there are pages", len(pages) > 50, len(pages))
for name, page in pages.items():
    check(f"{name}: each identifier once", len(set(page.ids)) == len(page.ids),
          [i for i in page.ids if page.ids.count(i) > 1][:3])
    lost = []
    for link in page.links + page.loaded:
        if re.match("https?:|mailto:", link):
            continue
        file, _, section = link.partition("#")
        there = (manual / file).is_file() if file else True
        if not there or section and section not in pages[file or name].ids:
            lost.append(link)
    check(f"{name}: links lead somewhere", not lost, lost[:3])
    check(f"{name}: nothing is loaded from elsewhere", not [x for x in page.loaded if ":" in x or x.startswith("//")])
    left = [part for part in re.findall(r".{0,20}\$.{0,20}", page.text) if "costs $5" not in part]
    check(f"{name}: no formula is left as text", not left, left[:3])
check("formulas are MathML", pages["extra.html"].formulas == 6, pages["extra.html"].formulas)
check("formulas are MathML on the whole page", pages["whole.html"].formulas == sum(
    page.formulas for name, page in pages.items() if name != "whole.html"))
check("a citation leads to the references", "references.html#ref-tested" in pages["extra.html"].links)
check("a link to a section of another document", "theory.html#theory.3-the-map" in pages["extra.html"].links)

# --- all documents, commands and calls
folders = ("", "lib", "apps", "apps/python", "examples", "tests")
documents = [*sources.glob("lib/doc/*.md"), *(sources / folder / "README.md" for folder in folders)]
for path in documents:
    title = path.read_text("utf-8").split("\n")[0].lstrip("# ").replace("`", "")
    check(f"a page has the title '{title}'", any(title in re.sub(r"\s+", " ", page.text) for page in pages.values()))
for path in sources.glob("apps/isoroll/cmd_*.c"):
    check(f"a page of {path.stem}", f"isoroll-{path.stem[4:]}.html" in pages)
named = {name.partition(".")[2] for page in pages.values() for name in page.ids}
declared = set()
for path in sources.glob("lib/**/*.h"):
    if not path.name.endswith("_impl.h"):
        declared |= set(re.findall(r"^ISO_API [^;]*?\b(iso_\w+)\(", path.read_text("utf-8"), re.M))
check("there are calls of C", len(declared) > 80, len(declared))
check("all calls of C", not declared - named, sorted(declared - named)[:5])
offered = re.search(r"__all__ = (\[.*?\])", (sources / "apps/python/isoroll/__init__.py").read_text("utf-8"), re.S)[1]
offered = set(ast.literal_eval(offered)) - {"library_version"}  # which is no call
check("all calls of Python", not offered - named, sorted(offered - named))

# --- in a browser: no page is wider than a telephone; the search works without a network
if chromium.find():
    with chromium.Browser() as browser:
        for name in ("index", "start", "extra", "theory", "formats", "apps", "lists", "isoroll-chaos", "c-api",
                     "python-calls", "names"):
            page = browser.open(str(manual / f"{name}.html"), width=390, height=800)
            width = page.evaluate("document.documentElement.scrollWidth")
            check(f"{name}: fits 390 pixels", width <= 390, width)
            check(f"{name}: no message", not page.messages(), page.messages()[:1])
            check(f"{name}: all requests are files", all(url.startswith("file:") for url in page.requests()))
            if name == "index":
                page.evaluate("document.getElementById('query').focus()")
                for key in "level.c":
                    page.key(key)
                page.wait("document.getElementById('query').value === 'level.c'")
                found = page.evaluate("[...document.querySelectorAll('#found a')].map(a => a.getAttribute('href'))")
                check("the search shows where level.c is", "formats.html#formats.effects" in found, found)
            page.close()
check("the end", True)
