/** The camera of ../shared/render-conventions.md, computed from what three.js makes of the model. */

import { MathUtils, PerspectiveCamera, Vector3 } from 'three';

const FOV = 40, AZIMUTH = 30, ELEVATION = 20;

export function frame(scene) {
    const { least, most } = box(scene);
    const center = least.clone().add(most).multiplyScalar(0.5);
    const r = most.distanceTo(least) / 2;
    const [fov, az, el] = [FOV, AZIMUTH, ELEVATION].map(MathUtils.degToRad);
    const distance = r / Math.sin(fov / 2);
    const camera = new PerspectiveCamera(FOV, 1, distance - 1.05 * r, distance + 1.05 * r);
    const towards = new Vector3(Math.cos(el) * Math.sin(az), Math.sin(el), Math.cos(el) * Math.cos(az));
    camera.position.copy(center).addScaledVector(towards, distance);
    camera.up.set(0, 1, 0);
    camera.lookAt(center);
    camera.updateMatrixWorld(true);
    return camera;
}

/** Of every vertex that an index names, after morph and skin, in world space. */
export function box(root) {
    const least = new Vector3(Infinity, Infinity, Infinity), most = least.clone().negate(), vertex = new Vector3();
    root.traverse((mesh) => {
        if (!mesh.isMesh) return;
        const { index, attributes: { position } } = mesh.geometry;
        const named = new Uint8Array(position.count);
        if (index) for (let i = 0; i < index.count; i++) named[index.getX(i)] = 1;
        else named.fill(1);
        for (let i = 0; i < position.count; i++) {
            if (!named[i]) continue;
            mesh.getVertexPosition(i, vertex).applyMatrix4(mesh.matrixWorld);
            least.min(vertex);
            most.max(vertex);
        }
    });
    return { least, most };
}
