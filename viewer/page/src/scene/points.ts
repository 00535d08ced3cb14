// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Points of a scan in one draw call: 16 bytes each, positions scaled by the object's matrix.
import { BufferAttribute, BufferGeometry, Points, type ShaderMaterial } from 'three';
import type { Vec3 } from '../check';
import type { Box, Scan } from '../data';
import { type ColorMode, ramp, surface_color, UNCLUSTERED, UNEXPLAINED } from '../palette';
import type { World } from '../world';
import { point_material } from './materials';

export type PointCloud = Points<BufferGeometry, ShaderMaterial>;

const SMALL = 140; // the size of unclustered points, of 255

/** Three numbers a point padded to four: graphics cards read eight bytes better than six. */
export function position_attribute(positions: Uint16Array): BufferAttribute {
  const padded = new Uint16Array((positions.length / 3) * 4);
  for (let i = 0, j = 0; i < positions.length; i += 3, j += 4) {
    padded[j] = positions[i]!;
    padded[j + 1] = positions[i + 1]!;
    padded[j + 2] = positions[i + 2]!;
  }
  return new BufferAttribute(padded, 4, true);
}

export function point_cloud(positions: BufferAttribute, box: Box): PointCloud {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', positions);
  geometry.setAttribute('color', new BufferAttribute(new Uint8Array(positions.count * 4), 4, true));
  geometry.setAttribute('normal', new BufferAttribute(new Int8Array(positions.count * 4), 4, true));
  const points = new Points(geometry, point_material());
  points.frustumCulled = false;
  points.position.set(...box.min);
  points.scale.set(...(box.max.map((v, k) => Math.max(1e-9, v - box.min[k]!)) as Vec3));
  return points;
}

/** Colours each point; alpha is its size, 255 for the full one. */
export function color_points(points: PointCloud, color: (point: number) => Vec3, size: (point: number) => number): void {
  const attribute = points.geometry.getAttribute('color') as BufferAttribute;
  for (let i = 0; i < attribute.count; ++i) {
    const [r, g, b] = color(i);
    attribute.array.set([r, g, b, size(i)], 4 * i);
  }
  attribute.needsUpdate = true;
}

/** Gives each point the normal of its surface; those of no surface have none and show from everywhere. */
export function face_points(points: PointCloud, scan: Scan, world: World): void {
  const attribute = points.geometry.getAttribute('normal');
  const normals = world.surfaces.map((s) => s.normal.map((v) => Math.round(127 * v)));
  scan.surface.forEach((s, i) => {
    if (s >= 0) for (let k = 0; k < 3; ++k) attribute.array[4 * i + k] = normals[s]![k]!;
  });
}

export function paint_scan(points: PointCloud, scan: Scan, world: World, mode: ColorMode): void {
  const colors = world.surfaces.map((s) => surface_color(s, mode).map((v) => v * 0.8) as Vec3); // darker than the faces that they lie on
  color_points(points, (i) => colors[scan.surface[i]!] ?? UNCLUSTERED, (i) => (scan.surface[i]! < 0 ? SMALL : 255));
}

/** Distance by colour up to the tolerance; beyond it points are unexplained. */
export function paint_atlas(points: PointCloud, scan: Scan): void {
  const steps = Array.from({ length: 256 }, (_, i) => ramp(i / 255));
  const most = scan.tolerance * 1e4;
  color_points(points, (i) => (scan.distance[i]! > most ? UNEXPLAINED : steps[Math.round((255 * scan.distance[i]!) / most)]!), () => 255);
}

/** A point in the world's axes. */
export function point_at(positions: ArrayLike<number>, stride: number, i: number, box: Box): Vec3 {
  return [0, 1, 2].map((k) => box.min[k]! + ((box.max[k]! - box.min[k]!) * positions[stride * i + k]!) / 65535) as Vec3;
}
