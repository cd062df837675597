// A body without torque: a brick, thrown, with the path of its angular velocity, or a planet, whose
// body cone rolls on the space cone.
"use strict";

{
  const { ellipsoid, degrees, shown } = play;

  // Moments of a uniform brick with three sides, or ellipsoid with three axes, per unit of mass.
  const moments = ({ x, y, z, shape }) =>
    [y * y + z * z, x * x + z * z, x * x + y * y].map((sum) => sum / (shape ? 20 : 12));
  const AXES = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  // The start: about one of the axes, with a little about the others.
  const first = ({ about, off, speed }) => {
    const next = (about + 1) % 3, c = Math.cos(off * degrees), s = Math.sin(off * degrees);
    return AXES[0].map((_, i) => speed * (i === about ? c : i === next ? 0.8 * s : 0.6 * s));
  };
  const motion = (values) => ({ ...formulas.rotor(moments(values), first(values)), start: first(values) });
  const faces = ({ x, y, z }, scale) => {
    const half = [x, y, z].map((side) => (side * scale) / 2), found = [];
    for (const axis of [0, 1, 2]) for (const side of [-1, 1]) {
      const [p, q] = [(axis + 1) % 3, (axis + 2) % 3], rows = [];
      for (let i = 0; i <= 4; i++) rows.push(Array.from({ length: 5 }, (_, j) => {
        const point = [0, 0, 0];
        point[axis] = side * half[axis];
        point[p] = half[p] * (i / 2 - 1);
        point[q] = half[q] * (j / 2 - 1);
        return point;
      }));
      found.push({ rows, axis, side });
    }
    return found;
  };
  const COLOURS = [["#2f7fb8", "#7db8df"], ["#c7502c", "#e8946f"], ["#3a8f62", "#8cc7a2"]];

  play.start({
    settings: [
      { name: "shape", words: "body", choices: ["brick", "planet, with its cones"], value: 0,
        presets: [{ x: 2, y: 1.3, z: 0.45, about: 1, off: 1.5 }, { x: 2, y: 2, z: 1.6, about: 2, off: 20 }] },
      { name: "x", words: "side along x", unit: "", min: 0.4, max: 3, step: 0.01, value: 2 },
      { name: "y", words: "side along y", unit: "", min: 0.4, max: 3, step: 0.01, value: 1.3 },
      { name: "z", words: "side along z", unit: "", min: 0.4, max: 3, step: 0.01, value: 0.45 },
      { name: "about", words: "initial rotation axis", choices: ["x", "y", "z"], value: 1 },
      { name: "off", words: "initial angle from this axis", unit: "°", min: 0.1, max: 45, step: 0.1, value: 1.5 },
      { name: "speed", words: "angular speed", unit: "rad/s", min: 0.5, max: 6, step: 0.1, value: 3 },
    ],
    motion,
    pace: 1,
    reach: 1.15,
    tilt: 0.25,
    readings: (m, values, time) => [
      ["period of the polhode", shown(m.period, 6, " s")],
      ["energy over ½ L ω", shown((2 * m.energy) / (m.momentum * Math.hypot(...m.start)), 6)],
      ["angular velocity now", `${m.omega(time).map((w) => shown(w, 3)).join(", ")} rad/s`],
      ["time", shown(time, 4, " s")],
    ],
    draw({ scene, values, motion: m, time, ink }) {
      const rows = m.attitude(time), columns = AXES.map((_, i) => rows.map((row) => row[i]));
      const scale = (values.shape ? 1.3 : 1.5) / Math.hypot(values.x, values.y, values.z);
      const planet = ellipsoid([values.x, values.y, values.z].map((side) => (side * scale) / 2));
      if (values.shape) scene.surface(planet, columns, (i, j) => (Math.floor(j / 3) % 2 ? "#3d7fc0" : "#6f9f62"));
      else for (const { rows: face, axis, side } of faces(values, scale))
        scene.surface(face, columns, (i, j) => COLOURS[axis][(i + j) % 2 && side > 0 ? 1 : 0]);
      const inSpace = (p) => [0, 1, 2].map((i) => p[0] * columns[0][i] + p[1] * columns[1][i] + p[2] * columns[2][i]);
      const span = Number.isFinite(m.period) ? m.period : 20, size = 0.95 / values.speed;
      const path = Array.from({ length: 241 }, (_, i) => inSpace(m.omega((span * i) / 240).map((w) => w * size)));
      scene.line(path, ink("red"), 2);
      if (values.shape) {
        // Both cones have their tip in the middle; they touch along the angular velocity.
        const cone = (rim) => [rim.map(() => [0, 0, 0]), rim];
        const inBody = Array.from({ length: 97 }, (_, i) => m.omega((span * i) / 96).map((w) => w * size));
        // Once round the angular momentum, or nearly so.
        const lasts = Math.min(span, (2.1 * Math.PI * Math.max(...moments(values))) / m.momentum);
        const begin = Math.max(0, time - lasts), rolled = Array.from({ length: 97 }, (_, i) => {
          const at = begin + lasts * (i / 96), now = m.attitude(at), w = m.omega(at);
          return now.map((row) => size * (row[0] * w[0] + row[1] * w[1] + row[2] * w[2]));
        });
        scene.surface(cone(inBody), columns, () => ink("red"), 0.3);
        scene.surface(cone(rolled), AXES, () => ink("blue"), 0.3);
        scene.line(rolled, ink("blue"), 2);
      }
      scene.arrow(inSpace(m.omega(time).map((w) => w * size)), ink("ink"), "ω");
      scene.arrow([0, 0, 1.05], ink("blue"), "L");
    },
  });
}
