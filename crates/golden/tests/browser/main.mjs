// The page of `tracer golden run --html` in a real browser. Run by `cargo xtask prove golden`: needs chromium, and playwright-core in
// target/prove/node. With GOLDEN_SHOTS=FOLDER it leaves pictures of the page there, to be looked at.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const root = fileURLToPath(new URL("../../../../", import.meta.url));
const require = createRequire(join(root, "target/prove/node/"));
const { chromium } = require("playwright-core");
const program = process.env.TRACER ?? join(root, "target/debug/tracer");

const folder = mkdtempSync(join(tmpdir(), "golden-"));
const shots = process.env.GOLDEN_SHOTS;
if (shots) mkdirSync(shots, { recursive: true });
const shoot = async (page, name) => shots && page.screenshot({ path: join(shots, `${name}.png`), fullPage: true });

const SCENE = `Scene(image: Image(width: 48, height: 32), render: Render(samples: 32), background: 0.3,
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 20)],
    objects: [Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: (0.8, 0.2, 0.1)))])`;

function tracer(code, ...args) {
  const ran = spawnSync(program, args, { cwd: folder, encoding: "utf8" });
  assert.equal(ran.status, code, `${args.join(" ")}: ${ran.stdout}${ran.stderr}`);
}

/** A folder in which one scene is equal, one within noise, one different, one new and one wrong. */
function prepare() {
  const golden = join(folder, "golden");
  mkdirSync(golden);
  const write = (name, text) => writeFileSync(join(golden, name), text);
  for (const name of ["equal", "noise", "different"]) write(`${name}.ron`, SCENE);
  tracer(0, "golden", "new", "golden");
  tracer(1, "golden", "run", "golden");
  tracer(0, "golden", "accept", "golden", "--all-failed", "--reason", "first");
  write("golden.toml", "[scene.noise]\nseed = 5\n");
  write("different.ron", SCENE.replace("(0.8, 0.2, 0.1)", "(0.1, 0.2, 0.8)"));
  write("new.ron", SCENE);
  write("wrong.ron", "Scene(objects: [Sphere(radius: -1)])");
  tracer(1, "golden", "run", "golden", "--html", "page.html");
}

prepare();
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  headless: true,
  args: ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update"],
});

/** The page, which fails the test where its script does, where its policy is broken, or where it asks anybody for anything. */
async function open(settings) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...settings });
  const page = await context.newPage();
  page.on("pageerror", (error) => assert.fail(`the page's script: ${error.stack}`));
  page.on("console", (message) => assert.notEqual(message.type(), "error", message.text()));
  const address = pathToFileURL(join(folder, "page.html")).href;
  page.on("request", (request) => assert.ok(request.url() === address || request.url().startsWith("data:"), request.url()));
  await page.goto(address);
  return page;
}

const at = (page, k) => page.evaluate((k) => parseFloat(document.querySelectorAll(".wipe")[k].style.getPropertyValue("--at")), k);

const tests = {
  async "the table leads to what failed"() {
    const page = await open({ colorScheme: "light" });
    assert.equal(await page.textContent("h1"), "Golden pictures: 3 failed, 2 passed");
    const rows = await page.locator("tbody tr").allTextContents();
    assert.equal(rows.length, 5);
    assert.ok(rows.slice(0, 3).every((row) => row.includes("fails")) && rows[4].includes("passes"), rows.join("\n"));
    assert.equal(await page.locator("section").count(), 4, "what is equal has nothing to see");
    for (const image of await page.locator("img").all()) {
      assert.ok(await image.evaluate((image) => image.complete && image.naturalWidth === 48), "every picture is there");
      assert.ok(await image.getAttribute("alt"));
    }
    await page.locator("tbody a", { hasText: "golden/different" }).click();
    const top = await page.locator("section", { hasText: "golden/different" }).evaluate((section) => section.getBoundingClientRect().top);
    assert.ok(top < 800, `the section is in view: ${top}`);
    await shoot(page, "light");
  },

  async "the wipe follows the pointer"() {
    const page = await open({ colorScheme: "dark" });
    await shoot(page, "dark");
    const box = page.locator(".wipe").first();
    await box.scrollIntoViewIfNeeded();
    const place = await box.boundingBox();
    for (const share of [0.25, 0.8]) {
      await page.mouse.move(place.x + share * place.width, place.y + 20);
      assert.ok(Math.abs((await at(page, 0)) - 100 * share) < 1, `${await at(page, 0)} at ${share}`);
    }
    // The ball is blue on the left of the line no more: what shows there is the expected one, red.
    const shown = await box.screenshot();
    const red = await page.evaluate(async (bytes) => {
      const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
      canvas.drawImage(bitmap, 0, 0);
      const [r, , b] = canvas.getImageData(bitmap.width / 2, bitmap.height / 2, 1, 1).data;
      return r > b;
    }, [...shown]);
    assert.ok(red, "the middle is the expected picture where the line is at 80 %");
  },

  async "keys alone reach everything"() {
    const page = await open({});
    const bar = page.locator("input[type=range]").first();
    for (let k = 0; k < 40 && !(await bar.evaluate((bar) => bar === document.activeElement)); k++) await page.keyboard.press("Tab");
    assert.ok(await bar.evaluate((bar) => bar === document.activeElement), "the wipe can be reached by Tab");
    const before = await at(page, 0);
    await page.keyboard.press("ArrowRight");
    assert.ok((await at(page, 0)) > before);
    await page.keyboard.press("Home");
    assert.equal(await at(page, 0), 0);
    await page.keyboard.press("End");
    assert.equal(await at(page, 0), 100);
    assert.equal(await bar.getAttribute("aria-valuetext"), "100 % expected");
    const outline = await bar.evaluate((bar) => getComputedStyle(bar).outlineStyle);
    assert.notEqual(outline, "none", "where the keys go can be seen");
  },

  async "a screen reader has names for all of it"() {
    const page = await open({});
    for (const section of await page.getByRole("region").all()) assert.ok(await section.getByRole("heading").textContent());
    assert.equal(await page.getByRole("region").count(), 4);
    assert.equal(await page.getByRole("slider", { name: /wipe of golden\/different/ }).count(), 1);
    assert.equal(await page.getByRole("img", { name: "expected" }).count(), 4);
    assert.equal(await page.getByRole("columnheader").count(), 3);
  },

  async "dark, light and the width of a phone"() {
    for (const colorScheme of ["light", "dark"]) {
      const page = await open({ colorScheme, viewport: { width: 360, height: 700 } });
      const beyond = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(beyond <= 0, `${colorScheme}: ${beyond} pixels are beyond the screen`);
      const [text, ground] = await page.evaluate(() => {
        const light = (colour) => colour.match(/[\d.]+/g).slice(0, 3).reduce((sum, x) => sum + Number(x), 0) / 765;
        const style = getComputedStyle(document.body);
        return [light(style.color), light(style.backgroundColor)];
      });
      assert.ok(colorScheme === "light" ? ground > 0.9 && text < 0.2 : ground < 0.2 && text > 0.8, `${colorScheme}: ${text} on ${ground}`);
      await shoot(page, `phone-${colorScheme}`);
      await page.context().close();
    }
  },
};

let failed = 0;
try {
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log(`ok      ${name}`);
    } catch (error) {
      failed += 1;
      console.log(`FAILED  ${name}: ${error.stack}`);
    }
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failed === 0 ? 0 : 1);
