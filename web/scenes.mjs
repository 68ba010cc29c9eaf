// SPDX-License-Identifier: Apache-2.0
// Writes the page's scenes: their texts, and the hashes of the native program under some suns.
// in: the native program web_hash -> out: scenes.json, of the rows in web/scenes.json
// docs/web.md; tools/web
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";

const [program] = process.argv.slice(2);
const rows = JSON.parse(readFileSync("web/scenes.json", "utf8"));
const scenes = rows.map(({ name, title, file, overrides, irradiance, suns }) => ({
    name, title, overrides, irradiance, text: readFileSync(file, "utf8"),
    suns: suns.map(([elevation, azimuth]) => ({
        elevation, azimuth,
        hash: execFileSync(program, [file, overrides.join("\n"), elevation, azimuth, ...irradiance],
            { encoding: "utf8" }).trim(),
    })),
}));
process.stdout.write(JSON.stringify(scenes) + "\n");
