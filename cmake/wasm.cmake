# SPDX-License-Identifier: Apache-2.0
# Toolchain: WebAssembly by Debian's Emscripten; programs run in node, the library in browsers, too.
# in: em++ on the path -> out: a cross build, of 32 bits, with vectors of 128 bits
# docs/web.md; preset wasm; tools/web
set(EMSCRIPTEN_SYSTEM_PROCESSOR wasm32)
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
# Header-only libraries are the host's (PileusLibraries.cmake links them by name); nothing else of it is seen.
set(CMAKE_SYSTEM_INCLUDE_PATH /usr/include)
# Exceptions are the machine's own: those made by JavaScript cost every call.
add_compile_options(-msimd128 -fwasm-exceptions)
# Vectors that Clang 14 makes by itself at -O2 give other bits (tables of sky maps); ours are written as vectors.
add_compile_options(-fno-vectorize -fno-slp-vectorize)
add_link_options(-msimd128 -fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)
# Emscripten asks node for Debian's acorn.
set(CMAKE_CXX_LINKER_LAUNCHER "${CMAKE_COMMAND};-E;env;NODE_PATH=/usr/share/nodejs")
