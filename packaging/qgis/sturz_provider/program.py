# SPDX-License-Identifier: Apache-2.0
"""Finds the program sturz, runs it, and hands its events on; stops it in order when told to.

The program tells what it does as one JSON object per line (`--json`); SIGTERM makes it keep what is
finished and end with code 3, so that the same call goes on later."""
import json
import os
import queue
import shlex
import shutil
import subprocess
import threading

from processing.core.ProcessingConfig import ProcessingConfig

SETTING = "STURZ_PROGRAM"
OK, TOO_MANY_FAILED, INTERRUPTED = 0, 2, 3
PATIENCE_S = 120  # that a program that was told to stop has before it is killed


class SturzError(Exception):
    """Why the program could not do it, in its own words where it has some."""


def program():
    """Path of the program: the setting's, else the first on PATH, else the one beside this plugin."""
    chosen = (ProcessingConfig.getSetting(SETTING) or "").strip()
    if chosen:
        if os.access(chosen, os.X_OK) and os.path.isfile(chosen):
            return chosen
        raise SturzError(f"{chosen} is no program that can be run. Correct it in Settings > Options > "
                         "Processing > Providers > sturz, or empty it to take the one on PATH.")
    # On PATH; else installed beside this plugin (bin/ and share/ under one prefix), links followed.
    beside = os.path.join(os.path.dirname(os.path.realpath(__file__)), "../../../../bin/sturz")
    found = shutil.which("sturz") or shutil.which(os.path.normpath(beside))
    if found is None:
        raise SturzError("The program sturz is not on PATH. Install it, or say where it lies in Settings > "
                         "Options > Processing > Providers > sturz.")
    return found


def _read_lines(stream, put):
    for line in stream:
        put(line)
    put(None)


class Call:
    """One call of the program. Iterating gives its events, dicts with the key `event`."""

    def __init__(self, arguments, feedback, events=True):
        self.feedback = feedback
        command = [program(), *map(str, arguments)] + (["--json"] if events else [])
        feedback.pushCommandInfo(shlex.join(command))
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, encoding="utf-8", errors="replace")
        self.lines = queue.Queue()
        self.words = []  # of stderr
        self.readers = [threading.Thread(target=_read_lines, args=(self.process.stdout, self.lines.put),
                                         daemon=True),
                        threading.Thread(target=_read_lines, args=(self.process.stderr, self.words.append),
                                         daemon=True)]
        for reader in self.readers:
            reader.start()
        self.stopped = False

    def _stop_when_told(self):
        if self.feedback.isCanceled() and not self.stopped:
            self.stopped = True
            self.feedback.pushInfo("Stopping: what is finished is kept ...")
            self.process.terminate()
            threading.Thread(target=self._kill_late, daemon=True).start()

    def _kill_late(self):
        try:
            self.process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.process.kill()

    def __iter__(self):
        while True:
            self._stop_when_told()
            try:
                line = self.lines.get(timeout=0.2)
            except queue.Empty:
                continue
            if line is None:
                return
            try:
                event = json.loads(line)
            except ValueError:
                self.feedback.pushInfo(line.rstrip())
                continue
            if event.get("event") == "warning":
                self.feedback.pushWarning(event.get("text", ""))
            else:
                yield event

    def end(self):
        """Exit code. Raises SturzError with the program's words where it could not do its work."""
        code = self.process.wait()
        for reader in self.readers:
            reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
        if code in (OK, TOO_MANY_FAILED, INTERRUPTED):
            return code
        text = "".join(word for word in self.words if word).strip().removeprefix("error: ")
        raise SturzError(text or f"sturz ended with code {code}")
