// SPDX-License-Identifier: Apache-2.0
// Hands the program's module to Emscripten's loader, which takes node's fetch for a browser's.
// in: pileus.wasm beside the script -> out: Module.wasmBinary
// docs/web.md
Module["wasmBinary"] = require("fs").readFileSync(__filename.replace(/js$/, "wasm"));
