// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The controls of the replay: under the picture, and its list of stages in the panel.
import type { App } from './app';
import type { Replay } from './data';
import { by_id, element, fill_facts, grouped } from './dom';
import { css, hsl } from './palette';
import type { ReplayMode } from './replay';

export interface Stretch {
  stage: string;
  first: number;
  length: number;
}

/** Steps of one stage after another. */
export function stretches(replay: Replay): Stretch[] {
  const found: Stretch[] = [];
  replay.steps.forEach(({ stage }, i) => {
    const last = found.at(-1);
    if (last?.stage === stage) ++last.length;
    else found.push({ stage, first: i, length: 1 });
  });
  return found;
}

const stage_color = (i: number) => css(hsl((i * 0.13 + 0.55) % 1, 0.35, 0.55));

function button(id: string, text: string, title: string, act: () => void): HTMLButtonElement {
  const made = element('button', { id, title, 'aria-label': title }, text);
  made.addEventListener('click', act);
  return made;
}

/** One segment a stage, as wide as its steps. */
function strip(app: App, parts: Stretch[]): HTMLElement {
  const segments = parts.map(({ stage, first, length }, i) => {
    const made = element('button', { class: 'segment', title: stage, tabindex: '-1' }, stage);
    made.style.flexGrow = String(length);
    made.style.borderTopColor = stage_color(i);
    made.addEventListener('click', () => app.replay?.go_to(first));
    return made;
  });
  return element('div', { id: 'replay-strip' }, ...segments);
}

function slider(app: App): HTMLInputElement {
  const made = element('input', { id: 'replay-at', type: 'range', min: '0', max: String(Math.max(0, app.replay!.length - 1)), step: '1', 'aria-label': 'Step' });
  made.addEventListener('input', () => app.replay?.go_to(Number(made.value)));
  return made;
}

function speed(app: App): HTMLElement {
  const made = element('select', { id: 'replay-speed', 'aria-label': 'Speed' }, ...[0.5, 1, 2, 4, 8].map((s) => element('option', { value: String(s) }, `${s} steps/s`)));
  made.value = String(app.replay!.speed);
  made.addEventListener('change', () => (app.replay!.speed = Number(made.value)));
  return made;
}

function mode(app: App): HTMLElement {
  const made = element('select', { id: 'replay-mode', 'aria-label': 'Shown as' }, element('option', { value: 'polygons' }, 'polygons'), element('option', { value: 'points' }, 'points'));
  made.addEventListener('change', () => app.replay!.set_mode(made.value as ReplayMode));
  return made;
}

export function toggle_play(app: App): void {
  const { replay } = app;
  if (!replay) return;
  if (replay.playing) replay.pause();
  else {
    if (app.tab !== 'replay') app.set_tab('replay', replay.step);
    replay.play();
  }
}

export function step_replay(app: App, by: number): void {
  if (app.tab === 'replay') app.replay?.go_to(app.replay.step + by);
}

/** Makes the controls for the replay of the page that was loaded. */
export function show_replay_bar(app: App): void {
  const { replay } = app;
  if (!replay) return;
  const parts = stretches(replay.replay);
  by_id('replay-bar').replaceChildren(
    element('div', { class: 'row' },
      button('replay-back', '◂', 'A step back (,)', () => step_replay(app, -1)),
      button('replay-play', '▶', 'Play or pause (space)', () => toggle_play(app)),
      button('replay-on', '▸', 'A step on (.)', () => step_replay(app, 1)),
      element('div', { class: 'track' }, slider(app), strip(app, parts)),
      mode(app),
      speed(app)),
    element('div', { id: 'replay-text', 'aria-live': 'polite' }),
  );
  const stages = parts.map(({ stage, first }) => {
    const row = element('li', {}, button(`stage-${first}`, stage, `Go to ${stage}`, () => replay.go_to(first)));
    row.dataset.first = String(first);
    return row;
  });
  by_id('tab-replay').replaceChildren(
    element('section', {}, element('h2', {}, 'Step'), element('dl', { id: 'replay-facts' })),
    element('section', {}, element('h2', {}, 'Stages'), element('ol', { id: 'replay-stages' }, ...stages)),
  );
}

export function bind_replay_bar(app: App): void {
  app.listeners.push(() => {
    const { replay } = app;
    const shown = app.tab === 'replay' && replay !== null;
    by_id('replay-bar').hidden = !shown;
    if (!shown) return;
    const step = replay.current;
    by_id<HTMLInputElement>('replay-at').value = String(replay.step);
    by_id('replay-play').textContent = replay.playing ? '❚❚' : '▶';
    by_id('replay-play').classList.toggle('playing', replay.playing);
    by_id<HTMLSelectElement>('replay-mode').value = replay.mode;
    if (!step) return;
    by_id('replay-text').replaceChildren(element('b', {}, step.stage), ` ${step.text}`);
    fill_facts(by_id('replay-facts'), [
      ['Step', `${replay.step + 1} of ${replay.length}`],
      ['Stage', step.stage],
      ['Clusters', grouped(step.clusters)],
      ['Points changed', grouped(step.changed)],
      ['Method', replay.replay.method],
    ]);
    const rows = [...by_id('replay-stages').children] as HTMLElement[];
    const current = rows.filter((r) => Number(r.dataset.first) <= replay.step).at(-1);
    for (const row of rows) row.classList.toggle('current', row === current);
    [...by_id('replay-strip').children].forEach((s, i) => s.classList.toggle('current', rows[i] === current));
  });
}
