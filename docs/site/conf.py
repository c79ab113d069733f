# SPDX-License-Identifier: Apache-2.0
"""The documentation as a site: Sphinx over the repository's own Markdown, offline. scripts/make_site.sh builds it.

Pages are the files of the repository where they lie, so that links that hold there hold on the site, too. Pages of OPTIONAL
are linked once they are there.
"""
import pathlib
import re

from docutils import nodes

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
html_static_path = ["static"]
html_css_files = ["site.css"]
highlight_language = "text"  # of blocks that name none: what a terminal shows
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


def mark_tables_of_keys(app, doctree):
    """So that a telephone can show their rows as cards."""
    for table in doctree.findall(nodes.table):
        first = next(iter(table.findall(nodes.entry)), None)
        if first is not None and first.astext().strip() in ("key", "command", "option"):
            table["classes"].append("keys")


def complete_theme(app, exception):
    """Debian's build of the theme asks the server for normalize.css, which a file has not, and lost its dark colours where
    the browser, not the reader, chooses them."""
    css = pathlib.Path(app.outdir) / "_static/styles/furo.css"
    if exception or not css.is_file():
        return
    text = css.read_text()
    wanted = re.search(r"@import url\((/javascript/[^)]*)\);", text)
    if wanted:
        plain = pathlib.Path("/usr/share") / wanted[1].lstrip("/")
        text = text.replace(wanted[0], plain.read_text() if plain.is_file() else "body { margin: 0; }")
    dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*--color-background-primary[^}]*\})', text)
    if dark and "prefers-color-scheme" not in text:
        text += f'\n@media not print {{ @media (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark[1]} }} }}\n'
    css.write_text(text)


def setup(app):
    app.connect("doctree-read", mark_tables_of_keys)
    app.connect("build-finished", complete_theme)
    app.connect("source-read", without_absent_pages)
    app.connect("source-read", folders_as_pages)
    app.connect("source-read", keys_of_the_guide)
    app.connect("source-read", need_no_list)
