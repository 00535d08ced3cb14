// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Walking through the world at a robot's height over the main floor.
import { Vector3 } from 'three';
import type { Cameras } from './camera';
import type { Stage } from './stage';

const SPEED = 1.6; // [m/s]; three times as fast with shift
const TURN = 1.4; // [rad/s] of the arrow keys to the sides
const LOOK = 0.004; // [rad] a pixel

const MOVES: Record<string, [number, number, number]> = {
  KeyW: [1, 0, 0],
  ArrowUp: [1, 0, 0],
  KeyS: [-1, 0, 0],
  ArrowDown: [-1, 0, 0],
  KeyA: [0, 1, 0],
  KeyD: [0, -1, 0],
  ArrowLeft: [0, 0, 1],
  ArrowRight: [0, 0, -1],
};

export class Walk {
  height = 0.6; // [m] of the eye over the floor
  floor = 0; // height of the main floor in the scene
  private yaw = 0;
  private pitch = 0;
  private readonly keys = new Set<string>();
  private last = 0;

  constructor(
    private readonly stage: Stage,
    private readonly cameras: Cameras,
    private readonly changed: () => void,
  ) {
    const canvas = stage.canvas;
    canvas.addEventListener('pointermove', (e) => {
      if (this.cameras.view !== 'walk' || !(e.buttons & 1)) return;
      this.yaw += e.movementX * LOOK;
      this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + e.movementY * LOOK));
      this.place();
    });
    window.addEventListener('keyup', (e) => this.keys.delete(e.code));
    window.addEventListener('blur', () => this.keys.clear());
  }

  start(at: Vector3, yaw: number, pitch = 0): void {
    this.cameras.walking.position.copy(at).setZ(this.floor + this.height);
    this.yaw = yaw;
    this.pitch = pitch;
    this.cameras.set_view('walk');
    this.place();
  }

  set_height(height: number): void {
    this.height = height;
    this.cameras.walking.position.z = this.floor + height;
    this.place();
  }

  /** Takes a key, if it is one of walking. */
  key(e: KeyboardEvent): boolean {
    if (this.cameras.view !== 'walk' || !MOVES[e.code]) return false;
    this.keys.add(e.code);
    if (!this.last) {
      this.last = performance.now();
      requestAnimationFrame((now) => this.step(now, e.shiftKey));
    }
    return true;
  }

  /** Goes on as long as keys are held. */
  private step(now: number, fast: boolean): void {
    const seconds = Math.min(0.1, Math.max(0, now - this.last) / 1000);
    this.last = now;
    if (this.keys.size === 0 || this.cameras.view !== 'walk') {
      this.keys.clear();
      this.last = 0;
      return;
    }
    const along = (k: 0 | 1 | 2) => [...this.keys].reduce((sum, key) => sum + MOVES[key]![k], 0);
    const [ahead, left, turn] = [along(0), along(1), along(2)];
    const reach = SPEED * (fast ? 3 : 1) * seconds;
    const position = this.cameras.walking.position;
    position.x += reach * (ahead * Math.cos(this.yaw) - left * Math.sin(this.yaw));
    position.y += reach * (ahead * Math.sin(this.yaw) + left * Math.cos(this.yaw));
    this.yaw += turn * TURN * seconds;
    this.place();
    requestAnimationFrame((next) => this.step(next, fast));
  }

  private place(): void {
    const camera = this.cameras.walking;
    const direction = new Vector3(Math.cos(this.yaw) * Math.cos(this.pitch), Math.sin(this.yaw) * Math.cos(this.pitch), Math.sin(this.pitch));
    camera.lookAt(direction.add(camera.position));
    this.stage.request();
    this.changed();
  }
}
