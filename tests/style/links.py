#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every link of the repository's Markdown leads to a file that is there, and every #anchor to a heading or an id of it.

usage: links.py ROOT      (prints FILE:LINE: what is wrong; addresses on the network are not looked at)
Anchors are those that GitHub makes of headings: lower case, without punctuation, blanks as hyphens, -1, -2 for repetitions.
"""
import pathlib
import re
import sys
import urllib.parse

LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^\[[^\]]+\]:\s+(\S+)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$")
ID = re.compile(r"<a (?:id|name)=\"([^\"]+)\"")
ELSEWHERE = re.compile(r"^(?:[a-z][a-z0-9+.-]*:|//)", re.I)
SKIPPED = {"build", "node_modules", ".git", "out"}


def lines_outside_code(text):
    """(number, line) without fenced blocks and the insides of `code`."""
    fence = None
    for n, line in enumerate(text.splitlines(), 1):
        mark = re.match(r"\s*(`{3,}|~{3,})", line)
        if mark and (fence is None or mark.group(1).startswith(fence)):
            fence = mark.group(1) if fence is None else None
        elif fence is None:
            yield n, re.sub(r"(`+)(?:(?!\1).)+\1", "``", line)


def plain(heading):
    """A heading as it is read: without link targets and marks of emphasis or code."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")


def anchors(text):
    found, seen = set(), {}
    fence = None
    for line in text.splitlines():
        mark = re.match(r"\s*(`{3,}|~{3,})", line)
        if mark and (fence is None or mark.group(1).startswith(fence)):
            fence = mark.group(1) if fence is None else None
        if fence is not None:
            continue
        found.update(ID.findall(line))
        if heading := HEADING.match(line):
            slug = re.sub(r"[^\w\- ]", "", plain(heading.group(1)).lower()).replace(" ", "-")
            again = seen.get(slug, 0)
            seen[slug] = again + 1
            found.add(f"{slug}-{again}" if again else slug)
    return found


def targets(line):
    return [*LINK.findall(line), *REFERENCE.findall(line)]


def wrong(root, page, target):
    """What is wrong with a link of a page, or an empty text."""
    path, _, anchor = urllib.parse.unquote(target).partition("#")
    where = (page.parent / path).resolve() if path else page
    if not where.is_relative_to(root):
        return "leads out of the repository"
    if not where.exists():
        return "leads nowhere"
    if anchor and where.suffix == ".md" and anchor not in anchors(where.read_text()):
        return f"has no heading or id #{anchor} there"
    return ""


def pages(root):
    for page in sorted(root.rglob("*.md")):
        if not SKIPPED & set(page.relative_to(root).parts):
            yield page


def problems(root):
    for page in pages(root):
        for n, line in lines_outside_code(page.read_text()):
            for target in targets(line):
                if not ELSEWHERE.match(target) and (why := wrong(root, page, target)):
                    yield f"{page.relative_to(root)}:{n}: {target} {why}."


def main(root):
    found = list(problems(pathlib.Path(root).resolve()))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
