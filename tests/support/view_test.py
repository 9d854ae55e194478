#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests `kinefile view` of a command that has its page built in: what is in the page that it writes,
and the picture that a browser makes of it, where there is one. With page_stub.html as the page, the
colour of the picture shows what the page was given."""

import argparse
import base64
import gzip
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLES = ROOT / "examples"
FAKE = pathlib.Path(__file__).resolve().parent / "fake_chromium.py"
BROWSERS = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
MOTION = re.compile(rb'<script id="motion" type="text/plain">([A-Za-z0-9+/=]*)</script>')
PART = "format: ChoreonoidBody\nformat_version: 2.0\nlinks: [ { name: HAND } ]\n"
ARM = """format: ChoreonoidBody
format_version: 2.0
links:
  - { name: ARM, joint_type: free }
  - { type: SubBody, uri: ../hand/hand.body, parent: ARM, prefix: L_ }
"""
bin_folder = None


def content_of(page):
    """The JSON of a page's content, and its files by path."""
    (text,) = MOTION.findall(page)
    payload = gzip.decompress(base64.b64decode(text))
    (length,) = struct.unpack("<I", payload[:4])
    content = json.loads(payload[4:4 + length])
    files, at = {}, 4 + length
    for file in content["files"]:
        files[file["path"]] = payload[at:at + file["size"]]
        at += file["size"]
    assert at == len(payload) and len(files) == len(content["files"])
    return content, files


def size_of(png):
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    return struct.unpack(">II", png[16:24])


def first_pixel_of(png):
    at, data = 8, b""
    while at < len(png):
        (length,) = struct.unpack(">I", png[at:at + 4])
        if png[at + 4:at + 8] == b"IDAT":
            data += png[at + 8:at + 8 + length]
        at += 12 + length
    return tuple(zlib.decompress(data)[1:4])  # after the byte of the row's filter


def is_alive(process):
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8") as stat:
            return stat.read().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


class View(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="view & test "))
        self.addCleanup(shutil.rmtree, self.folder)
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()
        self.environment = dict(os.environ, TMPDIR=str(self.temporary), NO_COLOR="1")
        subprocess.run([bin_folder / "make_walk", "walk.bvh", "60", "30"], cwd=self.folder,
                       check=True)

    def command(self, *words):
        return [str(bin_folder / "kinefile"), *map(str, words)]

    def run_command(self, *words, **options):
        return subprocess.run(self.command(*words), cwd=self.folder, env=self.environment,
                              capture_output=True, timeout=300, **options)

    def view(self, *words):
        """Runs view, which must succeed; returns the JSON and the files of page.html."""
        done = self.run_command("view", *words, "-o", "page.html", "--force", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        return content_of((self.folder / "page.html").read_bytes())

    def put(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def test_a_motion_is_in_the_page_as_it_is(self):
        content, files = self.view("walk.bvh")
        self.assertEqual(content, {
            "files": [{"path": "walk.bvh", "size": len(self.bytes_of("walk.bvh"))}],
            "open": [{"path": "walk.bvh", "options": {}}]})
        self.assertEqual(files["walk.bvh"], self.bytes_of("walk.bvh"))

    def test_the_same_files_make_the_same_page(self):
        first = self.run_command("view", "walk.bvh", "-o", "-").stdout
        second = self.run_command("view", self.folder / "walk.bvh", "-o", "-").stdout
        self.assertEqual(first, second)
        self.assertNotIn(str(self.folder).encode(), json.dumps(content_of(first)[0]).encode())

    def test_a_page_that_exists_is_replaced_by_force_alone(self):
        self.put("page.html", "other")
        done = self.run_command("view", "walk.bvh", "-o", "page.html")
        self.assertEqual(done.returncode, 3)
        self.assertIn(b"IO002", done.stderr)
        self.assertEqual(self.bytes_of("page.html"), b"other")
        self.view("walk.bvh")

    def test_the_skeleton_of_a_motion_comes_with_it(self):
        self.assertEqual(self.run_command("convert", "walk.bvh", "walk.amc").returncode, 0)
        content, files = self.view("walk.amc")
        self.assertEqual(list(files), ["walk.amc", "walk.asf"])
        self.assertEqual(content["open"], [{"path": "walk.amc", "options": {}}])
        (self.folder / "bones").mkdir()
        os.rename(self.folder / "walk.asf", self.folder / "bones" / "figure.asf")
        content, files = self.view("walk.amc", "walk.bvh", "--skeleton", "bones/figure.asf",
                                   "--fps", "60", "--lenient")
        self.assertEqual(list(files), ["walk.amc", "bones/figure.asf", "walk.bvh"])
        options = {"fps": "60", "lenient": True}
        self.assertEqual(content["open"], [
            {"path": "walk.amc", "skeleton": "bones/figure.asf", "options": options},
            {"path": "walk.bvh", "skeleton": "bones/figure.asf", "options": options}])

    def test_parts_of_a_model_come_with_it(self):
        self.put("robot/arm/arm.body", ARM)
        self.put("robot/hand/hand.body", PART)
        content, files = self.view("robot/arm/arm.body", "--model-root", self.folder / "robot")
        self.assertEqual(files, {"arm/arm.body": ARM.encode(), "hand/hand.body": PART.encode()})
        self.assertEqual(content["open"],
                         [{"path": "arm/arm.body", "options": {"model-root": "."}}])

    def test_a_file_that_is_given_twice_is_once_in_the_page(self):
        content, files = self.view("walk.bvh", "walk.bvh", "--from", "bvh", "--up-in", "y")
        self.assertEqual(list(files), ["walk.bvh"])
        self.assertEqual(content["open"],
                         [{"path": "walk.bvh", "options": {"from": "bvh", "up-in": "y"}}] * 2)

    def test_standard_input_is_a_file_of_the_page(self):
        done = self.run_command("view", "-", "-o", "-", input=self.bytes_of("walk.bvh"))
        content, files = content_of(done.stdout)
        self.assertEqual(files, {"<stdin>": self.bytes_of("walk.bvh")})
        self.assertEqual(content["open"], [{"path": "<stdin>", "options": {}}])

    def test_a_flow_comes_with_its_robot_and_its_map(self):
        for name in ("wave.txt", "servos.yaml", "robot.body"):
            shutil.copy(EXAMPLES / name, self.folder)
        content, files = self.view("wave.txt", "--servo-map", "servos.yaml",
                                   "--skeleton", "robot.body")
        self.assertEqual(sorted(files), ["robot.body", "servos.yaml", "wave.txt"])
        self.assertEqual(content["open"], [{"path": "wave.txt", "skeleton": "robot.body",
                                            "servo_map": "servos.yaml", "options": {}}])

    def test_a_project_comes_with_its_files(self):
        project = pathlib.Path(self.environment.get("KINEFILE_TEST_DATA", "")) / \
            "robovie/vsrc2premaidai"
        found = sorted(project.rglob("*.rpj"))
        if not found:
            self.skipTest("the folder KINEFILE_TEST_DATA with real files is not there")
        shutil.copytree(found[0].parent, self.folder / "project")
        for name in ("wave.txt", "servos.yaml", "robot.body"):
            shutil.copy(EXAMPLES / name, self.folder)
        name = f"project/{found[0].name}"
        content, files = self.view("wave.txt", "--servo-map", "servos.yaml", "--skeleton",
                                   "robot.body", "--project", name)
        self.assertEqual(content["open"][0]["project"], name)
        self.assertGreater(len([path for path in files if path.startswith("project/")]), 2)
        self.assertTrue(all(files[path] == self.bytes_of(path) for path in files))

    def fake_browser(self, mode):
        (self.folder / "programs").mkdir(exist_ok=True)
        link = self.folder / "programs" / "chromium"
        if not link.exists():
            link.symlink_to(FAKE)
        log = self.folder / "browser.json"
        self.environment.update(PATH=f"{link.parent}:{os.environ['PATH']}", FAKE_BROWSER=mode,
                                FAKE_BROWSER_LOG=str(log))
        return log

    def expect_nothing_left(self, log):
        self.assertEqual(list(self.temporary.iterdir()), [])
        self.assertEqual([path.name for path in self.folder.glob("*.part.*")], [])
        processes = json.loads(log.read_text())["processes"]
        self.assertEqual([number for number in processes if is_alive(number)], [])

    def test_a_browser_is_asked_for_the_picture_and_ends(self):
        log = self.fake_browser("picture")
        done = self.run_command("view", "walk.bvh", "--png", "walk.png", "-o", "page.html",
                                "--size", "640x480", "--frames", "0:60:10")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertTrue(self.bytes_of("walk.png").endswith(
            b'picture({"frames":"0:60:10","height":480,"width":640})'))
        content_of(self.bytes_of("page.html"))
        words = json.loads(log.read_text())["words"]
        self.assertIn("--window-size=640,480", words)
        self.assertEqual("--no-sandbox" in words, os.geteuid() == 0)
        self.expect_nothing_left(log)

    def test_what_goes_wrong_in_a_browser_is_told(self):
        cases = {
            "exception": "error[PAG004]: expected a picture from the page, found: Error: no WebGL",
            "crash": "error[PAG004]: expected a picture from the page, found: a crash; the page may "
                     "need more memory than there is",
            "text": "error[PAG004]: expected a picture from the page, found: no PNG",
            "exit": "error[PAG003]: expected a picture from the browser, found that it ended; it "
                    "may lack a library or the right to make its sandbox"}
        for mode, message in cases.items():
            with self.subTest(mode):
                log = self.fake_browser(mode)
                done = self.run_command("view", "walk.bvh", "--png", "walk.png", "-o", "page.html")
                self.assertEqual((done.returncode, done.stderr.decode().strip()), (3, message))
                self.assertFalse((self.folder / "walk.png").exists())
                self.assertFalse((self.folder / "page.html").exists())
                self.expect_nothing_left(log)

    def test_an_interrupted_command_ends_its_browser(self):
        log = self.fake_browser("hang")
        process = subprocess.Popen(self.command("view", "walk.bvh", "--png", "walk.png"),
                                   cwd=self.folder, env=self.environment, stderr=subprocess.PIPE)
        for _ in range(1000):
            if log.exists() and log.stat().st_size > 0:
                break
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=60)
        self.assertEqual((process.returncode, messages),
                         (-signal.SIGINT, b"error[PAG003]: stopped by a signal\n"))
        self.expect_nothing_left(log)

    def test_without_a_browser_there_is_no_picture(self):
        self.environment["PATH"] = str(self.temporary)
        done = self.run_command("view", "walk.bvh", "--png", "walk.png", "-o", "page.html")
        self.assertEqual((done.returncode, done.stderr.decode().strip()), (
            3, "error[PAG002]: expected a browser that makes the picture on the path (chromium, "
            "chromium-browser, google-chrome, google-chrome-stable), found none; install Chromium "
            "(Debian: apt install chromium)"))
        self.assertEqual(list(self.folder.glob("*.png")) + list(self.folder.glob("*.html")), [])

    def test_a_picture_of_the_page(self):
        if not any(map(shutil.which, BROWSERS)):
            self.skipTest("there is no Chromium browser")
        shutil.copy(self.folder / "walk.bvh", self.folder / "again.bvh")
        done = self.run_command("view", "walk.bvh", "again.bvh", "walk.bvh", "--png", "walk.png",
                                "-o", "page.html", "--size", "320x200")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        png = self.bytes_of("walk.png")
        self.assertEqual(size_of(png), (320, 200))
        self.assertEqual(list(self.temporary.iterdir()), [])
        if b"<title>kinefile page stub</title>" not in self.bytes_of("page.html"):
            return
        self.assertEqual(first_pixel_of(png), (2, 3, 0))
        shutil.copy(self.folder / "walk.bvh", self.folder / "refused.bvh")
        done = self.run_command("view", "refused.bvh", "--png", "refused.png")
        self.assertEqual((done.returncode, done.stderr.decode().strip()), (
            3, "error[PAG004]: expected a picture from the page, found: Error: it is refused"))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    options, rest = parser.parse_known_args()
    bin_folder = pathlib.Path(options.bin).resolve()
    unittest.main(argv=[sys.argv[0], *rest])
