"""Reads the vectors of secured packets, codec/tests/golden/security.json, by the standards alone.

A reader of its own, on Python's standard library: IEEE 1609.2 in COER, SHA-256 of both digests, ECDSA on NIST P-256.
It does not judge times, places and permissions. It says that each packet is what the file claims of it: one that is
taken, or refused for anything but its octets or signatures, is well formed, and the signatures of its message and of
its certificate are right; one that is refused for a signature has exactly that one wrong.
"""

import hashlib
import json
import pathlib
import sys

VECTORS = pathlib.Path(__file__).parent.parent / "tests" / "golden" / "security.json"

# NIST P-256 (FIPS 186-4, D.1.2.3).
P = 0xFFFFFFFF00000001000000000000000000000000FFFFFFFFFFFFFFFFFFFFFFFF
N = 0xFFFFFFFF00000000FFFFFFFFFFFFFFFFBCE6FAADA7179E84F3B9CAC2FC632551
B = 0x5AC635D8AA3A93E7B3EBBD55769886BC651D06B0CC53B0F63BCE3C3E27D2604B
G = (
    0x6B17D1F2E12C4247F8BCE6E563A440F277037D812DEB33A0F4A13945D898C296,
    0x4FE342E2FE1A7F9B8EE7EB4A7C0F9E162BCE33576B315ECECBB6406837BF51F5,
)


class Malformed(Exception):
    """Octets that are no envelope or certificate, or one that this reader need not know."""


def sha256(octets):
    return hashlib.sha256(octets).digest()


def add(a, b):
    if a is None or b is None:
        return a or b
    if a[0] == b[0]:
        if (a[1] + b[1]) % P == 0:
            return None
        slope = (3 * a[0] * a[0] - 3) * pow(2 * a[1], -1, P) % P
    else:
        slope = (b[1] - a[1]) * pow(b[0] - a[0], -1, P) % P
    x = (slope * slope - a[0] - b[0]) % P
    return x, (slope * (a[0] - x) - a[1]) % P


def times(k, point):
    result = None
    while k:
        if k & 1:
            result = add(result, point)
        point = add(point, point)
        k >>= 1
    return result


def point_of(odd, x):
    square = (x * x * x - 3 * x + B) % P
    y = pow(square, (P + 1) // 4, P)
    if y * y % P != square:
        raise Malformed("no point on the curve")
    return x, y if y & 1 == odd else P - y


def verifies(key, data, signer, signature):
    """IEEE 1609.2, 5.3.1: what is signed is the digest of the digests of data and of the signer's certificate."""
    r, s = signature
    e = int.from_bytes(sha256(sha256(data) + sha256(signer)), "big")
    w = pow(s, -1, N)
    point = add(times(e * w % N, G), times(r * w % N, key))
    return point is not None and point[0] % N == r


class Reader:
    def __init__(self, octets):
        self.octets, self.at = octets, 0

    def take(self, count):
        taken = self.octets[self.at : self.at + count]
        if len(taken) < count:
            raise Malformed("the octets end")
        self.at += count
        return taken

    def octet(self):
        return self.take(1)[0]

    def expect(self, *octets):
        found = self.take(len(octets))
        if found != bytes(octets):
            raise Malformed(f"{found.hex()}, not {bytes(octets).hex()}")

    def opaque(self):
        length = self.octet()
        if length >= 0x80:
            length = int.from_bytes(self.take(length & 0x7F), "big")
        return self.take(length)

    def integer(self):
        return int.from_bytes(self.opaque(), "big")

    def additions(self):
        bitmap = self.opaque()
        for bit in range(8 * (len(bitmap) - 1)):
            if bitmap[1 + bit // 8] & 0x80 >> bit % 8:
                self.opaque()

    def point(self):
        """A point in compressed form, in whichever it comes."""
        form, x = self.octet(), self.take(32)
        if form == 0x84:
            form = 0x82 | self.take(32)[-1] & 1
        if form not in (0x82, 0x83):
            raise Malformed("no point")
        return bytes([form]) + x

    def signature(self):
        self.expect(0x80)
        # x alone, or a point that is written with y or the parity of it.
        form = self.octet()
        if form not in (0x80, 0x82, 0x83, 0x84):
            raise Malformed("rSig in another form")
        r = int.from_bytes(self.take(32), "big")
        self.take(32 if form == 0x84 else 0)
        s = int.from_bytes(self.take(32), "big")
        if not (0 < r < N and 0 < s < N):
            raise Malformed("a signature out of range")
        return r, s


class Certificate:
    def __init__(self, reader):
        start = reader.at
        reader.expect(0x80, 3, 0)
        self.issuer = None
        if reader.octet() == 0x80:
            self.issuer = reader.take(8)
        else:
            reader.expect(0)
        signed = reader.at - start
        preamble = reader.octet()
        kind = reader.octet()
        if kind not in (0x81, 0x83):
            raise Malformed("an id but name and none")
        if kind == 0x81:
            reader.opaque()
        reader.take(5 + 4)
        if reader.octet() > 0x86:
            raise Malformed("a duration without a unit")
        reader.take(2)
        if preamble & 0x06:
            raise Malformed("permissions to request certificates")
        if preamble & 0x40:
            shape = reader.octet()
            if shape not in (0x80, 0x81):
                raise Malformed("a region but circles and rectangles")
            reader.take(10 if shape == 0x80 else 16 * reader.integer())
        if preamble & 0x20:
            reader.octet()
        if preamble & 0x10:
            for _ in range(reader.integer()):
                has_ssp = reader.octet()
                reader.integer()
                if has_ssp:
                    if reader.octet() not in (0x80, 0x81):
                        raise Malformed("permissions of a third kind")
                    reader.opaque()
        if preamble & 0x08:
            for _ in range(reader.integer()):
                given = reader.octet()
                reader.expect(0x80)
                for _ in range(reader.integer()):
                    reader.expect(0x80)
                    reader.integer()
                    reader.expect(0x81)
                for bit in (0x80, 0x40):
                    if given & bit:
                        reader.opaque()
                if given & 0x20:
                    reader.octet()
        # In canonical form points are compressed, and rSig is x alone.
        canonical = b""
        if preamble & 0x01:
            reader.octet()
            if reader.octet() not in (0x80, 0x81):
                raise Malformed("an encryption key but ECIES")
            canonical = reader.octets[start : reader.at] + reader.point()
            start = reader.at
        reader.expect(0x80, 0x80)
        canonical += reader.octets[start : reader.at]
        key = reader.point()
        self.key = point_of(key[0] & 1, int.from_bytes(key[1:], "big"))
        canonical += key
        start = reader.at
        if preamble & 0x80:
            reader.additions()
        canonical += reader.octets[start : reader.at]
        self.signed = canonical[signed:]
        self.signature = reader.signature()
        r, s = (number.to_bytes(32, "big") for number in self.signature)
        self.octets = canonical + b"\x80\x80" + r + s
        self.id = sha256(self.octets)[-8:]

    def is_signed_by(self, issuer):
        octets = issuer.octets if issuer is not self else b""
        return verifies(issuer.key, self.signed, octets, self.signature)


class Envelope:
    def __init__(self, packet, known):
        reader = Reader(packet)
        if reader.take(4)[0] != 0x12:
            raise Malformed("not a secured packet")
        reader.expect(3, 0x81, 0)
        start = reader.at
        reader.expect(0x40, 3, 0x80)
        reader.opaque()
        preamble = reader.octet()
        if not preamble & 0x40 or preamble & 0x0F:
            raise Malformed("no generationTime, or a field of another profile")
        reader.integer()
        reader.take(8)
        if preamble & 0x20:
            reader.take(8)
        if preamble & 0x10:
            reader.take(10)
        if preamble & 0x80:
            reader.additions()
        self.signed = reader.octets[start : reader.at]
        self.certificate = None
        if reader.octet() == 0x81:
            reader.expect(1, 1)
            self.certificate = Certificate(reader)
            self.signer = self.certificate
        else:
            self.signer = known.get(reader.take(8))
        self.signature = reader.signature()
        if reader.at != len(reader.octets):
            raise Malformed("octets follow the signature")

    def is_signed(self):
        return verifies(self.signer.key, self.signed, self.signer.octets, self.signature)


def judge(packet, expected, known, issuers):
    """What is wrong with a packet that its octets and signatures show."""
    try:
        envelope = Envelope(packet, known)
    except Malformed as error:
        # These the file refuses for their octets, or for a field that this reader does not read over.
        octets = ("malformed envelope", "unsupported", "not signed", "not secured", "against profile")
        return [] if expected in octets else [f"cannot be read ({error})"]
    if envelope.signer is None:
        return [] if expected in ("unknown certificate", "against profile") else ["its signer is not known"]
    wrong = []
    if envelope.is_signed() == (expected in ("wrong signature", "refused before")):
        wrong.append("the signature of the message")
    issuer = envelope.certificate and issuers.get(envelope.certificate.issuer)
    if issuer:
        if envelope.certificate.is_signed_by(issuer) == (expected == "wrong certificate signature"):
            wrong.append("the signature of the certificate")
    elif envelope.certificate and expected not in ("foreign root", "not a ticket"):
        wrong.append("its issuer")
    if expected is None:
        known[envelope.signer.id] = envelope.signer
    return wrong


def main():
    file = json.loads(VECTORS.read_text())
    root, authority = (Certificate(Reader(bytes.fromhex(file[name]))) for name in ("root", "authority"))
    if not (root.is_signed_by(root) and authority.is_signed_by(root) and authority.issuer == root.id):
        sys.exit("the chain of root and authority is wrong")
    issuers = {certificate.id: certificate for certificate in (root, authority)}
    packets = bad = 0
    for vector in file["vectors"]:
        known = {}
        for packet in vector["packets"]:
            packets += 1
            for wrong in judge(bytes.fromhex(packet["octets"]), packet["refused"], known, issuers):
                bad += 1
                print(f"{vector['name']} ({packet['refused'] or 'taken'}): {wrong}")
    if bad or packets < 110:
        sys.exit(f"{bad} of {packets} packets are not what the file says")
    print(f"secured.py: {packets} packets are what the file says of them")


if __name__ == "__main__":
    main()
