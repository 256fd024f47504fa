// Numbers as a reader wants them: three significant digits, units apart by a narrow no-break space.

export function threeDigits(value: number): string {
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size >= 100) return Math.round(value).toString();
  if (size < 0.01) return value.toPrecision(2);
  return Number(value.toPrecision(3)).toString();
}

export const withUnit = (value: number, unit: string): string => `${threeDigits(value)}\u202f${unit}`;

// Of a fraction.
export function percent(fraction: number): string {
  const value = 100 * fraction;
  return `${value.toFixed(value > 0 && value < 9.95 ? 1 : 0)}\u202f%`;
}

export function exposureValue(value: number | null): string {
  return value === null ? "–" : value.toFixed(1);
}

export function duration(seconds: number): string {
  if (seconds < 60) return `${Math.max(1, Math.round(seconds))}\u202fs`;
  const minutes = Math.round(seconds / 60);
  return minutes < 60 ? `${minutes}\u202fmin` : `${Math.floor(minutes / 60)}\u202fh ${minutes % 60}\u202fmin`;
}

export function bytes(count: number): string {
  return count < 1e6 ? withUnit(count / 1e3, "kB") : withUnit(count / 1e6, "MB");
}

// 17.5 as 17:30.
export function clock(hour: number): string {
  const minutes = Math.round(hour * 60);
  return `${String(Math.floor(minutes / 60)).padStart(2, "0")}:${String(minutes % 60).padStart(2, "0")}`;
}

export function roundTo(value: number, step: number): number {
  return Number((Math.round(value / step) * step).toFixed(6));
}
