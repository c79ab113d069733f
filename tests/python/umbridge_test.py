# SPDX-License-Identifier: Apache-2.0
"""`sturz serve --umbridge` answers as the protocol says, with the numbers of `sturz run`."""
import concurrent.futures
import json
import signal
import socket
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
        _, model = self.serve(workers=2, censored="value")
        points = [[0.45 + 0.0125 * k, 200 + 80 * k] for k in range(15)]
        points += [[0.25, 1500]]  # beyond its distribution, and still moving at the end time
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


class Censored(InFolder):
    """The plane ends after 300 m: with little friction all of the mass runs over its edge."""
    OVER_THE_EDGE = [[0.05, 1500]]

    def serve(self, **options):
        server = sturz.serve(slide(), **options)
        self.addCleanup(server.stop)
        return server, Model(server.url)

    def test_a_bound_is_an_error_that_says_how_to_go_on(self):
        server, model = self.serve()
        with self.assertRaises(Refused) as caught:
            model(self.OVER_THE_EDGE)
        problem = caught.exception
        self.assertEqual((problem.status, problem.type), (500, "InvalidOutput"))
        for words in ("runout_m of this member is only a lower bound", "mass left the known ground",
                      "left_and_moving", '{"censored": "value"}', 'output "censored"'):
            self.assertIn(words, problem.message)
        with self.assertRaises(Refused) as caught:
            model(self.OVER_THE_EDGE, {"outputs": ["com_travel_m"]})
        self.assertIn("com_travel_m of this member is not known", caught.exception.message)
        # What does not hang together with the end is a number as ever.
        self.assertGreater(model(self.OVER_THE_EDGE, {"outputs": ["release_volume_m3"]})[0][0], 0)
        told = model.ask("GET", "/Description")
        self.assertEqual(told["censored"], "error")
        self.assertEqual(set(told["config"]), {"outputs", "censored"})

    def test_on_request_it_comes_as_seen_with_a_mark(self):
        _, model = self.serve()
        wanted = {"outputs": ["runout_m", "censored"], "censored": "value"}
        runout, censored = model(self.OVER_THE_EDGE, wanted)[0]
        self.assertGreater(runout, 100)
        self.assertEqual(censored, 1)
        runout, censored = model([[0.6, 500]], wanted)[0]
        self.assertEqual(censored, 0)
        self.assertEqual(model([[0.6, 500]])[0][0], runout)
        with self.assertRaises(Refused) as caught:
            model([[0.6, 500]], {"censored": True})
        self.assertIn('must be "error" or "value"', caught.exception.message)

    def test_a_server_may_be_told_once_for_all_clients(self):
        _, model = self.serve(censored="value", outputs=["censored", "runout_m"])
        self.assertEqual(model.ask("GET", "/Description")["censored"], "value")
        self.assertEqual(model(self.OVER_THE_EDGE)[0][0], 1)
        with self.assertRaises(Refused):
            model(self.OVER_THE_EDGE, {"censored": "error"})


class HangsUp(InFolder):
    def test_the_member_of_a_client_that_is_gone_ends(self):
        with sturz.serve(long_slide(), workers=1) as server:
            body = json.dumps({"name": "sturz", "input": [[0.6, 1500]], "config": {}}).encode()
            place = server.url.rpartition("/")[2].split(":")
            clients = []
            for _ in range(2):  # one runs, the other waits for its turn
                one = socket.create_connection((place[0], int(place[1])), timeout=20)
                one.sendall(b"POST /Evaluate HTTP/1.1\r\nHost: x\r\nContent-Length: %d\r\n\r\n%s"
                            % (len(body), body))
                clients.append(one)
            time.sleep(1)
            self.assertEqual(self.ended(server), 0)
            begin = time.monotonic()
            for one in clients:
                one.close()
            while self.ended(server) < 2 and time.monotonic() - begin < 20:
                time.sleep(0.05)
            self.assertLess(time.monotonic() - begin, 5)

    @staticmethod
    def ended(server):
        return sum("its client hung up" in json.dumps(event) for event in list(server.events))


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
