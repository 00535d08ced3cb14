// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Broken, foreign and hostile data: a page says what is wrong and where, never goes blank, and runs nothing.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, empty_page, office, open, picture, start_browser, stop_browser, temporary_folder, view, with_data, write_json } from './support.mjs';

const folder = temporary_folder();
const HOSTILE = '<img src=x onerror="window.hacked=1">';

before(start_browser);
after(stop_browser);

const changed = (change) => {
  const world = office();
  change(world);
  return world;
};

const WORLDS = [
  ['a vertex that does not exist', changed((w) => (w.surfaces[3].outer[2] = 999)), 'surfaces[3].outer[2] is 999: there are 296 vertices'],
  ['no schema', changed((w) => delete w.schema), "this is not a world: it has no key 'schema'"],
  ['another version', changed((w) => (w.schema.version = 7)), 'version 7: this page shows version 2'],
  ['another schema', { schema: { name: 'scanworld-report', version: 1 } }, 'this is not a world: its schema is "scanworld-report", not "scanworld"'],
  ['a list', [1, 2, 3], 'this is not a world: it is not a JSON object'],
  ['a vertex of two numbers', changed((w) => (w.vertices[5] = [1, 2])), 'vertices[5] is [1,2]: it should be 3 numbers'],
  ['text for a number', changed((w) => (w.vertices[5][1] = 'high')), 'vertices[5][1] is "high": it should be a finite number'],
  ['an unknown kind', changed((w) => (w.surfaces[1].kind = 'roof')), 'surfaces[1].kind is "roof": it should be one of floor, ceiling, wall, other'],
  ['an id twice', changed((w) => (w.surfaces[4].id = w.surfaces[2].id)), 'surfaces[4].id is 2: surfaces[2] has this id already'],
  ['an opening in no surface', changed((w) => (w.openings[0].surface = 4242)), 'openings[0].surface is 4242: there is none of surfaces with this id'],
  ['a solid of no form', changed((w) => (w.obstacles[1] = { id: 1 })), 'a solid is a box, a hull, a cylinder or a prism'],
  ['a normal of length 2', changed((w) => (w.surfaces[0].plane.normal = [0, 2, 0])), 'surfaces[0].plane.normal is [0,2,0]: it should have length 1'],
  ['no surfaces at all', changed((w) => delete w.surfaces), 'surfaces is missing: it should be a list'],
];

const in_page = (world) => JSON.stringify({ schema: { name: 'scanworld-page', version: 1 }, title: 'x', world }).replaceAll('<', '\\u003c');

async function embed(text) {
  const file = join(folder, 'embedded.html');
  writeFileSync(file, with_data(text));
  return open(file);
}

async function drop(page, name, text) {
  await page.evaluate(([n, t]) => {
    const data = new DataTransfer();
    data.items.add(new File([t], n));
    window.dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
  }, [name, text]);
}

for (const [what, world, message] of WORLDS)
  test(`a page with a world with ${what} says so`, async () => {
    const page = await embed(in_page(world));
    const text = await page.locator('.message span').first().textContent();
    assert.equal(text.startsWith('world.json: '), true, text);
    assert.ok(text.includes(message), text);
    assert.deepEqual(page.troubles, []);
    assert.ok(await page.locator('#empty').isVisible());
    await close(page);
  });

test('a page whose data is no JSON, or of another version, says so', async () => {
  for (const [text, message] of [['{"schema":', 'the data of the page: this is not JSON'], ['{"schema":{"name":"scanworld-page","version":2}}', 'the data of the page: version 2: this page shows version 1'], ['7', 'the data of the page: this is not the data of a page']]) {
    const page = await embed(text);
    assert.ok((await page.locator('.message').first().textContent()).includes(message), await page.locator('.message').first().textContent());
    await close(page);
  }
});

test('a broken part beside the world is left out and told, the world is shown', async () => {
  const data = { schema: { name: 'scanworld-page', version: 1 }, title: 'x', world: office(), replay: { schema: { name: 'scanworld-replay', version: 1 }, method: 'rival', points: { count: -3 } }, sim: { rows: 5 }, scan: { positions: '!' }, report: [] };
  const page = await embed(JSON.stringify(data));
  const messages = (await page.locator('.message span').allTextContents()).join('\n');
  for (const part of ['replay.points.count is -3', 'sim.rows is 5', 'scan.positions is "!": it should be base64', 'report']) assert.ok(messages.includes(part), messages);
  assert.ok(await page.locator('#layer-polygons').isChecked());
  assert.deepEqual(await page.locator('#tabs button').allTextContents(), ['World']);
  assert.deepEqual(page.troubles, []);
  await close(page);
});

test('a world.json that is dropped or opened is shown, a bad one leaves what was shown and says why', async () => {
  const page = await open(empty_page);
  assert.ok(await page.locator('#empty').isVisible());
  const nothing = await picture(page);
  await drop(page, 'office.json', JSON.stringify(office()));
  await page.waitForFunction(() => document.title.startsWith('office.json'));
  const shown = await picture(page);
  assert.notEqual(shown, nothing);
  assert.ok(await page.locator('#empty').isHidden());
  for (const [name, text, message] of [['bad.json', JSON.stringify(WORLDS[0][1]), 'bad.json: surfaces[3].outer[2] is 999: there are 296 vertices'], ['photo.jpg', '\u00ff\u00d8', 'photo.jpg: this is not JSON']]) {
    await drop(page, name, text);
    await page.locator('.message', { hasText: message }).waitFor();
    await page.locator('.message button').click();
    assert.equal(await picture(page), shown);
    assert.match(await page.title(), /^office\.json/);
  }
  const small = write_json(join(folder, 'small.json'), changed((w) => Object.assign(w, { surfaces: w.surfaces.slice(0, 1), openings: [], doors: [], rooms: [], obstacles: [], colliders: [] })));
  await page.locator('#file').setInputFiles(small);
  await page.waitForFunction(() => document.title.startsWith('small.json'));
  assert.equal(await page.locator('label:has(#layer-rooms)').getAttribute('title'), 'the world has no rooms');
  assert.notEqual(await picture(page), shown);
  assert.deepEqual(page.troubles, []);
  await close(page);
});

test('names with markup in them are shown as text and run nothing', async () => {
  const world = changed((w) => {
    for (const room of w.rooms) room.name = HOSTILE;
    for (const opening of w.openings) opening.evidence = HOSTILE;
    w.provenance.program = HOSTILE;
    w.provenance.inputs = [{ file: HOSTILE, points: 3, fingerprint: '</script><script>window.hacked=1</script>' }];
  });
  const hostile = join(folder, HOSTILE);
  write_json(join(hostile, 'world.json'), world);
  const row = { name: HOSTILE, sort: 'world', speed: { triangles: 1, solids: 1, memory: 1, steps: [] }, promises: [{ name: HOSTILE, kept: true }] };
  write_json(join(hostile, 'sim_check.json'), { engine: HOSTILE, rate: 240, rows: [row], keeps_promises: true, verdict: HOSTILE });
  const page = await open(view(join(folder, 'hostile.html'), hostile));
  for (const key of ['7', 't']) await page.keyboard.press(key);
  await picture(page);
  assert.ok(HOSTILE.startsWith(await page.locator('#title').textContent())); // a file's ending is cut off
  assert.ok((await page.locator('.label.room').first().textContent()).startsWith(HOSTILE));
  await page.evaluate((id) => window.scanworld.select('opening', id), world.openings[0].id);
  assert.ok((await page.locator('#selection-facts').textContent()).includes(HOSTILE));
  assert.ok((await page.locator('#world-facts').textContent()).includes(HOSTILE));
  assert.equal(await page.locator('#tab-sim .verdict').textContent(), HOSTILE);
  await drop(page, `${HOSTILE}.json`, HOSTILE);
  await page.locator('.message', { hasText: HOSTILE }).waitFor();
  assert.equal(await page.locator('img').count(), 0);
  assert.equal(await page.evaluate(() => window.hacked), undefined);
  assert.deepEqual([page.troubles, page.requests], [[], []]);
  await close(page);
});

test('the page lets no markup in even where a text would become some', async () => {
  const page = await open(empty_page);
  const refused = await page.evaluate((html) => {
    try {
      document.getElementById('title').innerHTML = html;
    } catch (e) {
      return e.name;
    }
    return 'taken';
  }, HOSTILE);
  assert.equal(refused, 'TypeError');
  await close(page);
});

test('a browser without WebGL is told so', async () => {
  const page = await open(empty_page, { script: 'HTMLCanvasElement.prototype.getContext = () => null;' });
  assert.match(await page.locator('.message').textContent(), /This browser shows no 3D: WebGL is missing or switched off/);
  await close(page);
});

test('an unexpected error shows on the page', async () => {
  const page = await open(empty_page);
  await page.evaluate(() => void setTimeout(() => { throw new Error('a test'); }));
  await page.locator('.message', { hasText: 'Something went wrong in this page: Uncaught Error: a test' }).waitFor();
  await close(page);
});
