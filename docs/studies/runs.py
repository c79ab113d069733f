# SPDX-License-Identifier: Apache-2.0
"""Runs of the studies: one scene, one thread, kept where it was made."""
import hashlib
import json
import pathlib
import subprocess


def kept(folder, program, text, make):
    """What make(scene file) gave for this scene by this very program: from the folder where it is there, else made and kept."""
    made_of = hashlib.sha256(pathlib.Path(program).read_bytes() + text.encode()).hexdigest()
    folder.mkdir(parents=True, exist_ok=True)
    scene, store = folder / "scene.yaml", folder / "kept.json"
    if store.exists() and (found := json.loads(store.read_text()))["made_of"] == made_of:
        return found["result"]
    scene.write_text(text)
    result = make(scene)
    store.write_text(json.dumps({"made_of": made_of, "result": result}))
    return result


def output(command, scene):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{scene}: {done.stdout[-1000:]}{done.stderr[-1000:]}")
    return done.stdout


def run(sturz, folder, text):
    """Scalars of the run of a scene; its maps are in folder/out."""
    def make(scene):
        lines = output([sturz, "run", scene, "-o", folder / "out", "--replace", "--threads", "1", "--json"], scene).splitlines()
        return [json.loads(line) for line in lines if '"done"' in line][-1]["scalars"]
    return kept(folder, sturz, text, make)
