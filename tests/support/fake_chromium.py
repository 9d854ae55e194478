#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Stands for a Chromium browser in tests of `kinefile view --png`: it answers the messages that the
command sends. FAKE_BROWSER says what it does: "picture" gives a PNG of no content, "exception" a page
that fails, "crash" one that crashes, "text" no PNG, "exit" ends at once, "hang" never answers. It
starts a child that would live on, and writes the process ids and the words that it was started with
into FAKE_BROWSER_LOG."""

import base64
import json
import os
import subprocess
import sys
import urllib.parse

MODE = os.environ["FAKE_BROWSER"]
PNG = b"\x89PNG\r\n\x1a\n" + b"no content"
RESULTS = {
    "Target.createTarget": {"targetId": "T"},
    "Target.attachToTarget": {"sessionId": "S"},
    "Inspector.enable": {},
    "Page.enable": {},
    "Page.setLifecycleEventsEnabled": {},
    "Page.navigate": {"frameId": "F", "loaderId": "of the page"},
}
LOADERS = {"Page.setLifecycleEventsEnabled": "of the empty page", "Page.navigate": "of the page"}


def evaluated(expression):
    if MODE == "exception":
        return {"result": {"type": "object"}, "exceptionDetails": {
            "text": "Uncaught", "exception": {"description": "Error: no WebGL\n    at draw (x:1)"}}}
    value = base64.b64encode(PNG + expression.encode()).decode() if MODE == "picture" else "words"
    return {"result": {"type": "string", "value": value}}


def send(message):
    os.write(4, json.dumps(message).encode() + b"\0")


def answer(message):
    method, parameters = message["method"], message["params"]
    if method == "Runtime.evaluate" and MODE == "crash":
        return send({"method": "Inspector.targetCrashed", "params": {}, "sessionId": "S"})
    if method == "Runtime.evaluate":
        result = evaluated(parameters["expression"])
    else:
        result = RESULTS[method]
    if method == "Page.navigate":
        path = urllib.parse.unquote(parameters["url"].removeprefix("file://"))
        assert '<script id="motion"' in open(path, encoding="utf-8").read()
    send({"id": message["id"], "result": result})
    if method in LOADERS:
        send({"method": "Page.lifecycleEvent", "sessionId": "S",
              "params": {"name": "load", "loaderId": LOADERS[method]}})


def main():
    child = subprocess.Popen(["sleep", "1000"])
    with open(os.environ["FAKE_BROWSER_LOG"], "w", encoding="utf-8") as log:
        json.dump({"processes": [os.getpid(), child.pid], "words": sys.argv[1:]}, log)
    if MODE == "exit":
        return
    received = b""
    while block := os.read(3, 65536):
        received += block
        while b"\0" in received:
            text, received = received.split(b"\0", 1)
            if MODE != "hang":
                answer(json.loads(text))


main()
