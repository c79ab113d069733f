#!/usr/bin/env python3
"""Known misses of the physics tests: what a run of them left, beside the list that excuses them.

    rm -f build/release/tests/physics/results.csv
    ctest --test-dir build/release -L "physics|hard"
    scripts/misses.py build/release/tests/physics/results.csv            # prints every miss
    scripts/misses.py --write build/release/tests/physics/results.csv    # and writes the list anew

The list is tests/physics/results/known_misses.csv. Its figures come from runs only: --write takes over
what was measured, keeps `since` and `why` of lines that were listed, drops lines that are met again and
gives new ones the date of the results and the reason "not looked into". Lines that the run did not have
stay as they are and are named. Exit code 1 where list and results differ.
"""
import csv
import datetime
import os
import sys

HEAD = ["name", "quantity", "measured", "error", "asked", "since", "why"]
LIST = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "physics", "results",
                    "known_misses.csv")


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def new_list(results, listed, today):
    """The list as the results have it: {name: row}, sorted by name."""
    kept = dict(listed)
    for row in results:
        name = row["case"]
        if row["verdict"] == "missed":
            old = listed.get(name, {})
            kept[name] = {"name": name, "quantity": row["quantity"], "measured": row["measured"],
                          "error": row["error"], "asked": row["tolerance"],
                          "since": old.get("since", today), "why": old.get("why", "not looked into")}
        else:
            kept.pop(name, None)
    return dict(sorted(kept.items()))


def differences(results, listed):
    """One sentence for each line on which list and results do not agree."""
    verdicts = {row["case"]: row["verdict"] for row in results}
    for name in sorted(set(verdicts) | set(listed)):
        missed = verdicts.get(name) == "missed"
        if missed and name not in listed:
            yield f"not listed: {name}"
        elif name in listed and name not in verdicts:
            yield f"listed, but no test ran it: {name}"
        elif name in listed and not missed:
            yield f"no longer missed: {name}"


def write(rows, path):
    def quoted(text):
        return '"' + text.replace('"', "'") + '"'
    with open(path, "w", encoding="utf-8") as file:
        file.write(",".join(HEAD) + "\n")
        for r in rows.values():
            file.write(",".join([quoted(r["name"]), quoted(r["quantity"]), r["measured"], r["error"], r["asked"],
                                 quoted(r["since"]), quoted(r["why"])]) + "\n")


def main(arguments):
    results_path = arguments[-1]
    results, listed = rows_of(results_path), {r["name"]: r for r in rows_of(LIST)}
    today = datetime.date.fromtimestamp(os.path.getmtime(results_path)).isoformat()
    rows = new_list(results, listed, today)
    for r in rows.values():
        print(f"{r['name']}: {r['quantity']} {float(r['measured']):.4g}, error {float(r['error']):.4g} of "
              f"{float(r['asked']):.4g}, since {r['since']}: {r['why']}")
    said = list(differences(results, listed))
    print(f"{len(rows)} misses" + "".join("\n" + line for line in said), file=sys.stderr)
    if "--write" in arguments:
        write(rows, LIST)
    return 1 if said else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or (len(sys.argv) == 3 and sys.argv[1] != "--write"):
        sys.exit("usage: misses.py [--write] tests/physics/results.csv")
    sys.exit(main(sys.argv[1:]))
