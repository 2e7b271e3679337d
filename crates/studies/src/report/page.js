'use strict';
// All figures show one window of time, from and to as shares of the whole; each has a time pointed at.
const NS = 'http://www.w3.org/2000/svg', figures = [];
let view = [0, 1];
const make = (parent, tag, attributes = {}, text = '') => {
  const one = parent.namespaceURI === NS ? document.createElementNS(NS, tag) : document.createElement(tag);
  for (const name in attributes) one.setAttribute(name, attributes[name]);
  if (text) one.textContent = text;
  return parent.appendChild(one);
};
const number = (element, name) => parseFloat(element.getAttribute(name));
const nearest = (all, value) => all.reduce((best, one, i) => Math.abs(one - value) < Math.abs(all[best] - value) ? i : best, 0);

function prepare(figure) {
  const svg = figure.querySelector('svg.plot'), across = figure.dataset.axis === 'x';
  const data = JSON.parse(figure.querySelector('script').textContent), frames = [];
  let inner = [];
  // What is drawn before a frame goes into a window of its own, which shows a part of it. In a diagram the
  // second frame is that of the scale of colours.
  for (const child of [...svg.children]) {
    if (child.matches('path:not(.tick, .grid)')) inner.push(child);
    if (!child.matches('rect.frame') || (!across && frames.length)) continue;
    const [x, y, w, h] = ['x', 'y', 'width', 'height'].map(name => number(child, name));
    const window = make(svg, 'svg', { class: 'window', x, y, width: w, height: h, preserveAspectRatio: 'none' });
    window.append(...inner);
    child.before(window);
    frames.push({ x, y, w, h, window });
    inner = [];
  }
  const f = frames.at(-1), bottom = f.y + f.h;
  const isOfTime = element => {
    if (element.matches('text')) return across ? Math.abs(number(element, 'y') - bottom - 20) < 1 : element.getAttribute('text-anchor') === 'end';
    const [x, y, x2, y2] = element.getAttribute('d').match(/-?[\d.]+/g).map(Number);
    return across ? x === x2 : y === y2 && x === f.x;
  };
  const old = [...svg.querySelectorAll(':scope > .tick, :scope > .grid, :scope > text')].filter(isOfTime);
  const one = { svg, across, data, frames, f, bottom, old, times: data.times.map(Number) };
  one.end = data.end * data.factor;
  one.overlay = make(svg, 'g');
  one.axis = make(svg, 'g');
  figures.push(one);
  controls(one, make(figure, 'div', { class: 'controls' }));
  one.output = make(figure, 'div', { role: 'status', class: 'readout' }, 'Point at the figure, or move a slider, for values; drag to zoom.');
}

function controls(one, bar) {
  const button = (text, label, act) => make(bar, 'button', { type: 'button', 'aria-label': label, title: label }, text).addEventListener('click', act);
  button('+', 'Zoom in along time', () => look(...around(0.5)));
  button('−', 'Zoom out along time', () => look(...around(2)));
  button('◀', 'Earlier', () => look(...around(1, -0.25)));
  button('▶', 'Later', () => look(...around(1, 0.25)));
  button('All', 'The whole window of time', () => look(0, 1));
  const slider = (text, most, act) => {
    const input = make(make(bar, 'label', {}, text), 'input', { type: 'range', min: 0, max: most, value: 0 });
    input.addEventListener('input', () => act(Number(input.value)));
    return input;
  };
  one.time = slider('Time', one.times.length - 1, i => point(one, i, one.node));
  if (one.data.rows) one.place = slider('Place', Math.max(...one.data.rows.map(row => row.length)) - 1, j => point(one, one.index || 0, j));
  // Where an event is, as a share of the shown time, and across.
  const at = event => {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(one.svg.getScreenCTM().inverse());
    const share = one.across ? (p.x - one.f.x) / one.f.w : (one.bottom - p.y) / one.f.h;
    return [view[0] + Math.min(1, Math.max(0, share)) * (view[1] - view[0]), p.x];
  };
  let from = null;
  one.svg.addEventListener('pointermove', event => {
    const [share, x] = at(event), index = nearest(one.times, share * one.data.end);
    point(one, index, one.data.rows && nearest(one.data.rows[index].map(node => placed(one, node)), x));
  });
  one.svg.addEventListener('pointerdown', event => { [from] = at(event); });
  one.svg.addEventListener('pointerup', event => {
    const [to] = at(event);
    if (from !== null && Math.abs(to - from) > 0.02 * (view[1] - view[0])) look(Math.min(from, to), Math.max(from, to));
    from = null;
  });
  one.svg.addEventListener('dblclick', () => look(0, 1));
}

// The shown window made wider or narrower, and moved by a share of itself.
const around = (by, moved = 0) => {
  const wide = view[1] - view[0], middle = (view[0] + view[1]) / 2 + moved * wide;
  return [middle - wide / 2 * by, middle + wide / 2 * by];
};
const shareOf = (one, seconds) => (seconds / one.data.end - view[0]) / (view[1] - view[0]);
const placed = (one, node) => one.f.x + (node[2] - one.data.across[0]) / (one.data.across[1] - one.data.across[0]) * one.f.w;

// Shows a part of the whole window in all figures.
function look(from, to) {
  const wide = Math.min(1, Math.max(1e-3, to - from));
  from = Math.min(1 - wide, Math.max(0, from));
  view = [from, from + wide];
  for (const one of figures) {
    for (const { x, y, w, h, window } of one.frames) {
      window.setAttribute('viewBox', (one.across ? [x + from * w, y, wide * w, h] : [x, y + (1 - from - wide) * h, w, wide * h]).join(' '));
    }
    for (const element of one.old) element.classList.toggle('hidden', wide < 1);
    one.axis.replaceChildren();
    if (wide < 1) ticks(one);
    draw(one);
  }
}

function ticks(one) {
  const [from, to] = view.map(share => share * one.end), power = 10 ** Math.floor(Math.log10((to - from) / 6));
  const step = [1, 2, 5, 10].map(figure => figure * power).find(size => size >= (to - from) / 6);
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to * (1 + 1e-12); k++) {
    const share = (k * step - from) / (to - from), text = String(parseFloat((k * step).toPrecision(6)));
    const x = one.f.x + share * one.f.w, y = one.bottom - share * one.f.h;
    if (one.across) for (const g of one.frames) make(one.axis, 'path', { class: 'tick', d: `M${x} ${g.y + g.h}v6` });
    else make(one.axis, 'path', { class: 'tick', d: `M${one.f.x} ${y}h-6` });
    make(one.axis, 'text', one.across ? { x, y: one.bottom + 20, 'text-anchor': 'middle' } : { x: one.f.x - 9, y: y + 4, 'text-anchor': 'end' }, text);
  }
}

// Tells the values at a time, in a diagram at a node.
function point(one, index, node = 0) {
  const { data } = one, row = data.rows && data.rows[index];
  one.index = index;
  one.node = row ? Math.max(0, Math.min(node, row.length - 1)) : 0;
  const time = `t = ${data.times[index]} ${data.unit}`.trim();
  one.time.value = index;
  one.time.setAttribute('aria-valuetext', time);
  if (row && row.length) {
    const [bar, x, , value] = row[one.node], place = `${data.bars[bar]} at x = ${x} ${data.place}`.trim();
    one.place.value = one.node;
    one.place.setAttribute('aria-valuetext', place);
    one.output.textContent = `${time}, ${place}: ${data.quantity} = ${value} ${data.own}`.trim();
  } else one.output.textContent = row ? `${time}: nothing has moved yet` : time;
  for (const { name, values, unit } of data.quantities || []) make(one.output, 'div', {}, `${name} = ${values ? values[index] : 'not proven'} ${values ? unit : ''}`.trim());
  draw(one);
}

function draw(one) {
  one.overlay.replaceChildren();
  const share = shareOf(one, one.times[one.index]), { f } = one;
  if (!(share >= 0 && share <= 1)) return;
  if (one.across) for (const g of one.frames) make(one.overlay, 'path', { class: 'cursor', d: `M${g.x + share * g.w} ${g.y}v${g.h}` });
  else {
    const y = one.bottom - share * f.h, node = one.data.rows[one.index][one.node];
    make(one.overlay, 'path', { class: 'cursor', d: `M${f.x} ${y}h${f.w}` });
    if (node) make(one.overlay, 'circle', { class: 'point', cx: placed(one, node), cy: y, r: 5 });
  }
}

document.querySelectorAll('.explored').forEach(prepare);
look(0, 1);
