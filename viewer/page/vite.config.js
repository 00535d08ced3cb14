// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Builds the page into one HTML file that needs nothing else: ../page.html, or the file that SCANWORLD_PAGE names.
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

const here = dirname(fileURLToPath(import.meta.url));
const output = resolve(here, process.env.SCANWORLD_PAGE ?? '../page.html');
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

// Only this script and this style may run: a text of a scan that got into the page as markup could do nothing.
function policy(script, style) {
  const rules = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; img-src blob: data:; require-trusted-types-for 'script'`;
  return `<meta http-equiv="Content-Security-Policy" content="${rules}">`;
}

function one_file(html, script, style) {
  const licence = readFileSync(resolve(here, 'node_modules/three/LICENSE'), 'utf8').trim();
  const page = html
    .replace(/\s*<script type="module"[^>]*><\/script>/g, '')
    .replace(/\s*<link rel="stylesheet"[^>]*>/g, '')
    .replace('<meta charset="utf-8">', () => `<meta charset="utf-8">\n  ${policy(script, style)}`)
    .replace('</head>', () => `  <style>${style}</style>\n</head>`)
    .replace('</body>', () => `  <script type="module">${script}</script>\n</body>`);
  return `${page.trimEnd()}\n<!-- This file contains three.js.\n${licence}\n-->\n`;
}

// Takes what the bundler made and writes it as one file, in place of the bundler's own files.
const single_file = {
  name: 'single-file',
  enforce: 'post',
  generateBundle(_, bundle) {
    const parts = Object.values(bundle);
    const of = (ending) => parts.filter((p) => p.fileName.endsWith(ending)).map((p) => (p.code ?? p.source).toString()).join('\n');
    const script = of('.js').trim().replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
    const page = one_file(of('.html'), script, of('.css').trim());
    if (page.split('<script id="scanworld-data" type="application/json">null</script>').length !== 2) this.error('the place for the data is not there once');
    mkdirSync(dirname(output), { recursive: true });
    writeFileSync(output, page);
    for (const name of Object.keys(bundle)) delete bundle[name];
  },
};

export default defineConfig({
  root: resolve(here, 'src'),
  base: './',
  publicDir: false,
  logLevel: 'warn',
  plugins: [single_file],
  esbuild: { legalComments: 'inline' },
  build: { target: 'es2022', write: false, modulePreload: false, cssCodeSplit: false, assetsInlineLimit: 1e8, chunkSizeWarningLimit: 2000, reportCompressedSize: false },
});
