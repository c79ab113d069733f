# SPDX-License-Identifier: Apache-2.0
"""How far a call is: a bar on the screen, or the caller's own function."""
from __future__ import annotations

import shutil
import sys
import time
from typing import Any, Callable, Union

from .program import Event

#: True: a bar; False: nothing; None: a bar where people look; or a function that hears every event
ProgressLike = Union[bool, None, Callable[[Event], None]]


class Bar:
    """``[####....] 12/64 members, 1 failed | 40 s left``, written over itself on standard error."""

    def __init__(self, stream: Any = None):
        self.stream = stream or sys.stderr
        self.total = self.done = self.failed = 0
        self.before = 0  # finished by earlier calls: they count in the bar, not in the pace
        self.begin = time.monotonic()

    def __call__(self, event: Event) -> None:
        kind = event.get("event")
        if kind == "start":
            self.total = event["members"]
            self.before = self.done = event["finished_before"]
            self.begin = time.monotonic()
        elif kind == "member":
            self.done += 1
            self.total = max(self.total, self.done)
            self.failed += event["outcome"] not in ("settled", "out_of_time", "left_terrain")
        elif kind in ("done", "interrupted", "error"):
            return self.close()
        else:
            return
        self.draw()

    def line(self, columns: int) -> str:
        """The bar's text, cut to so many columns."""
        total = max(self.total, 1)
        filled = 20 * min(self.done, total) // total
        text = f"[{'#' * filled}{'.' * (20 - filled)}] {self.done}/{self.total} members"
        if self.failed:
            text += f", {self.failed} failed"
        now = self.done - self.before
        if now and self.done < self.total:
            left = (time.monotonic() - self.begin) / now * (self.total - self.done)
            text += f" | about {left:.0f} s left"
        return text[:columns]

    def draw(self) -> None:
        """Writes it over what stands there."""
        columns = max(shutil.get_terminal_size().columns - 1, 20)
        self.stream.write(f"\r{self.line(columns):<{columns}}")
        self.stream.flush()

    def close(self) -> None:
        """Ends its line, once."""
        if self.total:
            self.stream.write("\n")
            self.stream.flush()
        self.total = 0


def listener(progress: ProgressLike) -> Callable[[Event], None] | None:
    """The function that hears of events; None where nothing wants to."""
    if callable(progress):
        return progress
    if progress is None:
        progress = sys.stderr.isatty() or "ipykernel" in sys.modules
    return Bar() if progress else None
