# SPDX-License-Identifier: Apache-2.0
"""The program ``sturz`` as a child process: JSON lines come back one by one, Ctrl-C ends it in order."""
from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from typing import Any, Callable, Iterable, Mapping, Sequence

from .errors import Missing, ScenarioError, SturzError, SturzWarning

Event = dict[str, Any]
DONE, FAILED_MEMBERS, INTERRUPTED = 0, 2, 3  # exit codes; 1: usage or scenario error


def _places() -> Iterable[Path]:
    """Where the program lies seen from this package: in a build folder, a prefix, a checkout."""
    here = Path(os.path.abspath(__file__)).parent
    yield from (parent / "ensemble/app/sturz" for parent in list(here.parents)[1:2])
    yield from (parent / "bin/sturz" for parent in list(here.parents)[2:4])
    checkout = Path(__file__).resolve().parents
    if len(checkout) > 3:
        yield checkout[3] / "build/release/ensemble/app/sturz"


def program() -> str:
    """Path of the program: ``$STURZ`` where it is set, else the one beside this package, else the
    first on the search path.

    Raises:
        Missing: when there is none.
    """
    named = os.environ.get("STURZ")
    if named:
        if not os.access(named, os.X_OK):
            raise Missing(f"STURZ={named} is no program. Set it to the path of sturz, or unset it.")
        return named
    for place in _places():
        if place.is_file() and os.access(place, os.X_OK):
            return str(place)
    found = shutil.which("sturz")
    if not found:
        raise Missing("The program sturz was not found. Install it (cmake --install), or set the "
                      "environment variable STURZ to its path.")
    return found


def set_options(values: Mapping[str, Any] | None) -> list[str]:
    """``--set key=value`` for each entry; None removes a key."""
    from .scenario import plain
    options = []
    for key, value in (values or {}).items():
        options += ["--set", f"{key}={json.dumps(plain(value))}"]
    return options


@dataclass
class Ended:
    """How a call of the program ended."""

    code: int
    last: Event = field(default_factory=dict)  #: the last event, ``done`` when all went well
    errors: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    said: str = ""  #: standard error


class Child:
    """A running ``sturz``, out of reach of the terminal's Ctrl-C: it hears of it from us, once."""

    def __init__(self, arguments: Sequence[str]):
        self._words = tempfile.TemporaryFile()
        environment = {**os.environ, "OMP_WAIT_POLICY": os.environ.get("OMP_WAIT_POLICY", "passive")}
        self.process = subprocess.Popen(
            [program(), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=self._words, start_new_session=True, env=environment)

    def events(self) -> Iterable[Event]:
        """Its JSON lines as they come, to its end."""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            if line.strip():
                yield json.loads(line)

    def stop(self, is_read: bool = False) -> int:
        """Asks it to end in order and waits; it keeps what is finished.

        Args:
            is_read: somebody else reads its lines to the end. What nobody reads is read here: with a
                full pipe it would wait, be killed, and could put nothing away.
        """
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        if not is_read:
            Thread(target=self._read_away, daemon=True).start()
        try:
            return self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:  # it promises 1.5 s
            self.process.kill()
            return self.process.wait()

    def _read_away(self) -> None:
        assert self.process.stdout is not None
        try:
            while self.process.stdout.read(1 << 16):
                pass
        except ValueError:  # closed: it has ended
            pass

    def said(self) -> str:
        """What it wrote to standard error so far."""
        self._words.seek(0)
        return self._words.read().decode(errors="replace")

    def close(self) -> None:
        """Lets go of its streams."""
        if self.process.stdout is not None:
            self.process.stdout.close()
        self._words.close()


def call(arguments: Sequence[str], on_event: Callable[[Event], None] | None = None) -> Ended:
    """Runs the program to its end.

    Args:
        arguments: words of the command line, ``--json`` among them.
        on_event: hears of every JSON line as it comes. What it raises stops the program in order.

    Raises:
        ScenarioError: the program refused what it was asked (exit code 1).
        KeyboardInterrupt: Ctrl-C, after the program has put away what is finished. The same call
            goes on where it stopped.
    """
    child = Child(arguments)
    ended = Ended(0)
    try:
        for event in child.events():
            ended.last = event
            if event.get("event") == "warning":
                ended.warnings.append(event["text"])
            elif event.get("event") == "error":
                ended.errors.append(event["text"])
            if on_event:
                on_event(event)
        ended.code = child.process.wait()
    except BaseException:
        child.stop()
        raise
    finally:
        ended.said = child.said()
        child.close()
    for text in ended.warnings:
        warnings.warn(text, SturzWarning, stacklevel=3)
    if ended.code == INTERRUPTED:
        raise KeyboardInterrupt("sturz was interrupted; the same call goes on where it stopped")
    if ended.code in (DONE, FAILED_MEMBERS):
        return ended
    text = "\n".join(ended.errors) or _words_of(ended.said)
    if ended.code == 1:
        raise ScenarioError(text)
    raise SturzError(text or f"sturz ended with code {ended.code}")


def _words_of(said: str) -> str:
    """Standard error without what only a person at a terminal needs."""
    lines = [line.removeprefix("error: ") for line in said.splitlines()]
    return "\n".join(line for line in lines if line and not line.startswith("Run with --help"))
