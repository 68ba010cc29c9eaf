// SPDX-License-Identifier: Apache-2.0
// Tries the page: every scene in node, then in Chromium where there is one, told over its debugging pipe.
// in: the built folder, a port, Chromium or "" -> out: a line a picture; exit 1 where a hash is not the native one
// docs/web.md; tools/web
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import path from "node:path";

const [folder, port, chromium] = process.argv.slice(2);
const scenes = JSON.parse(readFileSync(path.join(folder, "scenes.json"), "utf8"));
const require = createRequire(import.meta.url);
let faults = 0;

function tell(where, scene, sun, hash, seconds, note) {
    const same = hash === sun.hash;
    if (!same) ++faults;
    console.log(`${where.padEnd(9)} ${scene.name.padEnd(13)} ${sun.elevation}, ${sun.azimuth}: ${hash || note} ` +
        `${seconds.toFixed(1)} s${same ? "" : `, FAULT: native ${sun.hash}`}`);
}

async function tryNode() {
    const { loadPileus, growingPicture } = require(path.resolve(folder, "worker.js"));
    const pileus = await loadPileus(require(path.resolve(folder, "pileus_web.js")),
        { wasmBinary: readFileSync(path.join(folder, "pileus_web.wasm")) });
    for (const scene of scenes) {
        const picture = pileus.open(scene.text, scene.overrides.join("\n"));
        for (const sun of scene.suns) {
            const began = performance.now();
            let last = null;
            for (last of growingPicture(pileus, picture, scene, sun.elevation, sun.azimuth));
            tell("node", scene, sun, last.hash, (performance.now() - began) / 1000, last.fault);
        }
        pileus.close(picture);
    }
}

const types = { html: "text/html", js: "text/javascript", wasm: "application/wasm", json: "application/json" };
function serve() {
    const server = createServer((request, answer) => {
        const name = path.basename(request.url === "/" ? "index.html" : request.url);
        try {
            const bytes = readFileSync(path.join(folder, name));
            answer.writeHead(200, { "Content-Type": types[name.split(".").pop()] || "text/plain" }).end(bytes);
        } catch {
            answer.writeHead(404).end();
        }
    });
    return new Promise((ready) => server.listen(Number(port), "127.0.0.1", () => ready(server)));
}

/** Chromium's protocol over descriptors 3 and 4: JSON, each message ended by a zero. */
function talk(child) {
    const waiting = new Map();
    let text = "", next = 0;
    child.stdio[4].on("data", (bytes) => {
        const parts = (text + bytes).split("\0");
        text = parts.pop();
        for (const part of parts) {
            const message = JSON.parse(part);
            if (waiting.has(message.id)) waiting.get(message.id)(message.result || {});
        }
    });
    return (method, params, sessionId) => new Promise((result) => {
        waiting.set(++next, result);
        child.stdio[3].write(JSON.stringify({ id: next, method, params, sessionId }) + "\0");
    });
}

async function tryChromium() {
    const server = await serve();
    const profile = mkdtempSync(path.join(tmpdir(), "pileus-web-"));
    const child = spawn(chromium, ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
        "--remote-debugging-pipe", `--user-data-dir=${profile}`],
        { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    const ended = new Promise((resume) => child.on("exit", resume));
    const send = talk(child);
    const { targetId } = await send("Target.createTarget", { url: `http://127.0.0.1:${server.address().port}/` });
    const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
    const ask = async (expression) =>
        (await send("Runtime.evaluate", { expression, returnByValue: true }, sessionId)).result?.value;
    const until = async (expression) => {
        for (let i = 0; i < 3000; ++i) {
            if (await ask(expression)) return true;
            await new Promise((resume) => setTimeout(resume, 100));
        }
        return false;
    };
    await until(`document.getElementById("scene")?.options.length === ${scenes.length}`);
    for (const scene of scenes)
        for (const [i, sun] of scene.suns.entries()) {
            const began = performance.now();
            await ask(`at("scene").value = "${scene.name}"; choose(); place(chosen().suns[${i}]);`);
            await until(`at("verdict").textContent !== ""`);
            const hash = await ask(`at("hash").textContent`);
            tell("chromium", scene, sun, hash, (performance.now() - began) / 1000, await ask(`at("progress").textContent`));
        }
    await send("Browser.close", {});
    await ended;
    server.close();
    rmSync(profile, { recursive: true, force: true });
}

await tryNode();
if (chromium) await tryChromium();
process.exit(faults === 0 ? 0 : 1);
