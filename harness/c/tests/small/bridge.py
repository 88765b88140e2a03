"""The outside of a robot on a microcontroller: runs it in QEMU, and carries its frames over the serial line.
python3 bridge.py measure QEMU...
python3 bridge.py lead|follow STATION PORT PEER_PORT LOG QEMU...

It sends the robot's packets by UDP to PEER_PORT of 127.0.0.1 and hands over what arrives at PORT. LOG gets the robot's
log. What the robot says goes to standard output. The exit code is 0 when its crossing came to its end."""
import os, select, signal, socket, struct, subprocess, sys, time

LIMIT_S = 120


class Line:
    """The serial line: frames of a kind, two octets of length, and so many octets."""

    def __init__(self, command):
        self.qemu = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.octets = b""

    def send(self, kind, octets):
        self.qemu.stdin.write(kind + struct.pack(">H", len(octets)) + octets)
        self.qemu.stdin.flush()

    def frames(self):
        octets = os.read(self.qemu.stdout.fileno(), 65_536)
        if not octets:
            sys.exit("QEMU has ended")
        self.octets += octets
        while len(self.octets) >= 3:
            length = 3 + struct.unpack_from(">H", self.octets, 1)[0]
            if len(self.octets) < length:
                return
            frame, self.octets = self.octets[:length], self.octets[length:]
            yield frame[:1], frame[3:]


def main(mode, *rest):
    if mode == "measure":
        (station, port, peer, log), command = (1, 0, 0, os.devnull), rest
    else:
        (station, port, peer, log), command = rest[:4], rest[4:]
    air = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    air.bind(("127.0.0.1", int(port)))
    line = Line(command)
    try:
        return carry(line, air, mode, int(station), int(peer), log)
    finally:
        line.qemu.kill()
        line.qemu.wait()


def carry(line, air, mode, station, peer, log):
    until, has_begun = time.monotonic() + LIMIT_S, False
    with open(log, "wb") as log:
        while time.monotonic() < until:
            readable = select.select([line.qemu.stdout, air], [], [], 1.0)[0]
            if air in readable:
                packet = air.recv(2_048)
                # Before it has begun, its serial line may lose a part of a frame.
                if has_begun:
                    line.send(b"P", packet)
            if line.qemu.stdout not in readable:
                continue
            for kind, octets in line.frames():
                if kind == b"S" and octets.startswith((b"Cortex", b"RV32")):
                    mission = struct.pack(">cIHQ", mode[:1].encode(), station, 1, time.time_ns() // 1_000_000)
                    line.send(b"M", mission)
                    has_begun = True
                if kind == b"S":
                    print(octets.decode(), flush=True)
                elif kind == b"L":
                    log.write(octets)
                elif kind == b"P" and peer:
                    air.sendto(octets, ("127.0.0.1", peer))
                elif kind == b"E":
                    return 0 if octets == b"\x01" else 1
    print(f"no end after {LIMIT_S} s", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
