// What the pages to play with share: sliders, clock, keys, and bodies drawn with light and shade.
// A page calls play({ settings, motion, readings, draw }).
"use strict";

const play = (() => {
  const find = (name) => document.getElementById(name);
  const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

  // --- drawing: a camera, and a list of pieces that is painted from the back --------------------------

  function camera(canvas, view) {
    const pen = canvas.getContext("2d");
    let pieces = [];
    const turn = (p) => {
      const [ct, st, cp, sp] = [Math.cos(view.turn), Math.sin(view.turn), Math.cos(view.tilt), Math.sin(view.tilt)];
      const x = ct * p[0] + st * p[1], away = -st * p[0] + ct * p[1];
      return [x, cp * p[2] + sp * away, sp * p[2] - cp * away];
    };
    const size = () => (Math.min(canvas.width, canvas.height) / 2 / view.reach) * view.zoom;
    const at = (p) => {
      const [x, y, depth] = turn(p), s = size();
      return [canvas.width / 2 + s * x, canvas.height / 2 - s * y, depth];
    };
    const scene = {
      line(points, colour, width = 1.5, dash = []) {
        const places = points.map(at);
        for (let i = 0; i + 1 < places.length; i++)
          pieces.push({ depth: (places[i][2] + places[i + 1][2]) / 2 + 1e-3, kind: "line", places: [places[i], places[i + 1]], colour, width, dash });
      },
      arrow(tip, colour, label, from = [0, 0, 0]) {
        const places = [at(from), at(tip)];
        pieces.push({ depth: (places[0][2] + places[1][2]) / 2 + 2e-3, kind: "arrow", places, colour, label });
      },
      // A surface of points (rows of points in the body), turned by three columns, with one colour a face.
      surface(rows, columns, colourOf, opacity = 1) {
        const space = rows.map((row) => row.map((p) => [0, 1, 2].map((i) => p[0] * columns[0][i] + p[1] * columns[1][i] + p[2] * columns[2][i])));
        for (let i = 0; i + 1 < rows.length; i++)
          for (let j = 0; j + 1 < rows[i].length; j++) {
            const corners = [space[i][j], space[i][j + 1], space[i + 1][j + 1], space[i + 1][j]];
            const [p, q] = [corners[2].map((x, k) => x - corners[0][k]), corners[3].map((x, k) => x - corners[1][k])];
            const normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
            const length = Math.hypot(...normal) || 1, facing = turn(normal.map((x) => x / length));
            const light = Math.abs(0.35 * facing[0] - 0.45 * facing[1] - 0.82 * facing[2]);
            const places = corners.map(at);
            pieces.push({ depth: places.reduce((sum, c) => sum + c[2], 0) / 4, kind: "face", places, colour: colourOf(i, j), light, opacity });
          }
      },
      label(place, words, colour) {
        pieces.push({ depth: 1e9, kind: "label", places: [at(place)], colour, words });
      },
    };
    // A label that would cross the right edge stands before it.
    const write = (words, x, y, scale) =>
      pen.fillText(words, Math.min(x, canvas.width - pen.measureText(words).width - 4 * scale), y);
    function paint() {
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.lineJoin = pen.lineCap = "round";
      const scale = devicePixelRatio;
      for (const piece of pieces.sort((a, b) => a.depth - b.depth)) {
        const [from, to] = piece.places;
        pen.strokeStyle = pen.fillStyle = piece.colour;
        pen.setLineDash((piece.dash || []).map((d) => d * scale));
        pen.lineWidth = (piece.width || 2.5) * scale;
        pen.font = `${14 * scale}px system-ui, sans-serif`;
        if (piece.kind === "label") { write(piece.words, from[0] + 6 * scale, from[1] - 6 * scale, scale); continue; }
        pen.beginPath();
        piece.places.forEach((p, i) => (i ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1])));
        if (piece.kind === "face") {
          pen.closePath();
          pen.fillStyle = pen.strokeStyle = `color-mix(in srgb, ${piece.colour} ${Math.round(45 + 55 * piece.light)}%, #101418)`;
          pen.lineWidth = 0.7 * scale;
          pen.globalAlpha = piece.opacity;
          pen.fill();
          if (piece.opacity < 1) { pen.globalAlpha = 1; continue; } // seams would show twice
        }
        pen.stroke();
        if (piece.kind !== "arrow") continue;
        const angle = Math.atan2(to[1] - from[1], to[0] - from[0]), head = 10 * scale;
        pen.beginPath();
        pen.moveTo(to[0], to[1]);
        for (const side of [-0.4, 0.4]) pen.lineTo(to[0] - head * Math.cos(angle + side), to[1] - head * Math.sin(angle + side));
        pen.fill();
        if (piece.label) write(piece.label, to[0] + 8 * scale, to[1] - 6 * scale, scale);
      }
      pieces = [];
    }
    return { scene, paint, pen };
  }

  // --- shapes -----------------------------------------------------------------------------------------

  // Rows of points of a body of revolution about the third axis, from its outline of (radius, height).
  const revolved = (outline, columns = 36) =>
    outline.map(([r, z]) => Array.from({ length: columns + 1 }, (_, j) => {
      const angle = (2 * Math.PI * j) / columns;
      return [r * Math.cos(angle), r * Math.sin(angle), z];
    }));
  const ellipsoid = (axes, rows = 18, columns = 36) =>
    revolved(Array.from({ length: rows + 1 }, (_, i) => [Math.sin((Math.PI * i) / rows), Math.cos((Math.PI * i) / rows)]), columns)
      .map((row) => row.map((p) => p.map((x, i) => x * axes[i])));
  const circle = (radius, height, from = 0, to = 2 * Math.PI, count = 96) =>
    Array.from({ length: count + 1 }, (_, i) => {
      const angle = from + ((to - from) * i) / count;
      return [radius * Math.cos(angle), radius * Math.sin(angle), height];
    });

  // --- the page ---------------------------------------------------------------------------------------

  function start({ settings, motion, readings, draw, pace, reach = 1.6, tilt = 0.3, still = false, step = 1 / 30 }) {
    const canvas = find("picture"), button = find("play"), state = { time: 0, playing: false, last: 0, speed: 1 };
    const view = { turn: 0.5, tilt, zoom: 1, reach };
    const { scene, paint, pen } = camera(canvas, view);
    // Start values have eight digits, and all of them are shown: what is shown gives what is read.
    for (const setting of settings) setting.value = Number(setting.value.toPrecision(8));
    const values = Object.fromEntries(settings.map(({ name, value }) => [name, value]));
    let moving = motion(values);

    function show() {
      draw({ scene, values, motion: moving, time: state.time, ink, canvas, pen });
      if (!still) paint();
      find("readings").replaceChildren(...readings(moving, values, state.time).flatMap(([words, number]) => {
        const [term, told] = [document.createElement("dt"), document.createElement("dd")];
        term.textContent = words;
        told.textContent = number;
        return [term, told];
      }));
      canvas.dataset.painted = "yes";
    }
    function resize() {
      canvas.width = canvas.clientWidth * devicePixelRatio;
      canvas.height = canvas.clientHeight * devicePixelRatio;
      show();
    }
    // By the clock: a slow machine shows fewer pictures, not a slower motion.
    function goOn() {
      const now = performance.now();
      state.time += ((now - state.last) / 1000) * state.speed * pace;
      state.last = now;
      show();
    }
    function tick() {
      if (!state.playing) return;
      goOn();
      requestAnimationFrame(tick);
    }
    function run(playing) {
      if (state.playing) goOn();
      state.playing = playing;
      button.textContent = playing ? "Pause" : "Play";
      state.last = performance.now();
      if (playing) requestAnimationFrame(tick);
    }
    function one(direction) { run(false); state.time = Math.max(0, state.time + direction * step * pace * state.speed); show(); }
    function update() {
      moving = motion(values);
      show();
    }
    function setSpeed(power) {
      const slider = find("playback"), words = `× ${shown(2 ** power, 3)}`;
      state.speed = 2 ** power;
      slider.value = power;
      slider.setAttribute("aria-valuetext", words);
      find("playback-shown").textContent = words;
    }
    function turn(right, up) {
      view.turn -= right;
      view.tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.tilt + up));
      show();
    }
    function zoom(factor) { view.zoom = Math.max(0.3, Math.min(6, view.zoom * factor)); show(); }

    const changes = {};  // by setting: show and use a value
    for (const { name, words, unit, min, max, value, step: fine, choices, presets } of settings) {
      const label = document.createElement("label"), told = document.createElement("output");
      const input = document.createElement(choices ? "select" : "input");
      if (choices) input.append(...choices.map((choice, i) => new Option(choice, i)));
      else Object.assign(input, { type: "range", min, max, step: "any" });
      input.id = name;
      changes[name] = (number) => {
        input.value = number;
        if (!choices) told.textContent = `${shown(number, 8)} ${unit}`.trim();
        if (!choices) input.setAttribute("aria-valuetext", told.textContent);
        values[name] = number;
      };
      input.addEventListener("input", () => {
        changes[name](choices ? Number(input.value) : Number((Math.round(input.value / fine) * fine).toPrecision(8)));
        for (const [other, number] of Object.entries(presets?.[input.value] ?? {})) changes[other](number);
        update();
      });
      changes[name](value);
      label.append(words, input, told);
      find("settings").append(label);
    }
    find("again").addEventListener("click", () => {
      for (const { name, value } of settings) changes[name](value);
      if (!still) setSpeed(0);
      state.time = 0;
      state.last = performance.now();
      update();
    });
    addEventListener("resize", resize);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
    if (!still) {
      button.addEventListener("click", () => run(!state.playing));
      find("step").addEventListener("click", () => one(1));
      find("playback").addEventListener("input", (e) => setSpeed(Number(e.target.value)));
      setSpeed(0);
      // A hidden page stands still.
      document.addEventListener("visibilitychange", () => {
        if (document.hidden && state.playing) goOn();
        state.last = performance.now();
      });
      makeTouchable(canvas, turn, zoom, {
        " ": () => run(!state.playing), ".": () => one(1), ",": () => one(-1),
      });
    }
    resize();
  }

  const degrees = Math.PI / 180;
  const shown = (x, digits, unit = "") =>
    Number.isFinite(x) ? x.toLocaleString("en", { maximumSignificantDigits: digits, useGrouping: false }).replace("-", "\u2212") + unit : "none";
  return { start, revolved, ellipsoid, circle, degrees, shown };
})();
