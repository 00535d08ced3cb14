// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The tabs of the panel; one without data is not there.
import type { App } from './app';
import type { Place } from './check';
import { by_id, element } from './dom';
import { tell } from './messages';
import { report_sections } from './report';
import { sim_sections } from './sim';

const TABS = [
  { name: 'world', label: 'World' },
  { name: 'replay', label: 'Replay' },
  { name: 'sim', label: 'Simulation' },
  { name: 'report', label: 'Report' },
];
const WIDE = ['sim', 'report'];

function fill(id: string, data: Place | null, sections: (p: Place) => HTMLElement[]): boolean {
  if (!data) return false;
  try {
    by_id(id).replaceChildren(...sections(data));
    return true;
  } catch (e) {
    tell((e as Error).message);
    return false;
  }
}

export function show_tabs(app: App): void {
  const { page } = app;
  if (!page) return;
  if (!fill('tab-report', page.report, report_sections)) page.report = null;
  if (!fill('tab-sim', page.sim, sim_sections)) page.sim = null;
  const there = TABS.filter(({ name }) => name === 'world' || (name === 'replay' ? app.replay : name === 'sim' ? page.sim : page.report));
  by_id('tabs').replaceChildren(...there.map(({ name, label }) => {
    const made = element('button', { id: `select-${name}`, role: 'tab', 'aria-controls': `tab-${name}` }, label);
    made.addEventListener('click', () => {
      app.set_tab(name);
      by_id('panel').scrollTop = 0;
    });
    return made;
  }));
}

export function bind_tabs(app: App): void {
  app.listeners.push(() => {
    for (const { name } of TABS) {
      by_id(`tab-${name}`).hidden = app.tab !== name;
      document.getElementById(`select-${name}`)?.setAttribute('aria-selected', String(app.tab === name));
    }
    document.body.classList.toggle('wide-panel', WIDE.includes(app.tab));
  });
}
