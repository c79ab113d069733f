#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""House rules that a machine can check. Usage: check_style.py CHECK ROOT, CHECK one of the
functions below or `all`. Prints file:line: what is wrong; exit code 1 when anything is."""
import importlib.util
import pathlib
import re
import sys

LIBRARIES = ("engine", "scenarios", "ensemble", "io", "reports")
CODE = (".hpp", ".cpp")
MAX_LINES = 400


def sources(root, folders, suffixes=CODE):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in suffixes and "node_modules" not in path.parts:
                yield path, path.relative_to(root).as_posix()


def lines_of(path):
    return path.read_text(errors="replace").splitlines()


def without_strings(line):
    """The line with the insides of its string literals blanked."""
    return re.sub(r'"(\\.|[^"\\])*"', '""', line)


def without_comment(line):
    return without_strings(line).split("//")[0]


def is_app(name):
    return name.startswith("ensemble/app/") or name == "ensemble/python/interpreter.cpp"


def length(root):
    for path, name in sources(root, LIBRARIES + ("tests",), CODE + (".py",)):
        n = len(lines_of(path))
        if n > MAX_LINES:
            yield f"{name}:{n}: {n} lines (at most {MAX_LINES}). One file, one idea: split it."


MAX_FILES, MAX_TYPES, MAX_FUNCTION = 25, 60, 70


def folders(root):
    """No folder of code is a drawer: at most 25 files and 60 types."""
    found = {}
    for path, name in sources(root, LIBRARIES + ("tests",)):
        found.setdefault(name.rpartition("/")[0], []).append(path)
    declared = re.compile(r"^\s*(?:class|struct|enum class|enum) \w+[^;]*\{")
    for folder, paths in found.items():
        if len(paths) > MAX_FILES:
            yield f"{folder}:1: {len(paths)} files (at most {MAX_FILES}). Group them."
        n = sum(bool(declared.match(line)) for path in paths for line in lines_of(path))
        if n > MAX_TYPES:
            yield f"{folder}:1: {n} types (at most {MAX_TYPES}). Group them."


# One loop that the compiler must see whole to put particles side by side in vector registers.
LONG_BY_INTENT = {
    "engine/effects/dense/update.hpp:void range(const Packing packing, const StressColumns& c, "
    "const SweepOutput& r, std::size_t begin,",
}


def functions(root):
    """No function of the libraries is longer than a screen; tables of data are none. Formatted code
    closes a block in the column in which it began."""
    heads = re.compile(r"^( {0,4})(?!namespace\b|struct\b|class\b|enum\b|union\b|extern\b|if\b|for\b|while\b"
                       r"|switch\b|do\b|else\b|[}:#/])\S.*\{$")
    for path, name in sources(root, LIBRARIES):
        lines = lines_of(path)
        for n, line in enumerate(lines):
            k = n  # a signature may take several lines: its first is the one that stands out
            while line.endswith("{") and k > 0 and n - k < 6 and lines[k].startswith("      ") \
                    and not lines[k - 1].endswith((";", "{", "}", ":")):
                k -= 1
            head = heads.match(lines[k] if k == n else lines[k] + " {")
            if k < n and lines[k].startswith("   "):
                continue  # a call with a lambda
            if not head or not line.endswith("{") or "(" not in lines[k] \
                    or re.search(r"=\s*\w*\{$", line):
                continue
            end = next((k for k in range(n + 1, len(lines))
                        if lines[k].startswith(head.group(1) + "}")), n)
            if end - n + 1 > MAX_FUNCTION and f"{name}:{lines[k].strip()}" not in LONG_BY_INTENT:
                yield f"{name}:{n + 1}: a function of {end - n + 1} lines (at most {MAX_FUNCTION})."


def silence(root):
    """Libraries do not print, exit or read the environment."""
    forbidden = re.compile(
        r"\b(?:std::)?(?:cout|cerr|clog|printf|fprintf|puts|putchar|perror|abort|quick_exit|_exit"
        r"|getenv|secure_getenv|setenv|putenv)\b|(?<![\w:.>])(?:std::)?exit\s*\(|\bstd::exit\b"
        r"|\bfmt::print\b|\bstd(?:out|err)\b")
    for path, name in sources(root, LIBRARIES):
        if is_app(name):
            continue
        for n, line in enumerate(lines_of(path), 1):
            found = forbidden.search(without_comment(line))
            if found:
                yield f"{name}:{n}: a library must not use {found.group(0)}; only ensemble/app may."


# The field uses each of these words for two things; GDAL's hillshade tool keeps its own name.
# A phase is one of a mixture, grains or liquid; how densely grains lie is their state.
FORBIDDEN_WORDS = {
    "DEM": "elevation model or discrete element method: say terrain, elevation raster, grain contact",
    "kernel": "SPH weight or hot loop: say SmoothingKernel or sweep",
}


# Words of this project alone, and what the field calls the thing. `parted_fraction` and
# `take_off_fraction` are columns of members.csv and keep their names.
PRIVATE_WORDS = {
    r"parcels?|Parcel\w*|\w+_parcels?|lone (?:particle|grain|column)s?": "isolated particle",
    r"groups? that fl(?:y|ies)|flying (?:grain|group)s?|calm groups?": "dispersed or dense group",
    r"parted|Parting[A-Z]\w*": "dilated or separated",
    r"hott?est|felt gradient|gradient felt": "largest granular temperature, pair-consistent gradient",
    r"kick[ _]length": "kick interval",
    r"take[ _-]offs?": "detachment",
    r"wall_share": "mirror contribution",
    r"[Pp]acked ?(?:Record|record)s?|PackedView|PackPass|[Pp]ack pass": "neighbour record, gather",
    r"rims?|\w+_rim": "domain boundary, edge",
    r"booked|bookings?|books": "accounted for, account, ledger",
    r"bends?|bend_\w+": "curvature",
    r"reach_\w+|(?!probability_of_reach)\w+_reach|reaches of": "support radius, contact distance, search radius or runout",
}
# Particles, effects and callers are things.
PERSONS = re.compile(r"\b(?:nobody|whoever|everybody|everyone|somebody|someone|anybody|anyone)\b"
                     r"|\bwho (?:came|comes|goes|leaves|flies|lands|is near)\b", re.IGNORECASE)


def words(root):
    patterns = {w: re.compile(rf"(?<![A-Za-z]){w}s?(?![A-Za-z])" if w == "DEM"
                              else rf"(?i:(?<![A-Za-z]){w}s?(?![A-Za-z]))") for w in FORBIDDEN_WORDS}
    allowed = re.compile(r"gdaldem|GDALDEM|/proc/sys/kernel|smoothing[ _-]kernel", re.IGNORECASE)
    private = {re.compile(rf"\b(?:{w})\b"): known for w, known in PRIVATE_WORDS.items()}
    for path, name in sources(root, LIBRARIES, CODE + (".js", ".css")):
        for n, line in enumerate(lines_of(path), 1):
            text = allowed.sub("", line)
            for word, pattern in patterns.items():
                if pattern.search(text):
                    yield f"{name}:{n}: the bare word '{word}' ({FORBIDDEN_WORDS[word]})."
            for pattern, known in private.items():
                found = pattern.search(text)
                if found:
                    yield f"{name}:{n}: '{found.group(0)}' is no word of the field. Say: {known}."
            found = PERSONS.search(text)
            if found:
                yield f"{name}:{n}: '{found.group(0)}' speaks of persons. Name the thing."


def headers(root):
    """Licence line first, `#pragma once` exactly once in every header."""
    for path, name in sources(root, LIBRARIES + ("tests",), CODE + (".py",)):
        text = lines_of(path)
        first = text[1:2] if text and text[0].startswith("#!") else text[:1]
        if not first or "SPDX-License-Identifier: Apache-2.0" not in first[0]:
            yield f"{name}:1: the first line must be the SPDX line."
        once = sum(line.strip() == "#pragma once" for line in text)
        if path.suffix == ".hpp" and once != 1:
            yield f"{name}:1: {once} lines '#pragma once' (exactly one)."
        if path.suffix == ".hpp" and not any(line.startswith("///") for line in text[1:4]):
            yield f"{name}:2: a header opens with one /// sentence that says the file's idea."


def machine_paths(root):
    """No path of one machine, and no unfinished mark, in anything that ships."""
    pattern = re.compile(r"(?<![\w.])/(?:home|root|work|tmp|Users|mnt|scratch)/\w+")
    marks = re.compile(r"\b(?:TODO|FIXME|XXX|HACK)\b")
    folders = LIBRARIES + ("docs", "scripts", "tests", ".ci")
    kinds = CODE + (".py", ".sh", ".md", ".yaml", ".yml", ".txt", ".json", ".js", ".css", ".html")
    files = list(sources(root, folders, kinds))
    files += [(p, p.name) for p in sorted(root.iterdir()) if p.is_file() and p.suffix in kinds]
    for path, name in files:
        if name == "tests/style/check_style.py":
            continue
        for n, line in enumerate(lines_of(path), 1):
            if pattern.search(line):
                yield f"{name}:{n}: a path of one machine: {pattern.search(line).group(0)}"
            if path.suffix != ".md" and marks.search(line):
                yield f"{name}:{n}: an unfinished mark; open an issue instead."


def equations(root):
    """Every row of engine/EQUATIONS.md names a source file and a test file that exist."""
    table = root / "engine" / "EQUATIONS.md"
    if not table.is_file():
        yield "engine/EQUATIONS.md:1: the table is missing."
        return
    named = re.compile(r"`?((?:engine|scenarios|ensemble|io|tests)/[\w./-]+\.(?:cpp|hpp|py))")
    rows = 0
    for n, line in enumerate(lines_of(table), 1):
        if not line.startswith("|") or re.match(r"^\|[\s:|-]+\|?$", line):
            continue
        paths = named.findall(line)
        if not paths and rows == 0:
            continue  # the head of the table
        rows += 1
        for path in paths:
            if not (root / path).is_file():
                yield f"engine/EQUATIONS.md:{n}: {path} does not exist."
        if not any(p.startswith("tests/") for p in paths):
            yield f"engine/EQUATIONS.md:{n}: the row names no test."
        if not any(p.startswith(("engine/", "scenarios/")) for p in paths):
            yield f"engine/EQUATIONS.md:{n}: the row names no source file."
    if rows == 0:
        yield "engine/EQUATIONS.md:1: the table has no rows."


# What shows that a word is a label of docs/physics.md: a capital with a number and nothing that
# would make it a version, a file name or an identifier. Errata and findings are named as such.
LABEL = re.compile(
    r"(?<![\w.\-/])([ABCDF]\.\d{1,2}|I[1-9]\d?|V[1-9]\d?[a-z]?)(?![\w/\-]|\.\d)"
    r"|\b(?:[Ee]rrat(?:a|um)|[Ff]indings?) ([ES][1-9]\d?)\b")
INSIDE_LABEL = re.compile(r"(?<![\w.\-/])([ES][1-9]\d?)(?![\w/\-]|\.\d)")  # in that file itself
ANCHOR = re.compile(
    r"^#{1,4} ([ABCDF]\.\d{1,2})\b|\*\*([IVS][1-9]\d?[a-z]?)\*\*|^\| (E[1-9]\d?) \|")
DOCUMENT = re.compile(r"[\w.\-/]*\w\.md\b")


def source_of(cited):
    """What an installed document is in the repository."""
    cited = re.sub(r"^(usr/)?share/doc/sturz/", "", cited.lstrip("/"))
    return re.sub(r"^(usr/)?share/sturz/", "scenarios/", cited)


def prose(path, line):
    """Comments and string literals of C++, everything of other files; without addresses."""
    if path.suffix in CODE:
        strings = re.findall(r'"(?:\\.|[^"\\])*"', line)
        comment = re.sub(r'"(?:\\.|[^"\\])*"', "", line).partition("//")[2]
        line = " ".join(strings + [comment])
    return re.sub(r"\w+://\S+", "", line)


def references(root):
    """Every label (B.9, I4, V8b) has its place in docs/physics.md, every cited document exists."""
    physics = root / "docs" / "physics.md"
    anchors = {}
    for n, line in enumerate(lines_of(physics) if physics.is_file() else [], 1):
        for found in ANCHOR.finditer(line):
            label = next(filter(None, found.groups()))
            if label in anchors:
                yield f"docs/physics.md:{n}: {label} has its place in line {anchors[label]} already."
            anchors.setdefault(label, n)
    kinds = CODE + (".py", ".sh", ".md", ".yaml", ".yml", ".txt", ".cmake")
    files = list(sources(root, LIBRARIES + ("docs", "scripts", "tests"), kinds))
    files += [(p, p.name) for p in sorted(root.iterdir()) if p.is_file() and p.suffix in kinds]
    documents = {p.name for p, _ in files if p.suffix == ".md"}
    for path, name in files:
        if name.startswith("tests/style/"):
            continue  # examples of both kinds
        patterns = (LABEL, INSIDE_LABEL) if path == physics else (LABEL,)
        for n, line in enumerate(lines_of(path), 1):
            text = prose(path, line)
            for found in (m for p in patterns for m in p.finditer(text)):
                label = next(filter(None, found.groups()))
                if label not in anchors:
                    yield f"{name}:{n}: {label} has no place in docs/physics.md."
            for cited in (source_of(m.group(0)) for m in DOCUMENT.finditer(text)):
                if not ((root / cited).is_file() or (path.parent / cited).is_file()
                        or cited in documents):
                    yield f"{name}:{n}: the document {cited} is not in the repository."


def citation(root):
    """CITATION.cff names the version of the project: one number, one place."""
    lists, cited = root / "CMakeLists.txt", root / "CITATION.cff"
    if not lists.is_file() or not cited.is_file():
        yield "CITATION.cff:1: CITATION.cff and CMakeLists.txt belong side by side."
        return
    project = re.search(r"^project\(\w+ VERSION ([\d.]+)", lists.read_text(), re.M)
    if not project:
        yield "CMakeLists.txt:1: project() gives no version."
        return
    for n, line in enumerate(lines_of(cited), 1):
        if line.startswith("version:"):
            if line.split(":", 1)[1].strip().strip("\"'") != project.group(1):
                yield f"CITATION.cff:{n}: the project's version is {project.group(1)}."
            return
    yield "CITATION.cff:1: no version."


def decisions(root):
    """Decisions are cited by number: no two share one."""
    first = {}
    for path in sorted((root / "docs/decisions").glob("*.md")):
        number = re.match(r"(\d{4})-[a-z0-9-]+\.md$", path.name)
        if not number:
            yield f"docs/decisions/{path.name}:1: is no NNNN-what-was-decided.md."
        elif first.setdefault(number.group(1), path.name) != path.name:
            yield f"docs/decisions/{path.name}:1: has the number of {first[number.group(1)]}. Take the next free one."


MADE_BY = re.compile(r"^<!-- made by (\w+) -->$")


def blocks_of(page):
    """Name, line and whether it ends, of every block of a page that a command makes."""
    lines = lines_of(page)
    for n, line in enumerate(lines, 1):
        if found := MADE_BY.match(line):
            rest = [other for other in lines[n:] if other == "<!-- end -->" or MADE_BY.match(other)]
            yield found.group(1), n, bool(rest) and rest[0] == "<!-- end -->"


def studies(root):
    """What a page says was made by an entry of scripts/studies_list.py is one, and goes there; and every entry has its page."""
    script = root / "scripts/studies_list.py"
    if not script.is_file():
        return
    spec = importlib.util.spec_from_file_location("studies_of_the_root", script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    pages = {name: study[0] for name, study in module.MADE.items()}
    seen = set()
    for page in sorted((root / "docs/studies").glob("*.md")):
        where = page.relative_to(root).as_posix()
        for name, n, ends in blocks_of(page):
            if name in seen:
                yield f"{where}:{n}: a second block of {name}."
            seen.add(name)
            if pages.get(name) != page.name:
                yield f"{where}:{n}: scripts/studies_list.py has no {name} for this page."
            if not ends:
                yield f"{where}:{n}: the block of {name} has no line <!-- end -->."
    for name, page in pages.items():
        whole = page.startswith(module.WHOLE)
        if whole and not (root / "docs/studies" / page.removeprefix(module.WHOLE)).is_file():
            yield f"scripts/studies_list.py:1: {name} makes {page.removeprefix(module.WHOLE)}, which docs/studies has not."
        if page and not whole and not page.startswith(module.BESIDE) and name not in seen:
            yield f"scripts/studies_list.py:1: docs/studies/{page} has no line <!-- made by {name} -->."


CHECKS = {f.__name__: f for f in (length, folders, functions, silence, words, headers, machine_paths, equations,
                                  references, citation, decisions, studies)}


def main(which, root):
    root = pathlib.Path(root).resolve()
    chosen = CHECKS.values() if which == "all" else [CHECKS[which]]
    bad = [line for check in chosen for line in check(root)]
    print("\n".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in (*CHECKS, "all"):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2]))
