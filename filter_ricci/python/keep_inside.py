# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps inside a library for macOS what zig's linker leaves open: takes out of its exports all names that
do not begin with a prefix, and has the loader exchange nothing of it, such as parts of the C++ library, for
those of other libraries. Then signs it as zig had, by the hashes of its pages; for Intel zig signs nothing.
Usage: keep_inside.py LIBRARY PREFIX"""

import hashlib
import struct
import sys

DYLD_INFO = 0x80000022
CODE_SIGNATURE = 0x1d
SIGNATURE, DIRECTORY = 0xfade0cc0, 0xfade0c02
FLAGS, WEAK = 24, 0x8000 | 0x10000  # place of the header's flags; has weak names, binds to such
SHA256 = (32, 2)  # bytes of a hash, and the number of its kind


def commands(data):
    """Kind of each load command -> its place."""
    magic, _, _, _, count = struct.unpack_from("<5I", data)
    if magic != 0xfeedfacf:
        sys.exit("This is no library for macOS of 64 bits.")
    place, found = 32, {}
    for _ in range(count):
        kind, size = struct.unpack_from("<2I", data, place)
        found[kind] = place
        place += size
    return found


def read_number(data, place):
    """Of seven bits a byte; and where it ends."""
    value = shift = 0
    while True:
        byte = data[place]
        value |= (byte & 0x7f) << shift
        place, shift = place + 1, shift + 7
        if byte < 0x80:
            return value, place


def number(value):
    text = bytearray()
    while value >= 0x80:
        text.append(value & 0x7f | 0x80)
        value >>= 7
    return bytes(text) + bytes([value])


def exports(trie, place=0, prefix=b""):
    """Name and what is known of it, of all names below a node."""
    size, place = read_number(trie, place)
    if size:
        yield prefix, trie[place:place + size]
    place += size
    children, place = trie[place], place + 1
    for _ in range(children):
        end = trie.index(b"\0", place)
        child, after = read_number(trie, end + 1)
        yield from exports(trie, child, prefix + trie[place:end])
        place = after


def nodes_of(entries):
    """A trie as a list of nodes: what is known of the name that ends there, and pairs of a label and
    the number of a node."""
    nodes = []

    def add(below):
        own = len(nodes)
        nodes.append([below.pop(b"", b""), []])
        while below:
            first = min(below)[:1]
            group = {name: below.pop(name) for name in sorted(below) if name[:1] == first}
            low, high = min(group), max(group)
            shared = next((i for i, (a, b) in enumerate(zip(low, high)) if a != b), len(low))
            label = low[:shared]
            nodes[own][1].append((label, add({name[shared:]: known for name, known in group.items()})))
        return own
    add(dict(entries))
    return nodes


def trie_of(entries):
    nodes = nodes_of(entries)
    places = [0] * len(nodes)
    while True:  # a place is a number, the length of which depends on the places
        texts = [number(len(known)) + known + bytes([len(children)]) +
                 b"".join(label + b"\0" + number(places[child]) for label, child in children)
                 for known, children in nodes]
        new = [sum(len(text) for text in texts[:i]) for i in range(len(texts))]
        if new == places:
            return b"".join(texts)
        places = new


def sign(data, place):
    """Writes the hashes of the pages of all that lies before the signature."""
    magic, _, count = struct.unpack_from(">3I", data, place)
    found = [place + struct.unpack_from(">2I", data, place + 12 + 8 * i)[1] for i in range(count)]
    found = [at for at in found if struct.unpack_from(">I", data, at)[0] == DIRECTORY]
    if magic != SIGNATURE or not found:
        sys.exit("The library has no signature of a known kind.")
    for at in found:
        hashes, _, _, pages, limit = struct.unpack_from(">5I", data, at + 16)
        size, kind, _, shift = struct.unpack_from(">4B", data, at + 36)
        if (size, kind) != SHA256:
            sys.exit("The library is signed with another hash than SHA-256.")
        for page in range(pages):
            end = min((page + 1) << shift, limit)
            digest = hashlib.sha256(data[page << shift:end]).digest()
            data[at + hashes + size * page:at + hashes + size * (page + 1)] = digest


def main(path, prefix):
    with open(path, "rb") as source:
        data = bytearray(source.read())
    found = commands(data)
    place = found[DYLD_INFO]
    # Bindings of weak names come on top of the addresses in the library: 0 is the end of them.
    weak, size = struct.unpack_from("<2I", data, place + 24)
    data[weak:weak + size] = bytes(size)
    flags, = struct.unpack_from("<I", data, FLAGS)
    struct.pack_into("<I", data, FLAGS, flags & ~WEAK)
    start, size = struct.unpack_from("<2I", data, place + 40)
    kept = [(name, known) for name, known in exports(bytes(data[start:start + size]))
            if name.startswith(prefix.encode())]
    trie = trie_of(kept)
    if not kept or len(trie) > size:
        sys.exit(f"{path}: {len(kept)} exports begin with {prefix}.")
    data[start:start + size] = trie.ljust(size, b"\0")  # nothing else moves
    if CODE_SIGNATURE in found:
        sign(data, struct.unpack_from("<I", data, found[CODE_SIGNATURE] + 8)[0])
    with open(path, "wb") as target:
        target.write(data)


if __name__ == "__main__":
    main(*sys.argv[1:])
