"""Compares the core's merges for s_u = 0 with SciPy's centroid linkage; run by scipy.sh.

SciPy keeps exact means where the core rounds them to the grid, and breaks ties its own way. So distances are equal
up to the rounding of two positions, and partitions are compared where the cut does not fall among merges of equal
distance. Both work on the grid positions of the buildings' centroids, so that the input is the same to the last bit.
"""

import csv
import gzip
import os
import struct
import subprocess
import sys

import numpy
from scipy.cluster.hierarchy import linkage

CELLS = 4.0  # rounded positions differ from exact means by less than a cell on each axis at both ends
RELATIVE = 1e-6


def read_rings(wkb):
    """Rings of a POLYGON or MULTIPOLYGON in little-endian EWKB, with an SRID or without."""
    at = 0

    def number(form):
        nonlocal at
        value = struct.unpack_from("<" + form, wkb, at)[0]
        at += struct.calcsize(form)
        return value

    def polygons():
        nonlocal at
        number("B")
        kind = number("I")
        at += 4 if kind & 0x20000000 else 0
        for _ in range(number("I")):
            if kind & 0xFF == 6:
                yield from polygons()
                continue
            count = number("I")
            ring = numpy.frombuffer(wkb, "<f8", 2 * count, at).reshape(-1, 2)
            at += 16 * count
            yield ring

    return list(polygons())


def centroid(rings):
    """Area-weighted centre by signed areas. Which point stands for a building does not matter to the comparison."""
    base = rings[0][0]
    area, moment = 0.0, numpy.zeros(2)
    for ring in rings:
        a, b = ring[:-1] - base, ring[1:] - base
        cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
        area += cross.sum() / 2
        moment += ((a + b) * cross[:, None]).sum(axis=0) / 6
    return base + moment / area


def read_centroids(path):
    with gzip.open(path, "rt") as rows:
        return numpy.array([centroid(read_rings(bytes.fromhex(row["geom"]))) for row in csv.DictReader(rows)])


def core_merges(program, points):
    """Grid positions by rank, and (kept, gone, cost) of every merge."""
    lines = "".join("%.17g %.17g\n" % tuple(p) for p in points)
    printed = subprocess.run([program, "0"], input=lines, capture_output=True, text=True, check=True).stdout
    words = [line.split() for line in printed.splitlines()]
    positions = numpy.array([[float(w[1]), float(w[2])] for w in words if w[0] == "position"])
    return positions, [(int(w[1]), int(w[2]), float(w[3])) for w in words if w[0] == "merge"]


def scipy_merges(positions):
    """(a rank of the one, a rank of the other, distance), in the order in which SciPy merges."""
    rank = list(range(len(positions)))
    merges = []
    for a, b, distance, _ in linkage(positions, method="centroid"):
        merges.append((rank[int(a)], rank[int(b)], distance))
        rank.append(min(rank[int(a)], rank[int(b)]))
    return merges


def partition(merges, n):
    """For every rank the smallest rank of its cluster."""
    parent = list(range(n))

    def root(rank):
        while parent[rank] != rank:
            parent[rank] = parent[parent[rank]]
            rank = parent[rank]
        return rank

    for a, b, _ in merges:
        a, b = root(a), root(b)
        parent[max(a, b)] = min(a, b)
    return [root(rank) for rank in range(n)]


def near(a, b):
    return abs(a - b) <= CELLS + RELATIVE * max(a, b)


def distances_agree(core, other):
    """Both sequences sorted: the i-th distances are equal up to rounding."""
    wrong = [(i, a, b) for i, (a, b) in enumerate(zip(sorted(m[2] for m in core), sorted(m[2] for m in other)))
             if not near(a, b)]
    for i, a, b in wrong[:3]:
        print("  distance %d: core %.3f, SciPy %.3f cells" % (i, a, b))
    return len(wrong)


def untied(merges, count):
    """Nearest cut at or below this many merges whose last merge and the next are told apart by their distances."""
    while count > 0 and near(merges[count - 1][2], merges[count][2]):
        count -= 1
    return count


def compare(name, program, points):
    n = len(points)
    positions, core = core_merges(program, points)
    other = scipy_merges(positions)
    failed = 0
    wrong = distances_agree(core, other)
    print("%s distances of %s: %d merges, %d differ" % ("ok" if wrong == 0 else "failed", name, len(core), wrong))
    failed += wrong > 0
    for part in (2, 3, 8):
        merges = untied(core, n - n // part)
        differ = sum(a != b for a, b in zip(partition(core[:merges], n), partition(other[:merges], n)))
        print("%s clusters of %s: %d buildings in %d clusters, %d elsewhere"
              % ("ok" if differ == 0 else "failed", name, n, n - merges, differ))
        failed += differ > 0
    return failed


def main():
    program, data = sys.argv[1:]
    failed = found = 0
    for name, part in (("north_bayreuth", None), ("liechtenstein_2024", 6000)):
        path = os.path.join(data, name, "buildings.csv.gz")
        if not os.path.exists(path):
            print("skipped: no " + path)
            continue
        points = read_centroids(path)
        if part is not None:  # SciPy needs n^2 / 2 distances: the southernmost ones are enough
            points = points[numpy.argsort(points[:, 1], kind="stable")[:part]]
        found += 1
        failed += compare(name, program, points)
    sys.exit(77 if found == 0 else failed > 0)


main()
