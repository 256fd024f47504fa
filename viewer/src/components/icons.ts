// Drawings of the tool bar's buttons, 20 by 20, in the colour of their text.
import { html, svg } from "lit";

const icon = (path: string) =>
  html`<svg
    width="20"
    height="20"
    viewBox="0 0 20 20"
    fill="none"
    stroke="currentColor"
    stroke-width="1.6"
    stroke-linecap="round"
    stroke-linejoin="round"
    aria-hidden="true"
  >
    ${svg`<path d=${path}></path>`}
  </svg>`;

export const undoIcon = icon("M4 8h8a4 4 0 0 1 0 8H8M7 4L3.5 8L7 12");
export const redoIcon = icon("M16 8H8a4 4 0 0 0 0 8h4M13 4l3.500 4L13 12");
export const meterIcon = icon("M4 14a7 7 0 1 1 12 0M10 13l3-5M7 16h6");
export const saveIcon = icon("M10 3v9M6.500 9L10 12.500L13.500 9M4 15.500h12");
export const walkIcon = icon(
  "M10.500 3.500a1 1 0 1 1 0 .1M7 18l2.500-5L9 8l3 2l2.500 .5M9 8L6.500 10.500M9.700 12.500L12.500 14.500L13 18",
);
export const orbitIcon = icon(
  "M10 8.500a1.500 1.500 0 1 1 0 3a1.500 1.500 0 1 1 0-3M2.500 10c0-2 3.400-3.600 7.500-3.600s7.500 1.600 7.500 3.600" +
    "s-3.400 3.600-7.500 3.600c-1.500 0-2.900-.2-4-.6M4 11.500L6 13l-1.500 2",
);
export const helpIcon = icon("M7.300 7.300a2.700 2.700 0 1 1 4 2.400c-.9 .5-1.300 1-1.300 2M10 14.700v.1");
