// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Keyboard shortcuts, and the window that lists them.
import type { App } from './app';
import { next_axis, next_color, toggle_tape } from './controls';
import { by_id, element } from './dom';
import { LAYERS } from './layers';
import { step_replay, toggle_play } from './replay_bar';

interface Shortcut {
  key: string;
  shown?: string;
  what: string;
  act: (app: App) => void;
}

const press = (id: string) => () => by_id(id).click();
const TURN = 0.12; // [rad]

const SHORTCUTS: Shortcut[] = [
  { key: 'i', what: 'view from a corner above', act: press('view-iso') },
  { key: 'v', what: 'view from the front', act: press('view-front') },
  { key: 't', what: 'view from above, true to scale', act: press('view-top') },
  { key: 'f', what: 'fit everything into the picture', act: press('view-fit') },
  { key: 'g', what: 'walk', act: press('view-walk') },
  { key: 'm', what: 'measure', act: toggle_tape },
  { key: 'b', what: 'surfaces from both sides', act: (app) => app.set_both_sides(!app.both_sides) },
  { key: 'c', what: 'next colouring', act: next_color },
  { key: 'x', what: 'next axis of the section', act: next_axis },
  { key: 'l', what: 'copy a link', act: press('copy-link') },
  { key: 'p', what: 'save the picture', act: press('picture') },
  { key: 'o', what: 'open a world.json', act: press('open') },
  { key: 'n', what: 'light or dark', act: press('theme') },
  { key: ' ', shown: 'space', what: 'play or pause the replay', act: toggle_play },
  { key: ',', what: 'replay: a step back', act: (app) => step_replay(app, -1) },
  { key: '.', what: 'replay: a step on', act: (app) => step_replay(app, 1) },
  { key: '+', what: 'closer', act: (app) => app.cameras.zoom(1.15) },
  { key: '-', what: 'farther', act: (app) => app.cameras.zoom(1 / 1.15) },
  { key: '?', what: 'this list', act: press('help') },
  { key: 'Escape', shown: 'Esc', what: 'end walking, measuring or the selection', act: escape },
];

const ARROWS: Record<string, [number, number]> = { ArrowLeft: [-TURN, 0], ArrowRight: [TURN, 0], ArrowUp: [0, TURN], ArrowDown: [0, -TURN] };

function escape(app: App): void {
  if (app.tape.cancel()) return app.show_tape();
  if (app.tape.active) return toggle_tape(app);
  if (app.cameras.view === 'walk') return app.cameras.set_view('orbit');
  app.select(null);
}

/** Whether a key belongs to the control that has the focus. */
function taken(e: KeyboardEvent): boolean {
  if (e.ctrlKey || e.altKey || e.metaKey) return true;
  if (by_id<HTMLDialogElement>('shortcuts').open) return true;
  const at = e.target as HTMLElement;
  if (at instanceof HTMLSelectElement) return e.key !== 'Escape';
  if (at instanceof HTMLInputElement && at.type !== 'checkbox') return at.type !== 'range' ? e.key !== 'Escape' : e.key.startsWith('Arrow');
  return e.key === ' ' && at.closest('button, input, [tabindex="0"]:not(canvas)') !== null;
}

function on_key(app: App, e: KeyboardEvent): void {
  if (taken(e)) return;
  const layer = LAYERS.find((l) => l.key === e.key);
  const shortcut = SHORTCUTS.find((s) => s.key === e.key || s.key === e.key.toLowerCase());
  const arrow = document.activeElement === app.stage.canvas || document.activeElement === document.body ? ARROWS[e.key] : undefined;
  if (app.walk.key(e)) e.preventDefault();
  else if (layer) app.set_layer(layer.name, !app.layers.has(layer.name));
  else if (arrow) {
    app.cameras.turn(...arrow);
    e.preventDefault();
  } else if (shortcut) {
    shortcut.act(app);
    e.preventDefault();
  }
}

function fill_help(dialog: HTMLDialogElement): void {
  const close = element('button', {}, 'Close');
  close.addEventListener('click', () => dialog.close());
  const rows = [
    ...LAYERS.map(({ key, label }) => [key, label]),
    ...SHORTCUTS.map(({ key, shown, what }) => [shown ?? key.toUpperCase(), what]),
    ['arrows', 'turn the view'],
    ['WASD', 'walk, while walking'],
  ];
  const list = element('dl', { class: 'keys' }, ...rows.map(([key, what]) => element('div', {}, element('dt', {}, element('kbd', {}, key!)), element('dd', {}, what!))));
  dialog.replaceChildren(element('h2', {}, 'Keyboard shortcuts'), list, element('p', { class: 'note' }, 'Drag turns, the right button moves, the wheel zooms. A click picks.'), close);
}

export function bind_keys(app: App): void {
  const dialog = by_id<HTMLDialogElement>('shortcuts');
  fill_help(dialog);
  by_id('help').addEventListener('click', () => dialog.showModal());
  dialog.addEventListener('click', (e) => {
    if (e.target === dialog) dialog.close(); // beside it
  });
  window.addEventListener('keydown', (e) => on_key(app, e));
}
