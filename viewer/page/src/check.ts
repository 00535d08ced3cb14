// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads JSON that may be anything, and says where it is not what it should be.

/** What is wrong with the data, in words for whoever opened the page. */
export class Fault extends Error {}

export type Vec3 = [number, number, number];
export type Vec4 = [number, number, number, number];

function shown(value: unknown): string {
  if (value === undefined) return 'missing';
  const text = JSON.stringify(value) ?? String(value);
  return text.length > 60 ? `${text.slice(0, 57)}...` : text;
}

/** A value in a document together with the way to it, for messages. */
export class Place {
  constructor(
    readonly value: unknown,
    readonly path: string,
    readonly file: string,
  ) {}

  fail(why: string): never {
    throw new Fault(`${this.file}: ${this.path ? `${this.path} is ${shown(this.value)}: ` : ''}${why}`);
  }

  get present(): boolean {
    return this.value !== undefined && this.value !== null;
  }

  at(key: string): Place {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.fail('it should be an object');
    return new Place((this.value as Record<string, unknown>)[key], this.path ? `${this.path}.${key}` : key, this.file);
  }

  keys(): string[] {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.fail('it should be an object');
    return Object.keys(this.value as object);
  }

  list(): Place[] {
    if (!Array.isArray(this.value)) this.fail('it should be a list');
    return (this.value as unknown[]).map((v, i) => new Place(v, `${this.path}[${i}]`, this.file));
  }

  /** The list, or none where the key is missing. */
  any(): Place[] {
    return this.value === undefined || this.value === null ? [] : this.list();
  }

  number(): number {
    if (typeof this.value !== 'number' || !Number.isFinite(this.value)) this.fail('it should be a finite number');
    return this.value as number;
  }

  text(): string {
    if (typeof this.value !== 'string') this.fail('it should be text');
    return this.value as string;
  }

  one_of<T extends string>(choices: readonly T[]): T {
    if (!choices.includes(this.value as T)) this.fail(`it should be one of ${choices.join(', ')}`);
    return this.value as T;
  }

  whole(): number {
    if (!Number.isInteger(this.value) || (this.value as number) < 0) this.fail('it should be a whole number, 0 or more');
    return this.value as number;
  }

  /** An index into something of which there are count. */
  index(count: number, what: string): number {
    if (!Number.isInteger(this.value) || (this.value as number) < 0 || (this.value as number) >= count) this.fail(`there are ${count} ${what}`);
    return this.value as number;
  }

  numbers<T extends number[]>(count: number): T {
    const list = this.list();
    if (list.length !== count) this.fail(`it should be ${count} numbers`);
    return list.map((p) => p.number()) as T;
  }

  vec3(): Vec3 {
    return this.numbers<Vec3>(3);
  }

  optional<T>(read: (p: Place) => T): T | null {
    return this.present ? read(this) : null;
  }
}

/** Checks which schema a document says that it follows. */
export function check_schema(root: Place, name: string, what: string, newest = 1): void {
  if (typeof root.value !== 'object' || root.value === null || Array.isArray(root.value)) throw new Fault(`${root.file}: this is not ${what}: it is not a JSON object`);
  const schema = root.at('schema');
  if (!schema.present) throw new Fault(`${root.file}: this is not ${what}: it has no key 'schema'`);
  if (schema.at('name').value !== name) throw new Fault(`${root.file}: this is not ${what}: its schema is ${shown(schema.at('name').value)}, not "${name}"`);
  const version = schema.at('version').value;
  if (version !== 1 && version !== newest) throw new Fault(`${root.file}: version ${shown(version)}: this page shows version ${newest}`);
}

export function parse(text: string, file: string): Place {
  try {
    return new Place(JSON.parse(text), '', file);
  } catch (e) {
    throw new Fault(`${file}: this is not JSON: ${(e as Error).message}`);
  }
}
