// What is wrong with the scene, over the picture: the terminal's own text, and a way into the editor.

import { post } from "./net.js";

const list = document.getElementById("faultList");
const box = document.getElementById("faults");
const title = document.getElementById("faultsTitle");
const fold = document.getElementById("fold");

let shown = "";
let folded = false;

const counted = (n, noun) => `${n} ${noun}${n === 1 ? "" : "s"}`;

/** Shows the diagnostics of a state; `say` tells the person something. */
export function show(state, say) {
  const text = JSON.stringify([state.told, state.editor, !!state.frame]);
  if (text === shown) return;
  shown = text;
  const errors = state.told.filter((told) => told.severity === "error").length;
  const warnings = state.told.length - errors;
  box.hidden = !state.told.length;
  box.dataset.grave = errors > 0;
  const parts = [errors && counted(errors, "error"), warnings && counted(warnings, "warning")].filter(Boolean);
  const old = errors && state.frame ? "; the picture is that of the last right text" : "";
  title.textContent = parts.join(", ") + old;
  // Warnings do not stand in the picture's way.
  setFolded(errors === 0);
  list.replaceChildren(...state.told.map((told, index) => item(told, index, state, say)));
}

function item(told, index, state, say) {
  const item = document.createElement("li");
  item.dataset.severity = told.severity;
  item.append(excerpt(told.text));
  const place = told.place;
  if (place) {
    const at = place.line ? `${place.name}:${place.line}:${place.column}` : place.name;
    const button = document.createElement("button");
    button.type = "button";
    if (state.editor) {
      button.textContent = `Open ${at}`;
      button.addEventListener("click", () =>
        post("open", { told: index, version: state.version }).catch((error) => say(error.message)));
    } else {
      button.textContent = `Copy ${at}`;
      button.title = "Start the preview with --editor to open it";
      button.addEventListener("click", () =>
        navigator.clipboard.writeText(at).then(() => say(`${at} is copied`), () => say(at)));
    }
    item.append(button);
  }
  return item;
}

/** The text with its headline, gutter and caret in colours. */
function excerpt(text) {
  const pre = document.createElement("pre");
  pre.tabIndex = 0;
  text.split("\n").forEach((line, k) => {
    const [, gutter, rest] = line.match(/^(\s*\d*\s*(?:\||-->|=|:::|\.\.\.)\s?)?(.*)$/s);
    const part = (kind, text) => {
      const span = document.createElement("span");
      span.className = kind;
      span.textContent = text;
      pre.append(span);
    };
    // The headline is a block, so that it is broken on a phone; the excerpt is not.
    if (k > 1) pre.append("\n");
    if (gutter) part("gutter", gutter);
    const isCaret = /^[\s\^|_\-+/\\]*\^/.test(rest) && !/^\s*\d/.test(line);
    part(k === 0 ? "head" : isCaret ? "caret" : "line", rest);
  });
  return pre;
}

export function setFolded(value) {
  folded = value;
  list.hidden = folded;
  fold.textContent = folded ? "Show" : "Fold";
  fold.setAttribute("aria-expanded", String(!folded));
}

export function toggle() {
  if (!box.hidden) setFolded(!folded);
}

fold.addEventListener("click", toggle);
