// Moved things that run into others: where that is seen, and in words.
import type { Model } from "./model.js";
import type { Box, Thing } from "./protocol.js";

const kMostNamed = 2; // pairs; more make the line too long

interface Pair {
  readonly thing: Thing;
  readonly into: Thing;
}

function pairsOf({ overlaps, things }: Model): Pair[] {
  return overlaps.flatMap(({ object, into }) => {
    const pair = { thing: things.get(object), into: things.get(into) };
    return pair.thing && pair.into ? [{ thing: pair.thing, into: pair.into }] : [];
  });
}

function shared(a: Box, b: Box): Box {
  const pick = (choose: (...values: number[]) => number, p: Box["low"], q: Box["low"]) =>
    [choose(p[0], q[0]), choose(p[1], q[1]), choose(p[2], q[2])] as const;
  return { low: pick(Math.max, a.low, b.low), high: pick(Math.min, a.high, b.high) };
}

// Boxes to be drawn; of walls and what else is as large as a room only where the thing is.
export function overlapBoxes(model: Model): Box[] {
  return pairsOf(model).flatMap(({ thing, into }) => [thing, into.movable ? into : shared(thing, into)]);
}

// One line that names them; null where there are none.
export function overlapWords(model: Model): string | null {
  const pairs = pairsOf(model);
  if (pairs.length === 0) return null;
  const named = pairs.slice(0, kMostNamed).map(({ thing, into }) => `${thing.name} runs into ${into.name}`);
  const more = pairs.length - named.length;
  return named.join(", ") + (more > 0 ? `, and ${more} more` : "");
}
