// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The two materials of our own: points of two sizes, and outlines that only show where their surface faces the eye.
import { Color, Matrix4, ShaderMaterial } from 'three';
import type { Vec3 } from '../check';

const FRAGMENT = `
varying vec3 v_color;
uniform float opacity;
#include <clipping_planes_pars_fragment>
void main() {
  #include <clipping_planes_fragment>
  gl_FragColor = vec4(v_color, opacity);
}`;

// The alpha of a point's colour is its size: 1 is the size of clustered points, less is a share of it. A point of a surface
// shows from the free side of that surface, as the surface does.
const POINT_VERTEX = `
attribute vec4 color;
uniform float size;
uniform mat4 turn; // from the world's axes to the scene's: the object's own matrix scales too
uniform bool hide_clustered;
uniform bool both_sides;
varying vec3 v_color;
#include <clipping_planes_pars_vertex>
void main() {
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  #include <clipping_planes_vertex>
  v_color = color.rgb;
  gl_Position = projectionMatrix * mvPosition;
  gl_PointSize = max(1.0, size * color.a);
  vec3 toward = isOrthographic ? vec3(0.0, 0.0, 1.0) : -mvPosition.xyz;
  bool away = !both_sides && dot(mat3(viewMatrix) * mat3(turn) * normal, toward) < 0.0;
  if (away || (hide_clustered && color.a == 1.0)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

// Moved towards the eye by a thousandth, so that a line is not cut up by the face that it borders.
const LINE_VERTEX = `
uniform vec3 tint;
uniform bool both_sides;
varying vec3 v_color;
#include <clipping_planes_pars_vertex>
void main() {
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  vec3 toward = isOrthographic ? vec3(0.0, 0.0, 1.0) : -mvPosition.xyz;
  bool away = dot(normalMatrix * normal, toward) < 0.0;
  if (isOrthographic) mvPosition.z += 0.01; else mvPosition.xyz *= 0.9985;
  #include <clipping_planes_vertex>
  v_color = tint;
  gl_Position = away && !both_sides ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * mvPosition;
}`;

/** A colour of the palette for a material, darker by a factor. */
export const to_color = ([r, g, b]: Vec3, factor = 1): Color => new Color().setRGB((factor * r) / 255, (factor * g) / 255, (factor * b) / 255);

export function point_material(): ShaderMaterial {
  return new ShaderMaterial({ vertexShader: POINT_VERTEX, fragmentShader: FRAGMENT, clipping: true, uniforms: { size: { value: 2 }, turn: { value: new Matrix4() }, both_sides: { value: false }, hide_clustered: { value: false }, opacity: { value: 1 } } });
}

export function line_material(color: Color, opacity = 1): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: LINE_VERTEX,
    fragmentShader: FRAGMENT,
    clipping: true,
    transparent: opacity < 1,
    depthWrite: opacity === 1,
    uniforms: { tint: { value: color }, both_sides: { value: false }, opacity: { value: opacity } },
  });
}
