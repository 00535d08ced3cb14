// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws when something has changed, never otherwise: first quickly, with as many points and pixels as the machine manages,
// and once nothing has changed for a moment again with everything.
import { type Camera, Color, ColorManagement, Group, LinearSRGBColorSpace, type Plane, Points, Scene, ShaderMaterial, Vector2, WebGLRenderer } from 'three';

ColorManagement.enabled = false; // colours are what the screen shows; nothing is lit

const REST_AFTER = 160; // [ms] without change until everything is drawn
const SLOW = 40; // [ms] between frames in motion: draw less
const FAST = 24; // [ms]: draw more
const LEAST_POINTS = 20_000;
const RATIOS = [0.5, 0.75, 1]; // picture pixels a CSS pixel in motion
const MOST_PIXELS = 9e6; // at rest

export class Stage {
  readonly renderer: WebGLRenderer;
  readonly scene = new Scene();
  readonly root = new Group(); // in the world's axes; the scene's +z is up
  readonly after_frame: (() => void)[] = [];
  camera: Camera | null = null;
  width = 1;
  height = 1;
  /** While this is set, as in a replay, frames follow each other and the one with everything would only flicker. */
  in_motion = false;

  private pending = 0;
  private complete = false;
  private timer = 0;
  private last_frame = 0;
  private points = 60_000; // drawn in motion
  private ratio = RATIOS.length - 1; // index
  private slow_frames = 0; // in a row
  private fast_frames = 0;
  private resting: (() => void)[] = [];

  constructor(readonly canvas: HTMLCanvasElement) {
    // Opaque, as the page behind it then need not be mixed in; edges are smoothed at rest by drawing finer.
    const context = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: true, stencil: false, powerPreference: 'high-performance' });
    if (!context) throw new Error('there is no WebGL 2');
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.scene.add(this.root);
  }

  /** Asks for a new picture. */
  request(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    this.complete = false;
    if (!this.pending) this.pending = requestAnimationFrame((now) => this.quick(now));
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.request();
  }

  /** Resolves when the picture with everything has been drawn: at once where that is so. */
  rest(): Promise<void> {
    return this.complete ? Promise.resolve() : new Promise((done) => this.resting.push(done));
  }

  set background(color: string) {
    this.scene.background = new Color(color);
    this.request();
  }

  set section(plane: Plane | null) {
    this.renderer.clippingPlanes = plane ? [plane] : [];
    this.request();
  }

  /** Draws everything and gives the picture's canvas while it is still filled. */
  picture(): HTMLCanvasElement {
    this.draw(this.rest_ratio(), Infinity);
    return this.canvas;
  }

  /** Waits until the graphics card has done all that it was told. */
  finish(): void {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** What the last picture holds: pixels, and points of the largest cloud. */
  drawn(): { width: number; height: number; points: number } {
    let points = 0;
    this.scene.traverseVisible((object) => {
      if (object instanceof Points) points = Math.max(points, Math.min(object.geometry.drawRange.count, object.geometry.getAttribute('position').count));
    });
    return { width: this.canvas.width, height: this.canvas.height, points };
  }

  private quick(now: number): void {
    this.pending = 0;
    this.adapt(now - this.last_frame);
    this.last_frame = now;
    this.draw(RATIOS[this.ratio]!, this.points);
    this.timer = window.setTimeout(() => this.slow(), REST_AFTER);
  }

  private slow(): void {
    this.timer = 0;
    if (this.in_motion) return;
    this.draw(this.rest_ratio(), Infinity);
    this.last_frame = 0; // what comes next does not follow this frame
    this.complete = true;
    for (const done of this.resting.splice(0)) done();
  }

  /** Draws less after a few slow frames, and more after many fast ones: changing the size of the picture takes time itself. */
  private adapt(interval: number): void {
    if (interval > 400) return; // not frames of one motion
    this.slow_frames = interval > SLOW ? this.slow_frames + 1 : 0;
    this.fast_frames = interval < FAST ? this.fast_frames + 1 : 0;
    if (this.slow_frames >= 2) {
      this.slow_frames = 0;
      if (this.points > LEAST_POINTS) this.points = Math.max(LEAST_POINTS, Math.round(this.points * 0.6));
      else this.ratio = Math.max(0, this.ratio - 1);
    } else if (this.fast_frames >= 30 && this.ratio < RATIOS.length - 1) {
      this.fast_frames = 0;
      ++this.ratio;
    } else if (this.fast_frames >= 8 && this.ratio === RATIOS.length - 1 && this.points < 1e7) {
      this.fast_frames = 0;
      this.points = Math.round(this.points * 1.5);
    }
  }

  private rest_ratio(): number {
    const ratio = Math.max(2, devicePixelRatio); // finer than the screen: smooths edges
    return Math.min(ratio, Math.max(1, Math.sqrt(MOST_PIXELS / (this.width * this.height))));
  }

  private draw(ratio: number, points: number): void {
    if (!this.camera) return;
    this.set_size(ratio);
    this.scene.traverseVisible((object) => {
      if (!(object instanceof Points)) return;
      object.geometry.setDrawRange(0, points);
      if (object.material instanceof ShaderMaterial) object.material.uniforms.size!.value = (object.userData.size ?? 2) * ratio;
    });
    this.renderer.render(this.scene, this.camera);
    for (const f of this.after_frame) f();
  }

  private set_size(ratio: number): void {
    const size = this.renderer.getSize(new Vector2());
    if (this.renderer.getPixelRatio() === ratio && size.x === this.width && size.y === this.height) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.width, this.height, false);
  }
}
