# SPDX-License-Identifier: Apache-2.0
"""Random members of grains in a liquid: what the hard suite's test prints of each, gathered by scene.

usage: random_mixtures.py HARD_MIXTURES_TEST [N]     N members (300), about half a second each
HARD_MIXTURES_TEST is build/.../tests/hard/hard_mixtures_test; tests/hard/coupled/random_mixtures.hpp says what is drawn.
"""
import os
import re
import subprocess
import sys

MEMBER = re.compile(r"^mixture, member (\d+), (?P<scene>.*?): (?P<stopped>.*?) ?solids .*?, (\d+) particles, (\d+) steps, (?P<seconds>\S+) s, "
                    r"residual (?P<residual>\S+), numerical (?P<numerical>\S+), speed (?P<speed>\S+), least step (?P<step>\S+)$", re.M)
MISSED = re.compile(r"^hard: mixture, member (\d+), (.*?), ([^,|]+) \|.*: missed$", re.M)
COUNTED = (("NaN", "members with NaN"), ("stopped early", "members stopped early"), ("leaked", "leaked share of the mass"), ("mass off", "mass error"),
           ("speed beyond 1.05", "largest speed / (free fall + 2 sqrt(g H))"), ("residual beyond 1 %", "energy residual"),
           ("step under 0.05", "least step / first"))


def main(binary, n="300"):
    environment = {**os.environ, "STURZ_HARD_MEMBERS": n}
    text = subprocess.run([binary, "--gtest_filter=RandomMixtures.*"], env=environment, capture_output=True, text=True).stdout
    members = [m.groupdict() for m in MEMBER.finditer(text)]
    missed = MISSED.findall(text)
    known = {name for _, name in COUNTED}
    strange = {what for _, _, what in missed} - known
    if len(members) != int(n) or strange:
        sys.exit(f"{len(members)} of {n} members were printed; unknown checks: {strange}\n{text[-2000:]}")
    heads = ["scene", "members", *(head for head, _ in COUNTED), "largest residual", "numerical, least and most", "largest speed", "shortest step"]
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for scene in dict.fromkeys(m["scene"] for m in members):
        of = [m for m in members if m["scene"] == scene]
        counts = [sum(s == scene and what == name for _, s, what in missed) for _, name in COUNTED]
        values = {key: [float(m[key]) for m in of] for key in ("residual", "numerical", "speed", "step")}
        row = [scene, len(of), *counts, f"{100 * max(values['residual']):.1f} %", f"{min(values['numerical']):.2f}, {max(values['numerical']):.2f}",
               f"{max(values['speed']):.2f}", f"{min(values['step']):.2f}"]
        print("| " + " | ".join(map(str, row)) + " |")
    beyond = sorted({int(number) for number, _, _ in missed})
    print(f"\n{sum(float(m['seconds']) for m in members):.0f} s for {len(members)} members. Beyond a bound: members {', '.join(map(str, beyond))}.")


if __name__ == "__main__":
    main(*sys.argv[1:])
