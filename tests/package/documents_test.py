#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Manual page and completion say what `--help` says. Usage: documents_test.py PROGRAM"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)


def output(*arguments):
    return subprocess.run([PROGRAM, *arguments], text=True, capture_output=True, check=True).stdout


def options_of(text):
    """Every -x and --word in the option column of a help text."""
    column = "\n".join(re.findall(r"^  (-\S*(?:,-\S*)*)", text, re.M))
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", column))


HELP = output("--help")
COMMANDS = re.findall(r"^  ([a-z][a-z-]*) ", HELP.split("Subcommands:")[1], re.M)
PAGE = output("print-help", "man")
SCRIPT = output("print-help", "bash")


class Documents(unittest.TestCase):
    def complete(self, *words, folder=None):
        """What bash offers for the last of `words`."""
        code = SCRIPT + '\nCOMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _sturz; printf "%s\\n" "${COMPREPLY[@]}"'
        done = subprocess.run(["bash", "-c", code, "-", PROGRAM, *words], text=True, capture_output=True,
                              cwd=folder)
        self.assertEqual(done.stderr, "")
        return set(done.stdout.splitlines()) - {""}

    def section(self, command):
        return re.search(rf"^\.SS sturz {command}\n(.*?)(?=^\.S[SH])", PAGE, re.M | re.S).group(1)

    def test_help_was_understood(self):
        self.assertIn("ensemble", COMMANDS)
        self.assertGreaterEqual(len(COMMANDS), 8)
        self.assertLessEqual({"-n", "--members", "--retry-failed"}, options_of(output("ensemble", "--help")))

    def test_every_option_is_in_the_manual_page(self):
        for command in COMMANDS:
            text = self.section(command).replace("\\-", "-")
            for option in options_of(output(command, "--help")):
                self.assertRegex(text, rf"\\fB{option}\\fR", command)
        for option in options_of(HELP):
            self.assertIn(f"\\fB{option}\\fR", PAGE.replace("\\-", "-"))

    def test_every_option_is_completed(self):
        for command in COMMANDS:
            self.assertEqual(self.complete(command, "-"), options_of(output(command, "--help")), command)
        self.assertEqual(self.complete("-"), options_of(HELP))

    def test_sub_commands_are_completed_and_hidden_ones_are_not(self):
        self.assertEqual(self.complete(""), set(COMMANDS))
        self.assertEqual(self.complete("en"), {"ensemble"})
        self.assertNotIn("print-help", PAGE.replace("\\-", "-"))

    def test_values_are_completed_by_their_kind(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "a slope.yaml").touch()
            (folder / "a.txt").touch()
            (folder / "afar").mkdir()
            self.assertEqual(self.complete("run", "a", folder=folder), {"a slope.yaml", "afar"})
            self.assertEqual(self.complete("run", "a.yaml", "-o", "a", folder=folder), {"afar"})
            self.assertEqual(self.complete("run", "--out", "=", "a", folder=folder), {"afar"})
            self.assertEqual(self.complete("run", "--out", "=", folder=folder), {"afar"})
            self.assertEqual(self.complete("run", "--threads", "a", folder=folder), set())
            self.assertEqual(self.complete("schema", "-o", "a", folder=folder),
                             {"a slope.yaml", "a.txt", "afar"})
        self.assertEqual(self.complete("cases", "z"), {"zhangjiawan"})
        self.assertIn("plane", self.complete("terrain", "pl"))

    def test_the_completion_registers_itself(self):
        done = subprocess.run(["bash", "-c", SCRIPT + "\ncomplete -p sturz"], text=True, capture_output=True)
        self.assertEqual(done.stdout.strip(), "complete -F _sturz sturz")

    def test_the_manual_page_renders_without_warnings(self):
        if not shutil.which("man"):
            self.skipTest("man is not installed")
        with tempfile.NamedTemporaryFile("w", suffix=".1") as file:
            file.write(PAGE)
            file.flush()
            for columns in ("80", "120"):
                done = subprocess.run(["man", "--warnings", "-l", file.name], text=True, capture_output=True,
                                      env=dict(os.environ, MANWIDTH=columns, LC_ALL="C.UTF-8"))
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("EXIT STATUS", done.stdout)


if __name__ == "__main__":
    unittest.main()
