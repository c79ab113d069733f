# SPDX-License-Identifier: Apache-2.0
"""links.py on a few pages: what it must find, and what it must leave alone."""
import pathlib
import tempfile
import unittest

import links


class Links(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name).resolve()
        (self.root / "docs").mkdir()
        (self.root / "docs/other.md").write_text("# Two words, and `code`!\n\n## Again\n\n## Again\n\n<a id=\"by-hand\"></a>\n```\n# no heading\n```\n")
        (self.root / "picture.png").write_text("")

    def found(self, text):
        (self.root / "docs/page.md").write_text(text)
        return list(links.problems(self.root))

    def test_links_that_lead_somewhere_are_left_alone(self):
        for text in ("[a](other.md)", "[a](other.md#two-words-and-code)", "[a](other.md#again)", "[a](other.md#again-1)", "[a](other.md#by-hand)",
                     "![p](../picture.png)", "[folder](../docs)", "[net](https://example.org/x.md)", "# Here\n[a](#here)", "`[a](gone.md)`",
                     "```\n[a](gone.md)\n```", "[a [b]](other.md)"):
            self.assertFalse(self.found(text), text)

    def test_links_that_lead_nowhere_are_found(self):
        for text in ("[a](gone.md)", "![p](gone.png)", "[a](other.md#gone)", "[a](other.md#no-heading)", "[a](#gone)", "[a]: gone.md", "[a](../../out.md)",
                     "[a](other.md) and [b](gone.md)", "```\n```\n[a](gone.md)"):
            self.assertEqual(len(self.found(text)), 1, text)


if __name__ == "__main__":
    unittest.main()
