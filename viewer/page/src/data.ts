// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The document that `scanworld view` puts into the page (docs/page.md), decoded and checked.
import { check_schema, Fault, Place, type Vec3 } from './check';
import { triangulate_world } from './triangulate';
import { read_world, type World } from './world';

export interface Box {
  min: Vec3;
  max: Vec3;
}

export interface Triangles {
  corners: Int32Array; // three indices of vertices each
  surface: Int32Array;
}

export interface Scan {
  points: number; // of the whole scan
  left_out: number;
  box: Box;
  positions: Uint16Array;
  surface: Int16Array;
  distance: Uint16Array; // 0.1 mm
  max_distance: number;
  tolerance: number;
  has_rays: boolean; // whether it is known where the scanner stood
  violations: Float32Array; // some of those that were found
  violations_found: number;
  leaks: Float32Array;
  leaks_found: number;
}

export interface ReplayStep {
  stage: string;
  text: string;
  clusters: number;
  changed: number;
  points: Uint32Array;
  cluster: Int32Array;
  polygons: { cluster: Int32Array; size: Int32Array; vertices: Uint16Array };
}

export interface Replay {
  method: string;
  count: number;
  box: Box;
  positions: Uint16Array;
  steps: ReplayStep[];
}

export interface SurfaceFidelity {
  points: number;
  rms: number | null;
  offset: number | null;
  coverage: number | null; // null where no point is near
}

export interface Page {
  title: string;
  world: World;
  triangles: Triangles;
  scan: Scan | null;
  fidelity: Map<number, SurfaceFidelity>;
  replay: Replay | null;
  report: Place | null;
  sim: Place | null;
  /** What could not be read of the parts that are not the world. */
  faults: string[];
}

type Numbers<T> = { new (buffer: ArrayBuffer): T; BYTES_PER_ELEMENT: number };

/** Little-endian numbers in base64; all machines with a browser are little-endian. */
function array<T extends { length: number }>(p: Place, type: Numbers<T>, length?: number): T {
  let text: string;
  try {
    text = atob(p.text());
  } catch (e) {
    if (e instanceof Fault) throw e;
    return p.fail('it should be base64');
  }
  if (text.length % type.BYTES_PER_ELEMENT) p.fail(`its ${text.length} bytes are not whole numbers of ${type.BYTES_PER_ELEMENT} bytes`);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  const numbers = new type(bytes.buffer);
  if (length !== undefined && numbers.length !== length) p.fail(`it holds ${numbers.length} numbers, not ${length}`);
  return numbers;
}

function check_indices(indices: ArrayLike<number>, least: number, count: number, p: Place, what: string): void {
  for (let i = 0; i < indices.length; ++i)
    if (indices[i]! < least || indices[i]! >= count) throw new Fault(`${p.file}: ${p.path}[${i}] is ${indices[i]}: there are ${count} ${what}`);
}

function multiple(values: { length: number }, of: number, p: Place): void {
  if (values.length % of) throw new Fault(`${p.file}: ${p.path} holds ${values.length} numbers, not a multiple of ${of}`);
}

function read_box(p: Place): Box {
  const box = { min: p.at('min').vec3(), max: p.at('max').vec3() };
  if (box.min.some((v, i) => v > box.max[i]!)) p.fail('min is above max');
  return box;
}

function read_triangles(p: Place, world: World): Triangles {
  if (!p.present) return triangulate_world(world);
  const corners = array(p.at('corners'), Int32Array);
  multiple(corners, 3, p.at('corners'));
  const surface = array(p.at('surface'), Int32Array, corners.length / 3);
  check_indices(corners, 0, world.vertices.length, p.at('corners'), 'vertices');
  check_indices(surface, 0, world.surfaces.length, p.at('surface'), 'surfaces');
  return { corners, surface };
}

function read_scan(p: Place, world: World): Scan {
  const positions = array(p.at('positions'), Uint16Array);
  multiple(positions, 3, p.at('positions'));
  const count = positions.length / 3;
  const surface = array(p.at('surface'), Int16Array, count);
  check_indices(surface, -1, world.surfaces.length, p.at('surface'), 'surfaces');
  const violations = array(p.at('violations'), Float32Array);
  const leaks = array(p.at('leaks'), Float32Array);
  multiple(violations, 9, p.at('violations'));
  multiple(leaks, 6, p.at('leaks'));
  return {
    points: p.at('points').whole(),
    left_out: p.at('left_out').optional((n) => n.whole()) ?? 0,
    box: read_box(p.at('box')),
    positions,
    surface,
    distance: array(p.at('distance'), Uint16Array, count),
    max_distance: p.at('max_distance').number(),
    tolerance: p.at('tolerance').number(),
    has_rays: p.at('has_rays').value === true,
    violations,
    violations_found: p.at('violations_found').whole(),
    leaks,
    leaks_found: p.at('leaks_found').whole(),
  };
}

function read_fidelity(p: Place): Page['fidelity'] {
  const found = new Map<number, SurfaceFidelity>();
  if (!p.present) return found;
  for (const s of p.at('surfaces').any())
    found.set(s.at('id').whole(), {
      points: s.at('points').number(),
      rms: s.at('rms').optional((n) => n.number()),
      offset: s.at('offset').optional((n) => n.number()),
      coverage: s.at('coverage').optional((n) => n.number()),
    });
  return found;
}

function read_step(p: Place, count: number): ReplayStep {
  const points = array(p.at('points'), Uint32Array);
  check_indices(points, 0, count, p.at('points'), 'points');
  const loops = p.at('polygons');
  const size = array(loops.at('size'), Int32Array);
  const vertices = size.reduce((sum, n) => sum + Math.abs(n), 0);
  return {
    stage: p.at('stage').text(),
    text: p.at('text').text(),
    clusters: p.at('clusters').whole(),
    changed: p.at('changed').whole(),
    points,
    cluster: array(p.at('cluster'), Int32Array, points.length),
    polygons: { size, cluster: array(loops.at('cluster'), Int32Array, size.length), vertices: array(loops.at('vertices'), Uint16Array, 3 * vertices) },
  };
}

function read_replay(p: Place): Replay {
  check_schema(p, 'scanworld-replay', 'a replay');
  const points = p.at('points');
  const count = points.at('count').whole();
  return {
    method: p.at('method').text(),
    count,
    box: read_box(points.at('box')),
    positions: array(points.at('positions'), Uint16Array, 3 * count),
    steps: p.at('steps').list().map((s) => read_step(s, count)),
  };
}

/** The page's document. A fault of the world is thrown; faults of other parts leave those parts out. */
export function read_page(root: Place): Page {
  check_schema(root, 'scanworld-page', 'the data of a page');
  const world = read_world(new Place(root.at('world').value, '', 'world.json'));
  const faults: string[] = [];
  const part = <T>(key: string, read: (p: Place) => T): T | null => {
    const p = root.at(key);
    if (!p.present) return null;
    try {
      return read(new Place(p.value, key, 'the data of the page'));
    } catch (e) {
      faults.push((e as Error).message);
      return null;
    }
  };
  return {
    title: root.at('title').optional((t) => t.text()) ?? 'world',
    world,
    triangles: part('triangles', (p) => read_triangles(p, world)) ?? triangulate_world(world),
    scan: part('scan', (p) => read_scan(p, world)),
    fidelity: part('fidelity', read_fidelity) ?? new Map(),
    replay: part('replay', read_replay),
    report: part('report', (p) => p),
    sim: part('sim', (p) => p),
    faults,
  };
}

/** A page of a world.json alone, as someone opens it. */
export function page_of_world(root: Place, title: string): Page {
  const world = read_world(root);
  return { title, world, triangles: triangulate_world(world), scan: null, fidelity: new Map(), replay: null, report: null, sim: null, faults: [] };
}
