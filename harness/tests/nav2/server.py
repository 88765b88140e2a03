"""Plays Nav2 with a robot: python3 server.py X Y TIMES_FASTER. It serves rclpy.py of this folder at a free port of
127.0.0.1, which is its first line; then each line says what happens. Goals with y > 1000 are rejected, those with y > 500
aborted, and those with x > 500 are not cancelled.
"""
import json, math, selectors, socket, sys, time

SUCCEEDED, CANCELED, ABORTED = 4, 5, 6


class Robot:
    def __init__(self, place, faster):
        self.place, self.faster, self.yaw, self.limit = place, faster, 0.0, 0.0
        self.goal = self.to = self.client = None

    def pose(self):
        x, y = self.place
        return {"x": x, "y": y, "z": math.sin(self.yaw / 2), "w": math.cos(self.yaw / 2)}

    def take(self, client, line):
        if line["op"] == "subscribe":
            say(client, "pose", **self.pose())
        elif line["op"] == "limit":
            self.limit = line["speed"]
            print(f"limit {self.limit:g}", flush=True)
        elif line["op"] == "goal":
            self.begin(client, line["id"], (line["x"], line["y"]), line["frame"])
        elif line["op"] == "cancel":
            if self.goal and (line["all"] or line["id"] == self.goal) and self.to[0] <= 500:
                self.end(CANCELED, "all cancelled" if line["all"] else "cancelled")
            say(client, "cancelled", id=line["id"])

    def begin(self, client, number, to, frame):
        is_taken = to[1] <= 1000
        print(f"{'goal' if is_taken else 'rejected'} {to[0]:.2f} {to[1]:.2f} in {frame}", flush=True)
        if is_taken and self.goal:
            self.end(ABORTED, "replaced")
        say(client, "response", id=number, accepted=is_taken)
        if is_taken:
            self.goal, self.to, self.client = number, to, client
        if is_taken and to[1] > 500:
            self.end(ABORTED, "aborted")

    def advance(self, seconds):
        if not self.goal:
            return
        way, step = math.dist(self.place, self.to), (self.limit or 0.5) * self.faster * seconds
        if way > 0:
            self.yaw = math.atan2(self.to[1] - self.place[1], self.to[0] - self.place[0])
        share = min(1.0, step / way) if way > 0 else 1.0
        self.place = tuple(a + (b - a) * share for a, b in zip(self.place, self.to))
        say(self.client, "feedback", id=self.goal, **self.pose())
        if share == 1.0:
            self.end(SUCCEEDED, "succeeded")

    def end(self, status, what):
        print(f"{what} at {self.place[0]:.2f} {self.place[1]:.2f}", flush=True)
        say(self.client, "result", id=self.goal, status=status)
        self.goal = None


def say(client, op, **more):
    try:
        client.sendall((json.dumps({"op": op, **more}) + "\n").encode())
    except OSError:
        pass  # Nav2 does not care whether its client lives


def main():
    x, y, faster = map(float, sys.argv[1:])
    robot, waiting, last = Robot((x, y), faster), selectors.DefaultSelector(), time.monotonic()
    listener = socket.create_server(("127.0.0.1", 0))
    waiting.register(listener, selectors.EVENT_READ, None)
    print("127.0.0.1:%d" % listener.getsockname()[1], flush=True)
    texts = {}
    while True:
        for key, _ in waiting.select(0.01):
            if key.fileobj is listener:
                client, _ = listener.accept()
                waiting.register(client, selectors.EVENT_READ)
                texts[client] = b""
                continue
            client = key.fileobj
            try:
                octets = client.recv(4096)
            except OSError:
                octets = b""
            if not octets:
                waiting.unregister(client)
                continue
            *lines, texts[client] = (texts[client] + octets).split(b"\n")
            for line in lines:
                robot.take(client, json.loads(line))
        now = time.monotonic()
        robot.advance(now - last)
        last = now


main()
