// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A world.json that someone opens or drops. What is shown stays until the new one has been read.
import { Fault, parse } from './check';
import { type Page, page_of_world } from './data';
import { by_id } from './dom';
import { clear_messages, tell } from './messages';

const MOST_BYTES = 512e6; // what one string of a browser holds

async function open(file: File, load: (page: Page) => void): Promise<void> {
  try {
    if (file.size > MOST_BYTES) throw new Fault(`${file.name}: ${file.size} bytes are too many for a world.json`);
    const page = page_of_world(parse(await file.text(), file.name), file.name);
    clear_messages();
    load(page);
  } catch (e) {
    tell((e as Error).message);
  }
}

export function bind_files(load: (page: Page) => void): void {
  const input = by_id<HTMLInputElement>('file');
  const ask = () => input.click();
  by_id('open').addEventListener('click', ask);
  by_id('open-empty').addEventListener('click', ask);
  input.addEventListener('change', () => {
    if (input.files?.[0]) void open(input.files[0], load);
    input.value = ''; // so that the same file can be opened again
  });
  window.addEventListener('dragover', (e) => {
    e.preventDefault();
    document.body.classList.add('dropping');
  });
  window.addEventListener('dragleave', (e) => {
    if (!e.relatedTarget) document.body.classList.remove('dropping');
  });
  window.addEventListener('drop', (e) => {
    e.preventDefault();
    document.body.classList.remove('dropping');
    const file = e.dataTransfer?.files[0];
    if (file) void open(file, load);
  });
}
