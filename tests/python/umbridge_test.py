# SPDX-License-Identifier: Apache-2.0
"""`sturz serve --umbridge` answers as the protocol says, with the numbers of `sturz run`."""
import concurrent.futures
import json
import signal
import subprocess
import time
import unittest

import sturz
from scenes import InFolder, long_slide, slide
from umbridge_client import Model, Refused

OUTPUTS = ["runout_m", "reached_area_m2", "deposit_area_m2", "max_speed_m_s", "max_thickness_m",
           "max_deposit_m", "max_energy_j_m2", "max_pressure_pa", "com_travel_m", "end_time_s"]


class Protocol(InFolder):
    def serve(self, scene=None, **options):
        server = sturz.serve(scene or slide(), **options)
        self.addCleanup(server.stop)
        return server, Model(server.url)

    def test_every_answer_has_the_shape_of_the_protocol(self):
        _, model = self.serve()
        self.assertEqual(model.ask("GET", "/Info"), {"protocolVersion": 1.0, "models": ["sturz"]})
        self.assertEqual(model.post("ModelInfo"), {"support": {
            "Evaluate": True, "Gradient": False, "ApplyJacobian": False, "ApplyHessian": False}})
        self.assertEqual(model.post("InputSizes"), {"inputSizes": [2]})
        self.assertEqual(model.post("OutputSizes"), {"outputSizes": [len(OUTPUTS)]})
        answer = model.post("Evaluate", input=[[0.5, 500]])
        self.assertEqual(set(answer), {"output"})
        self.assertEqual([len(vector) for vector in answer["output"]], [len(OUTPUTS)])

    def test_what_the_vectors_hold_is_described(self):
        server, model = self.serve()
        told = model.ask("GET", "/Description")
        self.assertEqual([i["key"] for i in told["inputs"]],
                         ["basal.friction_coefficient", "basal.turbulent_coefficient_m_s2"])
        self.assertEqual(told["inputs"][0]["distribution"], "{uniform: [0.45, 0.65]}")
        self.assertAlmostEqual(told["inputs"][0]["median"], 0.55)
        self.assertEqual([o["name"] for o in told["outputs"]], OUTPUTS)
        self.assertEqual((server.inputs, server.outputs), (told["inputs"], told["outputs"]))

    def test_sixteen_at_once_are_the_numbers_of_sixteen_runs(self):
        _, model = self.serve(workers=2)
        points = [[0.45 + 0.0125 * k, 200 + 80 * k] for k in range(15)]
        points += [[0.25, 1500]]  # beyond its distribution
        with concurrent.futures.ThreadPoolExecutor(16) as pool:
            answers = list(pool.map(lambda point: model([point])[0], points))
        self.assertEqual(len({tuple(answer) for answer in answers}), 16)
        for (friction, turbulent), answer in zip(points, answers):
            alone = sturz.run(slide(), "out", replace=True,
                              values={"basal.friction_coefficient": friction,
                                      "basal.turbulent_coefficient_m_s2": turbulent})
            self.assertEqual(answer, [alone.scalars[name] for name in OUTPUTS])

    def test_a_client_chooses_its_outputs(self):
        _, model = self.serve(outputs=["runout_m", "max_speed_m_s"])
        both = model([[0.5, 500]])[0]
        self.assertEqual(model.output_sizes(), [2])
        chosen = {"outputs": ["max_speed_m_s"]}
        self.assertEqual(model.output_sizes(chosen), [1])
        self.assertEqual(model([[0.5, 500]], chosen), [[both[1]]])
        # The centre of mass of a mass that never moved has no travel to divide by.
        with self.assertRaises(Refused) as caught:
            model([[1.5, 500]], {"outputs": ["com_ratio"]})
        self.assertEqual((caught.exception.status, caught.exception.type), (500, "InvalidOutput"))
        self.assertIn("com_ratio", caught.exception.message)


class Ends(InFolder):
    def start(self, scene, *options):
        sturz.Scenario(scene).write("scene.yaml")
        process = subprocess.Popen([sturz.program(), "serve", "scene.yaml", "--umbridge", "--json",
                                    "--port", "0", *options], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        for line in process.stdout:
            if json.loads(line)["event"] == "serving":
                return process, json.loads(line)
        self.fail("it never served")

    def test_term_and_int_end_it_in_order(self):
        for ending in (signal.SIGTERM, signal.SIGINT):
            process, serving = self.start(slide())
            Model(serving["url"])([[0.5, 500]])
            process.send_signal(ending)
            last = json.loads(process.stdout.readlines()[-1])
            self.assertEqual(process.wait(timeout=10), 0)
            self.assertEqual(last, {"event": "done", "evaluations": 1, "refused": 0})

    def test_a_member_that_runs_does_not_hold_it_up(self):
        process, serving = self.start(long_slide(), "--workers", "1")
        model = Model(serving["url"])
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            asked = [pool.submit(model, [[0.6, 1500]]) for _ in range(3)]  # one runs, two wait
            time.sleep(1)
            self.assertFalse(any(one.done() for one in asked))
            begin = time.monotonic()
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(timeout=10), 0)
            self.assertLess(time.monotonic() - begin, 3)
            for one in asked:
                self.assertEqual((one.exception().status, one.exception().type),
                                 (503, "InvalidOutput"))


class Starts(InFolder):
    def refused(self, *options, scene=None):
        sturz.Scenario(scene or slide()).write("scene.yaml")
        done = subprocess.run([sturz.program(), "serve", "scene.yaml", *options], text=True,
                              capture_output=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 1, done.stdout)
        return done.stderr

    def test_what_cannot_be_served_is_said_at_once(self):
        self.assertIn("Add --umbridge", self.refused())
        # The last is a name, which may stand for any machine.
        for address in ("0.0.0.0", "::", "192.0.2.1", "127.0.0.1.example.org"):
            self.assertIn("--allow-remote-clients", self.refused("--umbridge", "--address", address))
        fixed = slide(basal={"friction_coefficient": 0.3})
        self.assertIn("no uncertain value", self.refused("--umbridge", "--port", "0", scene=fixed))
        self.assertIn("did you mean runout_m?", self.refused("--umbridge", "--outputs", "runout"))
        self.assertIn("key", self.refused("--umbridge", "--set", "basal.fricton_coefficient=1"))

    def test_a_taken_port_is_said(self):
        with sturz.serve(slide()) as server:
            port = server.url.rpartition(":")[2]
            self.assertIn("another program has it", self.refused("--umbridge", "--port", port))


if __name__ == "__main__":
    unittest.main()
