'use strict';
// All figures show one window of time, [first, last] as parts of the whole, and one time pointed at.
const NS = 'http://www.w3.org/2000/svg';
const figures = [];
let view = [0, 1];
const make = (parent, tag, attributes, text) => {
  const svg = parent.namespaceURI === NS;
  const one = svg ? document.createElementNS(NS, tag) : document.createElement(tag);
  for (const name in attributes) one.setAttribute(name, attributes[name]);
  if (text !== undefined) one.textContent = text;
  parent.append(one);
  return one;
};
const number = (element, name) => parseFloat(element.getAttribute(name));
const shown = value => String(parseFloat(value.toPrecision(6)));

// What is drawn inside a frame is moved into a window of its own, which shows a part of it.
function prepare(figure) {
  const svg = figure.querySelector('svg.plot'), across = figure.dataset.axis === 'x';
  const frames = [], old = [];
  let inner = [];
  for (const child of [...svg.children]) {
    if (child.matches('path,line')) inner.push(child);
    // The frame of a scale of colours comes second.
    if (!child.matches('rect.frame') || (!across && frames.length)) continue;
    const frame = { x: number(child, 'x'), y: number(child, 'y'), w: number(child, 'width'), h: number(child, 'height') };
    const upright = path => /^M([-\d.]+) [-\d.]+L\1 /.test(path.getAttribute('d'));
    for (const path of inner.filter(path => path.matches('.tick') || (path.matches('.grid') && upright(path) === across))) old.push(path);
    inner = inner.filter(path => !path.matches('.tick,.grid,.bar,.wall,.lump'));
    frame.svg = make(svg, 'svg', { class: 'window', x: frame.x, y: frame.y, width: frame.w, height: frame.h, preserveAspectRatio: 'none' });
    frame.svg.append(...inner);
    child.before(frame.svg);
    frames.push(frame);
    inner = [];
  }
  const last = frames[frames.length - 1];
  const bottom = last.y + last.h;
  const isTick = path => {
    const [, x, y, z] = path.getAttribute('d').match(/^M([-\d.]+) ([-\d.]+)L([-\d.]+)/) || [];
    return across ? x === z && frames.some(f => Math.abs(y - f.y - f.h) < 0.5) : x !== z && Math.abs(x - last.x) < 0.5;
  };
  for (const path of svg.querySelectorAll(':scope > .tick')) if (isTick(path)) old.push(path);
  for (const text of svg.querySelectorAll(':scope > text')) {
    const at = [number(text, 'x'), number(text, 'y'), text.getAttribute('text-anchor')];
    if (across ? at[2] === 'middle' && Math.abs(at[1] - bottom - 20) < 0.6 : at[2] === 'end' && Math.abs(at[0] - last.x + 9) < 0.6) old.push(text);
  }
  const one = { figure, svg, across, frames, last, bottom, old: old.filter(path => !path.matches('.tick') || isTick(path)) };
  one.data = JSON.parse(figure.querySelector('script').textContent);
  one.times = one.data.times.map(Number);
  one.end = parseFloat(figure.dataset.end);
  one.factor = parseFloat(figure.dataset.factor);
  one.overlay = make(svg, 'g', {});
  one.axis = make(svg, 'g', {});
  controls(one);
  figures.push(one);
}

function controls(one) {
  const bar = make(one.figure, 'div', { class: 'controls' });
  const button = (text, label, act) => make(bar, 'button', { type: 'button', 'aria-label': label, title: label }, text).addEventListener('click', act);
  button('+', 'Zoom in along time', () => zoom(0.5));
  button('−', 'Zoom out along time', () => zoom(2));
  button('◀', 'Earlier', () => move(-0.25));
  button('▶', 'Later', () => move(0.25));
  button('All', 'The whole window of time', () => look(0, 1));
  const slider = (text, most, act) => {
    const input = make(make(bar, 'label', {}, text), 'input', { type: 'range', min: 0, max: most, value: 0 });
    input.addEventListener('input', () => act(Number(input.value)));
    return input;
  };
  one.time = slider('Time', one.times.length - 1, i => point(one, i, one.node));
  if (one.data.rows) one.place = slider('Place', Math.max(...one.data.rows.map(row => row.length)) - 1, j => point(one, one.index || 0, j));
  one.output = make(one.figure, 'output', { 'aria-live': 'polite' });
  const at = event => {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(one.svg.getScreenCTM().inverse());
    const f = one.last, share = one.across ? (p.x - f.x) / f.w : (one.bottom - p.y) / f.h;
    return { x: p.x, share: Math.min(1, Math.max(0, share)) };
  };
  const within = share => view[0] + share * (view[1] - view[0]);
  let from = null;
  one.svg.addEventListener('pointermove', event => {
    const { x, share } = at(event), time = within(share) * one.end / one.factor;
    const index = nearest(one.times, time);
    point(one, index, one.data.rows && nearest(one.data.rows[index].map(node => node[2]), placeAt(one, x)));
  });
  one.svg.addEventListener('pointerdown', event => { from = at(event).share; });
  one.svg.addEventListener('pointerup', event => {
    const to = at(event).share;
    if (from !== null && Math.abs(to - from) > 0.02) look(within(Math.min(from, to)), within(Math.max(from, to)));
    from = null;
  });
  one.svg.addEventListener('dblclick', () => look(0, 1));
}

const nearest = (all, value) => all.reduce((best, one, i) => Math.abs(one - value) < Math.abs(all[best] - value) ? i : best, 0);
const placeAt = (one, x) => one.data.across[0] + (x - one.last.x) / one.last.w * (one.data.across[1] - one.data.across[0]);
const zoom = by => { const middle = (view[0] + view[1]) / 2, half = (view[1] - view[0]) / 2 * by; look(middle - half, middle + half); };
const move = by => { const step = by * (view[1] - view[0]); look(view[0] + step, view[1] + step); };

// Shows a part of the whole window in all figures.
function look(from, to) {
  const wide = Math.min(1, Math.max(1e-3, to - from));
  from = Math.min(1 - wide, Math.max(0, from));
  view = [from, from + wide];
  for (const one of figures) {
    for (const f of one.frames) {
      const box = one.across ? [f.x + from * f.w, f.y, wide * f.w, f.h] : [f.x, f.y + (1 - from - wide) * f.h, f.w, wide * f.h];
      f.svg.setAttribute('viewBox', box.join(' '));
    }
    const whole = wide === 1;
    for (const path of one.old) path.classList.toggle('hidden', !whole);
    one.axis.replaceChildren();
    if (!whole) ticks(one);
    draw(one);
  }
}

function ticks(one) {
  const [from, to] = view.map(share => share * one.end), about = (to - from) / 6;
  const power = 10 ** Math.floor(Math.log10(about));
  const step = [1, 2, 5, 10].map(figure => figure * power).find(size => size >= about);
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to * (1 + 1e-12); k++) {
    const share = (k * step - from) / (to - from), f = one.last;
    if (one.across) {
      const x = f.x + share * f.w;
      for (const g of one.frames) make(one.axis, 'path', { class: 'tick', d: `M${x} ${g.y + g.h}v6` });
      make(one.axis, 'text', { x, y: one.bottom + 20, 'text-anchor': 'middle' }, shown(k * step));
    } else {
      const y = one.bottom - share * f.h;
      make(one.axis, 'path', { class: 'tick', d: `M${f.x} ${y}h-6` });
      make(one.axis, 'text', { x: f.x - 9, y: y + 4, 'text-anchor': 'end' }, shown(k * step));
    }
  }
}

function point(one, index, node) {
  one.index = index;
  one.node = node || 0;
  one.time.value = index;
  const { data, output } = one, row = data.rows && data.rows[index];
  const time = `t = ${data.times[index]} ${data.unit}`.trim();
  output.replaceChildren();
  if (!row) {
    const table = make(output, 'table', {});
    const line = (name, value) => { const tr = make(table, 'tr', {}); make(tr, 'th', { scope: 'row' }, name); make(tr, 'td', {}, value); };
    line('t', `${data.times[index]} ${data.unit}`.trim());
    for (const q of data.quantities) line(q.name, q.values ? `${q.values[index]} ${q.unit}`.trim() : 'not proven');
  } else if (row.length) {
    one.node = Math.min(one.node, row.length - 1);
    one.place.value = one.node;
    const [bar, x, , value] = row[one.node];
    output.textContent = `${time}, ${data.bars[bar]} at x = ${`${x} ${data.place}`.trim()}: ${data.quantity} = ${`${value} ${data.own}`.trim()}`;
  } else output.textContent = `${time}: nothing has moved yet`;
  draw(one);
}

// The time pointed at, and in a diagram the place.
function draw(one) {
  one.overlay.replaceChildren();
  if (one.index === undefined) return;
  const share = (one.times[one.index] * one.factor / one.end - view[0]) / (view[1] - view[0]), f = one.last;
  if (share < 0 || share > 1) return;
  if (one.across) {
    for (const g of one.frames) make(one.overlay, 'path', { class: 'cursor', d: `M${g.x + share * g.w} ${g.y}v${g.h}` });
    return;
  }
  const y = one.bottom - share * f.h, node = one.data.rows[one.index][one.node];
  make(one.overlay, 'path', { class: 'cursor', d: `M${f.x} ${y}h${f.w}` });
  if (!node) return;
  const [low, high] = one.data.across;
  make(one.overlay, 'circle', { class: 'point', cx: f.x + (node[2] - low) / (high - low) * f.w, cy: y, r: 5 });
}

for (const figure of document.querySelectorAll('.explored')) prepare(figure);
look(0, 1);
