"""Builds the manual: a page of HTML for each document, an index, a search, and all on one page for the PDF.

    python3 build.py SOURCE MAN ISOROLL VERSION OUTPUT [CHROMIUM]

MAN is the folder of the man pages, ISOROLL the command. pandoc reads and writes; formulas become MathML.
CHROMIUM prints the PDF. The same sources give the same bytes.
"""

import json
import posixpath
import re
import shutil
import string
import sys
from html import escape
from pathlib import Path

from index import index_of, terms_of
from pdf import print_pdf
from sources import BIBLIOGRAPHY, Section, chapters
from tree import attributes, change, header, node, pandoc, read, text_of

HERE = Path(__file__).resolve().parent
PICTURES = (".svg", ".png")
NUMBER = re.compile(r"\s*(?:\\tag\{([^{}]*)\}|\\qquad\s*\((\d+\w*)\))\s*$")  # of a formula
DOTS = {"\u0307": "\u02d9", "\u0308": "\u00a8"}  # over letters; browsers draw the combining ones beside them
ADDRESS = re.compile(r"[a-z]+:")  # not of a file of the project


# --- links, identifiers, sections ------------------------------------------------------------------------------------

def copied(path, source, output):
    """The address of a file of the project, which is copied into the manual: as NAME.txt, which browsers show."""
    place = Path("files", path if path.endswith(PICTURES) else path.lstrip(".") + ".txt")
    (output / place).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source / path, output / place)
    return place.as_posix()


def follow(target, page, by_source, source, output):
    """A link of a page as one of the manual. None: it leads to a folder, which the manual does not have."""
    path, _, section = target.partition("#")
    if ADDRESS.match(target) or not page.source:
        return target
    path = posixpath.normpath(posixpath.join(posixpath.dirname(page.source), path)) if path else page.source
    if path in by_source:
        return "#" + by_source[path] + ("." + section if section else "")
    if not (source / path).exists():
        sys.exit(f"{page.source}: there is no file {target}")
    return copied(path, source, output) if (source / path).is_file() else None


def arranged(formula):
    """A formula of its own, in parts that can stand below each other where the page is narrow: they end at \\qquad.
    Its number, \\tag{24} or \\qquad (24) at its end, stands beside it. MathML has neither."""
    text, number = formula["c"][1].strip(), NUMBER.search(formula["c"][1])
    if number:
        text = NUMBER.sub("", text)
    text = re.sub(r"\\tag\{(.*?)\}", r"\\qquad (\1)", text)  # of a line within
    parts = re.split(r"\s*\\qquad\s*", text)
    if any(part.count("{") != part.count("}") or r"\begin" in part or not part for part in parts):
        parts = [text]
    inside = node("Span", attributes("", "parts"), [node("Math", {"t": "DisplayMath"}, part) for part in parts])
    return node("Span", attributes("", "formula"), [inside, *(
        [node("Span", attributes(), [node("Str", f"({number[1] or number[2]})")])] if number else [])])


def finish(page, to):
    """Gives a page its title, identifiers of its own, and links as to(target) has them. Notes its sections."""
    def finished(tree):
        kind, content = tree["t"], tree.get("c")
        if kind in ("Link", "Image"):
            content[2][0] = to(content[2][0])
            return tree if content[2][0] else node("Span", attributes(), content[1])
        if kind in ("RawInline", "RawBlock"):
            content[1] = re.sub(r'(?<=src=")[^"]*', lambda found: to(found[0]), content[1])
        if kind == "Math" and content[0]["t"] == "DisplayMath":
            return arranged(tree)
        if kind == "Header":
            content[0] = max(content[0], 2)
            name = content[1][0] or re.sub(r"\W+", "-", text_of(content[2]).lower())
            content[1][0] = name if name.startswith(page.name + ".") else f"{page.name}.{name}"
        return tree

    page.blocks = [header(1, page.name, [node("Str", page.title)]), *change(page.blocks, finished)]
    for block in page.blocks:
        if block["t"] == "Header":
            level, (name, _, _), inlines = block["c"]
            page.sections.append(Section(level, name, text_of(inlines)))
        else:
            page.sections[-1].text += text_of(block)
        page.sections[-1].terms += terms_of(block)


# --- pages -----------------------------------------------------------------------------------------------------------

def wide_table(found):
    """A table that can be wider than the page. Its code can break after . _ and /"""
    return '<div class="wide">' + re.sub(r"<code>.*?</code>", lambda code: re.sub(
        r"(?<=\w)[._/](?=\w)", r"\g<0><wbr>", code[0]), found[0]) + "</div>"


def bodies(pages, source):
    """The HTML of each page, by its name."""
    tree = {**read("", "markdown"), "blocks": [block for page in pages for block in page.blocks]}
    bibliography = source / BIBLIOGRAPHY
    cite = ["--citeproc", "-M", f"bibliography={bibliography}", "-M", "link-citations=true"]
    text = pandoc(json.dumps(tree), "-f", "json", "-t", "html5", "--mathml", "--section-divs", "--no-highlight",
                  *(cite if bibliography.exists() else []))
    for combining, alone in DOTS.items():
        text = text.replace(f'<mo accent="true">{combining}</mo>', f'<mo accent="true">{alone}</mo>')
    text = re.sub(r'<math display="block".*?</math>', r'<span class="wide">\g<0></span>', text, flags=re.S)
    text = re.sub(r"<table.*?</table>", wide_table, text, flags=re.S)
    parts = re.split(r'^<section id="([^"]*)" class="level1', text, flags=re.M)
    return {name: f'<section id="{name}" class="level1{part}' for name, part in zip(parts[1::2], parts[2::2])}


def contents(parts, deep):
    """All pages by chapters; deep: with their sections."""
    def item(name, title, more=""):
        return f'<li><a href="#{name}">{escape(title)}</a>{more}</li>\n'

    def inside(page):
        sections = [item(section.name, section.title) for section in page.sections if section.level == 2]
        return f"<ul>{''.join(sections)}</ul>" if deep and sections else ""

    def items(pages):
        return "".join(item(page.name, page.title, inside(page)) for page in pages)

    return "".join(f"<h2>{chapter}</h2>\n<ul>{items(pages)}</ul>\n" for chapter, pages in parts.items())


def build(source, man, isoroll, version, output, chromium):
    output.mkdir(parents=True, exist_ok=True)
    parts = chapters(source, man, isoroll)
    pages = [page for chapter in parts.values() for page in chapter]
    by_source = {page.source: page.name for page in pages if page.source}
    for page in pages:
        finish(page, lambda target, page=page: follow(target, page, by_source, source, output))
    body = bodies(pages, source)
    home = {name: page for page, text in body.items() for name in re.findall(r' id="([^"]*)"', text)}

    def place(name):
        if name not in home:
            sys.exit(f"the manual has no section '{name}'")
        return home[name] + ".html" + ("" if home[name] == name else "#" + name)

    def placed(text):
        return re.sub(r'(?<=href=")#([^"]*)', lambda found: place(found[1]), text)

    def write(file, title, text, template="page.html", **more):
        frame = string.Template((HERE / template).read_text("utf-8"))
        text = frame.substitute(title=escape(title), body=text, version=version, **more)
        (output / file).write_text(text, "utf-8")

    def write_page(file, title, text):
        write(file, title, placed(text), nav=placed(contents(parts, deep=False)))

    for page in pages:
        write_page(page.name + ".html", page.title, body[page.name])
    paper = ' and <a href="isoroll.pdf">as a PDF</a>' if chromium else ""
    title = "The manual of isoroll"
    write_page("index.html", title, f'<div class="home">\n<h1>{title}</h1>\n'
               "<p>The search finds words in all pages; the key / leads to it. The manual is also "
               f'<a href="whole.html">on one page</a>{paper}.</p>\n{contents(parts, deep=True)}</div>')
    write_page("names.html", "Index", index_of(pages))
    whole = re.sub(r'<a\s+href="files/[^"]*">(.*?)</a>', r"\1", "".join(body.values()), flags=re.S)
    write("whole.html", "isoroll", whole, "whole.html", contents=contents(parts, deep=True))

    entries = [[place(section.name), page.title, section.title, " ".join(section.text.split()), section.terms]
               for page in pages for section in page.sections]
    lines = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in entries)
    (output / "entries.js").write_text(f"const entries = [\n{lines}\n];\n", "utf-8")
    for file in ("style.css", "search.js"):
        shutil.copyfile(HERE / file, output / file)
    if chromium:
        print_pdf(chromium, output / "whole.html", output / "isoroll.pdf")


if __name__ == "__main__":
    build(*map(Path, sys.argv[1:4]), sys.argv[4], Path(sys.argv[5]), sys.argv[6] if len(sys.argv) > 6 else "")
