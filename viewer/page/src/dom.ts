// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Elements of the page. Text only ever becomes text: names in a scan are nobody's markup.

export function by_id<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

export function element<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Record<string, string> = {}, ...children: (Node | string)[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** Fills a list of terms and values. */
export function fill_facts(list: HTMLElement, facts: [string, string][]): void {
  list.replaceChildren(...facts.flatMap(([term, value]) => [element('dt', {}, term), element('dd', {}, value)]));
}

export function table(head: string[], rows: (Node | string)[][]): HTMLTableElement {
  const line = (tag: 'th' | 'td', cells: (Node | string)[]) => element('tr', {}, ...cells.map((cell) => element(tag, {}, cell)));
  return element('table', {}, element('thead', {}, line('th', head)), element('tbody', {}, ...rows.map((row) => line('td', row))));
}

export const grouped = (n: number): string => Math.round(n).toLocaleString('en-US');
export const millimetres = (metres: number): string => `${(1000 * metres).toFixed(1)} mm`;
export const percent = (share: number): string => `${(100 * share).toFixed(share !== 0 && Math.abs(share) < 0.01 ? 2 : 1)} %`;

export function seconds(s: number): string {
  if (s >= 1) return `${s.toFixed(2)} s`;
  if (s >= 1e-3) return `${(s * 1e3).toFixed(s >= 0.1 ? 0 : 2)} ms`;
  return `${(s * 1e6).toFixed(s >= 1e-5 ? 1 : 2)} µs`;
}

export function bytes(n: number): string {
  if (n >= 1e6) return `${(n / 1e6).toFixed(1)} MB`;
  return n >= 1e3 ? `${(n / 1e3).toFixed(0)} kB` : `${n} B`;
}
