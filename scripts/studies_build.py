# SPDX-License-Identifier: Apache-2.0
"""Whether the programs that a study runs are built from the sources on disk.

A program that was built before the last change measures older code, and its figures would be recorded as those of this code. What
has to be built anew is known by ninja alone, which has the headers of each program; so it is asked (`ninja -n` builds nothing).
"""
import hashlib
import pathlib
import re
import subprocess

WORK = re.compile(r"Re-running CMake|\.o(bj)?$|Building|Linking|Generating|-> ")


def programs_of(build, commands):
    """Paths below the build folder that the commands run or hand on, and `all` where ctest runs whatever there is."""
    found = set()
    for command in commands:
        found |= {word for word in command if word.startswith(f"{build}/") and pathlib.Path(word).suffix in ("", ".so")}
        if command[:1] == ["ctest"]:
            found.add("all")
    return sorted(found)


def out_of_date(build, commands):
    """Why what the commands run is not built from the sources on disk; "" when it is."""
    programs = programs_of(build, commands)
    for program in programs:
        if program != "all" and not pathlib.Path(program).is_file():
            return f"{program} is not there"
    if not programs:
        return ""
    targets = [program.removeprefix(f"{build}/") for program in programs]
    asked = subprocess.run(["ninja", "-C", build, "-n", *targets], capture_output=True, text=True)
    if asked.returncode != 0:
        return f"ninja cannot tell whether {', '.join(targets)} is built: {(asked.stderr or asked.stdout).strip()[-300:]}"
    steps = [line for line in asked.stdout.splitlines() if WORK.search(line)]
    if not steps:
        return ""
    return f"{', '.join(targets)}: older than the sources, {len(steps)} steps to build, such as {steps[0].split('] ', 1)[-1]}"


def identity(build, commands):
    """Hash of the programs themselves: it says whether one was built anew while a study ran."""
    whole = hashlib.sha256()
    for program in programs_of(build, commands):
        if program != "all":
            whole.update(pathlib.Path(program).read_bytes())
    return whole.hexdigest()
