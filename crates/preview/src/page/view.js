// The picture on the screen: fitted, one to one, zoomed and moved.

const MOST = 64;
const LEAST = 1 / 64;

export class View {
  /** `size` is that of the picture, also while a draft with fewer pixels is shown. */
  constructor(canvas, changed) {
    this.canvas = canvas;
    this.changed = changed;
    this.context = canvas.getContext("2d", { alpha: false });
    this.picture = document.createElement("canvas");
    this.size = [0, 0];
    this.fitted = true;
    // Pixels of the screen for one of the picture, and the picture's point in the middle of the canvas.
    this.zoom = 1;
    this.centre = [0, 0];
    this.waiting = false;
    // What a drag and keys do: they move the picture, or what is put here does something else:
    // { exclusive, drag(dx, dy, event), wheel(step), key(event) }; one that is exclusive has the wheel and clicks, too.
    this.tool = null;
    this.dragged = false;
    // The pixel that is held by the inspector.
    this.cross = null;
    // Another picture, shown left of this share of the canvas.
    this.pinned = null;
    this.wipe = 0.5;
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.listen();
    this.resize();
  }

  show(width, height, bytes, size) {
    put(this.picture, width, height, bytes);
    if (size[0] !== this.size[0] || size[1] !== this.size[1]) {
      this.size = size;
      this.centre = [size[0] / 2, size[1] / 2];
      if (this.fitted) this.fit();
    }
    this.draw();
  }

  showPinned(width, height, bytes) {
    this.pinned ??= document.createElement("canvas");
    put(this.pinned, width, height, bytes);
    this.draw();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth * ratio, this.canvas.clientHeight * ratio].map(Math.round);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = Math.max(width, 1);
      this.canvas.height = Math.max(height, 1);
    }
    if (this.fitted) this.fit();
    this.draw();
  }

  fit() {
    if (!this.size[0]) return;
    const [width, height] = this.size;
    this.fitted = true;
    this.zoom = Math.min(this.canvas.width / width, this.canvas.height / height, MOST);
    this.centre = [width / 2, height / 2];
    this.draw();
  }

  /** Zooms; the picture's point under the place on the canvas stays there. */
  zoomTo(zoom, place = [this.canvas.width / 2, this.canvas.height / 2]) {
    const fixed = this.pointAt(place);
    this.fitted = false;
    this.zoom = Math.min(Math.max(zoom, LEAST), MOST);
    const off = [place[0] - this.canvas.width / 2, place[1] - this.canvas.height / 2];
    this.centre = [fixed[0] - off[0] / this.zoom, fixed[1] - off[1] / this.zoom];
    this.keep();
  }

  /** Moves the picture by pixels of the screen. */
  move(dx, dy) {
    this.fitted = false;
    this.centre = [this.centre[0] - dx / this.zoom, this.centre[1] - dy / this.zoom];
    this.keep();
  }

  /** Never loses the picture. */
  keep() {
    this.centre = this.centre.map((x, axis) => Math.min(Math.max(x, 0), this.size[axis]));
    this.draw();
  }

  /** The picture's point at a place of the canvas, in its pixels. */
  pointAt([x, y]) {
    return [
      this.centre[0] + (x - this.canvas.width / 2) / this.zoom,
      this.centre[1] + (y - this.canvas.height / 2) / this.zoom,
    ];
  }

  /** The place on the canvas of a picture's point. */
  placeOf([x, y]) {
    return [
      (x - this.centre[0]) * this.zoom + this.canvas.width / 2,
      (y - this.centre[1]) * this.zoom + this.canvas.height / 2,
    ];
  }

  /** The place on the canvas of an event. */
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [
      ((event.clientX - box.left) * this.canvas.width) / box.width,
      ((event.clientY - box.top) * this.canvas.height) / box.height,
    ];
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.paint();
      this.changed(this);
    });
  }

  paint() {
    const { context, canvas } = this;
    context.fillStyle = getComputedStyle(canvas.parentElement).backgroundColor;
    context.fillRect(0, 0, canvas.width, canvas.height);
    if (!this.size[0] || !this.picture.width) return;
    // Whole pixels of the screen: at one to one nothing is blurred.
    const [left, top] = this.placeOf([0, 0]).map(Math.round);
    const [right, bottom] = this.placeOf(this.size).map(Math.round);
    // What is enlarged shows its pixels; a draft does not pretend to have any.
    const draft = this.picture.width !== this.size[0] || this.picture.height !== this.size[1];
    context.imageSmoothingEnabled = draft || this.zoom < 1;
    context.imageSmoothingQuality = draft ? "low" : "high";
    context.drawImage(this.picture, left, top, right - left, bottom - top);
    if (this.pinned) {
      context.save();
      context.beginPath();
      context.rect(0, 0, Math.round(canvas.width * this.wipe), canvas.height);
      context.clip();
      context.fillRect(0, 0, canvas.width, canvas.height);
      // A state of another size fills the same place: it is held against this one.
      context.imageSmoothingEnabled = this.pinned.width !== this.size[0] || this.zoom < 1;
      context.drawImage(this.pinned, left, top, right - left, bottom - top);
      context.restore();
    }
    if (this.cross) this.paintCross();
  }

  /** A frame around the pixel, dark and light, so that it is seen on any. */
  paintCross() {
    const { context } = this;
    const [left, top] = this.placeOf(this.cross).map(Math.round);
    const side = Math.max(Math.round(this.zoom), 3);
    for (const [gap, colour] of [[2, "#000"], [1, "#fff"]]) {
      context.strokeStyle = colour;
      context.lineWidth = 1;
      context.strokeRect(left - gap + 0.5, top - gap + 0.5, side + 2 * gap - 1, side + 2 * gap - 1);
    }
    context.fillStyle = "#fff";
    const middle = [left + side / 2, top + side / 2];
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.fillRect(middle[0] + dx * (side / 2 + 12) - (dx ? 6 : 0.5), middle[1] + dy * (side / 2 + 12) - (dy ? 6 : 0.5), dx ? 12 : 1, dy ? 12 : 1);
    }
  }

  listen() {
    const { canvas } = this;
    const pointers = new Map();
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const step = event.deltaMode === 1 ? event.deltaY * 20 : event.deltaY;
      if (this.tool?.exclusive && !event.ctrlKey) this.tool.wheel(step);
      else this.zoomTo(this.zoom * Math.exp(-step / 400), this.place(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, this.place(event));
      this.dragged = false;
      canvas.classList.add("dragged");
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const now = this.place(event);
      const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
      // A hand that trembles clicks.
      if (!this.dragged && pointers.size === 1 && Math.hypot(dx, dy) < 3 * (window.devicePixelRatio || 1)) return;
      this.dragged = true;
      if (pointers.size === 1) {
        if (this.tool) this.tool.drag(dx / canvas.width, dy / canvas.height, event);
        else this.move(dx, dy);
      } else {
        // Two fingers: what is between them stays between them.
        const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
        const length = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) || 1;
        this.zoomTo((this.zoom * length(now, other)) / length(before, other), other);
      }
      pointers.set(event.pointerId, now);
    });
    const end = (event) => {
      pointers.delete(event.pointerId);
      if (!pointers.size) canvas.classList.remove("dragged");
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("contextmenu", (event) => {
      if (this.tool?.exclusive) event.preventDefault();
    });
    canvas.addEventListener("dblclick", (event) => {
      if (this.tool?.exclusive) return;
      if (this.fitted) this.zoomTo(1, this.place(event));
      else this.fit();
    });
    canvas.addEventListener("keydown", (event) => {
      if (this.tool?.key(event)) {
        event.preventDefault();
        return;
      }
      const step = (event.shiftKey ? 160 : 40) * (window.devicePixelRatio || 1);
      const by = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
      if (!by || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      this.move(...by);
    });
  }
}

function put(canvas, width, height, bytes) {
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  canvas.getContext("2d").putImageData(new ImageData(bytes, width, height), 0, 0);
}
