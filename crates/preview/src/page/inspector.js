// What a pixel is: under the pointer, or under the cross that the keys move.

const element = (id) => document.getElementById(id);

// Few digits tell more than many.
const number = (x) => (x === null || x === undefined ? "none" : Number(x.toPrecision(4)).toString().replace("-", "\u2212"));
const numbers = (values) => values.map(number).join("  ");

export class Inspector {
  constructor(view, say) {
    this.view = view;
    this.say = say;
    // In the picture's pixels; null: nothing is looked at.
    this.point = null;
    this.held = false;
    this.asking = false;
    this.again = false;
    view.canvas.addEventListener("pointermove", (event) => {
      if (!this.held && event.buttons === 0) this.look(view.pointAt(view.place(event)));
    });
    view.canvas.addEventListener("click", (event) => {
      if (!event.detail || view.dragged || view.tool?.exclusive) return;
      this.held = true;
      this.look(view.pointAt(view.place(event)));
    });
    element("inspectFree").addEventListener("click", () => this.free());
    element("openObject").addEventListener("click", () => this.ask(true));
  }

  /** Looks at the pixel that holds this point. */
  look([x, y]) {
    const [width, height] = this.view.size;
    if (!width) return;
    const inside = x >= 0 && y >= 0 && x < width && y < height;
    if (!inside && !this.held) return;
    this.point = [Math.min(Math.max(Math.floor(x), 0), width - 1), Math.min(Math.max(Math.floor(y), 0), height - 1)];
    this.view.cross = this.held ? this.point : null;
    this.view.draw();
    this.ask(false);
  }

  /** Moves the cross by pixels of the picture. */
  step(dx, dy) {
    const [width, height] = this.view.size;
    const from = this.point ?? [Math.floor(width / 2), Math.floor(height / 2)];
    this.held = true;
    this.look([from[0] + dx + 0.5, from[1] + dy + 0.5]);
  }

  free() {
    this.held = false;
    this.view.cross = null;
    this.view.draw();
    element("inspectFree").disabled = true;
  }

  /** The picture is another one. */
  refresh() {
    if (this.point) this.ask(false);
  }

  async ask(open) {
    if (this.asking) {
      this.again = true;
      return;
    }
    if (!this.point) return;
    this.asking = true;
    const [x, y] = this.point;
    try {
      const answer = await fetch(`pixel?x=${x}&y=${y}&open=${open}`);
      if (answer.ok) this.show(await answer.json());
      else if (open) this.say(await answer.text());
    } catch {
      // The state's loop tells when the program is gone.
    }
    this.asking = false;
    if (this.again) {
      this.again = false;
      this.ask(false);
    }
  }

  show(pixel) {
    element("inspectFree").disabled = !this.held;
    const rows = [["pixel", `${pixel.x}, ${pixel.y}`], ["linear RGB", numbers(pixel.radiance)]];
    rows.push(["object", pixel.object ? pixel.object.name : "none"]);
    if (pixel.material) rows.push(["material", pixel.material.name]);
    const said = new Set(["object_id", "material_id", "variance", "noise"]);
    for (const layer of pixel.layers) {
      if (!said.has(layer.name)) rows.push([layer.name.replace("_", " "), numbers(layer.values)]);
    }
    const list = element("pixelRows");
    list.replaceChildren(...rows.map(([name, value]) => {
      const row = document.createElement("div");
      const term = document.createElement("dt");
      const text = document.createElement("dd");
      term.textContent = name;
      text.textContent = value;
      row.append(term, text);
      return row;
    }));
    const place = pixel.object?.place;
    const button = element("openObject");
    button.disabled = !place;
    button.textContent = place ? `Open ${place.name}:${place.line}` : "Open its line";
  }
}
