// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A browser, and pages to open in it. SCANWORLD_COMMAND names the scanworld program that makes the pages.
// SCANWORLD_TEST_PAGE may name another page.html to put their data into, which saves building the program while working on the page.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

export const repository = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
export const empty_page = process.env.SCANWORLD_TEST_PAGE ?? join(repository, 'viewer/page.html');
const command = process.env.SCANWORLD_COMMAND ?? join(repository, 'build/release/scanworld');
const DATA = /<script id="scanworld-data" type="application\/json">(.*?)<\/script>/s;

export function temporary_folder() {
  const folder = mkdtempSync(join(tmpdir(), 'scanworld-browser-'));
  process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

export function scanworld(...args) {
  return execFileSync(command, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}

/** The page that `scanworld view` makes. */
export function view(output, ...args) {
  mkdirSync(dirname(output), { recursive: true });
  scanworld('view', ...args, '-o', output);
  if (process.env.SCANWORLD_TEST_PAGE) writeFileSync(output, with_data(DATA.exec(readFileSync(output, 'utf8'))[1]));
  return output;
}

/** The empty page with any text in the place of its data. */
export function with_data(text) {
  return readFileSync(empty_page, 'utf8').replace(DATA, (all, old) => all.replace(`>${old}<`, () => `>${text}<`));
}

export const write_json = (file, value) => {
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, JSON.stringify(value));
  return file;
};
export const read_json = (file) => JSON.parse(readFileSync(file, 'utf8'));
export const office = () => read_json(join(repository, 'worlds/office.json'));

export const LAPTOP = [1366, 768];

let browser = null;

export async function start_browser() {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
}

export const stop_browser = () => browser.close();

/** Opens a page, small as most tests need no more, and waits until it is ready. What went wrong in it is in `troubles`, what it asked the network for in `requests`. */
export async function open(file, { hash = '', scheme = 'light', script = null, size = [1000, 640] } = {}) {
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, colorScheme: scheme });
  const page = await context.newPage();
  page.troubles = [];
  page.requests = [];
  page.on('console', (m) => ['error', 'warning'].includes(m.type()) && !/GPU stall due to ReadPixels/.test(m.text()) && page.troubles.push(m.text()));
  page.on('pageerror', (e) => page.troubles.push(e.message));
  page.on('request', (r) => !/^(file|data|blob):/.test(r.url()) && page.requests.push(r.url()));
  if (script) await page.addInitScript(script);
  await page.goto(pathToFileURL(file) + hash);
  await page.evaluate(() => window.scanworld?.ready);
  return page;
}

/** Waits until nothing moves any more and what was drawn is on the screen. */
async function settle(page) {
  await page.evaluate(async () => {
    const frames = async (n) => {
      for (let i = 0; i < n; ++i) await new Promise((done) => requestAnimationFrame(done));
    };
    document.activeElement.blur(); // the focus has an outline
    await frames(2); // a message that came or went changes the size of the picture only in the next frame
    await window.scanworld.rest();
    await frames(3); // what was drawn is on the screen some frames later, where much else is going on
  });
}

/** What the picture looks like when nothing moves any more, as a hash: two are the same or they are not. */
export async function picture(page) {
  await settle(page);
  return createHash('sha256').update(await page.locator('#canvas').screenshot({ animations: 'disabled' })).digest('hex');
}

/** What a few pixels around a place of the world look like, as a hash. */
export async function patch(page, place) {
  await settle(page);
  const [x, y] = await project(page, place);
  return createHash('sha256').update(await page.screenshot({ clip: { x: Math.round(x) - 2, y: Math.round(y) - 2, width: 4, height: 4 } })).digest('hex');
}

export const state = (page) => page.evaluate(() => window.scanworld.state());
export const project = (page, place) => page.evaluate((p) => window.scanworld.project(p), place);
export const close = (page) => page.context().close();
