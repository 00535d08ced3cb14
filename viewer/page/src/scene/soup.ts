// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Triangles of many things in one: three corners each, and whose each is. All layers are drawn and picked from soups.
import { BufferAttribute, BufferGeometry, Vector3 } from 'three';
import type { Vec3 } from '../check';

export interface Soup {
  positions: Float32Array; // nine numbers a triangle
  owner: Int32Array; // index of the thing that the triangle is of
}

export class SoupBuilder {
  private readonly positions: number[] = [];
  private readonly owner: number[] = [];

  triangle(owner: number, ...corners: [Vec3, Vec3, Vec3]): void {
    for (const c of corners) this.positions.push(...c);
    this.owner.push(owner);
  }

  done(): Soup {
    return { positions: Float32Array.from(this.positions), owner: Int32Array.from(this.owner) };
  }
}

export function normal_of(positions: ArrayLike<number>, triangle: number): Vec3 {
  const corner = (k: number) => new Vector3(positions[9 * triangle + 3 * k], positions[9 * triangle + 3 * k + 1], positions[9 * triangle + 3 * k + 2]);
  const a = corner(0);
  return corner(1).sub(a).cross(corner(2).sub(a)).normalize().toArray();
}

/** One geometry of a soup, coloured by triangle. */
export function soup_geometry(soup: Soup, color: (owner: number, normal: Vec3) => Vec3): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(soup.positions, 3));
  geometry.setAttribute('color', new BufferAttribute(new Uint8Array(soup.positions.length), 3, true));
  recolor(geometry, soup, color);
  return geometry;
}

export function recolor(geometry: BufferGeometry, soup: Soup, color: (owner: number, normal: Vec3) => Vec3): void {
  const attribute = geometry.getAttribute('color') as BufferAttribute;
  soup.owner.forEach((owner, t) => {
    const c = color(owner, normal_of(soup.positions, t));
    for (let k = 0; k < 9; ++k) attribute.array[9 * t + k] = c[k % 3]!;
  });
  attribute.needsUpdate = true;
}

/** The triangles of one owner. */
export function part_of(soup: Soup, owner: number): Float32Array {
  const found: number[] = [];
  soup.owner.forEach((o, t) => {
    if (o === owner) for (let k = 0; k < 9; ++k) found.push(soup.positions[9 * t + k]!);
  });
  return Float32Array.from(found);
}
