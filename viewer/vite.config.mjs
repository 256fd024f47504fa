import { defineConfig } from "vite";

// The server's content-security policy allows nothing inline: every asset is a file, and the preload polyfill is left out.
export default defineConfig({
  base: "./",
  build: {
    outDir: "dist",
    target: "es2022",
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
  },
});
