// A pinned state beside the picture of now, with a border that can be moved.

import * as net from "./net.js";

const element = (id) => document.getElementById(id);

export class Compare {
  constructor(view, say, changed) {
    this.view = view;
    this.say = say;
    this.changed = changed;
    this.pin = null;
    element("pin").addEventListener("click", () => this.take());
    element("unpin").addEventListener("click", () => this.drop());
    element("wipe").addEventListener("input", () => this.move());
    const handle = element("handle");
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      event.preventDefault();
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = view.canvas.getBoundingClientRect();
      element("wipe").value = (100 * (event.clientX - box.left)) / box.width;
      this.move();
    });
  }

  async take() {
    try {
      this.pin = (await net.post("pin", {})).pin;
    } catch (error) {
      this.say(error.message);
      return;
    }
    element("pinned").hidden = false;
    element("wipe").value = 50;
    this.say("Pinned: the left side stays as it is now");
    this.move();
    this.changed();
  }

  drop() {
    this.pin = null;
    element("pinned").hidden = true;
    element("handle").hidden = true;
    this.view.pinned = null;
    this.view.draw();
  }

  toggle() {
    if (this.pin === null) this.take();
    else this.drop();
  }

  /** Moves the border, which lies so many hundredths from the left. */
  move() {
    const share = Number(element("wipe").value) / 100;
    this.view.wipe = share;
    const handle = element("handle");
    handle.hidden = this.pin === null;
    handle.style.left = `${100 * share}%`;
    this.view.draw();
  }

  step(by) {
    if (this.pin === null) return;
    element("wipe").value = Number(element("wipe").value) + by;
    this.move();
  }

  /** The pinned state in the look of now. */
  async fetch(look) {
    if (this.pin === null) return;
    try {
      const frame = await net.frame({ ...look, pin: this.pin });
      if (frame && this.pin !== null) this.view.showPinned(frame.width, frame.height, frame.bytes);
    } catch (error) {
      this.drop();
      this.say(error.message);
    }
  }
}
