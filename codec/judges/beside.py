"""A car, a pedestrian and a robot beside a crossing, signed by nothing of the kit: harness/robot/tests/beside.json.

Messages are encoded by asn1tools 0.169.0 from values of the golden vectors, headers and certificates octet by octet,
and signed in Python, below a root of their own. They have the forms that IEEE 1609.2 allows and the kit does not use:
rSig as a point with y or with its parity, n - s for s, a key with both coordinates, contributedExtensions.
"""

import json
import math
import os
import pathlib
import re
import struct
import sys

import asn1tools
from judge import ASN1, MODULES, without_defaults
from secured import G, N, P, Certificate, Reader, sha256, times

CODEC = pathlib.Path(__file__).parent.parent
FILE = CODEC.parent / "harness" / "robot" / "tests" / "beside.json"
# When the first message is generated, in ms of TimestampIts: 30 s after the robots of the test started.
BEGAN = 694_694_401_000 + 30_000
# The site of the test, in degrees, and metres per degree.
ORIGIN, DEGREE = (49.0101, 8.4124), 111_195.0
CAM, VAM, RAM = 36, 638, 16_480
PORTS = {CAM: 2001, VAM: 2018, RAM: 2998}
BITS = {CAM: b"\1\0\0", VAM: b"\1", RAM: b"\1\xc0"}
# Of each kind of station: its ITS-AID, the form of rSig, whether its key is compressed, the container that moves.
KINDS = {
    "CAM": (CAM, 0x82, False, "highFrequencyContainer"),
    "VAM": (VAM, 0x84, True, "vruHighFrequencyContainer"),
    "RAM": (RAM, 0x82, True, "robotHighFrequencyContainer"),
}
# A request for a revocation list (TS 102 941): contributor 2, extension 1.
CONTRIBUTED = bytes.fromhex("0204101101010201010b010900aabbccdd00112233")


def opaque(octets):
    length = len(octets)
    if length < 128:
        return bytes([length]) + octets
    return (b"\x81" + bytes([length]) if length < 256 else b"\x82" + struct.pack(">H", length)) + octets


def integer(value):
    return opaque(value.to_bytes(max(1, (value.bit_length() + 7) // 8), "big"))


def point(key, is_compressed):
    x, y = (part.to_bytes(32, "big") for part in times(key, G))
    return bytes([0x82 | y[31] & 1]) + x if is_compressed else b"\x84" + x + y


def sign(key, data, signer, form, is_low=None):
    """A signature with rSig in this form: 0x80 for x alone, 0x82 for the parity of y, 0x84 for y."""
    digest = sha256(sha256(data) + sha256(signer))
    k = int.from_bytes(sha256(key.to_bytes(32, "big") + digest), "big") % (N - 1) + 1
    x, y = times(k, G)
    s = pow(k, -1, N) * (int.from_bytes(digest, "big") + x * key) % N
    if is_low is not None and (s < N - s) != is_low:
        s, y = N - s, -y % P
    r = bytes([form | y & 1 if form == 0x82 else form]) + x.to_bytes(32, "big")
    return b"\x80" + r + (y.to_bytes(32, "big") if form == 0x84 else b"") + s.to_bytes(32, "big")


class Issued:
    """A certificate: in canonical form, and as it is sent."""

    def __init__(self, key, issuer, name=None, permits=(), issues=(), minimum=1, form=0x80, is_compressed=True):
        self.key = key
        signer = issuer or self
        head = b"\x80\3\0" + (b"\x80" + issuer.id if issuer else b"\x81\0")
        preamble = (0x10 if permits else 0) | (0x08 if issues else 0)
        body = bytes([preamble]) + (b"\x81" + opaque(name.encode()) if name else b"\x83") + bytes(5)
        # From an hour before, for 24 hours; issuers for a hundred more each.
        hours = 24 + 100 * minimum * bool(issues)
        body += struct.pack(">IBH", BEGAN // 1000 - 3600 * (1 + minimum * bool(issues)), 0x84, hours)
        if permits:
            body += integer(len(permits))
            for psid in permits:
                body += b"\x80" + integer(psid) + b"\x81" + opaque(opaque(BITS[psid]))
        if issues:
            body += b"\1\1" + bytes([0x80 if minimum != 1 else 0, 0x80]) + integer(len(issues))
            for psid in issues:
                body += b"\x80" + integer(psid) + b"\x81"
            body += integer(minimum) if minimum != 1 else b""
        body += b"\x80\x80"
        canonical = body + point(key, True)
        above = issuer.octets if issuer else b""
        # The lower s: then the station id of a robot is in the digest of this certificate itself.
        self.octets = head + canonical + sign(signer.key, canonical, above, 0x80, True)
        self.sent = head + body + point(key, is_compressed) + sign(signer.key, canonical, above, form, True)
        read = Certificate(Reader(self.sent))
        assert read.octets == self.octets and read.is_signed_by(Certificate(Reader(signer.octets)) if issuer else read)
        self.id = sha256(self.octets)[-8:]


def place(east, north):
    latitude = ORIGIN[0] + north / DEGREE
    longitude = ORIGIN[1] + east / (DEGREE * math.cos(math.radians(ORIGIN[0])))
    return round(latitude * 1e7), round(longitude * 1e7)


class Station:
    """Somebody who says where they are."""

    def __init__(self, kind, value, authority, key, ways):
        self.kind, self.value, self.ways = kind, value, ways
        self.psid, self.form, is_compressed, self.container = KINDS[kind]
        self.ticket = Issued(key, authority, permits=[self.psid], form=self.form, is_compressed=is_compressed)
        self.station = int.from_bytes(self.ticket.id[:4], "big")
        self.said = 0

    def say(self, kit, at_ms):
        east, north, speed, heading = self.ways(at_ms / 1000)
        latitude, longitude = place(east, north)
        its = BEGAN + at_ms
        self.value["header"]["stationId"] = self.station
        body = self.value[self.kind.lower()]
        body["generationDeltaTime"] = its % 65536
        parameters = body[self.kind.lower() + "Parameters"]
        position = parameters["basicContainer"]["referencePosition"]
        position["latitude"], position["longitude"] = latitude, longitude
        moving = parameters[self.container]
        moving = moving[1] if isinstance(moving, tuple) else moving
        moving["speed"]["speedValue"] = speed * 100
        moving["heading"]["headingValue" if self.kind == "CAM" else "value"] = heading * 10
        message = kit.encode(self.kind, without_defaults(self.value))
        address = struct.pack(">HBBI", (12 if self.kind == "RAM" else 5) << 10, 2, 0, self.station)
        # Its position is accurate.
        speed_and_flag = 0x8000 | speed * 100
        vector = address + struct.pack(">IiiHH", its % 2**32, latitude, longitude, speed_and_flag, heading * 10)
        payload = b"\x20\x50\2\x80" + struct.pack(">H", 4 + len(message)) + b"\1\0" + vector + bytes(4)
        payload += struct.pack(">HH", PORTS[self.psid], 0) + message
        additions = CONTRIBUTED if self.kind == "CAM" else b""
        header = bytes([0xC0 if additions else 0x40]) + integer(self.psid) + struct.pack(">Q", its * 1000) + additions
        data = b"\x40\3\x80" + opaque(payload) + header
        signer = b"\x80" + self.ticket.id if self.said % 3 else b"\x81\1\1" + self.ticket.sent
        # By turns the lower and the higher s.
        signature = sign(self.ticket.key, data, self.ticket.octets, self.form, self.said % 2 == 0)
        self.said += 1
        return {"atMs": at_ms, "kind": self.kind, "octets": (b"\x12\0\x1a\1\3\x81\0" + data + signer + signature).hex()}


def vector(file, pattern):
    return bytes.fromhex(re.search(pattern, (CODEC / "tests" / "golden" / file).read_text(), re.MULTILINE)[1])


def make():
    kit = asn1tools.compile_files([str(ASN1 / f"Crossguard-{name}.asn") for name in MODULES], "uper")
    root = Issued(1001, None, "root of others", issues=[CAM, VAM, RAM], minimum=2)
    authority = Issued(1002, root, "authority of others", issues=[CAM, VAM, RAM])
    cam = kit.decode("CAM", vector("its.txt", r"^C1: (\w+)"))
    vam = kit.decode("VAM", vector("vam.txt", r"^V1: (\w+)"))
    ram = kit.decode("RAM", vector("messages.json", r'"octets": "(\w+)"'))
    # From the east at 14 m/s: over the crossing, whose middle is 1 m east and 3.5 m north, after 9 s.
    car = Station("CAM", cam, authority, 1003, lambda s: (1 + 14 * (9 - s), 3.5, 14, 270))
    person = Station("VAM", vam, authority, 1004, lambda s: (20, -30, 0, 0))
    robot = Station("RAM", ram, authority, 1005, lambda s: (-20, -30, 0, 0))
    said = [car.say(kit, at) for at in range(0, 12_000, 400)]
    said += [it.say(kit, at) for it in (person, robot) for at in range(100, 12_000, 2_000)]
    return {
        "about": "A car, a pedestrian and a robot beside a crossing, by codec/judges/beside.py",
        "beganIts": BEGAN,
        "root": root.octets.hex(),
        "authority": authority.octets.hex(),
        "stations": {it.kind: it.station for it in (car, person, robot)},
        "packets": sorted(said, key=lambda packet: packet["atMs"]),
    }


if __name__ == "__main__":
    text = json.dumps(make(), indent=1) + "\n"
    if "CROSSGUARD_BLESS" in os.environ:
        FILE.write_text(text)
    elif text != FILE.read_text():
        sys.exit(f"{FILE.name} is not what beside.py makes: cargo xtask bless beside.json")
    print("beside.py: beside.json is what others sign")
