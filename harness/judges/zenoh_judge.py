"""What a subscriber that is not of this kit hears of robots that meet over zenoh.

    zenoh_judge.py PROGRAM ENDPOINT

    eclipse-zenoh (EPL-2.0 OR Apache-2.0), the Python API, of an older version than the kit's
"""

import json
import queue
import subprocess
import sys

import zenoh


def main():
    program, endpoint = sys.argv[1:]
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    config.insert_json5("scouting/multicast/enabled", "false")
    config.insert_json5("connect/timeout_ms", "20000")
    heard = queue.Queue()
    kinds, senders = {}, set()
    with zenoh.open(config) as session:
        session.declare_subscriber("crossguard/v2x/*", heard.put)
        while len(kinds) < 2 or len(senders) < 2:
            sample = heard.get(timeout=30)
            assert sample.priority == zenoh.Priority.REAL_TIME, sample.priority
            assert sample.congestion_control == zenoh.CongestionControl.DROP
            sender = str(sample.key_expr).rsplit("/", 1)[1]
            senders.add(int(sender, 16))
            packet = bytes(sample.payload).hex()
            decode = [program, "codec", "decode", "--hex", packet]
            decoded = json.loads(subprocess.run(decode, check=True, capture_output=True).stdout)
            kind = next(iter(decoded["message"]))
            kinds[kind] = kinds.get(kind, 0) + 1
    assert {it.lower() for it in kinds} == {"ram", "rmcm"}, kinds
    print(f"eclipse-zenoh hears {sum(kinds.values())} packets of {len(senders)} robots: {kinds}",
          file=sys.stderr)


main()
