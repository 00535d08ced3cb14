// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Which colour stands for what. Colours are [r, g, b], 0 to 255, as the screen shows them.
import type { Vec3 } from './check';
import type { Kind, OpeningKind, Surface } from './world';

export type ColorMode = 'id' | 'scan' | 'kind';
export const COLOR_MODES: ColorMode[] = ['id', 'scan', 'kind'];

const KIND_COLORS: Record<Kind, Vec3> = { floor: [201, 178, 143], ceiling: [205, 208, 214], wall: [140, 166, 196], other: [158, 185, 140] };
export const OPENING_COLORS: Record<OpeningKind, Vec3> = { door: [214, 122, 43], window: [48, 128, 214], passage: [46, 158, 104] };
export const GLASS: Vec3 = [110, 190, 235];
export const OBSTACLE: Vec3 = [176, 132, 96];
export const COLLIDER: Vec3 = [38, 166, 154];
export const UNEXPLAINED: Vec3 = [214, 39, 140];
export const UNCLUSTERED: Vec3 = [96, 100, 108];
export const VIOLATION: Vec3 = [220, 50, 47];
export const LEAK: Vec3 = [226, 132, 16];
export const SELECTED: Vec3 = [255, 196, 0];
const NO_COLOR: Vec3 = [186, 188, 192];

export function hsl(hue: number, saturation: number, lightness: number): Vec3 {
  const chroma = saturation * Math.min(lightness, 1 - lightness);
  const channel = (n: number) => {
    const k = (n + hue * 12) % 12;
    return 255 * (lightness - chroma * Math.max(-1, Math.min(k - 3, 9 - k, 1)));
  };
  return [channel(0), channel(8), channel(4)];
}

/** Neighbouring ids get hues far apart: each is a golden angle on. */
export function hue_color(id: number, lightness = 0.66): Vec3 {
  return hsl((id * 0.381966 + 0.08) % 1, 0.5, lightness + 0.06 * ((id % 3) - 1));
}

export function surface_color(surface: Surface, mode: ColorMode): Vec3 {
  if (mode === 'kind') return KIND_COLORS[surface.kind];
  if (mode === 'scan') return surface.color ?? NO_COLOR;
  return hue_color(surface.id);
}

// Dark blue over teal to yellow: its lightness rises all along, so that it reads without colour vision too.
const RAMP: Vec3[] = [[43, 64, 140], [38, 110, 160], [42, 152, 142], [122, 190, 92], [240, 216, 60]];

/** The colour of a share of the scale, 0 to 1. */
export function ramp(share: number): Vec3 {
  const at = Math.max(0, Math.min(1, share)) * (RAMP.length - 1);
  const i = Math.min(RAMP.length - 2, Math.floor(at));
  return [0, 1, 2].map((k) => RAMP[i]![k]! + (at - i) * (RAMP[i + 1]![k]! - RAMP[i]![k]!)) as Vec3;
}

export const css = (c: Vec3): string => `rgb(${c.map((v) => Math.round(v)).join(', ')})`;

/** How bright a face is by the direction of its normal, baked into colours: no light has to be computed while drawing. */
export function shade(normal: Vec3, up: Vec3): number {
  const rise = normal[0] * up[0] + normal[1] * up[1] + normal[2] * up[2];
  const side = Math.abs(normal[0] * 0.8 + normal[1] * 0.6 + normal[2] * 0.2);
  return rise > 0 ? 0.86 + 0.14 * rise : 0.74 + 0.12 * side * (1 + rise);
}
