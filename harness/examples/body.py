"""A body for `crossguard run` in some thirty lines: python3 body.py ADDRESS [EAST NORTH [TIMES_FASTER]]"""
import json, math, socket, sys, time

address, numbers = sys.argv[1], [float(word) for word in sys.argv[2:]]
place, pace = numbers[:2] or [0.0, 0.0], numbers[2] if len(numbers) > 2 else 1.0
link = socket.socket(socket.AF_UNIX)
link.connect(address.removeprefix("unix:"))
link.settimeout(0.02)
say = lambda type, **more: link.sendall((json.dumps({"type": type, **more}) + "\n").encode())
say("hello", crossguard=3)
target, speed, done, waits, begin, text, heard, last = None, 0.0, None, False, place, b"", time.monotonic(), time.monotonic()
while True:
    try:
        octets = link.recv(4096)
        text, heard = text + octets, time.monotonic()
        if not octets: sys.exit("the robot has closed the port")
    except socket.timeout: pass
    if target and time.monotonic() - heard > 0.5:  # the robot is silent: stand still, and say what that ends
        target, done = None, done and done[1] and say("failed", **done[1])
    *lines, text = text.split(b"\n")
    for line in map(json.loads, lines):
        if line["type"] not in ("beat", "release"): waits = line["type"] == "wait"
        to = line.get("to") and [line["to"]["eastM"], line["to"]["northM"]]
        if line["type"] == "start": begin, target, speed, done = place, to or place, line["speedMps"] or 0.5, (line["report"], {"id": line["id"]})
        if line["type"] == "go": target, speed, done = to, 0.5, None
        if line["type"] in ("stop", "halt", "refused"): target = None
        if line["type"] == "fall-back":
            ends = [begin, target or place] if line["policy"] == "escort-to-kerb" else [place]
            target, done = min(ends, key=lambda end: math.dist(end, place)), ("fallen-back", {"id": line["id"]})
    if target and not waits:
        step, way = (time.monotonic() - last) * speed * pace, math.dist(place, target)
        place = target if way <= step else [a + (b - a) * step / way for a, b in zip(place, target)]
    last = time.monotonic()
    say("pose", eastM=place[0], northM=place[1], errorM=0.2, speedMps=speed if target and place != target and not waits else 0.0)
    if target == place:
        target, done = None, done and say(done[0], **done[1])
