// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Which part of a floor belongs to which room. Rooms may share one floor, so the floor is cut into cells, and each cell
// goes to the room whose centre is nearest on a way around the walls. Everything here is level: +z is up.
import type { Vec3 } from '../check';

export interface Cell {
  room: number;
  x: number;
  y: number;
  width: number; // cells side by side are joined
  depth: number;
}

export interface Wall {
  from: Vec3;
  to: Vec3;
}

const LARGEST = 256; // cells along the longer side
const FREE = -1;
const OUTSIDE = -2;

class CellMap {
  readonly columns: number;
  readonly rows: number;
  readonly room: Int16Array;

  constructor(
    readonly min: [number, number],
    max: [number, number],
    readonly cell: number,
  ) {
    this.columns = Math.ceil((max[0] - min[0]) / cell) + 1;
    this.rows = Math.ceil((max[1] - min[1]) / cell) + 1;
    this.room = new Int16Array(this.columns * this.rows).fill(OUTSIDE);
  }

  at(x: number, y: number): number {
    const column = Math.floor((x - this.min[0]) / this.cell);
    const row = Math.floor((y - this.min[1]) / this.cell);
    return column < 0 || row < 0 || column >= this.columns || row >= this.rows ? -1 : row * this.columns + column;
  }

  /** Opens the cells whose middle is in a triangle. */
  open([a, b, c]: [Vec3, Vec3, Vec3]): void {
    const side = (p: Vec3, q: Vec3, x: number, y: number) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    const turn = Math.sign(side(a, b, c[0], c[1]));
    const span = (k: 0 | 1) => [Math.floor((Math.min(a[k], b[k], c[k]) - this.min[k]) / this.cell), Math.ceil((Math.max(a[k], b[k], c[k]) - this.min[k]) / this.cell)] as const;
    const [columns, rows] = [span(0), span(1)];
    for (let row = Math.max(0, rows[0]); row <= Math.min(this.rows - 1, rows[1]); ++row)
      for (let column = Math.max(0, columns[0]); column <= Math.min(this.columns - 1, columns[1]); ++column) {
        const x = this.min[0] + (column + 0.5) * this.cell;
        const y = this.min[1] + (row + 0.5) * this.cell;
        if (turn * side(a, b, x, y) >= 0 && turn * side(b, c, x, y) >= 0 && turn * side(c, a, x, y) >= 0) this.room[row * this.columns + column] = FREE;
      }
  }

  close({ from, to }: Wall): void {
    const steps = Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / (this.cell / 3)) + 1;
    for (let i = 0; i <= steps; ++i) {
      const cell = this.at(from[0] + ((to[0] - from[0]) * i) / steps, from[1] + ((to[1] - from[1]) * i) / steps);
      if (cell >= 0) this.room[cell] = OUTSIDE;
    }
  }

  /** All rooms grow at the same speed from their centres. */
  flood(centers: { room: number; center: Vec3 }[]): void {
    const queue: number[] = [];
    for (const { room, center } of centers) {
      const cell = this.at(center[0], center[1]);
      if (cell < 0 || this.room[cell] !== FREE) continue;
      this.room[cell] = room;
      queue.push(cell);
    }
    for (let head = 0; head < queue.length; ++head) {
      const cell = queue[head]!;
      const column = cell % this.columns;
      const next = [column > 0 ? cell - 1 : -1, column + 1 < this.columns ? cell + 1 : -1, cell - this.columns, cell + this.columns];
      for (const n of next) {
        if (n < 0 || n >= this.room.length || this.room[n] !== FREE) continue;
        this.room[n] = this.room[cell]!;
        queue.push(n);
      }
    }
  }

  strips(): Cell[] {
    const found: Cell[] = [];
    for (let row = 0; row < this.rows; ++row)
      for (let column = 0; column < this.columns; ) {
        const room = this.room[row * this.columns + column]!;
        let end = column + 1;
        while (end < this.columns && this.room[row * this.columns + end] === room) ++end;
        if (room >= 0) found.push({ room, x: this.min[0] + column * this.cell, y: this.min[1] + row * this.cell, width: (end - column) * this.cell, depth: this.cell });
        column = end;
      }
    return found;
  }
}

export function room_cells(floor: [Vec3, Vec3, Vec3][], walls: Wall[], centers: { room: number; center: Vec3 }[]): Cell[] {
  const all = floor.flat();
  if (all.length === 0) return [];
  const extent = (k: 0 | 1) => all.reduce<[number, number]>(([lo, hi], p) => [Math.min(lo, p[k]), Math.max(hi, p[k])], [Infinity, -Infinity]);
  const [x, y] = [extent(0), extent(1)];
  const map = new CellMap([x[0], y[0]], [x[1], y[1]], Math.max(0.05, Math.max(x[1] - x[0], y[1] - y[0]) / LARGEST));
  floor.forEach((t) => map.open(t));
  walls.forEach((w) => map.close(w));
  map.flood(centers);
  return map.strips();
}
