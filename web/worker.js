// SPDX-License-Identifier: Apache-2.0
// Draws one picture after another with the module, off the page's thread; node loads it, too.
// in: messages { number, scene, elevation, azimuth } -> out: messages with pixels and hash, step by step
// docs/web.md
"use strict";

/** The module's functions by their names without "web_"; `options` are Emscripten's. */
async function loadPileus(create, options) {
    const module = await create(options);
    const call = (name, result, types) => (...values) => module.ccall("web_" + name, result, types, values);
    const one = ["number"];
    return {
        open: call("open", "number", ["string", "string"]),
        close: call("close", null, one),
        fault: call("fault", "string", one),
        begin: call("begin", null, Array(6).fill("number")),
        units: call("units", "number", one),
        step: call("step", null, ["number", "number"]),
        draw: call("draw", null, one),
        width: call("width", "number", one),
        height: call("height", "number", one),
        hash: call("hash", "string", one),
        pixels(picture) {
            const at = module.ccall("web_pixels", "number", one, [picture]);
            return module.HEAPU8.slice(at, at + 4 * this.width(picture) * this.height(picture));
        },
    };
}

/** A picture that grows: yields { share, fault, ... } after every unit of light; the last one is whole. */
function* growingPicture(pileus, picture, scene, elevation, azimuth) {
    pileus.begin(picture, elevation, azimuth, ...scene.irradiance);
    const units = pileus.units(picture);
    for (let done = Math.min(units, 1); done <= units; ++done) {
        if (units > 0) pileus.step(picture, 1);
        pileus.draw(picture);
        const fault = pileus.fault(picture);
        yield {
            fault, whole: done === units || fault !== "", done, units, hash: pileus.hash(picture),
            width: pileus.width(picture), height: pileus.height(picture),
            pixels: fault === "" ? pileus.pixels(picture) : null,
        };
        if (fault !== "") return;
    }
}

if (typeof module === "object") {
    module.exports = { loadPileus, growingPicture };
} else {
    importScripts("pileus_web.js");
    const loading = loadPileus(pileusModule, {});
    let asked = null, open = null;

    // One message at a time; a later one ends the picture that is being drawn.
    const draw = async () => {
        const pileus = await loading, mine = asked;
        if (open === null || open.name !== mine.scene.name) {
            if (open !== null) pileus.close(open.picture);
            open = { name: mine.scene.name, picture: pileus.open(mine.scene.text, mine.scene.overrides.join("\n")) };
        }
        const began = performance.now();
        for (const now of growingPicture(pileus, open.picture, mine.scene, mine.elevation, mine.azimuth)) {
            postMessage({ ...now, number: mine.number, seconds: (performance.now() - began) / 1000 });
            await new Promise((resume) => setTimeout(resume, 0));
            if (asked !== mine) return draw();
        }
        asked = null;
    };
    onmessage = ({ data }) => {
        const idle = asked === null;
        asked = data;
        if (idle) draw().catch((error) => postMessage({ number: data.number, fault: String(error), whole: true }));
    };
}
