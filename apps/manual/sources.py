"""What the manual is made of: its chapters, and the pages of each."""

import re
import subprocess
from dataclasses import dataclass, field

from calls import page_of_python, pages_of_c
from tree import MARKDOWN, attributes, change, code_block, header, node, read, text_of

BIBLIOGRAPHY = "lib/doc/references.bib"

# Markdown by its path in the sources, and pages that are made. A pattern takes what stands nowhere else and begins with
# a title.
CHAPTERS = {
    "Start": ["README.md", "examples/README.md", "examples/*.md", "examples/*/*.md"],
    "The command": ["apps/README.md", "lib/doc/formats.md", "list", "man"],
    "Mathematics": ["lib/doc/theory.md", "lib/doc/rotor.md", "lib/doc/why_only_one.md", "lib/doc/prove.md",
                    "lib/doc/certify.md"],
    "Computing": ["lib/doc/methods.md", "lib/doc/performance.md", "lib/doc/measured.md", "lib/doc/clusters.md"],
    "The library": ["lib/README.md", "c"],
    "Python": ["apps/python/README.md", "python"],
    "More": ["lib/doc/*.md", "tests/README.md", "tests/extend/README.md", "lib/doc/changelog.md", "references"],
}


@dataclass
class Section:
    level: int
    name: str   # its identifier
    title: str
    text: str = ""
    terms: list = field(default_factory=list)  # names that it explains, see index.py


@dataclass
class Page:
    name: str    # of its file, and of its identifiers: name.section
    title: str
    blocks: list
    source: str = ""  # the path of its Markdown
    sections: list = field(default_factory=list)


def markdown(source, document):
    """A document. Its first line is its title."""
    path = source / document
    name = path.stem if path.stem != "README" else path.relative_to(source).parent.name or "start"
    title, *blocks = read(path.read_text("utf-8"), MARKDOWN)["blocks"]
    return Page(name, text_of(title["c"][2]), blocks, document)


def man_page(path, names):
    """A man page of the command. The names of others become links."""
    def see(tree):
        name = text_of(tree) if tree["t"] == "Strong" else ""
        return node("Link", attributes(), [tree], ["#" + name, ""]) if name in names else tree

    def lower(tree):
        if tree["t"] != "Header":
            return tree
        return header(3, "", [node("Str", text_of(tree["c"][2]).capitalize())])

    blocks = read(path.read_text("utf-8"), "man")["blocks"]
    return Page(path.stem, path.stem.replace("-", " "), change(blocks, lambda tree: see(lower(tree))))


def lists(isoroll):
    """What `isoroll list` prints: a section for each topic."""
    blocks = []
    text = subprocess.run([isoroll, "list"], env={}, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout
    for topic in text.strip().split("\n\n"):
        name, about, lines = re.match(r"(.*?): (.*?)\n(.*)", topic, re.S).groups()
        about = node("Para", [node("Str", about[:1].upper() + about[1:])])
        blocks += [header(2, "", [node("Str", name)]), about, code_block(lines, "text")]
    return Page("lists", "What isoroll list prints", blocks)


def references():
    return Page("references", "References", [node("Div", attributes("refs"), [])])


def chapters(source, man, isoroll):
    """The pages of each chapter."""
    taken = {document for documents in CHAPTERS.values() for document in documents}
    manuals = sorted(man.glob("**/*.1"), key=lambda path: path.stem)
    made = {
        "man": lambda: [man_page(path, {path.stem for path in manuals}) for path in manuals],
        "list": lambda: [lists(isoroll)],
        "c": lambda: [Page(*page) for page in pages_of_c(source / "lib")],
        "python": lambda: [Page(*page_of_python("python-calls", source / "apps/python/isoroll"))],
        "references": lambda: [references()] if (source / BIBLIOGRAPHY).exists() else [],
    }

    def pages_of(document):
        if document in made:
            return made[document]()
        found = sorted(path.relative_to(source).as_posix() for path in source.glob(document))
        if "*" in document:
            found = [path for path in found if path not in taken and (source / path).read_text("utf-8").startswith("# ")]
        return [markdown(source, path) for path in found]

    return {chapter: [page for document in documents for page in pages_of(document)]
            for chapter, documents in CHAPTERS.items()}
