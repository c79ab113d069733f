# SPDX-License-Identifier: Apache-2.0
"""scripts/studies_made.py on a root of one study: what it must find, and what it must leave alone."""
import json
import os
import pathlib
import shutil
import sys
import tempfile
import time
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import studies_build  # noqa: E402
import studies_made  # noqa: E402

LIST = """
import typing
class Study(typing.NamedTuple):
    page: str
    commands: tuple
    sources: tuple
    minutes: float = 0
    by_hand: str = ""
MADE = {"slide": Study("slide.md", (["python3", "docs/studies/slide.py"],), ("engine/laws", "engine/effects/*"), 2)}
def pages_of(study):
    return (study.page,)
"""


class StudiesMade(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        self.write("scripts/studies_list.py", LIST)
        self.write("engine/laws/friction.hpp", "// why\nint f();\n")
        self.write("engine/effects/step.cpp", "int g;\n")
        self.write("engine/effects/other/far.cpp", "int h;\n")
        self.write("docs/studies/slide.py", "import helper\n")
        self.write("docs/studies/helper.py", "x = 1\n")
        self.write("docs/studies/slide.md", "words\n")
        self.write("docs/studies/README.md", f"words\n{studies_made.BEGIN}\n{studies_made.END}\n")
        self.remake()
        self.assertEqual(studies_made.problems(self.root), [])
        self.assertEqual(studies_made.stale(self.root), [])

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def remake(self):
        made, _ = studies_made.declared(self.root)
        studies_made.keep(self.root, "slide", {"command": "python3 slide.py", "date": "2026-01-02", "machine": "x", "commit": "abc",
                                               "sources": studies_made.hash_now(self.root, made["slide"])})
        studies_made.write_table(self.root)

    def found(self, word):
        problems = studies_made.problems(self.root)
        self.assertTrue(any(word in line for line in problems), problems)

    def test_code_that_changed_makes_a_study_older_and_the_table_must_say_so(self):
        for path, text in (("engine/laws/friction.hpp", "int f(int);\n"), ("engine/effects/step.cpp", "int g = 1;\n"),
                           ("docs/studies/helper.py", "x = 2\n"), ("engine/laws/new.cpp", "int n;\n")):
            self.write(path, text)
            self.assertEqual(studies_made.stale(self.root), ["slide"], path)
            self.found("older than the code")
            studies_made.write_table(self.root)
            self.assertEqual(studies_made.problems(self.root), [], "an older study is told, and fails nothing")
            self.write(path, text + "int more;\n" if path.endswith("pp") else text + "y = 1\n")
            self.assertEqual(studies_made.problems(self.root), [], "nor does the next change")
            self.remake()

    def test_comments_blanks_and_code_that_is_not_measured_change_nothing(self):
        self.write("engine/laws/friction.hpp", "// another reason\n\n  int f();\n")
        self.write("engine/effects/other/far.cpp", "int h = 2;\n")
        self.assertEqual(studies_made.stale(self.root), [])

    def test_what_nobody_declares_is_found(self):
        self.write("docs/studies/lost.md", "words\n")
        self.found("docs/studies/lost.md")
        (self.root / "docs/studies/lost.md").unlink()
        self.write("docs/studies/lost.py", "x = 1\n")
        self.found("docs/studies/lost.py")

    def test_what_is_declared_and_missing_is_found(self):
        for path, word in (("docs/studies/slide.md", "its page"), ("docs/studies/slide.py", "its script"), ("engine/laws/friction.hpp", "its source")):
            text = (self.root / path).read_text()
            (self.root / path).unlink()
            self.found(word)
            self.write(path, text)

    def test_records_are_whole_and_belong_to_a_study(self):
        whole = studies_made.records(self.root)
        for field in studies_made.FIELDS:
            lacking = {"slide": {key: value for key, value in whole["slide"].items() if key != field}}
            self.write("docs/studies/made.json", json.dumps(lacking))
            self.found(f"lacks {field}")
        self.write("docs/studies/made.json", json.dumps(whole | {"gone": whole["slide"]}))
        self.found("gone is no study")

    def test_a_study_needs_a_command_or_a_reason(self):
        self.write("scripts/studies_list.py", LIST.replace('(["python3", "docs/studies/slide.py"],)', "()"))
        self.found("does not say why")

    def test_a_table_that_was_edited_is_found(self):
        page = self.root / "docs/studies/README.md"
        page.write_text(page.read_text().replace("2026-01-02", "2026-12-31"))
        self.found("2026-12-31")


    def test_a_record_that_is_interrupted_leaves_the_old_ones(self):
        before = (self.root / "docs/studies/made.json").read_text()
        with unittest.mock.patch("os.fsync", side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
            studies_made.keep(self.root, "other", {"date": "2026-01-03"})
        self.assertEqual((self.root / "docs/studies/made.json").read_text(), before)
        self.assertEqual([path.name for path in (self.root / "docs/studies").iterdir() if path.name.startswith(".")], [])


@unittest.skipUnless(shutil.which("ninja"), "needs ninja")
class StudiesBuild(unittest.TestCase):
    """A program that is one source, copied by ninja."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = pathlib.Path(folder.name).resolve()
        (self.build / "build").mkdir()
        (self.build / "build/build.ninja").write_text(
            "rule compile\n  command = cp $in $out && echo $out: $in ../part.hpp > $out.d\n  depfile = $out.d\n  deps = gcc\n"
            "rule link\n  command = cp $in $out\nbuild one.o: compile ../source.cpp\nbuild sturz: link one.o\nbuild bench: link one.o\n")
        for name in ("source.cpp", "part.hpp", "other.hpp"):
            (self.build / name).write_text("int f();\n")
        self.build = self.build / "build"
        self.commands = [["python3", "study.py", f"{self.build}/sturz", f"{self.build}/out.json"]]
        self.make("sturz")

    def make(self, target):
        studies_build.subprocess.run(["ninja", "-C", self.build, target], check=True, capture_output=True)

    def old(self):
        return studies_build.out_of_date(str(self.build), self.commands)

    def test_a_program_of_these_sources_is_taken_and_an_older_one_is_not(self):
        self.assertEqual(studies_build.programs_of(str(self.build), self.commands), [f"{self.build}/sturz"])
        self.assertEqual(self.old(), "")
        later = time.time() + 5
        os.utime(self.build.parent / "other.hpp", (later, later))
        self.assertEqual(self.old(), "", "it is not built from that")
        for name in ("source.cpp", "part.hpp"):
            os.utime(self.build.parent / name, (later, later))
            self.assertEqual(self.old(), f"sturz is older than 1 of the files that it is built from, such as {self.build.parent}/{name}")
            os.utime(self.build.parent / name, (1, 1))

    def test_a_program_that_is_not_there_is_named(self):
        self.commands.append([f"{self.build}/bench", "throughput"])
        self.assertIn("bench is not there", self.old())

    def test_what_is_missing_or_old_is_built_and_a_failure_is_told(self):
        self.commands.append([f"{self.build}/bench", "throughput"])
        (self.build.parent / "source.cpp").write_text("int g();\n")
        self.assertEqual(studies_build.make_current(str(self.build), self.commands), "")
        self.assertEqual([(self.build / name).read_text() for name in ("sturz", "bench")], ["int g();\n"] * 2)
        (self.build.parent / "source.cpp").unlink()
        (self.build / "bench").unlink()
        self.assertIn("building it failed", studies_build.make_current(str(self.build), self.commands))
        (self.build / "build.ninja").unlink()
        self.assertIn("is not there", studies_build.make_current(str(self.build), self.commands))

    def test_a_program_that_was_built_anew_is_another(self):
        before = studies_build.identity(str(self.build), self.commands)
        (self.build / "sturz").write_text("int g();\n")
        self.assertNotEqual(studies_build.identity(str(self.build), self.commands), before)


if __name__ == "__main__":
    unittest.main()
