# SPDX-License-Identifier: Apache-2.0
"""Whatever a client sends, the server answers with an error that helps, and goes on serving."""
import json
import socket
import time
import unittest
import zlib

import sturz
from scenes import InFolder, slide
from umbridge_client import Model, Refused

GOOD = {"name": "sturz", "input": [[0.5, 500]], "config": {}}


class Refusals(InFolder):
    def setUp(self):
        super().setUp()
        self.server = sturz.serve(slide(), workers=1)
        self.addCleanup(self.server.stop)
        self.model = Model(self.server.url)
        self.right = self.model([[0.5, 500]])

    def tearDown(self):
        """The server has survived and still computes the same."""
        self.assertEqual(self.model([[0.5, 500]]), self.right)

    def refused(self, request="Evaluate", **message):
        with self.assertRaises(Refused) as caught:
            self.model.ask("POST", "/" + request, {**GOOD, **message})
        return caught.exception

    def error(self, method, path, body=b"", headers=None):
        status, _, text = self.model.raw(method, path, body, headers)
        answer = json.loads(text)
        self.assertEqual(set(answer), {"error"})
        self.assertEqual(set(answer["error"]), {"type", "message"})
        return status, answer["error"]["type"], answer["error"]["message"]

    def test_wrong_inputs(self):
        two = "one list of 2 numbers"
        for given, said in (([[0.3]], "it holds 1"), ([[0.3, 500, 1]], "it holds 3"), ([], "0 lists"),
                            ([[0.3, 500], [1]], "2 lists"), ([0.3, 500], two), ("x", two), (None, two),
                            ({}, two), ([["0.3", 500]], "number 0 is string"), ([[0.3, None]], "is null"),
                            ([[[0.3], 500]], "is array"), ([[True, 500]], "is boolean")):
            problem = self.refused(input=given)
            self.assertEqual((problem.status, problem.type), (400, "InvalidInput"), given)
            self.assertIn(said, problem.message)

    def test_values_that_cannot_be(self):
        for values, key in (([-0.1, 500], "basal.friction_coefficient"),
                            ([0.3, 0], "basal.turbulent_coefficient_m_s2"),
                            ([0.3, -1e300], "basal.turbulent_coefficient_m_s2")):
            problem = self.refused(input=[values])
            self.assertEqual((problem.status, problem.type), (400, "InvalidInput"))
            self.assertIn(key, problem.message)
            self.assertIn("must be", problem.message)

    def test_unknown_models_and_features(self):
        for request in ("ModelInfo", "InputSizes", "OutputSizes", "Evaluate", "Gradient"):
            problem = self.refused(request, name="posterior")
            self.assertEqual((problem.status, problem.type), (400, "ModelNotFound"))
            self.assertIn("sturz", problem.message)
            self.assertEqual(self.refused(request, name=7).type, "InvalidInput")
        for request in ("Gradient", "ApplyJacobian", "ApplyHessian"):
            problem = self.refused(request)
            self.assertEqual((problem.status, problem.type), (400, "UnsupportedFeature"))

    def test_unknown_configurations(self):
        self.assertIn("config.level", self.refused(config={"level": 1}).message)
        self.assertIn("did you mean runout_m", self.refused(config={"outputs": ["runout"]}).message)
        for outputs in ([], "runout_m", [1], [["runout_m"]], ["runout_m", "runout_m"]):
            self.assertEqual(self.refused(config={"outputs": outputs}).type, "InvalidInput")
        self.assertEqual(self.refused("OutputSizes", config=[1]).type, "InvalidInput")

    def test_bodies_that_are_no_json(self):
        for body in (b"", b"{", b"nonsense", b"[]", b"7", b"\xff\xfe\x00",
                     b'{"name": "sturz", "input": [[NaN, 1]]}',
                     b'{"name": "sturz", "input": [[1e999, 1]]}', b"[" * 100000, b'{"a":' * 50000):
            status, kind, message = self.error("POST", "/Evaluate", body)
            self.assertEqual((status, kind), (400, "InvalidInput"), body[:40])
            self.assertTrue(message)

    def test_bodies_that_are_too_large_or_of_unknown_size(self):
        large = json.dumps({**GOOD, "rest": "x" * (2 << 20)}).encode()
        status, kind, message = self.error("POST", "/Evaluate", large)
        self.assertEqual((status, kind), (413, "InvalidInput"))
        self.assertIn("1048576 bytes", message)
        status, _, message = self.error("POST", "/Evaluate", iter([b"{", b"}"]),
                                        {"Transfer-Encoding": "chunked"})
        self.assertEqual(status, 411)
        self.assertIn("Content-Length", message)
        packed = zlib.compress(json.dumps(GOOD).encode())
        self.assertEqual(self.error("POST", "/Evaluate", packed, {"Content-Encoding": "deflate"})[0], 415)

    def test_a_client_that_writes_on_can_still_read_the_answer(self):
        host, port = self.model.place.split(":")
        chunk = b"10000\r\n" + b" " * 0x10000 + b"\r\n"
        with socket.create_connection((host, int(port)), timeout=20) as one:
            one.sendall(b"POST /Evaluate HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n")
            for _ in range(20):
                one.sendall(chunk)
                time.sleep(0.02)
            one.sendall(b"0\r\n\r\n")
            self.assertTrue(one.recv(1000).startswith(b"HTTP/1.1 411 "))

    def test_what_web_pages_send_is_not_answered(self):
        status, _, message = self.error("POST", "/Evaluate", json.dumps(GOOD).encode(),
                                        {"Origin": "http://example.org"})
        self.assertEqual(status, 403)
        self.assertIn("Origin", message)

    def test_unknown_paths_name_the_known_ones(self):
        for method, path in (("GET", "/"), ("GET", "/Evaluate"), ("POST", "/Info"), ("POST", "/evaluate"),
                             ("GET", "/../../etc/passwd"), ("DELETE", "/Info")):
            status, _, message = self.error(method, path)
            self.assertIn(status, (400, 404), path)
            if status == 404:
                self.assertIn("GET /Info", message)

    def test_what_is_no_http_at_all(self):
        host, port = self.model.place.split(":")
        for words in (b"", b"\r\n\r\n", b"\x16\x03\x01\x02\x00\x01",
                      b"POST /Evaluate HTTP/1.1\r\n" + b"a: b\r\n" * 9000,
                      b"POST /Evaluate HTTP/1.1\r\nContent-Length: -5\r\n\r\n{}",
                      b"POST /Evaluate HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n{}"):
            with socket.create_connection((host, int(port)), timeout=20) as one:
                try:
                    one.sendall(words)
                    one.shutdown(socket.SHUT_WR)
                    one.recv(1000)
                except ConnectionError:
                    pass  # hanging up is an answer to that


if __name__ == "__main__":
    unittest.main()
