// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What went wrong, said on the page itself.
import { by_id, element } from './dom';

export function tell(text: string, sort: 'error' | 'note' = 'error'): void {
  const list = by_id('messages');
  if ([...list.children].some((m) => m.firstElementChild?.textContent === text)) return;
  const close = element('button', { 'aria-label': 'Close this message' }, '×');
  const message = element('div', { class: `message ${sort}`, role: 'alert' }, element('span', {}, text), close);
  close.addEventListener('click', () => message.remove());
  list.append(message);
  if (sort === 'note') setTimeout(() => message.remove(), 4000);
}

export function clear_messages(): void {
  by_id('messages').replaceChildren();
}

/** From here on nothing fails silently. */
export function catch_all(): void {
  window.addEventListener('error', (e) => tell(`Something went wrong in this page: ${e.message}`));
  window.addEventListener('unhandledrejection', (e) => tell(`Something went wrong in this page: ${e.reason instanceof Error ? e.reason.message : String(e.reason)}`));
}
