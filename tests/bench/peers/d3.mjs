// One run of d3-delaunay, after another one that warms the compiler up:
//   node d3.mjs NODE_MODULES version
//   node d3.mjs NODE_MODULES triangulate|measure SITES WIDTH HEIGHT [CELLS]
// SITES: doubles x, y, x, y. The domain is from the origin to (WIDTH, HEIGHT). Prints seconds, those of the
// processor, and the number of triangles as JSON; CELLS gets the areas, centroids, where each cell's neighbors begin, and the neighbors.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [, , folder, job, sitesFile, width, height, cellsFile] = process.argv;
const from = createRequire(path.join(path.resolve(folder), 'x.js'));
const load = async (name) => import(pathToFileURL(from.resolve(name)).href);
const manifest = (name) => JSON.parse(fs.readFileSync(path.join(folder, name, 'package.json')));
const { default: Delaunator } = await load('delaunator');
const { Delaunay } = await load('d3-delaunay');

const shortestEdge = 1e-6; // of the distance of two sites: an edge shorter than that is a tie, and none

function measure(points, box) {
  const [xmin, ymin, xmax, ymax] = box;
  const n = points.length / 2;
  const delaunay = new Delaunay(points);
  const voronoi = delaunay.voronoi(box);
  const { inedges, halfedges, triangles } = delaunay;
  const { circumcenters } = voronoi;
  const areas = new Float64Array(n);
  const centroids = new Float64Array(2 * n);
  const offsets = new Uint32Array(n + 1);
  let neighbors = new Int32Array(8 * n);
  let count = 0;
  const polygon = []; // of one cell: x, y, x, y
  const others = []; // others[k]: the site across the edge that vertex k begins

  // Whether site i's cell lies inside the domain, with its polygon and neighbors.
  function walk(i) {
    polygon.length = others.length = 0;
    const first = inedges[i];
    let e = first;
    do {
      const t = 2 * Math.floor(e / 3);
      const x = circumcenters[t], y = circumcenters[t + 1];
      if (!(x >= xmin && x <= xmax && y >= ymin && y <= ymax)) return false;
      polygon.push(x, y);
      e = e % 3 === 2 ? e - 2 : e + 1;
      if (triangles[e] !== i) return false;
      others.push(triangles[e % 3 === 2 ? e - 2 : e + 1]);
      e = halfedges[e];
      if (e === -1) return false;
    } while (e !== first);
    return true;
  }

  function addNeighbor(j) {
    if (count === neighbors.length) {
      const more = new Int32Array(2 * count);
      more.set(neighbors);
      neighbors = more;
    }
    neighbors[count++] = j;
  }

  function add(i, vertices, length, site) {
    const px = points[2 * i], py = points[2 * i + 1];
    let twice = 0, cx = 0, cy = 0;
    let bx = vertices[0] - px, by = vertices[1] - py;
    for (let k = 0; k < length; ++k) {
      const ax = bx, ay = by;
      const next = k + 1 < length ? 2 * k + 2 : 0;
      bx = vertices[next] - px;
      by = vertices[next + 1] - py;
      const cross = ax * by - ay * bx;
      twice += cross;
      cx += cross * (ax + bx);
      cy += cross * (ay + by);
      if (site) {
        const dx = points[2 * site[k]] - px, dy = points[2 * site[k] + 1] - py;
        const edge = (bx - ax) ** 2 + (by - ay) ** 2;
        if (edge > shortestEdge ** 2 * (dx * dx + dy * dy)) addNeighbor(site[k]);
      }
    }
    areas[i] = Math.abs(twice) / 2;
    centroids[2 * i] = px + cx / (3 * twice);
    centroids[2 * i + 1] = py + cy / (3 * twice);
  }

  // Cells at the border are d3's own; walls are where the polygon lies on one.
  function addAtBorder(i) {
    const ring = voronoi.cellPolygon(i);
    if (!ring) return;
    add(i, ring.flat(), ring.length - 1, null);
    for (const j of voronoi.neighbors(i)) addNeighbor(j);
    const walls = [[-1, 0, xmin], [-2, 0, xmax], [-3, 1, ymin], [-4, 1, ymax]];
    for (const [wall, axis, at] of walls) {
      if (ring.some((p, k) => k > 0 && p[axis] === at && ring[k - 1][axis] === at)) addNeighbor(wall);
    }
  }

  for (let i = 0; i < n; ++i) {
    offsets[i] = count;
    if (inedges[i] === -1) continue;
    if (walk(i)) add(i, polygon, others.length, others);
    else addAtBorder(i);
  }
  offsets[n] = count;
  return { areas, centroids, offsets, neighbors: neighbors.subarray(0, count) };
}

if (job === 'version') {
  console.log(`${manifest('d3-delaunay').version}, node ${process.versions.node}`);
} else {
  const points = new Float64Array(new Uint8Array(fs.readFileSync(sitesFile)).buffer);
  const run = () => (job === 'triangulate' ? new Delaunator(points) : measure(points, [0, 0, +width, +height]));
  run();
  const begin = performance.now(), usedBefore = process.cpuUsage();
  const result = run();
  const seconds = (performance.now() - begin) / 1000, used = process.cpuUsage(usedBefore);
  const triangles = job === 'triangulate' ? result.triangles.length / 3 : 0;
  if (cellsFile) {
    const out = fs.openSync(cellsFile, 'w');
    for (const part of [result.areas, result.centroids, result.offsets, result.neighbors]) {
      fs.writeFileSync(out, new Uint8Array(part.buffer, part.byteOffset, part.byteLength));
    }
    fs.closeSync(out);
  }
  console.log(JSON.stringify({ seconds, cpu_seconds: (used.user + used.system) / 1e6, triangles }));
}
