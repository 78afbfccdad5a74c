"""tile_borders.py - reads lines "z x y hex of a vector tile" and compares neighbours: what two tiles show must be the same
polygon, a tile further on. Prints how many borders have something on both sides, how many features, and how many differ."""
import sys


def number(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at


def fields(data):
    at = 0
    while at < len(data):
        key, at = number(data, at)
        if key & 7 == 2:
            size, at = number(data, at)
            yield key >> 3, data[at:at + size]
            at += size
        elif key & 7 == 0:
            value, at = number(data, at)
            yield key >> 3, value
        else:
            raise ValueError("wire type %d" % (key & 7))


def signed(value):
    return (value >> 1) ^ -(value & 1)


def points(data):
    """the places of a polygon, in order"""
    numbers, at = [], 0
    while at < len(data):
        value, at = number(data, at)
        numbers.append(value)
    found, x, y, i = [], 0, 0, 0
    while i < len(numbers):
        command, count = numbers[i] & 7, numbers[i] >> 3
        i += 1
        for _ in range(count if command < 7 else 0):
            x, y, i = x + signed(numbers[i]), y + signed(numbers[i + 1]), i + 2
            found.append((x, y))
    return found


def features(tile):
    """id to places"""
    result = {}
    for field, layer in fields(tile):
        for kind, feature in fields(layer) if field == 3 else ():
            if kind == 2:
                content = dict(fields(feature))
                result[content[1]] = points(content[4])
    return result


tiles = {}
for line in sys.stdin:
    z, x, y, data = line.split(" ")
    tiles[int(z), int(x), int(y)] = features(bytes.fromhex(data.strip()))
borders = shared = other = 0
for (z, x, y), here in tiles.items():
    for right, down in ((1, 0), (0, 1), (1, 1), (-1, 1)):
        there = tiles.get((z, x + right, y + down), {})
        both = here.keys() & there.keys()
        borders += bool(both)
        shared += len(both)
        for feature in both:
            moved = {(px + 4096 * right, py + 4096 * down) for px, py in there[feature]}
            other += moved != set(here[feature])
print("tiles", len(tiles), "borders", borders, "shared", shared, "other", other,
      "features", len({(z, f) for (z, _, _), here in tiles.items() for f in here}))
