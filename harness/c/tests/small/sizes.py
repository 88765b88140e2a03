"""The sizes of the sections of an ELF file of 32 bits: python3 sizes.py FILE"""
import struct, sys

with open(sys.argv[1], "rb") as file:
    octets = file.read()
table, = struct.unpack_from("<I", octets, 32)
size, count, names = struct.unpack_from("<HHH", octets, 46)
sections = [struct.unpack_from("<10I", octets, table + size * nth) for nth in range(count)]
for name, _, flags, _, _, length, *_ in sections:
    start = sections[names][4] + name
    if flags & 2 and length:
        print(octets[start : octets.index(b"\0", start)].decode(), length)
