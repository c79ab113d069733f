#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every language of the page has every text, with the same places; no key is missing or idle.

texts_test.py ROOT: says which keys of which language are missing, and ends with 1.
"""
import json
import pathlib
import re
import sys

place = re.compile(r"\{[^{}]*\}")
used_cpp = re.compile(r'\btr(?:_count)?\(\s*(?:[^"()]*\?\s*)?"([^"]+)"')
# Keys that code puts together, by their beginnings; and any text that looks like a whole key.
made_up = ("nav.", "members.col.", "quantity.", "short.", "plane.", "intensity.", "outcome.",
           "censoring.", "phases.row.", "sources.col.", "assets.col.", "gauges.col.",
           "posterior.col.", "js.statistic.", "js.material.", "js.end.", "js.end_in_title.", "cut.")


def problems(tables, sources, scripts):
    """All that is wrong with {language: {key: text}}, given the texts of the code."""
    english = tables["en"]
    found = []
    for language, table in sorted(tables.items()):
        for key in sorted(english.keys() - table.keys()):
            found.append(f"{language}: {key} is missing")
        for key in sorted(table.keys() - english.keys()):
            found.append(f"{language}: {key} is unknown in English")
        for key in sorted(english.keys() & table.keys()):
            if not table[key].strip() and english[key].strip():
                found.append(f"{language}: {key} is empty")
            wanted, own = (sorted(place.findall(t[key])) for t in (english, table))
            numbered = any(p[1:-1].isdigit() for p in own)
            if len(wanted) != len(own) or (not numbered and wanted != own):
                found.append(f"{language}: {key} has the places {own}, English has {wanted}")
    code = "".join(sources)
    words = set(re.findall(r'"([a-z_0-9]+(?:\.[a-z_0-9]+)+)"', code))
    for key in used_cpp.findall(code):
        if key not in english and key + ".one" not in english:
            found.append(f"the code asks for {key}, which no table has")
    script = "".join(scripts)
    asked = {"js." + key for key in re.findall(r"\bt\(\s*'([^']+)'", script)}
    found += [f"the script asks for {key}, which no table has" for key in sorted(asked - english.keys())]
    quoted = {"js." + key for key in re.findall(r"'([a-z_0-9.]+)'", script)}
    for key in sorted(english):
        plain = re.sub(r"\.(one|many)$", "", key)
        if not {key, plain} & (words | quoted) and not key.startswith(made_up) and plain not in code:
            found.append(f"no code asks for {key}")
    return found


def main(root):
    reports = pathlib.Path(root) / "reports"
    tables = {file.stem: json.loads(file.read_text(encoding="utf-8"))
              for file in sorted((reports / "texts").glob("*.json"))}
    sources = [file.read_text(encoding="utf-8") for file in sorted(reports.rglob("*.cpp"))]
    scripts = [file.read_text(encoding="utf-8")
               for file in sorted((reports / "assets" / "src").rglob("*.js"))]
    found = problems(tables, sources, scripts)
    # A test that cannot fail is none: a key taken away, a place lost, a language left behind.
    assert problems({**tables, "xx": {}}, sources, scripts), "a missing language goes unseen"
    broken = dict(tables["de"])
    broken["cards.cut_of"] = broken["cards.cut_of"].replace("{}", "", 1)
    assert problems({**tables, "de": broken}, sources, scripts), "a lost place goes unseen"
    for line in found:
        print(line)
    print(f"{len(tables)} languages, {len(tables['en'])} texts, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
