// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Doors, windows and passages: what is open is a tinted sheet with a frame.
import { DoubleSide, Group, Mesh, MeshBasicMaterial } from 'three';
import { GLASS, OPENING_COLORS } from '../palette';
import { triangulate } from '../triangulate';
import type { World } from '../world';
import { LineBuilder } from './lines';
import { to_color } from './materials';
import { type Soup, soup_geometry, SoupBuilder } from './soup';

export function opening_soup(world: World): Soup {
  const soup = new SoupBuilder();
  world.openings.forEach((opening, i) => {
    const loop = opening.loop.map((v) => world.vertices[v]!);
    for (const [a, b, c] of triangulate(loop, [], world.surfaces[opening.surface]!.normal)) soup.triangle(i, loop[a!]!, loop[b!]!, loop[c!]!);
  });
  return soup.done();
}

export function opening_layer(soup: Soup, world: World): Group {
  const group = new Group();
  const geometry = soup_geometry(soup, (i) => (world.openings[i]!.glass ? GLASS : OPENING_COLORS[world.openings[i]!.kind]));
  group.add(new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.38, side: DoubleSide, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -2 })));
  for (const kind of ['door', 'window', 'passage'] as const) {
    const frames = new LineBuilder();
    for (const o of world.openings) if (o.kind === kind) frames.loop(o.loop.map((v) => world.vertices[v]!), [0, 0, 0]);
    group.add(frames.done(to_color(OPENING_COLORS[kind], 0.75)));
  }
  return group;
}
