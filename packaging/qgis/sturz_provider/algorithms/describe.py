# SPDX-License-Identifier: Apache-2.0
"""sturz describe: what a scene is and what it will take, before it is computed."""
import json

from qgis.core import QgsProcessingException, QgsProcessingOutputNumber, QgsProcessingOutputString

from ..program import Call, SturzError
from .base import SturzAlgorithm


class Describe(SturzAlgorithm):
    word = "describe"
    title = "Describe a scene"
    help = ("Says what a scenario file is: which formulation and effects, how many columns or particles, how much mass, "
            "which values are uncertain, and how long a simulation and the ensemble will take on this machine. "
            "Nothing is written.")

    def initAlgorithm(self, configuration=None):  # noqa: N802
        self.add_scenario()
        self.addOutput(QgsProcessingOutputNumber("RELEASE_VOLUME_M3", "Released volume [m3]"))
        self.addOutput(QgsProcessingOutputNumber("PREDICTED_SECONDS", "Computing time of one simulation [s]"))
        self.addOutput(QgsProcessingOutputNumber("MEMBERS", "Simulations of the scenario's ensemble"))
        self.addOutput(QgsProcessingOutputString("DESCRIPTION", "All of it, as JSON"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        scene = {}
        try:
            call = Call(self.arguments(parameters, context), feedback)
            for event in call:
                if "formulation" in event:
                    scene = event
            call.end()
        except SturzError as error:
            raise QgsProcessingException(str(error)) from error
        if not scene:
            return {}
        self.tell(scene, feedback)
        return {"RELEASE_VOLUME_M3": scene["release_volume_m3"], "PREDICTED_SECONDS": scene["predicted_seconds"],
                "MEMBERS": scene["members"], "DESCRIPTION": json.dumps(scene)}

    @staticmethod
    def tell(scene, feedback):
        say = feedback.pushInfo
        if scene["title"]:
            say(scene["title"])
        say(f"Formulation: {scene['formulation']} ({scene['formulation_reason']})")
        say(f"Particles: {scene['n_particles']:.0f} at a spacing of {scene['spacing_m']:g} m")
        say(f"Release: {scene['release_volume_m3']:.0f} m3 on {scene['release_area_m2']:.0f} m2")
        say(f"One simulation: about {scene['predicted_seconds']:.3g} s; the scenario asks for {scene['members']}")
        for key, distribution in scene["uncertain"].items():
            say(f"Uncertain: {key}: {distribution}")
        for effect in scene["effects"]:
            if effect["active"]:
                say(f"Effect: {effect['name']} ({effect['reason']})")
        for note in scene["notes"]:
            say(f"Note: {note}")
        for warning in scene["warnings"]:
            feedback.pushWarning(warning)
