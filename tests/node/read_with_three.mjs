// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// node read_with_three.mjs WORLD.glb|WORLD.usda: what three.js finds in it, a line a mesh: name, triangles, area and bounds in its
// own Y-up axes.
import { readFile } from 'node:fs/promises';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { USDLoader } from 'three/examples/jsm/loaders/USDLoader.js';
import { Box3, Triangle, Vector3 } from 'three';

globalThis.self = globalThis; // which loaders expect of a browser
const file = process.argv[2];
const bytes = await readFile(file);
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const root = file.endsWith('.glb') ? (await new GLTFLoader().parseAsync(buffer, '')).scene : new USDLoader().parse(file.endsWith('.usda') ? bytes.toString() : buffer);
root.updateMatrixWorld(true);
root.traverse((object) => {
  if (!object.isMesh) return;
  const geometry = object.geometry.index ? object.geometry.toNonIndexed() : object.geometry;
  const at = geometry.getAttribute('position');
  const corner = (i) => new Vector3().fromBufferAttribute(at, i).applyMatrix4(object.matrixWorld);
  const box = new Box3();
  let area = 0;
  for (let i = 0; i + 2 < at.count; i += 3) {
    const triangle = new Triangle(corner(i), corner(i + 1), corner(i + 2));
    area += triangle.getArea();
    for (const p of [triangle.a, triangle.b, triangle.c]) box.expandByPoint(p);
  }
  console.log(object.name, at.count / 3, area, ...box.min, ...box.max);
});
