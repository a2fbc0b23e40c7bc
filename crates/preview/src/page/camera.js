// The camera, moved by mouse and keys: around what it looks at, sideways, nearer and farther.

import * as net from "./net.js";

const element = (id) => document.getElementById(id);
const add = (a, b, s = 1) => a.map((x, k) => x + s * b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(...a);
const unit = (a) => a.map((x) => x / (length(a) || 1));
/** Turns `v` about a unit axis. */
const turn = (v, axis, angle) => {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return add(add(v.map((x) => x * c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
};
/** So near to `up` the camera does not come: there it would not know which way is up. */
const STEEPEST = 0.02;

/** How much a camera sees; each goes by one of them, and one that sees all around by none. */
const ZOOMS = ["fov", "focal_length", "height"];

export class CameraMover {
  constructor(say) {
    this.say = say;
    this.pose = null;
    // What the file had when the pose was taken: only what is another than that counts as moved.
    this.from = null;
    this.seen = null;
    this.sending = false;
    this.waiting = false;
    this.moved = 0;
    element("cameraWrite").addEventListener("click", () => this.write());
    element("cameraUndo").addEventListener("click", () => this.undo());
    element("cameraReset").addEventListener("click", () => this.reset());
  }

  /** What the program has; while the person moves, the page is ahead of it. */
  update(state) {
    if (!this.sending && performance.now() - this.moved > 400) {
      this.pose = state.camera;
      this.from = state.written;
    }
    this.seen = state.seen;
    element("cameraWrite").disabled = !state.moved || !state.camera || state.phase === "wrong";
    element("cameraReset").disabled = !state.moved;
    element("cameraUndo").disabled = !state.undo;
    element("cameraNote").textContent = state.moved ? "Moved here; not in the file" : "As the file has it";
    if (state.camera) {
      const list = (v) => v.map((x) => Number(x.toPrecision(4))).join(", ");
      const zoom = ZOOMS.find((name) => name in state.camera);
      element("cameraShown").textContent =
        `position ${list(state.camera.position)}\nlook_at ${list(state.camera.look_at)}` +
        (zoom ? `\n${zoom} ${list([state.camera[zoom]])}` : "");
    }
  }

  axes() {
    const { position, look_at, up } = this.pose;
    const forward = unit(add(look_at, position, -1));
    const right = unit(cross(forward, up));
    return { forward, right, above: cross(right, forward), distance: length(add(look_at, position, -1)) };
  }

  /** Around what it looks at, by angles in radians. */
  orbit(across, along) {
    if (!this.pose) return;
    const { right } = this.axes();
    const up = unit(this.pose.up);
    let arm = turn(add(this.pose.position, this.pose.look_at, -1), up, -across);
    const side = turn(right, up, -across);
    const now = Math.acos(Math.min(Math.max(dot(unit(arm), up), -1), 1));
    const wanted = Math.min(Math.max(now - along, STEEPEST), Math.PI - STEEPEST);
    arm = turn(arm, side, wanted - now);
    this.send({ ...this.pose, position: add(this.pose.look_at, arm) });
  }

  /** Sideways, by shares of what is seen at the distance looked at. */
  pan(across, along) {
    if (!this.pose) return;
    const { right, above, distance } = this.axes();
    const size = this.pose.height ?? distance * (this.seen ?? 1);
    const by = add(right.map((x) => x * across * size), above, along * size);
    this.send({ ...this.pose, position: add(this.pose.position, by), look_at: add(this.pose.look_at, by) });
  }

  /** Nearer to what it looks at, or farther: by a factor of the distance. */
  dolly(factor) {
    if (!this.pose) return;
    const arm = add(this.pose.position, this.pose.look_at, -1);
    this.send({ ...this.pose, position: add(this.pose.look_at, arm, factor) });
  }

  /** Sees more or less, by a factor of what is seen, whatever the camera says that by. */
  zoom(factor) {
    if (!this.pose) return;
    const { fov, focal_length, height } = this.pose;
    if (height !== undefined) this.send({ ...this.pose, height: height * factor });
    else if (focal_length !== undefined) this.send({ ...this.pose, focal_length: focal_length / factor });
    else if (fov !== undefined) {
      const half = Math.atan(Math.tan((fov * Math.PI) / 360) * factor);
      this.send({ ...this.pose, fov: Math.min(Math.max((360 / Math.PI) * half, 0.1), 175) });
    } else this.say("The projection of this camera cannot be zoomed here");
  }

  /** One at a time: the last one counts. */
  async send(pose) {
    this.pose = pose;
    this.moved = performance.now();
    if (this.sending) {
      this.waiting = true;
      return;
    }
    this.sending = true;
    try {
      do {
        this.waiting = false;
        await net.post("camera", { pose: this.pose, from: this.from });
      } while (this.waiting);
    } catch (error) {
      this.say(error.message);
    }
    this.sending = false;
  }

  reset() {
    this.moved = 0;
    net.post("camera", { pose: null }).catch((error) => this.say(error.message));
  }

  async write() {
    try {
      // What was moved last is on its way.
      while (this.sending) await new Promise((done) => setTimeout(done, 20));
      const { edits, expressions } = await net.post("camera/write", {});
      this.moved = 0;
      if (expressions) this.say("The camera is written into the scene file, in place of expressions too; Undo puts them back");
      else this.say(edits ? "The camera is written into the scene file" : "The file has this camera already");
    } catch (error) {
      this.say(error.message);
    }
  }

  async undo() {
    try {
      await net.post("camera/undo", {});
      this.moved = 0;
      this.say("The file is as it was before");
    } catch (error) {
      this.say(error.message);
    }
  }
}
