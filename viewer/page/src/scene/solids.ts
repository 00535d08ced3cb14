// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes, hulls, cylinders and prisms as triangles that face outwards.
import { BoxGeometry, type BufferGeometry, Color, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from 'three';
import { ConvexHull } from 'three/addons/math/ConvexHull.js';
import type { Vec3 } from '../check';
import { COLLIDER, OBSTACLE, shade } from '../palette';
import type { Solid, World } from '../world';
import { solid_edges } from './lines';
import { to_color } from './materials';
import { type Soup, soup_geometry, SoupBuilder } from './soup';

type Triangle = [Vec3, Vec3, Vec3];

function geometry_triangles(geometry: BufferGeometry): Triangle[] {
  const flat = geometry.toNonIndexed().getAttribute('position');
  const corner = (i: number): Vec3 => [flat.getX(i), flat.getY(i), flat.getZ(i)];
  return Array.from({ length: flat.count / 3 }, (_, t) => [corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)]);
}

function hull_triangles(points: Vec3[]): Triangle[] {
  if (points.length < 4) return [];
  const hull = new ConvexHull().setFromPoints(points.map((p) => new Vector3(...p)));
  return hull.faces.map((face) => {
    const first = face.edge;
    return [first.head(), first.next.head(), first.next.next.head()].map((v) => v.point.toArray()) as Triangle;
  });
}

function solid_triangles(solid: Solid, up: Vec3): Triangle[] {
  if (solid.form === 'box') return geometry_triangles(new BoxGeometry(...solid.size).applyQuaternion(new Quaternion(...solid.rotation)).translate(...solid.center));
  if (solid.form === 'hull') return hull_triangles(solid.vertices);
  if (solid.form === 'prism') return hull_triangles(solid.base.flatMap((p) => [p, p.map((v, k) => v + solid.extrusion[k]!) as Vec3]));
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...up));
  return geometry_triangles(new CylinderGeometry(solid.radius, solid.radius, solid.height, 32).applyQuaternion(turn).translate(...solid.center));
}

export function solid_soup(solids: Solid[], up: Vec3): Soup {
  const soup = new SoupBuilder();
  solids.forEach((solid, i) => {
    for (const triangle of solid_triangles(solid, up)) soup.triangle(i, ...triangle);
  });
  return soup.done();
}

const shaded = (color: Vec3, up: Vec3) => (_: number, normal: Vec3) => color.map((v) => v * shade(normal, up)) as Vec3;

export function obstacle_layer(soup: Soup, world: World, ink: Color): Group {
  const geometry = soup_geometry(soup, shaded(OBSTACLE, world.up));
  const fill = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
  return new Group().add(fill, solid_edges(geometry, ink));
}

export function collider_layer(world: World): Group {
  const soup = solid_soup(world.colliders.map((c) => c.solid), world.up);
  const geometry = soup_geometry(soup, shaded(COLLIDER, world.up));
  const fill = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.28, depthWrite: false }));
  return new Group().add(fill, solid_edges(geometry, to_color(COLLIDER, 255 / 400), 0.8));
}
