# SPDX-License-Identifier: Apache-2.0
"""Scenarios as dictionaries: built, changed, written as YAML, checked by the program's own rules."""
from __future__ import annotations

import copy
import json
import os
import re
import subprocess
import tempfile
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any, Iterator, Mapping, Union

from .errors import Missing, SturzError
from .program import program


def plain(value: Any) -> Any:
    """The value with numpy's numbers and arrays, paths and tuples as what YAML knows."""
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(entry) for entry in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):  # numpy
        return plain(value.tolist())
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    raise SturzError(f"{value!r} ({type(value).__name__} has no place in a scenario). Use numbers, "
                     "texts, lists and dictionaries.")


@lru_cache(maxsize=1)
def _loader(yaml: Any) -> Any:
    """Reads plain words as the program does (YAML 1.2, core schema). PyYAML's own are of YAML 1.1, where
    1e6 and 1.5e6 are texts, 012 is 10, 1:30 is 90 and `on` is true."""
    class Loader(yaml.SafeLoader):
        yaml_implicit_resolvers: dict[str, Any] = {}

    for kind, pattern, first in (("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
                                 ("bool", r"true|True|TRUE|false|False|FALSE", list("tTfF")),
                                 ("int", r"[-+]?[0-9]+", list("-+0123456789")),
                                 ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?"
                                           r"|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)", list("-+.0123456789"))):
        Loader.add_implicit_resolver(f"tag:yaml.org,2002:{kind}", re.compile(f"^(?:{pattern})$"), first)
    Loader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value))
    return Loader


class Scenario:
    """One scene: what a scenario file says, as a dictionary.

    Args:
        data: blocks and keys as in the user guide. Any number that may be uncertain may be a
            distribution in its place, such as ``{"uniform": [0.1, 0.3]}``.
        folder: where relative paths of inputs start.
        name: of results folders that nobody named.

    Nothing is checked here but that YAML can hold it: `check`, and every command, ask the program.
    """

    def __init__(self, data: Mapping[str, Any], folder: str | os.PathLike[str] = ".",
                 name: str = "scenario"):
        self.data: dict[str, Any] = plain(data)
        self.folder = Path(folder)
        self.name = name

    @classmethod
    def read(cls, file: str | os.PathLike[str]) -> "Scenario":
        """A scenario file as a dictionary that can be changed (needs python3-yaml)."""
        try:
            import yaml
        except ImportError as missing:
            raise Missing("Reading YAML needs python3-yaml (apt-get install python3-yaml).") from missing
        path = Path(file)
        with open(path, encoding="utf-8") as text:
            data = yaml.load(text, _loader(yaml))
        if not isinstance(data, dict):
            raise SturzError(f"{path} (must be a YAML mapping of blocks and keys).")
        return cls(data, path.parent, path.stem)

    def __getitem__(self, key: str) -> Any:
        """The value of a dotted key, or a block."""
        value: Any = self.data
        for part in key.split("."):
            value = value[part]
        return value

    def with_values(self, values: Mapping[str, Any] | None = None, **blocks: Any) -> "Scenario":
        """A changed copy. ``values`` by dotted keys, None removes one; whole blocks by name."""
        changed = copy.deepcopy(self.data)
        for key, value in {**(values or {}), **blocks}.items():
            *way, last = key.split(".")
            block = changed
            for part in way:
                block = block.setdefault(part, {})
                if not isinstance(block, dict):
                    raise SturzError(f"{key} ({part} is a value, no block).")
            if value is None:
                block.pop(last, None)
            else:
                block[last] = plain(value)
        return Scenario(changed, self.folder, self.name)

    def to_yaml(self) -> str:
        """As a scenario file has it. Without python3-yaml it is JSON, which YAML includes."""
        try:
            import yaml
        except ImportError:
            return json.dumps(self.data, indent=2, ensure_ascii=False) + "\n"
        return yaml.safe_dump(self.data, sort_keys=False, allow_unicode=True, default_flow_style=None)

    def write(self, file: str | os.PathLike[str]) -> Path:
        """Writes it; relative paths of inputs then start at that file."""
        path = Path(file)
        path.write_text(self.to_yaml(), encoding="utf-8")
        return path

    def check(self) -> None:
        """Raises ScenarioError with everything that is wrong with it and its files."""
        from .commands import check
        check(self)

    def __repr__(self) -> str:
        return f"Scenario({self.data.get('title', self.name)!r}: {', '.join(self.data)})"


#: What commands take: a scenario, its dictionary, or a file.
SceneLike = Union[Scenario, Mapping[str, Any], str, "os.PathLike[str]"]


def name_of(scene: SceneLike) -> str:
    """Of results folders that nobody named."""
    if isinstance(scene, Scenario):
        return scene.name
    return "scenario" if isinstance(scene, Mapping) else Path(scene).stem


def no_option(path: str | os.PathLike[str]) -> str:
    """A path as a word of a command line: a name that begins with a dash is no option."""
    text = os.fspath(path)
    return f"./{text}" if text.startswith("-") else text


@contextmanager
def as_file(scene: SceneLike) -> Iterator[str]:
    """The scene as a file that the program can read; a dictionary's is gone afterwards."""
    if isinstance(scene, (str, os.PathLike)):
        yield no_option(scene)
        return
    scenario = scene if isinstance(scene, Scenario) else Scenario(scene)
    with tempfile.NamedTemporaryFile("w", prefix=f".{Path(scenario.name).name}-", suffix=".yaml",
                                     dir=scenario.folder, encoding="utf-8") as file:
        file.write(scenario.to_yaml())
        file.flush()
        yield file.name


@lru_cache(maxsize=1)
def schema() -> dict[str, Any]:
    """The JSON Schema of scenario files, from the program."""
    done = subprocess.run([program(), "schema"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def explain(key: str) -> dict[str, Any]:
    """What the schema says of a dotted key: description, range, default.

    Raises:
        KeyError: for a key that no scenario may hold.
    """
    entry = schema()
    for part in key.split("."):
        entry = entry.get("properties", {})[part]
    return entry
