// The motions of the pages to play with, in closed form; angles in rad, times in s.
// Each function is compared with the library at a hundred random settings.
"use strict";

const formulas = (() => {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const times = (s, a) => a.map((x) => s * x);
  const unit = (a) => times(1 / Math.hypot(...a), a);

  // --- elliptic functions ------------------------------------------------------------------------

  // Jacobi's sn, cn, dn of argument u and parameter m <= 1, by descending Landen steps.
  function jacobi(u, m) {
    if (m >= 1) return [Math.tanh(u), 1 / Math.cosh(u), 1 / Math.cosh(u)];
    const a = [1], c = [Math.sqrt(m)];
    let b = Math.sqrt(1 - m), n = 0;
    for (; Math.abs(c[n]) > 1e-16 && n < 30; n++) {
      a.push((a[n] + b) / 2);
      c.push((a[n] - b) / 2);
      b = Math.sqrt(a[n] * b);
    }
    let phi = 2 ** n * a[n] * u;
    for (; n > 0; n--) phi = (phi + Math.asin((c[n] / a[n]) * Math.sin(phi))) / 2;
    const sn = Math.sin(phi);
    return [sn, Math.cos(phi), Math.sqrt(1 - m * sn * sn)];
  }

  // Complete integral of the first kind.
  function complete(m) {
    if (m >= 1) return Infinity;
    let a = 1, b = Math.sqrt(1 - m);
    while (Math.abs(a - b) > 1e-15 * a) [a, b] = [(a + b) / 2, Math.sqrt(a * b)];
    return Math.PI / (a + b);
  }

  // Carlson's R_F (Carlson 1995, Numer. Algorithms 10, 13).
  function carlson(x, y, z) {
    for (let i = 0; i < 60; i++) {
      const mean = (x + y + z) / 3;
      if (Math.max(Math.abs(x - mean), Math.abs(y - mean), Math.abs(z - mean)) < 1e-4 * mean) {
        const [p, q] = [1 - x / mean, 1 - y / mean], r = -p - q, e2 = p * q - r * r, e3 = p * q * r;
        return (1 - e2 / 10 + e3 / 14 + (e2 * e2) / 24 - (3 * e2 * e3) / 44) / Math.sqrt(mean);
      }
      const l = Math.sqrt(x * y) + Math.sqrt(y * z) + Math.sqrt(z * x);
      [x, y, z] = [(x + l) / 4, (y + l) / 4, (z + l) / 4];
    }
    return NaN;
  }

  // Integral of the first kind from 0 to phi, |phi| <= pi.
  function incomplete(phi, m) {
    if (Math.abs(phi) > Math.PI / 2) return Math.sign(phi) * (2 * complete(m) - incomplete(Math.PI - Math.abs(phi), m));
    const s = Math.sin(phi), c = Math.cos(phi);
    return s * carlson(c * c, 1 - m * s * s, 1);
  }

  // Gauss's rule with eight points over panels of even length.
  const NODES = [0.1834346424956498, 0.525532409916329, 0.7966664774136267, 0.9602898564975363];
  const WEIGHTS = [0.362683783378362, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763];
  function integral(rate, from, to, panels) {
    const half = (to - from) / panels / 2;
    let sum = 0;
    for (let i = 0; i < panels; i++) {
      const middle = from + (2 * i + 1) * half;
      for (let j = 0; j < 4; j++) sum += WEIGHTS[j] * (rate(middle - half * NODES[j]) + rate(middle + half * NODES[j]));
    }
    return sum * half;
  }

  // Twice as many panels until a whole period no longer changes: a top that passes close to upright
  // turns nearly all of it at once.
  const SETTLED = 1e-12, MOST_PANELS = 16384;

  // An angle that grows by the same amount in every period: its values at the edges of panels once,
  // and from the edge before a time on by one panel more.
  function grown(rate, period, panels) {
    if (!Number.isFinite(period) || period === 0) return (t) => integral(rate, 0, t, panels);
    const edgesOf = (count) => {
      const width = period / count, edges = [0];
      for (let i = 0; i < count; i++) edges.push(edges[i] + integral(rate, i * width, (i + 1) * width, 1));
      return edges;
    };
    let edges = edgesOf(panels), change = Infinity;
    while (change > SETTLED * Math.max(1, Math.abs(edges[panels])) && panels < MOST_PANELS) {
      const before = edges[panels];
      panels *= 2;
      edges = edgesOf(panels);
      change = Math.abs(edges[panels] - before);
    }
    const width = period / panels;
    return (t) => {
      const turns = Math.floor(t / period), rest = t - turns * period;
      const before = Math.min(panels - 1, Math.floor(rest / width));
      return turns * edges[panels] + edges[before] + integral(rate, before * width, rest, 1);
    };
  }

  // --- precession ---------------------------------------------------------------------------------

  // Rate of precession, rad/s, under bodies on Keplerian orbits whose node goes round on the ecliptic:
  // 3/2 H/Omega GM/(a^3 (1 - e^2)^(3/2)) cos(obliquity) (1 - 3/2 sin^2(inclination)), body by body.
  function precession({ flattening, spin, obliquity, pulls }) {
    const rates = pulls.map(({ gm, distance, eccentricity, inclination }) =>
      ((1.5 * flattening) / spin) * (gm / distance ** 3 / (1 - eccentricity ** 2) ** 1.5) *
      Math.cos(obliquity) * (1 - 1.5 * Math.sin(inclination) ** 2));
    const rate = rates.reduce((a, b) => a + b, 0);
    return { rates, rate, period: (2 * Math.PI) / Math.abs(rate) };
  }

  // --- free rotor -----------------------------------------------------------------------------------

  // Motion of a body without torque (Jacobi; Landau & Lifshitz, Mechanics, 37).
  // moments and omega along the principal axes; gives a function of time.
  function rotor(moments, omega) {
    const momentum = moments.map((m, i) => m * omega[i]), size = Math.hypot(...momentum);
    const energy2 = dot(momentum, omega), square = size * size;
    let order = [0, 1, 2].sort((i, j) => moments[i] - moments[j]);
    // The last axis is the one about which the angular velocity never changes its sign.
    if (square < energy2 * moments[order[1]]) order = order.reverse();
    const [I1, I2, I3] = order.map((i) => moments[i]), start = order.map((i) => omega[i]);
    const even = (order[1] - order[0] + 3) % 3 === 1 ? 1 : -1;
    const sense = even * Math.sign(I3 - I1);
    const off = Math.abs(energy2 * I3 - square), along = Math.abs(square - energy2 * I1);
    const a = Math.sqrt(off / (I1 * Math.abs(I3 - I1))), b = Math.sqrt(off / (I2 * Math.abs(I3 - I2)));
    const c = Math.sqrt(along / (I3 * Math.abs(I3 - I1)));
    const pace = Math.sqrt((Math.abs(I3 - I2) * along) / (I1 * I2 * I3));
    const m = off > 0 ? (Math.abs(I2 - I1) * off) / (Math.abs(I3 - I2) * along) : 0;
    const side = (start[2] < 0 ? -1 : 1) * sense;
    // On the separatrix (m = 1) the component along the first axis never changes its sign.
    const half = m >= 1 && start[0] < 0 ? -1 : 1;
    const phase = off > 0 ? incomplete(Math.atan2((half * side * start[1]) / b, (half * start[0]) / a), m) : 0;
    // Three equal moments: the angular velocity stays where it is.
    const sphere = Math.abs(I3 - I1) < 1e-12 * I3;
    const omegaAt = sphere ? () => omega : (t) => {
      const [sn, cn, dn] = jacobi(pace * t + phase, m), found = [0, 0, 0];
      [found[order[0]], found[order[1]], found[order[2]]] = [half * a * cn, half * side * b * sn, side * sense * c * dn];
      return found;
    };
    const period = sphere ? Infinity : (4 * complete(m)) / pace;
    // Longitude of the last axis about the angular momentum.
    const rate = (t) => {
      const w = omegaAt(t), x = I1 * w[order[0]], y = I2 * w[order[1]];
      return (size * ((x * x) / I1 + (y * y) / I2)) / (x * x + y * y);
    };
    const angle = !sphere && off > 1e-28 * square * I3 ? grown(rate, period, 96) : (t) => (size / I1) * t;
    const axis = [0, 0, 0];
    axis[order[2]] = 1;
    return {
      period, energy: energy2 / 2, momentum: size, omega: omegaAt,
      // Rows: directions of space, the third along the angular momentum, in the body.
      attitude(t) {
        const w = omegaAt(t), z = unit(moments.map((moment, i) => moment * w[i])), phi = angle(t);
        const upright = Math.hypot(...cross(z, axis)) < 1e-12;
        const node = unit(cross(z, upright ? [axis[1], axis[2], axis[0]] : axis)), beside = cross(z, node);
        const [sin, cos] = [Math.sin(phi), Math.cos(phi)];
        return [node.map((n, i) => cos * n - sin * beside[i]), node.map((n, i) => sin * n + cos * beside[i]), z];
      },
    };
  }

  // --- heavy top -----------------------------------------------------------------------------------

  // Motion of a symmetric top that is let go at inclination theta without inclination rate.
  // transverse, axial: moments about the pivot; weight: m g r; spin: omega_3. As in I.7.
  function top({ transverse, axial, weight, theta, spin, phiRate }) {
    // An upright top without inclination rate sleeps: its axis stays, stable or not.
    if (Math.sin(theta) === 0)
      return { period: NaN, meanRate: NaN, turning: [theta, theta], steady: NaN, pattern: "sleeping", at: (t) => [theta, 0, spin * t] };
    const u0 = Math.cos(theta), a = (axial * spin) / transverse, b = phiRate * Math.sin(theta) ** 2 + a * u0;
    const beta = (2 * weight) / transverse, alpha = (phiRate * Math.sin(theta)) ** 2 + beta * u0;
    // (1 - u^2)(alpha - beta u) - (b - a u)^2 has the root u0; the others are those of a quadratic.
    const q1 = -(alpha + a * a) + beta * u0, q0 = 2 * a * b - beta + q1 * u0;
    const q = -(q1 + (Math.sign(q1) || 1) * Math.sqrt(Math.max(0, q1 * q1 - 4 * beta * q0))) / 2;
    const [u1, u2, u3] = [u0, q / beta, q0 / q].sort((x, y) => x - y);
    const pace = Math.sqrt((beta * (u3 - u1)) / 4), m = (u2 - u1) / (u3 - u1), K = complete(m);
    const phase = Math.abs(u0 - u1) <= Math.abs(u0 - u2) ? 0 : K, period = (2 * K) / pace;
    const u = (t) => u1 + (u2 - u1) * jacobi(pace * t + phase, m)[0] ** 2;
    const rateAt = (x) => (b - a * x) / (1 - x * x), rate = (t) => rateAt(u(t));
    // Without spin and push the top swings in a plane, and the azimuth jumps at each passage below the point.
    const plane = a === 0 && b === 0, passages = (t) => Math.PI * Math.floor((pace * t + phase) / (2 * K));
    const phi = plane ? passages : grown(rate, period, 128);
    const psi = plane ? passages : grown((t) => spin - u(t) * rate(t), period, 128);
    const slow = a * a - 2 * beta * u0;
    const steady = slow >= 0 ? beta / (a + Math.sign(a || 1) * Math.sqrt(slow)) : NaN;
    // Azimuth rates at the turning heights: of one sign the axis traces waves, of two signs loops.
    const [low, high] = [rateAt(u1), rateAt(u2)], largest = Math.max(Math.abs(low), Math.abs(high));
    const pattern = plane ? "wave" : u2 - u1 < 1e-9 ? "steady" :
      Math.min(Math.abs(low), Math.abs(high)) < 1e-9 * largest ? "cusp" : low * high < 0 ? "loop" : "wave";
    return {
      period, pattern, meanRate: plane ? 0 : phi(period) / period, turning: [Math.acos(Math.min(1, u2)), Math.acos(Math.max(-1, u1))], steady,
      at: (t) => [Math.acos(Math.max(-1, Math.min(1, u(t)))), phi(t), psi(t)],
    };
  }

  // --- wobble ---------------------------------------------------------------------------------------

  // Numbers with an imaginary part, as pairs.
  const complex = {
    add: ([a, b], [c, d]) => [a + c, b + d],
    times: ([a, b], [c, d]) => [a * c - b * d, a * d + b * c],
    over: ([a, b], [c, d]) => [(a * c + b * d) / (c * c + d * d), (b * c - a * d) / (c * c + d * d)],
    scaled: (factor, [a, b]) => [factor * a, factor * b],
    root([a, b]) {
      const size = Math.hypot(a, b), real = Math.sqrt((size + Math.abs(a)) / 2);
      if (real === 0) return [0, 0];
      return a >= 0 ? [real, b / (2 * real)] : [Math.abs(b) / (2 * real), b < 0 ? -real : real];
    },
    // A Chebyshev series over a real range, at a complex place (Clenshaw).
    series(coefficients, [low, high], place) {
      const x = complex.add(complex.scaled(2 / (high - low), place), [-(low + high) / (high - low), 0]);
      let [now, last] = [[0, 0], [0, 0]];
      for (let k = coefficients.length - 1; k > 0; k -= 1) {
        const next = complex.add(complex.add(complex.scaled(2, complex.times(x, now)), complex.scaled(-1, last)), [coefficients[k], 0]);
        [last, now] = [now, next];
      }
      return complex.add(complex.add(complex.times(x, now), complex.scaled(-1, last)), [coefficients[0], 0]);
    },
  };

  // How much softer rocks are at a long period (s) than at 1 s, at quality factor 1 (Liu, Anderson & Kanamori 1976).
  function softerStrain(period, exponent) {
    const grown = (period / 200) ** exponent, angle = (exponent * Math.PI) / 2;
    const growth = exponent === 0 ? (2 / Math.PI) * Math.log(period / 200) : ((grown - 1) * Math.cos(angle)) / Math.sin(angle);
    return [-(2 / Math.PI) * Math.log(200) - growth, grown];
  }

  // Periods of the free wobble in turns of the body, rung by rung (Sasao, Okubo & Saito 1980):
  // [s - e + (1+s) kappa] [1 + s (1+beta) + e_f] = (1+s) X s (1+gamma).
  function wobble({ flattening, unitStrain, k2, coreK, kPressure, coreKPressure, coreFraction, coreEllipticity, ocean, anelastic }) {
    const { add, times, over, scaled } = complex, one = [1, 0];
    const e = flattening / (1 - flattening);
    // k2 and its companions times what softens them; s is the root near zero, far the one near -1.
    const roots = (water, soft = [one, one, one, one]) => {
      const [k, ck, kp, ckp] = [k2, coreK, kPressure, coreKPressure].map((value, i) => scaled(unitStrain * value, soft[i]));
      const kappa = add(k, [unitStrain * water, 0]), f = 1 + coreEllipticity;
      const pull = times(add([coreFraction, 0], kp), add(one, scaled(1 / coreFraction, ck)));
      const [p, q, b] = [add(one, kappa), add(kappa, [-e, 0]), add(one, scaled(1 / coreFraction, ckp))];
      const A = add(times(p, b), scaled(-1, pull)), C = scaled(f, q);
      const B = add(add(scaled(f, p), times(q, b)), scaled(-1, pull));
      const square = complex.root(add(times(B, B), scaled(-4, times(A, C))));
      const far = over(scaled(-1, add(B, square)), scaled(2, A));
      const near = over(C, times(A, far))[0];  // not above zero: the body would turn over, not wobble
      return { turns: near > 0 ? 1 / near : NaN, core: 1 / (1 + far[0]) };
    };
    const kappa = unitStrain * k2, fluid = roots(0), wet = roots(ocean);
    const found = { rigid: 1 / e, elastic: (1 + kappa) / (e - kappa), fluidCore: fluid.turns, ocean: wet.turns, coreNutation: wet.core };
    if (!anelastic) return found;
    let turns = wet.turns;
    for (let pass = 0; pass < 3; pass += 1) {
      const strain = softerStrain(turns * anelastic.day, anelastic.exponent);
      turns = roots(ocean, anelastic.softening.map((of) => complex.series(of, anelastic.range, strain))).turns;
    }
    return { ...found, anelastic: turns };
  }

  // --- sunlight -------------------------------------------------------------------------------------

  // Daily insolation of an orbit as a fraction of the solar constant (Berger 1978). `at` takes the
  // true longitude of the Sun and gives a function of the latitude; `year` is the mean over time.
  function insolation({ obliquity, eccentricity, perihelion }) {
    const room = 1 - eccentricity ** 2;
    const light = (sine) => (latitude) => {
      const polar = Math.sin(latitude) * sine, across = Math.cos(latitude) * Math.sqrt(1 - sine * sine);
      const half = Math.acos(Math.max(-1, Math.min(1, -polar / Math.max(across, 1e-300))));
      return (half * polar + across * Math.sin(half)) / Math.PI;
    };
    const declination = (longitude) => Math.sin(obliquity) * Math.sin(longitude);
    const at = (longitude) => {
      const near = ((1 - eccentricity * Math.cos(longitude - perihelion)) / room) ** 2, there = light(declination(longitude));
      return (latitude) => near * there(latitude);
    };
    // The time at a longitude is inverse to the closeness, so that the perihelion does not count.
    const year = (latitude, steps = 4000) => {
      let sum = 0;
      for (let i = 0; i < steps; i++) sum += light(declination((2 * Math.PI * (i + 0.5)) / steps))(latitude);
      return sum / steps / Math.sqrt(room);
    };
    return { at, year };
  }

  return { precession, rotor, top, wobble, insolation, jacobi, complete, incomplete };
})();
