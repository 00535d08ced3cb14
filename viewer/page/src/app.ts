// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page shows at the moment, and the one place where that changes.
import { Box3, BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshBasicMaterial, type Plane, Quaternion, Ray, Vector3 } from 'three';
import { Cameras, DIRECTIONS, type View } from './camera';
import type { Page } from './data';
import { by_id } from './dom';
import { Labels } from './labels';
import { default_layers, available, LAYERS, type LayerName, type Thing } from './layers';
import { read_link, type Shown, write_link } from './link';
import type { ColorMode } from './palette';
import { SELECTED } from './palette';
import { ReplayPlayer } from './replay';
import { Content } from './scene/content';
import { point_at } from './scene/points';
import { to_color } from './scene/materials';
import { part_of } from './scene/soup';
import { in_world, type Section, section_plane } from './section';
import { Stage } from './stage';
import { length_text, Tape } from './tape';
import { effective_theme, paper, set_theme, type Theme } from './theme';
import { area_of } from './triangulate';
import { Walk } from './walk';

const SNAP = 8; // [px] the tape snaps to a vertex of a surface so near
const STOREY = 1; // [m] floors nearer in height are of one storey
const POINT_REACH = 6; // [px] and to a point of the scan

export class App {
  readonly stage: Stage;
  readonly cameras: Cameras;
  readonly walk: Walk;
  readonly labels: Labels;
  readonly tape = new Tape();
  content: Content | null = null;
  replay: ReplayPlayer | null = null;
  layers = new Set<LayerName>();
  color: ColorMode = 'id';
  both_sides = false;
  section: Section = { axis: 'off', at: 0, flip: false };
  selection: Thing | null = null;
  theme: Theme | null = null;
  tab = 'world';
  /** Told after each change, to bring the controls up to date. */
  readonly listeners: (() => void)[] = [];

  private readonly turn = new Quaternion(); // from the world's axes to the scene's
  private highlight: Mesh | null = null;
  private told = false;

  constructor(canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas);
    const changed = () => this.changed();
    this.cameras = new Cameras(this.stage, changed);
    this.walk = new Walk(this.stage, this.cameras, changed);
    this.labels = new Labels(by_id('labels'), this.cameras);
    this.stage.after_frame.push(() => this.labels.update());
    this.stage.root.add(this.tape.group);
  }

  get page(): Page | null {
    return this.content?.page ?? null;
  }

  /** Shows a document, as the hash of the address says where it says so. */
  load(page: Page, hash: string): void {
    const turn = new Quaternion().setFromUnitVectors(new Vector3(...page.world.up).normalize(), new Vector3(0, 0, 1));
    const content = new Content(page, turn); // throws before anything has changed
    this.content?.dispose();
    this.replay?.dispose();
    this.tape.clear();
    this.content = content;
    this.turn.copy(turn);
    this.stage.root.quaternion.copy(this.turn);
    this.stage.root.add(content.group);
    const box = content.box();
    this.replay = page.replay && new ReplayPlayer(page.replay, page.world.up, this.stage, () => this.changed());
    this.cameras.set_box(box);
    this.walk.floor = this.main_floor();
    this.set_color(this.color);
    this.set_both_sides(this.both_sides);
    this.layers = default_layers(page);
    this.select(null);
    this.section = { axis: 'off', at: 0, flip: false };
    this.cameras.set_view('orbit');
    this.cameras.fit(DIRECTIONS.iso);
    this.set_tab('world');
    this.apply_theme();
    if (hash.length > 1) this.restore(hash);
    this.refresh_layers();
  }

  restore(hash: string): void {
    if (!this.page) return;
    const shown = read_link(hash, this.page);
    if (shown.theme !== undefined) this.set_theme(shown.theme);
    if (shown.layers) this.layers = shown.layers;
    if (shown.color) this.set_color(shown.color);
    this.set_both_sides(shown.both_sides ?? false);
    if (shown.section) this.set_section(shown.section);
    if (shown.view) this.restore_view(shown.view, shown.camera!);
    this.select(shown.selection ?? null);
    this.set_tab(shown.tab ?? 'world', shown.step ?? null);
    this.refresh_layers();
  }

  private restore_view(view: View, camera: number[]): void {
    if (view === 'walk') {
      const [x, y, z, yaw, pitch] = camera as [number, number, number, number, number];
      this.walk.height = z - this.walk.floor;
      return this.walk.start(new Vector3(x, y, z), yaw, pitch);
    }
    this.cameras.set_view(view);
    this.cameras.restore(camera);
  }

  shown(): Shown {
    return {
      view: this.cameras.view,
      camera: this.cameras.numbers(),
      layers: this.layers,
      color: this.color,
      both_sides: this.both_sides,
      section: this.section,
      selection: this.selection,
      theme: this.theme,
      tab: this.tab,
      step: this.tab === 'replay' && this.replay ? this.replay.step : null,
    };
  }

  link(): string {
    return this.page ? write_link(this.shown(), this.page) : '';
  }

  /** Tells the listeners once, after all that changes now has changed. */
  changed(): void {
    if (this.told) return;
    this.told = true;
    queueMicrotask(() => {
      this.told = false;
      for (const f of this.listeners) f();
    });
  }

  set_layer(name: LayerName, on: boolean): void {
    if (!this.page || (on && !available(name, this.page))) return;
    if (on) this.layers.add(name);
    else this.layers.delete(name);
    this.refresh_layers();
  }

  private refresh_layers(): void {
    if (!this.content) return;
    const replaying = this.tab === 'replay' && this.replay !== null;
    this.content.group.visible = !replaying;
    if (this.replay) this.replay.group.visible = replaying;
    for (const { name } of LAYERS) this.content.show(name, this.layers.has(name));
    this.labels.set('room', replaying ? [] : this.content.room_labels());
    if (this.highlight) this.highlight.visible = !replaying;
    this.update();
  }

  private update(): void {
    this.stage.request();
    this.changed();
  }

  set_color(mode: ColorMode): void {
    this.color = mode;
    if (this.content) this.content.color_mode = mode;
    this.update();
  }

  set_both_sides(both: boolean): void {
    this.both_sides = both;
    if (this.content) this.content.both_sides = both;
    this.update();
  }

  set_section(section: Section): void {
    this.section = section;
    this.stage.section = section_plane(section);
    this.changed();
  }

  set_tab(tab: string, step: number | null = null): void {
    const known = tab === 'world' || (tab === 'replay' && this.replay) || (tab === 'sim' && this.page?.sim) || (tab === 'report' && this.page?.report);
    const before = this.tab;
    this.tab = known ? tab : 'world';
    if (this.tab === 'replay') {
      if (step !== null) this.replay!.go_to(step);
      else if (before !== 'replay' && !this.replay!.started) this.replay!.autoplay();
    } else this.replay?.pause();
    this.refresh_layers();
  }

  set_theme(theme: Theme | null): void {
    this.theme = theme;
    this.apply_theme();
  }

  apply_theme(): void {
    set_theme(this.theme);
    this.stage.background = paper();
    const outlines = effective_theme(this.theme) === 'dark' ? '#0b0e12' : '#20262e';
    this.content?.ink.set(outlines);
    this.replay?.set_ink(outlines);
    this.changed();
  }

  /** A view by its name: iso, front, top, fit, walk, orbit. */
  set_view(name: string): void {
    if (name === 'walk') return this.start_walk();
    if (name === 'fit') {
      if (this.cameras.view === 'walk') this.cameras.set_view('orbit');
      return this.cameras.fit();
    }
    this.cameras.set_view(name === 'top' ? 'top' : 'orbit');
    if (name === 'top') this.cameras.fit();
    if (name === 'iso' || name === 'front') this.cameras.fit(DIRECTIONS[name]);
  }

  private start_walk(): void {
    if (this.cameras.view === 'walk' || !this.page) return;
    const rooms = this.page.world.rooms.filter((r) => r.center).sort((a, b) => (b.area ?? 0) - (a.area ?? 0));
    const centers = rooms.map((r) => new Vector3(...r.center!).applyQuaternion(this.turn));
    const at = centers.find((c) => Math.abs(c.z - this.walk.floor) < STOREY) ?? this.cameras.target.clone();
    this.walk.start(at, 0);
  }

  /** The height of the largest floor, in the scene. */
  private main_floor(): number {
    const world = this.page!.world;
    let best = { area: 0, height: this.content!.box().min.z };
    for (const s of world.surfaces) {
      const area = area_of(s, world);
      if (s.kind !== 'floor' || area <= best.area) continue;
      const heights = s.outer.map((v) => new Vector3(...world.vertices[v]!).applyQuaternion(this.turn).z);
      best = { area, height: heights.reduce((sum, z) => sum + z, 0) / heights.length };
    }
    return best.height;
  }

  select(thing: Thing | null): void {
    this.selection = thing;
    this.highlight?.removeFromParent();
    this.highlight?.geometry.dispose();
    this.highlight = null;
    if (thing && this.content) {
      const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(part_of(this.content.soup_of(thing.type), thing.index), 3));
      const color = to_color(SELECTED);
      this.highlight = new Mesh(geometry, new MeshBasicMaterial({ color, transparent: true, opacity: 0.6, side: DoubleSide, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -4 }));
      this.highlight.renderOrder = 1;
      this.stage.root.add(this.highlight);
    }
    this.update();
  }

  private ray(px: number, py: number): Ray {
    const { origin, direction } = this.cameras.ray(px, py);
    const back = this.turn.clone().invert();
    return new Ray(origin.applyQuaternion(back), direction.applyQuaternion(back));
  }

  private get section_in_world(): Plane | null {
    return in_world(section_plane(this.section), this.turn);
  }

  pick(px: number, py: number): Thing | null {
    if (!this.content || this.tab === 'replay') return null;
    return this.content.pick(this.ray(px, py), this.section_in_world)?.thing ?? null;
  }

  /** What a click means: a place for the tape, or something to select. */
  click(px: number, py: number): void {
    if (!this.tape.active) return this.select(this.pick(px, py));
    const place = this.place_under(px, py);
    if (!place) return;
    this.tape.click(place);
    this.show_tape();
  }

  show_tape(): void {
    const middle = (a: Vector3, b: Vector3) => a.clone().add(b).multiplyScalar(0.5).applyQuaternion(this.turn);
    this.labels.set('distance', this.tape.measures.map((m) => ({ text: length_text(m), place: middle(m.from, m.to) })));
    this.update();
  }

  /** The place in the world that the tape takes for a click: a vertex, a surface, or a point of the scan. */
  private place_under(px: number, py: number): Vector3 | null {
    const found = this.content?.pick(this.ray(px, py), this.section_in_world);
    const point = this.point_under(px, py);
    if (point && (!found || point.depth < found.hit.distance)) return point.place;
    if (found && found.thing.type !== 'surface') return found.hit.place;
    return this.vertex_under(px, py, found ? found.thing.index : null) ?? found?.hit.place ?? null;
  }

  /** The nearest vertex of a surface, or where none is given of all that show their free side, just beside whose edge one may click. */
  private vertex_under(px: number, py: number, index: number | null): Vector3 | null {
    if (!this.layers.has('polygons') && !this.layers.has('triangles')) return null;
    const { world } = this.page!;
    const ray = this.ray(px, py);
    const shown = world.surfaces.filter((s, i) => (index === null ? this.both_sides || ray.direction.dot(new Vector3(...s.normal)) < -1e-3 : i === index));
    let best: { distance: number; place: Vector3 | null } = { distance: SNAP, place: null };
    for (const v of new Set(shown.flatMap((s) => [...s.outer, ...s.holes.flat()]))) {
      const place = new Vector3(...world.vertices[v]!);
      const at = this.project(place);
      const distance = at ? Math.hypot(at[0] - px, at[1] - py) : Infinity;
      if (distance < best.distance && (this.section_in_world?.distanceToPoint(place) ?? 0) >= 0) best = { distance, place };
    }
    return best.place;
  }

  /** The nearest point of the scan that is drawn under a place of the page. */
  private point_under(px: number, py: number): { place: Vector3; depth: number } | null {
    const scan = this.page?.scan;
    if (!scan || !(this.layers.has('points') || this.layers.has('atlas'))) return null;
    const ray = this.ray(px, py);
    const section = this.section_in_world;
    const per_metre = this.cameras.view === 'top' ? 1 / this.cameras.pixels_per_metre : null;
    const tan = (2 * Math.tan((this.cameras.perspective.fov * Math.PI) / 360)) / this.stage.height;
    const v = new Vector3();
    let best: { place: Vector3; depth: number } | null = null;
    for (let i = 0; i < scan.surface.length; ++i) {
      v.fromArray(point_at(scan.positions, 3, i, scan.box));
      const depth = v.clone().sub(ray.origin).dot(ray.direction);
      if (depth <= 0 || (best && depth >= best.depth)) continue;
      const reach = POINT_REACH * (per_metre ?? tan * depth) * 0.5;
      if (ray.distanceSqToPoint(v) > reach * reach || (section && section.distanceToPoint(v) < 0)) continue;
      best = { place: v.clone(), depth };
    }
    return best;
  }

  /** The box of the world in the scene's axes. */
  scene_box(): Box3 {
    return this.content?.box() ?? new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  }

  /** Where a place of the world is on the page. */
  project(place: Vector3): [number, number] | null {
    return this.cameras.project(place.clone().applyQuaternion(this.turn));
  }
}
