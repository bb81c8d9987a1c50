/** Draws models with pineda and with three.js and compares every pixel: see README.md. */

import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import pngjs from 'pngjs';
import { work } from './browser.mjs';
import { LIMIT, judge } from './judge.mjs';
import { MODELS, MODES } from './models.mjs';

const { PNG } = pngjs;
const here = dirname(fileURLToPath(import.meta.url));
const root = dirname(here);

const { values: options } = parseArgs({
    options: {
        only: { type: 'string', default: '' },
        size: { type: 'string', default: '1024' },
        models: { type: 'string', default: join(root, '../shared/models') },
        pineda: { type: 'string', default: join(root, 'target/release/pineda') },
        chromium: { type: 'string', default: 'chromium' },
        pictures: { type: 'string', default: join(root, 'target/fidelity') },
    },
});

const size = Number(options.size);
const most = Math.floor(LIMIT * size * size);
const models = MODELS.filter(({ file }) => file.includes(options.only));
mkdirSync(options.pictures, { recursive: true });

/** The picture's name, without its ending. */
const name = ({ file, time }, mode) =>
    `${file.split('/').at(-1)}${time === undefined ? '' : `@${time}`}-${mode}`.replaceAll(' ', '_');

function ours(model, mode) {
    const picture = join(options.pictures, `${name(model, mode)}.png`);
    const pose = model.time === undefined ? [] : ['--animation', String(model.animation), '--time', String(model.time)];
    execFileSync(options.pineda, [
        'render', join(options.models, model.file), '-o', picture, '--shading', mode, '--samples', '1', '--size', `${size}x${size}`, ...pose,
    ], { stdio: ['ignore', 'ignore', 'inherit'] });
    const { data } = PNG.sync.read(readFileSync(picture), { skipRescale: mode === 'depth' });
    // pngjs makes four channels of a grey one.
    return mode === 'depth' ? depth(data.filter((_, i) => i % 4 === 0)) : color(data);
}

const color = (data) => ({ size: [size, size], channels: 4, greatest: 255, data });
const depth = (data) => ({ size: [size, size], channels: 1, greatest: 65535, data });

/** Ours, theirs, and outliers as red on theirs in grey, side by side. */
function sideBySide(a, b, mask, file) {
    const sheet = new PNG({ width: 3 * size, height: size });
    const rgba = ({ channels, greatest, data }, i) => {
        const pixel = Array.from(data.slice(channels * i, channels * (i + 1)), (x) => Math.round(255 * x / greatest));
        return channels === 4 ? pixel : [pixel[0], pixel[0], pixel[0], 255];
    };
    for (let i = 0; i < size * size; i++) {
        const [left, middle] = [rgba(a, i), rgba(b, i)];
        const gray = Math.round((middle[0] + middle[1] + middle[2]) / 6);
        const right = mask[i] ? [255, 0, 0, 255] : [gray, gray, gray, 255];
        [left, middle, right].forEach((pixel, column) => {
            sheet.data.set(pixel, 4 * (Math.floor(i / size) * 3 * size + column * size + i % size));
        });
    }
    writeFileSync(file, PNG.sync.write(sheet));
}

const rows = [];
let versions = '';

async function received(kind, path, body) {
    if (kind === 'failed') throw new Error(`the page: ${body}`);
    if (kind === 'versions') {
        const { three, browser, webgl } = JSON.parse(body);
        versions = `three.js r${three}; ${browser.match(/Chrome\/\S+/)}; ${webgl}`;
    }
    if (kind !== 'picture') return;
    const [number, mode] = path.split('/');
    const model = models[number];
    const codes = mode === 'depth' ? depth(new Uint16Array(body.buffer, body.byteOffset, body.length / 2)) : color(body);
    const our = ours(model, mode);
    const judged = judge(our, codes);
    sideBySide(our, codes, judged.mask, join(options.pictures, `${name(model, mode)}.png`));
    rows.push({ model, mode, ...judged });
    const { outliers, worst } = judged;
    console.error(`${outliers > most ? 'NOT ALIKE' : 'alike    '} ${name(model, mode)}: ${outliers} outliers, the worst by ${(255 * worst).toFixed(1)}/255`);
}

const folders = [['/three/', join(here, 'node_modules/three')], ['/models/', options.models], ['/page/', join(here, 'page')]];
await work(options.chromium, folders, { size, modes: MODES, models }, received);

const percent = (share) => `${(100 * share).toFixed(4)} %`;
console.log(`${versions}; ${size} x ${size} pixels; at most ${most} outliers\n`);
console.log(`| model | what it shows | ${MODES.join(' | ')} | worst |\n| --- | --- | ${MODES.map(() => '---: | ').join('')}---: |`);
for (const model of models) {
    const own = MODES.map((mode) => rows.find((row) => row.model === model && row.mode === mode));
    const title = `\`${model.file.split('/').at(-1)}\`${model.time === undefined ? '' : `, ${model.animation} at ${model.time} s`}`;
    const worst = 255 * Math.max(...own.map(({ worst }) => worst));
    console.log(`| ${title} | ${model.shows} | ${own.map(({ outliers }) => outliers).join(' | ')} | ${worst.toFixed(0)} |`);
}
const bad = rows.filter(({ outliers }) => outliers > most);
const sum = (what) => rows.reduce((sum, row) => sum + row[what], 0);
console.log(
    `\n${rows.length} pictures, of which ${bad.length} have more than ${most} outliers. Of all pixels ${percent(sum('outliers') / sum('pixels'))} are outliers, `
    + `${percent(sum('same') / sum('pixels'))} have the same codes.`,
);
process.exitCode = bad.length ? 1 : 0;
