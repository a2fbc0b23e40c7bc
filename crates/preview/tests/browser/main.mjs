// `tracer preview` in a real browser. Run by `cargo xtask prove preview`: needs chromium, and playwright-core in target/prove/node.
// With PREVIEW_SHOTS=FOLDER it leaves pictures of the page there, to be looked at.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { Program, SCENE, wait } from "./program.mjs";

const root = fileURLToPath(new URL("../../../../", import.meta.url));
const require = createRequire(join(root, "target/prove/node/"));
const { chromium } = require("playwright-core");

const folder = mkdtempSync(join(tmpdir(), "preview-"));
const shots = process.env.PREVIEW_SHOTS;
if (shots) mkdirSync(shots, { recursive: true });
const shoot = async (page, name) => shots && page.screenshot({ path: join(shots, `${name}.png`) });

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  headless: true,
  args: [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
  ],
});

/** A page that fails the test where its scripts do, or where it asks anybody but the preview. */
async function open(address, settings = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...settings });
  const page = await context.newPage();
  page.on("pageerror", (error) => assert.fail(`the page's script: ${error.stack}`));
  page.on("request", (request) => {
    const url = request.url();
    assert.ok(url.startsWith(address) || /^(data|blob):/.test(url), `the page asks for ${url}`);
  });
  await page.goto(address);
  return page;
}

/** Waits for a phase; for "done" until its last frame has been painted, too. */
async function phase(page, name) {
  await page.waitForFunction((name) => {
    const { phase, frame, newest } = document.body.dataset;
    return phase === name && (name !== "done" || frame === newest);
  }, name, { timeout: 60000 });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}
/** The scene as it was, and its picture. */
async function restore(program, page) {
  program.renameSave(SCENE);
  await page.waitForFunction(() => document.body.dataset.phase !== "done").catch(() => {});
  await phase(page, "done");
}
/** What the canvas shows in the middle of the picture. */
const middle = (page) => page.evaluate(() => {
  const canvas = document.getElementById("picture");
  return [...canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data];
});
const text = (page, id) => page.textContent(`#${id}`);

const tests = {
  async "the picture follows the file"({ program, page }) {
    await phase(page, "done");
    const before = await middle(page);
    assert.ok(before[0] > 1.5 * before[1], `the ball is red: ${before}`);
    await shoot(page, "dark");
    program.renameSave(SCENE.replace("0.9, 0.2, 0.1", "0.1, 0.2, 0.9"));
    await page.waitForFunction(() => {
      const canvas = document.getElementById("picture");
      const [red, , blue] = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data;
      return blue > 1.5 * red;
    }, null, { timeout: 60000 });
    await phase(page, "done");
    const said = await text(page, "figures");
    assert.match(said, /320 x 240, 16 of 16 samples, .*samples\/s, noise/);
    await restore(program, page);
  },

  async "what is wrong lies over the last picture"({ program, page }) {
    await phase(page, "done");
    const before = await middle(page);
    program.renameSave(SCENE.replace("radius: 1,", "radus: 1,"));
    await phase(page, "wrong");
    await page.waitForSelector("#faults:not([hidden])");
    const said = await text(page, "faultList");
    for (const word of ["error[E0201]", "radus: 1", "^^^^^", "did you mean `radius`?", "scene.ron:8"]) {
      assert.ok(said.includes(word), `${word} is not in ${said}`);
    }
    assert.match(await text(page, "faultsTitle"), /^1 error; the picture is that of the last right text/);
    assert.deepEqual(await middle(page), before);
    assert.match(await page.title(), /^! scene.ron/);
    await shoot(page, "dark-error");
    await page.click("#faultList button");
    await wait(() => readFileSync(join(folder, "opened"), "utf8").includes("scene.ron 8 "), "the editor is told the line");
    await page.keyboard.press("e");
    await page.waitForSelector("#faultList", { state: "hidden" });
    program.renameSave(SCENE);
    await phase(page, "done");
    await page.waitForSelector("#faults", { state: "hidden" });
  },

  async "exposure and tone map"({ page }) {
    await phase(page, "done");
    const before = await middle(page);
    await page.focus("#exposure");
    await page.fill("#exposure", "-3");
    await page.waitForFunction((red) => {
      const canvas = document.getElementById("picture");
      return canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data[0] < red / 2;
    }, before[0], { timeout: 60000 });
    assert.equal(await text(page, "exposureShown"), "-3 EV");
    await page.selectOption("#tone", "agx");
    await page.click("#lookReset");
    await page.waitForFunction((before) => {
      const canvas = document.getElementById("picture");
      return [...canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data].join() === before;
    }, before.join(), { timeout: 60000 });
  },

  async "zoom, by keys and by wheel"({ page }) {
    await phase(page, "done");
    await page.focus("#picture");
    await page.keyboard.press("1");
    await page.waitForFunction(() => document.getElementById("zoom").textContent === "100 %");
    // A pixel of the picture is one of the screen.
    const wide = await page.evaluate(() => {
      const canvas = document.getElementById("picture");
      const row = canvas.getContext("2d").getImageData(0, canvas.height / 2, canvas.width, 1).data;
      const edge = [...row.slice(0, 3)].join();
      let count = 0;
      for (let x = 0; x < canvas.width; x++) if ([...row.slice(4 * x, 4 * x + 3)].join() !== edge) count += 1;
      return count;
    });
    assert.equal(wide, 320);
    for (const key of ["+", "+", "-", "ArrowLeft", "ArrowUp"]) await page.keyboard.press(key);
    await page.mouse.move(500, 400);
    await page.mouse.wheel(0, -300);
    await page.waitForFunction(() => parseFloat(document.getElementById("zoom").textContent) > 200);
    await shoot(page, "zoomed");
    await page.keyboard.press("0");
    await page.waitForSelector("#fit[aria-pressed=true]");
  },

  async "saved pictures"({ page }) {
    await phase(page, "done");
    for (const [id, name, magic] of [["savePng", "scene.png", "\x89PNG"], ["saveExr", "scene.exr", "v/1\x01"]]) {
      const [download] = await Promise.all([page.waitForEvent("download"), page.click(`#${id}`)]);
      assert.equal(download.suggestedFilename(), name);
      assert.equal(readFileSync(await download.path()).toString("latin1", 0, 4), magic);
    }
  },

  async "pixels and layers"({ page }) {
    await phase(page, "done");
    // What the pointer met in the tests before is not waited for.
    await page.evaluate(() => document.getElementById("pixelRows").replaceChildren());
    await page.mouse.move(490, 420);
    await page.waitForFunction(() => /objects\[0\] Sphere/.test(document.getElementById("pixelRows").textContent));
    const said = await text(page, "pixelRows");
    for (const word of ["linear RGB", "depth", "normal", "material"]) assert.ok(said.includes(word), `${word}: ${said}`);
    await page.keyboard.press("i");
    const x = Number(/^pixel(\d+), /.exec(said)[1]);
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction((x) => document.getElementById("pixelRows").textContent.startsWith(`pixel${x}, `), x + 1);
    await page.selectOption("#layer", "normal");
    // The ball's middle faces the camera: the blue of normal maps.
    await page.waitForFunction(() => {
      const canvas = document.getElementById("picture");
      const at = [canvas.width / 2 - 30, canvas.height / 2 - 30];
      const [red, , blue] = canvas.getContext("2d").getImageData(...at, 1, 1).data;
      return blue > 200 && red < 180;
    }, null, { timeout: 60000 });
    await shoot(page, "normals");
    await page.selectOption("#layer", "");
    await page.keyboard.press("Escape");
    await page.waitForFunction(() => document.getElementById("inspectFree").disabled);
  },

  async "a state is pinned"({ program, page }) {
    await phase(page, "done");
    await page.focus("#picture");
    await page.keyboard.press("p");
    await page.waitForSelector("#handle:not([hidden])");
    program.renameSave(SCENE.replace("0.9, 0.2, 0.1", "0.1, 0.2, 0.9"));
    // Left of the border the ball is red, right of it blue.
    await page.waitForFunction(() => {
      const canvas = document.getElementById("picture");
      const at = (x) => canvas.getContext("2d").getImageData(canvas.width / 2 + x, canvas.height / 2, 1, 1).data;
      return at(-40)[0] > 1.5 * at(-40)[2] && at(40)[2] > 1.5 * at(40)[0];
    }, null, { timeout: 60000 });
    await shoot(page, "pinned");
    await page.keyboard.press("p");
    await page.waitForSelector("#handle", { state: "hidden" });
    await restore(program, page);
  },

  async "the camera is moved, written and taken back"({ program, page }) {
    await phase(page, "done");
    await page.focus("#picture");
    await page.keyboard.press("c");
    for (let k = 0; k < 4; k++) await page.keyboard.press("ArrowRight");
    await page.keyboard.press("PageUp");
    await page.mouse.move(400, 400);
    await page.mouse.down();
    await page.mouse.move(460, 430, { steps: 6 });
    await page.mouse.up();
    await page.waitForSelector("#cameraWrite:not(:disabled)");
    await phase(page, "done");
    await shoot(page, "moved");
    assert.equal(readFileSync(program.scene, "utf8"), SCENE);
    await page.keyboard.press("w");
    await wait(() => readFileSync(program.scene, "utf8") !== SCENE, "it is written");
    const written = readFileSync(program.scene, "utf8");
    assert.equal(written.replace(/position: \([^)]*\)/, ""), SCENE.replace(/position: \([^)]*\)/, ""));
    await page.waitForSelector("#cameraUndo:not(:disabled)");
    await page.keyboard.press("u");
    await wait(() => readFileSync(program.scene, "utf8") === SCENE, "it is taken back");
    await page.keyboard.press("Escape");
    await page.waitForSelector("#tool[aria-pressed=false]");
    await phase(page, "done");
  },

  async "the keyboard alone"({ page }) {
    await phase(page, "done");
    await page.evaluate(() => document.activeElement?.blur());
    const reached = new Set();
    for (let k = 0; k < 40; k++) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => document.activeElement?.id ?? ""));
    }
    const all = await page.evaluate(() =>
      [...document.querySelectorAll("button, a[href], select, input, canvas")]
        .filter((element) => element.offsetParent !== null && !element.disabled && element.id)
        .map((element) => element.id));
    for (const id of all) assert.ok(reached.has(id), `#${id} is not reached by Tab`);
    await page.keyboard.press("?");
    await page.waitForSelector("dialog[open]");
    await shoot(page, "keys");
    await page.keyboard.press("Escape");
    await page.waitForSelector("dialog", { state: "hidden" });
  },

  async "everything has a name for screen readers"({ page }) {
    await phase(page, "done");
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll("button, a[href], select, input, canvas, progress, section[aria-labelledby]")]
        .filter((element) => !(element.getAttribute("aria-label") || element.textContent.trim() || element.labels?.length))
        .map((element) => element.outerHTML));
    assert.deepEqual(nameless, []);
    assert.match(await page.getAttribute("#picture", "aria-label"), /^Picture of scene.ron, 320 by 240 pixels, 16 samples$/);
  },

  async "two pages, each in its own look"({ program, page }) {
    const other = await open(program.address);
    await phase(other, "done");
    const before = await middle(page);
    await other.fill("#exposure", "-4");
    await other.waitForFunction((red) => {
      const canvas = document.getElementById("picture");
      return canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data[0] < red / 2;
    }, before[0], { timeout: 60000 });
    assert.deepEqual(await middle(page), before);
    await other.context().close();
  },

  async "a phone, and light"({ program }) {
    for (const [name, settings] of [
      ["light", { colorScheme: "light" }],
      ["phone-dark", { viewport: { width: 390, height: 780 }, deviceScaleFactor: 2, hasTouch: true }],
      ["phone-light", { viewport: { width: 390, height: 780 }, deviceScaleFactor: 2, hasTouch: true, colorScheme: "light" }],
    ]) {
      const page = await open(program.address, { colorScheme: "dark", ...settings });
      await phase(page, "done");
      await page.waitForFunction(() => document.body.dataset.frame);
      await page.waitForTimeout(200);
      await shoot(page, name);
      const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(over <= 0, `${name} is ${over} pixels too wide`);
      program.renameSave(SCENE.replace("radius: 1,", "radus: 1, colour: 3,").replace("fov: 40", "fov: 400"));
      await phase(page, "wrong");
      await page.waitForSelector("#faults:not([hidden])");
      await shoot(page, `${name}-error`);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0, `${name} with errors`);
      program.renameSave(SCENE);
      await phase(page, "done");
      await page.context().close();
    }
  },

  async "ten saves in a second, and a file that is gone for a while"({ program, page }) {
    for (let k = 0; k < 10; k++) {
      program.renameSave(SCENE.replace("width: 320", `width: ${321 + k}`));
      await new Promise((done) => setTimeout(done, 90));
    }
    await page.waitForFunction(() => document.getElementById("figures").textContent.startsWith("330 x 240, 16 of 16"), null, { timeout: 60000 });
    program.remove();
    await phase(page, "wrong");
    assert.match(await text(page, "faultList"), /scene.ron is not there any more/);
    program.renameSave(SCENE);
    await phase(page, "done");
  },

  async "a file that is saved in halves"({ program, page }) {
    await phase(page, "done");
    for (const part of [0, 120, SCENE.length / 2]) {
      writeFileSync(program.scene, SCENE.replace("0.9, 0.2, 0.1", "0.1, 0.2, 0.9").slice(0, part));
      await new Promise((done) => setTimeout(done, 60));
    }
    program.renameSave(SCENE.replace("0.9, 0.2, 0.1", "0.1, 0.2, 0.9"));
    await page.waitForFunction(() => {
      const canvas = document.getElementById("picture");
      const [red, , blue] = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data;
      return blue > 1.5 * red;
    }, null, { timeout: 60000 });
    await phase(page, "done");
    await page.waitForSelector("#faults", { state: "hidden" });
    await restore(program, page);
  },

  async "the mouse: wipe, pan, dolly"({ program, page }) {
    await phase(page, "done");
    await page.focus("#picture");
    await page.keyboard.press("p");
    await page.waitForSelector("#handle:not([hidden])");
    program.renameSave(SCENE.replace("0.9, 0.2, 0.1", "0.1, 0.2, 0.9"));
    const at = (x) => page.evaluate((x) => {
      const canvas = document.getElementById("picture");
      return [...canvas.getContext("2d").getImageData(canvas.width / 2 + x, canvas.height / 2, 1, 1).data];
    }, x);
    await wait(async () => (await at(40))[2] > 1.5 * (await at(40))[0], "the new ball is blue");
    const handle = await page.locator("#handle").boundingBox();
    const [x, y] = [handle.x + handle.width / 2, handle.y + handle.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 80, y, { steps: 5 });
    await page.mouse.up();
    // The border has gone past this place: the pinned ball is red there.
    await wait(async () => (await at(40))[0] > 1.5 * (await at(40))[2], "the border follows the mouse");
    await page.keyboard.press("p");
    await restore(program, page);
    // Without the camera's tool the picture is moved.
    await page.keyboard.press("1");
    await page.waitForFunction(() => document.getElementById("zoom").textContent === "100 %");
    const before = await at(0);
    await page.mouse.move(500, 400);
    await page.mouse.down();
    await page.mouse.move(700, 400, { steps: 5 });
    await page.mouse.up();
    await wait(async () => (await at(0)).join() !== before.join(), "the picture is moved");
    await page.keyboard.press("0");
    // With it the wheel goes towards what is seen, and the button of the middle aside.
    await page.keyboard.press("c");
    const box = await page.locator("#picture").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.wheel(0, -300);
    await page.waitForSelector("#cameraWrite:not(:disabled)");
    await phase(page, "done");
    await page.keyboard.press("w");
    await wait(() => readFileSync(program.scene, "utf8") !== SCENE, "it is written");
    const nearer = /position: \(([^)]*)\)/.exec(readFileSync(program.scene, "utf8"))[1].split(",").map(Number);
    assert.ok(Math.hypot(nearer[0], nearer[1] - 1, nearer[2]) < 5.9, `${nearer} is nearer`);
    await page.waitForSelector("#cameraUndo:not(:disabled)");
    await page.keyboard.press("u");
    await wait(() => readFileSync(program.scene, "utf8") === SCENE, "it is taken back");
    await page.keyboard.press("Escape");
    await phase(page, "done");
  },

  async "the time from a save to its first pixels"({ program, page }) {
    await phase(page, "done");
    const times = [];
    for (let k = 0; k < 9; k++) {
      const shown = page.evaluate(() => new Promise((done) => {
        const first = document.body.dataset.frame;
        const look = () => (document.body.dataset.frame === first ? requestAnimationFrame(look) : done(Date.now()));
        look();
      }));
      const saved = Date.now();
      program.renameSave(SCENE.replace("0.9, 0.2, 0.1", `0.${k + 1}, 0.2, 0.3`));
      times.push((await shown) - saved);
      await phase(page, "done");
    }
    times.sort((a, b) => a - b);
    // A machine may be busy: it is told, and nothing fails by it.
    console.log(`        ${times[4]} ms, the median of nine (${times[0]} to ${times[8]})`);
    await restore(program, page);
  },

  async "an hour of saves, shortened"({ program, page }) {
    await phase(page, "done");
    const resident = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${program.child.pid}/status`, "utf8"))[1]) / 1024;
    const heap = () => page.evaluate(() => performance.memory.usedJSHeapSize / 1048576);
    const save = async (k) => {
      program.renameSave(SCENE.replace("fov: 40", `fov: ${30 + (k % 20)}`));
      await new Promise((done) => setTimeout(done, 60));
    };
    for (let k = 0; k < 60; k++) await save(k);
    await phase(page, "done");
    const [program0, page0] = [resident(), await heap()];
    for (let k = 0; k < 240; k++) await save(k);
    program.renameSave(SCENE);
    await page.waitForFunction(() => document.getElementById("figures").textContent.includes("16 of 16"), null, { timeout: 60000 });
    await phase(page, "done");
    // 240 films of this size are more than a gigabyte, as many pictures in the page 70 MB.
    const [program1, page1] = [resident(), await heap()];
    assert.ok(program1 < program0 + 40, `the program went from ${program0} to ${program1} MB`);
    assert.ok(page1 < page0 + 40, `the page went from ${page0} to ${page1} MB`);
  },

  async "a port that is taken"({ program }) {
    const port = new URL(program.address).port;
    const second = spawnSync(program.binary, ["preview", program.scene, "--port", port], { encoding: "utf8", timeout: 60000 });
    assert.notEqual(second.status, 0);
    assert.ok(second.stderr.includes(port), second.stderr);
  },

  async "a scene of 50 MB"({ program, page }) {
    await phase(page, "done");
    const balls = [];
    for (let k = 0; k < 700000; k++) {
      balls.push(`        Sphere(center: (${(k % 1000) / 100 - 5}, 0.02, ${-Math.floor(k / 1000) / 100}), radius: 0.004),\n`);
    }
    const large = SCENE.replace("    ],\n)", `${balls.join("")}    ],\n)`).replace("width: 320", "width: 321");
    assert.ok(large.length > 40e6, `${large.length}`);
    const done = (width) => page.waitForFunction(
      (width) => document.getElementById("figures").textContent.startsWith(`${width} x 240, 16 of 16`), width, { timeout: 240000 });
    program.renameSave(large);
    await done(321);
    program.renameSave(large.replace("width: 321", "width: 322"));
    await done(322);
    program.renameSave(SCENE);
    await done(320);
    await phase(page, "done");
  },

  // The last one: it ends the program.
  async "a program that has ended is told"({ program, page }) {
    await program.end();
    await phase(page, "gone");
    assert.match(await text(page, "phase"), /Not connected/);
  },
};

const program = new Program(root, folder);
let failed = 0;
try {
  await program.start();
  const page = await open(program.address, { colorScheme: "dark" });
  const only = process.argv[2];
  for (const [name, test] of Object.entries(tests)) {
    if (only && !name.includes(only)) continue;
    const began = Date.now();
    try {
      await test({ program, page, open, shoot, folder });
      console.log(`ok      ${name} (${Date.now() - began} ms)`);
    } catch (error) {
      failed += 1;
      console.log(`FAILED  ${name}: ${error.stack}`);
      await shoot(page, `failed-${failed}`);
    }
  }
} finally {
  await program.end();
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failed ? 1 : 0);
