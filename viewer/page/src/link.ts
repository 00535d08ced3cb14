// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What is shown, as the hash of the page's address and back.
import { available, LAYERS, type LayerName, type Thing } from './layers';
import { COLOR_MODES, type ColorMode } from './palette';
import { AXES, type Axis, type Section } from './section';
import type { Page } from './data';
import type { View } from './camera';

export interface Shown {
  view: View;
  camera: number[];
  layers: Set<LayerName>;
  color: ColorMode;
  both_sides: boolean;
  section: Section;
  selection: Thing | null;
  theme: 'dark' | 'light' | null; // null: as the system has it
  tab: string;
  step: number | null;
}

const list_of = (page: Page, type: Thing['type']) => ({ surface: page.world.surfaces, opening: page.world.openings, obstacle: page.world.obstacles })[type];

export const id_of = (page: Page, thing: Thing): number => list_of(page, thing.type)[thing.index]!.id;

export function find_thing(page: Page, type: string, id: number): Thing | null {
  if (type !== 'surface' && type !== 'opening' && type !== 'obstacle') return null;
  const index = list_of(page, type).findIndex((t) => t.id === id);
  return index < 0 ? null : { type, index };
}

export function write_link(shown: Shown, page: Page): string {
  const parts: [string, string][] = [
    ['view', shown.view],
    ['camera', shown.camera.join(',')],
    ['layers', [...shown.layers].join(',')],
    ['color', shown.color],
  ];
  if (shown.both_sides) parts.push(['sides', 'both']);
  if (shown.section.axis !== 'off') parts.push(['section', `${shown.section.axis},${shown.section.at},${shown.section.flip ? 'above' : 'below'}`]);
  if (shown.selection) parts.push(['select', `${shown.selection.type},${id_of(page, shown.selection)}`]);
  if (shown.theme) parts.push(['theme', shown.theme]);
  if (shown.tab !== 'world') parts.push(['tab', shown.tab]);
  if (shown.step !== null) parts.push(['step', String(shown.step)]);
  return `#${parts.map(([key, value]) => `${key}=${value}`).join('&')}`;
}

/** What the hash says; what it does not say or says wrongly is left out. */
export function read_link(hash: string, page: Page): Partial<Shown> {
  const values = new Map(hash.replace(/^#/, '').split('&').map((part) => part.split('=', 2) as [string, string]));
  const found: Partial<Shown> = {};
  const one_of = <T extends string>(key: string, choices: readonly T[]): T | undefined => choices.find((c) => c === values.get(key));
  const numbers = (values.get('camera') ?? '').split(',').map(Number);
  const view = one_of('view', ['orbit', 'top', 'walk'] as const);
  if (view && numbers.length > 1 && numbers.every(Number.isFinite)) Object.assign(found, { view, camera: numbers });
  if (values.has('layers')) found.layers = new Set(LAYERS.map((l) => l.name).filter((name) => values.get('layers')!.split(',').includes(name) && available(name, page)));
  const color = one_of('color', COLOR_MODES);
  if (color) found.color = color;
  found.both_sides = values.get('sides') === 'both';
  const [axis, at, side] = (values.get('section') ?? 'off,0,below').split(',');
  if (AXES.includes(axis as Axis) && Number.isFinite(Number(at))) found.section = { axis: axis as Axis, at: Number(at), flip: side === 'above' };
  const [type, id] = (values.get('select') ?? '').split(',');
  found.selection = find_thing(page, type ?? '', Number(id));
  const theme = one_of('theme', ['dark', 'light'] as const);
  if (theme) found.theme = theme;
  found.tab = values.get('tab') ?? 'world';
  const step = Number(values.get('step') ?? NaN);
  if (Number.isInteger(step) && step >= 0) found.step = step;
  return found;
}
