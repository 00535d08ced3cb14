// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Where one looks from: around the world in perspective, straight down without it, or walking inside.
import { type Box3, type Camera, MOUSE, OrthographicCamera, PerspectiveCamera, Spherical, TOUCH, Vector2, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Stage } from './stage';

export type View = 'orbit' | 'top' | 'walk';
export const DIRECTIONS = { iso: new Vector3(-0.55, -0.75, 0.8).normalize(), front: new Vector3(0, -1, 0.12).normalize() };

const FIELD = 45; // [degrees] of view, upright
const round = (v: number) => Math.round(v * 1e4) / 1e4;

export class Cameras {
  readonly perspective = new PerspectiveCamera(FIELD, 1, 0.05, 1000);
  readonly top = new OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
  readonly walking = new PerspectiveCamera(65, 1, 0.02, 1000);
  view: View = 'orbit';
  private readonly orbit_controls: OrbitControls;
  private readonly top_controls: OrbitControls;
  private box: Box3 | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly changed: () => void,
  ) {
    for (const c of [this.perspective, this.top, this.walking]) c.up.set(0, 0, 1);
    this.orbit_controls = this.controls(this.perspective);
    this.top_controls = this.controls(this.top);
    this.top_controls.enableRotate = false;
    this.top_controls.mouseButtons.LEFT = MOUSE.PAN;
    this.top_controls.touches.ONE = TOUCH.PAN;
    this.top_controls.touches.TWO = TOUCH.DOLLY_PAN;
    this.set_view('orbit');
  }

  private controls(camera: Camera): OrbitControls {
    const controls = new OrbitControls(camera, this.stage.canvas);
    controls.zoomToCursor = true;
    controls.addEventListener('change', () => {
      this.stage.request();
      this.changed();
    });
    return controls;
  }

  get active(): PerspectiveCamera | OrthographicCamera {
    return this.view === 'orbit' ? this.perspective : this.view === 'top' ? this.top : this.walking;
  }

  /** The box of what is shown, in the scene's axes. */
  set_box(box: Box3): void {
    this.box = box;
    const size = box.getSize(new Vector3()).length();
    for (const c of [this.perspective, this.top, this.walking]) {
      c.far = Math.max(100, 20 * size);
      c.updateProjectionMatrix();
    }
    this.perspective.near = Math.max(0.02, size / 1000);
    this.orbit_controls.maxDistance = 8 * size;
  }

  set_view(view: View): void {
    this.view = view;
    this.orbit_controls.enabled = view === 'orbit';
    this.top_controls.enabled = view === 'top';
    this.stage.camera = this.active;
    this.resize();
    this.changed();
  }

  resize(): void {
    const aspect = this.stage.width / this.stage.height;
    for (const c of [this.perspective, this.walking]) {
      c.aspect = aspect;
      c.updateProjectionMatrix();
    }
    const half = (this.top.top - this.top.bottom) / 2;
    [this.top.left, this.top.right] = [-half * aspect, half * aspect];
    this.top.updateProjectionMatrix();
    this.stage.request();
  }

  /** Puts everything into the picture, seen from a direction. */
  fit(direction: Vector3 | null = null): void {
    if (!this.box) return;
    if (this.view === 'top') return this.fit_top(this.box);
    const center = this.box.getCenter(new Vector3());
    const toward = direction ?? this.perspective.position.clone().sub(this.orbit_controls.target).normalize();
    const right = new Vector3(0, 0, 1).cross(toward).normalize();
    const up = toward.clone().cross(right);
    const tan = Math.tan((FIELD / 2) * (Math.PI / 180));
    // What is near looks larger, so the middle of the box is not the middle of its picture: the aim is moved a few times.
    for (let i = 0; ; ++i) {
      const views = corners(this.box).map((corner) => corner.sub(center)).map((v) => ({ x: v.dot(right), y: v.dot(up), near: v.dot(toward) }));
      const distance = Math.max(0.1, ...views.map((v) => v.near + 1.06 * Math.max(Math.abs(v.x) / (tan * this.perspective.aspect), Math.abs(v.y) / tan)));
      if (i === 4) return this.look(center.clone().addScaledVector(toward, distance), center);
      const middle = (slopes: number[]) => ((Math.min(...slopes) + Math.max(...slopes)) / 2) * distance;
      center.addScaledVector(right, middle(views.map((v) => v.x / (distance - v.near))));
      center.addScaledVector(up, middle(views.map((v) => v.y / (distance - v.near))));
    }
  }

  private fit_top(box: Box3): void {
    const [center, size] = [box.getCenter(new Vector3()), box.getSize(new Vector3())];
    const aspect = this.stage.width / this.stage.height;
    const half = 0.55 * Math.max(size.y, size.x / aspect, 0.1);
    [this.top.top, this.top.bottom] = [half, -half];
    this.top.zoom = 1;
    this.look_down(center, box.max.z);
    this.resize();
  }

  private look_down(center: Vector3, highest: number): void {
    this.top.near = 0.1;
    this.top_controls.target.copy(center);
    this.top.position.set(center.x, center.y - 1e-6, highest + 10);
    this.top_controls.update();
  }

  private look(from: Vector3, at: Vector3): void {
    this.orbit_controls.target.copy(at);
    this.perspective.position.copy(from);
    this.perspective.updateProjectionMatrix();
    this.orbit_controls.update();
    this.stage.request();
  }

  /** Turns around what one looks at, as dragging does; angles in radians. */
  turn(azimuth: number, rise: number): void {
    if (this.view !== 'orbit') return;
    const target = this.orbit_controls.target;
    const at = this.perspective.position.clone().sub(target);
    const around = new Spherical().setFromVector3(new Vector3(at.x, at.z, -at.y)); // its pole is +y
    around.theta += azimuth;
    around.phi = Math.max(0.02, Math.min(Math.PI - 0.02, around.phi - rise));
    const v = new Vector3().setFromSpherical(around);
    this.look(target.clone().add(new Vector3(v.x, -v.z, v.y)), target);
  }

  /** Scales what one sees, as the wheel does. */
  zoom(factor: number): void {
    if (this.view === 'top') {
      this.top.zoom *= factor;
      this.top.updateProjectionMatrix();
      this.stage.request();
      this.changed();
    } else if (this.view === 'orbit') {
      const target = this.orbit_controls.target;
      this.look(this.perspective.position.clone().sub(target).divideScalar(factor).add(target), target);
    }
  }

  /** CSS pixels that a metre takes in the top view. */
  get pixels_per_metre(): number {
    return (this.stage.height * this.top.zoom) / (this.top.top - this.top.bottom);
  }

  get target(): Vector3 {
    return (this.view === 'top' ? this.top_controls : this.orbit_controls).target;
  }

  /** The camera in numbers, for a link. */
  numbers(): number[] {
    if (this.view === 'top') return [...this.top_controls.target.toArray(), this.top.position.z, (this.top.top - this.top.bottom) / this.top.zoom].map(round);
    if (this.view === 'orbit') return [...this.perspective.position.toArray(), ...this.orbit_controls.target.toArray()].map(round);
    const direction = this.walking.getWorldDirection(new Vector3());
    return [...this.walking.position.toArray(), Math.atan2(direction.y, direction.x), Math.asin(Math.max(-1, Math.min(1, direction.z)))].map(round);
  }

  restore(numbers: number[]): void {
    const [x, y, z, a, b, c] = numbers as [number, number, number, number, number, number];
    if (this.view === 'orbit' && numbers.length === 6) this.look(new Vector3(x, y, z), new Vector3(a, b, c));
    if (this.view === 'top' && numbers.length === 5) {
      [this.top.top, this.top.bottom, this.top.zoom] = [b / 2, -b / 2, 1];
      this.look_down(new Vector3(x, y, z), a - 10);
      this.resize();
    }
  }

  /** The ray under a place of the page: of its near end and its direction in the scene's axes. */
  ray(px: number, py: number): { origin: Vector3; direction: Vector3 } {
    const frame = this.stage.canvas.getBoundingClientRect();
    const at = new Vector2(((px - frame.left) / frame.width) * 2 - 1, 1 - ((py - frame.top) / frame.height) * 2);
    const camera = this.active;
    camera.updateMatrixWorld();
    const origin = new Vector3(at.x, at.y, -1).unproject(camera);
    return { origin, direction: new Vector3(at.x, at.y, 1).unproject(camera).sub(origin).normalize() };
  }

  /** Where a place of the scene is on the page, in CSS pixels; null behind the eye. */
  project(place: Vector3): [number, number] | null {
    const camera = this.active;
    camera.updateMatrixWorld();
    const p = place.clone().project(camera);
    if (p.z > 1 || p.z < -1) return null;
    const frame = this.stage.canvas.getBoundingClientRect();
    return [frame.left + ((p.x + 1) / 2) * frame.width, frame.top + ((1 - p.y) / 2) * frame.height];
  }
}

function corners(box: Box3): Vector3[] {
  return Array.from({ length: 8 }, (_, i) => new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z));
}
