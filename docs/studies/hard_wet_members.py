# SPDX-License-Identifier: Apache-2.0
"""Wet members from the whole prior on ground that wants to break them, each beside its dry twin: the worst of all.

usage: hard_wet_members.py HARD_COLUMNS_TEST synthetic|mountain FIRST LAST [LINES]
HARD_COLUMNS_TEST is build/.../tests/hard/hard_columns_test. `mountain` needs ../shared/data/marsicano_tinitaly beside the
repository. Prints what the test prints for every 25 members, their sum, and failed checks; the lines of all members go to the file
LINES.
"""
import os
import re
import subprocess
import sys

TESTS = {"synthetic": "SteepGround.WetColumnsSurviveEveryCorner", "mountain": "SteepGround.WetColumnsSurviveMonteMarsicano"}
AT_ONCE = 25
LARGEST = (("energy residual", r"energy residual <= (\S+),"), ("mass error", r"mass error <= (\S+),"),
           ("speed over free fall", r"speed <= (\S+) of"), ("grains and water", r"grains and water to (\S+);"),
           ("time of a step over the dry twin's", r"a step at most (\S+) times"), ("mass lost inside", r"lost inside <= (\S+),"),
           ("steps a second over the dry twin's", r"steps a second at most (\S+) times"))
SUMS = (("not finite", r"(\d+) members not finite"), ("pressure out of bounds", r"(\d+) with a pressure"),
        ("over 1 % of energy", r"(\d+) over 1 %"))


def chunk(binary, which, first, n):
    environment = {**os.environ, "STURZ_HARD_MEMBERS": str(n), "STURZ_HARD_FIRST": str(first), "STURZ_HARD_TELL": "1"}
    return subprocess.run([binary, f"--gtest_filter={TESTS[which]}"], env=environment, capture_output=True, text=True).stdout


def main(binary, which, first, last, lines=""):
    worst, sums, outcomes, failed = {}, {}, {}, 0
    for begin in range(int(first), int(last), AT_ONCE):
        n = min(AT_ONCE, int(last) - begin)
        text = chunk(binary, which, begin, n)
        if lines:
            with open(lines, "a", encoding="utf-8") as file:
                file.writelines(line + "\n" for line in text.splitlines() if line.startswith("member "))
        failed += text.count(": Failure")
        wet = next((line for line in text.splitlines() if re.match(r"\d+ members in", line)), "")
        summary = wet + " " + next((line for line in text.splitlines() if line.startswith("grains and water")), "")
        if not wet:
            print(f"members {begin} to {begin + n - 1}: no summary\n{text[-2000:]}")
            continue
        for name, count in re.findall(r"(\w+) (\d+),", wet.split(" s:")[1].split("energy")[0] + ","):
            outcomes[name] = outcomes.get(name, 0) + int(count)
        for name, pattern in LARGEST:
            worst[name] = max(worst.get(name, 0), float(re.search(pattern, summary)[1]))
        for name, pattern in SUMS:
            sums[name] = sums.get(name, 0) + int(re.search(pattern, summary)[1])
        print(f"members {begin} to {begin + n - 1}: {summary}", flush=True)
    print(f"\n{which}, members {first} to {int(last) - 1}: {outcomes}; {failed} failed checks; "
          + "; ".join(f"{name} at most {value:.2g}" for name, value in worst.items()) + "; "
          + "; ".join(f"{count} {name}" for name, count in sums.items()))


if __name__ == "__main__":
    main(*sys.argv[1:])
