/** The four modes, drawn by three.js in linear light to floats; codes are made last, here. */

import { DepthTexture, FloatType, MeshLambertMaterial, NearestFilter, UnsignedIntType, WebGLRenderTarget, WebGLRenderer } from 'three';
import { box } from './camera.mjs';

/** What takes the place of the light in MeshLambertMaterial, which has all that the modes need: colour, texture, alpha, and the normal of the side that is seen, in view space. */
const COLORS = {
    unlit: 'outgoingLight = diffuseColor.rgb;',
    lambert: `
        vec3 l = normalize(vec3(0.5, 1.0, 0.8));
        float cosine = max(0.0, dot(inverseTransformDirection(normal, viewMatrix), l));
        outgoingLight = diffuseColor.rgb * (0.25 + 0.75 * cosine);`,
    normals: 'outgoingLight = inverseTransformDirection(normal, viewMatrix) * 0.5 + 0.5;',
    depth: 'outgoingLight = vec3(vViewPosition.z);',
};

export class Painter {
    constructor(size) {
        this.size = size;
        this.renderer = new WebGLRenderer({ antialias: false });
        this.renderer.setClearColor(0x000000, 0);
        this.target = new WebGLRenderTarget(size, size, {
            type: FloatType, minFilter: NearestFilter, magFilter: NearestFilter, depthTexture: new DepthTexture(size, size, UnsignedIntType),
        });
    }

    /** What WebGL runs on, and the fineness of the grid that it snaps vertices to. */
    driver() {
        const gl = this.renderer.getContext();
        const name = gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
        return `${name}, ${gl.getParameter(gl.SUBPIXEL_BITS)} subpixel bits`;
    }

    /** The picture's codes, rows from above: four bytes a pixel, or of `depth` a number of 16 bits. */
    paint(scene, camera, mode) {
        dress(scene, mode);
        if (mode === 'unlit' || mode === 'lambert') sort(scene, camera);
        this.renderer.setRenderTarget(this.target);
        this.renderer.clear();
        this.renderer.render(scene, camera);
        const pixels = new Float32Array(this.size * this.size * 4);
        this.renderer.readRenderTargetPixels(this.target, 0, 0, this.size, this.size, pixels);
        const lost = this.renderer.getContext().getError();
        if (lost) throw new Error(`WebGL error ${lost}`);
        return mode === 'depth' ? depths(pixels, this.size, camera) : colors(pixels, this.size, mode !== 'normals');
    }

    /** Gives back what a scene holds on the GPU's side. */
    forget(scene) {
        scene.traverse(({ geometry, material }) => {
            geometry?.dispose();
            for (const one of material ? [material].flat() : []) {
                one.map?.dispose();
                one.dispose();
            }
        });
    }
}

/** Gives each mesh the mode's material, with what its own says of colour, alpha and sides. */
function dress(scene, mode) {
    scene.traverse((mesh) => {
        if (!mesh.isMesh) return;
        mesh.own ??= mesh.material;
        mesh.frustumCulled = false;
        const flat = !mesh.geometry.hasAttribute('normal');
        const dressed = [mesh.own].flat().map((own) => dressing(own, mode, flat));
        mesh.material = Array.isArray(mesh.own) ? dressed : dressed[0];
    });
}

function dressing(own, mode, flatShading) {
    const { color, map = null, opacity, alphaTest, side, vertexColors } = own;
    const blends = own.transparent && (mode === 'unlit' || mode === 'lambert');
    const material = new MeshLambertMaterial({
        color, map, opacity, alphaTest, side, vertexColors, flatShading,
        transparent: blends, depthWrite: !blends, premultipliedAlpha: blends, toneMapped: false,
    });
    material.onBeforeCompile = (shader) => {
        shader.fragmentShader = shader.fragmentShader.replace('#include <opaque_fragment>', `${COLORS[mode]}\n#include <opaque_fragment>`);
    };
    material.customProgramCacheKey = () => mode;
    return material;
}

/** What blends is drawn from back to front, by the middles of boxes: three.js goes by nodes' origins. */
function sort(scene, camera) {
    const blended = [];
    scene.traverse((mesh) => {
        if (!mesh.isMesh || ![mesh.material].flat().some(({ transparent }) => transparent)) return;
        const { least, most } = box({ traverse: (visit) => visit(mesh) });
        blended.push({ mesh, distance: least.add(most).multiplyScalar(0.5).distanceTo(camera.position) });
    });
    blended.sort((a, b) => b.distance - a.distance);
    blended.forEach(({ mesh }, place) => { mesh.renderOrder = place; });
}

/** Straight alpha; light on the sRGB curve (IEC 61966-2-1), or plain numbers. */
function colors(pixels, size, isLight) {
    const codes = new Uint8Array(size * size * 4);
    const curve = (x) => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
    const code = (x) => Math.round(255 * Math.min(Math.max(x, 0), 1));
    each(size, (from, to) => {
        const alpha = pixels[4 * from + 3];
        if (code(alpha) === 0) return;
        for (let channel = 0; channel < 3; channel++) {
            const straight = pixels[4 * from + channel] / alpha;
            codes[4 * to + channel] = code(isLight ? curve(straight) : straight);
        }
        codes[4 * to + 3] = code(alpha);
    });
    return codes;
}

/** round(65534 depth), and 65535 where nothing is. */
function depths(pixels, size, { near, far }) {
    const codes = new Uint16Array(size * size).fill(65535);
    each(size, (from, to) => {
        if (pixels[4 * from + 3] === 0) return;
        const depth = (pixels[4 * from] - near) / (far - near);
        codes[to] = Math.round(65534 * Math.min(Math.max(depth, 0), 1));
    });
    return codes;
}

/** WebGL's rows begin at the bottom. */
function each(size, visit) {
    for (let y = 0; y < size; y++) {
        for (let x = 0; x < size; x++) visit((size - 1 - y) * size + x, y * size + x);
    }
}
