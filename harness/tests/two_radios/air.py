"""The air between two radios: relays Ethernet frames between two interfaces, loses some and delays all of them.
python3 air.py INTERFACE INTERFACE LOSS DELAY_MIN_MS DELAY_MAX_MS COUNTS

Frames overtake each other, as the delay of each is drawn anew. COUNTS gets "RELAYED LOST" when it is told to stop."""
import heapq, random, select, signal, socket, sys, time

names, (loss, at_least, at_most), counts = sys.argv[1:3], map(float, sys.argv[3:6]), sys.argv[6]
chance, waiting, relayed, lost = random.Random(1), [], 0, 0


def end(*_):
    with open(counts, "w") as file:
        file.write(f"{relayed} {lost}")
    sys.exit()


signal.signal(signal.SIGTERM, end)
ends = []
for name in names:
    link = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(0x8947))
    link.bind((name, 0x8947))
    ends.append(link)
while True:
    now = time.monotonic()
    while waiting and waiting[0][0] <= now:
        _, _, to, frame = heapq.heappop(waiting)
        ends[to].send(frame)
        relayed += 1
    patience = max(0.0, waiting[0][0] - now) if waiting else 1.0
    for link in select.select(ends, [], [], patience)[0]:
        frame, (_, _, kind, *_) = link.recvfrom(2048)
        if kind == socket.PACKET_OUTGOING:
            continue
        if chance.random() < loss:
            lost += 1
            continue
        due = time.monotonic() + chance.uniform(at_least, at_most) / 1000
        heapq.heappush(waiting, (due, relayed + lost + len(waiting), 1 - ends.index(link), frame))
