// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The topological map: floors tinted by room, a name for each, and lines through the doors and up the stairs that join them.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, MeshBasicMaterial, Points, PointsMaterial, Quaternion, Vector3 } from 'three';
import type { Vec3 } from '../check';
import { hsl } from '../palette';
import type { World } from '../world';
import { LineBuilder } from './lines';
import { room_cells, type Wall } from './room_cells';
import { type Soup, soup_geometry, SoupBuilder } from './soup';

type Triangle = [Vec3, Vec3, Vec3];

const WALL_REACH = 1.9; // [m] a wall that reaches so high over the floor parts rooms; doors are cut out of it below

const SAME_FLOOR = 0.3; // [m] between a floor and the centre of a room on it

export const room_color = (room: number): Vec3 => hsl((room * 0.381966 + 0.55) % 1, 0.5, 0.66);

/** The world's axes turned so that up is +z, and back. */
function level(up: Vec3): { there: (p: Vec3) => Vec3; back: (p: Vec3) => Vec3 } {
  const turn = new Quaternion().setFromUnitVectors(new Vector3(...up), new Vector3(0, 0, 1));
  const apply = (q: Quaternion) => (p: Vec3) => new Vector3(...p).applyQuaternion(q).toArray();
  return { there: apply(turn), back: apply(turn.clone().invert()) };
}

/** The walls that part rooms on a floor of this height, in plan. */
function walls_over(world: World, height: number, there: (p: Vec3) => Vec3): Wall[] {
  return world.surfaces.flatMap((s) => {
    if (s.kind !== 'wall') return [];
    const points = s.outer.map((v) => there(world.vertices[v]!));
    const heights = points.map((p) => p[2]);
    if (Math.max(...heights) < height + WALL_REACH || Math.min(...heights) > height + WALL_REACH) return [];
    return points.map((from, i) => ({ from, to: points[(i + 1) % points.length]! }));
  });
}

/** The rooms on a floor: those that name it, and of those that name none the ones whose centre is at its height. */
function rooms_on(world: World, floor: number): { named: number[]; near: number[] } {
  const { normal, offset } = world.surfaces[floor]!;
  const above = (p: Vec3) => Math.abs(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] + offset);
  const indices = world.rooms.map((_, i) => i);
  const names_none = (i: number) => !world.rooms[i]!.surfaces.some((s) => world.surfaces[s]!.kind === 'floor');
  return {
    named: indices.filter((i) => world.rooms[i]!.surfaces.includes(floor)),
    near: indices.filter((i) => names_none(i) && world.rooms[i]!.center !== null && above(world.rooms[i]!.center!) < SAME_FLOOR),
  };
}

function tint_soup(world: World, surfaces: Soup): Soup {
  const { there, back } = level(world.up);
  const soup = new SoupBuilder();
  world.surfaces.forEach((surface, s) => {
    if (surface.kind !== 'floor') return;
    const { named, near } = rooms_on(world, s);
    const rooms = [...named, ...near];
    const floor = triangles_of(surfaces, s).map((t) => t.map(there) as Triangle);
    if (rooms.length === 0 || floor.length === 0) return;
    if (named.length === 1 && near.length === 0) return floor.forEach((t) => soup.triangle(rooms[0]!, ...(t.map(back) as Triangle)));
    const centers = rooms.flatMap((room) => (world.rooms[room]!.center ? [{ room, center: there(world.rooms[room]!.center!) }] : []));
    const normal = there(surface.normal);
    const on_floor = (x: number, y: number): Vec3 => back([x, y, -(surface.offset + normal[0] * x + normal[1] * y) / normal[2]]);
    for (const c of room_cells(floor, walls_over(world, floor[0]![0][2], there), centers)) {
      const [a, b, d, e] = [on_floor(c.x, c.y), on_floor(c.x + c.width, c.y), on_floor(c.x + c.width, c.y + c.depth), on_floor(c.x, c.y + c.depth)];
      soup.triangle(c.room, a, b, d);
      soup.triangle(c.room, a, d, e);
    }
  });
  return soup.done();
}

function triangles_of(soup: Soup, owner: number): Triangle[] {
  const corner = (i: number): Vec3 => [soup.positions[i]!, soup.positions[i + 1]!, soup.positions[i + 2]!];
  const found: Triangle[] = [];
  soup.owner.forEach((o, t) => {
    if (o === owner) found.push([corner(9 * t), corner(9 * t + 3), corner(9 * t + 6)]);
  });
  return found;
}

function middle(world: World, opening: number): Vec3 {
  const loop = world.openings[opening]!.loop.map((v) => world.vertices[v]!);
  return [0, 1, 2].map((k) => loop.reduce((sum, p) => sum + p[k]!, 0) / loop.length) as Vec3;
}

/** From the centre of a room through the middle of a door, or up stairs and ramps, to the centre of the other one, a little over the floor. */
function links_between(world: World): LineBuilder {
  const lines = new LineBuilder();
  const lifted = (p: Vec3): Vec3 => p.map((v, k) => v + 0.1 * world.up[k]!) as Vec3;
  for (const door of world.doors) {
    for (const room of door.rooms) {
      const center = world.rooms[room]!.center;
      if (center) lines.segment(lifted(center), middle(world, door.opening), [0, 0, 0]);
    }
  }
  for (const way of world.ways) {
    const ends = [way.foot, way.top];
    lines.segment(lifted(way.foot), lifted(way.top), [0, 0, 0]);
    way.rooms.forEach((room, k) => {
      const center = room === null ? null : world.rooms[room]!.center;
      if (center) lines.segment(lifted(center), lifted(ends[k]!), [0, 0, 0]);
    });
  }
  return lines;
}

export function room_layer(world: World, surfaces: Soup, ink: Color): Group {
  const soup = tint_soup(world, surfaces);
  const tint = new MeshBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.72, side: DoubleSide, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4 });
  const links = links_between(world).done(ink);
  links.material.depthTest = false;
  links.renderOrder = 2;
  const places = new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from([...world.doors.map((d) => middle(world, d.opening)), ...world.ways.flatMap((w) => [w.foot, w.top])].flat()), 3));
  const marks = new Points(places, new PointsMaterial({ color: ink, size: 7, sizeAttenuation: false, depthTest: false, transparent: true }));
  marks.renderOrder = 2;
  return new Group().add(new Mesh(soup_geometry(soup, room_color), tint), links, marks);
}

export function room_label(room: World['rooms'][number]): string {
  return room.area === null ? room.name : `${room.name}\n${room.area.toFixed(1)} m²`;
}
