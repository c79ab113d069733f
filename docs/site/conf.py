# SPDX-License-Identifier: Apache-2.0
"""The documentation as a site: Sphinx over the repository's own Markdown, offline. scripts/make_site.sh builds it.

Pages are the files of the repository where they lie, so that links that hold there hold on the site, too. Pages of OPTIONAL
are linked once they are there.
"""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]

project = "sturz"
copyright = "the sturz authors, Apache-2.0"
version = release = re.search(r"project\(sturz VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "docs/site/index"
exclude_patterns = ["build", "**/node_modules", ".git", "out"]
myst_heading_anchors = 4  # as the repository's host makes them, so that the same links hold
myst_linkify_fuzzy_links = False
suppress_warnings = ["myst.header", "toc.circular", "toc.secnum"]
nitpicky = False

html_theme = "furo"
html_title = f"sturz {release}"
html_show_sphinx = False
html_copy_source = False
templates_path = []
# Nothing of the theme is fetched: fonts are the reader's own.
html_theme_options = {"sidebar_hide_name": False, "navigation_with_keys": True}
pygments_style = "friendly"
pygments_dark_style = "monokai"

# As a list of pages names them: docs/site/index.md and studies.md.
OPTIONAL = {"<../../docs/gis>": "docs/gis", "<../../docs/python>": "docs/python", "../studies/printed/*": "docs/studies/printed"}


def without_absent_pages(app, docname, source):
    """Takes lines of a list of pages out that name an optional page that is not there."""
    if docname.startswith("docs/site/"):
        absent = [line for line, path in OPTIONAL.items() if not ((ROOT / path).exists() or (ROOT / f"{path}.md").exists())]
        source[0] = "\n".join(line for line in source[0].splitlines() if not any(line.endswith(name) for name in absent)) + "\n"


def folders_as_pages(app, docname, source):
    """Links to a folder lead to the page that lists it."""
    source[0] = source[0].replace("](docs/decisions)", "](docs/site/decisions.md)")


def keys_of_the_guide(app, docname, source):
    """The guide's section on keys as a page of its own, its links as they hold one folder deeper."""
    if docname != "docs/site/keys":
        return
    guide = (ROOT / "docs/user_guide.md").read_text()
    section = guide.partition("## All keys")[2].partition("### Dams and buildings")[0]
    section = re.sub(r"\]\(#", "](../user_guide.md#", section)
    section = re.sub(r"\]\((?!http|\.\./user_guide)", "](../", section)
    source[0] = source[0].replace("KEYS OF THE USER GUIDE", section)


def need_no_list(app, docname, source):
    """A README somewhere in the code need not be in a list of pages; what lies in docs/ has to."""
    if not docname.startswith("docs/") and not source[0].startswith("---"):
        source[0] = "---\norphan: true\n---\n" + source[0]


def setup(app):
    app.connect("source-read", without_absent_pages)
    app.connect("source-read", folders_as_pages)
    app.connect("source-read", keys_of_the_guide)
    app.connect("source-read", need_no_list)
