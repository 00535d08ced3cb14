// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The controls of the panel's first tab: layers, colours, section, distances.
import type { App } from './app';
import { by_id, element, grouped } from './dom';
import { LAYERS } from './layers';
import { COLOR_MODES, type ColorMode, css, OPENING_COLORS } from './palette';
import { AXES, type Axis, section_range } from './section';
import { parts_text, length_text } from './tape';
import type { Page } from './data';

function layer_row(app: App, layer: (typeof LAYERS)[number], page: Page): HTMLElement {
  const reason = layer.missing(page);
  const box = element('input', { type: 'checkbox', id: `layer-${layer.name}` });
  box.disabled = reason !== null;
  box.addEventListener('change', () => app.set_layer(layer.name, box.checked));
  const count = layer.count(page);
  const row = element('label', { class: 'check layer' }, box, element('span', {}, layer.label), element('small', {}, reason === null && count !== null ? grouped(count) : ''), element('kbd', {}, layer.key));
  if (layer.name === 'openings' && reason === null) row.children[1]!.append(...Object.entries(OPENING_COLORS).map(([kind, color]) => swatch(kind, css(color))));
  if (reason !== null) {
    row.title = reason;
    row.classList.add('off');
    row.children[2]!.textContent = reason;
  }
  return row;
}

function swatch(title: string, color: string): HTMLElement {
  const made = element('i', { class: 'swatch', title });
  made.style.background = color;
  return made;
}

export function show_layers(app: App): void {
  by_id('layers').replaceChildren(...(app.page ? LAYERS.map((layer) => layer_row(app, layer, app.page!)) : []));
}

export function bind_controls(app: App): void {
  const color = by_id<HTMLSelectElement>('color-mode');
  color.addEventListener('change', () => app.set_color(color.value as ColorMode));
  const sides = by_id<HTMLInputElement>('both-sides');
  sides.addEventListener('change', () => app.set_both_sides(sides.checked));
  const axis = by_id<HTMLSelectElement>('section-axis');
  axis.addEventListener('change', () => set_axis(app, axis.value as Axis));
  const at = by_id<HTMLInputElement>('section-at');
  at.addEventListener('input', () => app.set_section({ ...app.section, at: Number(at.value) }));
  const flip = by_id<HTMLInputElement>('section-flip');
  flip.addEventListener('change', () => app.set_section({ ...app.section, flip: flip.checked }));
  by_id('tape-clear').addEventListener('click', () => clear_tape(app));
  app.listeners.push(() => update_controls(app), () => update_tape(app));
}

/** A new axis cuts through the middle. */
export function set_axis(app: App, axis: Axis): void {
  const [low, high] = section_range(axis, app.scene_box());
  app.set_section({ axis, at: Math.round(50 * (low + high)) / 100, flip: false });
}

export function next_axis(app: App): void {
  set_axis(app, AXES[(AXES.indexOf(app.section.axis) + 1) % AXES.length]!);
}

export function next_color(app: App): void {
  app.set_color(COLOR_MODES[(COLOR_MODES.indexOf(app.color) + 1) % COLOR_MODES.length]!);
}

export function clear_tape(app: App): void {
  app.tape.clear();
  app.show_tape();
}

export function toggle_tape(app: App): void {
  app.tape.active = !app.tape.active;
  app.tape.cancel();
  app.stage.request();
  app.changed();
}

function update_controls(app: App): void {
  for (const { name } of LAYERS) {
    const box = document.getElementById(`layer-${name}`) as HTMLInputElement | null;
    if (box) box.checked = app.layers.has(name);
  }
  by_id<HTMLSelectElement>('color-mode').value = app.color;
  by_id<HTMLInputElement>('both-sides').checked = app.both_sides;
  by_id<HTMLSelectElement>('section-axis').value = app.section.axis;
  by_id<HTMLInputElement>('section-flip').checked = app.section.flip;
  by_id('section-more').hidden = app.section.axis === 'off';
  by_id('section-value').textContent = `${app.section.at.toFixed(2)} m`;
  const at = by_id<HTMLInputElement>('section-at');
  if (app.section.axis !== 'off') [at.min, at.max] = section_range(app.section.axis, app.scene_box()).map((v) => v.toFixed(2)) as [string, string];
  at.value = String(app.section.at);
}

function update_tape(app: App): void {
  const { tape } = app;
  by_id('tape').hidden = !tape.active && tape.measures.length === 0;
  by_id('tape-hint').textContent = !tape.active ? 'Press M to measure more.' : tape.waiting ? 'Click the second place.' : 'Click two places; corners attract. Esc ends.';
  by_id('tape-list').replaceChildren(...tape.measures.map((m) => element('li', {}, element('b', {}, length_text(m)), element('span', {}, parts_text(m)))));
  by_id('measure').setAttribute('aria-pressed', String(tape.active));
  by_id('canvas').classList.toggle('measuring', tape.active);
}
