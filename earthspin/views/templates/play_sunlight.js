// Daily insolation over latitude and season for any orbit, and its difference from today.
"use strict";

{
  const { degrees, shown } = play, given = JSON.parse(document.getElementById("given").textContent);
  const CARDINAL = ["Mar", "Jun solstice", "Sep equinox", "Dec solstice", "Mar"], FIRST = 1;
  // Colours from night to the longest polar day.
  const SCALE = ["#0b1030", "#3b1d6e", "#8c2981", "#d8456c", "#fb8861", "#fec77f", "#fcfdbf"];

  const sky = ({ obliquity, eccentricity, perihelion }) =>
    formulas.insolation({ obliquity: obliquity * degrees, eccentricity, perihelion: perihelion * degrees });
  const today = sky(given.epochs[0]), watts = (x) => x * given.solarConstant;

  const rgb = (hex) => (hex.length < 7 ? [...hex.slice(1)].map((c) => c + c) : hex.slice(1).match(/../g)).map((c) => parseInt(c, 16));
  const blend = (colours, share) => {
    const place = Math.max(0, Math.min(1, share)) * (colours.length - 1), i = Math.min(colours.length - 2, Math.floor(place));
    return colours[i].map((c, k) => c + (place - i) * (colours[i + 1][k] - c));
  };
  // 1, 2 or 5 times a power of ten, at least x.
  const rounded = (x) => {
    const power = 10 ** Math.floor(Math.log10(x));
    return [1, 2, 5, 10].map((n) => n * power).find((n) => n >= x * (1 - 1e-9));
  };

  // W/m2 at the centres of pixels: rows from north to south, columns from equinox to equinox.
  function values(orbit, columns, rows) {
    const grid = new Float64Array(columns * rows);
    for (let i = 0; i < columns; i++) {
      const there = orbit.at((2 * Math.PI * (i + 0.5)) / columns);
      for (let j = 0; j < rows; j++) grid[j * columns + i] = watts(there(Math.PI * (0.5 - (j + 0.5) / rows)));
    }
    return grid;
  }
  let remembered = { size: "" };
  function valuesToday(columns, rows) {
    const size = `${columns} ${rows}`;
    if (remembered.size !== size) remembered = { size, grid: values(today, columns, rows) };
    return remembered.grid;
  }

  // Colours of all pixels, with a line wherever a multiple of the step is crossed.
  function painted(pen, grid, columns, rows, low, high, step, colours) {
    const image = pen.createImageData(columns, rows), level = (k) => Math.floor(grid[k] / step - 1e-9);
    for (let j = 0; j < rows; j++) for (let i = 0; i < columns; i++) {
      const k = j * columns + i;
      const line = (i + 1 < columns && level(k) !== level(k + 1)) || (j + 1 < rows && level(k) !== level(k + columns));
      const colour = blend(colours, (grid[k] - low) / (high - low));
      for (let c = 0; c < 3; c++) image.data[4 * k + c] = line ? 0.62 * colour[c] + 0.38 * 128 : colour[c];
      image.data[4 * k + 3] = 255;
    }
    return image;
  }

  let frames = [];  // places of the two maps on the canvas, in pixels of the canvas
  function map({ pen, ink, scale, width, frame, title, image, low, high, step, colours, mark, last }) {
    const { left, top, columns, rows } = frame;
    pen.putImageData(image, left, top);
    pen.strokeStyle = pen.fillStyle = ink("soft");
    pen.lineWidth = scale;
    pen.strokeRect(left, top, columns, rows);
    pen.textAlign = "left";
    pen.fillStyle = ink("ink");
    pen.fillText(title, left, top - 8 * scale);
    pen.fillStyle = ink("soft");
    pen.textAlign = "right";
    for (const latitude of [90, 60, 30, 0, -30, -60, -90]) {
      if (rows < 110 * scale && latitude % 90) continue;
      const name = latitude ? `${Math.abs(latitude)}° ${latitude > 0 ? "N" : "S"}` : "0°";
      pen.fillText(name, left - 6 * scale, top + rows * (0.5 - latitude / 180) + 4 * scale);
    }
    if (last) CARDINAL.forEach((words, i) => {
      pen.textAlign = ["left", "center", "center", "center", "right"][i];
      pen.fillText(columns > 400 * scale ? words : words.slice(0, 3), left + (columns * i) / 4, top + rows + 17 * scale);
    });
    const [bar, thick] = [left + columns + 10 * scale, 12 * scale];
    for (let j = 0; j < rows; j++) {
      const [r, g, b] = blend(colours, 1 - (j + 0.5) / rows);
      pen.fillStyle = `rgb(${r}, ${g}, ${b})`;
      pen.fillRect(bar, top + j, thick, 1);
    }
    pen.strokeRect(bar, top, thick, rows);
    pen.fillStyle = ink("soft");
    pen.textAlign = "left";
    const every = Math.ceil(((14 * scale) / rows) * ((high - low) / step));
    for (let n = Math.ceil(low / step - 1e-9); n * step <= high * (1 + 1e-9); n++)
      if (n % every === 0) pen.fillText(shown(n * step + 0, 3), bar + thick + 5 * scale, top + (rows * (high - n * step)) / (high - low) + 4 * scale);
    const [x, y] = [left + (columns * mark.season) / 360, top + rows * (0.5 - mark.latitude / 180)];
    for (const [colour, thickness] of [["#000", 4], ["#fff", 2]]) {
      pen.strokeStyle = colour;
      pen.lineWidth = thickness * scale;
      pen.beginPath(); pen.arc(x, y, 5.5 * scale, 0, 2 * Math.PI); pen.stroke();
    }
  }

  play.start({
    settings: [
      { name: "epoch", words: "start from", choices: given.epochs.map((epoch) => epoch.words), value: FIRST, presets: given.epochs.map(({ words, ...elements }) => elements) },
      { name: "obliquity", words: "obliquity", unit: "°", min: 0, max: 90, step: 0.01, value: given.epochs[FIRST].obliquity },
      { name: "eccentricity", words: "eccentricity", unit: "", min: 0, max: 0.3, step: 0.0001, value: given.epochs[FIRST].eccentricity },
      { name: "perihelion", words: "longitude of perihelion ϖ", unit: "°", min: 0, max: 360, step: 0.1, value: given.epochs[FIRST].perihelion },
      { name: "latitude", words: "latitude of the readings", unit: "°", min: -90, max: 90, step: 0.5, value: 65 },
      { name: "season", words: "longitude of the Sun", unit: "°", min: 0, max: 360, step: 1, value: 90 },
    ],
    motion: sky,
    pace: 1,
    still: true,
    readings(orbit, { latitude, season, eccentricity, perihelion }) {
      const there = (one) => watts(one.at(season * degrees)(latitude * degrees));
      const year = (one) => watts(one.year(latitude * degrees));
      return [
        ["insolation", shown(there(orbit), 6, " W/m²")],
        ["difference from today", shown(there(orbit) - there(today), 5, " W/m²")],
        ["annual mean", shown(year(orbit), 6, " W/m²")],
        ["annual mean, difference", shown(year(orbit) - year(today), 5, " W/m²")],
        ["climatic precession e sin ϖ", shown(eccentricity * Math.sin(perihelion * degrees), 4)],
        ["Earth nearest to the Sun at", shown((perihelion + 180) % 360, 4, "°")],
      ];
    },
    draw({ motion: orbit, values: { latitude, season }, ink, canvas, pen }) {
      const scale = devicePixelRatio, [width, height] = [canvas.width, canvas.height];
      const [left, right, above, below] = [46, 66, 26, 26].map((x) => Math.round(x * scale));
      const columns = Math.max(16, width - left - right), rows = Math.max(16, Math.floor((height - 2 * above - below) / 2));
      frames = [above, 2 * above + rows].map((top) => ({ left, top, columns, rows }));
      const now = values(orbit, columns, rows), then = valuesToday(columns, rows), change = now.map((w, k) => w - then[k]);
      const most = now.reduce((a, b) => Math.max(a, b)), high = 100 * Math.max(6, Math.ceil(most / 100));
      const largest = change.reduce((a, b) => Math.max(a, Math.abs(b)), 1);
      const step = rounded(largest / 6), far = step * Math.ceil(largest / step);
      const [blue, paper, red] = ["blue", "paper", "red"].map((name) => rgb(ink(name)));
      pen.clearRect(0, 0, width, height);
      pen.font = `${13 * scale}px system-ui, sans-serif`;
      const both = [
        { title: "Daily insolation, W/m²", grid: now, low: 0, high, step: high > 1000 ? 200 : 100, colours: SCALE.map(rgb) },
        { title: "Difference from today, W/m²", grid: change, low: -far, high: far, step, colours: [blue, paper, red] },
      ];
      both.forEach(({ grid, ...one }, i) => {
        const image = painted(pen, grid, columns, rows, one.low, one.high, one.step, one.colours);
        map({ pen, ink, scale, width, frame: frames[i], image, mark: { latitude, season }, last: i === 1, ...one });
      });
    },
  });

  const canvas = document.getElementById("picture");
  canvas.style.cursor = "crosshair";
  canvas.addEventListener("click", ({ offsetX, offsetY }) => {
    const [x, y] = [offsetX, offsetY].map((p) => p * devicePixelRatio);
    const frame = frames.find(({ left, top, columns, rows }) => x >= left && x <= left + columns && y >= top && y <= top + rows);
    if (!frame) return;
    const place = { season: (360 * (x - frame.left)) / frame.columns, latitude: 180 * (0.5 - (y - frame.top) / frame.rows) };
    for (const [name, value] of Object.entries(place)) {
      const slider = document.getElementById(name);
      slider.value = value;
      slider.dispatchEvent(new Event("input"));
    }
  });
}
