#!/usr/bin/env python3
"""Opens `wormdrive view` in headless Chromium and moves its sliders: live_page.py PROGRAM SCENARIO [CHROMIUM]

What a slider draws is what `wormdrive run --set` writes; a value that cannot be is told; zoom stays; keys move sliders
and press buttons; the page follows the dark scheme; hostile requests are refused; Ctrl-C leaves nothing behind. Without
Chromium only the server is asked. Prints how long the page takes to open and a slider until its run is drawn. One line per
fault.
"""

import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.parse
from pathlib import Path

import h5py

from browser import Browser

KEY = "mesh.friction"
QUESTIONS = """(async function () {
  const faults = [], say = (truth, what) => { if (!truth) faults.push(what); };
  window.addEventListener("error", (e) => faults.push("error: " + e.message), true);
  const drawn = () => new Promise((done) => document.addEventListener("wormdrive:drawn", done, { once: true }));
  const found = { faults, times: [] };
  const pressed = (key) => {
    const end = drawn();
    press(key);
    return end;
  };
  try {
    while (!window.view || document.readyState !== "complete") await new Promise((done) => setTimeout(done, 5));
    found.opened = Math.max(performance.timing.loadEventEnd - performance.timing.navigationStart,
                            ...performance.getEntriesByType("paint").map((paint) => paint.startTime));
    await new Promise((done) => setTimeout(done, 300));  // nobody moves a slider before
    const slider = view.sliders.find((s) => s.key === "mesh.friction"), [, range, number] = slider.row.children;
    const group = report.groups[0], first = report.data.groups[0].panels[0].series[0].values;
    say(group.charts.length >= 4, "no panels");
    const move = async (value) => {
      const begin = performance.now(), end = drawn();
      range.value = value;
      range.dispatchEvent(new Event("input", { bubbles: true }));
      await end;
      found.times.push(performance.now() - begin);
    };
    for (const value of [0.2, 0.21, 0.22, 0.23, 0.24, 0.26, 0.27, 0.28, 0.29, 0.3]) await move(value);
    found.friction = Number(range.value);
    found.angles = report.data.groups[0].panels[0].series[0].values;
    say(JSON.stringify(found.angles) !== JSON.stringify(first), "a slider changes nothing");
    say(report.groups[0] === group && group.charts[0].rawData_.length === found.angles.length, "the charts are not those from before");
    say(document.querySelector("#view code").textContent.endsWith("--set mesh.friction=0.3"), "the command is not told");
    group.charts[0].updateOptions({ dateWindow: [0.5, 0.75] });
    await move(0.25);
    say(Math.abs(group.range()[0] - 0.5) + Math.abs(group.range()[1] - 0.75) < 1e-9, "the zoom is lost");
    say(JSON.stringify(report.data.groups[0].panels[0].series[0].values) === JSON.stringify(first), "the way back leads elsewhere");
    number.focus();
    number.value = "-1";
    let end = drawn();
    number.dispatchEvent(new Event("change", { bubbles: true }));
    await end;
    say(document.querySelector("#view .fault").textContent.includes("mesh.friction = -1 must be at least 0"), "the fault is not told");
    const before = group.range().join();
    number.dispatchEvent(new KeyboardEvent("keydown", { key: "0", bubbles: true }));
    say(group.range().join() === before, "a key typed into a number moves the charts");
    end = drawn();
    document.querySelector("#view button").click();
    await end;
    say(document.querySelector("#view .fault").textContent === "" && view.changed.size === 0, "nothing leads back to what is stated");
    range.focus();
    const at = Number(range.value);
    await pressed("ArrowRight");
    say(Number(range.value) > at && view.changed.get("mesh.friction") === Number(range.value), "the arrow key moves no slider");
    say(document.activeElement === range, "a key takes the focus from its slider");
    press("Tab");
    await new Promise((done) => { const wait = () => document.activeElement === number ? done() : setTimeout(wait, 5); setTimeout(done, 5000); wait(); });
    say(document.activeElement === number, "Tab does not lead from a slider to its number");
    document.querySelector("#view button").focus();
    await pressed(" ");
    say(view.changed.size === 0 && Number(range.value) === at, "the blank does not press the button");
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    found.dark = dark;
    say((getComputedStyle(document.getElementById("view")).backgroundColor === "rgb(255, 255, 255)") !== dark, "the scheme is not followed");
  } catch (fault) { faults.push("exception: " + fault.message); }
  return JSON.stringify(found);
})()"""


class Viewed:
    """A running `wormdrive view`."""

    def __init__(self, program, scenario, *words, folder):
        environment = dict(os.environ, XDG_RUNTIME_DIR=str(folder))
        self.process = subprocess.Popen([program, "view", scenario, "--json", *words], stdout=subprocess.PIPE, text=True,
                                        env=environment)
        text = ""
        while not text.endswith("}\n"):  # JSON over several lines
            line = self.process.stdout.readline()
            if not line:
                raise SystemExit("wormdrive view does not start")
            text += line
        self.address = urllib.parse.urlsplit(json.loads(text)["address"])

    def ask(self, method, path, body=None, **headers):
        connection = http.client.HTTPConnection(self.address.hostname, self.address.port, timeout=60)
        try:
            connection.request(method, path, body=body, headers=headers)
            answer = connection.getresponse()
            return answer.status, answer.read(), answer.headers
        finally:
            connection.close()

    def ends(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(timeout=60)


def hostile_requests(viewed):
    """Status by request, 0 where the connection is closed; every one has to be refused."""
    page, run = viewed.address.path, viewed.address.path + "run"
    asked = []
    for path in ("/", "/favicon.ico", "/run", "/etc/passwd", "/" + 32 * "0" + "/", page[:-2] + "/", page + "..", page + "../../etc/passwd",
                 page + "%2e%2e/%2e%2e/etc/passwd", page + "run.h5", page + "run/", page.upper() + "x", "//" + page, page + "?x", "/.%00" + page):
        for method in ("GET", "POST", "PUT", "DELETE", "OPTIONS"):
            if not (path == page + "?x" and method == "GET"):
                asked.append((f"{method} {path}", lambda m=method, p=path: viewed.ask(m, p, b"{}" if m == "POST" else None)[0]))
    for host in ("evil.example", "localhost:" + str(viewed.address.port), f"127.0.0.1:{viewed.address.port}.evil.example", "", "[::1]"):
        asked.append((f"host {host!r}", lambda h=host: viewed.ask("GET", page, Host=h)[0]))
    for origin in ("http://evil.example", "null", "file://", f"https://127.0.0.1:{viewed.address.port}"):
        asked.append((f"origin {origin}", lambda o=origin: viewed.ask("POST", run, b"{}", Origin=o)[0]))
    for body in (b"", b"[]", b"null", b"{", b"\xff\xfe", b'{"mesh.friction": "0.2"}', b'{"mesh.friction": null}', b'{"mesh.friction": 1e999}',
                 b'{"load.file": 1}', b'{"run.report_interval_s": 1e-300}', b'{"mesh.friction=0.2\\nload.file": 1}',
                 b'{"' + b"a" * 100000 + b'": 1}', b"[" * 60000, b'{"mesh.friction": ' + b"9" * 50000 + b"}"):
        asked.append((f"body {body[:40]!r}", lambda b=body: viewed.ask("POST", run, b)[0]))

    def raw(words):
        with socket.create_connection((viewed.address.hostname, viewed.address.port), timeout=60) as s:
            s.sendall(words)
            s.shutdown(socket.SHUT_WR)
            answer = s.recv(64)
            return int(answer.split()[1]) if answer.startswith(b"HTTP/1.1 ") else 0

    for words in (b"\r\n\r\n", b"\x16\x03\x01\x02\x00", b"GET\r\n\r\n", b"GET " + page.encode() + b" HTTP/9.9\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"a: b\r\n" * 5000 + b"\r\n",
                  b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n", b"POST " + run.encode() + b" HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
                  b"POST " + run.encode() + b" HTTP/1.1\r\nHost: x\r\nContent-Length: 99999999999\r\n\r\n{}", b"\x00" * 1000):
        asked.append((f"raw {words[:30]!r}", lambda w=words: raw(w)))
    answers = []
    for name, ask in asked:
        try:
            answers.append((name, ask()))
        except (http.client.HTTPException, ConnectionError, ValueError):
            answers.append((name, 0))
    return answers


def faults_of_page(viewed, chromium, program, scenario, folder, *options):
    profile = f"{folder}/browser{len(options)}"
    chrome = subprocess.Popen([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0",
                               f"--user-data-dir={profile}", *options, viewed.address.geturl()], stderr=subprocess.DEVNULL)
    try:
        found = json.loads(Browser(profile).ask(QUESTIONS))
    finally:
        chrome.terminate()
        chrome.wait()
    faults = found["faults"]
    if options and not found.get("dark"):
        faults.append("the browser does not offer the dark scheme")
    if not faults:
        output = Path(folder, "same.h5")
        subprocess.run([program, "run", scenario, "--set", f"{KEY}={found['friction']}", "-q", "--force", "-o", output], check=True)
        angles = h5py.File(output)["trajectory/gear_angle"][:]
        if len(angles) != len(found["angles"]) or any(abs(a - b) > 1e-7 * abs(a) + 1e-30 for a, b in zip(angles, found["angles"])):
            faults.append("the page shows another run than wormdrive run writes")
        times = sorted(found["times"])
        print(f"the page opens in {found['opened']:.0f} ms; ", end="")
        print(f"a slider is followed in {times[len(times) // 2]:.0f} ms (median of {len(times)}, at most {times[-1]:.0f} ms)")
    return faults


def main(program, scenario, chromium=None):
    faults = []
    with tempfile.TemporaryDirectory(dir="/dev/shm" if os.path.isdir("/dev/shm") else None) as folder:
        begin = time.monotonic()
        viewed = Viewed(program, scenario, folder=folder)
        print(f"the program serves after {1e3 * (time.monotonic() - begin):.0f} ms")
        if viewed.ask("GET", viewed.address.path)[0] != 200:
            faults.append("the page cannot be had")
        if oct(next(Path(folder).glob("wormdrive-view-*")).stat().st_mode)[-3:] != "700":
            faults.append("others can look into the folder of the run")
        answers = hostile_requests(viewed)
        faults += [f"{name}: answered with {status}" for name, status in answers if 200 <= status < 400]
        status, text, headers = viewed.ask("POST", viewed.address.path + "run", json.dumps({KEY: 0.2}), **{"Accept-Encoding": "gzip, br"})
        if headers["Content-Encoding"]:
            faults.append("answers are compressed, which takes longer than the run")
        elif status != 200 or len(json.loads(text)["groups"]) != 1:
            faults.append(f"after hostile requests a proper one is answered with {status}")
        print(f"{len(answers)} hostile requests, {sum(s == 0 or s >= 400 for _, s in answers)} refused")
        if chromium:
            faults += faults_of_page(viewed, chromium, program, scenario, folder)
            faults += faults_of_page(viewed, chromium, program, scenario, folder, "--blink-settings=preferredColorScheme=0")
        code = viewed.ends()
        if code != 0:
            faults.append(f"Ctrl-C ends it with exit code {code}")
        if list(Path(folder).glob("wormdrive-view-*")):
            faults.append("it leaves its folder behind")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
