// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What the method did, step by step, as points or as polygons in the colours of their clusters.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, FrontSide, Group, Mesh, MeshBasicMaterial } from 'three';
import type { Vec3 } from './check';
import type { Replay, ReplayStep } from './data';
import { hue_color, shade, UNCLUSTERED } from './palette';
import { LineBuilder, type OutlinedLines } from './scene/lines';
import { point_at, point_cloud, type PointCloud, position_attribute } from './scene/points';
import { soup_geometry, SoupBuilder } from './scene/soup';
import type { Stage } from './stage';
import { loop_normal, triangulate } from './triangulate';

export type ReplayMode = 'polygons' | 'points';

// Of the way from the middle of the box to its side; what is farther out shows its inside only.
const NEAR_BORDER = 0.55;
const NEAR_CEILING = 0.1; // the same for what is level: ceilings are to be looked through
const SMALL = 130; // the size of unclustered points, of 255

export class ReplayPlayer {
  readonly group = new Group();
  step = 0;
  mode: ReplayMode = 'polygons';
  playing = false;
  started = false;
  speed = 2; // [steps/s]

  private readonly points: PointCloud;
  private readonly cluster: Int32Array; // of each point, at the step that is painted
  private painted = -1;
  private polygons = new Group();
  private timer = 0;
  private readonly ink = new Color();

  constructor(
    readonly replay: Replay,
    private readonly up: Vec3,
    private readonly stage: Stage,
    private readonly changed: () => void,
  ) {
    this.cluster = new Int32Array(replay.count).fill(-1);
    this.points = point_cloud(position_attribute(replay.positions), replay.box);
    this.points.userData.size = 2.5;
    for (let i = 0; i < replay.count; ++i) this.paint(i);
    this.group.visible = false;
    this.group.add(this.points, this.polygons);
    stage.root.add(this.group);
  }

  get length(): number {
    return this.replay.steps.length;
  }

  get current(): ReplayStep | undefined {
    return this.replay.steps[this.step];
  }

  set_ink(color: string): void {
    this.ink.set(color);
  }

  set_mode(mode: ReplayMode): void {
    this.mode = mode;
    this.show();
  }

  /** Shows a step and stays there. */
  go_to(step: number): void {
    this.pause();
    this.started = true;
    this.step = Math.max(0, Math.min(this.length - 1, step));
    this.show();
  }

  /** Plays from here to the end; from the beginning where this is the end. */
  play(): void {
    if (this.length === 0) return;
    if (this.step >= this.length - 1) this.step = 0;
    this.started = true;
    this.playing = true;
    this.stage.in_motion = true;
    this.show();
    this.wait();
  }

  /** Plays by itself, but not for those who asked their system for less motion. */
  autoplay(): void {
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) this.go_to(this.length - 1);
    else this.play();
  }

  pause(): void {
    clearTimeout(this.timer);
    this.playing = false;
    if (!this.stage.in_motion) return;
    this.stage.in_motion = false;
    this.stage.request();
    this.changed();
  }

  private wait(): void {
    this.timer = window.setTimeout(() => {
      if (this.step < this.length - 1) {
        ++this.step;
        this.show();
      }
      if (this.step < this.length - 1) this.wait();
      else this.pause();
    }, 1000 / this.speed);
  }

  private show(): void {
    this.recluster();
    this.free_polygons();
    if (this.mode === 'polygons' && this.current) this.polygons.add(...this.make_polygons(this.current));
    this.stage.request();
    this.changed();
  }

  /** Brings the clusters of the points to the current step: on by what changed, back by starting anew. */
  private recluster(): void {
    if (this.step < this.painted) {
      this.cluster.fill(-1);
      this.painted = -1;
      for (let i = 0; i < this.replay.count; ++i) this.paint(i);
    }
    while (this.painted < this.step) {
      const { points, cluster } = this.replay.steps[++this.painted]!;
      points.forEach((p, k) => {
        this.cluster[p] = cluster[k]!;
        this.paint(p);
      });
    }
    const unclustered_only = this.mode === 'polygons' && (this.current?.polygons.size.length ?? 0) > 0;
    // Polygons stand for their points: only those of no cluster are drawn beside them.
    this.points.material.uniforms.hide_clustered!.value = unclustered_only;
    (this.points.geometry.getAttribute('color') as BufferAttribute).needsUpdate = true;
  }

  private paint(point: number): void {
    const cluster = this.cluster[point]!;
    const colors = this.points.geometry.getAttribute('color').array;
    const color = cluster < 0 ? UNCLUSTERED : hue_color(cluster, 0.55);
    for (let k = 0; k < 3; ++k) colors[4 * point + k] = color[k]!;
    colors[4 * point + 3] = cluster < 0 ? SMALL : 255;
  }

  private make_polygons(step: ReplayStep): (Mesh | OutlinedLines)[] {
    const { box } = this.replay;
    const [inner, either] = [new SoupBuilder(), new SoupBuilder()];
    const lines = new LineBuilder();
    for (const { cluster, loops } of polygons_of(step)) {
      const [outer, ...holes] = loops.map((loop) => loop.map((i) => point_at(step.polygons.vertices, 3, i, box))) as [Vec3[], ...Vec3[][]];
      const { normal, border } = facing(outer, box, this.up);
      const all = [outer, ...holes].flat();
      for (const [a, b, c] of triangulate(outer, holes, normal)) (border ? inner : either).triangle(cluster, all[a!]!, all[b!]!, all[c!]!);
      for (const loop of [outer, ...holes]) lines.loop(loop, border ? normal : [0, 0, 0]);
    }
    const fill = (soup: SoupBuilder, side: typeof FrontSide | typeof DoubleSide) => {
      const color = (cluster: number, normal: Vec3) => hue_color(cluster).map((v) => v * shade(normal.map(Math.abs) as Vec3, this.up.map(Math.abs) as Vec3)) as Vec3;
      return new Mesh(soup_geometry(soup.done(), color), new MeshBasicMaterial({ vertexColors: true, side, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    };
    return [fill(inner, FrontSide), fill(either, DoubleSide), lines.done(this.ink)];
  }

  private free_polygons(): void {
    for (const child of this.polygons.children as (Mesh<BufferGeometry, MeshBasicMaterial> | OutlinedLines)[]) {
      child.geometry.dispose();
      child.material.dispose();
    }
    this.polygons.clear();
  }

  dispose(): void {
    this.pause();
    this.free_polygons();
    this.points.geometry.dispose();
    this.points.material.dispose();
    this.group.removeFromParent();
  }
}

/** The loops of a step sorted into polygons; each loop is a list of indices of vertices. */
function polygons_of(step: ReplayStep): { cluster: number; loops: number[][] }[] {
  const found: { cluster: number; loops: number[][] }[] = [];
  let at = 0;
  step.polygons.size.forEach((size, i) => {
    const loop = Array.from({ length: Math.abs(size) }, (_, k) => at + k);
    at += loop.length;
    if (size > 0) found.push({ cluster: step.polygons.cluster[i]!, loops: [loop] });
    else found.at(-1)?.loops.push(loop);
  });
  return found.filter((p) => p.loops[0]!.length > 2);
}

/** A step does not know yet which side of a polygon is free. What lies near the border of everything is free inside. */
function facing(outer: Vec3[], box: Replay['box'], up: Vec3): { normal: Vec3; border: boolean } {
  const sum = loop_normal(outer);
  const length = Math.hypot(...sum) || 1;
  const normal = sum.map((v) => v / length) as Vec3;
  const [center, half] = [box.min.map((v, k) => (v + box.max[k]!) / 2), box.min.map((v, k) => (box.max[k]! - v) / 2)];
  const middle = [0, 1, 2].map((k) => outer.reduce((s, p) => s + p[k]!, 0) / outer.length - center[k]!);
  const out = middle.reduce((s, v, k) => s + v * normal[k]!, 0);
  const level = Math.abs(normal.reduce((s, v, k) => s + v * up[k]!, 0)) > 0.7;
  const reach = half.reduce((s, v, k) => s + v * Math.abs(normal[k]!), 0) || 1;
  return { normal: out > 0 ? (normal.map((v) => -v) as Vec3) : normal, border: Math.abs(out) / reach > (level ? NEAR_CEILING : NEAR_BORDER) };
}
