// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What sim_check measured (docs/sim_check.md): how fast robots are simulated in each place, and whether they stay in it.
import type { Place } from './check';
import { bytes, element, grouped, percent, seconds, table } from './dom';

type Cell = Node | string;

/** A time, and how many times less it is than in the first row. */
function timing(p: Place): Cell {
  if (!p.present) return '–';
  const cpu = p.at('cpu').at('mean').number();
  const ratio = p.at('ratio').optional((r) => r.number());
  const cell = element('span', { title: `mean of CPU time, ± ${seconds(p.at('cpu').at('deviation').number())}` }, seconds(cpu));
  if (ratio !== null && ratio !== 1) cell.append(element('small', {}, ` ${ratio >= 100 ? ratio.toFixed(0) : ratio.toFixed(ratio >= 10 ? 1 : 2)} ×`));
  return cell;
}

/** The last part of a path; of a world.json its folder. */
function short_name(row: Place): string {
  const parts = row.at('name').text().split('/').filter((part) => part !== 'world.json');
  return parts.at(-1) ?? row.at('name').text();
}

function step_rows(rows: Place[], robot: string): Cell[][] {
  const steps = (row: Place) => row.at('speed').at('steps').any().filter((s) => s.at('robot').text() === robot);
  return steps(rows[0]!).map((first) => {
    const robots = first.at('robots').number();
    const find = (row: Place) => steps(row).find((s) => s.at('robots').number() === robots);
    return [`step of ${robots} ${robot}${robots === 1 ? '' : 's'}`, ...rows.map((row) => (find(row) ? timing(find(row)!.at('time')) : '–'))];
  });
}

function speed_table(rows: Place[]): HTMLElement {
  const line = (name: string, cell: (speed: Place) => Cell): Cell[] => [name, ...rows.map((row) => cell(row.at('speed')))];
  const robots = [...new Set(rows.flatMap((row) => row.at('speed').at('steps').any().map((s) => s.at('robot').text())))];
  return table(
    ['', ...rows.map(short_name)],
    [
      line('triangles', (s) => grouped(s.at('triangles').number())),
      line('solids', (s) => grouped(s.at('solids').number())),
      line('memory', (s) => bytes(s.at('memory').number())),
      ...robots.flatMap((robot) => step_rows(rows, robot)),
      line('detection', (s) => timing(s.at('detection'))),
      line('contact test', (s) => timing(s.at('contact_test'))),
      line('sweep', (s) => timing(s.at('sweep'))),
      line('lidar', (s) => timing(s.at('lidar'))),
    ],
  );
}

function robustness_table(rows: Place[]): HTMLElement {
  const judged = rows.filter((row) => row.at('robustness').present);
  const line = (name: string, cell: (r: Place) => string): Cell[] => [name, ...judged.map((row) => cell(row.at('robustness')))];
  const lost = judged[0]?.at('robustness').at('lost').any() ?? [];
  const share = (r: Place, i: number) => {
    const l = r.at('lost').any()[i];
    const robots = l?.at('robots').number() ?? 0;
    return robots ? percent(l!.at('lost').number() / robots) : '–';
  };
  const of = (r: Place, key: string, value: (p: Place) => string) => (r.at(key).present ? value(r.at(key)) : '–');
  return table(
    ['', ...judged.map(short_name)],
    [
      ...lost.map((l, i) => line(`lost at ${l.at('speed').number()} m/s, ${l.at('rate').number()} Hz`, (r) => share(r, i))),
      line('speed lost by a sliding cube', (r) => of(r, 'cube', (c) => percent(c.at('speed_lost').number()))),
      line('doors passed', (r) => of(r, 'doors', (d) => `${d.at('passed').number()} of ${d.at('wide').number()}`)),
      line('walls open', (r) => of(r, 'doors', (d) => `${d.at('walls_open').number()} of ${d.at('walls').number()}`)),
      line('gaps in the floor', (r) => of(r, 'floor', (f) => grouped(f.at('gaps').number()))),
      line('floor to drive on', (r) => of(r, 'floor', (f) => `${f.at('drivable').number().toFixed(1)} m²`)),
    ],
  );
}

function promises(rows: Place[]): HTMLElement[] {
  return rows.flatMap((row) => {
    const list = row.at('promises').any();
    if (list.length === 0) return [];
    const lines = list.map((p) => {
      const kept = p.at('kept').value === true;
      return element('li', { class: kept ? 'met' : 'unmet' }, element('span', {}, kept ? 'kept' : 'broken'), p.at('name').text());
    });
    return [element('h3', {}, short_name(row)), element('ul', { class: 'criteria' }, ...lines)];
  });
}

/** The tab's sections; throws a Fault where the data is not what it should be. */
export function sim_sections(sim: Place): HTMLElement[] {
  const rows = sim.at('rows').list();
  const speed = rows.filter((row) => row.at('speed').present);
  const kept = sim.at('keeps_promises').value === true;
  const about = [String(sim.at('engine').value ?? 'an engine'), `${String(sim.at('rate').value ?? '?')} Hz`];
  return [
    element('section', {}, element('h2', {}, 'Verdict'), element('p', { class: kept ? 'verdict met' : 'verdict unmet' }, sim.at('verdict').text()), ...promises(rows)),
    ...(speed.length ? [element('section', {}, element('h2', {}, 'Speed'), element('p', { class: 'note' }, `Mean CPU time (${about.join(', ')}); × how many times faster than in the first place.`), scrolling(speed_table(speed)))] : []),
    ...(rows.some((row) => row.at('robustness').present) ? [element('section', {}, element('h2', {}, 'Robustness'), scrolling(robustness_table(rows)))] : []),
  ];
}

export const scrolling = (content: HTMLElement): HTMLElement => element('div', { class: 'scrolling', tabindex: '0' }, content);
