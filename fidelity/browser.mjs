/** Chromium, headless, with WebGL by SwiftShader, and the server that it gets the page, three.js and the models from and sends pictures to. */

import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.png': 'image/png', '.jpeg': 'image/jpeg' };

/** How long the browser may be silent. */
const PATIENCE_SECONDS = 300;

/**
 * Opens the page, which works through `jobs` by itself. `folders` says what is served: [prefix, folder] each. `received(kind, name, body)` is called in turn for what the page sends.
 */
export async function work(program, folders, jobs, received) {
    const profile = await mkdtemp(join(tmpdir(), 'fidelity-'));
    let finish, fail, alarm;
    const done = new Promise((resolve, reject) => { finish = resolve; fail = reject; });
    const heard = () => {
        clearTimeout(alarm);
        alarm = setTimeout(() => fail(new Error(`the browser said nothing for ${PATIENCE_SECONDS} s`)), PATIENCE_SECONDS * 1000);
    };

    const answer = async (request, response) => {
        heard();
        const { pathname } = new URL(request.url, 'http://localhost');
        const path = decodeURIComponent(pathname);
        if (request.method === 'POST') {
            const parts = [];
            for await (const part of request) parts.push(part);
            const [kind, ...name] = path.slice(1).split('/');
            await received(kind, name.join('/'), Buffer.concat(parts));
            response.end();
            if (kind === 'done') finish();
            return;
        }
        if (path === '/jobs') {
            response.end(JSON.stringify(jobs));
            return;
        }
        const [prefix, folder] = folders.find(([prefix]) => path.startsWith(prefix)) ?? [];
        const file = prefix && join(folder, normalize('/' + path.slice(prefix.length)));
        const bytes = file && await readFile(file).catch(() => undefined);
        response.writeHead(bytes ? 200 : 404, { 'Content-Type': TYPES[extname(path)] ?? 'application/octet-stream' });
        response.end(bytes);
    };
    const server = createServer((request, response) => answer(request, response).catch(fail));
    await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));

    const browser = spawn(program, [
        '--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
        '--no-first-run', '--disable-extensions', '--disable-background-networking', `--user-data-dir=${profile}`,
        `http://127.0.0.1:${server.address().port}/page/page.html`,
    ], { stdio: 'ignore', detached: true });
    browser.on('error', (error) => fail(new Error(`${program} cannot be started: ${error.message}`)));
    browser.on('exit', (code) => fail(new Error(`${program} ended before it was done, with ${code}`)));
    heard();
    try {
        await done;
    } finally {
        clearTimeout(alarm);
        browser.removeAllListeners('exit');
        // The browser with all its helper processes.
        if (browser.pid && browser.exitCode === null) {
            const ended = new Promise((resolve) => browser.once('exit', resolve));
            process.kill(-browser.pid, 'SIGKILL');
            await ended;
        }
        server.closeAllConnections();
        server.close();
        await rm(profile, { recursive: true, force: true, maxRetries: 5 });
    }
}
