// The heavy top: what its tip draws, and when it stands.
"use strict";

{
  const { circle, degrees, shown } = play;
  const GRAVITY = 9.80665, MASS = 0.2, PIVOT = 0.05; // m/s2, kg, m from the point to the centre of mass

  // kg m2 about the pivot; the axial moment is that of a disc, the transverse one of disc and lever.
  const moments = (radius) => ({ axial: (MASS * radius ** 2) / 2, transverse: (MASS * radius ** 2) / 4 + MASS * PIVOT ** 2 });
  const motion = ({ radius, theta, spin, push }) =>
    formulas.top({ ...moments(radius / 100), weight: MASS * GRAVITY * PIVOT, theta: theta * degrees, spin, phiRate: push });
  const outline = (r) => [[0, 0], [0.03, 0.06], [0.1 + r * 0.25, 0.34], [r * 0.8, 0.5], [r, 0.58], [r, 0.66], [r * 0.8, 0.73], [0.09, 0.79], [0.045, 0.85], [0.045, 1.08], [0.0, 1.1]];
  const tips = (m, until, count) => Array.from({ length: count + 1 }, (_, i) => {
    const [theta, phi] = m.at((until * i) / count), s = Math.sin(theta);
    return [1.18 * s * Math.sin(phi), -1.18 * s * Math.cos(phi), 1.18 * Math.cos(theta)];
  });

  play.start({
    settings: [
      { name: "radius", words: "radius of the top", unit: "cm", min: 1.5, max: 6, step: 0.05, value: 3.5 },
      { name: "theta", words: "inclination at the start", unit: "°", min: 5, max: 85, step: 0.5, value: 35 },
      { name: "spin", words: "spin", unit: "rad/s", min: 10, max: 300, step: 1, value: 210 },
      { name: "push", words: "initial rate of precession", unit: "rad/s", min: -12, max: 12, step: 0.05, value: 0 },
    ],
    motion,
    pace: 0.12,
    reach: 1.2,
    tilt: 0.22,
    readings: (m, values, time) => [
      ["mean precession", shown(m.meanRate, 6, " rad/s")],
      ["period of nutation", shown(m.period * 1000, 6, " ms")],
      ["inclination", `${shown(m.turning[0] / degrees, 5)}° to ${shown(m.turning[1] / degrees, 5)}°`],
      ["steady rate of precession", shown(m.steady, 5, " rad/s")],
      ["path of the axis", m.pattern],
      ["time", shown(time, 4, " s")],
    ],
    draw({ scene, values, motion: m, time, ink }) {
      const [theta, phi, psi] = m.at(time), [st, ct] = [Math.sin(theta), Math.cos(theta)];
      const node = [Math.cos(phi), Math.sin(phi), 0], axis = [st * Math.sin(phi), -st * Math.cos(phi), ct];
      const beside = [axis[1] * node[2] - axis[2] * node[1], axis[2] * node[0] - axis[0] * node[2], axis[0] * node[1] - axis[1] * node[0]];
      const [s, c] = [Math.sin(psi), Math.cos(psi)];
      // The point stands on a floor below the middle of the picture; if the disc does not clear the floor, the point
      // is on a stand in the middle. The lowest point of the disc is on the rim of its lower face.
      const rim = 0.13 * values.radius + 0.05, lowest = Math.max(...m.turning);
      const falls = 0.58 * Math.cos(lowest) < rim * Math.sin(lowest);
      const columns = [node.map((n, i) => c * n + s * beside[i]), node.map((n, i) => -s * n + c * beside[i]), axis];
      const rows = play.revolved(outline(rim)), shift = falls ? 0 : 0.55;
      // In the body, down is the third row of the turn.
      const down = columns.map((column) => -shift * column[2]);
      scene.surface(rows.map((row) => row.map((p) => p.map((x, i) => x + down[i]))), columns, (i, j) => (i > 7 ? "#8a6a48" : Math.floor(j / 6) % 2 ? "#c7502c" : "#e2b24a"));
      for (let r = 0.3; r < 1 && !falls; r += 0.3) scene.line(circle(r, -0.555), ink("line"), 1);
      if (falls) for (const line of [[[0, 0, 0], [0, 0, -1.1]], circle(0.25, -1.1)]) scene.line(line, ink("soft"), 2);
      for (const angle of m.turning) scene.line(circle(1.18 * Math.sin(angle), 1.18 * Math.cos(angle) - shift), ink("soft"), 1, [3, 4]);
      const until = time > 0 ? time : 6 * m.period, begin = Math.max(0, until - 12 * m.period);
      const trail = Array.from({ length: 361 }, (_, i) => {
        const [a, b] = m.at(begin + ((until - begin) * i) / 360);
        return [1.18 * Math.sin(a) * Math.sin(b), -1.18 * Math.sin(a) * Math.cos(b), 1.18 * Math.cos(a) - shift];
      });
      scene.line(trail, ink("blue"), 2.5);
      scene.line([[0, 0, -shift], [0, 0, 1.4 - shift]], ink("soft"), 1, [5, 5]);
    },
  });
}
