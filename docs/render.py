#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The scanworld authors
# SPDX-License-Identifier: Apache-2.0
"""Draws a world and the scan that it was made of, side by side, for the pictures of docs/.

    scanworld build SCAN -o DIR --labels && docs/render.py DIR OUT.png [--azimuth 215] [--elevation 38]

Needs Debian's python3-numpy and python3-pil. Each surface has a colour of its own, and its points the same one;
points that belong to no surface are dark. Surfaces are drawn where their free side faces the viewer, so that one
looks into rooms from above.
"""
import argparse
import json
import math
import os

import numpy as np
from PIL import Image

SIZE = 900    # pixels of each half, before it is made smaller
SUPER = 2     # drawn so much larger
BACKGROUND = np.array([250, 250, 248], np.float32)


def read_labels(path):
    """The points of labels.ply and their surfaces' ids."""
    with open(path, 'rb') as file:
        fields, count = [], 0
        for line in iter(file.readline, b'end_header\n'):
            words = line.split()
            if words[0] == b'element':
                count = int(words[2])
            elif words[0] == b'property':
                fields.append((words[2].decode(), {b'float': '<f4', b'double': '<f8', b'int': '<i4'}[words[1]]))
        data = np.frombuffer(file.read(), np.dtype(fields), count)
    points = np.stack([data[k].astype(np.float64) for k in 'xyz'], 1)
    finite = np.isfinite(points).all(1)
    return points[finite], data['plane_id'][finite]


def read_obj(path):
    """Triangles (n, 3, 3) of a world.obj and the ids of their surfaces, from names like wall_12."""
    vertices, corners, ids, current = [], [], [], -1
    with open(path) as file:
        for line in file:
            words = line.split()
            if line.startswith('o '):
                current = int(words[1].rsplit('_', 1)[1])
            elif line.startswith('v '):
                vertices.append([float(w) for w in words[1:4]])
            elif line.startswith('f '):
                corners.append([int(w.split('/')[0]) - 1 for w in words[1:4]])
                ids.append(current)
    return np.array(vertices)[np.array(corners)], np.array(ids)


def read_colliders(world):
    """Triangles (n, 3, 3) of the colliders but those of ceilings, and the ids of their surfaces."""
    ceilings = {s['id'] for s in world['surfaces'] if s['kind'] == 'ceiling'}
    triangles, ids = [], []
    for collider in world['colliders']:
        if collider['surface'] in ceilings:
            continue
        if 'box' in collider:
            box = collider['box']
            x, y, z, w = box['rotation']
            turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                             [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                             [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
            corners = np.array([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]) / 2 * box['size']
            base = box['center'] + corners @ turn.T
            extrusion = turn @ [0, 0, -box['size'][2]]
        else:
            base, extrusion = np.array(collider['prism']['base']), np.array(collider['prism']['extrusion'])
        n = len(base)
        rings = [base, (base + extrusion)[::-1]]
        rings += [np.array([base[i], base[i] + extrusion, base[(i + 1) % n] + extrusion, base[(i + 1) % n]])
                  for i in range(n)]
        for ring in rings:
            for i in range(1, len(ring) - 1):
                triangles.append([ring[0], ring[i], ring[i + 1]])
                ids.append(collider['surface'])
    return np.array(triangles), np.array(ids)


def color_of(surface_id):
    """Colours that are easy to tell apart: steps of the golden ratio around the colour circle."""
    hue = (surface_id * 0.61803398875) % 1 * 6
    x = 1 - abs(hue % 2 - 1)
    rgb = [(1, x, 0), (x, 1, 0), (0, 1, x), (0, x, 1), (x, 0, 1), (1, 0, x)][int(hue)]
    return np.array([255 * (0.45 + 0.45 * c) for c in rgb], np.float32)


class Canvas:
    def __init__(self, right, down, toward, points):
        self.axes = np.stack([right, down, toward])
        flat = points @ self.axes[:2].T
        low, high = np.percentile(flat, 0.5, 0), np.percentile(flat, 99.5, 0)
        self.scale = 0.92 * SIZE * SUPER / (high - low).max()
        self.shift = SIZE * SUPER / 2 - self.scale * (low + high) / 2
        shape = (SIZE * SUPER, SIZE * SUPER)
        self.depth = np.full(shape, -np.inf)
        self.ids = np.full(shape, -2)
        self.image = np.tile(BACKGROUND, shape + (1,))

    def project(self, points):
        seen = points @ self.axes.T
        seen[..., :2] = seen[..., :2] * self.scale + self.shift
        return seen

    def triangle(self, corners, color, surface_id):
        p = self.project(corners)
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = p
        doubled = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        x0, y0 = np.maximum(np.floor(p[:, :2].min(0)), 0).astype(int)
        x1, y1 = np.minimum(np.ceil(p[:, :2].max(0)) + 1, SIZE * SUPER).astype(int)
        if abs(doubled) < 1e-9 or x0 >= x1 or y0 >= y1:
            return
        x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
        v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / doubled
        w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / doubled
        z = az + v * (bz - az) + w * (cz - az)
        window = (slice(y0, y1), slice(x0, x1))
        hit = (v >= 0) & (w >= 0) & (v + w <= 1) & (z > self.depth[window])
        self.depth[window][hit] = z[hit]
        self.ids[window][hit] = surface_id
        self.image[window][hit] = color

    def dots(self, points, colors, radius):
        p = self.project(points)
        order = np.argsort(p[:, 2])  # the nearest last, so that they stay
        p, colors = p[order], colors[order]
        for dy in range(-radius, radius + 1):
            for dx in range(-radius, radius + 1):
                x, y = (p[:, 0] + dx).astype(int), (p[:, 1] + dy).astype(int)
                inside = (x >= 0) & (y >= 0) & (x < SIZE * SUPER) & (y < SIZE * SUPER)
                self.image[y[inside], x[inside]] = colors[inside]

    def outlines(self):
        """Darkens where one surface ends."""
        edge = np.zeros(self.ids.shape, bool)
        edge[:, 1:] |= self.ids[:, 1:] != self.ids[:, :-1]
        edge[1:, :] |= self.ids[1:, :] != self.ids[:-1, :]
        self.image[edge] *= 0.45

    def picture(self):
        image = Image.fromarray(np.clip(self.image, 0, 255).astype(np.uint8))
        return image.resize((SIZE, SIZE), Image.LANCZOS)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folder', help='what scanworld build --labels wrote')
    parser.add_argument('out')
    parser.add_argument('--azimuth', type=float, default=215, help='degrees; where the viewer stands')
    parser.add_argument('--elevation', type=float, default=38)
    parser.add_argument('--cut', type=float, default=0.82, help='points above this share of the height are not drawn')
    parser.add_argument('--colliders', action='store_true', help='draw the colliders instead of the surfaces')
    args = parser.parse_args()

    with open(os.path.join(args.folder, 'world.json')) as file:
        content = json.load(file)
    frame = content['frame']
    up = np.array(frame['up'])
    side = np.cross(up, [0, 0, 1] if abs(up[2]) < 0.9 else [0, 1, 0])
    side = np.cross(side, up)
    side /= np.linalg.norm(side)
    a, e = math.radians(args.azimuth), math.radians(args.elevation)
    toward = math.cos(e) * (math.cos(a) * side + math.sin(a) * np.cross(up, side)) + math.sin(e) * up
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    down = np.cross(right, toward)

    points, labels = read_labels(os.path.join(args.folder, 'labels.ply'))
    points -= np.array(frame['origin'])
    triangles, ids = read_colliders(content) if args.colliders else read_obj(os.path.join(args.folder, 'world.obj'))

    scan = Canvas(right, down, toward, triangles.reshape(-1, 3))
    height = points @ up
    low, high = np.percentile(height[labels >= 0], [1, 99])
    shown = height < low + args.cut * (high - low)
    points, labels = points[shown], labels[shown]
    palette = np.array([color_of(i) for i in range(max(labels.max(), ids.max()) + 1)] + [[60, 60, 60]], np.float32)
    scan.dots(points[labels < 0], palette[labels[labels < 0]], 1)
    scan.dots(points[labels >= 0], palette[labels[labels >= 0]], 2 if len(points) < 150000 else 1)

    world = Canvas(right, down, toward, triangles.reshape(-1, 3))
    light = toward + 0.6 * up - 0.5 * right
    light /= np.linalg.norm(light)
    for corners, surface_id in zip(triangles, ids):
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        length = np.linalg.norm(normal)
        if length == 0 or normal @ toward <= 0:
            continue
        world.triangle(corners, color_of(surface_id) * (0.72 + 0.33 * max(0, normal @ light / length)), surface_id)
    world.outlines()

    both = Image.new('RGB', (2 * SIZE, SIZE), tuple(int(c) for c in BACKGROUND))
    both.paste(scan.picture(), (0, 0))
    both.paste(world.picture(), (SIZE, 0))
    both = both.resize((SIZE * 4 // 3, SIZE * 2 // 3), Image.LANCZOS)
    both.quantize(96, dither=Image.Dither.NONE).save(args.out, optimize=True)


if __name__ == '__main__':
    main()
