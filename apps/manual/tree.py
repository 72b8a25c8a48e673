"""Documents as pandoc reads them: trees of blocks and inlines."""

import json
import os
import re
import subprocess
import textwrap

PANDOC = os.environ.get("ISO_PANDOC", "pandoc")

# What the Markdown of the project uses: that of a forge, with formulas $...$ and citations [@key].
MARKDOWN = "+".join(("markdown_strict", "pipe_tables", "backtick_code_blocks", "fenced_code_attributes",
                     "tex_math_dollars", "citations", "intraword_underscores", "auto_identifiers",
                     "gfm_auto_identifiers", "space_in_atx_header", "all_symbols_escapable", "autolink_bare_uris"))


def pandoc(text, *options):
    """What pandoc makes of a text. A warning, such as a formula that it cannot read, ends the build."""
    return subprocess.run([PANDOC, "--fail-if-warnings", "--columns=9999", *options], input=text, check=True,
                          stdout=subprocess.PIPE, encoding="utf-8").stdout


def read(text, form):
    """The blocks of a text."""
    return json.loads(pandoc(text, "-f", form, "-t", "json"))


def node(kind, *content):
    return {"t": kind, "c": content[0] if len(content) == 1 else list(content)}


def attributes(name="", *classes):
    return [name, list(classes), []]


def header(level, name, inlines):
    return node("Header", level, attributes(name), inlines)


def code(text):
    return node("Code", attributes(), text)


def code_block(text, language):
    return node("CodeBlock", attributes("", language), text)


def link(inlines, target):
    return node("Link", attributes(), inlines, [target, ""])


def inlines(text, known=()):
    """The words of a comment: `names` in quotes and known names are code, known ones lead to the place that
    known[name] identifies."""
    parts = re.split(r"(`[^`]+`|\b(?:iso|ISO)_\w+)", text)
    return [node("Str", part) if i % 2 == 0 else link([code(part)], "#" + known[part]) if part in known else
            code(part.strip("`")) for i, part in enumerate(parts)]


def text_of(tree):
    """The words of a tree."""
    if isinstance(tree, list):
        return "".join(map(text_of, tree))
    kind, content = tree["t"], tree.get("c")
    if kind in ("Str", "Space", "SoftBreak", "LineBreak"):
        return content or " "
    if kind in ("Code", "CodeBlock", "Math"):
        return content[1] + (" " if kind == "CodeBlock" else "")
    if kind.startswith("Raw"):
        return ""
    if kind == "Table":
        return rows_of(content)
    inside = "".join(text_of(child) for child in inner(content))
    return inside if kind in ("Emph", "Strong", "Link", "Span", "Cite") else f" {inside} "


def rows_of(table):
    """The words of a table. Those of the head stand before each cell, for searches such as "exit status 4"."""
    head = [text_of(cell[4]).strip() for row in table[3][1] for cell in row[1]]
    rows = [row for body in table[4] for row in body[3]]
    return "".join(" ".join(f"{name} {text_of(cell[4])}" for name, cell in zip(head, row[1])) + "; " for row in rows)


def inner(content):
    """The nodes next below."""
    if isinstance(content, dict) and "t" in content:
        yield content
    elif isinstance(content, list):
        for item in content:
            yield from inner(item)


def change(tree, how):
    """Puts how(node) in place of each node, those inside first."""
    if isinstance(tree, list):
        return [change(item, how) for item in tree]
    if not isinstance(tree, dict):
        return tree
    tree = {key: change(value, how) for key, value in tree.items()}
    return how(tree) if "t" in tree else tree


def prose(text, known=()):
    """The blocks of a comment or a docstring: paragraphs, lists, code, and columns NAME  MEANING."""
    blocks = []
    for part in re.split(r"\n[ ]*\n", text.strip("\n")):
        lines = part.split("\n")
        if part.startswith(">>> ") or all(line.startswith("    ") for line in lines):
            blocks.append(code_block(textwrap.dedent(part), "text"))
        elif re.match(r"\w+  +\S", part):
            named = [re.split("  +", item, 1) for item in re.split(r"\n(?=\w+  +\S)", part)]
            blocks.append(node("DefinitionList", [[[code(name)], [[node("Plain", inlines(meaning, known))]]]
                                                  for name, meaning in named]))
        else:
            lead, *items = re.split(r"(?:^|\n)[ ]*- ", part)
            blocks += [node("Para", inlines(lead, known))] if lead else []
            blocks += [node("BulletList", [[node("Plain", inlines(item, known))] for item in items])] if items else []
    return blocks
