// What the messages' schemas share. Data from the network that does not follow them is a BadMessage.
import * as v from "valibot";

export class BadMessage extends Error {}

type Frozen<T> = T extends object ? { readonly [K in keyof T]: Frozen<T[K]> } : T;
export type Checked<S extends v.GenericSchema> = Frozen<v.InferOutput<S>>;

export const real = v.pipe(v.number(), v.finite()); // JSON may hold 1e999
export const whole = v.pipe(v.number(), v.integer());
export const pair = v.strictTuple([real, real]);
export const triple = v.strictTuple([real, real, real]);

// Throws BadMessage with the path of what is wrong. Keys that are not in the schema are passed over: a newer server may
// tell more.
export function check<S extends v.GenericSchema>(schema: S, value: unknown): Checked<S> {
  const result = v.safeParse(schema, value, { abortEarly: true });
  if (result.success) return result.output as Checked<S>;
  const issue = result.issues[0];
  throw new BadMessage(`${v.getDotPath(issue) ?? "message"}: ${issue.message}`);
}
