import { defineConfig } from "vite";
import { onePage } from "./vite.one_file.mjs";

// No whole page: what reports carry at their end.
export default defineConfig(onePage("reports", "dist-reports"));
