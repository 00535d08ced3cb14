// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What explains the picture in its corner: the scale bar of the top view, the legend of the error atlas.
import type { App } from './app';
import { by_id, element } from './dom';
import { css, ramp, UNEXPLAINED } from './palette';

const LONGEST = 180; // [px]

/** The largest of 1, 2, 5, 10, ... metres that fits. */
export function bar_length(pixels_per_metre: number): number {
  const most = LONGEST / pixels_per_metre;
  const decade = 10 ** Math.floor(Math.log10(most));
  return ([5, 2, 1].find((n) => n * decade <= most) ?? 1) * decade;
}

function metres(length: number): string {
  if (length >= 1) return `${length} m`;
  return length >= 0.01 ? `${Math.round(length * 100)} cm` : `${Number((length * 1000).toPrecision(1))} mm`;
}

export function bind_corner(app: App): void {
  app.stage.after_frame.push(() => {
    const top = app.cameras.view === 'top' && app.page !== null;
    by_id('scale').hidden = !top;
    if (!top) return;
    const length = bar_length(app.cameras.pixels_per_metre);
    by_id('scale-bar').style.width = `${length * app.cameras.pixels_per_metre}px`;
    by_id('scale-bar').dataset.metres = String(length);
    by_id('scale-text').textContent = metres(length);
  });
  app.listeners.push(() => {
    const scan = app.layers.has('atlas') && app.tab !== 'replay' ? app.page?.scan : null;
    const legend = by_id('legend');
    legend.hidden = !scan;
    if (!scan || legend.dataset.of === String(scan.tolerance)) return;
    legend.dataset.of = String(scan.tolerance);
    const bar = element('div', { class: 'ramp' });
    bar.style.background = `linear-gradient(to right, ${[0, 0.25, 0.5, 0.75, 1].map((s) => css(ramp(s))).join(', ')})`;
    const mark = element('i', { class: 'swatch' });
    mark.style.background = css(UNEXPLAINED);
    const ticks = [0, 0.25, 0.5, 0.75, 1].map((s) => element('span', {}, (1000 * scan.tolerance * s).toFixed(s ? 1 : 0)));
    const unexplained = scan.distance.reduce((sum, d) => sum + (d > scan.tolerance * 1e4 ? 1 : 0), 0) / Math.max(1, scan.distance.length);
    legend.replaceChildren(
      element('div', {}, 'Distance to the world, mm'),
      bar,
      element('div', { class: 'ticks' }, ...ticks),
      element('div', {}, mark, ` unexplained: farther, ${(100 * unexplained).toFixed(1)} %`),
    );
  });
}
