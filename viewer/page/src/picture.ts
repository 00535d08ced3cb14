// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture as a PNG file, with its labels and scale bar.
import type { App } from './app';
import { by_id, element } from './dom';
import { ink, paper } from './theme';

const MARGIN = 16; // [px] of the scale bar

function draw_scale(context: CanvasRenderingContext2D, scale: number, height: number): void {
  const width = by_id('scale-bar').getBoundingClientRect().width;
  context.fillStyle = ink();
  context.fillRect(MARGIN * scale, height - MARGIN * scale, width * scale, 3 * scale);
  context.textAlign = 'left';
  context.font = `${13 * scale}px system-ui, sans-serif`;
  context.fillText(by_id('scale-text').textContent ?? '', MARGIN * scale, height - (MARGIN + 10) * scale);
}

export function save_picture(app: App): void {
  const source = app.stage.picture();
  const canvas = element('canvas', { width: String(source.width), height: String(source.height) });
  const context = canvas.getContext('2d')!;
  context.drawImage(source, 0, 0);
  const scale = source.width / app.stage.width;
  app.labels.draw(context, scale, ink(), paper());
  if (!by_id('scale').hidden) draw_scale(context, scale, canvas.height);
  canvas.toBlob((blob) => {
    if (!blob) return;
    const link = element('a', { download: `${(app.page?.title ?? 'world').replace(/[^\w.-]+/g, '_')}.png` });
    link.href = URL.createObjectURL(blob);
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }, 'image/png');
}
