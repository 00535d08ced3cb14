// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A large world in a browser that draws in software, on whatever machine this is.
import assert from 'node:assert/strict';
import { statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, LAPTOP, open, start_browser, stop_browser, temporary_folder, view, write_json } from './support.mjs';

const ROOMS = 10; // along each side: 600 surfaces
const SIZE = [4, 3, 2.5];
const POINTS = 2_000_000;
const folder = temporary_folder();

// Each face of a box by its axis and side, looking inwards; its corners as choices of the low and high side of x, y, z.
const FACES = [0, 1, 2].flatMap((axis) => [0, 1].map((side) => {
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const turn = [[0, 0], [1, 0], [1, 1], [0, 1]];
  return { axis, side, corners: (side ? turn.reverse() : turn).map(([a, b]) => { const c = [0, 0, 0]; c[axis] = side; c[u] = a; c[v] = b; return c; }) };
}));

const low = (room) => [4.2 * (room % ROOMS), 3.2 * Math.floor(room / ROOMS), 0];

function many_rooms() {
  const [vertices, surfaces] = [[], []];
  for (let room = 0; room < ROOMS * ROOMS; ++room)
    for (const { axis, side, corners } of FACES) {
      const at = low(room);
      const outer = corners.map((c) => vertices.push(c.map((k, i) => at[i] + k * SIZE[i])) - 1);
      const normal = [0, 0, 0];
      normal[axis] = side ? -1 : 1;
      surfaces.push({ id: surfaces.length, kind: axis < 2 ? 'wall' : side ? 'ceiling' : 'floor', source: 'measured', plane: { normal, offset: -normal[axis] * (at[axis] + side * SIZE[axis]) || 0 }, outer, holes: [], support: { points: 3333, rms: 0.005, coverage: 1 } });
    }
  return { schema: { name: 'scanworld', version: 1 }, frame: { origin: [0, 0, 0], up: [0, 0, 1], unit: 'm', assumed: [] }, vertices, surfaces, openings: [], obstacles: [], colliders: [], rooms: [], doors: [], provenance: { program: 'a test', inputs: [], options: {} } };
}

function write_scan(file) {
  let state = 1;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const head = Buffer.from(`ply\nformat binary_little_endian 1.0\nelement vertex ${POINTS}\nproperty float x\nproperty float y\nproperty float z\nend_header\n`);
  const points = new Float32Array(3 * POINTS);
  for (let i = 0; i < POINTS; ++i) {
    const at = low(Math.floor(random() * ROOMS * ROOMS));
    const { axis, side } = FACES[Math.floor(random() * 6)];
    for (let k = 0; k < 3; ++k) points[3 * i + k] = at[k] + (k === axis ? side : random()) * SIZE[k] + (random() - 0.5) * 0.01;
  }
  writeFileSync(file, Buffer.concat([head, Buffer.from(points.buffer)]));
  return file;
}

before(start_browser);
after(stop_browser);

test('a world of 600 surfaces with 200,000 of 2,000,000 points turns with fewer points, and all are back at rest', async () => {
  write_json(join(folder, 'rooms/world.json'), many_rooms());
  const file = view(join(folder, 'rooms.html'), join(folder, 'rooms'), write_scan(join(folder, 'scan.ply')));
  assert.ok(statSync(file).size < 6e6);
  const page = await open(file, { size: LAPTOP });
  const rest = await page.evaluate(() => window.scanworld.rest().then(() => window.scanworld.drawn()));
  assert.ok(rest.points > 180_000 && rest.points <= 200_000 * 1.02, `${rest.points} points at rest`);
  const rate = await page.evaluate(() => window.scanworld.benchmark(60));
  const moving = await page.evaluate(() => window.scanworld.drawn());
  console.log(`# ${rate.toFixed(1)} frames a second, ${moving.width} x ${moving.height} pixels, ${Math.round(moving.points)} points in motion`);
  const again = await page.evaluate(() => window.scanworld.rest().then(() => window.scanworld.drawn()));
  assert.equal(again.points, rest.points, 'all points are back at rest');
  assert.deepEqual(page.troubles, []);
  await close(page);
});

test('nothing is drawn while nothing changes', async () => {
  const page = await open(join(folder, 'rooms.html'));
  await page.evaluate(() => window.scanworld.rest());
  const frames = await page.evaluate(async () => {
    let asked = 0;
    const real = window.requestAnimationFrame;
    window.requestAnimationFrame = (f) => (++asked, real(f));
    await new Promise((done) => setTimeout(done, 500));
    return asked;
  });
  assert.equal(frames, 0);
  await close(page);
});
