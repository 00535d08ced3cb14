// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What a page's document looks like: one object a layer, made when it is first shown.
import { Box3, type BufferAttribute, type BufferGeometry, Color, Group, type Material, type Mesh, type Object3D, type Plane, type Quaternion, type Ray, Vector3 } from 'three';
import type { Page } from '../data';
import type { ColorMode } from '../palette';
import { type Hit, pick_soup } from '../pick';
import { available, type LayerName, type Thing } from '../layers';
import { opening_layer, opening_soup } from './openings';
import { face_points, paint_atlas, paint_scan, point_cloud, type PointCloud, position_attribute } from './points';
import { room_label, room_layer } from './rooms';
import { leak_layer, violation_layer } from './sight_lines';
import { collider_layer, obstacle_layer, solid_soup } from './solids';
import type { Soup } from './soup';
import { SurfaceLayers } from './surfaces';

export class Content {
  readonly group = new Group();
  readonly ink = new Color();
  readonly positions: BufferAttribute | null;
  private readonly surfaces: SurfaceLayers;
  private readonly soups: { type: Thing['type']; layers: LayerName[]; soup: Soup }[];
  private readonly objects = new Map<LayerName, Object3D>();
  private readonly shown = new Set<LayerName>();
  private mode: ColorMode = 'id';
  private both = false;

  constructor(
    readonly page: Page,
    private readonly turn: Quaternion, // from the world's axes to the scene's
  ) {
    const { world, scan, triangles } = page;
    this.surfaces = new SurfaceLayers(world, triangles, this.ink);
    this.surfaces.color_mode = this.mode;
    this.positions = scan && position_attribute(scan.positions);
    this.soups = [
      { type: 'surface', layers: ['polygons', 'triangles'], soup: this.surfaces.soup },
      { type: 'opening', layers: ['openings'], soup: opening_soup(world) },
      { type: 'obstacle', layers: ['obstacles'], soup: solid_soup(world.obstacles.map((o) => o.solid), world.up) },
    ];
  }

  show(name: LayerName, on: boolean): void {
    if (on && !this.objects.has(name) && available(name, this.page)) {
      const object = this.make(name);
      this.objects.set(name, object);
      this.group.add(object);
    }
    if (on) this.shown.add(name);
    else this.shown.delete(name);
    for (const [layer, object] of this.objects) object.visible = this.shown.has(layer);
    // The atlas shows the same points: both at once would hide one another.
    const points = this.objects.get('points');
    if (points && this.shown.has('atlas')) points.visible = false;
  }

  private make(name: LayerName): Object3D {
    const { world, scan } = this.page;
    const soup = (type: Thing['type']) => this.soups.find((s) => s.type === type)!.soup;
    switch (name) {
      case 'polygons': return this.surfaces.polygons;
      case 'triangles': return this.surfaces.triangles;
      case 'openings': return opening_layer(soup('opening'), world);
      case 'obstacles': return obstacle_layer(soup('obstacle'), world, this.ink);
      case 'colliders': return collider_layer(world);
      case 'rooms': return room_layer(world, this.surfaces.soup, this.ink);
      case 'violations': return violation_layer(scan!.violations);
      case 'leaks': return leak_layer(scan!.leaks);
      case 'points':
      case 'atlas': return this.points(name);
    }
  }

  private points(name: 'points' | 'atlas'): PointCloud {
    const scan = this.page.scan!;
    const points = point_cloud(this.positions!, scan.box);
    face_points(points, scan, this.page.world);
    points.material.uniforms.turn!.value.makeRotationFromQuaternion(this.turn);
    points.material.uniforms.both_sides!.value = this.both;
    if (name === 'atlas') paint_atlas(points, scan);
    else paint_scan(points, scan, this.page.world, this.mode);
    points.userData.size = name === 'atlas' ? 2.5 : 2;
    return points;
  }

  set color_mode(mode: ColorMode) {
    this.mode = mode;
    this.surfaces.color_mode = mode;
    const points = this.objects.get('points') as PointCloud | undefined;
    if (points) paint_scan(points, this.page.scan!, this.page.world, mode);
  }

  set both_sides(both: boolean) {
    this.both = both;
    this.surfaces.both_sides = both;
    for (const name of ['points', 'atlas'] as const) {
      const points = this.objects.get(name) as PointCloud | undefined;
      if (points) points.material.uniforms.both_sides!.value = both;
    }
  }

  /** The nearest thing of a layer that is shown; ray and section in the world's axes. */
  pick(ray: Ray, section: Plane | null): { thing: Thing; hit: Hit } | null {
    let best: { thing: Thing; hit: Hit } | null = null;
    for (const { type, layers, soup } of this.soups) {
      if (!layers.some((l) => this.shown.has(l))) continue;
      const hit = pick_soup(ray, soup, type !== 'opening' && !(type === 'surface' && this.both), section);
      if (hit && (!best || hit.distance < best.hit.distance)) best = { thing: { type, index: hit.owner }, hit };
    }
    return best;
  }

  soup_of(type: Thing['type']): Soup {
    return this.soups.find((s) => s.type === type)!.soup;
  }

  room_labels(): { text: string; place: Vector3 }[] {
    if (!this.shown.has('rooms')) return [];
    return this.page.world.rooms.flatMap((room) => (room.center ? [{ text: room_label(room), place: new Vector3(...room.center).applyQuaternion(this.turn) }] : []));
  }

  /** The box of the world in the scene's axes; of the scan's points where the world is empty. */
  box(): Box3 {
    const box = new Box3();
    for (const v of this.page.world.vertices) box.expandByPoint(new Vector3(...v).applyQuaternion(this.turn));
    const scan = this.page.scan;
    if (box.isEmpty() && scan) box.expandByPoint(new Vector3(...scan.box.min)).expandByPoint(new Vector3(...scan.box.max));
    if (box.isEmpty()) box.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
    return box;
  }

  dispose(): void {
    this.group.traverse((object) => {
      const { geometry, material } = object as Mesh<BufferGeometry, Material>;
      geometry?.dispose();
      material?.dispose();
    });
    this.group.removeFromParent();
  }
}
