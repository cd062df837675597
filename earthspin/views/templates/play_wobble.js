// The ladder of the free wobble: from the rigid Earth to one with an elastic mantle, a core, an ocean and rocks that give way slowly.
"use strict";

{
  const { shown } = play, given = JSON.parse(document.getElementById("given").textContent);
  const RUNGS = [["rigid", "rigid"], ["elastic", "elastic mantle"], ["fluidCore", "fluid core"], ["ocean", "ocean"], ["anelastic", "anelastic mantle"]];

  const motion = ({ flattening, k2, core, ellipticity, ocean, exponent }) => {
    const scale = k2 / given.k2;
    return formulas.wobble({
      flattening: flattening / 1000, k2, coreFraction: core, coreEllipticity: ellipticity / 1000, ocean,
      coreK: given.coreK * scale, kPressure: given.kPressure * scale, coreKPressure: given.coreKPressure * scale,
      unitStrain: (given.strain * flattening) / (1000 - flattening),
      anelastic: { exponent, day: given.day * 86400, softening: given.softening, range: given.softeningRange },
    });
  };

  play.start({
    settings: [
      { name: "flattening", words: "dynamical flattening H", unit: "/ 1000", min: 2.5, max: 6, step: 0.0001, value: given.flattening * 1000 },
      { name: "k2", words: "Love number k₂", unit: "", min: 0.05, max: 0.5, step: 0.0001, value: given.k2 },
      { name: "core", words: "core fraction of the moment of inertia", unit: "", min: 0.01, max: 0.4, step: 0.0001, value: given.coreFraction },
      { name: "ellipticity", words: "ellipticity of the core", unit: "/ 1000", min: 1, max: 5, step: 0.0001, value: given.coreEllipticity * 1000 },
      { name: "ocean", words: "Love number of the ocean Δk", unit: "", min: 0, max: 0.1, step: 0.0001, value: given.ocean },
      { name: "exponent", words: "anelastic exponent α", unit: "", min: 0, max: 0.3, step: 0.001, value: given.exponent },
    ],
    motion,
    pace: 1,
    still: true,
    readings: (m) => [
      ...RUNGS.map(([name, words]) => [words, shown(m[name] * given.day, 6, " days")]),
      ["free core nutation, in space", shown(m.coreNutation * given.day, 5, " days")],
    ],
    draw({ motion: m, ink, canvas, pen }) {
      const scale = devicePixelRatio, [width, height] = [canvas.width, canvas.height];
      const days = RUNGS.map(([name]) => m[name] * given.day), top = 1.15 * Math.max(given.observed, ...days);
      const [left, right, bottom] = [56 * scale, 20 * scale, 44 * scale];
      const x = (i) => left + ((width - left - right) * (i + 0.5)) / RUNGS.length;
      const y = (d) => height - bottom - ((height - bottom - 20 * scale) * d) / top;
      pen.clearRect(0, 0, width, height);
      pen.font = `${13 * scale}px system-ui, sans-serif`;
      pen.lineWidth = scale;
      for (let d = 0; d < top; d += top > 800 ? 200 : 100) {
        pen.strokeStyle = ink("line");
        pen.beginPath(); pen.moveTo(left, y(d)); pen.lineTo(width - right, y(d)); pen.stroke();
        pen.fillStyle = ink("soft"); pen.textAlign = "right";
        pen.fillText(`${d} d`, left - 6 * scale, y(d) + 4 * scale);
      }
      pen.strokeStyle = pen.fillStyle = ink("red");
      pen.setLineDash([6 * scale, 4 * scale]);
      pen.beginPath(); pen.moveTo(left, y(given.observed)); pen.lineTo(width - right, y(given.observed)); pen.stroke();
      pen.setLineDash([]);
      pen.textAlign = "center";
      pen.fillText("observed", x(0), y(given.observed) - 6 * scale);
      days.forEach((d, i) => {
        const number = pen.measureText(shown(d, 4)).width + 6 * scale;
        const wide = Math.max(((width - left - right) / RUNGS.length) * 0.5, number);
        pen.fillStyle = ink("blue");
        pen.fillRect(x(i) - wide / 2, y(d), wide, y(0) - y(d));
        pen.fillStyle = ink("paper");
        pen.fillText(shown(d, 4), x(i), y(d) + 20 * scale);
        pen.fillStyle = ink("ink");
        RUNGS[i][1].split(" ").forEach((word, n) => pen.fillText(word, x(i), height - bottom + (17 + 15 * n) * scale));
      });
    },
  });
}
