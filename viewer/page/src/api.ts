// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// window.scanworld: the page for scripts and tests. Places are in the world's axes, pixels are CSS pixels of the page.
import { Vector3 } from 'three';
import type { App } from './app';
import type { Vec3 } from './check';
import { available, LAYERS, type LayerName } from './layers';
import { find_thing, id_of } from './link';

export interface Scanworld {
  /** Resolves when the page has shown its world, or has said why it cannot. */
  ready: Promise<void>;
  /** Resolves when the picture is complete: nothing moves, every point is drawn. */
  rest(): Promise<void>;
  layers(): Record<string, { on: boolean; available: boolean }>;
  setLayer(name: LayerName, on: boolean): void;
  /** The surface, opening or obstacle under a place of the page. */
  pick(x: number, y: number): { type: string; id: number } | null;
  select(type: string, id: number): void;
  /** Where a place of the world is on the page; null behind the eye. */
  project(place: Vec3): [number, number] | null;
  /** All that a link holds. */
  state(): Record<string, unknown>;
  /** iso, front, top, fit or walk. */
  setView(name: string): void;
  readonly replay: { length: number; step: number; playing: boolean; goTo(step: number): void; play(): void } | null;
  /** Turns the camera once around; gives frames per second. */
  benchmark(frames?: number): Promise<number>;
  /** What was drawn last: pixels, and points of the scan. */
  drawn(): { width: number; height: number; points: number };
}

const next_frame = () => new Promise<void>((done) => requestAnimationFrame(() => done()));

async function benchmark(app: App, frames: number): Promise<number> {
  const begin = performance.now();
  for (let i = 0; i < frames; ++i) {
    app.cameras.turn((2 * Math.PI) / frames, 0);
    await next_frame();
  }
  app.stage.finish();
  return (1000 * frames) / (performance.now() - begin);
}

function state(app: App): Record<string, unknown> {
  const { layers, selection, ...rest } = app.shown();
  return { ...rest, layers: [...layers], selection: selection && app.page ? { type: selection.type, id: id_of(app.page, selection) } : null, link: app.link() };
}

export function make_api(app: App, ready: Promise<void>): Scanworld {
  return {
    ready,
    rest: () => app.stage.rest(),
    layers: () => Object.fromEntries(LAYERS.map(({ name }) => [name, { on: app.layers.has(name), available: app.page !== null && available(name, app.page) }])),
    setLayer: (name, on) => app.set_layer(name, on),
    pick: (x, y) => {
      const thing = app.pick(x, y);
      return thing && app.page ? { type: thing.type, id: id_of(app.page, thing) } : null;
    },
    select: (type, id) => app.select(app.page && find_thing(app.page, type, id)),
    project: (place) => app.project(new Vector3(...place)),
    state: () => state(app),
    setView: (name) => app.set_view(name),
    get replay() {
      const { replay } = app;
      if (!replay) return null;
      return {
        length: replay.length,
        step: replay.step,
        playing: replay.playing,
        goTo: (step: number) => app.set_tab('replay', step),
        play: () => {
          app.set_tab('replay', replay.step);
          replay.play();
        },
      };
    },
    benchmark: (frames = 60) => benchmark(app, frames),
    drawn: () => app.stage.drawn(),
  };
}
