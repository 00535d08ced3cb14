// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The pictures of the page in docs/, made of what `scanworld` writes now:
//     node tests/browser/pictures.mjs docs/pictures [SCAN_OF_A_ROOM SCAN_OF_A_HALL]
import { join, resolve } from 'node:path';
import { close, open, picture, repository, scanworld, start_browser, stop_browser, temporary_folder, view } from './support.mjs';

const [out, room, hall] = process.argv.slice(2).map((path) => resolve(path));
const folder = temporary_folder();

/** A page of a scan: what is set on it, and the picture of the whole of it. */
async function take(name, scan, scheme, set) {
  const world = join(folder, name);
  scanworld('build', scan, '-o', world, '--record');
  const page = await open(view(join(folder, `${name}.html`), world, scan), { scheme, size: [1366, 768] });
  await set(page);
  await picture(page);
  await page.screenshot({ path: join(out, `page_${name}.png`) });
  await close(page);
}

const layers = (on) => (page) =>
  page.evaluate((names) => {
    for (const name of Object.keys(window.scanworld.layers())) window.scanworld.setLayer(name, names.includes(name));
  }, on);

await start_browser();
const office = join(repository, 'data/office.ply');
await take('office', office, 'light', layers(['polygons', 'openings', 'obstacles', 'rooms']));
await take('replay', office, 'light', async (page) => {
  await page.click('#select-replay');
  await page.evaluate(() => window.scanworld.replay.goTo(8));
});
if (room) await take('room', room, 'light', layers(['polygons', 'openings', 'obstacles', 'points']));
if (hall) await take('hall', hall, 'dark', layers(['atlas', 'triangles']));
await stop_browser();
