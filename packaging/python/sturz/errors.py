# SPDX-License-Identifier: Apache-2.0
"""What can go wrong, as exceptions that name the key, what is wrong and what would be right."""
from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any


class SturzError(Exception):
    """Anything that sturz refuses or cannot do."""


class SturzWarning(UserWarning):
    """What a scene or its results warn of; the work goes on."""


class Missing(SturzError, ImportError):
    """A package or program that this call needs is not installed; the text says which."""


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong with a scenario."""

    key: str  #: dotted path, such as ``basal.friction_coefficient``; empty where no key is to blame
    wrong: str  #: what is wrong, with the value
    right: str  #: what would be right; empty where the first sentence says it
    line: int | None = None  #: in the scenario file, from 1
    column: int | None = None

_PLACE = re.compile(r"^(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+): (?P<rest>.*)$", re.DOTALL)
_KEY = re.compile(r"^([a-z][a-z0-9_]*(?:\[\d+\])?(?:\.[a-z0-9_]+(?:\[\d+\])?)*)(?= = | \(|:(?:\s|$))")
_REMEDY = re.compile(r"\((must [^()]*)\)")


def problem_of(line: str) -> Problem:
    """The parts of one line of the program: ``[file:line:column: ]key = value (why). Suggestion.``"""
    place = _PLACE.match(line)
    rest = place["rest"] if place else line
    key = _KEY.match(rest)
    end = rest.find("). ")
    wrong, right = (rest[:end + 2], rest[end + 3:]) if end >= 0 else (rest, "")
    remedy = _REMEDY.search(wrong)
    return Problem(key[1] if key else "", wrong.strip(), right.strip() or (remedy[1] if remedy else ""),
                   int(place["line"]) if place else None, int(place["column"]) if place else None)


class ScenarioError(SturzError, ValueError):
    """A scenario, or what it was called with, that cannot be computed. All problems at once."""

    def __init__(self, text: str):
        super().__init__(text)
        #: every problem with its key
        self.problems: list[Problem] = [problem_of(line) for line in text.splitlines() if line.strip()]

    @property
    def keys(self) -> list[str]:
        """The keys that are to blame, in the order of the problems."""
        return [problem.key for problem in self.problems if problem.key]


class MembersFailed(SturzError):
    """More members failed than the scene allows. Maps were made of the others all the same."""

    def __init__(self, text: str, results: Any = None):
        super().__init__(text)
        self.results = results  #: what was computed, as the call would have returned it
