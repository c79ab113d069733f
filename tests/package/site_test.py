#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The documentation builds as a site without a warning, and a page of it fetches nothing. Usage: site_test.py ROOT

77 (skipped) where Sphinx, MyST or furo are not installed (scripts/packages.sh, site_packages).
"""
import html.parser
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile

FETCHING = {("script", "src"), ("link", "href"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("object", "data")}
# Links of <link> that name a place and fetch nothing.
NAMING = {"canonical", "license", "author", "search", "index", "next", "prev"}


class Fetched(html.parser.HTMLParser):
    """Addresses that a browser loads by itself."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if tag == "link" and given.get("rel") in NAMING:
            return
        self.found += [value for key, value in attributes if (tag, key) in FETCHING and value]


def fetched(text):
    parser = Fetched()
    parser.feed(text)
    return [address for address in parser.found if re.match(r"(?:https?:)?//", address)]


def problems(site):
    for page in sorted(site.rglob("*.html")):
        yield from (f"{page.relative_to(site)} fetches {address}" for address in fetched(page.read_text()))
    for sheet in sorted(site.rglob("*.css")):
        yield from (f"{sheet.relative_to(site)} fetches {address}" for address in re.findall(r"(?:url\(['\"]?|@import ['\"])((?:https?:)?//[^'\")]+)", sheet.read_text()))


def main(root):
    if any(importlib.util.find_spec(name) is None for name in ("sphinx", "myst_parser", "furo")):
        print("Sphinx, MyST or furo is not installed: nothing tested.")
        return 77
    assert fetched('<script src="https://a/b.js"></script><img src="//a/b.png"><a href="https://a">') == ["https://a/b.js", "//a/b.png"], "the test itself"
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder) / "site"
        done = subprocess.run([root / "scripts/make_site.sh"], text=True, capture_output=True, env=os.environ | {"STURZ_SITE": str(site)})
        print(done.stdout, done.stderr, sep="")
        found = list(problems(site))
        for name in ("docs/tutorial.html", "docs/site/keys.html", "docs/uses/hazard_map.html", "docs/studies/README.html"):
            if not (site / name).is_file():
                found.append(f"{name} is not there")
        keys = (site / "docs/site/keys.html").read_text() if not found else ""
        if "numerics.spacing_m" not in keys:
            found.append("docs/site/keys.html does not hold the keys")
        print("\n".join(found))
        return 1 if done.returncode or found else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
