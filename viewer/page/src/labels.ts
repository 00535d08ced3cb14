// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Words in the picture: page elements over the canvas, moved after each frame. Those that would cover an earlier one hide.
import type { Vector3 } from 'three';
import type { Cameras } from './camera';

interface Label {
  element: HTMLElement;
  place: Vector3; // in the scene's axes
}

export class Labels {
  private readonly groups = new Map<string, Label[]>();
  private placed: { text: string[]; x: number; y: number }[] = [];

  constructor(
    private readonly layer: HTMLElement,
    private readonly cameras: Cameras,
  ) {}

  /** Shows these labels, in place of those of the same group. */
  set(group: string, labels: { text: string; place: Vector3 }[]): void {
    for (const label of this.groups.get(group) ?? []) label.element.remove();
    this.groups.set(group, labels.map(({ text, place }) => {
      const element = document.createElement('div');
      element.className = `label ${group}`;
      element.textContent = text;
      this.layer.append(element);
      return { element, place };
    }));
  }

  update(): void {
    const taken: DOMRect[] = [];
    const frame = this.layer.getBoundingClientRect();
    this.placed = [];
    for (const { element, place } of [...this.groups.values()].flat()) {
      const at = this.cameras.project(place);
      element.hidden = !at;
      if (!at) continue;
      element.style.transform = `translate(${at[0] - frame.left}px, ${at[1] - frame.top}px) translate(-50%, -50%)`;
      const box = element.getBoundingClientRect();
      const covered = taken.some((t) => t.left < box.right && box.left < t.right && t.top < box.bottom && box.top < t.bottom);
      element.hidden = covered;
      if (covered) continue;
      taken.push(box);
      this.placed.push({ text: (element.textContent ?? '').split('\n'), x: at[0] - frame.left, y: at[1] - frame.top });
    }
  }

  /** Writes the labels into a picture that is to be saved. */
  draw(context: CanvasRenderingContext2D, scale: number, ink: string, paper: string): void {
    context.font = `${13 * scale}px system-ui, sans-serif`;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.lineWidth = 4 * scale;
    context.strokeStyle = paper;
    context.fillStyle = ink;
    for (const { text, x, y } of this.placed)
      text.forEach((line, i) => {
        const at = [x * scale, (y + 17 * (i - (text.length - 1) / 2)) * scale] as const;
        context.strokeText(line, ...at);
        context.fillText(line, ...at);
      });
  }
}
