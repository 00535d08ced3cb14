// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of a world that scanworld has built: it opens by itself, shows everything, and keeps what is shown in its address.
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, LAPTOP, open, picture, read_json, repository, scanworld, start_browser, state, stop_browser, temporary_folder, view, write_json } from './support.mjs';

const folder = temporary_folder();
const built = join(folder, 'office');
const file = join(folder, 'office.html');
let page;

const times = (mean) => ({ cpu: { mean, deviation: mean / 9 }, wall: { mean, deviation: 0 }, ratio: 2, ratio_quartiles: [2, 2] });
const sim_row = (name) => ({
  name, sort: 'world',
  speed: { triangles: 1234, area: 9, solids: 56, memory: 78000, steps: [{ robot: 'cube', robots: 200, time: times(0.0042) }], detection: times(1e-4), contact_test: times(2e-6), sweep: times(1e-6), lidar: times(0.008) },
  robustness: { lost: [{ speed: 5, rate: 60, robots: 200, lost: 3 }], cube: { speed_lost: 0.01, bump: 0 }, doors: { wide: 7, passed: 6, blocked: [2], walls: 300, walls_open: 0 }, floor: { drivable: 99.5, gaps: 4, gap_area: 1 } },
  promises: [{ name: 'gaps in the floor', value: 4, at_most: 0, kept: false }],
});

before(async () => {
  scanworld('build', join(repository, 'data/office.ply'), '-o', built, '--record');
  write_json(join(built, 'sim_check.json'), { program: 'scanworld', engine: 'bullet', rate: 240, rows: [sim_row('a/mesh.ply'), sim_row('a/office')], keeps_promises: false, verdict: 'a promise is broken' });
  view(file, built, join(repository, 'data/office.ply'));
  await start_browser();
  page = await open(file);
});
after(stop_browser);

test('a page opens from disk without an error or a request to any network', async () => {
  await picture(page);
  assert.deepEqual(page.troubles, []);
  assert.deepEqual(page.requests, []);
  assert.equal(await page.locator('.message').count(), 0);
  assert.equal(await page.title(), 'office – scanworld');
});

test('a page with 200,000 points is smaller than 6 MB', () => assert.ok(statSync(file).size < 6e6, `${statSync(file).size} bytes`));

test('layers of a built world and its scan are there, and those that need scanner positions say so', async () => {
  const layers = await page.evaluate(() => window.scanworld.layers());
  const on = Object.keys(layers).filter((name) => layers[name].on);
  assert.deepEqual(on, ['points', 'polygons', 'openings', 'obstacles']);
  for (const name of ['violations', 'leaks']) {
    assert.equal(layers[name].available, false);
    assert.match(await page.locator(`label:has(#layer-${name})`).getAttribute('title'), /needs scanner positions/);
    assert.ok(await page.locator(`#layer-${name}`).isDisabled());
  }
});

test('a link brings back all that was shown', async () => {
  const other = await open(file);
  for (const name of ['rooms', 'colliders']) await other.locator(`#layer-${name}`).check();
  await other.locator('#layer-points').uncheck();
  await other.selectOption('#color-mode', 'kind');
  await other.locator('#both-sides').check();
  await other.selectOption('#section-axis', 'z');
  await other.locator('#section-at').fill('1.5');
  await other.locator('#section-flip').check();
  await other.click('#theme');
  await other.evaluate(() => window.scanworld.select('surface', 3));
  await other.locator('#canvas').focus();
  for (const key of ['ArrowLeft', 'ArrowUp', '+']) await other.keyboard.press(key);
  await other.click('#select-replay');
  await other.evaluate(() => window.scanworld.replay.goTo(5));
  await other.waitForTimeout(400);
  const [hash, shown] = [await other.evaluate(() => location.hash), await state(other)];
  await close(other);
  const again = await open(file, { hash });
  const restored = await state(again);
  assert.equal(shown.step, 5);
  assert.deepEqual(shown.selection, { type: 'surface', id: 3 });
  assert.deepEqual(shown.section, { axis: 'z', at: 1.5, flip: true });
  restored.camera.forEach((v, i) => assert.ok(Math.abs(v - shown.camera[i]) < 2e-3, `camera ${i}: ${v}, not ${shown.camera[i]}`));
  assert.deepEqual({ ...restored, camera: 0, link: 0, layers: restored.layers.sort() }, { ...shown, camera: 0, link: 0, layers: shown.layers.sort() });
  assert.equal(await again.locator('html').getAttribute('data-theme'), 'dark');
  assert.ok(await again.locator('#replay-bar').isVisible());
  await close(again);
});

test('the replay plays to its end by itself and stops there', async () => {
  const replay = read_json(join(built, 'replay.json'));
  const before_replay = await picture(page);
  await page.click('#select-replay');
  await page.selectOption('#replay-speed', '8');
  const first = await page.evaluate(() => ({ ...window.scanworld.replay }));
  assert.equal(first.length, replay.steps.length);
  assert.ok(first.playing && first.step < first.length - 1);
  await page.waitForFunction(() => !window.scanworld.replay.playing, null, { timeout: 20000 });
  const end = await page.evaluate(() => window.scanworld.replay.step);
  assert.equal(end, replay.steps.length - 1);
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => window.scanworld.replay.step), end);
  const last = replay.steps.at(-1);
  assert.match(await page.locator('#replay-text').textContent(), new RegExp(`${last.stage}.*${last.text}`));
  assert.match(await page.locator('#replay-facts').textContent(), new RegExp(`${last.clusters}`));
  assert.notEqual(await picture(page), before_replay);
});

test('the replay steps on and back, shows points or polygons, and each stage once on its strip', async () => {
  const replay = read_json(join(built, 'replay.json'));
  const stages = replay.steps.map((s) => s.stage).filter((s, i, all) => s !== all[i - 1]);
  assert.deepEqual(await page.locator('.segment').allTextContents(), stages);
  await page.evaluate(() => window.scanworld.replay.goTo(10));
  const polygons = await picture(page);
  await page.click('#replay-on');
  await page.click('#replay-back');
  assert.equal(await page.evaluate(() => window.scanworld.replay.step), 10);
  assert.equal(await picture(page), polygons, 'a step on and back gives the same picture');
  await page.selectOption('#replay-mode', 'points');
  assert.notEqual(await picture(page), polygons);
  await page.click('#select-world');
  assert.ok(await page.locator('#replay-bar').isHidden());
});

test('the tabs show what sim_check and build reported', async () => {
  await page.click('#select-sim');
  const sim = await page.locator('#tab-sim').textContent();
  for (const part of ['a promise is broken', '1,234', '4.20 ms', '78 kB', '1.5 %', '6 of 7', 'broken']) assert.ok(sim.includes(part), part);
  await page.click('#select-report');
  const report = read_json(join(built, 'report.json'));
  const text = await page.locator('#tab-report').textContent();
  for (const part of ['390,000', report.world_hash, ...report.stages.map((s) => s.name), ...report.fidelity.criteria.map((c) => c.name)]) assert.ok(text.includes(part), part);
  const widths = await page.locator('.amount').evaluateAll((bars) => bars.map((b) => b.getBoundingClientRect().width));
  const longest = report.stages.findIndex((s) => s.seconds === Math.max(...report.stages.map((t) => t.seconds)));
  assert.equal(widths.indexOf(Math.max(...widths)), longest);
  await page.click('#select-world');
});

test('the picture is saved as a PNG file', async () => {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#picture')]);
  assert.equal(download.suggestedFilename(), 'office.png');
  const bytes = readFileSync(await download.path());
  assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
  assert.ok(bytes.readUInt32BE(16) >= 1000 && bytes.length > 30000, `${bytes.readUInt32BE(16)} pixels wide, ${bytes.length} bytes`);
  assert.deepEqual(page.troubles, []);
});
