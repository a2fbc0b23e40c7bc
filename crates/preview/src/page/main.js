// The page: asks for the state again and again, and shows it.

import { CameraMover } from "./camera.js";
import { Compare } from "./compare.js";
import * as faults from "./faults.js";
import { Inspector } from "./inspector.js";
import * as net from "./net.js";
import { View } from "./view.js";

const element = (id) => document.getElementById(id);
const TONES = ["none", "filmic", "agx"];
const PHASES = { loading: "Loading", rendering: "Rendering", done: "Done", wrong: "Scene has errors", gone: "Not connected" };

let current = null;
// What the person has chosen; undefined: what the scene says.
const chosen = { exposure: undefined, tone: undefined, layer: "" };
// The frame and look that are shown, or asked for.
let shown = "";
let fetching = false;
let announced = "";

const view = new View(element("picture"), (view) => {
  element("zoom").textContent = `${Number((view.zoom * 100).toPrecision(3))} %`;
  element("fit").setAttribute("aria-pressed", String(view.fitted));
  element("one").setAttribute("aria-pressed", String(!view.fitted && view.zoom === 1));
});

let toasted;
function say(text) {
  const toast = element("toast");
  toast.textContent = text;
  toast.hidden = false;
  clearTimeout(toasted);
  toasted = setTimeout(() => (toast.hidden = true), 5000);
}

const inspector = new Inspector(view, say);
const compare = new Compare(view, say, () => compare.fetch(look()));
const camera = new CameraMover(say);

/** What a drag, the wheel and keys do while the camera is moved. */
const steering = {
  exclusive: true,
  drag(dx, dy, event) {
    if (event.shiftKey || event.buttons & 6) camera.pan(-dx * (view.canvas.width / view.canvas.height), dy);
    else if (event.altKey) camera.zoom(Math.exp(dy * 2));
    else camera.orbit(dx * Math.PI, dy * Math.PI);
  },
  wheel: (step) => camera.dolly(Math.exp(step / 800)),
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (way && event.shiftKey) camera.pan(0.03 * way[0], 0.03 * way[1]);
    else if (way) camera.orbit(-0.06 * way[0], 0.06 * way[1]);
    else if (event.key === "PageUp") camera.dolly(1 / 1.08);
    else if (event.key === "PageDown") camera.dolly(1.08);
    else return false;
    return true;
  },
};

/** The inspector's keys, while it holds a pixel. */
const holding = {
  drag: (dx, dy) => view.move(dx * view.canvas.width, dy * view.canvas.height),
  key(event) {
    const by = event.shiftKey ? 10 : 1;
    const way = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, -by], ArrowDown: [0, by] }[event.key];
    if (way) inspector.step(...way);
    return !!way;
  },
};

function setTool(tool) {
  view.tool = tool;
  element("tool").setAttribute("aria-pressed", String(tool === steering));
  element("picture").classList.toggle("steered", tool === steering);
  if (tool !== holding) inspector.free();
  if (tool === steering) say("Drag orbits, Shift pans, the wheel goes nearer; Esc lets go");
}

function look() {
  const scene = current?.look ?? { exposure: 0, tone: "none" };
  return { exposure: chosen.exposure ?? scene.exposure, tone: chosen.tone ?? scene.tone };
}

// Numbers as people read them.
function rate(samples) {
  const [value, unit] = samples >= 1e6 ? [samples / 1e6, "M"] : samples >= 1e3 ? [samples / 1e3, "k"] : [samples, ""];
  return `${[Number(value.toPrecision(2)), unit].join(" ").trim()} samples/s`;
}

function time(seconds) {
  if (seconds < 60) return `${Math.max(Math.round(seconds), 1)} s`;
  if (seconds < 3600) return `${Math.round(seconds / 60)} min`;
  return `${Number((seconds / 3600).toPrecision(2))} h`;
}

function figures(state) {
  const parts = [];
  const { frame } = state;
  if (frame) parts.push(`${frame.size[0]} x ${frame.size[1]}`);
  if (frame && !frame.draft) parts.push(`${frame.samples} of ${state.asked} samples`);
  const running = state.phase === "rendering" && state.samples_done > 0 && state.seconds > 0;
  if (running || state.phase === "done") {
    const speed = (state.samples_done - state.samples_begun) / state.seconds;
    if (speed > 0 && Number.isFinite(speed)) parts.push(rate(speed));
    if (running && speed > 0) parts.push(`${time((state.samples_total - state.samples_done) / speed)} left`);
  }
  if (frame?.noise && frame.samples > 1) parts.push(noise(frame));
  return parts.join(", ");
}

// Of a lamp smaller than a pixel the noise is nearly all: that of the others says more.
function noise({ noise, few }) {
  const percent = (relative) => `${Number((relative * 100).toPrecision(2))} %`;
  if (!few) return `noise ${percent(noise)}`;
  const [pixels, rest] = few;
  return `noise ${percent(rest)} but for ${pixels === 1 ? "one pixel" : `${pixels} pixels`}`;
}

function render(state) {
  document.body.dataset.phase = state.phase;
  // For whoever waits until it is on the screen: `frame` is what is.
  document.body.dataset.newest = state.frame?.number ?? "";
  document.title = `${state.phase === "wrong" ? "! " : ""}${state.name}`;
  element("name").textContent = state.name;
  const phase = PHASES[state.phase];
  // Screen readers are told what has become of it, not every sample.
  if (phase !== announced) element("phase").textContent = announced = phase;
  element("figures").textContent = figures(state);
  element("progress").value = state.phase === "done" ? 1 : state.samples_total ? state.samples_done / state.samples_total : 0;
  element("progress").hidden = state.phase !== "rendering";
  faults.show(state, say);
  const { frame } = state;
  element("empty").hidden = !!frame;
  if (state.phase === "wrong" && !frame) element("empty").textContent = "As soon as the scene is right, it is shown here";
  if (frame) {
    const kind = frame.draft ? "draft" : `${frame.samples} samples`;
    element("picture").setAttribute("aria-label", `Picture of ${state.name}, ${frame.size[0]} by ${frame.size[1]} pixels, ${kind}`);
  }
  const layers = element("layer");
  if (layers.options.length !== state.layers.length + 1) {
    layers.append(...state.layers.map((name) => new Option(name.replace("_", " "), name)));
  }
  element("more").disabled = state.phase !== "done";
  camera.update(state);
  renderLook();
  fetchFrame();
}

function renderLook() {
  const { exposure, tone } = look();
  if (document.activeElement !== element("exposure") || chosen.exposure === undefined) element("exposure").value = exposure;
  const shownExposure = `${exposure > 0 ? "+" : ""}${Number(exposure.toFixed(2))} EV`;
  element("exposureShown").textContent = shownExposure;
  element("exposure").setAttribute("aria-valuetext", shownExposure);
  element("tone").value = tone;
  const own = chosen.exposure !== undefined || chosen.tone !== undefined;
  element("lookReset").disabled = !own;
  element("lookNote").textContent = own ? "On this page only" : "As the scene has it";
  const query = new URLSearchParams(look());
  element("savePng").href = `save?kind=png&${query}`;
  element("saveExr").href = `save?kind=exr&${query}`;
}

/** Shows the newest frame in the look of now; one request at a time, so that slow ways are not filled. */
async function fetchFrame() {
  if (fetching || !current?.frame) return;
  const query = () => (chosen.layer ? { ...look(), layer: chosen.layer } : look());
  const wanted = () => JSON.stringify([current.frame.number, query()]);
  if (wanted() === shown) return;
  fetching = true;
  const asked = wanted();
  const { size } = current.frame;
  try {
    const frame = await net.frame(query());
    if (!frame) {
      // It is being made anew.
      await new Promise((done) => setTimeout(done, 150));
    } else {
      // It may be a later one than was asked for, of another size, which the next state tells.
      const is_same = frame.number === JSON.parse(asked)[0];
      view.show(frame.width, frame.height, frame.bytes, is_same ? size : current.frame.size);
      document.body.dataset.frame = frame.number;
      inspector.refresh();
      shown = is_same ? asked : "";
    }
  } catch (error) {
    // The state's loop tells when the program is gone.
    await new Promise((done) => setTimeout(done, 300));
  }
  fetching = false;
  if (wanted() !== shown) fetchFrame();
}

async function follow() {
  let after = 0;
  for (;;) {
    try {
      const state = await net.state(after);
      after = state.version;
      current = state;
      render(state);
    } catch (error) {
      document.body.dataset.phase = "gone";
      if (announced !== PHASES.gone) element("phase").textContent = announced = PHASES.gone;
      element("figures").textContent = "tracer has ended, or cannot be reached; this page goes on when it answers";
      after = 0;
      await new Promise((done) => setTimeout(done, 1000));
    }
  }
}

function lookChanged() {
  renderLook();
  fetchFrame();
  compare.fetch(look());
}

function setLayer(name) {
  chosen.layer = name;
  element("layer").value = name;
  fetchFrame();
}

function more() {
  net.post("more", {}).catch((error) => say(error.message));
}

function setExposure(stops) {
  chosen.exposure = Math.min(Math.max(Math.round(stops * 100) / 100, -64), 64);
  lookChanged();
}

function savePng() {
  element("savePng").click();
}

/** A file, or why there is none: a link alone would save the refusal. */
async function save(event) {
  event.preventDefault();
  const link = event.currentTarget;
  try {
    const answer = await fetch(link.href);
    if (!answer.ok) throw new Error(await answer.text());
    const name = /filename="([^"]*)"/.exec(answer.headers.get("content-disposition"))?.[1] ?? "picture";
    const address = URL.createObjectURL(await answer.blob());
    const download = document.createElement("a");
    download.href = address;
    download.download = name;
    download.click();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
    say(`${name} is saved where this browser puts downloads`);
  } catch (error) {
    say(error.message);
  }
}

element("exposure").addEventListener("input", (event) => setExposure(Number(event.target.value)));
element("tone").addEventListener("change", (event) => {
  chosen.tone = event.target.value;
  lookChanged();
});
element("lookReset").addEventListener("click", () => {
  chosen.exposure = chosen.tone = undefined;
  lookChanged();
});
element("picture").addEventListener("click", () => {
  if (inspector.held && !view.tool) setTool(holding);
});
element("inspectFree").addEventListener("click", () => setTool(null));
element("layer").addEventListener("change", (event) => setLayer(event.target.value));
element("tool").addEventListener("click", () => setTool(view.tool === steering ? null : steering));
element("more").addEventListener("click", more);
element("savePng").addEventListener("click", save);
element("saveExr").addEventListener("click", save);
element("fit").addEventListener("click", () => view.fit());
element("one").addEventListener("click", () => view.zoomTo(1));
element("in").addEventListener("click", () => view.zoomTo(view.zoom * Math.SQRT2));
element("out").addEventListener("click", () => view.zoomTo(view.zoom / Math.SQRT2));
element("help").addEventListener("click", () => element("keys").showModal());

const themes = ["auto", "dark", "light"];
function setTheme(theme) {
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  element("theme").textContent = `Theme: ${theme}`;
  view.draw();
}
// The address has another port each time, so what is stored is only for this run.
let theme = sessionStorage.getItem("theme") ?? "auto";
setTheme(theme);
element("theme").addEventListener("click", () => {
  theme = themes[(themes.indexOf(theme) + 1) % themes.length];
  sessionStorage.setItem("theme", theme);
  setTheme(theme);
});
matchMedia("(prefers-color-scheme: light)").addEventListener("change", () => view.draw());

const keys = {
  "0": () => view.fit(),
  "1": () => view.zoomTo(1),
  "+": () => view.zoomTo(view.zoom * Math.SQRT2),
  "=": () => view.zoomTo(view.zoom * Math.SQRT2),
  "-": () => view.zoomTo(view.zoom / Math.SQRT2),
  "[": () => setExposure(look().exposure - 1 / 3),
  "]": () => setExposure(look().exposure + 1 / 3),
  t: () => {
    chosen.tone = TONES[(TONES.indexOf(look().tone) + 1) % TONES.length];
    lookChanged();
  },
  l: () => {
    const names = ["", ...(current?.layers ?? [])];
    setLayer(names[(names.indexOf(chosen.layer) + 1) % names.length]);
  },
  i: () => {
    element("picture").focus();
    setTool(holding);
    inspector.step(0, 0);
  },
  p: () => compare.toggle(),
  ",": () => compare.step(-2),
  ".": () => compare.step(2),
  c: () => {
    element("picture").focus();
    setTool(view.tool === steering ? null : steering);
  },
  w: () => element("cameraWrite").click(),
  u: () => element("cameraUndo").click(),
  m: () => element("more").click(),
  Escape: () => setTool(null),
  e: () => faults.toggle(),
  s: savePng,
  "?": () => element("keys").showModal(),
};

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select, input, dialog")) return;
  const act = keys[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});

follow();
