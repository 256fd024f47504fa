// Small checks that turn unknown data from the network into typed values, or throw BadMessage with the path of what is
// wrong.

export class BadMessage extends Error {}

export type Check<T> = (value: unknown, at: string) => T;
export type Checked<C> = C extends Check<infer T> ? T : never;

function refuse(at: string, wanted: string, value: unknown): never {
  const seen =
    value === null ? "null" : Array.isArray(value) ? "a list" : value === undefined ? "nothing" : `a ${typeof value}`;
  throw new BadMessage(`${at || "message"}: expected ${wanted}, got ${seen}`);
}

export const text: Check<string> = (value, at) => (typeof value === "string" ? value : refuse(at, "a text", value));

export const flag: Check<boolean> = (value, at) =>
  typeof value === "boolean" ? value : refuse(at, "true or false", value);

export const real: Check<number> = (value, at) =>
  typeof value === "number" && Number.isFinite(value) ? value : refuse(at, "a number", value);

export const whole: Check<number> = (value, at) =>
  typeof value === "number" && Number.isInteger(value) ? value : refuse(at, "a whole number", value);

export function literal<const T extends string>(...choices: readonly T[]): Check<T> {
  return (value, at) => {
    const found = choices.find(choice => choice === value);
    return found ?? refuse(at, `one of ${choices.join(", ")}`, value);
  };
}

export function nullable<T>(check: Check<T>): Check<T | null> {
  return (value, at) => (value === null ? null : check(value, at));
}

// Absent is allowed; null is not, unless the inner check allows it.
export function optional<T>(check: Check<T>): Check<T | undefined> {
  return (value, at) => (value === undefined ? undefined : check(value, at));
}

export function either<A, B>(first: Check<A>, second: Check<B>): Check<A | B> {
  return (value, at) => {
    try {
      return first(value, at);
    } catch {
      return second(value, at);
    }
  };
}

export function listOf<T>(check: Check<T>): Check<readonly T[]> {
  return (value, at) =>
    Array.isArray(value) ? value.map((item, i) => check(item, `${at}[${i}]`)) : refuse(at, "a list", value);
}

export const triple: Check<readonly [number, number, number]> = (value, at) =>
  Array.isArray(value) && value.length === 3
    ? [real(value[0], `${at}[0]`), real(value[1], `${at}[1]`), real(value[2], `${at}[2]`)]
    : refuse(at, "three numbers", value);

export const pair: Check<readonly [number, number]> = (value, at) =>
  Array.isArray(value) && value.length === 2
    ? [real(value[0], `${at}[0]`), real(value[1], `${at}[1]`)]
    : refuse(at, "two numbers", value);

type Shape = Record<string, Check<unknown>>;
type OptionalKeys<S extends Shape> = { [K in keyof S]: undefined extends Checked<S[K]> ? K : never }[keyof S];
export type ShapeOf<S extends Shape> = { readonly [K in Exclude<keyof S, OptionalKeys<S>>]: Checked<S[K]> } & {
  readonly [K in OptionalKeys<S>]?: Checked<S[K]>;
};

// Keys that are not in the shape are passed over: a newer server may tell more.
export function shape<S extends Shape>(checks: S): Check<ShapeOf<S>> {
  return (value, at) => {
    if (typeof value !== "object" || value === null || Array.isArray(value)) refuse(at, "an object", value);
    const source = value as Record<string, unknown>;
    const result: Record<string, unknown> = {};
    for (const [key, check] of Object.entries(checks)) {
      const checked = check(source[key], at ? `${at}.${key}` : key);
      if (checked !== undefined) result[key] = checked;
    }
    return result as ShapeOf<S>;
  };
}
