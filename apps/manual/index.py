"""The index: all names that the manual explains, by the alphabet."""

import re
from html import escape

from tree import change, text_of


def terms_of(block):
    """The names that stand as code at the left of a table, in a list of definitions, or in a heading."""
    found = []

    def look(tree):
        content = tree.get("c")
        if tree["t"] == "Table":
            firsts = [row[1][0][4] for body in content[4] for row in body[3]]
            found.extend(text_of(inline) for cell in firsts for part in cell for inline in part["c"]
                         if inline["t"] == "Code")
        if tree["t"] == "DefinitionList":
            found.extend(text_of(inline) for term, _ in content for inline in term
                         if inline["t"] in ("Code", "Strong"))
        if block["t"] == "Header" and tree["t"] == "Code":
            found.append(content[1])
        return tree

    change(block, look)
    return [term.strip() for term in found if re.match(r"[-/.]*[A-Za-z]", term)]


def index_of(pages):
    """The page."""
    places = {}
    for page in pages:
        for section in page.sections:
            for term in section.terms:
                places.setdefault(term, {}).setdefault(page.title, section.name)
    lines, letter = [], ""
    for term in sorted(places, key=lambda term: (term.lstrip("-/.").lower(), term)):
        if term.lstrip("-/.")[0].upper() != letter:
            letter = term.lstrip("-/.")[0].upper()
            lines.append(f"</ul>\n<h2>{letter}</h2>\n<ul>")
        links = ", ".join(f'<a href="#{section}">{escape(title)}</a>' for title, section in places[term].items())
        lines.append(f"<li><code>{escape(term)}</code> {links}</li>")
    return '<h1>Index</h1>\n<div class="index"><ul>' + "\n".join(lines) + "</ul></div>"
