// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Triangles of planar polygons, for worlds that come without their triangulation.
import { ShapeUtils, Vector2 } from 'three';
import type { Vec3 } from './check';
import type { Triangles } from './data';
import type { Surface, World } from './world';

const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The normal of a loop by its area, of any length; counter-clockwise seen from its tip. */
export function loop_normal(loop: Vec3[]): Vec3 {
  const sum: Vec3 = [0, 0, 0];
  loop.forEach((a, i) => {
    const b = loop[(i + 1) % loop.length]!;
    const c = cross([a[0] - loop[0]![0], a[1] - loop[0]![1], a[2] - loop[0]![2]], [b[0] - loop[0]![0], b[1] - loop[0]![1], b[2] - loop[0]![2]]);
    for (let k = 0; k < 3; ++k) sum[k]! += c[k]! / 2;
  });
  return sum;
}

/** [m2] without its holes. */
export function area_of(surface: Surface, world: World): number {
  const size = (loop: number[]) => Math.hypot(...loop_normal(loop.map((v) => world.vertices[v]!)));
  return surface.holes.reduce((sum, hole) => sum - size(hole), size(surface.outer));
}

/** Triangles of a polygon as indices into [...outer, ...holes], facing along the normal. */
export function triangulate(outer: Vec3[], holes: Vec3[][], normal: Vec3): number[][] {
  const axis: Vec3 = Math.abs(normal[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  const u = cross(normal, axis);
  const v = cross(normal, u); // u, v and the normal are right-handed
  const flat = (loop: Vec3[]) => loop.map((p) => new Vector2(dot(p, u), dot(p, v)));
  // three turns loops in place, so the order of corners says nothing: each triangle is turned by itself.
  const all = [...outer, ...holes.flat()];
  return ShapeUtils.triangulateShape(flat(outer), holes.map(flat)).map(([a, b, c]) => {
    const turn = dot(loop_normal([all[a!]!, all[b!]!, all[c!]!]), normal);
    return turn < 0 ? [a!, c!, b!] : [a!, b!, c!];
  });
}

export function triangulate_world(world: World): Triangles {
  const corners: number[] = [];
  const surface: number[] = [];
  world.surfaces.forEach((s, i) => {
    const indices = [...s.outer, ...s.holes.flat()];
    const at = (loop: number[]) => loop.map((v) => world.vertices[v]!);
    for (const triangle of triangulate(at(s.outer), s.holes.map(at), s.normal)) {
      corners.push(...triangle.map((k) => indices[k]!));
      surface.push(i);
    }
  });
  return { corners: Int32Array.from(corners), surface: Int32Array.from(surface) };
}
