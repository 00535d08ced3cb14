// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Light or dark: as the system has it, until someone chooses.
export type Theme = 'dark' | 'light';

const system = matchMedia('(prefers-color-scheme: dark)');

export const effective_theme = (chosen: Theme | null): Theme => chosen ?? (system.matches ? 'dark' : 'light');

export function set_theme(chosen: Theme | null): void {
  document.documentElement.dataset.theme = effective_theme(chosen);
}

export function on_system_theme(f: () => void): void {
  system.addEventListener('change', f);
}

const of_style = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** The colour behind the picture. */
export const paper = (): string => of_style('--paper');
export const ink = (): string => of_style('--text');
