// pack.js FILE.wasm FILE.txt - packs a library with gzip, and writes it as text (base64).
const fs = require("fs");
const [from, to] = process.argv.slice(2);
fs.writeFileSync(to, require("zlib").gzipSync(fs.readFileSync(from), { level: 9 }).toString("base64"));
