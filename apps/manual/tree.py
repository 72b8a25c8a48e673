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
    inside = "".join(text_of(child) for child in inner(content))
    return inside if kind in ("Emph", "Strong", "Link", "Span", "Cite") else inside + " "


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


def prose(text, words):
    """The blocks of a comment or a docstring: paragraphs, lists, indented code, and columns NAME  MEANING.
    words(text) gives inlines."""
    blocks = []
    for part in re.split(r"\n[ ]*\n", text.strip("\n")):
        lines = part.split("\n")
        if all(line.startswith("    ") for line in lines):
            blocks.append(code_block(textwrap.dedent(part), "text"))
        elif re.match(r"\w+  +\S", part):
            named = [re.split("  +", item, 1) for item in re.split(r"\n(?=\w)", part)]
            blocks.append(node("DefinitionList", [[[code(item[0])], [[node("Plain", words(" ".join(
                item[1:])))]]] for item in named]))
        else:
            lead, *items = re.split(r"(?:^|\n)[ ]*- ", part)
            blocks += [node("Para", words(lead))] if lead else []
            blocks += [node("BulletList", [[node("Plain", words(item))] for item in items])] if items else []
    return blocks
