// Draws each <figure class="solid"> from the JSON beside it: turned as touch.js has it, played in
// time.
// Plain canvas, no library: faces and lines are sorted by depth and painted from the back.
"use strict";

function rotateByQuaternion(q, v) {
  const [w, x, y, z] = q;
  const tx = 2 * (y * v[2] - z * v[1]), ty = 2 * (z * v[0] - x * v[2]), tz = 2 * (x * v[1] - y * v[0]);
  return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx];
}

// Seconds that the whole motion takes when it is played.
const PLAYING = 15;

// Colours as the page has them in light and in dark.
const THEMED = { "#1d1f21": "--ink", "#0072b2": "--blue", "#d55e00": "--red", "#009e73": "--green", "#999999": "--soft" };
const themed = (colour) =>
  getComputedStyle(document.documentElement).getPropertyValue(THEMED[colour.toLowerCase()] || "").trim() || colour;

function makeSolid(figure) {
  const scene = JSON.parse(figure.querySelector("script").textContent);
  const canvas = figure.querySelector("canvas"), pen = canvas.getContext("2d");
  const slider = figure.querySelector("input[type=range]"), button = figure.querySelector("button");
  const step = figure.querySelector("button.step");
  const clock = figure.querySelector("output");
  const frames = scene.times.length;
  // The last moment first: what grows in time is then there to be seen.
  const view = { turn: scene.turn, tilt: scene.tilt, zoom: 1, frame: frames - 1, playing: false, from: 0 };

  // Place of a point of an item at the current time, in space.
  const inSpace = (item, point) =>
    item.frame === "body" ? rotateByQuaternion(scene.attitude[view.frame], point) : point;

  // Orthographic: x to the right, y up, third number towards the eye.
  function project(point) {
    const ct = Math.cos(view.turn), st = Math.sin(view.turn), cp = Math.cos(view.tilt), sp = Math.sin(view.tilt);
    const x = ct * point[0] + st * point[1], away = -st * point[0] + ct * point[1];
    const size = (Math.min(canvas.width, canvas.height) / 2.25 / scene.radius) * view.zoom;
    return [canvas.width / 2 + size * x, canvas.height / 2 - size * (cp * (point[2] - scene.height) + sp * away), sp * point[2] - cp * away];
  }

  function pieces() {
    const found = [];
    for (const item of scene.items) {
      if (item.kind === "mesh") {
        const grid = item.points.map((row) => row.map((p) => project(inSpace(item, p))));
        for (let i = 0; i + 1 < grid.length; i++)
          for (let j = 0; j + 1 < grid[i].length; j++) {
            const corners = [grid[i][j], grid[i][j + 1], grid[i + 1][j + 1], grid[i + 1][j]];
            found.push({ depth: corners.reduce((sum, c) => sum + c[2], 0) / 4, corners, item });
          }
      } else if (item.kind === "line") {
        const line = item.points.map((p) => project(inSpace(item, p)));
        const last = item.grows ? Math.max(1, Math.round(((line.length - 1) * view.frame) / Math.max(1, frames - 1))) : line.length - 1;
        for (let i = 0; i < last; i++)
          found.push({ depth: (line[i][2] + line[i + 1][2]) / 2 + 1e-3, corners: [line[i], line[i + 1]], item });
      } else {
        const tip = item.track ? item.track[view.frame] : item.tip;
        const ends = [project([0, 0, 0]), project(inSpace(item, tip))];
        found.push({ depth: (ends[0][2] + ends[1][2]) / 2 + 2e-3, corners: ends, item });
      }
    }
    return found.sort((a, b) => a.depth - b.depth);
  }

  function arrow(from, to, item) {
    pen.beginPath();
    pen.moveTo(from[0], from[1]);
    pen.lineTo(to[0], to[1]);
    pen.stroke();
    const angle = Math.atan2(to[1] - from[1], to[0] - from[0]), head = 9 * devicePixelRatio;
    pen.beginPath();
    pen.moveTo(to[0], to[1]);
    pen.lineTo(to[0] - head * Math.cos(angle - 0.4), to[1] - head * Math.sin(angle - 0.4));
    pen.lineTo(to[0] - head * Math.cos(angle + 0.4), to[1] - head * Math.sin(angle + 0.4));
    pen.fill();
    if (item.label) {
      pen.font = `${13 * devicePixelRatio}px system-ui, sans-serif`;
      pen.fillText(item.label, to[0] + 7 * devicePixelRatio, to[1] - 5 * devicePixelRatio);
    }
  }

  function paint() {
    pen.clearRect(0, 0, canvas.width, canvas.height);
    pen.lineJoin = pen.lineCap = "round";
    const colours = new Map(scene.items.map((item) => [item, themed(item.colour)]));
    for (const { corners, item } of pieces()) {
      pen.strokeStyle = pen.fillStyle = colours.get(item);
      pen.globalAlpha = 1;
      pen.lineWidth = (item.width || 1) * devicePixelRatio;
      if (item.kind === "arrow") {
        arrow(corners[0], corners[1], item);
        continue;
      }
      pen.beginPath();
      corners.forEach((c, i) => (i ? pen.lineTo(c[0], c[1]) : pen.moveTo(c[0], c[1])));
      if (item.kind === "mesh") {
        pen.closePath();
        pen.globalAlpha = item.opacity;
        pen.fill();
        pen.globalAlpha = Math.min(1, 1.6 * item.opacity);
        pen.lineWidth = 0.5 * devicePixelRatio;
      }
      pen.stroke();
    }
    pen.globalAlpha = 1;
    clock.textContent = frames > 1 ? `${scene.times[view.frame].toPrecision(4)} ${scene.unit}` : "";
    slider.setAttribute("aria-valuetext", clock.textContent);
    figure.dataset.painted = "yes";
  }

  function resize() {
    canvas.width = canvas.clientWidth * devicePixelRatio;
    canvas.height = canvas.clientHeight * devicePixelRatio;
    paint();
  }

  function show(frame) {
    view.frame = Math.max(0, Math.min(frames - 1, frame));
    slider.value = view.frame;
    paint();
  }

  // By the clock: a slow machine shows fewer pictures, not a slower motion.
  function play(now) {
    if (!view.playing) return;
    const frame = Math.floor((((now - view.from) / 1000 / PLAYING) % 1) * frames);
    if (frame !== view.frame) show(frame);
    requestAnimationFrame(play);
  }

  function start(playing) {
    view.playing = playing;
    button.textContent = playing ? "pause" : "play";
    button.setAttribute("aria-label", `${button.textContent}: ${figure.dataset.title}`);
    if (!playing) return;
    const at = view.frame === frames - 1 ? 0 : view.frame;
    view.from = performance.now() - (at / frames) * PLAYING * 1000;
    requestAnimationFrame(play);
  }

  function turn(right, up) {
    view.turn -= right;
    view.tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.tilt + up));
    paint();
  }

  function zoom(factor) {
    view.zoom = Math.max(0.3, Math.min(8, view.zoom * factor));
    paint();
  }

  makeTouchable(canvas, turn, zoom, {
    " ": () => start(!view.playing), ".": () => { start(false); show(view.frame + 1); },
  });
  slider.max = frames - 1;
  slider.value = frames - 1;
  slider.addEventListener("input", () => { start(false); show(Number(slider.value)); });
  button.addEventListener("click", () => start(!view.playing));
  step.addEventListener("click", () => { start(false); show(view.frame + 1); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);
  figure.classList.toggle("still", frames < 2);
  addEventListener("resize", resize);
  // A hidden page stands still.
  let hidden = 0;
  document.addEventListener("visibilitychange", () => {
    if (document.hidden) hidden = performance.now();
    else view.from += performance.now() - hidden;
  });
  resize();
}

document.querySelectorAll("figure.solid").forEach(makeSolid);
