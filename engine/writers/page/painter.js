// painter.js: draws segments, borders, names and landmarks on the canvas.

const LEVELS = 24; // shades between the paler and the full colour of an environment
const CLASS_COLOURS = ["#3f7fb5", "#d98324", "#4f9d69", "#c9504b", "#8a6bb1", "#2f9c9c", "#b0893b", "#c86b98", "#6f7f3a", "#7d6a5c"];
const HEAVY = 24; // milliseconds: a drawing that takes longer is not repeated while moving
const OTHER_CLASS = "#8d9299";

const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
const css = (c) => `rgb(${c.map(Math.round).join(",")})`;
const mix = (a, b, t) => a.map((v, i) => v + (b[i] - v) * t);
/** A colour made neither too bright nor too dark to stand out from its ground. */
const toned = (c, least, most) => {
  const light = Math.max(0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2], 1);
  return c.map((v) => v * (Math.max(least, Math.min(most, light)) / light));
};

class Painter {
  /**
   * @param {HTMLCanvasElement} canvas for the map
   * @param {HTMLCanvasElement} over above it, for what is hovered or selected
   * @param {object} state what is chosen; see page.js
   */
  constructor(canvas, over, data, view, state) {
    Object.assign(this, { canvas, over, data, view, state });
    this.ctx = canvas.getContext("2d", { alpha: false });
    this.frame = 0;
    this.stale = false; // whether more than the chosen things has changed
    this.cost = 0; // milliseconds of the last full drawing
    this.readTheme();
  }

  /** Takes the colours of the style sheet, which knows light and dark. */
  readTheme() {
    const style = getComputedStyle(document.documentElement);
    const token = (name) => rgb(style.getPropertyValue(name).trim());
    this.paper = token("--paper");
    this.ink = token("--ink");
    this.accent = token("--accent");
    this.dark = this.paper[0] < 128;
    this.font = getComputedStyle(document.body).fontFamily;
    this.sprites = new Map();
    this.hatch = this.makeHatch();
    this.recolour();
  }

  /** Two-tone stripes for "unknown", one repeat of 8 x 8 pixels. */
  makeHatch() {
    const tile = document.createElement("canvas");
    tile.width = tile.height = 8;
    const ctx = tile.getContext("2d");
    ctx.fillStyle = css(mix(this.paper, this.ink, 0.05));
    ctx.fillRect(0, 0, 8, 8);
    ctx.strokeStyle = css(mix(this.paper, this.ink, 0.17));
    ctx.lineWidth = 1.1;
    for (const d of [-8, 0, 8]) {
      ctx.beginPath();
      ctx.moveTo(d - 1, 9);
      ctx.lineTo(d + 9, -1);
      ctx.stroke();
    }
    return ctx.createPattern(tile, "repeat");
  }

  /** Colour of an environment at a certainty in [0, 1]: the paler, the less certain. */
  shade(k, certainty) {
    const full = rgb(this.data.envs[k].colour);
    return css(this.dark ? mix(this.paper, toned(full, 95, 165), 0.2 + 0.55 * certainty) : mix(this.paper, full, 0.3 + 0.65 * certainty));
  }

  /** Colour of a value in [0, 1] in the modes that show one number. */
  ramp(value) {
    const k = this.state.probabilityOf;
    const strong = (c) => (this.dark ? mix(c, [255, 255, 255], 0.15) : mix(c, [0, 0, 0], 0.2));
    const full = k === null ? (this.dark ? [126, 200, 220] : [20, 84, 110]) : strong(rgb(this.data.envs[k].colour));
    return css(mix(mix(this.paper, this.ink, 0.04), full, 0.04 + 0.96 * value));
  }

  /** Sorts the segments by colour; needed after a change of mode, filter or theme. */
  recolour() {
    const { data, state } = this, groups = new Map();
    for (let i = 0; i < data.S; i++) {
      const k = data.label[i];
      let colour = "unknown";
      if (k >= 0) {
        if (state.hidden.has(k)) colour = css(mix(this.paper, this.ink, 0.035));
        else if (state.mode === "winner") {
          colour = this.shade(k, Math.round(Math.sqrt(data.margin[i]) * LEVELS) / LEVELS);
        } else {
          const value = state.mode === "margin" ? data.margin[i] : data.p(i, state.probabilityOf);
          colour = this.ramp(Math.round(value * LEVELS) / LEVELS);
        }
      } else if (state.hidden.has(-1)) colour = css(this.paper);
      if (groups.has(colour)) groups.get(colour).push(i);
      else groups.set(colour, [i]);
    }
    this.groups = groups;
    this.dotRows = this.sortDots();
  }

  dotColour(f) {
    const { data, state } = this;
    if (state.dots === "class") return CLASS_COLOURS[data.classes.indexOf(f)] || OTHER_CLASS;
    const k = data.foremost(f);
    if (k < 0) return OTHER_CLASS;
    const full = rgb(data.envs[k].colour);
    return css(this.dark ? mix(full, [255, 255, 255], 0.32) : mix(toned(full, 0, 185), [15, 20, 30], 0.32));
  }

  /** Landmarks by colour, the most frequent class first, so that rare ones lie on top. */
  sortDots() {
    const byClass = this.data.classes.map((f) => ({ f, colour: this.dotColour(f), rows: [] }));
    const slot = new Map(byClass.map((g) => [g.f, g]));
    for (let i = 0; i < this.data.n; i++) slot.get(this.data.feature[i]).rows.push(i);
    return byClass;
  }

  /** Asks for a drawing in the next frame; `moving` ones may reuse the last picture. */
  request(moving = false) {
    this.stale = true;
    this.moving = moving;
    this.requestChosen();
  }

  /** Asks for what is hovered and selected only. */
  requestChosen() {
    if (!this.frame) this.frame = requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.frame = 0;
    const { canvas, over, view } = this, dpr = Math.min(window.devicePixelRatio || 1, 2);
    const w = Math.round(view.width * dpr), h = Math.round(view.height * dpr);
    const resized = canvas.width !== w || canvas.height !== h;
    if (resized) [canvas.width, canvas.height, over.width, over.height] = [w, h, w, h];
    this.dpr = dpr;
    if (this.stale || resized) {
      clearTimeout(this.later);
      // A heavy map on a slow machine: while it moves, shift and scale the last picture instead.
      if (this.moving && this.cost > HEAVY && this.last && !resized) {
        this.reuse();
        this.later = setTimeout(() => this.request(), 140);
      } else this.drawMap();
    }
    this.stale = false;
    this.drawChosen();
  }

  drawMap() {
    const { canvas, ctx, state, dpr } = this, start = performance.now();
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = css(this.paper);
    ctx.fillRect(0, 0, canvas.width, canvas.height);
    ctx.setTransform(dpr, 0, 0, dpr, 0, 0);
    if (state.layers.segments) this.drawSegments();
    this.drawSurveyed();
    if (state.layers.landmarks) this.drawLandmarks();
    if (state.layers.names) this.drawNames();
    this.cost = performance.now() - start;
    this.keep();
  }

  /** Keeps a copy of the picture for `reuse`, if this map needs it. */
  keep() {
    if (this.cost <= HEAVY) return;
    const { canvas } = this, copy = this.copy || (this.copy = document.createElement("canvas"));
    [copy.width, copy.height] = [canvas.width, canvas.height];
    copy.getContext("2d").drawImage(canvas, 0, 0);
    this.last = { x: this.view.x, y: this.view.y, k: this.view.k };
  }

  reuse() {
    const { ctx, view, last, copy, dpr } = this, s = view.k / last.k;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = css(this.paper);
    ctx.fillRect(0, 0, copy.width, copy.height);
    const dx = (last.x - view.x) * view.k * dpr, dy = (view.y - last.y) * view.k * dpr;
    ctx.setTransform(s, 0, 0, s, (copy.width / 2) * (1 - s) + dx, (copy.height / 2) * (1 - s) + dy);
    ctx.drawImage(copy, 0, 0);
  }

  /** Adds rings to the current path. */
  trace(rings, ctx = this.ctx) {
    const { view } = this;
    for (const r of rings) {
      ctx.moveTo(view.sx(r[0]), view.sy(r[1]));
      for (let i = 2; i < r.length; i += 2) ctx.lineTo(view.sx(r[i]), view.sy(r[i + 1]));
      ctx.closePath();
    }
  }

  /** West, north, width, height of a segment in pixels, on whole device pixels: no seams. */
  pixels(i) {
    const { data, view, dpr } = this, j = 4 * i, snap = (v) => Math.round(v * dpr) / dpr;
    const x0 = snap(view.sx(data.box[j])), x1 = snap(view.sx(data.box[j + 2]));
    const y0 = snap(view.sy(data.box[j + 3])), y1 = snap(view.sy(data.box[j + 1]));
    return [x0, y0, x1 - x0, y1 - y0];
  }

  drawSegments() {
    const { ctx, data, view } = this, [x0, y0, x1, y1] = view.seen, box = data.box;
    const visible = (i) => box[4 * i] < x1 && box[4 * i + 2] > x0 && box[4 * i + 1] < y1 && box[4 * i + 3] > y0;
    this.hatch.setTransform(new DOMMatrix([1, 0, 0, 1, view.sx(view.bounds[0]) % 8, view.sy(view.bounds[1]) % 8]));
    for (const [colour, members] of this.groups) {
      ctx.fillStyle = colour === "unknown" ? this.hatch : colour;
      ctx.strokeStyle = ctx.fillStyle;
      ctx.lineWidth = 0.7;
      for (const i of members) {
        if (!visible(i)) continue;
        const rings = data.rings.get(i);
        if (rings) {
          ctx.beginPath();
          this.trace(rings);
          ctx.fill("evenodd");
          if (colour !== "unknown") ctx.stroke(); // closes the hairline between neighbours
        } else {
          const [px, py, pw, ph] = this.pixels(i);
          ctx.fillRect(px, py, pw, ph);
        }
      }
    }
    this.drawBorders(visible);
  }

  /** Faint borders of segments where there is room for them; clear ones between regions. */
  drawBorders(visible) {
    const { ctx, data, view, state } = this, b = view.bounds;
    const side = view.k * Math.sqrt(((b[2] - b[0]) * (b[3] - b[1])) / Math.max(data.S, 1));
    const faint = Math.max(0, Math.min(1, (side - 9) / 30));
    ctx.strokeStyle = ctx.fillStyle = css(this.paper);
    ctx.lineJoin = "round";
    ctx.lineWidth = 1;
    ctx.globalAlpha = 0.3 * faint;
    for (let i = 0; faint > 0 && i < data.S; i++) {
      if (!visible(i)) continue;
      const rings = data.rings.get(i);
      if (rings) {
        ctx.beginPath();
        this.trace(rings);
        ctx.stroke();
      } else {
        const [px, py, pw, ph] = this.pixels(i);
        ctx.fillRect(px, py, pw, 1);
        ctx.fillRect(px, py, 1, ph);
      }
    }
    const [x0, y0, x1, y1] = view.seen;
    ctx.beginPath();
    this.trace(data.regionRings.filter((r) => r.box[0] < x1 && r.box[2] > x0 && r.box[1] < y1 && r.box[3] > y0));
    ctx.globalAlpha = state.mode === "winner" ? 0.9 : 0.5;
    ctx.lineWidth = Math.max(0.6, Math.min(2, side / 12));
    ctx.stroke();
    ctx.globalAlpha = 1;
  }

  drawSurveyed() {
    if (!this.data.surveyed.length) return;
    const { ctx } = this;
    ctx.beginPath();
    this.trace(this.data.surveyed);
    ctx.setLineDash([5, 4]);
    ctx.strokeStyle = css(mix(this.paper, this.ink, 0.55));
    ctx.lineWidth = 1;
    ctx.stroke();
    ctx.setLineDash([]);
  }

  /** Radius of a dot in pixels: grows with the zoom, and small where there are many. */
  get radius() {
    const { data, view } = this, b = view.bounds;
    const spacing = view.k * Math.sqrt(((b[2] - b[0]) * (b[3] - b[1])) / Math.max(data.n, 1));
    return Math.max(0.7, Math.min(6, 0.75 + spacing * 0.06));
  }

  /** A dot with a rim in the colour of the paper, painted once for each colour and size. */
  sprite(colour, r) {
    const key = `${colour} ${r}`, made = this.sprites.get(key);
    if (made) return made;
    const scale = 2, rim = r > 2.2 ? 1 : 0.5, size = Math.ceil((r + rim + 1) * 2);
    const tile = document.createElement("canvas");
    tile.width = tile.height = size * scale;
    const ctx = tile.getContext("2d");
    ctx.scale(scale, scale);
    ctx.beginPath();
    ctx.arc(size / 2, size / 2, r + rim, 0, 7);
    ctx.fillStyle = css(this.paper);
    ctx.fill();
    ctx.beginPath();
    ctx.arc(size / 2, size / 2, r, 0, 7);
    ctx.fillStyle = colour;
    ctx.fill();
    const sprite = { tile, size };
    if (this.sprites.size > 200) this.sprites.clear();
    this.sprites.set(key, sprite);
    return sprite;
  }

  drawLandmarks() {
    const { ctx, data, view, state } = this, [x0, y0, x1, y1] = view.seen;
    const r = Math.round(this.radius * 4) / 4, chosen = state.classOf;
    const pad = 8 / view.k;
    for (const group of this.dotRows) {
      const lit = group.f === chosen, size = lit ? Math.max(r * 1.5, 3.5) : r;
      ctx.globalAlpha = chosen === null ? (r < 1.5 ? 0.65 : 0.95) : lit ? 1 : 0.16;
      const sprite = size >= 1.5 ? this.sprite(lit ? css(this.accent) : group.colour, size) : null;
      ctx.fillStyle = group.colour;
      for (const i of group.rows) {
        const x = data.lx[i], y = data.ly[i];
        if (x < x0 - pad || x > x1 + pad || y < y0 - pad || y > y1 + pad) continue;
        const px = view.sx(x), py = view.sy(y);
        if (sprite) ctx.drawImage(sprite.tile, px - sprite.size / 2, py - sprite.size / 2, sprite.size, sprite.size);
        else ctx.fillRect(px - size, py - size, 2 * size, 2 * size);
      }
    }
    ctx.globalAlpha = 1;
  }

  /** The names of regions that are large enough on the screen to hold them. */
  drawNames() {
    const { ctx, data, view, state } = this;
    if (state.mode !== "winner" || !state.layers.segments) return;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.lineJoin = "round";
    for (const { k, x, y, r } of data.names) {
      if (state.hidden.has(k)) continue;
      const size = Math.max(11, Math.min(17, (r * view.k) / 5)), text = data.envs[k].label;
      ctx.font = `600 ${size}px ${this.font}`;
      if ("letterSpacing" in ctx) ctx.letterSpacing = "0.4px";
      if (ctx.measureText(text).width > r * view.k * 2.1) continue;
      ctx.strokeStyle = css(this.paper);
      ctx.globalAlpha = 0.85;
      ctx.lineWidth = 3.5;
      ctx.strokeText(text, view.sx(x), view.sy(y));
      ctx.globalAlpha = 1;
      ctx.fillStyle = css(mix(rgb(data.envs[k].colour), this.ink, 0.62));
      ctx.fillText(text, view.sx(x), view.sy(y));
    }
  }

  /** The segment under the pointer and what is selected, on the canvas above. */
  drawChosen() {
    const { over, dpr } = this, ctx = over.getContext("2d");
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, over.width, over.height);
    ctx.setTransform(dpr, 0, 0, dpr, 0, 0);
    this.markChosen(ctx);
  }

  /** A scale bar in the picture itself, which is scaled when it is printed. */
  markScale(pixels, words) {
    const { ctx, view } = this, y = view.height - 14;
    ctx.fillStyle = css(this.paper);
    ctx.fillRect(8, y - 26, pixels + 20, 34);
    ctx.fillStyle = css(this.ink);
    ctx.fillRect(18, y, pixels, 2);
    ctx.fillRect(18, y - 5, 1.5, 6);
    ctx.fillRect(16.5 + pixels, y - 5, 1.5, 6);
    ctx.font = `13px ${this.font}`;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(words, 18, y - 9);
  }

  markChosen(ctx) {
    const { data, state } = this;
    ctx.lineJoin = "round";
    const twice = (width, rim, colour) => {
      for (const [w, c] of [[width + rim, this.paper], [width, colour]]) {
        ctx.lineWidth = w;
        ctx.strokeStyle = css(c);
        ctx.stroke();
      }
    };
    for (const [i, width] of [[state.hover, 1.25], [state.segment, 2.25]]) {
      if (i < 0) continue;
      ctx.beginPath();
      const rings = data.rings.get(i);
      if (rings) this.trace(rings, ctx);
      else ctx.rect(...this.pixels(i));
      twice(width, 2.5, this.ink);
    }
    if (state.landmark >= 0) {
      const i = state.landmark;
      ctx.beginPath();
      ctx.arc(this.view.sx(data.lx[i]), this.view.sy(data.ly[i]), Math.max(this.radius, 3) + 4, 0, 7);
      twice(2.5, 2.5, this.accent);
    }
  }
}
