// The program under test, and its scene in a folder of its own.

import { spawn } from "node:child_process";
import { chmodSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const SCENE = `// A ball on a floor.
Scene(
    camera: Camera(position: (0, 1, 6), look_at: (0, 1, 0), fov: 40),
    image: Image(width: 320, height: 240),
    render: Render(samples: 16),
    background: (0.6, 0.7, 0.9),
    objects: [
        Sphere(center: (0, 1, 0), radius: 1, material: Diffuse(albedo: (0.9, 0.2, 0.1))),
        Rectangle(center: (0, 0, 0), normal: (0, 1, 0), size: (20, 20)),
    ],
)
`;

/** Waits until this is true and throws nothing. */
export async function wait(what, name) {
  const began = Date.now();
  for (;;) {
    try {
      if (await what()) return;
    } catch {
      // Not yet.
    }
    if (Date.now() - began > 60000) throw new Error(`in vain: ${name}`);
    await new Promise((done) => setTimeout(done, 20));
  }
}

export class Program {
  constructor(root, folder) {
    this.binary = process.env.TRACER ?? join(root, "target/debug/tracer");
    this.folder = folder;
    this.scene = join(folder, "scene.ron");
  }

  async start() {
    this.renameSave(SCENE);
    // An editor that writes down what it was asked to open.
    const editor = join(this.folder, "editor.sh");
    writeFileSync(editor, `#!/bin/sh\necho "$@" >> "$(dirname "$0")/opened"\n`);
    chmodSync(editor, 0o755);
    this.child = spawn(this.binary, ["preview", this.scene, "--editor", `${editor} {file} {line} {column}`]);
    let said = "";
    this.child.stdout.on("data", (bytes) => (said += bytes));
    this.child.stderr.on("data", (bytes) => process.env.PREVIEW_TALK && process.stderr.write(bytes));
    await wait(() => /^http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/\n/.test(said), "the address is printed");
    this.address = said.trim();
  }

  /** Saves as most editors do. */
  renameSave(text) {
    const other = join(this.folder, ".scene.ron.swp");
    writeFileSync(other, text);
    renameSync(other, this.scene);
  }

  remove() {
    rmSync(this.scene);
  }

  async end() {
    if (!this.child || this.child.exitCode !== null || this.child.signalCode !== null) return;
    const ended = new Promise((done) => this.child.once("exit", done));
    this.child.kill("SIGINT");
    await ended;
  }
}
