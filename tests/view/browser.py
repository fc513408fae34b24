"""A Chromium that was started with --remote-debugging-port=0, driven by its DevTools protocol over a web socket."""

import base64
import http.client
import json
import os
import socket
import struct
import time
import urllib.parse
from pathlib import Path

CODES = {"Tab": 9, "Enter": 13, " ": 32, "End": 35, "Home": 36, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
TEXTS = {"Enter": "\r", " ": " "}


class Browser:
    """The only page of the browser whose profile this is."""

    def __init__(self, profile):
        told = Path(profile, "DevToolsActivePort")
        for _ in range(300):
            if told.exists() and "\n" in told.read_text():
                break
            time.sleep(0.1)
        port = int(told.read_text().split()[0])
        pages = []
        while not pages:
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
            connection.request("GET", "/json/list")
            pages = [page for page in json.loads(connection.getresponse().read()) if page["type"] == "page"]
        address = urllib.parse.urlsplit(pages[0]["webSocketDebuggerUrl"])
        self.socket = socket.create_connection((address.hostname, address.port), timeout=120)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET {address.path} HTTP/1.1\r\nHost: {address.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        self.come = self.socket.makefile("rb")
        while self.come.readline().strip():
            pass
        self.count = 0

    def ask(self, script):
        """What a script in the page resolves to; where it calls press(key), that key is pressed and let go.

        It has to wait for what it needs: a page that is still to come takes the place of one that was asked.
        """
        evaluate = lambda: self.send("Runtime.evaluate", {"expression": script, "awaitPromise": True, "returnByValue": True})
        self.send("Runtime.enable", {})
        self.send("Runtime.addBinding", {"name": "press"})
        mine = evaluate()
        while True:
            message = self.receive()
            if message.get("method") == "Runtime.bindingCalled":
                self.press(message["params"]["payload"])
            if message.get("id") == mine:
                if "error" in message:
                    mine = evaluate()
                    continue
                return message["result"]["result"].get("value")

    def press(self, key):
        """The page shows what comes of it; the browser's own answer is not waited for."""
        what = {"key": key, "code": "Space" if key == " " else key, "windowsVirtualKeyCode": CODES[key]}
        self.send("Input.dispatchKeyEvent", {"type": "keyDown", **({"text": TEXTS[key]} if key in TEXTS else {}), **what})
        self.send("Input.dispatchKeyEvent", {"type": "keyUp", **what})

    def send(self, method, parameters):
        self.count += 1
        data = json.dumps({"id": self.count, "method": method, "params": parameters}).encode()
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[k % 4] for k, byte in enumerate(data))
        if len(data) < 126:
            length = struct.pack("!B", 128 | len(data))
        else:
            length = struct.pack("!BH", 128 | 126, len(data)) if len(data) < 65536 else struct.pack("!BQ", 128 | 127, len(data))
        self.socket.sendall(b"\x81" + length + mask + masked)
        return self.count

    def receive(self):
        """The next message of text; what is no text is passed over."""
        text, last = b"", False
        while not last:
            first, length = self.come.read(2)
            if length > 125:
                length = int.from_bytes(self.come.read(2 if length == 126 else 8), "big")
            part = self.come.read(length)
            if first & 15 < 2:
                text, last = text + part, first & 128 != 0
        return json.loads(text)
