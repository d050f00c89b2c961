// Measures both programs on both scenes and writes the table: see README.md. Run by compare, which installs the packages.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { buildSync } from 'esbuild';
import puppeteer from 'puppeteer-core';

const here = dirname(fileURLToPath(import.meta.url));
const tyndall = process.env.TYNDALL ?? join(here, '../../build/release/sample_game/tyndall');
const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
const before = 4, timed = 20;  // frames
const env = { ...process.env, LIBGL_ALWAYS_SOFTWARE: '1', GALLIUM_DRIVER: 'llvmpipe' };

// The steps of a ray, or below 8 the adaptive step in metres; the size of the rays' picture; up-sampling of 16 taps or of 4.
const peer = (steps, size, fine = true) => ({
    name: (steps < 8 ? `adaptive steps of ${steps} m, ` : `${steps} steps, `) +
        { 0.25: 'quarter', 0.5: 'half', 0.75: 'three quarters', 1: 'full' }[size] + (fine ? '' : ', coarse up-sampling'),
    settings: {
        ...(steps < 8 ? { adaptiveSteps: { stepSize: steps } } : { raymarchSteps: steps }),
        resolutionScale: size, upsampleQuality: fine ? 1 : 0, blur: false,
    },
});
const defaults = { name: '**its defaults** (60 steps, half, blur)', settings: {} };
// The peer's density is a hundred times that of the thin media: what it adds is as bright as in its demos, for which its blur is
// made. Its lamp falls off as (1 - d / reach)², its default; its sun does not, as Tyndall's. Settings are those of its front.
const scenes = {
    sun: {
        gltf: 'godrays_sun.gltf', media: 'sun_media_thin.json', shadowSize: 2048,
        medium: { density: 1 / 12, maxDensity: 0.99, distanceAttenuation: 0 },
        settings: [peer(8, 0.25, false), peer(16, 0.25), peer(24, 0.25), peer(0.6, 0.5), peer(48, 0.5), defaults, peer(24, 0.75),
            peer(48, 0.75), peer(60, 1), peer(90, 1), peer(180, 1), peer(240, 1)],
    },
    lamp: {
        gltf: 'godrays_point_r25.gltf', media: 'point_media_thin.json', shadowSize: 512, reach: 25,
        medium: { density: 1 / 8, maxDensity: 0.99 },
        settings: [peer(2.5, 0.25, false), peer(16, 0.25, false), peer(24, 0.25), peer(0.4, 0.25), peer(0.4, 0.5), peer(0.25, 0.5),
            defaults, peer(90, 0.5), peer(90, 0.75), peer(180, 0.75), peer(180, 1), peer(240, 1)],
    },
};
const tyndallSettings = ['', '--set resolution=half', '--technique froxel', '--technique ray_march', '--preset fast'];

function fail(message) {
    console.error(`scripts/peer/compare: ${message}`);
    process.exit(1);
}

const [directory, option, file, ...rest] = process.argv.slice(2);
if (!directory || rest.length || (option && (option !== '-o' || !file))) fail('usage: compare SCENES_DIR [-o FILE.md]');
const paths = Object.values(scenes).flatMap(scene => [scene.gltf, scene.media]).map(name => join(directory, name));
for (const path of [tyndall, chromium, dirname(file ?? '.'), ...paths]) if (!existsSync(path)) fail(`there is no ${path}`);

// Processor time in ms, user and system, of a process; or of the children that this one has waited for.
function processorTime(pid, children = false) {
    const fields = readFileSync(`/proc/${pid}/stat`, 'latin1').split(') ').at(-1).split(' ');
    const ticks = children ? Number(fields[13]) + Number(fields[14]) : Number(fields[11]) + Number(fields[12]);
    return { parent: Number(fields[1]), ms: 10 * ticks };
}

function treeTime(root) {
    const processes = new Map();
    for (const pid of readdirSync('/proc').filter(name => /^\d+$/.test(name))) {
        try { processes.set(Number(pid), processorTime(pid)); } catch { /* it has ended */ }
    }
    const inTree = pid => pid === root || (processes.has(pid) && inTree(processes.get(pid).parent));
    return [...processes].reduce((sum, [pid, { ms }]) => sum + (inTree(pid) ? ms : 0), 0);
}

async function measurePeer(light, rows) {
    const { gltf, medium, shadowSize, reach, settings } = scenes[light];
    const bundle = buildSync({ entryPoints: [join(here, 'page.mjs')], bundle: true, write: false, logLevel: 'error' });
    const browser = await puppeteer.launch({
        executablePath: chromium, env, protocolTimeout: 600000,
        args: ['--no-sandbox', '--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist', '--disable-gpu-watchdog'],
    });
    try {
        const page = await browser.newPage();
        await page.addScriptTag({ content: bundle.outputFiles[0].text });
        const text = readFileSync(join(directory, gltf), 'utf8');
        const driver = await page.evaluate((...all) => load(...all), text, medium, shadowSize, reach);
        if (!driver.includes('llvmpipe')) throw Error(`the browser draws with ${driver} and not with llvmpipe`);
        console.error(light, 'peer', driver);
        const cost = async of => {
            const times = [];
            for (let run = 0; run < 2; run++) {
                await page.evaluate((...all) => draw(...all), before, of);
                const start = treeTime(browser.process().pid);
                await page.evaluate(count => draw(count), timed);
                times.push((treeTime(browser.process().pid) - start) / timed);
            }
            return Math.min(...times);
        };
        const off = await cost(null);
        for (const { name, settings: of } of settings) {
            const error = await page.evaluate(all => window.error(all), of);
            rows.push({ light, program: 'peer', name, ms: await cost(of) - off, errors: [error, error] });
            console.error(light, 'peer', name, rows.at(-1).ms.toFixed(1), error.toFixed(4));
        }
        return { driver, browser: await browser.version() };
    } finally {
        await browser.close();
    }
}

function measureTyndall(light, rows, folder) {
    const { gltf, media } = scenes[light];
    const run = (...all) => {
        const done = spawnSync(tyndall, all, { encoding: 'utf8', env });
        if (done.status !== 0) throw Error(`tyndall ${all[0]}: ${done.stderr || done.error || done.signal}`);
        return done.stdout;
    };
    const render = (count, out, options) => run('render', join(directory, gltf), '--media', join(directory, media),
        '--size', '640x360', '--frames', String(count), '--set', 'ambient=0', '--set', 'light_transmittance=false',
        '--layer', 'scattering', '-o', join(folder, out), '--stats', join(folder, 'stats.json'), ...options);
    const cost = options => {
        const total = count => Math.min(...[0, 1].map(() => {
            const start = processorTime('self', true).ms;
            render(count, 'picture.exr', options);
            return processorTime('self', true).ms - start;
        }));
        return (total(before + timed) - total(before)) / timed;
    };
    render(1, 'converged.exr', ['--technique', 'reference', '--set', 'reference_steps=2048']);
    const off = {};  // by preset, as presets have shadow maps of their own
    for (const setting of tyndallSettings) {
        const options = setting.split(' ').filter(Boolean);
        const errors = [1, 8].map(count => {
            render(count, 'picture.exr', options);
            const printed = run('compare', join(folder, 'picture.exr'), join(folder, 'converged.exr'), '--metric', 'relrmse');
            return Number(printed.split(/\s+/)[1]);
        });
        const preset = options[0] === '--preset' ? options : [];
        off[preset] ??= cost([...preset, '--technique', 'off']);
        const ms = cost(options) - off[preset], name = setting ? `\`${setting}\`` : '**its defaults**';
        rows.push({ light, program: 'Tyndall', name, ms, errors });
        console.error(light, 'Tyndall', name, ms.toFixed(1), ...errors.map(error => error.toFixed(4)));
    }
    const driver = readFileSync(join(folder, 'stats.json'), 'utf8').match(/"renderer": *"([^"]*)"/)[1];
    if (!driver.includes('llvmpipe')) throw Error(`Tyndall draws with ${driver} and not with llvmpipe`);
    return driver;
}

// Time over the peer's at the same error: along its front, the settings that no other beats in both, straight between logarithms.
// Beyond the front's ends it is a bound, from the setting there.
function ratio(row, error) {
    if (row.program === 'peer') return '';
    const ofPeer = rows.filter(other => other.light === row.light && other.program === 'peer');
    const all = ofPeer.map(({ ms, errors: [e] }) => ({ ms, e }));
    const front = all.filter(a => !all.some(b => b !== a && b.ms <= a.ms && b.e <= a.e)).sort((a, b) => a.ms - b.ms);
    const i = front.findIndex(a => a.e <= error);
    if (i === 0) return `> ${(row.ms / front[0].ms).toFixed(2)}`;
    if (i < 0) return `< ${(row.ms / front.at(-1).ms).toFixed(2)}`;
    const [a, b] = [front[i - 1], front[i]], along = Math.log(error / a.e) / Math.log(b.e / a.e);
    return (row.ms / (a.ms * (b.ms / a.ms) ** along)).toFixed(2);
}

const git = (...all) => spawnSync('git', ['-C', dirname(tyndall), ...all], { encoding: 'utf8' }).stdout?.trim();
const commit = (git('rev-parse', '--short', 'HEAD') || 'unknown') + (git('status', '--porcelain', '-uno') ? ' with changes' : '');
const rows = [], folder = mkdtempSync(join(tmpdir(), 'tyndall-peer-'));
let peerDriver, tyndallDriver;
process.on('exit', () => rmSync(folder, { recursive: true }));
try {
    for (const light of Object.keys(scenes)) {
        peerDriver = await measurePeer(light, rows);
        tyndallDriver = measureTyndall(light, rows, folder);
    }
} catch (error) {
    fail(error.message.trim().split('\n')[0]);
}

const versions = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8')).dependencies;
const table = `# Tyndall and three-good-godrays

| light | program | setting | processor ms a frame | error, 1 frame | error, 8 frames | ratio, 1 frame | ratio, 8 frames |
|---|---|---|---|---|---|---|---|
${rows.map(row => `| ${[row.light, row.program, row.name, row.ms.toFixed(1), ...row.errors.map(error => error.toFixed(4)),
        ...row.errors.map(error => ratio(row, error))].join(' | ')} |`).join('\n')}

Ratio: time over the peer's at the same error; a bound where that error is beyond the peer's front. The peer's frames are all alike.

Processor: ${cpus()[0].model.trim()}, ${cpus().length} threads. Date: ${new Date().toISOString().slice(0, 10)}.
Tyndall: commit ${commit}, ${tyndallDriver}.
Peer: ${['three-good-godrays', 'three', 'postprocessing'].map(name => `${name} ${versions[name]}`).join(', ')},
${peerDriver.browser}, ${peerDriver.driver}.
`;
if (file) writeFileSync(file, table);
else process.stdout.write(table);
