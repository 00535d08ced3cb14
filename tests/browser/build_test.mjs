// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// viewer/page.html is kept with the sources, so that building scanworld needs no npm: it must be what they build.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { empty_page, repository, temporary_folder } from './support.mjs';

const sources = join(repository, 'viewer/page');

test('page.html is what its sources build', () => {
  const output = join(temporary_folder(), 'page.html');
  if (!existsSync(join(sources, 'node_modules'))) execFileSync('npm', ['ci', '--no-audit', '--no-fund'], { cwd: sources, stdio: 'ignore' });
  execFileSync('npm', ['run', 'build'], { cwd: sources, env: { ...process.env, SCANWORLD_PAGE: output }, stdio: 'pipe' });
  assert.ok(readFileSync(output).equals(readFileSync(empty_page)), 'run ./dev page');
});

test('the page is one file that names no other, with the place for the data once and before the script', () => {
  const page = readFileSync(empty_page, 'utf8');
  assert.ok(page.length < 900_000, `${page.length} bytes`);
  const place = '<script id="scanworld-data" type="application/json">null</script>';
  assert.equal(page.split(place).length, 2);
  assert.ok(page.indexOf(place) < page.indexOf('<script type="module">'));
  assert.doesNotMatch(page.replace(/<script type="module">.*<\/script>/s, ''), /\b(src|href)=/);
  assert.ok(page.includes('three.js authors') && page.includes('The MIT License'));
});
