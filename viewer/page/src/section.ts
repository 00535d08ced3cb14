// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// One plane that cuts the picture open, square to an axis of the scene.
import { type Box3, Plane, type Quaternion, Vector3 } from 'three';

export type Axis = 'off' | 'x' | 'y' | 'z';
export const AXES: Axis[] = ['off', 'x', 'y', 'z'];

export interface Section {
  axis: Axis;
  at: number; // [m]
  flip: boolean;
}

/** What is below the place on the axis stays, or with flip what is above. */
export function section_plane(section: Section): Plane | null {
  if (section.axis === 'off') return null;
  const axis = new Vector3(section.axis === 'x' ? 1 : 0, section.axis === 'y' ? 1 : 0, section.axis === 'z' ? 1 : 0);
  const plane = new Plane(axis.multiplyScalar(-1), section.at);
  return section.flip ? plane.negate() : plane;
}

/** The plane in the axes of the world, which the scene shows turned. */
export function in_world(plane: Plane | null, turn: Quaternion): Plane | null {
  return plane && new Plane(plane.normal.clone().applyQuaternion(turn.clone().invert()), plane.constant);
}

export function section_range(axis: Axis, box: Box3): [number, number] {
  if (axis === 'off') return [0, 1];
  return [box.min[axis] - 0.05, box.max[axis] + 0.05];
}
