// data.js: decodes the embedded map and answers questions about it.
// Format: page/payload.py. Everything in it may come from a stranger, so it is only ever used as
// text (textContent) and numbers, never as markup.

const PARTS = 10000;

/** A regular raster of buckets: which boxes or points lie near a place. */
class Buckets {
  constructor(bounds, count, boxOf) {
    const [x0, y0, x1, y1] = bounds;
    this.n = Math.max(1, Math.min(256, Math.ceil(Math.sqrt(count / 2))));
    this.x0 = x0;
    this.y0 = y0;
    this.kx = this.n / Math.max(x1 - x0, 1e-9);
    this.ky = this.n / Math.max(y1 - y0, 1e-9);
    this.cells = new Map();
    for (let i = 0; i < count; i++) {
      this.each(boxOf(i), (key) => {
        const cell = this.cells.get(key);
        if (cell) cell.push(i);
        else this.cells.set(key, [i]);
      });
    }
  }

  each([x0, y0, x1, y1], visit) {
    const clamp = (v) => Math.max(0, Math.min(this.n - 1, Math.floor(v)));
    const c1 = clamp((x1 - this.x0) * this.kx), r1 = clamp((y1 - this.y0) * this.ky);
    for (let r = clamp((y0 - this.y0) * this.ky); r <= r1; r++) {
      for (let c = clamp((x0 - this.x0) * this.kx); c <= c1; c++) visit(r * this.n + c);
    }
  }

  /** Calls visit(i) for everything whose bucket touches the box; may repeat a box. */
  near(box, visit) {
    this.each(box, (key) => {
      for (const i of this.cells.get(key) || []) visit(i);
    });
  }
}

/** The map in metres; s segments, K environments, n landmarks. */
class MapData {
  constructor(raw) {
    const u = raw.unit, [ox, oy] = raw.origin;
    const x = (v) => ox + v * u, y = (v) => oy + v * u;
    this.raw = raw;
    this.envs = raw.envs;
    this.features = raw.features;
    this.K = raw.envs.length;
    const b = raw.bounds;
    this.bounds = [x(b[0]), y(b[1]), x(b[2]), y(b[3])];

    // A ring arrives as one corner and the steps from it.
    const ring = (flat) => {
      const out = new Float64Array(flat.length);
      let cx = 0, cy = 0;
      for (let i = 0; i < flat.length; i += 2) {
        out[i] = x(cx += flat[i]);
        out[i + 1] = y(cy += flat[i + 1]);
      }
      return out;
    };
    const s = raw.segments;
    this.S = s.id.length;
    this.id = s.id;
    this.label = s.label;
    this.count = s.count;
    this.area = s.area;
    this.box = new Float64Array(4 * this.S); // west, south, east, north
    for (let i = 0; i < 4 * this.S; i += 4) {
      this.box[i] = x(s.box[i]);
      this.box[i + 1] = y(s.box[i + 1]);
      this.box[i + 2] = x(s.box[i] + s.box[i + 2]);
      this.box[i + 3] = y(s.box[i + 1] + s.box[i + 3]);
    }
    this.rings = new Map(Object.entries(s.rings).map(([i, rs]) => [+i, rs.map(ring)]));
    this.unsurveyed = new Set(s.unsurveyed);
    this.regionRings = raw.regions.rings.map(ring);
    for (const r of this.regionRings) r.box = boxOf(r);
    this.names = raw.regions.names.map(([k, px, py, r]) => ({ k, x: x(px), y: y(py), r: r * u }));
    this.surveyed = raw.surveyed.map(ring);
    this.byId = new Map(this.id.map((id, i) => [id, i]));
    this.margin = new Float64Array(this.S);
    for (let i = 0; i < this.S; i++) {
      const order = this.order(i);
      this.margin[i] = this.label[i] < 0 ? 0 : this.p(i, order[0]) - (this.K > 1 ? this.p(i, order[1]) : 0);
    }
    this.segmentIndex = new Buckets(this.bounds, this.S, (i) => this.box.subarray(4 * i, 4 * i + 4));
    this.readLandmarks(raw.landmarks, x, y);
  }

  readLandmarks(columns, x, y) {
    const l = columns || { xy: [], feature: [], confidence: [], id: [], segment: [] };
    this.n = l.feature.length;
    this.feature = l.feature;
    this.confidence = l.confidence;
    this.landmarkId = l.id;
    this.home = l.segment;
    this.time = l.time;
    this.agent = l.agent;
    this.lx = Float64Array.from(l.feature, (_, i) => x(l.xy[2 * i]));
    this.ly = Float64Array.from(l.feature, (_, i) => y(l.xy[2 * i + 1]));
    this.landmarkIndex = new Buckets(this.bounds, this.n, (i) => [this.lx[i], this.ly[i], this.lx[i], this.ly[i]]);
    this.inside = Array.from({ length: this.S }, () => []);
    this.classCount = new Array(this.features.length).fill(0);
    for (let i = 0; i < this.n; i++) {
      if (this.home[i] >= 0) this.inside[this.home[i]].push(i);
      this.classCount[this.feature[i]]++;
    }
    this.classes = this.features.map((_, f) => f).filter((f) => this.classCount[f])
      .sort((a, b) => this.classCount[b] - this.classCount[a]);
  }

  /** P(environment k) of segment i. */
  p(i, k) {
    return this.raw.segments.p[i * this.K + k] / PARTS;
  }

  /** Environments of segment i, the most likely first (its label before any equal). */
  order(i) {
    const first = this.label[i];
    return this.envs.map((_, k) => k)
      .sort((a, b) => this.p(i, b) - this.p(i, a) || (b === first) - (a === first));
  }

  /** Reasons of segment i: [{feature, count, share: Map(environment -> part of P)}], or null. */
  reasons(i) {
    const rows = this.raw.segments.reasons;
    return rows && rows[i].map((row) => {
      const share = new Map();
      for (let j = 2; j < row.length; j += 2) share.set(row[j], row[j + 1] / PARTS);
      return { feature: row[0], count: row[1], share };
    });
  }

  /** Zones of the environment of segment i: [[zone, P], ...], none where not told; or null. */
  zones(i) {
    const rows = this.raw.segments.zones;
    if (!rows) return null;
    const found = [];
    for (let j = 0; j < rows[i].length; j += 2) found.push([rows[i][j], rows[i][j + 1] / PARTS]);
    return found;
  }

  /** The environment that a feature indicates most, or -1. */
  foremost(f) {
    const first = this.features[f].indicates[0];
    return first ? first[0] : -1;
  }

  /** What feature f says of environment k: {strength, steps, path, reason, source}, or null. */
  indication(f, k) {
    const row = this.features[f].indicates.find((r) => r[0] === k);
    return row ? { strength: row[1], steps: row[2], path: row[3], reason: row[4], source: row[5] } : null;
  }

  /** The segment at a place in metres, or -1. */
  segmentAt(x, y) {
    let found = -1;
    this.segmentIndex.near([x, y, x, y], (i) => {
      const b = this.box, j = 4 * i;
      if (x < b[j] || x > b[j + 2] || y < b[j + 1] || y > b[j + 3]) return;
      const rings = this.rings.get(i);
      if (!rings || insideRings(rings, x, y)) found = i;
    });
    return found;
  }

  /** The landmark nearest to a place within a distance in metres that `accept`s it, or -1. */
  landmarkAt(x, y, within, accept) {
    let found = -1, best = within * within;
    this.landmarkIndex.near([x - within, y - within, x + within, y + within], (i) => {
      const d = (this.lx[i] - x) ** 2 + (this.ly[i] - y) ** 2;
      if (d <= best && accept(i)) [found, best] = [i, d];
    });
    return found;
  }

  /** Longitude and latitude of a place in metres (design: a polynomial of degree 5), or null. */
  degrees(x, y) {
    const inverse = this.raw.inverse;
    if (!inverse) return null;
    const u = (x - inverse.middle[0]) / inverse.half, v = (y - inverse.middle[1]) / inverse.half;
    let lon = 0, lat = 0, t = 0;
    for (let i = 0; i < 6; i++) {
      for (let j = 0; j < 6 - i; j++, t++) {
        const term = u ** i * v ** j;
        lon += inverse.lon[t] * term;
        lat += inverse.lat[t] * term;
      }
    }
    return [((lon + 540) % 360) - 180, lat];
  }
}

/** Even-odd rule over all rings, so that holes are holes. */
function insideRings(rings, x, y) {
  let inside = false;
  for (const r of rings) {
    for (let i = 0, j = r.length - 2; i < r.length; j = i, i += 2) {
      if (r[i + 1] > y !== r[j + 1] > y && x < ((r[j] - r[i]) * (y - r[i + 1])) / (r[j + 1] - r[i + 1]) + r[i]) {
        inside = !inside;
      }
    }
  }
  return inside;
}

/** West, south, east, north of a ring. */
function boxOf(ring) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  ring.forEach((v, i) => {
    box[i % 2] = Math.min(box[i % 2], v);
    box[2 + (i % 2)] = Math.max(box[2 + (i % 2)], v);
  });
  return box;
}
