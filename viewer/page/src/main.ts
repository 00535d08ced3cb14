// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Starts the page: reads the data that was put into it and shows it, or says why it cannot.
import { make_api, type Scanworld } from './api';
import { App } from './app';
import { Fault, parse } from './check';
import { bind_controls, show_layers } from './controls';
import { bind_corner } from './corner';
import { type Page, read_page } from './data';
import { bind_details, show_world_facts } from './details';
import { by_id } from './dom';
import { bind_files } from './files';
import { bind_keys } from './keys';
import { catch_all, tell } from './messages';
import { bind_replay_bar, show_replay_bar } from './replay_bar';
import './style.css';
import { bind_tabs, show_tabs } from './tabs';
import { set_theme } from './theme';
import { bind_toolbar } from './toolbar';

declare global {
  interface Window {
    scanworld: Scanworld;
  }
}

function make_app(): App {
  const canvas = by_id<HTMLCanvasElement>('canvas');
  canvas.addEventListener('webglcontextlost', () => tell('The graphics card has dropped this page. Reload it to see the world again.'));
  try {
    return new App(canvas);
  } catch (e) {
    throw new Fault(`This browser shows no 3D: WebGL is missing or switched off (${(e as Error).message}).`);
  }
}

function show(app: App, page: Page, hash: string): void {
  app.load(page, hash);
  by_id('empty').hidden = true;
  by_id('title').textContent = page.title;
  document.title = `${page.title} – scanworld`;
  show_layers(app);
  show_world_facts(page);
  show_replay_bar(app);
  show_tabs(app);
  if (hash.length > 1) app.restore(hash); // the tabs are there now
  for (const fault of page.faults) tell(fault);
  app.changed();
}

/** The data in the page; null where there is none. */
function embedded(): Page | null {
  const text = by_id('scanworld-data').textContent ?? 'null';
  const root = parse(text, 'the data of the page');
  return root.value === null ? null : read_page(root);
}

function start(): Promise<void> {
  const app = make_app();
  for (const bind of [bind_controls, bind_details, bind_corner, bind_replay_bar, bind_tabs, bind_toolbar, bind_keys]) bind(app);
  bind_files((page) => show(app, page, ''));
  new ResizeObserver(([entry]) => {
    app.stage.resize(entry!.contentRect.width, entry!.contentRect.height);
    app.cameras.resize();
  }).observe(by_id('stage'));
  const stage = by_id('stage').getBoundingClientRect();
  app.stage.resize(stage.width, stage.height);
  app.apply_theme();
  const ready = Promise.resolve().then(() => {
    try {
      const page = embedded();
      if (page) show(app, page, location.hash);
      else by_id('empty').hidden = false;
    } catch (e) {
      by_id('empty').hidden = false;
      tell((e as Error).message);
    }
  });
  window.scanworld = make_api(app, ready);
  return ready;
}

catch_all();
set_theme(null);
try {
  void start();
} catch (e) {
  tell((e as Error).message);
}
