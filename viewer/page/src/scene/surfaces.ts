// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces of a world, filled and outlined, and their triangulation as a wireframe.
import { Color, FrontSide, DoubleSide, Group, Mesh, MeshBasicMaterial } from 'three';
import type { Vec3 } from '../check';
import type { Triangles } from '../data';
import { type ColorMode, shade, surface_color } from '../palette';
import type { World } from '../world';
import { hatch } from './hatch';
import { LineBuilder, type OutlinedLines } from './lines';
import { recolor, type Soup, soup_geometry, SoupBuilder } from './soup';

export function surface_soup(world: World, triangles: Triangles): Soup {
  const soup = new SoupBuilder();
  triangles.surface.forEach((s, t) => {
    const [a, b, c] = [0, 1, 2].map((k) => world.vertices[triangles.corners[3 * t + k]!]!) as [Vec3, Vec3, Vec3];
    soup.triangle(s, a, b, c);
  });
  return soup.done();
}

function outlines(world: World, ink: Color): OutlinedLines {
  const lines = new LineBuilder();
  for (const s of world.surfaces) for (const loop of [s.outer, ...s.holes]) lines.loop(loop.map((v) => world.vertices[v]!), s.normal);
  return lines.done(ink);
}

/** What was not measured: inferred surfaces and parts of others. */
function hatching(world: World, ink: Color): OutlinedLines {
  const lines = new LineBuilder();
  for (const s of world.surfaces) {
    const whole = [s.outer, ...s.holes].map((loop) => loop.map((v) => world.vertices[v]!));
    const parts = s.source === 'inferred' ? [whole] : s.inferred;
    for (const part of parts) for (const [a, b] of hatch(part, s.normal)) lines.segment(a, b, s.normal);
  }
  return lines.done(ink, 0.35);
}

function wireframe(world: World, triangles: Triangles, ink: Color): OutlinedLines {
  const lines = new LineBuilder();
  const drawn = new Set<string>();
  triangles.surface.forEach((s, t) => {
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [triangles.corners[3 * t + k]!, triangles.corners[3 * t + ((k + 1) % 3)]!];
      const key = `${s} ${Math.min(a, b)} ${Math.max(a, b)}`;
      if (drawn.has(key)) continue;
      drawn.add(key);
      lines.segment(world.vertices[a]!, world.vertices[b]!, world.surfaces[s]!.normal);
    }
  });
  return lines.done(ink);
}

export class SurfaceLayers {
  readonly polygons = new Group();
  readonly triangles: OutlinedLines;
  readonly soup: Soup;
  private readonly fill: Mesh<ReturnType<typeof soup_geometry>, MeshBasicMaterial>;
  private readonly outline: OutlinedLines;
  private readonly hatching: OutlinedLines;

  constructor(
    private readonly world: World,
    triangles: Triangles,
    ink: Color,
  ) {
    this.soup = surface_soup(world, triangles);
    const material = new MeshBasicMaterial({ vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    this.fill = new Mesh(soup_geometry(this.soup, () => [0, 0, 0]), material);
    this.outline = outlines(world, ink);
    this.hatching = hatching(world, ink);
    this.triangles = wireframe(world, triangles, ink);
    this.polygons.add(this.fill, this.outline, this.hatching);
  }

  set color_mode(mode: ColorMode) {
    recolor(this.fill.geometry, this.soup, (s) => {
      const surface = this.world.surfaces[s]!;
      const light = shade(surface.normal, this.world.up);
      return surface_color(surface, mode).map((v) => v * light) as Vec3;
    });
  }

  set both_sides(both: boolean) {
    this.fill.material.side = both ? DoubleSide : FrontSide;
    for (const lines of [this.outline, this.hatching, this.triangles]) lines.material.uniforms.both_sides!.value = both;
  }
}
