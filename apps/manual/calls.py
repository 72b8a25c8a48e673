"""The calls of C and of Python as blocks: from the comments of the public headers, and from docstrings."""

import ast
import os
import re
import textwrap
from pathlib import Path

from tree import attributes, code, code_block, header, node, prose

# --- C -----------------------------------------------------------------------------------------------------------

NOT_SHOWN = re.compile(r"#ifndef \w+_H\n#define \w+_H\n(\n+(#include .*\n)+)*|ISO_C_(BEGIN|END)\n|#endif\n$|"
                       r"/\* clang-format \w+ \*/\n")
DECLARED = re.compile(r"^#define (ISO_\w+)|\} (iso_\w+);|^typedef struct \w+ (iso_\w+);|^typedef \w+ \*?(iso_\w+)\(|"
                      r"^(?!typedef)\w[\w *]*?\b(iso_\w+)\(|(?:[{,] |^    )(ISO_\w+) = ", re.M)


def headers(lib):
    """The public headers by floors: of each floor, its name and the paths of its headers."""
    yield "isoroll.h", [lib / "isoroll.h"]
    public = re.findall(r'^#include "(.*)"', (lib / "isoroll.h").read_text("utf-8"), re.M)
    for floor in dict.fromkeys(path.partition("/")[0] for path in public):
        yield floor, [lib / path for path in public if path.startswith(floor + "/") and (lib / path).exists()]


def parts_of(text):
    """A header as (comment, declarations) for each part; the first is the comment about the header. Empty lines
    stand between parts."""
    parts = []
    for part in re.split(r"\n\n+(?![^{}]*\n\})", NOT_SHOWN.sub("", text)):
        comment, declared = re.match(r"\s*(?:/\*(.*?)\*/)?\n*(.*)", part, re.S).groups()
        comment = re.sub(r"^ \*?( |$)", "", comment or "", flags=re.M).strip()
        declared = re.sub(r"static inline ([^{;]*?)\n\{\n.*?^\}", r"\1;", declared.strip(), flags=re.S | re.M)
        declared = re.sub(r" +\*/", " */", declared.replace("ISO_API ", ""))
        parts.append((comment, declared))
    return parts


def names_of(declared):
    """What is declared."""
    return list(dict.fromkeys(name for found in DECLARED.findall(declared) for name in found if name))


def floor_of_c(page, lib, paths, known):
    """The blocks of a page with the headers of a floor. known: the identifiers of all names, by name."""
    for path in paths:
        file = path.relative_to(lib).as_posix()
        (about, _), *parts = parts_of(path.read_text("utf-8"))
        yield header(2, f"{page}.{file}", [node("Str", file)])
        about = about.partition(" - ")[2]
        yield from prose(about[:1].upper() + about[1:], known)
        for comment, declared in parts:
            names = names_of(declared)
            if names:
                others = [node("Span", attributes(f"{page}.{name}"), [node("Str", ", "), code(name)])
                          for name in names[1:]]
                yield header(3, f"{page}.{names[0]}", [code(names[0]), *others])
            if declared:
                yield code_block(declared, "c")
            yield from prose(re.sub(r"^--- (.*?) -+$", r"\1", comment), known) if comment else ()


def pages_of_c(lib):
    """(name, title, blocks) for each floor of the library."""
    floors = [("c-" + floor.partition(".")[0], floor, paths) for floor, paths in headers(lib)]
    known = {name: f"{page}.{name}" for page, _, paths in floors for path in paths
             for _, declared in parts_of(path.read_text("utf-8")) for name in names_of(declared)}
    for page, floor, paths in floors:
        yield page, "C: " + floor, list(floor_of_c(page, lib, paths, known))


# --- Python ------------------------------------------------------------------------------------------------------

def signature(function):
    """A function as it is called, without types; on several lines if it is long."""
    for argument in ast.walk(function.args):
        if isinstance(argument, ast.arg):
            argument.annotation = None
    result = f"\N{NO-BREAK SPACE}->\N{NO-BREAK SPACE}{ast.unparse(function.returns)}" if function.returns else ""
    line = f"{function.name}({ast.unparse(function.args)}){result}"
    lines = textwrap.wrap(line, 80, subsequent_indent=" " * (len(function.name) + 1), break_long_words=False,
                          break_on_hyphens=False)
    return "\n".join(lines).replace("\N{NO-BREAK SPACE}", " ")


def head_of(item):
    """How a function or a class is called."""
    if isinstance(item, ast.FunctionDef):
        return signature(item)
    for begin in item.body:
        if isinstance(begin, ast.FunctionDef) and begin.name == "__init__":
            begin.name, begin.args.args, begin.returns = item.name, begin.args.args[1:], None
            return signature(begin)
    return f"class {item.name}({', '.join(map(ast.unparse, item.bases))})"


def members(of):
    """What a class offers: (code, docstring) for each method and property."""
    for item in of.body if isinstance(of, ast.ClassDef) else ():
        if isinstance(item, ast.FunctionDef) and not item.name.startswith("_") and ast.get_docstring(item):
            property_ = any(ast.unparse(d) == "property" for d in item.decorator_list)
            item.args.args = item.args.args[1:]
            yield item.name if property_ else signature(item), ast.get_docstring(item)


def page_of_python(page, package):
    """(name, title, blocks) of all that `import isoroll` gives."""
    sources = [ast.parse(path.read_text("utf-8")) for path in sorted(package.glob("*.py"))]
    defined = {item.name: item for source in sources for item in source.body
               if isinstance(item, (ast.FunctionDef, ast.ClassDef))}
    stub = ast.parse(Path(os.environ["ISO_STUB"]).read_text("utf-8"))
    defined.update((item.name, item) for item in stub.body if isinstance(item, ast.FunctionDef))
    start = ast.parse((package / "__init__.py").read_text("utf-8"))
    offered = next(set(ast.literal_eval(item.value)) for item in start.body
                   if isinstance(item, ast.Assign) and item.targets[0].id == "__all__")
    blocks = prose(ast.get_docstring(start))
    for name in sorted(sorted(offered & defined.keys()), key=str.lower):
        item = defined[name]
        blocks += [header(2, f"{page}.{name}", [code(name)]), code_block(head_of(item), "python")]
        blocks += prose(ast.get_docstring(item) or "")
        for call, doc in members(item):
            blocks += [code_block(call, "python"), *prose(doc)]
    return page, "Python: all calls", blocks
