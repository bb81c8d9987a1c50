/** Works through the jobs: each model in each mode, sent as bytes to where the page came from. */

import { REVISION } from 'three';
import { frame } from './camera.mjs';
import { load } from './load.mjs';
import { Painter } from './paint.mjs';

const send = async (path, body) => {
    const response = await fetch(path, { method: 'POST', body });
    if (!response.ok) throw new Error(`${path}: ${response.status}`);
};

try {
    const { size, modes, models } = await (await fetch('/jobs')).json();
    const painter = new Painter(size);
    await send('/versions', JSON.stringify({ three: REVISION, browser: navigator.userAgent, webgl: painter.driver() }));
    for (const [number, model] of models.entries()) {
        const scene = await load(model);
        const camera = frame(scene);
        for (const mode of modes) {
            await send(`/picture/${number}/${mode}`, painter.paint(scene, camera, mode));
        }
        painter.forget(scene);
    }
    await send('/done');
} catch (error) {
    await send('/failed', `${error.stack ?? error}`);
}
