#!/usr/bin/env python3
"""Hostile requests to `dam studio`, while a rightful window goes on asking.

    python3 studio/hostile.py target/release/dam --count 100000

Starts a studio on a folder of its own and sends it requests of wrong host, origin, token,
path, size and form, slow ones and malformed WebSockets. None must be served, the program must
not end, its memory must stay flat, and the window must get every answer, 95 % of them within
100 ms. Plain Python, standard library alone. Exit status 0: all of it held.
"""

import argparse
import base64
import json
import os
import random
import re
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

SCENE = Path(__file__).resolve().parent.parent / "scenarios/rocker/two_masses.json"


class Place:
    """A folder with a scene, a link that leads out of it, and a secret beside it."""

    def __init__(self):
        self.base = Path(tempfile.mkdtemp(prefix="dam-hostile-"))
        self.folder = self.base / "open"
        self.folder.mkdir()
        self.text = SCENE.read_text()
        (self.folder / "scene.json").write_text(self.text)
        (self.base / "secret.json").write_text('{"dam": 1, "secret": true}')
        (self.folder / "link.json").symlink_to(self.base / "secret.json")
        (self.folder / "away").symlink_to(self.base)


class Studio:
    def __init__(self, dam, place):
        state = dict(os.environ, XDG_STATE_HOME=str(place.base / "state"))
        self.process = subprocess.Popen([dam, "studio", str(place.folder), "--no-open"], stderr=subprocess.PIPE, env=state, text=True)
        told = ""
        while not (found := re.search(r"http://127\.0\.0\.1:(\d+)/#([0-9a-f]{64})", told)):
            line = self.process.stderr.readline()
            if not line:
                sys.exit(f"no studio: {told}")
            told += line
        self.port, self.token = int(found[1]), found[2]
        self.host = f"127.0.0.1:{self.port}"

    def memory(self):
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024

    def connect(self, timeout=20):
        connection = socket.create_connection(("127.0.0.1", self.port), timeout)
        # Closed at once: so many waiting ports are not to be had.
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        return connection


def request(host, method="GET", path="/", headers=(), body=b""):
    lines = [f"{method} {path} HTTP/1.1"] + ([f"Host: {host}"] if host else []) + list(headers) + ["Connection: close"]
    if body:
        lines.append(f"Content-Length: {len(body)}")
    return "\r\n".join(lines).encode("latin-1", "replace") + b"\r\n\r\n" + body


def upgrade(host, origin):
    key = base64.b64encode(os.urandom(16)).decode()
    headers = ["Upgrade: websocket", "Sec-WebSocket-Version: 13", f"Sec-WebSocket-Key: {key}"]
    headers += [f"Origin: {origin}"] if origin else []
    return request(host, path="/ws", headers=headers).replace(b"Connection: close", b"Connection: Upgrade")


def frame(payload, opcode=1, masked=True, fin=True, length=None):
    size = len(payload) if length is None else length
    head = bytes([(0x80 if fin else 0) | opcode])
    bit = 0x80 if masked else 0
    if size < 126:
        head += bytes([bit | size])
    elif size < 65536:
        head += bytes([bit | 126]) + struct.pack(">H", size)
    else:
        head += bytes([bit | 127]) + struct.pack(">Q", size)
    if not masked:
        return head + payload
    mask = os.urandom(4)
    return head + mask + bytes(byte ^ mask[k % 4] for k, byte in enumerate(payload))


def hostile(studio, rng):
    """A request as bytes, and what follows an upgrade; never one that may be served."""
    host, origin, bearer = studio.host, f"http://{studio.host}", f"Authorization: Bearer {studio.token}"
    api = rng.choice(["/api/scenes", "/api/schema?scene=scene.json", "/api/parts?scene=scene.json", "/api/model?scene=scene.json", "/api/linkages?scene=scene.json", "/api/linkages?scene=scene.json&at=%7B%22x%22%3A%5B1%2Cnull%5D%7D", "/api/figures?scene=scene.json", "/api/first", "/api/questions?scene=scene.json", "/api/text?scene=scene.json", "/api/file?scene=scene.json&name=report.html&question=%7B%22command%22%3A%22run%22%7D"])
    other = rng.choice(["evil.example", f"localhost:{studio.port}", "127.0.0.1", f"127.0.0.1:{studio.port + 1}", f"evil.example:{studio.port}", f"127.0.0.1:{studio.port}.evil.example", "[::1]", f"0.0.0.0:{studio.port}"])
    wrong = rng.choice(["null", "http://evil.example", f"https://{host}", f"http://localhost:{studio.port}", f"http://{host}.evil.example", "file://"])
    path = rng.choice(["../secret.json", "..%2fsecret.json", "%2e%2e/secret.json", "link.json", "away/secret.json", "/etc/passwd", "scene.json/../../secret.json", "..\\secret.json", "scene.json%00", "./scene.json", "", ".", "open", "a" * 3000])
    hello = json.dumps({"type": "hello", "token": rng.choice(["", "0" * 64, studio.token[:-1], studio.token.upper() + "x"])}).encode()
    kind = rng.randrange(16)
    if kind == 0:
        return request(other, path=rng.choice(["/", api, "/studio.js"]), headers=[bearer])
    if kind == 1:
        return request(host, path=api, headers=[bearer, f"Origin: {wrong}"])
    if kind == 2:
        return request(host, method=rng.choice(["POST", "PUT", "DELETE", "PATCH"]), path=api, headers=[bearer] + rng.choice([[], [f"Origin: {wrong}"]]))
    if kind == 3:
        return request(host, path=api, headers=rng.choice([[], ["Authorization: Bearer "], [f"Authorization: Bearer {'0' * 64}"], [f"Authorization: Basic {studio.token}"], [f"Cookie: token={studio.token}"], [bearer, bearer]]))
    if kind == 4:
        return request(host, path=f"/api/{rng.choice(['schema', 'parts', 'model', 'linkages', 'figures', 'questions', 'text'])}?scene={path}", headers=[bearer])
    if kind == 5:
        return request(host, path=rng.choice(["/../secret.json", "/%2e%2e/secret.json", "/scene.json", "/link.json", "//etc/passwd", "/api/../api/scenes", f"/api/scenes/{studio.token}", "/api/nothing"]), headers=rng.choice([[], [bearer]]))
    if kind == 6:
        return request(host, method="POST", path=api, headers=[bearer, f"Origin: {origin}"], body=os.urandom(rng.choice([10, 2000, 200000])))
    if kind == 7:
        return request(host, method="POST", path=api, headers=[bearer, f"Origin: {origin}", f"Content-Length: {rng.choice([2 << 20, 1 << 40, -1])}"])
    if kind == 8:
        return os.urandom(rng.randrange(1, 400)) + b"\r\n\r\n"
    if kind == 9:
        return request("", path=api, headers=rng.choice([[bearer], [f"Host: {host}", f"Host: {host}", bearer]]))
    if kind == 10:
        return request(host, path=f"http://{other}{api}", headers=[bearer])
    if kind == 11:
        return upgrade(host, rng.choice([None, wrong]))
    if kind == 12:
        return upgrade(host, origin) + frame(hello)
    if kind == 13:
        broken = rng.choice([os.urandom(40), frame(hello, masked=False), frame(b"", 1, length=1 << 40), frame(hello, opcode=7), frame(b"x" * 200, opcode=9), frame(b"\xff\xfe"), frame(b"[" * 100), frame(b'{"type":"open","scene":"scene.json"}'), frame(b"", 8)])
        return upgrade(host, origin) + broken
    if kind == 14:
        return request(host, path=api, headers=[f"X-{k}: {'y' * 900}" for k in range(rng.choice([70, 200]))])
    return request(host, path=api, headers=[bearer, f"Sec-Fetch-Site: {rng.choice(['cross-site', 'same-site'])}"])


class Count:
    def __init__(self):
        self.lock = threading.Lock()
        self.sent = self.refused = self.closed = self.lost = 0
        self.served = []


def judge(answer, sent, count, token):
    """Served is what was told anything: a good status, or a message of a WebSocket."""
    status = re.match(rb"HTTP/1\.1 (\d+)", answer)
    head, _, rest = answer.partition(b"\r\n\r\n")
    told = status and status[1].startswith(b"2")
    # After an upgrade only a closing frame (0x88) may come.
    told = told or (status and status[1] == b"101" and rest and rest[0] & 0x0F in (1, 2))
    told = told or b"secret" in answer or token.encode() in answer or str(SCENE.parent).encode() in answer
    with count.lock:
        count.sent += 1
        if told:
            count.served.append((sent[:200], answer[:200]))
        elif status:
            count.refused += 1
        else:
            count.closed += 1


def attack(studio, seed, share, count, stop):
    rng = random.Random(seed)
    slow = []
    for number in range(share):
        if stop.is_set():
            break
        message = hostile(studio, rng)
        try:
            connection = studio.connect()
            if number % 50 == 0:
                # Slow: the head comes in drops, and never ends.
                connection.sendall(message[: rng.randrange(1, 40)])
                slow.append(connection)
                if len(slow) > 10:
                    slow.pop(0).close()
                with count.lock:
                    count.sent += 1
                    count.closed += 1
                continue
            answer = b""
            try:
                connection.sendall(message)
                # The side of the attacker of an upgrade has said all that it says.
                if message.startswith(b"GET /ws"):
                    connection.settimeout(0.05)
                while len(answer) < 1 << 16 and (more := connection.recv(65536)):
                    answer += more
            except (ConnectionError, socket.timeout):
                pass
            connection.close()
            judge(answer, message, count, studio.token)
        except OSError:
            with count.lock:
                count.sent += 1
                count.lost += 1
    for connection in slow:
        connection.close()


class Window:
    """The rightful window: edits a number, and waits for the answer to it."""

    def __init__(self, studio):
        self.connection = studio.connect()
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.rest = b""
        self.connection.sendall(upgrade(studio.host, f"http://{studio.host}"))
        while b"\r\n\r\n" not in self.rest:
            self.rest += self.connection.recv(65536)
        head, _, self.rest = self.rest.partition(b"\r\n\r\n")
        assert head.startswith(b"HTTP/1.1 101"), head
        self.send(type="hello", token=studio.token)
        self.send(type="open", scene="scene.json")
        self.version, self.text = 0, None
        while self.text is None:
            self.hear()
        self.answered = self.numbers = None

    def send(self, **message):
        self.connection.sendall(frame(json.dumps(message).encode()))

    def more(self, count):
        while len(self.rest) < count:
            got = self.connection.recv(1 << 20)
            if not got:
                raise ConnectionError("the window was closed")
            self.rest += got
        taken, self.rest = self.rest[:count], self.rest[count:]
        return taken

    def hear(self):
        first, size = self.more(2)
        if size == 126:
            (size,) = struct.unpack(">H", self.more(2))
        elif size == 127:
            (size,) = struct.unpack(">Q", self.more(8))
        payload = self.more(size)
        if first & 0x0F == 2:
            (length,) = struct.unpack("<I", payload[:4])
            self.answered = json.loads(payload[4 : 4 + length])["version"]
            self.send(type="shown")
        elif first & 0x0F == 1:
            message = json.loads(payload)
            if message["type"] == "opened":
                self.version, self.text = message["version"], message["text"]
            elif message["type"] == "updates":
                self.version = message["version"] + len(message["updates"])
            elif message["type"] == "pong":
                self.ponged = message["number"]

    def edit(self, drag):
        """Seconds from an edit to its answer."""
        inertia = re.search(r'"inertia": ([\d.]+)', self.text)
        number = f"{0.08 + 0.0004 * (drag % 100):.4f}"
        start, end = inertia.span(1)
        changes = [start, [end - start, number], len(self.text) - end]
        begun = time.perf_counter()
        self.send(type="push", version=self.version, updates=[{"changes": changes, "drag": drag // 20}])
        self.text = self.text[:start] + number + self.text[end:]
        wanted = self.version + 1
        while self.answered is None or self.answered < wanted:
            self.hear()
        return time.perf_counter() - begun

    def ping(self, number):
        begun = time.perf_counter()
        self.ponged = None
        self.send(type="ping", number=number)
        while self.ponged != number:
            self.hear()
        return time.perf_counter() - begun


def share(times, part):
    return sorted(times)[min(len(times) - 1, int(part * len(times)))] * 1e3 if times else float("nan")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("dam", help="the program")
    parser.add_argument("--count", type=int, default=100000)
    parser.add_argument("--threads", type=int, default=6)
    parser.add_argument("--within", type=float, default=100, help="milliseconds for 95 %% of the answers")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    arguments = parser.parse_args()
    print(f"seed {arguments.seed}")
    place = Place()
    studio = Studio(arguments.dam, place)
    count, stop = Count(), threading.Event()
    faults = []
    try:
        window = Window(studio)
        calm = [window.edit(number) for number in range(30)]
        attackers = [
            threading.Thread(target=attack, args=(studio, arguments.seed + k, -(-arguments.count // arguments.threads), count, stop), daemon=True)
            for k in range(arguments.threads)
        ]
        for attacker in attackers:
            attacker.start()
        answers, signs, memory = [], [], []
        asked = 30
        begun = time.perf_counter()
        while any(attacker.is_alive() for attacker in attackers):
            if studio.process.poll() is not None:
                faults.append(f"the program ended with status {studio.process.returncode}")
                break
            answers.append(window.edit(asked))
            signs.append(window.ping(asked))
            asked += 1
            memory.append(studio.memory())
            time.sleep(0.1)
        seconds = time.perf_counter() - begun
        # From a tenth on everything that is kept for good is there.
        settled = memory[len(memory) // 10 :] or [0]
        early, late = settled[: max(1, len(settled) // 4)], settled[-max(1, len(settled) // 4) :]
        grown = sum(late) / len(late) - sum(early) / len(early)
        print(f"{count.sent} hostile requests in {seconds:.0f} s: {count.refused} refused, {count.closed} closed, {count.lost} not connected, {len(count.served)} served")
        print(f"answers to the window: {len(answers)}, half within {share(answers, .5):.1f} ms, 95 % within {share(answers, .95):.1f} ms (undisturbed {share(calm, .95):.1f} ms)")
        print(f"signs of life: half within {share(signs, .5):.1f} ms, 95 % within {share(signs, .95):.1f} ms")
        print(f"memory: {settled[0]:.0f} MB, later {late[-1]:.0f} MB, grown by {grown:.1f} MB")
        if count.served:
            faults.append(f"served: {count.served[0]}")
        if share(answers, 0.95) > arguments.within:
            faults.append(f"95 % of the answers took longer than {arguments.within} ms")
        if grown > 16:
            faults.append("memory grows")
        if (place.base / "secret.json").read_text() != '{"dam": 1, "secret": true}' or (place.folder / "scene.json").read_text() != place.text:
            faults.append("a file was changed")
    except (ConnectionError, socket.timeout) as error:
        faults.append(f"the window was lost: {error}")
    finally:
        stop.set()
        studio.process.terminate()
        studio.process.wait()
        shutil.rmtree(place.base, ignore_errors=True)
    for fault in faults:
        print(f"FAILED: {fault}")
    print("failed" if faults else "all held")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
