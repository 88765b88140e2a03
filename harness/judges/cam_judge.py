"""What an independent decoder makes of the CAM of this kit.

    python cam_judge.py FILE STATION

reads the packets of FILE, a pcap file as `crossguard run --cam --pcap` writes it, takes Ethernet,
GeoNetworking and BTP off by itself, and decodes every CAM by pycrate from ETSI's own module of release 1.
The robot has to be in each: its id in the header, its station type, a place on earth, its size; and the low
frequency container in the first one and 500 ms apart. Ends with exit code 0 when that is so.

    pycrate (LGPL-2.1) 0.8.1
"""

import struct
import sys

from pycrate_asn1dir.ITS_CAM_2 import CAM_PDU_Descriptions

CAM_PORT = 2001
LIGHT_VRU_VEHICLE = 12


def frames(path):
    """The frames of a pcap file with microseconds, each with its time in seconds."""
    with open(path, "rb") as file:
        assert struct.unpack("<I", file.read(24)[:4])[0] == 0xA1B2C3D4, "a pcap file"
        while header := file.read(16):
            seconds, micros, length, _ = struct.unpack("<4I", header)
            yield seconds + micros / 1e6, file.read(length)


def message(frame):
    """The destination port of BTP-B and what is behind it; None of what is no single-hop broadcast."""
    ethertype, packet = struct.unpack(">H", frame[12:14])[0], frame[14:]
    assert ethertype == 0x8947, hex(ethertype)
    version, following = packet[0] >> 4, packet[0] & 15
    common = packet[4:12]
    if (version, following, common[1]) != (1, 1, 0x50):
        return None
    btp = packet[12 + 28:]
    return struct.unpack(">H", btp[:2])[0], btp[4:]


def main():
    path, station = sys.argv[1], int(sys.argv[2])
    cam, found, slow_s = CAM_PDU_Descriptions.CAM, [], None
    for at_s, frame in frames(path):
        port, octets = message(frame) or (None, b"")
        if port != CAM_PORT:
            continue
        cam.from_uper(octets)
        value = cam.get_val()
        header, parameters = value["header"], value["cam"]["camParameters"]
        assert (header["protocolVersion"], header["messageID"]) == (2, 2), header
        assert header["stationID"] == station, header
        basic = parameters["basicContainer"]
        place = basic["referencePosition"]
        assert basic["stationType"] == LIGHT_VRU_VEHICLE, basic
        assert abs(place["latitude"]) < 900_000_000 and abs(place["longitude"]) < 1_800_000_000, place
        kind, motion = parameters["highFrequencyContainer"]
        assert kind == "basicVehicleContainerHighFrequency", kind
        assert motion["vehicleLength"]["vehicleLengthValue"] < 1_022, motion
        assert motion["vehicleWidth"] < 61 and motion["speed"]["speedValue"] < 16_382, motion
        if "lowFrequencyContainer" in parameters:
            assert slow_s is None or at_s - slow_s > 0.45, (at_s, slow_s)
            assert parameters["lowFrequencyContainer"][1]["vehicleRole"] == "default", parameters
            slow_s = at_s
        assert slow_s is not None, "the first CAM has the low frequency container"
        cam.set_val(value)
        assert cam.to_uper() == octets, octets.hex()
        found.append(at_s)
    gaps = [after - before for before, after in zip(found, found[1:])]
    assert len(found) >= 3 and all(0.09 < gap < 1.2 for gap in gaps), gaps
    print(f"pycrate sees station {station} in {len(found)} CAM of {path}", file=sys.stderr)


main()
