// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// report.json for people: what was found, how true it is, how long it took.
import type { Place } from './check';
import { element, fill_facts, grouped, millimetres, percent, seconds } from './dom';

type Facts = [string, string][];

function facts_section(title: string, facts: Facts): HTMLElement {
  const list = element('dl');
  fill_facts(list, facts);
  return element('section', {}, element('h2', {}, title), list);
}

function found(report: Place): Facts {
  const facts: Facts = [];
  const add = (name: string, p: Place, show: (p: Place) => string) => {
    if (p.present) facts.push([name, show(p)]);
  };
  const count = (p: Place) => grouped(p.number());
  const length = (p: Place) => millimetres(p.number());
  if (report.at('points').present) add('Points', report.at('points').at('input'), count);
  if (report.at('surfaces').present) {
    const kinds = report.at('surfaces');
    facts.push(['Surfaces', kinds.keys().map((k) => `${kinds.at(k).number()} ${k}`).join(', ')]);
  }
  add('Triangles', report.at('triangles'), count);
  add('Point spacing', report.at('spacing'), length);
  add('Noise', report.at('noise'), length);
  add('T-junctions', report.at('t_junctions'), count);
  add('Cracks', report.at('cracks'), count);
  add('Method', report.at('method'), (p) => p.text());
  add('Preset', report.at('preset'), (p) => p.text());
  add('CPU time', report.at('cpu_seconds'), (p) => seconds(p.number()));
  add('Peak memory', report.at('peak_memory_mb'), (p) => `${p.number().toFixed(0)} MB`);
  add('Hash of the world', report.at('world_hash'), (p) => p.text());
  add('Program', report.at('program'), (p) => p.text());
  return facts;
}

/** What a criterion found and allows, in its unit. */
function limit(c: Place): string {
  const unit = c.at('unit').text();
  const show = (n: number) => (unit === 'm' ? millimetres(n) : unit === '%' ? percent(n) : grouped(n));
  const bound = c.at('at_most').present ? `at most ${show(c.at('at_most').number())}` : c.at('at_least').present ? `at least ${show(c.at('at_least').number())}` : '';
  return c.at('value').present ? `${show(c.at('value').number())}, ${bound}` : `not known, ${bound}`;
}

function fidelity(p: Place): HTMLElement {
  const criteria = p.at('criteria').any().map((c) => {
    const met = c.at('met').value;
    const word = met === true ? 'met' : met === false ? 'not met' : 'unknown';
    return element('li', { class: word === 'not met' ? 'unmet' : word }, element('span', {}, word), c.at('name').text(), element('small', {}, limit(c)));
  });
  const faithful = p.at('faithful').value === true;
  const verdict = p.at('verdict').optional((v) => v.text()) ?? '';
  return element('section', {}, element('h2', {}, 'Fidelity'), element('p', { class: faithful ? 'verdict met' : 'verdict unmet' }, verdict), element('ul', { class: 'criteria' }, ...criteria));
}

/** A bar for each stage, the longest one fills the width. */
function stages(list: Place[]): HTMLElement {
  const times = list.map((s) => ({ name: s.at('name').text(), seconds: s.at('seconds').number(), what: s.at('what').optional((w) => w.text()) ?? '' }));
  const most = Math.max(...times.map((t) => t.seconds), 1e-9);
  const rows = times.map((t) => {
    const bar = element('div', { class: 'amount' });
    bar.style.width = `${(100 * t.seconds) / most}%`;
    return element('div', { class: 'bar-row', title: t.what }, element('span', {}, t.name), element('div', { class: 'track' }, bar), element('span', { class: 'value' }, seconds(t.seconds)));
  });
  const total = times.reduce((sum, t) => sum + t.seconds, 0);
  return element('section', {}, element('h2', {}, `Stages, ${seconds(total)}`), ...rows);
}

export function report_sections(report: Place): HTMLElement[] {
  const warnings = report.at('warnings').any().map((w) => element('li', {}, w.text()));
  return [
    ...(warnings.length ? [element('section', {}, element('h2', {}, 'Warnings'), element('ul', { class: 'warnings' }, ...warnings))] : []),
    ...(report.at('fidelity').present ? [fidelity(report.at('fidelity'))] : []),
    facts_section('Found', found(report)),
    ...(report.at('stages').any().length ? [stages(report.at('stages').any())] : []),
  ];
}
