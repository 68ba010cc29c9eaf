// SPDX-License-Identifier: Apache-2.0
// The page: a scene, a sun, the picture as it grows, its hash beside the native program's.
// in: scenes.json (tools/web), the reader's choice -> out: messages to worker.js, pixels on the canvas
// docs/web.md
"use strict";

const at = (id) => document.getElementById(id);
const worker = new Worker("worker.js");
let scenes = [], number = 0;

const chosen = () => scenes.find((scene) => scene.name === at("scene").value);

/** What the native program drew under this sun; "" where it was not asked. */
function nativeHash() {
    const elevation = Number(at("elevation").value), azimuth = Number(at("azimuth").value);
    const sun = chosen().suns.find((s) => s.elevation === elevation && s.azimuth === azimuth);
    return sun === undefined ? "" : sun.hash;
}

function draw() {
    const elevation = Number(at("elevation").value), azimuth = Number(at("azimuth").value);
    at("elevation-text").textContent = elevation + "°";
    at("azimuth-text").textContent = azimuth + "°";
    at("native").textContent = nativeHash() || "not made for this sun";
    at("hash").textContent = at("verdict").textContent = "";
    at("progress").textContent = "preparing";
    worker.postMessage({ number: ++number, scene: chosen(), elevation, azimuth });
}

/** Puts the sliders where the native hash is known. */
function place(sun) {
    at("elevation").value = sun.elevation;
    at("azimuth").value = sun.azimuth;
    draw();
}

function choose() {
    at("suns").replaceChildren(...chosen().suns.map((sun) => {
        const button = document.createElement("button");
        button.textContent = `${sun.elevation}°, ${sun.azimuth}°`;
        button.onclick = () => place(sun);
        return button;
    }));
    place(chosen().suns[0]);
}

worker.onmessage = ({ data }) => {
    if (data.number !== number) return;
    if (data.fault !== "") {
        at("progress").textContent = data.fault;
        at("verdict").textContent = "fault";
        return;
    }
    const canvas = at("picture");
    canvas.width = data.width;
    canvas.height = data.height;
    canvas.getContext("2d").putImageData(
        new ImageData(new Uint8ClampedArray(data.pixels.buffer), data.width, data.height), 0, 0);
    const seconds = data.seconds.toFixed(1) + " s";
    at("progress").textContent = data.units > 0 ? `${data.done} of ${data.units}, ${seconds}` : seconds;
    if (!data.whole) return;
    at("hash").textContent = data.hash;
    const native = nativeHash();
    at("verdict").textContent = native === "" ? "" : native === data.hash ? "equal" : "different";
};

fetch("scenes.json").then((answer) => answer.json()).then((rows) => {
    scenes = rows;
    at("scene").replaceChildren(...rows.map((scene) => new Option(scene.title, scene.name)));
    at("scene").onchange = choose;
    at("elevation").onchange = at("azimuth").onchange = draw;
    choose();
});
