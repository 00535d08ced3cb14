// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The measuring tape: distances between places that were clicked, in the world's axes.
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Points, PointsMaterial, Vector3 } from 'three';
import { SELECTED } from './palette';
import { to_color } from './scene/materials';

export interface Measure {
  from: Vector3;
  to: Vector3;
}

const signed = (v: number) => `${v < 0 ? '−' : ''}${Math.abs(v).toFixed(3)}`;
export const length_text = (m: Measure) => `${m.from.distanceTo(m.to).toFixed(3)} m`;
export function parts_text({ from, to }: Measure): string {
  return `dx ${signed(to.x - from.x)}  dy ${signed(to.y - from.y)}  dz ${signed(to.z - from.z)}`;
}

export class Tape {
  readonly group = new Group();
  measures: Measure[] = [];
  active = false;
  private first: Vector3 | null = null;

  /** A place was clicked: the first or the second one of a distance. */
  click(place: Vector3): void {
    if (this.first) this.measures.push({ from: this.first, to: place });
    this.first = this.first ? null : place;
    this.redraw();
  }

  /** Forgets the place that waits for a second one; says whether there was one. */
  cancel(): boolean {
    const waiting = this.first !== null;
    this.first = null;
    this.redraw();
    return waiting;
  }

  clear(): void {
    this.measures = [];
    this.cancel();
  }

  /** What is measured now, in words. */
  get waiting(): boolean {
    return this.first !== null;
  }

  private redraw(): void {
    for (const child of this.group.children as (LineSegments | Points)[]) child.geometry.dispose();
    this.group.clear();
    const ends = this.measures.flatMap((m) => [m.from, m.to]);
    const geometry = (places: Vector3[]) => new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from(places.flatMap((p) => p.toArray())), 3));
    const color = to_color(SELECTED);
    const line = new LineSegments(geometry(ends), new LineBasicMaterial({ color, depthTest: false, transparent: true }));
    const marks = new Points(geometry(this.first ? [...ends, this.first] : ends), new PointsMaterial({ color, size: 8, sizeAttenuation: false, depthTest: false, transparent: true }));
    for (const object of [line, marks]) {
      object.frustumCulled = false;
      object.renderOrder = 3;
      this.group.add(object);
    }
  }
}
