"""Real keys for a Chromium that was started with --remote-debugging-port=0: its DevTools protocol over a web socket."""

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


class BrowserKeys:
    """The keyboard of the only page of the browser whose profile this is."""

    def __init__(self, profile):
        told = Path(profile, "DevToolsActivePort")
        for _ in range(300):
            if told.exists() and "\n" in told.read_text():
                break
            time.sleep(0.1)
        port = int(told.read_text().split()[0])
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
        connection.request("GET", "/json/list")
        pages = [page for page in json.loads(connection.getresponse().read()) if page["type"] == "page"]
        address = urllib.parse.urlsplit(pages[0]["webSocketDebuggerUrl"])
        self.socket = socket.create_connection((address.hostname, address.port), timeout=60)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET {address.path} HTTP/1.1\r\nHost: {address.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        answer = b""
        while b"\r\n\r\n" not in answer:
            answer += self.socket.recv(4096)
        self.count = 0

    def press(self, key):
        """Presses a key and lets it go. The page shows what comes of it; the browser's own answer is not waited for."""
        what = {"key": key, "code": "Space" if key == " " else key, "windowsVirtualKeyCode": CODES[key]}
        self.call("Input.dispatchKeyEvent", {"type": "keyDown", **({"text": TEXTS[key]} if key in TEXTS else {}), **what})
        self.call("Input.dispatchKeyEvent", {"type": "keyUp", **what})

    def call(self, method, parameters):
        self.count += 1
        data = json.dumps({"id": self.count, "method": method, "params": parameters}).encode()
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[k % 4] for k, byte in enumerate(data))
        length = struct.pack("!B", 128 | len(data)) if len(data) < 126 else struct.pack("!BH", 128 | 126, len(data))
        self.socket.sendall(b"\x81" + length + mask + masked)
