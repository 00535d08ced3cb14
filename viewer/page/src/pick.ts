// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What is under the mouse. Everything here is in the world's axes.
import { type Plane, Ray, Vector3 } from 'three';
import type { Soup } from './scene/soup';

export interface Hit {
  distance: number;
  owner: number;
  place: Vector3;
}

/** The nearest triangle that a ray meets, of those that the section leaves. */
export function pick_soup(ray: Ray, soup: Soup, front_only: boolean, section: Plane | null): Hit | null {
  const [a, b, c, at] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  let best: Hit | null = null;
  for (let t = 0; t < soup.owner.length; ++t) {
    a.fromArray(soup.positions, 9 * t);
    b.fromArray(soup.positions, 9 * t + 3);
    c.fromArray(soup.positions, 9 * t + 6);
    if (!ray.intersectTriangle(a, b, c, front_only, at)) continue;
    const distance = at.distanceTo(ray.origin);
    if ((best && distance >= best.distance) || (section && section.distanceToPoint(at) < 0)) continue;
    best = { distance, owner: soup.owner[t]!, place: at.clone() };
  }
  return best;
}
