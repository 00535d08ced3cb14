#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The scanworld authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the worlds of this folder from floor plans: worlds/make_worlds.py build/release/scanworld

They are the ground truth that scans are made of and results are compared with, so every face meets its
neighbours in shared vertices. Lengths are in metres.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

EPS = 1e-9


def sub(a, b):
    return [a[k] - b[k] for k in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(a[k] * b[k] for k in range(3))


def newell(loop):
    """The normal of a loop, counter-clockwise seen against it."""
    n = [0.0, 0.0, 0.0]
    for i in range(len(loop)):
        c = cross(sub(loop[i], loop[0]), sub(loop[(i + 1) % len(loop)], loop[0]))
        n = [n[k] + c[k] for k in range(3)]
    length = math.sqrt(dot(n, n))
    return [x / length for x in n]


class Place:
    def __init__(self, name):
        self.name = name
        self.faces = []  # dicts: kind, outer, holes as points
        self.openings = []
        self.obstacles = []
        self.rooms = []
        self.doors = []

    # -- building --

    def face(self, kind, outer, holes=()):
        """Adds a face; `outer` counter-clockwise seen from the free side, holes in any direction."""
        normal = newell(outer)
        turned = [h if dot(newell(h), normal) < 0 else h[::-1] for h in holes]
        self.faces.append({'kind': kind, 'outer': outer, 'holes': turned, 'normal': normal})
        return len(self.faces) - 1

    def box(self, center, size, z0, yaw=0.0, bottom=False):
        """A box that stands at height z0, its bottom seen or not."""
        c, s = math.cos(yaw), math.sin(yaw)
        plan = []
        for x, y in ((-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5)):
            px, py = x * size[0], y * size[1]
            plan.append((center[0] + c * px - s * py, center[1] + s * px + c * py))
        self.prism(plan, z0, z0 + size[2], bottom)

    def prism(self, plan, z0, z1, bottom=False):
        n = len(plan)
        for i in range(n):
            a, b = plan[i], plan[(i + 1) % n]
            self.face('wall' if z1 - z0 >= 1 else 'other', [[*a, z0], [*b, z0], [*b, z1], [*a, z1]])
        self.face('other', [[*p, z1] for p in plan])
        if bottom:
            self.face('other', [[*p, z0] for p in reversed(plan)])

    def table(self, center, size, height, yaw=0.0):
        top = 0.04
        self.box(center, (size[0], size[1], top), height - top, yaw, bottom=True)
        c, s = math.cos(yaw), math.sin(yaw)
        for i in (-1, 1):
            for j in (-1, 1):
                x, y = i * (size[0] / 2 - 0.08), j * (size[1] / 2 - 0.08)
                at = (center[0] + c * x - s * y, center[1] + s * x + c * y)
                self.box(at, (0.06, 0.06, height - top), 0, yaw)

    def wall(self, a, b, heights, openings):
        """The wall from a to b as seen from its left side; heights at a and b and, for a gable, (share, height)
        between. Openings are (from, to, sill, head) along the wall."""
        length = math.hypot(b[0] - a[0], b[1] - a[1])

        def at(s, z):
            return [a[0] + (b[0] - a[0]) * s / length, a[1] + (b[1] - a[1]) * s / length, z]

        outer = [at(0, 0)]
        holes = []
        for lo, hi, sill, head in sorted(openings):
            if sill == 0:
                outer += [at(lo, 0), at(lo, head), at(hi, head), at(hi, 0)]
            else:
                holes.append([at(lo, sill), at(hi, sill), at(hi, head), at(lo, head)])
        outer += [at(length, 0), at(length, heights[1])]
        for share, z in heights[2:]:
            outer.append(at(share * length, z))
        outer.append(at(0, heights[0]))
        # Seen from the left of a -> b, b is to the left of a: the loop above is clockwise there.
        return self.face('wall', outer[::-1], holes)

    # -- rooms on a rectangular plan, walls as gaps between them --

    def storey(self, rooms, gaps, roofs=None):
        """rooms: name -> (x0, y0, x1, y1, height). gaps: (axis, lo, hi, a, b, sill, head): an opening through what is
        between lo and hi on the axis, from a to b along the wall; a door where sill is 0."""
        roofs = roofs or {}
        door_rooms = {i: [] for i in range(len(gaps))}
        opening_of = {}
        for name, (x0, y0, x1, y1, height) in rooms.items():
            surfaces = []
            plan = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
            roof = roofs.get(name)
            for i in range(4):
                a, b = plan[i], plan[(i + 1) % 4]
                axis = 1 if i % 2 == 0 else 0
                here, cuts = a[axis], []
                for g, (gaxis, lo, hi, ga, gb, sill, head) in enumerate(gaps):
                    along = (min(a[1 - axis], b[1 - axis]), max(a[1 - axis], b[1 - axis]))
                    if gaxis != axis or ga < along[0] - EPS or gb > along[1] + EPS:
                        continue
                    if min(abs(here - lo), abs(here - hi)) > EPS:
                        continue
                    start = a[1 - axis]
                    cut = sorted((abs(ga - start), abs(gb - start)))
                    cuts.append((cut[0], cut[1], sill, head))
                    door_rooms[g].append(name)
                    opening_of.setdefault(g, (len(self.faces), here))
                heights = [roof[0](*a), roof[0](*b)] if roof else [height, height]
                if roof and axis == 1:
                    heights.append((0.5, roof[0]((x0 + x1) / 2, a[1])))
                surfaces.append(self.wall(a, b, heights, cuts))
            if roof:
                m, h = (x0 + x1) / 2, roof[0]
                surfaces.append(self.face('ceiling', [[x0, y0, h(x0, y0)], [x0, y1, h(x0, y1)], [m, y1, h(m, y1)], [m, y0, h(m, y0)]]))
                surfaces.append(self.face('ceiling', [[m, y0, h(m, y0)], [m, y1, h(m, y1)], [x1, y1, h(x1, y1)], [x1, y0, h(x1, y0)]]))
            else:
                surfaces.append(self.face('ceiling', [[x, y, height] for x, y in reversed(plan)]))
            self.rooms.append({'id': len(self.rooms), 'name': name, 'surfaces': surfaces,
                               'area': round((x1 - x0) * (y1 - y0), 6),
                               'center': [round((x0 + x1) / 2, 6), round((y0 + y1) / 2, 6), 0.0]})
        self.floor(list(rooms.values()), [g for g in gaps if g[5] == 0])
        for g, gap in enumerate(gaps):
            self.reveal(gap)
            self.opening(gap, *opening_of[g], door_rooms[g])

    def floor(self, rooms, doors):
        """One face for the floors of all rooms and the thresholds between them: trace the outline of a grid."""
        rects = [r[:4] for r in rooms]
        for axis, lo, hi, a, b, _, _ in doors:
            rects.append((lo, a, hi, b) if axis == 0 else (a, lo, b, hi))
        xs = sorted({v for r in rects for v in (r[0], r[2])})
        ys = sorted({v for r in rects for v in (r[1], r[3])})

        def inside(i, j):
            if not (0 <= i < len(xs) - 1 and 0 <= j < len(ys) - 1):
                return False
            x, y = (xs[i] + xs[i + 1]) / 2, (ys[j] + ys[j + 1]) / 2
            return any(r[0] < x < r[2] and r[1] < y < r[3] for r in rects)

        edges = {}  # from -> to, the inside on the left
        for i in range(len(xs) - 1):
            for j in range(len(ys) - 1):
                if not inside(i, j):
                    continue
                for (di, dj), p, q in (((0, -1), (i, j), (i + 1, j)), ((1, 0), (i + 1, j), (i + 1, j + 1)),
                                       ((0, 1), (i + 1, j + 1), (i, j + 1)), ((-1, 0), (i, j + 1), (i, j))):
                    if not inside(i + di, j + dj):
                        edges[p] = q
        loops = []
        while edges:
            start = next(iter(edges))
            loop, at = [], start
            while at in edges:
                loop.append(at)
                at = edges.pop(at)
            corners = [p for k, p in enumerate(loop)
                       if (p[0] == loop[k - 1][0]) != (p[0] == loop[(k + 1) % len(loop)][0])]
            loops.append([[xs[i], ys[j], 0.0] for i, j in corners])
        up = [loop for loop in loops if newell(loop)[2] > 0]
        assert len(up) == 1, 'the floor falls apart'
        self.face('floor', up[0], [loop for loop in loops if newell(loop)[2] < 0])

    def reveal(self, gap):
        axis, lo, hi, a, b, sill, head = gap

        def p(n, s, z):
            return [n, s, z] if axis == 0 else [s, n, z]

        faces = [[p(lo, a, sill), p(lo, a, head), p(hi, a, head), p(hi, a, sill)],
                 [p(lo, b, sill), p(hi, b, sill), p(hi, b, head), p(lo, b, head)],
                 [p(lo, a, head), p(lo, b, head), p(hi, b, head), p(hi, a, head)]]
        if sill > 0:
            faces.append([p(lo, a, sill), p(hi, a, sill), p(hi, b, sill), p(lo, b, sill)])
        middle = p((lo + hi) / 2, (a + b) / 2, (sill + head) / 2)
        for loop in faces:
            if dot(newell(loop), sub(middle, loop[0])) < 0:
                loop.reverse()
            high = max(q[2] for q in loop) - min(q[2] for q in loop)
            self.face('ceiling' if newell(loop)[2] < -0.9 else 'wall' if high >= 1 else 'other', loop)

    def opening(self, gap, surface, here, rooms):
        axis, lo, hi, a, b, sill, head = gap
        loop = [[here, s, z] if axis == 0 else [s, here, z] for s, z in ((a, sill), (b, sill), (b, head), (a, head))]
        if dot(newell(loop), self.faces[surface]['normal']) < 0:
            loop.reverse()
        kind = 'door' if sill == 0 else 'window'
        self.openings.append({'id': len(self.openings), 'kind': kind, 'surface': surface, 'loop': loop,
                              'width': round(b - a, 6), 'height': round(head - sill, 6), 'evidence': 'drawn'})
        if len(rooms) == 2:
            ids = [r['id'] for name in rooms for r in self.rooms if r['name'] == name]
            self.doors.append({'opening': len(self.openings) - 1, 'rooms': ids})

    def cylinder(self, x, y, radius, z0, z1):
        self.obstacles.append({'id': len(self.obstacles), 'cylinder': {
            'center': [x, y, (z0 + z1) / 2], 'radius': radius, 'height': z1 - z0}})

    def clutter_box(self, center, size, yaw):
        self.obstacles.append({'id': len(self.obstacles), 'box': {
            'center': center, 'size': size, 'rotation': [0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)]}})

    def clutter_hull(self, center, radii):
        """A round thing: the hull of points on an ellipsoid."""
        points = []
        for i in range(60):
            z = 1 - 2 * (i + 0.5) / 60
            r, angle = math.sqrt(1 - z * z), i * math.pi * (3 - math.sqrt(5))
            points.append([round(center[k] + radii[k] * v, 4) for k, v in enumerate((r * math.cos(angle), r * math.sin(angle), z))])
        self.obstacles.append({'id': len(self.obstacles), 'hull': {'vertices': points}})

    def stairs(self, at, direction, steps, rise, tread, width):
        """Steps that rise along `direction`, a unit vector; `at` is the lower corner on their right."""
        f = [direction[0], direction[1], 0]
        w = [-direction[1], direction[0], 0]

        def p(along, side, z):
            return [at[k] + f[k] * along + w[k] * side + (z if k == 2 else 0) for k in range(3)]

        for i in range(steps):
            s, z = i * tread, i * rise
            self.face('other', [p(s, width, z), p(s, 0, z), p(s, 0, z + rise), p(s, width, z + rise)])
            self.face('floor', [p(s, 0, z + rise), p(s + tread, 0, z + rise), p(s + tread, width, z + rise), p(s, width, z + rise)])
        for side in (0, width):
            loop = [p(0, side, 0), p(steps * tread, side, 0), p(steps * tread, side, steps * rise)]
            for i in reversed(range(steps)):
                loop.append(p(i * tread, side, (i + 1) * rise))
                if i:
                    loop.append(p(i * tread, side, i * rise))
            self.face('wall', loop if side == 0 else loop[::-1])
        s, z = steps * tread, steps * rise
        self.face('wall', [p(s, 0, 0), p(s, width, 0), p(s, width, z), p(s, 0, z)])

    # -- writing --

    def world(self):
        index, vertices = {}, []

        def vertex(point):
            key = tuple(round(x, 6) + 0.0 for x in point)
            if key not in index:
                index[key] = len(vertices)
                vertices.append(list(key))
            return index[key]

        faces = [{**f, 'outer': [vertex(p) for p in f['outer']],
                  'holes': [[vertex(p) for p in h] for h in f['holes']]} for f in self.faces]

        def conform(loop):
            """Puts into each edge the vertices of neighbours that lie on it."""
            result = []
            for i, a in enumerate(loop):
                b = loop[(i + 1) % len(loop)]
                pa, d = vertices[a], sub(vertices[b], vertices[a])
                result.append(a)
                between = []
                for v, p in enumerate(vertices):
                    t = dot(sub(p, pa), d) / dot(d, d)
                    if v not in loop and 1e-6 < t < 1 - 1e-6:
                        off = sub(p, [pa[k] + t * d[k] for k in range(3)])
                        if dot(off, off) < 1e-12:
                            between.append((t, v))
                result += [v for _, v in sorted(between)]
            return result

        surfaces = []
        for i, f in enumerate(faces):
            points = [vertices[v] for v in f['outer']]
            normal = newell(points)
            surfaces.append({
                'id': i, 'kind': f['kind'], 'source': 'measured',
                'plane': {'normal': normal, 'offset': -dot(normal, points[0])},
                'outer': conform(f['outer']), 'holes': [conform(h) for h in f['holes']],
                'support': {'points': 0, 'rms': 0.0, 'coverage': 0.0}})
        openings = [{**o, 'loop': [vertex(p) for p in o['loop']]} for o in self.openings]
        return {'schema': {'name': 'scanworld', 'version': 1},
                'frame': {'origin': [0.0, 0.0, 0.0], 'up': [0.0, 0.0, 1.0], 'unit': 'm', 'assumed': []},
                'vertices': vertices, 'surfaces': surfaces, 'openings': openings, 'obstacles': self.obstacles,
                'colliders': [], 'rooms': self.rooms, 'doors': self.doors,
                'provenance': {'program': 'worlds/make_worlds.py', 'inputs': [], 'options': {}}}


def room():
    place = Place('room')
    place.storey({'room': (0, 0, 5, 4, 2.7)},
                 [(1, -0.3, 0, 1.5, 3.1, 0.9, 2.2), (0, 5, 5.1, 2.6, 3.5, 0, 2.05)])
    place.box((0.5, 3.45), (0.9, 1.0, 0.8), 0, 0.12)
    place.table((3.2, 2.1), (1.4, 0.8), 0.74, 0.25)
    place.cylinder(4.4, 0.6, 0.18, 0, 0.9)
    return place


def office():
    place = Place('office')
    rooms = {
        'corridor': (0, 0, 9.6, 2.0, 2.5),
        'workshop': (0, 2.15, 5.4, 6.6, 3.0),
        'office': (5.5, 2.15, 9.6, 6.2, 2.8),
        'meeting': (0, -4.65, 4.2, -0.15, 2.8),
        'kitchen': (4.3, -4.15, 7.4, -0.15, 2.6),
        'store': (7.5, -3.25, 9.6, -0.15, 2.4),
    }
    gaps = [
        (1, 2.0, 2.15, 1.1, 2.05, 0, 2.05), (1, 2.0, 2.15, 6.2, 7.1, 0, 2.05),
        (1, -0.15, 0, 0.8, 1.7, 0, 2.05), (1, -0.15, 0, 5.0, 5.9, 0, 2.05), (1, -0.15, 0, 8.1, 8.95, 0, 2.0),
        (0, 5.4, 5.5, 4.4, 5.2, 0, 2.05), (0, 4.2, 4.3, -2.4, -0.9, 0, 2.2),
        (1, 6.6, 6.9, 0.8, 2.4, 0.9, 2.2), (1, 6.6, 6.9, 3.2, 4.6, 0.9, 2.2), (1, 6.2, 6.5, 6.3, 8.6, 0.9, 2.1),
        (1, -4.95, -4.65, 0.9, 3.1, 0.9, 2.2), (1, -4.45, -4.15, 5.2, 6.4, 1.1, 2.1),
    ]
    place.storey(rooms, gaps)
    place.table((1.6, 5.4), (1.6, 0.8), 0.74, 0.05)
    place.table((8.2, 5.2), (1.5, 0.75), 0.74, -0.2)
    place.table((2.1, -2.7), (2.0, 1.0), 0.74, 0.0)
    place.box((5.12, 3.0), (0.45, 1.1, 1.9), 0)
    place.box((9.3, 2.9), (0.5, 0.9, 1.2), 0)
    place.box((7.08, -2.5), (0.55, 2.2, 0.9), 0)
    place.box((8.4, -2.85), (1.4, 0.6, 1.7), 0)
    place.cylinder(3.4, 4.4, 0.2, 0, 3.0)
    place.clutter_hull((0.7, -3.9, 0.45), (0.35, 0.3, 0.45))
    place.clutter_hull((6.2, 3.4, 0.3), (0.25, 0.3, 0.3))
    place.clutter_box([4.7, 1.6, 0.2], [0.5, 0.35, 0.4], 0.5)
    return place


def stairs():
    place = Place('stairs')
    gable = (lambda x, y: 4.6 - 0.35 * abs(x - 4.0), )
    place.storey({'hall': (0, 0, 8, 6, 3.2), 'annex': (8.1, 1, 11.6, 5, 2.6)},
                 [(0, 8, 8.1, 2.5, 3.5, 0, 2.05), (1, -0.3, 0, 1.0, 3.0, 0.9, 2.1)],
                 {'hall': gable})
    place.stairs((1.2, 4.8, 0), (1, 0), 10, 0.17, 0.28, 1.2)
    # The landing that the stairs lead up to, its edge against the last riser's back.
    place.face('floor', [[4.0, 4.8, 1.7], [6.8, 4.8, 1.7], [6.8, 6.0, 1.7], [4.0, 6.0, 1.7]])
    place.face('ceiling', [[4.0, 4.8, 1.55], [4.0, 6.0, 1.55], [6.8, 6.0, 1.55], [6.8, 4.8, 1.55]])
    place.face('other', [[4.0, 4.8, 1.55], [6.8, 4.8, 1.55], [6.8, 4.8, 1.7], [4.0, 4.8, 1.7]])
    place.face('other', [[6.8, 4.8, 1.55], [6.8, 6.0, 1.55], [6.8, 6.0, 1.7], [6.8, 4.8, 1.7]])
    # A ramp in the annex.
    place.face('floor', [[9.2, 1.2, 0.0], [11.2, 1.2, 0.4], [11.2, 2.4, 0.4], [9.2, 2.4, 0.0]])
    place.face('other', [[9.2, 2.4, 0], [11.2, 2.4, 0.4], [11.2, 2.4, 0]])
    place.face('other', [[9.2, 1.2, 0], [11.2, 1.2, 0], [11.2, 1.2, 0.4]])
    place.face('other', [[11.2, 1.2, 0], [11.2, 2.4, 0], [11.2, 2.4, 0.4], [11.2, 1.2, 0.4]])
    place.table((3.2, 2.4), (1.4, 0.75), 0.74, 0.3)
    place.cylinder(2.0, 3.4, 0.2, 0, 3.7)
    return place


def main():
    scanworld = sys.argv[1] if len(sys.argv) > 1 else 'build/release/scanworld'
    here = os.path.dirname(os.path.abspath(__file__))
    for place in (room(), office(), stairs()):
        with tempfile.NamedTemporaryFile('w', suffix='.json') as raw:
            json.dump(place.world(), raw)
            raw.flush()
            target = os.path.join(here, place.name + '.json')
            subprocess.run([scanworld, 'export', raw.name, '-o', target], check=True)
            subprocess.run([scanworld, 'check', target], check=True)


if __name__ == '__main__':
    main()
