// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// world.json (docs/world.md) as the page needs it.
import { check_schema, type Place, type Vec3, type Vec4 } from './check';

export const KINDS = ['floor', 'ceiling', 'wall', 'other'] as const;
export const OPENINGS = ['door', 'window', 'passage'] as const;
export type Kind = (typeof KINDS)[number];
export type OpeningKind = (typeof OPENINGS)[number];

export interface Surface {
  id: number;
  kind: Kind;
  source: string;
  normal: Vec3; // to the free side
  offset: number;
  outer: number[];
  holes: number[][];
  support: { points: number; rms: number; coverage: number } | null;
  thickness: number | null;
  color: Vec3 | null;
  inferred: Vec3[][][]; // parts that were not measured, each its rings
}

export interface Opening {
  id: number;
  kind: OpeningKind;
  surface: number; // index, not id
  loop: number[];
  width: number;
  height: number;
  evidence: string;
  glass: boolean;
  leaf: { surface: number; angle: number; hinge: 'left' | 'right' } | null; // an index
}

export type Solid =
  | { form: 'box'; center: Vec3; size: Vec3; rotation: Vec4 }
  | { form: 'hull'; vertices: Vec3[] }
  | { form: 'cylinder'; center: Vec3; radius: number; height: number }
  | { form: 'prism'; base: Vec3[]; extrusion: Vec3 };

export interface Room {
  id: number;
  name: string;
  surfaces: number[]; // indices
  area: number | null;
  center: Vec3 | null;
}

export interface World {
  up: Vec3;
  vertices: Vec3[];
  surfaces: Surface[];
  openings: Opening[];
  obstacles: { id: number; solid: Solid }[];
  colliders: { surface: number | null; solid: Solid }[];
  rooms: Room[];
  doors: { opening: number; rooms: [number, number] }[]; // indices
  ways: { id: number; foot: Vec3; top: Vec3; rooms: [number | null, number | null] }[]; // stairs and ramps; indices of rooms
  provenance: { program: string; inputs: { file: string; points: number | null; fingerprint: string }[]; options: [string, string][] };
}

const loop = (p: Place, vertices: number): number[] => {
  const list = p.list();
  if (list.length < 3) p.fail('a loop has three vertices or more');
  return list.map((v) => v.index(vertices, 'vertices'));
};

function unit(p: Place): Vec3 {
  const v = p.vec3();
  if (Math.abs(Math.hypot(...v) - 1) > 1e-3) p.fail('it should have length 1');
  return v;
}

function read_surface(p: Place, vertices: number): Surface {
  return {
    id: p.at('id').whole(),
    kind: p.at('kind').one_of(KINDS),
    source: p.at('source').optional((s) => s.text()) ?? 'unknown',
    normal: unit(p.at('plane').at('normal')),
    offset: p.at('plane').at('offset').number(),
    outer: loop(p.at('outer'), vertices),
    holes: p.at('holes').any().map((h) => loop(h, vertices)),
    support: p.at('support').optional((s) => ({ points: s.at('points').number(), rms: s.at('rms').number(), coverage: s.at('coverage').number() })),
    thickness: p.at('thickness').optional((t) => t.number()),
    color: p.at('color').optional((c) => c.vec3()),
    inferred: p.at('inferred').any().map((part) => [part.at('outer'), ...part.at('holes').any()].map((ring) => ring.any().map((v) => v.vec3()))),
  };
}

function read_solid(p: Place): Solid {
  const box = p.at('box');
  if (box.present)
    return { form: 'box', center: box.at('center').vec3(), size: box.at('size').vec3(), rotation: box.at('rotation').optional((r) => r.numbers<Vec4>(4)) ?? [0, 0, 0, 1] };
  const hull = p.at('hull');
  if (hull.present) return { form: 'hull', vertices: hull.at('vertices').list().map((v) => v.vec3()) };
  const round = p.at('cylinder');
  if (round.present) return { form: 'cylinder', center: round.at('center').vec3(), radius: round.at('radius').number(), height: round.at('height').number() };
  const prism = p.at('prism');
  if (prism.present) return { form: 'prism', base: prism.at('base').list().map((v) => v.vec3()), extrusion: prism.at('extrusion').vec3() };
  return p.fail('a solid is a box, a hull, a cylinder or a prism');
}

/** Looks ids up, which need not be indices. */
class Ids {
  private readonly index = new Map<number, number>();
  constructor(
    items: { id: number }[],
    private readonly what: string,
    root: Place,
  ) {
    items.forEach(({ id }, i) => {
      const first = this.index.get(id);
      if (first !== undefined) root.at(what).list()[i]!.at('id').fail(`${what}[${first}] has this id already`);
      this.index.set(id, i);
    });
  }
  find(p: Place): number {
    const found = this.index.get(p.number());
    return found ?? p.fail(`there is none of ${this.what} with this id`);
  }
}

function read_provenance(p: Place): World['provenance'] {
  if (!p.present) return { program: 'unknown', inputs: [], options: [] };
  return {
    program: p.at('program').optional((t) => t.text()) ?? 'unknown',
    inputs: p.at('inputs').any().map((i) => ({
      file: i.at('file').text(),
      points: i.at('points').optional((n) => n.number()),
      fingerprint: i.at('fingerprint').optional((t) => t.text()) ?? '',
    })),
    options: p.at('options').present ? p.at('options').keys().map((k) => [k, String(p.at('options').at(k).value)]) : [],
  };
}

function read_openings(root: Place, surfaces: Ids, vertices: number): Opening[] {
  return root.at('openings').any().map((p) => ({
    id: p.at('id').whole(),
    kind: p.at('kind').one_of(OPENINGS),
    surface: surfaces.find(p.at('surface')),
    loop: loop(p.at('loop'), vertices),
    width: p.at('width').number(),
    height: p.at('height').number(),
    evidence: p.at('evidence').optional((t) => t.text()) ?? '',
    glass: p.at('glass').value === true,
    leaf: p.at('leaf').optional((l) => ({ surface: surfaces.find(l.at('surface')), angle: l.at('angle').number(), hinge: l.at('hinge').one_of(['left', 'right'] as const) })),
  }));
}

function read_rooms(root: Place, surfaces: Ids): Room[] {
  return root.at('rooms').any().map((p) => ({
    id: p.at('id').whole(),
    name: p.at('name').text(),
    surfaces: p.at('surfaces').any().map((s) => surfaces.find(s)),
    area: p.at('area').optional((n) => n.number()),
    center: p.at('center').optional((c) => c.vec3()),
  }));
}

/** Reads a world, or throws a Fault that names the place and the value. */
export function read_world(root: Place): World {
  check_schema(root, 'scanworld', 'a world', 2);
  const vertices = root.at('vertices').list().map((v) => v.vec3());
  const surfaces = root.at('surfaces').list().map((s) => read_surface(s, vertices.length));
  const surface_ids = new Ids(surfaces, 'surfaces', root);
  const openings = read_openings(root, surface_ids, vertices.length);
  const opening_ids = new Ids(openings, 'openings', root);
  const rooms = read_rooms(root, surface_ids);
  const room_ids = new Ids(rooms, 'rooms', root);
  const obstacles = root.at('obstacles').any().map((p) => ({ id: p.at('id').whole(), solid: read_solid(p) }));
  new Ids(obstacles, 'obstacles', root);
  return {
    up: root.at('frame').present ? unit(root.at('frame').at('up')) : [0, 0, 1],
    vertices,
    surfaces,
    openings,
    obstacles,
    colliders: root.at('colliders').any().map((p) => ({ surface: p.at('surface').optional((s) => surface_ids.find(s)), solid: read_solid(p) })),
    rooms,
    doors: root.at('doors').any().map((p) => {
      const ends = p.at('rooms').list();
      if (ends.length !== 2) p.at('rooms').fail('a door joins two rooms');
      return { opening: opening_ids.find(p.at('opening')), rooms: [room_ids.find(ends[0]!), room_ids.find(ends[1]!)] };
    }),
    ways: root.at('ways').any().map((p) => {
      const ends = p.at('rooms').list();
      if (ends.length !== 2) p.at('rooms').fail('a way has two ends');
      const room = (k: number) => ends[k]!.optional((r) => room_ids.find(r));
      return { id: p.at('id').whole(), foot: p.at('foot').vec3(), top: p.at('top').vec3(), rooms: [room(0), room(1)] };
    }),
    provenance: read_provenance(root.at('provenance')),
  };
}
