// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// node mujoco_consumer.mjs WORLD.xml ORDERS: an MJCF file in MuJoCo 3; orders and answers are those of tests/consumers/consumer.h.
import { readFile } from 'node:fs/promises';
import load_mujoco from 'mujoco-js';

const [world, orders] = await Promise.all(process.argv.slice(2, 4).map((f) => readFile(f, 'utf8')));
const mujoco = await load_mujoco();
mujoco.FS.mkdir('/world');

function load(xml) {
  mujoco.FS.writeFile('/world/world.xml', xml);
  const model = mujoco.MjModel.loadFromXML('/world/world.xml');
  const data = new mujoco.MjData(model);
  mujoco.mj_forward(model, data);
  return [model, data];
}
const [model, data] = load(world);

function names() {
  const all = [];
  for (let i = 0; i < model.ngeom; ++i) if (model.geom_contype[i]) all.push(mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM.value, i));
  return all;
}

const ray = (v, groups) => mujoco.mj_ray(model, data, v.slice(0, 3), v.slice(3, 6), groups, 1, -1, new Int32Array(1));

function drop(radius, seconds, places) {
  const balls = places.map((p) => `<body pos="${p.join(' ')}"><freejoint/><geom type="sphere" condim="6" friction="1 0.005 0.01" mass="1" size="${radius}"/></body>`);
  const [more, state] = load(world.replace('</worldbody>', balls.join('') + '</worldbody>'));
  while (state.time < seconds) mujoco.mj_step(more, state);
  return places.map((_, i) => Array.from(state.qpos.slice(7 * i, 7 * i + 3)).join(' ')).join('  ');
}

for (const line of orders.trim().split('\n')) {
  const [order, ...rest] = line.trim().split(/\s+/);
  const values = rest.map(Number);
  if (order === 'names') console.log(names().join(' ') + ' ');
  else if (order === 'gravity') console.log(Array.from(model.opt.gravity).join(' '));
  else if (order === 'ray') console.log(ray(values, [1, 0, 1, 0, 0, 0]));
  else if (order === 'probe') console.log(ray(values, [1, 0, 0, 1, 0, 0]));
  else if (order === 'drop') console.log(drop(values[0], values[1], Array.from({ length: (values.length - 2) / 3 }, (_, i) => values.slice(2 + 3 * i, 5 + 3 * i))));
  else throw new Error(`what is '${line}'?`);
}
