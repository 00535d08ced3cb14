// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The buttons above the picture, clicks into it, and the address that follows what is shown.
import type { App } from './app';
import { toggle_tape } from './controls';
import { by_id } from './dom';
import { tell } from './messages';
import { save_picture } from './picture';
import { effective_theme, on_system_theme } from './theme';

const STILL = 4; // [px] a click may move
const LINK_AFTER = 250; // [ms] without change until the address follows: browsers count how often it changes

async function copy_link(app: App): Promise<void> {
  follow(app);
  try {
    await navigator.clipboard.writeText(location.href);
    tell('The link is in the clipboard.', 'note');
  } catch {
    tell('The address of this page is the link; this browser does not let it be copied by a button.', 'note');
  }
}

let followed = '';

function follow(app: App): void {
  if (!app.page) return;
  followed = app.link();
  try {
    history.replaceState(null, '', followed);
  } catch {
    // A browser may refuse when the address changes very often; the next change catches up.
  }
}

function bind_link(app: App): void {
  let timer = 0;
  app.listeners.push(() => {
    clearTimeout(timer);
    timer = window.setTimeout(() => follow(app), LINK_AFTER);
  });
  window.addEventListener('hashchange', () => {
    if (location.hash !== followed) app.restore(location.hash);
  });
}

function bind_clicks(app: App): void {
  const { canvas } = app.stage;
  let down: { x: number; y: number } | null = null;
  canvas.addEventListener('pointerdown', (e) => {
    down = e.isPrimary && e.button === 0 ? { x: e.clientX, y: e.clientY } : null;
  });
  canvas.addEventListener('pointerup', (e) => {
    if (down && Math.hypot(e.clientX - down.x, e.clientY - down.y) < STILL) app.click(e.clientX, e.clientY);
    down = null;
  });
}

export function bind_toolbar(app: App): void {
  for (const name of ['iso', 'front', 'top', 'fit']) by_id(`view-${name}`).addEventListener('click', () => app.set_view(name));
  by_id('view-walk').addEventListener('click', () => (app.cameras.view === 'walk' ? app.cameras.set_view('orbit') : app.set_view('walk')));
  by_id('measure').addEventListener('click', () => toggle_tape(app));
  by_id('copy-link').addEventListener('click', () => void copy_link(app));
  by_id('picture').addEventListener('click', () => save_picture(app));
  by_id('theme').addEventListener('click', () => app.set_theme(effective_theme(app.theme) === 'dark' ? 'light' : 'dark'));
  const height = by_id<HTMLInputElement>('walk-height');
  height.addEventListener('input', () => {
    if (height.valueAsNumber > 0) app.walk.set_height(height.valueAsNumber);
  });
  app.listeners.push(() => {
    const walking = app.cameras.view === 'walk';
    by_id('walk-bar').hidden = !walking;
    by_id('view-walk').setAttribute('aria-pressed', String(walking));
    by_id('view-top').setAttribute('aria-pressed', String(app.cameras.view === 'top'));
    if (document.activeElement !== height) height.value = app.walk.height.toFixed(2);
  });
  on_system_theme(() => app.apply_theme());
  bind_clicks(app);
  bind_link(app);
}
