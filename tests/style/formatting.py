#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Names every C++ file that clang-format 14 would lay out otherwise. Usage: formatting.py ROOT"""
import pathlib
import re
import shutil
import subprocess
import sys

SUFFIXES = (".cpp", ".hpp")
WANTED = "14"  # other versions break lines elsewhere


def formatter():
    for name in (f"clang-format-{WANTED}", "clang-format"):
        program = shutil.which(name)
        if program is None:
            continue
        text = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
        if re.search(rf"version {WANTED}\.", text.stdout):
            return program
    sys.exit(f"clang-format {WANTED} is not here (Debian 12: apt-get install clang-format).")


def tracked(root):
    """Files of the repository; of an unpacked archive, whatever is not built."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, check=False)
    if listed.returncode == 0:
        names = [name for name in listed.stdout.decode().split("\0") if name]
    else:
        names = [str(path.relative_to(root)) for path in root.rglob("*")
                 if path.relative_to(root).parts[0] != "build"]
    return sorted(name for name in names if name.endswith(SUFFIXES) and (root / name).is_file())


def main(root):
    root = pathlib.Path(root)
    names = tracked(root)
    told = subprocess.run([formatter(), "--dry-run", "--ferror-limit=1", *names], cwd=root,
                          capture_output=True, text=True, check=False)
    wrong = sorted(set(re.findall(r"^(\S+?):\d+:\d+: .*clang-format", told.stderr, re.M)))
    for name in wrong:
        print(f"{name}: not formatted. Run: clang-format -i {name}")
    if told.returncode != 0 and not wrong:
        print(told.stderr)
    return 1 if wrong or told.returncode != 0 or not names else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
