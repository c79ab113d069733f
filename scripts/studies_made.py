#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""When each study of docs/studies was made, by what, and whether the code that it measures has changed since.

usage: scripts/studies_made.py check [ROOT]    (prints the studies that are older than their code; 1 when something is wrong)
       scripts/studies_made.py table [ROOT]    (writes the table of docs/studies/README.md anew)

docs/studies/made.json holds a record per study: command, date, machine, commit, and the hash of the sources that it
measures, without blanks and full-line comments. `check` fails for a page or a script that no study of scripts/studies_list.py
declares, for a declared page, script or source that is not there, for a study without its whole record, and for a table that
calls a study current that is not: decision 0058.
"""
import hashlib
import json
import os
import pathlib
import re
import sys

BEGIN, END = "<!-- studies -->", "<!-- end -->"
SUFFIXES = (".cpp", ".hpp", ".py", ".yaml")
FIELDS = ("command", "date", "machine", "commit", "sources")
CURRENT, OLDER = "of this code", "older than the code"
IMPORT = re.compile(r"^(?:from|import) (\w+)", re.M)


def declared(root):
    """The list of studies of that root: (MADE, pages_of)."""
    space = {"__name__": "studies_list", "__file__": str(root / "scripts/studies_list.py")}
    exec(compile((root / "scripts/studies_list.py").read_text(), space["__file__"], "exec"), space)
    return space["MADE"], space["pages_of"]


def scripts_of(root, study):
    """Paths of the scripts of docs/studies that a study runs, and of those that they import."""
    folder = root / "docs/studies"
    found, ahead = set(), [pathlib.Path(w).name for command in study.commands for w in command if "docs/studies/" in w and w.endswith(".py")]
    while ahead:
        name = ahead.pop()
        if name in found:
            continue
        found.add(name)
        if (folder / name).is_file():
            ahead += [f"{other}.py" for other in IMPORT.findall((folder / name).read_text()) if (folder / f"{other}.py").is_file()]
    return [f"docs/studies/{name}" for name in sorted(found)]


def files_of(root, source):
    """Files of a source: a folder with all below it, FOLDER/* for those directly in it, or one file."""
    if source.endswith("/*"):
        found = (root / source.removesuffix("/*")).glob("*")
    else:
        found = [root / source] if (root / source).is_file() else (root / source).rglob("*")
    return {path.relative_to(root).as_posix() for path in found if path.is_file() and path.suffix in SUFFIXES}


def measured(root, study):
    """All files that a study measures or is made by."""
    return sorted(set().union(*(files_of(root, source) for source in (*study.sources, *scripts_of(root, study)))))


def hash_of(texts):
    """Hash of (path, text) pairs that blanks and full-line comments do not change."""
    whole = hashlib.sha256()
    for path, text in texts:
        mark = "#" if path.endswith((".py", ".yaml")) else "//"
        lines = [line for raw in text.splitlines() if (line := raw.strip()) and not line.startswith(mark)]
        whole.update("\n".join([path, *lines, ""]).encode())
    return whole.hexdigest()[:16]


def hash_now(root, study):
    return hash_of((path, (root / path).read_text(errors="replace")) for path in measured(root, study))


def records(root):
    path = root / "docs/studies/made.json"
    return json.loads(path.read_text()) if path.is_file() else {}


def write_whole(path, text):
    """Puts a text in a file's place at once: whoever is interrupted leaves the old one, never a half."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with open(part, "w") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def keep(root, name, record):
    """Writes a study's record beside the others."""
    all_of_them = records(root) | {name: record}
    lines = [f'  {json.dumps(key)}: {json.dumps(all_of_them[key], ensure_ascii=False)}' for key in sorted(all_of_them)]
    write_whole(root / "docs/studies/made.json", "{\n" + ",\n".join(lines) + "\n}\n")


def stale(root):
    """Names of the studies whose sources have changed since they were made."""
    made, _ = declared(root)
    return [name for name, study in made.items() if name in records(root) and records(root)[name].get("sources") != hash_now(root, study)]


def table(root):
    """The table of docs/studies/README.md, a row per study."""
    made, pages_of = declared(root)
    old, have = stale(root), records(root)
    rows = ["| study | pages | made | commit | machine | core minutes, about | state |", "|---|---|---|---|---|---|---|"]
    for name, study in sorted(made.items()):
        record = have.get(name, {})
        pages = ", ".join(f"[{page.removesuffix('.md')}]({page})" for page in pages_of(study))
        minutes = f"by hand: {study.by_hand}" if study.by_hand else f"{study.minutes:g}"
        rows.append(f"| {name} | {pages} | {record.get('date', '')} | {record.get('commit', '')} | {record.get('machine', '')} | {minutes} "
                    f"| {OLDER if name in old else CURRENT} |")
    return "\n".join(rows)


def write_table(root):
    path = root / "docs/studies/README.md"
    head, rest = path.read_text().split(BEGIN, 1)
    write_whole(path, f"{head}{BEGIN}\n{table(root)}\n{END}{rest.split(END, 1)[1]}")


def undeclared(root, made, pages_of):
    folder = root / "docs/studies"
    pages = {page for study in made.values() for page in pages_of(study)}
    scripts = {script for study in made.values() for script in scripts_of(root, study)}
    for path in sorted(folder.glob("*.md")):
        if path.name not in pages | {"README.md"}:
            yield f"docs/studies/{path.name}: no study of scripts/studies_list.py makes it. Declare one."
    for path in sorted(folder.glob("*.py")):
        if f"docs/studies/{path.name}" not in scripts:
            yield f"docs/studies/{path.name}: no study of scripts/studies_list.py runs it. Declare one."


def missing(root, made, pages_of):
    have = records(root)
    for name, study in made.items():
        for page in pages_of(study):
            if not (root / "docs/studies" / page).is_file():
                yield f"{name}: its page docs/studies/{page} is not there."
        for script in scripts_of(root, study):
            if not (root / script).is_file():
                yield f"{name}: its script {script} is not there."
        for source in study.sources:
            if not files_of(root, source):
                yield f"{name}: its source {source} is not there, or holds no code."
        if not study.commands and not study.by_hand:
            yield f"{name}: has no command and does not say why (by_hand)."
        if lacks := [field for field in FIELDS if not have.get(name, {}).get(field)]:
            yield f"{name}: docs/studies/made.json lacks {', '.join(lacks)} of it."
    for name in have:
        if name not in made:
            yield f"docs/studies/made.json: {name} is no study of scripts/studies_list.py."


def dishonest(root):
    page = root / "docs/studies/README.md"
    block = page.read_text().split(BEGIN, 1)[-1].split(END, 1)[0].strip() if page.is_file() else ""
    shown, true = set(block.splitlines()), set(table(root).splitlines())
    for row in sorted(true ^ shown):
        where = "lacks" if row in true else "has, and it is not so"
        yield f"docs/studies/README.md: its table {where}: {row}\n  scripts/make_studies.sh --table writes it anew."


def problems(root):
    made, pages_of = declared(root)
    found = [*undeclared(root, made, pages_of), *missing(root, made, pages_of)]
    return found or list(dishonest(root))


def main(what="check", root=pathlib.Path(__file__).resolve().parent.parent):
    root = pathlib.Path(root).resolve()
    if what == "table":
        write_table(root)
        return 0
    found = problems(root)
    old, have = stale(root), records(root)
    print(f"{len(old)} of {len(declared(root)[0])} studies are older than the code that they measure:")
    for name in old:
        print(f"  {name}: made {have[name]['date']} at {have[name]['commit']}")
    print("\n".join(found), file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) > 3 or (len(sys.argv) > 1 and sys.argv[1] not in ("check", "table")):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
