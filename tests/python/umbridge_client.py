# SPDX-License-Identifier: Apache-2.0
"""A client of UM-Bridge 1.0, written from the protocol's public description, with the standard library."""
import http.client
import json
import urllib.parse


class Refused(Exception):
    """An error of the protocol."""

    def __init__(self, status, error):
        super().__init__(f"{status} {error['type']}: {error['message']}")
        self.status, self.type, self.message = status, error["type"], error["message"]


class Model:
    def __init__(self, url, name=None):
        self.place = urllib.parse.urlsplit(url).netloc
        info = self.ask("GET", "/Info")
        if info["protocolVersion"] != 1.0:
            raise ValueError(f"protocol {info['protocolVersion']}")
        self.name = name or info["models"][0]

    def raw(self, method, path, body=b"", headers=None):
        """Status, headers and bytes of one request on a connection of its own."""
        connection = http.client.HTTPConnection(self.place, timeout=60)
        try:
            connection.request(method, path, body, headers or {})
            reply = connection.getresponse()
            return reply.status, dict(reply.getheaders()), reply.read()
        finally:
            connection.close()

    def ask(self, method, path, message=None):
        body = b"" if message is None else json.dumps(message).encode()
        status, headers, text = self.raw(method, path, body, {"Content-Type": "application/json"})
        answer = json.loads(text)
        if "error" in answer:
            raise Refused(status, answer["error"])
        assert status == 200 and headers["Content-Type"] == "application/json", (status, headers)
        return answer

    def post(self, request, **message):
        return self.ask("POST", "/" + request, {"name": self.name, **message})

    def input_sizes(self):
        return self.post("InputSizes", config={})["inputSizes"]

    def output_sizes(self, config=None):
        return self.post("OutputSizes", config=config or {})["outputSizes"]

    def __call__(self, parameters, config=None):
        return self.post("Evaluate", input=parameters, config=config or {})["output"]
