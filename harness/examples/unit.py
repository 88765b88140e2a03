"""An on-board unit: the robot attached to it sends and receives by UDP multicast on loopback."""
import select, socket, struct, time

GROUP, HEADER = ("239.118.50.18", 47418), ">2sBBHHHBxhHQ"  # magic, version, kind, length, port, info, TC, power, busy, time
robots, address = socket.socket(type=socket.SOCK_DGRAM), None
robots.bind(("127.0.0.1", 4747))
radio = socket.socket(type=socket.SOCK_DGRAM)
radio.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
radio.bind(GROUP)
radio.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(GROUP[0]) + socket.inet_aton("127.0.0.1"))
radio.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
while True:
    for ready in select.select([robots, radio], [], [])[0]:
        octets, sender = ready.recvfrom(2048)
        kind, body = (3, octets) if ready is radio else (5, b"")  # a reception, or an answer to a hello
        if ready is robots:
            address = sender
            if octets[3] == 1:  # send this packet
                radio.sendto(octets[24:], GROUP)
            if octets[3] != 0:
                continue
        now = time.time_ns() // 1000
        if address:
            robots.sendto(struct.pack(HEADER, b"CG", 1, kind, len(body), 0, 0, 0, -32768, 2000, now) + body, address)
