// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The layers of the picture: what they are called, their keys, and why one may have nothing to show.
import type { Page } from './data';

export type LayerName = 'points' | 'polygons' | 'triangles' | 'openings' | 'obstacles' | 'colliders' | 'rooms' | 'atlas' | 'violations' | 'leaks';

/** What can be picked, by its index in the world. */
export interface Thing {
  type: 'surface' | 'opening' | 'obstacle';
  index: number;
}

interface Layer {
  name: LayerName;
  label: string;
  key: string;
  /** Why there is nothing to show, or null. */
  missing: (page: Page) => string | null;
  count: (page: Page) => number | null;
}

const NO_SCAN = 'no scan was given';
const lacks = (what: string, list: (page: Page) => unknown[]) => (page: Page) => (list(page).length ? null : `the world has no ${what}`);

export const LAYERS: Layer[] = [
  { name: 'points', label: 'Scan points', key: '1', missing: (p) => (p.scan ? null : NO_SCAN), count: (p) => p.scan && p.scan.positions.length / 3 },
  { name: 'polygons', label: 'Polygons', key: '2', missing: lacks('surfaces', (p) => p.world.surfaces), count: (p) => p.world.surfaces.length },
  { name: 'triangles', label: 'Triangles', key: '3', missing: lacks('surfaces', (p) => p.world.surfaces), count: (p) => p.triangles.surface.length },
  { name: 'openings', label: 'Doors and windows', key: '4', missing: lacks('openings', (p) => p.world.openings), count: (p) => p.world.openings.length },
  { name: 'obstacles', label: 'Obstacles', key: '5', missing: lacks('obstacles', (p) => p.world.obstacles), count: (p) => p.world.obstacles.length },
  { name: 'colliders', label: 'Colliders', key: '6', missing: lacks('colliders', (p) => p.world.colliders), count: (p) => p.world.colliders.length },
  { name: 'rooms', label: 'Rooms', key: '7', missing: lacks('rooms', (p) => p.world.rooms), count: (p) => p.world.rooms.length },
  { name: 'atlas', label: 'Distance to the world', key: '8', missing: (p) => (p.scan ? null : NO_SCAN), count: () => null },
  { name: 'violations', label: 'Free-space violations', key: '9', missing: (p) => no_rays(p, p.scan?.violations, 'no ray goes through the world'), count: (p) => p.scan && p.scan.violations_found },
  { name: 'leaks', label: 'Leaks', key: '0', missing: (p) => no_rays(p, p.scan?.leaks, 'no ray finds the world missing'), count: (p) => p.scan && p.scan.leaks_found },
];

function no_rays(page: Page, rays: Float32Array | undefined, none: string): string | null {
  if (!rays) return NO_SCAN;
  if (rays.length) return null;
  return page.scan!.has_rays ? none : 'needs scanner positions';
}

export function available(name: LayerName, page: Page): boolean {
  return LAYERS.find((l) => l.name === name)!.missing(page) === null;
}

export function default_layers(page: Page): Set<LayerName> {
  const wanted: LayerName[] = ['points', 'polygons', 'openings', 'obstacles'];
  return new Set(wanted.filter((name) => available(name, page)));
}
