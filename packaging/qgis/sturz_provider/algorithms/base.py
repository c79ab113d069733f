# SPDX-License-Identifier: Apache-2.0
"""What the algorithms that call the program share: scenario, values in place of its own, the call."""
import os

from qgis.core import (QgsProcessingAlgorithm, QgsProcessingException, QgsProcessingParameterBoolean,
                       QgsProcessingParameterFile, QgsProcessingParameterFolderDestination, QgsProcessingParameterNumber,
                       QgsProcessingParameterString)

from ..program import INTERRUPTED, TOO_MANY_FAILED, Call, SturzError
from ..results import project_of, show_results

MEMBERS_SHARE = 90  # per cent of the bar; the rest is for maps and page


class SturzAlgorithm(QgsProcessingAlgorithm):
    """Subclasses give `word` (of the program), `title` and `help`."""
    word = title = help = ""
    folder = to_show = None

    def createInstance(self):  # noqa: N802 (names of QGIS)
        return type(self)()

    def name(self):
        return self.word

    def displayName(self):  # noqa: N802
        return self.title

    def shortHelpString(self):  # noqa: N802
        return self.help

    def add_scenario(self):
        self.addParameter(QgsProcessingParameterFile("SCENARIO", "Scenario file (YAML)",
                                                     fileFilter="Scenarios (*.yaml *.yml)"))
        self.addParameter(QgsProcessingParameterString(
            "SET", "Values in place of the scenario's, one key=value per line", multiLine=True, optional=True))

    def add_folder(self):
        self.addParameter(QgsProcessingParameterFolderDestination("OUT", "Folder of the results"))

    def add_members(self):
        whole = QgsProcessingParameterNumber.Integer
        self.addParameter(QgsProcessingParameterNumber("MEMBERS", "Number of simulations (empty: the scenario's)",
                                                       whole, optional=True, minValue=1))
        self.addParameter(QgsProcessingParameterNumber("WORKERS", "Simulations at a time (empty: all cores)",
                                                       whole, optional=True, minValue=1))

    def add_load(self):
        self.addParameter(QgsProcessingParameterBoolean("LOAD", "Show the maps when they are made", True))

    def arguments(self, parameters, context):
        """Of the program: the word, the scenario, and what the parameters ask for."""
        words = [self.word, self.parameterAsFile(parameters, "SCENARIO", context)]
        for line in self.parameterAsString(parameters, "SET", context).splitlines():
            if line.strip():
                words += ["--set", line.strip()]
        if self.parameterDefinition("OUT") is not None:
            words += ["-o", self.folder]
        for name, option in (("MEMBERS", "-n"), ("WORKERS", "--workers")):
            if self.parameterDefinition(name) is None:
                continue
            number = self.parameterAsInt(parameters, name, context)  # 0 where nothing, or NULL, was given
            if number > 0:
                words += [option, number]
        return words

    def prepareAlgorithm(self, parameters, context, feedback):  # noqa: N802
        # Once: each question after a temporary folder would name another one.
        if self.parameterDefinition("OUT") is not None:
            self.folder = self.parameterAsFileOutput(parameters, "OUT", context)
        return True

    def call(self, parameters, context, feedback):
        """Runs the program to its end. Returns its last event."""
        last = {}
        try:
            call = Call(self.arguments(parameters, context), feedback)
            done, to_do = 0, 0
            for event in call:
                kind = event.get("event")
                if kind == "start":
                    to_do = event.get("to_do", 0)
                    feedback.pushInfo(f"{event.get('members', 0)} simulations, {to_do} to do")
                elif kind == "member":
                    done += 1
                    feedback.setProgress(MEMBERS_SHARE * done / max(to_do, done))
                    feedback.setProgressText(f"{done} of {to_do} simulations")
                elif kind != "error":  # whose words come once, with the end
                    last = event
            code = call.end()
        except SturzError as error:
            raise QgsProcessingException(str(error)) from error
        if code == INTERRUPTED:
            if not feedback.isCanceled():
                raise QgsProcessingException("sturz was stopped; the same call goes on.")
            feedback.pushInfo(f"Stopped after {done} simulations. The same call goes on from there.")
        elif code == TOO_MANY_FAILED:
            feedback.pushWarning("More simulations failed than the scenario accepts; see members.csv.")
        if not feedback.isCanceled():
            feedback.setProgress(100)
        return last

    def remember(self, parameters, context, feedback):
        """The folder to show once the algorithm is back in the main thread."""
        wanted = self.parameterAsBoolean(parameters, "LOAD", context) and not feedback.isCanceled()
        self.to_show = self.folder if wanted and os.path.exists(project_of(self.folder)) else None

    def postProcessAlgorithm(self, context, feedback):  # noqa: N802
        if self.to_show:
            try:
                show_results(self.to_show, context, feedback)
            except SturzError as error:
                raise QgsProcessingException(str(error)) from error
        return {}
