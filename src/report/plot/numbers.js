"use strict";
// Numbers, units and ticks as the drawings of the program have them: what zooming and the pointer
// tell. `script_tests.rs` holds them against those of the program.
const numbers = (() => {
  const PREFIXES = { "-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G" };
  const TAKE_ALL = ["N", "J", "W", "Pa", "Hz", "Nm"], TAKE_SMALL = ["s", "m", "rad"];
  const superscript = (n) => String(n).replace(/./g, (c) => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[+c]);
  const minus = (text) => text.replace(/-/g, "−");

  // The scale in which a unit is to be shown; nothing: the one in which it reads best.
  let preferred = () => undefined;
  const prefer = (scales) => { preferred = scales; };

  // As `scale` of quantity.rs: small prefixes of a kilogram stand before the gram.
  function scaleFor(magnitude, unit) {
    const own = preferred(unit, magnitude);
    if (own) return own;
    if (!(magnitude > 0) || !isFinite(magnitude) || !unit || unit.startsWith("1")) return { factor: 1, unit };
    let exponent = Math.floor((Math.log10(magnitude) + 1e-9) / 3) * 3;
    const first = unit.split(/[ /]/)[0], gram = unit === "kg", all = TAKE_ALL.includes(first);
    const some = all || gram || TAKE_SMALL.includes(first);
    if ((!all && exponent === 3) || (!some && exponent === -3)) exponent = 0;
    const factor = 10 ** exponent;
    if (exponent === 0) return { factor, unit };
    const prefix = all || (some && exponent < 0) ? PREFIXES[gram ? exponent + 3 : exponent] : undefined;
    if (prefix === undefined) return { factor, unit: `10${superscript(exponent)} ${unit}` };
    return { factor, unit: prefix + (gram ? unit.slice(1) : unit) };
  }

  // As `significant` of quantity.rs.
  function significant(value, digits) {
    if (value === null || !isFinite(value)) return "–";
    if (value === 0) return "0";
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    if (+power >= -3 && +power < 6) return minus(String(+value.toFixed(Math.max(0, digits - 1 - power))));
    const lead = minus(String(+mantissa));
    return `${lead === "1" ? "" : lead === "−1" ? "−" : `${lead}·`}10${superscript(+power)}`;
  }

  function withUnit(value, unit, digits) {
    const scale = scaleFor(Math.abs(value), unit);
    return `${significant(value / scale.factor, digits)}${scale.unit.startsWith("10") ? "·" : " "}${scale.unit}`.trim();
  }

  // Parts of a turn that angles are counted in (degrees).
  const PARTS = [10, 15, 30, 60, 90, 180, 360];
  const FEW = 3;
  const rounded = (raw) => { const power = 10 ** Math.floor(Math.log10(raw)); return ([1, 2, 5].find((f) => raw <= f * power * (1 + 1e-9)) || 10) * power; };
  // The step of ticks, and the next smaller one, which is taken where ticks are too few.
  function steps(span, raw, unit) {
    if (unit !== "deg" || raw <= 5) { const step = rounded(raw); return [step, rounded(0.4 * step)]; }
    const part = PARTS.findIndex((part) => raw <= part * (1 + 1e-9));
    if (part < 0) { const turns = rounded(raw / 360); return [360 * turns, 360 * Math.max(1, rounded(0.4 * turns))]; }
    return PARTS[part] < 60 && span >= 300 && span <= 400 ? [60, 60] : [PARTS[part], PARTS[Math.max(0, part - 1)]];
  }
  function ticks(low, high, count, unit) {
    const ends = (step) => [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)], many = (step) => ends(step)[1] - ends(step)[0] + 1;
    const [coarse, finer] = steps(high - low, (high - low) / count, unit);
    const step = many(coarse) < FEW && many(finer) >= FEW && many(finer) <= 2 * count ? finer : coarse;
    const [first, last] = ends(step);
    const decimals = Math.min(17, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
    const list = [];
    for (let i = first; i <= last && list.length < 60; i++) {
      const text = (i * step).toFixed(decimals);
      list.push([i * step, minus(/[1-9]/.test(text) ? text : text.replace("-", ""))]);
    }
    return list;
  }

  const WIDE = 2.5;
  // How the values of an axis between two ends are shown.
  function shown(axis, ends) {
    const size = Math.max(...ends.map((end) => Math.abs(axis.log ? 10 ** end : end)));
    if (axis.fixed || (axis.log && Math.abs(ends[1] - ends[0]) > WIDE)) return { factor: 1, unit: axis.unit };
    return scaleFor(0.94 * size, axis.unit);
  }

  // As `ticks` of scale.rs: [place on the axis, label, class] of every tick; places are logarithms of a log axis.
  function marksOf(axis, ends, pixels, pitch) {
    if (axis.rows.length) return axis.rows.map((name, row) => [row + 0.5, name, "gridline"]);
    const { factor, unit } = shown(axis, ends), count = Math.floor(Math.max(2, pixels / pitch));
    const low = Math.min(...ends), high = Math.max(...ends);
    if (!axis.log) return ticks(low / factor, high / factor, count, unit).map(([v, label]) => [v * factor, label, v === 0 ? "zero" : "gridline"]);
    const decades = high - low;
    if (decades < 0.7) return ticks(10 ** low / factor, 10 ** high / factor, count).map(([v, label]) => [Math.log10(v * factor), label, "gridline"]);
    const every = Math.max(1, Math.ceil(decades / count)), some = 3 * decades <= 1.6 * count, list = [];
    for (let decade = Math.floor(low); decade <= Math.ceil(high); decade++) for (let lead = 1; lead <= 9; lead++) {
      const place = decade + Math.log10(lead);
      if (place < low - 1e-9 || place > high + 1e-9 || (lead > 1 && decades > 7)) continue;
      const named = lead === 1 ? decade % every === 0 : (lead === 2 || lead === 5) && some;
      const power = decade === 0 ? "1" : decade === 1 ? "10" : `10${superscript(decade)}`;
      const wide = lead === 1 ? power : decade === 0 ? String(lead) : `${lead}·${power}`;
      const label = decades <= WIDE ? significant(lead * 10 ** decade / factor, 3) : wide;
      list.push([place, named ? label : "", lead > 1 ? "minor" : "gridline"]);
    }
    return list;
  }

  return { minus, prefer, scaleFor, significant, withUnit, ticks, shown, marksOf };
})();
