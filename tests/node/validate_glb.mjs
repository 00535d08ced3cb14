// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// node validate_glb.mjs FILE...: holds GLB files against the validator of Khronos; fails on any error or warning.
import { readFile } from 'node:fs/promises';
import validator from 'gltf-validator';

let faults = 0;
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), { uri: file });
  const { numErrors, numWarnings, messages } = report.issues;
  faults += numErrors + numWarnings;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${report.info.totalTriangleCount} triangles`);
  for (const m of messages.filter((m) => m.severity <= 1)) console.log(`  ${m.code} ${m.pointer}: ${m.message}`);
}
process.exit(faults === 0 ? 0 : 1);
