// Puts the script and the style into the page: it is one file that opens without a server.
const inOneFile = {
  name: "in-one-file",
  enforce: "post",
  generateBundle(_, bundle) {
    const page = bundle["index.html"];
    const take = name => {
      const file = bundle[name.replace(/^\.\//, "")];
      delete bundle[file.fileName];
      return file.code ?? file.source;
    };
    page.source = page.source
      .replace(/<link rel="stylesheet"[^>]* href="([^"]+)">/, (_, name) => `<style>${take(name)}</style>`)
      .replace(/<script type="module"[^>]* src="([^"]+)"><\/script>/, (_, name) => {
        const code = take(name).replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
        return `<script type="module">${code}</script>`;
      });
    const left = Object.keys(bundle).filter(name => name !== "index.html");
    if (left.length > 0) this.error(`files beside the page: ${left.join(", ")}`);
  },
};

// A page of folder `root`, built into one file in `outDir`.
export const onePage = (root, outDir) => ({
  root,
  base: "./",
  publicDir: false,
  plugins: [inOneFile],
  build: {
    outDir: `../${outDir}`,
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    chunkSizeWarningLimit: 2000,
  },
});
