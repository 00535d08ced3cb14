// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What is known of the thing that was picked, and of the world.
import type { App } from './app';
import type { Page } from './data';
import { by_id, fill_facts, grouped, millimetres, percent } from './dom';
import type { Thing } from './layers';
import { id_of } from './link';
import { area_of } from './triangulate';
import type { Solid } from './world';

type Facts = [string, string][];
const number = (v: number, digits = 3) => v.toFixed(digits).replace('-', '−');
const vector = (v: number[]) => v.map((x) => number(x)).join(', ');

function provenance(page: Page): Facts {
  const { program, inputs } = page.world.provenance;
  return [
    ['Made by', program],
    ...inputs.map(({ file, points, fingerprint }): [string, string] => ['Made of', [file, points === null ? '' : `${grouped(points)} points`, fingerprint].filter(Boolean).join('\n')]),
  ];
}

function surface_facts(page: Page, index: number): Facts {
  const s = page.world.surfaces[index]!;
  const facts: Facts = [
    ['Kind', s.kind],
    ['Source', s.source],
    ['Area', `${area_of(s, page.world).toFixed(2)} m²`],
  ];
  if (s.support) facts.push(['Points', grouped(s.support.points)], ['RMS distance', millimetres(s.support.rms)], ['Coverage', percent(s.support.coverage)]);
  facts.push(['Thickness', s.thickness === null ? 'unknown' : millimetres(s.thickness)], ['Normal', vector(s.normal)], ['Offset', `${number(s.offset)} m`]);
  const measured = page.fidelity.get(s.id);
  if (measured)
    facts.push(
      ['Measured offset', measured.offset === null ? 'unknown' : millimetres(measured.offset)],
      ['Measured RMS', measured.rms === null ? 'unknown' : `${millimetres(measured.rms)} of ${grouped(measured.points)} points`],
      ['Measured coverage', measured.coverage === null ? 'unknown' : percent(measured.coverage)],
    );
  return facts;
}

function opening_facts(page: Page, index: number): Facts {
  const o = page.world.openings[index]!;
  const door = page.world.doors.find((d) => d.opening === index);
  return [
    ['Kind', o.glass ? `${o.kind} with a pane` : o.kind],
    ['Clear width', `${o.width.toFixed(3)} m`],
    ['Clear height', `${o.height.toFixed(3)} m`],
    ['In surface', String(page.world.surfaces[o.surface]!.id)],
    ...(o.leaf ? ([['Leaf', `surface ${page.world.surfaces[o.leaf.surface]!.id}, ${((o.leaf.angle * 180) / Math.PI).toFixed(0)}° open, hinge ${o.leaf.hinge}`]] as Facts) : []),
    ...(door ? ([['Joins', door.rooms.map((r) => page.world.rooms[r]!.name).join(' and ')]] as Facts) : []),
    ['Evidence', o.evidence],
  ];
}

function solid_facts(solid: Solid): Facts {
  if (solid.form === 'box') return [['Form', 'box'], ['Size', `${vector(solid.size)} m`], ['Center', vector(solid.center)]];
  if (solid.form === 'cylinder') return [['Form', 'cylinder'], ['Radius', `${number(solid.radius)} m`], ['Height', `${number(solid.height)} m`], ['Center', vector(solid.center)]];
  return [['Form', solid.form === 'hull' ? `convex hull of ${solid.vertices.length} vertices` : 'prism']];
}

function facts_of(page: Page, { type, index }: Thing): Facts {
  if (type === 'surface') return surface_facts(page, index);
  return type === 'opening' ? opening_facts(page, index) : solid_facts(page.world.obstacles[index]!.solid);
}

export function show_world_facts(page: Page): void {
  const { world, scan } = page;
  const extent = world.vertices.reduce((box, v) => box.map(([lo, hi], k) => [Math.min(lo!, v[k]!), Math.max(hi!, v[k]!)]), [[Infinity, -Infinity], [Infinity, -Infinity], [Infinity, -Infinity]]);
  const facts: Facts = [
    ...(world.vertices.length ? ([['Extent', `${extent.map(([lo, hi]) => (hi! - lo!).toFixed(1)).join(' × ')} m`]] as Facts) : []),
    ['Vertices', grouped(world.vertices.length)],
    ...(scan ? ([['Scan', `${grouped(scan.points)} points, ${grouped(scan.positions.length / 3)} shown`]] as Facts) : []),
    ...(scan?.left_out ? ([['Left out', `${grouped(scan.left_out)} points far away`]] as Facts) : []),
    ...provenance(page),
  ];
  fill_facts(by_id('world-facts'), facts);
}

export function bind_details(app: App): void {
  let shown: Thing | null = null;
  app.listeners.push(() => {
    if (app.selection === shown) return;
    shown = app.selection;
    const panel = by_id('selection');
    panel.hidden = shown === null;
    if (!shown || !app.page) return;
    by_id('selection-title').textContent = `${shown.type[0]!.toUpperCase()}${shown.type.slice(1)} ${id_of(app.page, shown)}`;
    fill_facts(by_id('selection-facts'), [...facts_of(app.page, shown), ...provenance(app.page)]);
    panel.scrollIntoView({ block: 'nearest' });
  });
}
