// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Where rays of the scanner contradict the world: it stands where they went through, or is missing where they ended.
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Points, PointsMaterial } from 'three';
import type { Vec3 } from '../check';
import { LEAK, VIOLATION } from '../palette';
import { to_color } from './materials';


function positions(values: ArrayLike<number>): BufferGeometry {
  return new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from(values), 3));
}

function lines(values: ArrayLike<number>, color: Vec3, opacity: number): LineSegments {
  return new LineSegments(positions(values), new LineBasicMaterial({ color: to_color(color), transparent: true, opacity, depthWrite: false }));
}

function marks(values: ArrayLike<number>, color: Vec3): Points {
  return new Points(positions(values), new PointsMaterial({ color: to_color(color), size: 6, sizeAttenuation: false }));
}

/** Each ray is split at the places given as offsets into it: [from, to] segments, and the place that is marked. */
function pick(values: Float32Array, size: number, offsets: number[]): number[] {
  const found: number[] = [];
  for (let i = 0; i < values.length; i += size) for (const offset of offsets) found.push(values[i + offset]!, values[i + offset + 1]!, values[i + offset + 2]!);
  return found;
}

export function violation_layer(values: Float32Array): Group {
  return new Group().add(lines(pick(values, 9, [0, 3]), VIOLATION, 0.25), lines(pick(values, 9, [3, 6]), VIOLATION, 0.9), marks(pick(values, 9, [3]), VIOLATION));
}

export function leak_layer(values: Float32Array): Group {
  return new Group().add(lines(pick(values, 6, [0, 3]), LEAK, 0.5), marks(pick(values, 6, [3]), LEAK));
}
