// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers, picking, views and tools, on the drawn office with a virtual scan from known places: what is right is known.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, LAPTOP, office, open, patch, picture, project, scanworld, start_browser, state, stop_browser, temporary_folder, view, write_json } from './support.mjs';

const folder = temporary_folder();
const world = office();
let page;

/** The office with a wall that is not there, without one that is, a kerb around it, and with a collider: every layer has something to show. */
function flawed_office() {
  const flawed = office();
  for (const [x, turn] of [[3, -1], [3.1, 1]]) {
    const corners = [[x, 0.3, 0.2], [x, 1.7, 0.2], [x, 1.7, 1.8], [x, 0.3, 1.8]];
    flawed.vertices.push(...(turn > 0 ? corners : corners.reverse()));
    const begin = flawed.vertices.length - 4;
    flawed.surfaces.push({ id: 9000 + turn, kind: 'other', source: 'measured', plane: { normal: [turn, 0, 0], offset: -turn * x }, outer: [0, 1, 2, 3].map((i) => begin + i), holes: [], support: { points: 10, rms: 0.001, coverage: 0.5 } });
  }
  const kerb = (r) => [[-r, -r], [r, -r], [r, r], [-r, r]].map(([x, y]) => flawed.vertices.push([x, y, -0.5]) - 1);
  flawed.surfaces.push({ id: 9002, kind: 'floor', source: 'measured', plane: { normal: [0, 0, 1], offset: 0.5 }, outer: kerb(30), holes: [kerb(29.9).reverse()], support: { points: 10, rms: 0.001, coverage: 0.5 } });
  const kept = new Set(flawed.openings.map((o) => o.surface));
  const gone = flawed.surfaces.find((s) => s.kind === 'wall' && s.outer.length === 4 && !kept.has(s.id) && area(flawed, s) > 5);
  flawed.surfaces = flawed.surfaces.filter((s) => s !== gone);
  for (const room of flawed.rooms) room.surfaces = room.surfaces.filter((s) => s !== gone.id);
  flawed.colliders.push({ surface: 0, box: { center: [4.8, -0.05, 1.25], size: [9, 0.1, 2.5], rotation: [0, 0, 0, 1] } });
  return flawed;
}

const minus = (a, b) => a.map((v, k) => v - b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const loop_of = (w, s) => s.outer.map((v) => w.vertices[v]);
function area(w, s) {
  const loop = loop_of(w, s);
  const sides = [minus(loop[1], loop[0]), minus(loop[2], loop[1])];
  return Math.sqrt(dot(sides[0], sides[0]) * dot(sides[1], sides[1]));
}

/** Whether a place in a polygon's plane is inside: counted along the axis that the normal is least like. */
function inside(w, surface, at) {
  const n = surface.plane.normal.map(Math.abs);
  const [u, v] = [0, 1, 2].filter((k) => k !== n.indexOf(Math.max(...n)));
  let odd = false;
  for (const loop of [surface.outer, ...surface.holes].map((l) => l.map((i) => w.vertices[i])))
    loop.forEach((a, i) => {
      const b = loop[(i + 1) % loop.length];
      if (a[v] > at[v] !== b[v] > at[v] && at[u] < a[u] + ((at[v] - a[v]) / (b[v] - a[v])) * (b[u] - a[u])) odd = !odd;
    });
  return odd;
}

/** The surface that one sees from an eye in the direction of a place: the nearest one whose free side faces the eye. */
function seen(w, eye, toward) {
  const ray = minus(toward, eye);
  let best = [Infinity, null];
  for (const s of w.surfaces) {
    const slope = dot(s.plane.normal, ray);
    const t = -(dot(s.plane.normal, eye) + s.plane.offset) / slope;
    if (slope >= 0 || t <= 0 || t >= best[0]) continue;
    if (inside(w, s, eye.map((v, k) => v + t * ray[k]))) best = [t, s.id];
  }
  return best[1];
}

before(async () => {
  const [scan, poses] = [join(folder, 'scan.ply'), join(folder, 'poses.txt')];
  write_json(join(folder, 'truth/world.json'), world);
  write_json(join(folder, 'flawed/world.json'), flawed_office());
  scanworld('scan', join(folder, 'truth'), '-o', scan, '--save-poses', poses, '--points', '60000');
  view(join(folder, 'flawed.html'), join(folder, 'flawed'), scan, '--poses', poses);
  view(join(folder, 'truth.html'), join(folder, 'truth'));
  await start_browser();
  page = await open(join(folder, 'truth.html'));
});
after(stop_browser);

test('every layer shows something that was not in the picture before', async () => {
  const flawed = await open(join(folder, 'flawed.html'));
  const layers = await flawed.evaluate(() => window.scanworld.layers());
  assert.deepEqual(Object.keys(layers).filter((name) => !layers[name].available), []);
  for (const name of Object.keys(layers)) await flawed.locator(`#layer-${name}`).uncheck();
  const nothing = await picture(flawed);
  const pictures = new Set([nothing]);
  for (const name of Object.keys(layers)) {
    await flawed.locator(`#layer-${name}`).check();
    pictures.add(await picture(flawed));
    await flawed.locator(`#layer-${name}`).uncheck();
  }
  assert.equal(await picture(flawed), nothing, 'what is switched off is gone');
  assert.equal(pictures.size, Object.keys(layers).length + 1);
  assert.deepEqual(flawed.troubles, []);
  await close(flawed);
});

test('the error atlas has a legend in millimetres', async () => {
  const flawed = await open(join(folder, 'flawed.html'));
  assert.ok(await flawed.locator('#legend').isHidden());
  await flawed.keyboard.press('8');
  const tolerance = await flawed.evaluate(() => JSON.parse(document.getElementById('scanworld-data').textContent).scan.tolerance);
  assert.match(await flawed.locator('#legend').textContent(), new RegExp(`mm.*${(1000 * tolerance).toFixed(1)}.*unexplained`, 's'));
  await close(flawed);
});

test('rooms are named with their area', async () => {
  await page.locator('#layer-rooms').check();
  await page.evaluate(() => window.scanworld.setView('top'));
  await picture(page);
  const labels = await page.locator('.label.room').allTextContents();
  assert.deepEqual(labels.sort(), world.rooms.map((r) => `${r.name}\n${r.area.toFixed(1)} m²`).sort());
  await page.evaluate(() => window.scanworld.setView('iso'));
});

test('each room has a tint of its own on the floor that they share', async () => {
  await page.evaluate(() => window.scanworld.setView('top'));
  const floor = world.surfaces.find((s) => s.kind === 'floor' && s.plane.offset === 0).id;
  const places = [];
  for (const { center } of world.rooms) {
    // Beside the name, and not where something stands.
    const beside = [[0.8, 0.7], [-0.8, 0.7], [0.8, -0.7], [-0.8, -0.7]].map(([x, y]) => [center[0] + x, center[1] + y, center[2]]);
    for (const place of beside) if ((await page.evaluate((p) => window.scanworld.pick(...window.scanworld.project(p)).id, place)) === floor) places[world.rooms.findIndex((r) => r.center === center)] ??= place;
  }
  assert.equal(places.filter(Boolean).length, world.rooms.length);
  const tints = [];
  for (const place of places) tints.push(await patch(page, place));
  assert.equal(new Set(tints).size, world.rooms.length);
  await page.locator('#layer-rooms').uncheck();
  const bare = [];
  for (const place of places) bare.push(await patch(page, place));
  assert.equal(new Set(bare).size, 1);
  await page.evaluate(() => window.scanworld.setView('iso'));
});

test('a click picks the surface that is seen there', async () => {
  for (const layer of ['openings', 'obstacles']) await page.locator(`#layer-${layer}`).uncheck();
  await picture(page);
  const eye = (await state(page)).camera.slice(0, 3);
  const picked = [];
  for (const s of world.surfaces) {
    const loop = loop_of(world, s);
    const at = [0, 1, 2].map((k) => loop.reduce((sum, p) => sum + p[k], 0) / loop.length);
    if (picked.length >= 12 || area(world, s) < 1 || !inside(world, s, at) || seen(world, eye, at) !== s.id) continue;
    await page.mouse.click(...(await project(page, at)));
    assert.equal(await page.locator('#selection-title').textContent(), `Surface ${s.id}`);
    assert.ok((await page.locator('#selection-facts').textContent()).includes(s.kind));
    picked.push(s.id);
  }
  assert.ok(picked.length >= 6, `${picked.length} surfaces were seen`);
  await page.keyboard.press('Escape');
  assert.ok(await page.locator('#selection').isHidden());
});

test('from above one sees the floors through the ceilings, and with both sides the ceilings', async () => {
  await page.evaluate(() => window.scanworld.setView('top'));
  const kind_at = async () => {
    await page.mouse.click(...(await project(page, [2, 0.5, 0])));
    return page.locator('#selection-facts dd').first().textContent();
  };
  const looks = async () => {
    await page.keyboard.press('Escape');
    return patch(page, [2, 0.5, 0]);
  };
  assert.equal(await kind_at(), 'floor');
  const floor = await looks();
  await page.keyboard.press('b');
  assert.equal(await kind_at(), 'ceiling');
  assert.notEqual(await looks(), floor);
  await page.keyboard.press('b');
});

test('openings and obstacles are picked too, dragging picks nothing', async () => {
  for (const layer of ['openings', 'obstacles']) await page.locator(`#layer-${layer}`).check();
  const pillar = world.obstacles.find((o) => o.cylinder);
  const at = await project(page, pillar.cylinder.center);
  await page.mouse.move(...at);
  await page.mouse.down();
  await page.mouse.move(at[0] + 30, at[1] + 20);
  await page.mouse.move(...at);
  await page.mouse.move(at[0] + 40, at[1]);
  await page.mouse.up();
  assert.ok(await page.locator('#selection').isHidden());
  await page.evaluate(() => window.scanworld.setView('top'));
  await page.mouse.click(...(await project(page, pillar.cylinder.center)));
  assert.equal(await page.locator('#selection-title').textContent(), `Obstacle ${pillar.id}`);
  await page.evaluate(() => window.scanworld.setView('front'));
  const found = await page.evaluate((w) => w.openings.map((o) => {
    const loop = o.loop.map((v) => w.vertices[v]);
    const p = window.scanworld.project([0, 1, 2].map((k) => loop.reduce((s, q) => s + q[k], 0) / loop.length));
    return { id: o.id, p, hit: window.scanworld.pick(...p) };
  }).find(({ id, hit }) => hit?.type === 'opening' && hit.id === id), world);
  assert.ok(found, 'an opening is seen from the front');
  await page.mouse.click(...found.p);
  const opening = world.openings.find((o) => o.id === found.id);
  assert.equal(await page.locator('#selection-title').textContent(), `Opening ${found.id}`);
  assert.ok((await page.locator('#selection-facts').textContent()).includes(`${opening.width.toFixed(3)} m`));
  await page.keyboard.press('Escape');
});

test('the scale bar of the view from above is true', async () => {
  for (const zoom of [0, 3, -5]) {
    await page.evaluate(() => window.scanworld.setView('top'));
    for (let i = 0; i < Math.abs(zoom); ++i) await page.keyboard.press(zoom > 0 ? '+' : '-');
    await picture(page);
    const [a, b, c] = [await project(page, [4, 1, 0]), await project(page, [5, 1, 0]), await project(page, [4, 2, 1.5])];
    const metre = Math.hypot(b[0] - a[0], b[1] - a[1]);
    assert.ok(Math.abs(Math.hypot(c[0] - a[0], c[1] - a[1]) - metre) < 0.01, 'heights do not shift the plan');
    const bar = await page.locator('#scale-bar').evaluate((e) => ({ width: e.getBoundingClientRect().width, metres: Number(e.dataset.metres) }));
    assert.ok(Math.abs(bar.width - bar.metres * metre) < 0.5, `${bar.width} px for ${bar.metres} m, a metre has ${metre} px`);
    assert.match(await page.locator('#scale-text').textContent(), new RegExp(`^${bar.metres >= 1 ? `${bar.metres} m` : `${bar.metres * 100} cm`}$`));
  }
  await page.evaluate(() => window.scanworld.setView('iso'));
  await picture(page);
  assert.ok(await page.locator('#scale').isHidden());
});

test('the tape tells the distance between two corners to the millimetre', async () => {
  await page.evaluate(() => window.scanworld.setView('top'));
  const [a, c] = [[0, -4.65, 0], [9.6, 6.2, 0]]; // corners of two rooms
  for (const corner of [a, c]) assert.ok(world.vertices.some((v) => v.every((x, k) => x === corner[k])));
  const middle = [(a[0] + c[0]) / 2, (a[1] + c[1]) / 2, a[2]];
  await page.click('#measure');
  for (const [corner, pixels] of [[a, 3], [c, -3]]) {
    const [from, to] = [await project(page, corner), await project(page, middle)];
    const far = Math.hypot(to[0] - from[0], to[1] - from[1]);
    await page.mouse.click(from[0] + (pixels * (to[0] - from[0])) / far, from[1] + (pixels * (to[1] - from[1])) / far); // just inside, just outside
  }
  const [dx, dy] = minus(c, a);
  const text = await page.locator('#tape-list li').first().textContent();
  const number = (v) => v.toFixed(3).replace('-', '−');
  assert.equal(text, `${Math.hypot(dx, dy).toFixed(3)} mdx ${number(dx)}  dy ${number(dy)}  dz 0.000`);
  assert.equal(await page.locator('.label.distance').count(), 1);
  await page.click('#tape-clear');
  assert.equal(await page.locator('#tape-list li').count(), 0);
  await page.keyboard.press('Escape');
  assert.ok(await page.locator('#tape').isHidden());
});

test('a section cuts away what is above or below it', async () => {
  await page.evaluate(() => window.scanworld.setView('iso'));
  const whole = await picture(page);
  await page.selectOption('#section-axis', 'z');
  await page.locator('#section-at').fill('1');
  const below = await picture(page);
  assert.notEqual(below, whole);
  await page.locator('#section-flip').check();
  const above = await picture(page);
  assert.notEqual(above, below);
  await page.evaluate(() => window.scanworld.setView('top'));
  assert.equal(await page.evaluate((p) => window.scanworld.pick(...p), await project(page, [2, 0.5, 0])), null, 'the floor is cut away');
  await page.locator('#section-flip').uncheck();
  assert.equal((await page.evaluate((p) => window.scanworld.pick(...p), await project(page, [2, 0.5, 0]))).type, 'surface');
  await page.selectOption('#section-axis', 'off');
  await page.evaluate(() => window.scanworld.setView('iso'));
  assert.equal(await picture(page), whole);
});

test('walking goes ahead at the height of a robot and ends with Esc', async () => {
  await page.keyboard.press('g');
  const start = (await state(page)).camera;
  assert.equal(start[2], 0.6);
  await page.keyboard.down('w');
  await page.waitForTimeout(400);
  await page.keyboard.up('w');
  const end = (await state(page)).camera;
  const [dx, dy] = minus(end, start);
  assert.ok(Math.hypot(dx, dy) > 0.2 && dx * Math.cos(start[3]) + dy * Math.sin(start[3]) > 0.2, `${start} to ${end}`);
  await page.locator('#walk-height').fill('1.2');
  assert.ok(Math.abs((await state(page)).camera[2] - 1.2) < 1e-6);
  await page.locator('#canvas').focus();
  await page.keyboard.press('Escape');
  assert.equal((await state(page)).view, 'orbit');
});

test('one walks on the floor with the largest area, not on a kerb around it', async () => {
  const flawed = await open(join(folder, 'flawed.html'));
  await flawed.keyboard.press('g');
  assert.equal((await state(flawed)).camera[2], 0.6);
  await close(flawed);
});

test('a link to a walk and to a view from above bring these back', async () => {
  for (const name of ['walk', 'top']) {
    const other = await open(join(folder, 'truth.html'));
    await other.evaluate((n) => window.scanworld.setView(n), name);
    await other.waitForTimeout(400);
    const [hash, shown] = [await other.evaluate(() => location.hash), await state(other)];
    await close(other);
    const again = await open(join(folder, 'truth.html'), { hash });
    const restored = await state(again);
    assert.equal(restored.view, name);
    restored.camera.forEach((v, i) => assert.ok(Math.abs(v - shown.camera[i]) < 1e-3, `${name}: ${restored.camera}, not ${shown.camera}`));
    await close(again);
  }
});

test('the theme follows the system until it is chosen', async () => {
  const dark = await open(join(folder, 'truth.html'), { scheme: 'dark' });
  const paper = () => dark.evaluate(() => getComputedStyle(document.querySelector('aside')).backgroundColor);
  assert.equal(await dark.locator('html').getAttribute('data-theme'), 'dark');
  const [dark_paper, dark_picture] = [await paper(), await picture(dark)];
  await dark.keyboard.press('n');
  assert.equal(await dark.locator('html').getAttribute('data-theme'), 'light');
  assert.notEqual(await paper(), dark_paper);
  assert.notEqual(await picture(dark), dark_picture);
  await close(dark);
});

test('every control is reached by Tab with a visible focus, and keys do what the list of shortcuts says', async () => {
  const ids = await page.evaluate(() => [...document.querySelectorAll('button, input, select, canvas')].filter((e) => e.checkVisibility() && !e.disabled && e.tabIndex >= 0).map((e) => e.id || e.textContent));
  const reached = new Set();
  await page.evaluate(() => document.activeElement.blur());
  for (let i = 0; i < ids.length + 3; ++i) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => ({ id: document.activeElement.id || document.activeElement.textContent, outline: getComputedStyle(document.activeElement).outlineStyle }));
    if (ids.includes(at.id)) assert.equal(at.outline, 'solid', at.id);
    reached.add(at.id);
  }
  assert.deepEqual(ids.filter((id) => !reached.has(id)), []);
  await page.locator('#canvas').focus();
  await page.keyboard.press('?');
  assert.ok(await page.locator('#shortcuts').isVisible());
  await page.keyboard.press('Escape');
  assert.ok(await page.locator('#shortcuts').isHidden());
  const before_key = await page.evaluate(() => window.scanworld.layers().triangles.on);
  await page.keyboard.press('3');
  assert.equal(await page.evaluate(() => window.scanworld.layers().triangles.on), !before_key);
  await page.keyboard.press('3');
});

test('nothing overlaps on a small laptop, and no text is smaller than 12 pixels', async () => {
  const flawed = await open(join(folder, 'flawed.html'), { size: LAPTOP });
  for (const key of ['7', '8', 't']) await flawed.keyboard.press(key);
  await picture(flawed);
  const boxes = await flawed.evaluate(() => ['header', '#stage', 'aside'].map((s) => document.querySelector(s).getBoundingClientRect().toJSON()));
  for (const [a, b] of [[0, 1], [0, 2], [1, 2]]) assert.ok(boxes[a].right <= boxes[b].left + 0.5 || boxes[a].bottom <= boxes[b].top + 0.5, `${a} and ${b}`);
  const small = await flawed.evaluate(() => [...document.querySelectorAll('body *')].filter((e) => e.checkVisibility() && e.textContent && parseFloat(getComputedStyle(e).fontSize) < 12).map((e) => e.outerHTML.slice(0, 80)));
  assert.deepEqual(small, []);
  assert.equal(await flawed.evaluate(() => document.documentElement.scrollWidth), 1366);
  await close(flawed);
});
