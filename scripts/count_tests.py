#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adds up JUnit files of ctest. Usage: count_tests.py FILE..."""
import pathlib
import sys
import xml.etree.ElementTree as tree


def main(files):
    passed, skipped, failed = 0, [], []
    for name in files:
        if not pathlib.Path(name).is_file():
            failed.append(f"{name} was not written")
            continue
        cases = list(tree.parse(name).getroot().iter("testcase"))
        if not cases:
            failed.append(f"{name} holds no test")
        for case in cases:
            status = case.get("status")
            if status == "run":
                passed += 1
            elif status in ("notrun", "disabled") and case.find("skipped") is not None \
                    and "SKIP" in (case.find("skipped").get("message") or "").upper():
                skipped.append(case.get("name"))
            else:
                failed.append(case.get("name"))
    for name in skipped:
        print("skipped:", name)
    for name in failed:
        print("FAILED:", name)
    print(f"{passed} passed, {len(failed)} failed")
    return 1 if failed or passed == 0 else 0


sys.exit(main(sys.argv[1:]))
