#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The style checks must find what they are there to find."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_style as style  # noqa: E402

GOOD = "// SPDX-License-Identifier: Apache-2.0\n/// Idea.\n#pragma once\n"


class CheckStyle(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        for name in style.LIBRARIES + ("tests", "ensemble/app"):
            (self.root / name).mkdir(parents=True, exist_ok=True)

    def tearDown(self):
        self.folder.cleanup()

    def findings(self, check, name, text):
        path = self.root / name
        path.write_text(text)
        found = list(style.CHECKS[check](self.root))
        path.unlink()
        return found

    def test_long_files_are_found(self):
        self.assertTrue(self.findings("length", "io/a.cpp", "\n" * 401))
        self.assertFalse(self.findings("length", "io/a.cpp", "\n" * 400))

    def test_printing_libraries_are_found_and_the_app_may_print(self):
        for line in ('std::cout << 1;', 'printf("x");', 'std::exit(1);', 'exit(1);',
                     'auto p = std::getenv("HOME");', 'fmt::print("x");', 'fputs("x", stderr);'):
            self.assertTrue(self.findings("silence", "engine/a.cpp", line), line)
            self.assertFalse(self.findings("silence", "ensemble/app/a.cpp", line), line)
        for line in ('// never printf here', 'text("std::cout");', 'on_exit(3);', 'x.exit();'):
            self.assertFalse(self.findings("silence", "engine/a.cpp", line), line)

    def test_ambiguous_words_are_found(self):
        for line in ("// the DEM", "double kernel_sum;", "// Kernel loops"):
            self.assertTrue(self.findings("words", "io/a.cpp", line), line)
        for line in ("// gdaldem", "SmoothingKernel w;", "// demand", "// the liquid phase", "// ademic"):
            self.assertFalse(self.findings("words", "io/a.cpp", line), line)

    def test_private_words_are_found_in_libraries(self):
        for line in ("// a lone parcel", "struct ParcelBody {", "// grains that parted again",
                     "double hottest = 0;", "// groups that fly", "double kick_length(double dt);",
                     "ledger.take_off += 1;", "// over the rim", "// what is booked here",
                     "double bend_ee = 0;", "float inv_reach;", "// the gradient felt"):
            self.assertTrue(self.findings("words", "engine/a.hpp", line), line)
            self.assertTrue(self.findings("words", "reports/a.js", line), line)
            self.assertFalse(self.findings("words", "tests/a.hpp", line), line)
        for line in ("double parted_fraction = 0;", '"take_off_fraction", "1",', "// bookkeeping",
                     "// separated by commas", "// departed", "// trim the rows", "unpacked(bytes);"):
            self.assertFalse(self.findings("words", "engine/a.hpp", line), line)

    def test_persons_are_found_in_libraries(self):
        for line in ("// where nobody flies", "// whoever reads it", "// Everybody has it",
                     "// who came for its sake", '"somebody must ask"'):
            self.assertTrue(self.findings("words", "engine/a.hpp", line), line)
        for line in ("// whose lists are kept", "// bodies", "// the whole"):
            self.assertFalse(self.findings("words", "engine/a.hpp", line), line)

    def test_headers_without_licence_pragma_or_idea_are_found(self):
        self.assertFalse(self.findings("headers", "io/a.hpp", GOOD))
        for line in GOOD.splitlines(keepends=True):
            self.assertTrue(self.findings("headers", "io/a.hpp", GOOD.replace(line, "")), line)

    def test_machine_paths_and_unfinished_marks_are_found(self):
        self.assertTrue(self.findings("machine_paths", "io/a.cpp", 'open("/' + 'home/me/x");'))
        self.assertTrue(self.findings("machine_paths", "io/a.cpp", "// TO" + "DO later"))
        self.assertFalse(self.findings("machine_paths", "io/a.cpp", "a/tmp/b; /usr/bin/python3"))

    def test_equation_rows_need_files_that_exist(self):
        (self.root / "tests/a_test.cpp").write_text("")
        (self.root / "engine/a.cpp").write_text("")
        head = "| eq | where | test |\n|---|---|---|\n"
        good = head + "| 1 | engine/a.cpp:f | tests/a_test.cpp |\n"
        self.assertFalse(self.findings("equations", "engine/EQUATIONS.md", good))
        for bad in (head, good.replace("engine/a.cpp", "engine/b.cpp"),
                    good.replace("tests/a_test.cpp", "-")):
            self.assertTrue(self.findings("equations", "engine/EQUATIONS.md", bad), bad)

    def test_the_table_is_required(self):
        self.assertTrue(list(style.CHECKS["equations"](self.root)))

    PHYSICS = ("## B.9 States\n- **I4** Creep.\n- **V8** Cone, **V8b** slice.\n"
               "| E8 | a | b |\n**S2** Angle (E8).\n")

    def with_physics(self, text=PHYSICS):
        for name in ("docs/decisions", "docs/studies"):
            (self.root / name).mkdir(parents=True, exist_ok=True)
        (self.root / "docs/physics.md").write_text(text)

    def test_labels_need_a_place_in_the_physics(self):
        self.with_physics()
        for name, line in (("engine/a.cpp", "int x;  // law of docs/physics.md B.9, I4; see V8b."),
                           ("tests/a.cpp", 'f("V8 collapse, a {}", a);  // B.9\'s rule'),
                           ("docs/decisions/a.md", "V8 after errata E8 and finding S2 (B.9 step 3)"),
                           ("io/a.py", "# 2.B.7, v1.B.3, B.9.2, SV99, I2C, V8-9, x/V77")):
            self.assertFalse(self.findings("references", name, line), line)
        for name, line in (("engine/a.hpp", "/// Gone: B.99"), ("engine/a.cpp", "x();  // C.1"),
                           ("tests/a.cpp", 'f("V7 slab");'), ("docs/decisions/a.md", "(I5)"),
                           ("docs/decisions/a.md", "V8c"), ("scenarios/a.hpp", "// errata E9"),
                           ("README.md", "finding S1")):
            self.assertTrue(self.findings("references", name, line), line)

    def test_identifiers_are_no_labels(self):
        self.with_physics()
        for line in ("double V3 = I7 + A.5;", "template <int I9> struct V5 {};", "f(0x1E9, S3);"):
            self.assertFalse(self.findings("references", "engine/a.cpp", line), line)

    def test_the_physics_itself_must_be_consistent(self):
        for more in ("see S9", "see B.8", "## B.9 Again"):
            self.with_physics(self.PHYSICS + more)
            self.assertTrue(list(style.CHECKS["references"](self.root)), more)
        (self.root / "docs/physics.md").unlink()
        self.assertTrue(self.findings("references", "engine/a.hpp", "// B.9"))

    def test_decisions_have_numbers_of_their_own(self):
        folder = self.root / "docs/decisions"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "0002-two.md").write_text("")
        for name in ("0001-one.md", "0004-a-gap.md"):
            self.assertFalse(self.findings("decisions", "docs/decisions/" + name, "x"), name)
        self.assertTrue(self.findings("decisions", "docs/decisions/0002-other.md", "x"))

    def test_decisions_without_a_number_are_found(self):
        (self.root / "docs/decisions").mkdir(parents=True, exist_ok=True)
        self.assertTrue(self.findings("decisions", "docs/decisions/why.md", "x"))

    def test_documents_outside_the_repository_are_found(self):
        self.with_physics()
        (self.root / "docs/studies/cost.md").write_text("")
        for line in ("docs/physics.md", "share/doc/sturz/docs/physics.md", "`cost.md`",
                     "[study](../studies/cost.md)", "docs/studies/cost.md:3",
                     "https://example.org/a/other.md", "x.mdx", "a.md5"):
            self.assertFalse(self.findings("references", "docs/decisions/a.md", line), line)
        for line in ("thin.md", "docs/thin.md", "share/doc/sturz/docs/thin.md",
                     "see ../shared/physics2.md", "docs/cost.md"):
            self.assertTrue(self.findings("references", "docs/decisions/a.md", line), line)
            self.assertTrue(self.findings("references", "engine/a.cpp", "// " + line), line)

    def test_a_folder_is_no_drawer(self):
        for k in range(25):
            (self.root / f"io/file_{k}.cpp").write_text("int x;\n")
        self.assertFalse(list(style.CHECKS["folders"](self.root)))
        self.assertTrue(self.findings("folders", "io/one_more.cpp", "int x;\n"))
        self.assertTrue(self.findings("folders", "engine/a.hpp", "struct S {\n};\n" * 61))
        self.assertFalse(self.findings("folders", "reports/a.hpp", "struct S;\n" * 61))

    def test_long_functions_are_found_and_tables_are_not(self):
        body = "  work();\n" * 70
        self.assertTrue(self.findings("functions", "io/a.cpp", "void f(int x) {\n" + body + "}\n"))
        self.assertTrue(self.findings("functions", "io/a.cpp",
                                      "  void f(int x,\n         int y) const {\n" + body + "  }\n"))
        self.assertFalse(self.findings("functions", "io/a.cpp", "constexpr int t[] = {\n" + body + "};\n"))
        self.assertFalse(self.findings("functions", "io/a.cpp", "void f() {\n" + body[:300] + "}\n"))

    def test_pages_and_what_makes_them_agree(self):
        for folder in ("scripts", "docs/studies"):
            (self.root / folder).mkdir(parents=True, exist_ok=True)
        (self.root / "scripts/studies_list.py").write_text(
            'WHOLE, BESIDE = "whole ", "beside "\nMADE = {"a": ("a.md", []), "b": (WHOLE + "b.md", []), "c": ("", []), "d": (BESIDE + "d.md", [])}\n')
        (self.root / "docs/studies/b.md").write_text("no block")
        block = "words\n<!-- made by a -->\n1\n<!-- end -->\n"
        self.assertFalse(self.findings("studies", "docs/studies/a.md", block))
        (self.root / "docs/studies/a.md").write_text(block)
        for text in ("", block.replace("by a", "by e"), block.replace("end", "and"), block + block, block.replace("by a", "by b")):
            self.assertTrue(self.findings("studies", "docs/studies/a.md", text), text)
        self.assertTrue(self.findings("studies", "docs/studies/other.md", block), "on another page")
        (self.root / "docs/studies/a.md").write_text(block)
        self.assertTrue(self.findings("studies", "docs/studies/other.md", block), "on two pages")
        self.assertFalse(list(style.CHECKS["studies"](self.root)))
        (self.root / "docs/studies/b.md").unlink()
        self.assertTrue(list(style.CHECKS["studies"](self.root)), "no whole page")

    def test_the_citation_has_the_projects_version(self):
        (self.root / "CMakeLists.txt").write_text("project(sturz VERSION 1.2.3 LANGUAGES CXX)\n")
        self.assertFalse(self.findings("citation", "CITATION.cff", "title: x\nversion: 1.2.3\n"))
        for text in ("version: 1.2.2\n", "title: x\n", "version: 1.2.34\n"):
            self.assertTrue(self.findings("citation", "CITATION.cff", text), text)
        self.assertTrue(list(style.CHECKS["citation"](self.root)), "no file")


if __name__ == "__main__":
    unittest.main()
