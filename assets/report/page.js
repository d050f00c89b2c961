'use strict';
const { runs, pictures } = JSON.parse(document.getElementById('results').textContent);
const id = name => document.getElementById(name);

// What rows may hold, and what axes and table call it.
const measures = {
    volumetrics_ms: 'ms, volumetrics', frame_ms: 'ms, whole frame', value: 'value of the variable',
    scattering_relative_rmse: 'relative RMSE', scattering_relative_rmse_dim98: 'relative RMSE, dimmest 98%',
    relative_rmse_at_depth_edges: 'relative RMSE at depth edges', relative_rmse_elsewhere: 'relative RMSE elsewhere',
    color_hdr_flip: 'HDR FLIP', transmittance_rmse: 'RMSE of transmittance', flicker: 'flicker',
    medium_samples: 'media sampled', shadow_lookups: 'shadow lookups', light_evaluations: 'lights evaluated',
    texture_fetches: 'texture fetches'
};
const markers = ['circle', 'rect', 'triangle', 'rectRot', 'crossRot', 'cross', 'star', 'triangle'];
const hidden = new Set();
let run, rows, chosen, chart, sorted = { key: 'scattering_relative_rmse', down: false };

const number = v => v === null || v === undefined ? '–'
    : Number(v).toLocaleString('en', { maximumSignificantDigits: 3 });
const element = (tag, properties = {}, ...children) => {
    const e = Object.assign(document.createElement(tag), properties);
    e.append(...children);
    return e;
};
const fill = (select, options, wanted) => {
    select.replaceChildren(...options.map(([value, text]) => element('option', { value, textContent: text })));
    select.value = options.some(([value]) => value === wanted) ? wanted : options[0][0];
};
const unique = list => [...new Set(list)];
const look = family => run.families[family] ?? { color: '#777777', marker: 0 };

function chooseRun() {
    run = runs[id('suite').value];
    const c = run.conditions;
    id('conditions').textContent =
        `${c.driver}, ${c.processor}; ${c.size}; ${c.date}; ${c.version}; ground truth: ${c.reference}. ${c.command}`;
    fill(id('place'), unique(run.rows.map(r => r.place)).map(p => [p, p]), id('place').value);
    const known = Object.keys(measures).filter(key => run.rows.some(r => r[key] > 0));
    fill(id('x'), known.map(key => [key, measures[key]]), known.includes(id('x').value) ? id('x').value : 'volumetrics_ms');
    fill(id('y'), known.map(key => [key, measures[key]]),
         known.includes(id('y').value) ? id('y').value : 'scattering_relative_rmse');
    choosePlace();
}

function choosePlace() {
    rows = run.rows.filter(r => r.place === id('place').value);
    const families = unique(rows.map(r => r.family));
    id('families').replaceChildren(...families.map(family => {
        const box = element('input', { type: 'checkbox', checked: !hidden.has(family) });
        box.addEventListener('change', () => { hidden[box.checked ? 'delete' : 'add'](family); draw(); });
        const colour = element('span', { className: 'colour' });
        colour.style.background = look(family).color;
        return element('label', {}, box, colour, family);
    }));
    const least = (a, b) => a.scattering_relative_rmse <= b.scattering_relative_rmse ? a : b;
    choose(rows.find(r => r.settings === chosen?.settings && r.family === chosen?.family) ?? rows.reduce(least));
    draw();
}

const shown = () => rows.filter(r => !hidden.has(r.family));

// Points that no other beats in both.
function front(points) {
    const best = [];
    for (const p of [...points].sort((a, b) => a.x - b.x || a.y - b.y))
        if (!best.length || p.y < best[best.length - 1].y) best.push(p);
    return best;
}

function draw() {
    const x = id('x').value, y = id('y').value;
    const points = shown().filter(r => r[x] > 0 && r[y] > 0).map(row => ({ x: row[x], y: row[y], row }));
    const datasets = unique(points.map(p => p.row.family)).map(family => {
        const { color, marker } = look(family);
        return {
            label: family, data: points.filter(p => p.row.family === family), pointStyle: markers[marker], rotation: marker === 7 ? 180 : 0,
            borderColor: color, backgroundColor: color, borderWidth: 2, order: 1,
            radius: c => c.raw?.row === chosen ? 10 : 5, hoverRadius: 8
        };
    });
    datasets.push({ label: 'front', data: front(points), type: 'line', stepped: true, borderColor: '#999', borderWidth: 1.5,
                    pointRadius: 0, pointHitRadius: 0, order: 2 });
    const axis = key => ({ type: 'logarithmic', title: { display: true, text: measures[key], color: '#333' },
                           ticks: { color: '#333' }, grid: { color: '#ddd' } });
    chart?.destroy();
    chart = new Chart(id('chart'), {
        type: 'scatter', data: { datasets },
        options: {
            animation: false, maintainAspectRatio: false, scales: { x: axis(x), y: axis(y) },
            interaction: { mode: 'nearest', intersect: false, axis: 'xy' },
            onHover: (event, at) => pick(at), onClick: (event, at) => pick(at),
            plugins: { legend: { display: false },
                       tooltip: { filter: t => t.raw.row && t.dataset.label !== 'front',
                                  callbacks: { label: t => `${t.raw.row.family}: ${number(t.raw.x)}, ${number(t.raw.y)}` } } }
        }
    });
    table();
}

function pick(elements) {
    const hit = elements.map(e => chart.data.datasets[e.datasetIndex].data[e.index]).find(p => p.row);
    if (hit && hit.row !== chosen) { choose(hit.row); chart.update('none'); table(); }
}

function choose(row) {
    chosen = row;
    if (!row) return;
    const parts = [element('h2', { textContent: row.family }), element('code', { textContent: row.settings })];
    if (row.picture) {
        const image = (name, alt, className = '') => element('img', { src: pictures[name], alt, className });
        const above = image(row.picture, 'What the technique shows', 'front');
        const slider = element('input', { type: 'range', min: 0, max: 100, value: 50, ariaLabel: 'From technique to ground truth' });
        slider.addEventListener('input', () => { above.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`; });
        const both = element('div', { className: 'compare' }, element('div', { className: 'compare' },
            image(row.truth_picture, 'The ground truth'), above), slider,
            element('div', { className: 'names' }, element('span', { textContent: 'technique' }), element('span', { textContent: 'ground truth' })));
        parts.push(both, element('figure', { className: 'error' }, image(row.error_picture, 'Where it is wrong'),
            element('figcaption', { textContent: 'Difference; white: half of the mean of the ground truth.' })));
    }
    const list = element('dl');
    for (const [key, text] of Object.entries(measures))
        if (row[key] !== null && row[key] !== undefined && row[key] !== 0)
            list.append(element('dt', { textContent: text }), element('dd', { textContent: number(row[key]) }));
    id('point').replaceChildren(...parts, list);
}

function table() {
    const keys = ['family', ...Object.keys(measures).filter(key => rows.some(r => r[key] > 0))];
    const order = (a, b) => typeof a === 'string' ? a.localeCompare(b) : (a ?? Infinity) - (b ?? Infinity);
    const list = shown().sort((a, b) => order(a[sorted.key], b[sorted.key]) * (sorted.down ? -1 : 1));
    id('table').tHead.replaceChildren(element('tr', {}, ...keys.map(key => {
        const button = element('button', { type: 'button', textContent: measures[key] ?? 'technique' });
        button.addEventListener('click', () => { sorted = { key, down: sorted.key === key && !sorted.down }; table(); });
        const head = element('th', { scope: 'col' }, button);
        if (sorted.key === key) head.ariaSort = sorted.down ? 'descending' : 'ascending';
        return head;
    })));
    id('table').tBodies[0].replaceChildren(...list.map(row => {
        const own = row.settings.split(' ').filter(s => !s.startsWith('technique=')).join(' ');
        const button = element('button', { type: 'button', textContent: row.label ? `${row.family} ${row.label}` : row.family, title: own });
        button.addEventListener('click', () => { choose(row); chart.update('none'); table(); });
        return element('tr', { className: row === chosen ? 'chosen' : '' }, element('td', {}, button),
            ...keys.slice(1).map(key => element('td', { textContent: number(row[key]) })));
    }));
}

fill(id('suite'), runs.map((r, i) => [String(i), r.title]), '0');
id('suite').addEventListener('change', chooseRun);
id('place').addEventListener('change', choosePlace);
id('x').addEventListener('change', draw);
id('y').addEventListener('change', draw);
chooseRun();
