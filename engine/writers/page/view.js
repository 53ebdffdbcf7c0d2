// view.js: what part of the map is on the screen, and the gestures that change it.

const CALM = matchMedia("(prefers-reduced-motion: reduce)");

/** The transform between metres and CSS pixels, and its animation. */
class View {
  /**
   * @param {HTMLCanvasElement} canvas what shows the map
   * @param {number[]} bounds west, south, east, north in metres
   * @param {(moving: boolean) => void} changed called after every change
   */
  constructor(canvas, bounds, changed) {
    this.canvas = canvas;
    this.bounds = bounds;
    this.changed = changed;
    this.x = (bounds[0] + bounds[2]) / 2; // the middle of the screen, in metres
    this.y = (bounds[1] + bounds[3]) / 2;
    this.k = 1; // pixels per metre
    this.width = this.height = 1;
    this.flight = 0;
    this.aim = null; // where a flight under way ends
  }

  get fitted() {
    const [x0, y0, x1, y1] = this.bounds, pad = this.width < 600 ? 12 : 28;
    return Math.min((this.width - 2 * pad) / (x1 - x0), (this.height - 2 * pad) / (y1 - y0));
  }

  resize(width, height) {
    const whole = this.k <= this.fitted * 1.001;
    this.width = Math.max(width, 80);
    this.height = Math.max(height, 80);
    if (whole || this.k === 1) [this.x, this.y, this.k] = this.whole();
    this.changed(false);
  }

  whole() {
    const [x0, y0, x1, y1] = this.bounds;
    return [(x0 + x1) / 2, (y0 + y1) / 2, this.fitted];
  }

  sx(x) {
    return (x - this.x) * this.k + this.width / 2;
  }

  sy(y) {
    return this.height / 2 - (y - this.y) * this.k;
  }

  /** Pixels -> metres. */
  place(px, py) {
    return [(px - this.width / 2) / this.k + this.x, (this.height / 2 - py) / this.k + this.y];
  }

  /** The visible part in metres. */
  get seen() {
    const [x0, y1] = this.place(0, 0), [x1, y0] = this.place(this.width, this.height);
    return [x0, y0, x1, y1];
  }

  /** Goes there at once, but never far off the map nor too near or far. */
  set(x, y, k, moving = true) {
    const [x0, y0, x1, y1] = this.bounds, fit = this.fitted;
    this.k = Math.max(fit * 0.4, Math.min(fit * 600, k));
    const dx = (0.3 * this.width) / this.k, dy = (0.3 * this.height) / this.k;
    this.x = Math.max(x0 - dx, Math.min(x1 + dx, x));
    this.y = Math.max(y0 - dy, Math.min(y1 + dy, y));
    this.changed(moving);
  }

  /** Goes there in a fifth of a second. */
  fly(x, y, k) {
    this.stop();
    if (CALM.matches) return this.set(x, y, k, false);
    this.aim = [x, y, k];
    const from = [this.x, this.y, Math.log(this.k)], to = [x, y, Math.log(k)];
    const start = performance.now();
    const step = (now) => {
      const t = Math.min(1, (now - start) / 200), e = 1 - (1 - t) ** 3;
      const at = from.map((v, i) => v + (to[i] - v) * e);
      this.set(at[0], at[1], Math.exp(at[2]), t < 1);
      if (t < 1) this.flight = requestAnimationFrame(step);
      else this.aim = null;
    };
    this.flight = requestAnimationFrame(step);
  }

  stop() {
    cancelAnimationFrame(this.flight);
    this.aim = null;
  }

  /** Zooms so that the place under a pixel stays there; during a flight, from where that ends. */
  zoom(factor, px = this.width / 2, py = this.height / 2, smooth = false) {
    const [x, y, from] = (smooth && this.aim) || [this.x, this.y, this.k];
    const k = Math.max(this.fitted * 0.4, Math.min(this.fitted * 600, from * factor));
    const right = px - this.width / 2, up = this.height / 2 - py;
    const to = [x + right / from - right / k, y + up / from - up / k, k];
    if (smooth) this.fly(...to);
    else {
      this.stop();
      this.set(...to);
    }
  }

  pan(dx, dy) {
    this.stop();
    this.set(this.x - dx / this.k, this.y + dy / this.k, this.k);
  }

  /** Shows a box of metres, as far as it is map, in the part of the screen without a panel. */
  showBox(box, { right = 0, bottom = 0 } = {}) {
    const [west, south, east, north] = this.bounds;
    const x0 = Math.max(box[0], west), x1 = Math.min(box[2], east);
    const y0 = Math.max(box[1], south), y1 = Math.min(box[3], north);
    const w = Math.max(this.width - right - 32, 80), h = Math.max(this.height - bottom - 32, 80);
    const k = Math.min(w / Math.max(x1 - x0, 1e-6), h / Math.max(y1 - y0, 1e-6));
    this.fly((x0 + x1) / 2 + right / 2 / k, (y0 + y1) / 2 - bottom / 2 / k, k);
  }
}

/**
 * Drag, wheel, pinch, double click and keys on the map.
 * @param {View} view
 * @param {{hover: Function, leave: Function, click: Function, enter: Function}} on callbacks; the
 *   first three get pixels
 */
function listenToGestures(view, on) {
  const canvas = view.canvas, fingers = new Map();
  let travelled = 0, spread = 0;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const middle = () => {
    const all = [...fingers.values()];
    return [0, 1].map((axis) => all.reduce((sum, p) => sum + p[axis], 0) / all.length);
  };
  const width = () => {
    const [a, b] = [...fingers.values()];
    return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button > 0) return;
    canvas.setPointerCapture(event.pointerId);
    if (!fingers.size) travelled = 0;
    fingers.set(event.pointerId, at(event));
    spread = width();
    document.body.classList.remove("by-keys");
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = at(event);
    if (!fingers.has(event.pointerId)) {
      if (event.pointerType !== "touch") on.hover(...now);
      return;
    }
    const before = middle();
    fingers.set(event.pointerId, now);
    const after = middle();
    travelled += Math.hypot(after[0] - before[0], after[1] - before[1]);
    if (travelled < 4 && fingers.size < 2) return;
    canvas.classList.add("dragging");
    on.leave();
    view.pan(after[0] - before[0], after[1] - before[1]);
    if (fingers.size > 1) {
      travelled += 10;
      const wide = width();
      if (spread && wide) view.zoom(wide / spread, ...after);
      spread = wide;
    }
  });
  const lift = (event) => {
    if (!fingers.delete(event.pointerId)) return;
    spread = width();
    if (fingers.size) return;
    canvas.classList.remove("dragging");
    if (event.type === "pointerup" && travelled < 4) on.click(...at(event));
    else view.changed(false);
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("pointerleave", () => on.leave());
  canvas.addEventListener("dblclick", (event) => view.zoom(2, ...at(event), true));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 20 : 1;
    view.zoom(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0016)), ...at(event));
  }, { passive: false });

  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 200 : 60;
    const keys = {
      ArrowLeft: () => view.pan(step, 0),
      ArrowRight: () => view.pan(-step, 0),
      ArrowUp: () => view.pan(0, step),
      ArrowDown: () => view.pan(0, -step),
      "+": () => view.zoom(1.6, undefined, undefined, true),
      "=": () => view.zoom(1.6, undefined, undefined, true),
      "-": () => view.zoom(1 / 1.6, undefined, undefined, true),
      0: () => view.fly(...view.whole()),
      Enter: () => on.enter(),
      " ": () => on.enter(),
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    document.body.classList.add("by-keys"); // shows the cross in the middle
    keys[event.key]();
  });
}
