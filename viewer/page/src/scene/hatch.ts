// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Parallel lines over what was not measured.
import { Vector3 } from 'three';
import type { Vec3 } from '../check';

const SPACING = 0.15; // [m] between lines

/** The segments of parallel lines that are in a polygon of rings, which are in a plane with this normal. */
export function hatch(rings: Vec3[][], normal: Vec3): [Vec3, Vec3][] {
  const n = new Vector3(...normal);
  const side = Math.abs(n.z) < 0.9 ? new Vector3(0, 0, 1).cross(n).normalize() : new Vector3(1, 0, 0).cross(n).normalize();
  const along = side.clone().add(n.clone().cross(side)).normalize();
  const across = along.clone().cross(n);
  const at = new Map<number, { place: Vec3; t: number }[]>(); // where each line crosses a ring
  for (const ring of rings)
    ring.forEach((a, i) => {
      const b = ring[(i + 1) % ring.length]!;
      const [ca, cb] = [a, b].map((p) => across.dot(new Vector3(...p)) / SPACING) as [number, number];
      for (let line = Math.ceil(Math.min(ca, cb)); line < Math.max(ca, cb); ++line) {
        const share = (line - ca) / (cb - ca);
        const place = a.map((x, k) => x + share * (b[k]! - x)) as Vec3;
        if (!at.has(line)) at.set(line, []);
        at.get(line)!.push({ place, t: along.dot(new Vector3(...place)) });
      }
    });
  return [...at.values()].flatMap((crossings) => {
    crossings.sort((a, b) => a.t - b.t);
    const segments: [Vec3, Vec3][] = [];
    for (let i = 0; i + 1 < crossings.length; i += 2) segments.push([crossings[i]!.place, crossings[i + 1]!.place]);
    return segments;
  });
}
