// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Line segments with the normal of the face that they border.
import { BufferAttribute, BufferGeometry, Color, EdgesGeometry, LineSegments, type ShaderMaterial } from 'three';
import type { Vec3 } from '../check';
import { line_material } from './materials';

export type OutlinedLines = LineSegments<BufferGeometry, ShaderMaterial>;

export class LineBuilder {
  private readonly positions: number[] = [];
  private readonly normals: number[] = [];

  segment(a: Vec3, b: Vec3, normal: Vec3): void {
    this.positions.push(...a, ...b);
    this.normals.push(...normal, ...normal);
  }

  loop(points: Vec3[], normal: Vec3): void {
    points.forEach((p, i) => this.segment(p, points[(i + 1) % points.length]!, normal));
  }

  done(color: Color, opacity = 1): OutlinedLines {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(Float32Array.from(this.positions), 3));
    geometry.setAttribute('normal', new BufferAttribute(Float32Array.from(this.normals), 3));
    return new LineSegments(geometry, line_material(color, opacity));
  }
}

/** The edges of solids where faces meet at more than 20 degrees; they show from everywhere. */
export function solid_edges(geometry: BufferGeometry, color: Color, opacity = 1): OutlinedLines {
  const edges = new EdgesGeometry(geometry, 20);
  edges.setAttribute('normal', new BufferAttribute(new Float32Array(edges.getAttribute('position').array.length), 3));
  return new LineSegments(edges as BufferGeometry, line_material(color, opacity));
}
