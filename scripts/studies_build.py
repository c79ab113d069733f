# SPDX-License-Identifier: Apache-2.0
"""Whether the programs that a study runs are built from the sources on disk.

A program that was built before the last change measures older code, and its figures would be recorded as those of this code. What
a program is built from is known by ninja alone, sources and headers; all of it outside the build folder has to be older than the program.
(`ninja -n` cannot tell: it takes each program for old, because CMake looks for new sources before every build.)
"""
import hashlib
import json
import os
import pathlib
import subprocess


def programs_of(build, commands):
    """Paths below the build folder that the commands run or hand on, and the programs of the tests that ctest would run."""
    found = {word for command in commands for word in command if word.startswith(f"{build}/") and pathlib.Path(word).suffix in ("", ".so")}
    for command in commands:
        if command[:1] == ["ctest"]:
            found |= tests_of(build, command)
    return sorted(found)


def tests_of(build, command):
    """Programs of the build folder that a ctest command would run. Others wait for programs that they only start, and are not built anew with them."""
    told = subprocess.run([*command, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
    tests = json.loads(told[told.index("{"):])["tests"]
    return {test["command"][0] for test in tests if "command" in test and test["command"][0].startswith(f"{build}/")}


def ninja(build, *arguments):
    return subprocess.run(["ninja", "-C", build, *arguments], capture_output=True, text=True, check=True).stdout.splitlines()


def inputs_of(build, program):
    """Paths of all that a program is made from outside the build folder, headers too."""
    inputs = {line.strip() for line in ninja(build, "-t", "inputs", program.removeprefix(f"{build}/"))}
    headers, wanted = set(), False
    for line in ninja(build, "-t", "deps"):  # "OBJECT: #deps 3, ..." and an indented line for each
        if line.startswith(" "):
            if wanted:
                headers.add(line.strip())
        elif line:
            wanted = line.split(": #deps", 1)[0] in inputs
    paths = {os.path.normpath(os.path.join(build, path)) for path in inputs | headers}
    return sorted(path for path in paths if not path.startswith(f"{os.path.normpath(build)}/") and os.path.isfile(path))


def out_of_date(build, commands):
    """Why what the commands run is not built from the sources on disk; "" when it is."""
    for program in programs_of(build, commands):
        path = pathlib.Path(program)
        if not path.is_file():
            return f"{program} is not there"
        try:
            newer = [source for source in inputs_of(build, program) if os.stat(source).st_mtime_ns > path.stat().st_mtime_ns]
        except subprocess.CalledProcessError as problem:
            return f"ninja cannot tell what {program} is built from: {(problem.stderr or problem.stdout).strip()[-300:]}"
        if newer:
            return f"{path.name} is older than {len(newer)} of the files that it is built from, such as {newer[0]}"
    return ""


def make_current(build, commands):
    """Builds what of the commands' programs is not there or older than its sources. \return why that failed; "" when all is built"""
    old = out_of_date(build, commands)
    if not old or not pathlib.Path(build, "build.ninja").is_file():
        return old
    done = subprocess.run(["ninja", "-C", build, *(program.removeprefix(f"{build}/") for program in programs_of(build, commands))],
                          capture_output=True, text=True, check=False)
    return out_of_date(build, commands) if done.returncode == 0 else f"{old}, and building it failed: {done.stdout.strip()[-1000:]}"


def identity(build, commands):
    """Hash of the programs themselves: it says whether one was built anew while a study ran."""
    whole = hashlib.sha256()
    for program in programs_of(build, commands):
        whole.update(pathlib.Path(program).read_bytes())
    return whole.hexdigest()
