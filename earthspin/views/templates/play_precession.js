// Precession of a body under Sun and Moon: rate, period, and the path of its pole.
"use strict";

{
  const { ellipsoid, circle, degrees, shown } = play, given = JSON.parse(document.getElementById("given").textContent);
  const YEAR = 365.25 * 86400, ARCSEC = degrees / 3600;

  const motion = ({ mass, distance, obliquity, flattening }) =>
    formulas.precession({
      flattening: flattening / 1000, spin: given.spin, obliquity: obliquity * degrees,
      pulls: [given.sun, { ...given.moon, gm: given.moon.gm * mass, distance: given.moon.distance * distance }],
    });

  play.start({
    settings: [
      { name: "mass", words: "mass of the Moon", unit: "× present", min: 0, max: 4, step: 0.01, value: 1 },
      { name: "distance", words: "distance of the Moon", unit: "× present", min: 0.5, max: 2, step: 0.005, value: 1 },
      { name: "obliquity", words: "obliquity", unit: "°", min: 1, max: 89, step: 0.01, value: given.obliquity / degrees },
      { name: "flattening", words: "dynamical flattening H", unit: "/ 1000", min: 0.1, max: 10, step: 0.0001, value: given.flattening * 1000 },
    ],
    motion,
    pace: 1300 * YEAR, // a turn of the Earth's axis in twenty seconds
    reach: 1.45,
    tilt: 0.32,
    readings: (m, values, time) => [
      ["rate of precession", shown((m.rate * YEAR) / ARCSEC, 7, " ″ per year")],
      ["once round in", shown(m.period / YEAR, 6, " years")],
      ["share of the Moon", shown((100 * m.rates[1]) / m.rate, 3, " %")],
      ["time", shown(time / YEAR, 5, " years")],
    ],
    draw({ scene, values, motion: m, time, ink }) {
      const tilt = values.obliquity * degrees, angle = Math.PI / 2 - m.rate * time;
      const [sin, cos] = [Math.sin(tilt), Math.cos(tilt)], axis = [sin * Math.cos(angle), sin * Math.sin(angle), cos];
      const node = [-Math.sin(angle), Math.cos(angle), 0];
      const beside = [axis[1] * node[2] - axis[2] * node[1], axis[2] * node[0] - axis[0] * node[2], axis[0] * node[1] - axis[1] * node[0]];
      // It turns far more slowly than it would, so that one sees it turn.
      const spin = 3 * 2 * Math.PI * (time / (1300 * YEAR)), [s, c] = [Math.sin(spin), Math.cos(spin)];
      const columns = [node.map((n, i) => c * n + s * beside[i]), node.map((n, i) => -s * n + c * beside[i]), axis];
      // Flattened twenty times more than in reality.
      const planet = ellipsoid([0.8, 0.8, 0.8 * (1 - values.flattening / 50)], 24, 48);
      scene.surface(planet, columns, (i, j) => (i < 3 || i > 20 ? "#e8eef2" : (Math.sin(j / 3.6) + Math.cos(i / 2.5 + j / 6.7)) > 0.55 ? "#6f9f62" : "#3d7fc0"));
      scene.line(circle(1.35, 0), ink("line"), 1);
      scene.label([1.35, 0, 0], "ecliptic", ink("soft"));
      const length = 1.2;
      scene.line(circle(length * sin, length * cos), ink("soft"), 1, [3, 4]);
      const gone = Math.min(Math.abs(m.rate * time), 2 * Math.PI) * Math.sign(m.rate || 1);
      scene.line(circle(length * sin, length * cos, angle, angle + gone), ink("red"), 3);
      scene.line([[0, 0, -1.3], [0, 0, 1.3]], ink("soft"), 1, [5, 5]);
      scene.label([0, 0, -1.3], "normal to the ecliptic", ink("soft"));
      scene.arrow(axis.map((x) => length * x), ink("red"), "pole", axis.map((x) => -length * x));
      // A month lasts nine turns of the planet in the picture; distances are drawn by their fourth root.
      const moon = circle(1.12 * values.distance ** 0.25, 0, spin / 9 + 0.6, spin / 9 + 0.6, 1)[0], size = 0.09 * Math.cbrt(values.mass);
      if (size > 0) scene.surface(ellipsoid([size, size, size], 8, 12).map((row) => row.map((p) => p.map((x, i) => x + moon[i]))), [[1, 0, 0], [0, 1, 0], [0, 0, 1]], () => "#c9c5ba");
    },
  });
}
