// Looks of the controls, shared by all components.
import { css } from "lit";

export const controls = css`
  :host {
    display: block;
    box-sizing: border-box;
  }
  *,
  *::before,
  *::after {
    box-sizing: inherit;
  }
  [hidden] {
    display: none !important;
  }
  h2,
  h3,
  p {
    margin: 0;
  }
  h2 {
    font-size: 14px;
    font-weight: 600;
  }
  h3 {
    font-size: 12px;
    font-weight: 600;
    color: var(--muted);
  }
  .muted {
    color: var(--muted);
  }
  .stack {
    display: grid;
    gap: 10px;
  }
  .row {
    display: flex;
    align-items: center;
    gap: 8px;
  }
  .row > .grow {
    flex: 1;
    min-width: 0;
  }
  .field {
    display: grid;
    gap: 4px;
  }
  .two {
    display: grid;
    grid-template-columns: repeat(auto-fit, minmax(max(120px, 40%), 1fr));
    gap: 10px;
  }
  .number {
    font-variant-numeric: tabular-nums;
  }
  button,
  input,
  select {
    font: inherit;
    color: inherit;
  }
  button,
  select,
  input:not([type="range"], [type="checkbox"], [type="color"]) {
    min-height: 30px;
    padding: 4px 10px;
    border: 1px solid var(--control-line);
    border-radius: 5px;
    background: var(--raised);
  }
  input:not([type="range"], [type="checkbox"], [type="color"]) {
    width: 100%;
    min-width: 0;
    background: var(--ground);
  }
  input[type="number"] {
    padding-right: 4px;
  }
  select {
    width: 100%;
    min-width: 0;
  }
  button {
    cursor: pointer;
  }
  button:hover:not(:disabled) {
    background: #383838;
  }
  button:disabled {
    color: #7c7c7c;
    border-color: var(--line);
    cursor: default;
  }
  button.main {
    color: var(--on-accent);
    background: var(--accent);
    border-color: var(--accent);
    font-weight: 600;
  }
  button.main:hover:not(:disabled) {
    background: #ffd07e;
  }
  button.main:disabled {
    color: #7c7c7c;
    background: var(--raised);
    border-color: var(--line);
  }
  button[aria-pressed="true"],
  button[aria-checked="true"] {
    color: var(--accent);
    border-color: var(--accent);
  }
  button.plain {
    border-color: transparent;
    background: none;
  }
  :focus-visible {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }
  input[type="range"] {
    width: 100%;
    height: 24px;
    margin: 0;
    background: none;
    appearance: none;
    -webkit-appearance: none;
  }
  input[type="range"]::-webkit-slider-runnable-track {
    height: 4px;
    border-radius: 2px;
    background: var(--track, #565656);
  }
  input[type="range"]::-moz-range-track {
    height: 4px;
    border-radius: 2px;
    background: var(--track, #565656);
  }
  input[type="range"]::-webkit-slider-thumb {
    -webkit-appearance: none;
    width: 16px;
    height: 16px;
    margin-top: -6px;
    border: 2px solid var(--ground);
    border-radius: 50%;
    background: var(--text);
  }
  input[type="range"]::-moz-range-thumb {
    width: 14px;
    height: 14px;
    border: 2px solid var(--ground);
    border-radius: 50%;
    background: var(--text);
  }
  input[type="range"]:disabled {
    opacity: 0.4;
  }
  input[type="checkbox"] {
    width: 16px;
    height: 16px;
    margin: 0;
    accent-color: var(--accent);
  }
  input[type="color"] {
    width: 44px;
    height: 28px;
    padding: 1px;
    border: 1px solid var(--control-line);
    border-radius: 5px;
    background: none;
  }
  label.check {
    display: flex;
    align-items: center;
    gap: 8px;
    min-height: 28px;
  }
  .segments {
    display: flex;
  }
  .segments button {
    flex: 1;
    min-width: 0;
    padding: 4px 4px;
    border-radius: 0;
    margin-left: -1px;
  }
  .segments button:first-child {
    border-radius: 5px 0 0 5px;
    margin-left: 0;
  }
  .segments button:last-child {
    border-radius: 0 5px 5px 0;
  }
  .segments button[aria-checked="true"] {
    position: relative;
    z-index: 1;
  }
  .swatch {
    flex: none;
    width: 14px;
    height: 14px;
    border: 1px solid rgb(255 255 255 / 25%);
    border-radius: 50%;
  }
  .section {
    display: grid;
    gap: 10px;
    padding: 14px 16px;
    border-bottom: 1px solid var(--line);
  }
  @media (max-width: 760px) and (max-height: 520px) {
    .segments button {
      flex: 1 0 auto; /* the panel is narrow there: as wide as their words */
    }
  }
  @media (pointer: coarse) {
    button,
    select,
    input:not([type="range"], [type="checkbox"], [type="color"]) {
      min-height: 40px;
    }
    input[type="range"] {
      height: 34px;
    }
    input:not([type="range"]) {
      font-size: 16px; /* below that, phones zoom into the page */
    }
  }
`;
