import { defineConfig } from "vite";
import { onePage } from "./vite.one_file.mjs";

export default defineConfig(onePage("baked", "dist-baked"));
