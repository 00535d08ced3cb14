// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// How fast a page is on this machine, in a browser that draws in software:
//   node bench/page_speed.mjs PAGE.html      after ./dev test, which installs what it needs
// prints the milliseconds until it can be used, and the frames a second in which it turns (medians of five).
import { resolve } from 'node:path';
import { close, LAPTOP, open, start_browser, stop_browser } from '../tests/browser/support.mjs';

const RUNS = 5;
const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

const file = process.argv[2];
if (!file) {
  console.error('usage: node bench/page_speed.mjs PAGE.html');
  process.exit(2);
}
await start_browser();
const [usable, rates] = [[], []];
for (let i = 0; i < RUNS; ++i) {
  const begin = Date.now();
  const page = await open(resolve(file), { size: LAPTOP });
  await page.evaluate(() => window.scanworld.setLayer('rooms', true));
  usable.push(Date.now() - begin);
  rates.push(await page.evaluate(() => window.scanworld.benchmark(60)));
  await close(page);
}
await stop_browser();
console.log(`usable after ${median(usable)} ms, turns at ${median(rates).toFixed(1)} frames a second`);
